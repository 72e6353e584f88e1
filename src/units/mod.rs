//! Quantities as text: a number and a unit, `9.525 mm` or `14.9 1/GPa`.
//!
//! Scene files and options of the command accept such text for quantities with a [`Dimension`]; all values inside are in
//! SI units. A speed may be a rate of rotation on a diameter: `1500 rpm on 40 mm`. A power of ten changes the decimal exponent of the text, so that `9.525 mm` and `9.525e-3` are the same
//! double. A new unit is an entry in `tables`; a new dimension is a variant, its table and its name.

mod by_size;
mod dimension;
mod hints;
mod spelling;
mod tables;

pub use self::by_size::by_size;
pub(crate) use self::by_size::unit_by_size;
pub use self::dimension::Dimension;
#[cfg(feature = "serde")]
pub(crate) use self::hints::toml_line;
use self::spelling::{plain, split, times_power_of_ten};
use self::tables::Scale::{Plus, Ten, Times};
use crate::error::{InputError, escape};

impl Dimension {
    /// The valid units, the SI one first; other spellings (`µm`, `°C`, `Pa*s`, `Pa.s`, `GPa^-1`, `GPa-1`, `mm2/N`) are
    /// accepted too.
    pub fn unit_names(self) -> impl Iterator<Item = &'static str> {
        self.units().iter().filter_map(|(names, _)| names.first().copied())
    }

    /// The value of `text`, a number and a unit, in SI units; a space between them is optional. `field` is the name in
    /// errors.
    ///
    /// # Errors
    /// Text that is not a number and a unit, a unit of another dimension, a missing unit.
    pub fn parse(self, field: &str, text: &str) -> Result<f64, InputError> {
        let refused = |reason: String| InputError::Conflict {
            field: format!("{field} = \"{}\"", escape(text)),
            reason,
        };
        if let Some(hint) = hints::comma(text) {
            return Err(refused(hint));
        }
        let Some((number, unit)) = split(text) else {
            return Err(refused(format!(
                "must be a number, alone or with a unit of {}: {}",
                self.name(),
                self.offer()
            )));
        };
        if unit.is_empty() {
            return Err(refused(format!("the unit is missing: {}", self.offer())));
        }
        if let (Self::Speed, Some(circle)) = (self, unit.strip_prefix("rpm")) {
            let Some(diameter) = circle.trim().strip_prefix("on ") else {
                return Err(refused(
                    "rpm is a rate of rotation, not a speed in m/s; with the diameter of the surface it is one: \"1500 rpm on 40 mm\""
                        .to_owned(),
                ));
            };
            let diameter = Self::Length.parse(field, diameter)?;
            InputError::require_positive(field, diameter)?;
            let turns = number.parse::<f64>().unwrap_or(f64::NAN) / 60.0;
            let speed = std::f64::consts::PI * diameter * turns;
            return Some(speed)
                .filter(|speed| speed.is_finite())
                .ok_or_else(|| refused("is beyond the range of numbers".into()));
        }
        let plain = plain(unit);
        let known = self.units().iter().find(|(names, _)| names.contains(&plain.as_str()));
        let Some((_, scale)) = known else {
            if let Some(hint) = hints::other_dimension(self, number, &plain) {
                return Err(refused(hint));
            }
            return Err(refused(format!(
                "`{}` is no unit of {}; {}",
                escape(unit),
                self.name(),
                self.offer()
            )));
        };
        let value = match *scale {
            Ten(power) => times_power_of_ten(number, power),
            Times(factor) => number.parse().ok().map(|number: f64| number * factor),
            Plus(zero) => number.parse().ok().map(|number: f64| number + zero),
        };
        value
            .filter(|value| value.is_finite())
            .ok_or_else(|| refused("is beyond the range of numbers".into()))
    }

    /// The valid units, for messages: `m, cm or mm would do`.
    fn offer(self) -> String {
        let names: Vec<&str> = self.unit_names().collect();
        match names.as_slice() {
            [] => String::new(),
            [only] => format!("{only} would do"),
            [first @ .., last] => format!("{} or {last} would do", first.join(", ")),
        }
    }
}
