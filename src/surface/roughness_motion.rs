//! Motion of periodic roughness between time steps.
//!
//! A motion is a pure function of draw count, time and speed: with the seed of the scene it gives the same positions on
//! every machine and after every resumed run, without state.
//!
//! | motion | position of a body in the next contact |
//! |---|---|
//! | [`Fixed`] | unchanged |
//! | [`Advected`] | moved at its speed, between nodes too |
//! | [`AlongTrack`] | any along x |
//! | [`RandomShift`] | any along x and y |
//!
//! At zero speed a body does not move.

use std::fmt::Debug;

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use super::motion::Offset;
use crate::grid::Grid;

/// Position of the roughness of each body at each solve.
///
/// A step of a wear history spans many passages of the contact, so the two roughness patterns meet at a different
/// relative position in each step. All patterns are periodic.
///
/// Contract: an offset depends on the arguments only, so that a resumed run has the positions of an uninterrupted one.
/// Its fraction is in 0 to 1; columns and rows may be of any size (patterns are periodic). A body with
/// [`PointRevisit::Permanent`] of [`visits`](Self::visits) keeps its offset, one that moves along its track keeps its
/// row. `Debug` prints the constants. `testing::roughness_motion` checks the contract.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{Offset, RoughnessMotion, PointRevisit};
///
/// /// Steps by one column each time.
/// #[derive(Debug)]
/// struct Creep;
/// impl RoughnessMotion for Creep {
///     fn offset(&self, _body: usize, draw: u64, _time: f64, _speed: f64, grid: &Grid) -> Offset {
///         Offset { columns: (draw % grid.nx() as u64) as usize, rows: 0, fraction: 0.0 }
///     }
///     fn visits(&self, _speed: f64) -> PointRevisit {
///         PointRevisit::Track
///     }
/// }
/// assert_eq!(Creep.offset(0, 70, 0.0, 0.1, &Grid::centred(64, 8, 1e-6, 1e-6)?).columns, 6);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub trait RoughnessMotion: Debug + Send + Sync {
    /// Offset of the pattern of `body` (0 the ball, 1 the disc) on `grid` at the `draw`-th solve, counted from 0, at
    /// `time` \[s\]; its surface moves at `speed` \[m/s\] along x.
    fn offset(&self, body: usize, draw: u64, time: f64, speed: f64, grid: &Grid) -> Offset;

    /// Points of the patch of a body moving at `speed` \[m/s\] that pass the contact, all equally often.
    fn visits(&self, speed: f64) -> PointRevisit;
}

/// Points of the patch of a body that pass the contact.
///
/// # Examples
///
/// ```
/// use stribeck::surface::{AlongTrack, Fixed, Advected, RandomShift, RoughnessMotion, PointRevisit};
/// assert_eq!(Fixed.visits(0.1), PointRevisit::Permanent);
/// assert_eq!((Advected.visits(0.1), Advected.visits(0.0)), (PointRevisit::Passing, PointRevisit::Permanent));
/// assert_eq!(AlongTrack { seed: 1 }.visits(0.1), PointRevisit::Track);
/// assert_eq!(RandomShift { seed: 1 }.visits(0.1), PointRevisit::Patch);
/// assert_eq!(RandomShift { seed: 1 }.visits(0.0), PointRevisit::Permanent);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PointRevisit {
    /// The same points at all times.
    Permanent,
    /// All points along x in sequence, as the body moves.
    Passing,
    /// All points along x, in any order.
    Track,
    /// All points along x and y.
    Patch,
}

/// The patterns do not move: the same peaks always meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Fixed;

impl RoughnessMotion for Fixed {
    fn offset(&self, _body: usize, _draw: u64, _time: f64, _speed: f64, _grid: &Grid) -> Offset {
        Offset::default()
    }

    fn visits(&self, _speed: f64) -> PointRevisit {
        PointRevisit::Permanent
    }
}

/// Each pattern moves along x with its body: after the time `t` it is `V t` downstream, between nodes by interpolation.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{Advected, RoughnessMotion};
/// let grid = Grid::centred(128, 128, 1e-6, 1e-6)?;
/// // 0.25 cells downstream: the grid is at points 0.25 cells upstream in the pattern.
/// let carried = Advected.offset(0, 0, 2.5e-6, 0.1, &grid);
/// assert_eq!(carried.columns, 127);
/// assert!((carried.fraction - 0.75).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Advected;

impl RoughnessMotion for Advected {
    fn offset(&self, _body: usize, _draw: u64, time: f64, speed: f64, grid: &Grid) -> Offset {
        let columns = (-speed * time / grid.dx()).rem_euclid(grid.nx() as f64);
        // A distance that is not finite counts as zero.
        let whole = if columns.is_finite() { columns.floor() } else { 0.0 };
        let fraction = if columns.is_finite() { columns - whole } else { 0.0 };
        Offset { columns: whole as usize % grid.nx().max(1), rows: 0, fraction }
    }

    fn visits(&self, speed: f64) -> PointRevisit {
        if speed == 0.0 { PointRevisit::Permanent } else { PointRevisit::Passing }
    }
}

/// Each pattern has a different position along the track at each solve, a whole number of nodes from its origin. Its
/// position across the track is fixed, so that a groove forms. A body at rest does not move.
///
/// The positions of ball and disc are an additive recurrence, `x_n = frac(s + n c)` of the patch, where `c` is the first
/// and second negative power of the real root of `g^3 = g + 1` and `s` depends on the seed. Positions of a body, and of
/// one body relative to the other, are distributed much more evenly than random ones, so that the mean over `n` solves
/// converges nearly with `1/n`. At solve 0 both patterns are at their origins.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{AlongTrack, Offset, RoughnessMotion};
/// let grid = Grid::centred(128, 96, 1e-6, 1e-6)?;
/// let motion = AlongTrack { seed: 3 };
/// assert_eq!(motion.offset(1, 0, 0.0, 0.1, &grid), Offset::default());
/// let columns: Vec<usize> = (1..129).map(|draw| motion.offset(1, draw, 0.0, 0.1, &grid).columns).collect();
/// // An eighth of the patch has an eighth of 128 positions.
/// let eighth = columns.iter().filter(|column| (32..48).contains(*column)).count();
/// assert!((15..=17).contains(&eighth));
/// assert_eq!(motion.offset(1, 9, 0.0, 0.0, &grid), Offset::default());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct AlongTrack {
    /// Seed of the positions.
    pub seed: u64,
}

/// `2^64/g` and `2^64/g^2` of the real root of `g^3 = g + 1`.
const RECURRENCE: [u64; 2] = [0xc13f_a9a9_02a6_328f, 0x91e1_0da5_c79e_7b1c];

impl RoughnessMotion for AlongTrack {
    fn offset(&self, body: usize, draw: u64, _time: f64, speed: f64, grid: &Grid) -> Offset {
        if draw == 0 || speed == 0.0 {
            return Offset::default();
        }
        let start = generator(self.seed, body, 0, b"at track").next_u64();
        let place = start.wrapping_add(RECURRENCE[body % 2].wrapping_mul(draw));
        Offset { columns: below(place, grid.nx()), rows: 0, fraction: 0.0 }
    }

    fn visits(&self, speed: f64) -> PointRevisit {
        if speed == 0.0 { PointRevisit::Permanent } else { PointRevisit::Track }
    }
}

/// Each pattern has a new random position at each solve, a whole number of nodes from its origin along x and y: no groove
/// forms. At solve 0 both patterns are at their origins; a body at rest stays there.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::surface::{Offset, RandomShift, RoughnessMotion};
/// let grid = Grid::centred(128, 128, 1e-6, 1e-6)?;
/// let motion = RandomShift { seed: 3 };
/// let offset = motion.offset(0, 17, 0.0, 0.1, &grid);
/// assert_eq!(offset, motion.offset(0, 17, 5.0, 0.2, &grid));
/// assert!(offset.columns < 128 && offset.rows < 128);
/// assert_eq!(motion.offset(0, 17, 0.0, 0.0, &grid), Offset::default());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct RandomShift {
    /// Seed of the positions.
    pub seed: u64,
}

impl RoughnessMotion for RandomShift {
    fn offset(&self, body: usize, draw: u64, _time: f64, speed: f64, grid: &Grid) -> Offset {
        if draw == 0 || speed == 0.0 {
            return Offset::default();
        }
        let mut generator = generator(self.seed, body, draw, b"position");
        let columns = below(generator.next_u64(), grid.nx());
        Offset { columns, rows: below(generator.next_u64(), grid.ny()), fraction: 0.0 }
    }

    fn visits(&self, speed: f64) -> PointRevisit {
        if speed == 0.0 { PointRevisit::Permanent } else { PointRevisit::Patch }
    }
}

/// Random deviates that are unique to a body, draw and purpose.
fn generator(seed: u64, body: usize, draw: u64, purpose: &[u8; 8]) -> ChaCha8Rng {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    bytes[8..16].copy_from_slice(&(body as u64).to_le_bytes());
    bytes[16..24].copy_from_slice(&draw.to_le_bytes());
    bytes[24..].copy_from_slice(purpose);
    ChaCha8Rng::from_seed(bytes)
}

/// Maps 64 random bits onto `0..count`.
fn below(bits: u64, count: usize) -> usize {
    ((u128::from(bits) * count as u128) >> 64) as usize
}
