//! Generation of random surfaces and the parameters of one.
#![expect(clippy::unwrap_used, reason = "a panic is how a bench fails")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use num_complex::Complex64;
use rustfft::FftPlanner;
use stribeck::metrics::{AreaCorrelation, BearingCurve};
use stribeck::surface::{
    Autocorrelation, DimpleLayout, GrooveDirection, HeightDistribution, RandomShape, RandomSurface,
    SelfAffine, Synthesis, Texture,
};
use stribeck::{Boundary, Grid};

fn surfaces() -> Vec<(&'static str, RandomSurface)> {
    let correlated = |autocorrelation, length_x, length_y| {
        RandomSurface::new(RandomShape::Correlated { autocorrelation, length_x, length_y }, 1e-7, 1)
    };
    let self_affine = |synthesis, roll_off| {
        let shape = SelfAffine { hurst: 0.8, longest: f64::INFINITY, roll_off, shortest: 0.0, synthesis };
        RandomSurface::new(RandomShape::SelfAffine(shape), 1e-7, 1)
    };
    let skewed = |surface: RandomSurface| {
        surface.with_distribution(HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 })
    };
    let bounded = |surface: RandomSurface| {
        surface.with_distribution(HeightDistribution::Johnson { skewness: -0.5, kurtosis: 2.2 })
    };
    let open = |surface: RandomSurface| surface.with_boundary(Boundary::Open);
    let gaussian = correlated(Autocorrelation::Gaussian, 20e-6, 20e-6);
    let exponential = correlated(Autocorrelation::Exponential, 20e-6, 20e-6);
    let noise = self_affine(Synthesis::FilteredNoise, 100e-6);
    let phase = self_affine(Synthesis::RandomPhase, 100e-6);
    // as long as the surface
    let long_waves = |synthesis| self_affine(synthesis, 1024e-6);
    vec![
        ("gaussian", gaussian),
        ("anisotropic", correlated(Autocorrelation::Gaussian, 200e-6, 10e-6)),
        ("exponential", exponential),
        ("self_affine_noise", noise),
        ("self_affine_phase", phase),
        ("gaussian_open", open(gaussian)),
        ("self_affine_open", open(noise)),
        ("exponential_open", open(exponential)),
        ("gaussian_open_long", open(correlated(Autocorrelation::Gaussian, 512e-6, 512e-6))),
        ("exponential_open_long", open(correlated(Autocorrelation::Exponential, 512e-6, 512e-6))),
        ("self_affine_open_long", open(long_waves(Synthesis::FilteredNoise))),
        ("self_affine_open_long_phase", open(long_waves(Synthesis::RandomPhase))),
        ("self_affine_open_long_skewed", open(skewed(long_waves(Synthesis::FilteredNoise)))),
        ("gaussian_skewed", skewed(gaussian)),
        ("gaussian_bounded", bounded(gaussian)),
        ("exponential_skewed", skewed(exponential)),
        ("self_affine_skewed", skewed(phase)),
    ]
}

/// In place, block by block.
fn transpose(field: &mut [Complex64]) {
    for (row, column) in (0..32 * 32).map(|block| (block / 32 * 32, block % 32 * 32)).filter(|(r, c)| r <= c)
    {
        for j in row..row + 32 {
            for i in (column..column + 32).filter(|i| *i > j) {
                field.swap(j * 1024 + i, i * 1024 + j);
            }
        }
    }
}

fn generation(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("generate_1024");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    let grid = Grid::centred(1024, 1024, 1e-6, 1e-6).unwrap();
    group.throughput(Throughput::Elements(grid.len() as u64));
    // what a surface cannot be faster than: one complex transform there and one back, as plain as it gets
    group.bench_function("two_transforms", |bencher| {
        let mut field = vec![Complex64::new(1.0, 0.0); grid.len()];
        let plan = FftPlanner::new().plan_fft_forward(1024);
        bencher.iter(|| {
            for _ in 0..4 {
                plan.process(&mut field);
                transpose(&mut field);
                field.iter_mut().for_each(|value| *value /= 1024_f64.sqrt());
            }
            black_box(&field);
        });
    });
    for (name, surface) in surfaces() {
        group.bench_function(name, |bencher| bencher.iter(|| black_box(surface.generate(&grid).unwrap())));
    }
    let layout = DimpleLayout::Random { seed: 1 };
    let dimples = Texture::Dimples { radius: 20e-6, depth: 1e-6, pitch: 50e-6, layout };
    let direction = GrooveDirection::Crossed;
    let grooves = Texture::Grooves { width: 10e-6, depth: 1e-6, pitch: 25e-6, direction };
    for (name, texture) in [("dimples", dimples), ("grooves", grooves)] {
        group.bench_function(name, |bencher| bencher.iter(|| black_box(texture.generate(&grid).unwrap())));
    }
    group.finish();
}

fn parameters(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("parameters_1024");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    let grid = Grid::centred(1024, 1024, 1e-6, 1e-6).unwrap();
    group.throughput(Throughput::Elements(grid.len() as u64));
    let (_, surface) = surfaces()[0];
    let heights = surface.generate(&grid).unwrap();
    group.bench_function("bearing", |bencher| {
        bencher.iter(|| BearingCurve::new(black_box(&heights)).unwrap().core());
    });
    group.bench_function("autocorrelation", |bencher| {
        bencher.iter(|| AreaCorrelation::new(&grid, black_box(&heights), None, Boundary::Open).unwrap());
    });
    group.finish();
}

criterion_group!(benches, generation, parameters);
criterion_main!(benches);
