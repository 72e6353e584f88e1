//! Motion of periodic roughness between time steps.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::error::InputError;
use crate::grid::Grid;

/// Where the roughness of each body stands at each step.
///
/// A time step of a wear simulation spans many passages of the contact, so the two roughness patterns meet at
/// another relative position each time. All patterns are periodic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoughnessMotion {
    /// The patterns never move: the same peaks meet for ever.
    Fixed,
    /// At each step each body's pattern stands at a new random position, a whole number of nodes from its origin.
    RandomShift {
        /// Seed of the positions.
        seed: u64,
    },
    /// Each pattern is carried along x by its body: after the time `t` it stands `V t` downstream, between nodes by
    /// interpolation.
    Convected,
}

/// Where a pattern stands: node `(i, j)` of the grid sees the body's own field at column `i + columns + fraction` and row
/// `j + rows`, both periodic.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Offset {
    /// Whole columns.
    pub columns: usize,
    /// Whole rows.
    pub rows: usize,
    /// Part of a column, 0 to 1.
    pub fraction: f64,
}

impl Offset {
    /// Checks the fraction.
    ///
    /// # Errors
    /// A fraction outside 0 to 1.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require(
            (0.0..=1.0).contains(&self.fraction),
            "offset.fraction",
            self.fraction,
            "from 0 to 1",
        )
    }
}

impl RoughnessMotion {
    /// Where the pattern of `body` stands on `grid` at the `draw`-th solve and `time` \[s\], its surface moving at `speed`
    /// \[m/s\] along x.
    ///
    /// A function of its arguments alone, so that a resumed run meets the positions of an uninterrupted one.
    ///
    /// ```
    /// use stribeck::Grid;
    /// use stribeck::surface::{Offset, RoughnessMotion};
    /// let grid = Grid::centred(128, 128, 1e-6, 1e-6)?;
    /// let motion = RoughnessMotion::RandomShift { seed: 3 };
    /// let offset = motion.offset(0, 17, 0.0, 0.1, &grid);
    /// assert_eq!(offset, motion.offset(0, 17, 5.0, 0.2, &grid));
    /// assert!(offset.columns < 128 && offset.rows < 128);
    /// assert_eq!(RoughnessMotion::Fixed.offset(0, 17, 1.0, 0.1, &grid), Offset::default());
    /// // 0.25 cells downstream: the grid sees what was 0.25 cells upstream.
    /// let carried = RoughnessMotion::Convected.offset(0, 0, 2.5e-6, 0.1, &grid);
    /// assert_eq!(carried.columns, 127);
    /// assert!((carried.fraction - 0.75).abs() < 1e-9);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn offset(&self, body: usize, draw: u64, time: f64, speed: f64, grid: &Grid) -> Offset {
        match *self {
            Self::Fixed => Offset::default(),
            Self::RandomShift { seed } => {
                let mut bytes = [0; 32];
                bytes[..8].copy_from_slice(&seed.to_le_bytes());
                bytes[8..16].copy_from_slice(&(body as u64).to_le_bytes());
                bytes[16..24].copy_from_slice(&draw.to_le_bytes());
                bytes[24..].copy_from_slice(b"position");
                let mut generator = ChaCha8Rng::from_seed(bytes);
                let columns = below(generator.next_u64(), grid.nx());
                Offset { columns, rows: below(generator.next_u64(), grid.ny()), fraction: 0.0 }
            }
            Self::Convected => {
                let columns = (-speed * time / grid.dx()).rem_euclid(grid.nx() as f64);
                // A distance that is not a number stays at the origin.
                let whole = if columns.is_finite() { columns.floor() } else { 0.0 };
                let fraction = if columns.is_finite() { columns - whole } else { 0.0 };
                Offset { columns: whole as usize % grid.nx().max(1), rows: 0, fraction }
            }
        }
    }
}

/// Maps 64 random bits onto `0..count`.
fn below(bits: u64, count: usize) -> usize {
    ((u128::from(bits) * count as u128) >> 64) as usize
}

/// Overwrites `out` with the periodic `field` as seen after a shift:
/// `out[(j, i)] = field[((j + sy) % ny, (i + sx) % nx)]`, both row-major with `nx` columns and `ny` rows.
///
/// # Errors
/// [`InputError::Shape`] when a slice has not `nx * ny` values.
///
/// ```
/// let mut out = [0.0; 4];
/// stribeck::surface::copy_shifted(&[1.0, 2.0, 3.0, 4.0], 4, 1, (1, 0), &mut out)?;
/// assert_eq!(out, [2.0, 3.0, 4.0, 1.0]);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn copy_shifted(
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

/// Adds `values`, computed on the grid, to the periodic `field` of the body at `offset`: each value goes to the two columns
/// that it stands between, by their distance, so that the sum is kept; with a fraction of zero
/// `field[((j + rows) % ny, (i + columns) % nx)] += values[(j, i)]`.
///
/// # Errors
/// Slices that have not `nx * ny` values, a fraction outside 0 to 1.
///
/// ```
/// use stribeck::surface::{Offset, add_blended};
/// let mut field = [0.0; 4];
/// add_blended(&[2.0, 0.0, 4.0, 1.0], 4, 1, Offset { columns: 1, rows: 0, fraction: 0.25 }, &mut field)?;
/// assert_eq!(field, [1.75, 1.75, 0.5, 3.0]);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn add_blended(
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

fn require_shapes(source: &[f64], nx: usize, ny: usize, target: &[f64]) -> Result<(), InputError> {
    let nodes = nx.saturating_mul(ny);
    InputError::require_len("source", source, nodes)?;
    InputError::require_len("target", target, nodes)
}

/// Calls `visit(start in the body's field, start on the grid, length)` for the one or two contiguous pieces of each row.
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
