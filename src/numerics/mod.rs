//! Numerical algorithms of the modules above: zero-padded convolution, periodic transforms, sparse LU,
//! tridiagonal elimination, GMRES, vectors.
//!
//! The module is private and independent of contact mechanics. Fields are row-major slices without units,
//! `k = j nx + i`.
//!
//! | topic | module |
//! |---|---|
//! | displacements `u = K p` of a field of pressures | `convolution`, its kernels in `spectrum` |
//! | spectra of periodic complex and real fields | `fft`, `real_fft` |
//! | the factorized part of Newton's preconditioner | `grid_lu` |
//! | tridiagonal systems of lines, prescribed films and the unified Reynolds model | `tridiagonal` |
//! | the linear solve of a Newton step | `gmres` |
//! | small dense systems | `least_squares` |
//! | roots of one variable | `false_position` |
//! | multithreading | `parallel` |
//!
//! Callers check lengths. Results are bit-identical for any number of threads: threads share lines, no sum is
//! split.

mod convolution;
mod false_position;
mod fft;
mod gmres;
mod grid_lu;
mod least_squares;
mod lines;
mod parallel;
mod precision;
mod real_fft;
mod spectrum;
#[cfg(feature = "parallel")]
mod threads;
mod transpose;
mod tridiagonal;
mod vectors;

pub(crate) use convolution::{Convolution, ConvolutionPlan, fast_length};
pub(crate) use false_position::FalsePosition;
pub(crate) use fft::Fft2;
pub(crate) use gmres::{Gmres, PreconditionedOperator};
pub(crate) use grid_lu::{GridLu, Neighbors, Periodicity, STENCIL};
pub(crate) use least_squares::least_squares;
pub(crate) use lines::{FieldLines, for_each_range, for_each_with, map_lines, map_nodes};
pub(crate) use parallel::{chunk_count, join};
pub(crate) use real_fft::RealFft2;
#[cfg(feature = "parallel")]
pub use threads::set_num_threads;
pub(crate) use tridiagonal::solve_tridiagonal;
pub(crate) use vectors::{add_scaled, dot};
