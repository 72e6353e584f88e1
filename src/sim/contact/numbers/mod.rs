//! Results of a contact and of bodies, with the same names in programs, JSON, files and Python.
//!
//! A name is the path of a field. Example: `film.mean_central` is `solution.film.mean_central` and
//! `record.film.mean_central`, the entry `mean_central` of the table `film` in JSON, the attribute of a solution in
//! Python, and the column `film_mean_central_m` of a history, with its unit. `docs/output.md` lists all names.

mod bodies;
mod contact;
mod friction;
mod known;
mod moes;
mod starvation;
mod stress;
mod thermal;
mod wear;

pub use bodies::{DepthNumbers, PlasticNumbers, RoughnessNumbers};
pub(in crate::sim) use contact::Numbers;
pub use contact::{ContactNumbers, FilmNumbers, PressureNumbers};
pub use friction::FrictionNumbers;
pub(in crate::sim) use known::is_known;
pub use moes::Moes;
pub use starvation::StarvationNumbers;
pub use stress::StressNumbers;
pub use thermal::ThermalNumbers;
pub(in crate::sim) use wear::Scar;
pub use wear::WearNumbers;
