//! Factorizes and solves five-point matrices by stribeck and by faer, in single precision on one thread, and prints a
//! table of milliseconds: the least of repeats.
//!
//! ```text
//! RAYON_NUM_THREADS=1 cargo run --release --manifest-path tests/peers/sparse_lu/Cargo.toml
//! cargo run --release --manifest-path tests/peers/sparse_lu/Cargo.toml -- 5   # both in Newton's method, every fifth contact of the battery
//! ```
//!
//! The matrices are upwind convection and diffusion with coefficients over six decades, as cubes of films are. Nodes in
//! patches, a fifth of all, are decoupled, as those in solid contact are.

mod contacts;

use std::error::Error;
use std::time::Instant;

use faer::linalg::solvers::Solve as _;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use stribeck::testing::StencilLu;

/// Nodes along each side.
const SIDES: [usize; 5] = [64, 128, 256, 512, 1024];
/// Seconds of repeats of each row.
const SECONDS: f64 = 1.0;

fn main() -> Result<(), Box<dyn Error>> {
    if let Some(every) = std::env::args().nth(1) {
        return contacts::compare(every.parse()?);
    }
    println!("| nodes | own: factor, solve | faer: pattern, factor, solve | largest difference |");
    println!("|---|---|---|---|");
    for n in SIDES {
        let stencil = stencil(n);
        let right: Vec<f32> = (0..n * n).map(|k| ((k * 7919 % 101) as f32) / 101.0 - 0.5).collect();
        let mut own = StencilLu::new(n, n);
        let factor = least(|| assert!(own.factorize(&stencil)));
        let mut x = right.clone();
        let solve = least(|| {
            x.copy_from_slice(&right);
            own.solve(&mut x);
        });
        let matrix = SparseColMat::<u32, f32>::try_new_from_triplets(n * n, n * n, &triplets(n, &stencil))
            .map_err(|error| format!("{error:?}"))?;
        let pattern = SymbolicLu::try_new(matrix.symbolic()).map_err(|error| format!("{error:?}"))?;
        let pattern_time = least(|| drop(SymbolicLu::try_new(matrix.symbolic())));
        let make = || Lu::try_new_with_symbolic(pattern.clone(), matrix.as_ref());
        let lu = make().map_err(|error| format!("{error:?}"))?;
        let faer_factor = least(|| drop(make()));
        let mut y = faer::Mat::<f32>::zeros(n * n, 1);
        let faer_solve = least(|| {
            y.col_as_slice_mut(0).copy_from_slice(&right);
            lu.solve_in_place(y.as_mut());
        });
        let largest = x.iter().fold(0.0_f32, |most, value| most.max(value.abs()));
        let difference =
            x.iter().zip(y.col_as_slice(0)).fold(0.0_f32, |most, (a, b)| most.max((a - b).abs() / largest));
        println!(
            "| {n} x {n} | {factor:.2}, {solve:.2} | {pattern_time:.1}, {faer_factor:.2}, {faer_solve:.2} | {difference:.0e} |"
        );
    }
    Ok(())
}

/// Least of the milliseconds of repeats, since other work on the machine only adds.
fn least(mut work: impl FnMut()) -> f64 {
    let (start, mut times) = (Instant::now(), Vec::new());
    while times.len() < 3 || start.elapsed().as_secs_f64() < SECONDS {
        let one = Instant::now();
        work();
        times.push(1e3 * one.elapsed().as_secs_f64());
    }
    times.sort_unstable_by(f64::total_cmp);
    times[0]
}

/// Rows in the order center, east, west, north, south.
fn stencil(n: usize) -> Vec<f32> {
    let wave = |i: usize, j: usize| {
        let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
        (31.0 * x + 3.0 * (17.0 * y).sin()).sin() * (29.0 * y + 2.0 * (19.0 * x).cos()).sin()
    };
    let is_solid = |k: usize| wave(k % n, k / n) > 0.42;
    let conductance =
        |a: usize, b: usize| 10.0_f64.powf(-3.0 - 3.0 * wave(a % n, a / n).max(wave(b % n, b / n)));
    let mut stencil = vec![0.0; 5 * n * n];
    for k in 0..n * n {
        if is_solid(k) {
            stencil[5 * k] = 1.0;
            continue;
        }
        let neighbors = [
            (k % n + 1 < n, 1_isize),
            (k % n > 0, -1),
            (k / n + 1 < n, n as isize),
            (k / n > 0, -(n as isize)),
        ];
        let mut center = 1e-7;
        for (side, (exists, offset)) in neighbors.into_iter().enumerate() {
            let flow = if exists { conductance(k, k.wrapping_add_signed(offset)) } else { conductance(k, k) };
            // Upwind convection from the west.
            let carried = if side == 1 { 1e-5 } else { 0.0 };
            center += flow + carried;
            if exists && !is_solid(k.wrapping_add_signed(offset)) {
                stencil[5 * k + 1 + side] = -(flow + carried) as f32;
            }
        }
        stencil[5 * k] = center as f32;
    }
    stencil
}

fn triplets(n: usize, stencil: &[f32]) -> Vec<Triplet<u32, u32, f32>> {
    let offsets = [0, 1, -1, n as isize, -(n as isize)];
    let entry = |k: usize, side: usize| {
        let value = stencil[5 * k + side];
        let column = k.wrapping_add_signed(offsets[side]) as u32;
        (value != 0.0).then(|| Triplet::new(k as u32, column, value))
    };
    (0..n * n).flat_map(|k| (0..5).filter_map(move |side| entry(k, side))).collect()
}
