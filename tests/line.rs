//! Line contacts: kernel, dry contact, lubricated film.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use stribeck::analytic::{HertzLine, LineFilmConditions, strip_displacement, strip_potential};
use stribeck::elastic::{DeformationModel, LineHalfSpace};
use stribeck::sim::scene::{Flash, GridSpec, InletSpec, PlasticSpec, Roughness, SolverKind};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Moes, Scene, StepRecord, solve_contact};
use stribeck::surface::Form;
use stribeck::tribochem::{ThermalBody, estimate_rise_under_flux};
use stribeck::{Grid, SolverId, Status};

const RADIUS: f64 = 10e-3;
const MODULUS: f64 = 230e9;

/// A steel roller in oil at `p_max` \[Pa\] and `speed` \[m/s\] on `n` nodes.
fn roller(p_max: f64, speed: f64, n: usize) -> Scene {
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Cylinder { radius: RADIUS };
    scene.elastic.equivalent_modulus = MODULUS;
    scene.load.hertz_pressure = Some(p_max);
    scene.motion.entrainment_speed = speed;
    scene.roughness = Default::default();
    scene.plastic = None;
    // The inlet is flooded where the film gathers far from the contact.
    let hertz = HertzLine::from_max_pressure(RADIUS, MODULUS, p_max).unwrap();
    let film = conditions(&hertz, speed).moes_central().unwrap() * RADIUS / hertz.half_width.powi(2);
    let inlet = (1.0 + 8.0 * film.powf(0.58)).max(4.0) * hertz.half_width;
    scene.grid = GridSpec::Row { nx: n, x: [-inlet, 2.0 * hertz.half_width] };
    let lubricant = scene.lubricant.as_mut().unwrap();
    lubricant.eta0 = 0.04;
    lubricant.alpha = Some(20e-9);
    lubricant.inlet = InletSpec::BoxEdge;
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    assert!(solution.report.residual.max() <= scene.solver.tolerance);
    let inside = solution.state.pressure.iter().sum::<f64>() * solution.grid.dx();
    let load = inside + solution.pressure.load_outside;
    assert!((load / solution.hertz.force - 1.0).abs() < 1e-6, "load {load} N/m");
    solution
}

fn conditions(hertz: &HertzLine, speed: f64) -> LineFilmConditions {
    LineFilmConditions {
        entrainment_speed: speed,
        eta0: 0.04,
        alpha: 20e-9,
        equivalent_modulus: MODULUS,
        radius: RADIUS,
        load: hertz.force,
    }
}

/// Composite midpoint rule, panels halved thirty times towards the end `to`, where the integrand may be
/// singular.
fn integral(from: f64, to: f64, integrand: impl Fn(f64) -> f64) -> f64 {
    let mut sum = 0.0;
    for level in 0..30 {
        let [outer, inner] = [level, level + 1].map(|l| to + (from - to) * 0.5_f64.powi(l));
        for panel in 0..400 {
            let s = inner + (outer - inner) * (f64::from(panel) + 0.5) / 400.0;
            sum += (outer - inner).abs() / 400.0 * integrand(s);
        }
    }
    sum
}

#[test]
fn strip_potential_is_the_integral_on_all_branches() {
    for x in [0.0_f64, 0.3, 0.999, 1.0, 1.5, 7.99, 8.01, 40.0] {
        let logarithm = |s: f64| (10.0 / (x - s).abs()).ln();
        let middle = x.min(1.0);
        let right = if x < 1.0 { integral(1.0, middle, logarithm) } else { 0.0 };
        let sum = integral(-1.0, middle, logarithm) + right;
        let value = strip_potential(x, 1.0, 10.0);
        assert!((value - sum).abs() < 1e-5, "{x}: {value} {sum}");
    }
    let jump = strip_potential(8.0 * (1.0 + 1e-14), 1.0, 1e3) / strip_potential(8.0, 1.0, 1e3) - 1.0;
    assert!(jump.abs() < 1e-13, "{jump:e}");
    assert!(strip_potential(1.0, -1.0, 1.0).is_nan() && strip_displacement(0.0, 1.0, 1.0, 1.0, 0.0).is_nan());
}

#[test]
fn convolution_is_the_direct_sum_for_every_length() {
    for n in [1, 2, 5, 7, 13, 64, 127, 300] {
        let grid = Grid::from_edges(n, 1, [-1e-4, 2e-4], [-0.5, 0.5]).unwrap();
        let mut body = LineHalfSpace::new(grid, MODULUS, RADIUS).unwrap();
        let pressure: Vec<f64> = (0..n).map(|i| 1e9 * ((i * 37 % 11) as f64 - 3.0)).collect();
        let mut out = vec![0.0; n];
        body.displacement(&pressure, &mut out).unwrap();
        let coefficient =
            |d: usize| strip_displacement(grid.dx() * d as f64, 0.5 * grid.dx(), RADIUS, 1.0, MODULUS);
        let scale: f64 = pressure.iter().map(|p| p.abs()).sum::<f64>() * coefficient(0);
        for (i, u) in out.iter().enumerate() {
            let direct: f64 = pressure.iter().enumerate().map(|(k, p)| coefficient(i.abs_diff(k)) * p).sum();
            assert!((u - direct).abs() < 1e-14 * scale, "{n}, {i}: {u} {direct}");
        }
        assert!((body.influence(0, 0) / coefficient(0) - 1.0).abs() < 1e-15);
    }
    let wide = Grid::from_edges(8, 2, [-1e-4, 2e-4], [-0.5, 0.5]).unwrap();
    assert!(LineHalfSpace::new(wide, MODULUS, RADIUS).unwrap_err().to_string().contains("grid.ny"));
    let row = Grid::from_edges(8, 1, [-1e-4, 2e-4], [-0.5, 0.5]).unwrap();
    assert!(LineHalfSpace::new(row, MODULUS, 2.9e-4).unwrap_err().to_string().contains("reference"));
}

/// Peak, half-width (from the second moment of the pressure, `a^2/4`), pressure field and approach.
#[test]
fn dry_line_contact_is_hertz() {
    for n in [256, 257, 512, 1024] {
        let mut scene = roller(1e9, 1.0, n);
        scene.solver.kind = SolverKind::Dry;
        scene.solver.tolerance = 1e-9;
        let solution = solved(&scene);
        let hertz = HertzLine::from_max_pressure(RADIUS, MODULUS, 1e9).unwrap();
        assert!((solution.hertz.force / hertz.force - 1.0).abs() < 1e-14);
        let second_order = 1e-3 * (256.0 / n as f64).powi(2);
        let peak = solution.pressure.max / 1e9 - 1.0;
        let (mut moment, mut sum) = (0.0, 0.0);
        for ((x, _), p) in solution.grid.nodes().zip(&solution.state.pressure) {
            moment += x * x * p;
            sum += p;
            let near_rim = (x.abs() / hertz.half_width - 1.0).abs() < 0.1;
            let error = (p - hertz.pressure_at(x)).abs() / 1e9;
            assert!(error < if near_rim { 0.05 } else { 2e-3 }, "{n}: {error} at {x}");
        }
        let width = 2.0 * (moment / sum).sqrt() / hertz.half_width - 1.0;
        let approach = solution.state.approach / hertz.approach(RADIUS).unwrap() - 1.0;
        assert!(peak.abs() < second_order, "{n}: peak {peak:e}");
        assert!(width.abs() < second_order, "{n}: half-width {width:e}");
        assert!(approach.abs() < second_order, "{n}: approach {approach:e}");
        // The nodes in contact reach to the rim to within a cell.
        let touching = solution.state.in_contact.iter().filter(|&&c| c).count() as f64 * solution.grid.dx();
        assert!((touching - 2.0 * hertz.half_width).abs() < 1.01 * solution.grid.dx());
        assert!((solution.contact.area_ratio - 1.0).abs() < 0.02 && solution.contact.load_ratio > 0.999_999);
    }
}

/// The formulas are met by an incompressible lubricant. A compressible one is thinner in the centre by about
/// its density there, by 10 to 17 % here; the minimum film, where the pressure is low, hardly changes.
#[test]
fn central_film_is_that_of_the_formulas() {
    for (p_max, speed) in [(0.4e9, 1.0), (0.8e9, 1.0), (0.8e9, 5.0), (1.0e9, 2.0), (1.2e9, 0.5)] {
        let mut scene = roller(p_max, speed, 512);
        let hertz = HertzLine::from_max_pressure(RADIUS, MODULUS, p_max).unwrap();
        let line = conditions(&hertz, speed);
        let moes = line.moes_central().unwrap();
        let dowson = line.dowson_toyoda_central().unwrap();
        scene.lubricant.as_mut().unwrap().density_a = 0.0;
        let incompressible = solved(&scene);
        let Moes { m, l, .. } = incompressible.moes.unwrap();
        assert!(
            (m / line.moes_load() - 1.0).abs() < 1e-12 && (l / line.moes_lubricant() - 1.0).abs() < 1e-12
        );
        scene.lubricant.as_mut().unwrap().density_a = 0.6e-9;
        let compressible = solved(&scene);
        let central = incompressible.film.central;
        // Measured: within 2 and 3 %.
        let (to_moes, to_dowson) = (central / moes - 1.0, central / dowson - 1.0);
        assert!(to_moes.abs() < 0.05 && to_dowson.abs() < 0.05, "M {m:.1} L {l:.1}: {to_moes} {to_dowson}");
        let minimum = compressible.film.minimum / line.dowson_minimum().unwrap() - 1.0;
        assert!(minimum.abs() < 0.1, "M {m:.1} L {l:.1}: minimum {minimum}");
        let density = 1.0 + 0.6 * p_max * 1e-9 / (1.0 + 1.7 * p_max * 1e-9);
        assert!((compressible.film.central * density / central - 1.0).abs() < 0.05);
    }
}

/// Order of the central film over meshes that halve, against the extrapolated value.
#[test]
fn central_film_converges_fast() {
    for (p_max, speed) in [(0.4e9, 1.0), (0.8e9, 1.0)] {
        let films = [128, 256, 512, 1024].map(|n| solved(&roller(p_max, speed, n)).film.central);
        for (film, most) in films.iter().zip([4e-4, 1.2e-4, 3e-5]) {
            assert!((film / films[3] - 1.0).abs() < most, "{films:?}");
        }
    }
}

#[test]
fn rows_and_width_of_the_box_are_not_used() {
    let scene = roller(0.5e9, 1.0, 256);
    let line = solved(&scene);
    let mut wide = scene.clone();
    wide.grid = GridSpec::Cells { nx: 256, ny: 64, x: edges(&scene), y: [-1e-3, 1e-3] };
    let rows = solve_contact(&wide).unwrap();
    assert_eq!(line.state, rows.state, "ny and y are not used");
}

fn edges(scene: &Scene) -> [f64; 2] {
    match scene.grid {
        GridSpec::Row { x, .. } | GridSpec::Cells { x, .. } => x,
        _ => [0.0; 2],
    }
}

/// A rough dry roller with everything that changes surfaces, a few steps.
#[test]
fn a_history_runs_on_a_row() {
    let mut scene = Scene::azam_2019(16).with_tribofilm();
    scene.form = Form::Cylinder { radius: 9.525e-3 };
    scene.thermal.flash = Flash::On;
    scene.solver.kind = SolverKind::Dry;
    scene.grid = GridSpec::Row { nx: 256, x: [-0.25e-3, 0.25e-3] };
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    // The mean pressure of a line contact is pi/4 of the largest one.
    let (hertz, [ball, disc]) = (sim.hertz(), sim.conditions().motion.surface_speeds());
    let flux = sim.scene().friction.boundary_coefficient * PI / 4.0 * hertz.pressure * (ball - disc).abs();
    let steel = [ThermalBody::STEEL; 2];
    let estimate = estimate_rise_under_flux(steel, [ball, disc], flux, hertz.half_width_x).unwrap();
    assert!((sim.flash_estimate() / estimate - 1.0).abs() < 1e-9, "{} K", sim.flash_estimate());
    let mut records = Vec::new();
    sim.run(3, 60.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        records.push(record.clone());
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(records.len(), 3);
    assert!(sim.ledger_residual().unwrap() < 1e-20);
    assert!(records[2].tribofilm.disc_mean > records[0].tribofilm.disc_mean, "the film grows");
    assert!((records[2].contact.load_ratio - 1.0).abs() < 1e-9, "{}", records[2].contact.load_ratio);
}

#[test]
fn every_solver_takes_a_row() {
    let mut scene = roller(0.4e9, 5.0, 96);
    let newton = solved(&scene);
    scene.solver.kind = SolverKind::SemiSystem;
    let sweeps = solved(&scene);
    assert_eq!(sweeps.report.solver, SolverId::SemiSystem);
    assert!((sweeps.film.central / newton.film.central - 1.0).abs() < 1e-4);
}

/// A smooth roller at this speed would have a film of many contact films; a rough one may touch.
#[test]
fn rough_rollers_touch_and_converge() {
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Cylinder { radius: RADIUS };
    scene.load.hertz_pressure = Some(0.5e9);
    scene.roughness.ball = Roughness::gaussian(20e-9, 10e-6, 1);
    scene.roughness.disc = Roughness::gaussian(130e-9, 10e-6, 101);
    scene.plastic = Some(PlasticSpec::new(2e9));
    let modulus = scene.elastic.equivalent_modulus;
    let half = 1.7 * HertzLine::from_max_pressure(RADIUS, modulus, 0.5e9).unwrap().half_width;
    scene.grid = GridSpec::Row { nx: 512, x: [-half, half] };
    let solution = solved(&scene);
    assert!(solution.contact.load_ratio > 0.02, "{}", solution.contact.load_ratio);
}
