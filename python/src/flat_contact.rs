//! Dry contact of flat rough surfaces.

use std::path::PathBuf;

use numpy::PyArray2;
use pyo3::prelude::*;
use stribeck::sim::{SceneFile, SimError};

use crate::convert::{field, list, named};
use crate::error::value;
use crate::interrupt::on_signal;
use crate::laws::Failure;
use crate::run::RecordParts;

/// Numbers with `status` and warnings, pressure and gap of the deformed surfaces.
type Parts<'py> = (RecordParts<'py>, [Bound<'py, PyArray2<f64>>; 2]);

/// Solves the flat contact of a scene file.
#[pyfunction]
pub(crate) fn solve_flat(py: Python<'_>, path: PathBuf) -> PyResult<Parts<'_>> {
    let SceneFile::Flat(contact) = value(py, SceneFile::load(&path))? else {
        let reason = "form.kind is not \"flat\"; stribeck.solve takes other contacts";
        let error = SimError::Scene { reason: format!("{}: {reason}", path.display()) };
        return value(py, Err(error));
    };
    let solved = py.detach(|| contact.solve(on_signal()));
    if let Some(error) = Failure.take() {
        return Err(error);
    }
    let solution = value(py, solved)?;
    let numbers = named(py, &solution.numbers)?;
    numbers.set_item("status", solution.status.to_string())?;
    let fields = [field(py, &solution.grid, &solution.pressure)?, field(py, &solution.grid, &solution.film)?];
    Ok(((numbers, list(py, &solution.warnings)?), fields))
}
