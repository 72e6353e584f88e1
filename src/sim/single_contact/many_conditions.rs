//! A contact that is built once and solved under many conditions.

use std::fmt;

use crate::error::InputError;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::contact::{asperity_inlets, strip, warnings};
use crate::sim::error::SimError;
use crate::sim::history::builder::SimBuilder;
use crate::sim::scene::SolverModel;
use crate::sim::scene::operating_schedule::Conditions;
use crate::sim::single_contact::prepared::PreparedContact;
use crate::sim::single_contact::solve::needs_meshes;

/// A contact of unchanged bodies that is solved under one condition after the other, for Stribeck and traction curves.
///
/// Surfaces, elastic influence coefficients and the buffers of the solver are built once. By asperity inlets ([`SolverModel`]) dry
/// contact and flow through the valleys are those of the last solve under the same load.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene, scene::SolverModel};
/// let mut scene = Scene::azam_2019(64);
/// scene.solver.model = SolverModel::AsperityInlets;
/// let mut conditions = scene.conditions(0.0)?;
/// let mut contact = MixedLubricationSim::builder(scene).single_contact()?;
/// let mut shares = Vec::new();
/// for speed in [0.01, 0.1, 1.0] {
///     conditions.motion.entrainment_speed = speed;
///     shares.push(contact.solve_under(&conditions)?.contact.load_ratio);
/// }
/// assert!(shares[0] > shares[1] && shares[1] > shares[2]);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
pub struct SingleContact(PreparedContact);

impl SimBuilder {
    /// The contact of [`solve`](Self::solve), to be solved under many conditions.
    ///
    /// # Errors
    /// The input errors of [`solve`](Self::solve). A scene whose contact needs several meshes or steps: an accuracy, an
    /// estimate of errors, roughness that moves.
    pub fn single_contact(self) -> Result<SingleContact, SimError> {
        strip::validate(&self.scene)?;
        asperity_inlets::validate(&self.scene)?;
        if needs_meshes(&self.scene) || !self.scene.motion.roughness.is_at_rest() {
            return Err(SimError::Input(InputError::Conflict {
                field: "single_contact".to_owned(),
                reason:
                    "a contact under many conditions is solved on one mesh with roughness at rest; leave out \
                         solver.accuracy, solver.estimate, grid.accuracy and motion.roughness"
                        .to_owned(),
            }));
        }
        let mut contact = self.prepare_from_start()?;
        contact.model.reuses_buffers = true;
        Ok(SingleContact(contact))
    }
}

impl fmt::Debug for SingleContact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SingleContact").finish_non_exhaustive()
    }
}

impl SingleContact {
    /// Solves the contact under `conditions`. A limited supply of oil has no [`starvation`](ContactSolution::starvation)
    /// numbers. A solve that does not converge is no error: see the status of the report.
    ///
    /// # Errors
    /// Conditions out of range, a load that the grid or the pressure limit cannot carry, an interruption.
    pub fn solve_under(&mut self, conditions: &Conditions) -> Result<ContactSolution, SimError> {
        self.0.set_conditions(conditions)?;
        let mut solution = self.0.solve_next()?;
        // A resolved contact converges in fewer steps from its dry contact than from pressures at another speed.
        if solution.model == Some(SolverModel::AsperityInlets) {
            self.0.state.clone_from(&solution.state);
        }
        let found = warnings::after_solve(self.0.scene(), &solution);
        solution.warnings.extend(found);
        Ok(solution)
    }
}
