//! The coupled state: films, balances and active set of given pressures and approach, and their residuals.
//!
//! Evaluation of pressures `p` and approach `delta`, in this order:
//!
//! 1. the elastic film `gap + K p - delta`, by one convolution (`evaluate`);
//! 2. plastic depths and the film with them (`apply_plastic_depth`);
//! 3. mobilities, film fractions and the net outflow `F` of every cell (`refresh`);
//! 4. the active set (`classify`), after which 2 and 3 may be repeated (`update`);
//! 5. mass, load and complementarity residuals (`residuals`), independent of 4.
//!
//! All solvers, and [`Evaluation`](super::Evaluation) for custom ones, measure a state with this module only. `F`
//! is scaled by entrainment speed and cell size to a film thickness.
//!
//! The flow and its balances are in `flow`, node states in `active_set`, the unknowns of a solve in `state`.
//! Residuals are defined here only (`residuals`).

use super::active_set::{Fluid, NodeState, Sample, Solid};
use super::flow::{Discretisation, NearField};
use super::problem::LubricatedContact;
use super::state::ContactState;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::report::Residuals;
use crate::reynolds::inner_nodes::interior;

/// Relative distance below which a pressure counts as at the limit in the paper's contact. Steps relaxed by `w`
/// stop short of the limit by `2^-53 / w`, where further ones are lost to rounding; this tolerance holds for `w`
/// down to 1.1e-4.
const LIMIT_ROUNDING: f64 = 1e-12;

/// Cost of a convolution without padding over one on the padded grid, which has four times the points.
pub(super) const UNPADDED: f64 = 0.25;

/// Elastic film, mass balances and active set of a [`ContactState`].
#[derive(Debug, Clone)]
pub(super) struct Coupled {
    /// Nodes and faces of the fluid.
    pub(super) fluid: Discretisation,
    /// Film without the plastic depth of this solve \[m\].
    pub(super) elastic_film: Vec<f64>,
    /// `F` of every interior node \[m\].
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
        for side in &mut self.active_set {
            let fluid = if side.fluid == Fluid::Boundary { Fluid::Boundary } else { Fluid::Cavitated };
            *side = NodeState { fluid, solid: Solid::Open };
        }
    }

    /// Evaluates a state of unknown origin: films, active set and balances; one convolution.
    pub(super) fn begin(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<(), InputError> {
        self.recall_limited(problem, state);
        self.evaluate(problem, state)?;
        self.classify(problem, state);
        self.update(problem, state);
        Ok(())
    }

    /// Marks the nodes whose fluid is at the limit in `state`: their plastic depths are kept when it is evaluated.
    fn recall_limited(&mut self, problem: &LubricatedContact<'_>, state: &ContactState) {
        if problem.lubricant.is_none() || problem.is_paper() {
            return;
        }
        for k in interior(&self.fluid.grid) {
            if state.plastic_depth[k] > 0.0 && state.fluid_pressure[k] >= problem.limit_at(k) {
                self.active_set[k] = NodeState { fluid: Fluid::AtLimit, solid: Solid::Open };
            }
        }
    }

    /// Films, fluid quantities and balances of `state`; one convolution.
    pub(super) fn evaluate(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<(), InputError> {
        self.deform(problem, state)?;
        self.update(problem, state);
        Ok(())
    }

    /// Films without plastic depth of `state`; one convolution.
    pub(super) fn deform(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
    ) -> Result<(), InputError> {
        if problem.is_paper() {
            state.fluid_pressure.copy_from_slice(&state.pressure);
        }
        problem.deformation.displacement(&state.pressure, &mut self.elastic_film)?;
        self.convolutions += 1.0;
        // Elastic film: gap plus displacement minus approach.
        for (h, gap) in self.elastic_film.iter_mut().zip(problem.gap) {
            *h += gap - state.approach;
        }
        Ok(())
    }

    /// Plastic depths, fluid quantities and balances from the active set; no convolution.
    pub(super) fn update(&mut self, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        self.apply_plastic_depth(problem, state);
        self.refresh(problem, state);
    }

    /// Keeps yielded contact at the contact film, and the film of each node consistent with its plastic depth.
    pub(super) fn apply_plastic_depth(&self, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        let contact_film = problem.contact_film();
        if problem.is_paper() {
            // The overlap of nodes at the limit is flattened after the solve and not part of it.
            for (k, &film) in self.elastic_film.iter().enumerate() {
                let at_limit = is_at_limit(problem, k, state.pressure[k]);
                state.plastic_depth[k] = if at_limit { (-film).max(0.0) } else { 0.0 };
                state.film[k] = film;
            }
            return;
        }
        for (k, side) in self.active_set.iter().enumerate() {
            // At the limit the plastic depth of the fluid is an unknown; that of solids closes the gap.
            state.plastic_depth[k] = if side.fluid == Fluid::AtLimit {
                state.plastic_depth[k].max(0.0)
            } else if state.pressure[k] >= problem.limit_at(k) {
                (contact_film - self.elastic_film[k]).max(0.0)
            } else {
                0.0
            };
            state.film[k] = self.elastic_film[k] + state.plastic_depth[k];
        }
    }

    /// Fluid quantities and balances from the present films and pressures.
    pub(super) fn refresh(&mut self, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        let Some(lubricant) = problem.lubricant else {
            state.mass.fill(0.0);
            state.theta.fill(1.0);
            return;
        };
        self.flow(problem, lubricant, &state.fluid_pressure, &state.film);
        for (k, mass) in state.mass.iter_mut().enumerate() {
            *mass = self.fluid.held_mass(k);
        }
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
        for k in interior(&self.fluid.grid) {
            self.balance[k] = self.fluid.balance(k, previous);
        }
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
            if problem.is_paper() {
                self.active_set[k].solid = Solid::Open;
            }
        }
    }

    /// Residuals of the evaluated state from pressures and films only, independent of the active set.
    pub(super) fn residuals(&self, problem: &LubricatedContact<'_>, state: &ContactState) -> Residuals {
        let grid = self.fluid.grid;
        let (half_x, half_y) = problem.reference_half_widths;
        let contact_film = problem.contact_film();
        let load: f64 = state.pressure.iter().sum::<f64>() * grid.cell_area();
        let film_scale = self.film_scale(problem, state);
        let previous = problem.squeeze.map(|s| s.previous_mass);
        let (mut mass, mut build_up, mut gap_error) = (0.0, 0.0, 0.0);
        for (k, side) in self.active_set.iter().enumerate() {
            // Mass: imbalance of the cell, or accumulation in a cavitated cell.
            let (p, fluid_p, film) = (state.pressure[k], state.fluid_pressure[k], state.film[k]);
            if problem.lubricant.is_some() && side.fluid != Fluid::Boundary {
                if problem.is_paper() && is_at_limit(problem, k, p) {
                    // Clipped at the limit: the fluid pressure would be higher.
                    mass += self.balance[k].max(0.0);
                } else if self.fluid.conserves_mass() {
                    mass += self.fluid.imbalance(k, previous).abs();
                } else if fluid_p > 0.0 {
                    mass += self.balance[k].abs();
                } else {
                    build_up += (-self.balance[k]).max(0.0);
                }
            }
            if problem.is_paper() {
                continue;
            }
            // Complementarity: gap error in solid contact, penetration elsewhere.
            let touches = p > fluid_p;
            gap_error += if touches { (film - contact_film).abs() } else { (contact_film - film).max(0.0) };
        }
        // Scale by the flux of the mean film and by its volume in the contact.
        let per_flux = grid.dy() / self.flux_scale(problem, film_scale * 2.0 * half_y);
        let per_area = grid.cell_area() / (film_scale * std::f64::consts::PI * half_x * half_y);
        Residuals {
            mass: mass * per_flux,
            load: problem.box_load().map_or(0.0, |wanted| (load - wanted).abs() / wanted),
            complementarity: (build_up * per_flux).max(gap_error * per_area),
        }
    }

    /// Flux over speed \[m^2\] that scales mass residuals: that of the mean film through the contact width,
    /// `through_contact`, or the inflow of the box if that is smaller and there is no squeeze.
    fn flux_scale(&self, problem: &LubricatedContact<'_>, through_contact: f64) -> f64 {
        if problem.lubricant.is_none() || problem.squeeze.is_some() {
            return through_contact;
        }
        let inflow = self.fluid.edge_flow().0 / (self.fluid.rate() * self.fluid.grid.dx());
        if inflow > 0.0 { through_contact.min(inflow) } else { through_contact }
    }

    /// Pressure-weighted mean film, or mean elastic displacement without lubricant.
    fn film_scale(&self, problem: &LubricatedContact<'_>, state: &ContactState) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        for (k, &p) in state.pressure.iter().enumerate() {
            let length = if problem.lubricant.is_some() {
                state.mass[k].max(problem.contact_film())
            } else {
                self.elastic_film[k] - problem.gap[k] + state.approach
            };
            sum += p * length;
            weight += p;
        }
        if weight > 0.0 && sum > 0.0 { sum / weight } else { f64::MIN_POSITIVE }
    }

    /// Sets the contact flags of the state; in the paper's contact also the division into fluid and solid pressure.
    pub(super) fn mark_contact(&self, problem: &LubricatedContact<'_>, state: &mut ContactState) {
        if problem.is_paper() {
            for (k, flag) in state.in_contact.iter_mut().enumerate() {
                *flag = state.pressure[k] > 0.0 && state.film[k] < problem.contact_film();
                state.fluid_pressure[k] = if *flag { 0.0 } else { state.pressure[k] };
            }
            return;
        }
        for (k, flag) in state.in_contact.iter_mut().enumerate() {
            *flag = state.pressure[k] > state.fluid_pressure[k] && self.active_set[k].is_contact();
        }
    }
}

/// Whether pressure `p` is at the limit of node `k` within [`LIMIT_ROUNDING`].
fn is_at_limit(problem: &LubricatedContact<'_>, k: usize, p: f64) -> bool {
    problem.pressure_limit.is_some_and(|limit| reaches_limit(p, limit[k]))
}

/// Whether pressure `p` is at `limit` within rounding.
pub(crate) fn reaches_limit(p: f64, limit: f64) -> bool {
    p >= limit * (1.0 - LIMIT_ROUNDING)
}
