//! The pressure limit of a contact and the depth that yielding leaves on each body.
//!
//! A node of the contact carries at most the smaller of the limits of both bodies there, which depend on
//! their tribofilms and on how far they were flattened. Where the limit grows with the depth that this
//! contact adds, limit and depth are found by turns.
//!
//! Both bodies meet at one pressure: the softer one gives way, and where both have one limit they share the
//! depth.

use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::plastic::{PlasticityModel, split_depth, split_depth_into};
use crate::report::{SolveReport, Status};
use crate::reynolds::{ContactState, Squeeze};
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::per_body::PerBody;
use crate::sim::error::SimError;
use crate::sim::history::placement::Placement;

/// Solves in which limit and depth of a hardening contact must have met.
const MAX_HARDENING: usize = 40;
/// Accepted distance between both, relative to the limit.
const HARDENING_TOLERANCE: f64 = 1e-3;
/// A patch of nodes that yield together gives way more than a single one, by about this factor.
const PATCH_COMPLIANCE: f64 = 4.0;

/// Limits and depths of the contact in progress, in its frame.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Yielding {
    /// Pressure limit of the pair \[Pa\].
    pub(in crate::sim) limit: Vec<f64>,
    /// Limits of ball and disc at the start \[Pa\].
    body_limits: [Vec<f64>; 2],
    /// Plastic depths of the bodies once they have given way \[m\].
    hardened_depths: [Vec<f64>; 2],
    /// Their limits then \[Pa\].
    hardened: [Vec<f64>; 2],
    /// What each body gives way \[m\].
    pub(in crate::sim) split: [Vec<f64>; 2],
}

impl Yielding {
    /// Fields of zeros for `n` nodes.
    pub(in crate::sim) fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        let pair = || [zeros(), zeros()];
        Self { limit: zeros(), body_limits: pair(), hardened_depths: pair(), hardened: pair(), split: pair() }
    }

    /// Solves the contact of the bodies as they are placed under the pressure limit of their `models`. Limits
    /// that rise with the depth are moved and the contact is solved again until both belong together; where
    /// they do not, the status is that of too many iterations. The limit is then the one of the last solve.
    pub(in crate::sim) fn solve(
        &mut self,
        models: &PerBody<dyn PlasticityModel>,
        placement: &Placement,
        contact: &mut ContactModel,
        squeeze: Option<Squeeze<'_>>,
        state: &mut ContactState,
    ) -> Result<SolveReport, SimError> {
        let Placement { gap, films, depths, .. } = placement;
        self.start(models, films, depths)?;
        let mut report = contact.solve(gap, Some(&self.limit), squeeze, state)?;
        if !models.each().iter().any(|model| model.hardens()) {
            return Ok(report);
        }
        let compliance = PATCH_COMPLIANCE * contact.deformation.influence(0, 0);
        for _ in 0..MAX_HARDENING {
            let distance = self.harden(models, films, depths, &state.plastic_depth);
            if report.status != Status::Converged || distance <= HARDENING_TOLERANCE {
                return Ok(report);
            }
            self.move_limit(&state.plastic_depth, compliance);
            let before = report;
            report = contact.solve(gap, Some(&self.limit), squeeze, state)?.preceded_by(before);
        }
        report.status = Status::MaxIterations;
        Ok(report)
    }

    /// Limits of the bodies as they lie opposite each other with `films` and `depths` \[m\].
    pub(in crate::sim) fn start(
        &mut self,
        models: &PerBody<dyn PlasticityModel>,
        films: &[Vec<f64>; 2],
        depths: &[Vec<f64>; 2],
    ) -> Result<(), InputError> {
        for (body, model) in models.each().into_iter().enumerate() {
            model.pressure_limits(&films[body], &depths[body], &mut self.body_limits[body]);
            for &limit in &self.body_limits[body] {
                InputError::require(limit > 0.0, "pressure limit of the law", limit, "above 0")?;
            }
        }
        let Some(model) = models.common() else {
            let bodies = self.body_limits[0].iter().zip(&self.body_limits[1]);
            self.limit.iter_mut().zip(bodies).for_each(|(limit, (ball, disc))| *limit = ball.min(*disc));
            return Ok(());
        };
        let ([first, second], [above, below]) = (films, depths);
        model.contact_limit_into([first, second], [above, below], &mut self.limit)
    }

    /// Finds the limits of the bodies once they have given way by `plastic` \[m\], and returns the largest
    /// distance of the limit from the smaller one, relative.
    fn harden(
        &mut self,
        models: &PerBody<dyn PlasticityModel>,
        films: &[Vec<f64>; 2],
        depths: &[Vec<f64>; 2],
        plastic: &[f64],
    ) -> f64 {
        for k in 0..plastic.len() {
            let split = split_depth(plastic[k], [self.body_limits[0][k], self.body_limits[1][k]]);
            for body in 0..2 {
                self.hardened_depths[body][k] = depths[body][k] + split[body];
            }
        }
        for (body, model) in models.each().into_iter().enumerate() {
            model.pressure_limits(&films[body], &self.hardened_depths[body], &mut self.hardened[body]);
        }
        let bodies = self.hardened[0].iter().zip(&self.hardened[1]);
        self.limit.iter().zip(bodies).fold(0.0, |largest, (limit, (first, second))| {
            largest.max((first.min(*second) - limit).abs() / limit)
        })
    }

    /// Moves the limit towards that of the bodies once they have given way by `plastic` \[m\]. A limit that
    /// rises by dH lets the node give way by some `compliance` dH \[m\] less, which the length of the move
    /// allows for.
    fn move_limit(&mut self, plastic: &[f64], compliance: f64) {
        for (k, limit) in self.limit.iter_mut().enumerate() {
            let softer = self.body_limits[0][k].min(self.body_limits[1][k]);
            let hardened = self.hardened[0][k].min(self.hardened[1][k]);
            let slope = if plastic[k] > 0.0 { (hardened - softer).max(0.0) / plastic[k] } else { 0.0 };
            *limit += (hardened - *limit) / (1.0 + slope * compliance);
        }
    }

    /// Splits `plastic` \[m\] between the bodies by their limits at the start.
    pub(in crate::sim) fn share(&mut self, plastic: &[f64]) -> Result<(), InputError> {
        let [ball, disc] = &mut self.split;
        let [ball_limit, disc_limit] = &self.body_limits;
        split_depth_into(plastic, [ball_limit, disc_limit], [ball, disc])
    }
}
