//! Density laws.

use super::DensityLaw;
use crate::error::InputError;

/// `rho / rho_0 = 1 + a p / (1 + b p)`.
///
/// Source: Dowson, D. and Higginson, G.R. (1966), Elasto-hydrodynamic Lubrication, Pergamon; there
/// `a` = 0.6e-9 and `b` = 1.7e-9 1/Pa.
///
/// ```
/// use stribeck::lubricant::{DensityLaw, DowsonHigginson};
/// let oil = DowsonHigginson::new(0.6e-9, 1.7e-9)?;
/// assert!((oil.ratio(1e9) - (1.0 + 0.6 / 2.7)).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DowsonHigginson {
    /// `a` \[1/Pa\].
    a: f64,
    /// `b` \[1/Pa\].
    b: f64,
}

impl DowsonHigginson {
    /// Law with coefficients `a` and `b` \[1/Pa\].
    ///
    /// # Errors
    /// A coefficient that is negative or not finite.
    pub fn new(a: f64, b: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("lubricant.density_a", a)?;
        InputError::require_non_negative("lubricant.density_b", b)?;
        Ok(Self { a, b })
    }
}

impl DensityLaw for DowsonHigginson {
    fn ratio(&self, pressure: f64) -> f64 {
        let p = pressure.max(0.0);
        1.0 + self.a * p / (1.0 + self.b * p)
    }

    fn slope(&self, pressure: f64) -> f64 {
        self.a / (1.0 + self.b * pressure.max(0.0)).powi(2)
    }
}

/// Constant density, `rho = rho_0`.
///
/// # Examples
///
/// ```
/// use stribeck::lubricant::{DensityLaw, Incompressible};
/// assert_eq!((Incompressible.ratio(2e9), Incompressible.slope(2e9)), (1.0, 0.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Incompressible;

impl DensityLaw for Incompressible {
    fn ratio(&self, _pressure: f64) -> f64 {
        1.0
    }

    fn slope(&self, _pressure: f64) -> f64 {
        0.0
    }
}
