//! Single contacts: surfaces as they are, on one mesh or on several that estimate the errors.
//!
//! A single contact is prepared as the first step of a history is, and solved without changing its bodies.

mod accuracy;
pub(in crate::sim) mod expectation;
mod memory;
mod prepared;
mod standing;

use super::contact::solution::ContactSolution;
use super::error::SimError;
use super::history::builder::SimBuilder;
use super::scene::Scene;

/// Solves the single contact of `scene`, surfaces as they are. With an accuracy the contact is solved on
/// finer and finer meshes, the last of which is returned; with `solver.estimate` on half the cells of its
/// grid too.
///
/// # Errors
/// A scene that does not fit; a load that the pressure limit cannot carry. Not converging is a status of the
/// report.
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.lubricant = None; // dry
/// scene.roughness = Default::default(); // smooth
/// scene.plastic = None; // elastic
/// let solution = solve_contact(&scene)?;
/// solution.report.require_converged().unwrap();
/// assert!((solution.pressure.max / 1.15e9 - 1.0).abs() < 3e-3);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
pub fn solve_contact(scene: &Scene) -> Result<ContactSolution, SimError> {
    SimBuilder::new(scene.clone()).solve()
}
