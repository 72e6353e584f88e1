//! The rows of a cycle with the thinnest and the thickest film by formula.

use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};
use stribeck::Warning;
use stribeck::sim::scene::Scene;
use stribeck::sim::{CycleExtremes, CycleRowScene, MixedLubricationSim, SimError};
use stribeck::units::by_size;

use super::Expected;

/// The contacts of both rows.
pub(super) struct Rows {
    extremes: CycleExtremes,
    thinnest: Expected,
    thickest: Expected,
    /// The warnings of the cycle before its first contact, or the reason why it is not solved.
    checked: Result<Vec<Warning>, SimError>,
}

impl Rows {
    /// Those of `scene` in `file`; `None` without a cycle or a lubricant.
    pub(super) fn of(scene: &Scene, file: &Path) -> Result<Option<Self>, Box<dyn Error>> {
        let Some(extremes) = scene.cycle_extremes()? else { return Ok(None) };
        let thinnest = Expected::of(&extremes.thinnest.scene, file)?;
        let thickest = Expected::of(&extremes.thickest.scene, file)?;
        let checked = MixedLubricationSim::builder(scene.clone()).check_cycle();
        Ok(Some(Self { extremes, thinnest, thickest, checked }))
    }

    /// The warnings of the cycle before its first contact.
    pub(super) fn warnings(&self) -> &[Warning] {
        self.checked.as_deref().unwrap_or_default()
    }

    /// The reason why the cycle is not solved.
    pub(super) fn refusal(&self) -> Option<&SimError> {
        self.checked.as_ref().err()
    }

    /// The cycle, and the contacts of both rows.
    pub(super) fn lines(&self) -> Vec<String> {
        let CycleExtremes { rows, contacts, quasi_static, rows_at_rest, .. } = self.extremes;
        let how = if quasi_static { "steady contacts" } else { "contacts in time" };
        let rest = match rows_at_rest {
            0 => String::new(),
            rest => format!("; {rest} rows at rest, for which no formula holds"),
        };
        let mut lines = vec![format!("cycle      {rows} rows, {contacts} {how}{rest}")];
        for (name, row, expected) in [
            ("thinnest", &self.extremes.thinnest, &self.thinnest),
            ("thickest", &self.extremes.thickest, &self.thickest),
        ] {
            lines.push(format!("{name} film by formula: {}", conditions(row)));
            lines.extend(expected.contact_lines());
        }
        lines
    }

    pub(super) fn to_json(&self) -> Result<Value, serde_json::Error> {
        let contact = |row: &CycleRowScene, expected: &Expected| -> Result<Value, serde_json::Error> {
            let mut numbers = expected.to_json()?;
            let kept = ["hertz", "moes", "regime", "film", "contact", "friction", "film_rise", "flash_rise"];
            let kept = kept.map(|key| (key.to_owned(), numbers[key].take()));
            let mut object = json!({ "row": row.place, "time": row.time, "angle": row.angle });
            kept.into_iter().for_each(|(key, value)| object[key] = value);
            Ok(object)
        };
        Ok(json!({
            "rows": self.extremes.rows,
            "contacts": self.extremes.contacts,
            "rows_at_rest": self.extremes.rows_at_rest,
            "refused": self.refusal().map(ToString::to_string),
            "thinnest": contact(&self.extremes.thinnest, &self.thinnest)?,
            "thickest": contact(&self.extremes.thickest, &self.thickest)?,
        }))
    }
}

/// Place, load, speed and radius of `row`.
fn conditions(row: &CycleRowScene) -> String {
    let place = match row.angle {
        Some(angle) => format!("{:.2} deg", angle.to_degrees()),
        None => format!("{:.4e} s", row.time),
    };
    let unit = if row.scene.form.is_line() { "N/m" } else { "N" };
    format!(
        "{} at {place}, {}, {:.4} m/s, radius {}",
        row.place,
        by_size(row.scene.load.force.unwrap_or(f64::NAN), unit),
        row.scene.motion.entrainment_speed,
        by_size(row.scene.form.radii().0, "m")
    )
}
