//! Nonlinear elimination of pockets.
//!
//! The films of a pocket hardly follow its own pressures: as little oil as they hold flows through rims of a
//! nanometre, and which of its nodes cavitate is decided among a few of them. Newton steps of the whole, for
//! which each costs convolutions, take many to settle that. It is settled here, between two of them, by
//! Newton's method on small [`Window`]s in which films follow own pressures alone.

use super::Workspace;
use super::settings::PocketSettings;
use super::window::Window;
use crate::grid::Grid;
use crate::reynolds::active_set::{Fluid, Kind, Solid};
use crate::reynolds::flow::{Discretisation, NearField};
use crate::reynolds::problem::{LubricatedContact, interior};
use crate::reynolds::state::ContactState;

/// Pressure flow over entrainment of the own elastic response beyond which pressure flow alone fixes the
/// pressure of a node.
pub(super) const FREE: f64 = 30.0;

/// What a step foresees of all nodes, and the nodes around which windows are laid.
#[derive(Debug)]
pub(super) struct Pockets {
    /// Total pressures that the linear step foresees \[Pa\].
    pub(super) pressure: Vec<f64>,
    imbalance: Vec<f64>,
    /// Nodes of pockets, those with the largest imbalances first.
    order: Vec<u32>,
    settled: Vec<bool>,
    window: Window,
}

impl Pockets {
    pub(super) fn new(grid: Grid, settings: PocketSettings) -> Self {
        let n = grid.len();
        Self {
            pressure: vec![0.0; n],
            imbalance: vec![0.0; n],
            order: Vec::with_capacity(n),
            settled: vec![false; n],
            window: Window::new(&grid, settings.side),
        }
    }

    /// Finds the nodes that hold most of what the pockets lack; none where that is spread widely, which is
    /// the work of linear steps.
    fn find(
        &mut self,
        fluid: &Discretisation,
        kinds: &[Kind],
        near: NearField,
        previous: Option<&[f64]>,
        settings: PocketSettings,
    ) {
        self.order.clear();
        let mut sum = 0.0;
        for k in interior(&fluid.grid) {
            if is_in_pocket(fluid, kinds[k], k, near) {
                self.imbalance[k] = fluid.imbalance(k, previous).abs();
                sum += self.imbalance[k];
                self.order.push(k as u32);
            }
        }
        let imbalance = &self.imbalance;
        self.order.sort_unstable_by(|a, b| imbalance[*b as usize].total_cmp(&imbalance[*a as usize]));
        let mut covered = 0.0;
        let holds_most = self.order.iter().take_while(|&&k| {
            let is_more_needed = covered <= settings.share * sum;
            covered += imbalance[k as usize];
            is_more_needed
        });
        let count = holds_most.count();
        let is_wide = count as f64 > settings.most_nodes * fluid.grid.len() as f64;
        self.order.truncate(if is_wide { 0 } else { count });
    }
}

/// Whether the film of node `k` hardly follows its pressure: cavitated, beside solids that touch, or with a
/// pressure flow that exceeds the entrainment of the own elastic response [`FREE`] times.
pub(super) fn is_in_pocket(fluid: &Discretisation, kind: Kind, k: usize, near: NearField) -> bool {
    match (kind.fluid, kind.solid) {
        (Fluid::Active, Solid::Open) => fluid.flow_ratio(k, near) > FREE,
        (Fluid::Active | Fluid::Cavitated, _) => true,
        _ => false,
    }
}

impl Workspace {
    /// Solves the mass balances of pockets at the films that the linear step foresees.
    pub(super) fn eliminate_pockets(
        &mut self,
        problem: &LubricatedContact<'_>,
        state: &mut ContactState,
        trust: f64,
    ) {
        let settings = self.settings.pockets;
        let Some(lubricant) = problem.lubricant else { return };
        if settings.steps == 0
            || !self.coupled.fluid.conserves_mass()
            || self.coupled.fluid.course().is_some()
        {
            return;
        }
        let near = self.coupled.near;
        let films = self.coupled.elastic_film.iter_mut().zip(&self.foreseen);
        let pressures = state.pressure.iter().zip(&self.pockets.pressure);
        for ((film, foreseen_film), (pressure, foreseen_pressure)) in films.zip(pressures) {
            *film = foreseen_film + near.own * (pressure - foreseen_pressure);
        }
        self.coupled.apply_plastic_depth(problem, state);
        self.close_contact(problem, state);
        let Self { coupled, pockets, foreseen, .. } = self;
        let previous = problem.squeeze.map(|squeeze| squeeze.previous_mass);
        pockets.find(&coupled.fluid, &coupled.kinds, near, previous, settings);
        pockets.settled.fill(false);
        let Pockets { order, settled, window, pressure, .. } = pockets;
        for &k in &*order {
            if settled[k as usize] {
                continue;
            }
            window.enter(k as usize, coupled, problem, state, [foreseen, pressure]);
            let is_better = window.solve(problem, lubricant, settings, trust, near);
            window.leave(is_better, coupled, state, settled);
        }
    }
}
