//! Histories under changing conditions: schedules, their effect on steps and records, and their errors.
#![expect(clippy::float_cmp, reason = "equal histories are equal to the last bit")]

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use stribeck::plastic::ElasticPerfectlyPlastic;
use stribeck::sim::{
    Conditions, MixedLubricationSim, Scene, Schedule, StepControl, StepRecord, solve_contact,
};
use stribeck::surface::{Advected, Fixed};

fn scene() -> Scene {
    let mut scene = Scene::azam_2019(32).with_tribofilm();
    scene.solver.tolerance = 1e-4;
    scene
}

fn records(sim: &mut MixedLubricationSim, end: f64, control: &StepControl) -> Vec<StepRecord> {
    let mut records = Vec::new();
    sim.run_until(end, control, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        records.push(record.clone());
        ControlFlow::Continue(())
    })
    .unwrap();
    records
}

#[test]
fn a_schedule_of_the_scenes_own_values_changes_no_bit() {
    let load = scene().hertz().unwrap().force;
    let mut constant = scene();
    constant.load.hertz_pressure = None;
    constant.load.force = Some(load);
    let mut scheduled = constant.clone();
    scheduled.schedule.load = Some(Schedule::Constant { value: load });
    scheduled.schedule.entrainment_speed = Some(Schedule::ramps(&[(0.0, 0.1), (50.0, 0.1)]));
    scheduled.schedule.slide_roll_ratio = Some(Schedule::steps(&[(-1.0, 7.0), (0.0, 0.05)]));
    scheduled.schedule.bulk_temperature = Some(Schedule::Constant { value: 353.15 });
    let [plain, scheduled] = [constant, scheduled].map(|scene| {
        let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
        records(&mut sim, 60.0, &StepControl::fixed(25.0)).into_iter().take(2).collect::<Vec<_>>()
    });
    assert_eq!(plain, scheduled);
}

#[test]
fn records_hold_what_holds_at_their_time_and_no_step_crosses_an_entry() {
    let mut scene = scene();
    scene.schedule.load = Some(Schedule::steps(&[(0.0, 20.0), (25.0, 40.0), (50.0, 60.0)]));
    scene.schedule.entrainment_speed = Some(Schedule::ramps(&[(0.0, 0.1), (40.0, 0.3)]));
    scene.schedule.slide_roll_ratio = Some(Schedule::Constant { value: 0.5 });
    scene.schedule.bulk_temperature = Some(Schedule::ramps(&[(0.0, 350.0), (100.0, 400.0)]));
    let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let expected_steps = sim.steps_until(60.0, 10.0);
    let records = records(&mut sim, 60.0, &StepControl::fixed(10.0));
    assert_eq!(records.len() as u64, expected_steps);
    let starts: Vec<f64> = records.iter().map(|record| record.time - record.time_step).collect();
    for (start, expected) in starts.iter().zip([0.0, 10.0, 20.0, 25.0, 35.0, 40.0, 50.0]) {
        assert!((start - expected).abs() < 1e-12, "{starts:?}");
    }
    assert_eq!(records.len(), 7);
    let loads: Vec<f64> = records.iter().map(|record| record.load).collect();
    assert_eq!(loads, [20.0, 20.0, 20.0, 40.0, 40.0, 40.0, 60.0]);
    for (record, start) in records.iter().zip(starts) {
        let speed = 0.1 + 0.2 * (start / 40.0).min(1.0);
        assert!((record.motion.entrainment_speed - speed).abs() < 1e-12, "{record:?}");
        assert_eq!(record.motion.slide_roll_ratio, 0.5);
        assert!((record.bulk_temperature - (350.0 + 0.5 * start)).abs() < 1e-9, "{record:?}");
        assert!(record.report.residual.load <= 1e-4, "{record:?}");
    }
    // The load ratios are those of the load that holds: the pressures sum to it.
    let inside = sim.state().pressure.iter().sum::<f64>() * sim.grid().cell_area();
    let carried = inside + records[6].pressure.load_outside;
    assert!((carried / 60.0 - 1.0).abs() < 1.1e-4, "{carried}");
    assert!((sim.hertz().force - 60.0).abs() < 1e-9 && sim.conditions().load == 60.0);
    // The first contact is the one of the scene at the start.
    let mut fixed = MixedLubricationSim::builder(scene.clone()).motion(Fixed).build().unwrap();
    let first = fixed.step(1.0).unwrap();
    let single = solve_contact(&scene).unwrap();
    assert_eq!(first.contact.load_ratio, single.contact.load_ratio);
    assert_eq!((first.film.mean_central, first.load), (single.film.mean_central, 20.0));
}

/// A contact that is solved between two steps leaves the one of the last step as it was.
#[test]
fn a_question_leaves_the_contact_of_the_last_step() {
    let mut scene = scene();
    scene.schedule.load = Some(Schedule::steps(&[(0.0, 20.0), (10.0, 40.0)]));
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    sim.step(10.0).unwrap();
    let hertz = sim.hertz();
    let asked = sim.solve_under(&sim.conditions()).unwrap();
    assert!(asked.hertz.force > 39.0);
    assert_eq!(sim.hertz(), hertz);
}

#[test]
fn wear_follows_load_and_distance_of_the_schedule() {
    let mut scene = scene();
    scene.tribofilm = None;
    scene.schedule.load = Some(Schedule::steps(&[(0.0, 20.0), (30.0, 40.0)]));
    scene.schedule.slide_roll_ratio = Some(Schedule::steps(&[(0.0, 0.05), (15.0, 0.1)]));
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let half_width = sim.hertz().half_width_x;
    let records = records(&mut sim, 60.0, &StepControl::fixed(60.0));
    assert_eq!(records.len(), 3);
    // The box is met as rarely as the contact of the load that holds is shorter, which grows with the third
    // root.
    let work = 20.0 * 0.005 * 15.0 + 20.0 * 0.01 * 15.0 + 40.0 * 0.01 * 30.0 / 2.0_f64.cbrt();
    let expected = 5.45e-8 * work / (6e9 * 2.0 * half_width * sim.grid().size_y());
    for wear in records[2].wear.mean() {
        assert!((wear / expected - 1.0).abs() < 1e-4, "{wear} instead of {expected}");
    }
}

/// A body under a ramp of speed is carried as far as the integral of its speed.
#[test]
fn convected_roughness_moves_by_the_integral_of_the_speed() {
    let film = |ramp: bool| {
        let mut scene = scene();
        (scene.tribofilm, scene.wear, scene.plastic) = (None, None, None);
        let cell = scene.grid().unwrap().dx();
        let end = 20.0 * cell / 0.1;
        // Both end at 0.15 m/s; the first has come as far as 0.1 m/s would take it in this time.
        scene.motion.slide_roll_ratio = 0.0;
        let schedule = if ramp {
            Schedule::ramps(&[(0.0, 0.05), (end, 0.15)])
        } else {
            Schedule::steps(&[(0.0, 0.1), (0.9999999 * end, 0.15)])
        };
        scene.schedule.entrainment_speed = Some(schedule);
        let mut sim = MixedLubricationSim::builder(scene).motion(Advected).build().unwrap();
        sim.run(5, end / 4.0, &mut |_: &MixedLubricationSim, _: &StepRecord| ControlFlow::Continue(()))
            .unwrap();
        sim.state().film.clone()
    };
    let (ramp, steady) = (film(true), film(false));
    let largest = steady.iter().copied().fold(0.0, f64::max);
    let apart = ramp.iter().zip(&steady).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-6 * largest, "{apart} of {largest}");
}

#[test]
fn a_hotter_bulk_grows_film_faster() {
    let film = |temperature: f64| {
        let mut scene = scene();
        scene.schedule.bulk_temperature = Some(Schedule::steps(&[(0.0, 353.15), (10.0, temperature)]));
        let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
        records(&mut sim, 20.0, &StepControl::fixed(10.0)).pop().unwrap().tribofilm.disc_mean
    };
    let (hot, usual) = (film(450.0), film(353.15));
    assert!(hot > 1.05 * usual && hot < 1.3 * usual, "{hot} and {usual}");
}

#[test]
fn invalid_schedules_are_rejected_by_name() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = scene();
        change(&mut scene);
        let single = solve_contact(&scene).unwrap_err().to_string();
        let error = MixedLubricationSim::builder(scene).build().unwrap_err().to_string();
        assert_eq!(error, single);
        error
    };
    let load = |points: &[(f64, f64)]| {
        let schedule = Schedule::steps(points);
        refused(&|scene| scene.schedule.load = Some(schedule.clone()))
    };
    let error = load(&[(0.0, 20.0), (10.0, 30.0), (5.0, 40.0)]);
    assert!(error.contains("schedule.load.times[2] = 5") && error.contains("back in time"), "{error}");
    let error = load(&[(0.0, 20.0), (0.0, 30.0)]);
    assert!(error.contains("schedule.load.times[1] = 0"), "{error}");
    let error = load(&[(1.0, 20.0)]);
    assert!(
        error.contains("schedule.load.times[0] = 1") && error.contains("no value at the start"),
        "{error}"
    );
    let error = load(&[]);
    assert!(error.contains("schedule.load.times") && error.contains("no value at the start"), "{error}");
    let error = load(&[(0.0, 20.0), (10.0, -30.0)]);
    assert!(error.contains("schedule.load.values[1] = -30"), "{error}");
    let error = load(&[(0.0, 0.0)]);
    assert!(error.contains("schedule.load.values[0] = 0"), "{error}");
    let error = load(&[(0.0, 20.0), (f64::NAN, 30.0)]);
    assert!(error.contains("schedule.load.times[1] = NaN"), "{error}");
    let error = refused(&|scene| {
        scene.schedule.load = Some(Schedule::Ramps { times: vec![0.0, 1.0], values: vec![20.0] });
    });
    assert!(error.contains("schedule.load.values has 1 values, expected 2"), "{error}");
    let error = refused(&|scene| {
        scene.schedule.entrainment_speed = Some(Schedule::ramps(&[(0.0, 0.1), (9.0, 0.0)]));
    });
    assert!(error.contains("schedule.entrainment_speed.values[1] = 0"), "{error}");
    let error = refused(&|scene| {
        scene.schedule.slide_roll_ratio = Some(Schedule::Constant { value: f64::INFINITY });
    });
    assert!(error.contains("schedule.slide_roll_ratio.value = inf"), "{error}");
    let error = refused(&|scene| {
        scene.schedule.bulk_temperature = Some(Schedule::Constant { value: -3.0 });
    });
    assert!(error.contains("schedule.bulk_temperature = -3: -3 K is implausible"), "{error}");
}

/// Loads of the schedule after the start are those of a history alone: one of a contact between the nodes,
/// and one that the hardness does not carry.
#[test]
fn a_later_load_that_does_not_fit_is_refused_as_a_history_alone() {
    let mut scene = scene();
    (scene.load.hertz_pressure, scene.load.force) = (None, Some(20.0));
    let plain = solve_contact(&scene).unwrap();
    for (load, reason) in [(1e-9, "no node lies within"), (1e5, "plastic.hardness")] {
        scene.schedule.load = Some(Schedule::steps(&[(0.0, 20.0), (10.0, load)]));
        let builder = || MixedLubricationSim::builder(scene.clone());
        let [checked, built] =
            [builder().check().err(), builder().build().err()].map(|error| error.unwrap().to_string());
        assert!(checked == built && checked.contains(reason), "{checked}");
        builder().check_contact().unwrap();
        assert_eq!(solve_contact(&scene).unwrap().state, plain.state);
        // The hardness of the scene is none where another law takes its place.
        let hard = ElasticPerfectlyPlastic::uniform(1e15).unwrap();
        assert_eq!(builder().plasticity(hard).build().is_ok(), reason == "plastic.hardness");
    }
}

const HEAD: &str = "[form]\nkind = \"sphere\"\nradius = 9.525e-3\n[elastic]\nequivalent_modulus = 229.67e9\n\
    [load]\nforce = 20.0\n[motion]\nentrainment_speed = 0.1\n[grid]\nnx = 16\nny = 16\n\
    x = [-0.25e-3, 0.25e-3]\ny = [-0.25e-3, 0.25e-3]\n";

#[test]
fn schedules_of_files_are_read_and_written() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("speed.csv");
    std::fs::write(&table, "time_s, speed_m_s\n# a rig\n0, 0.1\n\n 10,0.3\n").unwrap();
    let file = folder.path().join("scene.toml");
    let text = format!(
        "{HEAD}[schedule.load]\nkind = \"steps\"\ntimes = [0, 5]\nvalues = [20.0, 40.0]\n\
         [schedule.entrainment_speed]\nkind = \"table\"\npath = \"speed.csv\"\n\
         [schedule.bulk_temperature]\nkind = \"constant\"\nvalue = 373.15\n"
    );
    std::fs::write(&file, &text).unwrap();
    let scene = Scene::load(&file).unwrap();
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    let now = scene.conditions(5.0).unwrap();
    assert_eq!((now.load, now.bulk_temperature), (40.0, 373.15));
    assert!((now.motion.entrainment_speed - 0.2).abs() < 1e-15);
    // A simulation holds the numbers: it is repeated without the table.
    let sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let numbers = Schedule::ramps(&[(0.0, 0.1), (10.0, 0.3)]);
    assert_eq!(sim.scene().schedule.entrainment_speed.as_ref().unwrap(), &numbers);
    assert_eq!(Scene::from_toml(&sim.scene().to_toml().unwrap()).unwrap(), *sim.scene());

    for (content, part) in
        [("0,0.1\n10\n", "line 2"), ("0,0.1\na,b\n", "`a,b`"), ("0,1,2\n", "line 1"), ("", "start")]
    {
        std::fs::write(&table, content).unwrap();
        let error = MixedLubricationSim::builder(scene.clone()).build().unwrap_err().to_string();
        assert!(error.contains("schedule.entrainment_speed") && error.contains(part), "{content}: {error}");
    }
    std::fs::remove_file(&table).unwrap();
    let error = MixedLubricationSim::builder(scene).build().unwrap_err().to_string();
    assert!(error.contains("schedule.entrainment_speed.path") && error.contains("speed.csv"), "{error}");

    for (broken, part) in [
        ("[schedule]\nspeed = 1\n", "speed"),
        ("[schedule.load]\nkind = \"steps\"\ntimes = [0.0]\n", "values"),
        ("[schedule.load]\nkind = \"constant\"\ntimes = [0.0]\n", "`times`"),
        ("[schedule.load]\nkind = \"waves\"\n", "schedule.load.kind"),
    ] {
        let error = Scene::from_toml(&format!("{HEAD}{broken}")).unwrap_err().to_string();
        assert!(error.contains(part) && error.contains("line"), "{error}");
    }
}

/// The scene and the steps of the example `running_in`: loads of 20, 40 and 60 N wear the peaks away, solids
/// carry less at the same speed, and friction falls by their share. In the mean over speeds: a single contact
/// may meet a peak that is left.
#[test]
#[ignore = "slow"]
fn running_in_lowers_friction_of_mixed_contacts() {
    let scene = Scene::from_toml(include_str!("../examples/scenes/running_in.toml")).unwrap();
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let sweep = |sim: &mut MixedLubricationSim| {
        [0.003, 0.01, 0.03].map(|speed| {
            let mut conditions = sim.conditions();
            (conditions.load, conditions.motion.entrainment_speed) = (20.0, speed);
            let solution = sim.solve_under(&conditions).unwrap();
            solution.report.require_converged().unwrap();
            assert!((solution.hertz.force / 20.0 - 1.0).abs() < 1e-12);
            let sum = solution.friction.boundary + solution.friction.fluid;
            assert!((sum / solution.friction.coefficient - 1.0).abs() < 1e-14);
            (solution.friction.coefficient, solution.contact.load_ratio)
        })
    };
    let new = sweep(&mut sim);
    // A look at the contact changes nothing.
    assert_eq!((sim.steps(), sim.conditions().load), (0, 20.0));
    assert_eq!(sweep(&mut sim), new);
    let records = records(&mut sim, 1800.0, &StepControl::new(20.0, 5e-9));
    let loads: BTreeSet<u64> = records.iter().map(|record| record.load as u64).collect();
    assert_eq!(loads, BTreeSet::from([20, 40, 60]));
    let worn = sweep(&mut sim);
    let mean = |sweep: [(f64, f64); 3]| {
        let sum = sweep.into_iter().reduce(|(a, b), (c, d)| (a + c, b + d)).unwrap();
        (sum.0 / 3.0, sum.1 / 3.0)
    };
    let (new, worn) = (mean(new), mean(worn));
    assert!(worn.0 < 0.99 * new.0 && worn.1 < 0.97 * new.1, "{worn:?} after {new:?}");
    assert_eq!(sim.conditions().load, 60.0);
}

#[test]
fn conditions_out_of_range_are_named() {
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    let mut refused = |change: &dyn Fn(&mut Conditions)| {
        let mut conditions = sim.conditions();
        change(&mut conditions);
        sim.solve_under(&conditions).unwrap_err().to_string()
    };
    assert!(refused(&|c| c.load = -1.0).starts_with("load = -1"));
    assert!(refused(&|c| c.load = 1e-9).contains("no node lies within"));
    assert!(refused(&|c| c.motion.entrainment_speed = 0.0).starts_with("entrainment_speed = 0"));
    assert!(refused(&|c| c.motion.slide_roll_ratio = f64::NAN).starts_with("slide_roll_ratio = NaN"));
    assert!(refused(&|c| c.bulk_temperature = 0.0).starts_with("bulk_temperature = 0"));
    assert!(scene().conditions(-1.0).unwrap_err().to_string().contains("time = -1"));
}
