//! Newton's method on the mass balances of a few cells, everything around held.

use super::linearization::Linearization;
use super::node::{Material, NodeBalance, NodePrediction, NodeSolution};
use super::prediction::Prediction;
use super::settings::{REGION_SHARE, REGION_STEPS};
use super::weak_coupling::is_weakly_coupled;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::{GridLu, STENCIL};
use crate::reynolds::active_set::{Fluid, NodeState, Solid};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::flow::{Discretisation, MARGIN, NearField};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// A rectangle of nodes whose films respond to their own pressures alone. Those near its edges, and all that are
/// strongly coupled to their films, are held.
#[derive(Debug)]
pub(super) struct Window {
    grid: Grid,
    /// Node of the whole grid that is node 0 of the window, and nodes in a row of the whole grid.
    first: usize,
    stride: usize,
    fluid: Discretisation,
    linearization: Linearization,
    lu: GridLu,
    stencil: Vec<f32>,
    nodes: Vec<NodeSolution>,
    best: Vec<NodeSolution>,
    /// Whether the best solution is better than the nodes as they came.
    is_better: bool,
    /// Prediction of the whole step: total pressures \[Pa\] and films without plastic depth \[m\].
    predicted: Vec<[f64; 2]>,
    previous_mass: Vec<f64>,
    /// Fluid pressures \[Pa\], films and films without plastic depth \[m\] of the nodes.
    pressure: Vec<f64>,
    film: Vec<f64>,
    elastic_film: Vec<f64>,
    /// Weakly coupled nodes, for which the window solves.
    chosen: Vec<bool>,
    /// Chosen nodes that are not filled, upstream of a node with a balance.
    is_coupled: Vec<bool>,
    /// Pressure and film of each node per unknown.
    dof_map: Vec<[f32; 2]>,
    unknown: Vec<f32>,
    pressure_change: Vec<f32>,
    film_change: Vec<f32>,
    balance_change: Vec<f32>,
}

impl Window {
    /// A window of `side` cells a side, or of as many as there are in `whole`.
    pub(super) fn new(whole: &Grid, side: usize) -> Self {
        let grid = whole.corner(side.min(whole.nx()), side.min(whole.ny()));
        let n = grid.len();
        let side = NodeState { fluid: Fluid::Boundary, solid: Solid::Open };
        let node = NodeSolution { side, pressure: 0.0, fluid_pressure: 0.0, depth: 0.0 };
        Self {
            grid,
            first: 0,
            stride: whole.nx(),
            fluid: Discretisation::new(grid),
            linearization: Linearization::new(grid),
            lu: GridLu::new(grid.nx(), grid.ny()),
            stencil: vec![0.0; STENCIL * n],
            nodes: vec![node; n],
            best: vec![node; n],
            is_better: false,
            predicted: vec![[0.0; 2]; n],
            previous_mass: vec![0.0; n],
            pressure: vec![0.0; n],
            film: vec![0.0; n],
            elastic_film: vec![0.0; n],
            chosen: vec![false; n],
            is_coupled: vec![false; n],
            dof_map: vec![[0.0; 2]; n],
            unknown: vec![0.0; n],
            pressure_change: vec![0.0; n],
            film_change: vec![0.0; n],
            balance_change: vec![0.0; n],
        }
    }

    /// Node of the whole grid that node `q` of the window is.
    fn whole_index(&self, q: usize) -> usize {
        self.first + q % self.grid.nx() + q / self.grid.nx() * self.stride
    }

    /// Whether the balance of node `q` depends on nodes of the window alone.
    fn is_core(&self, q: usize) -> bool {
        let inside = |i: usize, n: usize| n == 1 || (i >= MARGIN && i + MARGIN < n);
        inside(q % self.grid.nx(), self.grid.nx()) && inside(q / self.grid.nx(), self.grid.ny())
    }

    /// Places the window around node `k` of the whole grid, inside of it.
    pub(super) fn place(&mut self, k: usize, whole: &Grid) {
        let place = |i: usize, n: usize, all: usize| i.saturating_sub(n / 2).min(all - n);
        self.first = place(k % whole.nx(), self.grid.nx(), whole.nx())
            + place(k / whole.nx(), self.grid.ny(), whole.ny()) * whole.nx();
    }

    /// Columns and rows of the whole grid between the first node of the window and node `k`.
    fn offset(&self, k: usize) -> [isize; 2] {
        let between = |a: usize, b: usize| a.cast_signed() - b.cast_signed();
        [
            between(k % self.stride, self.first % self.stride),
            between(k / self.stride, self.first / self.stride),
        ]
    }

    /// Whether node `k` of the whole grid is one whose balance depends on nodes of the window alone.
    pub(super) fn solves_for(&self, k: usize) -> bool {
        let [i, j] = self.offset(k).map(|offset| usize::try_from(offset).unwrap_or(usize::MAX));
        i < self.grid.nx() && j < self.grid.ny() && self.is_core(i + j * self.grid.nx())
    }

    /// Whether two windows have common nodes.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        let [columns, rows] = self.offset(other.first).map(isize::unsigned_abs);
        columns < self.grid.nx() && rows < self.grid.ny()
    }

    /// Copies the nodes of the window.
    pub(super) fn enter(
        &mut self,
        coupled: &Coupled,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        prediction: &Prediction<'_>,
    ) {
        // Coefficients of the flow, states of the nodes, prediction.
        self.fluid.set_window(&coupled.fluid, self.first);
        for q in 0..self.grid.len() {
            let k = self.whole_index(q);
            self.nodes[q] = NodeSolution {
                side: coupled.active_set[k],
                pressure: state.pressure[k],
                fluid_pressure: if coupled.active_set[k].fluid == Fluid::Boundary {
                    problem.edge_pressure_at(k)
                } else {
                    state.fluid_pressure[k]
                },
                depth: state.plastic_depth[k],
            };
            self.predicted[q] = prediction.pressure_and_film(k);
            if let Some(squeeze) = problem.squeeze {
                self.previous_mass[q] = squeeze.previous_mass[k];
            }
        }
    }

    /// Copies the best solution to the whole grid if it is better than the state there; its nodes count as solved
    /// either way.
    pub(super) fn leave(&self, coupled: &mut Coupled, state: &mut ContactState, solved: &mut [bool]) {
        for q in (0..self.grid.len()).filter(|&q| self.is_core(q)) {
            let k = self.whole_index(q);
            solved[k] = true;
            if self.is_better && self.chosen[q] {
                self.best[q].write(k, coupled, state);
            }
        }
    }

    /// Newton steps for the weakly coupled nodes; keeps the best solution if it lowers the sum of their imbalances.
    pub(super) fn solve(
        &mut self,
        problem: &LubricatedContact<'_>,
        lubricant: &Lubricant,
        step_bound: f64,
        near: NearField,
    ) {
        self.flow(problem, lubricant, near.own);
        // Choose the nodes.
        for q in 0..self.grid.len() {
            let side = self.nodes[q].side;
            self.chosen[q] = self.is_core(q) && is_weakly_coupled(&self.fluid, side, q, near);
        }
        let before = self.residual_norm(problem);
        let mut least = before;
        for _ in 0..REGION_STEPS {
            // One Newton step, its residual, the best solution so far.
            if !self.step(problem, lubricant, near.own, step_bound) {
                break;
            }
            self.flow(problem, lubricant, near.own);
            let residual = self.residual_norm(problem);
            if residual < least {
                least = residual;
                self.best.copy_from_slice(&self.nodes);
            }
            if least < (1.0 - REGION_SHARE) * before {
                break;
            }
        }
        self.is_better = least < before;
    }

    /// Flow through the films that respond to own pressures.
    fn flow(&mut self, problem: &LubricatedContact<'_>, lubricant: &Lubricant, own: f64) {
        let contact_film = problem.contact_film();
        for (q, node) in self.nodes.iter().enumerate() {
            let [predicted_pressure, predicted_film] = self.predicted[q];
            let elastic_film = predicted_film + own * (node.pressure - predicted_pressure);
            self.elastic_film[q] = elastic_film;
            self.pressure[q] = node.fluid_pressure;
            self.film[q] = match (node.side.fluid, node.side.solid) {
                (_, Solid::Contact) => contact_film,
                (Fluid::AtLimit, _) => elastic_film + node.depth,
                (_, Solid::Yielded) => elastic_film.max(contact_film),
                (_, Solid::Open) => elastic_film,
            };
        }
        let previous = previous(problem, &self.previous_mass);
        self.fluid.update_window(lubricant, &self.pressure, &self.film, previous);
    }

    /// Residual norm of the window: the sum of the imbalances of the chosen nodes.
    fn residual_norm(&self, problem: &LubricatedContact<'_>) -> f64 {
        let previous = previous(problem, &self.previous_mass);
        let chosen = (0..self.grid.len()).filter(|&q| self.chosen[q]);
        chosen.map(|q| self.fluid.imbalance(q, previous).abs()).sum()
    }

    /// One Newton step for the chosen nodes, with the elimination of their own equations as in a step of the
    /// whole; false where their equations have no finite factors.
    fn step(
        &mut self,
        problem: &LubricatedContact<'_>,
        lubricant: &Lubricant,
        own: f64,
        step_bound: f64,
    ) -> bool {
        let film_unit = own * problem.reference_pressure;
        if !self.linear_step(problem, film_unit, own) {
            return false;
        }
        let previous = previous(problem, &self.previous_mass);
        for q in (0..self.grid.len()).filter(|&q| self.chosen[q]) {
            // Predict the node.
            let NodeSolution { side, pressure, fluid_pressure, .. } = self.nodes[q];
            let change = f64::from(self.pressure_change[q]) * problem.reference_pressure;
            let film_change = f64::from(self.film_change[q]) * film_unit;
            let own_change = if side.solid == Solid::Open { [change, film_change] } else { [0.0; 2] };
            let material = Material {
                contact_film: problem.contact_film(),
                limit: problem.limit_at(self.whole_index(q)),
                own_influence: own,
                step_bound,
            };
            let own_balance = NodeBalance::new(&self.fluid, lubricant, q);
            let balance = self.fluid.balance(q, previous);
            let imbalance = if side.has_balance() {
                balance - self.fluid.imbalance(q, previous)
            } else {
                balance + f64::from(self.balance_change[q]) * film_unit
            };
            let prediction = NodePrediction {
                pressure: pressure + own_change[0],
                fluid_pressure: fluid_pressure + change,
                elastic_film: self.elastic_film[q] + own_change[1],
                depth: 0.0,
                share: own_balance.predicted_share(self.film[q], [change, film_change], imbalance),
            };
            // Solve its own equations, near the prediction of the whole step.
            let mut node = own_balance.eliminate(material, prediction);
            if node.side.solid == Solid::Open && node.side.fluid == Fluid::Active {
                let [predicted, _] = self.predicted[q];
                node.pressure =
                    node.pressure.clamp((predicted - step_bound).max(0.0), predicted.max(0.0) + step_bound);
                node.fluid_pressure = node.pressure;
            }
            self.nodes[q] = node;
        }
        true
    }

    /// Solves the linearized balances of the chosen nodes for the changes of their pressures and films, and
    /// finds those of their balances, in the units of [`Linearization`]; false where the equations have no
    /// finite factors.
    fn linear_step(&mut self, problem: &LubricatedContact<'_>, film_unit: f64, own: f64) -> bool {
        // Linearize and choose the unknowns.
        self.linearization.update(&self.fluid, own);
        self.is_coupled.fill(false);
        for (q, node) in self.nodes.iter().enumerate() {
            let has_balance = self.chosen[q] && node.side.has_balance();
            self.dof_map[q] = [has_balance, has_balance && !node.side.is_contact()].map(f32::from);
            if has_balance {
                self.linearization.mark_coupled(q, |up| self.chosen[up], &mut self.is_coupled);
            }
        }
        // Assemble matrix and right-hand side.
        let previous = previous(problem, &self.previous_mass);
        for (q, row) in self.stencil.chunks_exact_mut(STENCIL).enumerate() {
            let is_unknown = self.dof_map[q][0] > 0.0;
            let entries = if is_unknown || self.is_coupled[q] {
                self.linearization.stencil_row(q, |node| self.dof_map[node], &self.is_coupled)
            } else {
                [1.0, 0.0, 0.0, 0.0, 0.0]
            };
            row.copy_from_slice(&entries);
            let imbalance = if is_unknown { self.fluid.imbalance(q, previous) } else { 0.0 };
            self.unknown[q] = (-imbalance / film_unit) as f32;
        }
        // Solve, and scatter the unknowns to pressures and films.
        if !self.lu.factorise(&self.stencil) {
            return false;
        }
        self.lu.solve(&mut self.unknown);
        for (q, unknown) in self.unknown.iter().enumerate() {
            [self.pressure_change[q], self.film_change[q]] = self.dof_map[q].map(|share| share * unknown);
        }
        self.linearization.product(&self.pressure_change, &self.film_change, &mut self.balance_change);
        true
    }
}

/// The masses of the previous time, those of a window, where there is one.
fn previous<'a>(problem: &LubricatedContact<'_>, mass: &'a [f64]) -> Option<&'a [f64]> {
    problem.squeeze.is_some().then_some(mass)
}
