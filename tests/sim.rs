//! The simulation: its account, its laws, its observer, and its errors.

#![expect(clippy::float_cmp, reason = "equal histories are equal to the last bit")]

use std::ops::ControlFlow;

use stribeck::elastic::{DeformationModel, HalfSpace};
use stribeck::lubricant::{Barus, Incompressible};
use stribeck::reynolds::{
    ContactSolver, ContactState, LubricatedContact, NewtonKrylov, ReynoldsError, StoppingRule,
};
use stribeck::sim::scene::{Flash, SolverKind};
use stribeck::sim::{MixedLubricationSim, RunEnd, Scene, Schedule, SimBuilder, SimError, StepRecord};
use stribeck::surface::AlongTrack;
use stribeck::wear::{Archard, WearLaw};
use stribeck::{Grid, InputError, SolveReport, SolverId, Status, SurfaceState};

fn scene() -> Scene {
    let mut scene = Scene::azam_2019(48).with_tribofilm();
    scene.solver.tolerance = 1e-4;
    scene
}

fn run(sim: &mut MixedLubricationSim, steps: u64, time_step: f64) -> Vec<StepRecord> {
    let mut records = Vec::new();
    let end = sim
        .run(steps, time_step, &mut |_: &MixedLubricationSim, record: &StepRecord| {
            records.push(record.clone());
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(end, RunEnd::Finished);
    records
}

#[test]
fn every_step_keeps_the_account_and_the_residuals() {
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    let mut last = [0.0; 3];
    let end = sim
        .run(6, 120.0, &mut |sim: &MixedLubricationSim, record: &StepRecord| {
            assert!(sim.ledger_residual().unwrap() < 1e-21, "account of step {}", record.step);
            assert!(record.report.residual.max() <= 1e-4, "{:?}", record.report);
            assert!(record.film.minimum_gap > 0.9e-9, "gap {}", record.film.minimum_gap);
            let now = [record.wear.ball_mean, record.wear.disc_mean, record.plastic.volume];
            assert!(now.iter().zip(&last).all(|(now, last)| now >= last), "{now:?} after {last:?}");
            last = now;
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(end, RunEnd::Finished);
    assert!((sim.time() - 720.0).abs() < 1e-9);
    // Load times sliding distance times specific rate, when all pressure wears and no film protects.
    let mut bare = scene();
    bare.tribofilm = None;
    let mut sim = MixedLubricationSim::builder(bare).build().unwrap();
    let records = run(&mut sim, 4, 100.0);
    // The middle of the track ages by the time of the test: the mean is that of a strip as long as the
    // contact.
    let area = 2.0 * sim.hertz().half_width_x * sim.grid().size_y();
    let expected = 5.45e-8 * sim.hertz().force * 0.005 * 400.0 / (6e9 * area);
    for wear in records[3].wear.mean() {
        assert!((wear / expected - 1.0).abs() < 1e-6, "{wear} instead of {expected}");
    }
}

#[test]
fn equal_seeds_give_equal_histories_and_others_do_not() {
    let history = |seed| {
        let mut sim = MixedLubricationSim::builder(scene()).motion(AlongTrack { seed }).build().unwrap();
        run(&mut sim, 2, 60.0)
    };
    assert_eq!(history(5), history(5));
    // The first contact is that of the scene, the second one elsewhere.
    assert_eq!(history(5)[0].film.mean_central, history(6)[0].film.mean_central);
    assert_ne!(history(5)[1].film.mean_central, history(6)[1].film.mean_central);
}

#[test]
fn the_observer_stops_the_run() {
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    let stop = &mut |_: &MixedLubricationSim, record: &StepRecord| {
        if record.step == 1 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    assert_eq!(sim.run(10, 10.0, stop).unwrap(), RunEnd::Stopped);
    assert_eq!(sim.steps(), 2);
}

#[test]
fn a_failed_step_changes_nothing() {
    let mut scene = scene();
    scene.solver.kind = SolverKind::NewtonKrylov;
    scene.solver.max_iterations = 1;
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let before = sim.bodies().clone();
    let error = sim.step(10.0).unwrap_err();
    assert!(matches!(error, SimError::NotConverged { step: 0, .. }), "{error}");
    assert_eq!((sim.time(), sim.steps()), (0.0, 0));
    for (body, old) in sim.bodies().iter().zip(&before) {
        assert_eq!(body.surface(), old.surface());
        assert_eq!(body.wear(), old.wear());
    }
}

/// A law that breaks its contract.
#[derive(Debug)]
struct Broken;

impl WearLaw for Broken {
    fn depth_rate(&self, _at: &SurfaceState, _film_thickness: f64) -> f64 {
        f64::NAN
    }
}

#[test]
fn a_broken_law_is_an_error_and_changes_nothing() {
    let mut sim = MixedLubricationSim::builder(scene()).wear_law(Broken).build().unwrap();
    let before = sim.bodies().clone();
    assert!(sim.step(10.0).is_err());
    for (body, old) in sim.bodies().iter().zip(&before) {
        assert_eq!(body.surface(), old.surface());
        assert_eq!(body.tribofilm(), old.tribofilm());
    }
}

/// Wear that ends where it is hot.
#[derive(Debug)]
struct Melting;

impl WearLaw for Melting {
    fn depth_rate(&self, at: &SurfaceState, _film_thickness: f64) -> f64 {
        if at.temperature > 380.0 { f64::NAN } else { 1e-13 }
    }
}

/// Newton's method, whose solutions are altered by their number and their load.
#[derive(Debug, Clone)]
struct Altered {
    newton: NewtonKrylov,
    solves: u32,
    alter: fn((u32, f64), &mut ContactState, &mut SolveReport),
}

impl Altered {
    fn by(alter: fn((u32, f64), &mut ContactState, &mut SolveReport)) -> Self {
        Self { newton: NewtonKrylov::new(), solves: 0, alter }
    }
}

impl ContactSolver for Altered {
    fn id(&self) -> SolverId {
        SolverId::Custom("altered")
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let mut report = self.newton.solve(problem, state, stop)?;
        self.solves += 1;
        (self.alter)((self.solves, problem.load), state, &mut report);
        Ok(report)
    }
}

/// Gives up above 50 N.
fn stubborn() -> Altered {
    Altered::by(|(_, load), _, report| {
        if load > 50.0 {
            report.status = Status::Stalled;
        }
    })
}

/// Leaves a state without numbers the second time.
fn stumbling() -> Altered {
    Altered::by(|(solves, _), state, report| {
        if solves == 2 {
            state.theta.fill(f64::NAN);
            report.status = Status::Diverged;
        }
    })
}

/// Reports convergence falsely: its pressures carry nine tenths of the load.
fn falsely_converging() -> Altered {
    Altered::by(|_, state, _| {
        state.pressure.iter_mut().chain(&mut state.fluid_pressure).for_each(|p| *p *= 0.9);
    })
}

/// With squeeze a solve starts from the state that it is given.
#[test]
fn another_position_is_tried_from_the_last_contact() {
    let solver = stumbling();
    let mut sim = MixedLubricationSim::builder(scene()).solver(solver).with_squeeze().build().unwrap();
    let records = run(&mut sim, 2, 10.0);
    assert_eq!((records[0].attempts, records[1].attempts), (1, 2));
}

#[test]
fn false_convergence_is_detected_and_changes_nothing() {
    let mut sim = MixedLubricationSim::builder(scene()).solver(falsely_converging()).build().unwrap();
    let before = sim.bodies().each_ref().map(|body| body.surface().to_vec());
    match sim.step(10.0) {
        Err(SimError::NotConverged { source, .. }) => {
            assert_eq!(source.report.status, Status::Unverified);
            assert!((source.report.residual.load - 0.1).abs() < 1e-4, "{source}");
        }
        other => panic!("{other:?}"),
    }
    let after = sim.bodies().each_ref().map(|body| body.surface().to_vec());
    assert_eq!((sim.steps(), after), (0, before));
    let single = MixedLubricationSim::builder(scene()).solver(falsely_converging()).solve().unwrap();
    assert_eq!(single.report.status, Status::Unverified);
    let honest = MixedLubricationSim::builder(scene()).solver(NewtonKrylov::new()).solve().unwrap();
    honest.report.require_converged().unwrap();
}

/// Everything that a checkpoint holds, positions drawn and masses squeezed included, and the conditions of
/// the contact: a step that fails after its solve leaves them, and so does one whose contact is not solved.
#[test]
fn a_failed_step_leaves_everything_as_it_was() {
    let mut hot = scene();
    hot.schedule.load = Some(Schedule::steps(&[(0.0, 40.0), (2.0, 54.0)]));
    hot.schedule.bulk_temperature = Some(Schedule::steps(&[(0.0, 353.15), (2.0, 400.0)]));
    let melting = MixedLubricationSim::builder(hot).wear_law(Melting).with_squeeze().build();
    let mut loaded = scene();
    loaded.schedule.load = Some(Schedule::steps(&[(0.0, 40.0), (2.0, 54.0)]));
    let stubborn = stubborn();
    let unsolved = MixedLubricationSim::builder(loaded).solver(stubborn).with_squeeze().build();
    let folder = tempfile::tempdir().unwrap();
    for (name, sim) in [("melting", melting), ("unsolved", unsolved)] {
        let mut sim = sim.unwrap();
        sim.step(1.0).unwrap();
        sim.step(1.0).unwrap();
        let all = |sim: &MixedLubricationSim| {
            let path = folder.path().join(name);
            sim.save(&path).unwrap();
            (std::fs::read(&path).unwrap(), sim.hertz(), sim.state().film.clone())
        };
        let before = all(&sim);
        let error = sim.step(1.0).unwrap_err().to_string();
        let after = all(&sim);
        assert!(before.0 == after.0 && before.1 == after.1 && before.2 == after.2, "{name}: {error}");
        assert_eq!(sim.step(1.0).unwrap_err().to_string(), error);
    }
}

#[test]
fn laws_of_the_user_take_the_place_of_the_scene() {
    let slow = Archard::new(5.45e-10, 5.45e-10, 1.0, 6e9).unwrap();
    let mut own = MixedLubricationSim::builder(scene()).wear_law(slow).build().unwrap();
    let mut usual = MixedLubricationSim::builder(scene()).build().unwrap();
    let (own, usual) = (&run(&mut own, 1, 10.0)[0], &run(&mut usual, 1, 10.0)[0]);
    assert!(own.wear.disc_mean < 0.02 * usual.wear.disc_mean);
    // The contact of the first step does not depend on wear.
    assert_eq!(own.pressure.max, usual.pressure.max);
}

#[test]
fn flash_temperature_is_left_out_where_its_estimate_is_negligible() {
    let mut scene = scene();
    let sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    assert!(!sim.models_flash_temperature(), "0.7 K at 5 mm/s sliding");
    assert!(sim.flash_estimate() > 0.5 && sim.flash_estimate() < 1.0, "{} K", sim.flash_estimate());
    scene.thermal.flash = Flash::On;
    let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let rise = run(&mut sim, 1, 10.0)[0].flash_rise.unwrap();
    assert!(rise > 0.3 && rise < 3.0, "rise {rise} K");
    scene.thermal.flash = Flash::Auto;
    scene.motion.slide_roll_ratio = 1.0;
    let sim = MixedLubricationSim::builder(scene).build().unwrap();
    assert!(sim.models_flash_temperature());
}

#[test]
fn heights_and_steps_that_do_not_fit_are_refused() {
    let error = MixedLubricationSim::builder(scene()).disc_heights(vec![0.0; 7]).build().unwrap_err();
    assert!(error.to_string().contains("disc_heights"), "{error}");
    let n = 48 * 48;
    let error = MixedLubricationSim::builder(scene()).ball_heights(vec![f64::NAN; n]).build().unwrap_err();
    assert!(error.to_string().contains("ball_heights[0]["), "{error}");
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(sim.step(bad).is_err(), "time step {bad}");
    }
}

/// A body that opens under pressure.
#[derive(Debug, Clone)]
struct Opening(HalfSpace);

impl DeformationModel for Opening {
    fn grid(&self) -> Grid {
        self.0.grid()
    }
    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.0.displacement(pressure, out)?;
        out.iter_mut().for_each(|u| *u = -*u);
        Ok(())
    }
    fn influence(&self, di: usize, dj: usize) -> f64 {
        -self.0.influence(di, dj)
    }
}

#[test]
fn parts_that_do_not_fit_are_named() {
    let refused = |builder: SimBuilder| match builder.build().unwrap_err() {
        SimError::Input(InputError::Conflict { field, reason }) => (field, reason),
        other => panic!("{other}"),
    };
    let body = |grid| HalfSpace::new(grid, 230e9).unwrap();
    let elsewhere = body(Grid::centred(8, 8, 1e-6, 1e-6).unwrap());
    let (field, reason) = refused(MixedLubricationSim::builder(scene()).deformation(elsewhere));
    assert_eq!(field, "deformation", "{reason}");
    let opening = Opening(body(scene().grid().unwrap()));
    let (field, reason) = refused(MixedLubricationSim::builder(scene()).deformation(opening));
    assert_eq!(field, "deformation", "{reason}");
    let mut dry = scene();
    dry.lubricant = None;
    let oil = Barus::new(0.01, 20e-9).unwrap();
    let (field, reason) = refused(MixedLubricationSim::builder(dry.clone()).viscosity(oil));
    assert_eq!(field, "viscosity", "{reason}");
    let (field, reason) = refused(MixedLubricationSim::builder(dry).density(Incompressible));
    assert_eq!(field, "density", "{reason}");
}
