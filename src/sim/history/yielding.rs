//! The pressure limit of a contact and its division of plastic depth between the bodies.
//!
//! The limit at a node of the contact is the smaller of the limits of both bodies there, which depend on their
//! tribofilms and plastic depths. If the limit grows with the depth added by this contact, limit and depth are
//! iterated.
//!
//! Both bodies have the same pressure: the softer one yields; at equal limits both take half of the depth.

use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::plastic::{PlasticityModel, split_depth, split_depth_into};
use crate::report::{SolveReport, Status};
use crate::reynolds::{ContactState, Squeeze};
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::per_body::PerBody;
use crate::sim::error::SimError;
use crate::sim::history::placement::Placement;

/// Most solves to match limit and depth of a hardening contact.
const MAX_HARDENING: usize = 40;
/// Tolerance of the limit, relative.
const HARDENING_TOLERANCE: f64 = 1e-3;
/// Compliance of a patch of nodes that yield together over that of a single node, approximately.
const PATCH_COMPLIANCE: f64 = 4.0;

/// Limits and depths of the present contact, in its frame.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Yielding {
    /// Pressure limit of the pair \[Pa\].
    pub(in crate::sim) limit: Vec<f64>,
    /// Initial limits of ball and disc \[Pa\].
    body_limits: [Vec<f64>; 2],
    /// Plastic depths of the bodies after yielding \[m\].
    hardened_depths: [Vec<f64>; 2],
    /// Limits of the bodies after yielding \[Pa\].
    hardened: [Vec<f64>; 2],
    /// Plastic depth added to each body \[m\].
    pub(in crate::sim) split: [Vec<f64>; 2],
}

impl Yielding {
    /// Fields of zeros for `n` nodes.
    pub(in crate::sim) fn new(n: usize) -> Self {
        let zeros = || vec![0.0; n];
        let pair = || [zeros(), zeros()];
        Self { limit: zeros(), body_limits: pair(), hardened_depths: pair(), hardened: pair(), split: pair() }
    }

    /// Solves the contact of the placed bodies under the pressure limit of their `models`; without them it is elastic. Limits that grow with the
    /// depth are updated and the contact is solved again until both match; otherwise the status is
    /// `MaxIterations` and the limit is that of the last solve.
    pub(in crate::sim) fn solve(
        &mut self,
        models: Option<&PerBody<dyn PlasticityModel>>,
        placement: &Placement,
        contact: &mut ContactModel,
        squeeze: Option<Squeeze<'_>>,
        state: &mut ContactState,
    ) -> Result<SolveReport, SimError> {
        let Placement { gap, films, depths, .. } = placement;
        let Some(models) = models else { return contact.solve(gap, None, squeeze, state) };
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

    /// Limits of the placed bodies with `films` and `depths` \[m\].
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

    /// Computes the limits of the bodies after yielding by `plastic` \[m\]. Returns the largest relative error of
    /// the present limit.
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

    /// Moves the limit towards that of the bodies after yielding by `plastic` \[m\]. A limit higher by dH lowers the
    /// plastic depth by about `compliance` dH \[m\], which the step length accounts for.
    fn move_limit(&mut self, plastic: &[f64], compliance: f64) {
        for (k, limit) in self.limit.iter_mut().enumerate() {
            let softer = self.body_limits[0][k].min(self.body_limits[1][k]);
            let hardened = self.hardened[0][k].min(self.hardened[1][k]);
            let slope = if plastic[k] > 0.0 { (hardened - softer).max(0.0) / plastic[k] } else { 0.0 };
            *limit += (hardened - *limit) / (1.0 + slope * compliance);
        }
    }

    /// Divides `plastic` \[m\] between the bodies by their initial limits.
    pub(in crate::sim) fn share(&mut self, plastic: &[f64]) -> Result<(), InputError> {
        let [ball, disc] = &mut self.split;
        let [ball_limit, disc_limit] = &self.body_limits;
        split_depth_into(plastic, [ball_limit, disc_limit], [ball, disc])
    }
}
