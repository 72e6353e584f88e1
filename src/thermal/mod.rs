//! Thermal lubrication: heat sources in the film, conduction to the surfaces, advection, and the film
//! temperature.
//!
//! [`FilmSection`] is the film at one node: temperature across the thickness, shear stress and viscosity, by
//! one of two algorithms ([`FilmProfile`]). [`FilmTemperature`] is the temperature field of a contact:
//! sections coupled by flow and surfaces.

mod advection;
mod collocation;
mod field;
mod film_flow;
mod film_section;
mod layers;
mod properties;
mod section;
mod velocity;

pub use advection::LayerAdvection;
pub use field::FilmTemperature;
pub use film_flow::{FilmFlow, HeatBalance};
pub use film_section::{FilmHeat, FilmProfile, FilmSection};
pub use properties::FilmThermal;
pub use section::SectionSolver;
