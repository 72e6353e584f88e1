//! Stresses below the surface: direct sums, Hertz, sliding Hertz, lines, scenes and errors.

use std::f64::consts::PI;

use stribeck::elastic::{StressField, stress_extremes, subsurface_stress};
use stribeck::sim::scene::{Elastic, GridSpec, LayerSpec, Material, SolverKind, StressSpec};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::{Grid, Status};

/// Hertz pressure of unit radius and unit peak.
fn hertz(grid: &Grid) -> Vec<f64> {
    grid.nodes().map(|(x, y)| (1.0 - x * x - y * y).max(0.0).sqrt()).collect()
}

fn components(field: &StressField, k: usize) -> [f64; 6] {
    [field.xx[k], field.yy[k], field.zz[k], field.xy[k], field.xz[k], field.yz[k]]
}

/// Stresses under unit point loads at the origin: normal (Boussinesq) and along x (Cerruti), Johnson 1985,
/// equations 3.19 and 3.76.
fn point_loads(v: f64, [x, y, z]: [f64; 3]) -> [[f64; 6]; 2] {
    let r2 = x * x + y * y;
    let rho = (r2 + z * z).sqrt();
    let (r3, r5, c, s) = (rho.powi(3), rho.powi(5), 1.0 - 2.0 * v, rho + z);
    let normal = [
        c / r2 * ((1.0 - z / rho) * (x * x - y * y) / r2 + z * y * y / r3) - 3.0 * z * x * x / r5,
        c / r2 * ((1.0 - z / rho) * (y * y - x * x) / r2 + z * x * x / r3) - 3.0 * z * y * y / r5,
        -3.0 * z.powi(3) / r5,
        c / r2 * ((1.0 - z / rho) * 2.0 * x * y / r2 - x * y * z / r3) - 3.0 * x * y * z / r5,
        -3.0 * x * z * z / r5,
        -3.0 * y * z * z / r5,
    ];
    let tangential = [
        -3.0 * x.powi(3) / r5
            + c * (x / r3 - 3.0 * x / (rho * s * s)
                + x.powi(3) / (r3 * s * s)
                + 2.0 * x.powi(3) / (rho * rho * s.powi(3))),
        -3.0 * x * y * y / r5
            + c * (x / r3 - x / (rho * s * s)
                + x * y * y / (r3 * s * s)
                + 2.0 * x * y * y / (rho * rho * s.powi(3))),
        -3.0 * x * z * z / r5,
        -3.0 * x * x * y / r5
            + c * (-y / (rho * s * s) + x * x * y / (r3 * s * s) + 2.0 * x * x * y / (rho * rho * s.powi(3))),
        -3.0 * x * x * z / r5,
        -3.0 * x * y * z / r5,
    ];
    [normal, tangential].map(|stress| stress.map(|value| value / (2.0 * PI)))
}

#[test]
fn convolutions_match_sums_of_point_loads() {
    let grid = Grid::centred(6, 5, 1.0, 0.7).unwrap();
    let pressure: Vec<f64> = (0..30).map(|k| f64::from(k * 7 % 11)).collect();
    let traction: Vec<f64> = (0..30).map(|k| f64::from(k * 5 % 7) - 3.0).collect();
    for v in [0.0, 0.3, 0.5] {
        for depth in [0.5, 2.0] {
            let field = subsurface_stress(&grid, v, depth, &pressure, Some(&traction)).unwrap();
            // Midpoints of 24 x 24 parts of each cell; none lies above a node.
            let parts = 24;
            for (k, (x, y)) in grid.nodes().enumerate() {
                let mut exact = [0.0; 6];
                for (l, (s, t)) in grid.nodes().enumerate() {
                    for part in 0..parts * parts {
                        let at = |i: usize, cell: f64| cell * ((i as f64 + 0.5) / parts as f64 - 0.5);
                        let (u, w) = (at(part % parts, grid.dx()), at(part / parts, grid.dy()));
                        let loads = point_loads(v, [x - s - u, y - t - w, depth]);
                        for (c, sum) in exact.iter_mut().enumerate() {
                            let stress = pressure[l] * loads[0][c] + traction[l] * loads[1][c];
                            *sum += stress * grid.cell_area() / (parts * parts) as f64;
                        }
                    }
                }
                for (found, exact) in components(&field, k).into_iter().zip(exact) {
                    assert!((found - exact).abs() < 5e-3, "v = {v}, z = {depth}, node {k}: {found} {exact}");
                }
            }
        }
    }
}

#[test]
fn hertz_axis_stresses_match_the_closed_form() {
    let grid = Grid::centred(161, 161, 1.0 / 70.0, 1.0 / 70.0).unwrap();
    let centre = 80 * 161 + 80;
    let pressure = hertz(&grid);
    for v in [0.0, 0.3, 0.5] {
        for z in [0.0, 0.1, 0.48, 1.0, 1.5] {
            let stress = subsurface_stress(&grid, v, z, &pressure, None).unwrap();
            let angle = if z == 0.0 { 0.0 } else { z * (1.0_f64 / z).atan() };
            let along = -(1.0 + v) * (1.0 - angle) + 0.5 / (1.0 + z * z);
            let into = -1.0 / (1.0 + z * z);
            let expected = [along, along, into, 0.0, 0.0, 0.0];
            for (found, exact) in components(&stress, centre).into_iter().zip(expected) {
                assert!((found - exact).abs() < 1e-3, "v = {v}, z = {z}: {found} {exact}");
            }
            let mises = stress.von_mises().nth(centre).unwrap();
            assert!((mises - (into - along).abs()).abs() < 2e-3);
        }
    }
    let depths: Vec<f64> = (0..16).map(|k| 0.06 * f64::from(k)).collect();
    let largest = stress_extremes(&grid, 0.3, &depths, &pressure, None).unwrap();
    let mises = largest.von_mises;
    assert!((mises.stress - 0.620).abs() < 1e-3 && (mises.depth - 0.481).abs() < 3e-3, "{mises:?}");
    assert!(mises.x.hypot(mises.y) < 1e-9, "{mises:?}");
}

#[test]
fn line_contacts_match_plane_strain() {
    let grid = Grid::from_edges(400, 1, [-2e-4, 2e-4], [-0.5, 0.5]).unwrap();
    let pressure: Vec<f64> =
        grid.nodes().map(|(x, _)| 1e9 * (1.0 - (x / 1e-4).powi(2)).max(0.0).sqrt()).collect();
    let depths: Vec<f64> = (0..40).map(|k| 3e-6 * f64::from(k)).collect();
    let largest = stress_extremes(&grid, 0.3, &depths, &pressure, None).unwrap();
    // Johnson 1985, section 4.2 and 9.2: orthogonal shear 0.25 at 0.50 half-widths, 0.87 beside the middle.
    let shear = largest.orthogonal_shear;
    assert!((shear.stress / 1e9 - 0.25).abs() < 5e-4 && (shear.depth / 1e-4 - 0.5).abs() < 0.01, "{shear:?}");
    assert!((shear.x.abs() / 1e-4 - 0.87).abs() < 0.02, "{shear:?}");
    // On the axis xx = -[(1 + 2 z^2)/sqrt(1 + z^2) - 2 z], zz = -1/sqrt(1 + z^2), yy = v (xx + zz).
    let mut best = (0.0, 0.0);
    for k in 0..200 {
        let z = f64::from(k) * 0.01;
        let root = (1.0 + z * z).sqrt();
        let (xx, zz) = (2.0 * z - (1.0 + 2.0 * z * z) / root, -1.0 / root);
        let yy = 0.3 * (xx + zz);
        let mises = (0.5 * ((xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2))).sqrt();
        if mises > best.0 {
            best = (mises, z);
        }
    }
    let mises = largest.von_mises;
    assert!(
        (mises.stress / 1e9 - best.0).abs() < 1e-3 && (mises.depth / 1e-4 - best.1).abs() < 0.02,
        "{mises:?} {best:?}"
    );
    assert!((best.0 - 0.558).abs() < 1e-3 && (best.1 - 0.70).abs() < 0.011, "{best:?}");
}

/// On the axis a traction `f p` causes `xz` only, an integral over rings of point loads. Behind the contact
/// the tension is Hamilton's.
#[test]
fn sliding_hertz_axis_shear_matches_the_ring_integral() {
    let n = 241;
    let grid = Grid::centred(n, n, 0.01, 0.01).unwrap();
    let (pressure, friction) = (hertz(&grid), 0.25);
    let traction: Vec<f64> = pressure.iter().map(|p| friction * p).collect();
    let centre = n / 2 * n + n / 2;
    for z in [0.1_f64, 0.5, 1.0] {
        let stress = subsurface_stress(&grid, 0.3, z, &vec![0.0; n * n], Some(&traction)).unwrap();
        let rings = 20_000;
        let exact: f64 = (0..rings)
            .map(|k| (f64::from(k) + 0.5) / f64::from(rings))
            .map(|r| -1.5 * z * friction * (1.0 - r * r).sqrt() * r.powi(3) / (r * r + z * z).powf(2.5))
            .sum::<f64>()
            / f64::from(rings);
        let found = components(&stress, centre);
        assert!((found[4] - exact).abs() < 1e-3, "{z}: {} {exact}", found[4]);
        assert!([0, 1, 2, 3, 5].iter().all(|&c| found[c].abs() < 1e-12), "{found:?}");
    }
}

/// A traction along +x causes tension behind the contact, at x = -1. Beyond, the tension decreases as the
/// square root of the distance, so the error is the square root of the cell size.
#[test]
fn tension_behind_a_sliding_ball_matches_hamilton() {
    let friction = 0.25;
    let tension = |n: usize, cell: f64| {
        let grid = Grid::centred(n, n, cell, cell).unwrap();
        let pressure = hertz(&grid);
        let traction: Vec<f64> = pressure.iter().map(|p| friction * p).collect();
        let stress = subsurface_stress(&grid, 0.3, 0.0, &pressure, Some(&traction)).unwrap();
        let (place, tension) =
            stress.xx.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        assert!((grid.x(place % n) + 1.0).abs() < 1.5 * cell && grid.y(place / n).abs() < 1e-9);
        tension
    };
    let [coarse, fine] = [(121, 0.02), (241, 0.01)].map(|(n, cell)| tension(n, cell));
    let limit = fine + (fine - coarse) / (2.0_f64.sqrt() - 1.0);
    let hamilton = 0.4 / 3.0 + 4.3 / 8.0 * PI * friction;
    assert!((limit / hamilton - 1.0).abs() < 0.01, "{coarse} {fine} {limit} {hamilton}");
}

fn scene(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.solver.kind = SolverKind::Dry;
    scene.stress = Some(StressSpec::default());
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

#[test]
fn scenes_report_requested_stresses() {
    let mut scene = scene(96);
    scene.motion.slide_roll_ratio = 0.0;
    scene.stress.as_mut().unwrap().yield_strength = Some(1e9);
    let solution = solved(&scene);
    let (stress, hertz) = (solution.stress.unwrap(), solution.hertz);
    let mises = stress.von_mises;
    assert!(
        (mises.stress / hertz.pressure - 0.62).abs() < 3e-3
            && (mises.depth / hertz.half_width_x - 0.48).abs() < 0.01
    );
    assert!((stress.yield_ratio.unwrap() / (mises.stress / 1e9) - 1.0).abs() < 1e-12);
    let shear = stress.orthogonal_shear.stress;
    assert!((stress.shakedown_ratio.unwrap() / (3.0_f64.sqrt() * shear / 1e9) - 1.0).abs() < 1e-12);
    // A friction coefficient of 0.5 moves the largest stress to the surface; the ball drags the disc along +x
    // and compresses it in front.
    scene.motion.slide_roll_ratio = 0.5;
    scene.friction.boundary_coefficient = 0.5;
    let sliding = solved(&scene).stress.unwrap().von_mises;
    assert!(sliding.depth == 0.0 && sliding.stress > 1.3 * mises.stress, "{sliding:?}");
    scene.motion.slide_roll_ratio = -0.5;
    let mirrored = solved(&scene).stress.unwrap().von_mises;
    assert!((mirrored.stress / sliding.stress - 1.0).abs() < 1e-6);
    assert!((mirrored.x + sliding.x).abs() < 1e-9, "{mirrored:?} {sliding:?}");
    scene.stress = None;
    let without = solved(&scene);
    assert!(without.stress.is_none());
}

/// A layer of the disc's material leaves its stresses unchanged; a stiff one has higher stresses.
#[test]
fn scenes_with_a_layer_report_its_stresses() {
    let mut scene = scene(64);
    scene.motion.slide_roll_ratio = 0.0;
    let bare = solved(&scene).stress.unwrap();
    assert!(bare.layer.is_none());
    let half_width = scene.hertz().unwrap().half_width_x;
    let mut coated = |modulus: f64| {
        let layer = LayerSpec::new(0.1 * half_width, modulus, 0.3);
        let layer = layer.with_substrate_modulus(Some(210e9)).with_substrate_poisson(Some(0.3));
        scene.elastic.layer = Some(layer);
        solved(&scene).stress.unwrap()
    };
    let (same, stiff) = (coated(210e9), coated(420e9));
    let (found, known) = (same.von_mises, bare.von_mises);
    assert!((found.stress / known.stress - 1.0).abs() < 1e-3, "{found:?} {known:?}");
    let [same, stiff] = [same, stiff].map(|stress| stress.layer.unwrap());
    assert!(same.von_mises.stress < known.stress, "{same:?} {known:?}");
    assert!(stiff.bond_shear.stress > same.bond_shear.stress, "{same:?} {stiff:?}");
    assert!(same.bond_shear.stress > 0.0 && (same.bond_shear.depth / half_width - 0.1).abs() < 1e-12);
    assert!(same.bond_tension.stress < 0.01 * same.bond_shear.stress, "{same:?}");
}

#[test]
fn errors_name_field_and_value() {
    let grid = Grid::centred(6, 6, 1.0, 1.0).unwrap();
    let p = vec![0.0; 36];
    for (error, part) in [
        (subsurface_stress(&grid, 0.6, 1.0, &p, None).unwrap_err(), "poisson = 0.6"),
        (subsurface_stress(&grid, 0.3, -1.0, &p, None).unwrap_err(), "depth = -1"),
        (subsurface_stress(&grid, 0.3, 1.0, &p[1..], None).unwrap_err(), "pressure has 35"),
        (subsurface_stress(&grid, 0.3, 1.0, &p, Some(&p[1..])).unwrap_err(), "traction has 35"),
        (stress_extremes(&grid, 0.3, &[], &p, None).unwrap_err(), "depths"),
        (stress_extremes(&grid, 0.3, &[1.0, 1.0], &p, None).unwrap_err(), "depths"),
    ] {
        assert!(error.to_string().contains(part), "{error}");
    }
    let refused = |change: fn(&mut StressSpec)| {
        let mut scene = scene(16);
        change(scene.stress.as_mut().unwrap());
        solve_contact(&scene).unwrap_err().to_string()
    };
    for (error, part) in [
        (refused(|s| s.depths = 2), "stress.depths = 2"),
        (refused(|s| s.deepest = Some(0.0)), "stress.deepest = 0"),
        (refused(|s| s.poisson = Some(0.6)), "stress.poisson = 0.6"),
        (refused(|s| s.yield_strength = Some(-1.0)), "stress.yield_strength = -1"),
    ] {
        assert!(error.contains(part), "{error}");
    }
    let mut both = scene(16);
    let steel = Material::default().with_modulus(Some(210e9)).with_poisson(Some(0.3));
    (both.elastic, both.materials.ball, both.materials.disc) = (Elastic::default(), steel, steel);
    both.stress.as_mut().unwrap().poisson = Some(0.3);
    assert!(solve_contact(&both).unwrap_err().to_string().contains("materials.disc.poisson"));
    both.stress.as_mut().unwrap().poisson = None;
    both.grid = GridSpec::Cells { nx: 32, ny: 32, x: [-0.25e-3, 0.25e-3], y: [-0.25e-3, 0.25e-3] };
    solved(&both);
    let layer = LayerSpec::new(1e-6, 1e11, 0.3);
    both.elastic.layer = Some(layer);
    assert!(solved(&both).stress.unwrap().layer.is_some());
    let mut twice = scene(16);
    twice.elastic.layer = Some(layer.with_substrate_modulus(Some(210e9)).with_substrate_poisson(Some(0.3)));
    twice.stress.as_mut().unwrap().poisson = Some(0.3);
    assert!(solve_contact(&twice).unwrap_err().to_string().contains("elastic.layer"));
}
