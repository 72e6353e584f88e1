//! Measured and generated surfaces.

use std::path::PathBuf;

use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::surface::{
    self, Autocorrelation, DimpleLayout, GrooveDirection, HeightDistribution, HeightScale, Heights,
    RandomShape, RandomSurface, SelfAffine, SurfaceError, Synthesis, Texture,
};
use stribeck::{Boundary, Grid};

use crate::convert::{contiguous, field};
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
    #[new]
    #[pyo3(signature = (heights, dx=None, dy=None, defined=None))]
    fn new(
        py: Python<'_>,
        heights: PyReadonlyArray2<'_, f64>,
        dx: Option<f64>,
        dy: Option<f64>,
        defined: Option<PyReadonlyArray2<'_, bool>>,
    ) -> PyResult<Self> {
        let [ny, nx] = numpy::PyUntypedArrayMethods::shape(&*heights) else {
            return Err(raise(py, "ShapeError", "heights: it must have two axes", Some("heights"), None));
        };
        let spacing = match (dx, dy) {
            (Some(dx), dy) => Some([dx, dy.unwrap_or(dx)]),
            _ => None,
        };
        let defined = match &defined {
            Some(defined) => Some(contiguous(py, "defined", defined)?.to_vec()),
            None => None,
        };
        let values = contiguous(py, "heights", &heights)?.to_vec();
        value(py, Heights::new(*nx, *ny, spacing, values, defined)).map(Self)
    }

    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        value(py, py.detach(|| surface::read(&path))).map(Self)
    }

    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let surface = &self.0;
        let name = path.extension().and_then(|end| end.to_str()).unwrap_or_default().to_lowercase();
        match name.as_str() {
            "x3p" => value(py, surface::write_x3p(path, surface)),
            "npy" if surface.undefined() > 0 => {
                let message = format!(
                    "path = {}: an npy file cannot tell the {} undefined points; call fill_undefined first or \
                     write x3p",
                    path.display(),
                    surface.undefined()
                );
                Err(raise(py, "InputError", &message, Some("path"), path.into_bound_py_any(py).ok()))
            }
            "npy" => value(py, surface::write_npy(path, surface.nx(), surface.ny(), surface.heights())),
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
        field(py, &unit, self.0.heights())
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

fn number(options: &Bound<'_, PyDict>, key: &str) -> PyResult<Option<f64>> {
    match options.get_item(key)? {
        Some(given) if !given.is_none() => Ok(Some(given.extract()?)),
        _ => Ok(None),
    }
}

/// A random surface on a grid, by the options of `stribeck.surface.generate`.
#[pyfunction]
pub(crate) fn generate<'py>(
    py: Python<'py>,
    on: &Cells,
    kind: &str,
    rq: f64,
    seed: u64,
    options: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let grid = on.0;
    let needed = |key: &str| -> PyResult<f64> {
        number(options, key)?
            .ok_or_else(|| raise(py, "InputError", &format!("{key} is missing"), Some(key), None))
    };
    let correlated = |autocorrelation| -> PyResult<RandomShape> {
        Ok(RandomShape::Correlated {
            autocorrelation,
            length_x: needed("length_x")?,
            length_y: needed("length_y")?,
        })
    };
    let shape = match kind {
        "gaussian" => correlated(Autocorrelation::Gaussian)?,
        "exponential" => correlated(Autocorrelation::Exponential)?,
        "self_affine" => RandomShape::SelfAffine(SelfAffine {
            hurst: needed("hurst")?,
            longest: number(options, "longest")?.unwrap_or(f64::INFINITY),
            roll_off: needed("roll_off")?,
            shortest: needed("shortest")?,
            synthesis: Synthesis::RandomPhase,
        }),
        _ => return Err(unknown(py, "kind", kind, "gaussian, exponential or self_affine")),
    };
    let mut surface = RandomSurface::new(shape, rq, seed);
    if let (Some(skewness), kurtosis) = (number(options, "skewness")?, number(options, "kurtosis")?) {
        surface.distribution = HeightDistribution::Johnson { skewness, kurtosis: kurtosis.unwrap_or(3.0) };
    }
    if let Some(exact) = options.get_item("exact_rq")? {
        surface.height = if exact.extract()? { HeightScale::Exact } else { HeightScale::Ensemble };
    }
    if let Some(name) = options.get_item("boundary")? {
        surface.boundary = boundary(py, name.extract()?)?;
    }
    field(py, &grid, &value(py, py.detach(|| surface.generate(&grid)))?)
}

/// Dimples or grooves on a grid, by their radius or width, depth and pitch \[m\].
#[pyfunction]
pub(crate) fn texture<'py>(
    py: Python<'py>,
    on: &Cells,
    kind: &str,
    sizes: [f64; 3],
    layout: &str,
    seed: u64,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (grid, [size, depth, pitch]) = (on.0, sizes);
    let texture = match (kind, layout) {
        ("dimples", "square") => {
            Texture::Dimples { radius: size, depth, pitch, layout: DimpleLayout::Square }
        }
        ("dimples", "random") => {
            Texture::Dimples { radius: size, depth, pitch, layout: DimpleLayout::Random { seed } }
        }
        ("grooves", "x") => {
            Texture::Grooves { width: size, depth, pitch, direction: GrooveDirection::AlongX }
        }
        ("grooves", "y") => {
            Texture::Grooves { width: size, depth, pitch, direction: GrooveDirection::AlongY }
        }
        ("grooves", "crossed") => {
            Texture::Grooves { width: size, depth, pitch, direction: GrooveDirection::Crossed }
        }
        ("dimples", _) => return Err(unknown(py, "layout", layout, "square or random")),
        ("grooves", _) => return Err(unknown(py, "direction", layout, "x, y or crossed")),
        _ => return Err(unknown(py, "kind", kind, "dimples or grooves")),
    };
    field(py, &grid, &value(py, texture.generate(&grid))?)
}
