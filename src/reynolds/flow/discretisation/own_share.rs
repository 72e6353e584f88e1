//! Outflow of one node with fixed neighbors.
//!
//! Nonlinear elimination solves the equations of one node with fixed neighbors. `held_neighbours` collects the
//! quantities that do not change in the iteration; `outflow` evaluates the net outflow at a pressure and a film.

use super::super::direction::Direction;
use super::super::node::NodeFlow;
use super::super::shear_thinning::{NodeRatios, ViscosityRatio};
use super::super::spin::{entrained, entrained_derivatives};
use super::Discretisation;
use crate::lubricant::Lubricant;

/// A fixed node across a face of coefficient `c`.
#[derive(Debug, Clone, Copy)]
pub(in crate::reynolds) struct HeldNeighbour {
    /// Coefficient `c` of the face.
    pub(super) c: f64,
    /// Quantities of the neighbour.
    flow: NodeFlow,
    /// Its effective viscosity over that of the law.
    ratio: ViscosityRatio,
    /// Direction of the face.
    direction: Direction,
    /// Whether this node is the first one of the face.
    is_first: bool,
    /// Flow entrained by spin towards it, over that of a face at film fraction one.
    pub(super) entrained: f64,
}

impl Discretisation {
    /// Coefficient of the node's own mass in `F_k`, from entrainment and squeeze.
    pub(in crate::reynolds) fn own_mass(&self, k: usize) -> f64 {
        self.upwind(k)[0] + self.squeeze + self.pseudo_transient
    }

    /// The neighbours of a node.
    #[inline]
    pub(in crate::reynolds) fn held_neighbours(&self, k: usize) -> [HeldNeighbour; 4] {
        let [east, west, north, south] = self.neighbours(k);
        let held = |(o, c, _): (usize, f64, f64), direction: Direction, is_first: bool| HeldNeighbour {
            c,
            flow: self.nodes[o],
            ratio: self.ratios.get(o).unwrap_or(&NodeRatios::NEWTONIAN).of(direction),
            direction,
            is_first,
            entrained: 0.0,
        };
        let mut held = [
            held(east, self.along_at(k), false),
            // An inflow to a node that is not filled returns with its advected fraction.
            held(
                (west.0, west.1 * (1.0 - self.advected_fraction[k - 1]), west.2),
                self.along_at(k - 1),
                true,
            ),
            held(north, Direction::Across, false),
            held(south, Direction::Across, true),
        ];
        self.hold_across(k, &mut held);
        held
    }

    /// Density and its slope, then flow through all faces of node `k` at fluid pressure and film `(p, h)` and its
    /// derivatives by both.
    pub(in crate::reynolds) fn outflow(
        &self,
        lubricant: &Lubricant,
        k: usize,
        neighbours: &[HeldNeighbour; 4],
        (p, h): (f64, f64),
    ) -> ([f64; 2], [f64; 3]) {
        let (node, ratios) = self.node_at(lubricant, k, p, h);
        ([node.density, node.density_p], self.flow_of(&node, &ratios, neighbours))
    }

    /// The same at the pressure and film of the last update.
    pub(in crate::reynolds) fn present_outflow(
        &self,
        k: usize,
        neighbours: &[HeldNeighbour; 4],
    ) -> ([f64; 2], [f64; 3]) {
        let node = &self.nodes[k];
        let ratios = self.ratios.get(k).unwrap_or(&NodeRatios::NEWTONIAN);
        ([node.density, node.density_p], self.flow_of(node, ratios, neighbours))
    }

    /// Pressure flow out of a node with these quantities, and its derivatives by pressure and film.
    #[inline]
    pub(super) fn flow_of(
        &self,
        node: &NodeFlow,
        ratios: &NodeRatios,
        neighbours: &[HeldNeighbour; 4],
    ) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for held in neighbours {
            // Mobility of the face, thinned by shear.
            let (first, second) = if held.is_first { (&held.flow, node) } else { (node, &held.flow) };
            let mut face = self.face_mobility.of(self.fluidity, first, second, held.direction);
            if !self.ratios.is_empty() {
                let ratio = ratios.of(held.direction);
                let (first, second) = if held.is_first { (held.ratio, ratio) } else { (ratio, held.ratio) };
                face = face.thinned(first, second);
            }
            // Its flow, and derivatives by pressure and film of the node.
            let own = if held.is_first { face.second } else { face.first };
            let drop = held.c * (node.potential - held.flow.potential);
            sums[0] += face.mobility * drop;
            sums[1] += own[0] * drop + held.c * face.mobility * node.potential_p;
            sums[2] += own[1] * drop;
            // Flow entrained across rows by spin.
            if held.entrained != 0.0 {
                let [by_pressure, _, by_film, _] = entrained_derivatives(node, &held.flow);
                sums[0] += held.entrained * entrained(node, &held.flow);
                sums[1] += held.entrained * by_pressure;
                sums[2] += held.entrained * by_film;
            }
        }
        sums
    }
}
