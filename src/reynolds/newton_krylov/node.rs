//! The equations of one node with its neighbors held.

use super::prediction::PredictedNode;
use super::settings::SETTLED_CHANGE;
use crate::lubricant::Lubricant;
use crate::reynolds::active_set::{Fluid, NodeState, Solid};
use crate::reynolds::coupled::Coupled;
use crate::reynolds::flow::{Discretisation, HeldNeighbour};
use crate::reynolds::state::ContactState;

/// Bisections and Newton steps of a local solve.
const MAX_STEPS: u32 = 60;
/// Relative change of the pressure with which the last step of a local solve ends: the error is about its
/// square.
const LAST_CHANGE: f64 = 1e-6;
/// Lowest pressure from which a search starts \[Pa\].
const FIRST_PRESSURE: f64 = 1.0;
/// Relative distance from the predicted pressure within which a root is the predicted one; the residual of linear
/// systems moves it by less.
const PREDICTED: f64 = 0.01;

/// The prediction of the linear step for one node.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodePrediction {
    /// Total pressure \[Pa\].
    pub(super) pressure: f64,
    /// Fluid pressure \[Pa\].
    pub(super) fluid_pressure: f64,
    /// Film at the total pressure without plastic depth \[m\].
    pub(super) elastic_film: f64,
    /// Plastic depth of a node whose fluid is at the limit \[m\].
    pub(super) depth: f64,
    /// Own share of the mass balance (see [`NodeBalance::predicted_share`]) \[m\].
    pub(super) share: f64,
}

/// The solution of the own equations of a node.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeSolution {
    /// Its state in the active set.
    pub(super) node_state: NodeState,
    pub(super) pressure: f64,
    pub(super) fluid_pressure: f64,
    /// Plastic depth of a node whose fluid is at the limit, zero otherwise \[m\].
    pub(super) depth: f64,
}

impl NodeSolution {
    /// Overwrites node `k`.
    pub(super) fn write(self, k: usize, coupled: &mut Coupled, state: &mut ContactState) {
        coupled.active_set[k] = self.node_state;
        state.pressure[k] = self.pressure;
        state.fluid_pressure[k] = self.fluid_pressure;
        state.plastic_depth[k] = self.depth;
    }
}

/// Film, limit, compliance and step bound in a node's own equations.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeParameters {
    pub(super) contact_film: f64,
    pub(super) limit: f64,
    /// Film per own pressure \[m/Pa\].
    pub(super) own_influence: f64,
    /// Bound of the distance between pressure and prediction \[Pa\].
    pub(super) step_bound: f64,
}

impl NodeParameters {
    /// The predicted state of an open node whose changes over the step are small ([`SETTLED_CHANGE`]); `None` for a
    /// node that has to solve its own equations. `film` and `balance` are those at the start of the step.
    pub(super) fn settled(
        &self,
        node_state: NodeState,
        film: f64,
        balance: f64,
        predicted: &PredictedNode,
    ) -> Option<NodeSolution> {
        let PredictedNode { pressure, elastic_film, change, .. } = *predicted;
        let is_open =
            node_state.solid == Solid::Open && elastic_film > (1.0 + SETTLED_CHANGE) * self.contact_film;
        if !is_open || change.film.abs() > SETTLED_CHANGE * film {
            return None;
        }
        let is_settled = match node_state.fluid {
            Fluid::Active => {
                let is_fluid = pressure > 0.0 && pressure < self.limit;
                is_fluid && change.fluid_pressure.abs() <= SETTLED_CHANGE * pressure
            }
            // The cell stays far from filled.
            Fluid::Cavitated => pressure <= 0.0 && balance + change.balance > SETTLED_CHANGE * film,
            Fluid::Boundary | Fluid::AtLimit => false,
        };
        let pressure = pressure.max(0.0);
        is_settled.then_some(NodeSolution { node_state, pressure, fluid_pressure: pressure, depth: 0.0 })
    }

    /// The solution without fluid pressure, the state of the fluid being given: open, or contact below or at the limit.
    pub(super) fn eliminate_dry(&self, fluid: Fluid, pressure: f64, elastic_film: f64) -> NodeSolution {
        let touch = pressure + (self.contact_film - elastic_film) / self.own_influence;
        let (solid, pressure) = if touch <= 0.0 {
            (Solid::Open, 0.0)
        } else if touch >= self.limit {
            (Solid::Yielded, self.limit)
        } else {
            (Solid::Contact, pressure.clamp(0.0, self.limit))
        };
        NodeSolution { node_state: NodeState { fluid, solid }, pressure, fluid_pressure: 0.0, depth: 0.0 }
    }
}

/// The own share of a mass balance as a function of own pressure and film, with the neighbors and the corrections of
/// face films held: `M rho(p) h + sum over faces of c a(p, h) (phi(p) - phi_o)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeBalance<'a> {
    lubricant: &'a Lubricant,
    fluid: &'a Discretisation,
    node: usize,
    mass: f64,
    neighbours: [HeldNeighbour; 4],
}

impl<'a> NodeBalance<'a> {
    pub(super) fn new(fluid: &'a Discretisation, lubricant: &'a Lubricant, node: usize) -> Self {
        let neighbours = fluid.held_neighbours(node);
        Self { lubricant, fluid, node, mass: fluid.own_mass(node), neighbours }
    }

    /// Own share at fluid pressure `p` and film `h`, and its derivatives by both.
    fn share(&self, p: f64, h: f64) -> (f64, f64, f64) {
        let (density, flow) = self.fluid.outflow(self.lubricant, self.node, &self.neighbours, (p, h));
        self.with_mass(density, flow, h)
    }

    /// The own share at the end of the linear step: the present film is `film`, own pressure and film change by
    /// `changes`, and the whole balance becomes `imbalance`.
    pub(super) fn predicted_share(&self, film: f64, changes: [f64; 2], imbalance: f64) -> f64 {
        let (density, flow) = self.fluid.present_outflow(self.node, &self.neighbours);
        let (share, by_pressure, by_film) = self.with_mass(density, flow, film);
        share + (by_pressure * changes[0] + by_film * changes[1]) - imbalance
    }

    #[inline]
    fn with_mass(&self, density: [f64; 2], flow: [f64; 3], h: f64) -> (f64, f64, f64) {
        let ([density, density_p], [flow, by_pressure, by_film]) = (density, flow);
        (
            self.mass * density * h + flow,
            self.mass * density_p * h + by_pressure,
            self.mass * density + by_film,
        )
    }

    /// The solution in which the own share is the predicted one, the film following the own pressure alone.
    ///
    /// One scalar `v` parametrizes all states of a node: cavitated (`v <= 0`), contact with fluid pressure `v`,
    /// open with pressure `v` once that exceeds the pressure `touch` at which the film is the contact film, and
    /// fluid at the limit with plastic depth `(v - limit)` times the self-influence. The share increases with
    /// `v`, except where a node that opens admits more fluid than leaves it.
    pub(super) fn eliminate(&self, parameters: NodeParameters, prediction: NodePrediction) -> NodeSolution {
        let NodeParameters { contact_film, limit, own_influence, step_bound } = parameters;
        let touch = prediction.pressure + (contact_film - prediction.elastic_film) / own_influence;
        let opening = touch.min(limit);
        if self.admits_fluid(parameters, prediction, opening) {
            // A streak of such nodes opens together: each keeps the predicted pressure, and the next linear
            // step, which couples them, lifts them.
            let (pressure, node_state) =
                (prediction.pressure, NodeState { fluid: Fluid::Active, solid: Solid::Open });
            return NodeSolution { node_state, pressure, fluid_pressure: pressure, depth: 0.0 };
        }
        let film = |v: f64| contact_film + own_influence * (v - opening).max(0.0);
        let value = |v: f64| {
            let (share, by_pressure, by_film) = self.share(v.min(limit), film(v));
            let slope = if v < limit { by_pressure } else { 0.0 }
                + if v > opening { by_film * own_influence } else { 0.0 };
            (share - prediction.share, slope)
        };
        // Solve for v.
        let mut v = root(value, prediction.fluid_pressure);
        // Keep it near the prediction, as pressures move films far away; except where the share falls at the
        // bound, as the next linear step would reverse the change there.
        let most = prediction.pressure.max(0.0) + prediction.depth / own_influence + step_bound;
        if v > most && value(most).1 >= 0.0 {
            v = most;
        }
        if v > opening {
            v = v.max(prediction.pressure.min(limit) - step_bound).max(opening);
        }
        // Read the state off v.
        let fluid = if v <= 0.0 { Fluid::Cavitated } else { Fluid::Active };
        if v > limit {
            let depth =
                (film(v) - prediction.elastic_film - own_influence * (limit - prediction.pressure)).max(0.0);
            let node_state = NodeState { fluid: Fluid::AtLimit, solid: Solid::Open };
            NodeSolution { node_state, pressure: limit, fluid_pressure: limit, depth }
        } else if v < opening {
            let solid = if touch >= limit { Solid::Yielded } else { Solid::Contact };
            let pressure = if solid == Solid::Yielded { limit } else { prediction.pressure.clamp(v, limit) };
            NodeSolution { node_state: NodeState { fluid, solid }, pressure, fluid_pressure: v, depth: 0.0 }
        } else {
            let node_state = NodeState { fluid, solid: Solid::Open };
            NodeSolution { node_state, pressure: v, fluid_pressure: v, depth: 0.0 }
        }
    }

    /// Whether more fluid enters the node at the contact film than leaves it, and more leaves as it opens.
    fn admits_fluid(&self, parameters: NodeParameters, prediction: NodePrediction, opening: f64) -> bool {
        let NodeParameters { contact_film, limit, .. } = parameters;
        let inside = 0.0..limit;
        if !inside.contains(&opening) || !inside.contains(&prediction.pressure) || prediction.depth > 0.0 {
            return false;
        }
        let (share, _, by_film) = self.share(opening, contact_film);
        share < prediction.share && by_film > 0.0
    }
}

/// Root of a function that increases nearly everywhere, or zero where the function is not negative at zero; by
/// Newton steps from `start` inside a bracket. Where it falls at `start`, a root within [`PREDICTED`] of that is
/// taken: the nodes around keep it in place.
fn root(value: impl Fn(f64) -> (f64, f64), start: f64) -> f64 {
    // Most starts are close to the root: zero is evaluated only where steps lead there.
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut v = start;
    if start <= FIRST_PRESSURE {
        if value(0.0).0 >= 0.0 {
            return 0.0;
        }
        (low, v) = (0.0, FIRST_PRESSURE);
    }
    for step in 0..MAX_STEPS {
        let (f, slope) = value(v);
        if step == 0 && slope <= 0.0 && (f / slope).abs() < PREDICTED * v {
            return v - f / slope;
        }
        // Narrow the bracket.
        if f < 0.0 {
            low = v;
        } else {
            high = v;
        }
        let newton = v - f / slope;
        if (newton - v).abs() <= LAST_CHANGE * v {
            return newton;
        }
        if low < 0.0 && newton <= 0.0 {
            if value(0.0).0 >= 0.0 {
                return 0.0;
            }
            low = 0.0;
        }
        // The Newton step where it stays in the bracket, else bisection, or doubling without an upper end.
        let next = if newton > low && newton < high {
            newton
        } else if high.is_finite() {
            0.5 * (low.max(0.0) + high)
        } else {
            2.0 * low.max(0.0) + FIRST_PRESSURE
        };
        if (next - v).abs() <= LAST_CHANGE * v || !next.is_finite() {
            return v;
        }
        v = next;
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;

    const PARAMETERS: NodeParameters =
        NodeParameters { contact_film: 1e-9, limit: 2e9, own_influence: 2e-17, step_bound: 1e8 };

    #[test]
    fn dry_node_is_open_in_contact_or_yielded() {
        // The film is the contact film at 500 MPa, never, and beyond the limit.
        for (film, solid, pressure) in [
            (1e-9, Solid::Contact, 5e8),
            (1e-9 + 2e-17 * 6e8, Solid::Open, 0.0),
            (1e-9 - 2e-17 * 2e9, Solid::Yielded, 2e9),
        ] {
            let node = PARAMETERS.eliminate_dry(Fluid::Cavitated, 5e8, film);
            assert_eq!((node.node_state.solid, node.pressure), (solid, pressure));
            assert!(node.fluid_pressure.abs() < f64::MIN_POSITIVE);
        }
    }

    #[test]
    fn root_is_found_where_the_slope_spans_orders_of_magnitude() {
        for exact in [1.0_f64, 1e4, 1e8, 1e9] {
            let value =
                |v: f64| ((-2e-8_f64 * exact).exp() - (-2e-8_f64 * v).exp(), 2e-8 * (-2e-8_f64 * v).exp());
            for start in [1.0, 1e7, 3e9] {
                let found = root(value, start);
                assert!((found / exact - 1.0).abs() < 1e-6, "{found} for {exact} from {start}");
            }
        }
    }
}
