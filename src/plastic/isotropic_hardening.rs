//! Elastic up to a hardness that grows as the node is flattened.

use super::{ElasticPerfectlyPlastic, PlasticityModel};
use crate::error::InputError;

/// `H(h, d) = H_0(h) + M d`: the hardness of [`ElasticPerfectlyPlastic`] under the film `h`, and linear
/// isotropic hardening with the plastic depth `d` in place of the plastic strain. A node that has carried a
/// pressure once carries it again without further depth.
///
/// The modulus is per depth, so it belongs to a size of asperity: a strain modulus over the height that it
/// spreads over.
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
    /// Limit before any flattening.
    initial: ElasticPerfectlyPlastic,
    /// Growth of the limit with the plastic depth \[Pa/m\].
    modulus: f64,
}

impl IsotropicHardening {
    /// Hardness `initial` of a node that has not yielded, `modulus` \[Pa/m\] for each metre of plastic depth.
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
