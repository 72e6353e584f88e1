//! Doolittle's free-volume viscosity with Tait's equation of state.

use std::fmt;

use super::{DensityLaw, Roelands, ViscosityLaw};
use crate::error::InputError;

/// Lower bound of the volume relative to that at ambient pressure.
const SMALLEST: f64 = 0.2;

/// Upper bound of the exponent `beta_K T` of the bulk modulus; liquids stay below 4.
const SOFTEST: f64 = 5.0;

/// Constants of [`DoolittleTait`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct DoolittleTaitConstants {
    /// Viscosity `eta_R` at ambient pressure and the temperature `T_R` \[Pa s\].
    pub viscosity: f64,
    /// Temperature `T_R` \[K\].
    pub temperature: f64,
    /// Doolittle's `B`.
    pub b: f64,
    /// Occupied volume fraction `R_0` at ambient pressure and `T_R`.
    pub r0: f64,
    /// Thermal expansion of the occupied volume `epsilon` \[1/K\], usually negative.
    pub epsilon: f64,
    /// Pressure derivative of the bulk modulus `K_0'`.
    pub k0_slope: f64,
    /// Bulk modulus `K_00` \[Pa\] at ambient pressure, extrapolated to 0 K.
    pub k00: f64,
    /// Temperature coefficient of the bulk modulus `beta_K` \[1/K\].
    pub beta: f64,
    /// Thermal expansion `a_V` at ambient pressure \[1/K\].
    pub expansion: f64,
}

/// Free-volume viscosity and Tait density, both by pressure and temperature:
///
/// `eta = eta_R exp{B R_0 [w/(v - R_0 w) - 1/(1 - R_0)]}`, `w = 1 + epsilon (T - T_R)`,
/// `v = [1 + a_V (T - T_R)] V/V_0`, `V/V_0 = 1 - ln[1 + p (1 + K_0')/K_0]/(1 + K_0')`,
/// `K_0 = K_00 exp(-beta_K T)`.
///
/// Valid in the range of the fitted constants, usually up to 1 GPa. Beyond it the viscosity is at most
/// `exp(25)` times that at ambient pressure ([`Roelands::MAX_EXPONENT`]), the volume at least a fifth, and
/// `beta_K T` at most 5.
///
/// Source: Doolittle, A. K. (1951), Journal of Applied Physics 22, 1471-1475 (free volume); with the equation
/// of Tait in Bair, S. (2007), High Pressure Rheology for Quantitative Elastohydrodynamics, Elsevier.
///
/// ```
/// use stribeck::lubricant::{DensityLaw, DoolittleTait, DoolittleTaitConstants, ViscosityLaw};
/// let oil = DoolittleTait::new(DoolittleTaitConstants {
///     viscosity: 0.02, temperature: 313.15, b: 4.0, r0: 0.65, epsilon: -8e-4,
///     k0_slope: 11.0, k00: 9e9, beta: 6e-3, expansion: 8e-4,
/// })?;
/// assert!((oil.viscosity(0.0) - 0.02).abs() < 1e-15);
/// assert!(oil.viscosity(1e8) > 0.06 && oil.ratio(1e8) > 1.04);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Clone, Copy, PartialEq)]
pub struct DoolittleTait {
    /// Constants of the fluid.
    constants: DoolittleTaitConstants,
    /// Temperature of the law \[K\].
    temperature: f64,
}

// Checkpoints compare the `Debug` output. The temperature, which the contact sets, is omitted from it.
impl fmt::Debug for DoolittleTait {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("DoolittleTait").field("constants", &self.constants).finish_non_exhaustive()
    }
}

impl DoolittleTait {
    /// The law at the temperature `T_R` of its constants.
    ///
    /// # Errors
    /// A constant that is not finite; a constant other than `epsilon`, `beta` and `expansion` that is not
    /// positive; a negative `beta` or `expansion`; an `r0` of one or more.
    pub fn new(constants: DoolittleTaitConstants) -> Result<Self, InputError> {
        let DoolittleTaitConstants { viscosity, temperature, b, r0, epsilon, k0_slope, k00, beta, expansion } =
            constants;
        for (field, value) in [
            ("viscosity", viscosity),
            ("temperature", temperature),
            ("b", b),
            ("k0_slope", k0_slope),
            ("k00", k00),
        ] {
            InputError::require_positive(&field_name(field), value)?;
        }
        InputError::require(0.0 < r0 && r0 < 1.0, &field_name("r0"), r0, "between 0 and 1")?;
        InputError::require(epsilon.is_finite(), &field_name("epsilon"), epsilon, "finite")?;
        InputError::require_non_negative(&field_name("beta"), beta)?;
        InputError::require_non_negative(&field_name("expansion"), expansion)?;
        Ok(Self { constants, temperature })
    }

    /// The law at another temperature \[K\].
    fn at(&self, temperature: f64) -> Self {
        Self { temperature, ..*self }
    }

    /// Volume at ambient pressure relative to that at `T_R`, `1 + a_V (T - T_R)`, at least the volume bound.
    fn expanded(&self) -> f64 {
        let DoolittleTaitConstants { expansion, temperature, .. } = self.constants;
        (1.0 + expansion * (self.temperature - temperature)).max(SMALLEST)
    }

    /// `V/V_0` and its pressure derivative \[1/Pa\].
    fn volume(&self, pressure: f64) -> (f64, f64) {
        let DoolittleTaitConstants { k0_slope, k00, beta, .. } = self.constants;
        let stiffness = k00 * (-(beta * self.temperature).min(SOFTEST)).exp();
        let p = pressure.max(0.0);
        let volume = 1.0 - (p * (1.0 + k0_slope) / stiffness).ln_1p() / (1.0 + k0_slope);
        if volume > SMALLEST { (volume, -1.0 / (stiffness + p * (1.0 + k0_slope))) } else { (SMALLEST, 0.0) }
    }

    /// The exponent of the viscosity; infinite without free volume.
    fn exponent(&self, volume: f64) -> f64 {
        let DoolittleTaitConstants { b, r0, epsilon, expansion, temperature, .. } = self.constants;
        let warmer = self.temperature - temperature;
        let occupied = (1.0 + epsilon * warmer).max(0.0);
        let free = (1.0 + expansion * warmer).max(0.0) * volume - r0 * occupied;
        if free > 0.0 { b * r0 * (occupied / free - 1.0 / (1.0 - r0)) } else { f64::INFINITY }
    }
}

/// The key of a constant in a scene file.
fn field_name(constant: &str) -> String {
    format!("lubricant.viscosity.{constant}")
}

impl ViscosityLaw for DoolittleTait {
    fn viscosity(&self, pressure: f64) -> f64 {
        let ambient = self.exponent(1.0).min(Roelands::MAX_EXPONENT);
        let growth = (self.exponent(self.volume(pressure).0) - ambient).clamp(0.0, Roelands::MAX_EXPONENT);
        self.constants.viscosity * (ambient + growth).exp()
    }

    fn at_temperature(&self, temperature: f64) -> Option<Box<dyn ViscosityLaw>> {
        Some(Box::new(self.at(temperature)))
    }

    fn viscosity_at(&self, pressure: f64, temperature: f64) -> Option<f64> {
        Some(self.at(temperature).viscosity(pressure))
    }
}

impl DensityLaw for DoolittleTait {
    fn ratio(&self, pressure: f64) -> f64 {
        1.0 / self.volume(pressure).0
    }

    fn slope(&self, pressure: f64) -> f64 {
        let (volume, slope) = self.volume(pressure);
        -slope / (volume * volume)
    }

    fn ratio_at(&self, pressure: f64, temperature: f64) -> Option<f64> {
        Some(self.expanded() / (self.at(temperature).expanded() * self.at(temperature).volume(pressure).0))
    }

    fn at_temperature(&self, temperature: f64) -> Option<Box<dyn DensityLaw>> {
        Some(Box::new(self.at(temperature)))
    }
}
