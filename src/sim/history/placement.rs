//! Relative position of the bodies: offsets of the roughness, and the fields of the contact there.
//!
//! Both bodies are periodic patches of the size of the grid. An [`Offset`] is the shift of a patch against the
//! contact in cells and a fraction of a cell. The gap of the undeformed bodies is `form - ball - disc`, with
//! both heights shifted.

use std::sync::Arc;

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::history::body::Body;
use crate::surface::{FourierShift, Offset, RoughnessMotion, blend_shifted, copy_shifted};

/// Offsets of the roughness of ball and disc.
pub(in crate::sim) type Offsets = [Offset; 2];

/// Motion of the surfaces between steps.
#[derive(Debug, Clone)]
pub(in crate::sim) struct SurfaceMotion {
    /// Motion of the roughness.
    pub(in crate::sim) motion: Arc<dyn RoughnessMotion>,
    /// Whether the film has a squeeze term.
    pub(in crate::sim) squeeze: bool,
}

impl SurfaceMotion {
    /// Offsets of the roughness within the patch at the time `time` \[s\], after `draws` random positions, with
    /// bodies whose mean speeds since the start are `speeds` \[m/s\].
    pub(in crate::sim) fn offsets(
        &self,
        draws: u64,
        time: f64,
        speeds: [f64; 2],
        grid: &Grid,
    ) -> Result<Offsets, InputError> {
        let [ball, disc] = [0, 1].map(|body| self.motion.offset(body, draws, time, speeds[body], grid));
        ball.validate_as("motion: offset.fraction of the ball")?;
        disc.validate_as("motion: offset.fraction of the disc")?;
        Ok([ball, disc].map(|offset| Offset {
            columns: offset.columns % grid.nx(),
            rows: offset.rows % grid.ny(),
            ..offset
        }))
    }
}

/// Fields of both bodies in the frame of the contact, row-major on its grid.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Placement {
    grid: Grid,
    /// Shifts heights by less than a cell.
    between_nodes: FourierShift,
    /// Heights of the body being placed \[m\].
    heights: Vec<f64>,
    /// Gap of the undeformed bodies \[m\]: form minus the heights of both.
    pub(in crate::sim) gap: Vec<f64>,
    /// Tribofilms \[m\].
    pub(in crate::sim) films: [Vec<f64>; 2],
    /// Plastic depths \[m\].
    pub(in crate::sim) depths: [Vec<f64>; 2],
}

impl Placement {
    /// Fields of zeros on `grid`.
    pub(in crate::sim) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        let pair = || [zeros(), zeros()];
        Self {
            grid,
            between_nodes: FourierShift::new(grid.nx()),
            heights: zeros(),
            gap: zeros(),
            films: pair(),
            depths: pair(),
        }
    }

    /// Overwrites the fields with those of `bodies` at `offsets`; `form` \[m\] is the gap of the smooth bodies.
    /// Heights between nodes are interpolated by Fourier series, films and depths linearly, so that they stay
    /// non-negative.
    pub(in crate::sim) fn place(
        &mut self,
        bodies: &[Body; 2],
        form: &[f64],
        offsets: Offsets,
    ) -> Result<(), InputError> {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        self.gap.copy_from_slice(form);
        for (index, body) in bodies.iter().enumerate() {
            let offset = offsets[index];
            if offset.fraction == 0.0 {
                copy_shifted(&body.surface, nx, ny, (offset.columns, offset.rows), &mut self.heights)?;
            } else {
                self.between_nodes.apply(&body.surface, ny, offset, &mut self.heights)?;
            }
            for (gap, z) in self.gap.iter_mut().zip(&self.heights) {
                *gap -= z;
            }
            blend_shifted(body.tribofilm(), nx, ny, offset, &mut self.films[index])?;
            blend_shifted(body.plastic_depth(), nx, ny, offset, &mut self.depths[index])?;
        }
        Ok(())
    }
}
