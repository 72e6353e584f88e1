//! Laws written in Python, called on whole fields.

use std::cell::Cell;
use std::fmt;
use std::sync::Arc;

use numpy::{PyArrayDyn, PyArrayMethods, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::elastic::{DeformationModel, NEAR, ResponseApproximations};
use stribeck::tribochem::{FilmGrowthLaw, integrate_rates};
use stribeck::wear::WearLaw;
use stribeck::{BoundaryFriction, Grid, InputError, RubbingPoint};

use crate::convert::{dictionary, field};
use crate::error::raise;
use crate::solution::{PyDeformation, PyGrowth, PyLaw};

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

/// A function of Python that gives a field.
struct Function {
    /// What messages call it.
    name: &'static str,
    /// What tells it from others in a checkpoint.
    identity: String,
    call: Py<PyAny>,
    grid: Grid,
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
            (Err(error), _) | (_, Err(error)) => Failure.keep(error),
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
                Err(error) => return Failure.keep(error),
            };
            let rates = |thickness: &[f64], out: &mut [f64]| match self.function.array(py, thickness) {
                Ok(thickness) => self.function.fill(py, vec![points.clone(), thickness], out),
                Err(error) => {
                    Failure.keep(error);
                    out.fill(f64::NAN);
                }
            };
            integrate_rates(rates, self.maximum_thickness, time_step, states);
        });
        if Failure.is_set() {
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
            (Err(error), _) | (_, Err(error)) => Failure.keep(error),
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
                Err(error) => Failure.keep(error),
            }
        });
    }
}

/// A deformation model: `displacement(pressure)` and, where there is one, `pressure_estimate(displacement)`.
/// A clone shares the functions.
#[derive(Clone)]
pub(crate) struct Deformation {
    displacement: Arc<Function>,
    estimated: Option<Estimated>,
    /// By rows and columns of the offset, up to `NEAR`.
    influences: [[f64; NEAR + 1]; NEAR + 1],
}

/// What a deformation model with an estimate of pressures offers beside its displacement.
#[derive(Clone)]
struct Estimated {
    displacement: Arc<Function>,
    estimate: Arc<Function>,
}

impl fmt::Debug for Deformation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.displacement.fmt(f)
    }
}

impl Deformation {
    /// The influence coefficients are the displacements under 1 Pa on the first node.
    fn new(py: Python<'_>, displacement: Function, estimate: Option<Function>) -> PyResult<Self> {
        let grid = displacement.grid;
        let mut unit = vec![0.0; grid.len()];
        let mut out = unit.clone();
        if let Some(first) = unit.first_mut() {
            *first = 1.0;
        }
        displacement.try_fill(py, vec![displacement.array(py, &unit)?], &mut out)?;
        let mut influences = [[0.0; NEAR + 1]; NEAR + 1];
        for (row, values) in influences.iter_mut().zip(out.chunks(grid.nx())) {
            for (influence, value) in row.iter_mut().zip(values) {
                *influence = *value;
            }
        }
        let displacement = Arc::new(displacement);
        let estimated = estimate.map(|estimate| Estimated {
            displacement: Arc::clone(&displacement),
            estimate: Arc::new(estimate),
        });
        Ok(Self { displacement, estimated, influences })
    }
}

impl DeformationModel for Deformation {
    fn grid(&self) -> Grid {
        self.displacement.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.displacement.field_into(pressure, out)
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.influences.get(dj).and_then(|row| row.get(di)).copied().unwrap_or(0.0)
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        self.estimated.as_mut().map(|estimated| estimated as _)
    }
}

impl ResponseApproximations for Estimated {
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.displacement.field_into(pressure, out)
    }

    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.estimate.field_into(displacement, out)
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

/// Laws of one simulation or solve.
pub(crate) struct Laws {
    pub(crate) growth: Option<Growth>,
    pub(crate) wear: Option<Wear>,
    pub(crate) friction: Option<Friction>,
    pub(crate) deformation: Option<Deformation>,
}

impl Laws {
    /// Each law is a pair of its identity and its function, the growth law with the largest thickness behind,
    /// the deformation model with the function of its estimate.
    pub(crate) fn new(
        py: Python<'_>,
        grid: Grid,
        growth: Option<PyGrowth>,
        wear: Option<PyLaw>,
        friction: Option<PyLaw>,
        deformation: Option<PyDeformation>,
    ) -> PyResult<Self> {
        let function = |name, (identity, call)| Function { name, identity, call, grid };
        let deformation = deformation.map(|(identity, displacement, estimate)| {
            let estimate = estimate.map(|call| function("pressure estimate", (identity.clone(), call)));
            Deformation::new(py, function("deformation model", (identity, displacement)), estimate)
        });
        Ok(Self {
            growth: growth.map(|(identity, call, maximum_thickness)| Growth {
                function: function("growth law", (identity, call)),
                maximum_thickness,
            }),
            wear: wear.map(|law| Wear(function("wear law", law))),
            friction: friction.map(|law| Friction(function("boundary friction", law))),
            deformation: deformation.transpose()?,
        })
    }
}
