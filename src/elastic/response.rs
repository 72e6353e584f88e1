//! A translation-invariant elastic response on a grid: convolution and its estimated inverse, shapes checked.

use std::sync::Arc;

use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Convolution, ConvolutionPlan};

/// What the half-spaces share. Cloning shares the plans.
#[derive(Debug, Clone)]
pub(super) struct ElasticResponse {
    pub(super) grid: Grid,
    convolution: Convolution,
    inverse: Convolution,
}

impl ElasticResponse {
    /// The response with displacement `kernel(i, j)` \[m/Pa\] at an offset of `i` columns and `j` rows.
    pub(super) fn new(grid: Grid, kernel: impl Fn(isize, isize) -> f64) -> Self {
        let plan = ConvolutionPlan::new(grid.nx(), grid.ny(), &kernel);
        let inverse = ConvolutionPlan::periodic_inverse(grid.nx(), grid.ny(), &kernel);
        let own = |plan| Convolution::new(Arc::new(plan));
        Self { grid, convolution: own(plan), inverse: own(inverse) }
    }

    pub(super) fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        InputError::require_len("pressure", pressure, self.grid.len())?;
        InputError::require_len("out", out, self.grid.len())?;
        self.convolution.apply(pressure, out);
        Ok(())
    }

    pub(super) fn pressure_estimate(
        &mut self,
        displacement: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        InputError::require_len("displacement", displacement, self.grid.len())?;
        InputError::require_len("out", out, self.grid.len())?;
        self.inverse.apply(displacement, out);
        Ok(())
    }
}
