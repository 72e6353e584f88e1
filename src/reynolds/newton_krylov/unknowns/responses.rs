//! Changes of films and balances under a vector of unknowns.

use super::{Linearized, Response, Unknowns};
use crate::error::InputError;
use crate::reynolds::coupled::UNPADDED;
use crate::reynolds::newton_krylov::linearization::Linearization;

impl Unknowns {
    /// Film changes under the pressure changes of all nodes and a change of the approach.
    fn deform(
        &mut self,
        at: &mut Linearized<'_, '_>,
        approach: f32,
        response: Response,
    ) -> Result<(), InputError> {
        match response {
            Response::Padded => {
                at.problem.deformation.displacement_single(&self.pressure, &mut self.elastic)?;
                at.coupled.convolutions += 1.0;
            }
            Response::Periodic => {
                at.problem.deformation.displacement_periodic(&self.pressure, &mut self.elastic)?;
                at.coupled.convolutions += UNPADDED;
            }
        }
        // The approach lowers all films alike.
        let approach = f64::from(approach) * self.film_unit;
        self.elastic.iter_mut().for_each(|elastic| *elastic -= approach);
        Ok(())
    }

    /// Scatters the pressures of the vector `x`.
    pub(super) fn place(&mut self, x: &[f32]) {
        self.pressure.fill(0.0);
        self.fluid.fill(0.0);
        // Open nodes have one pressure, contact a fluid pressure of its own, fluid at the limit none to find.
        let (fluid, rest) = x.split_at(self.balanced.len());
        for (i, (&k, &x)) in self.balanced.iter().zip(fluid).enumerate() {
            if i < self.limited_from {
                self.pressure[k as usize] = f64::from(x) * self.pressure_unit;
            }
            if i < self.limited_from || i >= self.contact_from {
                self.fluid[k as usize] = x;
            }
        }
        // Total pressures of contact.
        for (&k, &x) in self.contact.iter().zip(rest) {
            self.pressure[k as usize] = f64::from(x) * self.pressure_unit;
        }
    }

    /// Films and balances under the scattered pressures.
    pub(super) fn respond(
        &mut self,
        at: &mut Linearized<'_, '_>,
        x: &[f32],
        response: Response,
    ) -> Result<(), InputError> {
        self.deform(at, x[self.len() - 1], response)?;
        self.flow_under(at.linearization, x);
        Ok(())
    }

    /// Balances under the scattered fluid pressures, the present films without plastic depth, and the plastic
    /// depths of the vector `x`.
    pub(super) fn flow_under(&mut self, linearization: &mut Linearization, x: &[f32]) {
        let per_unit = 1.0 / self.film_unit;
        for (film, elastic) in self.film.iter_mut().zip(&self.elastic) {
            *film = (elastic * per_unit) as f32;
        }
        // Plastic depths open the films of fluid at the limit.
        let limited = self.limited_from..self.contact_from;
        for (&k, x) in self.balanced[limited.clone()].iter().zip(&x[limited]) {
            self.film[k as usize] += x;
        }
        self.flow(linearization);
    }

    /// Balances under the present changes of fluid pressure and film.
    fn flow(&mut self, linearization: &mut Linearization) {
        // Contact keeps its film: by the plastic depth of yielded nodes, by the gap rows of the others.
        for &k in self.yielded.iter().chain(&self.contact) {
            self.film[k as usize] = 0.0;
        }
        linearization.product(&self.fluid, &self.film, &mut self.balance);
    }

    /// `out = J x`.
    pub(in crate::reynolds::newton_krylov) fn product(
        &mut self,
        at: &mut Linearized<'_, '_>,
        x: &[f32],
        response: Response,
        out: &mut [f32],
    ) -> Result<(), InputError> {
        // Pressures, films under them, balances, and the rows.
        self.place(x);
        self.respond(at, x, response)?;
        self.rows(out);
        out[self.len() - 1] = self.load(x) as f32;
        Ok(())
    }

    /// The column of the approach, without the load balance; no convolution.
    pub(in crate::reynolds::newton_krylov) fn approach_column(
        &mut self,
        linearization: &mut Linearization,
        out: &mut [f32],
    ) {
        // All films fall by one film unit.
        self.fluid.fill(0.0);
        self.elastic.fill(-self.film_unit);
        self.film.fill(-1.0);
        self.flow(linearization);
        self.rows(out);
        out[self.len() - 1] = 0.0;
    }

    fn rows(&self, out: &mut [f32]) {
        let (balances, gaps) = out.split_at_mut(self.balanced.len());
        for ((row, &k), weight) in balances.iter_mut().zip(&self.balanced).zip(&self.weights) {
            *row = weight * self.balance[k as usize];
        }
        for (row, &k) in gaps.iter_mut().zip(&self.contact) {
            *row = (self.elastic[k as usize] / self.film_unit) as f32;
        }
    }

    /// The changes of films without plastic depth under the last vector, in film units.
    pub(in crate::reynolds::newton_krylov) fn copy_films(&self, out: &mut [f32]) {
        for (film, elastic) in out.iter_mut().zip(&self.elastic) {
            *film = (elastic / self.film_unit) as f32;
        }
    }
}
