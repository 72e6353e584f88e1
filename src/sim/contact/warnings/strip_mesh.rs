//! Warnings about the mesh of a rough strip: cells that are long along the flow, and those of a mixed strip without an error
//! estimate.

use super::{Warning, short};
use crate::sim::scene::{Scene, ShortestWaves};

/// Load ratios of the mixed regime. Load ratio and friction depend on the mesh there (`docs/mixed.md`).
const MIXED: std::ops::RangeInclusive<f64> = 0.1..=0.9;
/// Cells in the shortest wave with errors of a few hundredths of the load ratio in the mixed regime: 1 um in 15.6 um of
/// `docs/mixed.md`.
const CELLS_IN_WAVE: f64 = 16.0;

/// Length of the cells along the flow over their width up to which all of 12 mixed strips converge in 20 to 70 steps; at 4
/// and 5 most stall (`journal/newton.md`).
const LONGEST_CELL: f64 = 3.3;

/// Cells of a lubricated rough strip that are long along the flow.
pub(super) fn long_cells(scene: &Scene) -> Option<Warning> {
    let is_resolved_model = scene.is_lubricated() && scene.solver.model.is_resolved();
    if !scene.is_strip() || scene.is_smooth() || !is_resolved_model {
        return None;
    }
    let grid = scene.grid().ok()?;
    let ratio = grid.dx() / grid.dy();
    (ratio > LONGEST_CELL).then(|| {
        let least = (grid.size_x() / (LONGEST_CELL * grid.dy())).ceil();
        Warning::new(
            "grid.nx",
            grid.nx() as f64,
            format!("the cells are {ratio:.1} times as long along the flow as across it: mixed strips often do not converge"),
            format!("at least {least} cells along x, or fewer along y"),
        )
    })
}

/// Cells of a rough strip too wide for its `load_ratio`. Roughness without a known shortest wave counts as unresolved.
pub(super) fn coarse_strip(scene: &Scene, load_ratio: f64) -> Option<Warning> {
    let is_resolved_model = scene.is_lubricated() && scene.solver.model.is_resolved();
    if !scene.is_strip() || !is_resolved_model || !MIXED.contains(&load_ratio) {
        return None;
    }
    let grid = scene.grid().ok()?;
    let widest = |lengths: [f64; 2]| (grid.dx() / lengths[0]).max(grid.dy() / lengths[1]);
    let bodies = [&scene.roughness.ball, &scene.roughness.disc];
    let cell_in_wave = bodies.map(|roughness| match roughness.shortest_waves() {
        ShortestWaves::Of(lengths) => widest(lengths),
        _ => f64::INFINITY,
    });
    let cell_in_wave = cell_in_wave[0].max(cell_in_wave[1]);
    (cell_in_wave * CELLS_IN_WAVE > 1.0 + 1e-9).then(|| {
        let cells = if cell_in_wave.is_finite() {
            format!(
                "the cells are 1/{:.1} of the shortest waves of the roughness, wider than 1/{CELLS_IN_WAVE}",
                1.0 / cell_in_wave
            )
        } else {
            "the shortest waves of the roughness are unknown".to_owned()
        };
        Warning::new(
            "contact.load_ratio",
            load_ratio,
            format!(
                "{cells}: in the mixed regime ({} to {} of the load on solids) load ratio and friction depend on the mesh",
                short(*MIXED.start()),
                short(*MIXED.end())
            ),
            "solver.estimate = true gives the error".to_owned(),
        )
    })
}
