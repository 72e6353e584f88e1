//! Bodies with a past.

use std::path::PathBuf;

use numpy::{PyArray1, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::sim;

use crate::convert::{dictionary, field, on_grid};
use crate::error::value;
use crate::scene::Scene;

/// Fields by name and states of a body.
type Fields<'py> = (Bound<'py, PyDict>, Option<Bound<'py, PyArray1<f64>>>);

#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct BodyStart(pub(crate) sim::BodyStart);

#[pymethods]
impl BodyStart {
    #[new]
    #[pyo3(signature = (scene, heights, wear=None, plastic_depth=None, tribofilm=None))]
    fn new(
        py: Python<'_>,
        scene: &Scene,
        heights: PyReadonlyArray2<'_, f64>,
        wear: Option<PyReadonlyArray2<'_, f64>>,
        plastic_depth: Option<PyReadonlyArray2<'_, f64>>,
        tribofilm: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Self> {
        let grid = value(py, scene.0.grid())?;
        let mut start = sim::BodyStart::new(grid, on_grid(py, "heights", &heights, &grid)?.to_vec());
        if let Some(wear) = wear {
            start = start.with_wear(on_grid(py, "wear", &wear, &grid)?.to_vec());
        }
        if let Some(depth) = plastic_depth {
            start = start.with_plastic_depth(on_grid(py, "plastic_depth", &depth, &grid)?.to_vec());
        }
        if let Some(film) = tribofilm {
            start = start.with_tribofilm(on_grid(py, "tribofilm", &film, &grid)?.to_vec());
        }
        Ok(Self(start))
    }

    /// Fields by name and the states of the growth law, which [`from_fields`](Self::from_fields) takes.
    fn fields<'py>(&self, py: Python<'py>) -> PyResult<Fields<'py>> {
        let grid = self.0.grid();
        let array = |values: &[f64]| field(py, &grid, values);
        let fields = dictionary!(py, {
            "heights": array(self.0.initial())?,
            "wear": array(self.0.wear())?,
            "plastic_depth": array(self.0.plastic_depth())?,
            "tribofilm": array(self.0.tribofilm())?,
        });
        let states = self.0.film_states().map(|states| PyArray1::from_slice(py, states));
        Ok((fields, states))
    }

    #[staticmethod]
    fn from_fields(
        py: Python<'_>,
        scene: &Scene,
        heights: PyReadonlyArray2<'_, f64>,
        wear: PyReadonlyArray2<'_, f64>,
        plastic_depth: PyReadonlyArray2<'_, f64>,
        tribofilm: PyReadonlyArray2<'_, f64>,
        states: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Self> {
        let grid = value(py, scene.0.grid())?;
        let start = sim::BodyStart::new(grid, on_grid(py, "heights", &heights, &grid)?.to_vec())
            .with_wear(on_grid(py, "wear", &wear, &grid)?.to_vec())
            .with_plastic_depth(on_grid(py, "plastic_depth", &plastic_depth, &grid)?.to_vec())
            .with_tribofilm(on_grid(py, "tribofilm", &tribofilm, &grid)?.to_vec());
        Ok(Self(match states {
            Some(states) => start.with_film_states(states.as_slice()?.to_vec()),
            None => start,
        }))
    }

    /// The body `name` (`ball` or `disc`) of the archive of a run on the grid of `scene`.
    #[staticmethod]
    fn read_npz(py: Python<'_>, scene: &Scene, path: PathBuf, name: &str) -> PyResult<Self> {
        let grid = value(py, scene.0.grid())?;
        value(py, sim::BodyStart::read_npz(path, name, grid)).map(Self)
    }
}
