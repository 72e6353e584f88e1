//! The columns of a history.

use pyo3::prelude::*;
use stribeck::sim::StepRecord;

/// Names of the columns of a history and their units.
#[pyfunction]
pub(crate) fn columns() -> Vec<(&'static str, &'static str)> {
    StepRecord::columns().collect()
}
