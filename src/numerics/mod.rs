//! Numerical tools shared by the rooms above: convolution on the doubled grid, periodic transforms, sparse
//! LU, tridiagonal elimination, GMRES, vectors.
//!
//! All of it is private and knows nothing of contacts: fields are row-major slices, `k = j nx + i`, and only
//! the rooms above give them units.
//!
//! | look for | in |
//! |---|---|
//! | displacements `u = K p` of a field of pressures | `convolution`, its kernels in `spectrum` |
//! | spectra of periodic complex and real fields | `fft`, `real_fft` |
//! | the factorised part of Newton's preconditioner | `grid_lu` |
//! | systems of a line, of given films and of the paper's sweeps | `tridiagonal` |
//! | the linear solve of a Newton step | `gmres` |
//! | what runs on several threads | `lanes` |
//!
//! Callers check lengths; here they are taken for granted. Results do not depend on the number of threads:
//! these share lines, never a sum.

mod convolution;
mod fft;
mod gmres;
mod grid_lu;
mod lanes;
mod real_fft;
mod spectrum;
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
