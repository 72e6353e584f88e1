//! Entrainment across rows by spinning surfaces, for the balances of nodes.

use super::super::spin::SweepOrder;
use super::Discretisation;
use super::own_share::HeldNeighbour;

impl Discretisation {
    /// `w` in the row of node `k`.
    #[inline]
    pub(super) fn wedge_at(&self, k: usize) -> f64 {
        self.spin.as_ref().map_or(self.wedge, |spin| spin.wedge(k))
    }

    /// Flow entrained into inner node `k` along y, and out of it at film fraction one.
    #[inline]
    pub(super) fn across(&self, k: usize) -> [f64; 2] {
        self.spin.as_ref().map_or([0.0; 2], |spin| spin.through(k))
    }

    /// Updates the film fractions of spinning surfaces, column by column, each in flow direction.
    pub(super) fn update_film_fractions_across(&mut self, pressure: &[f64], previous: Option<&[f64]>) {
        let Some(mut spin) = self.spin.take() else { return };
        for i in 1..self.grid.nx() - 1 {
            for k in spin.sweep_order.downstream(i).filter(|k| pressure[*k] <= 0.0) {
                let ([enters, leaves], wedge) = (spin.through(k), spin.wedge(k));
                let full = wedge * self.entrained[k];
                // Inflow and outflow along both axes.
                let through = [wedge * self.entrained[k - 1] + enters, full + leaves];
                if let Some((theta, inflow_factor)) = self.film_fraction_of(k, through, previous) {
                    // Entrain the film fraction along both axes.
                    self.theta[k] = theta;
                    self.entrained[k] *= theta;
                    self.advected_fraction[k] = full / inflow_factor;
                    spin.set_film_fraction(k, theta, leaves / inflow_factor);
                }
            }
        }
        self.spin = Some(spin);
    }

    /// Sets the entrainment from the two neighbors of node `k` along y, the last two of `held`.
    pub(super) fn hold_across(&self, k: usize, held: &mut [HeldNeighbour; 4]) {
        let Some(spin) = &self.spin else { return };
        let (nx, column, [_, _, north, south]) = (self.grid.nx(), spin.column(k), held);
        for (held, o, outwards) in [(north, k + nx, column), (south, k - nx, -column)] {
            if outwards < 0.0 {
                held.entrained = outwards * self.theta[o];
                // An inflow to a node that is not filled returns with its advected fraction.
                held.c *= 1.0 - spin.advected_fraction[o];
            } else {
                held.entrained = outwards;
            }
        }
    }

    /// Sweep order of spinning surfaces; `None` without spin.
    pub(in crate::reynolds) fn sweep_order(&self) -> Option<&SweepOrder> {
        self.spin.as_ref().map(|spin| &spin.sweep_order)
    }

    /// Derivatives of the entrained flow through the face north of node `k` at film fraction one: by both
    /// pressures, then by both films.
    pub(in crate::reynolds) fn across_derivatives(&self, k: usize) -> [f64; 4] {
        self.spin.as_ref().map_or([0.0; 4], |spin| spin.derivatives(k, &self.nodes))
    }

    /// Fraction of a change of inflow that node `k` advects to the next row if it is not filled; zero elsewhere.
    pub(in crate::reynolds) fn advected_fraction_across(&self, k: usize) -> f64 {
        self.spin.as_ref().map_or(0.0, |spin| spin.advected_fraction[k])
    }
}
