//! Time of the lubricant of a whole field as solvers read it, and of its table.
#![expect(clippy::unwrap_used, reason = "benchmark")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use stribeck::Grid;
use stribeck::analytic::HertzPoint;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};

fn roelands(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("roelands");
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    let oil = || {
        let viscosity = Roelands::new(0.004, 0.68, 1.96e8).unwrap();
        Lubricant::new(viscosity, DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap())
    };
    group.bench_function("table", |bencher| bencher.iter(|| black_box(oil())));
    let lubricant = oil();
    let ball = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9).unwrap();
    for n in [128, 256] {
        let grid = Grid::from_edges(n, n, [-0.25e-3, 0.25e-3], [-0.25e-3, 0.25e-3]).unwrap();
        // As in a contact: a third of the nodes under pressure, the others at zero.
        let pressure: Vec<f64> = grid.nodes().map(|(x, y)| ball.pressure_at(x, y)).collect();
        group.throughput(Throughput::Elements(grid.len() as u64));
        group.bench_function(BenchmarkId::new("field", n), |bencher| {
            bencher.iter(|| {
                for &p in black_box(&pressure) {
                    let _ = black_box(lubricant.at(p));
                }
            });
        });
    }
    group.finish();
}

criterion_group!(benches, roelands);
criterion_main!(benches);
