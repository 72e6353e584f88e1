//! Elastic bodies.

use std::fmt;
use std::sync::Arc;

use pyo3::prelude::*;
use stribeck::elastic::{DeformationModel, NEAR, ResponseApproximations};
use stribeck::{Grid, InputError};

use super::Function;

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
    pub(crate) fn new(py: Python<'_>, displacement: Function, estimate: Option<Function>) -> PyResult<Self> {
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
