//! Gain of the feature `parallel`: the same work in pools of one and of two threads.
#![expect(clippy::unwrap_used, reason = "a benchmark stops at what it did not expect")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use rayon::ThreadPoolBuilder;
use stribeck::Grid;
use stribeck::analytic::HertzPoint;
use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::sim::scene::Roughness;
use stribeck::sim::{Scene, solve_contact};

fn displacement(c: &mut Criterion) {
    let hertz = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9).unwrap();
    let mut group = c.benchmark_group("displacement");
    for n in [256, 512, 1024] {
        let grid = Grid::from_edges(n, n, [-0.25e-3, 0.25e-3], [-0.25e-3, 0.25e-3]).unwrap();
        let pressure: Vec<f64> = grid.nodes().map(|(x, y)| hertz.pressure_at(x, y)).collect();
        let mut out = vec![0.0; grid.len()];
        group.throughput(Throughput::Elements(grid.len() as u64)).sample_size(10);
        group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(1000));
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut body = pool.install(|| HalfSpace::new(grid, 229.67e9).unwrap());
            group.bench_function(BenchmarkId::new(format!("{threads} threads"), n), |b| {
                b.iter(|| pool.install(|| body.displacement(black_box(&pressure), &mut out).unwrap()));
            });
        }
    }
    group.finish();
}

fn contact(c: &mut Criterion) {
    let mut group = c.benchmark_group("rough dry contact");
    for n in [512] {
        let mut scene = Scene::azam_2019(n);
        scene.lubricant = None;
        for (roughness, seed) in [(&mut scene.roughness.ball, 1), (&mut scene.roughness.disc, 2)] {
            *roughness = Roughness::gaussian(50e-9, 10e-6, seed);
        }
        group
            .sample_size(10)
            .warm_up_time(Duration::from_millis(200))
            .measurement_time(Duration::from_millis(1000));
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            group.bench_function(BenchmarkId::new(format!("{threads} threads"), n), |b| {
                b.iter(|| pool.install(|| solve_contact(black_box(&scene)).unwrap()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, displacement, contact);
criterion_main!(benches);
