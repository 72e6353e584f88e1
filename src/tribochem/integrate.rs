//! Integration of `dh/dt = f(h)` over a step of any length: adaptive exponential Euler.

/// Distance accepted between one whole and two half substeps, relative to the largest thickness;
/// extrapolation leaves errors below 1e-5 over a whole step of smooth laws.
const TOLERANCE: f64 = 1e-5;
/// Distance of the probe for the slope of the rate, relative to the largest thickness.
const PROBE: f64 = 1e-5;
/// Substeps tried, accepted or not, before the rest of the step is taken at once.
const MAX_TRIALS: usize = 200;
/// Reversed rates below this fraction of the starting rate count as rounding at the balance point.
const ROUNDING: f64 = 1e-9;
/// Halvings of the interval around a balance point.
const BISECTIONS: usize = 60;

/// Thickness after `time_step` from `start` with rate `rate(thickness)`, for `0 <= start`, staying within
/// `0..=max(ceiling, start)`.
pub(super) fn integrate(rate: impl Fn(f64) -> f64, ceiling: f64, start: f64, time_step: f64) -> f64 {
    let start = start.max(0.0);
    if time_step.is_finite() && time_step > 0.0 && ceiling.is_finite() && ceiling > 0.0 {
        Flow { rate, scale: ceiling, top: ceiling.max(start) }.run(start, time_step)
    } else {
        start
    }
}

struct Flow<F> {
    rate: F,
    scale: f64,
    top: f64,
}

impl<F: Fn(f64) -> f64> Flow<F> {
    fn run(&self, start: f64, time_step: f64) -> f64 {
        let (mut thickness, mut left, mut step) = (start, time_step, time_step);
        for _ in 0..MAX_TRIALS {
            let rate = (self.rate)(thickness);
            if left <= 0.0 || self.at_rest(thickness, rate) {
                return thickness;
            }
            let (next, error) = self.try_step(thickness, rate, step);
            if error > TOLERANCE {
                step *= (0.8 * (TOLERANCE / error).cbrt()).clamp(0.02, 0.5);
            } else {
                thickness = next;
                left -= step;
                step = left.min(step * (0.8 * (TOLERANCE / error.max(1e-300)).cbrt()).clamp(1.0, 8.0));
            }
        }
        let rate = (self.rate)(thickness);
        if self.at_rest(thickness, rate) { thickness } else { self.last_step(thickness, rate, left) }
    }

    /// Whether nothing can move: no usable rate, or one that pushes against a bound.
    fn at_rest(&self, thickness: f64, rate: f64) -> bool {
        !rate.is_finite()
            || rate.abs() <= 0.0
            || (rate < 0.0 && thickness <= 0.0)
            || (rate > 0.0 && thickness >= self.top)
    }

    /// Two half steps, extrapolated by Richardson, and their relative distance from one whole step; infinite
    /// when a balance point was crossed.
    fn try_step(&self, from: f64, rate: f64, step: f64) -> (f64, f64) {
        let whole = self.exponential_euler(from, rate, step);
        let middle = self.exponential_euler(from, rate, 0.5 * step);
        let middle_rate = (self.rate)(middle);
        if reverses(rate, middle_rate) {
            return (middle, f64::INFINITY);
        }
        let halves = if self.at_rest(middle, middle_rate) || middle_rate * rate.signum() < 0.0 {
            middle
        } else {
            self.exponential_euler(middle, middle_rate, 0.5 * step)
        };
        let next = (halves + (halves - whole) / 3.0).clamp(0.0, self.top);
        let crossed = reverses(rate, (self.rate)(next));
        (next, if crossed { f64::INFINITY } else { (halves - whole).abs() / self.scale })
    }

    /// `h + dt phi(J dt) f`, `phi(z) = (e^z - 1)/z`, J the slope of the rate by a probe on the side the film
    /// comes from, where no bound or kink ahead disturbs it.
    fn exponential_euler(&self, from: f64, rate: f64, step: f64) -> f64 {
        let behind = -rate.signum() * PROBE * self.scale;
        let probe = if (0.0..=self.top).contains(&(from + behind)) { behind } else { -behind };
        let slope = ((self.rate)(from + probe) - rate) / probe;
        let exponent = if slope.is_finite() { (slope * step).min(500.0) } else { 0.0 };
        let phi = if exponent.abs() < 1e-12 { 1.0 } else { exponent.exp_m1() / exponent };
        (from + step * phi * rate).clamp(0.0, self.top)
    }

    /// One step over the rest of the time, ended at the balance point should it cross one.
    fn last_step(&self, from: f64, rate: f64, step: f64) -> f64 {
        let to = self.exponential_euler(from, rate, step);
        if !reverses(rate, (self.rate)(to)) {
            return to;
        }
        let (mut here, mut beyond) = (from, to);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (here + beyond);
            if (self.rate)(middle) * rate > 0.0 {
                here = middle;
            } else {
                beyond = middle;
            }
        }
        here
    }
}

/// Whether `now` points the other way than `before`, rounding aside, or is not a number.
fn reverses(before: f64, now: f64) -> bool {
    !now.is_finite() || (now * before.signum() < -ROUNDING * before.abs())
}
