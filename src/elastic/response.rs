//! A translation-invariant elastic response on a grid: convolution, estimated inverse, and checks of shapes.
//!
//! The exact product is in double precision. Three cheaper operators are in single precision, scaled by the
//! self-influence so that their values are of the magnitude of pressures: the same product, the product on
//! the periodic grid at a quarter of the cost, and the inverse of the latter, which estimates pressures from
//! displacements.

use std::sync::Arc;

use super::ResponseApproximations;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Convolution, ConvolutionPlan};

/// Response shared by all half-spaces. Clones share the plans.
#[derive(Debug, Clone)]
pub(super) struct ElasticResponse {
    /// The grid of pressures and displacements.
    pub(super) grid: Grid,
    /// The exact product, in double precision.
    convolution: Convolution,
    /// The product in single precision, over the self-influence.
    estimate: Convolution<f32>,
    /// The product on the periodic grid, over the self-influence.
    periodic: Convolution<f32>,
    /// The inverse on the periodic grid, times the self-influence.
    inverse: Convolution<f32>,
    /// The inverse with a mean local compliance; `None` without one.
    compliant_inverse: Option<Convolution<f32>>,
    /// Self-influence `K(0, 0)` \[m/Pa\].
    self_influence: f64,
}

impl ElasticResponse {
    /// The response with displacement `kernel(i, j)` \[m/Pa\] at an offset of `i` columns and `j` rows.
    pub(super) fn new(grid: Grid, kernel: impl Fn(isize, isize) -> f64) -> Self {
        let (nx, ny) = (grid.nx(), grid.ny());
        let (plan, periodic) = if grid.is_strip() {
            (
                ConvolutionPlan::periodic_across(nx, ny, &kernel),
                ConvolutionPlan::periodic_strip(nx, ny, &kernel),
            )
        } else {
            (ConvolutionPlan::new(nx, ny, &kernel), ConvolutionPlan::periodic(nx, ny, &kernel))
        };
        Self::of_plans(grid, plan, &periodic, kernel(0, 0))
    }

    /// The response by its `plan`, that on the `periodic` grid and the displacement of a cell under its own pressure
    /// \[m/Pa\].
    pub(super) fn of_plans(
        grid: Grid,
        plan: ConvolutionPlan,
        periodic: &ConvolutionPlan,
        self_influence: f64,
    ) -> Self {
        Self {
            grid,
            estimate: Convolution::new(Arc::new(plan.to_single(1.0 / self_influence))),
            periodic: Convolution::new(Arc::new(periodic.to_single(1.0 / self_influence))),
            inverse: Convolution::new(Arc::new(periodic.inverse_with(0.0).to_single(self_influence))),
            compliant_inverse: None,
            convolution: Convolution::new(Arc::new(plan)),
            self_influence,
        }
    }

    /// `out = K p`.
    pub(super) fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        InputError::require_len("pressure", pressure, self.grid.len())?;
        InputError::require_len("out", out, self.grid.len())?;
        self.convolution.apply(pressure, out);
        Ok(())
    }
}

impl ResponseApproximations for ElasticResponse {
    /// `out = K p` in single precision.
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        in_single(&mut self.estimate, self.grid, ("pressure", pressure), self.self_influence, out)
    }

    /// `out = K p` on the periodic grid, in single precision.
    fn displacement_periodic(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        in_single(&mut self.periodic, self.grid, ("pressure", pressure), self.self_influence, out)
    }

    /// Sets the mean local compliance \[m/Pa\] that the estimated pressure includes.
    fn set_mean_compliance(&mut self, compliance: f64) {
        if compliance == 0.0 {
            self.compliant_inverse = None;
            return;
        }
        let plan = self.periodic.plan().inverse_with(compliance / self.self_influence);
        match &mut self.compliant_inverse {
            Some(compliant_inverse) => compliant_inverse.replace_plan(plan),
            None => self.compliant_inverse = Some(Convolution::new(Arc::new(plan))),
        }
    }

    /// Pressures that cause a displacement on the periodic grid: the spectrum of the kernel, plus the mean
    /// local compliance, inverted by its modulus.
    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        let inverse = self.compliant_inverse.as_mut().unwrap_or(&mut self.inverse);
        in_single(inverse, self.grid, ("displacement", displacement), 1.0 / self.self_influence, out)
    }
}

/// Applies a convolution to a named field and multiplies by `unit`. The field is scaled to at most one before
/// the conversion to single precision.
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
