//! `grid.accuracy`: meshes that reach it, estimates that hold, scenes it is not for.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

use stribeck::Status;
use stribeck::sim::scene::{GridSpec, Load, LubricantSpec};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::Form;

const RADIUS: f64 = 1.0;
const MODULUS: f64 = 226e9;
const ALPHA: f64 = 2.2e-8;

/// A smooth contact by its Moes parameters, which are formed with the sum of the speeds.
fn contact(moes_load: f64, moes_lubricant: f64, accuracy: f64) -> Scene {
    let speed_parameter = (moes_lubricant / (ALPHA * MODULUS)).powi(4);
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Sphere { radius: RADIUS };
    scene.elastic.equivalent_modulus = MODULUS;
    let force = moes_load * speed_parameter.powf(0.75) * MODULUS * RADIUS * RADIUS;
    scene.load = Load { hertz_pressure: None, force: Some(force) };
    scene.motion.entrainment_speed = 0.5 * speed_parameter * MODULUS * RADIUS / 0.04;
    scene.lubricant = Some(LubricantSpec {
        eta0: 0.04,
        roelands_z: 0.68,
        roelands_p0: 1.96e8,
        alpha: Some(ALPHA),
        formula_alpha: None,
        density_a: 0.34 / 5.9e8,
        density_b: 1.0 / 5.9e8,
        supplied_film: None,
    });
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.grid = GridSpec::Accuracy { accuracy };
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

/// Central and minimum film of converged solutions by two independent programs, in units of `a^2/R`.
#[test]
fn estimates_hold_against_known_films() {
    for (m, l, central, minimum) in [(20.0, 10.0, 0.4325, 0.2928), (100.0, 10.0, 0.1372, 0.0735)] {
        let solution = solved(&contact(m, l, 0.05));
        let (moes_load, moes_lubricant) = solution.moes.unwrap();
        assert!((moes_load / m - 1.0).abs() < 1e-6 && (moes_lubricant / l - 1.0).abs() < 1e-6);
        let unit = solution.hertz.radius.powi(2) / RADIUS;
        let estimate = solution.error_estimate.unwrap();
        assert!(estimate.central_film <= 0.05, "{estimate:?}");
        let error = solution.film.central / unit / central - 1.0;
        assert!(error.abs() <= estimate.central_film, "M {m}: error {error}, {estimate:?}");
        let error = solution.film.minimum / unit / minimum - 1.0;
        assert!(error.abs() <= estimate.minimum_film, "M {m}: error {error}, {estimate:?}");
    }
}

#[test]
fn dry_contacts_are_estimated_by_their_pressure() {
    for accuracy in [0.1, 0.01, 0.001] {
        for form in [
            Form::Sphere { radius: 10e-3 },
            Form::Ellipsoid { radius_x: 12e-3, radius_y: 8e-3 },
            Form::Cylinder { radius: 10e-3 },
        ] {
            let mut scene = contact(100.0, 10.0, accuracy);
            scene.form = form;
            scene.load = Load { hertz_pressure: Some(1e9), force: None };
            scene.lubricant = None;
            let solution = solved(&scene);
            let estimate = solution.error_estimate.unwrap();
            let error = (solution.contact.max_pressure / 1e9 - 1.0).abs();
            assert!(error <= estimate.max_pressure.max(1e-3 * accuracy), "{form:?}: {error:e}, {estimate:?}");
            assert!(estimate.max_pressure <= accuracy);
            assert!(estimate.central_film == 0.0 && estimate.minimum_film == 0.0);
        }
    }
}

#[test]
fn line_contacts_are_estimated_too() {
    let line = |accuracy| {
        let mut scene = contact(100.0, 10.0, accuracy);
        scene.form = Form::Cylinder { radius: 10e-3 };
        scene.load = Load { hertz_pressure: Some(0.8e9), force: None };
        scene.motion.entrainment_speed = 1.0;
        solved(&scene)
    };
    let fine = line(5e-4);
    for accuracy in [0.05, 0.02, 0.005] {
        let solution = line(accuracy);
        let estimate = solution.error_estimate.unwrap();
        let error = (solution.film.central / fine.film.central - 1.0).abs();
        assert!(error <= estimate.central_film && estimate.central_film <= accuracy, "{error}, {estimate:?}");
        let error = (solution.film.minimum / fine.film.minimum - 1.0).abs();
        assert!(error <= estimate.minimum_film, "{error}, {estimate:?}");
    }
}

#[test]
fn what_it_cannot_be_asked_of_is_refused() {
    let named = |scene: &Scene, part: &str| {
        let message = solve_contact(scene).unwrap_err().to_string();
        assert!(message.starts_with("grid.accuracy") && message.contains(part), "{message}");
    };
    for accuracy in [0.0, -0.01, 0.2, 1e-9, f64::NAN] {
        named(&contact(20.0, 10.0, accuracy), "between");
    }
    let mut rough = Scene::azam_2019(16);
    rough.grid = GridSpec::Accuracy { accuracy: 0.01 };
    named(&rough, "rough");
    // A history needs one grid for all of its steps.
    let message = MixedLubricationSim::builder(rough).build().unwrap_err().to_string();
    assert!(message.starts_with("grid.accuracy"), "{message}");
    // A film of a ten-thousandth of the Hertz approach has no affordable mesh.
    named(&contact(1e7, 3.0, 1e-4), "nodes");
}

#[test]
fn files_say_it_in_place_of_a_grid() {
    let text = |grid: &str| {
        format!(
            "[form]\nkind = \"sphere\"\nradius = 1e-2\n[elastic]\nequivalent_modulus = 2e11\n[load]\nforce = 10.0\n[grid]\n{grid}\n"
        )
    };
    let scene = Scene::from_toml(&text("accuracy = 0.01")).unwrap();
    assert_eq!(scene.grid, GridSpec::Accuracy { accuracy: 0.01 });
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    for (grid, part) in [
        ("accuracy = 0.01\nnx = 64", "`nx`"),
        ("accuracy = \"fine\"", "accuracy"),
        ("nx = 64\nx = [-1e-3, 1e-3]\nny = 64", "`y`"),
        ("", "`nx`"),
    ] {
        let message = Scene::from_toml(&text(grid)).unwrap_err().to_string();
        assert!(message.contains(part) && message.contains("grid"), "{message}");
    }
    let row = Scene::from_toml(&text("nx = 64\nx = [-1e-3, 1e-3]")).unwrap();
    let message = solve_contact(&row).unwrap_err().to_string();
    assert!(message.contains("ny and y are missing"), "{message}");
}
