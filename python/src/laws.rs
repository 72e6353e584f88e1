//! Laws written in Python, called on whole fields.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::tribochem::{FilmGrowthLaw, integrate_rates};
use stribeck::wear::WearLaw;
use stribeck::{BoundaryFriction, Grid, RubbingPoint};

use crate::convert::{dictionary, field};
use crate::error::raise;

/// The first exception that a law or a signal has raised.
#[derive(Clone, Default)]
pub(crate) struct Failure(Arc<Mutex<Option<PyErr>>>);

impl Failure {
    pub(crate) fn keep(&self, error: PyErr) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
    }

    pub(crate) fn take(&self) -> Option<PyErr> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    pub(crate) fn is_set(&self) -> bool {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).is_some()
    }
}

/// A function of Python that gives a field.
struct Function {
    /// What messages call it.
    name: &'static str,
    /// What tells it from others in a checkpoint.
    identity: String,
    call: Py<PyAny>,
    grid: Grid,
    failure: Failure,
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.identity)
    }
}

impl Function {
    /// Calls with the arguments that `arguments` makes and writes what is returned into `out`; NaN where that
    /// fails, with the exception kept.
    fn fill<'py>(&self, py: Python<'py>, arguments: Vec<Bound<'py, PyAny>>, out: &mut [f64]) {
        if let Err(error) = self.try_fill(py, arguments, out) {
            self.failure.keep(error);
        }
        if self.failure.is_set() {
            out.fill(f64::NAN);
        }
    }

    fn try_fill<'py>(
        &self,
        py: Python<'py>,
        arguments: Vec<Bound<'py, PyAny>>,
        out: &mut [f64],
    ) -> PyResult<()> {
        let arguments = pyo3::types::PyTuple::new(py, arguments)?;
        let returned = self.call.bind(py).call1(arguments).map_err(|error| self.raised(py, error))?;
        let numpy = py.import("numpy")?;
        let array = numpy.call_method1("asarray", (&returned, "float64"));
        let array = array.map_err(|_| {
            let kind = returned.get_type().to_string();
            self.refused(
                py,
                &format!("returned a value of the type {kind}, expected numbers"),
                returned.clone(),
            )
        })?;
        let expected =
            if out.len() == self.grid.len() { vec![self.grid.ny(), self.grid.nx()] } else { vec![out.len()] };
        let array = array.cast_into::<PyArrayDyn<f64>>()?;
        if array.ndim() > 0 && array.shape() != expected {
            let shape = array.getattr("shape")?;
            let message = format!("returned an array of the shape {shape}, expected {expected:?}");
            return Err(self.refused(py, &message, shape));
        }
        let array = numpy.call_method1("broadcast_to", (array, expected))?;
        let array = numpy.call_method1("ascontiguousarray", (array,))?.cast_into::<PyArrayDyn<f64>>()?;
        let values = array.readonly();
        let values = values.as_slice()?;
        if let Some(bad) = values.iter().find(|value| !value.is_finite()) {
            let value = bad.into_pyobject(py)?.into_any();
            return Err(self.refused(py, &format!("returned {bad}, every value must be finite"), value));
        }
        out.copy_from_slice(values);
        Ok(())
    }

    fn refused(&self, py: Python<'_>, what: &str, value: Bound<'_, PyAny>) -> PyErr {
        raise(py, "LawError", &format!("the {} {what}", self.name), Some(self.name), Some(value))
    }

    /// What the law raised, as the cause of a typed error; what ends a program goes on as it is.
    fn raised(&self, py: Python<'_>, error: PyErr) -> PyErr {
        if !error.is_instance_of::<pyo3::exceptions::PyException>(py) {
            return error;
        }
        let law = raise(py, "LawError", &format!("the {} raised {error}", self.name), Some(self.name), None);
        law.set_cause(py, Some(error));
        law
    }

    /// A field, or a row where it is not one of the grid.
    fn array<'py>(&self, py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyAny>> {
        if values.len() == self.grid.len() {
            return Ok(field(py, &self.grid, values)?.into_any());
        }
        Ok(numpy::PyArray1::from_slice(py, values).into_any())
    }

    /// The states of the nodes, as the laws see them.
    fn points<'py>(&self, py: Python<'py>, at: &[RubbingPoint]) -> PyResult<Bound<'py, PyAny>> {
        let part = |get: fn(&RubbingPoint) -> f64| self.array(py, &at.iter().map(get).collect::<Vec<_>>());
        let in_contact: Vec<bool> = at.iter().map(|at| at.in_contact).collect();
        let in_contact = if at.len() == self.grid.len() {
            field(py, &self.grid, &in_contact)?.into_any()
        } else {
            numpy::PyArray1::from_slice(py, &in_contact).into_any()
        };
        let parts: Bound<'py, PyDict> = dictionary!(py, {
            "pressure": part(|at| at.pressure)?,
            "solid_pressure": part(|at| at.solid_pressure)?,
            "shear_stress": part(|at| at.shear_stress)?,
            "temperature": part(|at| at.temperature)?,
            "sliding_speed": part(|at| at.sliding_speed)?,
            "film_thickness": part(|at| at.film_thickness)?,
            "in_contact": in_contact,
        });
        py.import("stribeck.laws")?.getattr("RubbingPoints")?.call((), Some(&parts))
    }
}

/// A growth law: `rate(at, thickness)`.
#[derive(Debug)]
pub(crate) struct Growth {
    function: Function,
    maximum_thickness: f64,
}

impl Growth {
    fn fill(&self, at: &[RubbingPoint], thickness: &[f64], out: &mut [f64]) {
        Python::attach(|py| match (self.function.points(py, at), self.function.array(py, thickness)) {
            (Ok(at), Ok(thickness)) => self.function.fill(py, vec![at, thickness], out),
            (Err(error), _) | (_, Err(error)) => self.function.failure.keep(error),
        });
    }
}

impl FilmGrowthLaw for Growth {
    fn rate(&self, at: &RubbingPoint, thickness: f64) -> f64 {
        let mut rate = [f64::NAN];
        self.fill(std::slice::from_ref(at), &[thickness], &mut rate);
        rate[0]
    }

    fn maximum_thickness(&self) -> f64 {
        self.maximum_thickness
    }

    fn advance_all(&self, at: &[RubbingPoint], time_step: f64, states: &mut [f64]) {
        // Attached once, and the conditions handed over once, for all rates of the step.
        Python::attach(|py| {
            let points = match self.function.points(py, at) {
                Ok(points) => points,
                Err(error) => return self.function.failure.keep(error),
            };
            let rates = |thickness: &[f64], out: &mut [f64]| match self.function.array(py, thickness) {
                Ok(thickness) => self.function.fill(py, vec![points.clone(), thickness], out),
                Err(error) => {
                    self.function.failure.keep(error);
                    out.fill(f64::NAN);
                }
            };
            integrate_rates(rates, self.maximum_thickness, time_step, states);
        });
        if self.function.failure.is_set() {
            states.fill(f64::NAN);
        }
    }
}

/// A wear law: `depth_rate(at, film_thickness)`.
#[derive(Debug)]
pub(crate) struct Wear(Function);

impl WearLaw for Wear {
    fn depth_rate(&self, at: &RubbingPoint, film_thickness: f64) -> f64 {
        let mut rate = [f64::NAN];
        self.depth_rates(std::slice::from_ref(at), &[film_thickness], &mut rate);
        rate[0]
    }

    fn depth_rates(&self, at: &[RubbingPoint], film_thickness: &[f64], rates: &mut [f64]) {
        rates.fill(f64::NAN);
        Python::attach(|py| match (self.0.points(py, at), self.0.array(py, film_thickness)) {
            (Ok(at), Ok(film)) => self.0.fill(py, vec![at, film], rates),
            (Err(error), _) | (_, Err(error)) => self.0.failure.keep(error),
        });
    }
}

/// A law of boundary friction: `coefficient(solid_pressure, sliding_speed, tribofilm_ball, tribofilm_disc)`.
#[derive(Debug)]
pub(crate) struct Friction(Function);

impl BoundaryFriction for Friction {
    fn coefficient(&self, solid_pressure: f64, sliding_speed: f64, tribofilm: [f64; 2]) -> f64 {
        let mut out = [f64::NAN];
        let [ball, disc] = tribofilm;
        self.coefficients(&[solid_pressure], sliding_speed, [&[ball], &[disc]], &mut out);
        out[0]
    }

    fn coefficients(&self, solid: &[f64], sliding_speed: f64, tribofilm: [&[f64]; 2], out: &mut [f64]) {
        out.fill(f64::NAN);
        Python::attach(|py| {
            let arguments = || -> PyResult<Vec<Bound<'_, PyAny>>> {
                let speed = sliding_speed.into_pyobject(py)?.into_any();
                let [ball, disc] = tribofilm;
                Ok(vec![self.0.array(py, solid)?, speed, self.0.array(py, ball)?, self.0.array(py, disc)?])
            };
            match arguments() {
                Ok(arguments) => self.0.fill(py, arguments, out),
                Err(error) => self.0.failure.keep(error),
            }
        });
    }
}

/// Laws of one simulation or solve.
pub(crate) struct Laws {
    pub(crate) growth: Option<Growth>,
    pub(crate) wear: Option<Wear>,
    pub(crate) friction: Option<Friction>,
    pub(crate) failure: Failure,
}

impl Laws {
    /// Each law is a pair of its identity and its function, the growth law with the largest thickness behind.
    pub(crate) fn new(
        grid: Grid,
        growth: Option<(String, Py<PyAny>, f64)>,
        wear: Option<(String, Py<PyAny>)>,
        friction: Option<(String, Py<PyAny>)>,
    ) -> Self {
        let failure = Failure::default();
        let function =
            |name, (identity, call)| Function { name, identity, call, grid, failure: failure.clone() };
        Self {
            growth: growth.map(|(identity, call, maximum_thickness)| Growth {
                function: function("growth law", (identity, call)),
                maximum_thickness,
            }),
            wear: wear.map(|law| Wear(function("wear law", law))),
            friction: friction.map(|law| Friction(function("boundary friction", law))),
            failure,
        }
    }
}
