//! Nonlinear elimination of isolated fluid regions.
//!
//! An isolated region is fluid whose films hardly respond to its own pressures: some hundred nanometers deep, closed
//! by a boundary of one. Which of its few nodes cavitate takes many Newton steps of the whole contact to decide, each
//! of which costs convolutions. It is decided here, between two of them, by Newton's method on small [`Window`]s in
//! which films respond to own pressures alone. Windows that do not overlap are solved side by side, with the results of
//! one after the other.

use super::contact_film::clamp_film_to_contact;
use super::prediction::Prediction;
use super::settings::{MOST_REGION_NODES, REGION_SHARE, WINDOW_SIDE};
use super::weak_coupling::is_weakly_coupled;
use super::window::Window;
use crate::grid::Grid;
use crate::numerics::{chunk_count, for_each_with, map_lines, map_nodes};
use crate::reynolds::active_set::NodeState;
use crate::reynolds::coupled::Coupled;
use crate::reynolds::flow::{Discretisation, NearField};
use crate::reynolds::inner_nodes::{inner_rows, interior};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Nodes around which windows are placed, and the windows.
#[derive(Debug)]
pub(super) struct IsolatedRegions {
    /// Imbalances of weakly coupled nodes; negative at others.
    imbalance: Vec<f64>,
    /// Nodes of isolated regions, those with the largest imbalances first.
    order: Vec<u32>,
    /// Nodes that a window has solved for.
    solved: Vec<bool>,
    /// One for each of the regions that are solved side by side.
    windows: Vec<Window>,
}

impl IsolatedRegions {
    pub(super) fn new(grid: Grid) -> Self {
        let n = grid.len();
        Self {
            imbalance: vec![0.0; n],
            order: Vec::with_capacity(n),
            solved: vec![false; n],
            windows: (0..chunk_count(n)).map(|_| Window::new(&grid, WINDOW_SIDE)).collect(),
        }
    }

    /// Solves the mass balances of isolated regions at the predicted films; in contacts that conserve mass and
    /// do not spin. Leaves films and flow that belong to the pressures of the prediction.
    pub(super) fn eliminate(
        &mut self,
        prediction: &Prediction<'_>,
        step_bound: f64,
        coupled: &mut Coupled,
        problem: &LubricatedContact<'_>,
        state: &mut ContactState,
    ) {
        let Some(lubricant) = problem.lubricant else { return };
        if !coupled.fluid.conserves_mass() || coupled.fluid.sweep_order().is_some() {
            return;
        }
        // Films after the elimination of the nodes: the predicted ones plus their own response.
        let near = coupled.near;
        map_nodes(&mut coupled.elastic_film, |k, film| {
            let [predicted_pressure, predicted_film] = prediction.pressure_and_film(k);
            *film = predicted_film + near.own * (state.pressure[k] - predicted_pressure);
        });
        clamp_film_to_contact(coupled, problem, state);
        // A window around each node that holds much of the residual and is not in one yet.
        let previous = problem.squeeze.map(|squeeze| squeeze.previous_mass);
        self.find(&coupled.fluid, &coupled.active_set, near, previous);
        self.solved.fill(false);
        let Self { order, solved, windows, .. } = self;
        let mut nodes = order.iter().map(|&k| k as usize).peekable();
        while nodes.peek().is_some() {
            // The next nodes whose windows do not overlap.
            let mut count = 0;
            while let Some(&k) = nodes.peek() {
                let (placed, free) = windows.split_at_mut(count);
                if !solved[k] && placed.iter().all(|window| !window.place.solves_for(k)) {
                    let Some(window) = free.first_mut() else { break };
                    let place = window.place.around(k);
                    if placed.iter().any(|other| place.overlaps(other.place)) {
                        break;
                    }
                    window.place = place;
                    count += 1;
                }
                nodes.next();
            }
            // Their solutions, and from them the state.
            let windows = &mut windows[..count];
            let (before, at) = (&*coupled, &*state);
            for_each_with(windows, |window| {
                window.enter(before, problem, at, prediction);
                window.solve(problem, lubricant, step_bound, near);
            });
            for window in windows {
                window.leave(coupled, state, solved);
            }
        }
    }

    /// Finds the nodes that hold most of the residual of isolated regions; none where it is spread widely, which
    /// is left to the linear solve.
    fn find(
        &mut self,
        fluid: &Discretisation,
        active_set: &[NodeState],
        near: NearField,
        previous: Option<&[f64]>,
    ) {
        // Weakly coupled nodes, ordered by their imbalances.
        self.order.clear();
        let mut sum = 0.0;
        let (nx, inner) = (fluid.grid.nx(), inner_rows(&fluid.grid));
        map_lines(&mut self.imbalance, nx, |j, row| {
            if inner.contains(&j) {
                for (i, imbalance) in row.iter_mut().enumerate().take(nx - 1).skip(1) {
                    let k = j * nx + i;
                    let is_weak = is_weakly_coupled(fluid, active_set[k], k, near);
                    *imbalance = if is_weak { fluid.imbalance(k, previous).abs() } else { -1.0 };
                }
            }
        });
        for k in interior(&fluid.grid) {
            if self.imbalance[k] < 0.0 {
                continue;
            }
            sum += self.imbalance[k];
            self.order.push(k as u32);
        }
        // The largest of them, as many as there may be and one more.
        let imbalance = &self.imbalance;
        let by_imbalance = |a: &u32, b: &u32| imbalance[*b as usize].total_cmp(&imbalance[*a as usize]);
        let most = (MOST_REGION_NODES * fluid.grid.len() as f64) as usize + 1;
        if self.order.len() > most {
            self.order.select_nth_unstable_by(most - 1, by_imbalance);
            self.order.truncate(most);
        }
        self.order.sort_unstable_by(by_imbalance);
        // As many of them as hold the wanted share.
        let mut covered = 0.0;
        let holds_most = self.order.iter().take_while(|&&k| {
            let is_more_needed = covered <= REGION_SHARE * sum;
            covered += imbalance[k as usize];
            is_more_needed
        });
        let count = holds_most.count();
        let is_wide = count as f64 > MOST_REGION_NODES * fluid.grid.len() as f64;
        self.order.truncate(if is_wide { 0 } else { count });
    }
}
