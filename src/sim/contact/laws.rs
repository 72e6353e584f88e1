//! The laws of a run.
//!
//! The builder makes them from the scene or from custom laws. They are stateless, so that a step depends only on its
//! contact and bodies.

use std::sync::Arc;

use crate::boundary_friction::BoundaryFriction;
use crate::plastic::PlasticityModel;
use crate::sim::contact::per_body::PerBody;
use crate::tribochem::FilmGrowthLaw;
use crate::wear::WearLaw;

/// The laws of a run, shared by its clones.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Laws {
    /// Pressure limit; `None` for elastic bodies.
    pub(in crate::sim) plasticity: Option<PerBody<dyn PlasticityModel>>,
    /// Growth of the tribofilm, the same on both bodies; `None` for no film.
    pub(in crate::sim) growth: Option<Arc<dyn FilmGrowthLaw>>,
    /// Wear; `None` for no wear.
    pub(in crate::sim) wear: Option<PerBody<dyn WearLaw>>,
    /// Boundary friction coefficient.
    pub(in crate::sim) friction: Arc<dyn BoundaryFriction>,
}
