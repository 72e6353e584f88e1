//! Contacts in time: waves that travel through line and point contacts with both surfaces, and the order of
//! the time step.

use std::f64::consts::PI;

use rayon::prelude::*;

use crate::common::rolling::{Passage, Rolling};

/// Amplitudes of waves of a tenth of the central film at M = 100, L = 11 (Venner and Lubrecht 2000).
#[test]
#[ignore = "slow"]
fn waves_in_pure_rolling_are_flattened_as_known() {
    for (nx, wave, cells, known) in [
        (512, 4.0, 8.0, 0.030),
        (512, 2.0, 4.0, 0.073),
        (512, 1.0, 2.0, 0.183),
        (512, 0.5, 1.0, 0.394),
        (1024, 0.25, 1.0, 0.660),
    ] {
        let found = Rolling::line(nx).unwrap().amplitude(wave, cells, true).unwrap();
        assert!((found - known).abs() < 0.01, "wave of {wave}: {found}, known {known}");
    }
}

#[test]
#[ignore = "slow"]
fn second_order_in_time_is_of_second_order_and_first_order_is_not() {
    let found = |second| {
        [4.0, 2.0, 1.0].map(|cells| Rolling::line(512).unwrap().amplitude(1.0, cells, second).unwrap())
    };
    let order = |[coarse, middle, fine]: [f64; 3]| ((coarse - middle) / (middle - fine)).abs().log2();
    let (first, second) = (found(false), found(true));
    assert!(order(second) > 1.7, "{second:?}");
    assert!((0.3..1.4).contains(&order(first)), "{first:?}");
    // First order damps: a quarter of the amplitude is gone.
    assert!(first[2] < 0.9 * second[2], "{first:?}, {second:?}");
}

/// Amplitude over the parameter `n = (wave length / a) sqrt(M / L)` lies on one curve for all loads and waves
/// (Venner and Lubrecht 2000). Sixteen cells a wave and more; waves of eleven cells are damped by the scheme.
#[test]
#[ignore = "slow"]
fn waves_under_a_ball_are_flattened_by_the_master_curve() {
    let cases = [(5.0, 0.75, 1.0), (20.0, 1.0, 1.0), (100.0, 1.0, 1.0), (100.0, 2.0, 2.0), (100.0, 3.0, 3.0)];
    cases.into_par_iter().for_each(|(moes_load, wave, cells)| {
        let n: f64 = wave * (moes_load / 10.0_f64).sqrt();
        let curve = 1.0 / (1.0 + 0.15 * n + 0.015 * n * n);
        let found = Rolling::ball(moes_load, 128).unwrap().amplitude(wave, cells, true).unwrap();
        assert!((found - curve).abs() < 0.08, "n {n}: {found}, master curve {curve}");
    });
}

/// A dent on a surface at half the entrainment speed: the change of the film at the inlet travels ahead of
/// it, at the entrainment speed, while the dent itself is pressed nearly flat.
#[test]
fn the_film_that_a_dent_lets_in_runs_ahead_of_it() {
    let mut rolling = Rolling::line(512).unwrap();
    let (grid, half_width, middle) = (rolling.grid, rolling.half_width, rolling.middle);
    let smooth = rolling.smooth_gap();
    let time_step = grid.dx() / rolling.speed;
    let mut passage = Passage::start(&mut rolling, &smooth, time_step).unwrap();
    let steady = passage.state.film.clone();
    let (depth, width) = (0.3 * steady[middle], 0.15 * half_width);
    let mut peaks = Vec::new();
    let mut largest_under_dent = 0.0_f64;
    for step in 1.. {
        let dent = -2.5 * half_width + 0.5 * rolling.speed * time_step * f64::from(step);
        if dent > -0.1 * half_width {
            break;
        }
        let gap: Vec<f64> = (grid.nodes().zip(&smooth))
            .map(|((x, _), height)| height + depth * (-((x - dent) / width).powi(2)).exp())
            .collect();
        passage.step(&mut rolling, &gap, true).unwrap();
        let change = |k: usize| passage.state.film[k] - steady[k];
        if dent < -0.5 * half_width {
            continue;
        }
        let ahead =
            (0..grid.len()).filter(|k| grid.x(*k) > dent + 2.0 * width && grid.x(*k) < 0.8 * half_width);
        let k = ahead.max_by(|a, b| change(*a).total_cmp(&change(*b))).unwrap();
        let (left, peak, right) = (change(k - 1), change(k), change(k + 1));
        let place = grid.x(k) + 0.5 * grid.dx() * (left - right) / (left - 2.0 * peak + right);
        peaks.push((f64::from(step) * time_step, place, peak));
        if dent > -0.3 * half_width {
            let under = (0..grid.len()).filter(|k| (grid.x(*k) - dent).abs() < width);
            largest_under_dent = under.map(|k| change(k).abs()).fold(largest_under_dent, f64::max);
        }
    }
    let ((first, from, before), (last, to, after)) = (peaks[0], peaks[peaks.len() - 1]);
    let speed = (to - from) / (last - first) / rolling.speed;
    assert!((speed - 1.0).abs() < 0.01, "the film travels at {speed} of the entrainment speed");
    assert!((after / before - 1.0).abs() < 0.03, "its change of {before:e} becomes one of {after:e}");
    assert!(before > 0.1 * depth, "{before:e} of {depth:e}");
    assert!(largest_under_dent < 0.05 * depth, "{largest_under_dent:e} of {depth:e} is left of the dent");
}

/// A wave of a surface at half the entrainment speed is pressed flat in the contact, but for the compression of the oil; the
/// inlet sends a wave of the same period with the fluid, which is twice as long (Greenwood and Morales-Espejel 1994).
#[test]
fn wave_of_a_sliding_surface_is_flat_and_its_inlet_wave_moves_with_the_fluid() {
    let found = Rolling::line(256).unwrap().sliding(0.5, 0.5).unwrap();
    assert!((found.carried_length - 2.0).abs() < 0.06, "{found:?}");
    assert!((found.surface - found.stiff_oil).abs() < 0.02, "{found:?}");
    assert!(found.carried > 5.0 * found.surface && found.carried < 1.0, "{found:?}");
}

#[test]
fn long_steps_are_quasi_steady() {
    let mut rolling = Rolling::line(256).unwrap();
    let smooth = rolling.smooth_gap();
    let wavy: Vec<f64> = (rolling.grid.nodes().zip(&smooth))
        .map(|((x, _), height)| height + 1e-6 * (2.0 * PI * x / rolling.half_width).cos())
        .collect();
    let steady = Passage::start(&mut rolling, &wavy, 1.0).unwrap().state.film;
    let crossing = rolling.half_width / rolling.speed;
    let apart = [1e2, 1e4, 1e6].map(|steps| {
        let mut passage = Passage::start(&mut rolling, &smooth, steps * crossing).unwrap();
        passage.step(&mut rolling, &wavy, false).unwrap();
        let films = passage.state.film.iter().zip(&steady);
        films.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    });
    assert!(apart[2] < 1e-6 && apart[1] < 0.02 * apart[0], "{apart:?}");
}
