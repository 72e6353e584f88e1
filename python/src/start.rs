//! Bodies with a past.

use std::path::PathBuf;

use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use stribeck::sim;

use crate::convert::on_grid;
use crate::error::value;
use crate::scene::Scene;

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

    /// It never changes.
    fn __copy__(this: Py<Self>) -> Py<Self> {
        this
    }

    fn __deepcopy__(this: Py<Self>, _memo: &Bound<'_, PyAny>) -> Py<Self> {
        this
    }

    fn __reduce__(&self) -> PyResult<()> {
        Err(PyTypeError::new_err(
            "a BodyStart is not pickled; the fields.npz of a run holds both bodies, see BodyStart.read_npz",
        ))
    }

    /// The body `name` (`ball` or `disc`) of the archive of a run on the grid of `scene`.
    #[staticmethod]
    fn read_npz(py: Python<'_>, scene: &Scene, path: PathBuf, name: &str) -> PyResult<Self> {
        let grid = value(py, scene.0.grid())?;
        value(py, sim::BodyStart::read_npz(path, name, grid)).map(Self)
    }
}
