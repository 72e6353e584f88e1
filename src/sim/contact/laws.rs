//! The laws of a run.
//!
//! Made by the builder, from the scene or given by the user, and never changed: they have no memory, so that
//! what a step does depends on its contact and its bodies alone.

use std::sync::Arc;

use crate::boundary_friction::BoundaryFriction;
use crate::plastic::PlasticityModel;
use crate::sim::contact::per_body::PerBody;
use crate::tribochem::FilmGrowthLaw;
use crate::wear::WearLaw;

/// The laws of a run, shared by its copies; absent ones cost nothing.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Laws {
    /// The pressure that a node carries; without, bodies are elastic.
    pub(in crate::sim) plasticity: Option<PerBody<dyn PlasticityModel>>,
    /// Growth of the tribofilm, the same on both bodies; without, there is no film.
    pub(in crate::sim) growth: Option<Arc<dyn FilmGrowthLaw>>,
    /// Wear; without, nothing wears.
    pub(in crate::sim) wear: Option<PerBody<dyn WearLaw>>,
    /// Friction coefficient of solid contact.
    pub(in crate::sim) friction: Arc<dyn BoundaryFriction>,
}
