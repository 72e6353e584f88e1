//! A solved cycle, in its file too: a second command with the same scene takes it from there.

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, from_value, json};
use stribeck::sim::scene::{Roughness, Scene};
use stribeck::sim::{CyclePoint, CycleRecord, CycleSolution, Warning};

use super::mean_power;
use super::squeeze::largest_squeeze;
use crate::files;

/// A solved cycle without its fields.
pub(super) struct Solved {
    pub(super) points: Vec<CyclePoint>,
    pub(super) cycles: Vec<CycleRecord>,
    pub(super) quasi_static: bool,
    pub(super) is_moving: bool,
    pub(super) largest_step: f64,
    pub(super) closure: f64,
    pub(super) warnings: Vec<Warning>,
    pub(super) ended_early: Option<String>,
    /// Time of the solve \[s\].
    pub(super) seconds: f64,
}

impl Solved {
    /// That of `solution`, which took so many `seconds`.
    pub(super) fn of(solution: CycleSolution, seconds: f64) -> Self {
        Self {
            points: solution.points,
            cycles: solution.cycles,
            quasi_static: solution.quasi_static,
            is_moving: solution.is_moving,
            largest_step: solution.largest_step,
            closure: solution.closure,
            warnings: solution.warnings,
            ended_early: solution.ended_early.map(|reason| reason.to_string()),
            seconds,
        }
    }

    pub(super) fn to_json(&self) -> Value {
        json!({
            "points": self.points,
            "cycles": self.cycles,
            "quasi_static": self.quasi_static,
            "is_moving": self.is_moving,
            "largest_step": self.largest_step,
            "closure": self.closure,
            "mean_friction_power": mean_power(&self.points),
            "largest_squeeze_ratio": largest_squeeze(self).map(|point| point.squeeze_ratio),
            "warnings": self.warnings,
            "ended_early": self.ended_early,
            "seconds": self.seconds,
            "version": env!("CARGO_PKG_VERSION"),
        })
    }

    /// The whole cycle in `numbers`; `None` for one that ended early.
    fn from_json(numbers: &Value) -> Option<Self> {
        let part = |key: &str| numbers.get(key).cloned().unwrap_or_default();
        numbers.get("ended_early").filter(|reason| reason.is_null())?;
        Some(Self {
            points: from_value(part("points")).ok()?,
            cycles: from_value(part("cycles")).ok()?,
            quasi_static: from_value(part("quasi_static")).ok()?,
            is_moving: from_value(part("is_moving")).ok()?,
            largest_step: from_value(part("largest_step")).ok()?,
            closure: from_value(part("closure")).ok()?,
            warnings: from_value(part("warnings")).ok()?,
            ended_early: None,
            seconds: from_value(part("seconds")).ok()?,
        })
    }
}

/// The file of a solved cycle with its scene.
pub(super) struct Kept {
    pub(super) path: PathBuf,
    /// The scene as text.
    scene: String,
    /// Files that the scene reads.
    inputs: Vec<PathBuf>,
    /// The former content of the file, if it is of the same scene.
    former: Option<Value>,
}

impl Kept {
    /// The file at `path` for the cycle of `scene`.
    pub(super) fn of(scene: &Scene, path: PathBuf) -> Result<Self, Box<dyn Error>> {
        let text = scene.to_toml()?;
        let heights = [&scene.roughness.ball, &scene.roughness.disc].map(|roughness| match roughness {
            Roughness::File(file) => Some(file.path.clone()),
            _ => None,
        });
        let table = scene.cycle.as_ref().and_then(|cycle| cycle.table.clone());
        let former =
            fs::read_to_string(&path).ok().and_then(|text| serde_json::from_str::<Value>(&text).ok());
        let former = former.filter(|former| former["scene"] == text.as_str());
        Ok(Self { path, scene: text, inputs: heights.into_iter().flatten().chain(table).collect(), former })
    }

    /// Whether a former cycle of this name is of the same scene.
    pub(super) fn is_of_scene(&self) -> bool {
        self.former.is_some()
    }

    /// The former cycle, if it is whole, of this version, not older than the files that the scene reads, and has its `tables`.
    pub(super) fn solved(&self, tables: &[PathBuf]) -> Option<Solved> {
        let former = self.former.as_ref().filter(|former| former["version"] == env!("CARGO_PKG_VERSION"))?;
        let modified = |path: &Path| fs::metadata(path).and_then(|found| found.modified()).ok();
        let written = modified(&self.path)?;
        let is_newer = |input: &PathBuf| modified(input).is_none_or(|time| time > written);
        if self.inputs.iter().any(is_newer) || !tables.iter().all(|table| table.is_file()) {
            return None;
        }
        Solved::from_json(former)
    }

    /// Writes the `numbers` of a solved cycle.
    pub(super) fn write(&self, mut numbers: Value) -> Result<(), Box<dyn Error>> {
        numbers["scene"] = json!(self.scene);
        files::write(&self.path, numbers.to_string().as_bytes())
    }
}
