//! Elastic constants of the pair, of a layer on ball or disc and of tribofilms.

use super::{BODIES, Scene};
#[cfg(feature = "serde")]
use super::{NamedMaterial, tables::required};
use crate::elastic::{BondedFilm, Layer};
use crate::error::InputError;
use crate::with_fields::with_fields;

/// Elastic constants of the pair.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Elastic {
    /// `E'` \[Pa\], `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`, without the layer; infinite if it follows from the
    /// moduli of the materials ([`Scene::equivalent_modulus`]).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "super::is_infinite"))]
    pub equivalent_modulus: f64,
    /// A layer on ball or disc; `None` for half-spaces.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub layer: Option<LayerSpec>,
    /// Elastic constants of both tribofilms; `None` if they are as stiff as the bodies.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub tribofilm: Option<FilmElasticSpec>,
}

/// Elastic constants of compliant tribofilms, whose deflection adds to that of the bodies by [`BondedFilm`].
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::FilmElasticSpec;
/// let mut scene = Scene::azam_2019(32).with_tribofilm();
/// scene.elastic.tribofilm = Some(FilmElasticSpec::new(30e9, 0.3));
/// // Deflection in nanometres of a film of 100 nm under 1 GPa.
/// let [ball, disc] = scene.bonded_films()?.ok_or("no films")?;
/// assert!((1e9 * 100e-9 * disc.compliance() - 2.24e-9).abs() < 1e-11);
/// assert_eq!(ball, disc);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct FilmElasticSpec {
    /// Young's modulus \[Pa\], below that of the bodies.
    pub modulus: f64,
    /// Poisson's ratio, at most 0.45.
    pub poisson: f64,
}

impl FilmElasticSpec {
    /// Films with Young's modulus `modulus` \[Pa\] and Poisson's ratio `poisson`.
    pub const fn new(modulus: f64, poisson: f64) -> Self {
        Self { modulus, poisson }
    }
}

with_fields!(FilmElasticSpec { with_modulus modulus: f64, with_poisson poisson: f64 });

/// Poisson's ratio assumed if only `E'` of the bodies is known.
const USUAL_POISSON: f64 = 0.3;

/// A layer bonded to the ball or the disc as substrate.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::LayerSpec;
/// let mut scene = Scene::azam_2019(32);
/// let coating = LayerSpec::new(2e-6, 300e9, 0.25);
/// scene.elastic.layer = Some(coating); // the substrate is still unknown
/// assert!(scene.layer().is_err());
/// scene.elastic.layer =
///     Some(coating.with_substrate_modulus(Some(210e9)).with_substrate_poisson(Some(0.3)));
/// assert_eq!(scene.layer()?.map(|layer| layer.thickness()), Some(2e-6));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "LayerTable"))]
#[non_exhaustive]
pub struct LayerSpec {
    /// Thickness \[m\].
    pub thickness: f64,
    /// Young's modulus \[Pa\].
    pub modulus: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// The body below the layer.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "CoatedBody::is_disc"))]
    pub body: CoatedBody,
    /// Hardness of the layer, in place of that of the body below \[Pa\]; `None` for that hardness.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub hardness: Option<f64>,
    /// Young's modulus of the substrate \[Pa\]; `None` for that of the material of the body.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub substrate_modulus: Option<f64>,
    /// Poisson's ratio of the substrate; `None` for that of the material of the body.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub substrate_poisson: Option<f64>,
}

/// The body that has a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum CoatedBody {
    /// The ball.
    Ball,
    /// The disc.
    #[default]
    Disc,
}

impl CoatedBody {
    /// Number of the body: 0 for the ball, 1 for the disc.
    pub(in crate::sim) fn index(self) -> usize {
        usize::from(self.is_disc())
    }

    /// Whether it is the disc.
    pub(in crate::sim) fn is_disc(&self) -> bool {
        *self == Self::Disc
    }
}

impl LayerSpec {
    /// A layer on the disc, of `thickness` \[m\] with Young's modulus `modulus` \[Pa\] and Poisson's ratio `poisson`.
    pub const fn new(thickness: f64, modulus: f64, poisson: f64) -> Self {
        Self {
            thickness,
            modulus,
            poisson,
            body: CoatedBody::Disc,
            hardness: None,
            substrate_modulus: None,
            substrate_poisson: None,
        }
    }
}

with_fields!(LayerSpec {
    with_thickness thickness: f64,
    with_modulus modulus: f64,
    with_poisson poisson: f64,
    with_body body: CoatedBody,
    with_hardness hardness: Option<f64>,
    with_substrate_modulus substrate_modulus: Option<f64>,
    with_substrate_poisson substrate_poisson: Option<f64>,
});

/// `[elastic.layer]` as written in a scene file.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct LayerTable {
    thickness: f64,
    material: Option<NamedMaterial>,
    #[serde(default)]
    body: CoatedBody,
    hardness: Option<f64>,
    modulus: Option<f64>,
    poisson: Option<f64>,
    substrate_modulus: Option<f64>,
    substrate_poisson: Option<f64>,
}

#[cfg(feature = "serde")]
impl TryFrom<LayerTable> for LayerSpec {
    type Error = String;

    fn try_from(table: LayerTable) -> Result<Self, String> {
        let modulus = table.modulus.or(table.material.map(NamedMaterial::modulus));
        let poisson = table.poisson.or(table.material.map(NamedMaterial::poisson));
        Ok(Self {
            thickness: table.thickness,
            modulus: required("modulus", modulus)?,
            poisson: required("poisson", poisson)?,
            body: table.body,
            hardness: table.hardness,
            substrate_modulus: table.substrate_modulus,
            substrate_poisson: table.substrate_poisson,
        })
    }
}

impl Elastic {
    /// Half-spaces of the equivalent modulus `E'` \[Pa\].
    pub fn new(equivalent_modulus: f64) -> Self {
        Self { equivalent_modulus, layer: None, tribofilm: None }
    }

    /// Whether the table can be omitted from the file.
    #[cfg(feature = "serde")]
    pub(super) fn is_absent(&self) -> bool {
        *self == Self::default()
    }
}

impl Default for Elastic {
    /// Half-spaces with the modulus of the materials.
    fn default() -> Self {
        Self::new(f64::INFINITY)
    }
}

impl Scene {
    /// The layer on ball or disc, if any.
    ///
    /// # Errors
    /// A value out of range, constants of the substrate that are missing or given twice.
    pub fn layer(&self) -> Result<Option<Layer>, InputError> {
        let Some(spec) = self.elastic.layer else { return Ok(None) };
        let (name, body) = (BODIES[spec.body.index()], self.materials.bodies()[spec.body.index()]);
        let substrate = |key: &str, own: Option<f64>, body_key: &str, body: Option<f64>| {
            let conflict =
                |reason: String| Err(InputError::Conflict { field: format!("elastic.layer.{key}"), reason });
            match (own, body) {
                (Some(value), None) | (None, Some(value)) => Ok(value),
                (None, None) => conflict(format!("is missing, and so is materials.{name}.{body_key}")),
                (Some(_), Some(value)) => {
                    conflict(format!("materials.{name}.{body_key} = {value:e} is given too; give only one"))
                }
            }
        };
        let modulus =
            substrate("substrate_modulus", spec.substrate_modulus, "modulus", body.young_modulus())?;
        let poisson = substrate("substrate_poisson", spec.substrate_poisson, "poisson", body.poisson())?;
        Layer::new(spec.thickness, [spec.modulus, spec.poisson], [modulus, poisson]).map(Some)
    }

    /// The tribofilms of ball and disc on their supports, if they have elastic constants. The support of a coated body
    /// is its layer. If only `E'` of the bodies is known, both have the same material with Poisson's ratio 0.3; the
    /// compliance of the body against a layer is the rest of `E'`.
    ///
    /// # Errors
    /// A value out of range, films that are not more compliant than their support.
    pub fn bonded_films(&self) -> Result<Option<[BondedFilm; 2]>, InputError> {
        let Some(spec) = self.elastic.tribofilm else { return Ok(None) };
        let on = |substrate: [f64; 2]| BondedFilm::new([spec.modulus, spec.poisson], substrate);
        let [ball, disc] = self.below_films()?;
        Ok(Some([on(ball)?, on(disc)?]))
    }

    /// Young's modulus \[Pa\] and Poisson's ratio of the supports of the films on ball and disc.
    fn below_films(&self) -> Result<[[f64; 2]; 2], InputError> {
        let compliance = 2.0 / self.equivalent_modulus()?;
        let layer = self.layer()?;
        let coated = self.elastic.layer.map_or(CoatedBody::Disc, |layer| layer.body).index();
        let below = layer.map_or(0.5 * compliance, |layer| layer.compliances()[1]);
        // For a rigid counterpart the difference is a rounding error.
        let mut compliances = [(compliance - below).max(0.0); 2];
        compliances[coated] = below;
        let usual = |compliance: f64| [(1.0 - USUAL_POISSON * USUAL_POISSON) / compliance, USUAL_POISSON];
        let [ball, disc] = self.materials.bodies().map(|body| body.young_modulus().zip(body.poisson()));
        let mut supports = [(ball, compliances[0]), (disc, compliances[1])]
            .map(|(known, compliance)| known.map_or_else(|| usual(compliance), Into::into));
        if let Some(layer) = self.elastic.layer {
            supports[coated] = [layer.modulus, layer.poisson];
        }
        Ok(supports)
    }
}
