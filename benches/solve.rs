//! Time of whole contacts, each from a cold start with kernel, plan and buffers still to be made: a full film
//! (M = 20, L = 10), a highly loaded one (M = 1000, L = 10), a dry rough and a mixed contact. Further, a step of a
//! history, and reading a scene and a measured surface.
#![expect(clippy::unwrap_used, reason = "benchmark")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use stribeck::Status;
use stribeck::sim::scene::{GridSpec, Load};
use stribeck::sim::{MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::{Form, read_bytes};

/// A smooth ball by its Moes load parameter, L = 10.
fn ball(moes_load: f64, n: usize) -> Scene {
    const MODULUS: f64 = 226e9;
    let mut scene = Scene::azam_2019(n);
    let oil = scene.lubricant.as_mut().unwrap();
    (oil.eta0, oil.alpha) = (0.04, Some(2.2e-8));
    let speed = (10.0 / (2.2e-8 * MODULUS)).powi(4);
    scene.form = Form::Sphere { radius: 1.0 };
    scene.elastic.equivalent_modulus = MODULUS;
    scene.load = Load::force(moes_load * speed.powf(0.75) * MODULUS);
    scene.motion.entrainment_speed = 0.5 * speed * MODULUS / 0.04;
    scene.roughness = Default::default();
    scene.plastic = None;
    let a = scene.hertz().unwrap().half_width_x;
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-4.5 * a, 1.5 * a], y: [-3.0 * a, 3.0 * a] };
    scene
}

fn scenes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("solve");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(1000));
    for n in [64, 128] {
        let mut dry = Scene::azam_2019(n);
        dry.lubricant = None;
        let scenes = [
            ("full_film", ball(20.0, n)),
            ("highly_loaded", ball(1000.0, n)),
            ("dry_rough", dry),
            ("mixed", Scene::azam_2019(n)),
        ];
        for (name, scene) in scenes {
            group.bench_function(BenchmarkId::new(name, n), |bencher| {
                bencher.iter(|| {
                    let solution = solve_contact(&scene).unwrap();
                    assert_eq!(solution.report.status, Status::Converged);
                    solution.state.approach
                });
            });
        }
    }
    group.finish();
}

fn histories(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("history");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(1000));
    for n in [64, 128] {
        let scene = Scene::azam_2019(n).with_tribofilm();
        let mut start = MixedLubricationSim::builder(scene).build().unwrap();
        // The first contact starts from the dry one.
        start.step(10.0).unwrap();
        group.bench_function(BenchmarkId::new("step", n), |bencher| {
            bencher.iter_batched(
                || start.clone(),
                |mut sim| sim.step(10.0).unwrap().contact.load_ratio,
                BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

fn files(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("read");
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(1000));
    let text = Scene::azam_2019(128).to_toml().unwrap();
    group.bench_function("scene", |bencher| bencher.iter(|| Scene::from_toml(black_box(&text)).unwrap()));
    for name in ["cut.txt", "cut.x3p"] {
        let bytes = std::fs::read(format!("tests/data/surfaces/{name}")).unwrap();
        group.bench_function(name, |bencher| {
            bencher.iter(|| read_bytes(black_box(&bytes), name).unwrap());
        });
    }
    group.finish();
}

criterion_group!(benches, scenes, histories, files);
criterion_main!(benches);
