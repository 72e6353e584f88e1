//! Numbers of a contact and of bodies, under the names that programs, JSON, files and Python share.
//!
//! A name is the path of a field: `film.mean_central` is `solution.film.mean_central` and
//! `record.film.mean_central`, the entry `mean_central` of the table `film` in JSON, the attribute of a solution
//! in Python, and the column `film_mean_central_m` of a history, which has the unit behind it.
//! `docs/output.md` lists them all.

mod bodies;
mod contact;
mod friction;
mod stress;
mod thermal;
mod wear;

pub use bodies::{DepthNumbers, PlasticNumbers, RoughnessNumbers};
pub(in crate::sim) use contact::Numbers;
pub use contact::{ContactNumbers, FilmNumbers, Moes, PressureNumbers};
pub use friction::FrictionNumbers;
pub use stress::StressNumbers;
pub use thermal::ThermalNumbers;
pub use wear::WearNumbers;
