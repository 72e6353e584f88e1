//! Smooth contacts in time: waves and dents that travel through them. Shared by tests and the study `validation`.

use std::error::Error;
use std::f64::consts::PI;

use stribeck::Grid;
use stribeck::analytic::HertzPoint;
use stribeck::elastic::{DeformationModel, HalfSpace, LineHalfSpace};
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Auto, CarriedWaves, ContactSolver, ContactState, FaceMobility, LubricatedContact, Scheme, Squeeze,
    StoppingRule,
};

/// A result whose error may cross threads.
pub(crate) type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

const RADIUS: f64 = 1.0;
const MODULUS: f64 = 226e9;
const ALPHA: f64 = 2.2e-8;
const ETA0: f64 = 0.04;
/// Moes parameters of the line contact, with the sum of the speeds.
const M: f64 = 100.0;
const L: f64 = 11.0;

fn oil() -> Outcome<Lubricant> {
    Ok(Lubricant::new(
        Roelands::from_alpha(ETA0, ALPHA, 0.68, 1.96e8)?,
        DowsonHigginson::new(0.6e-9, 1.7e-9)?,
    ))
}

/// A contact in pure rolling over waves whose crests lie across the flow.
pub(crate) struct Rolling {
    pub(crate) radius: f64,
    pub(crate) grid: Grid,
    pub(crate) body: Box<dyn DeformationModel>,
    pub(crate) oil: Lubricant,
    pub(crate) solver: Auto,
    pub(crate) half_width: f64,
    pub(crate) pressure: f64,
    pub(crate) speed: f64,
    pub(crate) load: f64,
    pub(crate) reference_film: f64,
    /// Node in the middle of the contact.
    pub(crate) middle: usize,
    /// Where the first wave comes in and how far past the middle it is followed, half-widths.
    pub(crate) way: [f64; 2],
    /// Periods that the amplitude is taken from.
    pub(crate) periods: f64,
}

impl Rolling {
    /// The line contact of `M` and `L`.
    pub(crate) fn line(nx: usize) -> Outcome<Self> {
        let speed_sum = (L / (ALPHA * MODULUS)).powi(4);
        let load = M * speed_sum.sqrt();
        let half_width = RADIUS * (8.0 * load / PI).sqrt();
        let grid = Grid::from_edges(nx, 1, [-4.0 * half_width, 1.5 * half_width], [-0.5, 0.5])?;
        Ok(Self {
            radius: RADIUS,
            grid,
            body: Box::new(LineHalfSpace::new(grid, MODULUS, RADIUS)?),
            oil: oil()?,
            solver: Auto::new(),
            half_width,
            pressure: MODULUS * (load / (2.0 * PI)).sqrt(),
            speed: 0.5 * speed_sum * MODULUS * RADIUS / ETA0,
            load: load * MODULUS * RADIUS,
            reference_film: 2e-5,
            middle: nx * 8 / 11,
            way: [-2.5, 0.6],
            periods: 2.0,
        })
    }

    /// A ball at L = 10 on a box of six by six half-widths.
    pub(crate) fn ball(moes_load: f64, n: usize) -> Outcome<Self> {
        let speed_sum = (10.0 / (ALPHA * MODULUS)).powi(4);
        let load = moes_load * speed_sum.powf(0.75) * MODULUS * RADIUS * RADIUS;
        let hertz = HertzPoint::from_load(RADIUS, RADIUS, MODULUS, load)?;
        let a = hertz.half_width_x;
        let grid = Grid::from_edges(n, n, [-4.5 * a, 1.5 * a], [-3.0 * a, 3.0 * a])?;
        Ok(Self {
            radius: RADIUS,
            grid,
            body: Box::new(HalfSpace::new(grid, MODULUS)?),
            oil: oil()?,
            solver: Auto::new(),
            half_width: a,
            pressure: hertz.pressure,
            speed: 0.5 * speed_sum * MODULUS * RADIUS / ETA0,
            load,
            reference_film: 0.1 * a * a / RADIUS,
            middle: n / 2 * n + n * 3 / 4,
            way: [-2.0, 0.3],
            periods: 1.5,
        })
    }

    /// The gap without waves.
    pub(crate) fn smooth_gap(&self) -> Vec<f64> {
        self.grid.nodes().map(|(x, y)| (x * x + y * y) / (2.0 * self.radius)).collect()
    }

    fn solve(&mut self, gap: &[f64], squeeze: Option<Squeeze<'_>>, state: &mut ContactState) -> Outcome<()> {
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
        let report = self.solver.solve(&mut problem, state, &StoppingRule::default())?;
        Ok(report.require_converged()?)
    }

    /// Runs a wave of length `wave` half-widths, whose amplitude is a tenth of the central film, through the
    /// contact, `cells` of the grid in a step; returns its amplitude in the middle of the contact over the
    /// undeformed one.
    pub(crate) fn amplitude(&mut self, wave: f64, cells: f64, second_order: bool) -> Outcome<f64> {
        let (grid, middle) = (self.grid, self.middle);
        let (length, step_length) = (wave * self.half_width, cells * grid.dx());
        let time_step = step_length / self.speed;
        let smooth = self.smooth_gap();
        let mut passage = Passage::start(self, &smooth, time_step)?;
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
            passage.step(self, &gap, second_order)?;
            films.push(passage.state.film[middle]);
        }
        let seen = (self.periods * length / step_length).round() as usize;
        let last = &films[films.len() - seen..];
        let highest = last.iter().copied().fold(0.0, f64::max);
        let lowest = last.iter().copied().fold(f64::INFINITY, f64::min);
        Ok(0.5 * (highest - lowest) / amplitude)
    }

    /// Runs a wave of about `wave` half-widths, whose amplitude is a tenth of the central film, through the contact on a
    /// surface at the speed `ratio` times that of entrainment, one cell of the fluid in a step.
    #[allow(dead_code, reason = "not every program that shares this file slides")]
    pub(crate) fn sliding(&mut self, wave: f64, ratio: f64) -> Outcome<SlidingWave> {
        let (grid, a) = (self.grid, self.half_width);
        let step_length = ratio * grid.dx();
        let period = (wave * a / step_length).round();
        let length = period * step_length;
        let smooth = self.smooth_gap();
        let mut passage = Passage::start(self, &smooth, grid.dx() / self.speed)?;
        passage.carries_waves = true;
        let central = passage.state.film[self.middle];
        let amplitude = 0.1 * central;
        let [start, end] = self.way.map(|x| x * a);
        let steps = ((end - start + 2.0 * length) / step_length).ceil() as usize;
        // Fourier coefficients over the last period, at the nodes in the middle of the contact.
        let nodes: Vec<usize> = (0..grid.len()).filter(|k| grid.x(*k).abs() < 0.5 * a).collect();
        let mut waves = vec![[0.0; 2]; nodes.len()];
        for step in 1..=steps + period as usize {
            let front = start + step_length * step as f64;
            let height = |x: f64| {
                let behind = front - x;
                let ramp = (behind / length).clamp(0.0, 1.0);
                amplitude * ramp * ramp * (3.0 - 2.0 * ramp) * (2.0 * PI * behind / length).cos()
            };
            let gap: Vec<f64> = grid.nodes().zip(&smooth).map(|((x, _), form)| form + height(x)).collect();
            passage.step(self, &gap, true)?;
            if step > steps {
                let (sine, cosine) = (2.0 * PI * step as f64 / period).sin_cos();
                for (wave, node) in waves.iter_mut().zip(&nodes) {
                    let film = 2.0 / period * passage.state.film[*node];
                    *wave = [wave[0] + film * cosine, wave[1] - film * sine];
                }
            }
        }
        let places: Vec<f64> = nodes.iter().map(|node| grid.x(*node)).collect();
        let number = 2.0 * PI / length;
        let fits = (0..=400).map(|k| {
            let factor = 0.8 + 0.001 * f64::from(k);
            (factor, two_waves(&places, &waves, [number, factor * ratio * number]))
        });
        let best = fits.min_by(|(_, a), (_, b)| a.2.total_cmp(&b.2));
        let (factor, (surface, carried, _)) = best.ok_or("no fit")?;
        // (rho h)' = 0 under a wave that slides through stiff oil: h' = -beta h p', with h' = A + 4 p'/(E' k).
        let pressure = self.pressure;
        let compressibility = 0.6e-9 / ((1.0 + 1.7e-9 * pressure) * (1.0 + 2.3e-9 * pressure));
        let ratio_of_stiffness = central * compressibility * MODULUS * number / 4.0;
        Ok(SlidingWave {
            carried_length: 1.0 / (factor * ratio),
            carried: carried / amplitude,
            surface: surface / amplitude,
            stiff_oil: ratio_of_stiffness / (1.0 + ratio_of_stiffness),
        })
    }
}

/// Waves of the film in the middle of a contact, one surface of which has a wave and slides.
#[derive(Debug)]
#[allow(dead_code, reason = "not every program that shares this file slides")]
pub(crate) struct SlidingWave {
    /// Length of the wave that the inlet sends with the fluid, over that of the surface.
    pub(crate) carried_length: f64,
    /// Its amplitude over the undeformed one.
    pub(crate) carried: f64,
    /// Amplitude of the wave that moves with the surface, over the undeformed one.
    pub(crate) surface: f64,
    /// The same in the limit of stiff oil.
    pub(crate) stiff_oil: f64,
}

/// Amplitudes of `exp(-i k x)` of both wave numbers in the complex `values` at `places`, by least squares, and the sum of
/// the squared residuals.
fn two_waves(places: &[f64], values: &[[f64; 2]], [first, second]: [f64; 2]) -> (f64, f64, f64) {
    let times = |a: [f64; 2], b: [f64; 2]| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let sum = |number: f64, of: &dyn Fn(usize) -> [f64; 2]| {
        places.iter().enumerate().fold([0.0; 2], |sum, (k, x)| {
            let (sine, cosine) = (number * x).sin_cos();
            let term = times(of(k), [cosine, sine]);
            [sum[0] + term[0], sum[1] + term[1]]
        })
    };
    let count = places.len() as f64;
    let overlap = sum(first - second, &|_| [1.0, 0.0]);
    let [a, b] = [first, second].map(|number| sum(number, &|k| values[k]));
    let determinant = count * count - overlap[0].powi(2) - overlap[1].powi(2);
    let solve = |own: [f64; 2], other: [f64; 2], overlap: [f64; 2]| {
        let shared = times(overlap, other);
        [0, 1].map(|part| (count * own[part] - shared[part]) / determinant)
    };
    let x = solve(a, b, overlap);
    let y = solve(b, a, [overlap[0], -overlap[1]]);
    let energy: f64 = values.iter().map(|value| value[0].powi(2) + value[1].powi(2)).sum();
    let explained = a[0] * x[0] + a[1] * x[1] + b[0] * y[0] + b[1] * y[1];
    (x[0].hypot(x[1]), y[0].hypot(y[1]), energy - explained)
}

/// Contacts in equal steps of time, from the steady one on.
pub(crate) struct Passage {
    pub(crate) state: ContactState,
    masses: [Vec<f64>; 2],
    films: [Vec<f64>; 2],
    is_full: [Vec<bool>; 2],
    combined: Vec<f64>,
    pub(crate) time_step: f64,
    /// Whether waves of the film keep their amplitude, in steps of second order.
    pub(crate) carries_waves: bool,
}

impl Passage {
    pub(crate) fn start(rolling: &mut Rolling, gap: &[f64], time_step: f64) -> Outcome<Self> {
        let mut state = ContactState::new(&rolling.grid);
        rolling.solve(gap, None, &mut state)?;
        let masses = [state.mass.clone(), state.mass.clone()];
        let films = [state.film.clone(), state.film.clone()];
        let is_full = [is_full(&state), is_full(&state)];
        let combined = vec![0.0; gap.len()];
        Ok(Self { state, masses, films, is_full, combined, time_step, carries_waves: false })
    }

    pub(crate) fn step(&mut self, rolling: &mut Rolling, gap: &[f64], second_order: bool) -> Outcome<()> {
        let [newest, oldest] = &self.masses;
        let squeeze = if second_order {
            let Squeeze { time_step, .. } =
                Squeeze::second_order([newest, oldest], [self.time_step; 2], &mut self.combined)?;
            if self.carries_waves {
                let [now, before] = &self.is_full;
                let is_full: Vec<bool> =
                    now.iter().zip(before).map(|(now, before)| *now && *before).collect();
                let waves = CarriedWaves {
                    masses: [newest, oldest],
                    films: [&self.films[0], &self.films[1]],
                    is_full: &is_full,
                    cells: [rolling.speed * self.time_step / rolling.grid.dx(); 2],
                    nx: rolling.grid.nx(),
                    scheme: Scheme::SecondOrder,
                    second_order,
                };
                waves.correct(&mut self.combined)?;
            }
            Squeeze { previous_mass: &self.combined, time_step }
        } else {
            Squeeze { previous_mass: newest, time_step: self.time_step }
        };
        rolling.solve(gap, Some(squeeze), &mut self.state)?;
        self.masses.swap(0, 1);
        self.masses[0].clone_from(&self.state.mass);
        self.films.swap(0, 1);
        self.films[0].clone_from(&self.state.film);
        self.is_full.swap(0, 1);
        self.is_full[0] = is_full(&self.state);
        Ok(())
    }

    /// Mirrors a line contact in x, for flow in the other direction.
    #[allow(dead_code, reason = "not every program that shares this file reciprocates")]
    pub(crate) fn mirror(&mut self) {
        let state = &mut self.state;
        state.in_contact.reverse();
        let fields = [
            &mut state.pressure,
            &mut state.fluid_pressure,
            &mut state.film,
            &mut state.theta,
            &mut state.mass,
        ];
        fields.into_iter().chain(&mut self.masses).for_each(|field| field.reverse());
    }
}

/// Cells full of oil under pressure, without solid contact.
fn is_full(state: &ContactState) -> Vec<bool> {
    let at = |k: usize| state.theta[k] >= 1.0 && state.fluid_pressure[k] > 0.0 && !state.in_contact[k];
    (0..state.theta.len()).map(at).collect()
}
