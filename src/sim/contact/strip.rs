//! Errors for scenes of strips with physics or solvers that need side edges or other grids.

use crate::error::InputError;
use crate::reynolds::ContactDefinition;
use crate::sim::scene::{Scene, SolverKind};

/// Checks that the scene has nothing that is not defined on a strip.
pub(in crate::sim) fn validate(scene: &Scene) -> Result<(), InputError> {
    if !scene.is_strip() {
        return Ok(());
    }
    let found = [
        (
            scene.solver.kind == SolverKind::Multigrid,
            "solver.kind = \"multigrid\" needs side edges; leave it out",
        ),
        (
            scene.solver.contact != ContactDefinition::Hard,
            "solver.contact = \"paper\" needs side edges; leave it out",
        ),
    ];
    match found.into_iter().find(|(applies, _)| *applies) {
        Some((_, reason)) => Err(conflict(reason)),
        None => Ok(()),
    }
}

fn conflict(reason: &str) -> InputError {
    InputError::Conflict { field: "grid.across = \"periodic\"".to_owned(), reason: reason.to_owned() }
}
