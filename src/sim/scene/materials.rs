//! Materials of the two bodies.

use std::fmt;
use std::str::FromStr;

use super::Scene;
use crate::error::{InputError, escape};
use crate::nearest::nearest;
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

/// Materials with known elastic constants.
///
/// Sources: ISO 6336-2 (steel, cast steel, cast irons, tin bronze); ISO/TS 16281 (bearing steel); EN 10088-1 (stainless
/// steel); Schott, data sheet of N-BK7; Munro (1997), Journal of the American Ceramic Society 80, 1919-1928 (sintered
/// alumina) and Journal of Physical and Chemical Reference Data 26, 1195-1203 (sintered silicon carbide); all others are
/// within the ranges of Ashby (2011), Materials Selection in Mechanical Design, appendix A. Moduli of glasses and ceramics
/// differ by 5 to 10 % between grades, those of polymers by 20 % and with temperature.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::{Elastic, NamedMaterial};
/// let mut scene = Scene::azam_2019(32);
/// scene.elastic = Elastic::default(); // use the moduli of the materials
/// scene.materials.ball.material = Some(NamedMaterial::Steel);
/// scene.materials.disc.material = Some("silicon nitride".parse()?);
/// let compliance = (1.0 - 0.09) / 206e9 + (1.0 - 0.27 * 0.27) / 310e9;
/// assert!((scene.equivalent_modulus()? * compliance / 2.0 - 1.0).abs() < 1e-12);
/// let error = "silicon".parse::<NamedMaterial>().unwrap_err().to_string();
/// assert!(error.contains("silicon_nitride"), "{error}");
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NamedMaterial {
    /// Steel.
    Steel,
    /// Through-hardened steel of rolling bearings, as 100Cr6.
    BearingSteel,
    /// Austenitic stainless steel.
    StainlessSteel,
    /// Cast steel.
    CastSteel,
    /// Nodular cast iron.
    NodularCastIron,
    /// Grey cast iron: 118 GPa, the lower end of its range.
    GreyCastIron,
    /// Tin bronze.
    TinBronze,
    /// Aluminium alloys.
    Aluminium,
    /// Soda-lime glass, as float glass.
    Glass,
    /// Borosilicate crown glass N-BK7 of optical discs.
    Bk7,
    /// Silicon nitride of bearing balls.
    SiliconNitride,
    /// Sintered silicon carbide.
    SiliconCarbide,
    /// Sintered alumina of at least 99.5 %.
    Alumina,
    /// Tungsten carbide with 6 % of cobalt.
    TungstenCarbide,
    /// Polytetrafluoroethylene.
    Ptfe,
    /// Polyether ether ketone, without fibers.
    Peek,
    /// Polyoxymethylene.
    Pom,
    /// Ultra-high-molecular-weight polyethylene.
    Uhmwpe,
}

/// Names, Young's moduli \[Pa\] and Poisson's ratios.
const NAMED: [(NamedMaterial, &str, f64, f64); 18] = [
    (NamedMaterial::Steel, "steel", 206e9, 0.3),
    (NamedMaterial::BearingSteel, "bearing_steel", 207e9, 0.3),
    (NamedMaterial::StainlessSteel, "stainless_steel", 200e9, 0.3),
    (NamedMaterial::CastSteel, "cast_steel", 202e9, 0.3),
    (NamedMaterial::NodularCastIron, "nodular_cast_iron", 173e9, 0.3),
    (NamedMaterial::GreyCastIron, "grey_cast_iron", 118e9, 0.3),
    (NamedMaterial::TinBronze, "tin_bronze", 113e9, 0.3),
    (NamedMaterial::Aluminium, "aluminium", 70e9, 0.33),
    (NamedMaterial::Glass, "glass", 70e9, 0.22),
    (NamedMaterial::Bk7, "bk7", 82e9, 0.206),
    (NamedMaterial::SiliconNitride, "silicon_nitride", 310e9, 0.27),
    (NamedMaterial::SiliconCarbide, "silicon_carbide", 415e9, 0.16),
    (NamedMaterial::Alumina, "alumina", 416e9, 0.231),
    (NamedMaterial::TungstenCarbide, "tungsten_carbide", 630e9, 0.22),
    (NamedMaterial::Ptfe, "ptfe", 0.5e9, 0.46),
    (NamedMaterial::Peek, "peek", 3.7e9, 0.4),
    (NamedMaterial::Pom, "pom", 2.8e9, 0.38),
    (NamedMaterial::Uhmwpe, "uhmwpe", 0.75e9, 0.46),
];

impl NamedMaterial {
    /// Its name in scene files, modulus \[Pa\] and Poisson's ratio.
    fn entry(self) -> (&'static str, f64, f64) {
        let found = NAMED.iter().find(|(material, ..)| *material == self).unwrap_or(&NAMED[0]);
        (found.1, found.2, found.3)
    }

    /// Young's modulus \[Pa\].
    pub fn modulus(self) -> f64 {
        self.entry().1
    }

    /// Poisson's ratio.
    pub fn poisson(self) -> f64 {
        self.entry().2
    }
}

impl fmt::Display for NamedMaterial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.entry().0)
    }
}

impl FromStr for NamedMaterial {
    type Err = InputError;

    /// The material with this name, in letters of any case; spaces and hyphens count as underscores.
    fn from_str(name: &str) -> Result<Self, InputError> {
        let plain = name.trim().to_lowercase().replace([' ', '-'], "_");
        NAMED.iter().find(|(_, known, ..)| *known == plain).map(|(material, ..)| *material).ok_or_else(|| {
            let near = nearest(&plain, NAMED.iter().map(|(_, known, ..)| *known));
            InputError::Conflict {
                field: format!("material = \"{}\"", escape(name)),
                reason: format!(
                    "is not in the list of materials; the nearest: {}; any other is given by modulus and poisson",
                    near.join(", ")
                ),
            }
        })
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for NamedMaterial {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(feature = "serde")]
impl<'de> serde::Deserialize<'de> for NamedMaterial {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        name.parse().map_err(serde::de::Error::custom)
    }
}

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
        let (field, given) = ("elastic.equivalent_modulus", self.elastic.equivalent_modulus);
        match self.materials.equivalent_modulus()? {
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

    /// Hardness of ball and disc \[Pa\]; `common` for a material without hardness.
    pub(in crate::sim) fn hardnesses(&self, common: f64) -> [f64; 2] {
        self.materials.bodies().map(|body| body.hardness.unwrap_or(common))
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
                return Err(InputError::Conflict {
                    field: format!("materials.{name}.hardness = {hardness:e}"),
                    reason: "nothing uses it: the scene has neither [plastic] nor [wear] by Archard's law"
                        .to_owned(),
                });
            }
        }
        Ok(())
    }
}
