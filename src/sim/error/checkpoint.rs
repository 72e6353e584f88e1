//! Errors of checkpoints.

use std::path::PathBuf;

use thiserror::Error;

/// Error of writing or restoring a checkpoint.
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
        /// Error of the operating system.
        source: std::io::Error,
    },
    /// The file is not a checkpoint.
    #[error("{} is no checkpoint", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// The file was written by a later version of the crate.
    #[error("{} has format {found}, this version reads formats up to {known}", path.display())]
    Newer {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u32,
        /// The latest format that can be read.
        known: u32,
    },
    /// The file is truncated or its content has changed.
    #[error("{} is damaged: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The damage found.
        reason: String,
    },
    /// The file belongs to another simulation.
    #[error(
        "{} belongs to another run: {part} differs{}; take scene, laws and heights of that run, or begin another one",
        path.display(), if detail.is_empty() { String::new() } else { format!(" ({detail})") }
    )]
    Other {
        /// The file.
        path: PathBuf,
        /// Names of the parts that differ.
        part: String,
        /// Values of laws that differ, here and in the file; empty for other parts.
        detail: String,
    },
}
