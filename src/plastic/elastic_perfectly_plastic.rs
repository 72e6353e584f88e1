//! Elastic below the hardness, perfectly plastic at it.

use super::PlasticityModel;
use crate::error::InputError;

/// Pressure limit at the hardness, without hardening: `H(h) = H_s - (H_s - H_t) clamp(h / h_ref, 0, 1)`, from
/// the hardness of the substrate to that of a tribofilm of the reference thickness.
///
/// Sources: perfect plasticity at the hardness: Almqvist, Sahlin, Larsson, Glavatskih (2007), Tribology
/// International 40; hardness decreasing linearly with film thickness: Azam and co-workers (2019), Tribology
/// International 135, 161-169.
///
/// ```
/// use stribeck::plastic::{ElasticPerfectlyPlastic, PlasticityModel};
/// let model = ElasticPerfectlyPlastic::azam_2019();
/// assert!((model.pressure_limit(0.0, 0.0) - 6e9).abs() < 1.0);
/// assert!((model.pressure_limit(100e-9, 0.0) - 4e9).abs() < 1.0);
/// assert!((model.pressure_limit(300e-9, 0.0) - 2e9).abs() < 1.0);
///
/// let mut limit = [0.0; 2];
/// model.contact_limit_into([&[0.0, 0.0], &[0.0, 200e-9]], [&[0.0; 2], &[0.0; 2]], &mut limit)?;
/// assert!((limit[1] - 2e9).abs() < 1.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticPerfectlyPlastic {
    /// Hardness of the bare surface \[Pa\].
    substrate: f64,
    /// Hardness of the substrate less that of the film \[Pa\].
    drop: f64,
    /// Reciprocal of the reference thickness \[1/m\].
    per_thickness: f64,
}

impl ElasticPerfectlyPlastic {
    /// Uniform `hardness` \[Pa\], independent of the film.
    ///
    /// # Errors
    /// A hardness that is not finite and positive.
    pub fn uniform(hardness: f64) -> Result<Self, InputError> {
        InputError::require_positive("hardness", hardness)?;
        Ok(Self { substrate: hardness, drop: 0.0, per_thickness: 0.0 })
    }

    /// Hardness `substrate` \[Pa\] of the bare surface, and `film` \[Pa\] under a film of at least
    /// `reference_thickness` \[m\].
    ///
    /// # Errors
    /// A value that is not finite and positive.
    pub fn with_film(substrate: f64, film: f64, reference_thickness: f64) -> Result<Self, InputError> {
        InputError::require_positive("substrate_hardness", substrate)?;
        InputError::require_positive("film_hardness", film)?;
        InputError::require_positive("reference_thickness", reference_thickness)?;
        Ok(Self { substrate, drop: substrate - film, per_thickness: 1.0 / reference_thickness })
    }

    /// The values of Azam and co-workers (2019): steel 6 GPa, film 2 GPa at 200 nm.
    pub fn azam_2019() -> Self {
        Self { substrate: 6e9, drop: 4e9, per_thickness: 1.0 / 200e-9 }
    }
}

impl PlasticityModel for ElasticPerfectlyPlastic {
    fn pressure_limit(&self, film_thickness: f64, _plastic_depth: f64) -> f64 {
        self.substrate - self.drop * (film_thickness * self.per_thickness).clamp(0.0, 1.0)
    }
}
