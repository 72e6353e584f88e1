//! The far field of a contact model under its present conditions.

use crate::error::InputError;
use crate::sim::contact::far_field::outer::OuterContact;
use crate::sim::contact::far_field::{BoxError, Contact, FloodedInlet, Inlet, InletScale};
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::scene::Scene;

impl ContactModel {
    /// Computes the far field under the present conditions if the box cuts the inlet.
    pub(in crate::sim) fn find_far_field(&mut self, laws: &Laws) -> Result<(), SimError> {
        let Some(mut inlet) = self.inlet.take() else { return Ok(()) };
        let found = self.find_far_field_of(&mut inlet, laws);
        self.inlet = Some(inlet);
        found
    }

    fn find_far_field_of(&mut self, inlet: &mut Inlet, laws: &Laws) -> Result<(), SimError> {
        let motion = self.motion;
        let point =
            [self.hertz.force, motion.entrainment_speed, motion.slide_roll_ratio, self.bulk_temperature]
                .map(f64::to_bits);
        if inlet.point == Some(point) {
            return Ok(());
        }
        self.far_field = None;
        inlet.is_solved = true;
        inlet.error = BoxError::NONE;
        let Some(scale) = self.inlet_scale(&inlet.scene)? else { return Ok(()) };
        if !self.is_starved(&inlet.scene)? {
            inlet.error = scale.error_on(&self.grid);
        }
        if !inlet.error.is_small() {
            if inlet.has_outer && scale.is_held_by(&self.grid) {
                let outer = OuterContact::new(&inlet.scene, self, scale.film())?;
                self.far_field = outer.solve(&self.grid, laws, scale.film())?;
            }
            inlet.is_solved = self.far_field.is_some();
        }
        inlet.point = Some(point);
        Ok(())
    }

    /// Lengths and pressures of the flooded contact of `scene` under the present conditions; `None` without a lubricant.
    fn inlet_scale(&self, scene: &Scene) -> Result<Option<InletScale>, InputError> {
        let (Some(oil), Some(formulas)) = (&self.lubricant, self.formulas) else { return Ok(None) };
        let (hertz, viscosity) = (&self.hertz, oil.viscosity());
        let entrainment_speed = self.motion.entrainment_speed;
        InletScale::new(&Contact { scene, hertz, viscosity, entrainment_speed, formulas }).map(Some)
    }

    /// The inlet under the present conditions; `None` if the oil supply is at the edge of the box or inside.
    pub(in crate::sim) fn flooded_inlet(&self) -> Result<Option<FloodedInlet>, InputError> {
        let Some(inlet) = &self.inlet else { return Ok(None) };
        let Some(scale) = self.inlet_scale(&inlet.scene)? else { return Ok(None) };
        if self.is_starved(&inlet.scene)? {
            return Ok(None);
        }
        let error = scale.error_on(&self.grid);
        Ok(Some(FloodedInlet { film_error: error.ambient, box_holds_it: error.is_small() }))
    }

    /// The warning that the box of a cycle of `scene` cuts the inlet: its oil begins at the edges of the box.
    pub(in crate::sim) fn cut_inlet(&self, scene: &Scene) -> Result<Option<Warning>, InputError> {
        let Some(scale) = self.inlet_scale(scene)? else { return Ok(None) };
        let error = scale.error_on(&self.grid);
        if error.is_small() || self.is_starved(scene)? {
            return Ok(None);
        }
        let message = format!(
            "the box cuts the inlet at the largest entrainment speed of the cycle, whose oil begins at the edges of the box: the film is up to \
             {:.0} % too thin",
            100.0 * error.ambient
        );
        let remedy =
            "take a wider box, or say that the oil begins at its edge (lubricant.inlet = \"box_edge\")"
                .to_owned();
        Ok(Some(Warning::new("grid.x", self.grid.x(0) - 0.5 * self.grid.dx(), message, remedy)))
    }

    /// Whether the supplied film meets the surfaces within the box: there is no pressure upstream of it.
    fn is_starved(&self, scene: &Scene) -> Result<bool, InputError> {
        let Some(supply) = self.supplied_film else { return Ok(false) };
        let mut edge = vec![0.0; self.grid.len()];
        scene.form.gap_into(&self.grid, &mut edge)?;
        let least = edge.iter().step_by(self.grid.nx()).copied().fold(f64::INFINITY, f64::min);
        Ok(least > supply)
    }
}
