//! Newton's method on the mass balances of a few cells, everything around them held.

use super::linearisation::Linearisation;
use super::local::{Forecast, Local, Material, NodeState};
use super::pockets::is_in_pocket;
use super::settings::PocketSettings;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::{GridLu, STENCIL};
use crate::reynolds::active_set::{Fluid, Kind, Solid};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::flow::{Discretisation, MARGIN, NearField};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// A rectangle of nodes whose films follow their own pressures alone. Those near its edges, and all but the
/// nodes of pockets, are held.
#[derive(Debug)]
pub(super) struct Window {
    grid: Grid,
    /// Node of the whole grid that is node 0 of the window, and nodes in a row of the whole grid.
    first: usize,
    stride: usize,
    fluid: Discretisation,
    linearisation: Linearisation,
    lu: GridLu,
    stencil: Vec<f32>,
    nodes: Vec<NodeState>,
    best: Vec<NodeState>,
    /// What the linear step of the whole foresees: films without plastic depth \[m\], total pressures \[Pa\].
    foreseen_film: Vec<f64>,
    foreseen_pressure: Vec<f64>,
    previous_mass: Vec<f64>,
    /// Fluid pressures \[Pa\], films and films without plastic depth \[m\] of the present nodes.
    pressure: Vec<f64>,
    film: Vec<f64>,
    elastic_film: Vec<f64>,
    /// Nodes of pockets, which the window solves for.
    chosen: Vec<bool>,
    /// Chosen nodes that are not filled and carry on what enters them to a node with a balance.
    linked: Vec<bool>,
    /// By how much the unknown of a node moves its pressure and its film.
    follows: Vec<[f32; 2]>,
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
        let kind = Kind { fluid: Fluid::Boundary, solid: Solid::Open };
        let node = NodeState { kind, pressure: 0.0, fluid_pressure: 0.0, depth: 0.0 };
        Self {
            grid,
            first: 0,
            stride: whole.nx(),
            fluid: Discretisation::new(grid),
            linearisation: Linearisation::new(grid),
            lu: GridLu::new(grid.nx(), grid.ny()),
            stencil: vec![0.0; STENCIL * n],
            nodes: vec![node; n],
            best: vec![node; n],
            foreseen_film: vec![0.0; n],
            foreseen_pressure: vec![0.0; n],
            previous_mass: vec![0.0; n],
            pressure: vec![0.0; n],
            film: vec![0.0; n],
            elastic_film: vec![0.0; n],
            chosen: vec![false; n],
            linked: vec![false; n],
            follows: vec![[0.0; 2]; n],
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

    /// Whether all that the balance of node `q` hangs on lies in the window.
    fn is_core(&self, q: usize) -> bool {
        let inside = |i: usize, n: usize| n == 1 || (i >= MARGIN && i + MARGIN < n);
        inside(q % self.grid.nx(), self.grid.nx()) && inside(q / self.grid.nx(), self.grid.ny())
    }

    /// Lays the window around node `k` of the whole grid, for which films and pressures are `foreseen`.
    pub(super) fn enter(
        &mut self,
        k: usize,
        coupled: &Coupled,
        problem: &LubricatedContact<'_>,
        state: &ContactState,
        foreseen: [&[f64]; 2],
    ) {
        let whole = &coupled.fluid.grid;
        let place = |i: usize, n: usize, all: usize| i.saturating_sub(n / 2).min(all - n);
        self.first = place(k % whole.nx(), self.grid.nx(), whole.nx())
            + place(k / whole.nx(), self.grid.ny(), whole.ny()) * whole.nx();
        self.fluid.look_at(&coupled.fluid, self.first);
        for q in 0..self.grid.len() {
            let k = self.whole_index(q);
            self.nodes[q] = NodeState {
                kind: coupled.kinds[k],
                pressure: state.pressure[k],
                fluid_pressure: if coupled.kinds[k].fluid == Fluid::Boundary {
                    problem.edge_pressure_at(k)
                } else {
                    state.fluid_pressure[k]
                },
                depth: state.plastic_depth[k],
            };
            (self.foreseen_film[q], self.foreseen_pressure[q]) = (foreseen[0][k], foreseen[1][k]);
            if let Some(squeeze) = problem.squeeze {
                self.previous_mass[q] = squeeze.previous_mass[k];
            }
        }
    }

    /// Takes the best states found to the whole if they are better than those it had; its nodes are settled
    /// either way.
    pub(super) fn leave(
        &self,
        is_better: bool,
        coupled: &mut Coupled,
        state: &mut ContactState,
        settled: &mut [bool],
    ) {
        for q in (0..self.grid.len()).filter(|&q| self.is_core(q)) {
            let k = self.whole_index(q);
            settled[k] = true;
            if is_better && self.chosen[q] {
                self.best[q].put(k, coupled, state);
            }
        }
    }

    /// Newton steps for the nodes of pockets; says whether one of them lessens the sum of what they lack.
    pub(super) fn solve(
        &mut self,
        problem: &LubricatedContact<'_>,
        lubricant: &Lubricant,
        settings: PocketSettings,
        trust: f64,
        near: NearField,
    ) -> bool {
        self.flow(problem, lubricant, near.own);
        for q in 0..self.grid.len() {
            let kind = self.nodes[q].kind;
            self.chosen[q] = self.is_core(q) && is_in_pocket(&self.fluid, kind, q, near);
        }
        let before = self.lack(problem);
        let mut least = before;
        for _ in 0..settings.steps {
            if !self.step(problem, lubricant, near.own, trust) {
                break;
            }
            self.flow(problem, lubricant, near.own);
            let lack = self.lack(problem);
            if lack < least {
                least = lack;
                self.best.copy_from_slice(&self.nodes);
            }
            if least < (1.0 - settings.share) * before {
                break;
            }
        }
        least < before
    }

    /// Flow through the films that follow the own pressures.
    fn flow(&mut self, problem: &LubricatedContact<'_>, lubricant: &Lubricant, own: f64) {
        let contact_film = problem.contact_film();
        for (q, node) in self.nodes.iter().enumerate() {
            let elastic_film = self.foreseen_film[q] + own * (node.pressure - self.foreseen_pressure[q]);
            self.elastic_film[q] = elastic_film;
            self.pressure[q] = node.fluid_pressure;
            self.film[q] = match (node.kind.fluid, node.kind.solid) {
                (_, Solid::Contact) => contact_film,
                (Fluid::AtLimit, _) => elastic_film + node.depth,
                (_, Solid::Yielded) => elastic_film.max(contact_film),
                (_, Solid::Open) => elastic_film,
            };
        }
        let previous = previous(problem, &self.previous_mass);
        self.fluid.update_window(lubricant, &self.pressure, &self.film, previous);
    }

    /// Sum of the imbalances of the chosen nodes.
    fn lack(&self, problem: &LubricatedContact<'_>) -> f64 {
        let previous = previous(problem, &self.previous_mass);
        let chosen = (0..self.grid.len()).filter(|&q| self.chosen[q]);
        chosen.map(|q| self.fluid.imbalance(q, previous).abs()).sum()
    }

    /// One Newton step for the chosen nodes, with the elimination of their own equations that a step of the
    /// whole has; false where their equations have no finite factors.
    fn step(&mut self, problem: &LubricatedContact<'_>, lubricant: &Lubricant, own: f64, trust: f64) -> bool {
        let film_unit = own * problem.reference_pressure;
        if !self.linear_step(problem, film_unit, own) {
            return false;
        }
        let previous = previous(problem, &self.previous_mass);
        for q in (0..self.grid.len()).filter(|&q| self.chosen[q]) {
            let NodeState { kind, pressure, fluid_pressure, .. } = self.nodes[q];
            let change = f64::from(self.pressure_change[q]) * problem.reference_pressure;
            let film_change = f64::from(self.film_change[q]) * film_unit;
            let own_change = if kind.solid == Solid::Open { [change, film_change] } else { [0.0; 2] };
            let material = Material {
                contact_film: problem.contact_film(),
                limit: problem.limit_at(self.whole_index(q)),
                own_influence: own,
                trust,
            };
            let local = Local::new(&self.fluid, lubricant, q);
            let balance = self.fluid.balance(q, previous);
            let imbalance = if kind.has_balance() {
                balance - self.fluid.imbalance(q, previous)
            } else {
                balance + f64::from(self.balance_change[q]) * film_unit
            };
            let forecast = Forecast {
                pressure: pressure + own_change[0],
                fluid_pressure: fluid_pressure + change,
                elastic_film: self.elastic_film[q] + own_change[1],
                depth: 0.0,
                share: local.foreseen_share(self.film[q], [change, film_change], imbalance),
            };
            let mut node = local.eliminate(material, forecast);
            if node.kind.solid == Solid::Open && node.kind.fluid == Fluid::Active {
                // The whole does not follow what leaves its forecast by much.
                let foreseen = self.foreseen_pressure[q];
                node.pressure = node.pressure.clamp((foreseen - trust).max(0.0), foreseen.max(0.0) + trust);
                node.fluid_pressure = node.pressure;
            }
            self.nodes[q] = node;
        }
        true
    }

    /// Solves the linearised balances of the chosen nodes for the changes of their pressures and films, and
    /// finds those of their balances, in the units of [`Linearisation`]; false where the equations have no
    /// finite factors.
    fn linear_step(&mut self, problem: &LubricatedContact<'_>, film_unit: f64, own: f64) -> bool {
        self.linearisation.update(&self.fluid, own);
        self.linked.fill(false);
        for (q, node) in self.nodes.iter().enumerate() {
            let has_balance = self.chosen[q] && node.kind.has_balance();
            self.follows[q] = [has_balance, has_balance && !node.kind.is_contact()].map(f32::from);
            if has_balance {
                self.linearisation.link(q, |up| self.chosen[up], &mut self.linked);
            }
        }
        let previous = previous(problem, &self.previous_mass);
        for (q, row) in self.stencil.chunks_exact_mut(STENCIL).enumerate() {
            let is_unknown = self.follows[q][0] > 0.0;
            let entries = if is_unknown || self.linked[q] {
                self.linearisation.stencil_row(q, |node| self.follows[node], &self.linked)
            } else {
                [1.0, 0.0, 0.0, 0.0, 0.0]
            };
            row.copy_from_slice(&entries);
            let lack = if is_unknown { self.fluid.imbalance(q, previous) } else { 0.0 };
            self.unknown[q] = (-lack / film_unit) as f32;
        }
        if !self.lu.factorise(&self.stencil) {
            return false;
        }
        self.lu.solve(&mut self.unknown);
        for (q, unknown) in self.unknown.iter().enumerate() {
            [self.pressure_change[q], self.film_change[q]] = self.follows[q].map(|share| share * unknown);
        }
        self.linearisation.product(&self.pressure_change, &self.film_change, &mut self.balance_change);
        true
    }
}

/// The masses of the previous time, those of a window, where there is one.
fn previous<'a>(problem: &LubricatedContact<'_>, mass: &'a [f64]) -> Option<&'a [f64]> {
    problem.squeeze.is_some().then_some(mass)
}
