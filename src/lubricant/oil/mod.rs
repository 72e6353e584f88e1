//! Oils as data sheets state them: kinematic viscosities, density, viscosity index.

mod pressure_viscosity;
mod viscosity_index;
mod walther;

use std::fmt;

pub use pressure_viscosity::{BaseOil, petroleum_density, so_klaus};
pub use viscosity_index::viscosity_index;
pub(crate) use walther::INDEX_TEMPERATURES;
pub use walther::Walther;

use super::{Roelands, ViscosityLaw};
use crate::error::InputError;

/// Reference pressure of Roelands' law \[Pa\].
const PRESSURE: f64 = 1.96e8;
/// Kinematic viscosities between which correlations are used \[m^2/s\]; beyond, Roelands' index is constant.
const CORRELATED: [f64; 2] = [5e-6, 500e-6];
/// Least dynamic viscosity \[Pa s\], above the limit of Roelands' law.
const LEAST_VISCOSITY: f64 = 1e-4;

/// Pressure-viscosity coefficient of an [`Oil`].
///
/// ```
/// use stribeck::lubricant::{BaseOil, PressureViscosity};
/// let measured = PressureViscosity::Measured { alpha: 22e-9, temperature: 313.15 };
/// assert_ne!(measured, PressureViscosity::Correlation(BaseOil::Mineral));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PressureViscosity {
    /// By the correlation of the base oil at each temperature.
    Correlation(BaseOil),
    /// `alpha` \[1/Pa\] at `temperature` \[K\]. At other temperatures Roelands' index is the same.
    Measured {
        /// Coefficient \[1/Pa\].
        alpha: f64,
        /// Its temperature \[K\].
        temperature: f64,
    },
}

/// An oil of known kinematic viscosity and density. At each temperature
/// `eta = eta_0 exp{(ln eta_0 + 9.67) [(1 + p/p_0)^z - 1]}` with `p_0` = 0.196 GPa, the viscosity `eta_0 = rho nu` by
/// [`Walther`] and [`petroleum_density`], and the index `z = alpha p_0/(ln eta_0 + 9.67)` of its pressure-viscosity
/// coefficient.
///
/// Correlations are evaluated from 5 to 500 cSt; beyond, the index `z` is constant, so that the viscosity falls with
/// temperature at all pressures. Valid up to about 1 GPa.
///
/// Source of the pressure dependence: [`Roelands`].
///
/// ```
/// use stribeck::lubricant::{BaseOil, Oil, PressureViscosity, ViscosityLaw, Walther};
/// let viscosity = Walther::new([[46e-6, 313.15], [6.8e-6, 373.15]])?;
/// let oil = Oil::new(viscosity, 870.0, PressureViscosity::Correlation(BaseOil::Mineral), 313.15)?;
/// assert!((oil.viscosity(0.0) - 46e-6 * 854.1).abs() < 1e-5);
/// let hot = oil.at_temperature(373.15).ok_or("no temperature")?;
/// assert!(hot.log_slope(0.0) < 0.8 * oil.log_slope(0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq)]
pub struct Oil {
    kinematic: Walther,
    /// At 15 degrees Celsius \[kg/m^3\].
    density: f64,
    pressure: PressureViscosity,
    /// The law at the current temperature.
    current: Roelands,
}

// Checkpoints compare the `Debug` output. The temperature, which the contact sets, is omitted from it.
impl fmt::Debug for Oil {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Oil")
            .field("kinematic", &self.kinematic)
            .field("density", &self.density)
            .field("pressure", &self.pressure)
            .finish_non_exhaustive()
    }
}

impl Oil {
    /// The oil of `kinematic` viscosity and `density` \[kg/m^3\] at 15 degrees Celsius, at `temperature` \[K\].
    ///
    /// # Errors
    /// A density outside of 500 to 2500 kg/m^3, a negative coefficient, a temperature that is not positive.
    pub fn new(
        kinematic: Walther,
        density: f64,
        pressure: PressureViscosity,
        temperature: f64,
    ) -> Result<Self, InputError> {
        InputError::require(
            (500.0..=2500.0).contains(&density),
            "lubricant.density",
            density,
            "500 to 2500 kg/m^3; 0.87 g/cm^3 is 870 kg/m^3",
        )?;
        InputError::require_positive("temperature", temperature)?;
        if let PressureViscosity::Measured { alpha, temperature } = pressure {
            InputError::require_non_negative("lubricant.alpha", alpha)?;
            InputError::require_positive("lubricant.temperature", temperature)?;
        }
        let current = law_at(&kinematic, density, pressure, temperature)?;
        Ok(Self { kinematic, density, pressure, current })
    }

    /// The law at another temperature \[K\].
    fn law_at(&self, temperature: f64) -> Roelands {
        let law = law_at(&self.kinematic, self.density, self.pressure, temperature);
        // Temperatures are positive here, so that the law exists.
        law.unwrap_or_else(|_| self.current.clone())
    }
}

/// Dynamic viscosity at ambient pressure \[Pa s\].
fn ambient(kinematic: &Walther, density: f64, temperature: f64) -> f64 {
    let viscosity = petroleum_density(density, temperature) * kinematic.kinematic_viscosity(temperature);
    viscosity.max(LEAST_VISCOSITY)
}

/// Roelands' law at `temperature` \[K\].
fn law_at(
    kinematic: &Walther,
    density: f64,
    pressure: PressureViscosity,
    temperature: f64,
) -> Result<Roelands, InputError> {
    let index = |alpha: f64, at: f64| alpha * PRESSURE / (ambient(kinematic, density, at).ln() + 9.67);
    let z = match pressure {
        PressureViscosity::Measured { alpha, temperature } => index(alpha, temperature),
        PressureViscosity::Correlation(base) => {
            let [thin, thick] = CORRELATED.map(|viscosity| kinematic.temperature_of(viscosity));
            let at = temperature.clamp(thick.min(thin), thin);
            let viscosity = kinematic.kinematic_viscosity(at);
            index(base.alpha(viscosity, petroleum_density(density, at), kinematic.slope()), at)
        }
    };
    let eta0 = ambient(kinematic, density, temperature);
    if z > 0.0 { Roelands::new(eta0, z, PRESSURE) } else { Roelands::isoviscous(eta0, PRESSURE) }
}

impl ViscosityLaw for Oil {
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
