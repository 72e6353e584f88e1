//! The folder of a sweep: one file a point, and a table of all.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use stribeck::sim::Scene;

use super::axes::Input;
use crate::files;

/// A folder that belongs to the points of one scene.
pub(super) struct Folder(PathBuf);

impl Folder {
    /// Makes the folder, or takes one of the same points.
    pub(super) fn open(path: &Path, scene: &Scene, inputs: &[Input]) -> Result<Self, String> {
        let scene = scene.to_toml().map_err(|error| error.to_string())?;
        let points: Vec<Value> = inputs.iter().map(|input| json!(input.values)).collect();
        let own = json!({ "scene": scene, "points": points });
        files::make_folder(path)?;
        let file = path.join("sweep.json");
        if file.exists() {
            let other = read(&file);
            let differ: Vec<&str> = ["scene", "points"]
                .into_iter()
                .filter(|part| other.as_ref().is_none_or(|other| other[*part] != own[*part]))
                .collect();
            if !differ.is_empty() {
                return Err(format!(
                    "--out {}: holds another sweep, whose {} differ; give another folder",
                    path.display(),
                    differ.join(" and ")
                ));
            }
        } else {
            write(&file, &own)?;
        }
        Ok(Self(path.to_owned()))
    }

    fn file(&self, point: usize) -> PathBuf {
        self.0.join(format!("point_{point:06}.json"))
    }

    /// The result of a point, where there is a sound one.
    pub(super) fn kept(&self, point: usize) -> Option<Value> {
        let is_sound = |result: &Value| {
            let has_error = result["error"].is_string();
            result["status"].is_string() && (has_error || result["values"]["status"].is_string())
        };
        read(&self.file(point)).filter(is_sound)
    }

    /// Keeps the result of a point.
    pub(super) fn keep(&self, point: usize, result: &Value) -> Result<(), String> {
        write(&self.file(point), result)
    }

    /// Writes `sweep.csv`, a line for each of the points that are `done`: inputs, status, error and all numbers.
    pub(super) fn write_table(&self, inputs: &[Input], done: &[(usize, Value)]) -> Result<PathBuf, String> {
        let rows: Vec<Vec<(String, String)>> =
            done.iter().map(|(_, result)| numbers(&result["values"])).collect();
        let mut names: Vec<String> = Vec::new();
        for (name, _) in rows.iter().flatten() {
            if !names.contains(name) {
                names.push(name.clone());
            }
        }
        let keys =
            inputs.first().map(|input| input.values.iter().map(|(key, _)| key.clone()).collect::<Vec<_>>());
        let mut head = keys.unwrap_or_default();
        // of inputs that have the name of a number
        head.iter_mut().filter(|key| names.contains(key)).for_each(|key| *key = format!("scene.{key}"));
        head.extend(["status".to_owned(), "error".to_owned()]);
        let mut text = head.into_iter().chain(names.iter().cloned()).collect::<Vec<_>>().join(",") + "\n";
        for ((k, result), row) in done.iter().zip(&rows) {
            let given = inputs[*k].values.iter().map(|(_, value)| quoted(value));
            let ends = ["status", "error"].map(|part| quoted(&result[part]));
            let values = names.iter().map(|name| {
                row.iter()
                    .find(|(other, _)| other == name)
                    .map_or_else(String::new, |(_, value)| value.clone())
            });
            text += &(given.chain(ends).chain(values).collect::<Vec<_>>().join(",") + "\n");
        }
        let file = self.0.join("sweep.csv");
        files::write(&file, text.as_bytes()).map_err(|error| error.to_string())?;
        Ok(file)
    }
}

/// The numbers by their names with dots, without lists.
fn numbers(values: &Value) -> Vec<(String, String)> {
    let fields = leaves(values).into_iter().filter(|(name, _)| name != "status");
    fields.map(|(name, value)| (name, quoted(value))).collect()
}

/// The values by their names with dots, without lists.
pub(super) fn leaves(values: &Value) -> Vec<(String, &Value)> {
    let mut found = Vec::new();
    collect(values, "", &mut found);
    found
}

fn collect<'a>(values: &'a Value, prefix: &str, found: &mut Vec<(String, &'a Value)>) {
    match values {
        Value::Object(parts) => {
            for (key, value) in parts {
                let name = if prefix.is_empty() { key.clone() } else { format!("{prefix}.{key}") };
                collect(value, &name, found);
            }
        }
        Value::Array(_) => {}
        value => found.push((prefix.to_owned(), value)),
    }
}

/// A value as a field of a table.
fn quoted(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) if text.contains([',', '"', '\n']) => {
            format!("\"{}\"", text.replace('"', "\"\""))
        }
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

fn read(file: &Path) -> Option<Value> {
    serde_json::from_str(&fs::read_to_string(file).ok()?).ok()
}

fn write(file: &Path, value: &Value) -> Result<(), String> {
    files::write(file, value.to_string().as_bytes()).map_err(|error| error.to_string())
}
