//! Surfaces: the shape of the bodies, their roughness, and where the roughness is while they move.
//!
//! | type | role |
//! |---|---|
//! | [`Form`] | undeformed gap of the smooth bodies |
//! | [`RoughnessSpec`], [`generate`] | random roughness of a given height and correlation length |
//! | [`Heights`] | a measured surface: levelling, filling of holes, transfer to a grid |
//! | `read`, `write_npy` (feature `formats`) | x3p and npy files |
//! | [`RoughnessMotion`], [`FourierShift`] | shift of periodic roughness from step to step, by less than a cell too |
//!
//! Heights are in metres and point out of the body: a positive height narrows the gap.

mod error;
mod fft;
mod form;
mod generate;
mod measured;
mod motion;
#[cfg(feature = "formats")]
mod npy;
#[cfg(feature = "formats")]
mod number;
#[cfg(feature = "formats")]
mod read;
mod resample;
mod subcell;
#[cfg(feature = "formats")]
mod x3p;

pub use error::SurfaceError;
pub use form::Form;
pub use generate::{Autocorrelation, RoughnessSpec, generate};
pub use measured::Heights;
pub use motion::{Offset, RoughnessMotion, add_blended, copy_shifted};
#[cfg(feature = "formats")]
pub use npy::write_npy;
#[cfg(feature = "formats")]
pub use read::read;
pub use subcell::{FourierShift, blend_shifted};
