//! Scene files of flat contacts.

use serde::Deserialize;

use super::{FlatContact, FlatLoad};
use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::StoppingRule;
use crate::sim::scene::{Elastic, Materials, RoughnessPair};

/// A scene file with `form.kind = "flat"`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FlatFile {
    #[expect(dead_code, reason = "its only value is checked by reading it")]
    form: FlatForm,
    #[serde(default)]
    elastic: Elastic,
    #[serde(default)]
    materials: Materials,
    load: LoadTable,
    grid: GridTable,
    #[serde(default)]
    roughness: RoughnessPair,
    plastic: Option<PlasticTable>,
    #[serde(default)]
    solver: SolverTable,
}

/// `[form]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FlatForm {
    #[expect(dead_code, reason = "its only value is checked by reading it")]
    kind: FlatKind,
}

/// Value of `kind` in `[form]`.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
enum FlatKind {
    Flat,
}

/// `[load]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LoadTable {
    mean_pressure: Option<f64>,
    mean_gap: Option<f64>,
}

/// `[grid]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GridTable {
    periodic: bool,
    nx: usize,
    ny: usize,
    x: [f64; 2],
    y: [f64; 2],
}

/// `[plastic]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlasticTable {
    hardness: f64,
}

/// `[solver]`.
#[derive(Deserialize)]
#[serde(default, deny_unknown_fields)]
struct SolverTable {
    tolerance: f64,
    max_iterations: u64,
}

impl Default for SolverTable {
    fn default() -> Self {
        let StoppingRule { tolerance, max_iterations } = StoppingRule::default();
        Self { tolerance, max_iterations }
    }
}

fn conflict(field: &str, reason: &str) -> InputError {
    InputError::Conflict { field: field.to_owned(), reason: reason.to_owned() }
}

impl FlatFile {
    /// The contact; a table that it does not use is an error.
    pub(super) fn contact(self) -> Result<FlatContact, InputError> {
        let Self { elastic, materials, load, grid, roughness, plastic, solver, .. } = self;
        if !grid.periodic {
            return Err(conflict("grid.periodic = false", "a flat contact is a cell that repeats; use true"));
        }
        let unused = [
            ("elastic.layer", elastic.layer.is_some()),
            ("elastic.tribofilm", elastic.tribofilm.is_some()),
            ("materials.*.conductivity", materials.bodies().iter().any(|body| body.conductivity.is_some())),
            ("materials.*.diffusivity", materials.bodies().iter().any(|body| body.diffusivity.is_some())),
        ];
        if let Some((field, _)) = unused.into_iter().find(|(_, given)| *given) {
            return Err(conflict(field, "a flat contact does not use it; leave it out"));
        }
        let load = match (load.mean_pressure, load.mean_gap) {
            (Some(pressure), None) => FlatLoad::MeanPressure(pressure),
            (None, Some(gap)) => FlatLoad::MeanGap(gap),
            (Some(_), Some(_)) => return Err(conflict("load", "give mean_pressure or mean_gap, not both")),
            (None, None) => return Err(conflict("load", "mean_pressure or mean_gap is missing")),
        };
        let own = materials.bodies().into_iter().filter_map(|body| body.hardness).reduce(f64::min);
        let common = plastic.map(|plastic| plastic.hardness);
        if let (Some(hardness), None) = (own, common) {
            return Err(InputError::Conflict {
                field: format!("materials.*.hardness = {hardness:e}"),
                reason: "the scene has no table [plastic]".to_owned(),
            });
        }
        let hardness = common
            .map(|common| materials.bodies().map(|body| body.hardness.unwrap_or(common)))
            .map(|[ball, disc]| ball.min(disc));
        Ok(FlatContact {
            equivalent_modulus: elastic.modulus_with(&materials)?,
            load,
            grid: Grid::from_edges(grid.nx, grid.ny, grid.x, grid.y)?,
            roughness,
            hardness,
            tolerance: solver.tolerance,
            max_iterations: solver.max_iterations,
        })
    }
}
