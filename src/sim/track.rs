//! What a history leaves on the track: means over its width, its profile, and the roughness on it.

use super::body::Body;
use super::simulation::MixedLubricationSim;
use crate::error::InputError;
use crate::metrics;

impl MixedLubricationSim {
    /// Mean of `field`, one value per node of a body's patch, over the width of the track, `|y| <= a` with the half-width `a` of
    /// the Hertz contact across; cells count by their share of it. The box does not change it.
    ///
    /// # Errors
    /// A field of another length than the grid.
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
        let (grid, half_width) = (self.contact.grid, self.contact.hertz.a_y);
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
        body.wear_depth().chunks_exact(nx).map(|row| row.iter().sum::<f64>() / nx as f64).collect()
    }

    /// Heights of `body` without the form of the track \[m\]: see [`metrics::without_track_form`].
    pub fn roughness(&self, body: &Body) -> Vec<f64> {
        metrics::without_track_form(body.surface(), self.contact.grid.nx())
    }
}
