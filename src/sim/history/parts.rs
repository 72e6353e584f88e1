//! Laws, bodies and warnings of a simulation, from custom components or the scene.

use std::sync::Arc;

use crate::error::InputError;
use crate::lubricant::Lubricant;
use crate::plastic::{ElasticPerfectlyPlastic, IsotropicHardening, PlasticityModel};
use crate::sim::contact::asperity_inlets;
use crate::sim::contact::friction_laws::boundary_law;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::per_body::PerBody;
use crate::sim::contact::setup;
use crate::sim::contact::short_roughness;
use crate::sim::contact::warnings::{self, Warning};
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::builder::SimBuilder;
use crate::sim::history::custom_parts::ReplacedParts;
use crate::sim::scene::{BODIES, PlasticSpec, Roughness};
use crate::tribochem::FilmGrowthLaw;

impl SimBuilder {
    /// The warnings of the scene, without those on roughness that custom heights replace, and of heights and laws
    /// given or read.
    pub(in crate::sim) fn warnings(
        &self,
        replaced: ReplacedParts,
        contact: &ContactModel,
        bodies: &[Body; 2],
        laws: &Laws,
    ) -> Vec<Warning> {
        let mut scene = self.scene.clone();
        let mut found = Vec::new();
        let roughness = [&mut scene.roughness.ball, &mut scene.roughness.disc];
        for (index, (roughness, given)) in roughness.into_iter().zip(replaced.heights).enumerate() {
            if given || matches!(roughness, Roughness::File(_)) {
                *roughness = Roughness::None;
                found.extend(warnings::of_heights(
                    index,
                    bodies[index].initial(),
                    &contact.grid,
                    &contact.hertz,
                ));
                let measured = self.measured_rq[index];
                found.extend(measured.and_then(|rq| warnings::lost_rq(index, bodies[index].initial(), rq)));
            }
        }
        found.extend_from_slice(&self.file_warnings);
        let viscosity = contact.lubricant.as_ref().filter(|_| replaced.viscosity).map(Lubricant::viscosity);
        let growth = laws.growth.as_ref().filter(|_| replaced.growth);
        found.extend(warnings::of_own_laws(viscosity, growth.map(|law| law.maximum_thickness())));
        let heights = bodies.each_ref().map(Body::initial);
        found.extend(warnings::of_roughness(&self.scene, heights, &contact.grid, &contact.hertz));
        found.extend(asperity_inlets::warnings(&self.scene, &contact.grid, heights, contact.stated_film));
        // Heights that replace those of the scene have no spectrum beyond the grid.
        let short = short_roughness::short_roughness(&scene, &contact.grid, heights, &contact.hertz);
        found.extend(short_roughness::warning(&scene, &contact.grid, short));
        let mut warnings = scene.warnings();
        warnings.extend(found);
        if self.squeeze {
            warnings.retain(|warning| !warnings::QUASI_STATIC.contains(&warning.field.as_str()));
        }
        warnings
    }

    /// The custom laws, or else those of the scene, each for the hardness of its body. Laws that depend on the film
    /// get the thickness of a full tribofilm.
    pub(in crate::sim) fn laws(&mut self) -> Result<Laws, SimError> {
        let scene = &self.scene;
        let growth: Option<Arc<dyn FilmGrowthLaw>> = match (self.growth.take(), scene.tribofilm) {
            (Some(law), _) => Some(law),
            (None, Some(spec)) => Some(spec.law()?.into()),
            (None, None) => None,
        };
        if growth.is_none() && scene.elastic.tribofilm.is_some() {
            return Err(SimError::Input(InputError::Conflict {
                field: "elastic.tribofilm".to_owned(),
                reason: "the scene has no tribofilm".to_owned(),
            }));
        }
        let film_thickness = growth.as_ref().map(|law| law.maximum_thickness());
        let plasticity = match (self.plasticity.take(), scene.plastic) {
            (Some(model), _) => Some(PerBody::same(model)),
            (None, Some(spec)) => Some(PerBody::by(scene.hardnesses(spec.hardness), |hardness| {
                plasticity_model(&PlasticSpec { hardness, ..spec }, film_thickness)
                    .map_err(|error| error.within("plastic"))
            })?),
            (None, None) => None,
        };
        let wear = match (self.wear.take(), scene.wear) {
            (Some(_), None) => {
                return Err(SimError::Input(InputError::Conflict {
                    field: "wear.exposure".to_owned(),
                    reason: "is missing; a wear law of your own takes its exposure, \"track\" or \"contact_clock\", from the \
                             wear table of the scene"
                        .to_owned(),
                }));
            }
            (Some(law), Some(_)) => Some(PerBody::same(law)),
            (None, Some(spec)) => match spec.law.hardness() {
                None => Some(PerBody::same(spec.law(0.0, film_thickness)?.into())),
                Some(common) => Some(PerBody::by(scene.hardnesses(common), |hardness| {
                    spec.law(hardness, film_thickness)
                })?),
            },
            (None, None) => None,
        };
        let friction = match self.friction.take() {
            Some(law) => law,
            None => boundary_law(&scene.friction, film_thickness)?.into(),
        };
        Ok(Laws { plasticity, growth, wear, friction })
    }

    /// The ball (0) or the disc (1): a body from an earlier run, or a new one of heights given, generated or read.
    pub(in crate::sim) fn body(
        &mut self,
        index: usize,
        contact: &ContactModel,
        laws: &Laws,
    ) -> Result<Body, SimError> {
        let name = BODIES[index];
        let (heights, start) = (self.heights[index].take(), self.starts[index].take());
        if let Some(start) = start {
            if heights.is_some() {
                return Err(SimError::Input(InputError::Conflict {
                    field: format!("{name} start"),
                    reason: format!("heights of the {name} are given too, but a start has its own"),
                }));
            }
            return Ok(start.into_body(name, &contact.grid, laws.growth.as_deref())?);
        }
        let roughness = &self.scene.roughness;
        let roughness = [&roughness.ball, &roughness.disc][index];
        let initial = match heights {
            Some(heights) => heights,
            None => {
                let rough = setup::heights(roughness, &contact.grid, name)?;
                self.measured_rq[index] = rough.measured_rq;
                self.file_warnings.extend(rough.file_warnings);
                rough.heights
            }
        };
        let field = format!("{name}_heights");
        contact.grid.require_field(&field, &initial)?;
        let half_width = contact.hertz.half_width_x.min(contact.hertz.half_width_y);
        warnings::reject_height_unit(&format!("roughness.{name}"), &initial, half_width)?;
        Ok(Body::new(initial, laws.growth.as_deref()))
    }
}

/// The plasticity model of one body: a hardness, linear in the thickness of a softer tribofilm, and growing with
/// the plastic depth if a modulus is given. Errors name its constants only.
fn plasticity_model(
    spec: &PlasticSpec,
    film_thickness: Option<f64>,
) -> Result<Box<dyn PlasticityModel>, InputError> {
    let initial = match (spec.film_hardness, film_thickness) {
        (Some(film), Some(full)) => ElasticPerfectlyPlastic::with_film(spec.hardness, film, full)?,
        _ => ElasticPerfectlyPlastic::uniform(spec.hardness)?,
    };
    Ok(match spec.hardening_modulus {
        Some(modulus) => Box::new(IsotropicHardening::new(initial, modulus)?),
        None => Box::new(initial),
    })
}
