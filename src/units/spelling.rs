//! Splitting a quantity into number and unit, and plain spelling of units.

/// Number and unit of `text`; `None` if it does not begin with a number.
pub(super) fn split(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    if !text.starts_with(|c: char| c.is_ascii_digit() || ['+', '-', '.'].contains(&c)) {
        return None;
    }
    // The longest possible number: its digits, signs and exponent.
    let longest = text.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c))).unwrap_or(text.len());
    let end = (1..=longest).rev().find(|end| text[..*end].parse::<f64>().is_ok())?;
    Some((&text[..end], text[end..].trim()))
}

/// The spelling of `unit` in the tables: `mPa.s` is `mPa s`, `mm2/N` is `mm^2/N`, `GPa-1` is `GPa^-1`.
pub(super) fn plain(unit: &str) -> String {
    let unit = unit
        .replace(['\u{b5}', '\u{3bc}'], "u")
        .replace('\u{2103}', "degC")
        .replace('\u{b0}', "deg")
        .replace('\u{b2}', "2")
        .replace('\u{b3}', "3")
        .replace("\u{207b}\u{b9}", "-1")
        .replace(['\u{2212}', '\u{2013}'], "-")
        .replace(['*', '.', '\u{b7}', '\u{22c5}'], " ");
    let mut plain = String::with_capacity(unit.len());
    for (index, c) in unit.char_indices() {
        let exponent = unit[index..].trim_start_matches('-').starts_with(|c: char| c.is_ascii_digit());
        if exponent && plain.ends_with(|before: char| before.is_ascii_alphabetic()) {
            plain.push('^');
        }
        plain.push(c);
    }
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The number with `power` added to its exponent, correctly rounded.
pub(super) fn times_power_of_ten(number: &str, power: i32) -> Option<f64> {
    let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent = exponent.parse::<i32>().ok()?.checked_add(power)?;
    format!("{digits}e{exponent}").parse().ok()
}
