//! Closed-form solutions: references for the numerical models, and the scales of a contact.
//!
//! [`HertzPoint`] is the dry smooth contact of two curved bodies (circular or elliptical), [`HertzLine`] that
//! of parallel cylinders. [`FilmConditions`] and [`LineFilmConditions`] are film formulas fitted to full
//! numerical solutions, [`FilmMap`] the regime of a contact and its film, [`MixedLoadShare`] the share of the
//! load on solids. [`GreenwoodTripp`] is the mean contact of asperities, [`PatirCheng`] the mean flow between them. [`Westergaard`] is the dry contact of a wavy surface. [`rectangle_potential`] is the
//! integral of 1/r over a rectangle and [`strip_potential`] that of a logarithm over a strip, the
//! displacements of uniformly loaded cells. [`ThermalInlet`] and [`ShearedLayer`] give the heat of inlets and
//! of a sheared film. The module is plain arithmetic, without grids or solvers.

mod asymptotes;
mod film_formulas;
mod film_heat;
mod film_regimes;
mod greenwood_tripp;
mod hertz;
mod hertz_line;
mod line_film_formulas;
mod load_share;
mod love;
mod patir_cheng;
mod rigid_paraboloids;
mod strip;
mod westergaard;

pub use film_formulas::FilmConditions;
pub use film_heat::{ShearedLayer, ThermalInlet};
pub use film_regimes::{FilmMap, FilmRegime};
pub use greenwood_tripp::{GreenwoodTripp, asperity_moment};
pub use hertz::{HertzPoint, equivalent_modulus};
pub use hertz_line::HertzLine;
pub use line_film_formulas::LineFilmConditions;
pub use load_share::MixedLoadShare;
pub use love::{rectangle_displacement, rectangle_potential};
pub use patir_cheng::PatirCheng;
pub use rigid_paraboloids::RigidParaboloids;
pub use strip::{strip_displacement, strip_potential};
pub use westergaard::Westergaard;
