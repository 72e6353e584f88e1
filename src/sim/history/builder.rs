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
use crate::lubricant::{DensityLaw, ViscosityLaw};
use crate::plastic::PlasticityModel;
use crate::reynolds::{ContactSolver, ContactState};
use crate::sim::contact::components::CustomComponents;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::warnings::Warning;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::start::BodyStart;
use crate::sim::scene::Scene;
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
    pub(in crate::sim) measured_rq: [Option<f64>; 2],
    /// Warnings about the files of measured surfaces after reading.
    pub(in crate::sim) file_warnings: Vec<Warning>,
    /// Start of a single contact, or of the first one of a history.
    pub(in crate::sim) contact_start: Option<ContactState>,
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

    /// Interrupts a solve: `asked` is called once per iteration on the solving thread, and between the parts of the
    /// preparation of a single contact. When it returns true, the solve ends with [`SimError::Interrupted`](crate::sim::SimError::Interrupted) and the
    /// simulation is as before the step.
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
}
