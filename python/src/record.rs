//! Reports as dictionaries, and the columns of a history.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::SolveReport;
use stribeck::sim::StepRecord;

use crate::convert::named;

/// Names of the columns of a history and their units.
#[pyfunction]
pub(crate) fn columns() -> Vec<(&'static str, &'static str)> {
    StepRecord::columns().collect()
}

/// A report without the strategy and the history of its residuals.
pub(crate) fn report_dict<'py>(py: Python<'py>, report: &SolveReport) -> PyResult<Bound<'py, PyDict>> {
    named(py, report)
}
