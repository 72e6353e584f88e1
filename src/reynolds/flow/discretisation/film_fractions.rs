//! Film fractions of starved and cavitated nodes, and the entrained masses with them.

use super::super::cavitation::Cavitation;
use super::Discretisation;
use crate::reynolds::inner_nodes::interior;

impl Discretisation {
    /// Updates film fractions and entrained masses of the faces to the east. The first `held` columns are already up
    /// to date.
    pub(super) fn update_entrained(&mut self, held: usize, pressure: &[f64], previous: Option<&[f64]>) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        // Entrain full films first.
        for k in (0..n).step_by(nx).flat_map(|first| first + held..first + nx) {
            self.entrained[k] = self.masses[k] + self.beyond[k];
            self.theta[k] = 1.0;
        }
        self.advected_fraction.fill(0.0);
        if self.cavitation == Cavitation::MassConserving {
            self.apply_starvation();
            if self.spin.is_some() {
                self.update_film_fractions_across(pressure, previous);
                return;
            }
            // Film fractions of cavitated nodes, in flow direction.
            for k in interior(&self.grid).filter(|k| pressure[*k] <= 0.0 && k % nx >= held) {
                self.update_film_fraction(k, previous);
            }
        }
    }

    /// Limits the flow through the faces at the inlet edge to the supply.
    pub(super) fn apply_starvation(&mut self) {
        for first in (0..self.grid.len()).step_by(self.grid.nx()) {
            let full = self.entrained[first];
            // A meniscus upstream of the box has filled the gap if there is pressure at its edge.
            let is_filled = self.edge_pressure.get(first).is_some_and(|pressure| *pressure > 0.0);
            if full > self.supply && !is_filled {
                self.theta[first] = self.supply / full;
                self.entrained[first] = self.supply;
            }
        }
    }

    /// Whether node `k` is on the inlet edge and supplied with less than a full film: its outflow does not depend on
    /// its film.
    #[inline]
    pub(super) fn is_starved(&self, k: usize) -> bool {
        self.theta[k] < 1.0 && k.is_multiple_of(self.grid.nx())
    }

    /// Updates the film fraction of node `k`, which has no pressure, from its inflow; upstream nodes come first.
    pub(super) fn update_film_fraction(&mut self, k: usize, previous: Option<&[f64]>) {
        let full = self.wedge * self.entrained[k];
        if let Some((theta, inflow_factor)) =
            self.film_fraction_of(k, [self.wedge * self.entrained[k - 1], full], previous)
        {
            self.theta[k] = theta;
            self.entrained[k] *= theta;
            self.advected_fraction[k] = full / inflow_factor;
        }
    }

    /// Film fraction of node `k`, which has no pressure, if it is below one, and its derivative by the inflow.
    /// `[enters, leaves]` are the entrained flows into the node, and out of it at film fraction one.
    pub(super) fn film_fraction_of(
        &self,
        k: usize,
        [enters, leaves]: [f64; 2],
        previous: Option<&[f64]>,
    ) -> Option<(f64, f64)> {
        let mass = self.masses[k];
        let whole = leaves + self.squeeze * mass;
        let kept = previous.map_or(0.0, |previous| self.squeeze * previous[k]);
        let theta = (enters + kept - self.pressure_outflow(k)) / whole;
        let inflow_factor = whole + self.pseudo_transient * mass;
        (whole > 0.0 && theta < 1.0).then_some((theta.max(0.0), inflow_factor))
    }
}
