//! The coupled state: films, balances and active set of given pressures and approach.
//!
//! An evaluation of pressures `p` and approach `delta` computes, in this order:
//!
//! 1. the elastic film `gap + K p - delta`, by one convolution;
//! 2. plastic depths and the film with them;
//! 3. mobilities, film fractions and the net outflow `F` of every cell;
//! 4. for a state of unknown origin the active set, and 2 and 3 again;
//! 5. the residuals (`residuals`), independent of the active set.
//!
//! [`Changed`] names the first quantity that is out of date; the ones before it are kept. All solvers, and
//! [`Evaluation`](super::Evaluation) for custom ones, measure a state with this module only. `F` is scaled by entrainment
//! speed and cell size to a film thickness.

use super::active_set::{Fluid, NodeState, Sample, Solid};
use super::flow::{Discretisation, NearField};
use super::problem::LubricatedContact;
use super::state::ContactState;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::{FieldLines, for_each_range, map_lines, map_nodes};
use crate::report::Residuals;
use crate::reynolds::inner_nodes::{inner_rows, interior};

/// Cost of a convolution without padding over one on the padded grid, which has four times the points.
pub(super) const UNPADDED: f64 = 0.25;

/// The first quantity of a state that has changed since its last evaluation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Changed {
    /// The state is of unknown origin: its active set is determined too.
    Everything,
    /// Pressures or approach.
    Pressures,
    /// Elastic film, plastic depths or active set.
    ElasticFilm,
    /// The film, or the schemes of the flow.
    Film,
}

/// Elastic film, mass balances and active set of a [`ContactState`].
#[derive(Debug, Clone)]
pub(super) struct Coupled {
    /// Nodes and faces of the fluid.
    pub(super) fluid: Discretisation,
    /// Film without the plastic depth of this solve \[m\].
    pub(super) elastic_film: Vec<f64>,
    /// Mass balance `F` of every interior node: its net outflow \[m\].
    pub(super) balance: Vec<f64>,
    /// State of each node.
    pub(super) active_set: Vec<NodeState>,
    /// Influence coefficients of the node itself and of the next two along x \[m/Pa\].
    pub(super) near: NearField,
    /// Number of convolutions in equivalents of one on the padded grid.
    pub(super) convolutions: f64,
}

impl Coupled {
    /// Buffers for `grid`, with all interior nodes cavitated and open.
    pub(super) fn new(grid: Grid) -> Self {
        let mut active_set = vec![NodeState::BOUNDARY; grid.len()];
        for k in interior(&grid) {
            active_set[k] = NodeState { fluid: Fluid::Cavitated, solid: Solid::Open };
        }
        Self {
            fluid: Discretisation::new(grid),
            elastic_film: vec![0.0; grid.len()],
            balance: vec![0.0; grid.len()],
            active_set,
            near: NearField { own: 1.0, next_x: 0.0, second_x: 0.0 },
            convolutions: 0.0,
        }
    }

    /// Sets schemes and elastic response of `problem`; resets active set and counts.
    pub(super) fn configure(&mut self, problem: &LubricatedContact<'_>) {
        let influence = |di, dj| problem.deformation.influence(di, dj);
        self.near = NearField { own: influence(0, 0), next_x: influence(1, 0), second_x: influence(2, 0) };
        self.fluid.configure(problem);
        self.convolutions = 0.0;
        // No node is in contact before the first evaluation.
        for side in &mut self.active_set {
            let fluid = if side.fluid == Fluid::Boundary { Fluid::Boundary } else { Fluid::Cavitated };
            *side = NodeState { fluid, solid: Solid::Open };
        }
    }

    /// Evaluates `state` from the quantity that has `changed` on, and returns its residuals. One convolution, or none.
    pub(super) fn evaluate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        changed: Changed,
    ) -> Result<Residuals, InputError> {
        if changed == Changed::Everything {
            self.recall_limited(problem, state);
        }
        if matches!(changed, Changed::Everything | Changed::Pressures) {
            self.displace(problem, state)?;
        }
        if changed != Changed::Film {
            self.update_film(problem, state);
        }
        self.update_flow(problem, state);
        if changed == Changed::Everything {
            self.classify(problem, state);
            self.update_film(problem, state);
            self.update_flow(problem, state);
        }
        Ok(self.residuals(problem, state))
    }

    /// Marks the nodes whose fluid is at the limit in `state`: their plastic depths are kept when it is evaluated.
    fn recall_limited(&mut self, problem: &LubricatedContact<'_>, state: &ContactState) {
        if problem.lubricant.is_none() {
            return;
        }
        for k in interior(&self.fluid.grid) {
            if state.plastic_depth[k] > 0.0 && state.fluid_pressure[k] >= problem.limit_at(k) {
                self.active_set[k] = NodeState { fluid: Fluid::AtLimit, solid: Solid::Open };
            }
        }
    }

    /// The elastic film of the pressures: gap plus displacement minus approach; one convolution.
    pub(super) fn displace(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
    ) -> Result<(), InputError> {
        problem.deformation.displacement(&state.pressure, &mut self.elastic_film)?;
        self.convolutions += 1.0;
        map_nodes(&mut self.elastic_film, |k, film| *film += problem.gap[k] - state.approach);
        Ok(())
    }

    /// Keeps yielded contact at the contact film, and the film of each node consistent with its plastic depth.
    pub(super) fn update_film(&self, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        let (contact_film, limits) = (problem.contact_film(), problem.pressure_limit);
        let (pressure, n) = (&state.pressure, self.active_set.len());
        let fields = (FieldLines::new(&mut state.plastic_depth, 1), FieldLines::new(&mut state.film, 1));
        for_each_range(fields, n, n, |nodes, (depths, films)| {
            for (k, (depth, film)) in nodes.zip(depths.values.iter_mut().zip(films.values)) {
                // At the limit the plastic depth of the fluid is an unknown; that of solids closes the gap.
                let limit = limits.map_or(f64::INFINITY, |limit| limit[k]);
                *depth = if self.active_set[k].fluid == Fluid::AtLimit {
                    depth.max(0.0)
                } else if pressure[k] >= limit {
                    (contact_film - self.elastic_film[k]).max(0.0)
                } else {
                    0.0
                };
                *film = self.elastic_film[k] + *depth;
            }
        });
    }

    /// Fluid quantities and balances of the films and pressures of `state`.
    pub(super) fn update_flow(&mut self, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        let Some(lubricant) = problem.lubricant else {
            state.mass.fill(0.0);
            state.theta.fill(1.0);
            return;
        };
        self.flow(problem, lubricant, &state.fluid_pressure, &state.film);
        map_nodes(&mut state.mass, |k, mass| *mass = self.fluid.held_mass(k));
        state.theta.copy_from_slice(self.fluid.film_fractions());
    }

    /// Fluid quantities and balances of a flow through `film`.
    pub(super) fn flow(
        &mut self,
        problem: &LubricatedContact<'_>,
        lubricant: &Lubricant,
        fluid_pressure: &[f64],
        film: &[f64],
    ) {
        let previous = problem.squeeze.map(|s| s.previous_mass);
        self.fluid.update(lubricant, fluid_pressure, film, previous);
        // Net outflow of every cell.
        let (fluid, nx, inner) = (&self.fluid, self.fluid.grid.nx(), inner_rows(&self.fluid.grid));
        map_lines(&mut self.balance, nx, |j, row| {
            if inner.contains(&j) {
                for (i, balance) in row.iter_mut().enumerate().take(nx - 1).skip(1) {
                    *balance = fluid.balance(j * nx + i, previous);
                }
            }
        });
    }

    /// Determines the active set.
    pub(super) fn classify(&mut self, problem: &LubricatedContact<'_>, state: &ContactState) {
        let lubricated = problem.lubricant.is_some();
        for k in 0..self.active_set.len() {
            // Pressure change that would satisfy the mass balance.
            let fluid_push = if lubricated && self.active_set[k].fluid != Fluid::Boundary {
                -self.balance[k] / self.fluid.diagonal(k, self.near)
            } else {
                0.0
            };
            let sample = Sample {
                pressure: state.pressure[k],
                fluid_pressure: state.fluid_pressure[k],
                elastic_film: self.elastic_film[k],
                contact_film: problem.contact_film(),
                limit: problem.limit_at(k),
                fluid_push,
                own_influence: self.near.own,
                lubricated,
            };
            self.active_set[k] = sample.classify(self.active_set[k]);
        }
    }

    /// Sets the contact flags of the state.
    pub(super) fn mark_contact(&self, state: &mut ContactState) {
        for (k, flag) in state.in_contact.iter_mut().enumerate() {
            *flag = state.pressure[k] > state.fluid_pressure[k] && self.active_set[k].is_contact();
        }
    }
}
