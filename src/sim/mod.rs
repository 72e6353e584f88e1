//! The reference simulation: a rough lubricated contact through time.
//!
//! A [`Scene`] describes it, [`solve_contact`] solves its single contact, [`MixedLubricationSim`] runs its history.
//! Every law can be replaced through the [builder](SimBuilder); an [`Observer`] sees every step.

mod accuracy;
mod body;
mod builder;
mod contact;
mod error;
mod friction;
mod hertz;
#[cfg(feature = "npz")]
mod npz;
mod observer;
mod record;
pub mod scene;
mod setup;
mod simulation;
mod step_control;
mod yielding;

pub use accuracy::ErrorEstimate;
pub use body::Body;
pub use builder::SimBuilder;
pub use contact::{ContactNumbers, ContactSolution, FilmNumbers, solve_contact};
pub use error::SimError;
pub use hertz::HertzContact;
#[cfg(feature = "npz")]
pub use npz::write_npz;
pub use observer::Observer;
pub use record::StepRecord;
pub use scene::Scene;
pub use simulation::{MixedLubricationSim, RunEnd};
pub use step_control::StepControl;
