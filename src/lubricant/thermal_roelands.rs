//! The Roelands law with temperature.

use std::fmt;

use super::{Roelands, ViscosityLaw};
use crate::error::InputError;

/// Reference of temperatures in the Roelands law \[K\].
const ORIGIN: f64 = 138.0;

/// `eta = eta_0 exp{(ln eta_0 + 9.67) [(1 + p/p_0)^z [(T - 138)/(T_0 - 138)]^(-S_0) - 1]}` with `eta_0` in Pa
/// s at the temperature `T_0` in K.
///
/// At each temperature this is [`Roelands`] with another `eta_0`, at `T_0` the given one. The temperature
/// coefficient `-d ln(eta)/dT` at `T_0` is `S_0 (ln eta_0 + 9.67)/(T_0 - 138)`; mineral oils have `S_0` of
/// 1.0 to 1.5. Temperatures below 139 K count as 139 K.
///
/// Source: Roelands, C.J.A. (1966), Correlational aspects of the viscosity-temperature-pressure relationship
/// of lubricating oils, thesis, Delft; in this form Houpert, L. (1985), Journal of Tribology 107, 241-247.
///
/// ```
/// use stribeck::lubricant::{Roelands, ThermalRoelands, ViscosityLaw};
/// let oil = ThermalRoelands::new(Roelands::new(0.04, 0.68, 1.96e8)?, 313.15, 1.1)?;
/// assert!((oil.viscosity(5e8) / Roelands::new(0.04, 0.68, 1.96e8)?.viscosity(5e8) - 1.0).abs() < 1e-14);
/// assert!(oil.at_temperature(353.15).unwrap().viscosity(0.0) < 0.011);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Clone, PartialEq)]
pub struct ThermalRoelands {
    /// The law at the reference temperature.
    reference: Roelands,
    temperature: f64,
    slope: f64,
    /// The law at the current temperature.
    current: Roelands,
}

// Checkpoints compare the `Debug` output. The temperature, which the contact sets, is omitted from it.
impl fmt::Debug for ThermalRoelands {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ThermalRoelands")
            .field("reference", &self.reference)
            .field("temperature", &self.temperature)
            .field("slope", &self.slope)
            .finish_non_exhaustive()
    }
}

impl ThermalRoelands {
    /// The law that equals `reference` at `temperature` \[K\], with the index `S_0`.
    ///
    /// # Errors
    /// A temperature that is not finite and above 139 K, an index that is not finite or below zero.
    pub fn new(reference: Roelands, temperature: f64, slope: f64) -> Result<Self, InputError> {
        InputError::require(
            temperature.is_finite() && temperature > ORIGIN + 1.0,
            "lubricant.temperature",
            temperature,
            "finite and above 139 K",
        )?;
        InputError::require_non_negative("lubricant.roelands_s0", slope)?;
        Ok(Self { current: reference.clone(), reference, temperature, slope })
    }

    /// The law at `temperature` \[K\].
    fn law_at(&self, temperature: f64) -> Roelands {
        let ratio = (temperature - ORIGIN).max(1.0) / (self.temperature - ORIGIN);
        self.reference.scaled(ratio.powf(-self.slope))
    }
}

impl ViscosityLaw for ThermalRoelands {
    fn viscosity(&self, pressure: f64) -> f64 {
        self.current.viscosity(pressure)
    }

    fn log_slope(&self, pressure: f64) -> f64 {
        self.current.log_slope(pressure)
    }

    fn at_temperature(&self, temperature: f64) -> Option<Box<dyn ViscosityLaw>> {
        Some(Box::new(Self { current: self.law_at(temperature), ..self.clone() }))
    }

    fn viscosity_at(&self, pressure: f64, temperature: f64) -> Option<f64> {
        Some(self.law_at(temperature).viscosity(pressure))
    }
}
