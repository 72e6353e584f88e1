//! Measured and generated surfaces.

use std::path::PathBuf;

use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::sim::scene::Roughness;
use stribeck::surface::{self, Heights, LengthUnit, ReadOptions, SurfaceError};
use stribeck::{Boundary, Grid, InputError};

use crate::convert::{contiguous, field, table};
use crate::error::{raise, value};
use crate::scene::Cells;

/// A measured surface; every method gives a new one.
#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct Surface(Heights);

pub(crate) fn boundary(py: Python<'_>, name: &str) -> PyResult<Boundary> {
    match name {
        "periodic" => Ok(Boundary::Periodic),
        "open" => Ok(Boundary::Open),
        _ => Err(unknown(py, "boundary", name, "periodic or open")),
    }
}

fn unknown(py: Python<'_>, field: &str, name: &str, known: &str) -> PyErr {
    let message = format!("{field} = {name:?}: must be {known}");
    raise(py, "InputError", &message, Some(field), name.into_bound_py_any(py).ok())
}

impl Surface {
    fn changed(
        &self,
        py: Python<'_>,
        change: impl FnOnce(&mut Heights) -> Result<(), SurfaceError> + Send,
    ) -> PyResult<Self> {
        let mut heights = self.0.clone();
        value(py, py.detach(|| change(&mut heights)))?;
        Ok(Self(heights))
    }
}

#[pymethods]
impl Surface {
    /// Heights that are not finite are undefined; `unit` and `warnings` are those of the file.
    #[new]
    #[pyo3(signature = (heights, dx=None, dy=None, defined=None, unit=None, warnings=None))]
    fn new(
        py: Python<'_>,
        heights: PyReadonlyArray2<'_, f64>,
        dx: Option<f64>,
        dy: Option<f64>,
        defined: Option<PyReadonlyArray2<'_, bool>>,
        unit: Option<&str>,
        warnings: Option<Vec<String>>,
    ) -> PyResult<Self> {
        let [ny, nx] = numpy::PyUntypedArrayMethods::shape(&*heights) else {
            return Err(raise(py, "ShapeError", "heights: it must have two axes", Some("heights"), None));
        };
        let spacing = match (dx, dy) {
            (Some(dx), dy) => Some([dx, dy.unwrap_or(dx)]),
            _ => None,
        };
        let values = contiguous(py, "heights", &heights)?.to_vec();
        let mut known: Vec<bool> = values.iter().map(|height| height.is_finite()).collect();
        if let Some(defined) = &defined {
            let given = contiguous(py, "defined", defined)?;
            value(py, same_length(given.len(), known.len()))?;
            known.iter_mut().zip(given).for_each(|(known, given)| *known &= given);
        }
        let made = value(py, Heights::new(*nx, *ny, spacing, values, Some(known)))?;
        let made = made.with_warnings(warnings.unwrap_or_default());
        Ok(Self(match unit.and_then(LengthUnit::parse) {
            Some(unit) => made.with_unit(unit),
            None => made,
        }))
    }

    /// Reads a file; `channel` counts from 1, `unit` is that of lengths without one.
    #[staticmethod]
    #[pyo3(signature = (path, channel=None, unit=None))]
    fn read(py: Python<'_>, path: PathBuf, channel: Option<usize>, unit: Option<&str>) -> PyResult<Self> {
        let mut options = ReadOptions::new();
        options.channel = channel;
        if let Some(name) = unit {
            let found = LengthUnit::parse(name);
            options.unit =
                Some(found.ok_or_else(|| unknown(py, "unit", name, "a unit of length, such as um"))?);
        }
        value(py, py.detach(|| surface::read_with(&path, &options))).map(Self)
    }

    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let surface = &self.0;
        let name = path.extension().and_then(|end| end.to_str()).unwrap_or_default().to_lowercase();
        match name.as_str() {
            "x3p" => value(py, surface::write_x3p(path, surface)),
            "npy" => {
                value(py, surface::write_npy(path, surface.nx(), surface.ny(), &surface.heights_or_nan()))
            }
            "txt" | "csv" => value(py, surface::write_text(path, surface)),
            _ => Err(unknown(
                py,
                "path",
                &path.display().to_string(),
                "a name that ends in .x3p, .npy, .txt or .csv",
            )),
        }
    }

    #[getter]
    fn heights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let unit = value(py, Grid::centred(self.0.nx(), self.0.ny(), 1.0, 1.0))?;
        field(py, &unit, &self.0.heights_or_nan())
    }

    /// Unit of the heights in the file.
    #[getter]
    fn unit(&self) -> Option<String> {
        self.0.unit().map(|unit| unit.to_string())
    }

    /// Doubts of the reader of the file.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.0.warnings().to_vec()
    }

    #[getter]
    fn defined<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<bool>>>> {
        let unit = value(py, Grid::centred(self.0.nx(), self.0.ny(), 1.0, 1.0))?;
        self.0.defined().map(|mask| field(py, &unit, mask)).transpose()
    }

    #[getter]
    fn nx(&self) -> usize {
        self.0.nx()
    }

    #[getter]
    fn ny(&self) -> usize {
        self.0.ny()
    }

    #[getter]
    fn dx(&self) -> Option<f64> {
        self.0.dx()
    }

    #[getter]
    fn dy(&self) -> Option<f64> {
        self.0.dy()
    }

    #[getter]
    fn undefined(&self) -> usize {
        self.0.undefined()
    }

    fn with_spacing(&self, py: Python<'_>, dx: f64, dy: f64) -> PyResult<Self> {
        value(py, self.0.clone().with_spacing(dx, dy)).map(Self)
    }

    fn fill_undefined(&self, py: Python<'_>) -> PyResult<Self> {
        self.changed(py, Heights::fill_undefined)
    }

    fn remove_plane(&self, py: Python<'_>) -> PyResult<Self> {
        self.changed(py, Heights::remove_plane)
    }

    fn remove_polynomial(&self, py: Python<'_>, degree: usize) -> PyResult<Self> {
        self.changed(py, |heights| heights.remove_polynomial(degree))
    }

    fn remove_sphere(&self, py: Python<'_>) -> PyResult<(Self, f64)> {
        let mut radius = 0.0;
        let surface = self.changed(py, |heights| {
            radius = heights.remove_sphere()?;
            Ok(())
        })?;
        Ok((surface, radius))
    }

    fn remove_cylinder(&self, py: Python<'_>) -> PyResult<(Self, f64)> {
        let mut radius = 0.0;
        let surface = self.changed(py, |heights| {
            radius = heights.remove_cylinder()?;
            Ok(())
        })?;
        Ok((surface, radius))
    }

    fn s_filter(&self, py: Python<'_>, cutoff: f64, boundary_name: &str) -> PyResult<Self> {
        let boundary = boundary(py, boundary_name)?;
        self.changed(py, |heights| heights.s_filter(cutoff, boundary))
    }

    fn l_filter(&self, py: Python<'_>, cutoff: f64, boundary_name: &str) -> PyResult<Self> {
        let boundary = boundary(py, boundary_name)?;
        self.changed(py, |heights| heights.l_filter(cutoff, boundary))
    }

    fn set_rq(&self, py: Python<'_>, rq: f64) -> PyResult<Self> {
        self.changed(py, |heights| heights.set_rq(rq))
    }

    fn taper(&self, py: Python<'_>, width: f64) -> PyResult<Self> {
        self.changed(py, |heights| heights.taper(width))
    }

    fn crop(&self, py: Python<'_>, first: [usize; 2], nx: usize, ny: usize) -> PyResult<Self> {
        value(py, self.0.crop(first, nx, ny)).map(Self)
    }

    fn rotated_90(&self) -> Self {
        Self(self.0.rotated_90())
    }

    fn fit_to_grid<'py>(&self, py: Python<'py>, on: &Cells) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let grid = on.0;
        field(py, &grid, &value(py, py.detach(|| self.0.fit_to_grid(&grid)))?)
    }

    fn resample<'py>(&self, py: Python<'py>, on: &Cells) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let grid = on.0;
        field(py, &grid, &value(py, py.detach(|| self.0.resample(&grid)))?)
    }
}

/// Error unless the mask has as many values as the heights.
fn same_length(found: usize, expected: usize) -> Result<(), InputError> {
    if found == expected {
        return Ok(());
    }
    Err(InputError::Shape { field: "defined".to_owned(), expected, found })
}

/// The roughness of a table of a scene file on a grid.
#[pyfunction]
pub(crate) fn generate<'py>(
    py: Python<'py>,
    on: &Cells,
    keys: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let grid = on.0;
    let roughness: Result<Roughness, _> = table(keys, "")?.try_into();
    let roughness = roughness.map_err(|error| {
        let message = error.message().to_owned();
        // messages name keys in quotes
        let field = message.split(['`', '"']).nth(1).map(str::to_owned);
        raise(py, "InputError", &message, field.as_deref(), None)
    })?;
    field(py, &grid, &value(py, py.detach(|| roughness.heights(&grid)))?)
}
