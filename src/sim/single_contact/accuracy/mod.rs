//! Error estimates of a single contact from coarser meshes, and meshes for a target accuracy.
//!
//! `smooth` picks box and meshes of a smooth contact and extrapolates over three of them. `rough` halves
//! cells until the estimated errors are small (`contact::mesh_error`). `docs/errors.md` has the evidence.

mod plan;
mod rough;
mod smooth;

use crate::error::InputError;
use crate::grid::Grid;
use crate::report::Work;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::setup;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::scene::{GridSpec, Scene};

/// Nodes of the largest mesh that a solve of `scene` uses: its own if given; the finest of the first meshes
/// for a smooth contact; the largest allowed mesh for a rough contact.
pub(in crate::sim) fn largest_mesh(scene: &Scene) -> Result<usize, SimError> {
    match scene.grid {
        GridSpec::Accuracy { accuracy } if scene.is_smooth() => {
            let grid = smooth::finest(scene, accuracy)?;
            Ok(Scene { grid, ..scene.clone() }.grid()?.len())
        }
        GridSpec::Accuracy { .. } => Ok(rough::MAX_NODES),
        _ if scene.solver.accuracy.is_some() => Ok(rough::MAX_NODES.max(scene.grid()?.len())),
        _ => Ok(scene.grid()?.len()),
    }
}

/// Nodes of the first mesh of a rough contact, of the finest of the first ones for a smooth contact.
pub(in crate::sim) fn first_mesh(scene: &Scene) -> Result<usize, SimError> {
    match scene.grid {
        GridSpec::Accuracy { accuracy } if !scene.is_smooth() => {
            let grid = rough::cells_of_waves(scene, accuracy)?;
            Ok(Scene { grid, ..scene.clone() }.grid()?.len())
        }
        GridSpec::Accuracy { .. } => largest_mesh(scene),
        _ => Ok(scene.grid()?.len()),
    }
}

/// The meshes of one contact before the first solve.
pub(in crate::sim) enum Meshes {
    /// A smooth contact whose box and cells are chosen.
    Smooth(Box<smooth::MeshChoice>),
    /// A rough contact, or one of given cells.
    Rough(Box<rough::Halving>),
}

impl Meshes {
    /// The meshes of the single contact of `scene`. All input errors of a solve are returned here, before its
    /// first iteration.
    ///
    /// # Errors
    /// A scene that does not fit, an accuracy out of range, surfaces that cannot be evaluated on other meshes.
    pub(in crate::sim) fn new(scene: &Scene, interrupt: Option<&Interrupt>) -> Result<Self, SimError> {
        let (accuracy, field) = match (scene.grid, scene.solver.accuracy) {
            (GridSpec::Accuracy { .. }, Some(_)) => {
                return Err(SimError::Input(InputError::Conflict {
                    field: "solver.accuracy".to_owned(),
                    reason: "it is for given cells; remove it, as grid.accuracy is given".to_owned(),
                }));
            }
            (GridSpec::Accuracy { accuracy }, None) => {
                setup::validate_accuracy("grid.accuracy", accuracy)?;
                if scene.is_smooth() {
                    let meshes = smooth::MeshChoice::new(scene, accuracy, interrupt)?;
                    return Ok(Self::Smooth(Box::new(meshes)));
                }
                let grid = rough::cells_of_waves(scene, accuracy)?;
                let scene = Scene { grid, ..scene.clone() };
                let meshes = rough::Halving::new(scene, accuracy, "grid.accuracy", interrupt)?;
                return Ok(Self::Rough(Box::new(meshes)));
            }
            (_, Some(accuracy)) => (accuracy, "solver.accuracy"),
            (_, None) => (f64::INFINITY, "solver.estimate"),
        };
        let meshes = rough::Halving::new(scene.clone(), accuracy, field, interrupt)?;
        Ok(Self::Rough(Box::new(meshes)))
    }

    /// Solves on one mesh after the other and estimates the errors of the last. `observer` is called with each
    /// solution.
    pub(in crate::sim) fn solve(
        self,
        observer: &mut dyn FnMut(&ContactSolution),
    ) -> Result<ContactSolution, SimError> {
        match self {
            Self::Smooth(meshes) => meshes.solve(observer),
            Self::Rough(meshes) => meshes.solve(observer),
        }
    }

    /// The warnings before the first solve.
    pub(in crate::sim) fn into_warnings(self) -> Vec<Warning> {
        match self {
            Self::Smooth(meshes) => meshes.warnings,
            Self::Rough(meshes) => meshes.into_warnings(),
        }
    }
}

/// Work on all meshes, convolutions weighted by nodes.
#[derive(Debug, Default)]
struct WorkUsed {
    /// Convolutions times the nodes of their grids.
    convolved_nodes: f64,
    /// Outer iterations.
    iterations: u64,
    /// Inner iterations.
    inner_iterations: u64,
}

impl WorkUsed {
    /// Adds the work of `solution`.
    fn add(&mut self, solution: &ContactSolution) {
        let work = solution.report.work;
        self.convolved_nodes += work.convolutions * solution.grid.len() as f64;
        self.iterations += work.iterations;
        self.inner_iterations += work.inner_iterations;
    }

    /// The work in convolutions of `grid`.
    fn on(&self, grid: &Grid) -> Work {
        Work {
            convolutions: self.convolved_nodes / grid.len() as f64,
            iterations: self.iterations,
            inner_iterations: self.inner_iterations,
        }
    }
}
