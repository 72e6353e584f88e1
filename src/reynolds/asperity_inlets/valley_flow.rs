//! Flow through the valleys between the asperities of a dry contact.

use super::flank::half_interval;
use crate::grid::Grid;
use crate::lubricant::{Barus, Incompressible, Lubricant};
use crate::report::Status;
use crate::reynolds::{FilmThickness, GivenFilm, ReynoldsError};

/// Relative change of a film up to which the flow of earlier films holds. The flow errs by three times as much.
const SAME_FILM: f64 = 1e-3;

/// Largest number of Newton steps on one grid: most flows take 4 to 20, those between worn bodies up to 70.
const MOST_STEPS: u64 = 100;
/// Imbalance of the flow over the inflow.
const IMBALANCE: f64 = 1e-4;

/// Rise of the reduced pressure from the edge of the box through the valleys, over `12 eta0 u`.
///
/// The bodies are rigid and as far apart as those of the dry contact plus the contact film. Mass is conserved where the
/// fluid cavitates. The reduced pressure of this flow is that of an incompressible fluid of constant viscosity, which is
/// proportional to viscosity and speed: one solve serves all speeds.
#[derive(Debug, Default, Clone)]
pub(super) struct ValleyFlow {
    /// Films of the flow \[m\].
    film: Vec<f64>,
    /// Rise at the nodes \[1/m\]; empty if the flow did not converge.
    rise: Vec<f64>,
}

impl ValleyFlow {
    /// Solves for the flow between bodies with this `gap` \[m\], if their films are not those of the last solve. Ends with
    /// an error soon after `must_stop` returns true.
    pub(super) fn update(
        &mut self,
        grid: Grid,
        gap: &[f64],
        contact_film: f64,
        must_stop: impl Fn() -> bool,
    ) -> Result<(), ReynoldsError> {
        let film: Vec<f64> = gap.iter().map(|gap| gap.max(0.0) + contact_film).collect();
        if self.is_of(&film) {
            return Ok(());
        }
        // Viscosity and speed are one: the pressure is the rise times twelve.
        let thickness = FilmThickness::from_halves(grid, &film, |near, far, length| {
            half_interval(near, far, length, contact_film)
        })?;
        let fluid = Lubricant::new(Barus::new(1.0, 0.0)?, Incompressible);
        let flow = GivenFilm {
            imbalance: IMBALANCE,
            most_steps: MOST_STEPS,
            ..GivenFilm::new(&thickness, &fluid, [1.0; 2])
        };
        let flow = flow.solve_unless(must_stop)?;
        self.rise.clear();
        if flow.report.status == Status::Converged {
            self.rise.extend(flow.pressure.iter().map(|rise| rise / 12.0));
        }
        self.film = film;
        Ok(())
    }

    /// Rise of the reduced pressure at node `k` over `12 eta0 u` \[1/m\]; `None` if the flow did not converge.
    pub(super) fn rise(&self, k: usize) -> Option<f64> {
        self.rise.get(k).copied()
    }

    /// Whether the flow converged.
    pub(super) fn is_solved(&self) -> bool {
        !self.rise.is_empty()
    }

    fn is_of(&self, film: &[f64]) -> bool {
        let is_same = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME_FILM * b;
        self.film.len() == film.len() && self.film.iter().zip(film).all(is_same)
    }
}
