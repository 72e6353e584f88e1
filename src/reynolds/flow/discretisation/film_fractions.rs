//! Film fractions of starved and cavitated nodes, and the entrained masses with them.

use std::mem::take;

use super::Discretisation;
use crate::numerics::{FieldLines, for_each_range};
use crate::reynolds::inner_nodes::inner_rows;

impl Discretisation {
    /// Updates film fractions and entrained masses of the faces to the east. The first `held` columns are already up
    /// to date.
    pub(super) fn update_entrained(&mut self, held: usize, pressure: &[f64], previous: Option<&[f64]>) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let (mut entrained, mut theta) = (take(&mut self.entrained), take(&mut self.theta));
        let mut advected = take(&mut self.advected_fraction);
        let fields = (
            FieldLines::new(&mut entrained, nx),
            FieldLines::new(&mut theta, nx),
            FieldLines::new(&mut advected, nx),
        );
        let this = &*self;
        for_each_range(fields, self.grid.ny(), n, |rows, (entrained, theta, advected)| {
            let values = theta.values.chunks_exact_mut(nx).zip(advected.values.chunks_exact_mut(nx));
            for (j, (entrained, (theta, advected))) in
                rows.zip(entrained.values.chunks_exact_mut(nx).zip(values))
            {
                this.entrain_row(j, held, [entrained, theta, advected], pressure, previous);
            }
        });
        (self.entrained, self.theta, self.advected_fraction) = (entrained, theta, advected);
        if self.conserves_mass() && self.spin.is_some() {
            self.update_film_fractions_across(pressure, previous);
        }
    }

    /// The entrained masses, film fractions and advected fractions of row `j`; with spin before the film fractions of
    /// cavitated nodes, which follow from the entrainment across rows too.
    fn entrain_row(
        &self,
        j: usize,
        held: usize,
        [entrained, theta, advected]: [&mut [f64]; 3],
        pressure: &[f64],
        previous: Option<&[f64]>,
    ) {
        let (nx, first) = (self.grid.nx(), j * self.grid.nx());
        // Entrain full films first.
        for i in held..nx {
            entrained[i] = self.masses[first + i] + self.beyond[first + i];
            theta[i] = 1.0;
        }
        advected.fill(0.0);
        if !self.conserves_mass() {
            return;
        }
        if let Some(supplied) = self.starved_fraction(first, entrained[0]) {
            (entrained[0], theta[0]) = (self.supply, supplied);
        }
        if self.spin.is_some() || !inner_rows(&self.grid).contains(&j) {
            return;
        }
        // Film fractions of cavitated nodes, in flow direction: upstream nodes come first.
        for i in held.max(1)..nx - 1 {
            let is_cavitated = pressure[first + i] <= 0.0;
            if !is_cavitated {
                continue;
            }
            let full = self.wedge * entrained[i];
            let through = [self.wedge * entrained[i - 1], full];
            if let Some((fraction, inflow_factor)) = self.film_fraction_of(first + i, through, previous) {
                theta[i] = fraction;
                entrained[i] *= fraction;
                advected[i] = full / inflow_factor;
            }
        }
    }

    /// Film fraction at the node `first` of a row, on the inlet edge, which entrains `full` if its gap is full; `None`
    /// where the supply is enough.
    fn starved_fraction(&self, first: usize, full: f64) -> Option<f64> {
        // A meniscus upstream of the box has filled the gap if there is pressure at its edge.
        let is_filled = self.edge_pressure.get(first).is_some_and(|pressure| *pressure > 0.0);
        (full > self.supply && !is_filled).then(|| self.supply / full)
    }

    /// Whether node `k` is on the inlet edge and supplied with less than a full film: its outflow does not depend on
    /// its film.
    #[inline]
    pub(super) fn is_starved(&self, k: usize) -> bool {
        self.theta[k] < 1.0 && k.is_multiple_of(self.grid.nx())
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
