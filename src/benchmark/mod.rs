//! Benchmarks of contact solvers: cases, contestants, verified results and pictures (feature `benchmark`).
//!
//! A [`Benchmark`] solves [`Cases`] by [`Contestant`]s, at one or several tolerances and meshes. Every result is
//! a [`Row`]: the [`Verdict`] after an independent check, residuals, work, seconds and the numbers of the contact.
//! [`Results`] holds the rows, as CSV, in words and in three pictures.
//!
//! | topic | item |
//! |---|---|
//! | a scene, its tags and its known limits | [`Case`], [`Limits`] |
//! | lists of cases by name, version and seed; case files | [`Cases`] |
//! | a solver or a variant of one | [`Contestant`] |
//! | tolerances, meshes, budget, threads, resuming | [`Benchmark`] |
//! | convergence over the cases | [`Results::stability_map`] |
//! | error over work | [`Results::work_precision`] |
//! | share of cases within a factor of the best | [`Results::performance_profile`] |

//!
//! A converged state is evaluated by the crate: its residuals of load, complementarity and mass, the signs of its
//! pressures and gaps, and the load that it carries. A state that fails is [`Verdict::FalselyConverged`]. A
//! contestant that panics, does not return or returns a state of another grid has a row with the reason, and the
//! others continue. All columns but the seconds are the same in every run on one machine, for any number of
//! threads, unless the limit of seconds is reached.
//!
//! ```
//! use stribeck::benchmark::{Benchmark, Cases, Contestant};
//! use stribeck::reynolds::SemiSystem;
//! let cases = Cases::named("battery", 1)?.tagged("smooth").every(20);
//! let results = Benchmark::new(cases)
//!     .contestant(Contestant::named("auto")?)
//!     .contestant(Contestant::named("newton_krylov:step_bound=0.015")?)
//!     .contestant(Contestant::new("my_solver", |_| Box::new(SemiSystem::default())))
//!     .meshes([16])
//!     .run()?;
//! assert_eq!(results.rows().len(), 9);
//! println!("{}", results.summary());
//! assert!(results.stability_map().starts_with("<svg"));
//! # Ok::<(), stribeck::sim::SimError>(())
//! ```

mod budget;
mod case;
mod case_file;
mod cases;
mod check;
mod clock;
mod contestant;
mod entrant;
pub mod growth;
mod job;
mod limits;
mod metered;
mod pictures;
mod plan;
mod results;
mod row;
mod run;
mod scoring;
mod summary;
mod table;

pub use budget::Budget;
pub use case::{Case, HeightsOnGrid, History};
pub use cases::Cases;
pub use contestant::Contestant;
pub use limits::{Limits, Quantity};
pub use plan::Benchmark;
pub use results::Results;
pub use row::{Row, Verdict};
