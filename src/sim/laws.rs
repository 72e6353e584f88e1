//! The laws of a run.
//!
//! Made by the builder, from the scene or given by the user, and never changed: they have no memory, so that
//! what a step does depends on its contact and its bodies alone.

use std::sync::Arc;

use super::per_body::PerBody;
use crate::boundary_friction::BoundaryFriction;
use crate::plastic::PlasticityModel;
use crate::tribochem::FilmGrowthLaw;
use crate::wear::WearLaw;

/// The laws of a run, shared by its copies; absent ones cost nothing.
#[derive(Debug, Clone)]
pub(super) struct Laws {
    /// The pressure that a node carries; without, bodies are elastic.
    pub(super) plasticity: Option<PerBody<dyn PlasticityModel>>,
    /// Growth of the tribofilm, the same on both bodies; without, there is no film.
    pub(super) growth: Option<Arc<dyn FilmGrowthLaw>>,
    /// Wear; without, nothing wears.
    pub(super) wear: Option<PerBody<dyn WearLaw>>,
    /// Friction coefficient of solid contact.
    pub(super) friction: Arc<dyn BoundaryFriction>,
}
