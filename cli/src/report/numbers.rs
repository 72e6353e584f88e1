//! Tables of a report. Every number is that of the JSON object under the key that its cell names.

use serde_json::Value;

use super::escape;

/// The error of a number.
#[derive(Debug, Clone, Copy)]
pub(crate) enum ErrorOf<'a> {
    None,
    /// Key of a share of the number.
    Relative(&'a str),
    /// Key of a number of the same unit.
    Absolute(&'a str),
}

/// A number of the JSON object.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Number<'a> {
    pub(crate) name: &'a str,
    /// Its keys, with dots between them.
    pub(crate) key: &'a str,
    pub(crate) unit: &'a str,
    /// From SI units to `unit`.
    pub(crate) factor: f64,
    /// From the zero of the SI unit to that of `unit`, in `unit`.
    pub(crate) offset: f64,
    pub(crate) error: ErrorOf<'a>,
}

pub(super) const fn number<'a>(name: &'a str, key: &'a str, unit: &'a str, factor: f64) -> Number<'a> {
    Number { name, key, unit, factor, offset: 0.0, error: ErrorOf::None }
}

const fn estimated<'a>(
    name: &'a str,
    key: &'a str,
    unit: &'a str,
    factor: f64,
    error: ErrorOf<'a>,
) -> Number<'a> {
    Number { name, key, unit, factor, offset: 0.0, error }
}

/// Numbers of a contact and of the means of a history. Those that an object does not have are left out.
const CONTACT: [Number<'static>; 50] = [
    number("Hertz pressure", "hertz.pressure", "GPa", 1e-9),
    number("Half-width along x", "hertz.half_width_x", "µm", 1e6),
    number("Half-width along y", "hertz.half_width_y", "µm", 1e6),
    number("Load", "hertz.force", "N", 1.0),
    number("Moes M", "moes.m", "", 1.0),
    number("Moes L", "moes.l", "", 1.0),
    estimated(
        "Mean film",
        "film.mean_central",
        "nm",
        1e9,
        ErrorOf::Relative("error_estimate.film_mean_central"),
    ),
    estimated("Central film", "film.central", "nm", 1e9, ErrorOf::Relative("error_estimate.film_central")),
    estimated("Least film", "film.minimum", "nm", 1e9, ErrorOf::Relative("error_estimate.film_minimum")),
    number("Film over Rq", "film.lambda", "", 1.0),
    number("Least film over Rq", "film.minimum_lambda", "", 1.0),
    number("Film over Rq by formula", "film.formula_lambda", "", 1.0),
    number("Film over that by formula", "film.formula_ratio", "", 1.0),
    number("Central film over the flooded one", "starvation.film_ratio", "", 1.0),
    number("Central film if flooded", "starvation.flooded_film", "nm", 1e9),
    number("Oil in the gap of the contact", "film.fluid_fraction", "%", 100.0),
    estimated(
        "Load on solids",
        "contact.load_ratio",
        "",
        1.0,
        ErrorOf::Absolute("error_estimate.contact_load_ratio"),
    ),
    estimated(
        "Contact over Hertz area",
        "contact.area_ratio",
        "",
        1.0,
        ErrorOf::Absolute("error_estimate.contact_area_ratio"),
    ),
    number("Plastic area", "contact.plastic_area", "µm²", 1e12),
    estimated(
        "Largest pressure",
        "pressure.max",
        "GPa",
        1e-9,
        ErrorOf::Relative("error_estimate.pressure_max"),
    ),
    number("Central pressure", "pressure.central", "GPa", 1e-9),
    estimated(
        "Friction coefficient",
        "friction.coefficient",
        "",
        1.0,
        ErrorOf::Relative("error_estimate.friction_coefficient"),
    ),
    number("of which solid contact", "friction.boundary", "", 1.0),
    number("of which fluid", "friction.fluid", "", 1.0),
    number("Power loss", "friction.power_loss", "W", 1.0),
    number("Flash temperature rise", "flash_rise", "K", 1.0),
    number("Composite Rq", "roughness.composite_rq", "nm", 1e9),
    number("Rq of the ball", "roughness.ball_rq", "nm", 1e9),
    number("Rq of the disc", "roughness.disc_rq", "nm", 1e9),
    number("Viscosity of the oil", "oil.eta0", "mPa s", 1e3),
    number("Viscosity ratio kappa (ISO 281)", "oil.kappa", "", 1.0),
    number("Inflow", "flow.inflow", "mm³/s", 1e9),
    number("Flow imbalance", "flow.imbalance", "", 1.0),
    number("Time of the test", "time", "s", 1.0),
    number("Steps", "steps", "", 1.0),
    number("Steps of the means", "averaged_steps", "", 1.0),
    number("Worn from the ball", "wear.ball_in_contact", "nm", 1e9),
    number("Worn from the disc", "wear.disc_in_contact", "nm", 1e9),
    number("Wear volume of the ball", "wear.ball_volume", "mm³", 1e9),
    number("Wear volume of the disc", "wear.disc_volume", "mm³", 1e9),
    number("Specific wear rate of the ball", "wear.ball_specific_rate", "mm³/(N m)", 1e9),
    number("Specific wear rate of the disc", "wear.disc_specific_rate", "mm³/(N m)", 1e9),
    number("Scar width of the ball", "wear.ball_scar_width", "µm", 1e6),
    number("Scar width of the disc", "wear.disc_scar_width", "µm", 1e6),
    number("Scar depth of the ball", "wear.ball_scar_depth", "nm", 1e9),
    number("Scar depth of the disc", "wear.disc_scar_depth", "nm", 1e9),
    number("Tribofilm on the ball", "tribofilm.ball_in_contact", "nm", 1e9),
    number("Tribofilm on the disc", "tribofilm.disc_in_contact", "nm", 1e9),
    number("Residual of the mass", "residual.mass", "", 1.0),
    number("Time of the computation", "seconds", "s", 1.0),
];

/// The numbers of a contact; films of a dry one are rounding where the solids touch, and are left out. Those of a `line` contact are
/// per metre of its length, which has no half-width along y.
pub(crate) fn contact(json: &Value, lubricated: bool, line: bool) -> String {
    let shown = |number: &&Number<'_>| match number.key {
        "film.central" | "film.minimum" => lubricated,
        "hertz.half_width_y" => !line,
        _ => true,
    };
    let of_line = |number: &Number<'static>| {
        let unit = match number.key {
            "hertz.force" => "N/m",
            "contact.plastic_area" => "µm²/m",
            "flow.inflow" => "mm³/(s m)",
            "friction.power_loss" => "W/m",
            "wear.ball_volume" | "wear.disc_volume" => "mm³/m",
            _ => number.unit,
        };
        Number { unit, ..*number }
    };
    let numbers = CONTACT.iter().filter(shown);
    list(json, &numbers.map(|number| if line { of_line(number) } else { *number }).collect::<Vec<_>>())
}

/// Numbers below each other, with their errors and units.
pub(crate) fn list(json: &Value, numbers: &[Number<'_>]) -> String {
    let rows = numbers.iter().filter_map(|number| {
        let value = cell(json, number.key, [number.factor, number.offset], FOUR)?;
        let error = error_of(json, number, |key| key.to_owned());
        let [name, unit] = [number.name, number.unit].map(escape);
        Some(match number.error {
            // An error in per cent follows the unit of the value.
            ErrorOf::Relative(_) => format!("<tr><th>{name}</th><td>{value}</td><td>{unit}{error}</td></tr>"),
            _ => format!("<tr><th>{name}</th><td>{value}{error}</td><td>{unit}</td></tr>"),
        })
    });
    format!("<table class=\"list\"><tbody>{}</tbody></table>\n", rows.collect::<String>())
}

/// Lines of a name and a text.
pub(crate) fn lines(lines: &[(&str, String)]) -> String {
    let row = |(name, text): &(&str, String)| {
        format!("<tr><th>{}</th><td>{}</td></tr>", escape(name), escape(text))
    };
    let rows = lines.iter().map(row);
    format!("<table class=\"list\"><tbody>{}</tbody></table>\n", rows.collect::<String>())
}

/// A row for each entry of the array `array` of `json`, at most `most` of them, evenly spread.
pub(crate) fn rows(json: &Value, array: &str, columns: &[Number<'_>], most: usize) -> String {
    let entries = json[array].as_array().map_or(0, Vec::len);
    let every = entries.div_ceil(most).max(1);
    let known = |column: &&Number<'_>| (0..entries).any(|k| value_at(&json[array][k], column.key).is_some());
    let columns: Vec<_> = columns.iter().filter(known).collect();
    let heads = columns.iter().map(|column| {
        let unit = if column.unit.is_empty() { String::new() } else { format!(", {}", escape(column.unit)) };
        format!("<th>{}{unit}</th>", escape(column.name))
    });
    let head = heads.collect::<String>();
    let body = (0..entries).step_by(every).map(|k| {
        let cells = columns.iter().map(|column| {
            let key = |name: &str| format!("{array}.{k}.{name}");
            let value = cell(json, &key(column.key), [column.factor, column.offset], FOUR)
                .unwrap_or_else(|| "-".to_owned());
            format!("<td>{value}{}</td>", error_of(json, column, key))
        });
        format!("<tr>{}</tr>", cells.collect::<String>())
    });
    let note = if every > 1 {
        format!("<p>One of {every} rows; the table (csv) has all.</p>")
    } else {
        String::new()
    };
    format!(
        "<div class=\"tables\"><table class=\"rows\"><thead><tr>{head}</tr></thead><tbody>{}</tbody></table>{note}</div>\n",
        body.collect::<String>()
    )
}

/// All numbers of an object in SI units, without those in arrays.
pub(crate) fn all(json: &Value) -> String {
    let mut keys = Vec::new();
    numbers_in(json, "", &mut keys);
    let numbers: Vec<_> = keys.iter().map(|key| number(key, key, "", 1.0)).collect();
    list(json, &numbers) + "<p>SI units.</p>\n"
}

fn numbers_in(json: &Value, before: &str, keys: &mut Vec<String>) {
    for (name, value) in json.as_object().into_iter().flatten() {
        let key = if before.is_empty() { name.clone() } else { format!("{before}.{name}") };
        if value.is_number() {
            keys.push(key);
        } else {
            numbers_in(value, &key, keys);
        }
    }
}

/// The error of `number` behind its value; `key` is the path of a name in `json`. Empty without one.
fn error_of(json: &Value, number: &Number<'_>, key: impl Fn(&str) -> String) -> String {
    let error = match number.error {
        ErrorOf::None => None,
        ErrorOf::Relative(name) => {
            cell(json, &key(name), [100.0, 0.0], TWO).map(|error| format!(" ± {error} %"))
        }
        ErrorOf::Absolute(name) => {
            cell(json, &key(name), [number.factor, 0.0], TWO).map(|error| format!(" ± {error}"))
        }
    };
    error.unwrap_or_default()
}

/// Significant digits of values and of errors.
const FOUR: i32 = 4;
const TWO: i32 = 2;

/// The number under `key` with so many `significant` digits, times a factor plus an offset, marked with all three.
fn cell(json: &Value, key: &str, [factor, offset]: [f64; 2], significant: i32) -> Option<String> {
    let value = value_at(json, key)?;
    let key = escape(key);
    let shift = if offset == 0.0 { String::new() } else { format!(" data-offset=\"{offset}\"") };
    let shown = digits(factor * value + offset, significant);
    Some(format!("<span data-key=\"{key}\" data-factor=\"{factor:e}\"{shift}>{shown}</span>"))
}

fn value_at(json: &Value, key: &str) -> Option<f64> {
    let mut value = json;
    for part in key.split('.') {
        value = match part.parse::<usize>() {
            Ok(index) if value.is_array() => value.get(index)?,
            _ => value.get(part)?,
        };
    }
    value.as_f64()
}

/// `significant` digits; whole numbers with all of theirs.
fn digits(value: f64, significant: i32) -> String {
    let size = value.abs();
    if size < 1e7 && value.fract() == 0.0 {
        format!("{value}")
    } else if (1e-3..1e5).contains(&size) {
        let decimals = (significant - 1 - size.log10().floor() as i32).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.*e}", (significant - 1).max(0) as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::{FOUR, TWO, digits};

    #[test]
    fn numbers_have_four_digits_and_whole_ones_all() {
        let shown =
            [0.0, 128.0, 23.976, 0.070_689, 99_999.6, 4.2e-7, -1.5, 0.99996].map(|value| digits(value, FOUR));
        assert_eq!(shown, ["0", "128", "23.98", "0.07069", "100000", "4.200e-7", "-1.500", "1.0000"]);
        assert_eq!(
            [4.376, 12.0, 0.0312, 123.4].map(|value| digits(value, TWO)),
            ["4.4", "12", "0.031", "123"]
        );
    }
}
