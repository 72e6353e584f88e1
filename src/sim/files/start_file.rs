//! Starts of bodies from the archives of earlier runs.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use zip::ZipArchive;
use zip::result::ZipError;

use crate::error::InputError;
use crate::grid::Grid;
use crate::regular_file;
use crate::sim::error::SimError;
use crate::sim::history::start::BodyStart;
use crate::surface::read_bytes;

/// Most bytes of an array beside its numbers.
const HEADER: u64 = 1 << 16;

impl BodyStart {
    /// Reads a body from the arrays `NAME_initial`, `NAME_wear`, `NAME_plastic_depth` and `NAME_tribofilm` of
    /// shape `(ny, nx)` in an npz archive. `fields.npz` of a [`RunFolder`](crate::sim::RunFolder) has them for
    /// the names `ball` and `disc`. Only the first is required. States of a film are read from
    /// `NAME_tribofilm_state_0`, `_1` and so on if present. The archive does not hold the cell size: `grid` must
    /// be the grid that it was written on.
    ///
    /// # Errors
    /// [`SimError`] for a file that cannot be read or is not an archive, and for an array that is missing,
    /// damaged or of another shape than `grid`.
    pub fn read_npz(path: impl AsRef<Path>, name: &str, grid: Grid) -> Result<Self, SimError> {
        let path = path.as_ref();
        let io = |source| SimError::Io { path: path.to_owned(), source };
        let archive = ZipArchive::new(regular_file::open(path).map_err(io)?);
        let mut archive = archive.map_err(|error| io(error.into()))?;
        let mut array = |part: &str| read_array(&mut archive, path, &format!("{name}_{part}"), &grid);
        let Some(initial) = array("initial")? else {
            return Err(SimError::Input(InputError::Conflict {
                field: format!("{name}_initial"),
                reason: format!("{} has no such array", path.display()),
            }));
        };
        let mut start = Self::new(grid, initial);
        start.wear = array("wear")?.unwrap_or(start.wear);
        start.plastic = array("plastic_depth")?.unwrap_or(start.plastic);
        start.tribofilm = array("tribofilm")?.unwrap_or(start.tribofilm);
        let mut states: Vec<Vec<f64>> = Vec::new();
        while let Some(state) = array(&format!("tribofilm_state_{}", states.len()))? {
            states.push(state);
        }
        start.states = (!states.is_empty())
            .then(|| (0..grid.len()).flat_map(|node| states.iter().map(move |state| state[node])).collect());
        Ok(start)
    }
}

/// The array `name`, if present.
fn read_array(
    archive: &mut ZipArchive<File>,
    path: &Path,
    name: &str,
    grid: &Grid,
) -> Result<Option<Vec<f64>>, SimError> {
    let io = |source| SimError::Io { path: path.to_owned(), source };
    let entry = match archive.by_name(&format!("{name}.npy")) {
        Ok(entry) => entry,
        Err(ZipError::FileNotFound) => return Ok(None),
        Err(error) => return Err(io(error.into())),
    };
    let mut bytes = Vec::new();
    entry.take(8 * grid.len() as u64 + HEADER).read_to_end(&mut bytes).map_err(io)?;
    let array = read_bytes(&bytes, path.join(name))?;
    if array.undefined() > 0 {
        return Err(SimError::Input(InputError::Conflict {
            field: format!("{name} of {}", path.display()),
            reason: format!("{} values are not finite", array.undefined()),
        }));
    }
    if (array.nx(), array.ny()) != (grid.nx(), grid.ny()) {
        return Err(SimError::Input(InputError::Conflict {
            field: format!("{name} of {}", path.display()),
            reason: format!(
                "the array has {} x {} values, the grid {} x {}",
                array.nx(),
                array.ny(),
                grid.nx(),
                grid.ny()
            ),
        }));
    }
    Ok(Some(array.heights().to_vec()))
}
