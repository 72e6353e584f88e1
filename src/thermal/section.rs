//! The film at one place: temperature across it, shear stress and viscosity.

use super::collocation::{Collocation, POINTS};
use crate::lubricant::{Rheology, ViscosityLaw};

/// Heat of shear is found to this relative error.
const TOLERANCE: f64 = 1e-10;
/// Evaluations of the stress at most.
const MAX_EVALUATIONS: usize = 60;
/// Passes over the shape of the heat across the film, each under the viscosities of the last.
const MAX_PASSES: usize = 60;
/// Change of a share of the heat below which its shape is found.
const SHAPE_TOLERANCE: f64 = 1e-11;
/// Secants to the temperature of a viscosity at most, and the last step of them \[K\].
const MAX_SECANTS: usize = 30;
const SECANT_TOLERANCE: f64 = 1e-6;

/// How the temperature across the film is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum FilmProfile {
    /// The film shears evenly, with the viscosity at its mean temperature: the profile is a parabola.
    #[default]
    Parabola,
    /// The shear stress is the same across the film and each layer shears by its own viscosity; heat
    /// conduction is collocated in eight points.
    Collocation,
}

/// The film at one place, and the heat that goes through it.
///
/// Across a film of thickness `h` under one shear stress `tau`
///
/// `k d2T/dz2 + tau du/dz + s = 0`, `T = T_1, T_2` at the surfaces, `integral of du/dz = u_s`,
///
/// with `du/dz = F(tau)/eta(p, T)` of the rheology, and `s` the heat that does not depend on its shear: that
/// of the flow by pressure, `q_p` (in proportion to the square of the distance from the middle), that of
/// compression, and less what the flow carries on, `C (T_m - T_a)`, both even across the film. `T_m` is the
/// mean across the film. With one viscosity across the film that is
///
/// `T_m = (T_1 + T_2)/2 + h/(12 k) [tau u_s + q_c - C (T_m - T_a)] + h/(20 k) q_p`.
///
/// The surfaces may follow the heat that leaves the film: `T_i + R (q - q_0)`.
#[derive(Debug, Clone, Copy)]
pub struct FilmSection<'a> {
    /// Viscosity by pressure and temperature; one that does not know temperature keeps its value.
    pub viscosity: &'a dyn ViscosityLaw,
    /// Shear stress of the fluid.
    pub rheology: &'a Rheology,
    /// Thermal conductivity `k` \[W/(m K)\].
    pub conductivity: f64,
    /// Pressure `p` \[Pa\].
    pub pressure: f64,
    /// Film thickness `h` \[m\].
    pub film: f64,
    /// Sliding speed `u_s`, not negative \[m/s\].
    pub sliding: f64,
    /// Temperatures of the surfaces `T_1, T_2` where the heat that leaves the film is `q_0` \[K\].
    pub surfaces: [f64; 2],
    /// `R` \[K m^2/W\] and `q_0` \[W/m^2\].
    pub response: (f64, f64),
    /// Heat of the flow by pressure `q_p` and of compression `q_c` \[W/m^2\].
    pub other_heat: (f64, f64),
    /// What the flow carries on: `C` \[W/(m^2 K)\] and the temperature `T_a` that it comes with \[K\].
    pub carried: (f64, f64),
}

/// What [`SectionSolver::solve`] finds.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FilmHeat {
    /// Mean temperature across the film `T_m` \[K\].
    pub mean: f64,
    /// Shear stress `tau` \[Pa\].
    pub stress: f64,
    /// Viscosity that the flow by pressure has: `h^3/(12 eta)` is its mobility \[Pa s\].
    pub flow_viscosity: f64,
    /// Temperature at which the law has this viscosity \[K\]; the mean one where it does not know
    /// temperature.
    pub flow_temperature: f64,
    /// Heat that goes to the surfaces \[W/m^2\].
    pub conducted: f64,
    /// Heat that the flow carries on \[W/m^2\].
    pub carried: f64,
}

/// Solves sections; owns the rule of collocation.
///
/// ```
/// use stribeck::lubricant::{Barus, Rheology};
/// use stribeck::thermal::{FilmProfile, FilmSection, SectionSolver};
/// // One viscosity: 0.1 Pa s sheared at 1 m/s over 1 um between surfaces at 300 K.
/// let section = FilmSection {
///     viscosity: &Barus::new(0.1, 20e-9)?, rheology: &Rheology::newtonian(), conductivity: 0.14, pressure: 0.0,
///     film: 1e-6, sliding: 1.0, surfaces: [300.0; 2], response: (0.0, 0.0), other_heat: (0.0, 0.0), carried: (0.0, 300.0),
/// };
/// let heat = SectionSolver::new(FilmProfile::Parabola).solve(&section);
/// assert!((heat.mean - 300.0 - 0.1 / (12.0 * 0.14)).abs() < 1e-9);
/// assert!((heat.conducted - 1e5).abs() < 1e-3);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SectionSolver {
    /// How the temperature is found.
    profile: FilmProfile,
    /// Points, weights and integrals of the collocation.
    rule: Collocation,
}

/// Temperatures and viscosities that go with a heat of shear.
#[derive(Debug, Clone, Copy)]
struct Trial {
    mean: f64,
    stress: f64,
    flow_viscosity: f64,
    carried: f64,
}

impl SectionSolver {
    /// By `profile`.
    pub fn new(profile: FilmProfile) -> Self {
        Self { profile, rule: Collocation::new() }
    }

    /// Temperature, stress and viscosity of `section`: the heat of shear `q = tau u_s` of which the film
    /// becomes so warm that it shears by `tau`. The stress falls with the heat, so there is one.
    #[must_use]
    pub fn solve(&self, section: &FilmSection<'_>) -> FilmHeat {
        // Where shares of the heat begin: an even one.
        let mut shape = [1.0; POINTS];
        let mut trial = self.trial(section, 0.0, &mut shape);
        let mut heat = trial.stress * section.sliding;
        if heat > 0.0 {
            (heat, trial) = self.find(section, heat, &mut shape);
        }
        let (by_pressure, by_compression) = section.other_heat;
        let conducted = heat + by_pressure + by_compression - trial.carried;
        let Trial { mean, stress, flow_viscosity, carried } = trial;
        let flow_temperature = match self.profile {
            FilmProfile::Parabola => mean,
            FilmProfile::Collocation => section.temperature_of(flow_viscosity, mean),
        };
        FilmHeat { mean, stress, flow_viscosity, flow_temperature, conducted, carried }
    }

    /// The heat between that of the cool film, `most`, and the one under that.
    fn find(&self, section: &FilmSection<'_>, most: f64, shape: &mut [f64; POINTS]) -> (f64, Trial) {
        let mut excess = |heat: f64| {
            let trial = self.trial(section, heat, shape);
            // A stress that vanishes is no zero of the logarithm.
            let made = (trial.stress * section.sliding).max(f64::MIN_POSITIVE);
            (made.ln() - heat.ln(), trial)
        };
        let (mut high, mut high_excess) = (most, excess(most));
        if high_excess.0 > -TOLERANCE {
            return (most, high_excess.1);
        }
        let mut low = most * high_excess.0.exp();
        let mut low_excess = excess(low);
        let mut found = (low, low_excess.1);
        // Illinois' rule: an end that stays counts half.
        let mut side = 0;
        for _ in 0..MAX_EVALUATIONS {
            if low_excess.0 < TOLERANCE || high / low < 1.0 + TOLERANCE {
                break;
            }
            let (a, b) = (low.ln(), high.ln());
            let middle = (a + (b - a) * low_excess.0 / (low_excess.0 - high_excess.0)).exp();
            let at = excess(middle);
            found = (middle, at.1);
            if at.0.abs() < TOLERANCE {
                break;
            }
            if at.0 > 0.0 {
                (low, low_excess) = (middle, at);
                high_excess.0 *= if side == 1 { 0.5 } else { 1.0 };
                side = 1;
            } else {
                (high, high_excess) = (middle, at);
                low_excess.0 *= if side == -1 { 0.5 } else { 1.0 };
                side = -1;
            }
        }
        found
    }

    /// The film under a heat of shear of `heat` \[W/m^2\].
    fn trial(&self, section: &FilmSection<'_>, heat: f64, shape: &mut [f64; POINTS]) -> Trial {
        match self.profile {
            FilmProfile::Parabola => parabola(section, heat),
            FilmProfile::Collocation => self.collocate(section, heat, shape),
        }
    }

    fn collocate(&self, section: &FilmSection<'_>, heat: f64, shape: &mut [f64; POINTS]) -> Trial {
        let rule = &self.rule;
        let per_flux = section.film / section.conductivity;
        let mut trial = parabola(section, heat);
        for _ in 0..MAX_PASSES {
            let uncarried: [f64; POINTS] = std::array::from_fn(|i| {
                let z = rule.nodes[i];
                let y = z - 0.5;
                let sheared: f64 = rule.green[i].iter().zip(shape.iter()).map(|(green, g)| green * g).sum();
                let (by_pressure, by_compression) = section.other_heat;
                let even = 0.5 * z * (1.0 - z) * by_compression;
                per_flux * (heat * sheared + even + (0.0625 - y.powi(4)) * by_pressure)
            });
            let (surfaces, carried, mean) = section.close(heat, rule.mean(&uncarried));
            let fluidity: [f64; POINTS] = std::array::from_fn(|i| {
                let z = rule.nodes[i];
                let lost = per_flux * 0.5 * z * (1.0 - z) * carried;
                let surface = surfaces[0] + z * (surfaces[1] - surfaces[0]);
                1.0 / section.viscosity_at(surface + uncarried[i] - lost)
            });
            let all = rule.mean(&fluidity);
            let stress = section.stress(1.0 / all);
            trial = Trial { mean, stress, flow_viscosity: self.flow_viscosity(&fluidity), carried };
            let mut change = 0.0_f64;
            for (share, fluidity) in shape.iter_mut().zip(&fluidity) {
                let new = fluidity / all;
                change = change.max((new - *share).abs());
                *share = new;
            }
            if change < SHAPE_TOLERANCE {
                break;
            }
        }
        trial
    }

    /// The viscosity that a film of one viscosity would have under the same flow by pressure.
    fn flow_viscosity(&self, fluidity: &[f64; POINTS]) -> f64 {
        let rule = &self.rule;
        let moment = |power: i32| -> f64 {
            let terms = fluidity.iter().zip(rule.nodes.iter().zip(&rule.weights));
            terms.map(|(f, (z, w))| w * f * (z - 0.5).powi(power)).sum()
        };
        let (all, first, second) = (moment(0), moment(1), moment(2));
        1.0 / (12.0 * (second - first * first / all))
    }
}

/// The film with one viscosity across it.
fn parabola(section: &FilmSection<'_>, heat: f64) -> Trial {
    let (by_pressure, by_compression) = section.other_heat;
    let per_flux = section.film / section.conductivity;
    let uncarried = per_flux * ((heat + by_compression) / 12.0 + by_pressure / 20.0);
    let (_, carried, mean) = section.close(heat, uncarried);
    let viscosity = section.viscosity_at(mean);
    Trial { mean, stress: section.stress(viscosity), flow_viscosity: viscosity, carried }
}

impl FilmSection<'_> {
    /// Temperatures of the surfaces, what the flow carries on and the mean temperature, of a film whose mean
    /// is `uncarried` above the surfaces as long as the flow carries nothing on.
    fn close(&self, heat: f64, uncarried: f64) -> ([f64; 2], f64, f64) {
        let (by_pressure, by_compression) = self.other_heat;
        let (response, before) = self.response;
        let (capacity, upstream) = self.carried;
        let follow = response * (heat + by_pressure + by_compression - before);
        let still = 0.5 * (self.surfaces[0] + self.surfaces[1]) + follow + uncarried;
        // The flow takes from the film and, with its response, from the surfaces.
        let resistance = self.film / (12.0 * self.conductivity) + response;
        let carried = capacity * (still - upstream) / (1.0 + capacity * resistance);
        let shift = follow - response * carried;
        (self.surfaces.map(|surface| surface + shift), carried, still - resistance * carried)
    }

    fn viscosity_at(&self, temperature: f64) -> f64 {
        let law = self.viscosity;
        law.viscosity_at(self.pressure, temperature).unwrap_or_else(|| law.viscosity(self.pressure))
    }

    /// Temperature at which the law has the `viscosity` under the pressure of the section, by secants from
    /// `near` \[K\]; `near` where the law does not know temperature.
    fn temperature_of(&self, viscosity: f64, near: f64) -> f64 {
        let excess = |temperature: f64| (self.viscosity_at(temperature) / viscosity).ln();
        let (mut last, mut temperature) = (near, near + 1.0);
        let mut last_excess = excess(last);
        for _ in 0..MAX_SECANTS {
            let now = excess(temperature);
            let step = now * (temperature - last) / (now - last_excess);
            if !step.is_finite() {
                return last;
            }
            (last, last_excess) = (temperature, now);
            temperature = (temperature - step).clamp(0.5 * temperature, 2.0 * temperature);
            if step.abs() < SECANT_TOLERANCE {
                break;
            }
        }
        temperature
    }

    /// Shear stress by the mean `viscosity` \[Pa s\]; none without a film.
    fn stress(&self, viscosity: f64) -> f64 {
        if self.film <= 0.0 || self.sliding == 0.0 {
            return 0.0;
        }
        self.rheology.shear_stress_under(self.pressure, viscosity, self.sliding / self.film)
    }
}
