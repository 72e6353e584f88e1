//! A clone of a simulation goes on as the original would, to the last bit, on any thread.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use stribeck::elastic::{DeformationModel, HalfSpace, LayeredHalfSpace, LineHalfSpace};
use stribeck::lubricant::Lubricant;
use stribeck::reynolds::{Auto, ContactSolver, Dry, Multigrid, NewtonKrylov, SemiSystem};
use stribeck::sim::scene::{ArchardSpec, Flash, Schedule, SolverKind, WearLawSpec, WearSpec};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, SimError, StepRecord};
use stribeck::surface::Advected;
use stribeck::wear::Archard;

/// Compiles for types that can be sent to another thread, shared among threads and cloned.
fn is_shared<T: Clone + Send + Sync + 'static>() {}

#[test]
fn parts_may_go_to_other_threads() {
    is_shared::<MixedLubricationSim>();
    is_shared::<Scene>();
    is_shared::<StepRecord>();
    is_shared::<ContactSolution>();
    is_shared::<Lubricant>();
    is_shared::<HalfSpace>();
    is_shared::<LineHalfSpace>();
    is_shared::<LayeredHalfSpace>();
    is_shared::<Auto>();
    is_shared::<NewtonKrylov>();
    is_shared::<Multigrid>();
    is_shared::<SemiSystem>();
    is_shared::<Dry>();
    fn is_sendable<T: Send + Sync + ?Sized>() {}
    is_sendable::<dyn DeformationModel>();
    is_sendable::<dyn ContactSolver>();
}

/// All that a record holds, to the last bit.
fn words(record: &StepRecord) -> String {
    let mut line = Vec::new();
    record.write_csv(&mut line).unwrap();
    format!("{record:?} {}", String::from_utf8(line).unwrap())
}

/// Records of two steps after a first one, of the original and of clones before and after each other.
fn assert_same_way(mut sim: MixedLubricationSim) {
    sim.step(30.0).unwrap();
    let steps = |mut sim: MixedLubricationSim| [30.0, 45.0].map(|time| words(&sim.step(time).unwrap()));
    let (first, second, shared) = (sim.clone(), sim.clone(), &sim);
    let elsewhere = std::thread::spawn(move || steps(first));
    let third = std::thread::scope(|scope| scope.spawn(|| steps(shared.clone())).join().unwrap());
    let expected = steps(sim);
    assert_eq!(elsewhere.join().unwrap(), expected);
    assert_eq!(steps(second), expected);
    assert_eq!(third, expected);
}

#[test]
fn clones_of_a_mixed_history_have_equal_steps() {
    let mut scene = Scene::azam_2019(24).with_tribofilm();
    scene.thermal.flash = Flash::On;
    scene.materials.disc.hardness = Some(5e9);
    scene.schedule.load = Some(Schedule::Ramps { times: vec![0.0, 200.0], values: vec![50.0, 60.0] });
    assert_same_way(MixedLubricationSim::builder(scene).build().unwrap());
}

#[test]
fn clones_with_custom_parts_have_equal_steps() {
    let scene = Scene::azam_2019(24);
    let model = HalfSpace::new(scene.grid().unwrap(), 200e9).unwrap();
    let law = Archard::new(1e-7, 1e-8, 2e-7, 6e9).unwrap();
    let builder = MixedLubricationSim::builder(scene).deformation(model).wear_law(law).motion(Advected);
    assert_same_way(builder.solver(NewtonKrylov::new()).with_squeeze().build().unwrap());
}

#[test]
fn clones_of_a_dry_contact_have_equal_steps() {
    let mut dry = Scene::azam_2019(24);
    (dry.lubricant, dry.solver.kind) = (None, SolverKind::Dry);
    assert_same_way(MixedLubricationSim::builder(dry).build().unwrap());
}

/// Changes of one of them do not affect the other.
#[test]
fn clones_are_independent() {
    let mut scene = Scene::azam_2019(16);
    let law = WearLawSpec::Archard(ArchardSpec { coefficient: 1e-6, ..ArchardSpec::default() });
    scene.wear = Some(WearSpec::azam_2019().with_law(law));
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    sim.step(30.0).unwrap();
    let (heights, time) = (sim.bodies()[1].surface().to_vec(), sim.time());
    let mut fork = sim.clone();
    fork.step(500.0).unwrap();
    assert!(sim.bodies()[1].surface() == heights && fork.bodies()[1].surface() != heights);
    assert!(sim.time().to_bits() == time.to_bits() && fork.steps() == sim.steps() + 1);
}

/// A clone hears the same interrupt, and one that has stopped stops no other.
#[test]
fn interrupts_are_heard_by_each_alone() {
    let stop = Arc::new(AtomicBool::new(false));
    let heard = Arc::clone(&stop);
    let builder = MixedLubricationSim::builder(Scene::azam_2019(16));
    let mut sim = builder.interrupt(move || heard.load(Ordering::Relaxed)).build().unwrap();
    let mut fork = sim.clone();
    stop.store(true, Ordering::Relaxed);
    assert!(matches!(fork.step(30.0), Err(SimError::Interrupted)));
    assert!(matches!(sim.step(30.0), Err(SimError::Interrupted)));
    stop.store(false, Ordering::Relaxed);
    assert_eq!(words(&sim.step(30.0).unwrap()), words(&fork.step(30.0).unwrap()));
}
