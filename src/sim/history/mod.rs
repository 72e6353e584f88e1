//! Histories: bodies that yield, wear and grow tribofilms, with one contact solve per step.
//!
//! ```text
//! builder ──> simulation: placement ──> contact ──> passage (flatten, wear, grow) ──> record
//! ```

pub(in crate::sim) mod accessors;
pub(in crate::sim) mod body;
mod build;
pub(in crate::sim) mod builder;
pub(in crate::sim) mod columns;
pub(in crate::sim) mod contact_exposure;
pub(in crate::sim) mod custom_parts;
pub(in crate::sim) mod exposure;
pub(in crate::sim) mod half_mesh;
pub(in crate::sim) mod heat;
pub(in crate::sim) mod history_means;
#[cfg(feature = "serde")]
pub(in crate::sim) mod identity;
mod means_table;
pub(in crate::sim) mod observer;
mod parts;
pub(in crate::sim) mod placement;
pub(in crate::sim) mod record;
mod record_csv;
pub(in crate::sim) mod runs;
pub(in crate::sim) mod simulation;
#[cfg(feature = "serde")]
mod simulation_identity;
pub(in crate::sim) mod squeeze_memory;
pub(in crate::sim) mod start;
mod step_commit;
pub(in crate::sim) mod step_control;
mod step_record;
mod step_solve;
mod step_warnings;
pub(in crate::sim) mod track;
pub(in crate::sim) mod wider_box;
mod worn_form;
pub(in crate::sim) mod yielding;
