//! One quasi-static contact: its parts, its solve with film temperature and flooded inlet, its results and warnings.
//!
//! ```text
//! setup, laws ──> model ──> film_heat ──> solution: numbers, warnings
//!                  └── far_field: pressures at the edges of the box
//! ```

pub(in crate::sim) mod asperity_inlets;
pub(in crate::sim) mod boxed_clone;
pub(in crate::sim) mod compliant_films;
pub(in crate::sim) mod components;
pub(in crate::sim) mod conditions;
pub(in crate::sim) mod custom_laws;
pub(in crate::sim) mod error_estimate;
pub(in crate::sim) mod far_field;
pub(in crate::sim) mod film_heat;
pub(in crate::sim) mod film_temperature;
mod flooding;
pub(in crate::sim) mod formula;
pub(in crate::sim) mod friction;
pub(in crate::sim) mod friction_laws;
pub(in crate::sim) mod heating;
pub(in crate::sim) mod interrupt;
pub(in crate::sim) mod laws;
pub(in crate::sim) mod memory;
pub(in crate::sim) mod mesh_error;
pub(in crate::sim) mod mixing;
pub(in crate::sim) mod model;
mod model_range;
pub(in crate::sim) mod numbers;
pub(in crate::sim) mod oil;
pub(in crate::sim) mod oil_numbers;
pub(in crate::sim) mod outer_rows;
pub(in crate::sim) mod per_body;
pub(in crate::sim) mod setup;
pub(in crate::sim) mod short_roughness;
pub(in crate::sim) mod solution;
pub(in crate::sim) mod solution_numbers;
pub(in crate::sim) mod strip;
pub(in crate::sim) mod warnings;
