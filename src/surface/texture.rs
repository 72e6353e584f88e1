//! Textures: dimples and grooves.

use chacha20::ChaCha8Rng;
use chacha20::rand_core::{Rng, SeedableRng};

use crate::error::InputError;
use crate::grid::Grid;

/// A flat with recesses, periodic with the grid: 0 on the flat, negative in the recesses.
///
/// ```
/// use stribeck::{Grid, surface::{DimpleLayout, Texture}};
/// let grid = Grid::centred(200, 200, 1e-6, 1e-6)?;
/// let texture = Texture::Dimples { radius: 20e-6, depth: 1e-6, pitch: 50e-6, layout: DimpleLayout::Square };
/// let heights = texture.generate(&grid)?;
/// let share = heights.iter().filter(|z| **z < 0.0).count() as f64 / heights.len() as f64;
/// assert!((share / (std::f64::consts::PI * 0.16) - 1.0).abs() < 0.02);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Texture {
    /// Round dimples with the profile `-depth (1 - (r/radius)^2)`.
    Dimples {
        /// Radius of the rim \[m\].
        radius: f64,
        /// Depth at the center \[m\].
        depth: f64,
        /// Pitch of the centers along x and y \[m\], rounded to a divisor of the grid size; at least twice the radius.
        pitch: f64,
        /// Arrangement of the centers.
        layout: DimpleLayout,
    },
    /// Straight grooves with the profile `-depth (1 - (2 s/width)^2)` across them.
    Grooves {
        /// Width \[m\].
        width: f64,
        /// Depth in the middle \[m\].
        depth: f64,
        /// Pitch \[m\], rounded to a divisor of the grid size; above the width.
        pitch: f64,
        /// Direction; at crossings the larger depth counts.
        direction: GrooveDirection,
    },
}

/// Arrangement of the centers of dimples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum DimpleLayout {
    /// On a square lattice.
    Square,
    /// Random within the cells of that lattice, without overlap and isotropic at short range.
    Random {
        /// Seed: equal seeds give equal surfaces.
        seed: u64,
    },
}

/// Direction of grooves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum GrooveDirection {
    /// Along x, the direction of motion.
    AlongX,
    /// Along y.
    AlongY,
    /// Both: equal properties along x and y.
    Crossed,
}

impl Texture {
    /// Heights \[m\] at the nodes of `grid`.
    ///
    /// # Errors
    /// Lengths that are not positive, a pitch too small for its recesses or larger than the grid.
    ///
    /// ```
    /// use stribeck::{Grid, surface::{GrooveDirection, Texture}};
    /// let grid = Grid::centred(100, 4, 1e-6, 1e-6)?;
    /// let grooves = Texture::Grooves { width: 10e-6, depth: 1e-6, pitch: 25e-6, direction: GrooveDirection::AlongY };
    /// let mean = grooves.generate(&grid)?.iter().sum::<f64>() / 400.0;
    /// assert!((mean / (-2.0 / 3.0 * 1e-6 * 10.0 / 25.0) - 1.0).abs() < 0.01);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn generate(&self, grid: &Grid) -> Result<Vec<f64>, InputError> {
        match *self {
            Self::Dimples { radius, depth, pitch, layout } => dimples(grid, radius, depth, pitch, layout),
            Self::Grooves { width, depth, pitch, direction } => grooves(grid, width, depth, pitch, direction),
        }
    }
}

/// Heights of dimples \[m\].
fn dimples(
    grid: &Grid,
    radius: f64,
    depth: f64,
    pitch: f64,
    layout: DimpleLayout,
) -> Result<Vec<f64>, InputError> {
    InputError::require_positive("texture.radius", radius)?;
    InputError::require_positive("texture.depth", depth)?;
    let (across, along) =
        (Repeats::new(grid.size_x(), grid.nx(), pitch)?, Repeats::new(grid.size_y(), grid.ny(), pitch)?);
    let narrow = across.pitch.min(along.pitch);
    let apart = narrow >= 2.0 * radius;
    InputError::require(apart, "texture.pitch", narrow, "at least twice the radius, rounded")?;
    let centres = centres(&across, &along, radius, layout);
    Ok(field(grid, |x, y| {
        let (i, j) = (across.cell(x), along.cell(y));
        let (cx, cy) = centres[j * across.count + i];
        let square = ((x - cx).powi(2) + (y - cy).powi(2)) / (radius * radius);
        depth * (square - 1.0).min(0.0)
    }))
}

/// Heights of grooves \[m\].
fn grooves(
    grid: &Grid,
    width: f64,
    depth: f64,
    pitch: f64,
    direction: GrooveDirection,
) -> Result<Vec<f64>, InputError> {
    InputError::require_positive("texture.width", width)?;
    InputError::require_positive("texture.depth", depth)?;
    let groove = |repeats: &Repeats, s: f64| {
        let from_middle = s - (repeats.cell(s) as f64 + 0.5) * repeats.pitch;
        depth * ((2.0 * from_middle / width).powi(2) - 1.0).min(0.0)
    };
    let repeats = |size: f64, nodes: usize| {
        let repeats = Repeats::new(size, nodes, pitch)?;
        let apart = repeats.pitch > width;
        InputError::require(apart, "texture.pitch", repeats.pitch, "above the width, rounded")?;
        Ok::<_, InputError>(repeats)
    };
    Ok(match direction {
        GrooveDirection::AlongX => {
            let across = repeats(grid.size_y(), grid.ny())?;
            field(grid, |_, y| groove(&across, y))
        }
        GrooveDirection::AlongY => {
            let across = repeats(grid.size_x(), grid.nx())?;
            field(grid, |x, _| groove(&across, x))
        }
        GrooveDirection::Crossed => {
            let (across, along) = (repeats(grid.size_x(), grid.nx())?, repeats(grid.size_y(), grid.ny())?);
            field(grid, |x, y| groove(&across, x).min(groove(&along, y)))
        }
    })
}

/// Heights from the distances of the nodes to the lower edges of the grid.
fn field(grid: &Grid, height: impl Fn(f64, f64) -> f64) -> Vec<f64> {
    let (x0, y0) = (grid.x(0) - 0.5 * grid.dx(), grid.y(0) - 0.5 * grid.dy());
    grid.nodes().map(|(x, y)| height(x - x0, y - y0)).collect()
}

/// A whole number of equal lengths in the grid.
struct Repeats {
    /// Number of repeats along the axis.
    count: usize,
    pitch: f64,
}

impl Repeats {
    fn new(size: f64, nodes: usize, pitch: f64) -> Result<Self, InputError> {
        InputError::require_positive("texture.pitch", pitch)?;
        let count = (size / pitch).round();
        let fits = (1.0..=nodes as f64).contains(&count);
        InputError::require(fits, "texture.pitch", pitch, "between the spacing and the size of the grid")?;
        Ok(Self { count: count as usize, pitch: size / count })
    }

    /// Index of the repeat at the position `s`.
    fn cell(&self, s: f64) -> usize {
        ((s / self.pitch) as usize).min(self.count - 1)
    }
}

/// Positions of the centers of dimples \[m\].
fn centres(across: &Repeats, along: &Repeats, radius: f64, layout: DimpleLayout) -> Vec<(f64, f64)> {
    let mut seed = [0; 32];
    if let DimpleLayout::Random { seed: number } = layout {
        seed[..8].copy_from_slice(&number.to_le_bytes());
    }
    let mut random = ChaCha8Rng::from_seed(seed);
    let mut place = |cell: usize, pitch: f64| {
        let share = match layout {
            DimpleLayout::Square => 0.5,
            // 53 bits, the precision of a double
            DimpleLayout::Random { .. } => (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64,
        };
        cell as f64 * pitch + radius + share * (pitch - 2.0 * radius)
    };
    let cells = (0..along.count).flat_map(|j| (0..across.count).map(move |i| (i, j)));
    cells.map(|(i, j)| (place(i, across.pitch), place(j, along.pitch))).collect()
}
