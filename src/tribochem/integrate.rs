//! Integration of `dh/dt = f(h)` over a step of any length by adaptive exponential Euler.
//!
//! Far from its equilibrium a film changes fast, close to it slowly, and the time steps of a history are
//! long: explicit integration would need many substeps. Exponential Euler is exact for rates that are linear
//! in the film, `f = J (h - h_0)`. The difference between one full and two half substeps estimates the error
//! and sets the next substep. A substep in which the rate changes sign is shortened, and the last one ends by
//! bisection at the equilibrium, so the film does not oscillate about it.

/// Accepted difference between one full and two half substeps, relative to the largest thickness. With
/// Richardson extrapolation the error over a step is below 1e-5 for smooth laws.
const TOLERANCE: f64 = 1e-5;
/// Increment of the difference quotient for the slope of the rate, relative to the largest thickness.
const PROBE: f64 = 1e-5;
/// Number of substeps, accepted or rejected, after which the remaining time is one substep.
const MAX_TRIALS: usize = 200;
/// Reversed rates below this fraction of the initial rate count as rounding errors at the equilibrium.
const ROUNDING: f64 = 1e-9;
/// Number of bisections at an equilibrium.
const BISECTIONS: usize = 60;

/// Thickness after `time_step` from `start` with the rate `rate(thickness)`, within
/// `0..=max(ceiling, start)`.
pub(super) fn integrate(rate: impl Fn(f64) -> f64, ceiling: f64, start: f64, time_step: f64) -> f64 {
    let Some(mut step) = FilmStep::new(ceiling, start, time_step) else { return start.max(0.0) };
    let mut requested = step.thickness;
    while let Some(next) = step.advance(rate(requested)) {
        requested = next;
    }
    step.thickness
}

/// Advances `thickness` \[m\], one value per node, by `time_step` \[s\]. The result is bit-identical to the
/// default of [`FilmGrowthLaw::advance`](super::FilmGrowthLaw::advance), for a law that computes the rates of
/// all nodes together: `rates(thickness, out)` overwrites `out` \[m/s\] with the rates of films of
/// `thickness` \[m\]. Finished nodes remain in the argument with their last thickness. `largest` is the
/// thickness limit of growth \[m\].
///
/// ```
/// use stribeck::tribochem::integrate_rates;
/// let mut thickness = [0.0, 50e-9];
/// let rates = |h: &[f64], out: &mut [f64]| h.iter().zip(out).for_each(|(h, out)| *out = 1e-3 * (100e-9 - h));
/// integrate_rates(rates, 100e-9, 1000.0, &mut thickness);
/// assert!((thickness[0] - 100e-9 * (1.0 - (-1.0_f64).exp())).abs() < 1e-18);
/// ```
pub fn integrate_rates(
    mut rates: impl FnMut(&[f64], &mut [f64]),
    largest: f64,
    time_step: f64,
    thickness: &mut [f64],
) {
    let mut steps: Vec<Option<FilmStep>> =
        thickness.iter().map(|start| FilmStep::new(largest, *start, time_step)).collect();
    let mut requested: Vec<f64> = thickness.iter().map(|start| start.max(0.0)).collect();
    let mut results = vec![0.0; thickness.len()];
    thickness.copy_from_slice(&requested);
    while steps.iter().any(Option::is_some) {
        rates(&requested, &mut results);
        for (k, step) in steps.iter_mut().enumerate() {
            let Some(open) = step else { continue };
            match open.advance(results[k]) {
                Some(next) => requested[k] = next,
                None => {
                    thickness[k] = open.thickness;
                    *step = None;
                }
            }
        }
    }
}

/// Purpose of a requested rate.
#[derive(Debug, Clone, Copy)]
enum Stage {
    /// Rate at the start of a substep.
    Start,
    /// Slope at the start of a substep.
    StartSlope,
    /// Rate after half a substep.
    Middle,
    /// Slope after half a substep.
    MiddleSlope,
    /// Rate after the substep.
    Substep,
    /// Slope for the remaining time.
    RemainderSlope,
    /// Rate at the end of the remaining time.
    End,
    /// Bisection between both sides of an equilibrium.
    Bisection,
}

/// Integration of one film over a step, as a coroutine that requests one rate at a time; many films then
/// advance in parallel.
#[derive(Debug, Clone, Copy)]
struct FilmStep {
    /// Largest thickness, the scale of errors \[m\].
    scale: f64,
    /// Upper bound of the film \[m\].
    top: f64,
    /// Film at the current time \[m\].
    thickness: f64,
    /// Remaining time \[s\].
    left: f64,
    /// Length of the current substep \[s\].
    step: f64,
    /// Number of substeps, or of bisections at the end.
    trials: usize,
    /// Purpose of the requested rate.
    stage: Stage,
    /// Rate at the current film \[m/s\].
    rate: f64,
    /// Film after one full substep \[m\].
    whole: f64,
    /// Film after half a substep, or the midpoint of a bisection \[m\].
    middle: f64,
    /// Rate at that film \[m/s\].
    middle_rate: f64,
    /// Film after two half substeps, extrapolated \[m\].
    next: f64,
    /// Difference of full and half substeps, relative to the scale.
    error: f64,
}

impl FilmStep {
    /// `None` where the film does not change.
    fn new(ceiling: f64, start: f64, time_step: f64) -> Option<Self> {
        let start = start.max(0.0);
        let moves = time_step.is_finite() && time_step > 0.0 && ceiling.is_finite() && ceiling > 0.0;
        moves.then_some(Self {
            scale: ceiling,
            top: ceiling.max(start),
            thickness: start,
            left: time_step,
            step: time_step,
            trials: 0,
            stage: Stage::Start,
            rate: 0.0,
            whole: 0.0,
            middle: 0.0,
            middle_rate: 0.0,
            next: 0.0,
            error: 0.0,
        })
    }

    /// Processes the requested rate, initially that at the start, and returns the thickness of the next
    /// request; `None` at the end of the step.
    fn advance(&mut self, rate: f64) -> Option<f64> {
        match self.stage {
            Stage::Start => self.begin_substep(rate),
            Stage::StartSlope => {
                let slope = self.slope(self.thickness, self.rate, rate);
                self.whole = self.exponential_euler(self.thickness, self.rate, slope, self.step);
                self.middle = self.exponential_euler(self.thickness, self.rate, slope, 0.5 * self.step);
                self.request(Stage::Middle, self.middle)
            }
            Stage::Middle => self.at_middle(rate),
            Stage::MiddleSlope => {
                let slope = self.slope(self.middle, self.middle_rate, rate);
                let halves = self.exponential_euler(self.middle, self.middle_rate, slope, 0.5 * self.step);
                self.extrapolate(halves)
            }
            Stage::Substep => {
                let crossed = reverses(self.rate, rate);
                self.accept_or_shorten(self.next, if crossed { f64::INFINITY } else { self.error })
            }
            Stage::RemainderSlope => {
                let slope = self.slope(self.thickness, self.rate, rate);
                self.next = self.exponential_euler(self.thickness, self.rate, slope, self.left);
                self.request(Stage::End, self.next)
            }
            Stage::End if !reverses(self.rate, rate) => self.finish(self.next),
            Stage::End => {
                self.trials = 0;
                self.bisect()
            }
            Stage::Bisection => {
                if rate * self.rate > 0.0 {
                    self.thickness = self.middle;
                } else {
                    self.next = self.middle;
                }
                self.trials += 1;
                if self.trials == BISECTIONS { None } else { self.bisect() }
            }
        }
    }

    /// Requests the rate at `thickness`.
    fn request(&mut self, stage: Stage, thickness: f64) -> Option<f64> {
        self.stage = stage;
        Some(thickness)
    }

    /// Ends the step with this thickness.
    fn finish(&mut self, thickness: f64) -> Option<f64> {
        self.thickness = thickness;
        None
    }

    /// Begins a substep, or the rest of the step after too many substeps, from the current film with its
    /// `rate`.
    fn begin_substep(&mut self, rate: f64) -> Option<f64> {
        let last = self.trials == MAX_TRIALS;
        if (!last && self.left <= 0.0) || self.is_stationary(self.thickness, rate) {
            return None;
        }
        self.trials += 1;
        self.rate = rate;
        let beside = self.thickness + self.probe(self.thickness, rate);
        self.request(if last { Stage::RemainderSlope } else { Stage::StartSlope }, beside)
    }

    /// Processes the rate after half a substep; a change of sign rejects the substep.
    fn at_middle(&mut self, rate: f64) -> Option<f64> {
        self.middle_rate = rate;
        if reverses(self.rate, rate) {
            return self.accept_or_shorten(self.middle, f64::INFINITY);
        }
        if self.is_stationary(self.middle, rate) || rate * self.rate.signum() < 0.0 {
            return self.extrapolate(self.middle);
        }
        let beside = self.middle + self.probe(self.middle, rate);
        self.request(Stage::MiddleSlope, beside)
    }

    /// Richardson extrapolation of two half substeps, and their relative difference from the full one.
    fn extrapolate(&mut self, halves: f64) -> Option<f64> {
        self.next = (halves + (halves - self.whole) / 3.0).clamp(0.0, self.top);
        self.error = (halves - self.whole).abs() / self.scale;
        self.request(Stage::Substep, self.next)
    }

    /// Accepts the substep to `next` or shortens it; `error` is infinite across an equilibrium.
    fn accept_or_shorten(&mut self, next: f64, error: f64) -> Option<f64> {
        if error > TOLERANCE {
            self.step *= (0.8 * (TOLERANCE / error).cbrt()).clamp(0.02, 0.5);
        } else {
            self.thickness = next;
            self.left -= self.step;
            let longer = (0.8 * (TOLERANCE / error.max(1e-300)).cbrt()).clamp(1.0, 8.0);
            self.step = self.left.min(self.step * longer);
        }
        self.request(Stage::Start, self.thickness)
    }

    /// Requests the midpoint between the film and the thickness beyond the equilibrium.
    fn bisect(&mut self) -> Option<f64> {
        self.middle = 0.5 * (self.thickness + self.next);
        self.request(Stage::Bisection, self.middle)
    }

    /// Whether the film is stationary: an unusable rate, or one toward an active bound.
    fn is_stationary(&self, thickness: f64, rate: f64) -> bool {
        !rate.is_finite()
            || rate.abs() <= 0.0
            || (rate < 0.0 && thickness <= 0.0)
            || (rate > 0.0 && thickness >= self.top)
    }

    /// Increment of the difference quotient, away from the direction of change, where no bound or kink
    /// interferes.
    fn probe(&self, from: f64, rate: f64) -> f64 {
        let behind = -rate.signum() * PROBE * self.scale;
        if (0.0..=self.top).contains(&(from + behind)) { behind } else { -behind }
    }

    /// `J = (f(h + probe) - f(h)) / probe` \[1/s\].
    fn slope(&self, from: f64, rate: f64, beside: f64) -> f64 {
        (beside - rate) / self.probe(from, rate)
    }

    /// `h + dt phi(J dt) f`, `phi(z) = (e^z - 1)/z`, with the slope J of the rate.
    fn exponential_euler(&self, from: f64, rate: f64, slope: f64, step: f64) -> f64 {
        let exponent = if slope.is_finite() { (slope * step).min(500.0) } else { 0.0 };
        let phi = if exponent.abs() < 1e-12 { 1.0 } else { exponent.exp_m1() / exponent };
        (from + step * phi * rate).clamp(0.0, self.top)
    }
}

/// Whether `now` has the opposite sign of `before` beyond rounding, or is NaN.
fn reverses(before: f64, now: f64) -> bool {
    !now.is_finite() || (now * before.signum() < -ROUNDING * before.abs())
}
