//! Oils by the numbers of their data sheets.

use std::fmt;

use crate::error::InputError;
use crate::lubricant::{BaseOil, INDEX_TEMPERATURES, Walther};
use crate::with_fields::with_fields;

/// Viscosity grades: kinematic viscosities at 40 degrees Celsius \[mm^2/s\]. Source: ISO 3448.
pub(super) const GRADES: [u16; 20] =
    [2, 3, 5, 7, 10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200];
/// Relative tolerance of a grade (ISO 3448).
const GRADE_TOLERANCE: f64 = 0.1;
/// Largest difference of a stated viscosity index from that of two stated viscosities, which are rounded.
const INDEX_TOLERANCE: f64 = 5.0;
/// Density of a mineral oil without a stated one \[kg/m^3\].
const USUAL_DENSITY: f64 = 870.0;

/// A kinematic viscosity at a temperature.
///
/// ```
/// use stribeck::sim::scene::KinematicPoint;
/// assert_eq!(KinematicPoint::new(46e-6, 313.15).temperature, 313.15);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KinematicPoint {
    /// Kinematic viscosity \[m^2/s\].
    pub viscosity: f64,
    /// Temperature \[K\].
    pub temperature: f64,
}

impl KinematicPoint {
    /// A kinematic viscosity \[m^2/s\] at a temperature \[K\].
    pub const fn new(viscosity: f64, temperature: f64) -> Self {
        Self { viscosity, temperature }
    }
}

/// An oil as its data sheet states it: two kinematic viscosities, or one of them (or the ISO grade, that is the
/// viscosity at 40 degrees Celsius) and the viscosity index. Dynamic viscosity and pressure-viscosity coefficient at the
/// temperature of the contact follow by [`Oil`](crate::lubricant::Oil).
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::OilSpec;
/// let [warm, hot] = OilSpec::iso_vg(46, 95.0).walther()?.index_viscosities();
/// assert!((warm / 46e-6 - 1.0).abs() < 1e-9);
/// assert!((hot / 6.7e-6 - 1.0).abs() < 0.02);
/// let error = OilSpec::iso_vg(48, 95.0).walther().unwrap_err().to_string();
/// assert!(error.contains("ISO VG 46"), "{error}");
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct OilSpec {
    /// ISO viscosity grade.
    pub grade: Option<u16>,
    /// Viscosity index (ASTM D2270).
    pub viscosity_index: Option<f64>,
    /// Measured kinematic viscosities; the second one only with the first.
    pub kinematic: [Option<KinematicPoint>; 2],
    /// Density at 15 degrees Celsius \[kg/m^3\]; `None` for 870, a mineral oil.
    pub density: Option<f64>,
    /// Chemistry of the base oil, for the correlation of the pressure-viscosity coefficient.
    pub base_oil: BaseOil,
}

with_fields!(OilSpec {
    with_viscosity_index viscosity_index: Option<f64>,
    with_density density: Option<f64>,
    with_base_oil base_oil: BaseOil,
});

impl OilSpec {
    /// A mineral oil of an ISO grade and a viscosity index.
    pub const fn iso_vg(grade: u16, viscosity_index: f64) -> Self {
        Self { grade: Some(grade), ..Self::of([None; 2], Some(viscosity_index)) }
    }

    /// A mineral oil of two kinematic viscosities.
    pub const fn measured(points: [KinematicPoint; 2]) -> Self {
        Self::of([Some(points[0]), Some(points[1])], None)
    }

    /// A mineral oil without grade and density.
    const fn of(kinematic: [Option<KinematicPoint>; 2], viscosity_index: Option<f64>) -> Self {
        Self { grade: None, viscosity_index, kinematic, density: None, base_oil: BaseOil::Mineral }
    }

    /// Density at 15 degrees Celsius \[kg/m^3\]: the stated one, or 870.
    pub fn density_at_15(&self) -> f64 {
        self.density.unwrap_or(USUAL_DENSITY)
    }

    /// Viscosity over temperature.
    ///
    /// # Errors
    /// An unknown grade, missing or contradicting values, a viscosity that rises with temperature.
    pub fn walther(&self) -> Result<Walther, InputError> {
        self.require_known_grade()?;
        let within = |error: InputError| error.within("lubricant");
        let by_grade = self.grade.map(|grade| [1e-6 * f64::from(grade), INDEX_TEMPERATURES[0]]);
        let [first, second] =
            self.kinematic.map(|point| point.map(|point| [point.viscosity, point.temperature]));
        let oil = match (first, second, by_grade, self.viscosity_index) {
            (Some(first), Some(second), ..) => Walther::new([first, second]).map_err(within)?,
            (Some(point), None, _, Some(index)) | (None, _, Some(point), Some(index)) => {
                Walther::from_viscosity_index(point, index).map_err(within)?
            }
            (Some(_), None, Some(_), None) | (Some(_), None, None, None) | (None, _, Some(_), None) => {
                return Err(missing(
                    "viscosity_index",
                    "one viscosity does not determine its fall with temperature: give the viscosity index (paraffinic \
                     mineral oils: about 95) or two viscosities",
                ));
            }
            (None, ..) => return Err(missing("kinematic", "give lubricant.grade or lubricant.kinematic")),
        };
        self.require_consistency(&oil)?;
        Ok(oil)
    }

    /// Error for a grade outside of the standard.
    fn require_known_grade(&self) -> Result<(), InputError> {
        match self.grade {
            Some(grade) if !GRADES.contains(&grade) => {
                Err(unknown_grade(f64::from(grade), &grade.to_string()))
            }
            _ => Ok(()),
        }
    }

    /// Error for a grade or an index that contradicts the viscosities of `oil`.
    fn require_consistency(&self, oil: &Walther) -> Result<(), InputError> {
        if let Some(grade) = self.grade {
            let (stated, found) = (f64::from(grade), 1e6 * oil.index_viscosities()[0]);
            if (found / stated - 1.0).abs() > GRADE_TOLERANCE * (1.0 + 1e-9) {
                return Err(InputError::Conflict {
                    field: format!("lubricant.grade = \"ISO VG {grade}\""),
                    reason: format!(
                        "lubricant.kinematic gives {found:.4} cSt at 40 degC, outside of {:.4} to {:.4} cSt of this \
                         grade (ISO 3448); correct one of them or leave the grade out",
                        (1.0 - GRADE_TOLERANCE) * stated,
                        (1.0 + GRADE_TOLERANCE) * stated
                    ),
                });
            }
        }
        let (Some(stated), [_, Some(_)]) = (self.viscosity_index, self.kinematic) else { return Ok(()) };
        let found = oil.viscosity_index().map_err(|error| error.within("lubricant"))?;
        if (found - stated).abs() <= INDEX_TOLERANCE {
            return Ok(());
        }
        Err(InputError::Conflict {
            field: format!("lubricant.viscosity_index = {stated}"),
            reason: format!(
                "the two viscosities of lubricant.kinematic have the index {found:.0}; correct one of them, or leave \
                 viscosity_index out"
            ),
        })
    }

    /// Statement of the viscosity for reports.
    pub(in crate::sim) fn statement(&self) -> String {
        let index = |index: Option<f64>| index.map_or_else(String::new, |index| format!(", VI {index}"));
        match (self.kinematic, self.grade) {
            ([None, _], Some(grade)) => format!("ISO VG {grade}{}", index(self.viscosity_index)),
            _ => format!("{}{}", Points(self.kinematic), index(self.viscosity_index)),
        }
    }
}

/// Error for a missing key.
fn missing(key: &str, remedy: &str) -> InputError {
    InputError::Conflict { field: format!("lubricant.{key}"), reason: format!("is missing: {remedy}") }
}

/// Error for a grade outside of the standard, with its neighbors.
pub(super) fn unknown_grade(number: f64, text: &str) -> InputError {
    let above = GRADES.iter().position(|grade| f64::from(*grade) >= number).unwrap_or(GRADES.len());
    let near = GRADES.get(above.saturating_sub(1)..(above + 1).min(GRADES.len())).unwrap_or(&GRADES);
    let near: Vec<String> = near.iter().map(|grade| format!("ISO VG {grade}")).collect();
    InputError::Conflict {
        field: format!("lubricant.grade = \"{text}\""),
        reason: format!(
            "is not a grade of ISO 3448; the nearest: {}; any other viscosity is given by lubricant.kinematic",
            near.join(", ")
        ),
    }
}

/// Viscosities as in scene files, with all digits.
struct Points([Option<KinematicPoint>; 2]);

impl fmt::Display for Points {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, point) in self.0.iter().flatten().enumerate() {
            let separator = if index > 0 { ", " } else { "" };
            // Decimal digits are rounded where they differ from those as written by rounding only.
            let [viscosity, celsius] = [1e6 * point.viscosity, point.temperature - 273.15].map(rounded);
            write!(f, "{separator}{viscosity} cSt at {celsius} degC")?;
        }
        Ok(())
    }
}

/// A number without the rounding errors of a change of unit.
fn rounded(value: f64) -> f64 {
    format!("{value:.12e}").parse().unwrap_or(value)
}
