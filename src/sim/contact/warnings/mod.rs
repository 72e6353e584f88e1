//! Warnings about implausible values and results, and about models outside of their valid range. They are never fatal.
//! One function a check.

#[cfg(feature = "serde")]
mod bearing;
mod given_film;
mod left_out;
mod limits;
mod mesh;
mod plausible;
mod quantity;
mod quasi_static;
mod rough;
mod solved;
mod strip_mesh;
mod worn;

use std::fmt;

pub(in crate::sim) use bearing::{
    bearing_warnings, coarse_dimples, reject_film_units, reject_oil_temperature, turbulent_film,
    unsolved_bearing,
};
#[cfg(feature = "serde")]
pub(in crate::sim) use bearing::{other_diameter, tension};
#[cfg(feature = "serde")]
pub(in crate::sim) use given_film::film_warnings;
pub use given_film::given_film_warnings;
pub(in crate::sim) use left_out::{OperatingPoint, left_out};
pub(in crate::sim) use plausible::{of_own_laws, reject_height_unit, reject_units};
pub(in crate::sim) use quasi_static::QUASI_STATIC;
pub(in crate::sim) use rough::of_roughness;
pub(in crate::sim) use solved::{SolvedContact, after_solve, large_errors, of_contact};
pub(in crate::sim) use worn::{DEEP_WEAR, LONG_STEP, deep_wear, long_step};

use crate::error::format_number;
use crate::grid::Grid;
use crate::metrics::height_statistics;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{BODIES, Scene};
#[cfg(feature = "formats")]
use crate::surface::Heights;
use crate::units::by_size;

/// Share of the Rq of a measured surface that its way onto the grid may cost without a word.
const LARGEST_LOSS: f64 = 0.1;

/// Something in a scene, or in its solution, that is allowed but unlikely to be meant or to hold.
///
/// ```
/// use stribeck::sim::Scene;
/// let mut scene = Scene::azam_2019(256);
/// assert!(scene.warnings().is_empty());
/// scene.lubricant.as_mut().unwrap().alpha = Some(15.0);
/// let warnings = scene.warnings();
/// assert_eq!(warnings[0].field, "lubricant.alpha");
/// assert!(warnings[0].to_string().contains("did you mean 15 1/GPa = 1.5e-8 1/Pa?"));
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Warning {
    /// The key of the scene, or the number of the solution, that it is about.
    pub field: String,
    /// Its value, in SI units; NaN where it has none.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "number_or_nan"))]
    pub value: f64,
    /// Reason for the warning.
    pub message: String,
    /// Suggested change.
    pub remedy: String,
}

impl Warning {
    /// A warning about `field` of the given `value` in SI units.
    pub(in crate::sim) fn new(field: impl Into<String>, value: f64, message: String, remedy: String) -> Self {
        Self { field: field.into(), value, message, remedy }
    }
}

/// A number; in texts also null, which stands for NaN in JSON.
#[cfg(feature = "serde")]
fn number_or_nan<'de, D: serde::Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    use serde::Deserialize;
    if from.is_human_readable() {
        Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
    } else {
        f64::deserialize(from)
    }
}

impl fmt::Display for Warning {
    /// One line: `field = value: message; remedy`, without the value where it is NaN. Films and pressures of solutions have units.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.value.is_nan() {
            return write!(f, "{}: {}; {}", self.field, self.message, self.remedy);
        }
        let value = match output_unit(&self.field) {
            Some(unit) => by_size(self.value, unit),
            None => short(self.value),
        };
        write!(f, "{} = {value}: {}; {}", self.field, self.message, self.remedy)
    }
}

/// The unit of a number of a solution; `None` for keys of scenes, whose numbers are as written, and numbers without unit.
fn output_unit(field: &str) -> Option<&'static str> {
    match field {
        "film" | "film.central" | "film.formula_central" | "roughness.composite_rq" => Some("m"),
        "pressure.max" => Some("Pa"),
        _ if DEEP_WEAR.contains(&field) => Some("m"),
        _ => None,
    }
}

impl Scene {
    /// Warnings about this scene that need no solve: values in a wrong unit, a box or cells that do not resolve the
    /// contact, models outside of their valid range. Errors are not repeated as warnings; roughness from files is checked
    /// when it is read. `docs/errors.md` lists the checks.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut list = plausible::values(self);
        list.extend(limits::of_models(self));
        list.extend(quasi_static::fast_changes(self));
        list.extend(mesh::boxes(self));
        list.extend(mesh::known_waves(self));
        list.extend(strip_mesh::long_cells(self));
        list
    }
}

/// Doubts about the file of the measured `surface` of a `body`: heights without unit, and those of its reader.
#[cfg(feature = "formats")]
pub(in crate::sim) fn of_file(body: &str, surface: &Heights) -> Vec<Warning> {
    let field = format!("roughness.{body}.path");
    let without_unit = "the file names no unit of its heights, they are taken as metres";
    let name_it = "name the unit in a text file (a line `unit: um`), or convert the file to x3p";
    let look = "`stribeck surface FILE` reports the heights as they are read";
    let mut list = Vec::new();
    if surface.unit().is_none() {
        list.push(Warning::new(&field, f64::NAN, without_unit.to_owned(), name_it.to_owned()));
    }
    let others = surface.warnings().iter().filter(|words| !words.starts_with("the unit of the heights"));
    list.extend(others.map(|words| Warning::new(&field, f64::NAN, words.clone(), look.to_owned())));
    list
}

/// Warnings about `heights` \[m\] of the `body` from a file or a caller.
pub(in crate::sim) fn of_heights(
    body: usize,
    heights: &[f64],
    grid: &Grid,
    hertz: &HertzContact,
) -> Vec<Warning> {
    let field = format!("roughness.{}", BODIES[body]);
    let mut list = plausible::height(&field, heights, hertz.half_width_x.min(hertz.half_width_y));
    list.extend(mesh::measured_waves(&field, heights, grid));
    list
}

/// The warning about `heights` \[m\] on the grid that have lost much of the `measured` Rq \[m\] of their file.
pub(in crate::sim) fn lost_rq(body: usize, heights: &[f64], measured: f64) -> Option<Warning> {
    let left = height_statistics(heights).ok()?.sq;
    (left < (1.0 - LARGEST_LOSS) * measured).then(|| {
        let nanometres = |rq: f64| format!("{:.1}", 1e9 * rq);
        Warning::new(
            format!("roughness.{}_rq", BODIES[body]),
            left,
            format!(
                "of an Rq of {} nm in the file {} nm are left on the grid, whose cells average short waves and whose box cuts long ones",
                nanometres(measured),
                nanometres(left)
            ),
            "take smaller cells, or give the `rq` that the surface is to have on the grid".to_owned(),
        )
    })
}

/// The number with at most seven digits.
fn short(value: f64) -> String {
    format_number(format!("{value:.6e}").parse().unwrap_or(value))
}
