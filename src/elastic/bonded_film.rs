//! A thin film bonded to an elastic body: the additional displacement under pressure.

use crate::error::InputError;

/// Largest Poisson's ratio of a film. A nearly incompressible film flows sideways under pressure, far beyond
/// the loaded area, and is not a local compliance.
const LARGEST_POISSON: f64 = 0.45;

/// The material of a thin elastic film and of the body (the substrate) below it.
///
/// Under a pressure that varies over lengths much larger than the thickness `h`, the film adds a displacement
/// proportional to the local pressure:
///
/// `u/p = h [1/M - 2 v/(1 - v) s - E/(1 - v^2) s^2]`, `1/M = (1 + v)(1 - 2 v)/[E (1 - v)]`,
/// `s = (1 + v2)(1 - 2 v2)/E2`,
///
/// with Young's moduli \[Pa\] and Poisson's ratios `E`, `v` of the film and `E2`, `v2` of the substrate. On a
/// rigid substrate, `s = 0`, the film deforms without lateral strain, with the confined modulus `M` (Johnson
/// 1985, Contact Mechanics, section 5.8). The surface of an elastic substrate contracts laterally under
/// pressure and strains the film, which pulls back: second and third term. For a film of the substrate's
/// material the three terms cancel.
///
/// This is the first order in `q h` of the response of a layer to a pressure of wave number `q` (Burmister
/// 1945, see [`Layer`](super::Layer)). For a soft film (`E = E2/7`, both ratios 0.3) the next orders are
/// 0.1 % of it at wavelengths of 600 `h`, 1 % at 60 `h`.
///
/// ```
/// use stribeck::elastic::BondedFilm;
/// let rigid = BondedFilm::new([30e9, 0.3], [f64::INFINITY, 0.3])?;
/// assert!((rigid.confined_modulus() / 40.385e9 - 1.0).abs() < 1e-4);
/// // 100 nm under 1 GPa: 2.5 nm, on steel a tenth less.
/// assert!((1e9 * 100e-9 * rigid.compliance() / 2.476e-9 - 1.0).abs() < 1e-3);
/// let steel = BondedFilm::new([30e9, 0.3], [210e9, 0.3])?;
/// assert!((steel.compliance() / rigid.compliance() - 0.906).abs() < 1e-3);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BondedFilm {
    /// `M` \[Pa\].
    confined_modulus: f64,
    /// Additional displacement per pressure and thickness \[1/Pa\].
    compliance: f64,
}

impl BondedFilm {
    /// A film with Young's modulus \[Pa\] and Poisson's ratio, on a substrate with the second pair. An
    /// infinite modulus stands for a rigid substrate.
    ///
    /// # Errors
    /// A modulus that is not positive, or that of the film not finite. Poisson's ratio of the film not above
    /// -1 or above 0.45, of the substrate not above -1 or above 0.5. A film that is not more compliant than
    /// its substrate.
    pub fn new(
        [modulus, poisson]: [f64; 2],
        [substrate_modulus, substrate_poisson]: [f64; 2],
    ) -> Result<Self, InputError> {
        InputError::require_positive("elastic.tribofilm.modulus", modulus)?;
        InputError::require(
            -1.0 < poisson && poisson <= LARGEST_POISSON,
            "elastic.tribofilm.poisson",
            poisson,
            "above -1 and at most 0.45",
        )?;
        let is_positive = substrate_modulus > 0.0;
        InputError::require(is_positive, "substrate modulus", substrate_modulus, "positive")?;
        let in_range = -1.0 < substrate_poisson && substrate_poisson <= 0.5;
        InputError::require(
            in_range,
            "substrate Poisson's ratio",
            substrate_poisson,
            "above -1 and at most 0.5",
        )?;
        let confined_modulus = modulus * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        let shrinkage = (1.0 + substrate_poisson) * (1.0 - 2.0 * substrate_poisson) / substrate_modulus;
        let stretched = modulus / (1.0 - poisson * poisson) * shrinkage * shrinkage;
        let compliance = 1.0 / confined_modulus - 2.0 * poisson / (1.0 - poisson) * shrinkage - stretched;
        InputError::require(
            compliance.is_finite(),
            "elastic.tribofilm.modulus",
            modulus,
            "large enough for its reciprocal to be finite",
        )?;
        InputError::require(
            compliance > 0.0,
            "elastic.tribofilm.modulus",
            modulus,
            "low enough for the film to be more compliant than its substrate",
        )?;
        Ok(Self { confined_modulus, compliance })
    }

    /// Confined modulus `M` \[Pa\]: pressure over strain of the film without lateral strain.
    pub fn confined_modulus(&self) -> f64 {
        self.confined_modulus
    }

    /// Displacement that the film adds to that of the substrate, per pressure and thickness \[1/Pa\].
    pub fn compliance(&self) -> f64 {
        self.compliance
    }
}
