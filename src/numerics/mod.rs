//! Numerical tools shared by the rooms above: convolution on the doubled grid, sparse LU, GMRES.

mod convolution;
mod gmres;
mod grid_lu;

pub(crate) use convolution::{Convolution, ConvolutionPlan};
pub(crate) use gmres::{Gmres, PreconditionedOperator};
pub(crate) use grid_lu::{GridLu, STENCIL};
