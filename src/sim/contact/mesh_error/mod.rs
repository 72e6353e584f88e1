//! Errors of the mesh, estimated from the same contact on larger cells.
//!
//! `surfaces` evaluates heights on other cells of the same box, `change` estimates the errors of the finer of two
//! solutions from their difference. `docs/errors.md` has the evidence.

mod change;
mod surfaces;

use crate::error::InputError;
use crate::reynolds::ContactDefinition;
use crate::sim::scene::Scene;

pub(in crate::sim) use change::{BOX_MINIMUM, Mesh, estimate};
pub(in crate::sim) use surfaces::Surfaces;

/// Fewest cells per Hertz half-width of the first mesh for a requested accuracy, and of a cycle without a warning.
pub(in crate::sim) const CELLS_IN_HALF_WIDTH: f64 = 10.0;
/// Fewest cells along a side that can be halved.
const FEWEST: usize = 10;

/// Rejects scenes that cannot be solved on half their cells, as their key `field` requires.
pub(in crate::sim) fn require_half(scene: &Scene, field: &str) -> Result<(), InputError> {
    if scene.is_lubricated() && scene.solver.contact != ContactDefinition::Hard {
        return Err(InputError::Conflict {
            field: "solver.contact = \"paper\"".to_owned(),
            reason: format!(
                "{field} needs \"hard\": where the pressure flow ends, numbers have no limit on fine meshes"
            ),
        });
    }
    let grid = scene.grid()?;
    for (axis, n, counts) in [("grid.nx", grid.nx(), true), ("grid.ny", grid.ny(), grid.ny() > 1)] {
        if counts && n < FEWEST {
            return Err(InputError::Conflict {
                field: format!("{axis} = {n}"),
                reason: format!(
                    "{field} needs at least {FEWEST} cells along each side, so that half of them are a mesh"
                ),
            });
        }
    }
    Ok(())
}
