//! Files of a simulation: run folders, checkpoints, archives of fields.

#[cfg(feature = "serde")]
pub(in crate::sim) mod atomic_file;
#[cfg(feature = "serde")]
pub(in crate::sim) mod checkpoint;
#[cfg(feature = "serde")]
mod checkpoint_content;
#[cfg(feature = "npz")]
pub(in crate::sim) mod npz;
#[cfg(all(feature = "serde", feature = "npz"))]
pub(in crate::sim) mod run_folder;
#[cfg(all(feature = "formats", feature = "npz"))]
pub(in crate::sim) mod start_file;
#[cfg(feature = "vtk")]
pub(in crate::sim) mod vtk;
