//! Linearized entrainment from row to row by surfaces that turn.
//!
//! Nodes that are not filled advect shares of a change: along x to the next column, and across to the next row.
//! Columns are swept one after the other, each along its flow.

use super::face_flows::{FaceFlows, single, store};
use crate::grid::Grid;
use crate::numerics::{FieldLines, STENCIL};
use crate::reynolds::flow::{Discretisation, SweepOrder};

/// Derivatives of the entrainment through the faces to the north of the nodes, and its changes.
#[derive(Debug)]
pub(super) struct Across {
    /// Nodes in a row.
    nx: usize,
    /// Direction of entrainment along the columns.
    sweep_order: SweepOrder,
    /// Derivatives, by face.
    pub(super) faces: FaceFlows,
    /// Changes of the entrainment through these faces.
    pub(super) change: Vec<f32>,
    /// Changes of the entrainment through the faces to the east.
    east_change: Vec<f32>,
    /// Share of a change of inflow that nodes that are not filled advect to the next row; zero elsewhere.
    advected: Vec<f32>,
    /// Film fractions.
    theta: Vec<f32>,
}

impl Across {
    pub(super) fn new(grid: &Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self {
            nx: grid.nx(),
            sweep_order: SweepOrder::default(),
            faces: std::array::from_fn(|_| zeros()),
            change: zeros(),
            east_change: zeros(),
            advected: zeros(),
            theta: zeros(),
        }
    }

    /// Evaluates the derivatives at the last update of `fluid`, with the flow direction `sweep_order`.
    pub(super) fn update(&mut self, fluid: &Discretisation, sweep_order: &SweepOrder, stiffness: f64) {
        self.sweep_order.clone_from(sweep_order);
        let mut faces = self.faces.each_mut().map(|field| FieldLines::new(field, self.nx));
        for k in 0..self.change.len() - self.nx {
            store(&mut faces, k, fluid.across_derivatives(k), stiffness);
        }
        for (k, advected) in self.advected.iter_mut().enumerate() {
            *advected = single(fluid.advected_fraction_across(k));
        }
        for (theta, of_node) in self.theta.iter_mut().zip(fluid.film_fractions()) {
            *theta = single(*of_node);
        }
    }

    /// Adds to the changes of flow by pressure in `out` those of entrainment, under the changes `mass` of the nodes
    /// and `higher_order` corrections of them; `advected` is the share that nodes advect along x, `upwind` are the coefficients of the
    /// masses in each row.
    pub(super) fn add_entrainment(
        &mut self,
        mass: &[f32],
        higher_order: &[f32],
        advected: &[f32],
        upwind: &[[f32; 2]],
        out: &mut [f32],
    ) {
        let nx = self.nx;
        let Self { sweep_order, change, east_change, theta, .. } = self;
        for (j, [_, up]) in upwind.iter().enumerate() {
            east_change[j * nx] = higher_order[j * nx] - up * mass[j * nx];
        }
        for k in (1..nx - 1).flat_map(|i| sweep_order.downstream(i)) {
            let ([enters, leaves], sign, [here, up]) =
                (sweep_order.faces(k), sweep_order.sign(k), upwind[k / nx]);
            let flow = out[k] - east_change[k - 1] - sign * change[enters];
            // Outflow of a full gap, along x and across it.
            let (east, next) = (higher_order[k] - up * mass[k], sign * change[leaves]);
            let stored = (here + up) * mass[k];
            out[k] = flow + stored + east + next;
            east_change[k] = east;
            if advected[k] > 0.0 {
                // Outflow of the filled share, and the advected share of the remaining inflow.
                let remaining = flow + theta[k] * (stored + east + next);
                east_change[k] = theta[k] * east - advected[k] * remaining;
                change[leaves] = sign * (theta[k] * next - self.advected[k] * remaining);
            }
        }
    }

    /// Adds to the `row` of node `k` of the fluid block the entrainment through its two faces; arguments as of
    /// [`Linearization::stencil_row`](super::linearization::Linearization::stencil_row), `advected` being the share
    /// that nodes advect along x.
    pub(super) fn add_to_row(
        &self,
        k: usize,
        row: &mut [f32; STENCIL],
        dof_map: impl Fn(usize) -> [f32; 2],
        (is_coupled, advected): (&[bool], &[f32]),
    ) {
        let (nx, [enters, _]) = (self.nx, self.sweep_order.faces(k));
        let share = if is_coupled[k] { advected[k] } else { 1.0 };
        let by_unknown = |[p, h]: [f32; 2], o: usize| {
            let [pressure, film] = dof_map(o);
            p * pressure + h * film
        };
        let [_, _, _, north, south] = row;
        let mut own = 0.0;
        for (entry, o, face) in [(north, k + nx, k), (south, k - nx, k - nx)] {
            let is_north = o > k;
            // Mass that enters is advected by the unknown of the upstream node, if that has one.
            if face == enters {
                if is_coupled[o] {
                    *entry -= share * self.advected[o] / advected[o];
                    continue;
                }
            } else if is_coupled[k] {
                continue;
            }
            // Derivatives of the flow through the face by the unknowns on both of its sides.
            let [first_p, second_p, first_h, second_h] = self.faces.each_ref().map(|by| by[face]);
            let (first, second) = ([first_p, first_h], [second_p, second_h]);
            let (sign, here, there) = if is_north { (share, first, second) } else { (-share, second, first) };
            own += sign * by_unknown(here, k);
            *entry += sign * by_unknown(there, o);
        }
        row[0] += own;
    }
}
