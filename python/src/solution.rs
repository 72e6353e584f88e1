//! Single contacts.

use std::time::{Duration, Instant};

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::reynolds::ContactState;
use stribeck::sim::{ContactSolution, MixedLubricationSim, SimBuilder};

use crate::convert::{field, named, on_grid};
use crate::error::value;
use crate::interrupt::{on_signal, on_signal_or_at};
use crate::laws::{Failure, PyLaws};
use crate::scene::{Nodes, Scene, grid_dict, nodes};
use crate::start::BodyStart;

type Array<'py> = PyReadonlyArray2<'py, f64>;

/// Components that replace parts of a scene.
#[derive(FromPyObject)]
pub(crate) struct Parts<'py> {
    #[pyo3(item)]
    ball_heights: Option<Array<'py>>,
    #[pyo3(item)]
    disc_heights: Option<Array<'py>>,
    #[pyo3(item)]
    ball_start: Option<Py<BodyStart>>,
    #[pyo3(item)]
    disc_start: Option<Py<BodyStart>>,
    #[pyo3(item)]
    laws: PyLaws,
}

impl Parts<'_> {
    /// A builder with these parts.
    pub(crate) fn builder(self, py: Python<'_>, scene: &Scene) -> PyResult<SimBuilder> {
        let mut builder = MixedLubricationSim::builder(scene.0.clone());
        if self.ball_heights.is_some() || self.disc_heights.is_some() {
            let grid = value(py, scene.0.grid())?;
            if let Some(heights) = &self.ball_heights {
                builder = builder.ball_heights(on_grid(py, "ball_heights", heights, &grid)?.to_vec());
            }
            if let Some(heights) = &self.disc_heights {
                builder = builder.disc_heights(on_grid(py, "disc_heights", heights, &grid)?.to_vec());
            }
        }
        if self.laws.any() {
            let grid = value(py, scene.0.grid())?;
            let temperature = scene.0.thermal.bulk_temperature;
            builder = self.laws.put_into(py, builder, &grid, temperature)?;
        }
        if let Some(start) = self.ball_start {
            builder = builder.ball_start(start.get().0.clone());
        }
        if let Some(start) = self.disc_start {
            builder = builder.disc_start(start.get().0.clone());
        }
        Ok(builder.interrupt(on_signal()))
    }
}

/// The fields and the approach of an earlier solution.
#[derive(FromPyObject)]
pub(crate) struct Start<'py> {
    #[pyo3(item)]
    pressure: Array<'py>,
    #[pyo3(item)]
    fluid_pressure: Array<'py>,
    #[pyo3(item)]
    film: Array<'py>,
    #[pyo3(item)]
    theta: Array<'py>,
    #[pyo3(item)]
    plastic_depth: Array<'py>,
    #[pyo3(item)]
    in_contact: PyReadonlyArray2<'py, bool>,
    #[pyo3(item)]
    approach: f64,
}

impl Start<'_> {
    /// The state; its mass belongs to a squeeze, which a single contact has not.
    pub(crate) fn state(&self, py: Python<'_>, scene: &Scene) -> PyResult<ContactState> {
        let grid = value(py, scene.0.grid())?;
        let part =
            |name: &str, array| -> PyResult<Vec<f64>> { Ok(on_grid(py, name, array, &grid)?.to_vec()) };
        let mut state = ContactState::new(&grid);
        state.pressure = part("start pressure", &self.pressure)?;
        state.fluid_pressure = part("start fluid_pressure", &self.fluid_pressure)?;
        state.film = part("start film", &self.film)?;
        state.theta = part("start theta", &self.theta)?;
        state.plastic_depth = part("start plastic_depth", &self.plastic_depth)?;
        state.in_contact = on_grid(py, "start in_contact", &self.in_contact, &grid)?.to_vec();
        state.approach = self.approach;
        Ok(state)
    }
}

/// Numbers, fields and nodes of a solution.
pub(crate) type Solved<'py> = (Bound<'py, PyDict>, Bound<'py, PyDict>, Nodes<'py>);

/// Solves the single contact of `scene`, in at most `budget` seconds.
#[pyfunction]
#[pyo3(signature = (scene, parts, start=None, budget=None))]
pub(crate) fn solve<'py>(
    py: Python<'py>,
    scene: &Scene,
    parts: Parts<'py>,
    start: Option<Start<'py>>,
    budget: Option<f64>,
) -> PyResult<Solved<'py>> {
    let began = Instant::now();
    let mut builder = parts.builder(py, scene)?;
    let budget = budget.map(Duration::try_from_secs_f64).and_then(Result::ok);
    if let Some(deadline) = budget.and_then(|budget| began.checked_add(budget)) {
        builder = builder.interrupt(on_signal_or_at(deadline));
    }
    if let Some(start) = start {
        builder = builder.contact_start(start.state(py, scene)?);
    }
    let solved = py.detach(|| builder.solve());
    let seconds = began.elapsed().as_secs_f64();
    if let Some(error) = Failure.take() {
        return Err(error);
    }
    let solved = parts_of(py, &value(py, solved)?)?;
    solved.0.set_item("seconds", seconds)?;
    Ok(solved)
}

/// A solution in Python.
pub(crate) fn parts_of<'py>(py: Python<'py>, solution: &ContactSolution) -> PyResult<Solved<'py>> {
    let fields = PyDict::new(py);
    for (name, values) in solution.fields() {
        fields.set_item(name, field(py, &solution.grid, values)?)?;
    }
    fields.set_item("in_contact", field(py, &solution.grid, &solution.state.in_contact)?)?;
    Ok((numbers(py, solution)?, fields, nodes(py, &solution.grid)))
}

/// The numbers under the names of the command's JSON, with the edges of the grid; values that are not finite are None.
fn numbers<'py>(py: Python<'py>, solution: &ContactSolution) -> PyResult<Bound<'py, PyDict>> {
    let numbers = named(py, solution)?;
    numbers.set_item("grid", grid_dict(py, &solution.grid)?)?;
    Ok(numbers)
}
