//! Layers under strips: waves across the flow, the line for equal rows, contacts and stresses.

use std::f64::consts::TAU;

use stribeck::elastic::{DeformationModel, Layer, LayeredHalfSpace, LayeredStress, StripHalfSpace};
use stribeck::sim::scene::{GridSpec, LayerSpec, Load, Roughness, StressSpec};
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::{Grid, Status};

const MODULUS: f64 = 230.77e9;
const STEEL: [f64; 2] = [210e9, 0.3];
const REFERENCE: f64 = 10e-3;

/// Soft, stiff, thin and thick.
fn layers() -> [Layer; 4] {
    [(2e-6, 20e9), (2e-6, 900e9), (30e-6, 70e9), (200e-6, 600e9)]
        .map(|(thickness, modulus)| Layer::new(thickness, [modulus, 0.25], STEEL).unwrap())
}

fn displaced(mut body: impl DeformationModel, pressure: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; pressure.len()];
    body.displacement(pressure, &mut out).unwrap();
    out
}

/// `u = 2/q [2/E' - c2 + c1 f(q h)] p` in the middle of ridges along the flow, flattened by `sin(e)/e`, `e = q dy/2`.
#[test]
fn waves_across_the_flow_have_the_transform_of_the_layer() {
    let (nx, ny, width) = (160, 32, 40e-6);
    let grid = Grid::strip(nx, ny, [-0.2e-3, 0.2e-3], [0.0, width]).unwrap();
    for layer in layers() {
        let body = LayeredHalfSpace::strip(grid, MODULUS, layer, REFERENCE).unwrap();
        for waves in [1, 2] {
            let q = TAU * f64::from(waves) / width;
            let pressure: Vec<f64> = grid.nodes().map(|(_, y)| (q * y).cos()).collect();
            let out = displaced(body.clone(), &pressure);
            let ([own, below], half) = (layer.compliances(), 0.5 * q * grid.dy());
            let response = 2.0 / MODULUS - below + own * layer.transform(q * layer.thickness());
            let exact = 2.0 / q * response * half.sin() / half;
            for j in 0..ny {
                let k = j * nx + nx / 2;
                // Cells have harmonics of the wave.
                let error = (out[k] - exact * pressure[k]) / exact;
                assert!(error.abs() < 3e-3, "{layer:?}, {waves} waves, row {j}: {error:e}");
            }
        }
    }
}

#[test]
fn equal_rows_deflect_as_the_line_and_steel_on_steel_as_a_half_space() {
    let x = [-0.2e-3, 0.1e-3];
    let line = Grid::from_edges(60, 1, x, [-0.5, 0.5]).unwrap();
    let pressure: Vec<f64> = (0..60).map(|i| 1e9 * (0.3 * f64::from(i)).sin()).collect();
    for (rows, width) in [(7, 20e-6), (12, 0.5e-3)] {
        let grid = Grid::strip(60, rows, x, [0.0, width]).unwrap();
        let repeated = pressure.repeat(rows);
        for layer in layers() {
            let row = displaced(
                LayeredHalfSpace::plane_strain(line, MODULUS, layer, REFERENCE).unwrap(),
                &pressure,
            );
            let found =
                displaced(LayeredHalfSpace::strip(grid, MODULUS, layer, REFERENCE).unwrap(), &repeated);
            let largest = row.iter().fold(0.0_f64, |most, u| most.max(u.abs()));
            for (k, u) in found.iter().enumerate() {
                assert!((u - row[k % 60]).abs() < 1e-6 * largest, "{rows} rows, {layer:?}, node {k}");
            }
        }
        let same = Layer::new(3e-6, STEEL, STEEL).unwrap();
        let pressure: Vec<f64> = (0..60 * rows).map(|k| (k * 7 % 11) as f64).collect();
        let coated = displaced(LayeredHalfSpace::strip(grid, MODULUS, same, REFERENCE).unwrap(), &pressure);
        let bare = displaced(StripHalfSpace::new(grid, MODULUS, REFERENCE).unwrap(), &pressure);
        assert!(coated.iter().zip(&bare).all(|(a, b)| (a / b - 1.0).abs() < 1e-12));
    }
    let error = LayeredHalfSpace::strip(line, MODULUS, layers()[0], REFERENCE).unwrap_err().to_string();
    assert!(error.contains("Grid::strip"), "{error}");
}

/// A coated roller of 1 GPa, dry or in oil.
fn roller(modulus: f64, is_dry: bool) -> Scene {
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Cylinder { radius: 5e-3 };
    (scene.load, scene.roughness) = (Load::hertz_pressure(1e9), Default::default());
    (scene.plastic, scene.wear, scene.motion.entrainment_speed) = (None, None, 1.0);
    let layer = scene.elastic.layer.insert(LayerSpec::new(20e-6, modulus, 0.25));
    (layer.substrate_modulus, layer.substrate_poisson) = (Some(209e9), Some(0.3));
    scene.grid = GridSpec::Row { nx: 120, x: [-0.3e-3, 0.22e-3] };
    scene.stress.insert(StressSpec::default()).depths = 16;
    scene.solver.tolerance = 1e-8;
    if is_dry {
        scene.lubricant = None;
    }
    scene
}

#[test]
fn smooth_coated_strip_is_the_line() {
    for (modulus, is_dry) in [(60e9, true), (500e9, true), (500e9, false)] {
        let line = roller(modulus, is_dry);
        let mut strip = line.clone();
        strip.grid = GridSpec::Strip { nx: 120, ny: 6, x: [-0.3e-3, 0.22e-3], y: Some([0.0, 0.1e-3]) };
        let [row, rows] = [line, strip].map(|scene| {
            let solution = solve_contact(&scene).unwrap();
            assert_eq!(solution.report.status, Status::Converged);
            let stress = solution.stress.unwrap();
            let layer = stress.layer.unwrap();
            let extremes = [stress.von_mises, stress.orthogonal_shear, layer.von_mises, layer.bond_shear];
            let film = if is_dry { 1.0 } else { solution.film.central };
            ([film, solution.pressure.max, solution.friction.coefficient], extremes.map(|found| found.stress))
        });
        for (a, b) in row.0.iter().zip(&rows.0) {
            assert!((a / b - 1.0).abs() < 1e-5, "{modulus:e}: {row:?} {rows:?}");
        }
        for (a, b) in row.1.iter().zip(&rows.1) {
            assert!((a / b - 1.0).abs() < 1e-3, "{modulus:e}: {row:?} {rows:?}");
        }
    }
}

/// Equal rows against a row of long cells; a layer of the substrate's material against none; tractions across the bond.
#[test]
fn stresses_of_a_coated_strip_are_those_of_its_parts() {
    let line = Grid::from_edges(48, 1, [-2.0, 2.0], [-1e6, 1e6]).unwrap();
    let layer = Layer::new(0.3, [420e9, 0.3], STEEL).unwrap();
    let band = |grid: &Grid| grid.nodes().map(|(x, _)| (1.0 - x * x).max(0.0).sqrt()).collect::<Vec<_>>();
    for (rows, width) in [(6, 0.5), (9, 4.0)] {
        let grid = Grid::strip(48, rows, [-2.0, 2.0], [0.0, width]).unwrap();
        let [row, strip] = [&line, &grid].map(|grid| {
            let load = band(grid);
            LayeredStress::new(grid, layer, &load, Some(&load)).unwrap()
        });
        for depth in [0.0, 0.2, 0.3, 0.7] {
            let [plane, found] = [&row, &strip].map(|stress| {
                if depth < 0.3 { stress.in_layer(depth) } else { stress.in_substrate(depth) }.unwrap()
            });
            for (k, zz) in found.zz.iter().enumerate() {
                let apart =
                    [zz - plane.zz[k % 48], found.xx[k] - plane.xx[k % 48], found.xz[k] - plane.xz[k % 48]];
                assert!(apart.iter().all(|part| part.abs() < 1e-5), "{rows} rows at {depth}: {apart:?}");
            }
        }
        let pressure: Vec<f64> = (0..48 * rows).map(|k| (k * 7 % 11) as f64 / 11.0).collect();
        let rough = LayeredStress::new(&grid, layer, &pressure, None).unwrap();
        let (over, under) = (rough.in_layer(0.3).unwrap(), rough.in_substrate(0.3).unwrap());
        for (a, b) in [(&over.zz, &under.zz), (&over.xz, &under.xz), (&over.yz, &under.yz)] {
            assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6));
        }
    }
}

#[test]
fn rough_coated_strip_converges() {
    let mut scene = roller(400e9, false);
    scene.grid = GridSpec::Strip { nx: 120, ny: 40, x: [-0.3e-3, 0.22e-3], y: Some([-0.1e-3, 0.1e-3]) };
    scene.motion.entrainment_speed = 0.05;
    scene.roughness.disc = Roughness::gaussian(150e-9, 25e-6, 1);
    let coated = solve_contact(&scene).unwrap();
    assert_eq!(coated.report.status, Status::Converged, "{:?}", coated.report);
    scene.elastic.layer = None;
    let bare = solve_contact(&scene).unwrap();
    // A stiff layer bears asperities at larger pressures.
    assert!(coated.pressure.max > 1.02 * bare.pressure.max, "{} {}", coated.pressure.max, bare.pressure.max);
    assert!(coated.contact.load_ratio > 0.05 && coated.stress.unwrap().layer.is_some());
}
