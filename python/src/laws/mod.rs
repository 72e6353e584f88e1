//! Laws written in Python, called on whole fields.

mod deformation;
mod fluid;
mod given;
mod problem;
mod rubbing;
mod solver;
mod surface;

use std::cell::Cell;
use std::fmt;

use deformation::Deformation;
use fluid::{Density, Viscosity};
pub(crate) use given::PyLaws;
use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
pub(crate) use problem::Problem;
use pyo3::prelude::*;
use rubbing::{Friction, Growth, Wear};
use solver::Solver;
use stribeck::{Grid, InputError};
pub(crate) use surface::check_visits;
use surface::{Motion, Plasticity};

use crate::convert::field;
use crate::error::raise;

thread_local! {
    static RAISED: Cell<Option<PyErr>> = const { Cell::new(None) };
}

/// The first exception that a law or a signal has raised on this thread, which is the one that solves: clones
/// of a simulation share their laws and may step at the same time.
#[derive(Clone, Copy, Default)]
pub(crate) struct Failure;

impl Failure {
    pub(crate) fn keep(self, error: PyErr) {
        RAISED.set(Some(RAISED.take().unwrap_or(error)));
    }

    pub(crate) fn take(self) -> Option<PyErr> {
        RAISED.take()
    }

    pub(crate) fn is_set(self) -> bool {
        let error = RAISED.take();
        let is_set = error.is_some();
        RAISED.set(error);
        is_set
    }
}

/// A solver in Python for contacts on `grid`.
pub(crate) fn own_solver(law: PyLaw, grid: Grid) -> Box<dyn stribeck::reynolds::ContactSolver> {
    Box::new(Solver::new(Function::new("solver", law, grid), None))
}

/// A law in Python: its identity and its function.
type PyLaw = (String, Py<PyAny>);

/// A function of Python that gives a field.
struct Function {
    /// Its name in messages.
    name: &'static str,
    /// Its identity in checkpoints.
    identity: String,
    call: Py<PyAny>,
    grid: Grid,
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.identity)
    }
}

/// The error of the crate for an `error` raised by the function `name`.
pub(crate) fn raised(py: Python<'_>, name: &str, error: PyErr) -> PyErr {
    if !error.is_instance_of::<pyo3::exceptions::PyException>(py) {
        return error;
    }
    let law = raise(py, "LawError", &format!("the {name} raised {error}"), Some(name), None);
    law.set_cause(py, Some(error));
    law
}

impl Function {
    fn new(name: &'static str, (identity, call): PyLaw, grid: Grid) -> Self {
        Self { name, identity, call, grid }
    }

    /// Calls with the arguments that `arguments` makes and writes the result into `out`; NaN where that
    /// fails, with the exception kept.
    fn fill<'py>(&self, py: Python<'py>, arguments: Vec<Bound<'py, PyAny>>, out: &mut [f64]) {
        if let Err(error) = self.try_fill(py, arguments, out) {
            Failure.keep(error);
        }
        if Failure.is_set() {
            out.fill(f64::NAN);
        }
    }

    fn try_fill<'py>(
        &self,
        py: Python<'py>,
        arguments: Vec<Bound<'py, PyAny>>,
        out: &mut [f64],
    ) -> PyResult<()> {
        let returned = self.call(py, arguments)?;
        self.take(&returned, "returned", out)
    }

    /// The result of the function.
    fn call<'py>(&self, py: Python<'py>, arguments: Vec<Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyAny>> {
        let arguments = pyo3::types::PyTuple::new(py, arguments)?;
        self.call.bind(py).call1(arguments).map_err(|error| self.raised(py, error))
    }

    /// Writes a field of finite numbers, or one number for all, into `out`; `did` is the verb of messages about the function
    /// with it.
    fn take(&self, given: &Bound<'_, PyAny>, did: &str, out: &mut [f64]) -> PyResult<()> {
        let py = given.py();
        let numpy = py.import("numpy")?;
        let array = py.import("stribeck._arguments")?.call_method1("floats", (given,));
        let array = array.map_err(|_| {
            let kind = given.get_type().to_string();
            let message = format!("{did} a value of the type {kind}, expected numbers");
            self.refused(py, &message, given.clone())
        })?;
        let expected =
            if out.len() == self.grid.len() { vec![self.grid.ny(), self.grid.nx()] } else { vec![out.len()] };
        let array = array.cast_into::<PyArrayDyn<f64>>()?;
        if array.ndim() > 0 && array.shape() != expected {
            let shape = array.getattr("shape")?;
            let message = format!("{did} an array of the shape {shape}, expected {expected:?}");
            return Err(self.refused(py, &message, shape));
        }
        let array = numpy.call_method1("broadcast_to", (array, expected))?;
        let array = numpy.call_method1("ascontiguousarray", (array,))?.cast_into::<PyArrayDyn<f64>>()?;
        let values = array.readonly();
        let values = values.as_slice()?;
        if let Some(bad) = values.iter().find(|value| !value.is_finite()) {
            let value = bad.into_pyobject(py)?.into_any();
            return Err(self.refused(py, &format!("{did} {bad}, every value must be finite"), value));
        }
        out.copy_from_slice(values);
        Ok(())
    }

    /// The same for laws that cannot fail: NaN where it does, with the exception kept.
    fn fill_by<'py>(
        &self,
        py: Python<'py>,
        arguments: impl FnOnce() -> PyResult<Vec<Bound<'py, PyAny>>>,
        out: &mut [f64],
    ) {
        match arguments() {
            Ok(arguments) => self.fill(py, arguments, out),
            Err(error) => {
                Failure.keep(error);
                out.fill(f64::NAN);
            }
        }
    }

    fn refused(&self, py: Python<'_>, reason: &str, value: Bound<'_, PyAny>) -> PyErr {
        raise(py, "LawError", &format!("the {} {reason}", self.name), Some(self.name), Some(value))
    }

    /// The exception of the law as the cause of a typed error; exceptions that end a program pass unchanged.
    fn raised(&self, py: Python<'_>, error: PyErr) -> PyErr {
        raised(py, self.name, error)
    }

    /// A field, or a row where it is not one of the grid.
    fn array<'py>(&self, py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyAny>> {
        if values.len() == self.grid.len() {
            return Ok(field(py, &self.grid, values)?.into_any());
        }
        Ok(numpy::PyArray1::from_slice(py, values).into_any())
    }
}

impl Function {
    /// The field that the function makes of another one.
    fn field_into(&self, field: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        let expected = self.grid.len();
        if let Some(found) = [field.len(), out.len()].into_iter().find(|found| *found != expected) {
            return Err(InputError::Shape { field: self.name.to_owned(), expected, found });
        }
        Python::attach(|py| match self.array(py, field) {
            Ok(field) => self.fill(py, vec![field], out),
            Err(error) => Failure.keep(error),
        });
        if Failure.is_set() {
            let reason = "it raised an exception".to_owned();
            return Err(InputError::Conflict { field: self.name.to_owned(), reason });
        }
        Ok(())
    }
}
