//! Time of one elastic convolution beside that of the bare transforms of its padded size.
#![expect(clippy::unwrap_used, reason = "benchmark")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use num_complex::Complex64;
use realfft::RealFftPlanner;
use rustfft::FftPlanner;
use stribeck::Grid;
use stribeck::elastic::{DeformationModel, HalfSpace};

/// One forward and one inverse real transform of `2 n` x `2 n` points, all rows and columns, columns
/// contiguous: the yardstick. It neither skips rows of zeros nor transposes, and it multiplies no kernel.
struct BareTransforms {
    size: usize,
    field: Vec<f64>,
    rows: Vec<Complex64>,
    columns: Vec<Complex64>,
    scratch: Vec<Complex64>,
    real: RealFftPlanner<f64>,
    complex: FftPlanner<f64>,
}

impl BareTransforms {
    fn new(n: usize) -> Self {
        let (size, half) = (2 * n, n + 1);
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let scratch = real
            .plan_fft_forward(size)
            .get_scratch_len()
            .max(real.plan_fft_inverse(size).get_scratch_len())
            .max(complex.plan_fft_forward(size).get_inplace_scratch_len())
            .max(complex.plan_fft_inverse(size).get_inplace_scratch_len());
        Self {
            size,
            field: vec![0.0; size * size],
            rows: vec![Complex64::default(); half * size],
            columns: vec![Complex64::default(); half * size],
            scratch: vec![Complex64::default(); scratch],
            real,
            complex,
        }
    }

    fn run(&mut self) {
        let Self { size, field, rows, columns, scratch, real, complex } = self;
        let half = *size / 2 + 1;
        let (forward, inverse) = (real.plan_fft_forward(*size), real.plan_fft_inverse(*size));
        for (row, spectrum) in field.chunks_exact_mut(*size).zip(rows.chunks_exact_mut(half)) {
            forward.process_with_scratch(row, spectrum, scratch).unwrap();
        }
        complex.plan_fft_forward(*size).process_with_scratch(columns, scratch);
        complex.plan_fft_inverse(*size).process_with_scratch(columns, scratch);
        for (row, spectrum) in field.chunks_exact_mut(*size).zip(rows.chunks_exact_mut(half)) {
            inverse.process_with_scratch(spectrum, row, scratch).unwrap();
        }
    }
}

fn convolution(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("elastic");
    group
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    for n in [64, 128, 256, 512, 1024] {
        group.throughput(Throughput::Elements((n * n) as u64));
        let grid = Grid::centred(n, n, 1e-6, 1e-6).unwrap();
        let mut body = HalfSpace::new(grid, 230e9).unwrap();
        let pressure: Vec<f64> = (0..grid.len()).map(|k| 1e9 + 1e6 * (k % 101) as f64).collect();
        let mut out = vec![0.0; grid.len()];
        group.bench_function(BenchmarkId::new("displacement", n), |bencher| {
            bencher.iter(|| body.displacement(black_box(&pressure), black_box(&mut out)).unwrap());
        });
        let mut bare = BareTransforms::new(n);
        group.bench_function(BenchmarkId::new("bare_transforms", n), |bencher| bencher.iter(|| bare.run()));
    }
    group.finish();
}

criterion_group!(benches, convolution);
criterion_main!(benches);
