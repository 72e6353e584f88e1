//! Scenes with `solver.model = "asperity_inlets"`: errors for scenes that the law does not hold for, and warnings
//! at the ends of its range.

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::ContactDefinition;
use crate::sim::contact::film_temperature;
use crate::sim::contact::warnings::Warning;
use crate::sim::scene::{GridSpec, Scene, SolverKind};

/// Roughness whose largest root mean square slope of any direction is above this multiple of the smallest has a lay.
const LAY: f64 = 2.0;
/// Slide-roll ratio above which the surfaces move in opposite directions.
const OPPOSITE: f64 = 2.0;
/// Largest smooth film over composite Rq.
const LARGEST_LAMBDA: f64 = 0.5;
/// Words of the warning about cells.
pub(in crate::sim) const WIDE_CELLS: &str = "too wide for the curvature of the asperities";
/// Widest cell over the root mean square height over slope, a length of the asperities.
const WIDEST_CELL: f64 = 0.25;

/// Checks that the scene has nothing that the law leaves out.
pub(in crate::sim) fn validate(scene: &Scene) -> Result<(), InputError> {
    if scene.solver.model.is_resolved() {
        return Ok(());
    }
    let oil = scene.lubricant;
    let found = [
        (oil.is_none(), "it needs a lubricant"),
        (scene.solver.kind != SolverKind::Auto, "solver.kind selects another solver; leave it out"),
        (
            scene.solver.contact != ContactDefinition::Hard,
            "solver.contact = \"paper\" needs the resolved model",
        ),
        (
            oil.is_some_and(|oil| oil.supplied_film.is_some()),
            "it needs a flooded inlet; leave out lubricant.supplied_film",
        ),
        (scene.motion.spin_radius.is_some(), "motion.spin_radius needs the resolved model"),
        (
            scene.motion.slide_roll_ratio.abs() > OPPOSITE,
            "motion.slide_roll_ratio is above 2: surfaces in opposite directions have their inlets on both sides of an \
             asperity; use the resolved model",
        ),
        (scene.friction.flow_thinning.is_some(), "friction.flow_thinning needs the resolved model"),
        (film_temperature::models_film_temperature(scene), "lubricant.thermal needs the resolved model"),
        (
            scene.solver.estimate,
            "solver.estimate = true estimates errors by several meshes, which need the resolved model; leave out solver.estimate",
        ),
        (
            scene.solver.accuracy.is_some(),
            "solver.accuracy estimates errors by several meshes, which need the resolved model; leave out solver.accuracy",
        ),
        (
            matches!(scene.grid, GridSpec::Accuracy { .. }),
            "grid.accuracy estimates errors by several meshes, which need the resolved model; give nx, ny, x and y in its place",
        ),
    ];
    match found.into_iter().find(|(applies, _)| *applies) {
        Some((_, reason)) => Err(conflict(reason.to_owned())),
        None => Ok(()),
    }
}

fn conflict(reason: String) -> InputError {
    InputError::Conflict { field: "solver.model = \"asperity_inlets\"".to_owned(), reason }
}

/// Root mean squares of the combined heights of both bodies and of their slopes along x and y.
pub(in crate::sim) fn height_and_slopes(grid: &Grid, heights: [&[f64]; 2]) -> [f64; 3] {
    let at = |i: usize, j: usize| heights.iter().map(|body| body[j * grid.nx() + i]).sum::<f64>();
    let mut squares = [0.0; 3];
    for j in 0..grid.ny() {
        for i in 0..grid.nx() {
            let here = at(i, j);
            squares[0] += here * here;
            if i > 0 {
                squares[1] += ((here - at(i - 1, j)) / grid.dx()).powi(2);
            }
            if j > 0 {
                squares[2] += ((here - at(i, j - 1)) / grid.dy()).powi(2);
            }
        }
    }
    squares.map(|sum| (sum / grid.len() as f64).sqrt())
}

/// Largest root mean square slope of any direction over the smallest, and the angle of the former to the flow \[rad\].
fn lay(grid: &Grid, heights: [&[f64]; 2]) -> [f64; 2] {
    let [_, along, across] = height_and_slopes(grid, heights);
    // Correlation of both slopes, in the middle between four nodes.
    let at = |i: usize, j: usize| heights.iter().map(|body| body[j * grid.nx() + i]).sum::<f64>();
    let mut sums = [0.0; 3];
    for j in 1..grid.ny() {
        for i in 1..grid.nx() {
            let [rise, turn] = [at(i, j) - at(i - 1, j - 1), at(i, j - 1) - at(i - 1, j)];
            let [x, y] = [rise + turn, rise - turn];
            sums[0] += x * x;
            sums[1] += y * y;
            sums[2] += x * y;
        }
    }
    let scale = (sums[0] * sums[1]).sqrt();
    let correlation = if scale > 0.0 { sums[2] / scale } else { 0.0 };
    let (mean, half) = (0.5 * (along * along + across * across), 0.5 * (along * along - across * across));
    let shear = correlation * along * across;
    let deviation = half.hypot(shear);
    [((mean + deviation) / (mean - deviation).max(0.0)).sqrt(), 0.5 * shear.atan2(half)]
}

/// Rejects combined heights with a lay, whose asperities starve each other or refill from the side.
pub(in crate::sim) fn require_no_lay(
    scene: &Scene,
    grid: &Grid,
    heights: [&[f64]; 2],
) -> Result<(), InputError> {
    if scene.solver.model.is_resolved() {
        return Ok(());
    }
    let [ratio, angle] = lay(grid, heights);
    if ratio.is_nan() || ratio <= LAY {
        return Ok(());
    }
    if grid.ny() == 1 {
        return Err(conflict(
            "the roughness of a line contact is a lay across the flow; use the resolved model".to_owned(),
        ));
    }
    Err(conflict(format!(
        "the roughness has a lay: its root mean square slope at {:.0} degrees to the flow is {ratio:.3} times that at right angles to it, \
         and the law holds up to {LAY}; use the resolved model",
        angle.abs().to_degrees()
    )))
}

/// Warnings about the roughness and the smooth film of a scene with this model.
pub(in crate::sim) fn warnings(
    scene: &Scene,
    grid: &Grid,
    heights: [&[f64]; 2],
    smooth_film: f64,
) -> Vec<Warning> {
    if scene.solver.model.is_resolved() {
        return Vec::new();
    }
    let [rq, along, _] = height_and_slopes(grid, heights);
    let lambda = smooth_film / rq;
    let thick = (lambda > LARGEST_LAMBDA || !lambda.is_finite()).then(|| {
        let film = if lambda.is_finite() {
            format!(
                "the smooth film by formula is {lambda:.3} times the composite Rq, above {LARGEST_LAMBDA}"
            )
        } else {
            "the bodies are smooth".to_owned()
        };
        Warning::new(
            "solver.model",
            f64::NAN,
            format!("{film}: the model leaves out the deformation by the fluid between the asperities"),
            "use the resolved model".to_owned(),
        )
    });
    let widest = WIDEST_CELL * rq / along;
    let coarse = (grid.dx() > widest).then(|| {
        Warning::new(
            "grid.nx",
            grid.nx() as f64,
            format!("cells of {:.3e} m are {WIDE_CELLS}, load ratios err by a tenth or more", grid.dx()),
            format!("use cells of at most {widest:.3e} m"),
        )
    });
    thick.into_iter().chain(coarse).collect()
}
