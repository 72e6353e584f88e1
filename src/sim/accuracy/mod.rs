//! Errors of a single contact that coarser meshes tell, and meshes for a wanted accuracy.
//!
//! Three ways, one a file: `smooth` picks box and meshes for a smooth contact and extrapolates over three of
//! them, `rough` halves cells until the change is small, and `change` says what the difference of two meshes
//! tells of the errors of the finer one. `surfaces` evaluates heights on any mesh. What counts as small, and
//! on what the factors rest, is in `docs/errors.md`.

mod change;
mod rough;
mod smooth;
mod surfaces;

use super::SimError;
use super::interrupt::Interrupt;
use super::scene::{GridSpec, Scene};
use super::setup;
use super::solution::ContactSolution;
use super::warnings::Warning;
use crate::error::InputError;
use crate::grid::Grid;
use crate::report::Work;

/// Estimated errors of a solution, those of films, pressure and friction over their value, those of the two
/// ratios as they are.
///
/// The estimates of a smooth contact that picks its mesh come from three meshes, all others from one mesh of half
/// the cells, on which the surfaces are the Fourier series of the given ones. All hold the error of the box, which
/// no mesh shows, against a flooded inlet. How far they were found to hold is in `docs/errors.md`.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.solver.estimate = true; // solved on 16 x 16 cells too
/// let solution = solve_contact(&scene)?;
/// let estimate = solution.error_estimate.ok_or("one of both was not solved")?;
/// assert!(estimate.film_mean_central >= 0.0 && estimate.contact_load_ratio <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ErrorEstimate {
    /// Of the central film; 0 in a smooth dry contact, whose film is none.
    pub film_central: f64,
    /// Of the minimum film; 0 in a smooth dry contact.
    pub film_minimum: f64,
    /// Of the maximum pressure. A pressure spike at the outlet does not converge on such meshes: where it is,
    /// or may still become, the maximum, the estimate of a smooth contact says so and is large.
    pub pressure_max: f64,
    /// Of the mean film within two thirds of the Hertz radii.
    pub film_mean_central: f64,
    /// Of the share of the load that solid contact carries, absolute.
    pub contact_load_ratio: f64,
    /// Of the area of solid contact over the Hertz area, absolute.
    pub contact_area_ratio: f64,
    /// Of the friction coefficient; 0 without sliding.
    pub friction_coefficient: f64,
    /// The part of the errors of the central and the mean film that the edges of the box make, which is in them; the
    /// rest is that of the mesh. 0 where the oil begins at the edge of the box.
    pub film_by_box: f64,
}

/// Nodes of the largest mesh that a solve of `scene` takes: its own where that is given, the finest of the first
/// meshes of a smooth contact that picks them, the largest that is ever tried of a rough one.
pub(super) fn largest_mesh(scene: &Scene) -> Result<usize, SimError> {
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

/// The meshes of one contact, of which nothing is solved yet.
pub(super) enum Meshes {
    /// Of a smooth contact, box and cells picked.
    Smooth(Box<smooth::Picked>),
    /// Of a rough one, or of given cells.
    Rough(Box<rough::Halving>),
}

impl Meshes {
    /// Those of the single contact of `scene`. Everything that a solve refuses before its first iteration is
    /// refused here.
    ///
    /// # Errors
    /// A scene that does not fit, an accuracy out of range, surfaces that are not known on other meshes.
    pub(super) fn new(scene: &Scene, interrupt: Option<&Interrupt>) -> Result<Self, SimError> {
        let (accuracy, field) = match (scene.grid, scene.solver.accuracy) {
            (GridSpec::Accuracy { .. }, Some(_)) => {
                return Err(SimError::Input(InputError::Conflict {
                    field: "solver.accuracy".to_owned(),
                    reason: "it is for given cells, grid.accuracy stands in its place".to_owned(),
                }));
            }
            (GridSpec::Accuracy { accuracy }, None) => {
                setup::validate_accuracy("grid.accuracy", accuracy)?;
                if scene.is_smooth() {
                    let meshes = smooth::Picked::new(scene, accuracy, interrupt)?;
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

    /// Solves on one mesh after the other and estimates the errors of the last; `observer` sees the solution of
    /// each.
    pub(super) fn solve(
        self,
        observer: &mut dyn FnMut(&ContactSolution),
    ) -> Result<ContactSolution, SimError> {
        match self {
            Self::Smooth(meshes) => meshes.solve(observer),
            Self::Rough(meshes) => meshes.solve(observer),
        }
    }

    /// What is known without solving.
    pub(super) fn into_warnings(self) -> Vec<Warning> {
        match self {
            Self::Smooth(meshes) => meshes.warnings,
            Self::Rough(meshes) => meshes.into_warnings(),
        }
    }
}

/// Work of all meshes, convolutions as node counts.
#[derive(Debug, Default)]
struct Spent {
    /// Convolutions times the nodes of their grids.
    convolved_nodes: f64,
    /// Outer iterations.
    iterations: u64,
    /// Inner iterations.
    inner_iterations: u64,
}

impl Spent {
    /// Counts in the work of `solution`.
    fn add(&mut self, solution: &ContactSolution) {
        let work = solution.report.work;
        self.convolved_nodes += work.convolutions * solution.grid.len() as f64;
        self.iterations += work.iterations;
        self.inner_iterations += work.inner_iterations;
    }

    /// The work in equivalents of `grid`.
    fn on(&self, grid: &Grid) -> Work {
        Work {
            convolutions: self.convolved_nodes / grid.len() as f64,
            iterations: self.iterations,
            inner_iterations: self.inner_iterations,
        }
    }
}
