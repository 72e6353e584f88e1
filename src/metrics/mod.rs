//! Numbers that describe surfaces, films and contacts: pure functions of field slices and a [`Grid`](crate::Grid).
//!
//! | file | what |
//! |---|---|
//! | roughness | [`height_statistics`], [`composite_rq`] |
//! | bearing | [`BearingCurve`], [`CoreParameters`], [`VolumeParameters`] (ISO 25178-2) |
//! | film | [`average_central_film`], [`minimum_film`], [`minimum_gap`], [`lambda_ratio`] |
//! | contact | [`contact_statistics`], [`peak`] |
//! | friction | [`viscous_shear_into`], [`friction_coefficient`] |
//!
//! Nothing here knows a solver: the fields may come from a simulation, a file or a measurement.

mod bearing;
mod contact;
mod film;
mod friction;
mod peak;
mod roughness;

pub use bearing::{BearingCurve, CoreParameters, VolumeParameters};
pub use contact::{ContactStatistics, contact_statistics};
pub use film::{average_central_film, lambda_ratio, minimum_film, minimum_gap};
pub use friction::{friction_coefficient, viscous_shear_into};
pub use peak::peak;
pub use roughness::{HeightStatistics, composite_rq, height_statistics};
