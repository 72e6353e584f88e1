//! Solver of the film at one node: temperature profile, shear stress and viscosity.

use super::advection::LayerAdvection;
use super::collocation::{Collocation, POINTS};
use super::film_section::{FilmHeat, FilmProfile, FilmSection};
use super::layers::LayerResponse;
use super::velocity::velocity;

/// Relative tolerance of the shear heat.
const TOLERANCE: f64 = 1e-10;
/// Largest number of stress evaluations.
const MAX_EVALUATIONS: usize = 60;
/// Largest number of fixed-point iterations for the heat profile.
const MAX_PASSES: usize = 60;
/// Change of the normalized heat profile at convergence.
const SHAPE_TOLERANCE: f64 = 1e-11;

/// Solver of film sections; owns the collocation rule.
///
/// ```
/// use stribeck::lubricant::{Barus, Rheology};
/// use stribeck::thermal::{FilmProfile, FilmSection, LayerAdvection, SectionSolver};
/// // Constant viscosity of 0.1 Pa s, sheared at 1 m/s over 1 um between surfaces at 300 K.
/// let section = FilmSection {
///     viscosity: &Barus::new(0.1, 20e-9)?, rheology: &Rheology::newtonian(), conductivity: 0.14, pressure: 0.0,
///     film: 1e-6, theta: 1.0, sliding: 1.0, surfaces: [300.0; 2], response: (0.0, 0.0), pressure_heat: 0.0,
///     compression: [0.0; 8], advection: LayerAdvection::uniform(0.0, 300.0),
/// };
/// let heat = SectionSolver::new(FilmProfile::Parabola).solve(&section);
/// assert!((heat.mean - 300.0 - 0.1 / (12.0 * 0.14)).abs() < 1e-9);
/// assert!((heat.conducted - 1e5).abs() < 1e-3);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct SectionSolver {
    /// Model of the temperature profile.
    profile: FilmProfile,
    /// Collocation nodes, weights and Green's function.
    rule: Collocation,
}

/// Film state for a trial value of the shear heat.
#[derive(Debug, Clone, Copy)]
struct Trial {
    /// Temperatures at the collocation points \[K\].
    temperature: [f64; POINTS],
    stress: f64,
    flow_viscosity: f64,
    /// Heat conducted to the surfaces \[W/m^2\].
    conducted: f64,
}

impl SectionSolver {
    /// Solver for the given `profile`.
    pub fn new(profile: FilmProfile) -> Self {
        Self { profile, rule: Collocation::new() }
    }

    /// Temperature, stress and viscosity of `section`: the shear heat `q = tau u_s` that is consistent with
    /// the stress `tau` at the resulting temperature. The stress decreases with the heat, so the solution is
    /// unique.
    #[must_use]
    pub fn solve(&self, section: &FilmSection<'_>) -> FilmHeat {
        self.solve_from(section, &mut [1.0; POINTS])
    }

    /// The same from the `fluidity` of the layers over its mean, which becomes that of the solution.
    pub(super) fn solve_from(&self, section: &FilmSection<'_>, fluidity: &mut [f64; POINTS]) -> FilmHeat {
        let FilmSection { film, conductivity, surfaces, response, advection, .. } = section;
        let layers = LayerResponse::new(&self.rule, film / conductivity, *surfaces, *response, advection);
        let mut trial = self.trial(section, &layers, 0.0, fluidity);
        let mut heat = trial.stress * section.sliding;
        if heat > 0.0 {
            (heat, trial) = self.find(section, &layers, heat, fluidity);
        }
        let Trial { temperature, stress, flow_viscosity, conducted } = trial;
        let mean = self.rule.mean(&temperature);
        let flow_temperature = section.temperature_of(flow_viscosity, mean);
        let carried = heat + section.pressure_heat + self.rule.mean(&section.compression) - conducted;
        FilmHeat { mean, stress, flow_viscosity, flow_temperature, conducted, carried, layers: temperature }
    }

    /// Mean across the film.
    pub(super) fn mean(&self, layers: &[f64; POINTS]) -> f64 {
        self.rule.mean(layers)
    }

    /// See [`velocity`].
    pub(super) fn velocity(&self, parts: [f64; 3]) -> [f64; POINTS] {
        velocity(&self.rule, parts)
    }

    /// See [`LayerAdvection::between`].
    pub(super) fn advection(
        &self,
        per_flow: f64,
        flows: [&[f64; POINTS]; 3],
        neighbours: [&[f64; POINTS]; 2],
    ) -> LayerAdvection {
        LayerAdvection::between(&self.rule, per_flow, flows, neighbours)
    }

    /// Heat of the layers, with the shear heat `heat` distributed as the `fluidity`.
    fn sources(&self, section: &FilmSection<'_>, heat: f64, fluidity: &[f64; POINTS]) -> [f64; POINTS] {
        std::array::from_fn(|i| {
            let driven = 12.0 * (self.rule.nodes[i] - 0.5).powi(2) * section.pressure_heat;
            heat * fluidity[i] + driven + section.compression[i]
        })
    }

    /// Root of the heat equation between the isothermal heat `most` and the heat under the temperature that
    /// `most` causes.
    fn find(
        &self,
        section: &FilmSection<'_>,
        layers: &LayerResponse,
        most: f64,
        shape: &mut [f64; POINTS],
    ) -> (f64, Trial) {
        let mut excess = |heat: f64| {
            let trial = self.trial(section, layers, heat, shape);
            // The logarithm requires a positive stress.
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
        // Illinois variant of regula falsi: the weight of a retained end is halved.
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

    /// Film state for the shear heat `heat` \[W/m^2\].
    fn trial(
        &self,
        section: &FilmSection<'_>,
        layers: &LayerResponse,
        heat: f64,
        shape: &mut [f64; POINTS],
    ) -> Trial {
        match self.profile {
            FilmProfile::Parabola => self.parabola(section, layers, heat),
            FilmProfile::Collocation => self.collocate(section, layers, heat, shape),
        }
    }

    /// Film state under the viscosities at two temperatures: the stress has that at the mean, the pressure flow that
    /// at the mean weighted by the square of the distance from the midplane, which is its share of the flow under a
    /// uniform viscosity.
    fn parabola(&self, section: &FilmSection<'_>, layers: &LayerResponse, heat: f64) -> Trial {
        let rule = &self.rule;
        let sources = self.sources(section, heat, &[1.0; POINTS]);
        let temperature = layers.temperatures(&sources);
        let weighted = temperature.iter().zip(rule.nodes.iter().zip(&rule.weights));
        let flow_mean: f64 = weighted.map(|(t, (z, w))| 12.0 * w * (z - 0.5).powi(2) * t).sum();
        Trial {
            temperature,
            stress: section.stress(section.viscosity_at(rule.mean(&temperature))),
            flow_viscosity: section.viscosity_at(flow_mean),
            conducted: layers.conducted(&sources),
        }
    }

    fn collocate(
        &self,
        section: &FilmSection<'_>,
        layers: &LayerResponse,
        heat: f64,
        shape: &mut [f64; POINTS],
    ) -> Trial {
        // fixed-point iteration: temperature, fluidity, heat profile
        let (mut trial, mut change) = self.pass(section, layers, heat, shape);
        for _ in 1..MAX_PASSES {
            if change < SHAPE_TOLERANCE {
                break;
            }
            (trial, change) = self.pass(section, layers, heat, shape);
        }
        trial
    }

    /// Film state under the heat profile `shape`, which becomes that of this state; returns its change, too.
    fn pass(
        &self,
        section: &FilmSection<'_>,
        layers: &LayerResponse,
        heat: f64,
        shape: &mut [f64; POINTS],
    ) -> (Trial, f64) {
        let rule = &self.rule;
        let sources = self.sources(section, heat, shape);
        let temperature = layers.temperatures(&sources);
        let fluidity = temperature.map(|temperature| 1.0 / section.viscosity_at(temperature));
        let all = rule.mean(&fluidity);
        let stress = section.stress(1.0 / all);
        let mut change = 0.0_f64;
        for (share, fluidity) in shape.iter_mut().zip(&fluidity) {
            let new = fluidity / all;
            change = change.max((new - *share).abs());
            *share = new;
        }
        let flow_viscosity = self.flow_viscosity(&fluidity);
        (Trial { temperature, stress, flow_viscosity, conducted: layers.conducted(&sources) }, change)
    }

    /// Uniform viscosity that gives the same pressure flow.
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
