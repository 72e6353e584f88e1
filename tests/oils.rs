//! Viscosity by pressure and temperature, shear stress by rate and pressure, and scenes that use them.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use stribeck::Status;
use stribeck::lubricant::{
    DensityLaw, DoolittleTait, DoolittleTaitConstants, ImprovedYasutomi, ImprovedYasutomiConstants, Rheology,
    Roelands, ThermalRoelands, ViscosityLaw,
};
use stribeck::sim::scene::{
    BarusConstants, Elastic, Flash, GridSpec, Load, LubricantSpec, Motion, RoughnessPair, Schedule,
    ViscositySpec,
};
use stribeck::sim::{MixedLubricationSim, Scene, SimError, solve_contact};
use stribeck::surface::Form;
use stribeck::testing::{density_law, viscosity_law};

use crate::common::free_volume::FREE_VOLUME;

const GLASS: ImprovedYasutomiConstants = ImprovedYasutomiConstants {
    glass_viscosity: 1e12,
    glass_temperature: 200.0,
    a1: 80.0,
    a2: 1e-9,
    b1: 6e-9,
    b2: -0.5,
    c1: 16.0,
    c2: 20.0,
};

fn roelands() -> Roelands {
    Roelands::new(0.04, 0.6, 1.96e8).unwrap()
}

fn laws() -> [Box<dyn ViscosityLaw>; 3] {
    [
        Box::new(ThermalRoelands::new(roelands(), 313.15, 1.1).unwrap()),
        Box::new(DoolittleTait::new(FREE_VOLUME).unwrap()),
        Box::new(ImprovedYasutomi::new(GLASS, 313.15).unwrap()),
    ]
}

#[test]
fn laws_satisfy_the_contract_at_all_temperatures() {
    for law in laws() {
        for temperature in [1.0, 100.0, 250.0, 313.15, 350.0, 450.0, 2e3, 1e6] {
            viscosity_law(&*law.at_temperature(temperature).unwrap()).unwrap();
        }
    }
    let tait = DoolittleTait::new(FREE_VOLUME).unwrap();
    for temperature in [1.0, 250.0, 313.15, 450.0, 1e4] {
        density_law(&*DensityLaw::at_temperature(&tait, temperature).unwrap()).unwrap();
    }
    assert!(roelands().at_temperature(300.0).is_none());
}

#[test]
fn viscosity_and_its_pressure_coefficient_decrease_with_temperature() {
    for law in laws() {
        let at = |t: f64| law.at_temperature(t).unwrap();
        for (cold, hot) in [(280.0, 300.0), (313.15, 353.15), (353.15, 400.0)] {
            let (cold, hot) = (at(cold), at(hot));
            for p in [0.0, 1e8, 5e8] {
                assert!(hot.viscosity(p) < cold.viscosity(p), "{law:?} at {p:e}");
            }
            assert!(hot.log_slope(1e7) < cold.log_slope(1e7), "{law:?}");
        }
        // The result depends on the requested temperature alone, not on earlier ones.
        let back = at(400.0).at_temperature(313.15).unwrap();
        assert!((back.viscosity(2e8) / at(313.15).viscosity(2e8) - 1.0).abs() < 1e-14);
        assert_eq!(
            format!("{:?}", at(400.0)),
            format!("{law:?}"),
            "the temperature that holds is no part of the oil"
        );
    }
}

/// The published equation, its temperature coefficient at the reference, and no temperature dependence for a
/// zero index.
#[test]
fn thermal_roelands_matches_its_equation() {
    let law = ThermalRoelands::new(roelands(), 313.15, 1.1).unwrap();
    for (t, p) in [(313.15, 0.0), (313.15, 3e8), (353.15, 0.0), (353.15, 3e8), (290.0, 1e8)] {
        let factor = ((t - 138.0) / (313.15 - 138.0_f64)).powf(-1.1);
        let exact = 0.04 * ((0.04_f64.ln() + 9.67) * ((1.0 + p / 1.96e8_f64).powf(0.6) * factor - 1.0)).exp();
        assert!((law.at_temperature(t).unwrap().viscosity(p) / exact - 1.0).abs() < 1e-12, "{t} {p:e}");
    }
    let at = |t: f64| law.at_temperature(t).unwrap().viscosity(0.0).ln();
    let coefficient = 1.1 * (0.04_f64.ln() + 9.67) / (313.15 - 138.0);
    assert!(((at(313.14) - at(313.16)) / 0.02 / coefficient - 1.0).abs() < 1e-6);
    // With alpha the exponent is alpha p0/z.
    let by_alpha = Roelands::from_alpha(0.04, 2e-8, 0.6, 1.96e8).unwrap();
    let warm = ThermalRoelands::new(by_alpha, 313.15, 1.0).unwrap().at_temperature(353.15).unwrap();
    let factor = (313.15 - 138.0) / (353.15 - 138.0);
    assert!((warm.log_slope(0.0) / (2e-8 * factor) - 1.0).abs() < 1e-12);
    let without = ThermalRoelands::new(roelands(), 313.15, 0.0).unwrap().at_temperature(400.0).unwrap();
    assert_eq!(without.viscosity(4e8).to_bits(), roelands().viscosity(4e8).to_bits());
}

/// Tait's bulk modulus and its pressure derivative at ambient pressure, Doolittle's free volume, and no
/// temperature dependence without expansion.
#[test]
fn doolittle_tait_matches_its_equations() {
    let law = DoolittleTait::new(FREE_VOLUME).unwrap();
    let stiffness = 9e9 * (-6e-3_f64 * 313.15).exp();
    assert!((law.slope(0.0) * stiffness - 1.0).abs() < 1e-12);
    // K = K0 + K0' p to first order, K = rho dp/drho.
    let modulus = |p: f64| law.ratio(p) / law.slope(p);
    assert!(((modulus(1e5) - modulus(0.0)) / 1e5 / 11.0 - 1.0).abs() < 1e-3);
    for p in [0.0, 1e8, 6e8] {
        let free = 1.0 / law.ratio(p) - 0.65;
        let exact = 0.02 * (4.0 * 0.65 * (1.0 / free - 1.0 / 0.35)).exp();
        assert!((law.viscosity(p) / exact - 1.0).abs() < 1e-12, "{p:e}");
    }
    // Far beyond the fitted range the free volume vanishes: a finite plateau.
    assert!((law.viscosity(1e12) / law.viscosity(0.0)).ln() <= Roelands::MAX_EXPONENT + 1e-9);
    let rigid = DoolittleTaitConstants { epsilon: 0.0, beta: 0.0, expansion: 0.0, ..FREE_VOLUME };
    let rigid = DoolittleTait::new(rigid).unwrap();
    let hot = ViscosityLaw::at_temperature(&rigid, 400.0).unwrap();
    assert!((hot.viscosity(3e8) / rigid.viscosity(3e8) - 1.0).abs() < 1e-14);
}

#[test]
fn improved_yasutomi_matches_its_equation() {
    let law = |t: f64| ImprovedYasutomi::new(GLASS, t).unwrap();
    for (t, p) in [(313.15, 0.0_f64), (353.15, 2e8), (300.0, 1e8)] {
        let glass = 200.0 + 80.0 * (1.0 + 1e-9 * p).ln();
        let x = (t - glass) * (1.0 + 6e-9 * p).powf(-0.5);
        let exact = 10.0_f64.powf(12.0 - 16.0 * x / (20.0 + x));
        assert!((law(t).viscosity(p) / exact - 1.0).abs() < 1e-11, "{t} {p:e}");
    }
    // At the glass transition and below it.
    for t in [200.0, 150.0] {
        assert!((law(t).viscosity(0.0) / 1e12 - 1.0).abs() < 1e-12);
    }
}

#[test]
fn carreau_stress_and_pressure_limits_match_their_equations() {
    let oil = Rheology::carreau(5e6, 0.4).unwrap();
    assert!((oil.shear_stress(1e-4, 1e3) / 0.1 - 1.0).abs() < 1e-12);
    assert!((oil.shear_stress(10.0, 1e6) / (1e7 * 5.0_f64.powf(-0.3)) - 1.0).abs() < 1e-12);
    let newtonian = Rheology::carreau(5e6, 1.0).unwrap();
    assert!((newtonian.shear_stress(10.0, 1e6) / 1e7 - 1.0).abs() < 1e-14);
    let limited = oil.with_limit_by_pressure(0.08).unwrap();
    assert!((limited.limit(1e9) / 8e7 - 1.0).abs() < 1e-14 && limited.limit(-1.0) == 0.0);
    assert!(oil.limit(1e9).is_infinite());
    assert!((limited.with_limit(5e7).unwrap().limit(1e9) / 5e7 - 1.0).abs() < 1e-14);
    for (error, part) in [
        (Rheology::carreau(0.0, 0.5).unwrap_err(), "friction.carreau_stress = 0"),
        (Rheology::carreau(1e6, 1.5).unwrap_err(), "friction.carreau_exponent = 1.5"),
        (oil.with_limit_by_pressure(-1.0).unwrap_err(), "friction.limiting_stress_coefficient = -1"),
    ] {
        assert!(error.to_string().contains(part), "{error}");
    }
}

fn scene() -> Scene {
    let mut scene = Scene::azam_2019(48);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.wear = None;
    scene.load.hertz_pressure = Some(0.6e9);
    scene.motion.entrainment_speed = 1.0;
    scene.lubricant.as_mut().unwrap().eta0 = 0.04;
    scene
}

/// A scene at a bulk temperature equals one with the viscosity at that temperature.
#[test]
fn contact_uses_the_viscosity_at_its_bulk_temperature() {
    let mut warm = scene();
    let oil = warm.lubricant.as_mut().unwrap();
    (oil.temperature, oil.roelands_s0) = (Some(313.15), Some(1.2));
    warm.thermal.bulk_temperature = 353.15;
    let factor = ((353.15 - 138.0) / (313.15 - 138.0_f64)).powf(-1.2);
    let mut same = scene();
    same.lubricant.as_mut().unwrap().eta0 = (((0.04_f64.ln() + 9.67) * factor) - 9.67).exp();
    let [warm, same] = [warm, same].map(|scene| solve_contact(&scene).unwrap());
    assert!(warm.report.require_converged().is_ok());
    assert!((warm.film.central / same.film.central - 1.0).abs() < 1e-6);
    assert!((warm.moes.unwrap().m / same.moes.unwrap().m - 1.0).abs() < 1e-9);
}

#[test]
fn contact_converges_for_every_viscosity_law() {
    let mut films = Vec::new();
    for law in [ViscositySpec::DoolittleTait(FREE_VOLUME), ViscositySpec::ImprovedYasutomi(GLASS)] {
        let mut scene = scene();
        scene.lubricant.as_mut().unwrap().viscosity = Some(law);
        scene.friction.carreau_stress = Some(5e6);
        scene.friction.carreau_exponent = Some(0.5);
        scene.friction.limiting_stress_coefficient = Some(0.06);
        for temperature in [313.15, 353.15] {
            scene.thermal.bulk_temperature = temperature;
            let solution = solve_contact(&scene).unwrap();
            assert!(solution.report.require_converged().is_ok(), "{:?}", solution.report);
            films.push(solution.film.central);
            assert!(
                solution.friction.fluid > 0.0 && solution.friction.fluid <= 0.06 + 1e-9,
                "{}",
                solution.friction.fluid
            );
        }
    }
    assert!(films[1] < 0.6 * films[0] && films[3] < 0.6 * films[2], "{films:?}");
}

/// Films of a history follow the scheduled bulk temperature for a law with temperature dependence,
/// reversibly.
#[test]
fn contact_converges_without_pressure_thickening() {
    let soft = |form: Form| {
        let mut scene = Scene::azam_2019(24);
        (scene.form, scene.elastic, scene.plastic) = (form, Elastic::new(10e6), None);
        scene.roughness = RoughnessPair::default();
        (scene.load, scene.motion) = (Load::force(1.0), Motion::new(0.1, 0.0));
        let thin = ViscositySpec::Barus(BarusConstants { eta0: 0.04, alpha: 0.0 });
        scene.lubricant = Some(LubricantSpec::roelands(0.0, 0.0).with_viscosity(Some(thin)));
        let side = 4.0 * scene.hertz().unwrap().half_width_x;
        let edges = [-side, side];
        scene.grid = GridSpec::Cells { nx: 24, ny: 24, x: edges, y: edges };
        scene
    };
    let radius = 9.525e-3;
    for form in
        [Form::Sphere { radius }, Form::Ellipsoid { radius_x: radius, radius_y: 2.0 * radius, angle: 0.0 }]
    {
        let scene = soft(form);
        let solution = solve_contact(&scene).unwrap();
        let formula = scene.formula_film().unwrap().unwrap().central;
        assert_eq!(solution.report.status, Status::Converged);
        let moes = solution.moes.unwrap();
        assert!(moes.m > 0.0 && moes.l == 0.0, "{moes:?}");
        let ratio = solution.film.central / formula;
        assert!((0.6..1.6).contains(&ratio), "{form:?}: {ratio}");
    }
    let mut wrong = soft(Form::Sphere { radius });
    let law = ViscositySpec::Barus(BarusConstants { eta0: 0.04, alpha: -1.0 });
    wrong.lubricant = wrong.lubricant.map(|oil| oil.with_viscosity(Some(law)));
    let error = solve_contact(&wrong).unwrap_err().to_string();
    assert_eq!(error, "lubricant.viscosity.alpha = -1: must be finite and >= 0");
}

#[test]
fn history_follows_the_bulk_temperature() {
    let mut scene = scene();
    scene.thermal.flash = Flash::Off;
    let temperatures = Schedule::Steps { times: vec![0.0, 10.0, 20.0], values: vec![313.15, 363.15, 313.15] };
    scene.schedule.bulk_temperature = Some(temperatures);
    let films = |scene: &Scene| -> Vec<f64> {
        let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
        (0..3).map(|_| sim.step(10.0).unwrap().film.mean_central).collect()
    };
    let constant = films(&scene);
    assert!((constant[1] / constant[0] - 1.0).abs() < 1e-3, "{constant:?}");
    let oil = scene.lubricant.as_mut().unwrap();
    (oil.temperature, oil.roelands_s0) = (Some(313.15), Some(1.2));
    let following = films(&scene);
    assert!((following[0] / constant[0] - 1.0).abs() < 1e-6, "{following:?} {constant:?}");
    assert!(following[1] < 0.5 * following[0], "{following:?}");
    assert!((following[2] / following[0] - 1.0).abs() < 1e-3, "{following:?}");
}

/// A failed step leaves the oil at its temperature, and the next step sets that of its own time.
#[test]
fn failed_step_leaves_the_oil_unchanged() {
    let mut scene = scene();
    scene.thermal.flash = Flash::Off;
    let oil = scene.lubricant.as_mut().unwrap();
    (oil.temperature, oil.roelands_s0) = (Some(313.15), Some(1.2));
    scene.schedule.bulk_temperature =
        Some(Schedule::Steps { times: vec![0.0, 10.0], values: vec![313.15, 363.15] });
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    let builder =
        MixedLubricationSim::builder(scene.clone()).interrupt(move || asked.load(Ordering::Relaxed));
    let mut sim = builder.build().unwrap();
    let mut whole = MixedLubricationSim::builder(scene).build().unwrap();
    assert_eq!(sim.step(10.0).unwrap(), whole.step(10.0).unwrap());
    stop.store(true, Ordering::Relaxed);
    assert!(matches!(sim.step(10.0), Err(SimError::Interrupted)));
    stop.store(false, Ordering::Relaxed);
    let (again, expected) = (sim.step(10.0).unwrap(), whole.step(10.0).unwrap());
    assert!(expected.film.mean_central.is_finite());
    assert_eq!(again, expected);
}

#[test]
fn scene_files_select_laws_and_report_their_errors() {
    let head = "[form]\nkind = \"sphere\"\nradius = 1e-2\n[elastic]\nequivalent_modulus = 2.3e11\n[load]\nforce = 10.0\n\
                [motion]\nentrainment_speed = 1.0\n[grid]\nnx = 32\nny = 32\nx = [-2e-4, 2e-4]\ny = [-2e-4, 2e-4]\n";
    let law = "[lubricant.viscosity]\nlaw = \"doolittle_tait\"\nviscosity = 0.02\ntemperature = 313.15\nb = 4.0\nr0 = 0.65\n\
               epsilon = -8e-4\nk0_slope = 11.0\nk00 = 9e9\nbeta = 6e-3\nexpansion = 8e-4\n";
    let scene = Scene::from_toml(&format!("{head}{law}")).unwrap();
    assert_eq!(scene.lubricant.unwrap().viscosity, Some(ViscositySpec::DoolittleTait(FREE_VOLUME)));
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    let refused = |text: &str| {
        let error = Scene::from_toml(text).map(|scene| solve_contact(&scene).map(|_| ()));
        match error {
            Err(error) => error.to_string(),
            Ok(outcome) => outcome.unwrap_err().to_string(),
        }
    };
    let oil = |keys: &str| format!("{head}[lubricant]\neta0 = 0.04\nroelands_z = 0.6\n{keys}");
    for (text, parts) in [
        (format!("{head}[lubricant]\neta0 = 0.04\n{law}"), ["`eta0`", "viscosity"]),
        (format!("{head}[lubricant]\ndensity_b = 0.0\n{law}"), ["`density_b`", "Tait"]),
        (format!("{head}[lubricant]\nroelands_p0 = 2e8\n{law}"), ["`roelands_p0`", "viscosity"]),
        (format!("{head}[lubricant]\neta0 = 0.04\n"), ["roelands_z", "lubricant"]),
        (format!("{head}{}", law.replace("doolittle_tait", "surprise")), ["surprise", "improved_yasutomi"]),
        (format!("{head}{}", law.replace("r0 = 0.65", "r0 = 1.5")), ["lubricant.viscosity.r0", "1.5"]),
        (format!("{head}{}", law.replace("r0 = 0.65\n", "")), ["r0", "lubricant"]),
        (oil("roelands_s0 = 1.0\n"), ["lubricant.temperature", "missing"]),
        (oil("temperature = 313.0\n"), ["lubricant.roelands_s0", "missing"]),
        (oil("temperature = 100.0\nroelands_s0 = 1.0\n"), ["lubricant.temperature", "100"]),
        (oil("temperature = 313.0\nroelands_s0 = -1.0\n"), ["lubricant.roelands_s0", "-1"]),
        (oil("[friction]\ncarreau_stress = 5e6\n"), ["friction.carreau_exponent", "missing"]),
        (oil("[friction]\ncarreau_exponent = 0.5\n"), ["friction.carreau_stress", "missing"]),
        (
            oil("[friction]\ncarreau_stress = 5e6\ncarreau_exponent = 0.5\neyring_stress = 5e6\n"),
            ["eyring_stress", "only one"],
        ),
    ] {
        let error = refused(&text);
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
    let wrong = ImprovedYasutomiConstants { b2: 0.5, ..GLASS };
    assert!(
        ImprovedYasutomi::new(wrong, 300.0).unwrap_err().to_string().contains("lubricant.viscosity.b2 = 0.5")
    );
}
