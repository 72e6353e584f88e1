//! Mean and scatter over the seeds of random surfaces.

use serde_json::{Map, Value, json};

use super::axes::{Axis, Input};
use super::folder;
use crate::output;
use crate::sample::Sample;

/// Numbers of the printed table: heading, name, and factor to its unit.
const SHOWN: [(&str, &str, f64); 6] = [
    ("load ratio", "contact.load_ratio", 1.0),
    ("friction", "friction.coefficient", 1.0),
    ("h min, nm", "film.minimum", 1e9),
    ("h mean, nm", "film.mean_central", 1e9),
    ("p max, GPa", "pressure.max", 1e-9),
    ("area ratio", "contact.area_ratio", 1.0),
];
/// Width of a column of the printed table.
const WIDTH: usize = 25;

/// Values by the keys of the scene.
type Inputs = Vec<(String, Value)>;

/// Converged points that differ in their seeds alone.
pub(super) struct Group {
    /// The inputs beside the seeds.
    inputs: Inputs,
    /// Number of points.
    count: usize,
    /// Numbers that all points have.
    numbers: Vec<(String, Sample)>,
}

/// The groups of the points `done`; none where no seed varies.
pub(super) fn groups(axes: &[Axis], inputs: &[Input], done: &[(usize, Value)]) -> Vec<Group> {
    if !axes.iter().any(Axis::is_seed) {
        return Vec::new();
    }
    let mut groups: Vec<(Inputs, Vec<&Value>)> = Vec::new();
    for (k, result) in done.iter().filter(|(_, result)| result["status"] == "converged") {
        let fixed = axes.iter().zip(&inputs[*k].values).filter(|(axis, _)| !axis.is_seed());
        let fixed: Inputs = fixed.map(|(_, input)| input.clone()).collect();
        match groups.iter_mut().find(|(inputs, _)| *inputs == fixed) {
            Some((_, results)) => results.push(&result["values"]),
            None => groups.push((fixed, vec![&result["values"]])),
        }
    }
    let several = groups.into_iter().filter(|(_, results)| results.len() > 1);
    several.map(|(inputs, results)| Group::of(inputs, &results)).collect()
}

impl Group {
    /// The group of the points with these `results`.
    fn of(inputs: Inputs, results: &[&Value]) -> Self {
        let mut columns: Vec<(String, Vec<f64>)> = Vec::new();
        for (name, value) in results.iter().flat_map(|result| folder::leaves(result)) {
            let Some(value) = value.as_f64() else { continue };
            match columns.iter_mut().find(|(known, _)| *known == name) {
                Some((_, values)) => values.push(value),
                None => columns.push((name, vec![value])),
            }
        }
        let count = results.len();
        let whole = columns.into_iter().filter(|(_, values)| values.len() == count);
        let numbers = whole.filter_map(|(name, values)| Some((name, Sample::of(&values)?))).collect();
        Self { inputs, count, numbers }
    }

    /// Inputs, number of points, and mean and standard deviation of each number.
    pub(super) fn to_json(&self) -> Value {
        let inputs: Map<String, Value> = self.inputs.iter().cloned().collect();
        let numbers = self.numbers.iter().map(|(name, Sample { mean, deviation })| {
            (name.clone(), json!({ "mean": mean, "standard_deviation": deviation }))
        });
        json!({ "inputs": inputs, "count": self.count, "means": numbers.collect::<Map<String, Value>>() })
    }

    /// Mean and standard deviation of the number `name` times `factor`.
    fn cell(&self, name: &str, factor: f64) -> String {
        match self.numbers.iter().find(|(known, _)| known == name) {
            Some((_, Sample { mean, deviation })) => format!(
                "{} +- {}",
                output::digits(factor * mean),
                output::digits(factor * deviation.unwrap_or(0.0))
            ),
            None => String::new(),
        }
    }

    /// The inputs beside the seeds in words.
    fn place(&self) -> String {
        let text = |value: &Value| value.as_f64().map_or_else(|| value.to_string(), output::digits);
        let inputs = self.inputs.iter().map(|(key, value)| format!("{key} = {}", text(value)));
        inputs.collect::<Vec<_>>().join(", ")
    }
}

/// A table with a line for each group.
pub(super) fn table(groups: &[Group]) -> Vec<String> {
    if groups.is_empty() {
        return Vec::new();
    }
    let mut lines = vec!["seeds      means over the seeds +- standard deviation of one surface".to_owned()];
    let headings = SHOWN.map(|(heading, ..)| format!("{heading:>WIDTH$}"));
    lines.push(format!("{:>10}{}", "surfaces", headings.concat()));
    lines.extend(groups.iter().map(|group| {
        let cells = SHOWN.map(|(_, name, factor)| format!("{:>WIDTH$}", group.cell(name, factor)));
        format!("{:>10}{}  {}", group.count, cells.concat(), group.place()).trim_end().to_owned()
    }));
    lines
}
