//! Elastic up to a hardness that grows with the plastic depth.

use super::{ElasticPerfectlyPlastic, PlasticityModel};
use crate::error::InputError;

/// `H(h, d) = H_0(h) + M d`: the hardness of [`ElasticPerfectlyPlastic`] under the film `h`, with linear
/// isotropic hardening in the plastic depth `d` instead of the plastic strain. A repeated pressure causes no
/// further depth.
///
/// The modulus is per depth and depends on the asperity size: a strain-hardening modulus over the height of
/// the plastic zone.
///
/// ```
/// use stribeck::plastic::{ElasticPerfectlyPlastic, IsotropicHardening, PlasticityModel};
/// // 1 GPa for each 50 nm.
/// let model = IsotropicHardening::new(ElasticPerfectlyPlastic::azam_2019(), 2e16)?;
/// assert!((model.pressure_limit(0.0, 0.0) - 6e9).abs() < 1.0);
/// assert!((model.pressure_limit(0.0, 50e-9) - 7e9).abs() < 1.0);
/// assert!((model.pressure_limit(200e-9, 50e-9) - 3e9).abs() < 1.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct IsotropicHardening {
    /// Hardness at zero plastic depth.
    initial: ElasticPerfectlyPlastic,
    /// Increase of the limit per plastic depth \[Pa/m\].
    modulus: f64,
}

impl IsotropicHardening {
    /// Hardness `initial` at zero plastic depth, and `modulus` \[Pa/m\] per plastic depth.
    ///
    /// # Errors
    /// A modulus that is negative or not finite.
    pub fn new(initial: ElasticPerfectlyPlastic, modulus: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("hardening_modulus", modulus)?;
        Ok(Self { initial, modulus })
    }
}

impl PlasticityModel for IsotropicHardening {
    fn pressure_limit(&self, film_thickness: f64, plastic_depth: f64) -> f64 {
        self.initial.pressure_limit(film_thickness, plastic_depth) + self.modulus * plastic_depth.max(0.0)
    }

    fn hardens(&self) -> bool {
        self.modulus > 0.0
    }
}
