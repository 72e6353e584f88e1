//! Closed-form solutions: what the numerical models are checked against, and the scales of a contact.
//!
//! [`HertzPoint`] is the dry smooth contact of two curved bodies (circular or elliptical), [`FilmConditions`] the
//! film formulas fitted to full numerical solutions, [`Westergaard`] the dry contact of a wavy surface and
//! [`rectangle_potential`] the integral of 1/r over a rectangle, from which the displacement of a uniformly
//! loaded cell follows. All of it is plain arithmetic on numbers: nothing here knows a grid or a solver.

mod film_formulas;
mod hertz;
mod love;
mod westergaard;

pub use film_formulas::FilmConditions;
pub use hertz::{HertzPoint, equivalent_modulus};
pub use love::{rectangle_displacement, rectangle_potential};
pub use westergaard::Westergaard;
