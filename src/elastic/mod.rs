//! Elastic deformation of the surfaces under pressure.
//!
//! [`DeformationModel`] is the interface of the solvers to an elastic body: the displacement under a pressure
//! field and the influence coefficients of near nodes. [`ResponseApproximations`] are cheaper operators that
//! speed solvers up. [`HalfSpace`] is the default (Boussinesq half-space, Love's influence coefficients,
//! DC-FFT convolution), [`LineHalfSpace`] its plane-strain counterpart for line contacts,
//! [`StripHalfSpace`] that under loads that repeat across the flow, [`PeriodicHalfSpace`] that under loads that repeat
//! along both axes, and [`LayeredHalfSpace`] either of them with a bonded [`Layer`]. [`WithLocalCompliance`] adds the compliance
//! of a thin [`BondedFilm`] to any of them. [`direct_displacement`] is the slow direct sum that verifies the
//! half-space. [`subsurface_stress`] and [`stress_extremes`] compute stresses below the surface,
//! [`LayeredStress`] those in and below a layer.

mod bonded_film;
mod direct;
mod dry;
mod half_space;
mod layered;
mod line;
mod local_compliance;
mod periodic;
mod response;
mod strip;
mod subsurface;

use std::fmt::Debug;

pub use bonded_film::BondedFilm;
pub use direct::direct_displacement;
pub use dry::{DryOutcome, DryProblem, DrySolver};
pub use half_space::HalfSpace;
pub use layered::{Layer, LayerStressExtremes, LayeredHalfSpace, LayeredStress, LayeredStressExtremes};
pub use line::LineHalfSpace;
pub use local_compliance::WithLocalCompliance;
pub use periodic::PeriodicHalfSpace;
pub use strip::StripHalfSpace;
pub use subsurface::{Extreme, StressExtremes, StressField, stress_extremes, subsurface_stress};

use crate::error::InputError;
use crate::grid::Grid;

/// The displacement of both surfaces together as a linear function of pressure.
///
/// Contract: `displacement` is linear in the pressure, symmetric (node a acts on node b as b acts on a),
/// positive definite, and translation invariant except for [`self_influence`](Self::self_influence). Solvers
/// rely on all four properties. It must not allocate after the first call.
///
/// # Examples
///
/// Independent springs (Winkler foundation), the simplest elastic body:
///
/// ```
/// use stribeck::elastic::DeformationModel;
/// use stribeck::{Grid, InputError};
/// #[derive(Debug, Clone)]
/// struct Springs {
///     grid: Grid,
///     compliance: f64, // m/Pa
/// }
/// impl DeformationModel for Springs {
///     fn grid(&self) -> Grid {
///         self.grid
///     }
///     fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
///         out.iter_mut().zip(pressure).for_each(|(u, p)| *u = self.compliance * p);
///         Ok(())
///     }
///     fn influence(&self, di: usize, dj: usize) -> f64 {
///         if di + dj == 0 { self.compliance } else { 0.0 }
///     }
/// }
/// let mut springs = Springs { grid: Grid::centred(4, 1, 1e-6, 1.0)?, compliance: 1e-15 };
/// let mut out = [0.0; 4];
/// springs.displacement(&[0.0, 1e9, 0.0, 0.0], &mut out)?;
/// assert!((out[1] - 1e-6).abs() < 1e-20 && out[0] == 0.0);
/// # Ok::<(), InputError>(())
/// ```
pub trait DeformationModel: Debug + Send + Sync {
    /// The grid of pressures and displacements.
    fn grid(&self) -> Grid;

    /// Overwrites `out` \[m\] with the displacement (widening of the gap) under `pressure` \[Pa\], both of
    /// `grid().len()` values in the order of the grid.
    ///
    /// # Errors
    /// [`InputError::Shape`] when a slice does not fit the grid.
    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError>;

    /// The influence coefficient \[m/Pa\] at an offset of `di` columns and `dj` rows (absolute values, at
    /// most [`NEAR`]): line relaxations solve for these implicitly.
    fn influence(&self, di: usize, dj: usize) -> f64;

    /// The displacement of node `node` under unit pressure on itself \[m/Pa\]. The default is
    /// `influence(0, 0)` for all nodes. Where the value varies over the nodes, `influence(0, 0)` is a
    /// representative value.
    fn self_influence(&self, _node: usize) -> f64 {
        self.influence(0, 0)
    }

    /// The same bodies on another grid, for coarse-grid starts and multigrid. `None` (the default) means that
    /// the model exists on one grid only: `Multigrid` then rejects it and `Auto` uses Newton's method.
    fn on_grid(&self, _grid: Grid) -> Option<Box<dyn DeformationModel>> {
        None
    }

    /// Whether the caller wants the solve to end. Solvers ask between long parts of an iteration, and
    /// `displacement` then returns an error. The default is false.
    fn must_stop(&self) -> bool {
        false
    }

    /// Cheaper approximations of the response. With `None` (the default) solvers use the exact displacement,
    /// and divide by the self-influence to estimate a pressure.
    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        None
    }
}

/// Approximations of the response of a [`DeformationModel`] that cost less than the exact displacement. They
/// affect the cost of a solve, not its solution.
pub trait ResponseApproximations {
    /// Overwrites `out` \[m\] with the displacement under `pressure` \[Pa\], accurate to about 1e-6 of its
    /// largest value. The accuracy suffices for the matrix-vector products of linear systems, which are
    /// solved to a relative residual of about 0.01.
    ///
    /// # Errors
    /// [`InputError::Shape`] when a slice does not fit the grid.
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError>;

    /// Overwrites `out` \[m\] with the displacement under `pressure` \[Pa\], exact between near nodes and
    /// accurate to a few per cent elsewhere. Linear solvers use it as a preconditioner and measure the
    /// residual with `displacement_single`. The half-space uses a periodic convolution with the minimum-image
    /// distance, at a quarter of the cost. The default is `displacement_single`.
    ///
    /// # Errors
    /// [`InputError::Shape`] when a slice does not fit the grid.
    fn displacement_periodic(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.displacement_single(pressure, out)
    }

    /// Overwrites `out` \[Pa\] with an estimate of the pressure that causes `displacement` \[m\]: the
    /// preconditioner of contact equations. It must be positive and linear to about 1e-6. A better
    /// approximation of the inverse reduces the number of iterations.
    ///
    /// # Errors
    /// [`InputError::Shape`] when a slice does not fit the grid.
    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError>;

    /// Sets the mean local compliance \[m/Pa\] that `pressure_estimate` adds to every node; zero stands for
    /// the bodies alone. The default implementation ignores it, which costs iterations.
    fn set_mean_compliance(&mut self, _compliance: f64) {}
}

impl DeformationModel for Box<dyn DeformationModel> {
    fn grid(&self) -> Grid {
        (**self).grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        (**self).displacement(pressure, out)
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        (**self).influence(di, dj)
    }

    fn self_influence(&self, node: usize) -> f64 {
        (**self).self_influence(node)
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        (**self).on_grid(grid)
    }

    fn must_stop(&self) -> bool {
        (**self).must_stop()
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        (**self).approximations()
    }
}

/// Approximations with the exact displacement as the fallback.
impl dyn DeformationModel + '_ {
    /// The displacement in single precision, or else the exact one.
    pub(crate) fn displacement_single(
        &mut self,
        pressure: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        match self.approximations() {
            Some(approximations) => approximations.displacement_single(pressure, out),
            None => self.displacement(pressure, out),
        }
    }

    /// The displacement to a few per cent, or else the exact one.
    pub(crate) fn displacement_periodic(
        &mut self,
        pressure: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        match self.approximations() {
            Some(approximations) => approximations.displacement_periodic(pressure, out),
            None => self.displacement(pressure, out),
        }
    }

    /// The estimated pressure, or else the displacement over the self-influence.
    pub(crate) fn pressure_estimate(
        &mut self,
        displacement: &[f64],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        if let Some(approximations) = self.approximations() {
            return approximations.pressure_estimate(displacement, out);
        }
        InputError::require_len("displacement", displacement, self.grid().len())?;
        InputError::require_len("out", out, self.grid().len())?;
        let stiffness = 1.0 / self.influence(0, 0);
        for (p, u) in out.iter_mut().zip(displacement) {
            *p = stiffness * u;
        }
        Ok(())
    }
}

/// The largest offset along x or y for which solvers call [`DeformationModel::influence`].
pub const NEAR: usize = 5;
