//! Laws of the surfaces: pressure limits and motion of the roughness.

use pyo3::prelude::*;
use stribeck::plastic::PlasticityModel;
use stribeck::surface::{Offset, PointRevisit, RoughnessMotion};
use stribeck::{Grid, InputError};

use super::{Failure, Function};
use crate::convert::shown;
use crate::error::raise;
use crate::scene::Cells;

/// A plasticity model: `pressure_limit(film_thickness, plastic_depth)`.
#[derive(Debug)]
pub(crate) struct Plasticity {
    pub(crate) function: Function,
    /// Whether the limit depends on the depth.
    pub(crate) hardens: bool,
}

impl PlasticityModel for Plasticity {
    fn pressure_limit(&self, film_thickness: f64, plastic_depth: f64) -> f64 {
        let mut limit = [f64::NAN];
        self.pressure_limits(&[film_thickness], &[plastic_depth], &mut limit);
        limit[0]
    }

    fn pressure_limits(&self, film_thickness: &[f64], plastic_depth: &[f64], out: &mut [f64]) {
        Python::attach(|py| {
            let arguments = || {
                Ok(vec![self.function.array(py, film_thickness)?, self.function.array(py, plastic_depth)?])
            };
            self.function.fill_by(py, arguments, out);
        });
    }

    fn hardens(&self) -> bool {
        self.hardens
    }

    fn contact_limit_into(
        &self,
        films: [&[f64]; 2],
        depths: [&[f64]; 2],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        let expected = out.len();
        if let Some(found) = films.iter().chain(&depths).map(|field| field.len()).find(|n| *n != expected) {
            return Err(InputError::Shape { field: self.function.name.to_owned(), expected, found });
        }
        let mut other = vec![f64::NAN; expected];
        self.pressure_limits(films[0], depths[0], out);
        self.pressure_limits(films[1], depths[1], &mut other);
        out.iter_mut().zip(other).for_each(|(limit, other)| *limit = limit.min(other));
        Ok(())
    }
}

/// The places of that name.
fn visits_of(py: Python<'_>, name: &str) -> PyResult<PointRevisit> {
    match name {
        "stays" => Ok(PointRevisit::Permanent),
        "passing" => Ok(PointRevisit::Passing),
        "track" => Ok(PointRevisit::Track),
        "patch" => Ok(PointRevisit::Patch),
        _ => {
            let message = format!("motion: visits = {name:?}: must be stays, passing, track or patch");
            let value = name.into_pyobject(py)?.into_any();
            Err(raise(py, "LawError", &message, Some("motion.visits"), Some(value)))
        }
    }
}

/// Refuses names of places that there are not.
#[pyfunction]
pub(crate) fn check_visits(py: Python<'_>, visits: &str) -> PyResult<()> {
    visits_of(py, visits).map(drop)
}

/// A motion of the roughness: `offset(body, draw, time, speed, grid)`.
#[derive(Debug)]
pub(crate) struct Motion {
    function: Function,
    visits: PointRevisit,
}

impl Motion {
    /// `visits` is `stays`, `passing`, `track` or `patch`.
    pub(crate) fn new(py: Python<'_>, function: Function, visits: &str) -> PyResult<Self> {
        Ok(Self { function, visits: visits_of(py, visits)? })
    }

    /// Columns, and rows and the fraction of a column where they are given too.
    fn called(
        &self,
        py: Python<'_>,
        arguments: (usize, u64, f64, f64),
        grid: &Grid,
    ) -> PyResult<(i64, i64, f64)> {
        let (body, draw, time, speed) = arguments;
        let cells = py.import("stribeck.scene")?.getattr("Grid")?.call_method1("_of", (Cells(*grid),))?;
        let arguments = vec![
            body.into_pyobject(py)?.into_any(),
            draw.into_pyobject(py)?.into_any(),
            time.into_pyobject(py)?.into_any(),
            speed.into_pyobject(py)?.into_any(),
            cells,
        ];
        let returned = self.function.call(py, arguments)?;
        if let Ok(columns) = returned.extract::<i64>() {
            return Ok((columns, 0, 0.0));
        }
        if let Ok((columns, rows)) = returned.extract::<(i64, i64)>() {
            return Ok((columns, rows, 0.0));
        }
        let offset = returned.extract::<(i64, i64, f64)>().ok();
        offset.filter(|(.., fraction)| (0.0..=1.0).contains(fraction)).ok_or_else(|| {
            let message =
                "must return whole columns, columns and rows, or both and a fraction of a column from 0 to 1";
            let found = shown(&returned);
            self.function.refused(py, &format!("{message}, not {found}"), returned)
        })
    }
}

impl RoughnessMotion for Motion {
    fn offset(&self, body: usize, draw: u64, time: f64, speed: f64, grid: &Grid) -> Offset {
        Python::attach(|py| match self.called(py, (body, draw, time, speed), grid) {
            Ok((columns, rows, fraction)) => {
                let within = |shift: i64, n: usize| (shift.rem_euclid(n as i64)) as usize;
                Offset { columns: within(columns, grid.nx()), rows: within(rows, grid.ny()), fraction }
            }
            Err(error) => {
                Failure.keep(error);
                Offset { columns: 0, rows: 0, fraction: f64::NAN }
            }
        })
    }

    fn visits(&self, _speed: f64) -> PointRevisit {
        self.visits
    }
}
