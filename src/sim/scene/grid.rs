//! The grid of a scene.
//!
//! Cells of one size fill a box; nodes are at their centers. Whether the box contains the contact is checked when
//! the contact is built.

#[cfg(feature = "serde")]
use serde::ser::SerializeMap as _;

use super::{Roughness, Scene};
use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::scene::hertz::LINE_LENGTH;

/// Default period of a strip, in correlation lengths of its roughness.
const PERIOD: f64 = 5.0;

/// The grid, or the accuracy that it is chosen for.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::GridSpec;
/// let mut scene = Scene::azam_2019(32);
/// scene.grid = GridSpec::Cells { nx: 48, ny: 24, x: [-0.4e-3, 0.2e-3], y: [-0.15e-3, 0.15e-3] };
/// let grid = scene.grid()?;
/// assert_eq!((grid.nx(), grid.ny()), (48, 24));
/// assert!((grid.dx() - 12.5e-6).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum GridSpec {
    /// Cells that fill a box. A line contact is solved on one row of them; `ny` and `y` are checked but not used.
    Cells {
        /// Cells along x.
        nx: usize,
        /// Cells along y.
        ny: usize,
        /// Outer edges along x \[m\]; flow is in the direction +x.
        x: [f64; 2],
        /// Outer edges along y \[m\].
        y: [f64; 2],
    },
    /// Initial cells of a history whose box doubles in width when solid contact, wear or a tribofilm reaches its
    /// edge (`grows = true` in a file).
    Growing {
        /// Cells along x.
        nx: usize,
        /// Cells along y.
        ny: usize,
        /// Outer edges along x \[m\]; flow is in the direction +x.
        x: [f64; 2],
        /// Outer edges along y \[m\].
        y: [f64; 2],
    },
    /// The cells of a line contact.
    Row {
        /// Cells along x.
        nx: usize,
        /// Outer edges along x \[m\]; flow is in the direction +x.
        x: [f64; 2],
    },
    /// The cells of a strip: a line contact whose surfaces repeat across the flow (`across = "periodic"` in a file).
    Strip {
        /// Cells along x.
        nx: usize,
        /// Cells along y.
        ny: usize,
        /// Outer edges along x \[m\]; flow is in the direction +x.
        x: [f64; 2],
        /// Outer edges along y \[m\], a period apart; `None` for a period of five correlation lengths along y of the
        /// random roughness.
        y: Option<[f64; 2]>,
    },
    /// Box and cells are chosen for a target error, which is estimated from coarser grids. For a smooth contact it
    /// is the relative error of the central film (dry: of the maximum pressure), for a rough one that of
    /// [`SolverSpec::accuracy`](super::SolverSpec::accuracy). Single contacts only. Heights must be normal with a
    /// shortest wavelength (Gaussian autocorrelation, or self-affine with a cutoff), which sets the first cells.
    Accuracy {
        /// Target error.
        accuracy: f64,
    },
}

impl GridSpec {
    /// The same box with `count` of the cells along each side.
    pub(in crate::sim) fn with_counts(self, count: impl Fn(usize) -> usize) -> Self {
        match self {
            Self::Cells { nx, ny, x, y } => Self::Cells { nx: count(nx), ny: count(ny), x, y },
            Self::Growing { nx, ny, x, y } => Self::Growing { nx: count(nx), ny: count(ny), x, y },
            Self::Row { nx, x } => Self::Row { nx: count(nx), x },
            Self::Strip { nx, ny, x, y } => Self::Strip { nx: count(nx), ny: count(ny), x, y },
            Self::Accuracy { .. } => self,
        }
    }

    /// The same box with `cells` along x, and cells along y in proportion.
    #[cfg(feature = "benchmark")]
    pub(crate) fn with_nx(self, cells: usize) -> Self {
        let before = self.nx().max(1) as f64;
        let share = cells as f64 / before;
        self.with_counts(|count| ((share * count as f64).round() as usize).max(1))
    }

    /// Cells along x; 0 if they are not given.
    #[cfg(feature = "benchmark")]
    pub(crate) fn nx(&self) -> usize {
        match self {
            Self::Cells { nx, .. }
            | Self::Growing { nx, .. }
            | Self::Row { nx, .. }
            | Self::Strip { nx, .. } => *nx,
            Self::Accuracy { .. } => 0,
        }
    }

    /// Whether the box of a history grows.
    pub(in crate::sim) fn grows(&self) -> bool {
        matches!(self, Self::Growing { .. })
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for GridSpec {
    /// The keys of `[grid]`.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut keys = serializer.serialize_map(None)?;
        match self {
            Self::Cells { nx, ny, x, y } | Self::Growing { nx, ny, x, y } => {
                keys.serialize_entry("nx", nx)?;
                keys.serialize_entry("ny", ny)?;
                keys.serialize_entry("x", x)?;
                keys.serialize_entry("y", y)?;
                if self.grows() {
                    keys.serialize_entry("grows", &true)?;
                }
            }
            Self::Row { nx, x } => {
                keys.serialize_entry("nx", nx)?;
                keys.serialize_entry("x", x)?;
            }
            Self::Strip { nx, ny, x, y } => {
                keys.serialize_entry("across", "periodic")?;
                keys.serialize_entry("nx", nx)?;
                keys.serialize_entry("ny", ny)?;
                keys.serialize_entry("x", x)?;
                if let Some(y) = y {
                    keys.serialize_entry("y", y)?;
                }
            }
            Self::Accuracy { accuracy } => keys.serialize_entry("accuracy", accuracy)?,
        }
        keys.end()
    }
}

impl Scene {
    /// The grid; for a line contact one row of cells one metre wide, or a strip.
    ///
    /// # Errors
    /// Cells or edges out of range; a row or a strip for a point contact; a strip without a period; an accuracy in place
    /// of a grid.
    pub fn grid(&self) -> Result<Grid, InputError> {
        let row = |nx, x| Grid::from_edges(nx, 1, x, [-0.5 * LINE_LENGTH, 0.5 * LINE_LENGTH]);
        let conflict = |field: &str, reason: &str| {
            Err(InputError::Conflict { field: field.to_owned(), reason: reason.to_owned() })
        };
        match self.grid {
            GridSpec::Cells { nx, ny, x, y } | GridSpec::Growing { nx, ny, x, y } => {
                let grid = Grid::from_edges(nx, ny, x, y)?;
                if self.form.is_line() { row(nx, x) } else { Ok(grid) }
            }
            GridSpec::Row { nx, x } if self.form.is_line() => row(nx, x),
            GridSpec::Row { .. } => conflict("grid", "ny and y are missing; only a cylinder can omit them"),
            GridSpec::Strip { nx, ny, x, y } if self.form.is_line() => {
                Grid::strip(nx, ny, x, y.map_or_else(|| self.default_period(), Ok)?)
            }
            GridSpec::Strip { .. } => conflict(
                "grid.across",
                "only a line contact repeats across the flow; use form.kind = \"cylinder\"",
            ),
            GridSpec::Accuracy { .. } => {
                conflict("grid.accuracy", "only a single contact picks its grid, this needs nx, ny, x and y")
            }
        }
    }

    /// Whether the contact is a strip.
    pub(in crate::sim) fn is_strip(&self) -> bool {
        matches!(self.grid, GridSpec::Strip { .. })
    }

    /// Edges along y of a strip without given ones \[m\].
    fn default_period(&self) -> Result<[f64; 2], InputError> {
        let bodies = [&self.roughness.ball, &self.roughness.disc];
        let longest = bodies.into_iter().filter_map(Roughness::length_across).fold(0.0, f64::max);
        if longest > 0.0 {
            let half = 0.5 * PERIOD * longest;
            return Ok([-half, half]);
        }
        Err(InputError::Conflict {
            field: "grid.y".to_owned(),
            reason: "is missing; its default, five correlation lengths along y, needs random roughness"
                .to_owned(),
        })
    }
}
