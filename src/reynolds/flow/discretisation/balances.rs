//! Mass balances of the cells and their diagonals.

use super::super::balance::{FilmFlows, FlowBalance};
use super::super::cavitation::Cavitation;
use super::{Discretisation, Scheme};
use crate::reynolds::inner_nodes::{inner_rows, interior};

/// Leading influence coefficients, for implicit relaxation \[m/Pa\].
#[derive(Debug, Clone, Copy)]
pub(in crate::reynolds) struct NearField {
    /// Of a node on itself.
    pub(in crate::reynolds) own: f64,
    /// On the next node along x.
    pub(in crate::reynolds) next_x: f64,
    /// On the one after it.
    pub(in crate::reynolds) second_x: f64,
}

/// Relative pressure difference below which the secant of a potential is the mean of its slopes.
const SECANT_SHARE: f64 = 1e-6;

impl Discretisation {
    /// Pressure flow per pressure difference through the faces east and north of node `k` \[m/Pa\], at the
    /// pressures of the last update.
    pub(in crate::reynolds) fn conductances(&self, k: usize, pressure: &[f64]) -> [f64; 2] {
        let towards = |o: usize, c: f64, mobility: f64| {
            let (a, b) = (&self.nodes[k], &self.nodes[o]);
            let difference = pressure[k] - pressure[o];
            let slope = if difference.abs() > SECANT_SHARE * (pressure[k] + pressure[o]) {
                (a.potential - b.potential) / difference
            } else {
                0.5 * (a.potential_p + b.potential_p)
            };
            c * mobility * slope
        };
        let [east, north] = self.coefficients[k];
        [towards(k + 1, east, self.east[k]), towards(k + self.grid.nx(), north, self.north[k])]
    }

    /// Coefficients of `m` at `k`, `k - 1` and `k - 2` in the entrainment term if it is linear in `m`; those of
    /// first order for the limited scheme and next to the inlet.
    #[inline]
    pub(in crate::reynolds) fn upwind(&self, k: usize) -> [f64; 3] {
        let w = self.wedge_at(k);
        match self.scheme {
            Scheme::SecondOrder if k % self.grid.nx() >= 2 => [1.5 * w, -2.0 * w, 0.5 * w],
            _ => [w, -w, 0.0],
        }
    }

    /// `F_k` of an interior node at the last update, with film fraction one in its own cell.
    pub(in crate::reynolds) fn balance(&self, k: usize, previous: Option<&[f64]>) -> f64 {
        let [enters, leaves] = self.across(k);
        self.transport(k, previous) + self.pressure_outflow(k) + (leaves - enters)
    }

    /// Net outflow of interior node `k` at its film fraction; zero if the film fraction satisfies the balance.
    pub(in crate::reynolds) fn imbalance(&self, k: usize, previous: Option<&[f64]>) -> f64 {
        let stored = previous.map_or(0.0, |previous| self.squeeze * (self.held_mass(k) - previous[k]));
        let across = self.spin.as_ref().map_or(0.0, |spin| spin.outflow(k));
        self.wedge_at(k) * (self.entrained[k] - self.entrained[k - 1])
            + stored
            + self.pressure_outflow(k)
            + across
    }

    /// Whether cavitation conserves mass.
    pub(in crate::reynolds) fn conserves_mass(&self) -> bool {
        self.cavitation == Cavitation::MassConserving
    }

    /// Flows through the edges of the box and growth rate of its mass.
    pub(in crate::reynolds) fn flow_balance(&self, previous: Option<&[f64]>) -> FlowBalance {
        let (inflow, outflow) = self.edge_flow();
        let grown = previous.map_or(0.0, |previous| {
            interior(&self.grid).map(|k| self.held_mass(k) - previous[k]).sum::<f64>()
        });
        FlowBalance::new(inflow, outflow, self.rate * self.grid.cell_area() * self.squeeze * grown)
    }

    /// Flow into and out of the box through the inner faces of its outermost nodes \[m^3/s\].
    pub(in crate::reynolds) fn edge_flow(&self) -> (f64, f64) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let (mut inflow, mut outflow) = (0.0, 0.0);
        let mut count = |out: f64| if out > 0.0 { outflow += out } else { inflow -= out };
        // Faces at both ends of each row, then those of the first and the last row.
        for first in inner_rows(&self.grid).map(|j| j * nx) {
            let through = |k: usize| self.wedge_at(k) * self.entrained[k] + self.east_flow[k];
            count(-through(first));
            count(through(first + nx - 2));
        }
        if self.grid.has_side_edges() {
            let north = |k: usize| self.north_flow[k] + self.spin.as_ref().map_or(0.0, |spin| spin.north(k));
            for i in 1..nx - 1 {
                count(-north(i));
                count(north(n - 2 * nx + i));
            }
        }
        let unit = self.rate * self.grid.cell_area();
        (unit * inflow, unit * outflow)
    }

    /// Overwrites `flows` with those at the last update: pressure flow through the faces east and north, and the
    /// mean of the total flow through the two faces of a node along x \[m^2/s\]. Nodes at the edge of the box have
    /// one face along x.
    pub(in crate::reynolds) fn film_flows(&self, flows: &mut FilmFlows) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let (along, across) = (self.rate * self.grid.dx(), self.rate * self.grid.dy());
        flows.resize(n);
        flows.has_edge_pressure = !self.edge_pressure.is_empty();
        // Pressure flow per width.
        for k in 0..n {
            if k % nx + 1 < nx {
                flows.east[k] = along * self.east_flow[k];
            }
            if self.grid.north_of(k).is_some() {
                flows.north[k] = across * self.north_flow[k];
            }
        }
        // Flows through the outer faces of the outermost nodes are unknown.
        let through = |k: usize| along * self.wedge_at(k) * self.entrained[k] + flows.east[k];
        for (k, mean) in flows.through.iter_mut().enumerate() {
            let (first, last) = (k % nx == 0, k % nx + 1 == nx);
            let before = if first { k } else { k - 1 };
            let after = if last { before } else { k };
            *mean = 0.5 * (through(before) + through(after));
        }
    }

    /// Entrainment and squeeze terms of `F_k`.
    pub(in crate::reynolds) fn transport(&self, k: usize, previous: Option<&[f64]>) -> f64 {
        let mut sum = self.wedge_at(k) * (self.masses[k] + self.beyond[k] - self.entrained[k - 1]);
        if let Some(previous) = previous {
            sum += self.squeeze * (self.masses[k] - previous[k]);
        }
        sum
    }

    /// Flow through all faces of node `k` per potential, with fixed neighbors.
    pub(super) fn conductance(&self, k: usize) -> f64 {
        let mut sum = 0.0;
        for (_, c, mobility) in self.neighbours(k) {
            sum += c * mobility;
        }
        sum
    }

    /// Derivative of `F_k` by its own pressure with frozen coefficients \[m/Pa\].
    pub(in crate::reynolds) fn diagonal(&self, k: usize, near: NearField) -> f64 {
        let faces = self.conductance(k);
        self.wedge_at(k) * (self.nodes[k].density * near.own - self.nodes[k - 1].density * near.next_x)
            + self.squeeze * self.nodes[k].density * near.own
            + faces * self.nodes[k].potential_p
    }

    /// Pressure-flow coefficient of node `k` over the entrainment and squeeze of its elastic response.
    pub(in crate::reynolds) fn flow_ratio(&self, k: usize, near: NearField) -> f64 {
        self.conductance(k) * self.nodes[k].potential_p
            / ((self.wedge_at(k) + self.squeeze) * self.nodes[k].density * near.own)
    }
}
