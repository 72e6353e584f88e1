//! Coupled simulation of rough lubricated contacts: mixed elastohydrodynamic lubrication, plastic
//! flattening, tribofilm growth and wear on one grid.
//!
//! # The model
//!
//! | equation | meaning |
//! |---|---|
//! | `h = g - δ + K p + d` | film: undeformed gap less approach, elastic displacement, plastic depth |
//! | `0 ≤ p_f ⊥ F ≥ 0`, `F = u ∂(ρh)/∂x + ∂(ρh)/∂t - ∇·(ρh³/(12η) ∇p_f)` | Reynolds balance or cavitation |
//! | `0 ≤ p - p_f ⊥ h - h_cut ≥ 0` | solid contact or none |
//! | `0 ≤ H - p ⊥ d ≥ 0` | elastic or yielded |
//! | `∫ p dA = W` | load balance |
//! | `z = z_0 - w - d + f` on each body | the surfaces of the next step: wear, plastic depth, tribofilm |
//!
//! `a ⊥ b` stands for complementarity: neither term is negative and their product is zero.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | `p`, `p_f` | total and fluid pressure | Pa |
//! | `h`, `h_cut` | film thickness, contact film | m |
//! | `g`, `δ` | gap of the undeformed bodies at first contact; rigid-body approach, positive toward each other | m |
//! | `K` | elastic displacement of both bodies per pressure | m/Pa |
//! | `u` | entrainment speed, mean of both surfaces, along +x | m/s |
//! | `η`, `ρ` | viscosity, density over that at ambient pressure | Pa s, 1 |
//! | `H` | hardness of the softer surface | Pa |
//! | `W` | load | N |
//! | `z`, `w`, `d`, `f` | height of a body, worn depth, plastic depth, tribofilm | m |
//!
//! # Types and roles
//!
//! | type | role |
//! |---|---|
//! | [`sim::Scene`] | the whole physical description; TOML with the feature `serde` |
//! | [`sim::solve_contact`] | one quasi-static contact |
//! | [`sim::MixedLubricationSim`] | the history; every law replaceable through its builder |
//! | [`reynolds::LubricatedContact`], [`reynolds::ContactSolver`] | the coupled problem and its solvers |
//! | [`reynolds::GivenFilm`] | pressure and cavitation between rigid surfaces with a prescribed film |
//! | [`elastic::DeformationModel`] | elastic response; [`elastic::HalfSpace`] by DC-FFT |
//! | [`lubricant::ViscosityLaw`], [`lubricant::DensityLaw`] | the fluid |
//! | [`sim::Observer`] | callback after every step; `sim::RunFolder` (features `serde`, `npz`) writes, checkpoints and resumes |
//! | [`sim::ensemble`] | many histories over threads |
//! | [`plastic::PlasticityModel`], [`tribochem::FilmGrowthLaw`], [`wear::WearLaw`] | evolution of the surfaces |
//! | [`SolveReport`], [`Status`], [`Residuals`] | outcome of a solve; failure to converge is a status |
//!
//! # Example
//!
//! ```
//! use stribeck::sim::{MixedLubricationSim, Scene, StepRecord};
//! use std::ops::ControlFlow;
//!
//! // A steel ball on a rough disc in base oil with an anti-wear additive, on a coarse grid.
//! let scene = Scene::azam_2019(32).with_tribofilm();
//! let mut sim = MixedLubricationSim::builder(scene).build()?;
//! let mut history = Vec::new();
//! sim.run(4, 60.0, &mut |_: &MixedLubricationSim, record: &StepRecord| {
//!     history.push(record.clone());
//!     ControlFlow::Continue(())
//! })?;
//! let last = &history[3];
//! assert_eq!(last.time, 240.0);
//! let solids = last.contact.load_ratio;
//! assert!(solids > 0.0 && solids < 1.0, "mixed lubrication: solid contact carries part of the load");
//! assert!(last.tribofilm.disc_mean > history[0].tribofilm.disc_mean, "the film grows");
//! assert!(sim.ledger_residual()? < 1e-20, "every nanometre is accounted for");
//! # Ok::<(), stribeck::sim::SimError>(())
//! ```
//!
//! # Conventions and limits
//!
//! SI units throughout. Fields are row-major slices, node `(i, j)` at `j * nx + i`, x along the entrainment.
//! Heights are positive out of their body. The fluid is isothermal unless a scene enables film heating. Bodies
//! are parabolic elastic half-spaces without subsurface plasticity. Contact area and load ratio depend on
//! `h_cut`, and on the grid in the mixed regime.
//!
//! # Features
//!
//! None by default. `serde`: scenes as TOML, checkpoints. `formats`: files of measured surfaces. `npz`,
//! `vtk`: fields for `NumPy` and `ParaView`. `parallel`: multithreading on large grids, with identical
//! results. `testing`: conformance checks of custom laws and solvers, random scenes. `fit`: fits of growth-law
//! constants to measured films. `benchmark`: benchmarks of contact solvers and growth laws.
#![deny(missing_docs)]
#![forbid(unsafe_code)]

pub mod analytic;
#[cfg(feature = "benchmark")]
pub mod benchmark;
mod boundary;
mod boundary_friction;
mod displayed;
pub mod elastic;
mod error;
mod grid;
pub mod lubricant;
pub mod metrics;
mod nearest;
mod numerics;
pub mod plastic;
mod regular_file;
mod report;
pub mod reynolds;
pub mod sim;
mod solver_id;
mod strategy;
pub mod surface;
mod surface_state;
#[cfg(feature = "testing")]
pub mod testing;
mod text_file;
pub mod text_table;
pub mod thermal;
pub mod tribochem;
pub mod units;
pub mod wear;
mod with_fields;

// Types shared by all modules.
pub use boundary::Boundary;
pub use boundary_friction::{BoundaryFriction, ConstantFriction, FilmFriction};
pub use error::InputError;
pub use grid::Grid;
#[cfg(feature = "parallel")]
pub use numerics::set_num_threads;
pub use report::{NotConverged, Residuals, SolveReport, Status, Work};
pub use sim::Warning;
pub use solver_id::SolverId;
pub use strategy::Strategy;
pub use surface_state::SurfaceState;

// Doctests of the README and of the first page of the book.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
#[doc = include_str!("../docs/getting_started.md")]
#[cfg_attr(feature = "benchmark", doc = include_str!("../docs/comparing_solvers.md"))]
struct ReadmeDoctests;
