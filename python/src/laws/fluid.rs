//! Laws of the lubricant.

use std::sync::Arc;

use pyo3::prelude::*;
use stribeck::lubricant::{DensityLaw, ViscosityLaw};

use super::Function;

/// Pressures apart that slopes are taken from, over the pressure, and the least of these pressures \[Pa\].
const SLOPE_STEP: f64 = 1e-4;
const LEAST: f64 = 1e6;

/// A function of pressure and, where it knows it, of temperature.
#[derive(Debug, Clone)]
pub(crate) struct OfPressure {
    function: Arc<Function>,
    knows_temperature: bool,
    /// That of the lubricant \[K\].
    temperature: f64,
}

impl OfPressure {
    /// At the bulk `temperature` \[K\] of the scene.
    pub(crate) fn new(function: Function, knows_temperature: bool, temperature: f64) -> Self {
        Self { function: Arc::new(function), knows_temperature, temperature }
    }

    fn warmed(&self, temperature: f64) -> Option<Self> {
        self.knows_temperature.then(|| Self { temperature, ..self.clone() })
    }

    /// Pressures below zero count as zero.
    fn fill(&self, pressure: &[f64], out: &mut [f64]) {
        let pressure: Vec<f64> = pressure.iter().map(|p| p.max(0.0)).collect();
        Python::attach(|py| {
            let arguments = || {
                let mut arguments = vec![self.function.array(py, &pressure)?];
                if self.knows_temperature {
                    arguments.push(self.temperature.into_pyobject(py)?.into_any());
                }
                Ok(arguments)
            };
            self.function.fill_by(py, arguments, out);
        });
    }

    fn at(&self, pressure: f64) -> f64 {
        let mut value = [f64::NAN];
        self.fill(&[pressure], &mut value);
        value[0]
    }
}

/// A viscosity law: `viscosity(pressure)`, or `viscosity_at(pressure, temperature)`.
#[derive(Debug)]
pub(crate) struct Viscosity(pub(crate) OfPressure);

impl ViscosityLaw for Viscosity {
    fn viscosity(&self, pressure: f64) -> f64 {
        self.0.at(pressure)
    }

    fn at_temperature(&self, temperature: f64) -> Option<Box<dyn ViscosityLaw>> {
        self.0.warmed(temperature).map(|law| Box::new(Self(law)) as _)
    }

    fn fill(&self, pressure: &[f64], viscosity: &mut [f64]) {
        self.0.fill(pressure, viscosity);
    }
}

/// A density law: `ratio(pressure)`, or `ratio_at(pressure, temperature)`.
#[derive(Debug)]
pub(crate) struct Density(pub(crate) OfPressure);

impl DensityLaw for Density {
    fn ratio(&self, pressure: f64) -> f64 {
        self.0.at(pressure)
    }

    fn slope(&self, pressure: f64) -> f64 {
        let mut slope = [f64::NAN];
        self.fill_slopes(&[pressure], &mut slope);
        slope[0]
    }

    fn at_temperature(&self, temperature: f64) -> Option<Box<dyn DensityLaw>> {
        self.0.warmed(temperature).map(|law| Box::new(Self(law)) as _)
    }

    fn fill(&self, pressure: &[f64], ratio: &mut [f64]) {
        self.0.fill(pressure, ratio);
    }

    /// Central differences.
    fn fill_slopes(&self, pressure: &[f64], slope: &mut [f64]) {
        let ends = |p: f64| {
            let (p, step) = (p.max(0.0), SLOPE_STEP * p.abs().max(LEAST));
            ((p - step).max(0.0), p + step)
        };
        let (low, high): (Vec<f64>, Vec<f64>) = pressure.iter().map(|p| ends(*p)).unzip();
        let mut below = vec![f64::NAN; low.len()];
        self.0.fill(&low, &mut below);
        self.0.fill(&high, slope);
        for (k, slope) in slope.iter_mut().enumerate() {
            *slope = (*slope - below[k]) / (high[k] - low[k]);
        }
    }
}
