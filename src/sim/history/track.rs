//! Evaluation on the track: means over its width, its profile and its roughness.

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::contact::numbers::Scar;
use crate::sim::history::body::Body;
use crate::sim::history::exposure;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::worn_form::scar_rq;
use crate::surface::PointRevisit;

/// Half the length along x of the middle of a scar, over the Hertz half-width.
const MIDDLE: f64 = 0.25;

impl MixedLubricationSim {
    /// Mean of `field`, one value per node of a body's patch, over the width of the track, `|y| <= a`, where `a` is
    /// the Hertz half-width along y under the largest load of the schedule: the width is the same in all steps. Cells
    /// are weighted by their part within the track. The mean does not depend on the box. The track of a line contact is
    /// the whole width.
    ///
    /// # Errors
    /// A field whose length differs from the grid.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let sim = MixedLubricationSim::builder(Scene::azam_2019(32)).build()?;
    /// let grid = sim.grid();
    /// let inside: Vec<f64> = grid.nodes().map(|(_, y)| if y.abs() < 1.2e-4 { 2.0 } else { 0.0 }).collect();
    /// assert!((sim.mean_on_track(&vec![1.0; grid.len()])? - 1.0).abs() < 1e-12);
    /// assert!(sim.mean_on_track(&inside)? > 1.5);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn mean_on_track(&self, field: &[f64]) -> Result<f64, InputError> {
        let grid = self.contact.grid;
        let [_, largest] = self.operating_schedule.loads();
        let half_width = self.contact.hertz_under(&self.scene, largest)?.half_extents()[1];
        InputError::require_len("field", field, grid.len())?;
        let (mut sum, mut width) = (0.0, 0.0);
        for (j, row) in field.chunks_exact(grid.nx()).enumerate() {
            let (low, high) = (grid.y(j) - 0.5 * grid.dy(), grid.y(j) + 0.5 * grid.dy());
            let share = (high.min(half_width) - low.max(-half_width)).max(0.0);
            sum += share * row.iter().sum::<f64>();
            width += share * row.len() as f64;
        }
        Ok(if width > 0.0 { sum / width } else { 0.0 })
    }

    /// Worn depth of `body` across the track, one value per row of the grid: the mean along x \[m\].
    pub fn worn_profile(&self, body: &Body) -> Vec<f64> {
        let nx = self.contact.grid.nx();
        body.wear().chunks_exact(nx).map(|row| row.iter().sum::<f64>() / nx as f64).collect()
    }

    /// The worn scars of ball and disc, whose surfaces move at `speeds` \[m/s\].
    ///
    /// The profile across the track is the mean along x; of a body whose points stay in the contact it is the mean over
    /// the middle quarter of the Hertz contact along x. The profile of a cylinder at rest is that along x, of a strip the
    /// mean over its rows.
    pub(in crate::sim) fn scars(&self, speeds: [f64; 2]) -> [Scar; 2] {
        let grid = &self.contact.grid;
        let (nx, is_line) = (grid.nx(), !grid.has_side_edges());
        let middle = (MIDDLE * self.contact.hertz.half_extents()[0]).max(0.51 * grid.dx());
        std::array::from_fn(|body| {
            let (wear, motion) = (self.bodies[body].wear(), self.surface_motion.motion.as_ref());
            let stays = exposure::visits(motion, speeds[body]) == PointRevisit::Permanent;
            if is_line && stays {
                let rows = grid.ny() as f64;
                return Scar::of_profile(nx, grid.dx(), |i| wear[i..].iter().step_by(nx).sum::<f64>() / rows);
            }
            let counts = |i: &usize| !stays || grid.x(*i).abs() <= middle;
            let columns = (0..nx).filter(counts).count().max(1) as f64;
            let row = |j: usize| {
                let worn = (0..nx).filter(counts).map(|i| wear[j * nx + i]);
                worn.sum::<f64>() / columns
            };
            if is_line {
                let depth = (0..grid.ny()).map(row).sum::<f64>() / grid.ny() as f64;
                return Scar { width: None, depth };
            }
            Scar::of_profile(grid.ny(), grid.dy(), row)
        })
    }

    /// Roughness on the track \[m\]: the rows of `heights` (one value per node of a body's patch) within `|y| <= a`,
    /// each minus its mean along x. A groove is constant along the track, so its profile is removed with the
    /// means. Roughness as long as the patch is removed too: for isotropic roughness of correlation length `b` in
    /// a patch of length `L`, a fraction of order `b/L` of the mean square. Rows outside the track are excluded.
    ///
    /// # Errors
    /// A field whose length differs from the grid.
    ///
    /// ```
    /// use stribeck::metrics::height_statistics;
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(32)).build()?;
    /// let roughness = sim.track_roughness(sim.bodies()[1].surface())?;
    /// let record = sim.step(10.0)?;
    /// assert!((height_statistics(&roughness)?.sq / record.roughness.disc_rq - 1.0).abs() < 1e-9);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn track_roughness(&self, heights: &[f64]) -> Result<Vec<f64>, InputError> {
        let rows = self.track_rows(heights)?.flat_map(|(row, mean)| row.iter().map(move |z| z - mean));
        Ok(rows.collect())
    }

    /// Root mean square roughness of both bodies in the present contact \[m\]: of [`track_roughness`](Self::track_roughness),
    /// and of a body worn at the same points at all times about the form of its scar.
    pub(in crate::sim) fn roughness(&self) -> [f64; 2] {
        let (grid, hertz) = (&self.contact.grid, &self.contact.hertz);
        let speeds = self.conditions().motion.surface_speeds();
        std::array::from_fn(|body| {
            let heights = self.bodies[body].surface();
            let visits = exposure::visits(self.surface_motion.motion.as_ref(), speeds[body]);
            let is_worn = || self.bodies[body].wear().iter().any(|depth| *depth > 0.0);
            if visits == PointRevisit::Permanent && is_worn() {
                scar_rq(grid, &hertz.ellipse(), heights)
            } else {
                track_rq(grid, hertz.half_extents()[1], heights)
            }
        })
    }

    /// The rows of the track and their means.
    fn track_rows<'a>(&self, field: &'a [f64]) -> Result<impl Iterator<Item = (&'a [f64], f64)>, InputError> {
        InputError::require_len("field", field, self.contact.grid.len())?;
        Ok(track_rows(&self.contact.grid, self.contact.hertz.half_extents()[1], field))
    }
}

/// Root mean square of the rows of `heights` on `grid` within `|y| <= half_width`, each about its mean \[m\].
pub(in crate::sim) fn track_rq(grid: &Grid, half_width: f64, heights: &[f64]) -> f64 {
    let (mut square, mut count) = (0.0, 0);
    for (row, mean) in track_rows(grid, half_width, heights) {
        square += row.iter().map(|z| (z - mean).powi(2)).sum::<f64>();
        count += row.len();
    }
    if count > 0 { (square / count as f64).sqrt() } else { 0.0 }
}

/// Rows of `field` on `grid` within `|y| <= half_width` \[m\], each with its mean.
fn track_rows<'a>(
    grid: &Grid,
    half_width: f64,
    field: &'a [f64],
) -> impl Iterator<Item = (&'a [f64], f64)> + use<'a> {
    let grid = *grid;
    let rows = field.chunks_exact(grid.nx()).enumerate();
    let within = rows.filter(move |(j, _)| grid.y(*j).abs() <= half_width);
    within.map(|(_, row)| (row, row.iter().sum::<f64>() / row.len() as f64))
}
