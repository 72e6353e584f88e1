//! Laws of surfaces that rub: growth of tribofilms, wear, boundary friction.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use stribeck::tribochem::{FilmGrowthLaw, integrate_rates};
use stribeck::wear::WearLaw;
use stribeck::{BoundaryFriction, SurfaceState};

use super::{Failure, Function};
use crate::convert::{dictionary, field};

impl Function {
    /// The states of the nodes, as the laws see them.
    fn points<'py>(&self, py: Python<'py>, at: &[SurfaceState]) -> PyResult<Bound<'py, PyAny>> {
        let part = |get: fn(&SurfaceState) -> f64| self.array(py, &at.iter().map(get).collect::<Vec<_>>());
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
            "gap": part(|at| at.gap)?,
            "in_contact": in_contact,
        });
        py.import("stribeck.laws")?.getattr("SurfaceStates")?.call((), Some(&parts))
    }
}

/// A growth law: `rate(at, thickness)`.
#[derive(Debug)]
pub(crate) struct Growth {
    pub(crate) function: Function,
    /// \[m\].
    pub(crate) maximum_thickness: f64,
}

impl Growth {
    fn fill(&self, at: &[SurfaceState], thickness: &[f64], out: &mut [f64]) {
        Python::attach(|py| match (self.function.points(py, at), self.function.array(py, thickness)) {
            (Ok(at), Ok(thickness)) => self.function.fill(py, vec![at, thickness], out),
            (Err(error), _) | (_, Err(error)) => Failure.keep(error),
        });
    }
}

impl FilmGrowthLaw for Growth {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        let mut rate = [f64::NAN];
        self.fill(std::slice::from_ref(at), &[thickness], &mut rate);
        rate[0]
    }

    fn maximum_thickness(&self) -> f64 {
        self.maximum_thickness
    }

    fn advance_all(&self, at: &[SurfaceState], time_step: f64, states: &mut [f64]) {
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
pub(crate) struct Wear(pub(crate) Function);

impl WearLaw for Wear {
    fn depth_rate(&self, at: &SurfaceState, film_thickness: f64) -> f64 {
        let mut rate = [f64::NAN];
        self.depth_rates(std::slice::from_ref(at), &[film_thickness], &mut rate);
        rate[0]
    }

    fn depth_rates(&self, at: &[SurfaceState], film_thickness: &[f64], rates: &mut [f64]) {
        rates.fill(f64::NAN);
        Python::attach(|py| match (self.0.points(py, at), self.0.array(py, film_thickness)) {
            (Ok(at), Ok(film)) => self.0.fill(py, vec![at, film], rates),
            (Err(error), _) | (_, Err(error)) => Failure.keep(error),
        });
    }
}

/// A law of boundary friction: `coefficient(solid_pressure, sliding_speed, tribofilm_ball, tribofilm_disc)`.
#[derive(Debug)]
pub(crate) struct Friction(pub(crate) Function);

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
