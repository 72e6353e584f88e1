//! Checkpoints: a resumed run is the uninterrupted one to the last bit, whoever stopped it; files that do not
//! fit are refused.

#![expect(clippy::print_stdout, reason = "tests")]

use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::OnceLock;

use stribeck::elastic::HalfSpace;
use stribeck::sim::scene::{FilmElasticSpec, Flash, PlasticSpec};
use stribeck::sim::{
    CheckpointError, MixedLubricationSim, RunFolder, Scene, Schedule, SimBuilder, SimError, StepControl,
    StepRecord,
};
use stribeck::surface::{Advected, RandomShift};
use stribeck::tribochem::ThermalArrhenius;

fn scene() -> Scene {
    let mut scene = Scene::azam_2019(32).with_tribofilm();
    scene.solver.tolerance = 1e-3;
    scene
}

fn hardening() -> Scene {
    let mut scene = scene();
    scene.plastic =
        Some(PlasticSpec::new(4e9).with_film_hardness(Some(2e9)).with_hardening_modulus(Some(1e16)));
    scene
}

fn ignore(_: &MixedLubricationSim, _: &StepRecord) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Everything that can be seen of a simulation, bit by bit.
fn bits(sim: &MixedLubricationSim) -> Vec<u64> {
    let state = sim.state();
    let fields = sim.bodies().iter().flat_map(|body| {
        [body.surface(), body.wear(), body.plastic_depth(), body.tribofilm(), body.initial()]
    });
    let contact = [&state.pressure, &state.fluid_pressure, &state.film, &state.mass, &state.plastic_depth];
    let mut bits: Vec<u64> = fields.flatten().map(|value| value.to_bits()).collect();
    bits.extend(contact.into_iter().flatten().map(|value| value.to_bits()));
    bits.extend([sim.time().to_bits(), state.approach.to_bits(), sim.steps()]);
    bits
}

fn resumed_equals_uninterrupted(build: impl Fn() -> SimBuilder, time_step: f64) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let mut whole = build().build().unwrap();
    let mut first = build().build().unwrap();
    whole.run(5, time_step, &mut ignore).unwrap();
    first.run(2, time_step, &mut ignore).unwrap();
    first.save(&path).unwrap();
    drop(first);
    let mut second = build().build().unwrap();
    second.restore(&path).unwrap();
    assert_eq!(second.steps(), 2);
    second.run(3, time_step, &mut ignore).unwrap();
    assert!(bits(&second) == bits(&whole), "the resumed run differs");
}

#[test]
fn wear_history_with_film() {
    resumed_equals_uninterrupted(|| MixedLubricationSim::builder(scene()), 60.0);
}

#[test]
fn wear_history_with_a_compliant_film() {
    let mut soft = scene();
    soft.elastic.tribofilm = Some(FilmElasticSpec::new(30e9, 0.3));
    resumed_equals_uninterrupted(|| MixedLubricationSim::builder(soft.clone()), 60.0);
    (soft.lubricant, soft.solver.tolerance) = (None, 1e-6);
    resumed_equals_uninterrupted(|| MixedLubricationSim::builder(soft.clone()), 300.0);
}

#[test]
fn hardening_history() {
    resumed_equals_uninterrupted(
        || MixedLubricationSim::builder(hardening()).motion(RandomShift { seed: u64::MAX }),
        60.0,
    );
}

#[test]
fn squeezed_history_starts_from_its_last_contact() {
    // Each solve starts from the pressures before: they belong to the checkpoint.
    resumed_equals_uninterrupted(
        || MixedLubricationSim::builder(scene()).motion(Advected).with_squeeze(),
        3e-5,
    );
}

#[test]
fn a_dry_history_without_film_or_wear() {
    let mut dry = scene();
    (dry.lubricant, dry.tribofilm, dry.wear) = (None, None, None);
    resumed_equals_uninterrupted(|| MixedLubricationSim::builder(dry.clone()), 60.0);
}

/// Sums of steps of 0.1 s are rounded: their ends do not depend on where a run was stopped.
#[test]
fn a_run_to_a_time_and_on_takes_the_steps_of_one_run() {
    let mut dry = scene();
    dry.lubricant = None;
    let [mut whole, mut parts] = [0, 1].map(|_| MixedLubricationSim::builder(dry.clone()).build().unwrap());
    let control = StepControl::fixed(0.1);
    whole.run_until(0.5, &control, &mut ignore).unwrap();
    for end in [0.3, 0.5] {
        parts.run_until(end, &control, &mut ignore).unwrap();
    }
    assert!(bits(&parts) == bits(&whole), "{} {}", parts.time(), whole.time());
}

#[test]
fn a_resumed_run_ends_at_its_time_with_another_step() {
    let mut dry = scene();
    dry.lubricant = None;
    let build = || MixedLubricationSim::builder(dry.clone()).build().unwrap();
    let mut first = build();
    first.run_until(60.0, &StepControl::fixed(20.0), &mut ignore).unwrap();
    let mut second = build();
    second.restore_checkpoint(&first.checkpoint().unwrap()).unwrap();
    assert_eq!(second.steps_until(125.0, 25.0), 3);
    second.run_until(125.0, &StepControl::fixed(25.0), &mut ignore).unwrap();
    assert_eq!((second.steps(), second.time()), (6, 125.0));
    let error = second.run_until(130.0, &StepControl::fixed(1e-15), &mut ignore).unwrap_err();
    assert!(error.to_string().starts_with("time_step = 1e-15: must be longer"), "{error}");
}

#[test]
fn a_file_named_as_the_lock_keeps_its_content() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("lock"), "mine").unwrap();
    let sim = MixedLubricationSim::builder(scene()).build().unwrap();
    drop(RunFolder::create(folder.path(), &sim, 1).unwrap());
    assert_eq!(fs::read_to_string(folder.path().join("lock")).unwrap(), "mine");
}

#[test]
fn files_that_do_not_fit_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let build = |scene: Scene| MixedLubricationSim::builder(scene).build().unwrap();
    let mut sim = build(scene());
    sim.step(10.0).unwrap();
    sim.save(&path).unwrap();
    let good = fs::read(&path).unwrap();

    let mut fresh = build(scene());
    let before = bits(&fresh);
    let mut refuse = |bytes: &[u8]| {
        fs::write(&path, bytes).unwrap();
        let error = fresh.restore(&path).unwrap_err();
        assert!(bits(&fresh) == before, "a refused file changed the simulation");
        error
    };
    assert!(matches!(refuse(b""), CheckpointError::Foreign { .. }));
    assert!(matches!(refuse(b"step,time_s\n1,2\n"), CheckpointError::Foreign { .. }));
    let mut other_format = good.clone();
    other_format[20] = 10;
    let error = refuse(&other_format);
    assert!(matches!(error, CheckpointError::Newer { found: 10, known: 9, .. }), "{error}");
    other_format[20] = 8;
    let error = refuse(&other_format);
    assert!(matches!(error, CheckpointError::Damaged { .. }), "{error}");
    // Cut short anywhere, or a byte changed anywhere.
    for length in [20, 30, 36, 37, good.len() / 2, good.len() - 1] {
        let error = refuse(&good[..length]);
        assert!(matches!(error, CheckpointError::Damaged { .. }), "{length} bytes: {error}");
    }
    for position in (0..good.len()).step_by(good.len() / 97) {
        let mut changed = good.clone();
        changed[position] ^= 0x10;
        refuse(&changed);
    }
    let mut longer = good.clone();
    longer.push(0);
    assert!(matches!(refuse(&longer), CheckpointError::Damaged { .. }));
    fs::remove_file(&path).unwrap();
    assert!(matches!(fresh.restore(&path).unwrap_err(), CheckpointError::Io { .. }));

    fs::write(&path, &good).unwrap();
    let part = |builder: SimBuilder| match builder.build().unwrap().restore(&path).unwrap_err() {
        CheckpointError::Other { part, .. } => part,
        other => panic!("{other}"),
    };
    let mut other = scene();
    other.load.hertz_pressure = Some(1.1500000000000002e9);
    assert_eq!(part(MixedLubricationSim::builder(other)), "scene.load");
    let motion = RandomShift { seed: 1 };
    assert_eq!(part(MixedLubricationSim::builder(scene()).motion(motion)), "motion");
    let law = ThermalArrhenius::new(100e-9, 1e-3, 0.1).unwrap();
    let parts = part(MixedLubricationSim::builder(scene()).growth_law(law));
    assert_eq!(parts, "growth law");
    let stiffer = HalfSpace::new(scene().grid().unwrap(), 230e9).unwrap();
    assert_eq!(part(MixedLubricationSim::builder(scene()).deformation(stiffer)), "deformation model");
    let heights = vec![1e-9; 32 * 32];
    assert_eq!(part(MixedLubricationSim::builder(scene()).ball_heights(heights)), "ball_heights");
}

/// The files below `folder`; those that vanish meanwhile are left out.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(current) = folders.pop() {
        for path in fs::read_dir(current).into_iter().flatten().flatten().map(|entry| entry.path()) {
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// The files below `folder` with their contents.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let relative = |path: &Path| path.strip_prefix(folder).unwrap().to_owned();
    files(folder).iter().map(|path| (relative(path), fs::read(path).unwrap())).collect()
}

/// Whether a file below `folder` is being written, or was when the process ended.
fn is_writing(folder: &Path) -> bool {
    files(folder).iter().any(|path| path.extension().is_some_and(|end| end == "partial"))
}

#[test]
fn folder_of_a_run() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, parts) = (folder.path().join("whole"), folder.path().join("parts"));
    let build = || MixedLubricationSim::builder(scene()).build().unwrap();
    let mut sim = build();
    let mut files = RunFolder::create(&whole, &sim, 2).unwrap();
    let mut seen = Vec::new();
    sim.run(5, 10.0, &mut |sim: &MixedLubricationSim, record: &StepRecord| {
        seen.push(as_a_line(record));
        stribeck::sim::Observer::after_step(&mut files, sim, record)
    })
    .unwrap();
    files.finish(&sim).unwrap();

    let mut sim = build();
    let mut files = RunFolder::create(&parts, &sim, 2).unwrap();
    sim.run(3, 10.0, &mut files).unwrap();
    // One run at a time writes into a folder.
    for second in
        [RunFolder::create(&parts, &sim, 2), RunFolder::resume(&parts, &mut build(), 2).map(|run| run.0)]
    {
        let message = second.unwrap_err().to_string();
        assert!(message.contains("parts: another run writes into this folder"), "{message}");
    }
    drop(files);
    // A kill leaves part of a line.
    let mut history = fs::read(parts.join("history.csv")).unwrap();
    history.extend_from_slice(b"3,4e1,1e1,9.");
    fs::write(parts.join("history.csv"), history).unwrap();
    fs::write(parts.join("checkpoint.partial"), b"half").unwrap();
    let mut sim = build();
    let (mut files, records) = RunFolder::resume(&parts, &mut sim, 2).unwrap();
    assert_eq!(records, seen[..2]);
    sim.run(3, 10.0, &mut files).unwrap();
    files.finish(&sim).unwrap();
    assert_eq!(contents(&parts), contents(&whole));

    // A finished run is as it was when it is resumed once more.
    let mut sim = build();
    let (files, records) = RunFolder::resume(&parts, &mut sim, 2).unwrap();
    assert_eq!(records, seen);
    files.finish(&sim).unwrap();
    assert_eq!(contents(&parts), contents(&whole));

    // The folder alone repeats the run.
    let scene = Scene::load(parts.join("scene.toml")).unwrap();
    assert_eq!(&scene, sim.scene());
    let run = fs::read_to_string(parts.join("run.toml")).unwrap();
    assert!(run.contains(env!("CARGO_PKG_VERSION")) && run.contains("AlongTrack { seed: 0 }"), "{run}");

    // A history that does not reach the checkpoint.
    fs::write(parts.join("history.csv"), format!("{}\n", StepRecord::csv_header())).unwrap();
    let error = RunFolder::resume(&parts, &mut build(), 2).unwrap_err();
    assert!(matches!(error, SimError::Input(_)) && error.to_string().contains("history.csv"), "{error}");
}

/// The record without the values that no line has.
fn as_a_line(record: &StepRecord) -> StepRecord {
    let mut record = record.clone();
    record.report.strategy = None;
    record.report.residual_history.clear();
    record
}

#[test]
fn a_line_of_the_history_is_read_to_the_last_bit() {
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    let record = sim.step(7.3).unwrap();
    let mut line = Vec::new();
    record.write_csv(&mut line).unwrap();
    let line = String::from_utf8(line).unwrap();
    assert_eq!(StepRecord::from_csv(&line).unwrap(), as_a_line(&record));
    for broken in ["", "1,2", &line[1..], &line.replace("converged", "fine"), &format!("{},7", line.trim())] {
        assert!(StepRecord::from_csv(broken).is_err(), "{broken}");
    }
}

fn program() -> &'static Path {
    static PROGRAM: OnceLock<PathBuf> = OnceLock::new();
    PROGRAM.get_or_init(|| crate::common::example("mtm_zddp"))
}

/// Cells along each side and steps of the runs that are killed.
#[derive(Clone, Copy)]
struct Size {
    grid: &'static str,
    steps: &'static str,
}

/// Steps of some hundredths of a second, a checkpoint after each.
const SMALL: Size = Size { grid: "32", steps: "30" };
/// Nodes enough for two threads to share the lines of the transforms.
const SHARED: Size = Size { grid: "192", steps: "2" };

fn start(out: &Path, size: Size, threads: &str) -> Child {
    Command::new(program())
        .args(["--grid", size.grid, "--steps", size.steps, "--checkpoint", "1", "--resume", "--out"])
        .arg(out)
        .env("RAYON_NUM_THREADS", threads)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Numbers from 0 to 1, the same in every run of the tests.
struct Random(u64);

impl Random {
    fn share(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Runs that are killed (SIGKILL) at random moments, once to three times each, and resumed with another
/// number of threads end with the files of one that is not killed, byte by byte.
fn killed_runs(ends: usize, files: usize, start: impl Fn(&Path, &str) -> Child) {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    let begin = std::time::Instant::now();
    assert!(start(&whole, "1").wait().unwrap().success());
    let length = begin.elapsed();
    let expected = contents(&whole);
    assert!(expected.len() >= files, "{} files", expected.len());
    let mut random = Random(0x2545_f491_4f6c_dd1d);
    let (mut same, mut kills, mut half_written) = (0, 0, 0);
    while same < ends {
        let out = folder.path().join("killed");
        let wanted = 1 + (3.0 * random.share()) as usize;
        let mut hits = 0;
        loop {
            let mut child = start(&out, if (same + hits) % 2 == 0 { "1" } else { "2" });
            if hits < wanted {
                std::thread::sleep(length.mul_f64(0.9 * random.share()));
                // The first kill of every second run waits for a file to be written; later ones may find files
                // of an earlier one.
                let waits = hits == 0 && same % 2 == 1;
                while waits && !is_writing(&out) && child.try_wait().unwrap().is_none() {}
                if child.try_wait().unwrap().is_none() {
                    child.kill().unwrap();
                    child.wait().unwrap();
                    half_written += usize::from(hits == 0 && is_writing(&out));
                    hits += 1;
                    continue;
                }
            }
            assert!(child.wait().unwrap().success(), "run {same} fails after {hits} kills");
            break;
        }
        for (path, bytes) in contents(&out) {
            let whole = expected.iter().find(|(name, _)| *name == path);
            assert!(whole.is_some_and(|(_, whole)| *whole == bytes), "{} differs", path.display());
        }
        assert!(expected.iter().all(|(name, _)| out.join(name).exists()), "a file is missing");
        fs::remove_dir_all(&out).unwrap();
        kills += hits;
        same += usize::from(hits > 0);
    }
    println!(
        "{same} identical ends after {kills} kills, {half_written} or more of them while a file was written, of runs of {length:.1?}"
    );
}

fn killed_examples(ends: usize, size: Size) {
    // Built before the clock starts: the length of a run is when the others are killed.
    let _ = program();
    killed_runs(ends, 18, |out, threads| start(out, size, threads));
}

/// Where the process that is killed keeps its run.
const FOLDER: &str = "STRIBECK_TEST_FOLDER";

#[test]
#[ignore = "the process that another test starts and kills"]
fn scheduled_run_in_a_process_of_its_own() {
    let Some(out) = std::env::var_os(FOLDER) else { return };
    let mut sim = MixedLubricationSim::builder(scheduled()).build().unwrap();
    let (mut files, _) = RunFolder::resume(PathBuf::from(out), &mut sim, 1).unwrap();
    sim.run_until(200.0, &StepControl::new(8.0, 20e-9), &mut files).unwrap();
    files.finish(&sim).unwrap();
}

#[test]
#[ignore = "slow"]
fn killed_scheduled_runs_end_as_uninterrupted_ones() {
    killed_runs(3, 5, |out, threads| {
        Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "--ignored", "resume::scheduled_run_in_a_process_of_its_own"])
            .env(FOLDER, out)
            .env("RAYON_NUM_THREADS", threads)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap()
    });
}

#[test]
fn killed_runs_end_as_uninterrupted_ones() {
    killed_examples(2, SMALL);
}

#[test]
#[ignore = "takes minutes"]
fn fifty_killed_runs() {
    killed_examples(50, SMALL);
}

#[test]
#[ignore = "takes minutes"]
fn killed_runs_of_shared_lines() {
    killed_examples(6, SHARED);
}

/// Loads in steps, speeds on ramps, so that the last step before the checkpoint and the first after it meet
/// other conditions.
fn scheduled() -> Scene {
    let mut scene = scene();
    scene.schedule.load = Some(Schedule::steps(&[(0.0, 30.0), (60.0, 40.0), (150.0, 50.0)]));
    scene.schedule.entrainment_speed = Some(Schedule::ramps(&[(0.0, 0.1), (200.0, 0.4)]));
    scene.schedule.slide_roll_ratio = Some(Schedule::ramps(&[(0.0, 0.05), (300.0, 0.5)]));
    scene.schedule.bulk_temperature = Some(Schedule::ramps(&[(0.0, 353.0), (300.0, 383.0)]));
    scene.thermal.flash = Flash::On;
    scene
}

/// Warnings of the first contact are those of the whole run, each once.
#[test]
fn warnings_are_those_of_the_whole_run() {
    let mut scene = scene();
    (scene.motion.slide_roll_ratio, scene.friction.limiting_shear_stress) = (1.0, 1e9);
    let build = || MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let mut sim = build();
    let known = sim.warnings().len();
    sim.step(60.0).unwrap();
    assert!(sim.warnings().len() > known, "{:?}", sim.warnings());
    let mut resumed = build();
    resumed.restore_checkpoint(&sim.checkpoint().unwrap()).unwrap();
    resumed.step(60.0).unwrap();
    assert_eq!(resumed.warnings(), sim.warnings());
}

#[test]
fn scheduled_history() {
    resumed_equals_uninterrupted(|| MixedLubricationSim::builder(scheduled()), 60.0);
    resumed_equals_uninterrupted(
        || MixedLubricationSim::builder(scheduled()).motion(Advected).with_squeeze(),
        0.01,
    );
}

#[test]
#[ignore = "slow"]
fn scheduled_runs_that_are_stopped_end_as_uninterrupted_ones() {
    let folder = tempfile::tempdir().unwrap();
    let (whole, parts) = (folder.path().join("whole"), folder.path().join("parts"));
    let control = StepControl::new(40.0, 20e-9);
    let build = || MixedLubricationSim::builder(scheduled()).build().unwrap();
    let mut sim = build();
    let mut files = RunFolder::create(&whole, &sim, 1).unwrap();
    sim.run_until(200.0, &control, &mut files).unwrap();
    files.finish(&sim).unwrap();
    // Stopped after each step in turn, on both sides of the entries of the schedules.
    for stop in 1..sim.steps() {
        let mut sim = build();
        let mut files = RunFolder::create(&parts, &sim, 1).unwrap();
        let _ = sim.run_until(200.0, &control, &mut |sim: &MixedLubricationSim, record: &StepRecord| {
            let written = stribeck::sim::Observer::after_step(&mut files, sim, record);
            if sim.steps() == stop { ControlFlow::Break(()) } else { written }
        });
        drop(files);
        let mut sim = build();
        let (mut files, records) = RunFolder::resume(&parts, &mut sim, 1).unwrap();
        assert_eq!(records.len() as u64, stop);
        sim.run_until(200.0, &control, &mut files).unwrap();
        files.finish(&sim).unwrap();
        assert_eq!(contents(&parts), contents(&whole), "stopped after {stop} steps");
    }
}

#[test]
fn run_resumes_under_other_conditions_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("checkpoint");
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    sim.step(60.0).unwrap();
    sim.save(&path).unwrap();
    let mut other = scheduled();
    other.lubricant.as_mut().unwrap().eta0 = 0.008;
    let mut under = MixedLubricationSim::builder(other).build().unwrap();
    let before = bits(&under);
    let names = ["scene.lubricant", "scene.schedule", "scene.thermal"];
    match under.restore(&path).unwrap_err() {
        CheckpointError::Other { part, .. } => assert_eq!(part, names.join(", ")),
        error => panic!("{error}"),
    }
    assert!(bits(&under) == before);
    assert_eq!(under.restore_under_other_conditions(&path).unwrap(), names);
    assert!(bits(&under) == bits(&sim));
    let record = under.step(60.0).unwrap();
    assert_eq!((record.time, record.load, record.step), (120.0, 40.0, 1));
    assert!((record.motion.entrainment_speed - 0.19).abs() < 1e-12, "{record:?}");

    // Other parts are rejected, with the names of all that differ.
    let mut other = scheduled();
    other.plastic.as_mut().unwrap().hardness = 5e9;
    let mut harder = MixedLubricationSim::builder(other).build().unwrap();
    let before = bits(&harder);
    match harder.restore_under_other_conditions(&path).unwrap_err() {
        CheckpointError::Other { part, .. } => {
            assert_eq!(part, "scene.plastic, scene.schedule, scene.thermal");
        }
        error => panic!("{error}"),
    }
    assert!(bits(&harder) == before);
}
