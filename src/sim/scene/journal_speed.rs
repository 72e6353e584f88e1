//! Speed of a journal as a rate of rotation: `speed = "3000 rpm"` is on the diameter of the journal.

use toml::{Table, Value};

use crate::error::InputError;
use crate::units::Dimension;

/// Completes `"3000 rpm"` by the diameter of the journal in `tables`, before units are converted; the diameter of
/// `"3000 rpm on 50 mm"` \[m\], `None` for other speeds.
///
/// # Errors
/// A diameter behind `on` that is not a length.
pub(super) fn complete(tables: &mut Table) -> Result<Option<f64>, InputError> {
    let Some(Value::Table(bearing)) = tables.get_mut("given_film") else { return Ok(None) };
    if bearing.get("kind").and_then(Value::as_str) != Some("journal") {
        return Ok(None);
    }
    let Some((number, circle)) =
        bearing.get("speed").and_then(Value::as_str).and_then(|speed| speed.split_once("rpm"))
    else {
        return Ok(None);
    };
    if let Some(diameter) = circle.trim().strip_prefix("on ") {
        return Dimension::Length.parse("given_film.speed", diameter).map(Some);
    }
    let diameter = match bearing.get("diameter") {
        Some(Value::String(text)) => text.clone(),
        Some(Value::Float(metres)) => format!("{metres} m"),
        Some(Value::Integer(metres)) => format!("{metres} m"),
        _ => return Ok(None),
    };
    if circle.trim().is_empty() {
        let speed = format!("{} rpm on {diameter}", number.trim());
        bearing.insert("speed".to_owned(), speed.into());
    }
    Ok(None)
}
