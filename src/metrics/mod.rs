//! Parameters of surfaces, films and contacts: pure functions of field slices and a [`Grid`](crate::Grid).
//!
//! | file | content |
//! |---|---|
//! | roughness | [`height_statistics`], [`composite_rq`] |
//! | bearing | [`BearingCurve`], [`CoreParameters`], [`VolumeParameters`] (ISO 25178-2) |
//! | histogram | [`HeightHistogram`] |
//! | hybrid | [`HybridParameters`]: gradient and developed area (ISO 25178-2) |
//! | correlation | [`AreaCorrelation`], [`SpatialParameters`] (ISO 25178-2) |
//! | spectrum | [`radial_spectrum`], [`profile_spectrum`] |
//! | film | [`mean_central_film`], [`minimum_film`], [`minimum_gap`], [`lambda_ratio`] |
//! | contact | [`contact_statistics`], [`peak`] |
//! | patches | [`contact_patches`] |
//! | friction | [`viscous_shear_into`], [`friction_coefficient`] |
//!
//! The functions are independent of solvers: fields may come from a simulation, a file or a measurement.

mod bearing;
mod contact;
mod correlation;
mod ellipse;
mod film;
mod friction;
mod histogram;
mod hybrid;
mod mask;
mod patches;
mod peak;
mod roughness;
mod spectrum;

pub use bearing::{BearingCurve, CoreParameters, VolumeParameters};
pub(crate) use contact::statistics_in;
pub use contact::{ContactStatistics, contact_statistics};
pub use correlation::{AreaCorrelation, SpatialParameters};
pub(crate) use ellipse::Ellipse;
pub(crate) use film::{CENTRAL, is_central, mean_central_film_in};
pub use film::{lambda_ratio, mean_central_film, minimum_film, minimum_gap};
pub(crate) use friction::fill_shear;
pub use friction::{friction_coefficient, viscous_shear_into};
pub use histogram::{HeightHistogram, height_histogram};
pub use hybrid::{HybridParameters, hybrid_parameters};
pub use patches::{ContactPatches, contact_patches};
pub use peak::peak;
pub use roughness::{HeightStatistics, composite_rq, height_statistics};
pub use spectrum::{Axis, Spectrum, profile_spectrum, radial_spectrum};
