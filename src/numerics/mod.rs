//! Numerical tools shared by the rooms above: convolution on the doubled grid, periodic transforms, sparse
//! LU, tridiagonal elimination, GMRES, vectors.

mod convolution;
mod fft;
mod gmres;
mod grid_lu;
mod lanes;
mod real_fft;
mod transpose;
mod tridiagonal;
mod vectors;

pub(crate) use convolution::{Convolution, ConvolutionPlan, fast_length};
pub(crate) use fft::Fft2;
pub(crate) use gmres::{Gmres, PreconditionedOperator};
pub(crate) use grid_lu::{GridLu, STENCIL};
pub(crate) use lanes::{both, map_lines};
pub(crate) use real_fft::RealFft2;
pub(crate) use tridiagonal::solve_tridiagonal;
pub(crate) use vectors::{add_scaled, dot};
