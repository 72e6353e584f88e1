//! Memory of a contact.

use crate::error::InputError;
use crate::grid::Grid;

/// Memory of a lubricated contact per node \[byte\].
const LUBRICATED_BYTES: usize = 2000;
/// Memory of a dry contact per node \[byte\].
const DRY_BYTES: usize = 400;

/// Memory per node \[byte\].
pub(in crate::sim) fn bytes(lubricated: bool) -> usize {
    if lubricated { LUBRICATED_BYTES } else { DRY_BYTES }
}

/// Checks that the system can allocate the memory of a contact on `grid`. Otherwise the process would be killed later.
pub(in crate::sim) fn validate_memory(grid: &Grid, lubricated: bool) -> Result<(), InputError> {
    grid.require_memory(bytes(lubricated))
}
