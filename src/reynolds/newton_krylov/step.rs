//! One Newton step: the linear equations, and what the nodes make of their solution.

use super::Workspace;
use super::local::{Forecast, Local, Material};
use super::preconditioner::BlockPreconditioner;
use super::unknowns::{Linearised, Response, Unknowns};
use crate::error::InputError;
use crate::numerics::PreconditionedOperator;
use crate::report::Residuals;
use crate::reynolds::ReynoldsError;
use crate::reynolds::active_set::{Fluid, Solid};
use crate::reynolds::problem::LubricatedContact;
use crate::reynolds::state::ContactState;

impl Workspace {
    /// Has the fluid flow through the contact film wherever nodes are to touch, which is the film that they
    /// have at a solution.
    ///
    /// What the last step did not foresee takes them some nanometres off it. The gap rows mend that; but
    /// mobilities go with the cube of the film, and flows through those films would drain the pockets whose
    /// rims they are.
    pub(super) fn close_contact(&mut self, problem: &LubricatedContact<'_>, state: &ContactState) {
        let Some(lubricant) = problem.lubricant else { return };
        let contact_film = problem.contact_film();
        for ((flow_film, film), kind) in self.flow_film.iter_mut().zip(&state.film).zip(&self.coupled.kinds) {
            *flow_film = if kind.solid == Solid::Contact { contact_film } else { *film };
        }
        self.coupled.flow(problem, lubricant, &state.fluid_pressure, &self.flow_film);
    }

    /// Takes the step, or half of it, again and again, if the residual `before` grows under it by more than
    /// the factor `growth`; returns the residuals that it leaves.
    pub(super) fn advance_carefully(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        trust: f64,
        before: f64,
        growth: f64,
    ) -> Result<Residuals, ReynoldsError> {
        self.before.keep(&self.coupled, state);
        let mut length = 1.0;
        self.advance(problem, state, trust, length)?;
        let mut residuals = self.coupled.residuals(problem, state);
        for _ in 0..self.settings.halvings {
            if residuals.max() <= growth * before {
                break;
            }
            length *= 0.5;
            self.before.restore(&mut self.coupled, problem, state);
            self.close_contact(problem, state);
            self.advance(problem, state, length * trust, length)?;
            residuals = self.coupled.residuals(problem, state);
        }
        Ok(residuals)
    }

    /// Solves the linearised equations into `self.step`, their residual to `tolerance` of itself; returns the
    /// Krylov steps, or none where the fluid equations of this state have no finite factors.
    ///
    /// What the equations lack is told by the whole elastic response, changes of films by its periodic
    /// approximation: what that leaves is for the next step.
    pub(super) fn linear_step(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &ContactState,
        tolerance: f64,
    ) -> Result<Option<u64>, ReynoldsError> {
        let Self { coupled, unknowns, linearisation, preconditioner, gmres, films, .. } = self;
        unknowns.sort(coupled, problem, state);
        if problem.lubricant.is_some() {
            linearisation.update(&coupled.fluid, coupled.near.own);
        }
        if !preconditioner.prepare(coupled, linearisation, unknowns, problem) {
            return Ok(None);
        }
        let response = if coupled.fluid.grid.ny() > 1 { Response::Periodic } else { Response::Whole };
        let mut at = Linearised { coupled, problem, linearisation };
        preconditioner.border(unknowns, &mut at)?;
        let n = unknowns.len();
        let (residual, step) = (&mut self.residual[..n], &mut self.step[..n]);
        step.fill(0.0);
        unknowns.residual(&mut at, state, residual)?;
        // On a row the solution is to be known to the rounding of its own numbers.
        let films = if response == Response::Periodic { &mut films[..] } else { &mut [] };
        let mut system =
            System { unknowns, at: &mut at, preconditioner, response, films: &mut *films, products: 0 };
        let outcome = gmres.solve(&mut system, residual, tolerance, step)?;
        if unknowns.are_pinned() || outcome.steps as usize > films.len() {
            unknowns.change(&mut at, step, response)?;
        } else {
            let shares = gmres.coefficients(outcome).iter().copied();
            unknowns.change_by(at.linearisation, step, shares.zip(films.iter().map(Vec::as_slice)));
        }
        Ok(Some(outcome.steps))
    }

    /// Share of the step under which no pressure changes by more than it may.
    fn allowed_share(&self, problem: &LubricatedContact<'_>) -> f64 {
        let largest = self.unknowns.largest_pressure(&self.step[..self.unknowns.len()]);
        let allowed = self.settings.largest_change(problem) * problem.reference_pressure;
        (allowed / largest).min(1.0)
    }

    /// Takes at most the share `most` of the step; every node's own equations are then eliminated.
    fn advance(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        trust: f64,
        most: f64,
    ) -> Result<(), ReynoldsError> {
        let length = most * self.allowed_share(problem);
        let Self { coupled, unknowns, .. } = self;
        let step = &self.step[..unknowns.len()];
        let (contact_film, own_influence) = (problem.contact_film(), coupled.near.own);
        for k in 0..state.pressure.len() {
            let kind = coupled.kinds[k];
            let change = unknowns.node(k);
            let material = Material { contact_film, limit: problem.limit_at(k), own_influence, trust };
            let pressure = state.pressure[k] + length * change.pressure;
            let fluid_pressure = state.fluid_pressure[k] + length * change.fluid_pressure;
            let elastic_film = coupled.elastic_film[k] + length * change.elastic_film;
            let depth = match kind.fluid {
                Fluid::AtLimit => {
                    (state.plastic_depth[k] + length * (change.film - change.elastic_film)).max(0.0)
                }
                _ => 0.0,
            };
            let node = match problem.lubricant {
                Some(lubricant) if kind.fluid != Fluid::Boundary => {
                    let local = Local::new(&coupled.fluid, lubricant, k);
                    let imbalance =
                        if kind.has_balance() { 0.0 } else { coupled.balance[k] + length * change.balance };
                    let changes = [length * change.fluid_pressure, length * change.film];
                    let share = local.foreseen_share(self.flow_film[k], changes, imbalance);
                    let forecast = Forecast { pressure, fluid_pressure, elastic_film, depth, share };
                    local.eliminate(material, forecast)
                }
                _ => material.eliminate_dry(kind.fluid, pressure, elastic_film),
            };
            self.foreseen[k] = elastic_film;
            self.pockets.pressure[k] = pressure;
            node.put(k, coupled, state);
        }
        state.approach += length * unknowns.approach(step);
        self.eliminate_pockets(problem, state, trust);
        self.coupled.deform(problem, state)?;
        if self.coupled.fluid.grid.ny() == 1 {
            self.keep_level(state);
        }
        self.coupled.update(problem, state);
        Ok(())
    }

    /// Takes back by the approach what the films, weighted by pressure, moved beyond the prediction in the
    /// mean. The pressures of a line move all films alike, by far more than each its own; the load balance
    /// of the next linear step knows what that leaves of the load.
    fn keep_level(&mut self, state: &mut ContactState) {
        let films = self.coupled.elastic_film.iter().zip(&self.foreseen);
        let (mut sum, mut weight) = (0.0, 0.0);
        for ((film, foreseen), pressure) in films.zip(&state.pressure) {
            sum += pressure * (film - foreseen);
            weight += pressure;
        }
        if weight > 0.0 {
            let rise = sum / weight;
            state.approach += rise;
            self.coupled.elastic_film.iter_mut().for_each(|film| *film -= rise);
        }
    }

    /// Pressure-weighted root mean square of what the last step did not foresee of the films without plastic
    /// depth, over the films or the contact film.
    pub(super) fn unforeseen_share(&self, state: &ContactState, contact_film: f64) -> f64 {
        let (mut sum, mut weight) = (0.0, 0.0);
        let films = self.coupled.elastic_film.iter().zip(&self.foreseen).zip(&state.film);
        for (((elastic, foreseen), film), p) in films.zip(&state.pressure) {
            sum += p * ((elastic - foreseen) / film.max(contact_film)).powi(2);
            weight += p;
        }
        (sum / weight).sqrt()
    }
}

/// The linearised equations as GMRES sees them.
struct System<'a, 'b, 'c> {
    unknowns: &'a mut Unknowns,
    at: &'a mut Linearised<'b, 'c>,
    preconditioner: &'a mut BlockPreconditioner,
    response: Response,
    /// Film changes under the first products.
    films: &'a mut [Vec<f32>],
    products: usize,
}

impl PreconditionedOperator for System<'_, '_, '_> {
    type Error = InputError;

    fn apply(&mut self, x: &[f32], out: &mut [f32]) -> Result<(), InputError> {
        self.unknowns.product(self.at, x, self.response, out)?;
        if let Some(films) = self.films.get_mut(self.products) {
            self.unknowns.copy_films(films);
        }
        self.products += 1;
        Ok(())
    }

    fn precondition(&mut self, r: &[f32], out: &mut [f32]) -> Result<(), InputError> {
        self.preconditioner.apply(self.unknowns, self.at, r, out)
    }
}
