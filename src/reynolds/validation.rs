//! Checks of a contact problem.

use super::flow::require_spin;
use super::inner_nodes::interior;
use super::problem::LubricatedContact;
use crate::error::{InputError, format_number};
use crate::grid::Grid;
use crate::lubricant::Lubricant;

impl LubricatedContact<'_> {
    /// Checks shapes and ranges of every field.
    ///
    /// # Errors
    /// An [`InputError`] naming the first invalid field, or a load that the pressure limit cannot carry, with the
    /// largest possible load.
    pub fn validate(&self) -> Result<(), InputError> {
        let grid = self.grid();
        grid.require_field("gap", self.gap)?;
        InputError::require_positive("load", self.load)?;
        InputError::require_positive("reference_half_widths.0", self.reference_half_widths.0)?;
        InputError::require_positive("reference_half_widths.1", self.reference_half_widths.1)?;
        InputError::require_positive("reference_pressure", self.reference_pressure)?;
        InputError::require_non_negative("reference_film", self.reference_film)?;
        // The stencil needs two nodes on each side.
        InputError::require(grid.nx() >= 5, "grid.nx", grid.nx() as f64, "at least 5 for a contact solve")?;
        InputError::require(
            grid.ny() == 1 || grid.ny() >= 5,
            "grid.ny",
            grid.ny() as f64,
            "at least 5 for a contact solve, or 1 for a line contact",
        )?;
        // Oil and its supply.
        if self.lubricant.is_some() {
            InputError::require_positive("film_cutoff", self.film_cutoff)?;
            if self.squeeze.is_none() || self.entrainment_speed != 0.0 {
                require_speed("entrainment_speed", self.entrainment_speed)?;
            }
            let films = self.lubricant.map_or(&[][..], Lubricant::film_temperatures);
            if !films.is_empty() {
                InputError::require_len("lubricant.film_temperatures", films, grid.len())?;
            }
            if let Some(radius) = self.spin_radius {
                require_spin(("spin_radius", radius), &grid, self.supplied_film.is_some(), !self.is_hard())?;
                require_speed("entrainment_speed", self.entrainment_speed)?;
            }
            if let Some(film) = self.supplied_film {
                InputError::require_positive("supplied_film", film)?;
                self.cavitation.require_conserved("supplied_film", film)?;
            }
        }
        // Edges and squeeze.
        if let Some(edge) = self.edge_pressure {
            grid.require_field("edge_pressure.field", edge.field)?;
            let low = edge.field.iter().copied().fold(0.0, f64::min);
            InputError::require_non_negative("edge_pressure.field", low)?;
            let outside = edge.load_outside.unwrap_or(0.0);
            let fits = outside >= 0.0 && outside < self.load;
            let requirement = "at least 0 and less than the load";
            InputError::require(fits, "edge_pressure.load_outside", outside, requirement)?;
        }
        if let Some(squeeze) = self.squeeze {
            InputError::require_positive("squeeze.time_step", squeeze.time_step)?;
            grid.require_field("squeeze.previous_mass", squeeze.previous_mass)?;
        }
        self.validate_limit(&grid)
    }

    fn validate_limit(&self, grid: &Grid) -> Result<(), InputError> {
        let Some(limit) = self.pressure_limit else { return Ok(()) };
        grid.require_field("pressure_limit", limit)?;
        if let Some(&low) = limit.iter().find(|&&p| p <= 0.0) {
            InputError::require_positive("pressure_limit", low)?;
        }
        // The load that all inner nodes carry at the limit.
        let largest: f64 = interior(grid).map(|k| limit[k]).sum::<f64>() * grid.cell_area();
        let Some(load) = self.box_load() else { return Ok(()) };
        if load >= largest {
            return Err(InputError::Conflict {
                field: format!("load = {}", format_number(self.load)),
                reason: format!(
                    "the inner nodes of the box carry less than {largest:.6e} N at the pressure limit; take less load, or harder bodies"
                ),
            });
        }
        Ok(())
    }
}

/// Smallest entrainment speed of a film \[m/s\]: at smaller ones the entrainment is lost to rounding in the
/// single-precision linear systems of Newton's method.
pub(crate) const LEAST_SPEED: f64 = 1e-15;
/// Requirement of [`require_speed`].
pub(crate) const SPEED_REQUIREMENT: &str =
    "finite and >= 1e-15: the oil flows along +x; mirror the scene in x for the other direction";

/// Rejects an entrainment speed \[m/s\] that entrains no film.
pub(crate) fn require_speed(field: &str, speed: f64) -> Result<(), InputError> {
    InputError::require(speed.is_finite() && speed >= LEAST_SPEED, field, speed, SPEED_REQUIREMENT)
}
