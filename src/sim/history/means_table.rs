//! The table of a history for people: first step, last step and mean of the last tenth, in units of their size.

use std::fmt;

use crate::sim::history::history_means::{HistoryMeans, RATES};
use crate::units::unit_by_size;

/// Columns that say nothing of a dry contact: its gap is rounding where the solids touch.
const OF_FILMS: [&str; 3] = ["film.", "friction.fluid", "contact.film_cutoff"];
/// Columns that are left out where they are zero: processes and corrections that the scene does not have.
const OF_PROCESSES: [&str; 4] = ["wear.", "tribofilm.", "plastic.", "pressure.load_outside"];
/// Digits of a number.
const DIGITS: i32 = 5;

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
            let (unit, factor) = unit_by_size(largest, self.unit(column));
            let cells = values.map(|value| value.map_or_else(String::new, |value| digits(value / factor)));
            let [first, last, mean] = cells;
            write!(f, "\n{:<28} {first:>12} {last:>12} {mean:>12}  {unit}", column.name)?;
        }
        for (name, rate) in RATES.into_iter().zip(self.specific_wear_rates().into_iter().flatten()) {
            if rate > 0.0 {
                let (name, rate) = (format!("wear.{name}"), digits(1e9 * rate));
                write!(f, "\n{name:<28} {:>12} {rate:>12} {:>12}  mm^3/(N m)", "", "")?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::history::columns::COLUMNS;

    #[test]
    fn units_of_lines_are_per_metre() {
        let unit = |name: &str, means: &HistoryMeans| {
            let column = COLUMNS.iter().find(|column| column.name == name);
            column.map_or("", |column| means.unit(column))
        };
        let (point, line) = (HistoryMeans::new(1), HistoryMeans::new(1).of_line());
        for (name, units) in [
            ("flow.outflow", ["m^3/s", "m^2/s"]),
            ("wear.ball_volume", ["m^3", "m^3/m"]),
            ("friction.power_loss", ["W", "W/m"]),
            ("film.central", ["m", "m"]),
        ] {
            assert_eq!([unit(name, &point), unit(name, &line)], units, "{name}");
        }
    }
}
