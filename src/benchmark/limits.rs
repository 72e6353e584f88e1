//! Known results of a case, as limits of fine meshes.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::sim::scene::{GridSpec, SolverSpec};
use crate::sim::{Scene, SimError};

/// A number of a contact.
///
/// ```
/// use stribeck::benchmark::Quantity;
/// assert_eq!(Quantity::MeanFilm.to_string(), "mean_film");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Quantity {
    /// Film thickness at the center \[m\].
    CentralFilm,
    /// Smallest film under pressure \[m\].
    MinimumFilm,
    /// Mean film within two thirds of the Hertz radius \[m\].
    MeanFilm,
    /// Area of solid contact over the Hertz area.
    AreaRatio,
    /// Load on solids over load.
    LoadRatio,
    /// Friction coefficient.
    Friction,
}

impl Quantity {
    /// All quantities, in the order of the columns of a table.
    pub const ALL: [Self; 6] = [
        Self::CentralFilm,
        Self::MinimumFilm,
        Self::MeanFilm,
        Self::AreaRatio,
        Self::LoadRatio,
        Self::Friction,
    ];

    /// Name, a column of a table.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::CentralFilm => "central_film",
            Self::MinimumFilm => "minimum_film",
            Self::MeanFilm => "mean_film",
            Self::AreaRatio => "area_ratio",
            Self::LoadRatio => "load_ratio",
            Self::Friction => "friction",
        }
    }

    /// Error of `value` from `limit`, relative; of ratios that are zero in the limit it is absolute.
    pub fn error(self, value: f64, limit: f64) -> f64 {
        let scale = if limit == 0.0 { 1.0 } else { limit.abs() };
        (value - limit).abs() / scale
    }
}

impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// Limits of quantities as cells and tolerances become small, with their uncertainties, for one scene on any
/// mesh.
///
/// ```
/// use stribeck::benchmark::{Limits, Quantity};
/// use stribeck::sim::Scene;
/// let limits = Limits::of(&Scene::azam_2019(64))?.with(Quantity::LoadRatio, 0.3, 0.01);
/// assert!(limits.is_of(&Scene::azam_2019(128))?); // another mesh
/// assert!(!limits.is_of(&Scene::azam_2019(64).with_tribofilm())?);
/// assert_eq!(limits.get(Quantity::LoadRatio), Some((0.3, 0.01)));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// Fingerprint of the scene.
    scene: String,
    /// Quantities, values and uncertainties.
    values: Vec<(Quantity, f64, f64)>,
}

impl Limits {
    /// Limits of `scene`, without values.
    ///
    /// # Errors
    /// A scene that cannot be written as TOML.
    pub fn of(scene: &Scene) -> Result<Self, SimError> {
        Ok(Self { scene: fingerprint(scene)?, values: Vec::new() })
    }

    /// Limits of the scene with this fingerprint.
    pub(super) fn of_fingerprint(scene: String) -> Self {
        Self { scene, values: Vec::new() }
    }

    /// Adds the limit of `quantity` and its uncertainty.
    #[must_use]
    pub fn with(mut self, quantity: Quantity, value: f64, uncertainty: f64) -> Self {
        self.values.retain(|(other, ..)| *other != quantity);
        self.values.push((quantity, value, uncertainty));
        self
    }

    /// Limit and uncertainty of `quantity`.
    pub fn get(&self, quantity: Quantity) -> Option<(f64, f64)> {
        self.values.iter().find(|(other, ..)| *other == quantity).map(|(_, value, spread)| (*value, *spread))
    }

    /// Whether the limits belong to `scene`. Mesh, solver, tolerance and number of iterations do not count;
    /// discretization, cavitation and contact film do.
    ///
    /// # Errors
    /// A scene that cannot be written as TOML.
    pub fn is_of(&self, scene: &Scene) -> Result<bool, SimError> {
        Ok(self.scene == fingerprint(scene)?)
    }

    /// The largest error of `values`, by quantity, from the limits; `None` without a known quantity.
    pub(super) fn error(&self, values: impl Fn(Quantity) -> f64) -> Option<f64> {
        self.values
            .iter()
            .map(|(quantity, limit, _)| quantity.error(values(*quantity), *limit))
            .reduce(|most, error| if error.is_nan() { error } else { most.max(error) })
    }

    /// The fingerprint of the scene of these limits.
    pub(super) fn scene(&self) -> &str {
        &self.scene
    }
}

/// Identity of a scene on any mesh: 64 bits of its TOML text (FNV-1a), without counts of cells, solver, tolerance
/// and number of iterations.
pub(super) fn fingerprint(scene: &Scene) -> Result<String, SimError> {
    let mut scene = scene.clone();
    let default = SolverSpec::default();
    scene.solver.kind = default.kind;
    scene.solver.tolerance = default.tolerance;
    scene.solver.max_iterations = default.max_iterations;
    if !matches!(scene.grid, GridSpec::Accuracy { .. }) {
        scene.grid = scene.grid.with_nx(1);
    }
    let text = scene.to_toml()?;
    let hash = text.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    Ok(format!("{hash:016x}"))
}
