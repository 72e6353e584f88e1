//! Scenes.

use std::path::PathBuf;

use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::sim;

use crate::convert::{dict, dictionary, list, named, table};
use crate::error::{raise, value};
use crate::run::RecordParts;

/// Positions of columns and rows.
pub(crate) type Nodes<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// The cells of a contact.
#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct Cells(pub(crate) stribeck::Grid);

#[pymethods]
impl Cells {
    /// `shape` is `(ny, nx)`, `x` and `y` are the outer edges \[m\].
    #[new]
    fn new(py: Python<'_>, shape: (usize, usize), x: [f64; 2], y: [f64; 2]) -> PyResult<Self> {
        value(py, stribeck::Grid::from_edges(shape.1, shape.0, x, y)).map(Self)
    }

    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        grid_dict(py, &self.0)
    }

    fn nodes<'py>(&self, py: Python<'py>) -> Nodes<'py> {
        nodes(py, &self.0)
    }
}

#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct Scene(pub(crate) sim::Scene);

#[pymethods]
impl Scene {
    /// A scene from a dictionary with the tables and keys of a scene file.
    #[staticmethod]
    fn from_dict(py: Python<'_>, tables: &Bound<'_, PyDict>) -> PyResult<Self> {
        let text = toml::to_string(&table(tables, "")?);
        let text = text.map_err(|error| raise(py, "SceneError", &error.to_string(), None, None))?;
        value(py, sim::Scene::from_toml(&text).map_err(without_line)).map(Self)
    }

    /// A scene from the text of a scene file.
    #[staticmethod]
    fn from_toml(py: Python<'_>, text: &str) -> PyResult<Self> {
        value(py, sim::Scene::from_toml(text)).map(Self)
    }

    /// A scene from its file; paths in it are relative to its folder.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        value(py, sim::Scene::load(path)).map(Self)
    }

    /// The scene of Azam et al. (2019) on `n` x `n` cells.
    #[staticmethod]
    fn azam_2019(n: usize, tribofilm: bool) -> Self {
        let scene = sim::Scene::azam_2019(n);
        Self(if tribofilm { scene.with_tribofilm() } else { scene })
    }

    fn to_toml(&self, py: Python<'_>) -> PyResult<String> {
        value(py, self.0.to_toml())
    }

    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let table = self.to_toml(py)?.parse::<toml::Table>();
        dict(py, &table.map_err(|error| raise(py, "SceneError", &error.to_string(), None, None))?)
    }

    fn hertz<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        named(py, &value(py, self.0.hertz())?)
    }

    /// The expectation by formula and its warnings.
    fn expectation<'py>(&self, py: Python<'py>) -> PyResult<RecordParts<'py>> {
        let sim = value(py, sim::MixedLubricationSim::builder(self.0.clone()).build())?;
        let warnings = [sim.warnings(), &value(py, sim.expected_warnings())?].concat();
        Ok((named(py, &value(py, sim.expectation())?)?, list(py, &warnings)?))
    }

    /// The oil at the bulk temperature; `None` for a dry contact.
    fn oil<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        value(py, self.0.oil_numbers())?.map(|oil| named(py, &oil)).transpose()
    }

    fn grid(&self, py: Python<'_>) -> PyResult<Cells> {
        value(py, self.0.grid()).map(Cells)
    }

    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        list(py, &self.0.warnings())
    }

    fn conditions<'py>(&self, py: Python<'py>, time: f64) -> PyResult<Bound<'py, PyDict>> {
        named(py, &value(py, self.0.conditions(time))?)
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}

/// The error without the number of a line, of a text that the crate has written.
fn without_line(error: sim::SimError) -> sim::SimError {
    match error {
        sim::SimError::Scene { reason } => {
            let rest = reason.strip_prefix("line ").and_then(|rest| rest.split_once(": "));
            let reason = rest.map_or(reason.as_str(), |(_, rest)| rest).to_owned();
            sim::SimError::Scene { reason }
        }
        other => other,
    }
}

/// Positions of the columns and of the rows of a grid \[m\].
pub(crate) fn nodes<'py>(py: Python<'py>, grid: &stribeck::Grid) -> Nodes<'py> {
    let x = (0..grid.nx()).map(|i| grid.x(i));
    let y = (0..grid.ny()).map(|j| grid.y(j));
    (PyArray1::from_iter(py, x), PyArray1::from_iter(py, y))
}

/// Counts, cell sizes and edges of a grid.
pub(crate) fn grid_dict<'py>(py: Python<'py>, grid: &stribeck::Grid) -> PyResult<Bound<'py, PyDict>> {
    let edges = |first: f64, cell: f64, size: f64| (first - 0.5 * cell, first - 0.5 * cell + size);
    Ok(dictionary!(py, {
        "nx": grid.nx(),
        "ny": grid.ny(),
        "dx": grid.dx(),
        "dy": grid.dy(),
        "edges_x": edges(grid.x(0), grid.dx(), grid.size_x()),
        "edges_y": edges(grid.y(0), grid.dy(), grid.size_y()),
    }))
}
