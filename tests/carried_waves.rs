//! Waves of the film that both surfaces carry through a contact.

use std::f64::consts::PI;

use rayon::prelude::*;
use stribeck::sim::{MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::Advected;

const RADIUS: f64 = 1.0;
const MODULUS: f64 = 226e9;
const ALPHA: f64 = 2.2e-8;
const ETA0: f64 = 0.04;
/// Moes parameters of the line contact, with the sum of the speeds.
const M: f64 = 100.0;
const L: f64 = 11.0;
/// Cells of the row, a multiple of all lengths of waves.
const CELLS: usize = 240;

/// A wave of `length` cells and a twentieth of the central film that rolls through a line contact, `cells` a step; its amplitude at 0.7
/// half-widths behind the middle of the contact over that at 0.7 before it.
fn kept(length: usize, cells: f64) -> f64 {
    let speed_sum = (L / (ALPHA * MODULUS)).powi(4);
    let speed = 0.5 * speed_sum * MODULUS * RADIUS / ETA0;
    let load = M * speed_sum.sqrt() * MODULUS * RADIUS;
    let half_width = (8.0 * load * RADIUS / (PI * MODULUS)).sqrt();
    let (low, dx) = (-4.0, 5.5 / 256.0);
    let high = low + CELLS as f64 * dx;
    let text = format!(
        "form = {{ kind = \"cylinder\", radius = {RADIUS} }}\nelastic.equivalent_modulus = {MODULUS}\nload.force = {load}\n\
         motion.entrainment_speed = {speed}\n[lubricant]\neta0 = {ETA0}\nalpha = {ALPHA}\nroelands_z = 0.68\ninlet = \"box_edge\"\n\
         [grid]\nnx = {CELLS}\nx = [{}, {}]",
        low * half_width,
        high * half_width
    );
    let scene = Scene::from_toml(&text).unwrap();
    let smooth = solve_contact(&scene).unwrap().film.central;
    let phase = 2.0 * PI / length as f64;
    let wave = (0..CELLS).map(|i| 0.05 * smooth * (phase * i as f64).cos()).collect();
    let builder = MixedLubricationSim::builder(scene).motion(Advected).with_squeeze().disc_heights(wave);
    let mut sim = builder.build().unwrap();
    let time_step = cells * dx * half_width / speed;
    let period = (length as f64 / cells).round() as usize;
    let node = |x: f64| ((x - low) / dx) as usize;
    let (steps, places) = (((4.2 / dx) / cells) as usize + period, [-0.7, 0.7].map(node));
    let mut films = [Vec::new(), Vec::new()];
    for _ in 0..=steps {
        sim.step(time_step).unwrap();
        for (films, place) in films.iter_mut().zip(places) {
            films.push(sim.state().film[place]);
        }
    }
    let [before, behind] = films.map(|films| {
        let last = &films[films.len() - period..];
        let turn = 2.0 * PI / period as f64;
        let part = |f: fn(f64) -> f64| {
            last.iter().enumerate().map(|(i, film)| film * f(turn * i as f64)).sum::<f64>()
        };
        part(f64::cos).hypot(part(f64::sin))
    });
    behind / before
}

#[test]
#[ignore = "slow"]
fn waves_keep_their_amplitude_across_the_contact() {
    let cases = [
        (8, 1.0, 0.97),
        (12, 1.0, 0.99),
        (16, 1.0, 0.99),
        (8, 0.5, 0.93),
        (12, 0.5, 0.98),
        (16, 0.5, 0.98),
        (8, 2.0, 0.93),
        (12, 2.0, 0.98),
        (16, 2.0, 0.98),
    ];
    cases.into_par_iter().for_each(|(length, cells, least)| {
        let found = kept(length, cells);
        assert!((least..1.02).contains(&found), "{length} cells, {cells} a step: {found:.3}");
    });
}
