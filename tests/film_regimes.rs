//! Regimes, their films and the load on solids by formula, against closed forms and solved contacts.

use approx::assert_relative_eq;
use stribeck::analytic::{FilmConditions, FilmRegime, LineFilmConditions, MixedLoadShare};
use stribeck::sim::{MixedLubricationSim, Scene, solve_contact};

const BALL: FilmConditions = FilmConditions {
    entrainment_speed: 0.1,
    eta0: 0.004,
    alpha: 14.94e-9,
    equivalent_modulus: 229.67e9,
    radius: 9.525e-3,
    load: 54.07,
    ellipticity: 1.0,
};
const ROLLER: LineFilmConditions = LineFilmConditions {
    entrainment_speed: 1.0,
    eta0: 0.04,
    alpha: 20e-9,
    equivalent_modulus: 230e9,
    radius: 10e-3,
    load: 2e5,
};

/// Loaded steel in oil, rubber in water, a light ball in a viscous oil, a fast one that swims.
#[test]
fn points_and_lines_fall_into_all_four_regimes() {
    use FilmRegime::{IsoviscousElastic, IsoviscousRigid, PiezoviscousElastic, PiezoviscousRigid};
    let soft = FilmConditions { alpha: 0.0, equivalent_modulus: 10e6, load: 1.0, ..BALL };
    let viscous = FilmConditions { eta0: 0.05, entrainment_speed: 2.0, alpha: 30e-9, load: 2.0, ..BALL };
    let swims = FilmConditions { eta0: 0.05, entrainment_speed: 10.0, load: 0.1, ..BALL };
    for (contact, regime) in [
        (BALL, PiezoviscousElastic),
        (soft, IsoviscousElastic),
        (viscous, PiezoviscousRigid),
        (swims, IsoviscousRigid),
    ] {
        assert_eq!(contact.film_map().unwrap().regime, regime, "{contact:?}");
    }
    let soft = LineFilmConditions { alpha: 0.0, equivalent_modulus: 10e6, load: 1e3, ..ROLLER };
    let swims = LineFilmConditions { alpha: 1e-9, load: 1e3, ..ROLLER };
    let viscous = LineFilmConditions { load: 2e4, entrainment_speed: 5.0, ..ROLLER };
    for (contact, regime) in [
        (ROLLER, PiezoviscousElastic),
        (soft, IsoviscousElastic),
        (viscous, PiezoviscousRigid),
        (swims, IsoviscousRigid),
    ] {
        assert_eq!(contact.film_map().unwrap().regime, regime, "{contact:?}");
    }
}

#[test]
fn parameters_of_the_map_are_those_of_its_axes() {
    let map = BALL.film_map().unwrap();
    let (u, g, w) = (BALL.speed_parameter(), BALL.material_parameter(), BALL.load_parameter());
    assert_relative_eq!(map.viscosity_parameter, g * w.powi(3) / (u * u), max_relative = 1e-12);
    assert_relative_eq!(map.elasticity_parameter, w.powf(8.0 / 3.0) / (u * u), max_relative = 1e-12);
    let map = ROLLER.film_map().unwrap();
    let (u, g, w) = (ROLLER.speed_parameter(), ROLLER.material_parameter(), ROLLER.load_parameter());
    assert_relative_eq!(map.viscosity_parameter, g * w.powf(1.5) / u.sqrt(), max_relative = 1e-12);
    assert_relative_eq!(map.elasticity_parameter, w / u.sqrt(), max_relative = 1e-12);
}

/// Brewe, Hamrock and Taylor's spheres and Martin's cylinders, rigid in an isoviscous oil.
#[test]
fn rigid_isoviscous_films_are_those_of_brewe_and_martin() {
    let light = FilmConditions { load: 1e-4, alpha: 0.0, ..BALL };
    let side = 0.6_f64.powi(2) * (0.131 * 0.5_f64.atan() + 1.683).powi(2);
    let brewe = 128.0 * side * BALL.radius * (light.speed_parameter() / light.load_parameter()).powi(2);
    assert_relative_eq!(light.film_map().unwrap().central, brewe, max_relative = 1e-3);
    let light = LineFilmConditions { load: 1.0, alpha: 0.0, ..ROLLER };
    let martin = 4.896 * ROLLER.radius * light.speed_parameter() / light.load_parameter();
    assert_relative_eq!(light.film_map().unwrap().central, martin, max_relative = 1e-3);
}

/// An independent formula of loaded ellipses that are wide across the entrainment.
#[test]
fn films_of_loaded_ellipses_are_near_those_of_hamrock_and_dowson() {
    for ellipticity in [1.0, 2.0, 4.0, 8.0] {
        for speed in [0.1, 1.0] {
            let contact = FilmConditions {
                ellipticity,
                entrainment_speed: speed,
                eta0: 0.02,
                alpha: 18e-9,
                load: 200.0,
                ..BALL
            };
            let ratio = contact.film_map().unwrap().central / contact.hamrock_dowson_central().unwrap();
            assert!((0.8..1.1).contains(&ratio), "ellipticity {ellipticity}, {speed} m/s: {ratio}");
        }
    }
}

/// The formulas are for incompressible oils: the density at the center thins the film of a roller by a sixth.
#[test]
fn expected_film_of_a_roller_counts_the_density_of_its_oil() {
    let scene = |density: &str| {
        let text = format!(
            "form = {{ kind = \"cylinder\", radius = 10e-3 }}\nelastic.equivalent_modulus = 230e9\nload.force = 175e3\n\
             motion.entrainment_speed = 1.0\n[lubricant]\neta0 = 0.04\nroelands_z = 0.68\nalpha = 20e-9\n{density}\n\
             [grid]\nnx = 200\nx = [-560e-6, 280e-6]"
        );
        Scene::from_toml(&text).unwrap()
    };
    let mut films = Vec::new();
    for density in ["", "density_a = 0.0"] {
        let scene = scene(density);
        let expected = MixedLubricationSim::builder(scene.clone()).build().unwrap().expectation().unwrap();
        let expected = expected.film.unwrap();
        let solved = solve_contact(&scene).unwrap().film.central;
        assert!((expected.central / solved - 1.0).abs() < 0.05, "{density}: {} {solved}", expected.central);
        films.push(expected.central);
    }
    assert!(films[0] < 0.85 * films[1], "{films:?}");
}

/// Rows of cells that reach so far upstream that the contact is flooded.
#[test]
fn films_of_lines_are_near_those_of_flooded_solutions() {
    let modulus = 230e9;
    for (m, l, bound) in
        [(0.3, 0.0, 0.06), (3.0, 0.0, 0.1), (30.0, 0.0, 0.05), (3.0, 5.0, 0.06), (30.0, 10.0, 0.05)]
    {
        let alpha = if l > 0.0 { 20e-9 } else { 0.0 };
        let double_u = if l > 0.0 { f64::powi(l / (alpha * modulus), 4) } else { 5e-12 };
        let load = m * f64::sqrt(double_u) * modulus * 10e-3;
        let entrainment_speed = 0.5 * double_u * modulus * 10e-3 / 0.04;
        let line = LineFilmConditions {
            entrainment_speed,
            eta0: 0.04,
            alpha,
            equivalent_modulus: modulus,
            radius: 10e-3,
            load,
        };
        let film = line.film_map().unwrap().central;
        let half_width = (8.0 * load * 10e-3 / (std::f64::consts::PI * modulus)).sqrt();
        let inlet = (20.0 * half_width).max(40.0 * (2.0 * 10e-3 * film).sqrt());
        let outlet = (3.0 * half_width).max(0.2 * inlet);
        let scene = format!(
            "form = {{ kind = \"cylinder\", radius = 10e-3 }}\nelastic.equivalent_modulus = {modulus}\nload.force = {load}\n\
             motion.entrainment_speed = {entrainment_speed}\n[lubricant]\ndensity_a = 0.0\ndensity_b = 0.0\n\
             viscosity = {{ law = \"barus\", eta0 = 0.04, alpha = {alpha} }}\n\
             [grid]\nnx = 2000\nx = [-{inlet}, {outlet}]\n[solver]\nkind = \"newton_krylov\""
        );
        let solution = solve_contact(&Scene::from_toml(&scene).unwrap()).unwrap();
        solution.report.require_converged().unwrap();
        let error = film / solution.film.central - 1.0;
        assert!(error.abs() < bound, "M {m}, L {l}: {error:.3}");
    }
}

/// The limits of fine meshes in `docs/reference.csv`, means over their surfaces.
#[test]
fn load_on_solids_is_near_the_limits_of_fine_meshes() {
    let table = include_str!("../docs/reference.csv");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let mut contacts = std::collections::BTreeMap::<String, (f64, Vec<f64>)>::new();
    for line in lines {
        let text = |name: &str| line[names.iter().position(|column| *column == name).unwrap()];
        let number = |name: &str| text(name).parse::<f64>().unwrap();
        if text("cavitation") != "mass_conserving" {
            continue;
        }
        let inlets = MixedLoadShare {
            entrainment_speed: number("entrainment_speed_m_per_s"),
            eta0: 0.004,
            alpha: 0.68 * (0.004_f64.ln() + 9.67) / 1.96e8,
            correlation_length: number("length_m"),
            contact_film: number("film_cutoff_m"),
            composite_rq: number("rq_ball_m").hypot(number("rq_disc_m")),
        };
        let key = format!("{} {}", text("scene"), text("entrainment_speed_m_per_s"));
        let contact = contacts.entry(key).or_insert((inlets.load_ratio().unwrap(), Vec::new()));
        contact.1.push(number("load_ratio"));
    }
    let errors = contacts
        .values()
        .map(|(formula, solved)| (formula - solved.iter().sum::<f64>() / solved.len() as f64).abs());
    let errors: Vec<f64> = errors.collect();
    let (mean, largest) =
        (errors.iter().sum::<f64>() / errors.len() as f64, errors.iter().copied().fold(0.0, f64::max));
    assert_eq!(errors.len(), 9);
    assert!(mean < 0.055 && largest < 0.21, "{mean} {largest}");
}
