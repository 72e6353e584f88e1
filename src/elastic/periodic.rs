//! The elastic half-space under loads that repeat along both axes, by one real transform.

use std::f64::consts::TAU;
use std::sync::Arc;

use super::response::ElasticResponse;
use super::{DeformationModel, NEAR, ResponseApproximations};
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Convolution, ConvolutionPlan};

/// Relative difference up to which two lengths are the same period.
const SAME_PERIOD: f64 = 1e-9;

/// Least displacement over that of the loaded node.
const ROUNDING: f64 = 1e-12;

/// Two half-spaces pressed together under a pressure that repeats along x and y with the size of the grid.
///
/// A wave of pressure with the wave number `q` displaces by a wave, `u = 4 p/(E' q)`. Pressures between nodes are those of
/// the waves that the grid resolves. The displacement under the mean pressure of an endless plane has no limit; it is
/// set such that a pressure at one node displaces the node that moves least by zero. Another choice shifts the
/// approach by a constant times the mean pressure. A grid of one row has waves along x alone, in plane strain.
///
/// `E'` is the equivalent modulus, `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`. Cost: one forward and one inverse real FFT
/// of N points for N nodes. Cloning shares the plan.
///
/// Source: Stanley, H. M. and Kato, T. (1997), Journal of Tribology 119, 481-485.
///
/// ```
/// use std::f64::consts::TAU;
/// use stribeck::Grid;
/// use stribeck::elastic::{DeformationModel, PeriodicHalfSpace};
/// let grid = Grid::centred(32, 24, 1e-6, 1e-6)?;
/// let mut body = PeriodicHalfSpace::new(grid, 230e9)?;
/// let wave: Vec<f64> = grid.nodes().map(|(x, _)| (TAU * x / 32e-6).cos()).collect();
/// let mut out = vec![0.0; grid.len()];
/// body.displacement(&wave, &mut out)?;
/// let exact = 4.0 * 32e-6 / (TAU * 230e9);
/// assert!(wave.iter().zip(&out).all(|(p, u)| (u - exact * p).abs() < 1e-12 * exact));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct PeriodicHalfSpace {
    /// `E'` \[Pa\].
    equivalent_modulus: f64,
    /// Influence coefficients by rows and columns of offset \[m/Pa\].
    near: [[f64; NEAR + 1]; NEAR + 1],
    /// Convolution with all influence coefficients.
    response: ElasticResponse,
}

impl PeriodicHalfSpace {
    /// Half-space with the period of `grid` along both axes and the equivalent modulus `E'` \[Pa\].
    ///
    /// # Errors
    /// A strip, whose period is across alone. A grid of one node. A modulus that is not finite and positive.
    pub fn new(grid: Grid, equivalent_modulus: f64) -> Result<Self, InputError> {
        let conflict =
            |reason: &str| Err(InputError::Conflict { field: "grid".to_owned(), reason: reason.to_owned() });
        if grid.is_strip() {
            return conflict("a strip repeats across alone; use StripHalfSpace, or Grid::from_edges");
        }
        if grid.len() < 2 {
            return conflict("one node resolves no wave");
        }
        InputError::require_positive("elastic.equivalent_modulus", equivalent_modulus)?;
        let (nx, ny) = (grid.nx(), grid.ny());
        let plan = |mean: f64| {
            ConvolutionPlan::of_spectrum(nx, ny, |i, j| {
                let wave_number = TAU * (i as f64 / grid.size_x()).hypot(j as f64 / grid.size_y());
                if wave_number > 0.0 { 4.0 / (equivalent_modulus * wave_number) } else { mean }
            })
        };
        let mut impulse = vec![0.0; grid.len()];
        impulse[0] = 1.0;
        let mut influence = vec![0.0; grid.len()];
        Convolution::new(Arc::new(plan(0.0))).apply(&impulse, &mut influence);
        let least = influence.iter().copied().fold(0.0, f64::min);
        // Above rounding, so that no node moves towards the load.
        let mean = ROUNDING * influence[0] - least;
        let at = |di: usize, dj: usize| influence[dj % ny * nx + di % nx] + mean;
        let plan = plan(mean * grid.len() as f64);
        Ok(Self {
            equivalent_modulus,
            near: std::array::from_fn(|dj| std::array::from_fn(|di| at(di, dj))),
            response: ElasticResponse::of_plans(grid, plan.clone(), &plan, at(0, 0)),
        })
    }
}

impl DeformationModel for PeriodicHalfSpace {
    fn grid(&self) -> Grid {
        self.response.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.response.displacement(pressure, out)
    }

    /// The bodies on a grid of the same periods.
    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let own = self.grid();
        let is_same = |a: f64, b: f64| (a - b).abs() <= SAME_PERIOD * b;
        let repeats = is_same(grid.size_x(), own.size_x()) && is_same(grid.size_y(), own.size_y());
        let body = repeats.then(|| Self::new(grid, self.equivalent_modulus).ok()).flatten()?;
        Some(Box::new(body))
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.near.get(dj).and_then(|row| row.get(di)).copied().unwrap_or(0.0)
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        Some(&mut self.response)
    }
}
