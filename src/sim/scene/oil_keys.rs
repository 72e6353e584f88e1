//! Keys of an oil by its data sheet in `[lubricant]`.

use super::oil::{GRADES, unknown_grade};
use super::{KinematicPoint, OilSpec};
use crate::error::{InputError, escape};
use crate::lubricant::BaseOil;
use crate::units::Dimension;

/// Form of `kinematic` in scene files.
const EXAMPLE: &str = "\"67 cSt at 40 degC, 8.9 cSt at 100 degC\"";

/// Keys of an oil as written in a scene file.
#[derive(Debug, Default, serde::Serialize)]
pub(super) struct OilKeys {
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) grade: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) viscosity_index: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) kinematic: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) density: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) base_oil: Option<BaseOil>,
}

impl serde::Serialize for OilSpec {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let texts: Vec<String> = self
            .kinematic
            .iter()
            .flatten()
            .map(|point| format!("{:e} m^2/s at {} K", point.viscosity, point.temperature))
            .collect();
        OilKeys {
            grade: self.grade.map(|grade| format!("ISO VG {grade}")),
            viscosity_index: self.viscosity_index,
            kinematic: (!texts.is_empty()).then(|| texts.join(", ")),
            density: self.density,
            base_oil: Some(self.base_oil),
        }
        .serialize(serializer)
    }
}

impl OilKeys {
    /// The first key that is given.
    pub(super) fn first(&self) -> Option<&'static str> {
        let given = [
            ("grade", self.grade.is_some()),
            ("kinematic", self.kinematic.is_some()),
            ("viscosity_index", self.viscosity_index.is_some()),
            ("density", self.density.is_some()),
            ("base_oil", self.base_oil.is_some()),
        ];
        given.into_iter().find(|(_, given)| *given).map(|(key, _)| key)
    }

    /// The oil; `None` if no key is given.
    pub(super) fn into_spec(self) -> Result<Option<OilSpec>, InputError> {
        if self.first().is_none() {
            return Ok(None);
        }
        Ok(Some(OilSpec {
            grade: self.grade.as_deref().map(grade).transpose()?,
            viscosity_index: self.viscosity_index,
            kinematic: self.kinematic.as_deref().map_or(Ok([None; 2]), points)?,
            density: self.density,
            base_oil: self.base_oil.unwrap_or_default(),
        }))
    }
}

/// The number of a grade: `ISO VG 46`, `VG 46` or `46`.
fn grade(text: &str) -> Result<u16, InputError> {
    let upper = text.to_ascii_uppercase();
    let number = upper.trim().trim_start_matches("ISO").trim_start().trim_start_matches("VG").trim();
    let known = number.parse().ok().filter(|number| GRADES.contains(number));
    known.ok_or_else(|| match number.parse::<f64>() {
        Ok(number) => unknown_grade(number, text),
        Err(_) => InputError::Conflict {
            field: format!("lubricant.grade = \"{}\"", escape(text)),
            reason: "must be a grade of ISO 3448, such as \"ISO VG 46\"; engine and gear oils of SAE grades are given by \
                     lubricant.kinematic"
                .to_owned(),
        },
    })
}

/// One or two viscosities with their temperatures.
fn points(text: &str) -> Result<[Option<KinematicPoint>; 2], InputError> {
    let field = "lubricant.kinematic";
    let wrong = || InputError::Conflict {
        field: format!("{field} = \"{}\"", escape(text)),
        reason: format!(
            "must be one or two viscosities with their temperatures and a decimal point: {EXAMPLE}"
        ),
    };
    let mut found = [None; 2];
    let mut parts = text.split([',', ';']);
    for (place, part) in found.iter_mut().zip(&mut parts) {
        let (viscosity, temperature) = part.split_once(" at ").ok_or_else(wrong)?;
        let viscosity = Dimension::KinematicViscosity.parse(field, viscosity.trim())?;
        *place =
            Some(KinematicPoint::new(viscosity, Dimension::Temperature.parse(field, temperature.trim())?));
    }
    if parts.next().is_some() { Err(wrong()) } else { Ok(found) }
}
