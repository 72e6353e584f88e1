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

mod accuracy;
mod asked;
mod body;
mod builder;
#[cfg(feature = "serde")]
mod checkpoint;
mod columns;
mod compliant_films;
mod contact;
mod course;
pub mod ensemble;
mod error;
mod expectation;
mod exposure;
mod far_field;
mod film_heat;
mod formula;
mod friction;
mod heat;
mod heating;
mod hertz;
mod history_means;
#[cfg(feature = "serde")]
mod identity;
mod interrupt;
mod laws;
mod memory;
mod mixing;
#[cfg(feature = "npz")]
mod npz;
mod numbers;
mod observer;
mod outer_rows;
mod own_laws;
mod owned;
mod passage;
mod per_body;
mod placement;
mod record;
#[cfg(all(feature = "serde", feature = "npz"))]
mod run_folder;
mod runs;
pub mod scene;
mod setup;
mod simulation;
mod single;
mod solution;
mod solution_numbers;
mod squeeze_memory;
mod standing;
mod start;
#[cfg(all(feature = "formats", feature = "npz"))]
mod start_file;
mod step_control;
mod timetable;
mod track;
#[cfg(feature = "vtk")]
mod vtk;
mod warnings;
#[cfg(feature = "serde")]
mod whole_file;
mod wider_box;
mod yielding;

pub use accuracy::ErrorEstimate;
pub use body::Body;
pub use builder::SimBuilder;
#[cfg(feature = "serde")]
pub use checkpoint::CheckpointError;
pub use contact::solve_contact;
pub use error::SimError;
pub use expectation::{Expectation, ExpectedFilm};
pub use far_field::FloodedInlet;
pub use formula::FormulaFilm;
pub use hertz::HertzContact;
pub use history_means::HistoryMeans;
#[cfg(feature = "serde")]
pub use history_means::HistoryNumbers;
#[cfg(feature = "npz")]
pub use npz::write_npz;
pub use numbers::{
    ContactNumbers, DepthNumbers, FilmNumbers, FrictionNumbers, Moes, PlasticNumbers, PressureNumbers,
    RoughnessNumbers, StressNumbers, ThermalNumbers, WearNumbers,
};
pub use observer::Observer;
pub use outer_rows::{BoxTooSmall, EdgeQuantity};
pub use record::StepRecord;
#[cfg(all(feature = "serde", feature = "npz"))]
pub use run_folder::RunFolder;
pub use runs::RunEnd;
pub use scene::{Scene, Schedule};
pub use simulation::MixedLubricationSim;
pub use solution::ContactSolution;
pub use start::BodyStart;
pub use step_control::StepControl;
pub use timetable::Conditions;
#[cfg(feature = "vtk")]
pub use vtk::write_vtk;
pub use warnings::{Warning, given_film_warnings};
