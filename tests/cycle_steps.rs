//! Contacts that follow another one in time.

use stribeck::SolverId;
use stribeck::sim::scene::{InletSpec, Load, Motion};
use stribeck::sim::{MixedLubricationSim, Scene};

/// The steady film stays as it is, whichever method solves it.
#[test]
fn next_step_of_a_full_film_is_solved_by_newtons_method() {
    let mut scene = Scene::azam_2019(72);
    (scene.roughness, scene.plastic) = (Default::default(), None);
    (scene.load, scene.motion) = (Load::hertz_pressure(0.5e9), Motion::new(5.0, 0.0));
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    let mut sim = MixedLubricationSim::builder(scene).with_squeeze().build().unwrap();
    let [first, second] = [sim.step(1e-4).unwrap(), sim.step(1e-4).unwrap()];
    assert_eq!((first.report.solver, second.report.solver), (SolverId::Multigrid, SolverId::NewtonKrylov));
    assert!((second.film.central / first.film.central - 1.0).abs() < 1e-5, "{first:?} {second:?}");
}
