//! Roughness in motion from a scene: means over a passage.

use std::ops::ControlFlow;

use stribeck::sim::scene::{GridSpec, Roughness, RoughnessState};
use stribeck::sim::{MixedLubricationSim, PassageSolution, Scene, SimError, StepRecord, solve_contact};
use stribeck::surface::{GrooveDirection, Texture};

const TOML: &str = "form = { kind = \"cylinder\", radius = 10e-3 }\nelastic.equivalent_modulus = 230e9\nload.hertz_pressure = 0.8e9\n\
     motion = { entrainment_speed = 3.0, slide_roll_ratio = 0.5, roughness = \"moving\" }\n[lubricant]\neta0 = 0.01\nalpha = 15e-9\n\
     roelands_z = 0.6\n[friction]\neyring_stress = 5e6\n[grid]\nnx = 96\nx = [-0.4e-3, 0.3e-3]";

fn rough() -> Scene {
    let mut scene = Scene::from_toml(TOML).unwrap();
    scene.roughness.ball = Roughness::gaussian(0.05e-6, 80e-6, 1);
    scene
}

/// Grooves across the flow in the box of 0.7 mm.
fn grooves(pitch: f64) -> Roughness {
    let direction = GrooveDirection::AlongY;
    Roughness::Texture(Texture::Grooves { width: 30e-6, depth: 0.05e-6, pitch, direction })
}

fn pass(scene: Scene) -> PassageSolution {
    let mut observer = |_: &MixedLubricationSim, _: &StepRecord| ControlFlow::Continue(());
    let solution = MixedLubricationSim::builder(scene).solve_passage(&mut observer).unwrap();
    assert_eq!(solution.ended_early, None);
    solution
}

#[test]
fn smooth_passage_has_the_film_of_the_steady_contact() {
    let mut scene = rough();
    scene.roughness = Default::default();
    let passage = pass(scene.clone());
    scene.motion.roughness = RoughnessState::AtRest;
    let steady = solve_contact(&scene).unwrap();
    let means = passage.means;
    for (scatter, value) in [
        (means.film_mean_central, steady.film.mean_central),
        (means.film_minimum, steady.film.minimum),
        (means.pressure_max, steady.pressure.max),
        (means.friction_coefficient, steady.friction.coefficient),
    ] {
        assert!((scatter.mean / value - 1.0).abs() < 1e-4, "{scatter:?}, {value:e}");
        assert!(scatter.standard_deviation < 1e-4 * value);
    }
}

/// Rough disc at rest under a sliding ball: nothing moves, so the passage is the steady contact.
#[test]
fn passage_over_roughness_at_rest_is_the_steady_contact() {
    let mut scene = rough();
    scene.roughness.disc = std::mem::take(&mut scene.roughness.ball);
    scene.motion.slide_roll_ratio = 2.0;
    let passage = pass(scene.clone());
    scene.motion.roughness = RoughnessState::AtRest;
    let steady = solve_contact(&scene).unwrap();
    let film = passage.means.film_mean_central;
    assert!(
        (film.mean / steady.film.mean_central - 1.0).abs() < 2e-3,
        "{film:?}, {:e}",
        steady.film.mean_central
    );
    assert!(film.standard_deviation < 1e-3 * film.mean, "{film:?}");
}

#[test]
fn steps_pass_a_cell_of_the_faster_surface() {
    let mut scene = rough();
    scene.motion.passage = Some(0.2e-3);
    let passage = pass(scene);
    let dx = passage.grid.dx();
    assert!((passage.time_step * 3.75 / dx - 1.0).abs() < 1e-12);
    assert_eq!(passage.passage().len(), (0.2e-3 / (dx * 3.0 / 3.75)).ceil() as usize);
    assert_eq!(passage.records.len(), passage.start_up + passage.passage().len());
    assert!(passage.start_up as f64 * passage.time_step * 3.0 > 0.4e-3 + passage.hertz.half_width_x);
    assert!(passage.means.film_mean_central.standard_deviation > 0.0);
}

/// Rows that are equal make a strip of a line.
#[test]
fn strip_of_equal_rows_has_the_passage_of_its_line() {
    let mut scene = rough();
    scene.motion.passage = Some(0.1e-3);
    let line = scene.grid().unwrap();
    let row = scene.roughness.ball.heights(&line).unwrap();
    scene.roughness = Default::default();
    let mut wide = scene.clone();
    wide.grid = GridSpec::Strip { nx: 96, ny: 6, x: [-0.4e-3, 0.3e-3], y: Some([-0.02e-3, 0.02e-3]) };
    let means = [(scene, row.clone()), (wide, row.repeat(6))].map(|(scene, heights)| {
        let mut observer = |_: &MixedLubricationSim, _: &StepRecord| ControlFlow::Continue(());
        let builder = MixedLubricationSim::builder(scene).ball_heights(heights);
        builder.solve_passage(&mut observer).unwrap().means
    });
    for value in [
        means.map(|means| means.film_mean_central.mean),
        means.map(|means| means.film_minimum.mean),
        means.map(|means| means.pressure_max.mean),
        means.map(|means| means.friction_coefficient.mean),
    ] {
        assert!((value[0] / value[1] - 1.0).abs() < 1e-3, "{value:?}");
    }
}

#[test]
fn scenes_that_cannot_move_are_refused_by_name() {
    type Change = fn(&mut Scene);
    let cases: [(Change, &str); 7] = [
        (|s| s.roughness.disc = grooves(49e-6), "roughness.disc.pitch = 4.9e-5"),
        (|s| s.lubricant = None, "dry"),
        (|s| s.grid = GridSpec::Accuracy { accuracy: 0.01 }, "[grid]"),
        (|s| s.solver.estimate = true, "solver.estimate"),
        (|s| s.solver.model = stribeck::sim::scene::SolverModel::AsperityInlets, "asperity_inlets"),
        (|s| s.motion.passage = Some(-1.0), "motion.passage = -1"),
        (|s| s.motion.passage = Some(1e9), "motion.passage = 1000000000"),
    ];
    for (change, word) in cases {
        let mut scene = rough();
        change(&mut scene);
        let mut observer = |_: &MixedLubricationSim, _: &StepRecord| ControlFlow::Continue(());
        let builder = || MixedLubricationSim::builder(scene.clone());
        let solved = builder().solve_passage(&mut observer).unwrap_err().to_string();
        let checked = builder().check_contact().unwrap_err().to_string();
        assert!(solved.contains(word) && solved == checked, "{word}: {solved}, {checked}");
    }
    let builder = || MixedLubricationSim::builder(rough());
    assert!(builder().check_contact().is_ok());
    let mut whole = rough();
    whole.roughness.disc = grooves(50e-6);
    assert!(MixedLubricationSim::builder(whole).check_contact().is_ok());
    let error = builder().build().unwrap_err().to_string();
    assert!(error.contains("track.motion"), "{error}");
    let stray = "form = { kind = \"sphere\", radius = 1.0 }\nload.force = 1\nelastic.equivalent_modulus = 1e9\n\
                 motion = { entrainment_speed = 1.0, passage = 1.0 }\ngrid.accuracy = 0.01";
    assert!(Scene::from_toml(stray).unwrap_err().to_string().contains("roughness = \"moving\""));
}

#[test]
fn solved_contact_has_the_means_of_its_passage() {
    let mut scene = rough();
    scene.motion.passage = Some(0.1e-3);
    let contact = solve_contact(&scene).unwrap();
    let means = pass(scene).means;
    for (value, scatter) in [
        (contact.film.mean_central, means.film_mean_central),
        (contact.film.minimum, means.film_minimum),
        (contact.pressure.max, means.pressure_max),
        (contact.friction.coefficient, means.friction_coefficient),
    ] {
        assert!((value / scatter.mean - 1.0).abs() < 1e-12, "{value:e}, {scatter:?}");
    }
}

/// Solids that reach the edge of the box end a passage, which keeps its contacts. As a single contact it is an error.
#[test]
fn solids_at_the_edge_of_the_box_end_a_passage_that_keeps_its_contacts() {
    let scene = Scene::from_toml(
        "form = { kind = \"cylinder\", radius = 5e-3 }\nelastic.equivalent_modulus = 230e9\nload.hertz_pressure = 1.2e9\n\
         motion = { entrainment_speed = 0.1, slide_roll_ratio = 0.25, roughness = \"moving\" }\n\
         lubricant = { eta0 = 0.003, alpha = 15e-9, roelands_z = 0.6 }\n\
         [grid]\nacross = \"periodic\"\nnx = 68\nny = 8\nx = [-0.25e-3, 0.175e-3]\ny = [-0.025e-3, 0.025e-3]\n\
         [roughness]\nball = { kind = \"gaussian\", rq = 0.3e-6, length_x = 25e-6, length_y = 25e-6, seed = 2 }\n\
         disc = { kind = \"gaussian\", rq = 0.3e-6, length_x = 25e-6, length_y = 25e-6, seed = 2 }\n",
    )
    .unwrap();
    let mut observer = |_: &MixedLubricationSim, _: &StepRecord| ControlFlow::Continue(());
    let passage = MixedLubricationSim::builder(scene.clone()).solve_passage(&mut observer).unwrap();
    let reason = passage.ended_early.unwrap();
    assert!(reason.contains("reaches the edge of the box") && reason.contains("take grid.x"), "{reason}");
    assert!(passage.start_up > 60 && passage.records.len() > passage.start_up + 20);
    assert!(passage.means.contact_load_ratio.mean > 0.05, "{:?}", passage.means);
    assert!(matches!(solve_contact(&scene), Err(SimError::BoxTooSmall(_))));
}
