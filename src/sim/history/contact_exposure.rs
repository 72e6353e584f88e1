//! The effect of a solved contact on the bodies: plastic indentation, wear and tribofilm growth.
//!
//! Pressures, stresses and temperatures are those of the solved contact, constant during a step. The time that
//! the nodes of each body are exposed to them is in `exposure`.

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::ContactState;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::laws::Laws;
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::exposure::TimeWeight;
use crate::sim::history::placement::Offsets;
use crate::surface::{Offset, add_blended};
use crate::surface_state::SurfaceState;
use crate::tribochem::Tribofilm;

/// Conditions on the bodies in a solved contact, in the frame of the contact.
#[derive(Debug)]
pub(in crate::sim) struct ContactExposure<'a> {
    /// The grid of the contact and of both bodies.
    pub(in crate::sim) grid: &'a Grid,
    /// Pressures and film.
    pub(in crate::sim) state: &'a ContactState,
    /// Shear on the surfaces and the pressure of the solids.
    pub(in crate::sim) friction: &'a FrictionFields,
    /// Temperature rises of the surfaces of ball and disc above the bulk \[K\].
    pub(in crate::sim) rises: [&'a [f64]; 2],
    /// Bulk temperature \[K\].
    pub(in crate::sim) bulk: f64,
    /// Sliding speed \[m/s\].
    pub(in crate::sim) sliding: f64,
    /// Positions of the bodies.
    pub(in crate::sim) offsets: Offsets,
    /// Time weights of growth and indentation on both bodies.
    pub(in crate::sim) time_weight: [TimeWeight; 2],
    /// Time weights of wear.
    pub(in crate::sim) wear_time_weight: [TimeWeight; 2],
}

impl ContactExposure<'_> {
    /// Surface state of `body` at node `k` of the contact.
    fn on_grid(&self, body: usize, k: usize) -> SurfaceState {
        SurfaceState {
            pressure: self.state.pressure[k],
            solid_pressure: self.friction.solid[k],
            shear_stress: self.friction.stress(k),
            temperature: self.bulk + self.rises[body][k],
            sliding_speed: self.sliding,
            gap: self.state.film[k],
            in_contact: self.state.in_contact[k],
        }
    }

    /// Surface state at a `node` of a `body` shifted by its offset: that of the contact node above it or, for a
    /// shift by a fraction of a cell, linear between two neighbors.
    fn on_body(&self, body: usize, node: usize) -> SurfaceState {
        let offset: Offset = self.offsets[body];
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let (i, j) = ((node % nx + nx - offset.columns) % nx, (node / nx + ny - offset.rows) % ny);
        let at = self.on_grid(body, j * nx + i);
        if offset.fraction == 0.0 {
            return at;
        }
        at.towards(&self.on_grid(body, j * nx + (i + nx - 1) % nx), offset.fraction)
    }
}

/// Buffers on the nodes of a body.
#[derive(Debug, Clone)]
pub(in crate::sim) struct StepBuffers {
    /// Plastic indentation by the step \[m\].
    indentation: Vec<f64>,
    /// Surface state of each node.
    points: Vec<SurfaceState>,
    /// Wear rates of the step \[m/s\].
    wear_rates: Vec<f64>,
}

impl StepBuffers {
    /// Buffers for bodies of `nodes` nodes.
    pub(in crate::sim) fn new(nodes: usize) -> Self {
        Self {
            indentation: vec![0.0; nodes],
            points: Vec::with_capacity(nodes),
            wear_rates: vec![0.0; nodes],
        }
    }

    /// Adds the plastic indentation of the contact to the plastic depth of the bodies: `depths` \[m\] of each body,
    /// times the share of a step of `time_step` \[s\].
    pub(in crate::sim) fn flatten(
        &mut self,
        bodies: &mut [Body; 2],
        contact_exposure: &ContactExposure<'_>,
        depths: &[Vec<f64>; 2],
        time_step: f64,
    ) -> Result<(), InputError> {
        let (nx, ny) = (contact_exposure.grid.nx(), contact_exposure.grid.ny());
        for (index, body) in bodies.iter_mut().enumerate() {
            self.indentation.fill(0.0);
            add_blended(&depths[index], nx, ny, contact_exposure.offsets[index], &mut self.indentation)?;
            let share = contact_exposure.time_weight[index].indentation_share(time_step);
            self.indentation.iter_mut().for_each(|depth| *depth *= share);
            body.plastic.add(&self.indentation)?;
        }
        Ok(())
    }

    /// Wears the bodies and grows their films for `time_step` \[s\], and updates their surfaces. Half of the growth
    /// precedes the wear and half follows, so that the wear coefficient is that of the middle of the step.
    pub(in crate::sim) fn wear_and_grow(
        &mut self,
        bodies: &mut [Body; 2],
        contact_exposure: &ContactExposure<'_>,
        laws: &Laws,
        time_step: f64,
    ) -> Result<(), SimError> {
        let Self { points, wear_rates, .. } = self;
        for (index, body) in bodies.iter_mut().enumerate() {
            let exposed = contact_exposure.time_weight[index].rate * time_step;
            points.clear();
            let nodes = 0..contact_exposure.grid.len();
            points.extend(nodes.map(|node| contact_exposure.on_body(index, node)));
            let grow = |film: &mut Option<Tribofilm>| match (&laws.growth, film) {
                (Some(law), Some(film)) => film.advance_all(law.as_ref(), 0.5 * exposed, points),
                _ => Ok(()),
            };
            grow(&mut body.film)?;
            if let Some(law) = &laws.wear {
                let exposed = contact_exposure.wear_time_weight[index].rate * time_step;
                let thickness = body.film.as_ref().map_or(body.no_film.as_slice(), Tribofilm::thickness);
                body.wear.advance_all(law.each()[index], exposed, (points, thickness), wear_rates)?;
                // worn volume K F u_s dt, independent of the exposure
                let per_second = wear_rates.iter().sum::<f64>() * contact_exposure.grid.cell_area();
                body.worn_volume += per_second * time_step;
            }
            grow(&mut body.film)?;
            body.rebuild()?;
        }
        Ok(())
    }
}
