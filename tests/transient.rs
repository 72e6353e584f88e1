//! Contacts in time: waves that travel through line and point contacts with both surfaces, and the order of
//! the time step.

use std::f64::consts::PI;

use rayon::prelude::*;
use stribeck::analytic::HertzPoint;
use stribeck::elastic::{DeformationModel, HalfSpace, LineHalfSpace};
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Auto, ContactSolver, ContactState, FaceMobility, LubricatedContact, Scheme, Squeeze, StoppingRule,
};
use stribeck::{Grid, Status};

const RADIUS: f64 = 1.0;
const MODULUS: f64 = 226e9;
const ALPHA: f64 = 2.2e-8;
const ETA0: f64 = 0.04;
/// Moes parameters of the line contact, with the sum of the speeds.
const M: f64 = 100.0;
const L: f64 = 11.0;

fn oil() -> Lubricant {
    Lubricant::new(
        Roelands::from_alpha(ETA0, ALPHA, 0.68, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    )
}

/// A contact in pure rolling over waves whose crests lie across the flow.
struct Rolling {
    grid: Grid,
    body: Box<dyn DeformationModel>,
    oil: Lubricant,
    solver: Auto,
    half_width: f64,
    pressure: f64,
    speed: f64,
    load: f64,
    reference_film: f64,
    /// Node in the middle of the contact.
    middle: usize,
    /// Where the first wave comes in and how far past the middle it is followed, half-widths.
    way: [f64; 2],
    /// Periods that the amplitude is taken from.
    periods: f64,
}

impl Rolling {
    /// The line contact of `M` and `L`.
    fn line(nx: usize) -> Self {
        let speed_sum = (L / (ALPHA * MODULUS)).powi(4);
        let load = M * speed_sum.sqrt();
        let half_width = RADIUS * (8.0 * load / PI).sqrt();
        let grid = Grid::from_edges(nx, 1, [-4.0 * half_width, 1.5 * half_width], [-0.5, 0.5]).unwrap();
        Self {
            grid,
            body: Box::new(LineHalfSpace::new(grid, MODULUS, RADIUS).unwrap()),
            oil: oil(),
            solver: Auto::new(),
            half_width,
            pressure: MODULUS * (load / (2.0 * PI)).sqrt(),
            speed: 0.5 * speed_sum * MODULUS * RADIUS / ETA0,
            load: load * MODULUS * RADIUS,
            reference_film: 2e-5,
            middle: nx * 8 / 11,
            way: [-2.5, 0.6],
            periods: 2.0,
        }
    }

    /// A ball at L = 10 on a box of six by six half-widths.
    fn ball(moes_load: f64, n: usize) -> Self {
        let speed_sum = (10.0 / (ALPHA * MODULUS)).powi(4);
        let load = moes_load * speed_sum.powf(0.75) * MODULUS * RADIUS * RADIUS;
        let hertz = HertzPoint::from_load(RADIUS, RADIUS, MODULUS, load).unwrap();
        let a = hertz.half_width_x;
        let grid = Grid::from_edges(n, n, [-4.5 * a, 1.5 * a], [-3.0 * a, 3.0 * a]).unwrap();
        Self {
            grid,
            body: Box::new(HalfSpace::new(grid, MODULUS).unwrap()),
            oil: oil(),
            solver: Auto::new(),
            half_width: a,
            pressure: hertz.pressure,
            speed: 0.5 * speed_sum * MODULUS * RADIUS / ETA0,
            load,
            reference_film: 0.1 * a * a / RADIUS,
            middle: n / 2 * n + n * 3 / 4,
            way: [-2.0, 0.3],
            periods: 1.5,
        }
    }

    /// The gap without waves.
    fn smooth_gap(&self) -> Vec<f64> {
        self.grid.nodes().map(|(x, y)| (x * x + y * y) / (2.0 * RADIUS)).collect()
    }

    fn solve(&mut self, gap: &[f64], squeeze: Option<Squeeze<'_>>, state: &mut ContactState) {
        let mut problem = LubricatedContact::new(
            gap,
            &mut *self.body,
            self.load,
            (self.half_width, self.half_width),
            self.pressure,
        )
        .with_lubricant(Some(&self.oil))
        .with_entrainment_speed(self.speed)
        .with_squeeze(squeeze)
        .with_scheme(Scheme::SecondOrder)
        .with_face_mobility(FaceMobility::ReducedPressure)
        .with_reference_film(self.reference_film);
        let report = self.solver.solve(&mut problem, state, &StoppingRule::default()).unwrap();
        assert_eq!(report.status, Status::Converged, "{report:?}");
    }

    /// Runs a wave of length `wave` half-widths, whose amplitude is a tenth of the central film, through the
    /// contact, `cells` of the grid in a step; returns its amplitude in the middle of the contact over the
    /// undeformed one.
    fn amplitude(&mut self, wave: f64, cells: f64, second_order: bool) -> f64 {
        let (grid, middle) = (self.grid, self.middle);
        let (length, step_length) = (wave * self.half_width, cells * grid.dx());
        let time_step = step_length / self.speed;
        let smooth = self.smooth_gap();
        let mut passage = Passage::start(self, &smooth, time_step);
        let amplitude = 0.1 * passage.state.film[middle];
        let [start, end] = self.way.map(|x| x * self.half_width);
        let steps = ((end - start + (1.0 + self.periods) * length) / step_length) as usize;
        let mut films = Vec::with_capacity(steps);
        for step in 1..=steps {
            let front = start + step_length * step as f64;
            let waves = |x: f64| {
                let behind = front - x;
                let ramp = (behind / length).clamp(0.0, 1.0);
                ramp * ramp * (3.0 - 2.0 * ramp) * (2.0 * PI * behind / length).cos()
            };
            let gap: Vec<f64> =
                grid.nodes().zip(&smooth).map(|((x, _), height)| height + amplitude * waves(x)).collect();
            passage.step(self, &gap, second_order);
            films.push(passage.state.film[middle]);
        }
        let seen = (self.periods * length / step_length).round() as usize;
        let last = &films[films.len() - seen..];
        let highest = last.iter().copied().fold(0.0, f64::max);
        let lowest = last.iter().copied().fold(f64::INFINITY, f64::min);
        0.5 * (highest - lowest) / amplitude
    }
}

/// Contacts in equal steps of time, from the steady one on.
struct Passage {
    state: ContactState,
    masses: [Vec<f64>; 2],
    combined: Vec<f64>,
    time_step: f64,
}

impl Passage {
    fn start(rolling: &mut Rolling, gap: &[f64], time_step: f64) -> Self {
        let mut state = ContactState::new(&rolling.grid);
        rolling.solve(gap, None, &mut state);
        let masses = [state.mass.clone(), state.mass.clone()];
        Self { state, masses, combined: vec![0.0; gap.len()], time_step }
    }

    fn step(&mut self, rolling: &mut Rolling, gap: &[f64], second_order: bool) {
        let [newest, oldest] = &self.masses;
        let squeeze = if second_order {
            Squeeze::second_order([newest, oldest], [self.time_step; 2], &mut self.combined).unwrap()
        } else {
            Squeeze { previous_mass: newest, time_step: self.time_step }
        };
        rolling.solve(gap, Some(squeeze), &mut self.state);
        self.masses.swap(0, 1);
        self.masses[0].clone_from(&self.state.mass);
    }
}

/// Amplitudes of waves of a tenth of the central film at M = 100, L = 11 (Venner and Lubrecht 2000).
#[test]
fn waves_in_pure_rolling_are_flattened_as_known() {
    for (nx, wave, cells, known) in [
        (512, 4.0, 8.0, 0.030),
        (512, 2.0, 4.0, 0.073),
        (512, 1.0, 2.0, 0.183),
        (512, 0.5, 1.0, 0.394),
        (1024, 0.25, 1.0, 0.660),
    ] {
        let found = Rolling::line(nx).amplitude(wave, cells, true);
        assert!((found - known).abs() < 0.01, "wave of {wave}: {found}, known {known}");
    }
}

#[test]
fn second_order_in_time_is_of_second_order_and_first_order_is_not() {
    let found = |second| [4.0, 2.0, 1.0].map(|cells| Rolling::line(512).amplitude(1.0, cells, second));
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
fn waves_under_a_ball_are_flattened_by_the_master_curve() {
    let cases = [(5.0, 0.75, 1.0), (20.0, 1.0, 1.0), (100.0, 1.0, 1.0), (100.0, 2.0, 2.0), (100.0, 3.0, 3.0)];
    cases.into_par_iter().for_each(|(moes_load, wave, cells)| {
        let n: f64 = wave * (moes_load / 10.0_f64).sqrt();
        let curve = 1.0 / (1.0 + 0.15 * n + 0.015 * n * n);
        let found = Rolling::ball(moes_load, 128).amplitude(wave, cells, true);
        assert!((found - curve).abs() < 0.08, "n {n}: {found}, master curve {curve}");
    });
}

/// A dent on a surface at half the entrainment speed: what it does to the film at the inlet travels ahead of
/// it, at the entrainment speed, while the dent itself is pressed nearly flat.
#[test]
fn the_film_that_a_dent_lets_in_runs_ahead_of_it() {
    let mut rolling = Rolling::line(512);
    let (grid, half_width, middle) = (rolling.grid, rolling.half_width, rolling.middle);
    let smooth = rolling.smooth_gap();
    let time_step = grid.dx() / rolling.speed;
    let mut passage = Passage::start(&mut rolling, &smooth, time_step);
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
        passage.step(&mut rolling, &gap, true);
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

#[test]
fn long_steps_are_quasi_steady() {
    let mut rolling = Rolling::line(256);
    let smooth = rolling.smooth_gap();
    let wavy: Vec<f64> = (rolling.grid.nodes().zip(&smooth))
        .map(|((x, _), height)| height + 1e-6 * (2.0 * PI * x / rolling.half_width).cos())
        .collect();
    let steady = Passage::start(&mut rolling, &wavy, 1.0).state.film;
    let crossing = rolling.half_width / rolling.speed;
    let apart = [1e2, 1e4, 1e6].map(|steps| {
        let mut passage = Passage::start(&mut rolling, &smooth, steps * crossing);
        passage.step(&mut rolling, &wavy, false);
        let films = passage.state.film.iter().zip(&steady);
        films.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    });
    assert!(apart[2] < 1e-6 && apart[1] < 0.02 * apart[0], "{apart:?}");
}
