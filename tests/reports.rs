//! Solve reports: strategy and residual history.

use stribeck::reynolds::{ContactDefinition, NewtonKrylov, NewtonSettings};
use stribeck::sim::scene::{InletSpec, SolverKind};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, solve_contact};
use stribeck::{Status, Strategy};

fn smooth(cells: usize) -> Scene {
    let mut scene = Scene::azam_2019(cells);
    (scene.roughness, scene.plastic) = (Default::default(), None);
    scene.motion.entrainment_speed = 1.0;
    scene.lubricant.as_mut().unwrap().inlet = InletSpec::BoxEdge;
    scene
}

/// A single start, whose residuals come first, and those of each step.
#[test]
fn residual_history_holds_the_start_and_each_step() {
    for (kind, strategy) in [
        (SolverKind::NewtonKrylov, Some(Strategy::Attempt)),
        (SolverKind::SemiSystem, None),
        (SolverKind::Multigrid, None),
    ] {
        let mut scene = smooth(48);
        scene.solver.kind = kind;
        let report = solve_contact(&scene).unwrap().report;
        report.require_converged().unwrap();
        assert_eq!(report.strategy, strategy, "{kind:?}");
        assert_eq!(report.residual_history.len() as u64, report.work.iterations + 1, "{kind:?}");
        assert_eq!(report.residual_history.last(), Some(&report.residual), "{kind:?}");
        let start = report.residual_history.first().unwrap();
        assert!(start.max() > 1e3 * scene.solver.tolerance, "{kind:?}: {start:?}");
    }
}

/// Truncated sweeps of the unified Reynolds model: the best state need not be the last one.
#[test]
fn residual_history_of_sweeps_is_complete() {
    let mut scene = Scene::azam_2019(32);
    scene.solver.contact = ContactDefinition::UnifiedReynolds;
    scene.solver.kind = SolverKind::SemiSystem;
    scene.solver.max_iterations = 20;
    let report = solve_contact(&scene).unwrap().report;
    assert_eq!(report.residual_history.len(), 21);
    assert!(report.residual_history.contains(&report.residual), "{report:?}");
}

#[test]
fn dry_contact_has_no_residual_history() {
    let mut scene = smooth(32);
    scene.lubricant = None;
    let report = solve_contact(&scene).unwrap().report;
    report.require_converged().unwrap();
    assert!(report.residual_history.is_empty() && report.strategy.is_none(), "{report:?}");
}

fn newton(scene: Scene, change: fn(&mut NewtonSettings)) -> ContactSolution {
    let mut settings = NewtonSettings::default();
    change(&mut settings);
    let builder = MixedLubricationSim::builder(scene);
    let solution = builder.solver(NewtonKrylov::with_settings(settings).unwrap()).solve().unwrap();
    let report = &solution.report;
    assert!(report.residual_history.len() as u64 > report.work.iterations, "each start adds one");
    solution
}

fn converged(scene: Scene, change: fn(&mut NewtonSettings)) -> ContactSolution {
    let solution = newton(scene, change);
    solution.report.require_converged().unwrap();
    assert_eq!(solution.report.residual_history.last(), Some(&solution.report.residual));
    solution
}

/// The attempt starts at the contact film of the scene and cannot halve its residual in six steps.
fn stall(settings: &mut NewtonSettings) {
    (settings.first_contact_film, settings.stall_window) = (1.0, 6);
}

/// The attempt stalls with the contact film of the scene, but not with a thicker one, from which continuation
/// leads to the same solution.
#[test]
fn continuation_from_thicker_contact_films_solves_a_stalled_contact() {
    let led = converged(Scene::azam_2019(56), stall);
    assert_eq!(led.report.strategy, Some(Strategy::Continuation));
    assert_eq!(led.report.strategy.unwrap().to_string(), "continuation");
    let usual = converged(Scene::azam_2019(56), |_| ());
    assert_eq!(usual.report.strategy, Some(Strategy::Attempt));
    let same = |one: f64, other: f64| assert!((one - other).abs() < 1e-4 * other, "{one} and {other}");
    same(led.contact.load_ratio, usual.contact.load_ratio);
    same(led.film.mean_central, usual.film.mean_central);
    let stalls = newton(Scene::azam_2019(56), |settings| {
        stall(settings);
        settings.least_film_ratio = f64::INFINITY;
    });
    assert_eq!(stalls.report.status, Status::Stalled);
    assert_eq!(stalls.report.strategy, Some(Strategy::Attempt));
}
