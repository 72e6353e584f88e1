//! Time of the pieces of a lubricated solve, from a film that is right to its discretisation error: one
//! semi-system sweep, one multigrid cycle, one Newton step, viscosity and density of all nodes. Each of the
//! first three holds one evaluation of the film more, with which a solve begins or ends.
#![expect(clippy::unwrap_used, reason = "benchmark")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    ContactSolver, ContactState, FaceMobility, LubricatedContact, Multigrid, NewtonKrylov, Scheme,
    SemiSystem, StoppingRule,
};
use stribeck::sim::Scene;

fn pieces(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("reynolds");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(1000));
    for n in [64, 128, 256] {
        let mut scene = Scene::azam_2019(n);
        scene.motion.entrainment_speed = 2.0;
        let (grid, hertz) = (scene.grid().unwrap(), scene.hertz().unwrap());
        let mut gap = vec![0.0; grid.len()];
        scene.form.gap_into(&grid, &mut gap).unwrap();
        let mut body = HalfSpace::new(grid, scene.elastic.equivalent_modulus).unwrap();
        let oil = Lubricant::new(
            Roelands::new(0.004, 0.68, 1.96e8).unwrap(),
            DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
        );
        let mut problem = LubricatedContact::new(
            &gap,
            &mut body,
            hertz.force,
            (hertz.half_width_x, hertz.half_width_y),
            hertz.pressure,
        )
        .with_lubricant(Some(&oil))
        .with_entrainment_speed(scene.motion.entrainment_speed)
        .with_scheme(Scheme::default())
        .with_face_mobility(FaceMobility::default())
        .with_reference_film(60e-9);
        let mut start = ContactState::new(&grid);
        let none = StoppingRule::new(1e-12, 0);
        let once = none.with_max_iterations(1);
        let _ = Multigrid::new().solve(&mut problem, &mut start, &none).unwrap();
        let solvers: [(&str, Box<dyn ContactSolver>); 3] = [
            ("semi_system_step", Box::new(SemiSystem::default())),
            ("multigrid_cycle", Box::new(Multigrid::new())),
            ("newton_step", Box::new(NewtonKrylov::new())),
        ];
        for (name, mut solver) in solvers {
            group.bench_function(BenchmarkId::new(name, n), |bencher| {
                bencher.iter_batched(
                    || start.clone(),
                    |mut state| solver.solve(&mut problem, &mut state, &once).unwrap(),
                    BatchSize::LargeInput,
                );
            });
        }
        group.bench_function(BenchmarkId::new("viscosity", n), |bencher| {
            bencher.iter(|| {
                for &p in black_box(&start.pressure) {
                    let _ = black_box(oil.at(p));
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, pieces);
criterion_main!(benches);
