//! Estimated errors of the steps of a history.

use stribeck::elastic::HalfSpace;
use stribeck::sim::scene::{GridSpec, TrackMotion};
use stribeck::sim::{MixedLubricationSim, Scene, StepRecord, solve_contact};

fn scene(cells: usize) -> Scene {
    let mut scene = Scene::azam_2019(cells).with_tribofilm();
    scene.motion.entrainment_speed = 0.2;
    scene.track.motion = TrackMotion::AtRest;
    scene.solver.estimate = true;
    scene
}

#[test]
fn errors_of_the_first_step_are_those_of_the_single_contact() {
    let scene = scene(48);
    let single = solve_contact(&scene).unwrap().error_estimate.unwrap();
    let step = MixedLubricationSim::builder(scene).build().unwrap().step(10.0).unwrap();
    let of_step = step.error_estimate.unwrap();
    assert!(single.film_mean_central > 0.01 && single.contact_load_ratio > 0.01, "{single:?}");
    for (one, other) in [
        (single.film_mean_central, of_step.film_mean_central),
        (single.contact_load_ratio, of_step.contact_load_ratio),
        (single.friction_coefficient, of_step.friction_coefficient),
        (single.film_by_box, of_step.film_by_box),
    ] {
        assert!((one / other - 1.0).abs() < 1e-3, "{single:?} {of_step:?}");
    }
}

#[test]
fn errors_follow_the_bodies_and_change_no_number() {
    let with = scene(32);
    let mut without = with.clone();
    without.solver.estimate = false;
    let [mut estimated, mut plain] =
        [with, without].map(|scene| MixedLubricationSim::builder(scene).build().unwrap());
    let mut errors = Vec::new();
    for _ in 0..3 {
        let (mut record, other) = (estimated.step(600.0).unwrap(), plain.step(600.0).unwrap());
        errors.push(record.error_estimate.take().unwrap().friction_coefficient);
        assert_eq!((record, other.error_estimate), (other, None));
    }
    assert!(errors[2] > 0.0 && errors[0].to_bits() != errors[2].to_bits(), "{errors:?}");
}

#[test]
fn errors_are_read_back_from_a_line_of_the_history() {
    let record = MixedLubricationSim::builder(scene(32)).build().unwrap().step(10.0).unwrap();
    let mut line = Vec::new();
    record.write_csv(&mut line).unwrap();
    let read = StepRecord::from_csv(String::from_utf8(line).unwrap().trim_end()).unwrap();
    assert_eq!(read.error_estimate, record.error_estimate);
    assert!(record.error_estimate.is_some());
}

#[test]
fn histories_that_have_no_coarser_mesh_are_refused() {
    let mut coarse = scene(32);
    let GridSpec::Cells { x, y, .. } = coarse.grid else { panic!("cells") };
    coarse.grid = GridSpec::Cells { nx: 8, ny: 32, x, y };
    let refused = |builder: stribeck::sim::SimBuilder| builder.build().unwrap_err().to_string();
    let error = refused(MixedLubricationSim::builder(coarse));
    assert!(error.starts_with("grid.nx = 8: solver.estimate needs at least 10 cells"), "{error}");
    let scene = scene(32);
    let bodies = HalfSpace::new(scene.grid().unwrap(), scene.equivalent_modulus().unwrap()).unwrap();
    let error = refused(MixedLubricationSim::builder(scene).deformation(bodies));
    assert!(error.starts_with("deformation: it is known on one grid"), "{error}");
}
