//! Histories of strips: those of the line for equal rows, worn volumes per metre, and their continuation.

use std::f64::consts::PI;

use stribeck::sim::scene::{Exposure, GridSpec, Load, PlasticSpec, Roughness, SolverKind, TrackMotion};
use stribeck::sim::{MixedLubricationSim, Scene, StepRecord};
use stribeck::surface::Form;

use crate::common::runs::run;

const X: [f64; 2] = [-0.3e-3, 0.21e-3];
const Y: [f64; 2] = [-0.1e-3, 0.06e-3];
const RADII: [f64; 2] = [5e-3, 20e-3];

/// A slow smooth roller whose bodies wear and grow a tribofilm.
fn roller(nx: usize) -> Scene {
    let mut scene = Scene::azam_2019(16).with_tribofilm();
    scene.form = Form::Cylinder { radius: 5e-3 };
    scene.load = Load::hertz_pressure(1.2e9);
    (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (2e-3, 0.5);
    (scene.roughness, scene.grid) = (Default::default(), GridSpec::Row { nx, x: X });
    [scene.track.radius_ball, scene.track.radius_disc] = RADII.map(Some);
    scene
}

/// The same roller as a strip of `ny` rows.
fn strip(scene: &Scene, ny: usize) -> Scene {
    let mut scene = scene.clone();
    let GridSpec::Row { nx, x } = scene.grid else { panic!("a line") };
    scene.grid = GridSpec::Strip { nx, ny, x, y: Some(Y) };
    scene
}

/// Rough along both axes.
fn rough(scene: &Scene, ny: usize) -> Scene {
    let mut scene = strip(scene, ny);
    scene.roughness.ball = Roughness::gaussian(60e-9, 30e-6, 1);
    scene.roughness.disc = Roughness::gaussian(100e-9, 30e-6, 2);
    scene
}

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() < tolerance, "{value:e} is not {expected:e}");
}

/// The numbers of a step that wear and tribofilm enter.
fn numbers(record: &StepRecord) -> Vec<f64> {
    let (wear, film) = (record.wear, record.tribofilm);
    let scars = [wear.ball_scar_depth, wear.disc_scar_depth, wear.ball_scar_width.unwrap_or(1.0)];
    [
        &wear.mean()[..],
        &wear.in_contact(),
        &wear.volume(),
        &[wear.ball_max, wear.disc_max],
        &scars,
        &film.mean(),
        &film.in_contact(),
        &[film.ball_max, film.disc_max, record.film.mean_central, record.friction.coefficient],
        &[record.contact.load_ratio, record.load, record.pressure.max],
        &[1.0 + record.plastic.volume * 1e9, record.friction.power_loss],
    ]
    .concat()
}

#[test]
fn history_of_a_smooth_strip_is_that_of_the_line() {
    for (ratio, motion) in [(0.5, TrackMotion::AlongTrack), (2.0, TrackMotion::Random)] {
        let mut line = roller(96);
        (line.motion.slide_roll_ratio, line.track.motion) = (ratio, motion);
        line.solver.tolerance = 1e-9;
        let [row, rows] = [line.clone(), strip(&line, 6)].map(|scene| run(scene, 3, 60.0));
        for (a, b) in row.1.iter().zip(&rows.1) {
            for (k, (a, b)) in numbers(a).into_iter().zip(numbers(b)).enumerate() {
                assert!((a / b - 1.0).abs() < 1e-5, "number {k} at ratio {ratio}: {a:e} {b:e}");
            }
        }
        let wear = row.1[2].wear;
        assert!(wear.disc_max > 0.0 && row.1[2].tribofilm.disc_max > 1e-9, "the history changes the bodies");
        for (line, strip) in row.0.bodies().iter().zip(rows.0.bodies()) {
            let worn = line.wear();
            let apart = strip.wear().chunks(96).flat_map(|row| row.iter().zip(worn));
            let apart = apart.fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
            assert!(apart < 1e-5 * wear.disc_max, "{apart:e}");
        }
    }
}

/// `K F s/H` per metre, in one and in two periods; on the track of its own length the depths are the volume.
#[test]
fn rough_strip_loses_archards_volume_per_metre() {
    let mut line = roller(64);
    (line.lubricant, line.tribofilm, line.plastic) = (None, None, None);
    line.solver.kind = SolverKind::Dry;
    line.wear.as_mut().unwrap().exposure = Exposure::Track;
    let mut wide = rough(&line, 48);
    wide.grid = GridSpec::Strip { nx: 64, ny: 48, x: X, y: Some(Y.map(|y| 2.0 * y)) };
    for scene in [rough(&line, 24), wide] {
        let (sim, records) = run(scene, 3, 20.0);
        let record = &records[2];
        let expected = 5.45e-8 / 6e9 * record.load * 1e-3 * 60.0;
        let grid = sim.grid();
        for (body, radius) in sim.bodies().iter().zip(RADII) {
            let depths: f64 = body.wear().iter().sum::<f64>() * grid.cell_area() / grid.size_y();
            close(depths * 2.0 * PI * radius / grid.size_x(), expected, 1e-5);
        }
        record.wear.volume().into_iter().for_each(|volume| close(volume, expected, 1e-5));
        // Rows differ: every row wears, the mean of all is that of the track.
        let profile = sim.worn_profile(&sim.bodies()[1]);
        let mean = profile.iter().sum::<f64>() / profile.len() as f64;
        close(mean, record.wear.disc_mean, 1e-9);
        close(record.wear.disc_in_contact, record.wear.disc_mean, 1e-9);
        close(record.wear.disc_scar_depth, record.wear.disc_mean, 1e-9);
        assert!(profile.iter().any(|depth| (depth / mean - 1.0).abs() > 1e-3), "rows wear unequally");
    }
}

/// Random positions shift the rows of a strip too; each point is exposed as on the track.
#[test]
fn random_positions_of_a_strip_wear_as_those_along_the_track() {
    let mut line = roller(64);
    (line.lubricant, line.tribofilm, line.plastic) = (None, None, None);
    line.solver.kind = SolverKind::Dry;
    let means = [TrackMotion::AlongTrack, TrackMotion::Random].map(|motion| {
        let mut scene = rough(&line, 24);
        scene.track.motion = motion;
        run(scene, 2, 20.0).1[1].wear.disc_mean
    });
    close(means[0], means[1], 1e-5);
}

#[test]
fn rough_strip_flattens_wears_and_continues_from_a_checkpoint() {
    let mut scene = rough(&roller(80), 24);
    scene.plastic = Some(PlasticSpec::new(2e9));
    let build = || MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let mut sim = build();
    let first = sim.step(60.0).unwrap();
    let bytes = sim.checkpoint().unwrap();
    let mut other = build();
    other.restore_checkpoint(&bytes).unwrap();
    let second = sim.step(60.0).unwrap();
    assert_eq!(other.step(60.0).unwrap(), second);
    assert_eq!(other.bodies()[0].surface(), sim.bodies()[0].surface());
    assert!(first.plastic.volume > 0.0 && second.plastic.volume > first.plastic.volume);
    assert!(second.wear.ball_volume > first.wear.ball_volume && second.tribofilm.ball_mean > 0.0);
    assert!(sim.ledger_residual().unwrap() < 1e-20);
}
