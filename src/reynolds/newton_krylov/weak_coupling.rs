//! Nodes whose films hardly respond to their pressures.

use crate::reynolds::active_set::{Fluid, NodeState, Solid};
use crate::reynolds::flow::{Discretisation, NearField};

/// Pressure flow over entrainment of the own elastic response beyond which pressure flow alone determines the
/// pressure of a node.
pub(super) const FREE: f64 = 30.0;

/// Whether the film of node `k` is weakly coupled to its pressure: cavitated, beside solids that touch, or with a
/// pressure flow that exceeds the entrainment of the own elastic response [`FREE`] times.
pub(super) fn is_weakly_coupled(
    fluid: &Discretisation,
    node_state: NodeState,
    k: usize,
    near: NearField,
) -> bool {
    match (node_state.fluid, node_state.solid) {
        (Fluid::Active, Solid::Open) => fluid.flow_ratio(k, near) > FREE,
        (Fluid::Active | Fluid::Cavitated, _) => true,
        _ => false,
    }
}
