//! Elastic bodies of the crate, for deformation models that are built from them.

use std::sync::{Mutex, PoisonError};

use numpy::{PyArray2, PyReadonlyArray2};
use pyo3::prelude::*;
use stribeck::InputError;
use stribeck::elastic::{self, DeformationModel};

use crate::convert::{field, on_grid};
use crate::error::{ForPython, value};
use crate::scene::Cells;

/// Two half-spaces in contact.
#[pyclass(frozen, module = "stribeck._stribeck")]
pub(crate) struct HalfSpace(Mutex<elastic::HalfSpace>);

#[pymethods]
impl HalfSpace {
    #[new]
    fn new(py: Python<'_>, cells: &Cells, equivalent_modulus: f64) -> PyResult<Self> {
        value(py, elastic::HalfSpace::new(cells.0, equivalent_modulus)).map(|body| Self(Mutex::new(body)))
    }

    fn displacement<'py>(
        &self,
        py: Python<'py>,
        pressure: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let grid = self.look(|body| body.grid());
        let pressure = on_grid(py, "pressure", &pressure, &grid)?;
        if let Some(k) = pressure.iter().position(|value| !value.is_finite()) {
            let (field, index, value) = (format!("pressure[{}]", k / grid.nx()), k % grid.nx(), pressure[k]);
            return Err(InputError::NotFinite { field, index, value }.for_python(py));
        }
        let displacement = py.detach(|| {
            let mut out = vec![0.0; pressure.len()];
            self.look(|body| body.displacement(pressure, &mut out))?;
            Ok::<_, InputError>(out)
        });
        field(py, &grid, &value(py, displacement)?)
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.look(|body| body.influence(di, dj))
    }
}

impl HalfSpace {
    fn look<T>(&self, at: impl FnOnce(&mut elastic::HalfSpace) -> T) -> T {
        at(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}
