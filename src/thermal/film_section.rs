//! The film at one node: its conditions, and its temperatures from the heat in it.

use super::advection::LayerAdvection;
use super::collocation::POINTS;
use crate::lubricant::{Rheology, ViscosityLaw};

/// Largest number of secant steps to the temperature of a viscosity, and the step at convergence \[K\].
const MAX_SECANTS: usize = 30;
const SECANT_TOLERANCE: f64 = 1e-6;

/// Model of the temperature profile across the film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum FilmProfile {
    /// Uniform shear rate with the viscosity at the mean temperature: the profile is a parabola.
    #[default]
    Parabola,
    /// Uniform shear stress with the local viscosity of each layer; heat conduction is collocated at eight
    /// points.
    Collocation,
}

/// The film at one node and its heat sources.
///
/// Across a film of thickness `h` under one shear stress `tau` of sliding
///
/// `k d2T/dz2 + tau du/dz + s = 0`, `T = T_1, T_2` at the surfaces, `integral of du/dz = u_s`,
///
/// with `du/dz = F(tau)/eta(p, T)` of the rheology. The remaining heat `s` is that of the pressure flow (in total `q_p`,
/// proportional to the square of the distance from the midplane) and that of compression, less the heat that the layers
/// [advect](LayerAdvection). For a uniform viscosity without advection the mean across the film is
///
/// `T_m = (T_1 + T_2)/2 + h/(12 k) (tau u_s + q_c) + h/(20 k) q_p`.
///
/// The surface temperatures may respond to the heat that leaves the film: `T_i + R (q - q_0)`.
#[derive(Debug, Clone, Copy)]
pub struct FilmSection<'a> {
    /// Viscosity by pressure and temperature; a law without temperature dependence keeps its value.
    pub viscosity: &'a dyn ViscosityLaw,
    /// Shear stress of the fluid.
    pub rheology: &'a Rheology,
    /// Thermal conductivity `k` \[W/(m K)\].
    pub conductivity: f64,
    /// Pressure `p` \[Pa\].
    pub pressure: f64,
    /// Film thickness `h` \[m\].
    pub film: f64,
    /// Film fraction, 1 in a full gap: the stress `tau` counts times it.
    pub theta: f64,
    /// Sliding speed `u_s`, not negative \[m/s\].
    pub sliding: f64,
    /// Surface temperatures `T_1, T_2` at the heat flow `q_0` out of the film \[K\].
    pub surfaces: [f64; 2],
    /// Surface response `R` \[K m^2/W\] and reference heat flow `q_0` \[W/m^2\].
    pub response: (f64, f64),
    /// Heat of the pressure flow `q_p` \[W/m^2\].
    pub pressure_heat: f64,
    /// Heat of compression in the layers, with the mean `q_c` \[W/m^2\].
    pub compression: [f64; POINTS],
    /// Heat that the layers lose by advection.
    pub advection: LayerAdvection,
}

/// Result of [`SectionSolver::solve`](super::SectionSolver::solve).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FilmHeat {
    /// Mean temperature across the film `T_m` \[K\].
    pub mean: f64,
    /// Shear stress `tau` \[Pa\].
    pub stress: f64,
    /// Effective viscosity of the pressure flow \[Pa s\]: the mobility is `h^3/(12 eta)`.
    pub flow_viscosity: f64,
    /// Temperature at which the law has this viscosity \[K\]; the mean temperature for a law without
    /// temperature dependence.
    pub flow_temperature: f64,
    /// Heat conducted to the surfaces \[W/m^2\].
    pub conducted: f64,
    /// Heat advected by the flow \[W/m^2\].
    pub carried: f64,
    /// Temperatures of the layers \[K\].
    pub layers: [f64; POINTS],
}

impl FilmSection<'_> {
    pub(super) fn viscosity_at(&self, temperature: f64) -> f64 {
        let law = self.viscosity;
        law.viscosity_at(self.pressure, temperature).unwrap_or_else(|| law.viscosity(self.pressure))
    }

    /// Temperature at which the law has the `viscosity` at the pressure of the section, by secant steps from
    /// `near` \[K\]; `near` for a law without temperature dependence.
    pub(super) fn temperature_of(&self, viscosity: f64, near: f64) -> f64 {
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

    /// Shear stress at the mean `viscosity` \[Pa s\], over the whole cell; zero without a film.
    pub(super) fn stress(&self, viscosity: f64) -> f64 {
        if self.film <= 0.0 || self.sliding == 0.0 {
            return 0.0;
        }
        self.theta * self.rheology.shear_stress_under(self.pressure, viscosity, self.sliding / self.film)
    }
}
