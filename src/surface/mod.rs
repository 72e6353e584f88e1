//! Surfaces: form of the bodies, roughness, and motion of the roughness.
//!
//! | type | role |
//! |---|---|
//! | [`Form`] | undeformed gap of the smooth bodies |
//! | [`RoughnessSpec`], [`generate`] | random roughness of a given height and correlation length |
//! | [`RandomSurface`] | the same with more choice: self-affine, skewed, open, ensemble height |
//! | [`Texture`] | dimples and grooves |
//! | [`Heights`] | a measured surface: removal of form, filters, filling of holes, transfer to a grid |
//! | `read`, `read_with`, `read_bytes` (feature `formats`) | instrument files: x3p, sur, sdf, prf, plu, al3d, npy, text |
//! | `write_x3p`, `write_npy`, `write_text` (feature `formats`) | lossless output files |
//! | [`RoughnessMotion`] | position of periodic roughness from step to step: [`AlongTrack`], [`RandomShift`], [`Advected`], [`Fixed`] |
//! | [`FourierShift`] | shift by less than a cell |
//!
//! Heights are in metres and point out of the body: a positive height narrows the gap.

mod amplitudes;
mod arrangement;
mod autocorrelation;
mod deviates;
mod error;
mod form;
mod form_removal;
#[cfg(feature = "formats")]
mod format;
mod fourier_resampling;
mod gaussian_filter;
mod generate;
mod johnson;
mod measured;
mod motion;
mod on_grid;
mod patch;
mod random;
mod random_shape;
mod resample;
mod rescale;
mod roughness_motion;
mod roughness_spec;
mod round_form;
mod self_affine;
mod short_waves;
mod subcell;
mod texture;

pub use autocorrelation::Autocorrelation;
pub use error::SurfaceError;
pub use form::Form;
#[cfg(feature = "formats")]
pub use format::{ReadOptions, read, read_bytes, read_with, write_npy, write_text, write_x3p};
pub(crate) use fourier_resampling::series_at_nodes;
pub use generate::generate;
pub use measured::Heights;
pub use motion::Offset;
pub(crate) use motion::{add_blended, copy_shifted};
pub use random::{HeightDistribution, HeightScale, RandomSurface};
pub use random_shape::RandomShape;
#[cfg(feature = "formats")]
pub(crate) use rescale::rescale;
pub use roughness_motion::{Advected, AlongTrack, Fixed, PointRevisit, RandomShift, RoughnessMotion};
pub use roughness_spec::RoughnessSpec;
pub use self_affine::{SelfAffine, Synthesis};
pub use subcell::FourierShift;
pub(crate) use subcell::blend_shifted;
#[cfg(feature = "formats")]
pub use surface_formats::{Error as FileError, LengthUnit};
pub use texture::{DimpleLayout, GrooveDirection, Texture};
