//! Remedies for text that is almost a quantity.

use super::dimension::Dimension;
#[cfg(feature = "serde")]
use super::spelling::split;
use super::tables::Scale;
#[cfg(feature = "serde")]
use crate::error::escape;
use crate::error::format_number;

/// Density of a mineral oil \[kg/m^3\], to convert kinematic viscosities in messages.
const OIL_DENSITY: f64 = 850.0;
/// Hardness of a bearing steel \[Pa\], to convert specific wear rates in messages.
const STEEL_HARDNESS: f64 = 6e9;
/// Units of specific wear rates, volume over load and distance, in m^2/N.
const WEAR_RATES: [(&str, f64); 8] = [
    ("mm^3/(N m)", 1e-9),
    ("mm^3/N/m", 1e-9),
    ("m^3/(N m)", 1.0),
    ("m^3/N/m", 1.0),
    ("um^3/(N m)", 1e-18),
    ("mm^2/N", 1e-6),
    ("m^2/N", 1.0),
    ("um^2/N", 1e-12),
];

/// The remedy for a decimal comma.
pub(super) fn comma(text: &str) -> Option<String> {
    let (before, after) = text.split_once(',')?;
    let is_decimal =
        before.ends_with(|c: char| c.is_ascii_digit()) && after.starts_with(|c: char| c.is_ascii_digit());
    let shown = format!("{}.{}", before.trim(), after.trim());
    (is_decimal && !after.contains(',') && shown.len() < 40)
        .then(|| format!("the decimal separator is a point: \"{shown}\""))
}

/// The remedy for the `line` of a TOML file that is invalid because of a number in it.
#[cfg(feature = "serde")]
pub(crate) fn toml_line(line: &str) -> Option<String> {
    let (_, value) = line.split_once('=')?;
    let value = value.split('#').next().unwrap_or_default().trim();
    comma(value).or_else(|| {
        let (_, unit) = split(value)?;
        let is_unit =
            unit.starts_with(|c: char| c.is_alphabetic() || "%/\u{b0}\u{b5}".contains(c) || c == '1');
        is_unit.then(|| format!("a number with a unit is text in quotes: \"{}\"", escape(value)))
    })
}

/// The remedy for a `number` in a unit, in its plain spelling, of a related dimension.
pub(super) fn other_dimension(dimension: Dimension, number: &str, unit: &str) -> Option<String> {
    match dimension {
        Dimension::Viscosity => kinematic_viscosity(number, unit),
        Dimension::Ratio => wear_rate(number, unit),
        _ => None,
    }
}

/// The remedy for a specific wear rate in place of a dimensionless coefficient of wear.
fn wear_rate(number: &str, unit: &str) -> Option<String> {
    let (_, factor) = WEAR_RATES.iter().find(|(name, _)| *name == unit)?;
    let coefficient = factor * STEEL_HARDNESS * number.parse::<f64>().ok()?;
    let coefficient: f64 = format!("{coefficient:.4e}").parse().ok()?;
    Some(format!(
        "`{unit}` is a unit of the specific wear rate, a number without unit is asked for; a coefficient of wear is that rate times the \
         hardness: with {} GPa it is {}",
        1e-9 * STEEL_HARDNESS,
        format_number(coefficient)
    ))
}

/// The remedy for a kinematic viscosity in place of a dynamic one.
fn kinematic_viscosity(number: &str, unit: &str) -> Option<String> {
    let units = Dimension::KinematicViscosity.units().iter();
    let factor = units.filter(|(names, _)| names.contains(&unit)).find_map(|(_, scale)| match *scale {
        Scale::Ten(power) => Some(10.0_f64.powi(power)),
        Scale::Times(_) | Scale::Plus(_) => None,
    })?;
    let dynamic = 1e3 * OIL_DENSITY * factor * number.parse::<f64>().ok()?;
    let dynamic: f64 = format!("{dynamic:.4e}").parse().ok()?;
    Some(format!(
        "`{unit}` is a unit of kinematic viscosity, the dynamic viscosity is asked for (scenes take kinematic ones as \
         lubricant.kinematic); multiply by the density: with {OIL_DENSITY} kg/m^3 it is \"{} mPa s\"",
        format_number(dynamic)
    ))
}
