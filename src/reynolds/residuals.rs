//! Residuals of an evaluated state: mass, load and complementarity.
//!
//! They follow from pressures and films alone and do not depend on the active set, so that states of different
//! solvers compare.

use super::active_set::Fluid;
use super::coupled::Coupled;
use super::problem::LubricatedContact;
use super::state::ContactState;
use crate::report::Residuals;

impl Coupled {
    /// Residuals of the evaluated `state`.
    pub(super) fn residuals(&self, problem: &LubricatedContact<'_>, state: &ContactState) -> Residuals {
        let (mut mass, mut build_up, mut gap_error) = (0.0, 0.0, 0.0);
        for k in 0..self.fluid.grid.len() {
            let [imbalance, accumulation] = self.mass_errors(problem, state, k);
            mass += imbalance;
            build_up += accumulation;
            gap_error += gap_error_at(problem, state, k);
        }
        self.scaled(problem, state, [mass, build_up, gap_error])
    }

    /// Residuals of the evaluated `state` by its sums of mass errors, accumulation and gap errors.
    pub(super) fn scaled(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        [mass, build_up, gap_error]: [f64; 3],
    ) -> Residuals {
        let grid = self.fluid.grid;
        let (half_x, half_y) = problem.reference_half_widths;
        let load: f64 = state.pressure.iter().sum::<f64>() * grid.cell_area();
        // Scale by the flux of the mean film and by its volume in the contact.
        let film_scale = self.film_scale(problem, state);
        let per_flux = grid.dy() / self.flux_scale(problem, film_scale * 2.0 * half_y);
        let per_area = grid.cell_area() / (film_scale * std::f64::consts::PI * half_x * half_y);
        Residuals {
            mass: mass * per_flux,
            load: problem.box_load().map_or(0.0, |wanted| (load - wanted).abs() / wanted),
            complementarity: (build_up * per_flux).max(gap_error * per_area),
        }
    }

    /// Error of the mass balance of node `k`, and mass that accumulates although the node is cavitated \[m\].
    pub(super) fn mass_errors(
        &self,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        k: usize,
    ) -> [f64; 2] {
        if problem.lubricant.is_none() || self.active_set[k].fluid == Fluid::Boundary {
            return [0.0, 0.0];
        }
        let balance = self.balance[k];
        if self.fluid.conserves_mass() {
            [self.fluid.imbalance(k, problem.squeeze.map(|s| s.previous_mass)).abs(), 0.0]
        } else if state.fluid_pressure[k] > 0.0 {
            [balance.abs(), 0.0]
        } else {
            [0.0, (-balance).max(0.0)]
        }
    }

    /// Flux over speed \[m^2\] that scales mass residuals: that of the mean film through the contact width,
    /// `through_contact`, or the inflow of the box if that is smaller and there is no squeeze.
    fn flux_scale(&self, problem: &LubricatedContact<'_>, through_contact: f64) -> f64 {
        if problem.lubricant.is_none() || problem.squeeze.is_some() {
            return through_contact;
        }
        let inflow = self.fluid.edge_flow().0 / (self.fluid.rate() * self.fluid.grid.dx());
        if inflow > 0.0 { through_contact.min(inflow) } else { through_contact }
    }

    /// Pressure-weighted mean film, or mean elastic displacement without lubricant.
    fn film_scale(&self, problem: &LubricatedContact<'_>, state: &ContactState) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (k, &p) in state.pressure.iter().enumerate() {
            // The mass of the fluid, or the displacement of dry bodies, weighted by pressure.
            let length = if problem.lubricant.is_some() {
                state.mass[k].max(problem.contact_film())
            } else {
                self.elastic_film[k] - problem.gap[k] + state.approach
            };
            sum += p * length;
            weight += p;
        }
        if weight > 0.0 && sum > 0.0 { sum / weight } else { f64::MIN_POSITIVE }
    }
}

/// Complementarity error of node `k`: gap error in solid contact, penetration elsewhere \[m\].
fn gap_error_at(problem: &LubricatedContact<'_>, state: &ContactState, k: usize) -> f64 {
    let gap = state.film[k] - problem.contact_film();
    let touches = state.pressure[k] > state.fluid_pressure[k];
    if touches { gap.abs() } else { (-gap).max(0.0) }
}
