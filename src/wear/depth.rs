//! Worn depth of a body.

use super::WearLaw;
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// Worn depth \[m\] of a body at the nodes of its own surface; it never decreases.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::wear::{Archard, WearDepth};
/// let at = SurfaceState::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_sliding_speed(0.005).with_in_contact(true);
/// let mut wear = WearDepth::new(2);
/// wear.advance(&Archard::azam_2019(), 7200.0, |_| (at, 0.0))?;
/// assert!((wear.values()[0] - 327e-9).abs() < 1e-12); // 5.45e-8 / 6 GPa x 1 GPa x 36 m
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, PartialEq)]
pub struct WearDepth {
    /// Worn depth of each node \[m\].
    values: Vec<f64>,
}

impl Clone for WearDepth {
    fn clone(&self) -> Self {
        Self { values: self.values.clone() }
    }

    /// Copies into the existing buffers.
    fn clone_from(&mut self, source: &Self) {
        self.values.clone_from(&source.values);
    }
}

impl WearDepth {
    /// An unworn body of `n_nodes` nodes.
    pub fn new(n_nodes: usize) -> Self {
        Self { values: vec![0.0; n_nodes] }
    }

    /// A body with the worn depth `values` \[m\].
    ///
    /// # Errors
    /// A depth that is negative or not finite.
    pub fn from_values(values: Vec<f64>) -> Result<Self, InputError> {
        for &value in &values {
            InputError::require_non_negative("wear.depth", value)?;
        }
        Ok(Self { values })
    }

    /// Worn depth of every node \[m\].
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Wears every node for `time_step` \[s\] at the rate of `law` under `point(node)`: the state of the node on the body's
    /// own surface, and its film thickness \[m\]. Allocates nothing. The film is that at the start of the step, which is
    /// first-order in time if it changes.
    ///
    /// # Errors
    /// A time step that is negative or not finite: nothing is worn. A wear rate that is negative or not finite: earlier nodes
    /// are already worn; the error names the rate.
    pub fn advance(
        &mut self,
        law: &dyn WearLaw,
        time_step: f64,
        mut point: impl FnMut(usize) -> (SurfaceState, f64),
    ) -> Result<(), InputError> {
        InputError::require_non_negative("time_step", time_step)?;
        for (node, value) in self.values.iter_mut().enumerate() {
            let (at, film_thickness) = point(node);
            let rate = law.depth_rate(&at, film_thickness);
            InputError::require_non_negative("wear rate of the law", rate)?;
            *value += rate * time_step;
        }
        Ok(())
    }

    /// The same for the states `at` and films `film_thickness` \[m\], one per node, by a law that may evaluate all nodes at
    /// once. `rates`, of the same length, is overwritten with the wear rates \[m/s\].
    ///
    /// # Errors
    /// As of [`advance`](Self::advance), and slices whose length is not the number of nodes: nothing is worn.
    pub fn advance_all(
        &mut self,
        law: &dyn WearLaw,
        time_step: f64,
        (at, film_thickness): (&[SurfaceState], &[f64]),
        rates: &mut [f64],
    ) -> Result<(), InputError> {
        InputError::require_non_negative("time_step", time_step)?;
        InputError::require_len("at", at, self.values.len())?;
        InputError::require_len("film_thickness", film_thickness, self.values.len())?;
        InputError::require_len("rates", rates, self.values.len())?;
        law.depth_rates(at, film_thickness, rates);
        for &rate in &*rates {
            InputError::require_non_negative("wear rate of the law", rate)?;
        }
        self.values.iter_mut().zip(&*rates).for_each(|(value, rate)| *value += rate * time_step);
        Ok(())
    }

    /// Worn volume \[m^3\] on cells of `cell_area` \[m^2\].
    pub fn volume(&self, cell_area: f64) -> f64 {
        self.values.iter().sum::<f64>() * cell_area
    }
}
