//! The table of a history for people: first step, last step and mean of the last tenth, in units of their size.

use std::fmt;

use crate::sim::history::history_means::{HistoryMeans, RATES};

/// Columns that say nothing of a dry contact: its gap is rounding where the solids touch.
const OF_FILMS: [&str; 3] = ["film.", "friction.fluid", "contact.film_cutoff"];
/// Columns that are left out where they are zero: processes and corrections that the scene does not have.
const OF_PROCESSES: [&str; 4] = ["wear.", "tribofilm.", "plastic.", "pressure.load_outside"];
/// Volumes are in cubic millimetres.
const CUBIC_MILLIMETRES: (f64, &str) = (1e9, "mm^3");
/// Digits of a number.
const DIGITS: i32 = 5;

/// Units of a quantity in the SI unit `unit`, the largest first, with the values that one of them has.
fn units(unit: &str) -> &'static [(f64, &'static str)] {
    match unit {
        "m" => &[(1e-3, "mm"), (1e-6, "um"), (0.0, "nm")],
        "Pa" => &[(1e8, "GPa"), (1e5, "MPa"), (0.0, "Pa")],
        "m^2" => &[(1e-6, "mm^2"), (0.0, "um^2")],
        "m^3" => &[(0.0, CUBIC_MILLIMETRES.1)],
        "m^3/s" => &[(0.0, "mm^3/s")],
        _ => &[],
    }
}

/// Factor from SI units to the unit `name`.
fn factor(name: &str) -> f64 {
    match name {
        "mm" => 1e3,
        "um" | "mm^2" => 1e6,
        "nm" => 1e9,
        "GPa" => 1e-9,
        "MPa" => 1e-6,
        "um^2" => 1e12,
        "mm^3" | "mm^3/s" => CUBIC_MILLIMETRES.0,
        _ => 1.0,
    }
}

/// A number with its digits; very large and small ones with an exponent.
fn digits(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if !(1e-3..1e6).contains(&size) {
        return format!("{value:.*e}", DIGITS as usize - 1);
    }
    let decimals = (DIGITS - 1 - size.log10().floor() as i32).max(0) as usize;
    format!("{value:.decimals$}")
}

impl fmt::Display for HistoryMeans {
    /// A table of the first step, the last step, the mean of the last tenth and the unit, one line per result that the
    /// scene has. Units follow the size: nm, um or mm, MPa or GPa. Specific wear rates are in mm^3/(N m).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let begins = |name: &str, list: &[&str]| list.iter().any(|start| name.starts_with(start));
        write!(f, "{:<28} {:>12} {:>12} {:>12}  unit", "", "first step", "last step", "last tenth")?;
        for (column, values) in self.rows() {
            let largest = values.iter().flatten().fold(0.0, |most: f64, value| most.max(value.abs()));
            let is_absent = begins(column.name, &OF_PROCESSES) && largest == 0.0;
            if is_absent || (self.is_dry() && begins(column.name, &OF_FILMS)) {
                continue;
            }
            let of_size = units(column.unit).iter().find(|(least, _)| largest >= *least);
            let unit = of_size.map_or(column.unit, |(_, name)| *name);
            let cells =
                values.map(|value| value.map_or_else(String::new, |value| digits(factor(unit) * value)));
            let [first, last, mean] = cells;
            write!(f, "\n{:<28} {first:>12} {last:>12} {mean:>12}  {unit}", column.name)?;
        }
        for (name, rate) in RATES.into_iter().zip(self.specific_wear_rates().into_iter().flatten()) {
            if rate > 0.0 {
                let (name, rate) = (format!("wear.{name}"), digits(CUBIC_MILLIMETRES.0 * rate));
                write!(f, "\n{name:<28} {:>12} {rate:>12} {:>12}  mm^3/(N m)", "", "")?;
            }
        }
        Ok(())
    }
}
