//! stribeck
#![forbid(unsafe_code)]

pub mod analytic;
pub mod elastic;
mod error;
mod grid;
pub mod lubricant;
pub mod metrics;
mod numerics;
pub mod plastic;
mod report;
pub mod reynolds;
mod rubbing;
pub mod sim;
pub mod surface;
pub mod tribochem;
pub mod wear;

pub use error::InputError;
pub use grid::Grid;
pub use report::{NotConverged, Residuals, SolveReport, Status, Work};
pub use rubbing::RubbingPoint;
