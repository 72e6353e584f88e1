//! Histories whose films have a temperature of their own.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use stribeck::sim::scene::{Flash, PlasticSpec};
use stribeck::sim::{
    MixedLubricationSim, RunFolder, Scene, Schedule, SimBuilder, SimError, StepRecord, solve_contact,
};
use stribeck::surface::{Advected, Fixed};
use stribeck::thermal::FilmThermal;

const BULK: f64 = 353.15;

/// Rough surfaces that solids and oil carry, with everything that changes them.
fn scene() -> Scene {
    let mut scene = Scene::azam_2019(32).with_tribofilm();
    scene.solver.tolerance = 1e-4;
    scene.motion.entrainment_speed = 1.0;
    scene.motion.slide_roll_ratio = 1.0;
    scene.friction.eyring_stress = Some(5e6);
    scene.thermal.bulk_temperature = BULK;
    let oil = scene.lubricant.as_mut().unwrap();
    (oil.temperature, oil.roelands_s0) = (Some(BULK), Some(1.1));
    oil.thermal = Some(FilmThermal::default());
    scene
}

/// Everything that can be seen of a simulation, bit by bit.
fn bits(sim: &MixedLubricationSim) -> Vec<u64> {
    let state = sim.state();
    let fields = sim
        .bodies()
        .iter()
        .flat_map(|body| [body.surface(), body.wear(), body.plastic_depth(), body.tribofilm()]);
    let contact = [&state.pressure, &state.fluid_pressure, &state.film, &state.mass];
    let values = fields.flatten().chain(contact.into_iter().flatten()).chain([&state.approach]);
    let mut bits: Vec<u64> = values.map(|value| value.to_bits()).collect();
    bits.extend([sim.time().to_bits(), sim.steps()]);
    bits
}

#[test]
fn the_first_contact_is_that_of_a_single_one() {
    let single = solve_contact(&scene()).unwrap();
    let mut sim = MixedLubricationSim::builder(scene()).build().unwrap();
    let standing = sim.solve_under(&sim.conditions()).unwrap();
    let record = sim.step(10.0).unwrap();
    let (numbers, heat) = (single.thermal.as_ref().unwrap(), record.thermal.unwrap());
    assert_eq!(sim.state().pressure, single.state.pressure);
    assert_eq!(standing.state.pressure, single.state.pressure);
    assert_eq!(standing.thermal.unwrap(), *numbers);
    assert_eq!(heat, *numbers);
    let recorded = [record.friction.coefficient, record.film.mean_central];
    let solved = [single.friction.coefficient, single.film.mean_central];
    assert_eq!(recorded.map(f64::to_bits), solved.map(f64::to_bits));
    assert!(heat.solves > 1 && heat.film_temperature_max > BULK + 10.0, "{heat:?}");
    // A look at other conditions changes no later step.
    let mut other = MixedLubricationSim::builder(scene()).build().unwrap();
    let _ = other.step(10.0).unwrap();
    let mut fast = other.conditions();
    fast.motion.entrainment_speed = 3.0;
    fast.bulk_temperature += 10.0;
    let _ = other.solve_under(&fast).unwrap();
    assert_eq!(other.step(10.0).unwrap(), sim.step(10.0).unwrap());
    assert_eq!(bits(&other), bits(&sim));
}

#[test]
#[ignore = "slow"]
fn a_resumed_history_is_the_uninterrupted_one() {
    let hardening = || {
        let mut scene = scene();
        scene.plastic =
            Some(PlasticSpec::new(4e9).with_film_hardness(Some(2e9)).with_hardening_modulus(Some(1e16)));
        MixedLubricationSim::builder(scene)
    };
    let warming = || {
        let mut scene = scene();
        scene.schedule.bulk_temperature = Some(Schedule::ramps(&[(0.0, BULK), (40.0, BULK + 20.0)]));
        MixedLubricationSim::builder(scene)
    };
    let squeezed = || MixedLubricationSim::builder(scene()).motion(Advected).with_squeeze();
    for (build, time_step) in
        [(&hardening as &dyn Fn() -> SimBuilder, 10.0), (&warming, 10.0), (&squeezed, 1.56e-5)]
    {
        let mut whole = build().build().unwrap();
        let _ = whole.step(time_step).unwrap();
        let _ = whole.step(time_step).unwrap();
        let bytes = whole.checkpoint().unwrap();
        let records = [whole.step(time_step).unwrap(), whole.step(time_step).unwrap()];
        let mut resumed = build().build().unwrap();
        resumed.restore_checkpoint(&bytes).unwrap();
        assert_eq!([resumed.step(time_step).unwrap(), resumed.step(time_step).unwrap()], records);
        assert_eq!(bits(&resumed), bits(&whole));
        assert!(records.iter().all(|record| record.thermal.unwrap().change <= 5e-3));
    }
}

#[test]
fn a_killed_run_leaves_the_files_of_the_whole_one() {
    let folder = tempfile::tempdir().unwrap();
    let build = || MixedLubricationSim::builder(scene()).build().unwrap();
    let read = |name: &str, file: &str| std::fs::read(folder.path().join(name).join(file)).unwrap();
    let mut sim = build();
    let mut files = RunFolder::create(folder.path().join("whole"), &sim, 2).unwrap();
    sim.run(4, 10.0, &mut files).unwrap();
    files.finish(&sim).unwrap();
    let mut sim = build();
    let mut files = RunFolder::create(folder.path().join("parts"), &sim, 2).unwrap();
    sim.run(3, 10.0, &mut files).unwrap();
    drop(files);
    let mut sim = build();
    let (mut files, records) = RunFolder::resume(folder.path().join("parts"), &mut sim, 2).unwrap();
    assert_eq!(records.len(), 2);
    sim.run(2, 10.0, &mut files).unwrap();
    files.finish(&sim).unwrap();
    for file in ["history.csv", "checkpoint"] {
        assert_eq!(read("parts", file), read("whole", file), "{file}");
    }
    let history = String::from_utf8(read("whole", "history.csv")).unwrap();
    let record = StepRecord::from_csv(history.lines().nth(1).unwrap()).unwrap();
    assert_eq!(record.thermal, records[0].thermal);
    assert!(record.thermal.is_some());
}

#[test]
fn a_step_that_ends_early_leaves_everything_as_it_was() {
    let asked = Arc::new(AtomicU32::new(0));
    let seen = Arc::clone(&asked);
    // Ends the solve in its hundred and fiftieth iteration, once.
    let stop = move || seen.fetch_add(1, Ordering::Relaxed) == 150;
    let mut sim = MixedLubricationSim::builder(scene()).interrupt(stop).build().unwrap();
    let mut whole = MixedLubricationSim::builder(scene()).build().unwrap();
    let mut ended = 0;
    for _ in 0..6 {
        let before = bits(&sim);
        let record = match sim.step(10.0) {
            Ok(record) => record,
            Err(error) => {
                assert!(matches!(error, SimError::Interrupted), "{error}");
                assert_eq!(bits(&sim), before);
                ended += 1;
                sim.step(10.0).unwrap()
            }
        };
        assert_eq!(record, whole.step(10.0).unwrap());
    }
    assert_eq!(ended, 1, "{} iterations", asked.load(Ordering::Relaxed));
}

#[test]
fn slow_rolling_is_the_isothermal_history() {
    let mut warm = scene();
    (warm.motion.entrainment_speed, warm.motion.slide_roll_ratio) = (0.005, 0.0);
    let mut cool = warm.clone();
    cool.lubricant.as_mut().unwrap().thermal = None;
    let [mut warm, mut cool] = [warm, cool].map(|scene| MixedLubricationSim::builder(scene).build().unwrap());
    for _ in 0..3 {
        let [warm, cool] = [&mut warm, &mut cool].map(|sim| sim.step(10.0).unwrap());
        assert!((warm.film.mean_central / cool.film.mean_central - 1.0).abs() < 1e-6);
        assert!((warm.contact.load_ratio - cool.contact.load_ratio).abs() < 1e-6);
        assert_eq!(warm.thermal.unwrap().solves, 1);
        assert!(cool.thermal.is_none());
    }
}

/// The laws of growth see the surfaces that the film has heated, and no heat twice.
#[test]
fn surfaces_of_the_film_are_those_of_tribochemistry() {
    let mut on = scene();
    on.thermal.flash = Flash::On;
    let mut sim = MixedLubricationSim::builder(on.clone()).build().unwrap();
    let record = sim.step(10.0).unwrap();
    let heat = record.thermal.unwrap();
    assert_eq!(record.flash_rise, Some(heat.surface_rise_ball.max(heat.surface_rise_disc)));
    // Where solids carry, film and surfaces have one temperature: that of the flash of the same friction.
    on.lubricant.as_mut().unwrap().thermal = None;
    on.motion.entrainment_speed = 0.02;
    let plain = MixedLubricationSim::builder(on.clone()).build().unwrap().step(10.0).unwrap();
    on.lubricant.as_mut().unwrap().thermal = Some(FilmThermal::default());
    let warm = MixedLubricationSim::builder(on).build().unwrap().step(10.0).unwrap();
    let (flash, rise) = (plain.flash_rise.unwrap(), warm.flash_rise.unwrap());
    assert!(plain.contact.load_ratio > 0.5 && (rise / flash - 1.0).abs() < 0.05, "{rise} and {flash}");
}

/// Roughness that lies still: the film of the last step is nearly that of the next one.
#[test]
fn a_film_starts_from_that_of_the_last_step() {
    let mut scene = scene();
    scene.motion.entrainment_speed = 2.0;
    scene.wear = None;
    scene.tribofilm = None;
    scene.plastic = None;
    let mut sim = MixedLubricationSim::builder(scene).motion(Fixed).build().unwrap();
    let [first, second] = [0, 1].map(|_| sim.step(10.0).unwrap());
    let [cold, warm] = [first, second].map(|record| record.thermal.unwrap().solves);
    assert!(cold > 2 && warm <= 2, "{cold} and {warm} solves");
}
