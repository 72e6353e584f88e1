//! The reference simulation: a rough lubricated contact over time.
//!
//! A [`Scene`] describes the contact, [`solve_contact`] solves it once, [`MixedLubricationSim`] runs its
//! history. Every law can be replaced through the [builder](SimBuilder); an [`Observer`] is called after
//! every step.
//!
//! ```text
//! Scene ── SimBuilder ──┬── solve ──> ContactSolution: one contact, surfaces as they are
//!                       └── build ──> MixedLubricationSim ── step ──> StepRecord, Observer
//! ```
//!
//! | topic | item |
//! |---|---|
//! | contents of a scene file | [`scene`] |
//! | a scene file of any kind | `SceneFile` |
//! | one step of a history and its order | [`MixedLubricationSim`] |
//! | step control, many steps | [`StepControl`], [`MixedLubricationSim::run_until`] |
//! | results of a step and of a contact | [`StepRecord`], [`ContactSolution`] |
//! | bodies from an earlier run | [`BodyStart`] |
//! | ensembles of histories | [`ensemble`] |
//! | error of the mesh | [`ErrorEstimate`] |
//! | rigid bearings of scene files | `RigidBearing` |
//! | dry contact of flat rough surfaces | `FlatContact` |
//!
//! Errors are [`SimError`]; implausible input that can still be computed is a [`Warning`]. `sim` imports all
//! other modules, and none of them imports `sim`. All values are in SI units, all fields row-major slices over
//! [`Scene::grid`].

mod contact;
mod cycle;
pub mod ensemble;
mod error;
mod files;
#[cfg(feature = "serde")]
mod flat_contact;
mod history;
mod passage;
#[cfg(feature = "serde")]
mod rigid_bearing;
pub mod scene;
#[cfg(feature = "serde")]
mod scene_file;
mod single_contact;

#[cfg(feature = "benchmark")]
use crate::error::InputError;
#[cfg(feature = "benchmark")]
use crate::reynolds::ContactSolver;

pub use contact::error_estimate::ErrorEstimate;
pub use contact::far_field::FloodedInlet;
pub use contact::formula::{FilmFormula, FormulaFilm};
pub use contact::numbers::{
    ContactNumbers, DepthNumbers, FilmNumbers, FrictionNumbers, Moes, PlasticNumbers, PressureNumbers,
    RoughnessNumbers, StarvationNumbers, StressNumbers, ThermalNumbers, WearNumbers,
};
pub use contact::oil_numbers::OilNumbers;
pub use contact::solution::ContactSolution;
pub use contact::warnings::{Warning, given_film_warnings};
pub use cycle::{CycleEnd, CycleExtremes, CyclePoint, CycleRecord, CycleRowScene, CycleSolution};
#[cfg(feature = "serde")]
pub use error::CheckpointError;
pub use error::{BoxTooSmall, EdgeQuantity, SimError};
#[cfg(feature = "npz")]
pub use files::npz::write_npz;
#[cfg(all(feature = "serde", feature = "npz"))]
pub use files::run_folder::RunFolder;
#[cfg(feature = "vtk")]
pub use files::vtk::write_vtk;
#[cfg(feature = "serde")]
pub use flat_contact::{FlatContact, FlatContactNumbers, FlatContactSolution, FlatLoad};
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
pub use passage::{PassageNumbers, PassageSolution, Scatter};
#[cfg(feature = "serde")]
pub use rigid_bearing::{BearingNumbers, BearingSolution, RigidBearing};
pub use scene::hertz::HertzContact;
pub use scene::operating_schedule::Conditions;
pub use scene::{Scene, Schedule};
#[cfg(feature = "serde")]
pub use scene_file::SceneFile;
pub use single_contact::expectation::{Expectation, ExpectedFilm};
pub use single_contact::many_conditions::SingleContact;
pub use single_contact::solve_contact;

/// The solver that `scene` names.
#[cfg(feature = "benchmark")]
pub(crate) fn solver_of(scene: &Scene) -> Result<Box<dyn ContactSolver>, InputError> {
    contact::setup::solver(scene).map(|solver| solver as Box<dyn ContactSolver>)
}
