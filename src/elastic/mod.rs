//! Elastic deformation of the surfaces under pressure.
//!
//! [`DeformationModel`] is what solvers need of a body: the displacement field of a pressure field and the
//! first influence coefficients; [`ResponseApproximations`] are what makes them faster. [`HalfSpace`] is the
//! default (Boussinesq half-space, Love's influence coefficients, DC-FFT convolution), [`LineHalfSpace`] its
//! plane-strain counterpart for line contacts, [`LayeredHalfSpace`] either of them with a bonded [`Layer`];
//! [`WithLocalCompliance`] adds to any of them what a thin [`BondedFilm`] gives way. [`direct_displacement`] is
//! the slow direct sum that the half-space is checked against. [`subsurface_stress`] and [`stress_extremes`] are
//! the stresses below the surface, [`LayeredStress`] those in and below a layer.

mod bonded_film;
mod direct;
mod dry;
mod half_space;
mod layered;
mod line;
mod local_compliance;
mod response;
mod subsurface;

use std::fmt::Debug;

pub use bonded_film::BondedFilm;
pub use direct::direct_displacement;
pub use dry::{DryOutcome, DryProblem, DrySolver};
pub use half_space::HalfSpace;
pub use layered::{Layer, LayerStressExtremes, LayeredHalfSpace, LayeredStress, LayeredStressExtremes};
pub use line::LineHalfSpace;
pub use local_compliance::WithLocalCompliance;
pub use subsurface::{Extreme, StressExtremes, StressField, stress_extremes, subsurface_stress};

use crate::error::InputError;
use crate::grid::Grid;

/// The displacement of both surfaces together as a linear function of pressure.
///
/// Contract: `displacement` is linear in the pressure, symmetric (the influence of node a on b is that of b
/// on a), positive and translation invariant but for [`self_influence`](Self::self_influence); solvers rely
/// on all four. It must not allocate after the first call.
///
/// # Examples
///
/// Springs side by side (Winkler's foundation), the simplest body there is:
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
    /// The grid that pressures and displacements live on.
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

    /// The displacement of node `node` under unit pressure of its own \[m/Pa\]; `influence(0, 0)` (the default)
    /// where it is that of all nodes. Where it is not, `influence(0, 0)` stands for all of them.
    fn self_influence(&self, _node: usize) -> f64 {
        self.influence(0, 0)
    }

    /// The same bodies on another grid, for starts on coarser grids and multigrid; none (the default) where
    /// the model lives on one grid alone: then `Multigrid` refuses it and `Auto` takes Newton's method.
    fn on_grid(&self, _grid: Grid) -> Option<Box<dyn DeformationModel>> {
        None
    }

    /// Cheaper approximations of the response, for solvers to work with; none (the default) where there are
    /// none: the displacement is then taken in their place, and a division by the self-influence.
    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        None
    }
}

/// Approximations of the response of a [`DeformationModel`] that cost less than its displacement. Solutions
/// do not depend on them, the work of a solve does.
pub trait ResponseApproximations {
    /// Overwrites `out` \[m\] with the displacement under `pressure` \[Pa\] to about 1e-6 of its largest
    /// value: what the products of linear systems need, which are solved to a hundredth.
    ///
    /// # Errors
    /// [`InputError::Shape`] when a slice does not fit the grid.
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError>;

    /// Overwrites `out` \[m\] with the displacement under `pressure` \[Pa\] to some per cent, exact between
    /// near nodes: what linear systems are solved with before `displacement_single` tells how well. The
    /// half-space takes the shortest way between two nodes round a periodic grid, at a quarter of the cost.
    /// By default `displacement_single`.
    ///
    /// # Errors
    /// [`InputError::Shape`] when a slice does not fit the grid.
    fn displacement_periodic(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.displacement_single(pressure, out)
    }

    /// Overwrites `out` \[Pa\] with an estimate of the pressure that causes `displacement` \[m\]: the
    /// preconditioner of contact equations. It must be linear, to about 1e-6, and positive; the better it
    /// inverts the displacement, the fewer iterations a solve takes.
    ///
    /// # Errors
    /// [`InputError::Shape`] when a slice does not fit the grid.
    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError>;

    /// From now on `pressure_estimate` is that of bodies whose nodes give way each by `compliance` \[m/Pa\] times
    /// its pressure too, of the bodies alone where that is zero. By default it stays that of the bodies alone,
    /// which costs iterations.
    fn soften(&mut self, _compliance: f64) {}
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

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        (**self).approximations()
    }
}

/// What solvers ask of a model, approximations or not.
impl dyn DeformationModel + '_ {
    /// The displacement in single precision, or the exact one.
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

    /// The displacement to some per cent, or the exact one.
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

    /// The estimated pressure, or the displacement over the self-influence.
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

/// The largest offset, along x or y, at which solvers ask for [`DeformationModel::influence`].
pub const NEAR: usize = 5;
