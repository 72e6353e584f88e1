//! Conformance of laws, models and solvers to the contracts of their traits, for tests of custom
//! implementations (feature `testing`).
//!
//! Each function probes one implementation over a wide range of arguments and returns the first
//! [`Violation`]. A pass is necessary, not sufficient: a law can satisfy its contract and still be wrong.
//!
//! | function | checks |
//! |---|---|
//! | [`film_growth_law`] | finite rates, bounds, frozen inactive nodes, rate = derivative, any division of the time step |
//! | [`wear_law`] | finite, non-negative, zero without sliding or load, monotone in both |
//! | [`boundary_friction`] | finite, non-negative, a function of the arguments alone |
//! | [`viscosity_law`] | finite, positive, monotone, slope = derivative, negative pressures |
//! | [`density_law`] | 1 at ambient pressure, monotone, slope = derivative, negative pressures |
//! | [`plasticity_model`] | positive limits that do not decrease with depth, the smaller limit for a pair |
//! | [`deformation_model`] | linear, symmetric, translation invariant, positive; errors of shape |
//! | [`roughness_motion`] | fractions within a column, offsets by arguments alone, constant offset of fixed bodies |
//! | [`contact_solver`] | a smooth contact: load, bounds, residuals, restart; invalid input rejected |
//!
//! Strategies for proptest: [`scenes`], [`absurd_scenes`] and [`pressures`]. [`StencilLu`] is the sparse
//! factorization of Newton's preconditioner, [`newton_by`] takes another one in its place: for comparisons.

mod absurd;
mod boundary_friction;
mod contact_solver;
mod deformation;
mod film_growth;
mod fluid;
mod motion;
mod plasticity;
mod stencil_lu;
mod strategies;
mod wear;

use std::fmt::Debug;

pub use absurd::absurd_scenes;
pub use boundary_friction::boundary_friction;
pub use contact_solver::contact_solver;
pub use deformation::deformation_model;
pub use film_growth::film_growth_law;
pub use fluid::{density_law, viscosity_law};
pub use motion::roughness_motion;
pub use plasticity::plasticity_model;
pub use stencil_lu::{StencilFactorization, StencilLu, newton_by};
pub use strategies::{pressures, scenes};
use thiserror::Error;
pub use wear::wear_law;

use crate::surface_state::SurfaceState;

/// The first violated clause of a contract.
///
/// # Examples
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::wear::WearLaw;
/// /// Wears at rest, which violates the contract.
/// #[derive(Debug)]
/// struct Rusting;
/// impl WearLaw for Rusting {
///     fn depth_rate(&self, _at: &SurfaceState, _film_thickness: f64) -> f64 {
///         1e-12
///     }
/// }
/// let violation = stribeck::testing::wear_law(&Rusting).unwrap_err();
/// assert_eq!((violation.subject.as_str(), violation.clause), ("Rusting", "the rate is zero at rest"));
/// ```
#[derive(Debug, Clone, PartialEq, Error)]
#[error("{subject}: {clause}: {finding}")]
#[non_exhaustive]
pub struct Violation {
    /// The implementation, as `Debug` prints it.
    pub subject: String,
    /// The required property.
    pub clause: &'static str,
    /// The observed value with its arguments.
    pub finding: String,
}

/// Reports violations of one implementation.
struct Contract {
    subject: String,
}

impl Contract {
    /// Contract of the implementation with the `Debug` output of `subject`.
    fn of(subject: &(impl Debug + ?Sized)) -> Self {
        Self { subject: format!("{subject:?}") }
    }

    /// A violation of `clause` unless it `holds`; `finding` is evaluated only then.
    fn require(
        &self,
        holds: bool,
        clause: &'static str,
        finding: impl FnOnce() -> String,
    ) -> Result<(), Violation> {
        if holds { Ok(()) } else { Err(self.broken(clause, finding())) }
    }

    /// A violation of `clause`.
    fn broken(&self, clause: &'static str, finding: String) -> Violation {
        Violation { subject: self.subject.clone(), clause, finding }
    }
}

/// Equal to the tolerance, relative to `scale`; false for numbers that are not finite.
fn close(a: f64, b: f64, scale: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * scale.abs()
}

/// Bit-identical, including infinities; false for NaN.
fn same(a: f64, b: f64) -> bool {
    a <= b && b <= a
}

/// A node in boundary lubrication, 1 GPa at 80 C.
const IN_CONTACT: SurfaceState = SurfaceState {
    pressure: 1e9,
    solid_pressure: 1e9,
    shear_stress: 1.15e8,
    temperature: 353.15,
    sliding_speed: 0.005,
    gap: 1e-9,
    in_contact: true,
};

/// A node without contact, pressure or shear.
const IDLE: SurfaceState = SurfaceState {
    pressure: 0.0,
    solid_pressure: 0.0,
    shear_stress: 0.0,
    temperature: 353.15,
    sliding_speed: 0.005,
    gap: 1e-6,
    in_contact: false,
};

/// Nodes from idle to far beyond any contact.
fn surface_states() -> [SurfaceState; 9] {
    [
        IDLE,
        IN_CONTACT,
        SurfaceState { temperature: 293.15, ..IN_CONTACT },
        SurfaceState { temperature: 473.15, ..IN_CONTACT },
        SurfaceState { pressure: 6e9, solid_pressure: 6e9, shear_stress: 6.9e8, ..IN_CONTACT },
        SurfaceState { solid_pressure: 0.0, shear_stress: 1e7, gap: 50e-9, in_contact: false, ..IN_CONTACT },
        SurfaceState { sliding_speed: 10.0, ..IN_CONTACT },
        SurfaceState { temperature: 0.0, ..IN_CONTACT },
        SurfaceState {
            pressure: 1e12,
            solid_pressure: 1e12,
            shear_stress: 1e12,
            temperature: 1e4,
            sliding_speed: 1e3,
            ..IN_CONTACT
        },
    ]
}
