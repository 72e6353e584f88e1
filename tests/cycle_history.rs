//! Wear and tribofilms from cycle to cycle, and contacts at rest whose oil drains.

use std::f64::consts::{PI, TAU};

use stribeck::sim::scene::CycleSpec;
use stribeck::sim::{CyclePoint, MixedLubricationSim, Scene};

use crate::common::runs::cycle as solve;

const LOAD: f64 = 1e5;
const COEFFICIENT: f64 = 1e-6;
const HARDNESS: f64 = 6e9;
const STEPS: usize = 40;

/// A rough roller on a disc that reciprocates, mixed, with Archard's wear; `more` are further tables.
fn reciprocating(repeat: Option<usize>, solved: Option<usize>, more: &str) -> Scene {
    let mut scene = Scene::from_toml(&format!(
        "form = {{ kind = \"cylinder\", radius = 10e-3 }}\nelastic.equivalent_modulus = 230e9\nload.force = {LOAD}\n\
         motion.entrainment_speed = 0.005\n[lubricant]\neta0 = 0.002\nalpha = 18e-9\nroelands_z = 0.6\ninlet = \"box_edge\"\n\
         [friction]\neyring_stress = 5e6\n[grid]\nnx = 96\nx = [-0.4e-3, 0.4e-3]\n\
         [roughness.ball]\nkind = \"gaussian\"\nrq = 0.05e-6\nlength_x = 40e-6\nlength_y = 40e-6\nseed = 1\n\
         [wear]\nexposure = \"contact_clock\"\ncoefficient = {COEFFICIENT}\nfilm_coefficient = {COEFFICIENT}\nhardness = {HARDNESS}\n{more}"
    ))
    .unwrap();
    let period = 0.2;
    let mut cycle = CycleSpec::default();
    cycle.time = (0..=STEPS).map(|k| period * k as f64 / STEPS as f64).collect();
    cycle.ball_speed = vec![0.0; STEPS + 1];
    cycle.disc_speed = (0..=STEPS).map(|k| 0.01 * (TAU * k as f64 / STEPS as f64).cos()).collect();
    (cycle.disc_speed[STEPS / 4], cycle.disc_speed[3 * STEPS / 4]) = (0.0, 0.0);
    (cycle.steps, cycle.repeat, cycle.solved) = (Some(STEPS), repeat, solved);
    scene.cycle = Some(cycle);
    scene
}

/// `K/H` times load on solids times sliding distance, summed over the contacts.
fn archard(points: &[CyclePoint]) -> f64 {
    let time_step = points[1].time - points[0].time;
    let distance = |point: &CyclePoint| (point.ball_speed - point.disc_speed).abs() * time_step;
    let worn = points.iter().map(|point| point.contact_load_ratio * point.load * distance(point));
    COEFFICIENT / HARDNESS * worn.sum::<f64>()
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found:e}, expected {expected:e}");
}

/// Wear of each cycle is Archard's sum over its contacts, and worn bodies start the next one.
#[test]
fn worn_volume_is_the_sum_of_archard_over_each_cycle() {
    let one = solve(reciprocating(Some(1), None, ""));
    let two = solve(reciprocating(Some(2), None, ""));
    let (first, second) = (archard(&one.points), archard(&two.points));
    assert!(first > 0.05 * COEFFICIENT / HARDNESS * LOAD * 0.01 * 2.0 / PI * 0.2, "{first:e}: hardly mixed");
    assert_eq!((one.cycles.len(), two.cycles.len()), (1, 2));
    close(one.cycles[0].wear_ball_volume, first, 1e-6);
    close(one.cycles[0].wear_disc_volume, first, 1e-6);
    close(one.points.last().unwrap().wear_ball_volume, first, 1e-6);
    assert_eq!(two.cycles[0], one.cycles[0]);
    close(two.cycles[1].wear_ball_volume, first + second, 1e-6);
    assert!(two.cycles[1].wear_ball_max > two.cycles[0].wear_ball_max);
    // Bodies without `repeat` do not wear.
    let unworn = solve(reciprocating(None, None, ""));
    assert!(unworn.cycles.is_empty() && unworn.points.iter().all(|point| point.wear_ball_volume == 0.0));
}

/// A solved cycle that stands for many wears the bodies by as much.
#[test]
fn solved_cycles_stand_for_repeated_ones() {
    let solution = solve(reciprocating(Some(300), Some(3), ""));
    let cycles = &solution.cycles;
    assert_eq!(cycles.iter().map(|cycle| cycle.cycles).collect::<Vec<_>>(), [100.0, 200.0, 300.0]);
    close(cycles[2].wear_disc_volume - cycles[1].wear_disc_volume, 100.0 * archard(&solution.points), 1e-6);
    assert!(cycles[2].wear_disc_max > 2.0 * cycles[0].wear_disc_max, "{cycles:?}");
}

/// The film of both strokes is that of one body, which is mirrored where the flow turns back.
#[test]
fn tribofilm_grows_from_cycle_to_cycle() {
    let solution = solve(reciprocating(Some(40), Some(2), "[tribofilm]\nlaw = \"ghanbarzadeh\""));
    let [first, second] = [solution.cycles[0], solution.cycles[1]];
    assert!(first.tribofilm_disc_max > 1e-10, "{first:?}");
    assert!(second.tribofilm_disc_max > first.tribofilm_disc_max, "{second:?}");
    assert!(solution.closure > 0.0);
}

/// A tooth in mesh begins each cycle from a steady contact: unworn bodies repeat it.
#[test]
fn cycles_that_run_once_begin_from_a_steady_contact() {
    let mut scene = reciprocating(Some(2), None, "");
    scene.wear = None;
    scene.cycle.as_mut().unwrap().once = true;
    let solution = solve(scene);
    close(solution.cycles[1].film_minimum, solution.cycles[0].film_minimum, 1e-3);
    close(solution.cycles[1].contact_load_ratio, solution.cycles[0].contact_load_ratio, 1e-3);
}

/// A smooth isoviscous roller that stops; `end` of the rest, `steps` until then.
fn stopping(alpha: f64, end: f64, steps: usize) -> Scene {
    let mut scene = Scene::from_toml(&format!(
        "form = {{ kind = \"cylinder\", radius = 10e-3 }}\nelastic.equivalent_modulus = 230e9\nload.force = {LOAD}\n\
         motion.entrainment_speed = 1.0\n[lubricant]\ninlet = \"box_edge\"\ndensity_a = 0.0\n\
         viscosity = {{ law = \"barus\", eta0 = 0.02, alpha = {alpha} }}\n[grid]\nnx = 128\nx = [-0.4e-3, 0.4e-3]"
    ))
    .unwrap();
    let mut cycle = CycleSpec::default();
    cycle.time = vec![0.0, 1e-3, 2e-3, end];
    cycle.ball_speed = vec![1.0, 1.0, 0.0, 0.0];
    cycle.disc_speed = cycle.ball_speed.clone();
    (cycle.once, cycle.steps) = (true, Some(steps));
    scene.cycle = Some(cycle);
    scene
}

/// In the middle of a Hertz contact at rest `dh/dt = h^3 p''/(12 eta)` with `p'' = -p_H/a^2`, thus
/// `1/h^2 = 1/h_0^2 + p_H t/(6 eta a^2)`: as `t^(-1/2)`.
#[test]
fn central_film_at_rest_decays_by_the_squeeze_of_a_hertz_contact() {
    let solution = solve(stopping(0.0, 12e-3, 120));
    let half_width = (8.0 * LOAD * 10e-3 / (PI * 230e9)).sqrt();
    let rate = 2.0 * LOAD / (PI * half_width) / (6.0 * 0.02 * half_width.powi(2));
    let rest: Vec<&CyclePoint> = solution.points.iter().filter(|point| point.time > 3e-3).collect();
    let start = rest[0];
    for point in &rest {
        let expected = (start.film_central.powi(-2) + rate * (point.time - start.time)).powf(-0.5);
        close(point.film_central, expected, 0.01);
    }
    assert!(rest.last().unwrap().film_central < 0.5 * start.film_central);
}

/// At rest nothing is entrained: shorter steps leave the film as it is.
#[test]
fn film_of_a_contact_at_rest_is_independent_of_the_number_of_steps() {
    let [few, many] = [360, 1080].map(|steps| *solve(stopping(18e-9, 24e-3, steps)).points.last().unwrap());
    close(few.film_central, many.film_central, 0.01);
    close(few.film_minimum, many.film_minimum, 0.03);
}

/// Steps that are too long for the film that drains are halved; in the end solids carry.
#[test]
fn contact_at_rest_carries_on_by_solids_when_its_oil_has_drained() {
    let solution = solve(stopping(18e-9, 400.0, 40));
    let last = solution.points.last().unwrap();
    assert!(last.contact_load_ratio > 0.5 && last.film_mean_central < 1e-8, "{last:?}");
    assert!(solution.points.iter().all(|point| point.residual_load < 1e-6));
}

#[test]
fn histories_that_do_not_fit_are_refused_by_field_and_value() {
    type Change = fn(&mut Scene);
    let cases: [(Change, &[&str]); 5] = [
        (|s| s.cycle.as_mut().unwrap().repeat = Some(0), &["cycle.repeat", "0", "at least 1"]),
        (|s| s.cycle.as_mut().unwrap().solved = Some(7), &["cycle.solved", "7", "cycle.repeat"]),
        (
            |s| {
                let cycle = s.cycle.as_mut().unwrap();
                (cycle.repeat, cycle.solved) = (None, Some(2));
            },
            &["cycle.solved = 2", "missing"],
        ),
        (
            |s| {
                s.tribofilm = Scene::azam_2019(16).with_tribofilm().tribofilm;
                s.cycle.as_mut().unwrap().repeat = None;
            },
            &["tribofilm", "cycle.repeat"],
        ),
        (
            |s| s.motion.roughness = stribeck::sim::scene::RoughnessState::Moving,
            &["one cell of the faster surface", "quasi_static = true"],
        ),
    ];
    for (change, words) in cases {
        let mut scene = reciprocating(Some(3), None, "");
        change(&mut scene);
        let error = MixedLubricationSim::builder(scene).solve_cycle(&mut |_| true).unwrap_err().to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
    }
}
