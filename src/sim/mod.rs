//! The reference simulation: a rough lubricated contact through time.
//!
//! A [`Scene`] describes it, [`solve_contact`] solves its single contact, [`MixedLubricationSim`] runs its
//! history. Every law can be replaced through the [builder](SimBuilder); an [`Observer`] sees every step.
//!
//! ```text
//! Scene ── SimBuilder ──┬── solve ──> ContactSolution: one contact, surfaces as they are
//!                       └── build ──> MixedLubricationSim ── step ──> StepRecord, Observer
//! ```
//!
//! | look for | in |
//! |---|---|
//! | what a scene file holds | [`scene`] |
//! | one step of a history and its order | [`MixedLubricationSim`] |
//! | steps as long as wear allows, many steps | [`StepControl`], [`MixedLubricationSim::run_until`] |
//! | the numbers of a step and of a contact | [`StepRecord`], [`ContactSolution`] |
//! | bodies that have been through another run | [`BodyStart`] |
//! | many histories side by side | [`ensemble`] |
//! | how far the mesh is from the limit | [`ErrorEstimate`] |
//!
//! Errors are [`SimError`]; what is unlikely to be meant, but can be computed, is a [`Warning`]. It rests on
//! all other rooms and none of them knows of it. All numbers are SI, all fields row-major slices over
//! [`Scene::grid`].

mod contact;
pub mod ensemble;
mod error;
mod files;
mod history;
pub mod scene;
mod single_contact;

pub use contact::error_estimate::ErrorEstimate;
pub use contact::far_field::FloodedInlet;
pub use contact::formula::FormulaFilm;
pub use contact::numbers::{
    ContactNumbers, DepthNumbers, FilmNumbers, FrictionNumbers, Moes, PlasticNumbers, PressureNumbers,
    RoughnessNumbers, StressNumbers, ThermalNumbers, WearNumbers,
};
pub use contact::solution::ContactSolution;
pub use contact::warnings::{Warning, given_film_warnings};
#[cfg(feature = "serde")]
pub use error::CheckpointError;
pub use error::{BoxTooSmall, EdgeQuantity, SimError};
#[cfg(feature = "npz")]
pub use files::npz::write_npz;
#[cfg(all(feature = "serde", feature = "npz"))]
pub use files::run_folder::RunFolder;
#[cfg(feature = "vtk")]
pub use files::vtk::write_vtk;
pub use history::body::Body;
pub use history::builder::SimBuilder;
pub use history::history_means::HistoryMeans;
#[cfg(feature = "serde")]
pub use history::history_means::HistoryNumbers;
pub use history::observer::Observer;
pub use history::record::StepRecord;
pub use history::runs::RunEnd;
pub use history::simulation::MixedLubricationSim;
pub use history::start::BodyStart;
pub use history::step_control::StepControl;
pub use scene::hertz::HertzContact;
pub use scene::operating_schedule::Conditions;
pub use scene::{Scene, Schedule};
pub use single_contact::expectation::{Expectation, ExpectedFilm};
pub use single_contact::solve_contact;
