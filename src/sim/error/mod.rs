//! Errors of the simulation.

mod box_too_small;
#[cfg(feature = "serde")]
mod checkpoint;

use std::path::PathBuf;

use thiserror::Error;

pub use self::box_too_small::{BoxTooSmall, EdgeQuantity};
#[cfg(feature = "serde")]
pub use self::checkpoint::CheckpointError;

use crate::error::InputError;
use crate::report::NotConverged;
use crate::reynolds::ReynoldsError;
use crate::surface::SurfaceError;

/// Error of building a scene or taking a step. It leaves the state of a simulation unchanged.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene, SimError};
/// let mut scene = Scene::azam_2019(32);
/// scene.motion.entrainment_speed = -1.0;
/// let error = MixedLubricationSim::builder(scene).build().unwrap_err();
/// assert!(matches!(error, SimError::Input(_)));
/// assert!(error.to_string().starts_with("motion.entrainment_speed = -1"));
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SimError {
    /// A value out of range, a shape that does not fit, or a contradiction.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A solver does not accept the problem.
    #[error(transparent)]
    Reynolds(#[from] ReynoldsError),
    /// A surface could not be read or prepared.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// A contact did not converge.
    #[error("the contact of step {step} was not solved at {attempts} positions of the roughness: {source}")]
    NotConverged {
        /// Number of the step, from 0.
        step: u64,
        /// Positions that were tried.
        attempts: u32,
        /// The last attempt.
        source: NotConverged,
    },
    /// Solids, wear or a tribofilm reach the edge of the box.
    #[error(transparent)]
    BoxTooSmall(#[from] BoxTooSmall),
    /// The solve was interrupted ([`SimBuilder::interrupt`](crate::sim::SimBuilder::interrupt)).
    #[error("the solve was interrupted")]
    Interrupted,
    /// A checkpoint could not be used.
    #[cfg(feature = "serde")]
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// A member of an ensemble failed on a rank of an MPI program.
    #[cfg(feature = "mpi")]
    #[error("{reason}")]
    Remote {
        /// The rank.
        rank: i32,
        /// Message of the error.
        reason: String,
    },
    /// A scene file that is not valid.
    #[error("{reason}")]
    Scene {
        /// Message of the parser, with key and line.
        reason: String,
    },
    /// A file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: std::io::Error,
    },
}
