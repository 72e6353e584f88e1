//! The table `solver` of a scene, and its defaults that depend on other tables.
//!
//! The default schemes are those of the contact definition.

use super::Scene;
use crate::reynolds::{Cavitation, ContactDefinition, FaceMobility, LubricatedContact, Scheme, StoppingRule};
use crate::with_fields::with_fields;

/// Solver of the contact problem and its settings.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{SolverKind, SolverSpec};
/// let spec = SolverSpec::default().with_kind(SolverKind::NewtonKrylov).with_tolerance(1e-5);
/// assert_eq!((spec.film_cutoff, spec.max_iterations), (1e-9, 20_000));
/// assert!(spec.scheme.is_none()); // follows from the contact definition
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct SolverSpec {
    /// Whether the inlets of asperities are resolved or modelled.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "SolverModel::is_resolved"))]
    pub model: SolverModel,
    /// The solver.
    pub kind: SolverKind,
    /// Upper bound of every residual at convergence.
    pub tolerance: f64,
    /// Largest number of outer iterations.
    pub max_iterations: u64,
    /// Entrainment flux through faces; `None` for the default of the contact definition, see
    /// [`Scene::scheme`].
    pub scheme: Option<Scheme>,
    /// Pressure flow through faces; `None` for the default of the contact definition, see
    /// [`Scene::face_mobility`].
    pub face_mobility: Option<FaceMobility>,
    /// Cavitation condition; `None` for the default, see [`Scene::cavitation`].
    pub cavitation: Option<Cavitation>,
    /// Film thickness of solid contact \[m\].
    pub film_cutoff: f64,
    /// Definition of solid contact.
    pub contact: ContactDefinition,
    /// Whether errors are estimated by a second solve on half the cells along each side. Single contacts on a given
    /// grid only.
    pub estimate: bool,
    /// Target error. Cells of a given grid are halved until the estimated errors of load ratio and area ratio and
    /// the relative errors of mean film and friction are all at most this. Single contacts only.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub accuracy: Option<f64>,
    /// Whether a dry contact may touch the edge of the box.
    pub edge_contact: bool,
    /// Under-relaxation of the semi-system sweeps for the paper's contact.
    pub relaxation: f64,
    /// Stiffness factor of the implicit deformation in these sweeps.
    pub stiffness: f64,
}

with_fields!(SolverSpec {
    with_model model: SolverModel,
    with_kind kind: SolverKind,
    with_tolerance tolerance: f64,
    with_max_iterations max_iterations: u64,
    with_scheme scheme: Option<Scheme>,
    with_face_mobility face_mobility: Option<FaceMobility>,
    with_cavitation cavitation: Option<Cavitation>,
    with_film_cutoff film_cutoff: f64,
    with_contact contact: ContactDefinition,
    with_estimate estimate: bool,
    with_accuracy accuracy: Option<f64>,
    with_edge_contact edge_contact: bool,
    with_relaxation relaxation: f64,
    with_stiffness stiffness: f64,
});

impl Default for SolverSpec {
    fn default() -> Self {
        let StoppingRule { tolerance, max_iterations } = StoppingRule::default();
        Self {
            model: SolverModel::Resolved,
            kind: SolverKind::Auto,
            tolerance,
            max_iterations,
            scheme: None,
            face_mobility: None,
            cavitation: None,
            film_cutoff: LubricatedContact::FILM_CUTOFF,
            contact: ContactDefinition::default(),
            estimate: false,
            accuracy: None,
            edge_contact: false,
            relaxation: 0.2,
            stiffness: 6.0,
        }
    }
}

/// Treatment of the inlets of asperities.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{SolverModel, SolverSpec};
/// assert_eq!(SolverSpec::default().model, SolverModel::Resolved);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SolverModel {
    /// The Reynolds equation at every node.
    #[default]
    Resolved,
    /// A dry contact and the inlets of its asperities ([`AsperityInlets`](crate::reynolds::AsperityInlets)).
    AsperityInlets,
}

impl SolverModel {
    /// Whether the Reynolds equation is solved at every node.
    pub fn is_resolved(&self) -> bool {
        *self == Self::Resolved
    }
}

/// Solvers of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SolverKind {
    /// Chosen by the contents of the scene, with fallback.
    Auto,
    /// Full multigrid.
    Multigrid,
    /// Line sweeps of the semi-system method.
    SemiSystem,
    /// Semismooth Newton with Krylov steps.
    NewtonKrylov,
    /// Dry contact; a lubricant in the scene is ignored.
    Dry,
}

impl Scene {
    /// Whether the contact is solved with a lubricant.
    pub fn is_lubricated(&self) -> bool {
        self.lubricant.is_some() && self.solver.kind != SolverKind::Dry
    }

    /// Entrainment flux through faces: the scheme named in `solver`, or the
    /// [default](ContactDefinition::default_scheme) of the contact definition.
    pub fn scheme(&self) -> Scheme {
        self.solver.scheme.unwrap_or_else(|| self.solver.contact.default_scheme())
    }

    /// The cavitation condition named in `solver`, or the [default](ContactDefinition::default_cavitation) of the
    /// contact definition.
    pub fn cavitation(&self) -> Cavitation {
        self.solver.cavitation.unwrap_or_else(|| self.solver.contact.default_cavitation())
    }

    /// Pressure flow through faces: the law named in `solver`, or the
    /// [default](ContactDefinition::default_face_mobility) of the contact definition between bodies that are smooth or
    /// not.
    pub fn face_mobility(&self) -> FaceMobility {
        self.face_mobility_between(self.is_smooth())
    }

    /// The face mobility between bodies that are `smooth` or not, whatever the roughness of the scene.
    pub(in crate::sim) fn face_mobility_between(&self, smooth: bool) -> FaceMobility {
        self.solver.face_mobility.unwrap_or_else(|| self.solver.contact.default_face_mobility(smooth))
    }
}
