use faer::prelude::Solve;
use faer::{Col, Mat};

use super::periodicity::Neighbors;
use super::*;

/// A diagonally dominant, unsymmetric matrix without entries across edges; some nodes are decoupled.
fn matrix(nx: usize, ny: usize, periodicity: Periodicity) -> Vec<f32> {
    let neighbors = Neighbors::new(nx, ny, periodicity);
    let mut seed = 3_u64;
    let mut noise = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 40) as f32 / (1_u64 << 24) as f32
    };
    let alone = |k: usize| k % 7 == 3 || (k % nx > nx / 2 && k / nx > ny / 2);
    let mut stencil = vec![0.0; STENCIL * nx * ny];
    for (k, row) in stencil.chunks_exact_mut(STENCIL).enumerate() {
        for slot in 0..4 {
            if neighbors.has(k, slot) && !alone(k) && !alone(neighbors.at(k, slot + 1)) {
                row[slot + 1] = -noise();
            }
        }
        row[0] = 0.1 + row[1..].iter().map(|v| v.abs()).sum::<f32>();
        let unit = 10.0_f32.powf(6.0 * noise() - 20.0);
        row.iter_mut().for_each(|v| *v *= unit);
    }
    stencil
}

fn product(stencil: &[f32], neighbors: Neighbors, x: &[f64]) -> Vec<f32> {
    let row_sum = |(k, row): (usize, &[f32])| {
        let values = (0..STENCIL).map(|slot| x.get(neighbors.at(k, slot)).copied().unwrap_or(0.0));
        row.iter().zip(values).map(|(entry, x)| f64::from(*entry) * x).sum::<f64>() as f32
    };
    stencil.chunks_exact(STENCIL).enumerate().map(row_sum).collect()
}

/// Largest error of the solution of a matrix on a grid, of values up to 2e8.
fn error_of_solve(nx: usize, ny: usize, periodicity: Periodicity) -> f64 {
    let stencil = matrix(nx, ny, periodicity);
    let exact: Vec<f64> = (0..nx * ny).map(|k| 1e8 * (1.0 + (k as f64).sin())).collect();
    let mut lu = GridLu::new(nx, ny, periodicity);
    let mut worst = 0.0_f64;
    // Twice: the second factorization must not depend on the first.
    for _ in 0..2 {
        let mut x = product(&stencil, Neighbors::new(nx, ny, periodicity), &exact);
        assert!(lu.factorise(&stencil), "{nx} x {ny}");
        lu.solve(&mut x);
        worst = x.iter().zip(&exact).fold(worst, |m, (a, b)| m.max((f64::from(*a) - b).abs()));
    }
    worst
}

#[test]
fn solves_on_grids_of_any_shape() {
    for (nx, ny) in [(1, 1), (1, 40), (40, 1), (5, 3), (17, 16), (64, 48), (101, 67), (200, 170)] {
        for periodicity in Periodicity::ALL {
            let worst = error_of_solve(nx, ny, periodicity);
            assert!(worst < 1e-4 * 2e8, "{nx} x {ny}, {periodicity:?}: off by {worst}");
        }
    }
}

/// A ring of one or two nodes couples a node to itself, or to its neighbor on both sides.
#[test]
fn solves_on_rings_of_any_circumference() {
    for (around, along) in (1..=8).flat_map(|around| [1, 2, 3, 7, 60].map(|along| (around, along))) {
        let (x, y) = (
            error_of_solve(around, along, Periodicity::AlongX),
            error_of_solve(along, around, Periodicity::AlongY),
        );
        assert!(x.max(y) < 1e-4 * 2e8, "{around} around, {along} along: off by {x} and {y}");
    }
}

#[test]
fn solutions_are_bit_identical_for_any_number_of_tasks() {
    let (nx, ny) = (200, 170);
    let periodicity = Periodicity::AlongY;
    let stencil = matrix(nx, ny, periodicity);
    let right: Vec<f32> = (0..nx * ny).map(|k| stencil[STENCIL * k] * (2.0 + (k as f32).cos())).collect();
    let solutions = [1, 2, 5, 8].map(|tasks| {
        let mut lu = GridLu::new(nx, ny, periodicity);
        lu.tree = Tree::new(nx, ny, periodicity, tasks);
        let mut x = right.clone();
        assert!(lu.factorise(&stencil));
        lu.solve(&mut x);
        x.into_iter().map(f32::to_bits).collect::<Vec<_>>()
    });
    assert!(solutions.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn unknowns_may_have_any_units() {
    let (nx, ny) = (40, 30);
    let periodicity = Periodicity::AlongX;
    let neighbors = Neighbors::new(nx, ny, periodicity);
    let mut stencil = matrix(nx, ny, periodicity);
    let exact: Vec<f64> = (0..nx * ny).map(|k| 2.0 + (k as f64).sin()).collect();
    let right = product(&stencil, neighbors, &exact);
    // A flow equation beside pressures: its diagonal is 1e-9 of its other entries.
    let unit = |k: usize| if k.is_multiple_of(3) { 1e-9 } else { 1.0 };
    let mut lu = GridLu::new(nx, ny, periodicity);
    for (k, row) in stencil.chunks_exact_mut(STENCIL).enumerate() {
        for (slot, value) in row.iter_mut().enumerate() {
            *value *= unit(neighbors.at(k, slot)) as f32;
        }
    }
    let mut x = right;
    assert!(lu.factorise(&stencil));
    lu.solve(&mut x);
    for (k, (x, exact)) in x.iter().zip(&exact).enumerate() {
        assert!((f64::from(*x) * unit(k) / exact - 1.0).abs() < 1e-3, "node {k}: {x} for {exact}");
    }
}

#[test]
fn agrees_with_a_dense_factorisation_that_exchanges_rows() {
    let (nx, ny) = (17, 16);
    for periodicity in Periodicity::ALL {
        let (stencil, n) = (matrix(nx, ny, periodicity), nx * ny);
        let neighbors = Neighbors::new(nx, ny, periodicity);
        let mut lu = GridLu::new(nx, ny, periodicity);
        let mut dense = Mat::<f64>::zeros(n, n);
        for (k, row) in stencil.chunks_exact(STENCIL).enumerate() {
            for (slot, value) in row.iter().enumerate().filter(|(_, value)| **value != 0.0) {
                dense[(k, neighbors.at(k, slot))] = f64::from(*value);
            }
        }
        // Rows of sizes between 1e-20 and 1e-14: right sides of the size of each.
        let right: Vec<f32> = (0..n).map(|k| stencil[STENCIL * k] * (2.0 + (k as f32).cos())).collect();
        let exact = dense.partial_piv_lu().solve(Col::from_fn(n, |k| f64::from(right[k])));
        let mut x = right;
        assert!(lu.factorise(&stencil));
        lu.solve(&mut x);
        for (k, (x, exact)) in x.iter().zip(exact.iter()).enumerate() {
            assert!((f64::from(*x) / exact - 1.0).abs() < 1e-4, "{periodicity:?}, node {k}: {x} for {exact}");
        }
    }
}

#[test]
fn factorization_stops_when_told_to() {
    let (nx, ny) = (200, 200);
    let (stencil, polls) = (matrix(nx, ny, Periodicity::None), std::sync::atomic::AtomicUsize::new(0));
    let must_stop = || polls.fetch_add(1, std::sync::atomic::Ordering::Relaxed) == 2;
    let mut lu = GridLu::new(nx, ny, Periodicity::None);
    assert!(!lu.factorise_unless(&stencil, &must_stop));
    assert!(lu.factorise_unless(&stencil, &must_stop), "all later polls are false");
}

#[test]
fn factorization_fails_for_nan() {
    let mut stencil = matrix(9, 9, Periodicity::None);
    stencil[STENCIL * 40] = f32::NAN;
    assert!(!GridLu::new(9, 9, Periodicity::None).factorise(&stencil), "NaN");
    // Decoupled nodes.
    let mut alone: Vec<f32> = (0..81).flat_map(|_| [1.0, 0.0, 0.0, 0.0, 0.0]).collect();
    alone[STENCIL * 40] = 0.0;
    let mut lu = GridLu::new(9, 9, Periodicity::None);
    assert!(lu.factorise(&alone), "a zero pivot is perturbed");
    let mut x = vec![1.0; 81];
    lu.solve(&mut x);
    assert!(x.iter().all(|x| x.is_finite()));
    alone[STENCIL * 40] = f32::NAN;
    assert!(!GridLu::new(9, 9, Periodicity::None).factorise(&alone), "NaN of a decoupled node");
}
