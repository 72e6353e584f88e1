//! Worn volumes against Archard's law, `K F s/H` for each body.
#![expect(clippy::float_cmp, reason = "a full film wears nothing at all")]

use std::f64::consts::PI;

use stribeck::sim::scene::{
    ArchardSpec, Exposure, GridSpec, Load, SolverKind, TrackMotion, WearLawSpec, WearSpec,
};
use stribeck::sim::{HistoryMeans, MixedLubricationSim, Scene};
use stribeck::surface::Form;
use stribeck::wear::WearPressure;

use crate::common::runs::run;
use crate::common::scene_text::{assert_names, dry as dry_text};

const COEFFICIENT: f64 = 1e-7;
const HARDNESS: f64 = 6e9;
const RADII: [f64; 2] = [9e-3, 20e-3];

/// A smooth dry contact of 5 N that slides at 0.2 m/s, in a box of so many half-widths to each side.
fn dry(half_widths: f64, cells: usize, exposure: Exposure) -> Scene {
    let mut scene = Scene::azam_2019(32);
    scene.solver.kind = SolverKind::Dry;
    (scene.lubricant, scene.plastic) = (None, None);
    scene.roughness = Default::default();
    scene.load = Load::force(5.0);
    (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (0.1, 2.0);
    let half = half_widths * scene.hertz().unwrap().half_width_x;
    scene.grid = GridSpec::Cells { nx: cells, ny: cells, x: [-half, half], y: [-half, half] };
    [scene.track.radius_ball, scene.track.radius_disc] = RADII.map(Some);
    let law =
        ArchardSpec { coefficient: COEFFICIENT, film_coefficient: COEFFICIENT, ..ArchardSpec::default() };
    scene.wear = Some(WearSpec::new(WearLawSpec::Archard(law), exposure));
    scene
}

/// `K F s/H` \[m^3\].
fn archard(load: f64, distance: f64) -> f64 {
    COEFFICIENT * load * distance / HARDNESS
}

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() < tolerance, "{value:e} is not {expected:e}");
}

/// 5 N at 0.2 m/s for an hour: 6.0e-14 m^3 of either body, the ball that moves and the disc at rest.
#[test]
fn both_bodies_lose_archards_volume_when_the_disc_is_at_rest() {
    for exposure in [Exposure::Track, Exposure::ContactClock] {
        let mut scene = dry(3.0, 48, exposure);
        // The groove of an hour on the contact clock is wider than the contact.
        scene.solver.edge_contact = true;
        let (_, records) = run(scene, 36, 100.0);
        for volume in records[35].wear.volume() {
            close(volume, 6.0e-14, 1e-3);
        }
    }
}

#[test]
fn worn_volume_is_archards_in_any_box_and_motion() {
    for (half_widths, cells) in [(1.5, 32), (6.0, 64)] {
        for exposure in [Exposure::Track, Exposure::ContactClock] {
            for motion in
                [TrackMotion::AlongTrack, TrackMotion::Random, TrackMotion::Carried, TrackMotion::AtRest]
            {
                for ratio in [0.05, 2.0, -2.0] {
                    let mut scene = dry(half_widths, cells, exposure);
                    (scene.track.motion, scene.motion.slide_roll_ratio) = (motion, ratio);
                    let (_, records) = run(scene, 3, 1.37);
                    let expected = archard(5.0, 0.1 * ratio.abs() * 3.0 * 1.37);
                    for volume in records[2].wear.volume() {
                        close(volume, expected, 1e-5);
                    }
                }
            }
        }
    }
}

#[test]
fn worn_volume_of_a_line_contact_is_archards_per_metre() {
    for half_widths in [1.5, 6.0] {
        let mut scene = dry(3.0, 32, Exposure::Track);
        scene.form = Form::Cylinder { radius: 9.525e-3 };
        scene.load = Load::force(1e5);
        let half = half_widths * scene.hertz().unwrap().half_width_x;
        scene.grid = GridSpec::Row { nx: 128, x: [-half, half] };
        let (_, records) = run(scene, 3, 1.0);
        for volume in records[2].wear.volume() {
            close(volume, archard(1e5, 0.2 * 3.0), 1e-5);
        }
    }
}

/// The depth on the patch, as long as the whole track, is the volume.
#[test]
fn worn_depth_on_the_track_times_its_length_is_the_worn_volume() {
    let mut scene = dry(2.0, 32, Exposure::Track);
    scene.motion.slide_roll_ratio = 0.05;
    let (sim, records) = run(scene, 3, 100.0);
    let wear = records[2].wear;
    for ((mean, volume), radius) in wear.mean().into_iter().zip(wear.volume()).zip(RADII) {
        close(mean * sim.grid().size_y() * 2.0 * PI * radius, volume, 1e-9);
    }
    let cells = sim.grid().cell_area();
    let patch = sim.bodies()[0].volumes(cells).unwrap().wear;
    close(patch * 2.0 * PI * RADII[0] / sim.grid().size_x(), wear.ball_volume, 1e-9);
}

/// The load changes within the history, and with it the length of the contact.
#[test]
fn worn_volume_counts_the_load_of_each_step() {
    let mut scene = dry(3.0, 48, Exposure::ContactClock);
    scene.schedule.load = Some(stribeck::sim::Schedule::steps(&[(0.0, 5.0), (2.0, 15.0)]));
    let (_, records) = run(scene, 4, 1.0);
    for volume in records[3].wear.volume() {
        close(volume, archard(5.0 + 15.0, 0.2 * 2.0), 1e-5);
    }
}

/// Rough and lubricated: solids alone wear, and they carry a part of the load.
#[test]
fn worn_volume_in_mixed_lubrication_is_that_of_the_load_on_solids() {
    let mut scene = Scene::azam_2019(48);
    [scene.track.radius_ball, scene.track.radius_disc] = RADII.map(Some);
    let law =
        ArchardSpec { coefficient: COEFFICIENT, film_coefficient: COEFFICIENT, ..ArchardSpec::default() };
    let by_solids = WearSpec::new(WearLawSpec::Archard(law), Exposure::Track);
    for (pressure, share) in [(WearPressure::Solid, None), (WearPressure::Total, Some(1.0))] {
        scene.wear = Some(by_solids.with_pressure(pressure));
        let (_, records) = run(scene.clone(), 3, 10.0);
        let loads = records.iter().map(|record| record.load * share.unwrap_or(record.contact.load_ratio));
        let expected = archard(loads.sum(), 0.005 * 10.0);
        assert!(records[0].contact.load_ratio < 0.9);
        for volume in records[2].wear.volume() {
            close(volume, expected, 1e-4);
        }
    }
}

const TABLES: &str = "[motion]\nentrainment_speed = 1.0\nslide_roll_ratio = 0.5\n\
                      [lubricant]\neta0 = 0.05\nroelands_z = 0.6\n[wear]\nexposure = \"contact_clock\"\n";

#[test]
fn a_full_film_wears_nothing_by_default_under_either_law() {
    let energy = "law = \"frictional_energy\"\nvolume_per_energy = 1e-16\n";
    for extra in ["", energy] {
        let text = format!("{}{TABLES}{extra}", dry_text("")).replace("nx = 16\nny = 16", "nx = 32\nny = 32");
        let (sim, records) = run(Scene::from_toml(&text).unwrap(), 2, 10.0);
        assert_eq!(records[1].contact.load_ratio, 0.0);
        assert_eq!(records[1].wear.volume(), [0.0; 2]);
        assert!(sim.bodies().iter().all(|body| body.wear().iter().all(|depth| *depth == 0.0)));
        let (_, records) = run(Scene::from_toml(&format!("{text}pressure = \"total\"\n")).unwrap(), 2, 10.0);
        assert!(records[1].wear.volume().iter().all(|volume| *volume > 0.0));
    }
}

#[test]
fn wear_without_an_exposure_is_refused_with_the_choices() {
    assert_names(
        &dry_text("[wear]\ncoefficient = 1e-8\n"),
        &[
            "wear",
            "`exposure`",
            "exposure = \"track\": a point",
            "exposure = \"contact_clock\": a point",
            "radius_disc",
        ],
    );
}

#[test]
fn wear_on_the_track_needs_the_radii_of_bodies_that_move() {
    let mut scene = dry(2.0, 32, Exposure::Track);
    (scene.track.radius_ball, scene.track.radius_disc) = (None, None);
    let error = MixedLubricationSim::builder(scene).build().unwrap_err().to_string();
    assert_eq!(error, "track.radius_ball: is missing; wear.exposure = \"track\" needs it");
}

#[test]
fn a_wear_law_without_a_wear_table_is_refused() {
    let mut scene = dry(2.0, 32, Exposure::Track);
    scene.wear = None;
    let law = stribeck::wear::Archard::azam_2019();
    let error = MixedLubricationSim::builder(scene).wear_law(law).build().unwrap_err().to_string();
    assert!(error.starts_with("wear.exposure: is missing"), "{error}");
}

#[test]
fn worn_volumes_of_a_history_are_the_last_ones_in_cubic_millimetres() {
    let (_, records) = run(dry(2.0, 32, Exposure::Track), 20, 1.0);
    let mut means = HistoryMeans::new(20);
    records.iter().for_each(|record| means.see(record));
    assert_eq!(means.mean("wear", "disc_volume"), Some(records[19].wear.disc_volume));
    let text = means.to_string();
    let line = text.lines().find(|line| line.starts_with("wear.ball_volume")).unwrap();
    let words: Vec<&str> = line.split_whitespace().collect();
    // After the first and the last step.
    close(words[1].parse().unwrap(), 1e9 * archard(5.0, 0.2), 1e-4);
    close(words[2].parse().unwrap(), 1e9 * archard(5.0, 0.2 * 20.0), 1e-4);
    assert_eq!(words[3], "mm^3");
    let line = text.lines().find(|line| line.starts_with("wear.ball_specific_rate")).unwrap();
    let words: Vec<&str> = line.split_whitespace().collect();
    // K/H = 1.67e-17 m^3/(N m)
    close(words[1].parse().unwrap(), 1e9 * COEFFICIENT / HARDNESS, 1e-4);
    assert_eq!(words[2..], ["mm^3/(N", "m)"]);
    let line = text.lines().find(|line| line.starts_with("pressure.max ")).unwrap();
    let words: Vec<&str> = line.split_whitespace().collect();
    let numbers: Vec<f64> = words[1..4].iter().map(|word| 1e9 * word.parse::<f64>().unwrap()).collect();
    assert_eq!(words[4], "GPa");
    close(numbers[0], records[0].pressure.max, 1e-4);
    close(numbers[1], records[19].pressure.max, 1e-4);
    close(numbers[2], 0.5 * (records[18].pressure.max + records[19].pressure.max), 1e-4);
    // The gap of a dry contact is rounding.
    assert!(!text.contains("film.") && text.contains("wear.disc_scar_width"), "{text}");
}

#[test]
fn a_checkpoint_keeps_the_worn_volume() {
    let scene = dry(2.0, 32, Exposure::Track);
    let (sim, _) = run(scene.clone(), 3, 1.0);
    let mut other = MixedLubricationSim::builder(scene).build().unwrap();
    other.restore_checkpoint(&sim.checkpoint().unwrap()).unwrap();
    let record = other.step(1.0).unwrap();
    close(record.wear.disc_volume, archard(5.0, 0.2 * 4.0), 1e-5);
}
