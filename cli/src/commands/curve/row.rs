//! The numbers of one value of the curve: means over the surfaces, their spread and their errors.

use serde_json::{Map, Value as Json};
use stribeck::sim::scene::SolverModel;
use stribeck::sim::{ContactSolution, FormulaFilm};

use super::axis::Axis;
use crate::sample::{Sample, mean};

/// A number of a solution as a column of the curve.
pub(super) struct Quantity {
    /// Heading of the column in files, in SI units.
    pub(super) column: &'static str,
    /// Heading in the table on the terminal and label in the picture, and the factor to their unit.
    pub(super) label: &'static str,
    pub(super) factor: f64,
    /// Digits behind the point in the table.
    decimals: usize,
    value: fn(&ContactSolution) -> Option<f64>,
    /// Estimated absolute error.
    error: fn(&ContactSolution) -> Option<f64>,
}

pub(super) const QUANTITIES: [Quantity; 4] = [
    Quantity {
        column: "friction_coefficient",
        label: "friction",
        factor: 1.0,
        decimals: 4,
        value: |solution| Some(solution.friction.coefficient),
        error: |solution| {
            Some(solution.friction.coefficient.abs() * solution.error_estimate?.friction_coefficient)
        },
    },
    Quantity {
        column: "contact_load_ratio",
        label: "load on solids",
        factor: 1.0,
        decimals: 4,
        value: |solution| Some(solution.contact.load_ratio),
        error: |solution| Some(solution.error_estimate?.contact_load_ratio),
    },
    Quantity {
        column: "film_mean_central_m",
        label: "film (nm)",
        factor: 1e9,
        decimals: 2,
        value: |solution| Some(solution.film.mean_central),
        error: |solution| Some(solution.film.mean_central * solution.error_estimate?.film_mean_central),
    },
    Quantity {
        column: "film_lambda",
        label: "film / Rq",
        factor: 1.0,
        decimals: 3,
        value: |solution| solution.film.lambda,
        error: |solution| Some(solution.film.lambda? * solution.error_estimate?.film_mean_central),
    },
];

/// The quantity that a curve is over, and the headings that it has beside the values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Columns {
    pub(super) over: Axis,
    /// Line contacts, with loads per length.
    pub(super) line: bool,
    /// Estimated errors are asked for.
    pub(super) errors: bool,
    /// There are several surfaces.
    pub(super) spread: bool,
}

impl Columns {
    /// A value of the quantity in messages.
    pub(super) fn words(self, value: f64) -> String {
        self.over.words(value, self.line)
    }
}

/// A number at one value of the quantity.
#[derive(Debug, Clone, Copy)]
pub(super) struct Value {
    pub(super) mean: f64,
    /// Sample standard deviation over the surfaces.
    sd: Option<f64>,
    /// Mean of the estimated errors.
    error: Option<f64>,
}

impl Value {
    /// Half the width of the band around the mean: surfaces and meshes err independently.
    pub(super) fn band(&self) -> Option<f64> {
        match (self.sd, self.error) {
            (None, None) => None,
            (sd, error) => Some(sd.unwrap_or(0.0).hypot(error.unwrap_or(0.0))),
        }
    }
}

/// One point of the curve.
pub(super) struct Row {
    /// The value of the quantity that the curve is over.
    pub(super) at: f64,
    /// Surfaces that the means are over.
    surfaces: usize,
    pub(super) model: SolverModel,
    pub(super) values: [Option<Value>; QUANTITIES.len()],
    /// Means of the friction of solids and of the fluid, over the load.
    pub(super) friction_parts: [f64; 2],
    /// Film of the smooth contact by formula.
    pub(super) formula: Option<FormulaFilm>,
    /// Fields of the warnings of this row.
    pub(super) warned: Vec<String>,
}

impl Row {
    /// That of the converged `solutions`, one for each surface; none without any.
    pub(super) fn of(at: f64, solutions: &[&ContactSolution], formula: Option<FormulaFilm>) -> Option<Self> {
        let all = |get: fn(&ContactSolution) -> Option<f64>| -> Option<Vec<f64>> {
            solutions.iter().map(|solution| get(solution)).collect()
        };
        let mean_of = |get: fn(&ContactSolution) -> Option<f64>| mean(&all(get)?);
        let values = QUANTITIES.map(|quantity| {
            let values = all(quantity.value)?;
            let Sample { mean, deviation: sd } = Sample::of(&values)?;
            let error = mean_of(quantity.error);
            Some(Value { mean, sd, error })
        });
        let model = solutions.first()?.model.unwrap_or_default();
        let friction_parts = [
            mean_of(|solution| Some(solution.friction.boundary))?,
            mean_of(|solution| Some(solution.friction.fluid))?,
        ];
        Some(Self {
            at,
            surfaces: solutions.len(),
            model,
            values,
            friction_parts,
            formula,
            warned: Vec::new(),
        })
    }

    /// Names and values of the columns; a value that is not known is `None`.
    fn cells(&self, columns: Columns) -> Vec<(String, Option<f64>)> {
        let mut cells = vec![(columns.over.column(columns.line).to_owned(), Some(self.at))];
        let named = |ending: &str, get: fn(&Value) -> Option<f64>| {
            let named = QUANTITIES.iter().zip(&self.values);
            let cells = named.map(|(quantity, value)| {
                (format!("{}{ending}", quantity.column), value.as_ref().and_then(get))
            });
            cells.collect::<Vec<_>>()
        };
        cells.extend(named("", |value| Some(value.mean)));
        if columns.errors {
            cells.extend(named("_error", |value| value.error));
        }
        if columns.spread {
            cells.extend(named("_sd", |value| value.sd));
            cells.push(("surfaces".to_owned(), Some(self.surfaces as f64)));
        }
        cells
    }

    /// A line of comma-separated values.
    pub(super) fn csv(&self, columns: Columns) -> String {
        let cells = self.cells(columns).into_iter();
        let texts = cells.map(|(_, value)| value.map_or_else(String::new, |value| format!("{value:e}")));
        texts.chain([self.warned.join(" "), self.model_name().to_owned()]).collect::<Vec<_>>().join(",")
    }

    fn model_name(&self) -> &'static str {
        if self.model.is_resolved() { "resolved" } else { "asperity_inlets" }
    }

    pub(super) fn to_json(&self, columns: Columns) -> Json {
        let cells = self.cells(columns).into_iter().map(|(name, value)| (name, Json::from(value)));
        let model = [
            ("model".to_owned(), Json::from(self.model_name())),
            ("film_formula_m".to_owned(), Json::from(self.formula.map(|film| film.central))),
            ("film_formula".to_owned(), Json::from(self.formula.map(|film| film.formula.to_string()))),
            ("warnings".to_owned(), Json::from(self.warned.clone())),
        ];
        Json::Object(cells.chain(model).collect::<Map<_, _>>())
    }

    /// A line of the table on the terminal.
    pub(super) fn table_line(&self, columns: Columns) -> String {
        let cells = QUANTITIES.iter().zip(&self.values).map(|(quantity, value)| {
            let shown = |number: f64| format!("{:.*}", quantity.decimals, quantity.factor * number);
            let Some(value) = value else { return cell(columns, "-") };
            let band = value.band().map_or_else(String::new, |band| format!(" +- {}", shown(band)));
            cell(columns, &(shown(value.mean) + &band))
        });
        let mark = mark(&self.warned);
        format!("{}{}  {}{mark}", columns.over.cell(self.at), cells.collect::<String>(), self.model_name())
    }
}

/// The end of a line with warnings about the fields `warned`.
pub(super) fn mark(warned: &[String]) -> String {
    if warned.is_empty() { String::new() } else { format!("  ! {}", warned.join(", ")) }
}

/// The headings of a file.
pub(super) fn csv_header(columns: Columns) -> String {
    let empty = Row {
        at: 0.0,
        surfaces: 0,
        model: SolverModel::Resolved,
        values: [None; QUANTITIES.len()],
        friction_parts: [0.0; 2],
        formula: None,
        warned: Vec::new(),
    };
    let names = empty.cells(columns).into_iter().map(|(name, _)| name);
    names.chain(["warnings".to_owned(), "model".to_owned()]).collect::<Vec<_>>().join(",")
}

/// The headings of the table on the terminal.
pub(super) fn table_header(columns: Columns) -> String {
    let cells = QUANTITIES.iter().map(|quantity| cell(columns, quantity.label));
    format!("{:>11}{}  model", columns.over.heading(columns.line), cells.collect::<String>())
}

/// A cell of the table, wide enough for a number with its band where there are bands.
fn cell(columns: Columns, text: &str) -> String {
    let width = if columns.errors || columns.spread { 20 } else { 15 };
    format!("{text:>width$}")
}
