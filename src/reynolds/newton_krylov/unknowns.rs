//! The unknowns of a Newton step and the linearized equations.
//!
//! A vector holds the unknowns alone, one after the other:
//!
//! | nodes | unknown | its row |
//! |---|---|---|
//! | open fluid | pressure | mass balance |
//! | fluid at the limit | plastic depth | mass balance |
//! | contact with fluid pressure, yielded or not | fluid pressure | mass balance |
//! | contact that has not yielded | total pressure | gap; the flow takes the contact film |
//! | | approach | load balance |
//!
//! Pressures are in reference pressures, films in deflections of a node under the reference pressure alone. All
//! numbers are then near one, and single precision suffices: a Newton step is solved to a tenth, on a row to the
//! rounding of its numbers.

mod responses;
#[cfg(test)]
mod tests;

use super::linearization::Linearization;
use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::active_set::{Fluid, NodeState, Solid};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Accuracy of elastic responses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Response {
    /// Convolution on the padded grid, in single precision.
    Padded,
    /// Convolution on the periodic grid: some per cent off at large distances, at a quarter of the cost.
    Periodic,
}

/// The contact that is linearized at a state, and its mass balances.
pub(super) struct Linearized<'a, 'b> {
    pub(super) coupled: &'a mut Coupled,
    pub(super) problem: &'a mut LubricatedContact<'b>,
    pub(super) linearization: &'a mut Linearization,
}

/// The nodes of each kind of unknown, and the changes of all nodes under a vector of unknowns.
#[derive(Debug)]
pub(super) struct Unknowns {
    /// Nodes with a mass balance: open fluid, fluid at the limit, contact.
    balanced: Vec<u32>,
    /// Indices at which the second and the third of these begin.
    limited_from: usize,
    contact_from: usize,
    /// Nodes in contact that have not yielded, and those that have.
    contact: Vec<u32>,
    yielded: Vec<u32>,
    /// Changes of total and fluid pressure that the active set prescribes \[Pa\].
    pinned: Vec<(u32, [f64; 2])>,
    /// One over the sizes of the mass balances.
    weights: Vec<f32>,
    /// The reference pressure \[Pa\] and the deflection of a node under it \[m\].
    pressure_unit: f64,
    film_unit: f64,
    /// Load of the reference pressure in one cell over the load; zero where the approach is held.
    cell_load: f64,
    /// Changes of total pressure \[Pa\] and of the film without plastic depth \[m\].
    pressure: Vec<f64>,
    elastic: Vec<f64>,
    /// Changes of fluid pressure, film and balance.
    fluid: Vec<f32>,
    film: Vec<f32>,
    balance: Vec<f32>,
}

/// Changes of one node in a linear step \[Pa, m\].
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeChange {
    pub(super) pressure: f64,
    pub(super) fluid_pressure: f64,
    pub(super) film: f64,
    pub(super) elastic_film: f64,
    pub(super) balance: f64,
}

impl NodeChange {
    /// These changes times `share`.
    pub(super) fn times(self, share: f64) -> Self {
        Self {
            pressure: share * self.pressure,
            fluid_pressure: share * self.fluid_pressure,
            film: share * self.film,
            elastic_film: share * self.elastic_film,
            balance: share * self.balance,
        }
    }
}

impl Unknowns {
    pub(super) fn new(grid: Grid) -> Self {
        let n = grid.len();
        let nodes = || Vec::with_capacity(n);
        Self {
            balanced: nodes(),
            limited_from: 0,
            contact_from: 0,
            contact: nodes(),
            yielded: nodes(),
            pinned: Vec::with_capacity(n),
            weights: Vec::with_capacity(n),
            pressure_unit: 1.0,
            film_unit: 1.0,
            cell_load: 0.0,
            pressure: vec![0.0; n],
            elastic: vec![0.0; n],
            fluid: vec![0.0; n],
            film: vec![0.0; n],
            balance: vec![0.0; n],
        }
    }

    /// Most unknowns that a grid can have.
    pub(super) fn most(grid: &Grid) -> usize {
        2 * grid.len() + 1
    }

    /// Number of unknowns.
    pub(super) fn len(&self) -> usize {
        self.balanced.len() + self.contact.len() + 1
    }

    /// Open nodes whose fluid pressure is unknown, the first unknowns.
    pub(super) fn open(&self) -> &[u32] {
        &self.balanced[..self.limited_from]
    }

    /// All nodes with a mass balance.
    pub(super) fn balanced(&self) -> &[u32] {
        &self.balanced
    }

    /// One over the size of the row of a mass balance.
    pub(super) fn weight(&self, row: usize) -> f32 {
        self.weights[row]
    }

    /// Nodes in contact that have not yielded.
    pub(super) fn contact(&self) -> &[u32] {
        &self.contact
    }

    /// Partitions the nodes by the active set.
    pub(super) fn partition(
        &mut self,
        coupled: &Coupled,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
    ) {
        self.pressure_unit = problem.reference_pressure;
        self.film_unit = coupled.near.own * problem.reference_pressure;
        let area = coupled.fluid.grid.cell_area();
        self.cell_load = problem.box_load().map_or(0.0, |load| area * problem.reference_pressure / load);
        // Unknowns: fluid pressures and plastic depths, then total pressures of contact.
        self.balanced.clear();
        push_all(&mut self.balanced, &coupled.active_set, NodeState::is_open_fluid);
        self.limited_from = self.balanced.len();
        push_all(&mut self.balanced, &coupled.active_set, |node_state| node_state.fluid == Fluid::AtLimit);
        self.contact_from = self.balanced.len();
        push_all(&mut self.balanced, &coupled.active_set, |node_state| {
            node_state.has_fluid_pressure() && node_state.is_contact()
        });
        self.contact.clear();
        push_all(&mut self.contact, &coupled.active_set, |node_state| node_state.solid == Solid::Contact);
        self.yielded.clear();
        push_all(&mut self.yielded, &coupled.active_set, |node_state| node_state.solid == Solid::Yielded);
        // Prescribed changes: pressures that vanish, and those at the limit.
        self.pinned.clear();
        for (k, node_state) in coupled.active_set.iter().enumerate() {
            let (total, fluid) = (state.pressure[k], state.fluid_pressure[k]);
            let drop = if node_state.has_balance() { 0.0 } else { -fluid };
            let pinned = match node_state.solid {
                Solid::Open => [if node_state.has_balance() { 0.0 } else { -total }, drop],
                Solid::Contact => [0.0, drop],
                Solid::Yielded => [problem.limit_at(k) - total, drop],
            };
            if pinned.iter().any(|change| change.abs() > 0.0) {
                self.pinned.push((k as u32, pinned));
            }
        }
    }

    /// Takes the size of the rows of the mass balances, by node.
    pub(super) fn set_row_sizes(&mut self, size: impl Fn(usize) -> f32) {
        self.weights.clear();
        self.weights.extend(self.balanced.iter().map(|&k| 1.0 / size(k as usize)));
    }

    /// Scatters the vector `x` and the prescribed changes to the changes of all nodes.
    pub(super) fn scatter_step(
        &mut self,
        at: &mut Linearized<'_, '_>,
        x: &[f32],
        response: Response,
    ) -> Result<(), InputError> {
        self.place(x);
        for (k, [total, fluid]) in &self.pinned {
            self.pressure[*k as usize] = *total;
            if *fluid != 0.0 {
                self.fluid[*k as usize] = (fluid / self.pressure_unit) as f32;
            }
        }
        self.respond(at, x, response)
    }

    /// The same without prescribed changes, from the share of each direction in the vector `x` and its `films`
    /// (see [`Unknowns::copy_films`]); no convolution.
    pub(super) fn scatter_step_from_films<'f>(
        &mut self,
        linearization: &mut Linearization,
        x: &[f32],
        films: impl Iterator<Item = (f64, &'f [f32])>,
    ) {
        self.place(x);
        self.elastic.fill(0.0);
        for (share, films) in films {
            let share = share * self.film_unit;
            for (elastic, film) in self.elastic.iter_mut().zip(films) {
                *elastic += share * f64::from(*film);
            }
        }
        self.flow_under(linearization, x);
    }

    /// Whether the active set prescribes changes.
    pub(super) fn are_pinned(&self) -> bool {
        !self.pinned.is_empty()
    }

    /// Right-hand side: minus the residual at `state` under the prescribed changes; one convolution, none without
    /// such changes.
    pub(super) fn residual(
        &mut self,
        at: &mut Linearized<'_, '_>,
        state: &ContactState,
        out: &mut [f32],
    ) -> Result<(), InputError> {
        if self.pinned.is_empty() {
            self.elastic.fill(0.0);
            self.balance.fill(0.0);
        } else {
            out.fill(0.0);
            self.scatter_step(at, out, Response::Padded)?;
        }
        let changes = self.pinned.iter().map(|(_, [change, _])| change).sum::<f64>();
        let carried = (state.pressure.iter().sum::<f64>() + changes) / self.pressure_unit * self.cell_load;
        // Mass balances, gaps of contact, load.
        let (balances, rest) = out.split_at_mut(self.balanced.len());
        for ((row, &k), weight) in balances.iter_mut().zip(&self.balanced).zip(&self.weights) {
            let present = (at.coupled.balance[k as usize] / self.film_unit) as f32;
            *row = -weight * (self.balance[k as usize] + present);
        }
        let contact_film = at.problem.contact_film();
        for (row, &k) in rest.iter_mut().zip(&self.contact) {
            let present = (at.coupled.elastic_film[k as usize] - contact_film) / self.film_unit;
            *row = -((self.elastic[k as usize] / self.film_unit + present) as f32);
        }
        rest[self.contact.len()] = if self.cell_load > 0.0 { (1.0 - carried) as f32 } else { 0.0 };
        Ok(())
    }

    /// The load that the pressures of a vector carry, over the load.
    pub(super) fn load(&self, x: &[f32]) -> f64 {
        let (fluid, rest) = x.split_at(self.balanced.len());
        let pressures = fluid[..self.limited_from].iter().chain(&rest[..self.contact.len()]);
        pressures.map(|&p| f64::from(p)).sum::<f64>() * self.cell_load
    }

    /// Largest change of a total pressure in a vector \[Pa\].
    pub(super) fn largest_pressure(&self, x: &[f32]) -> f64 {
        let pressures = x[..self.limited_from].iter().chain(&x[self.balanced.len()..self.len() - 1]);
        f64::from(pressures.fold(0.0_f32, |largest, change| largest.max(change.abs()))) * self.pressure_unit
    }

    /// Change of the approach of a vector \[m\].
    pub(super) fn approach(&self, x: &[f32]) -> f64 {
        f64::from(x[self.len() - 1]) * self.film_unit
    }

    /// Changes of node `k` at the last [`Unknowns::scatter_step`].
    pub(super) fn node(&self, k: usize) -> NodeChange {
        NodeChange {
            pressure: self.pressure[k],
            fluid_pressure: f64::from(self.fluid[k]) * self.pressure_unit,
            film: f64::from(self.film[k]) * self.film_unit,
            elastic_film: self.elastic[k],
            balance: f64::from(self.balance[k]) * self.film_unit,
        }
    }
}

fn push_all(nodes: &mut Vec<u32>, active_set: &[NodeState], wanted: impl Fn(NodeState) -> bool) {
    nodes.extend(
        active_set.iter().enumerate().filter(|(_, node_state)| wanted(**node_state)).map(|(k, _)| k as u32),
    );
}
