//! Nonlinear elimination: from the prediction of a linear step to a state.

use super::isolated_regions::IsolatedRegions;
use super::node::{Material, NodeBalance, NodePrediction};
use super::prediction::{PredictedNode, Prediction};
use crate::grid::Grid;
use crate::reynolds::active_set::Fluid;
use crate::reynolds::coupled::Coupled;
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

/// Solves the equations of single nodes, then those of isolated regions, everything around held.
#[derive(Debug)]
pub(super) struct LocalElimination {
    /// `None` where isolated regions are left to the linear solve.
    regions: Option<IsolatedRegions>,
}

impl LocalElimination {
    /// Elimination on `grid`, that of isolated regions only if `eliminates_regions`.
    pub(super) fn new(grid: Grid, eliminates_regions: bool) -> Self {
        Self { regions: eliminates_regions.then(|| IsolatedRegions::new(grid)) }
    }

    /// Overwrites pressures, plastic depths and active set with those of the predicted state: every node solves
    /// its own equations, neighbors and films as predicted, and leaves the predicted pressure by at most
    /// `step_bound` \[Pa\]; then the isolated regions do.
    ///
    /// Needs in `coupled` the flow at the start of the step with films clamped to contact.
    pub(super) fn eliminate(
        &mut self,
        prediction: &Prediction<'_>,
        step_bound: f64,
        coupled: &mut Coupled,
        problem: &LubricatedContact<'_>,
        state: &mut ContactState,
    ) {
        eliminate_nodes(prediction, step_bound, coupled, problem, state);
        if let Some(regions) = &mut self.regions {
            regions.eliminate(prediction, step_bound, coupled, problem, state);
        }
    }
}

/// Every node that has not settled solves its own equations.
fn eliminate_nodes(
    prediction: &Prediction<'_>,
    step_bound: f64,
    coupled: &mut Coupled,
    problem: &LubricatedContact<'_>,
    state: &mut ContactState,
) {
    let (contact_film, own_influence) = (problem.contact_film(), coupled.near.own);
    for k in 0..state.pressure.len() {
        let (side, predicted) = (coupled.active_set[k], prediction.node(k));
        let material = Material { contact_film, limit: problem.limit_at(k), own_influence, step_bound };
        if let Some(node) = material.settled(side, state.film[k], coupled.balance[k], &predicted) {
            node.write(k, coupled, state);
            continue;
        }
        let node = match problem.lubricant {
            Some(lubricant) if side.fluid != Fluid::Boundary => {
                // The outflow that the linear step predicts for the node as a function of its own pressure.
                let balance = NodeBalance::new(&coupled.fluid, lubricant, k);
                let PredictedNode { pressure, fluid_pressure, elastic_film, depth, change } = predicted;
                let imbalance = if side.has_balance() { 0.0 } else { coupled.balance[k] + change.balance };
                let changes = [change.fluid_pressure, change.film];
                let share = balance.predicted_share(state.film[k], changes, imbalance);
                let depth = if side.fluid == Fluid::AtLimit { depth } else { 0.0 };
                let prediction = NodePrediction { pressure, fluid_pressure, elastic_film, depth, share };
                // Its own pressure, film and place in the active set.
                balance.eliminate(material, prediction)
            }
            _ => material.eliminate_dry(side.fluid, predicted.pressure, predicted.elastic_film),
        };
        node.write(k, coupled, state);
    }
}
