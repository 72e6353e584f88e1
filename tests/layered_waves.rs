//! Stresses in and below a bonded layer as integrals over waves, under Hertz' pressure and a line.

use std::f64::consts::PI;

use stribeck::Grid;
use stribeck::elastic::LayeredStress;

use crate::common::coated::{Materials, PAIRS, components, hertz, layer};
use crate::common::dense::solve;

/// Airy's function with two derivatives under both loads, and the derivative of shear across the wave.
type Functions = ([[f64; 3]; 2], f64);

/// Airy's function and its first two derivatives at the depth `x` over the wave number, in or below a layer
/// of thickness `d` over the wave number, under unit pressure and under a unit first derivative at the
/// surface; and the first derivative of the function of shear across the wave under a unit one. Linear
/// systems of six and three conditions at surface and bond.
fn wave([[g1, v1], [g2, v2]]: Materials, d: f64, x: f64) -> Functions {
    let falling = |x: f64| {
        [
            [1.0, -1.0, 1.0, -1.0].map(|s| s * (-x).exp()),
            [x, 1.0 - x, x - 2.0, 3.0 - x].map(|s| s * (-x).exp()),
        ]
    };
    let rising = |x: f64| {
        [[1.0; 4].map(|s| s * (x - d).exp()), [x, x + 1.0, x + 2.0, x + 3.0].map(|s| s * (x - d).exp())]
    };
    let both = |x: f64| [falling(x)[0], falling(x)[1], rising(x)[0], rising(x)[1]];
    let displacements = |f: [f64; 4], g: f64, v: f64| {
        [((1.0 - v) * f[2] + v * f[0]) / g, ((1.0 - v) * f[3] - (2.0 - v) * f[1]) / g]
    };
    let mut matrix = [[0.0; 6]; 6];
    for (k, (top, bond)) in both(0.0).into_iter().zip(both(d)).enumerate() {
        let [u, w] = displacements(bond, g1, v1);
        [top[0], top[1], bond[0], bond[1], u, w]
            .into_iter()
            .enumerate()
            .for_each(|(row, v)| matrix[row][k] = v);
    }
    for (k, bond) in falling(d).into_iter().enumerate() {
        let [u, w] = displacements(bond, g2, v2);
        [bond[0], bond[1], u, w].into_iter().enumerate().for_each(|(row, v)| matrix[row + 2][k + 4] = -v);
    }
    let loads = [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, 0.0, 0.0]];
    let functions = loads.map(|load| {
        let c = solve(matrix, load);
        let sum = |k: usize| {
            if x <= d {
                both(x).into_iter().zip(&c[..4]).map(|(f, c)| c * f[k]).sum::<f64>()
            } else {
                falling(x).into_iter().zip(&c[4..]).map(|(f, c)| c * f[k]).sum::<f64>()
            }
        };
        [sum(0), sum(1), sum(2)]
    });
    let (up, down) = ((-d).exp(), 1.0);
    let across = solve([[-1.0, up, 0.0], [-up, down, up], [up / g1, down / g1, -up / g2]], [1.0, 0.0, 0.0]);
    let slope =
        if x <= d { across[1] * (x - d).exp() - across[0] * (-x).exp() } else { -across[2] * (-x).exp() };
    (functions, slope)
}

/// Midpoints of `n` intervals.
fn integral(to: f64, n: u32, value: impl Fn(f64) -> f64) -> f64 {
    let step = to / f64::from(n);
    (0..n).map(|k| value((f64::from(k) + 0.5) * step)).sum::<f64>() * step
}

/// Below the center of a Hertz pressure, and of a traction of that shape, stresses are integrals over wave
/// numbers.
#[test]
fn axis_stresses_of_a_coated_hertz_contact_match_the_hankel_integral() {
    let (n, cell) = (161, 0.03);
    let grid = Grid::centred(n, n, cell, cell).unwrap();
    let (load, centre, none) = (hertz(&grid), n / 2 * n + n / 2, vec![0.0; n * n]);
    for materials in PAIRS {
        for thickness in [0.2, 0.8] {
            let body = layer(thickness, materials);
            let pressed = LayeredStress::new(&grid, body, &load, None).unwrap();
            let sheared = LayeredStress::new(&grid, body, &none, Some(&load)).unwrap();
            for (z, below) in [(0.1, false), (0.2, false), (thickness, true), (1.0, true)] {
                let at = |s: &LayeredStress| if below { s.in_substrate(z) } else { s.in_layer(z) }.unwrap();
                let v = materials[usize::from(below)][1];
                let share = if below { 1.0 + 1e-12 } else { 1.0 };
                // Transform of the Hertz pressure times q/(2 pi).
                let spectrum = |q: f64| (q.sin() - q * q.cos()) / (q * q);
                let over_waves = |value: fn(f64, Functions) -> f64| {
                    integral(60.0, 12_000, |q| {
                        spectrum(q) * value(v, wave(materials, q * thickness, q * z * share))
                    })
                };
                let exact = [
                    over_waves(|v, (f, _)| 0.5 * ((1.0 + v) * f[0][2] - v * f[0][0])),
                    over_waves(|_, (f, _)| -f[0][0]),
                    over_waves(|_, (f, across)| -0.5 * (f[1][1] + across)),
                ];
                let (p, t) = (components(&at(&pressed), centre), components(&at(&sheared), centre));
                for (found, exact) in [(p[0], exact[0]), (p[1], exact[0]), (p[2], exact[1]), (t[4], exact[2])]
                {
                    let size = 1.0 + exact.abs();
                    println!("{materials:?}, h {thickness}, z {z}: {found:.5} {exact:.5}");
                    assert!(
                        (found - exact).abs() < 3e-4 * size,
                        "{materials:?}, {thickness}, {z}: {found} {exact}"
                    );
                }
            }
        }
    }
}

/// The plane-strain counterpart below the middle of a strip under uniform loads.
#[test]
fn coated_line_stresses_match_the_fourier_integral() {
    let unit = 1e-4;
    let grid = Grid::from_edges(201, 1, [-2.01 * unit, 2.01 * unit], [-0.5, 0.5]).unwrap();
    // The cells of 0.02 end at 1.01.
    let half = 1.01;
    let load: Vec<f64> = grid.nodes().map(|(x, _)| f64::from(u8::from(x.abs() < half * unit))).collect();
    let none = vec![0.0; 201];
    for materials in PAIRS {
        for thickness in [0.2, 0.8] {
            let body = layer(thickness * unit, materials);
            let pressed = LayeredStress::new(&grid, body, &load, None).unwrap();
            let sheared = LayeredStress::new(&grid, body, &none, Some(&load)).unwrap();
            for (z, below) in [(0.15, false), (0.2, false), (thickness, true), (1.0, true)] {
                let at = |s: &LayeredStress| {
                    if below { s.in_substrate(z * unit) } else { s.in_layer(z * unit) }.unwrap()
                };
                let v = materials[usize::from(below)][1];
                let share = if below { 1.0 + 1e-12 } else { 1.0 };
                let over_waves = |value: fn([[f64; 3]; 2]) -> f64| {
                    let spectrum = |q: f64| 2.0 / PI * (half * q).sin() / q;
                    integral(80.0, 40_000, |q| {
                        spectrum(q) * value(wave(materials, q * thickness, q * z * share).0)
                    })
                };
                let (xx, zz) = (over_waves(|f| f[0][2]), over_waves(|f| -f[0][0]));
                let (p, t) = (components(&at(&pressed), 100), components(&at(&sheared), 100));
                let exact = [(p[0], xx), (p[1], v * (xx + zz)), (p[2], zz), (t[4], over_waves(|f| -f[1][1]))];
                for (found, exact) in exact {
                    println!("{materials:?}, h {thickness}, z {z}: {found:.5} {exact:.5}");
                    let bound = 5e-4 * (1.0 + exact.abs());
                    assert!(
                        (found - exact).abs() < bound,
                        "{materials:?}, {thickness}, {z}: {found} {exact}"
                    );
                }
            }
        }
    }
}
