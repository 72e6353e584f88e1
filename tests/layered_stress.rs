//! Stresses in and below a bonded layer: half-spaces as limits, integrals over waves, equilibrium, continuity at
//! the bond, lines, scenes and errors.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

use std::f64::consts::PI;

use stribeck::Grid;
use stribeck::elastic::{Layer, LayeredStress, StressField, subsurface_stress};

fn components(field: &StressField, k: usize) -> [f64; 6] {
    [field.xx[k], field.yy[k], field.zz[k], field.xy[k], field.xz[k], field.yz[k]]
}

/// Shear moduli and Poisson's ratios of layer and substrate.
type Materials = [[f64; 2]; 2];

fn layer(thickness: f64, [own, below]: Materials) -> Layer {
    let young = |[g, v]: [f64; 2]| [2.0 * g * (1.0 + v), v];
    Layer::new(thickness, young(own), young(below)).unwrap()
}

const PAIRS: [Materials; 3] =
    [[[4.0, 0.25], [1.0, 0.3]], [[0.2, 0.4], [1.0, 0.3]], [[30.0, 0.2], [1.0, 0.5]]];

/// Smooth loads of unit size in the middle of `grid`.
fn smooth(grid: &Grid) -> [Vec<f64>; 2] {
    let bell = |x: f64, y: f64| (-3.0 * (x * x + y * y)).exp();
    let pressure = grid.nodes().map(|(x, y)| bell(x, y)).collect();
    let traction = grid.nodes().map(|(x, y)| 0.4 * bell(x - 0.2, y + 0.1)).collect();
    [pressure, traction]
}

fn largest_difference(one: &StressField, other: &StressField) -> f64 {
    let pairs = (0..one.xx.len()).map(|k| (components(one, k), components(other, k)));
    pairs.flat_map(|(a, b)| (0..6).map(move |c| (a[c] - b[c]).abs())).fold(0.0, f64::max)
}

#[test]
fn a_layer_of_the_substrate_changes_nothing() {
    for (nx, ny) in [(20, 17), (40, 1)] {
        let grid = Grid::centred(nx, ny, 0.1, if ny == 1 { 1.0 } else { 0.13 }).unwrap();
        let [pressure, traction] = smooth(&grid);
        for thickness in [1e-6, 0.3, 50.0] {
            let body = layer(thickness, [[80e9, 0.3]; 2]);
            let stress = LayeredStress::new(&grid, body, &pressure, Some(&traction)).unwrap();
            for share in [0.0, 0.4, 1.0, 1.5, 4.0] {
                let depth = share * thickness;
                let bare = subsurface_stress(&grid, 0.3, depth, &pressure, Some(&traction)).unwrap();
                if share <= 1.0 {
                    assert!(largest_difference(&stress.in_layer(depth).unwrap(), &bare) < 1e-10);
                }
                if share >= 1.0 {
                    assert!(largest_difference(&stress.in_substrate(depth).unwrap(), &bare) < 1e-10);
                }
            }
        }
    }
}

/// At the surface the stresses are the loads, at the bond tractions are continuous, whatever the layer.
#[test]
fn loads_and_tractions_are_exact() {
    let grid = Grid::centred(24, 20, 0.1, 0.13).unwrap();
    let [pressure, traction] = smooth(&grid);
    for materials in PAIRS {
        for thickness in [1e-3, 0.1, 1.0, 30.0] {
            let stress =
                LayeredStress::new(&grid, layer(thickness, materials), &pressure, Some(&traction)).unwrap();
            let surface = stress.in_layer(0.0).unwrap();
            let [over, under] =
                [stress.in_layer(thickness).unwrap(), stress.in_substrate(thickness).unwrap()];
            for k in 0..grid.len() {
                assert!((surface.zz[k] + pressure[k]).abs() < 1e-12, "{materials:?}, {thickness}");
                assert!((surface.xz[k] + traction[k]).abs() < 1e-12 && surface.yz[k].abs() < 1e-12);
                let [over, under] = [components(&over, k), components(&under, k)];
                for c in [2, 4, 5] {
                    assert!((over[c] - under[c]).abs() < 1e-12, "{materials:?}, {thickness}: {c}");
                }
            }
        }
    }
}

/// Strains in the plane of the bond are the same on both sides: displacements are continuous.
#[test]
fn displacements_are_continuous_at_the_bond() {
    let n = 161;
    let grid = Grid::centred(n, n, 0.05, 0.05).unwrap();
    let [pressure, traction] = smooth(&grid);
    for materials in PAIRS {
        for thickness in [0.2, 0.5, 1.5] {
            let stress =
                LayeredStress::new(&grid, layer(thickness, materials), &pressure, Some(&traction)).unwrap();
            let fields = [stress.in_layer(thickness).unwrap(), stress.in_substrate(thickness).unwrap()];
            let strains = |body: usize, k: usize| {
                let ([g, v], s) = (materials[body], components(&fields[body], k));
                let share = v / (1.0 + v) * (s[0] + s[1] + s[2]);
                [s[0] - share, s[1] - share, s[3]].map(|stress| stress / (2.0 * g))
            };
            let (mut worst, mut size) = (0.0_f64, 0.0_f64);
            for k in middle(n, n / 4) {
                let [over, under] = [strains(0, k), strains(1, k)];
                for c in 0..3 {
                    worst = worst.max(2.0 * materials[0][0] * (over[c] - under[c]).abs());
                    size = size.max(components(&fields[0], k)[c].abs());
                }
            }
            println!("{materials:?}, {thickness}: {worst:.1e} of {size:.2}");
            assert!(
                worst < 1e-3 * (materials[0][0] / materials[1][0]).max(2.0),
                "{materials:?}, {thickness}: {worst:e} of {size}"
            );
        }
    }
}

/// Nodes of `n` x `n` that are `margin` nodes away from the edges.
fn middle(n: usize, margin: usize) -> impl Iterator<Item = usize> {
    let inner = margin..n - margin;
    inner.clone().flat_map(move |j| inner.clone().map(move |i| j * n + i))
}

/// What is left of the forces on a volume is the gradient of the stresses of the images, which falls with
/// the size of the box.
#[test]
fn stresses_are_in_equilibrium() {
    for materials in PAIRS {
        for depth in [0.25, 0.45, 0.55, 1.0] {
            let [small, large] = [81, 161].map(|n| force(materials, n, depth));
            println!("{materials:?} at {depth}: {small:.1e}, {large:.1e}");
            assert!(
                large < 3e-3 && (large < 0.3 * small || large < 3e-4),
                "{materials:?}: {small:e} {large:e}"
            );
        }
    }
}

/// Largest force on a volume in the middle of a box of `n` x `n` cells at `depth`.
fn force(materials: Materials, n: usize, depth: f64) -> f64 {
    let (cell, step) = (0.05, 0.01);
    let grid = Grid::centred(n, n, cell, cell).unwrap();
    let [pressure, traction] = smooth(&grid);
    let stress = LayeredStress::new(&grid, layer(0.5, materials), &pressure, Some(&traction)).unwrap();
    let at = |z: f64| if depth < 0.5 { stress.in_layer(z) } else { stress.in_substrate(z) }.unwrap();
    let [before, here, after] = [depth - step, depth, depth + step].map(at);
    let forces = middle(n, n / 2 - 20).map(|k| {
        // Fourth order along the nodes.
        let slope = |field: &[f64], by: usize| {
            (8.0 * (field[k + by] - field[k - by]) - field[k + 2 * by] + field[k - 2 * by]) / (12.0 * cell)
        };
        let down = |field: fn(&StressField) -> &[f64]| (field(&after)[k] - field(&before)[k]) / (2.0 * step);
        let forces = [
            slope(&here.xx, 1) + slope(&here.xy, n) + down(|s| &s.xz),
            slope(&here.xy, 1) + slope(&here.yy, n) + down(|s| &s.yz),
            slope(&here.xz, 1) + slope(&here.yz, n) + down(|s| &s.zz),
        ];
        forces.into_iter().fold(0.0_f64, |worst, force| worst.max(force.abs()))
    });
    forces.fold(0.0, f64::max)
}

/// A thin layer leaves the substrate as it is, a thick one is all there is.
#[test]
fn thin_and_thick_layers_are_half_spaces() {
    let grid = Grid::centred(61, 61, 0.1, 0.1).unwrap();
    let [pressure, traction] = smooth(&grid);
    for materials in PAIRS {
        let bare = |v: f64, z: f64| subsurface_stress(&grid, v, z, &pressure, Some(&traction)).unwrap();
        let [[_, v1], [_, v2]] = materials;
        let thin = 1e-9;
        let stress = LayeredStress::new(&grid, layer(thin, materials), &pressure, Some(&traction)).unwrap();
        for z in [thin, 0.3, 2.0] {
            assert!(largest_difference(&stress.in_substrate(z).unwrap(), &bare(v2, z)) < 1e-6);
        }
        let thick = LayeredStress::new(&grid, layer(1e5, materials), &pressure, Some(&traction)).unwrap();
        for z in [0.0, 0.3, 2.0] {
            assert!(largest_difference(&thick.in_layer(z).unwrap(), &bare(v1, z)) < 1e-9);
        }
    }
}

/// A thin layer has the strains of the surface of the substrate, under plane stress and the pressure. It is
/// thinner than the cells: of first order.
#[test]
fn thin_layers_have_the_strains_of_the_substrate() {
    for materials in PAIRS {
        let [coarse, fine] = [(61, 0.1), (121, 0.05)].map(|(n, cell)| strain_error(materials, n, cell));
        println!("{materials:?}: {coarse:.1e}, {fine:.1e}");
        assert!(fine < 0.01 * (materials[0][0] / materials[1][0]).max(1.0) && fine < 0.65 * coarse);
    }
}

/// Largest error of a stress in the plane of a thin layer on `n` x `n` cells.
fn strain_error(materials: Materials, n: usize, cell: f64) -> f64 {
    let grid = Grid::centred(n, n, cell, cell).unwrap();
    let [pressure, traction] = smooth(&grid);
    let [[g1, v1], [g2, v2]] = materials;
    let stress = LayeredStress::new(&grid, layer(1e-9, materials), &pressure, Some(&traction)).unwrap();
    let over = stress.in_layer(0.0).unwrap();
    let under = subsurface_stress(&grid, v2, 0.0, &pressure, Some(&traction)).unwrap();
    let errors = middle(n, n / 4).map(|k| {
        let (found, s) = (components(&over, k), components(&under, k));
        let share = v2 / (1.0 + v2) * (s[0] + s[1] + s[2]);
        let strains = [s[0] - share, s[1] - share, s[3]].map(|stress| stress / (2.0 * g2));
        let sum = (strains[0] + strains[1]) * v1 / (1.0 - v1);
        let pressed = -pressure[k] * v1 / (1.0 - v1);
        let exact = [
            2.0 * g1 * (strains[0] + sum) + pressed,
            2.0 * g1 * (strains[1] + sum) + pressed,
            2.0 * g1 * strains[2],
        ];
        let pairs = [found[0], found[1], found[3]].into_iter().zip(exact);
        pairs.map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max)
    });
    errors.fold(0.0, f64::max)
}

/// Solution of a dense linear system by elimination with pivots.
fn solve<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> [f64; N] {
    for k in 0..N {
        let pivot = (k..N).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (top, below) = a.split_at_mut(k + 1);
        for (i, row) in below.iter_mut().enumerate() {
            let factor = row[k] / top[k][k];
            row.iter_mut().zip(&top[k]).for_each(|(value, above)| *value -= factor * above);
            b[k + 1 + i] -= factor * b[k];
        }
    }
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|j| a[k][j] * b[j]).sum();
        b[k] = (b[k] - known) / a[k][k];
    }
    b
}

/// Airy's function and its first two derivatives at the depth `x` over the wave number, below a layer of `d` over
/// it or in it, under unit pressure and under a unit first derivative at the surface; and the first derivative of
/// the function of shear across the wave under a unit one. All from the conditions at surface and bond, six and
/// three at a time.
fn wave([[g1, v1], [g2, v2]]: Materials, d: f64, x: f64) -> ([[f64; 3]; 2], f64) {
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

fn hertz(grid: &Grid) -> Vec<f64> {
    grid.nodes().map(|(x, y)| (1.0 - x * x - y * y).max(0.0).sqrt()).collect()
}

/// Midpoints of `n` intervals.
fn integral(to: f64, n: u32, value: impl Fn(f64) -> f64) -> f64 {
    let step = to / f64::from(n);
    (0..n).map(|k| value((f64::from(k) + 0.5) * step)).sum::<f64>() * step
}

/// Below the centre of Hertz' pressure, and of a traction of that shape, stresses are integrals over waves.
#[test]
fn the_axis_of_a_coated_hertz_contact_is_the_integral_over_waves() {
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
                // Of Hertz' pressure, times q/(2 pi).
                let spectrum = |q: f64| (q.sin() - q * q.cos()) / (q * q);
                let over_waves = |value: fn(f64, ([[f64; 3]; 2], f64)) -> f64| {
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

/// The same below the middle of a strip under uniform loads, in plane strain.
#[test]
fn a_coated_line_is_the_integral_over_waves() {
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

/// Box and cells: with twice the box, and with half the cells, the largest stresses stay.
#[test]
fn extremes_depend_little_on_box_and_cells() {
    let body = layer(0.3, PAIRS[0]);
    let depths: Vec<f64> = (0..24).map(|k| 1.5 * (f64::from(k) / 23.0).powi(2)).collect();
    let [reference, box_only, cells_only] = [(97, 0.05), (193, 0.05), (193, 0.025)].map(|(n, cell)| {
        let grid = Grid::centred(n, n, cell, cell).unwrap();
        let pressure = hertz(&grid);
        let traction: Vec<f64> = pressure.iter().map(|p| 0.2 * p).collect();
        let largest =
            LayeredStress::new(&grid, body, &pressure, Some(&traction)).unwrap().extremes(&depths).unwrap();
        println!("{n} cells of {cell}: {largest:?}");
        let (layer, substrate) = (largest.layer, largest.substrate);
        [
            layer.von_mises,
            layer.bond_shear,
            layer.bond_tension,
            substrate.von_mises,
            substrate.orthogonal_shear,
        ]
        .map(|extreme| extreme.stress)
    });
    for k in 0..5 {
        assert!((box_only[k] - reference[k]).abs() < 2e-3, "{k}: {reference:?} {box_only:?}");
        assert!((cells_only[k] - reference[k]).abs() < 3e-2, "{k}: {reference:?} {cells_only:?}");
    }
}

#[test]
fn errors_name_field_and_value() {
    let grid = Grid::centred(6, 6, 1.0, 1.0).unwrap();
    let (body, p) = (layer(0.5, PAIRS[0]), vec![0.0; 36]);
    let stress = LayeredStress::new(&grid, body, &p, None).unwrap();
    for (error, part) in [
        (LayeredStress::new(&grid, body, &p[1..], None).unwrap_err(), "pressure has 35"),
        (LayeredStress::new(&grid, body, &p, Some(&p[1..])).unwrap_err(), "traction has 35"),
        (stress.in_layer(0.6).unwrap_err(), "depth = 0.6"),
        (stress.in_layer(f64::NAN).unwrap_err(), "depth = NaN"),
        (stress.in_substrate(0.4).unwrap_err(), "depth = 0.4"),
        (stress.in_substrate(f64::INFINITY).unwrap_err(), "depth = inf"),
        (stress.extremes(&[]).unwrap_err(), "depths"),
        (stress.extremes(&[1.0, 1.0]).unwrap_err(), "depths"),
        (stress.extremes(&[-1.0, 1.0]).unwrap_err(), "depth = -1"),
    ] {
        assert!(error.to_string().contains(part), "{error}");
    }
}
