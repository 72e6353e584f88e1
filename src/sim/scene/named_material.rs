//! Materials by name, with their elastic constants.

use std::fmt;
use std::str::FromStr;

use crate::error::{InputError, escape};
use crate::nearest::nearest;

/// Materials with known elastic constants.
///
/// Sources: ISO 6336-2 (steel, cast steel, cast irons, tin bronze); ISO/TS 16281 (bearing steel); EN 10088-1 (stainless
/// steel); Schott, data sheet of N-BK7; Munro (1997), Journal of the American Ceramic Society 80, 1919-1928 (sintered
/// alumina) and Journal of Physical and Chemical Reference Data 26, 1195-1203 (sintered silicon carbide); Ratner et al.
/// (2004), Biomaterials Science, table of metals (cobalt chromium, ASTM F75 cast); Salinas Ruiz et al. (2021), Nature Communications 12, 4550, table 1
/// (DLC, a-C:H), with the Poisson's ratio of ta-C by Cho et al. (2005), Journal of Micromechanics and Microengineering 15, 728-735; Gent (1958), Rubber
/// Chemistry and Technology 31, 896-906 (rubbers, by their hardness); all others are
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
    /// Nitrile rubber of 70 Shore A.
    Nbr,
    /// Fluororubber of 75 Shore A.
    Fkm,
    /// Cobalt-chromium-molybdenum alloy of joint implants.
    Cocr,
    /// Diamond-like carbon a-C:H, for layers.
    Dlc,
}

/// Names, Young's moduli \[Pa\] and Poisson's ratios.
const NAMED: [(NamedMaterial, &str, f64, f64); 22] = [
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
    (NamedMaterial::Nbr, "nbr", 5.5e6, 0.499),
    (NamedMaterial::Fkm, "fkm", 7.1e6, 0.499),
    (NamedMaterial::Cocr, "cocr", 210e9, 0.3),
    (NamedMaterial::Dlc, "dlc", 259e9, 0.17),
];

/// Chemical formulas and common names, and the names that they stand for.
const SYNONYMS: [(&str, &str); 9] = [
    ("si3n4", "silicon_nitride"),
    ("sic", "silicon_carbide"),
    ("al2o3", "alumina"),
    ("wc", "tungsten_carbide"),
    ("100cr6", "bearing_steel"),
    ("viton", "fkm"),
    ("nitrile", "nbr"),
    ("cocrmo", "cocr"),
    ("aluminum", "aluminium"),
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

    /// The material with this name or chemical formula (`si3n4`), in letters of any case; spaces and hyphens count as underscores.
    fn from_str(name: &str) -> Result<Self, InputError> {
        let plain = name.trim().to_lowercase().replace([' ', '-'], "_");
        let plain = SYNONYMS
            .iter()
            .find(|(synonym, _)| *synonym == plain)
            .map_or(plain, |(_, known)| (*known).to_owned());
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
