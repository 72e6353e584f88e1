//! Motion of periodic roughness between time steps.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use crate::error::InputError;

/// Where the roughness of each body stands at each step.
///
/// A time step of a wear simulation spans many passages of the contact, so the two roughness patterns meet at
/// another relative position each time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RoughnessMotion {
    /// The patterns never move: the same peaks meet for ever.
    Fixed,
    /// At each step each body's pattern stands at a new random position, a whole number of nodes from its origin.
    RandomShift {
        /// Seed of the positions.
        seed: u64,
    },
}

impl RoughnessMotion {
    /// Shift `(sx, sy)` in nodes of the pattern of `body` at `step`, on a grid of `nx` x `ny`: `0 <= sx < nx`, `0 <= sy < ny`.
    ///
    /// A function of its arguments alone, so that a resumed run meets the positions of an uninterrupted one.
    ///
    /// ```
    /// use stribeck::surface::RoughnessMotion;
    /// let motion = RoughnessMotion::RandomShift { seed: 3 };
    /// let shift = motion.shift(0, 17, 128, 128);
    /// assert_eq!(shift, motion.shift(0, 17, 128, 128));
    /// assert!(shift.0 < 128 && shift.1 < 128);
    /// assert_eq!(RoughnessMotion::Fixed.shift(0, 17, 128, 128), (0, 0));
    /// ```
    #[must_use]
    pub fn shift(&self, body: usize, step: u64, nx: usize, ny: usize) -> (usize, usize) {
        match *self {
            Self::Fixed => (0, 0),
            Self::RandomShift { seed } => {
                let mut bytes = [0; 32];
                bytes[..8].copy_from_slice(&seed.to_le_bytes());
                bytes[8..16].copy_from_slice(&(body as u64).to_le_bytes());
                bytes[16..24].copy_from_slice(&step.to_le_bytes());
                bytes[24..].copy_from_slice(b"position");
                let mut generator = ChaCha8Rng::from_seed(bytes);
                (below(generator.next_u64(), nx), below(generator.next_u64(), ny))
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

/// Adds `values`, computed on the grid, to the periodic `field` of the shifted body: the way back of [`copy_shifted`],
/// `field[((j + sy) % ny, (i + sx) % nx)] += values[(j, i)]`.
///
/// # Errors
/// [`InputError::Shape`] when a slice has not `nx * ny` values.
///
/// ```
/// let mut field = [0.0; 4];
/// stribeck::surface::add_shifted(&[2.0, 3.0, 4.0, 1.0], 4, 1, (1, 0), &mut field)?;
/// assert_eq!(field, [1.0, 2.0, 3.0, 4.0]);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn add_shifted(
    values: &[f64],
    nx: usize,
    ny: usize,
    shift: (usize, usize),
    field: &mut [f64],
) -> Result<(), InputError> {
    require_shapes(values, nx, ny, field)?;
    for_rows(nx, ny, shift, |body, grid, length| {
        for (target, value) in field[body..body + length].iter_mut().zip(&values[grid..grid + length]) {
            *target += value;
        }
    });
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
