//! Quantities of the nodes: density, mobility, potential and viscosity ratios.

use std::mem::take;

use super::super::face_mobility::FaceMobility;
use super::super::node::NodeFlow;
use super::super::shear_thinning::NodeRatios;
use super::Discretisation;
use crate::lubricant::{Lubricant, ThermalRatios};
use crate::numerics::{FieldLines, for_each_range};

impl Discretisation {
    /// Temperature corrections of the laws at node `k` under fluid pressure `p`; `None` for an isothermal film.
    #[inline]
    pub(super) fn thermal_ratios(&self, lubricant: &Lubricant, k: usize, p: f64) -> Option<ThermalRatios> {
        self.film_temperatures.get(k).and_then(|films| lubricant.thermal_ratios(films, p))
    }

    /// The quantities of a node at fluid pressure `p` and film `h`, with temperature corrections `warm` if any.
    #[inline]
    pub(super) fn node_flow(
        &self,
        lubricant: &Lubricant,
        warm: Option<ThermalRatios>,
        p: f64,
        h: f64,
    ) -> NodeFlow {
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        let square = self.fluidity * floored * floored;
        let is_closed = h < self.closed_film;
        let (film, cube) = if is_closed { (0.0, 0.0) } else { (floored, square * floored) };
        let film_h = if h > self.film_floor { 1.0 } else { 0.0 };
        let cube_h = 3.0 * square * film_h;
        let (mut density, mut density_p) = (point.density, point.density_slope);
        if let Some(warm) = warm {
            density_p = warm.density * (density_p + density * warm.density_slope);
            density *= warm.density;
        }
        match self.face_mobility {
            FaceMobility::Arithmetic => NodeFlow {
                density,
                density_p,
                film,
                film_h,
                mobility: cube * point.reduced_slope,
                mobility_p: cube * point.reduced_curvature,
                mobility_h: cube_h * point.reduced_slope,
                potential: p,
                potential_p: 1.0,
            },
            FaceMobility::ReducedPressure | FaceMobility::Wedge | FaceMobility::Inlet => NodeFlow {
                density,
                density_p,
                film,
                film_h,
                mobility: cube,
                mobility_p: 0.0,
                mobility_h: cube_h,
                potential: point.reduced_pressure,
                potential_p: point.reduced_slope,
            },
        }
    }

    /// `eta*/eta` of a node at fluid pressure `p` and film `h`, with temperature corrections `warm` if any.
    pub(super) fn viscosity_ratios(
        &self,
        lubricant: &Lubricant,
        warm: Option<ThermalRatios>,
        p: f64,
        h: f64,
    ) -> NodeRatios {
        let warmed = |ratios: NodeRatios| warm.map_or(ratios, |warm| ratios.warmed(&warm));
        let Some((law, length)) = self.thinning else { return warmed(NodeRatios::NEWTONIAN) };
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        // Density over the slope of the reduced pressure is the viscosity over that at ambient pressure.
        let (ratio, slope) = warm.map_or((1.0, 0.0), |warm| (warm.viscosity, warm.viscosity_slope));
        let x = ratio * length / floored * (point.density / point.reduced_slope);
        let by_pressure =
            slope + point.density_slope / point.density - point.reduced_curvature / point.reduced_slope;
        let by_film = if h > self.film_floor { -1.0 / h } else { 0.0 };
        warmed(law.node_ratios(x, [by_pressure, by_film]))
    }

    /// Density, mobility and potential of node `k` at fluid pressure `p` and film `h`, and its viscosity ratios.
    #[inline]
    pub(super) fn node_at(&self, lubricant: &Lubricant, k: usize, p: f64, h: f64) -> (NodeFlow, NodeRatios) {
        let warm = self.thermal_ratios(lubricant, k, p);
        (self.node_flow(lubricant, warm, p, h), self.viscosity_ratios(lubricant, warm, p, h))
    }

    /// Updates the quantities of the changed nodes.
    pub(super) fn update_nodes(&mut self, lubricant: &Lubricant, pressure: &[f64], film: &[f64]) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let (mut nodes, mut masses, mut ratios) =
            (take(&mut self.nodes), take(&mut self.masses), take(&mut self.ratios));
        let fields = (
            FieldLines::new(&mut nodes, nx),
            FieldLines::new(&mut masses, nx),
            FieldLines::new(&mut ratios, nx),
        );
        let this = &*self;
        for_each_range(fields, self.grid.ny(), n, |rows, (nodes, masses, ratios)| {
            let first = rows.start * nx;
            for (i, (node, mass)) in nodes.values.iter_mut().zip(masses.values).enumerate() {
                let k = first + i;
                // Nodes that have not changed keep their quantities.
                if this.changes.at(k) {
                    let (p, h) = (pressure[k], film[k]);
                    let (flow, viscosity) = this.node_at(lubricant, k, p, h);
                    (*node, *mass) = (flow, flow.density * h);
                    if let Some(stored) = ratios.values.get_mut(i) {
                        *stored = viscosity;
                    }
                }
            }
        });
        (self.nodes, self.masses, self.ratios) = (nodes, masses, ratios);
    }
}
