//! Derivatives of the mass balances, face by face, and their products with changes of pressures and films.
//!
//! All is in single precision, balances and films over the self-influence, so that they are pressures. A flow is
//! computed once for the two nodes of its face: it leaves one as it enters the other, rounding included, and the
//! balance of an isolated region, the small difference of large flows, keeps its digits.

use super::across::Across;
use super::face_flows::{FaceFlows, changes_between, flow_changes, higher_order_changes, single, store};
use crate::grid::Grid;
use crate::numerics::{FieldLines, STENCIL, for_each_range, map_lines, map_nodes};
use crate::reynolds::flow::Discretisation;
use crate::reynolds::inner_nodes::inner_rows;

/// The mass balances of all nodes, linearized.
#[derive(Debug)]
pub(super) struct Linearization {
    grid: Grid,
    /// Derivatives of the mass of each node by its pressure and by its film.
    mass: [Vec<f32>; 2],
    /// Of the face to the east of each node, and of that to the north.
    east: FaceFlows,
    north: FaceFlows,
    /// Of the entrainment through the face to the east of each node beyond the mass of that node, in schemes of
    /// higher order.
    higher_order: [Vec<f32>; 5],
    has_entrainment_corrections: bool,
    higher_order_change: Vec<f32>,
    /// Share of a change of inflow that nodes that are not filled advect downstream; zero elsewhere.
    advected: Vec<f32>,
    /// Coefficients of the masses of a node and of its upstream neighbor in each row, and those of the
    /// preconditioner.
    upwind: Vec<[f32; 2]>,
    near: Vec<[f32; 2]>,
    /// Entrainment from row to row by surfaces that turn.
    across: Option<Box<Across>>,
    mass_change: Vec<f32>,
    east_change: Vec<f32>,
    north_change: Vec<f32>,
}

impl Linearization {
    pub(super) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        let faces = || std::array::from_fn(|_| zeros());
        Self {
            grid,
            mass: [zeros(), zeros()],
            east: faces(),
            north: faces(),
            higher_order: std::array::from_fn(|_| zeros()),
            has_entrainment_corrections: false,
            higher_order_change: zeros(),
            advected: zeros(),
            upwind: vec![[0.0; 2]; grid.ny()],
            near: vec![[0.0; 2]; grid.ny()],
            across: None,
            mass_change: zeros(),
            east_change: zeros(),
            north_change: zeros(),
        }
    }

    /// Evaluates the derivatives at the last update of `fluid`.
    pub(super) fn update(&mut self, fluid: &Discretisation, own_influence: f64) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        // Masses of the nodes and their advection.
        let (ny, stiffness) = (self.grid.ny(), 1.0 / own_influence);
        let [by_pressure, by_film] = self.mass.each_mut().map(|field| FieldLines::new(field, nx));
        for_each_range((by_pressure, by_film), ny, n, |rows, (by_pressure, by_film)| {
            let nodes = (rows.start * nx..).zip(by_pressure.values.iter_mut().zip(by_film.values));
            for (k, (by_pressure, by_film)) in nodes {
                let [pressure, film] = fluid.mass_derivatives(k);
                (*by_pressure, *by_film) = (single(stiffness * pressure), single(film));
            }
        });
        map_nodes(&mut self.advected, |k, advected| *advected = single(fluid.advected_fraction(k)));
        // Flow by pressure through the faces, and entrainment that the masses of the nodes do not determine.
        self.has_entrainment_corrections = fluid.has_entrainment_corrections();
        let has_corrections = self.has_entrainment_corrections;
        let east = self.east.each_mut().map(|field| FieldLines::new(field, nx));
        let higher_order = self.higher_order.each_mut().map(|field| FieldLines::new(field, nx));
        for_each_range((east, higher_order), ny, n, |rows, (mut east, higher_order)| {
            let [own_p, up_p, own_h, next_h, up_h] = higher_order;
            for (i, k) in (rows.start * nx..rows.end * nx).enumerate() {
                let (by_flow, derivatives) = fluid.east_derivatives(k, i % nx);
                // Pressure flow through the face to the east.
                store(&mut east, i, by_flow, stiffness);
                if has_corrections {
                    // Entrainment through it that the masses of the nodes do not determine.
                    own_p.values[i] = single(stiffness * derivatives[0]);
                    up_p.values[i] = single(stiffness * derivatives[1]);
                    own_h.values[i] = single(derivatives[2]);
                    next_h.values[i] = single(derivatives[3]);
                    up_h.values[i] = single(derivatives[4]);
                }
            }
        });
        if !has_corrections {
            self.higher_order_change.fill(0.0);
        }
        let north = self.north.each_mut().map(|field| FieldLines::new(field, nx));
        // A strip has faces north of its last row.
        let rows = if self.grid.is_strip() { ny } else { ny - 1 };
        for_each_range(north, rows, n, |rows, mut north| {
            for (i, k) in (rows.start * nx..rows.end * nx).enumerate() {
                store(&mut north, i, fluid.north_derivatives(k), stiffness);
            }
        });
        // Coefficients of the entrainment.
        for (j, (upwind, near)) in self.upwind.iter_mut().zip(&mut self.near).enumerate() {
            *upwind = fluid.mass_coefficients(j * nx).map(single);
            *near = fluid.five_point_mass_coefficients(j * nx).map(single);
        }
        self.across = fluid.sweep_order().map(|sweep_order| {
            let mut across = self.across.take().unwrap_or_else(|| Box::new(Across::new(&self.grid)));
            across.update(fluid, sweep_order, stiffness);
            across
        });
    }

    /// Change of the balance of every inner node under changes of fluid pressure and film; others stay as
    /// they are.
    pub(super) fn product(&mut self, pressure: &[f32], film: &[f32], out: &mut [f32]) {
        let nx = self.grid.nx();
        self.update_changes(pressure, film);
        // Balances, row by row.
        let (this, inner) = (&*self, inner_rows(&self.grid));
        map_lines(out, nx, |j, row| {
            if inner.contains(&j) {
                this.balance_row(j, row);
            }
        });
        if let Some(across) = &mut self.across {
            flow_changes(&across.faces, nx, [pressure, film], 0, &mut across.change);
            across.add_entrainment(
                &self.mass_change,
                &self.higher_order_change,
                &self.advected,
                &self.upwind,
                out,
            );
        }
    }

    /// Changes of masses, of flows through faces and of entrainment beyond the masses.
    fn update_changes(&mut self, pressure: &[f32], film: &[f32]) {
        let (nx, ny, n, is_strip) = (self.grid.nx(), self.grid.ny(), self.grid.len(), self.grid.is_strip());
        let (east, north, higher_order, has_corrections) =
            (&self.east, &self.north, &self.higher_order, self.has_entrainment_corrections);
        let [by_pressure, by_film] = &self.mass;
        let fields = (
            FieldLines::new(&mut self.mass_change, nx),
            FieldLines::new(&mut self.east_change, nx),
            FieldLines::new(&mut self.north_change, nx),
            FieldLines::new(&mut self.higher_order_change, nx),
        );
        for_each_range(fields, ny, n, |rows, (mass, east_change, north_change, higher_order_change)| {
            let (first, nodes) = (rows.start * nx, rows.start * nx..rows.end * nx);
            let derivatives = by_pressure[nodes.clone()].iter().zip(&by_film[nodes.clone()]);
            let changes = pressure[nodes.clone()].iter().zip(&film[nodes]);
            for ((mass, (a, b)), (p, h)) in mass.values.iter_mut().zip(derivatives).zip(changes) {
                *mass = a * p + b * h;
            }
            flow_changes(east, 1, [pressure, film], first, east_change.values);
            if has_corrections {
                higher_order_changes(higher_order, [pressure, film], first, higher_order_change.values);
            }
            if ny > 1 {
                flow_changes(north, nx, [pressure, film], first, north_change.values);
            }
            if is_strip && rows.end == ny {
                // From the last row to the first.
                let last = &mut north_change.values[(ny - 1) * nx - first..];
                changes_between(north, [n - nx, 0], [pressure, film], last);
            }
        });
    }

    /// Changes of the balances in row `j` under the present changes; with surfaces that turn without those of
    /// entrainment.
    fn balance_row(&self, j: usize, out: &mut [f32]) {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let first = j * nx;
        let row = first..first + nx;
        let (mass, east, advected) =
            (&self.mass_change[row.clone()], &self.east_change[row.clone()], &self.advected[row.clone()]);
        let (higher_order, north) = (&self.higher_order_change[row.clone()], &self.north_change[row]);
        // Flow by pressure through the faces.
        for i in 1..nx - 1 {
            out[i] = east[i] - east[i - 1];
        }
        // A window has no faces south of its first row.
        if let Some(south) = self.grid.south_of(first) {
            let south = &self.north_change[south..south + nx];
            for ((out, north), south) in out[1..nx - 1].iter_mut().zip(&north[1..]).zip(&south[1..]) {
                *out += north - south;
            }
        } else if ny > 1 {
            for (out, north) in out[1..nx - 1].iter_mut().zip(&north[1..]) {
                *out += north;
            }
        }
        if self.across.is_some() {
            return;
        }
        // Entrainment, downstream: nodes that are not filled advect their inflow.
        let [here, up] = self.upwind[j];
        let mut inflow = higher_order[0] - up * mass[0];
        for i in 1..nx - 1 {
            let flow = out[i] - inflow;
            out[i] = flow + here * mass[i] + higher_order[i];
            inflow = if advected[i] > 0.0 { -advected[i] * flow } else { higher_order[i] - up * mass[i] };
        }
    }

    /// Marks all nodes that are not filled where surfaces turn; false where they move along x alone.
    pub(super) fn mark_all_coupled(&self, is_coupled: &mut [bool]) -> bool {
        let turns = self.across.is_some();
        if turns {
            let nodes = is_coupled.iter_mut().zip(&self.advected);
            nodes.for_each(|(is_coupled, advected)| *is_coupled = *advected > 0.0);
        }
        turns
    }

    /// Marks the nodes that are not filled upstream of node `k`, as far as `may` admits: the balance of the node
    /// is coupled to their inflow.
    pub(super) fn mark_coupled(&self, k: usize, may: impl Fn(usize) -> bool, is_coupled: &mut [bool]) {
        let mut up = k - 1;
        while self.advected[up] > 0.0 && may(up) && !is_coupled[up] {
            is_coupled[up] = true;
            up -= 1;
        }
    }

    /// Row of inner node `k` of the fluid block, center, east, west, north and south: entrainment of first order,
    /// `dof_map` giving pressure and film of a node per unknown. The unknown of a node that `is_coupled` is the
    /// flow that it advects.
    pub(super) fn stencil_row(
        &self,
        k: usize,
        dof_map: impl Fn(usize) -> [f32; 2],
        is_coupled: &[bool],
    ) -> [f32; STENCIL] {
        let nx = self.grid.nx();
        let [here, up] = self.near[k / nx];
        let (east, north, mass) = (&self.east, &self.north, &self.mass);
        // Derivatives by pressures (`a` = 0) or by films (2), at `a` and `a + 1` in the flows.
        let derivatives = |a: usize| {
            let across = match self.grid.south_of(k) {
                Some(south) => [north[a][k] - north[a + 1][south], north[a + 1][k], -north[a][south]],
                None => [north[a][k], north[a + 1][k], 0.0],
            };
            let mass = &mass[a / 2];
            [
                here * mass[k] + (east[a][k] - east[a + 1][k - 1]) + across[0],
                east[a + 1][k],
                up * mass[k - 1] - east[a][k - 1],
                across[1],
                across[2],
            ]
        };
        let (by_pressure, by_film) = (derivatives(0), derivatives(2));
        let [north_of, south_of] = [self.grid.north_of(k), self.grid.south_of(k)].map(|o| o.unwrap_or(k));
        let nodes = [k, k + 1, k - 1, north_of, south_of];
        let share = if is_coupled[k] { self.advected[k] } else { 1.0 };
        let mut row = std::array::from_fn(|slot| {
            let [pressure, film] = dof_map(nodes[slot]);
            share * (by_pressure[slot] * pressure + by_film[slot] * film)
        });
        if is_coupled[k] {
            row[0] = 1.0;
        }
        if is_coupled[k - 1] {
            row[2] = -share;
        }
        if let Some(across) = &self.across {
            across.add_to_row(k, &mut row, dof_map, (is_coupled, &self.advected));
        }
        row
    }
}

#[cfg(test)]
mod tests;
