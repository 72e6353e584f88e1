//! What a solved contact does to the bodies under it: it flattens them, wears them and grows their
//! tribofilms.
//!
//! Pressures, stresses and temperatures are those of the contact as it was solved; a step leaves them as they
//! are while the surfaces change. How long the nodes of each body feel them is in `exposure`.

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

/// A solved contact as the nodes of the bodies feel it, in the frame of the contact.
#[derive(Debug)]
pub(in crate::sim) struct ContactExposure<'a> {
    /// The grid of the contact and of both bodies.
    pub(in crate::sim) grid: &'a Grid,
    /// Pressures and film.
    pub(in crate::sim) state: &'a ContactState,
    /// Shear on the surfaces and the pressure of the solids.
    pub(in crate::sim) friction: &'a FrictionFields,
    /// Rises of the surfaces of ball and disc above the bulk \[K\].
    pub(in crate::sim) rises: [&'a [f64]; 2],
    /// Bulk temperature \[K\].
    pub(in crate::sim) bulk: f64,
    /// Sliding speed \[m/s\].
    pub(in crate::sim) sliding: f64,
    /// Where the bodies lie.
    pub(in crate::sim) offsets: Offsets,
    /// How their nodes age in a second, of growth and prints.
    pub(in crate::sim) time_weight: [TimeWeight; 2],
    /// The same of wear.
    pub(in crate::sim) wear_time_weight: [TimeWeight; 2],
}

impl ContactExposure<'_> {
    /// What `body` feels at node `k` of the contact.
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

    /// What a node of a `body`, which lies where its offset says, feels: that of the node of the contact it
    /// stands on, or, short of it by a fraction of a cell, linear between that and the one before.
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
    /// Plastic depth that the step leaves \[m\].
    print: Vec<f64>,
    /// What each node feels.
    points: Vec<SurfaceState>,
    /// Rates of wear while they are applied \[m/s\].
    wear_rates: Vec<f64>,
}

impl StepBuffers {
    /// Buffers for bodies of so many nodes.
    pub(in crate::sim) fn new(nodes: usize) -> Self {
        Self { print: vec![0.0; nodes], points: Vec::with_capacity(nodes), wear_rates: vec![0.0; nodes] }
    }

    /// Adds the print of the contact to the plastic depth of the bodies: `depths`, what each gives way \[m\],
    /// times the share that a step of `time_step` \[s\] leaves.
    pub(in crate::sim) fn flatten(
        &mut self,
        bodies: &mut [Body; 2],
        contact_exposure: &ContactExposure<'_>,
        depths: &[Vec<f64>; 2],
        time_step: f64,
    ) -> Result<(), InputError> {
        let (nx, ny) = (contact_exposure.grid.nx(), contact_exposure.grid.ny());
        for (index, body) in bodies.iter_mut().enumerate() {
            self.print.fill(0.0);
            add_blended(&depths[index], nx, ny, contact_exposure.offsets[index], &mut self.print)?;
            let share = contact_exposure.time_weight[index].print(time_step);
            self.print.iter_mut().for_each(|depth| *depth *= share);
            body.plastic.add(&self.print)?;
        }
        Ok(())
    }

    /// Wears the bodies and grows their films for `time_step` \[s\], and brings their surfaces up to date.
    /// The film grows half before and half after the wear, so that the wear coefficient is that of the middle
    /// of the step.
    pub(in crate::sim) fn rub(
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
                // K F u_s dt, however long the nodes are exposed
                let per_second = wear_rates.iter().sum::<f64>() * contact_exposure.grid.cell_area();
                body.worn_volume += per_second * time_step;
            }
            grow(&mut body.film)?;
            body.rebuild()?;
        }
        Ok(())
    }
}
