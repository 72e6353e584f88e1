//! Integration of `dh/dt = f(h)` over a step of any length: adaptive exponential Euler.
//!
//! A film that starts far from its balance moves fast and then hardly at all, and time steps of a history are
//! long: explicit steps would need to be many. Exponential Euler is exact for rates that are linear in the
//! film, `f = J (h - h_0)`; a whole substep and two half ones tell the error, which sets the length of the
//! next. A substep within which the rate changes its sign is shortened, and the last one ends by bisection at
//! the balance point: a film does not swing about it.

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
    let Some(mut flow) = Flow::new(ceiling, start, time_step) else { return start.max(0.0) };
    let mut asked = flow.thickness;
    while let Some(next) = flow.answer(rate(asked)) {
        asked = next;
    }
    flow.thickness
}

/// Advances `thickness` \[m\], one value a node, by `time_step` \[s\] as
/// [`FilmGrowthLaw::advance`](super::FilmGrowthLaw::advance) does by default, to the same last bit, for a law
/// that gives the rates of all nodes at once: `rates(thickness, out)` overwrites `out` \[m/s\] with those of
/// films of `thickness` \[m\]. Nodes that have arrived are asked for on, with the thickness of their last
/// question. `largest` is the thickness \[m\] that growth alone approaches.
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
    let mut flows: Vec<Option<Flow>> =
        thickness.iter().map(|start| Flow::new(largest, *start, time_step)).collect();
    let mut asked: Vec<f64> = thickness.iter().map(|start| start.max(0.0)).collect();
    let mut answers = vec![0.0; thickness.len()];
    thickness.copy_from_slice(&asked);
    while flows.iter().any(Option::is_some) {
        rates(&asked, &mut answers);
        for (k, flow) in flows.iter_mut().enumerate() {
            let Some(open) = flow else { continue };
            match open.answer(answers[k]) {
                Some(next) => asked[k] = next,
                None => {
                    thickness[k] = open.thickness;
                    *flow = None;
                }
            }
        }
    }
}

/// What a rate was asked for.
#[derive(Debug, Clone, Copy)]
enum Question {
    /// That of the film as it is.
    Here,
    /// Beside it, for the slope.
    Slope,
    /// Half a substep on.
    Middle,
    /// Beside that, for the slope there.
    MiddleSlope,
    /// A whole substep on, in two halves.
    Next,
    /// Beside the film, for the slope of what is left of the time.
    LastSlope,
    /// At the end of it.
    End,
    /// Between a thickness this side of a balance point and one beyond.
    Between,
}

/// The way of one film through a step. It asks for the rate at one thickness after the other, so that many
/// films can go side by side.
#[derive(Debug, Clone, Copy)]
struct Flow {
    /// Largest thickness, which errors are relative to \[m\].
    scale: f64,
    /// Upper bound of the film \[m\].
    top: f64,
    /// Film at the time reached \[m\].
    thickness: f64,
    /// Time that is left \[s\].
    left: f64,
    /// Length of the substep under way \[s\].
    step: f64,
    /// Substeps tried, or bisections at the end.
    trials: usize,
    /// What the next answer is the rate of.
    question: Question,
    /// Rate at the film reached \[m/s\].
    rate: f64,
    /// Film after one whole substep \[m\].
    whole: f64,
    /// Film after the first half, or between bounds of a balance point \[m\].
    middle: f64,
    /// Rate there \[m/s\].
    middle_rate: f64,
    /// Film after two halves, extrapolated \[m\].
    next: f64,
    /// Distance of both, relative to the scale.
    error: f64,
}

impl Flow {
    /// None where the film stays as it is.
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
            question: Question::Here,
            rate: 0.0,
            whole: 0.0,
            middle: 0.0,
            middle_rate: 0.0,
            next: 0.0,
            error: 0.0,
        })
    }

    /// Takes the rate that was asked for, first that at the start, and returns the thickness whose rate is
    /// needed next; none at the end of the step.
    fn answer(&mut self, rate: f64) -> Option<f64> {
        match self.question {
            Question::Here => self.begin(rate),
            Question::Slope => {
                let slope = self.slope(self.thickness, self.rate, rate);
                self.whole = self.exponential_euler(self.thickness, self.rate, slope, self.step);
                self.middle = self.exponential_euler(self.thickness, self.rate, slope, 0.5 * self.step);
                self.ask(Question::Middle, self.middle)
            }
            Question::Middle => self.at_middle(rate),
            Question::MiddleSlope => {
                let slope = self.slope(self.middle, self.middle_rate, rate);
                let halves = self.exponential_euler(self.middle, self.middle_rate, slope, 0.5 * self.step);
                self.extrapolate(halves)
            }
            Question::Next => {
                let crossed = reverses(self.rate, rate);
                self.decide(self.next, if crossed { f64::INFINITY } else { self.error })
            }
            Question::LastSlope => {
                let slope = self.slope(self.thickness, self.rate, rate);
                self.next = self.exponential_euler(self.thickness, self.rate, slope, self.left);
                self.ask(Question::End, self.next)
            }
            Question::End if !reverses(self.rate, rate) => self.end_at(self.next),
            Question::End => {
                self.trials = 0;
                self.halve()
            }
            Question::Between => {
                if rate * self.rate > 0.0 {
                    self.thickness = self.middle;
                } else {
                    self.next = self.middle;
                }
                self.trials += 1;
                if self.trials == BISECTIONS { None } else { self.halve() }
            }
        }
    }

    /// Asks for the rate at `thickness`, for the purpose of `question`.
    fn ask(&mut self, question: Question, thickness: f64) -> Option<f64> {
        self.question = question;
        Some(thickness)
    }

    /// Ends the step with this thickness.
    fn end_at(&mut self, thickness: f64) -> Option<f64> {
        self.thickness = thickness;
        None
    }

    /// Begins a substep, or the rest of the step after too many of them, at the film as it is with its
    /// `rate`.
    fn begin(&mut self, rate: f64) -> Option<f64> {
        let last = self.trials == MAX_TRIALS;
        if (!last && self.left <= 0.0) || self.at_rest(self.thickness, rate) {
            return None;
        }
        self.trials += 1;
        self.rate = rate;
        let beside = self.thickness + self.probe(self.thickness, rate);
        self.ask(if last { Question::LastSlope } else { Question::Slope }, beside)
    }

    /// Takes the rate half a substep on; a change of sign makes the substep shorter.
    fn at_middle(&mut self, rate: f64) -> Option<f64> {
        self.middle_rate = rate;
        if reverses(self.rate, rate) {
            return self.decide(self.middle, f64::INFINITY);
        }
        if self.at_rest(self.middle, rate) || rate * self.rate.signum() < 0.0 {
            return self.extrapolate(self.middle);
        }
        let beside = self.middle + self.probe(self.middle, rate);
        self.ask(Question::MiddleSlope, beside)
    }

    /// Two half steps, extrapolated by Richardson, and their relative distance from one whole step.
    fn extrapolate(&mut self, halves: f64) -> Option<f64> {
        self.next = (halves + (halves - self.whole) / 3.0).clamp(0.0, self.top);
        self.error = (halves - self.whole).abs() / self.scale;
        self.ask(Question::Next, self.next)
    }

    /// Takes the substep to `next` or a shorter one; `error` is infinite when a balance point was crossed.
    fn decide(&mut self, next: f64, error: f64) -> Option<f64> {
        if error > TOLERANCE {
            self.step *= (0.8 * (TOLERANCE / error).cbrt()).clamp(0.02, 0.5);
        } else {
            self.thickness = next;
            self.left -= self.step;
            let longer = (0.8 * (TOLERANCE / error.max(1e-300)).cbrt()).clamp(1.0, 8.0);
            self.step = self.left.min(self.step * longer);
        }
        self.ask(Question::Here, self.thickness)
    }

    /// Asks half-way between the film and the thickness beyond the balance point.
    fn halve(&mut self) -> Option<f64> {
        self.middle = 0.5 * (self.thickness + self.next);
        self.ask(Question::Between, self.middle)
    }

    /// Whether nothing can move: no usable rate, or one that pushes against a bound.
    fn at_rest(&self, thickness: f64, rate: f64) -> bool {
        !rate.is_finite()
            || rate.abs() <= 0.0
            || (rate < 0.0 && thickness <= 0.0)
            || (rate > 0.0 && thickness >= self.top)
    }

    /// Distance to where the slope is probed, on the side the film comes from, where no bound or kink ahead
    /// disturbs it.
    fn probe(&self, from: f64, rate: f64) -> f64 {
        let behind = -rate.signum() * PROBE * self.scale;
        if (0.0..=self.top).contains(&(from + behind)) { behind } else { -behind }
    }

    /// `J = (f(h + probe) - f(h)) / probe` \[1/s\].
    fn slope(&self, from: f64, rate: f64, beside: f64) -> f64 {
        (beside - rate) / self.probe(from, rate)
    }

    /// `h + dt phi(J dt) f`, `phi(z) = (e^z - 1)/z`, J the slope of the rate.
    fn exponential_euler(&self, from: f64, rate: f64, slope: f64, step: f64) -> f64 {
        let exponent = if slope.is_finite() { (slope * step).min(500.0) } else { 0.0 };
        let phi = if exponent.abs() < 1e-12 { 1.0 } else { exponent.exp_m1() / exponent };
        (from + step * phi * rate).clamp(0.0, self.top)
    }
}

/// Whether `now` points the other way than `before`, rounding aside, or is not a number.
fn reverses(before: f64, now: f64) -> bool {
    !now.is_finite() || (now * before.signum() < -ROUNDING * before.abs())
}
