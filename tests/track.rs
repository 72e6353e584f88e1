//! Histories do not depend on the box, the length of its steps, where on the track the contact is
//! met.
#![expect(clippy::float_cmp, reason = "tests")]

use std::ops::ControlFlow;

use stribeck::Grid;
use stribeck::sim::scene::{Exposure, GridSpec, Roughness, SolverKind, TrackMotion};
use stribeck::sim::{MixedLubricationSim, Scene, Schedule, StepRecord, solve_contact};
use stribeck::surface::{Fixed, Offset, PointRevisit, RoughnessMotion};

/// Dry and smooth, all pressure wears, on cells of 500 um / 32.
fn smooth(columns: usize, rows: usize) -> Scene {
    let mut scene = Scene::azam_2019(32);
    scene.solver.kind = SolverKind::Dry;
    scene.roughness = Default::default();
    let half = |cells: usize| 0.5 * cells as f64 * 500e-6 / 32.0;
    let (x, y) = (half(columns), half(rows));
    scene.grid = GridSpec::Cells { nx: columns, ny: rows, x: [-x, x], y: [-y, y] };
    scene
}

/// The same with roughness that the cells resolve.
fn rough(columns: usize, rows: usize) -> Scene {
    let mut scene = smooth(columns, rows);
    scene.roughness = Scene::azam_2019(32).roughness;
    for body in [&mut scene.roughness.ball, &mut scene.roughness.disc] {
        if let Roughness::Random(random) = body {
            *body = Roughness::gaussian(random.rq, 40e-6, random.seed);
        }
    }
    scene
}

/// The scene with growth and wear exposed so.
fn exposed(mut scene: Scene, exposure: Exposure) -> Scene {
    scene.track.exposure = exposure;
    scene.wear = scene.wear.map(|wear| wear.with_exposure(exposure));
    scene
}

fn run(scene: Scene, steps: u64, time_step: f64) -> (MixedLubricationSim, StepRecord) {
    let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
    let mut last = None;
    sim.run(steps, time_step, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        last = Some(record.clone());
        ControlFlow::Continue(())
    })
    .unwrap();
    (sim, last.unwrap())
}

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() < tolerance, "{value} is not {expected}");
}

#[test]
fn the_first_contact_is_that_of_solve_contact() {
    for motion in [TrackMotion::AlongTrack, TrackMotion::Random, TrackMotion::Carried, TrackMotion::AtRest] {
        let mut scene = Scene::azam_2019(32).with_tribofilm();
        (scene.track.motion, scene.track.seed) = (motion, 17);
        let single = solve_contact(&scene).unwrap();
        let mut sim = MixedLubricationSim::builder(scene).build().unwrap();
        let record = sim.step(10.0).unwrap();
        assert_eq!(sim.state().pressure, single.state.pressure, "{motion:?}");
        assert_eq!(record.contact.load_ratio, single.contact.load_ratio, "{motion:?}");
    }
}

/// The whole force wears a strip as long as the contact: with one coefficient `K F s / (H (2a)^2)` over the
/// width of the track.
#[test]
fn wear_of_the_track_is_that_of_force_and_distance_in_any_box() {
    for columns in [32, 48, 64] {
        for motion in [TrackMotion::AlongTrack, TrackMotion::Carried] {
            let mut scene = smooth(columns, 32);
            scene.track.motion = motion;
            let (sim, record) = run(scene, 40, 10.0 + 1.37e-3);
            let square = 4.0 * sim.hertz().half_width_x.powi(2);
            let expected = 5.45e-8 * sim.hertz().force * 0.005 * sim.time() / (6e9 * square);
            for wear in record.wear.in_contact() {
                // A contact that wears grows beyond its width, by a node at most.
                close(wear, expected, 0.02);
            }
            // Nothing else is worn: the mean over the box holds to rounding.
            let strip = 2.0 * sim.hertz().half_width_x * sim.grid().size_y();
            close(
                record.wear.ball_mean,
                5.45e-8 * sim.hertz().force * 0.005 * sim.time() / (6e9 * strip),
                1e-5,
            );
        }
    }
}

#[test]
fn on_a_track_a_point_ages_while_the_contact_passes() {
    let clock = run(rough(32, 32).with_tribofilm(), 3, 10.0).1;
    let mut scene = exposed(rough(32, 32).with_tribofilm(), Exposure::Track);
    (scene.track.radius_ball, scene.track.radius_disc) = (Some(9.525e-3), Some(23e-3));
    let share =
        [9.525e-3, 23e-3].map(|radius| scene.hertz().unwrap().half_width_x / (std::f64::consts::PI * radius));
    let track = run(scene, 3, 10.0).1;
    for body in [0, 1] {
        // The surfaces hardly change: film and wear are those of the time in the contact, and small beside
        // their final values.
        close(track.wear.in_contact()[body], share[body] * clock.wear.in_contact()[body], 0.05);
        close(track.tribofilm.in_contact()[body], share[body] * clock.tribofilm.in_contact()[body], 0.1);
    }
}

/// At a slide-roll ratio of 2 the disc stands still: its nodes in the contact stay there and age by the
/// time of the test.
#[test]
fn a_body_that_does_not_move_stays_in_the_contact() {
    for exposure in [Exposure::ContactClock, Exposure::Track] {
        let mut scene = exposed(smooth(32, 32), exposure);
        scene.motion.slide_roll_ratio = 2.0;
        // The disc needs no track.
        scene.track.radius_ball = Some(9.525e-3);
        let (sim, record) = run(scene, 10, 1.0);
        let area = sim.grid().size_x() * sim.grid().size_y();
        let worn = 5.45e-8 * sim.hertz().force * 0.2 * sim.time() / (6e9 * area);
        close(record.wear.disc_mean, worn, 1e-5);
        let of_ball = match exposure {
            Exposure::ContactClock => sim.grid().size_x() / (2.0 * sim.hertz().half_width_x),
            _ => sim.grid().size_x() / (2.0 * std::f64::consts::PI * 9.525e-3),
        };
        close(record.wear.ball_mean, worn * of_ball, 1e-5);
        // The disc is worn where the contact is and nowhere else.
        let grid = sim.grid();
        let depths = grid.nodes().zip(sim.bodies()[1].wear());
        let outside: Vec<f64> =
            depths.filter(|((x, y), _)| x.hypot(*y) > 2e-4).map(|(_, depth)| *depth).collect();
        assert!(outside.len() > 100 && outside.iter().all(|depth| *depth == 0.0));
    }
}

/// The same holds for random positions of the roughness: nodes in the contact are flattened.
#[test]
fn a_body_that_does_not_move_is_flattened_where_it_lies() {
    let mut scene = rough(32, 32);
    scene.motion.slide_roll_ratio = 2.0;
    scene.track.motion = TrackMotion::Random;
    scene.plastic.as_mut().unwrap().hardness = 2e9;
    let (sim, _) = run(scene, 2, 1.0);
    let grid = sim.grid();
    let depths = grid.nodes().zip(sim.bodies()[1].plastic_depth());
    let flattened: Vec<f64> =
        depths.filter(|(_, depth)| **depth > 0.0).map(|((x, y), _)| x.hypot(y)).collect();
    assert!(!flattened.is_empty() && flattened.iter().all(|distance| *distance < 2.5e-4), "{flattened:?}");
}

#[test]
fn smooth_bodies_stay_smooth() {
    let (_, record) = run(smooth(32, 32), 720, 10.0);
    println!("Rq {:?} m after {:?} m of wear", record.roughness.rq(), record.wear.in_contact());
    assert!(record.wear.ball_in_contact > 150e-9);
    assert!(record.roughness.rq().iter().all(|rq| *rq < 1e-9), "{:?}", record.roughness.rq());
}

/// Ball, disc, wear ratio.
#[test]
#[ignore = "slow"]
fn roughness_and_wear_do_not_depend_on_the_number_of_steps() {
    let [coarse, fine] = [720_u32, 2880].map(|steps| {
        let at_end = |scene| run(scene, u64::from(steps), 7200.0 / f64::from(steps)).1;
        let [bare, filmed] = [at_end(rough(32, 32)), at_end(rough(32, 32).with_tribofilm())];
        let ratio = |body: usize| filmed.wear.in_contact()[body] / bare.wear.in_contact()[body];
        println!("{steps} steps: Rq {:?}, wear ratios {} {}", bare.roughness.rq(), ratio(0), ratio(1));
        [bare.roughness.ball_rq, bare.roughness.disc_rq, filmed.roughness.disc_rq, ratio(0), ratio(1)]
    });
    for (a, b) in coarse.into_iter().zip(fine) {
        close(a, b, 0.03);
    }
}

/// A groove is the form of the track, not its roughness; the profile of the wear holds it.
#[test]
fn the_groove_is_no_roughness() {
    let (mut sim, _) = run(smooth(32, 32), 59, 100.0);
    let met = sim.track_roughness(sim.bodies()[1].surface()).unwrap();
    let record = sim.step(100.0).unwrap();
    let disc = &sim.bodies()[1];
    let profile = sim.worn_profile(disc);
    assert_eq!(profile.len(), 32);
    close(profile.iter().sum::<f64>() / 32.0, record.wear.disc_mean, 1e-12);
    assert!(profile[16] > 100e-9 && profile[0] == 0.0, "{profile:?}");
    let deepest = disc.surface().iter().copied().fold(0.0, f64::min);
    assert!(deepest < -100e-9 && record.roughness.disc_rq < 5e-9, "{deepest} {:?}", record.roughness.rq());
    assert_eq!(met.len() % 32, 0);
    close(stribeck::metrics::height_statistics(&met).unwrap().sq, record.roughness.disc_rq, 1e-6);
}

/// Bodies and contacts of all entries of a schedule count.
#[test]
fn tracks_are_checked_under_the_whole_schedule() {
    let refused = |scene: Scene| MixedLubricationSim::builder(scene).build().unwrap_err().to_string();
    let mut scene = smooth(32, 32);
    scene.plastic = None;
    (scene.track.exposure, scene.track.radius_ball) = (Exposure::Track, Some(23e-3));
    // The disc rests at a ratio of 2.
    scene.schedule.slide_roll_ratio = Some(Schedule::Constant { value: 2.0 });
    MixedLubricationSim::builder(scene.clone()).build().unwrap();
    // It rests at both entries and moves between them.
    scene.schedule.slide_roll_ratio = Some(Schedule::ramps(&[(0.0, 0.0), (9.0, 2.0)]));
    scene.schedule.entrainment_speed = Some(Schedule::ramps(&[(0.0, 0.0), (9.0, 0.1)]));
    let missing = "track.radius_disc: is missing; track.exposure = \"track\" needs it";
    assert_eq!(refused(scene), missing);
    let mut scene = smooth(32, 32);
    scene.plastic = None;
    scene.track.radius_ball = Some(100e-6);
    MixedLubricationSim::builder(scene.clone()).build().unwrap();
    scene.schedule.load = Some(Schedule::steps(&[(0.0, 20.0), (5.0, 600.0), (9.0, 20.0)]));
    let error = refused(scene);
    assert!(
        error.starts_with("track.radius_ball = 1e-4") && error.contains("shorter than the contact"),
        "{error}"
    );
}

/// NaN offsets from the second solve on.
#[derive(Debug)]
struct Lost;

impl RoughnessMotion for Lost {
    fn offset(&self, body: usize, draw: u64, _time: f64, _speed: f64, grid: &Grid) -> Offset {
        // Beyond the patch, which is periodic.
        let columns = 5 * grid.nx() + 3;
        Offset { columns, rows: 7 * grid.ny(), fraction: if draw > 0 && body == 1 { f64::NAN } else { 0.0 } }
    }
    fn visits(&self, _speed: f64) -> PointRevisit {
        PointRevisit::Track
    }
}

#[test]
fn a_motion_without_numbers_is_an_error_and_changes_nothing() {
    let mut sim = MixedLubricationSim::builder(rough(32, 32)).motion(Lost).build().unwrap();
    sim.step(10.0).unwrap();
    let before = sim.bodies().clone();
    let error = sim.step(10.0).unwrap_err().to_string();
    assert_eq!(error, "motion: offset.fraction of the disc = NaN: must be from 0 to 1");
    assert_eq!((sim.steps(), sim.time()), (1, 10.0));
    for (body, old) in sim.bodies().iter().zip(&before) {
        assert_eq!(body.surface(), old.surface());
    }
}

#[test]
fn a_motion_of_the_user_takes_the_place_of_the_scene() {
    let mut own = MixedLubricationSim::builder(rough(32, 32)).motion(Fixed).build().unwrap();
    let mut named = rough(32, 32);
    named.track.motion = TrackMotion::AtRest;
    let mut named = MixedLubricationSim::builder(named).build().unwrap();
    for _ in 0..2 {
        assert_eq!(own.step(10.0).unwrap(), named.step(10.0).unwrap());
    }
}

#[test]
fn tracks_that_do_not_fit_are_named() {
    let refused = |radii: [Option<f64>; 2]| {
        let mut scene = smooth(32, 32);
        scene.track.exposure = Exposure::Track;
        [scene.track.radius_ball, scene.track.radius_disc] = radii;
        MixedLubricationSim::builder(scene).build().unwrap_err().to_string()
    };
    let error = refused([Some(9.525e-3), None]);
    assert_eq!(error, "track.radius_disc: is missing; track.exposure = \"track\" needs it");
    let error = refused([Some(5e-5), Some(23e-3)]);
    assert!(error.starts_with("track.radius_ball = 5e-5: a track of 3.14"), "{error}");
    assert!(error.contains("shorter than the patch, which is 5e-4 m long"), "{error}");
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = refused([Some(9.525e-3), Some(bad)]);
        assert!(error.starts_with("track.radius_disc = "), "{error}");
    }
}
