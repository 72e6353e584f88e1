//! Single contacts of unchanged surfaces, on one mesh or on several for error estimates.
//!
//! A single contact is prepared like the first step of a history and leaves its bodies unchanged.

mod accuracy;
pub(in crate::sim) mod expectation;
pub(in crate::sim) mod many_conditions;
mod memory;
mod prepared;
mod solve;
mod solve_under;
mod starvation;

use super::contact::solution::ContactSolution;
use super::error::SimError;
use super::history::builder::SimBuilder;
use super::scene::Scene;

/// Solves the single contact of `scene`. With an accuracy the contact is solved on successively finer meshes
/// and the finest solution is returned. With `solver.estimate` it is also solved on half the cells of its
/// grid.
///
/// # Errors
/// A scene that does not fit; a load that the pressure limit cannot carry. A solve that does not converge is
/// no error: see the status of the report.
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
