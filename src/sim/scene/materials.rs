//! Materials of the two bodies.

use super::{Elastic, NamedMaterial, Scene};
use crate::error::InputError;
use crate::tribochem::ThermalBody;
use crate::with_fields::with_fields;

/// Names of the bodies in scene files and errors.
pub(in crate::sim) const BODIES: [&str; 2] = ["ball", "disc"];

/// Materials of ball and disc.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Materials {
    /// The ball, body 0.
    pub ball: Material,
    /// The disc, body 1.
    pub disc: Material,
}

/// Properties of one body; absent ones are those of the pair.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{Material, NamedMaterial};
/// let steel = Material::default().with_material(Some(NamedMaterial::Steel));
/// assert_eq!((steel.young_modulus(), steel.poisson()), (Some(206e9), Some(0.3)));
/// assert_eq!(steel.with_modulus(Some(210e9)).young_modulus(), Some(210e9)); // takes precedence
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Material {
    /// A material by name, with default modulus and Poisson's ratio.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub material: Option<NamedMaterial>,
    /// Young's modulus \[Pa\] in place of `elastic.equivalent_modulus`; give it for both bodies or neither.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub modulus: Option<f64>,
    /// Poisson's ratio; requires `modulus`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub poisson: Option<f64>,
    /// Hardness \[Pa\], in place of `plastic.hardness` and `wear.hardness`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub hardness: Option<f64>,
    /// Thermal conductivity \[W/(m K)\], in place of `thermal.conductivity`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub conductivity: Option<f64>,
    /// Thermal diffusivity \[m^2/s\], in place of `thermal.diffusivity`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub diffusivity: Option<f64>,
}

with_fields!(Material {
    with_material material: Option<NamedMaterial>,
    with_modulus modulus: Option<f64>,
    with_poisson poisson: Option<f64>,
    with_hardness hardness: Option<f64>,
    with_conductivity conductivity: Option<f64>,
    with_diffusivity diffusivity: Option<f64>,
});

impl Material {
    /// Young's modulus \[Pa\]: the given one, or that of the named material.
    pub fn young_modulus(&self) -> Option<f64> {
        self.modulus.or(self.material.map(NamedMaterial::modulus))
    }

    /// Poisson's ratio: the given one, or that of the named material.
    pub fn poisson(&self) -> Option<f64> {
        self.poisson.or(self.material.map(NamedMaterial::poisson))
    }
}

impl Materials {
    /// Whether all properties are absent.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Ball and disc.
    pub fn bodies(&self) -> [&Material; 2] {
        [&self.ball, &self.disc]
    }

    /// `E'` \[Pa\] of the moduli, `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`; `None` if no modulus is given.
    fn equivalent_modulus(&self) -> Result<Option<f64>, InputError> {
        let given = |body: &&Material| body.young_modulus().is_some() || body.poisson().is_some();
        if !self.bodies().iter().any(given) {
            return Ok(None);
        }
        let mut compliance = 0.0;
        for (name, body) in BODIES.into_iter().zip(self.bodies()) {
            let required = |key: &str, value: Option<f64>| {
                let field = format!("materials.{name}.{key}");
                value.map(|value| (field.clone(), value)).ok_or_else(|| InputError::Conflict {
                    field,
                    reason: "is missing: give elastic constants for both bodies or neither".to_owned(),
                })
            };
            let (field, modulus) = required("modulus", body.young_modulus())?;
            InputError::require_positive(&field, modulus)?;
            let (field, ratio) = required("poisson", body.poisson())?;
            InputError::require((-1.0 < ratio) && (ratio <= 0.5), &field, ratio, "above -1 and at most 0.5")?;
            compliance += (1.0 - ratio * ratio) / modulus;
        }
        let equivalent = 2.0 / compliance;
        InputError::require_positive("equivalent modulus of the materials", equivalent)?;
        Ok(Some(equivalent))
    }
}

impl Elastic {
    /// `E'` \[Pa\] of the pair: from the moduli of both `materials` if given, otherwise that of this table.
    pub(in crate::sim) fn modulus_with(&self, materials: &Materials) -> Result<f64, InputError> {
        let (field, given) = ("elastic.equivalent_modulus", self.equivalent_modulus);
        match materials.equivalent_modulus()? {
            None if given == f64::INFINITY => Err(InputError::Conflict {
                field: field.to_owned(),
                reason: "is missing (or infinite), and so are the moduli of the materials".to_owned(),
            }),
            None => InputError::require_positive(field, given).map(|()| given),
            Some(modulus) if given == f64::INFINITY => Ok(modulus),
            Some(modulus) => Err(InputError::Conflict {
                field: format!("{field} = {given:e}"),
                reason: format!(
                    "the moduli of the materials are given too, E' = {modulus:e} Pa; give only one"
                ),
            }),
        }
    }
}

impl Scene {
    /// `E'` \[Pa\] of the pair: from the moduli of both materials if given, otherwise
    /// `elastic.equivalent_modulus`.
    ///
    /// ```
    /// use stribeck::sim::Scene;
    /// use stribeck::sim::scene::{Elastic, Material};
    /// let mut scene = Scene::azam_2019(32);
    /// let steel = Material::default().with_modulus(Some(209e9)).with_poisson(Some(0.3));
    /// scene.elastic = Elastic::default();
    /// (scene.materials.ball, scene.materials.disc) = (steel, steel);
    /// assert!((scene.equivalent_modulus()? - 229.67e9).abs() < 1e7);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    ///
    /// # Errors
    /// A value out of range, a missing modulus or ratio, both ways at once with different results.
    pub fn equivalent_modulus(&self) -> Result<f64, InputError> {
        self.elastic.modulus_with(&self.materials)
    }

    /// Hardness of ball and disc \[Pa\], that of its layer for a coated body; `common` for a material without hardness.
    pub(in crate::sim) fn hardnesses(&self, common: f64) -> [f64; 2] {
        let mut hardnesses = self.materials.bodies().map(|body| body.hardness.unwrap_or(common));
        if let Some((layer, hardness)) = self.elastic.layer.and_then(|layer| Some((layer, layer.hardness?))) {
            hardnesses[layer.body.index()] = hardness;
        }
        hardnesses
    }

    /// Thermal properties of ball and disc.
    pub(in crate::sim) fn thermal_bodies(&self) -> [ThermalBody; 2] {
        self.materials.bodies().map(|body| ThermalBody {
            conductivity: body.conductivity.unwrap_or(self.thermal.conductivity),
            diffusivity: body.diffusivity.unwrap_or(self.thermal.diffusivity),
        })
    }

    /// Checks the materials except their moduli.
    pub(in crate::sim) fn validate_materials(&self) -> Result<(), InputError> {
        for (name, body) in BODIES.into_iter().zip(self.materials.bodies()) {
            for (key, value) in [
                ("hardness", body.hardness),
                ("conductivity", body.conductivity),
                ("diffusivity", body.diffusivity),
            ] {
                value.map_or(Ok(()), |value| {
                    InputError::require_positive(&format!("materials.{name}.{key}"), value)
                })?;
            }
            let by_wear = self.wear.and_then(|wear| wear.law.hardness());
            if let (Some(hardness), None, None) = (body.hardness, &self.plastic, by_wear) {
                return Err(unused_hardness(&format!("materials.{name}.hardness"), hardness));
            }
        }
        self.validate_layer_hardness()
    }

    /// Checks the hardness of a layer.
    fn validate_layer_hardness(&self) -> Result<(), InputError> {
        let field = "elastic.layer.hardness";
        let Some(hardness) = self.elastic.layer.and_then(|layer| layer.hardness) else { return Ok(()) };
        InputError::require_positive(field, hardness)?;
        let by_wear = self.wear.and_then(|wear| wear.law.hardness());
        let is_unused = self.plastic.is_none() && by_wear.is_none();
        if is_unused { Err(unused_hardness(field, hardness)) } else { Ok(()) }
    }
}

/// Error for a hardness of `field` that no law uses.
fn unused_hardness(field: &str, hardness: f64) -> InputError {
    InputError::Conflict {
        field: format!("{field} = {hardness:e}"),
        reason: "nothing uses it: the scene has neither [plastic] nor [wear] by Archard's law".to_owned(),
    }
}
