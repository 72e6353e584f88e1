//! Nonlinear elimination: from the prediction of a linear step to a state.

use std::mem::take;

use super::isolated_regions::IsolatedRegions;
use super::node::{NodeBalance, NodeParameters, NodePrediction, NodeSolution};
use super::prediction::{PredictedNode, Prediction};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::{FieldLines, for_each_range};
use crate::reynolds::active_set::{Fluid, NodeState};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::flow::Discretisation;
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
    let (limits, lubricant) = (problem.pressure_limit, problem.lubricant);
    let grid = coupled.fluid.grid;
    let (nx, film) = (grid.nx(), &state.film);
    let mut active_set = take(&mut coupled.active_set);
    let fields = (
        FieldLines::new(&mut active_set, nx),
        FieldLines::new(&mut state.pressure, nx),
        FieldLines::new(&mut state.fluid_pressure, nx),
        FieldLines::new(&mut state.plastic_depth, nx),
    );
    let (fluid, balance) = (&coupled.fluid, &coupled.balance);
    for_each_range(
        fields,
        grid.ny(),
        grid.len(),
        |rows, (node_states, pressure, fluid_pressure, plastic_depth)| {
            let first = rows.start * nx;
            for i in 0..node_states.values.len() {
                let k = first + i;
                let (node_state, predicted) = (node_states.values[i], prediction.node(k));
                let limit = limits.map_or(f64::INFINITY, |limit| limit[k]);
                let parameters = NodeParameters { contact_film, limit, own_influence, step_bound };
                // An open node with small changes takes its prediction; the others solve their local equations.
                let solution =
                    parameters.settled(node_state, film[k], balance[k], &predicted).unwrap_or_else(|| {
                        eliminate(
                            parameters,
                            (fluid, lubricant),
                            (k, node_state),
                            (film[k], balance[k]),
                            &predicted,
                        )
                    });
                node_states.values[i] = solution.node_state;
                pressure.values[i] = solution.pressure;
                fluid_pressure.values[i] = solution.fluid_pressure;
                plastic_depth.values[i] = solution.depth;
            }
        },
    );
    coupled.active_set = active_set;
}

/// The solution of the own equations of node `k` in the state `node_state`, with its film and balance at the start of the step.
fn eliminate(
    parameters: NodeParameters,
    (fluid, lubricant): (&Discretisation, Option<&Lubricant>),
    (k, node_state): (usize, NodeState),
    (film, balance): (f64, f64),
    predicted: &PredictedNode,
) -> NodeSolution {
    let PredictedNode { pressure, fluid_pressure, elastic_film, depth, change } = *predicted;
    match lubricant {
        Some(lubricant) if node_state.fluid != Fluid::Boundary => {
            // The outflow that the linear step predicts for the node as a function of its own pressure.
            let own = NodeBalance::new(fluid, lubricant, k);
            let imbalance = if node_state.has_balance() { 0.0 } else { balance + change.balance };
            let share = own.predicted_share(film, [change.fluid_pressure, change.film], imbalance);
            let depth = if node_state.fluid == Fluid::AtLimit { depth } else { 0.0 };
            // Its own pressure, film and place in the active set.
            own.eliminate(parameters, NodePrediction { pressure, fluid_pressure, elastic_film, depth, share })
        }
        _ => parameters.eliminate_dry(node_state.fluid, pressure, elastic_film),
    }
}
