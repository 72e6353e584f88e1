//! Stresses below the surface: the table `stress`.

use super::Scene;
use crate::error::InputError;

/// Stresses below the surface of the disc, or of the ball if that has a layer, in single contacts.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::StressSpec;
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.lubricant = None;
/// scene.stress = Some(StressSpec::default());
/// let stress = solve_contact(&scene)?.stress.ok_or("not requested")?;
/// assert!(stress.von_mises.stress > stress.orthogonal_shear.stress);
/// assert!(stress.yield_ratio.is_none()); // no strength given
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct StressSpec {
    /// Number of depths at which stresses are computed; the first one is the surface.
    pub depths: usize,
    /// Largest depth \[m\]; `None` for 1.5 times the smaller Hertz half-width.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub deepest: Option<f64>,
    /// Poisson's ratio of the disc; `None` for that of `materials.disc`, or 0.3. Not with a layer.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub poisson: Option<f64>,
    /// Tensile yield strength of the disc \[Pa\], or of the substrate below a layer, for the stress ratios.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub yield_strength: Option<f64>,
}

impl Default for StressSpec {
    fn default() -> Self {
        Self { depths: 24, deepest: None, poisson: None, yield_strength: None }
    }
}

impl StressSpec {
    /// Poisson's ratio of steel, the default of a disc.
    const STEEL: f64 = 0.3;

    /// Checks the values and their consistency with `scene`.
    pub(in crate::sim) fn validate(&self, scene: &Scene) -> Result<(), InputError> {
        let depths = self.depths as f64;
        InputError::require(
            (3..=1000).contains(&self.depths),
            "stress.depths",
            depths,
            "between 3 and 1000",
        )?;
        if let Some(deepest) = self.deepest {
            InputError::require_positive("stress.deepest", deepest)?;
        }
        if let Some(poisson) = self.poisson {
            let inside = -1.0 < poisson && poisson <= 0.5;
            InputError::require(inside, "stress.poisson", poisson, "above -1 and at most 0.5")?;
        }
        if let Some(strength) = self.yield_strength {
            InputError::require_positive("stress.yield_strength", strength)?;
        }
        let conflict = |reason: &str| {
            Err(InputError::Conflict { field: "stress".to_owned(), reason: reason.to_owned() })
        };
        match (self.poisson, scene.materials.disc.poisson(), scene.elastic.layer) {
            (Some(_), Some(_), _) => {
                conflict("poisson and materials.disc.poisson are both given; give only one")
            }
            (Some(_), None, Some(_)) => conflict(
                "poisson is given, but elastic.layer has the ratios of the layer and of the body below",
            ),
            _ => Ok(()),
        }
    }

    /// Poisson's ratio of the disc: the given one, or that of its material, or that of steel.
    pub(in crate::sim) fn poisson(&self, scene: &Scene) -> f64 {
        self.poisson.or(scene.materials.disc.poisson()).unwrap_or(Self::STEEL)
    }

    /// The depths for a contact of smaller half-width `half_width` \[m\]: squares of an even spacing, densest at the
    /// surface.
    pub(in crate::sim) fn depths(&self, half_width: f64) -> Vec<f64> {
        let deepest = self.deepest.unwrap_or(1.5 * half_width);
        (0..self.depths).map(|k| deepest * (k as f64 / (self.depths - 1) as f64).powi(2)).collect()
    }
}
