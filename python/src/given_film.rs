//! Rigid surfaces with a film that is given.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::Grid;
use stribeck::lubricant::{Barus, DowsonHigginson, Incompressible, Lubricant};
use stribeck::reynolds::{FilmThickness, GivenFilm, GivenFilmSolution, SideEdges};
use stribeck::sim::{SceneFile, SimError, Warning, given_film_warnings};

use crate::convert::{dictionary, field, list, named, on_grid};
use crate::error::value;
use crate::interrupt::on_signal;
use crate::laws::{Failure, raised};
use crate::run::RecordParts;
use crate::scene::Cells;

/// Films at the nodes, or a function of a place.
#[derive(FromPyObject)]
pub(crate) enum Film<'py> {
    Nodes(PyReadonlyArray2<'py, f64>),
    Function(Bound<'py, PyAny>),
}

impl Film<'_> {
    fn thickness(&self, py: Python<'_>, grid: Grid) -> PyResult<FilmThickness> {
        let film = match self {
            Self::Nodes(film) => FilmThickness::from_nodes(grid, on_grid(py, "film", film, &grid)?),
            Self::Function(function) => FilmThickness::from_function(grid, |x, y| {
                let film = function.call1((x, y)).and_then(|film| film.extract());
                film.unwrap_or_else(|error| {
                    Failure.keep(error);
                    f64::NAN
                })
            }),
        };
        match Failure.take() {
            Some(error) => Err(raised(py, "film", error)),
            None => value(py, film),
        }
    }
}

/// Pressures along a row, and the place of reformation.
type Row<'py> = (Bound<'py, PyArray2<f64>>, Option<f64>);

/// A solved film, of which places along a row can be asked, its thickness at the nodes and its warnings.
#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct SolvedFilm(GivenFilmSolution, Vec<f64>, Vec<Warning>);

#[pymethods]
impl SolvedFilm {
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = named(py, &self.0.report)?;
        numbers.set_item("load", self.0.load)?;
        let [lower, upper] = self.0.friction;
        numbers.set_item("force", dictionary!(py, { "lower": lower, "upper": upper }))?;
        numbers.set_item("flow", named(py, &self.0.flow)?)?;
        numbers.set_item("side_flow", self.0.side_flow)?;
        numbers.set_item("edge_flows", self.0.edge_flows.to_vec())?;
        numbers.set_item("cavitated_shear", self.0.cavitated_shear)?;
        numbers.set_item("power_loss", self.0.power_loss)?;
        Ok(numbers)
    }

    fn film<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        field(py, &self.0.grid(), &self.1)
    }

    fn pressure<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        field(py, &self.0.grid(), &self.0.pressure)
    }

    fn theta<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        field(py, &self.0.grid(), &self.0.theta)
    }

    fn warnings<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        self.2.iter().map(|warning| named(py, warning)).collect()
    }

    /// Positions and pressures along each row from edge to edge, and where the film first reforms in it.
    fn rows<'py>(&self, py: Python<'py>) -> PyResult<Vec<Row<'py>>> {
        let row = |row: usize| -> PyResult<Row<'py>> {
            let profile: Vec<f64> = self.0.profile(row).unwrap_or_default().concat();
            let points = profile.len() / 2;
            Ok((PyArray1::from_vec(py, profile).reshape([points, 2])?, self.0.reformation(row)))
        };
        (0..self.0.grid().ny()).map(row).collect()
    }
}

/// Solves the rigid bearing of a scene file; its numbers with `status`, and its warnings.
#[pyfunction]
pub(crate) fn solve_bearing(py: Python<'_>, path: PathBuf) -> PyResult<RecordParts<'_>> {
    let SceneFile::Bearing(bearing) = value(py, SceneFile::load(&path))? else {
        let reason = "the scene has no table [given_film]; stribeck.solve takes contacts".to_owned();
        let error = SimError::Scene { reason: format!("{}: {reason}", path.display()) };
        return value(py, Err(error));
    };
    let solved = py.detach(|| bearing.solve(on_signal()));
    if let Some(error) = Failure.take() {
        return Err(error);
    }
    let solution = value(py, solved)?;
    let numbers = named(py, &solution.numbers)?;
    numbers.set_item("status", solution.film.report.status.to_string())?;
    Ok((numbers, list(py, &solution.warnings)?))
}

/// Solves for pressure and content in `film` on the cells `on`, of an oil of `(eta0, alpha, [density_a, density_b])` between edges of
/// `(edge_pressures, cavitation_pressure, [closed_sides, periodic])`.
#[pyfunction]
pub(crate) fn solve_film(
    py: Python<'_>,
    on: &Cells,
    film: Film<'_>,
    speeds: [f64; 2],
    oil: (f64, f64, [f64; 2]),
    edges: ([f64; 4], f64, [bool; 2]),
) -> PyResult<SolvedFilm> {
    let ((eta0, alpha, [a, b]), (pressures, cavitation, [closed_sides, is_periodic])) = (oil, edges);
    let film = film.thickness(py, on.0)?;
    let viscosity = value(py, Barus::new(eta0, alpha))?;
    let oil = if a == 0.0 && b == 0.0 {
        Lubricant::new(viscosity, Incompressible)
    } else {
        Lubricant::new(viscosity, value(py, DowsonHigginson::new(a, b))?)
    };
    let sides = if closed_sides { SideEdges::Closed } else { SideEdges::Ambient };
    let solved = py.detach(|| {
        let problem = GivenFilm::new(&film, &oil, speeds)
            .with_edge_pressures(pressures)
            .with_cavitation_pressure(cavitation)
            .with_sides(sides)
            .with_periodic(is_periodic);
        let solution = problem.solve_unless(on_signal())?;
        let warnings = given_film_warnings(&problem, &solution);
        Ok::<_, SimError>((solution, warnings))
    });
    match Failure.take() {
        Some(error) => Err(error),
        None => {
            let (solved, warnings) = value(py, solved)?;
            Ok(SolvedFilm(solved, film.nodes().to_vec(), warnings))
        }
    }
}
