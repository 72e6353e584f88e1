//! Putting a simulation together: the scene's own laws, or the user's in their place.

use super::body::Body;
use super::contact::{ContactModel, Overrides};
use super::scene::{Flash, Scene};
use super::simulation::{Heat, Laws, MixedLubricationSim, Travel};
use super::{SimError, exposure, setup};
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::lubricant::{DensityLaw, ViscosityLaw};
use crate::plastic::{ElasticPerfectlyPlastic, IsotropicHardening, PlasticityModel};
use crate::reynolds::ContactSolver;
use crate::surface::RoughnessMotion;
use crate::tribochem::{FilmGrowthLaw, FlashTemperature, ThermalBody, estimate_maximum_rise};
use crate::wear::{Archard, WearLaw, WearPressure};

/// Flash temperature rise below which the heat pass is left out unless asked for \[K\].
const NEGLIGIBLE_RISE: f64 = 1.0;

/// Builder of a [`MixedLubricationSim`].
#[derive(Debug)]
pub struct SimBuilder {
    scene: Scene,
    overrides: Overrides,
    plasticity: Option<Box<dyn PlasticityModel>>,
    growth: Option<Box<dyn FilmGrowthLaw>>,
    wear: Option<Box<dyn WearLaw>>,
    motion: Option<Box<dyn RoughnessMotion>>,
    squeeze: bool,
    heights: [Option<Vec<f64>>; 2],
}

impl SimBuilder {
    pub(super) fn new(scene: Scene) -> Self {
        Self {
            scene,
            overrides: Overrides::default(),
            plasticity: None,
            growth: None,
            wear: None,
            motion: None,
            squeeze: false,
            heights: [None, None],
        }
    }

    /// Replaces the elastic half-space; the model must live on the grid of the scene ([`Scene::grid`]).
    #[must_use]
    pub fn deformation(mut self, model: impl DeformationModel + 'static) -> Self {
        self.overrides.deformation = Some(Box::new(model));
        self
    }

    /// Replaces the viscosity law; the scene must have a lubricant.
    #[must_use]
    pub fn viscosity(mut self, law: impl ViscosityLaw + 'static) -> Self {
        self.overrides.viscosity = Some(Box::new(law));
        self
    }

    /// Replaces the density law; the scene must have a lubricant.
    #[must_use]
    pub fn density(mut self, law: impl DensityLaw + 'static) -> Self {
        self.overrides.density = Some(Box::new(law));
        self
    }

    /// Replaces the solver.
    #[must_use]
    pub fn solver(mut self, solver: impl ContactSolver + 'static) -> Self {
        self.overrides.solver = Some(Box::new(solver));
        self
    }

    /// Replaces the plasticity model, or brings one into a scene without.
    #[must_use]
    pub fn plasticity(mut self, model: impl PlasticityModel + 'static) -> Self {
        self.plasticity = Some(Box::new(model));
        self
    }

    /// Replaces the growth law of the tribofilm, or brings one into a scene without.
    #[must_use]
    pub fn growth_law(mut self, law: impl FilmGrowthLaw + 'static) -> Self {
        self.growth = Some(Box::new(law));
        self
    }

    /// Replaces the wear law, or brings one into a scene without.
    #[must_use]
    pub fn wear_law(mut self, law: impl WearLaw + 'static) -> Self {
        self.wear = Some(Box::new(law));
        self
    }

    /// Replaces the motion of the roughness from step to step.
    #[must_use]
    pub fn motion(mut self, motion: impl RoughnessMotion + 'static) -> Self {
        self.motion = Some(Box::new(motion));
        self
    }

    /// Makes the history transient: each contact after the first feels the squeeze of the films of the two before
    /// ([`Squeeze::second_order`](crate::reynolds::Squeeze::second_order); of first order in the second contact and after a step
    /// more than twice as long as the one before). It belongs to [`Carried`](crate::surface::Carried) and steps of the time that the
    /// surfaces need for a cell; in the long steps of a wear history the squeeze is nothing.
    #[must_use]
    pub fn with_squeeze(mut self) -> Self {
        self.squeeze = true;
        self
    }

    /// Replaces the heights of the ball, one value per node of the grid, positive out of the body \[m\].
    #[must_use]
    pub fn ball_heights(mut self, heights: Vec<f64>) -> Self {
        self.heights[0] = Some(heights);
        self
    }

    /// Replaces the heights of the disc, one value per node of the grid, positive out of the body \[m\].
    #[must_use]
    pub fn disc_heights(mut self, heights: Vec<f64>) -> Self {
        self.heights[1] = Some(heights);
        self
    }

    /// Checks the scene and makes the simulation; what is not modelled is decided here once.
    ///
    /// # Errors
    /// A scene or heights that do not fit.
    pub fn build(mut self) -> Result<MixedLubricationSim, SimError> {
        let overrides = std::mem::take(&mut self.overrides);
        let contact = ContactModel::new(&self.scene, overrides)?;
        exposure::validate(&self.scene, &contact.grid)?;
        let laws = self.laws()?;
        let [ball, disc] = std::mem::take(&mut self.heights);
        let bodies = [self.body(ball, 0, &contact, &laws)?, self.body(disc, 1, &contact, &laws)?];
        let (flash, flash_estimate) = self.flash(&contact)?;
        let heat = Heat { flash, estimate: flash_estimate };
        let motion = self.motion.unwrap_or_else(|| self.scene.track.roughness_motion());
        let travel = Travel { motion, squeeze: self.squeeze };
        Ok(MixedLubricationSim::assemble(self.scene, contact, bodies, laws, heat, travel)?)
    }

    fn laws(&mut self) -> Result<Laws, SimError> {
        let scene = &self.scene;
        let growth: Option<Box<dyn FilmGrowthLaw>> = match (self.growth.take(), scene.tribofilm) {
            (Some(law), _) => Some(law),
            (None, Some(spec)) => Some(Box::new(setup::growth_law(&spec)?)),
            (None, None) => None,
        };
        let film_thickness = growth.as_ref().map(|law| law.maximum_thickness());
        let plasticity: Option<Box<dyn PlasticityModel>> = match (self.plasticity.take(), scene.plastic) {
            (Some(model), _) => Some(model),
            (None, Some(spec)) => {
                let initial = match (spec.film_hardness, film_thickness) {
                    (Some(film), Some(full)) => {
                        ElasticPerfectlyPlastic::with_film(spec.hardness, film, full)?
                    }
                    _ => ElasticPerfectlyPlastic::uniform(spec.hardness)?,
                };
                Some(match spec.hardening_modulus {
                    Some(modulus) => Box::new(IsotropicHardening::new(initial, modulus)?),
                    None => Box::new(initial),
                })
            }
            (None, None) => None,
        };
        let wear: Option<Box<dyn WearLaw>> = match (self.wear.take(), scene.wear) {
            (Some(law), _) => Some(law),
            (None, Some(spec)) => {
                // Without a film the reference thickness is never reached: any positive one will do.
                let full = film_thickness.unwrap_or(1.0);
                let mut law = Archard::new(spec.coefficient, spec.film_coefficient, full, spec.hardness)?;
                if let Some(film_hardness) = spec.film_hardness {
                    law = law.with_film_hardness(film_hardness)?;
                }
                let pressure =
                    if spec.solid_pressure_only { WearPressure::Solid } else { WearPressure::Total };
                Some(Box::new(law.with_pressure(pressure)))
            }
            (None, None) => None,
        };
        Ok(Laws { plasticity, growth, wear })
    }

    fn body(
        &self,
        heights: Option<Vec<f64>>,
        index: usize,
        contact: &ContactModel,
        laws: &Laws,
    ) -> Result<Body, SimError> {
        let (name, roughness) = if index == 0 {
            ("ball", &self.scene.roughness.ball)
        } else {
            ("disc", &self.scene.roughness.disc)
        };
        let initial = match heights {
            Some(heights) => heights,
            None => setup::heights(roughness, &contact.grid, name)?,
        };
        let field = format!("{name} heights");
        InputError::require_len(&field, &initial, contact.grid.len())?;
        InputError::require_finite(&field, &initial)?;
        Ok(Body::new(initial, laws.growth.as_deref()))
    }

    /// The heat pass, unless it is switched off or its estimate is negligible, and the estimate \[K\].
    fn flash(&self, contact: &ContactModel) -> Result<(Option<FlashTemperature>, f64), SimError> {
        let (thermal, motion) = (self.scene.thermal, self.scene.motion);
        let steel = ThermalBody { conductivity: thermal.conductivity, diffusivity: thermal.diffusivity };
        let speeds = motion.surface_speeds();
        let radius = contact.hertz.radius;
        let friction = self.scene.friction.boundary_coefficient;
        let estimate = estimate_maximum_rise([steel; 2], speeds, friction, contact.hertz.p_max, radius)?;
        let wanted = match thermal.flash {
            Flash::On => true,
            Flash::Off => false,
            Flash::Auto => estimate >= NEGLIGIBLE_RISE,
        };
        let flash =
            if wanted { Some(FlashTemperature::new(&contact.grid, [steel; 2], speeds)?) } else { None };
        Ok((flash, estimate))
    }
}
