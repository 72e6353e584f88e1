//! Shifts of periodic fields by whole nodes.
//!
//! A field of a body is a periodic patch. In the frame of the contact it is shifted by an [`Offset`]: whole columns and
//! rows, and a fraction of a column along x. Films and depths are interpolated linearly, heights by Fourier series
//! (`subcell`).

use crate::error::InputError;

/// Offset of a pattern: node `(i, j)` of the grid is at column `i + columns + fraction` and row `j + rows` of the field of
/// the body, both periodic.
///
/// # Examples
///
/// ```
/// use stribeck::surface::Offset;
/// assert!(Offset { columns: 1000, rows: 3, fraction: 0.25 }.validate().is_ok());
/// assert!(Offset { fraction: -0.1, ..Offset::default() }.validate().is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Offset {
    /// Whole columns.
    pub columns: usize,
    /// Whole rows.
    pub rows: usize,
    /// Fraction of a column, 0 to 1.
    pub fraction: f64,
}

impl Offset {
    /// Checks the fraction.
    ///
    /// # Errors
    /// A fraction outside 0 to 1.
    pub fn validate(&self) -> Result<(), InputError> {
        self.validate_as("offset.fraction")
    }

    /// The same with the name `field` in the error.
    pub(crate) fn validate_as(&self, field: &str) -> Result<(), InputError> {
        InputError::require((0.0..=1.0).contains(&self.fraction), field, self.fraction, "from 0 to 1")
    }
}

/// Overwrites `out` with the shifted periodic `field`:
/// `out[(j, i)] = field[((j + sy) % ny, (i + sx) % nx)]`, both row-major with `nx` columns and `ny` rows.
///
/// # Errors
/// [`InputError::Shape`] if a slice does not have `nx * ny` values.
pub(crate) fn copy_shifted(
    field: &[f64],
    nx: usize,
    ny: usize,
    shift: (usize, usize),
    out: &mut [f64],
) -> Result<(), InputError> {
    require_shapes(field, nx, ny, out)?;
    for_rows(nx, ny, shift, |body, grid, length| {
        out[grid..grid + length].copy_from_slice(&field[body..body + length]);
    });
    Ok(())
}

/// Adds `values` on the grid to the periodic `field` of the body at `offset`. Each value is divided between its two
/// neighboring columns by distance, which keeps the sum; with a fraction of zero
/// `field[((j + rows) % ny, (i + columns) % nx)] += values[(j, i)]`.
///
/// # Errors
/// Slices that do not have `nx * ny` values, a fraction outside 0 to 1.
pub(crate) fn add_blended(
    values: &[f64],
    nx: usize,
    ny: usize,
    offset: Offset,
    field: &mut [f64],
) -> Result<(), InputError> {
    require_shapes(values, nx, ny, field)?;
    offset.validate()?;
    let mut add = |columns: usize, weight: f64| {
        for_rows(nx, ny, (columns, offset.rows), |body, grid, length| {
            for (target, value) in field[body..body + length].iter_mut().zip(&values[grid..grid + length]) {
                *target += weight * value;
            }
        });
    };
    add(offset.columns, 1.0 - offset.fraction);
    if offset.fraction > 0.0 {
        add(offset.columns + 1, offset.fraction);
    }
    Ok(())
}

/// Error unless both fields have `nx * ny` values.
fn require_shapes(source: &[f64], nx: usize, ny: usize, target: &[f64]) -> Result<(), InputError> {
    let nodes = nx.saturating_mul(ny);
    InputError::require_len("source", source, nodes)?;
    InputError::require_len("target", target, nodes)
}

/// Calls `visit(start in the field of the body, start on the grid, length)` for the one or two contiguous parts of each
/// row.
fn for_rows(nx: usize, ny: usize, shift: (usize, usize), mut visit: impl FnMut(usize, usize, usize)) {
    if nx == 0 || ny == 0 {
        return;
    }
    let (sx, sy) = (shift.0 % nx, shift.1 % ny);
    for j in 0..ny {
        let body = (j + sy) % ny * nx;
        visit(body + sx, j * nx, nx - sx);
        visit(body, j * nx + nx - sx, sx);
    }
}
