//! A translation-invariant elastic response on a grid: convolution and its estimated inverse, shapes checked.
//!
//! Beside the exact product in double precision there are three cheaper operators in single precision, scaled
//! by the self-influence so that their numbers are of the size of pressures: the same product, that on the
//! periodic grid at a quarter of the cost, and the inverse of the latter, which estimates pressures of
//! displacements.

use std::sync::Arc;

use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Convolution, ConvolutionPlan};

/// What the half-spaces share. Cloning shares the plans.
#[derive(Debug, Clone)]
pub(super) struct ElasticResponse {
    /// The grid of pressures and displacements.
    pub(super) grid: Grid,
    /// The exact product.
    convolution: Convolution,
    /// In single precision, over the self-influence.
    estimate: Convolution<f32>,
    /// The same on the periodic grid.
    periodic: Convolution<f32>,
    /// In single precision, times the self-influence.
    inverse: Convolution<f32>,
    /// The same with a local compliance of all nodes; none without.
    softened: Option<Convolution<f32>>,
    /// Self-influence `K(0, 0)` \[m/Pa\].
    own: f64,
}

impl ElasticResponse {
    /// The response with displacement `kernel(i, j)` \[m/Pa\] at an offset of `i` columns and `j` rows.
    pub(super) fn new(grid: Grid, kernel: impl Fn(isize, isize) -> f64) -> Self {
        let plan = ConvolutionPlan::new(grid.nx(), grid.ny(), &kernel);
        let periodic = ConvolutionPlan::periodic(grid.nx(), grid.ny(), &kernel);
        let own = kernel(0, 0);
        Self {
            grid,
            estimate: Convolution::new(Arc::new(plan.to_single(1.0 / own))),
            periodic: Convolution::new(Arc::new(periodic.to_single(1.0 / own))),
            inverse: Convolution::new(Arc::new(periodic.inverse_with(0.0).to_single(own))),
            softened: None,
            convolution: Convolution::new(Arc::new(plan)),
            own,
        }
    }

    /// `out = K p`.
    pub(super) fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        InputError::require_len("pressure", pressure, self.grid.len())?;
        InputError::require_len("out", out, self.grid.len())?;
        self.convolution.apply(pressure, out);
        Ok(())
    }

    /// `out = K p` in single precision.
    pub(super) fn displacement_single(
        &mut self,
        pressure: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        in_single(&mut self.estimate, self.grid, ("pressure", pressure), self.own, out)
    }

    /// `out = K p` on the periodic grid, in single precision.
    pub(super) fn displacement_periodic(
        &mut self,
        pressure: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        in_single(&mut self.periodic, self.grid, ("pressure", pressure), self.own, out)
    }

    /// Adds a local `compliance` \[m/Pa\] of all nodes to what estimated pressures belong to, in place of that
    /// before.
    pub(super) fn soften(&mut self, compliance: f64) {
        if compliance == 0.0 {
            self.softened = None;
            return;
        }
        let plan = self.periodic.plan().inverse_with(compliance / self.own);
        match &mut self.softened {
            Some(softened) => softened.take(plan),
            None => self.softened = Some(Convolution::new(Arc::new(plan))),
        }
    }

    /// Pressures that a displacement needs on the periodic grid: the spectrum of the kernel, and of a local
    /// compliance, inverted by its modulus.
    pub(super) fn pressure_estimate(
        &mut self,
        displacement: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        let inverse = self.softened.as_mut().unwrap_or(&mut self.inverse);
        in_single(inverse, self.grid, ("displacement", displacement), 1.0 / self.own, out)
    }
}

/// The convolution of a named field times `unit`, the field brought to numbers of at most one before.
fn in_single(
    convolution: &mut Convolution<f32>,
    grid: Grid,
    (name, field): (&'static str, &[f64]),
    unit: f64,
    out: &mut [f64],
) -> Result<(), InputError> {
    InputError::require_len(name, field, grid.len())?;
    InputError::require_len("out", out, grid.len())?;
    let largest = field.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    if largest == 0.0 {
        out.fill(0.0);
    } else {
        convolution.apply_scaled(field, [1.0 / largest, largest * unit], out);
    }
    Ok(())
}
