//! Checkpoints that cannot be written or used.

use std::path::PathBuf;

use thiserror::Error;

/// Why a checkpoint could not be written or used.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{CheckpointError, MixedLubricationSim, Scene};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// let mut bytes = sim.checkpoint()?;
/// if let Some(last) = bytes.last_mut() {
///     *last ^= 1;
/// }
/// let error = sim.restore_checkpoint(&bytes).unwrap_err();
/// assert!(matches!(error, CheckpointError::Damaged { .. }));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is no checkpoint.
    #[error("{} is no checkpoint", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// A later version of the crate has written the file.
    #[error("{} has format {found}, this version reads formats up to {known}", path.display())]
    Newer {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u32,
        /// The latest format that can be read.
        known: u32,
    },
    /// The file is cut short or its content has changed.
    #[error("{} is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// How that shows.
        reason: String,
    },
    /// The file belongs to another simulation.
    #[error(
        "{} belongs to another run: {part} differs; take scene, laws and heights of that run, or begin another one",
        path.display()
    )]
    Other {
        /// The file.
        path: PathBuf,
        /// What differs.
        part: String,
    },
}
