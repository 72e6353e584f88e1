//! What turning surfaces carry from row to row, as the balances of nodes ask for it.

use super::super::spin::Course;
use super::Discretisation;
use super::own_share::HeldNeighbour;

impl Discretisation {
    /// `w` of the row of node `k`.
    #[inline]
    pub(super) fn wedge_at(&self, k: usize) -> f64 {
        self.spin.as_ref().map_or(self.wedge, |spin| spin.wedge(k))
    }

    /// What turning surfaces carry into inner node `k` along y, and out of it with its own gap filled.
    #[inline]
    pub(super) fn across(&self, k: usize) -> [f64; 2] {
        self.spin.as_ref().map_or([0.0; 2], |spin| spin.through(k))
    }

    /// Fills the gaps without pressure between surfaces that turn, column by column, each along its flow.
    pub(super) fn fill_across(&mut self, pressure: &[f64], previous: Option<&[f64]>) {
        let Some(mut spin) = self.spin.take() else { return };
        for i in 1..self.grid.nx() - 1 {
            for k in spin.course.downstream(i).filter(|k| pressure[*k] <= 0.0) {
                let ([enters, leaves], wedge) = (spin.through(k), spin.wedge(k));
                let full = wedge * self.carried[k];
                let through = [wedge * self.carried[k - 1] + enters, full + leaves];
                if let Some((content, taken)) = self.content_of(k, through, previous) {
                    self.content[k] = content;
                    self.carried[k] *= content;
                    self.passed[k] = full / taken;
                    spin.fill(k, content, leaves / taken);
                }
            }
        }
        self.spin = Some(spin);
    }

    /// Lets the neighbours of node `k` across, the last two, carry what they do.
    pub(super) fn hold_across(&self, k: usize, held: &mut [HeldNeighbour; 4]) {
        let Some(spin) = &self.spin else { return };
        let (nx, column, [_, _, north, south]) = (self.grid.nx(), spin.column(k), held);
        for (held, o, outwards) in [(north, k + nx, column), (south, k - nx, -column)] {
            if outwards < 0.0 {
                held.carried = outwards * self.content[o];
                // What flows into a node that is not filled comes back with all it carries on.
                held.c *= 1.0 - spin.passed[o];
            } else {
                held.carried = outwards;
            }
        }
    }

    /// Which way surfaces that turn carry fluid from row to row; none where they move along x alone.
    pub(in crate::reynolds) fn course(&self) -> Option<&Course> {
        self.spin.as_ref().map(|spin| &spin.course)
    }

    /// Derivatives of what turning surfaces carry through the face to the north of node `k` between full
    /// gaps: by both pressures, then by both films.
    pub(in crate::reynolds) fn across_derivatives(&self, k: usize) -> [f64; 4] {
        self.spin.as_ref().map_or([0.0; 4], |spin| spin.derivatives(k, &self.nodes))
    }

    /// What node `k` carries on to the next row of a change of its inflow, where it is not filled; zero
    /// elsewhere.
    pub(in crate::reynolds) fn passed_across(&self, k: usize) -> f64 {
        self.spin.as_ref().map_or(0.0, |spin| spin.passed[k])
    }
}
