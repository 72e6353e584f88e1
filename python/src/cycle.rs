//! Contacts over a cycle of load, speeds and radius.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::sim::MixedLubricationSim;

use crate::convert::list;
use crate::error::value;
use crate::interrupt::on_signal;
use crate::laws::Failure;
use crate::run::RecordParts;
use crate::scene::Scene;

/// Solves the cycle of a scene: its contacts, and the numbers of the whole with their warnings.
#[pyfunction]
pub(crate) fn solve_cycle<'py>(
    py: Python<'py>,
    scene: &Scene,
) -> PyResult<(Bound<'py, PyAny>, RecordParts<'py>)> {
    let builder = MixedLubricationSim::builder(scene.0.clone()).interrupt(on_signal());
    let solved = py.detach(|| builder.solve_cycle(&mut |_| true));
    if let Some(error) = Failure.take() {
        return Err(error);
    }
    let solution = value(py, solved)?;
    let of_all = PyDict::new(py);
    of_all.set_item("quasi_static", solution.quasi_static)?;
    of_all.set_item("largest_step", solution.largest_step)?;
    of_all.set_item("closure", solution.closure)?;
    of_all.set_item("ended_early", solution.ended_early.as_ref().map(ToString::to_string))?;
    of_all.set_item("cycles", list(py, &solution.cycles)?)?;
    Ok((list(py, &solution.points)?, (of_all, list(py, &solution.warnings)?)))
}
