//! The table `solver` of a scene, and what holds where it leaves a choice open.
//!
//! Schemes that are not named follow from the contact definition and, for the flow by pressure, from whether
//! the bodies are rough.

use super::Scene;
use crate::reynolds::{Cavitation, ContactDefinition, FaceMobility, LubricatedContact, Scheme, StoppingRule};
use crate::with_fields::with_fields;

/// How the contact problem is solved.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{SolverKind, SolverSpec};
/// let spec = SolverSpec::default().with_kind(SolverKind::NewtonKrylov).with_tolerance(1e-5);
/// assert_eq!((spec.film_cutoff, spec.max_iterations), (1e-9, 20_000));
/// assert!(spec.scheme.is_none()); // that of the contact definition
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct SolverSpec {
    /// Which solver.
    pub kind: SolverKind,
    /// Bound for every residual.
    pub tolerance: f64,
    /// Largest number of outer iterations.
    pub max_iterations: u64,
    /// What entrainment carries through faces; none for that of the contact definition, see
    /// [`Scene::scheme`].
    pub scheme: Option<Scheme>,
    /// Pressure flow through the faces; none for that of the contact definition, see
    /// [`Scene::face_mobility`].
    pub face_mobility: Option<FaceMobility>,
    /// What holds where the fluid cavitates.
    pub cavitation: Option<Cavitation>,
    /// Film thickness at which solids touch \[m\].
    pub film_cutoff: f64,
    /// What solid contact is.
    pub contact: ContactDefinition,
    /// Whether errors are estimated by a second solve on half the cells along each side; single contacts on a
    /// given grid only.
    pub estimate: bool,
    /// Cells of a given grid are halved until the largest of four estimated errors, those of load and area
    /// ratio and the relative ones of mean film and friction, is at most this; single contacts only.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub accuracy: Option<f64>,
    /// Whether a dry contact may reach the edge of the box.
    pub edge_contact: bool,
    /// Under-relaxation of the semi-system sweeps of the paper's contact.
    pub relaxation: f64,
    /// Stiffening of the implicit deformation in these sweeps.
    pub stiffness: f64,
}

with_fields!(SolverSpec {
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

/// The solvers a scene can name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum SolverKind {
    /// By what the scene holds, with fallback.
    Auto,
    /// Full multigrid.
    Multigrid,
    /// Semi-system line sweeps.
    SemiSystem,
    /// Semismooth Newton with Krylov steps.
    NewtonKrylov,
    /// Dry contact; a lubricant in the scene is left out.
    Dry,
}

impl Scene {
    /// Whether the contact is solved with a lubricant.
    pub fn is_lubricated(&self) -> bool {
        self.lubricant.is_some() && self.solver.kind != SolverKind::Dry
    }

    /// What entrainment carries through faces: the scheme named in `solver`, else the default, of first order
    /// in the paper's contact as published.
    pub fn scheme(&self) -> Scheme {
        self.solver.scheme.unwrap_or(match self.solver.contact {
            ContactDefinition::Hard => Scheme::default(),
            ContactDefinition::UnifiedReynolds => Scheme::FirstOrder,
        })
    }

    /// What holds where the fluid cavitates: the condition named in `solver`, else the default, Reynolds'
    /// condition in the paper's contact as published.
    pub fn cavitation(&self) -> Cavitation {
        self.solver.cavitation.unwrap_or(match self.solver.contact {
            ContactDefinition::Hard => Cavitation::default(),
            ContactDefinition::UnifiedReynolds => Cavitation::Reynolds,
        })
    }

    /// The pressure flow through faces: the one named in `solver`, else that which knows edges of contacts
    /// within a cell between rough surfaces, that of a film which is linear between nodes between smooth
    /// ones, whose inlets are resolved, and arithmetic means in the paper's contact as published.
    pub fn face_mobility(&self) -> FaceMobility {
        self.face_mobility_between(self.is_smooth())
    }

    /// The same between bodies that are `smooth` or not, whatever the scene says of their roughness.
    pub(in crate::sim) fn face_mobility_between(&self, smooth: bool) -> FaceMobility {
        self.solver.face_mobility.unwrap_or(match self.solver.contact {
            ContactDefinition::Hard if smooth => FaceMobility::Wedge,
            ContactDefinition::Hard => FaceMobility::Inlet,
            ContactDefinition::UnifiedReynolds => FaceMobility::Arithmetic,
        })
    }
}
