//! Flash temperature, starvation, scars, wear rates, kappa and means over the track of a history, beside closed forms.

use std::f64::consts::PI;
use std::path::Path;

use stribeck::sim::scene::{CoatedBody, GridSpec, LayerSpec, Load, PlasticSpec, Schedule, StressSpec};
use stribeck::sim::{HistoryMeans, MixedLubricationSim, Scene, solve_contact};

use crate::common::runs::run;

fn scene(name: &str) -> Scene {
    Scene::load(Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes").join(name)).unwrap()
}

fn close(name: &str, value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() < tolerance, "{name}: {value:e}, expected {expected:e}");
}

/// A slow contact heats two half-spaces at rest: `pi q a/(8 k)` in the center under the flux `q (1 - r^2/a^2)^(1/2)`.
#[test]
fn flash_rise_of_a_slow_dry_contact_is_that_of_a_source_at_rest() {
    let mut scene = scene("dry_wear.toml");
    scene.motion.entrainment_speed = 1e-3; // the disc at 2 mm/s: Peclet number 0.005
    let solution = solve_contact(&scene).unwrap();
    let sliding = scene.motion.sliding_speed();
    let flux = 0.6 * solution.hertz.pressure * sliding;
    let expected = PI * flux * solution.hertz.radius / (8.0 * scene.thermal.conductivity);
    close("flash", solution.flash_rise.unwrap(), expected, 0.02);
    assert!(solution.to_string().contains("\nflash "), "{solution}");
    scene.motion.slide_roll_ratio = 0.0;
    assert_eq!(solve_contact(&scene).unwrap().flash_rise, None);
}

/// The first record of a history has the same contact and the same moving sources; `solve` leaves out the outermost 1e-4
/// of the heat.
#[test]
fn flash_rise_of_a_solve_is_that_of_the_first_step() {
    let mut scene = scene("dry_wear.toml");
    scene.thermal.flash = stribeck::sim::scene::Flash::On;
    let solved = solve_contact(&scene).unwrap().flash_rise.unwrap();
    let stepped = MixedLubricationSim::builder(scene).build().unwrap().step(1.0).unwrap().flash_rise.unwrap();
    close("flash", solved, stepped, 1e-6);
}

#[test]
fn starved_film_is_compared_with_the_flooded_one() {
    let starved = scene("starved.toml");
    let mut flooded = starved.clone();
    flooded.lubricant = flooded.lubricant.map(|oil| oil.with_supplied_film(None));
    let (starved, flooded) = (solve_contact(&starved).unwrap(), solve_contact(&flooded).unwrap());
    let starvation = starved.starvation.unwrap();
    close("flooded film", starvation.flooded_film, flooded.film.central, 1e-9);
    close("film ratio", starvation.film_ratio, starved.film.central / flooded.film.central, 1e-9);
    assert!(starvation.film_ratio < 0.3 && flooded.starvation.is_none(), "{starvation:?}");
    let [starved, flooded] = [starved, flooded].map(|solution| solution.film.fluid_fraction.unwrap());
    assert!(
        [starved, flooded].iter().all(|fraction| (0.999..=1.0).contains(fraction)),
        "{starved} {flooded}"
    );
}

/// The ball at rest wears by the pressure at y, `(1 - y^2/a^2)^(1/2)`, the disc by its sum along x, `1 - y^2/a^2`: the profiles fall to
/// a twentieth of their depth at 0.9987 a and 0.9747 a. The profile of the disc has the area `4/3 a d`.
#[test]
fn scars_have_the_width_and_depth_of_their_profiles() {
    let (sim, records) = run(scene("dry_wear.toml"), 1, 1e-3);
    let (a, wear) = (sim.hertz().half_width_y, records[0].wear);
    let cell = sim.grid().dy();
    let [ball, disc] = [wear.ball_scar_width, wear.disc_scar_width].map(Option::unwrap);
    assert!(
        (ball - 2.0 * 0.9987 * a).abs() < cell && (disc - 2.0 * 0.9747 * a).abs() < cell,
        "{ball} {disc} {a}"
    );
    close("depth of the ball", wear.ball_scar_depth, wear.ball_max, 0.02);
    let depth = wear.disc_mean * sim.grid().size_y() / (4.0 / 3.0 * a);
    close("depth of the disc", wear.disc_scar_depth, depth, 0.02);
}

/// Wear never falls, and neither does its mean over a track of one width under a growing load.
#[test]
fn mean_wear_on_the_track_grows_with_a_growing_load() {
    let mut scene = scene("dry_wear.toml");
    scene.load = Load::force(2.0);
    scene.schedule.load = Some(Schedule::Steps { times: vec![0.0, 20.0], values: vec![2.0, 10.0] });
    let (sim, records) = run(scene, 4, 10.0);
    for pair in records.windows(2) {
        let [before, after] = [&pair[0], &pair[1]].map(|record| record.wear.in_contact());
        assert!(after[0] > before[0] && after[1] > before[1], "{before:?} {after:?}");
    }
    // The width under the first load is that of the last one.
    let ones = vec![1.0; sim.grid().len()];
    close("mean", sim.mean_on_track(&ones).unwrap(), 1.0, 1e-12);
}

/// Archard's law: volume over load and distance is K/H.
#[test]
fn specific_wear_rate_is_that_of_archard() {
    let (_, records) = run(scene("dry_wear.toml"), 4, 10.0);
    let mut means = HistoryMeans::new(4);
    records.iter().for_each(|record| means.see(record));
    for rate in means.specific_wear_rates().unwrap() {
        close("rate", rate, 1e-7 / 6e9, 1e-4);
    }
}

/// The scar of a pin at rest is form: smooth bodies stay smooth as they wear, to the hundredth of the scar that it is
/// off a paraboloid. Above `8 p/(E' q)` of wear a step profiles oscillate, which is said.
#[test]
fn roughness_of_a_worn_pin_is_without_its_scar_and_long_steps_are_said() {
    let (sim, records) = run(scene("dry_wear.toml"), 60, 5.0);
    let last = records.last().unwrap();
    let [depth, rq] = [last.wear.ball_scar_depth, last.roughness.ball_rq];
    assert!(depth > 0.3e-6 && rq < 0.01 * depth, "Rq {rq:e} of a scar of {depth:e} m");
    assert!(sim.warnings().is_empty(), "{:?}", sim.warnings());
    assert!(last.pressure.max < records[0].pressure.max);

    let (sim, records) = run(scene("dry_wear.toml"), 30, 40.0);
    let (first, warnings) = (records.first().unwrap(), sim.warnings());
    let long: Vec<_> = warnings.iter().filter(|warning| warning.field == "time_step").collect();
    assert_eq!(long.len(), 1, "{warnings:?}");
    let waves = PI * 2.0_f64.sqrt() / sim.grid().dx();
    let limit = 8.0 * first.pressure.max / (scene("dry_wear.toml").equivalent_modulus().unwrap() * waves);
    assert!(first.wear.ball_max + first.wear.disc_max > limit);
    assert!(long[0].message.contains(&stribeck::units::by_size(limit, "m")), "{}", long[0]);
    // The scar widens and pressures fall, but for the oscillations.
    assert!(records.last().unwrap().pressure.max > 2.0 * first.pressure.max);
}

/// ISO 281: 4500/sqrt(1500 39.04) = 18.60 mm^2/s, 45000 500^-0.83/sqrt(39.04) = 41.4 mm^2/s.
#[test]
fn kappa_is_the_viscosity_over_that_of_iso_281() {
    let kappa = |rotation: &str| {
        let text = format!(
            "[form]\nkind = \"sphere\"\nradius = 1e-2\n[elastic]\nequivalent_modulus = 2.3e11\n[load]\nforce = 20.0\n\
             [motion]\nentrainment_speed = 1.0\n[lubricant]\ngrade = \"ISO VG 68\"\nviscosity_index = 95\n\
             [thermal]\nbulk_temperature = \"40 degC\"\n[grid]\nnx = 16\nny = 16\nx = [-1e-4, 1e-4]\ny = [-1e-4, 1e-4]\n\
             [bearing]\nrotation = \"{rotation}\"\nmean_diameter = \"39.04 mm\"\n"
        );
        Scene::from_toml(&text).unwrap().oil_numbers().unwrap().unwrap().kappa.unwrap()
    };
    close("1500 rpm", kappa("1500 rpm"), 68.0 / 18.595, 1e-3);
    close("500 rpm", kappa("500 rpm"), 68.0 * 500_f64.powf(0.83) * 39.04_f64.sqrt() / 45_000.0, 1e-9);
    let error = Scene::azam_2019(16);
    assert_eq!(error.oil_numbers().unwrap().unwrap().kappa, None);
}

/// Steel with a layer of steel: the tension at the edge of a frictionless contact is `(1 - 2 v) p_0/3` (Johnson 1985), that behind a
/// sliding one `p_0 ((1 - 2 v)/3 + mu pi (4 + v)/8)` (Hamilton 1983).
#[test]
#[ignore = "slow"]
fn tension_at_the_surface_of_a_layer_is_that_of_hertz_and_of_hamilton() {
    let mut scene = scene("dry_wear.toml");
    scene.grid = GridSpec::Cells { nx: 128, ny: 128, x: [-120e-6, 120e-6], y: [-120e-6, 120e-6] };
    scene.elastic.layer = Some(LayerSpec::new(20e-6, 206e9, 0.3));
    scene.stress = Some(StressSpec::default());
    let layer = |scene: &Scene| {
        let solution = solve_contact(scene).unwrap();
        (solution.hertz, solution.stress.unwrap().layer.unwrap().surface_tension)
    };
    let modulus = scene.materials.disc.young_modulus().unwrap();
    scene.elastic.layer = scene.elastic.layer.map(|layer| layer.with_modulus(modulus));
    let mut still = scene.clone();
    still.motion.slide_roll_ratio = 0.0;
    let (hertz, tension) = layer(&still);
    close("at rest", tension.stress, 0.4 * hertz.pressure / 3.0, 0.06);
    close("edge", tension.x.hypot(tension.y), hertz.half_width_x, 0.06);
    // The stress is a cusp at the edge, which cells cut off by the root of their width.
    let (_, tension) = layer(&scene);
    let mut coarse = scene.clone();
    coarse.grid = GridSpec::Cells { nx: 64, ny: 64, x: [-120e-6, 120e-6], y: [-120e-6, 120e-6] };
    let root = 2.0_f64.sqrt();
    let limit = (root * tension.stress - layer(&coarse).1.stress) / (root - 1.0);
    close("sliding", limit, hertz.pressure * (0.4 / 3.0 + 0.6 * PI * 4.3 / 8.0), 0.06);
    // The disc at 0.1 m/s drags the ball at rest to +x: friction on the disc is towards -x, and its tension ahead of the contact.
    assert!(tension.x > 0.9 * hertz.half_width_x, "{tension:?}");
    scene.elastic.layer = scene.elastic.layer.map(|layer| layer.with_body(CoatedBody::Ball));
    let (_, tension) = layer(&scene);
    assert!(tension.x < -0.9 * hertz.half_width_x, "{tension:?}");
}

/// The same pair with its bodies exchanged.
#[test]
fn coating_on_the_ball_is_that_on_the_disc_of_the_exchanged_pair() {
    let mut on_disc = scene("dry_wear.toml");
    on_disc.materials.ball = on_disc.materials.ball.with_modulus(Some(100e9)).with_hardness(None);
    on_disc.plastic = Some(PlasticSpec::new(6e9));
    let coating = LayerSpec::new(5e-6, 400e9, 0.25).with_hardness(Some(0.6e9));
    on_disc.elastic.layer = Some(coating);
    let mut on_ball = on_disc.clone();
    std::mem::swap(&mut on_ball.materials.ball, &mut on_ball.materials.disc);
    on_ball.elastic.layer = Some(coating.with_body(CoatedBody::Ball));
    let [on_disc, on_ball] = [on_disc, on_ball].map(|scene| solve_contact(&scene).unwrap());
    close("central pressure", on_ball.pressure.central, on_disc.pressure.central, 1e-9);
    // The coating yields at its own hardness.
    close("hardness", on_ball.pressure.max, 0.6e9, 1e-6);
    close("plastic area", on_ball.contact.plastic_area, on_disc.contact.plastic_area, 1e-9);
}

#[test]
fn hardness_of_a_coating_that_nothing_uses_is_refused() {
    let mut scene = scene("dry_wear.toml");
    scene.wear = None;
    scene.elastic.layer = Some(LayerSpec::new(5e-6, 400e9, 0.25).with_hardness(Some(20e9)));
    let error = solve_contact(&scene).unwrap_err().to_string();
    assert!(error.contains("elastic.layer.hardness = 2e10") && error.contains("[plastic]"), "{error}");
}
