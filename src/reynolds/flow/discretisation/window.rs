//! A window of the flow: the same equations on a few cells with a fixed surrounding.
//!
//! Newton's method on an isolated region uses a window of its size. Coefficients and the entrained flow across the
//! western edge are copied from the full grid. Balances of nodes within [`MARGIN`] of an edge are not used.

use super::super::shear_thinning::NodeRatios;
use super::Discretisation;
use crate::lubricant::Lubricant;

/// Nodes along each edge of a window whose balances need nodes outside of it.
pub(in crate::reynolds) const MARGIN: usize = 3;

/// Number of columns at the western edge whose entrained flow is copied from the full grid.
const HELD_COLUMNS: usize = 2;

impl Discretisation {
    /// Makes this a window of `whole` whose row `j` begins at the node `first(j)` there.
    pub(in crate::reynolds) fn set_window(&mut self, whole: &Self, first: impl Fn(usize) -> usize) {
        self.changes.forget();
        // Schemes and coefficients of the whole grid.
        self.face_mobility = whole.face_mobility;
        self.scheme = whole.scheme;
        self.cavitation = whole.cavitation;
        self.film_floor = whole.film_floor;
        self.closed_film = whole.closed_film;
        (self.wedge, self.squeeze) = (whole.wedge, whole.squeeze);
        self.pseudo_transient = whole.pseudo_transient;
        (self.fluidity, self.rate) = (whole.fluidity, whole.rate);
        self.thinning = whole.thinning;
        self.film_temperatures.clear();
        let thinned = if whole.ratios.is_empty() { 0 } else { self.grid.len() };
        self.ratios.resize(thinned, NodeRatios::NEWTONIAN);
        // Fields, row by row.
        let nx = self.grid.nx();
        for j in 0..self.grid.ny() {
            let there = first(j)..first(j) + nx;
            let here = j * nx..(j + 1) * nx;
            self.alignments[here.clone()].copy_from_slice(&whole.alignments[there.clone()]);
            self.coefficients[here.clone()].copy_from_slice(&whole.coefficients[there.clone()]);
            if !whole.film_temperatures.is_empty() {
                self.film_temperatures.extend_from_slice(&whole.film_temperatures[there.clone()]);
            }
            // The flow entrained into the window stays fixed.
            for (here, there) in here.zip(there).take(HELD_COLUMNS) {
                (self.entrained[here], self.theta[here]) = (whole.entrained[there], whole.theta[there]);
            }
        }
    }

    /// Updates a window for the given fluid pressures and films.
    pub(in crate::reynolds) fn update_window(
        &mut self,
        lubricant: &Lubricant,
        pressure: &[f64],
        film: &[f64],
        previous: Option<&[f64]>,
    ) {
        self.update_faces(lubricant, pressure, film);
        self.update_entrained(HELD_COLUMNS, pressure, previous);
    }
}
