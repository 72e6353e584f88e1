//! Dry contact of flat rough surfaces that repeat along both axes: Westergaard's wave, limits of theories of rough
//! contact, input errors.

use std::f64::consts::TAU;

use stribeck::analytic::Westergaard;
use stribeck::elastic::{DeformationModel, DryProblem, DrySolver, PeriodicHalfSpace};
use stribeck::sim::{FlatContact, FlatContactNumbers, FlatLoad};
use stribeck::testing::deformation_model;
use stribeck::{Grid, Status};

const MODULUS: f64 = 230e9;

#[test]
fn periodic_half_space_satisfies_the_contract_on_even_odd_and_long_grids() {
    for (nx, ny, dy) in [(16, 12, 1e-6), (9, 7, 2e-6), (30, 6, 5e-6)] {
        let grid = Grid::centred(nx, ny, 1e-6, dy).unwrap();
        deformation_model(&mut PeriodicHalfSpace::new(grid, MODULUS).unwrap()).unwrap();
    }
}

#[test]
fn waves_of_pressure_displace_by_their_closed_form() {
    for (nx, ny) in [(16, 12), (9, 7), (12, 1)] {
        let grid = Grid::centred(nx, ny, 1e-6, 3e-6).unwrap();
        let mut body = PeriodicHalfSpace::new(grid, MODULUS).unwrap();
        for (i, j) in [(1, 0), (3, 2), (4, 0)] {
            let j = if ny == 1 { 0 } else { j };
            let (qx, qy) = (TAU * f64::from(i) / grid.size_x(), TAU * f64::from(j) / grid.size_y());
            let wave: Vec<f64> = grid.nodes().map(|(x, y)| (qx * x + qy * y + 0.3).cos()).collect();
            let mut out = vec![0.0; grid.len()];
            body.displacement(&wave, &mut out).unwrap();
            let exact = 4.0 / (MODULUS * qx.hypot(qy));
            for (u, p) in out.iter().zip(&wave) {
                assert!((u / exact - p).abs() < 1e-12, "{nx} x {ny}, waves {i}, {j}");
            }
        }
    }
}

#[test]
fn bodies_on_another_grid_keep_their_periods() {
    let body = PeriodicHalfSpace::new(Grid::centred(32, 32, 1e-6, 1e-6).unwrap(), MODULUS).unwrap();
    assert!(body.on_grid(Grid::centred(16, 16, 2e-6, 2e-6).unwrap()).is_some());
    assert!(body.on_grid(Grid::centred(17, 16, 2e-6, 2e-6).unwrap()).is_none());
    let strip = Grid::strip(32, 32, [0.0, 1.0], [0.0, 1.0]).unwrap();
    let error = PeriodicHalfSpace::new(strip, MODULUS).unwrap_err().to_string();
    assert!(error.contains("StripHalfSpace"), "{error}");
}

/// Mean gap over amplitude, less that of Westergaard, of a wave on `cells` along its direction.
fn gap_error(grid: Grid, wave_numbers: [f64; 2], cells: f64, ratio: f64) -> f64 {
    let [qx, qy] = wave_numbers;
    let wavelength = TAU / qx.hypot(qy);
    let exact = Westergaard { amplitude: 1e-4 * wavelength, wavelength, equivalent_modulus: MODULUS };
    let mean_pressure = ratio * exact.full_contact_pressure().unwrap();
    let gap: Vec<f64> =
        grid.nodes().map(|(x, y)| exact.amplitude * (1.0 - (qx * x + qy * y).cos())).collect();
    let load = mean_pressure * grid.size_x() * grid.size_y();
    let mut solver = DrySolver::new(grid.len());
    let mut pressure = vec![0.0; grid.len()];
    let mut body = PeriodicHalfSpace::new(grid, MODULUS).unwrap();
    let problem = DryProblem { gap: &gap, load, limit: None };
    let outcome = solver.solve(&problem, &mut body, &mut pressure, 1e-9, 500).unwrap();
    assert!(outcome.converged, "{cells} {ratio}: {outcome:?}");
    let contact = pressure.iter().filter(|p| **p > 0.0).count() as f64 / grid.len() as f64;
    let half_width = exact.contact_half_width(mean_pressure).unwrap();
    let off = (contact - 2.0 * half_width / wavelength) * cells;
    assert!(off.abs() <= 2.0, "{cells} {ratio}: the strip is {off} cells too wide");
    let mean = solver.gap().iter().sum::<f64>() / grid.len() as f64;
    (mean - exact.mean_gap(mean_pressure).unwrap()) / exact.amplitude
}

#[test]
fn wavy_surface_has_the_mean_gap_of_westergaard() {
    for ratio in [0.05, 0.2, 0.5, 0.8, 0.97, 1.2] {
        let line = Grid::centred(256, 1, 1e-6, 1.0).unwrap();
        let error = gap_error(line, [TAU / 256e-6, 0.0], 256.0, ratio);
        assert!(error.abs() < 1e-4, "along x, {ratio}: {error:e}");
        let across = Grid::centred(8, 256, 1e-6, 1e-6).unwrap();
        let error = gap_error(across, [0.0, TAU / 256e-6], 256.0, ratio);
        assert!(error.abs() < 1e-4, "along y, {ratio}: {error:e}");
        let oblique = Grid::centred(256, 256, 1e-6, 1e-6).unwrap();
        let error = gap_error(oblique, [TAU / 256e-6; 2], 181.0, ratio);
        assert!(error.abs() < 2e-4, "oblique, {ratio}: {error:e}");
    }
}

/// A self-affine cell of 200 um whose shortest wave has 16 cells.
fn self_affine(cells: usize, load: FlatLoad) -> FlatContact {
    let text = format!(
        "[form]\nkind = \"flat\"\n[elastic]\nequivalent_modulus = \"230 GPa\"\n[load]\nmean_pressure = \"1 MPa\"\n\
         [grid]\nperiodic = true\nnx = {cells}\nny = {cells}\nx = [\"-100 um\", \"100 um\"]\ny = [\"-100 um\", \"100 um\"]\n\
         [roughness.disc]\nkind = \"self_affine\"\nrq = \"200 nm\"\nhurst = 0.8\nroll_off = \"50 um\"\nlongest = \"50 um\"\n\
         shortest = \"6.25 um\"\nseed = 3\n"
    );
    let mut contact = FlatContact::from_toml(&text).unwrap();
    contact.load = load;
    contact
}

fn numbers(contact: &FlatContact) -> FlatContactNumbers {
    let solution = contact.solve(|| false).unwrap();
    assert!(solution.warnings.is_empty(), "{:?}", solution.warnings);
    assert_eq!(solution.status, Status::Converged);
    solution.numbers
}

#[test]
fn area_over_load_of_a_self_affine_cell_is_between_the_theories() {
    for pressure in [20e6, 60e6] {
        let found = numbers(&self_affine(512, FlatLoad::MeanPressure(pressure)));
        assert!(found.area_share < 0.1, "{found:?}");
        assert!((1.60..2.51).contains(&found.area_over_load), "{found:?}");
    }
}

#[test]
fn stiffness_is_proportional_to_a_light_load_and_mean_gap_falls_with_it() {
    let [low, high] = [5e6, 20e6].map(|p| numbers(&self_affine(128, FlatLoad::MeanPressure(p))));
    // Of this finite cell the exponent is somewhat below one.
    let exponent = (high.stiffness.unwrap() / low.stiffness.unwrap()).log(4.0);
    assert!((0.75..1.05).contains(&exponent), "{exponent}");
    assert!(high.mean_gap < low.mean_gap && low.mean_gap < 4.0 * low.composite_rq);
    let mean = 0.5 * (low.stiffness.unwrap() + high.stiffness.unwrap());
    let secant = 15e6 / (low.mean_gap - high.mean_gap);
    assert!((secant / mean - 1.0).abs() < 0.3, "{secant:e} {mean:e}");
}

#[test]
fn mean_gap_and_mean_pressure_give_the_same_contact() {
    for (pressure, hardness) in [(20e6, None), (300e6, None), (300e6, Some(5e9))] {
        let mut by_pressure = self_affine(128, FlatLoad::MeanPressure(pressure));
        by_pressure.hardness = hardness;
        let found = numbers(&by_pressure);
        let mut by_gap = by_pressure;
        by_gap.load = FlatLoad::MeanGap(found.mean_gap);
        let same = numbers(&by_gap);
        assert!((same.mean_pressure / pressure - 1.0).abs() < 1e-4, "{same:?}");
        assert!((same.area_share - found.area_share).abs() < 1e-3, "{same:?} {found:?}");
    }
}

#[test]
fn hardness_limits_pressures_and_closes_the_gap() {
    let elastic = numbers(&self_affine(128, FlatLoad::MeanPressure(300e6)));
    let mut soft = self_affine(128, FlatLoad::MeanPressure(300e6));
    soft.hardness = Some(2e9);
    let soft = numbers(&soft);
    assert!(elastic.pressure_max > 2e9 && soft.pressure_max <= 2e9);
    assert!(soft.plastic_share > 0.02 && soft.mean_plastic_depth > 0.0 && elastic.plastic_share == 0.0);
    assert!(soft.area_share > elastic.area_share && soft.mean_gap < elastic.mean_gap);
}

#[test]
fn scenes_out_of_range_are_refused_by_name() {
    let scene = include_str!("../examples/scenes/flat.toml");
    assert!(FlatContact::from_toml(scene).is_ok());
    for (from, to, named) in [
        ("mean_pressure = \"100 MPa\"", "mean_pressure = -1.0", "load.mean_pressure"),
        ("mean_pressure = \"100 MPa\"", "mean_pressure = \"7 GPa\"", "plastic.hardness"),
        ("mean_pressure = \"100 MPa\"", "mean_gap = \"5 um\"", "load.mean_gap"),
        ("mean_pressure = \"100 MPa\"", "mean_gap = 0.0", "load.mean_gap"),
        ("mean_pressure = \"100 MPa\"", "mean_gap = \"1 MPa\"", "load.mean_gap"),
        ("mean_pressure = \"100 MPa\"", "", "mean_pressure or mean_gap is missing"),
        ("mean_pressure = \"100 MPa\"", "mean_pressure = 1e8\nmean_gap = 1e-8", "not both"),
        ("mean_pressure = \"100 MPa\"", "force = 1.0", "force"),
        ("periodic = true", "periodic = false", "grid.periodic"),
        ("nx = 256", "nx = 4", "grid.nx"),
        ("hardness = \"6 GPa\"", "hardness = 0.0", "plastic.hardness"),
        ("kind = \"self_affine\"", "kind = \"none\"", "none"),
        (
            "[plastic]",
            "[elastic.layer]\nthickness = 1e-6\nmodulus = 3e11\npoisson = 0.3\n[plastic]",
            "elastic.layer",
        ),
        ("[plastic]", "[lubricant]\neta0 = 0.01\n[plastic]", "lubricant"),
    ] {
        let text = scene.replacen(from, to, 1);
        assert_ne!(text, scene, "{from}");
        let error = match FlatContact::from_toml(&text) {
            Ok(contact) => {
                contact.solve(|| false).map(|solved| solved.numbers).map_err(|error| error.to_string())
            }
            Err(error) => Err(error.to_string()),
        };
        let error = error.unwrap_err();
        assert!(error.contains(named), "{to}: {error}");
    }
    let contact = FlatContact::from_toml(scene).unwrap();
    assert!(matches!(contact.solve(|| true), Err(stribeck::sim::SimError::Interrupted)));
}

#[test]
fn roughness_that_the_cells_do_not_resolve_is_warned_of() {
    let scene = include_str!("../examples/scenes/flat.toml").replacen("shortest = \"3 um\"", "", 1);
    let warnings = FlatContact::from_toml(&scene).unwrap().solve(|| false).unwrap().warnings;
    assert!(warnings.iter().any(|found| found.field == "grid.nx"), "{warnings:?}");
}
