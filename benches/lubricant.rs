//! Time of the viscosity of a whole field: beside the elastic convolution the largest part of a cheap step.
#![expect(clippy::unwrap_used, reason = "benchmark")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use stribeck::Grid;
use stribeck::analytic::HertzPoint;
use stribeck::lubricant::{Roelands, ViscosityLaw};

fn roelands(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("roelands");
    group
        .sample_size(20)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    let law = Roelands::new(0.004, 0.68, 1.96e8).unwrap();
    let ball = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9).unwrap();
    for n in [128, 256] {
        let grid = Grid::from_edges(n, n, [-0.25e-3, 0.25e-3], [-0.25e-3, 0.25e-3]).unwrap();
        // As in a contact: a third of the nodes under pressure, the others at zero.
        let pressure: Vec<f64> = grid.nodes().map(|(x, y)| ball.pressure_at(x, y)).collect();
        let (mut viscosity, mut slope) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
        group.throughput(Throughput::Elements(grid.len() as u64));
        group.bench_function(BenchmarkId::new("fill_with_slope", n), |bencher| {
            bencher.iter(|| {
                law.fill_with_slope(black_box(&pressure), black_box(&mut viscosity), black_box(&mut slope));
            });
        });
    }
    group.finish();
}

criterion_group!(benches, roelands);
criterion_main!(benches);
