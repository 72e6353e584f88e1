//! Stresses in and below a bonded layer: half-spaces as limits, equilibrium, continuity at the bond, box and
//! cells, errors.

use stribeck::Grid;
use stribeck::elastic::{LayeredStress, StressField, subsurface_stress};

use crate::common::coated::{Materials, PAIRS, components, hertz, layer};

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
fn layer_of_the_substrate_material_has_half_space_stresses() {
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

/// At the surface the stresses equal the loads, at the bond tractions are continuous, for any layer.
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

/// In-plane strains are equal on both sides of the bond: displacements are continuous.
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

/// The residual body force is the stress gradient of the periodic images, which decreases with the size of
/// the box.
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

/// Largest residual body force in the middle of a box of `n` x `n` cells at `depth`.
fn force(materials: Materials, n: usize, depth: f64) -> f64 {
    let (cell, step) = (0.05, 0.01);
    let grid = Grid::centred(n, n, cell, cell).unwrap();
    let [pressure, traction] = smooth(&grid);
    let stress = LayeredStress::new(&grid, layer(0.5, materials), &pressure, Some(&traction)).unwrap();
    let at = |z: f64| if depth < 0.5 { stress.in_layer(z) } else { stress.in_substrate(z) }.unwrap();
    let [before, here, after] = [depth - step, depth, depth + step].map(at);
    let forces = middle(n, n / 2 - 20).map(|k| {
        // Fourth-order differences along the nodes.
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

/// A thin layer leaves the stresses of the substrate unchanged, a thick one has those of a half-space.
#[test]
fn thin_and_thick_layers_approach_half_spaces() {
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

/// A thin layer has the surface strains of the substrate, in plane stress plus the pressure. It is thinner
/// than the cells: first order.
#[test]
fn thin_layers_have_the_strains_of_the_substrate() {
    for materials in PAIRS {
        let [coarse, fine] = [(61, 0.1), (121, 0.05)].map(|(n, cell)| strain_error(materials, n, cell));
        println!("{materials:?}: {coarse:.1e}, {fine:.1e}");
        assert!(fine < 0.01 * (materials[0][0] / materials[1][0]).max(1.0) && fine < 0.65 * coarse);
    }
}

/// Largest error of an in-plane stress of a thin layer on `n` x `n` cells.
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

/// The largest stresses hardly change with twice the box or half the cells.
#[test]
#[ignore = "slow"]
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
