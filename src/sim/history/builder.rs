//! Builder of a simulation from the laws of its scene or custom components.
//!
//! Every law of the scene can be replaced before [`build`](SimBuilder::build) or
//! [`solve`](SimBuilder::solve), which check everything. Checkpoints identify custom components by their
//! `Debug` output: a simulation with other components is another run.
//!
//! [`SimBuilder::build`] makes a history, [`SimBuilder::solve`] a single contact. Clones of the simulation
//! share all components except elastic bodies and solver, which are copied.

use std::sync::Arc;

use crate::boundary_friction::BoundaryFriction;
use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::lubricant::{DensityLaw, Lubricant, ViscosityLaw};
use crate::plastic::{ElasticPerfectlyPlastic, IsotropicHardening, PlasticityModel};
use crate::reynolds::{ContactSolver, ContactState, FaceMobility};
use crate::sim::contact::asperity_inlets;
use crate::sim::contact::friction_laws::boundary_law;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::{ContactModel, CustomComponents, validate_loads};
use crate::sim::contact::per_body::PerBody;
use crate::sim::contact::setup;
use crate::sim::contact::short_roughness;
use crate::sim::contact::warnings::{self, Warning};
use crate::sim::error::SimError;
use crate::sim::history::body::Body;
use crate::sim::history::exposure;
use crate::sim::history::half_mesh::HalfMesh;
use crate::sim::history::heat::Heat;
use crate::sim::history::placement::SurfaceMotion;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::start::BodyStart;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::{BODIES, PlasticSpec, Roughness, Scene};
use crate::surface::RoughnessMotion;
use crate::tribochem::FilmGrowthLaw;
use crate::wear::WearLaw;

/// Builder of a [`MixedLubricationSim`].
///
/// # Examples
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// use stribeck::wear::Archard;
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16))
///     .wear_law(Archard::azam_2019()) // one law for both bodies
///     .disc_heights(vec![0.0; 16 * 16]) // a smooth disc under the rough ball of the scene
///     .build()?;
/// assert_eq!(sim.bodies()[1].surface(), [0.0; 16 * 16]);
/// assert!(sim.step(10.0)?.wear.disc_mean > 0.0);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug)]
pub struct SimBuilder {
    /// The scene. The components below replace its parts.
    pub(in crate::sim) scene: Scene,
    /// Custom components of the contact.
    pub(in crate::sim) custom: CustomComponents,
    /// Custom plasticity model; `None` for that of the scene, as for all fields below.
    pub(in crate::sim) plasticity: Option<Arc<dyn PlasticityModel>>,
    /// Growth of the tribofilm.
    pub(in crate::sim) growth: Option<Arc<dyn FilmGrowthLaw>>,
    /// Wear of both bodies.
    pub(in crate::sim) wear: Option<Arc<dyn WearLaw>>,
    /// Friction of solid contact.
    pub(in crate::sim) friction: Option<Arc<dyn BoundaryFriction>>,
    /// Motion of the roughness from step to step.
    pub(in crate::sim) motion: Option<Arc<dyn RoughnessMotion>>,
    /// Whether the film has a squeeze term.
    pub(in crate::sim) squeeze: bool,
    /// Custom heights of ball and disc \[m\].
    pub(in crate::sim) heights: [Option<Vec<f64>>; 2],
    /// Bodies from earlier runs.
    pub(in crate::sim) starts: [Option<BodyStart>; 2],
    /// Rq of the files of measured surfaces after reading \[m\].
    measured_rq: [Option<f64>; 2],
    /// Warnings about the files of measured surfaces after reading.
    file_warnings: Vec<Warning>,
    /// Start of a single contact, or of the first one of a history.
    pub(in crate::sim) contact_start: Option<ContactState>,
}

/// Flags of the parts of the scene that were replaced.
#[derive(Debug, Default, Clone, Copy)]
pub(in crate::sim) struct ReplacedParts {
    /// Heights of ball and disc.
    heights: [bool; 2],
    /// The viscosity law.
    viscosity: bool,
    /// The growth law.
    growth: bool,
}

impl MixedLubricationSim {
    /// A builder of the simulation of `scene`.
    pub fn builder(scene: Scene) -> SimBuilder {
        SimBuilder::new(scene)
    }
}

impl SimBuilder {
    /// A builder without custom components.
    pub(in crate::sim) fn new(scene: Scene) -> Self {
        Self {
            scene,
            custom: CustomComponents::default(),
            plasticity: None,
            growth: None,
            wear: None,
            friction: None,
            motion: None,
            squeeze: false,
            heights: [None, None],
            starts: [None, None],
            measured_rq: [None, None],
            file_warnings: Vec::new(),
            contact_start: None,
        }
    }

    /// Replaces the elastic half-space. The model must be on the grid of the scene ([`Scene::grid`]). Clones of the
    /// simulation copy it.
    #[must_use]
    pub fn deformation(mut self, model: impl DeformationModel + Clone + 'static) -> Self {
        self.custom.deformation = Some(Box::new(model));
        self
    }

    /// Replaces the viscosity law; the scene must have a lubricant.
    #[must_use]
    pub fn viscosity(mut self, law: impl ViscosityLaw + 'static) -> Self {
        self.custom.viscosity = Some(Box::new(law));
        self
    }

    /// Replaces the density law; the scene must have a lubricant.
    #[must_use]
    pub fn density(mut self, law: impl DensityLaw + 'static) -> Self {
        self.custom.density = Some(Box::new(law));
        self
    }

    /// Replaces the solver. Clones of the simulation copy it. A state that it reports as converged is evaluated
    /// again: if its residuals exceed twice the tolerance, the status is
    /// [`Status::Unverified`](crate::Status::Unverified) and the bodies do not change.
    #[must_use]
    pub fn solver(mut self, solver: impl ContactSolver + Clone + 'static) -> Self {
        self.custom.solver = Some(Box::new(solver));
        self
    }

    /// Replaces the solver by one whose states are checked by the caller and are those of a solver of the crate.
    #[cfg(feature = "benchmark")]
    pub(crate) fn checked_solver(mut self, solver: impl ContactSolver + Clone + 'static) -> Self {
        self.custom.solver = Some(Box::new(solver));
        self.custom.is_checked = true;
        self
    }

    /// Sets the plasticity model, with or without one in the scene.
    #[must_use]
    pub fn plasticity(mut self, model: impl PlasticityModel + 'static) -> Self {
        self.plasticity = Some(Arc::new(model));
        self
    }

    /// Sets the growth law of the tribofilm, with or without one in the scene.
    #[must_use]
    pub fn growth_law(mut self, law: impl FilmGrowthLaw + 'static) -> Self {
        self.growth = Some(Arc::new(law));
        self
    }

    /// Replaces the wear law of the scene, but not its [`exposure`](crate::sim::scene::WearSpec::exposure).
    #[must_use]
    pub fn wear_law(mut self, law: impl WearLaw + 'static) -> Self {
        self.wear = Some(Arc::new(law));
        self
    }

    /// Replaces the law of friction in solid contact.
    #[must_use]
    pub fn boundary_friction(mut self, law: impl BoundaryFriction + 'static) -> Self {
        self.friction = Some(Arc::new(law));
        self
    }

    /// Starts with a ball from an earlier run: its heights, wear, plastic depth and tribofilm.
    #[must_use]
    pub fn ball_start(mut self, start: BodyStart) -> Self {
        self.starts[0] = Some(start);
        self
    }

    /// Starts with a disc from an earlier run: its heights, wear, plastic depth and tribofilm.
    #[must_use]
    pub fn disc_start(mut self, start: BodyStart) -> Self {
        self.starts[1] = Some(start);
        self
    }

    /// Replaces the motion of the roughness from step to step.
    #[must_use]
    pub fn motion(mut self, motion: impl RoughnessMotion + 'static) -> Self {
        self.motion = Some(Arc::new(motion));
        self
    }

    /// Makes the history transient: from the second contact on, the squeeze term uses the films of the two previous
    /// contacts ([`Squeeze::second_order`](crate::reynolds::Squeeze::second_order)). It is first-order in the
    /// second contact and after a step more than twice as long as the previous one. Use it with
    /// [`Advected`](crate::surface::Advected) and steps of one cell transit time; in the long steps of a wear
    /// history the squeeze term vanishes.
    #[must_use]
    pub fn with_squeeze(mut self) -> Self {
        self.squeeze = true;
        self
    }

    /// Replaces the heights of the ball, one value per node of the grid, positive out of the body \[m\]. Unless all
    /// heights are equal, the default face mobility is that of rough surfaces.
    #[must_use]
    pub fn ball_heights(mut self, heights: Vec<f64>) -> Self {
        self.heights[0] = Some(heights);
        self
    }

    /// Replaces the heights of the disc, one value per node of the grid, positive out of the body \[m\]; see
    /// [`ball_heights`](Self::ball_heights).
    #[must_use]
    pub fn disc_heights(mut self, heights: Vec<f64>) -> Self {
        self.heights[1] = Some(heights);
        self
    }

    /// Interrupts a solve: `asked` is called once per iteration on the solving thread. When it returns true, the
    /// solve ends with [`SimError::Interrupted`] and the simulation is as before the step.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use std::sync::atomic::{AtomicBool, Ordering};
    /// use stribeck::sim::{MixedLubricationSim, Scene, SimError};
    /// let stop = Arc::new(AtomicBool::new(true));
    /// let seen = Arc::clone(&stop);
    /// let builder = MixedLubricationSim::builder(Scene::azam_2019(32));
    /// let mut sim = builder.interrupt(move || seen.load(Ordering::Relaxed)).build()?;
    /// assert!(matches!(sim.step(60.0), Err(SimError::Interrupted)));
    /// stop.store(false, Ordering::Relaxed);
    /// assert_eq!(sim.step(60.0)?.step, 0);
    /// # Ok::<(), SimError>(())
    /// ```
    #[must_use]
    pub fn interrupt(mut self, asked: impl Fn() -> bool + Send + Sync + 'static) -> Self {
        self.custom.interrupt = Some(Interrupt::new(asked));
        self
    }

    /// Starts [`solve`](Self::solve), or the first step of a history, from the pressures of an earlier solution on
    /// the same grid. Newton's method discards this start if its residual exceeds
    /// [`NewtonSettings::warm_start_threshold`](crate::reynolds::NewtonSettings::warm_start_threshold). Later
    /// steps start from the bodies only.
    #[must_use]
    pub fn contact_start(mut self, state: ContactState) -> Self {
        self.contact_start = Some(state);
        self
    }

    /// The face mobility. Its default for custom heights is that of rough surfaces.
    pub(in crate::sim) fn face_mobility(&self, replaced: ReplacedParts, bodies: &[Body; 2]) -> FaceMobility {
        let roughness = [&self.scene.roughness.ball, &self.scene.roughness.disc];
        let smooth = (0..2).all(|index| {
            let surface = bodies[index].surface();
            let is_flat = || surface.iter().all(|z| z.to_bits() == surface[0].to_bits());
            if replaced.heights[index] { is_flat() } else { roughness[index].is_smooth() }
        });
        self.scene.face_mobility_between(smooth)
    }

    /// The parts of the scene replaced so far.
    pub(in crate::sim) fn replaced(&self) -> ReplacedParts {
        ReplacedParts {
            heights: [0, 1].map(|body| self.heights[body].is_some() || self.starts[body].is_some()),
            viscosity: self.custom.viscosity.is_some(),
            growth: self.growth.is_some(),
        }
    }

    /// The first custom component of the contact, apart from heights and starts.
    pub(in crate::sim) fn custom_contact(&self) -> Option<&'static str> {
        let custom = &self.custom;
        [
            ("deformation", custom.deformation.is_some()),
            ("viscosity", custom.viscosity.is_some()),
            ("density", custom.density.is_some()),
            ("solver", custom.solver.is_some()),
            ("plasticity", self.plasticity.is_some()),
            ("boundary_friction", self.friction.is_some()),
        ]
        .into_iter()
        .find_map(|(part, given)| given.then_some(part))
    }

    /// The first custom component, height or start.
    pub(in crate::sim) fn custom_part(&self) -> Option<&'static str> {
        let [ball, disc] = &self.heights;
        let [ball_start, disc_start] = &self.starts;
        let given = [
            ("ball_heights", ball.is_some()),
            ("disc_heights", disc.is_some()),
            ("ball_start", ball_start.is_some()),
            ("disc_start", disc_start.is_some()),
            ("contact_start", self.contact_start.is_some()),
        ];
        given.into_iter().find_map(|(part, given)| given.then_some(part)).or_else(|| self.custom_contact())
    }

    /// A custom component that is defined on one grid and cannot follow a growing box.
    pub(in crate::sim) fn part_on_one_grid(&self) -> Option<&'static str> {
        let others = [
            ("growth_law", self.growth.is_some()),
            ("wear_law", self.wear.is_some()),
            ("motion", self.motion.is_some()),
            ("squeeze", self.squeeze),
        ];
        self.custom_part().or_else(|| others.into_iter().find_map(|(part, given)| given.then_some(part)))
    }

    /// Checks the scene and makes the simulation, with the physics of the scene.
    ///
    /// # Errors
    /// A scene or heights that do not fit.
    pub fn build(mut self) -> Result<MixedLubricationSim, SimError> {
        require_at_rest(&self.scene)?;
        self.scene.schedule.read_tables()?;
        self.require_growable()?;
        #[cfg(feature = "serde")]
        let custom_identity = crate::sim::history::identity::CustomIdentity::of(&self);
        let replaced = self.replaced();
        let custom_contact = self.custom_contact();
        let custom = std::mem::take(&mut self.custom);
        let interrupt = custom.interrupt.clone();
        let mut contact = ContactModel::new(&self.scene, custom)?;
        let operating_schedule = OperatingSchedule::new(&self.scene)?;
        let plastic = self.scene.plastic.filter(|_| self.plasticity.is_none());
        validate_loads(&self.scene, plastic, &contact.grid, &operating_schedule)?;
        exposure::validate(&self.scene, &operating_schedule, &contact.grid)?;
        let laws = self.laws()?;
        let bodies = [self.body(0, &contact, &laws)?, self.body(1, &contact, &laws)?];
        asperity_inlets::require_no_lay(&self.scene, &contact.grid, bodies.each_ref().map(Body::initial))?;
        let warnings = self.warnings(replaced, &contact, &bodies, &laws);
        contact.face_mobility = self.face_mobility(replaced, &bodies);
        let heat = Heat::new(&self.scene, &contact, &operating_schedule, &laws)?;
        let motion = self.motion.unwrap_or_else(|| self.scene.track.roughness_motion().into());
        let surface_motion = SurfaceMotion { motion, squeeze: self.squeeze };
        let whole = (self.scene, operating_schedule, warnings);
        let mut sim = MixedLubricationSim::assemble(whole, contact, bodies, laws, heat, surface_motion)?;
        sim.contact_start = self.contact_start;
        if sim.scene.solver.estimate
            && let Some(part) = custom_contact
        {
            return Err(SimError::Input(InputError::Conflict {
                field: part.to_owned(),
                reason: "it is known on one grid, an estimate of errors (solver.estimate) needs two"
                    .to_owned(),
            }));
        }
        sim.half_mesh = HalfMesh::new(&sim.scene, &sim.contact, interrupt.clone())?.map(Box::new);
        sim.interrupt = interrupt;
        #[cfg(feature = "serde")]
        let sim = sim.with_custom_identity(custom_identity);
        Ok(sim)
    }

    /// Prepares [`build`](Self::build) and the first step of the history up to the first iteration of its solver,
    /// without solving. Returns the warnings known by then. [`check_contact`](Self::check_contact) is the same
    /// for a single contact.
    ///
    /// # Errors
    /// The input errors of [`build`](Self::build) and of the first step. Some concern a history only: a track
    /// shorter than the patch, a load of the schedule that does not fit into the box or exceeds the pressure
    /// limit.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut scene = Scene::azam_2019(32);
    /// let builder = |scene: &Scene| MixedLubricationSim::builder(scene.clone());
    /// assert!(builder(&scene).check()?.starts_with(&scene.warnings()));
    /// scene.track.radius_disc = Some(1e-6); // the track is shorter than the patch
    /// assert!(builder(&scene).check().is_err() && builder(&scene).check_contact().is_ok());
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn check(self) -> Result<Vec<Warning>, SimError> {
        let mut sim = self.build()?;
        sim.check_first_contact()?;
        Ok(sim.warnings)
    }

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

/// Rejects roughness in motion in a history.
fn require_at_rest(scene: &Scene) -> Result<(), InputError> {
    if scene.motion.roughness.is_at_rest() {
        return Ok(());
    }
    Err(InputError::Conflict {
        field: "motion.roughness = \"moving\"".to_owned(),
        reason:
            "is for single contacts; in a history track.motion says how the roughness moves from step to step"
                .to_owned(),
    })
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
