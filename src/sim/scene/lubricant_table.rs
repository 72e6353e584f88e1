//! The table `[lubricant]` of a scene file.

use super::oil_keys::OilKeys;
use super::{BarusConstants, InletSpec, LubricantSpec, ViscositySpec};
use crate::lubricant::BaseOil;
use crate::thermal::FilmThermal;

/// `[lubricant]` as written in a scene file.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LubricantTable {
    eta0: Option<f64>,
    roelands_z: Option<f64>,
    roelands_p0: Option<f64>,
    alpha: Option<f64>,
    temperature: Option<f64>,
    roelands_s0: Option<f64>,
    viscosity: Option<ViscositySpec>,
    grade: Option<String>,
    viscosity_index: Option<f64>,
    kinematic: Option<String>,
    density: Option<f64>,
    base_oil: Option<BaseOil>,
    formula_alpha: Option<f64>,
    density_a: Option<f64>,
    density_b: Option<f64>,
    supplied_film: Option<f64>,
    #[serde(default)]
    inlet: InletSpec,
    thermal: Option<FilmThermal>,
}

impl TryFrom<LubricantTable> for LubricantSpec {
    type Error = String;

    fn try_from(table: LubricantTable) -> Result<Self, String> {
        let oil = OilKeys {
            grade: table.grade.clone(),
            viscosity_index: table.viscosity_index,
            kinematic: table.kinematic.clone(),
            density: table.density,
            base_oil: table.base_oil,
        };
        let other_law = table.viscosity.is_some() || oil.first().is_some();
        let needed = |key: &str, value: Option<f64>| match value {
            Some(value) => Ok(value),
            None if other_law => Ok(0.0),
            None => Err(format!("missing field `{key}`")),
        };
        let usual = Self::roelands(needed("eta0", table.eta0)?, needed("roelands_z", table.roelands_z)?);
        table.reject_other_laws(&usual, oil.first())?;
        Ok(Self {
            roelands_p0: table.roelands_p0.unwrap_or(usual.roelands_p0),
            alpha: table.alpha,
            temperature: table.temperature,
            roelands_s0: table.roelands_s0,
            viscosity: table.viscosity,
            oil: oil.into_spec().map_err(|error| error.to_string())?,
            formula_alpha: table.formula_alpha,
            density_a: table.density_a.unwrap_or(usual.density_a),
            density_b: table.density_b.unwrap_or(usual.density_b),
            supplied_film: table.supplied_film,
            inlet: table.inlet,
            thermal: table.thermal,
            ..usual
        })
    }
}

/// `[lubricant]` of films between rigid surfaces, where `eta0` alone is an isoviscous oil.
#[derive(serde::Deserialize)]
#[serde(try_from = "LubricantTable")]
pub(in crate::sim) struct RigidFilmLubricant(pub(in crate::sim) LubricantSpec);

impl TryFrom<LubricantTable> for RigidFilmLubricant {
    type Error = String;

    fn try_from(mut table: LubricantTable) -> Result<Self, String> {
        let index = [table.roelands_z, table.alpha, table.roelands_s0, table.temperature];
        if index.iter().all(Option::is_none) && table.viscosity.is_none() {
            let by_data_sheet = table.grade.is_some() || table.kinematic.is_some();
            if let (Some(eta0), false) = (table.eta0, by_data_sheet) {
                table.eta0 = None;
                table.viscosity = Some(ViscositySpec::Barus(BarusConstants { eta0, alpha: 0.0 }));
            }
        }
        LubricantSpec::try_from(table).map(Self)
    }
}

impl LubricantTable {
    /// Error for keys of one law beside another one; `oil` is the first key of an oil by its data sheet.
    fn reject_other_laws(&self, usual: &LubricantSpec, oil: Option<&str>) -> Result<(), String> {
        let law = [
            ("eta0", self.eta0, 0.0),
            ("roelands_z", self.roelands_z, 0.0),
            ("roelands_s0", self.roelands_s0, 0.0),
            ("roelands_p0", self.roelands_p0, usual.roelands_p0),
        ];
        let slope = [("alpha", self.alpha, 0.0), ("temperature", self.temperature, 0.0)];
        let of_density =
            [("density_a", self.density_a, usual.density_a), ("density_b", self.density_b, usual.density_b)];
        // Scenes are written with all their values: accept default values.
        let refuse = |keys: &[(&str, Option<f64>, f64)], reason: &str| {
            let stray = keys.iter().find(|(_, value, usual)| value.is_some_and(|value| value - usual != 0.0));
            stray.map_or(Ok(()), |(key, ..)| Err(format!("unknown key `{key}`, {reason}")))
        };
        if self.viscosity.is_some() {
            if let Some(key) = oil {
                return Err(format!("unknown key `{key}`, `viscosity` gives another law"));
            }
            refuse(&law, "`viscosity` gives another law than that of Roelands")?;
            refuse(&slope, "`viscosity` gives another law than that of Roelands")?;
        }
        if let Some(key) = oil {
            refuse(
                &law,
                &format!("`{key}` describes the oil by its data sheet, from which viscosities follow"),
            )?;
        }
        if matches!(self.viscosity, Some(ViscositySpec::DoolittleTait(_))) {
            refuse(&of_density, "`viscosity` brings the density of Tait")?;
        }
        Ok(())
    }
}
