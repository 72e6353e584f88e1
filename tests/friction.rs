//! Friction, its heat, and the numbers of records.
#![expect(clippy::float_cmp, reason = "tests")]

use stribeck::BoundaryFriction;
use stribeck::lubricant::{Roelands, ViscosityLaw};
use stribeck::metrics::height_statistics;
use stribeck::sim::scene::{FrictionSpec, SolverKind};
use stribeck::sim::{Body, BodyStart, MixedLubricationSim, Scene, solve_contact};

/// A rough dry scene, fast to solve.
fn dry(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.solver.kind = SolverKind::Dry;
    scene
}

/// The friction changes with the coverage of the film; its boundary part is the mean coefficient times the
/// solid load ratio.
#[test]
fn friction_follows_the_tribofilm() {
    let friction = |film_coefficient: Option<f64>, thickness: f64| {
        let mut scene = Scene::azam_2019(32).with_tribofilm();
        scene.solver.tolerance = 1e-4;
        (scene.friction.boundary_coefficient, scene.friction.film_coefficient) = (0.08, film_coefficient);
        scene.friction.covering_thickness = film_coefficient.map(|_| 20e-9);
        let rough = MixedLubricationSim::builder(scene.clone()).build().unwrap();
        let start = BodyStart::new(rough.grid(), rough.bodies()[1].initial().to_vec());
        let mut sim = MixedLubricationSim::builder(scene)
            .disc_start(start.with_tribofilm(vec![thickness; 32 * 32]))
            .build()
            .unwrap();
        let record = sim.step(1.0).unwrap();
        let sum = record.friction.boundary + record.friction.fluid;
        assert!((sum / record.friction.coefficient - 1.0).abs() < 1e-14);
        assert!(record.contact.load_ratio > 0.01 && record.friction.fluid > 0.0, "{record:?}");
        record.friction.boundary / record.contact.load_ratio
    };
    for (covered, thickness, expected) in [
        (None, 50e-9, 0.08),
        (Some(0.14), 0.0, 0.08),
        (Some(0.14), 10e-9, 0.11),
        (Some(0.14), 50e-9, 0.14),
        (Some(0.02), 5e-9, 0.065),
    ] {
        let mean = friction(covered, thickness);
        assert!((mean / expected - 1.0).abs() < 1e-12, "{mean} instead of {expected}");
    }
}

/// Lower friction on thick films.
#[derive(Debug)]
struct Soap;

impl BoundaryFriction for Soap {
    fn coefficient(&self, solid_pressure: f64, sliding_speed: f64, tribofilm: [f64; 2]) -> f64 {
        assert!(solid_pressure >= 0.0 && sliding_speed > 0.0 && tribofilm == [0.0; 2]);
        if solid_pressure > 1e9 { 0.05 } else { 0.1 }
    }
}

/// A law that returns invalid coefficients.
#[derive(Debug)]
struct Wild;

impl BoundaryFriction for Wild {
    fn coefficient(&self, solid_pressure: f64, _: f64, _: [f64; 2]) -> f64 {
        if solid_pressure > 1e9 { f64::NAN } else { 0.1 }
    }
}

#[test]
fn custom_friction_replaces_that_of_the_scene() {
    let scene = dry(32);
    let mut sim = MixedLubricationSim::builder(scene.clone()).boundary_friction(Soap).build().unwrap();
    let record = sim.step(1.0).unwrap();
    let mu = record.friction.coefficient;
    assert!(mu > 0.05 && mu < 0.1 && record.friction.fluid == 0.0 && record.friction.boundary == mu, "{mu}");
    let mut sim = MixedLubricationSim::builder(scene).boundary_friction(Wild).build().unwrap();
    let before = sim.bodies().clone();
    let error = sim.step(1.0).unwrap_err().to_string();
    assert!(error.contains("boundary friction of the law = NaN"), "{error}");
    assert_eq!((sim.time(), sim.bodies()[0].surface()), (0.0, before[0].surface()));
}

#[test]
fn invalid_friction_coefficients_are_rejected_by_name() {
    for (change, part) in [
        (
            &(|spec: &mut FrictionSpec| spec.film_coefficient = Some(-0.1)) as &dyn Fn(&mut FrictionSpec),
            "friction.film_coefficient = -0.1",
        ),
        (
            &|spec| (spec.film_coefficient, spec.covering_thickness) = (Some(0.1), Some(0.0)),
            "friction.covering_thickness = 0",
        ),
        (&|spec| spec.covering_thickness = Some(1e-8), "friction.film_coefficient is missing"),
    ] {
        let mut scene = Scene::azam_2019(32);
        change(&mut scene.friction);
        let error = solve_contact(&scene).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// A smooth film without boundary friction at a slide-roll ratio of 1: the estimate includes its shear heat.
#[test]
fn flash_temperature_estimate_includes_fluid_shear() {
    for speed in [2.0, 5.0] {
        let mut scene = Scene::azam_2019(64);
        scene.roughness = Default::default();
        (scene.plastic, scene.wear) = (None, None);
        (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (speed, 1.0);
        scene.friction.boundary_coefficient = 0.0;
        scene.solver.tolerance = 1e-4;
        let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
        assert!(sim.models_flash_temperature());
        let rise = sim.step(1e-3).unwrap().flash_rise.unwrap();
        println!("{speed} m/s: estimate {:.1} K, computed {rise:.1} K", sim.flash_estimate());
        assert!((sim.flash_estimate() / rise - 1.0).abs() < 0.25, "{} and {rise}", sim.flash_estimate());
        scene.motion.slide_roll_ratio = 0.0;
        let rolling = MixedLubricationSim::builder(scene).build().unwrap();
        assert_eq!((rolling.flash_estimate(), rolling.models_flash_temperature()), (0.0, false));
    }
}

/// Values of a record are consistent: roughness and film of one contact, pressures within the limit of their
/// nodes.
#[test]
fn record_values_are_consistent() {
    let mut scene = Scene::azam_2019(48).with_tribofilm();
    scene.solver.tolerance = 1e-4;
    (scene.plastic.as_mut().unwrap().hardness, scene.roughness.ball) = (2.5e9, Default::default());
    let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let rq = |sim: &MixedLubricationSim| {
        let track = |body: &Body| sim.track_roughness(body.surface()).unwrap();
        sim.bodies().each_ref().map(|body| height_statistics(&track(body)).unwrap().sq)
    };
    for step in 0..4 {
        let before = rq(&sim);
        let record = sim.step(200.0).unwrap();
        for (rq, before) in record.roughness.rq().into_iter().zip(before) {
            assert!((rq - before).abs() <= 1e-12 * before, "step {step}: {rq} and {before}");
        }
        assert_eq!(record.film.lambda, Some(record.film.mean_central / record.roughness.composite_rq));
        let thickest = sim.bodies().iter().flat_map(|body| body.tribofilm()).copied().fold(0.0, f64::max);
        assert!(record.pressure.max <= 2.5e9 && record.pressure.max > 2e9, "{record:?} under {thickest} m");
        if step > 0 {
            assert!(rq(&sim) != before, "the step changes the surfaces");
        }
    }
    // By the coefficient that is stated, not by the slope of the viscosity law.
    let formula = |alpha| {
        let mut scene = scene.clone();
        scene.lubricant.as_mut().unwrap().formula_alpha = alpha;
        let record = MixedLubricationSim::builder(scene).build().unwrap().step(1.0).unwrap();
        (record.film.formula_lambda.unwrap(), record.film.mean_central)
    };
    let (by_slope, stated) = (formula(None), formula(Some(2.0 * 1.4393e-8)));
    assert!((stated.0 / by_slope.0 / 2.0_f64.powf(0.53) - 1.0).abs() < 1e-4, "{stated:?} {by_slope:?}");
    assert_eq!(stated.1, by_slope.1);
}

/// Behind a fully flooded contact the film ruptures: the share `theta` of each cell is sheared.
#[test]
fn cavitated_cells_shear_by_their_film_fraction() {
    let mut scene = Scene::azam_2019(48);
    (scene.roughness, scene.plastic) = (Default::default(), None);
    let solution = solve_contact(&scene).unwrap();
    solution.report.require_converged().unwrap();
    let (state, rheology, sliding) =
        (&solution.state, scene.friction.rheology().unwrap(), scene.motion.sliding_speed());
    let oil = scene.lubricant.unwrap();
    let law = Roelands::new(oil.eta0, oil.roelands_z, oil.roelands_p0).unwrap();
    assert!(state.theta.iter().filter(|theta| **theta < 0.9).count() > 100);
    let stress = |k: usize| {
        let pressure = state.fluid_pressure[k];
        let stress = rheology.shear_stress_under(pressure, law.viscosity(pressure), sliding / state.film[k]);
        state.theta[k] * stress
    };
    let force = (0..state.film.len()).map(stress).sum::<f64>() * solution.grid.cell_area();
    let exact = force / solution.hertz.force;
    assert!((solution.friction.fluid / exact - 1.0).abs() < 1e-12, "{} for {exact}", solution.friction.fluid);
}
