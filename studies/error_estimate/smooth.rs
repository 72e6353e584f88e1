//! Full-film contacts solved to an accuracy, again on finer meshes, and once more on a box of twice the size;
//! extrapolated values stand for the truth.

use std::error::Error;
use std::io::{self, Write};

use stribeck::Status;
use stribeck::sim::scene::{GridSpec, Load, LubricantSpec};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;

/// Large, so that all films are far above the one at which solids touch; the Moes parameters hold it all.
const RADIUS: f64 = 1.0;
const MODULUS: f64 = 226e9;
const ALPHA: f64 = 2.2e-8;

pub(crate) fn run(accuracy: f64, finest_nodes: usize) -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout();
    writeln!(
        out,
        "| M | L | cells | Hc: error, estimate % | Hmin: error, estimate % | p_max: error, estimate % |"
    )?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    let (mut held, mut total) = ([0; 3], 0);
    for moes_load in [20.0, 50.0, 100.0, 200.0, 500.0, 1000.0] {
        for moes_lubricant in [2.5, 5.0, 10.0, 15.0] {
            let mut scene = contact(moes_load, moes_lubricant);
            scene.grid = GridSpec::Accuracy { accuracy };
            let solution = solve_contact(&scene)?;
            let cells = format!("{} x {}", solution.grid.nx(), solution.grid.ny());
            let (Some(estimate), Some(truth)) =
                (solution.error_estimate, truth(&scene, &solution, finest_nodes)?)
            else {
                writeln!(out, "| {moes_load} | {moes_lubricant} | {cells} | not solved | | |")?;
                continue;
            };
            let estimates = [estimate.film_central, estimate.film_minimum, estimate.pressure_max];
            let mut row = format!("| {moes_load} | {moes_lubricant} | {cells} |");
            for (k, (value, estimate)) in numbers(&solution).into_iter().zip(estimates).enumerate() {
                let error = value / truth[k] - 1.0;
                held[k] += usize::from(error.abs() <= estimate);
                row += &format!(" {:.3}, {:.3} |", 100.0 * error, 100.0 * estimate);
            }
            total += 1;
            writeln!(out, "{row}")?;
        }
    }
    writeln!(
        out,
        "\nheld: central film {}, minimum film {}, maximum pressure {} of {total}",
        held[0], held[1], held[2]
    )?;
    Ok(())
}

/// A smooth contact by its Moes parameters, formed with the sum of the speeds; Roelands viscosity,
/// Dowson-Higginson density.
fn contact(moes_load: f64, moes_lubricant: f64) -> Scene {
    let speed_parameter = (moes_lubricant / (ALPHA * MODULUS)).powi(4);
    let eta0 = 0.04;
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Sphere { radius: RADIUS };
    scene.elastic.equivalent_modulus = MODULUS;
    let force = moes_load * speed_parameter.powf(0.75) * MODULUS * RADIUS * RADIUS;
    scene.load = Load::force(force);
    scene.motion.entrainment_speed = 0.5 * speed_parameter * MODULUS * RADIUS / eta0;
    scene.lubricant = Some(
        LubricantSpec::roelands(eta0, 0.68)
            .with_alpha(Some(ALPHA))
            .with_density_a(0.34 / 5.9e8)
            .with_density_b(1.0 / 5.9e8),
    );
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.wear = None;
    scene
}

fn numbers(solution: &ContactSolution) -> [f64; 3] {
    [solution.film.central, solution.film.minimum, solution.pressure.max]
}

/// Numbers of the truth: extrapolated from meshes two and four times finer (from the solution's own and the
/// one two times finer where four times is too fine), films times what a box of twice the size changes on a
/// coarser mesh.
fn truth(
    scene: &Scene,
    solution: &ContactSolution,
    finest: usize,
) -> Result<Option<[f64; 3]>, Box<dyn Error>> {
    let grid = solution.grid;
    let (nx, ny) = (grid.nx(), grid.ny());
    let edges = |first: f64, step: f64, n: usize| [first - 0.5 * step, first + (n as f64 - 0.5) * step];
    let (x, y) = (edges(grid.x(0), grid.dx(), nx), edges(grid.y(0), grid.dy(), ny));
    let mut scene = scene.clone();
    let mut solved = |nx, ny, x, y| -> Result<Option<[f64; 3]>, Box<dyn Error>> {
        scene.grid = GridSpec::Cells { nx, ny, x, y };
        let solution = solve_contact(&scene)?;
        Ok((solution.report.status == Status::Converged).then(|| numbers(&solution)))
    };
    let mut values = vec![numbers(solution)];
    for factor in [2, 4] {
        if factor * factor * grid.len() > finest {
            break;
        }
        let Some(finer) = solved(factor * nx, factor * ny, x, y)? else { break };
        values.push(finer);
    }
    // Cells keep their size and place: whole cells are added on every side but the outlet.
    let inlet = (-x[0] / grid.dx()).round() as usize / 2;
    let wide =
        [y[0] - ny.div_euclid(4) as f64 * 2.0 * grid.dy(), y[1] + ny.div_euclid(4) as f64 * 2.0 * grid.dy()];
    let long = [x[0] - 2.0 * inlet as f64 * grid.dx(), x[1]];
    let own = solved(nx / 2, ny / 2, x, y)?;
    let large = solved(nx / 2 + inlet, ny / 2 + 2 * (ny / 4), long, wide)?;
    let ([.., coarse, fine], Some(own), Some(large)) = (values.as_slice(), own, large) else {
        return Ok(None);
    };
    Ok(Some(std::array::from_fn(|k| {
        let by_box = if k < 2 { large[k] / own[k] } else { 1.0 };
        (fine[k] + (fine[k] - coarse[k]) / 3.0) * by_box
    })))
}
