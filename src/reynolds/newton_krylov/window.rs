//! Newton's method on the mass balances of a few cells, everything around held.

use super::fluid_block::lu_of;
use super::linearization::Linearization;
use super::node::{NodeBalance, NodeParameters, NodePrediction, NodeSolution};
use super::prediction::Prediction;
use super::settings::{REGION_SHARE, REGION_STEPS};
use super::weak_coupling::is_weakly_coupled;
use super::window_place::WindowPlace;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::{GridLu, STENCIL};
use crate::reynolds::active_set::{Fluid, NodeState, Solid};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::flow::{Discretisation, NearField};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// A rectangle of nodes whose films respond to their own pressures alone. Those near its edges, and all that are
/// strongly coupled to their films, are held.
#[derive(Debug)]
pub(super) struct Window {
    grid: Grid,
    pub(super) place: WindowPlace,
    fluid: Discretisation,
    linearization: Linearization,
    lu: GridLu<f32>,
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
        let node_state = NodeState { fluid: Fluid::Boundary, solid: Solid::Open };
        let node = NodeSolution { node_state, pressure: 0.0, fluid_pressure: 0.0, depth: 0.0 };
        Self {
            grid,
            place: WindowPlace::new(whole, &grid),
            fluid: Discretisation::new(grid),
            linearization: Linearization::new(grid),
            lu: lu_of(&grid),
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

    /// Copies the nodes of the window.
    pub(super) fn enter(
        &mut self,
        coupled: &Coupled,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        prediction: &Prediction<'_>,
    ) {
        // Coefficients of the flow, states of the nodes, prediction.
        self.fluid.set_window(&coupled.fluid, |j| self.place.row_start(j));
        for q in 0..self.grid.len() {
            let k = self.place.node(q);
            self.nodes[q] = NodeSolution {
                // Outermost nodes keep the pressure of the edge.
                node_state: coupled.active_set[k],
                pressure: state.pressure[k],
                fluid_pressure: if coupled.active_set[k].fluid == Fluid::Boundary {
                    problem.edge_pressure_at(k)
                } else {
                    state.fluid_pressure[k]
                },
                depth: state.plastic_depth[k],
            };
            // Films respond to changes from the prediction.
            self.predicted[q] = prediction.pressure_and_film(k);
            if let Some(squeeze) = problem.squeeze {
                self.previous_mass[q] = squeeze.previous_mass[k];
            }
        }
    }

    /// Copies the best solution to the whole grid if it is better than the state there; its nodes count as solved
    /// either way.
    pub(super) fn leave(&self, coupled: &mut Coupled, state: &mut ContactState, solved: &mut [bool]) {
        for q in (0..self.grid.len()).filter(|&q| self.place.is_core(q)) {
            let k = self.place.node(q);
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
            let node_state = self.nodes[q].node_state;
            self.chosen[q] = self.place.is_core(q) && is_weakly_coupled(&self.fluid, node_state, q, near);
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
            // The elastic film by the own pressure, the others as predicted.
            let elastic_film = predicted_film + own * (node.pressure - predicted_pressure);
            self.elastic_film[q] = elastic_film;
            self.pressure[q] = node.fluid_pressure;
            // The film by the state of the node: contact, plastic depth of fluid or solid, open.
            self.film[q] = match (node.node_state.fluid, node.node_state.solid) {
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
            let NodeSolution { node_state, pressure, fluid_pressure, .. } = self.nodes[q];
            let change = f64::from(self.pressure_change[q]) * problem.reference_pressure;
            let film_change = f64::from(self.film_change[q]) * film_unit;
            let own_change = if node_state.solid == Solid::Open { [change, film_change] } else { [0.0; 2] };
            let material = NodeParameters {
                contact_film: problem.contact_film(),
                limit: problem.limit_at(self.place.node(q)),
                own_influence: own,
                step_bound,
            };
            let own_balance = NodeBalance::new(&self.fluid, lubricant, q);
            let balance = self.fluid.balance(q, previous);
            let imbalance = if node_state.has_balance() {
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
            if node.node_state.solid == Solid::Open && node.node_state.fluid == Fluid::Active {
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
            // A chosen node with a balance has a pressure; one in contact has a fixed film.
            let has_balance = self.chosen[q] && node.node_state.has_balance();
            self.dof_map[q] = [has_balance, has_balance && !node.node_state.is_contact()].map(f32::from);
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
