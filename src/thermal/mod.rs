//! Heat in the lubricant film: what shear and compression make of it, what surfaces and flow carry off, and
//! how warm the film becomes.
//!
//! [`FilmSection`] is the film at one place: its temperature across the thickness, the shear stress and the
//! viscosity that go with it, by either of two algorithms ([`FilmProfile`]). [`FilmTemperature`] is the field
//! of a contact: sections that the flow and the surfaces connect.

mod collocation;
mod field;
mod properties;
mod section;
mod streams;

pub use field::{FilmFlow, FilmTemperature, HeatBalance};
pub use properties::FilmThermal;
pub use section::{FilmHeat, FilmProfile, FilmSection, SectionSolver};
