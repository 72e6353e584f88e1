//! One contact of the reference: its surfaces, its solve, its line of the table.

use std::error::Error;

use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::metrics;
use stribeck::reynolds::{
    ContactDefinition, ContactSolver, ContactState, LubricatedContact, NewtonKrylov, StoppingRule,
};
use stribeck::sim::Scene;
use stribeck::surface::{Autocorrelation, Heights, RoughnessSpec, generate};
use stribeck::{Grid, Status};

use super::plan::{Run, SURFACE_CELLS};

/// Newton steps of a solve; what takes more has not converged.
const MOST_STEPS: u64 = 100;

pub(crate) const COLUMNS: &str = "scene,entrainment_speed_m_per_s,cavitation,face_mobility,seed,cells,status,convolutions,\
     area_ratio,load_ratio,mean_film_m,friction_coefficient";

/// A contact and what became of it.
#[derive(Debug, Clone)]
pub(crate) struct Row {
    pub(crate) run: Run,
    status: String,
    convolutions: f64,
    /// Area ratio, load ratio, mean film \[m\] and friction coefficient.
    pub(crate) values: [f64; 4],
}

impl Row {
    pub(crate) fn converged(&self) -> bool {
        self.status == "converged"
    }

    pub(crate) fn line(&self) -> String {
        let [area, share, film, friction] = self.values;
        format!(
            "{},{},{:.0},{area:.6},{share:.6},{film:.5e},{friction:.6}",
            self.run.key(),
            self.status,
            self.convolutions
        )
    }

    /// The row of `run` among the lines of a table.
    pub(crate) fn find(run: Run, lines: &[String]) -> Option<Self> {
        let key = run.key() + ",";
        let rest = lines.iter().find_map(|line| line.strip_prefix(&key))?;
        let fields: Vec<&str> = rest.split(',').collect();
        let number = |k: usize| fields.get(k)?.parse::<f64>().ok();
        Some(Self {
            run,
            status: (*fields.first()?).to_owned(),
            convolutions: number(1)?,
            values: [number(2)?, number(3)?, number(4)?, number(5)?],
        })
    }
}

/// Solves the contact of `run` from `start`, or from the dry contact.
pub(crate) fn solve(run: Run, start: Option<ContactState>) -> Result<(Row, ContactState), Box<dyn Error>> {
    let scene = run.scene();
    let (grid, hertz) = (scene.grid()?, scene.hertz()?);
    let gap = gap(run, &scene, grid)?;
    let (spec, plastic) = scene.lubricant.zip(scene.plastic).ok_or("the scene has oil and a hardness")?;
    let lubricant = Lubricant::new(
        Roelands::new(spec.eta0, spec.roelands_z, spec.roelands_p0)?,
        DowsonHigginson::new(spec.density_a, spec.density_b)?,
    );
    let limit = vec![plastic.hardness; grid.len()];
    let mut deformation = HalfSpace::new(grid, scene.elastic.equivalent_modulus)?;
    let mut problem = LubricatedContact::new(
        &gap,
        &mut deformation,
        hertz.force,
        (hertz.half_width_x, hertz.half_width_y),
        hertz.pressure,
    )
    .with_lubricant(Some(&lubricant))
    .with_entrainment_speed(run.speed)
    .with_pressure_limit(Some(&limit))
    .with_film_cutoff(scene.solver.film_cutoff)
    .with_contact(ContactDefinition::Hard)
    .with_scheme(scene.scheme())
    .with_face_mobility(scene.face_mobility())
    .with_cavitation(scene.cavitation());
    let mut state = start.unwrap_or_else(|| ContactState::new(&grid));
    let report = NewtonKrylov::new().solve(
        &mut problem,
        &mut state,
        &StoppingRule::default().with_max_iterations(MOST_STEPS),
    )?;
    let status = report.status;
    let row = Row {
        run,
        status: status.to_string(),
        convolutions: report.work.convolutions,
        values: numbers(&scene, grid, &lubricant, &state)?,
    };
    Ok((row, if status == Status::Converged { state } else { ContactState::new(&grid) }))
}

/// The undeformed gap: the ball on the flat less the heights of both, which are those of a coarse mesh by
/// their Fourier series.
fn gap(run: Run, scene: &Scene, grid: Grid) -> Result<Vec<f64>, Box<dyn Error>> {
    let coarse = Run { cells: SURFACE_CELLS, ..run }.scene().grid()?;
    let mut gap = vec![0.0; grid.len()];
    scene.form.gap_into(&grid, &mut gap)?;
    for (rq, seed) in run.miniature.rq.into_iter().zip([2 * run.seed - 1, 2 * run.seed]) {
        let length = run.miniature.length;
        let autocorrelation = Autocorrelation::Gaussian;
        let spec = RoughnessSpec { autocorrelation, rq, length_x: length, length_y: length, seed };
        let heights = generate(&coarse, &spec)?;
        let surface =
            Heights::new(coarse.nx(), coarse.ny(), Some([coarse.dx(), coarse.dy()]), heights, None)?;
        let fine = surface.resample_fourier(grid.nx(), grid.ny())?;
        for (gap, height) in gap.iter_mut().zip(fine.heights()) {
            *gap -= height;
        }
    }
    Ok(gap)
}

/// Area ratio, load ratio, mean film \[m\] and friction coefficient.
fn numbers(
    scene: &Scene,
    grid: Grid,
    lubricant: &Lubricant,
    state: &ContactState,
) -> Result<[f64; 4], Box<dyn Error>> {
    let hertz = scene.hertz()?;
    let solid: Vec<f64> = (0..grid.len()).map(|k| state.solid_pressure(k)).collect();
    let contact = metrics::contact_statistics(
        &grid,
        &state.in_contact,
        &solid,
        hertz.force,
        hertz.half_width_x,
        hertz.half_width_y,
    )?;
    let mut viscosity = vec![0.0; grid.len()];
    lubricant.viscosity().fill(&state.fluid_pressure, &mut viscosity);
    let mut shear = vec![0.0; grid.len()];
    let rheology = scene.friction.rheology()?;
    metrics::viscous_shear_into(
        &viscosity,
        &state.film,
        scene.motion.sliding_speed(),
        &rheology,
        &mut shear,
    )?;
    let boundary = scene.friction.boundary_coefficient;
    Ok([
        contact.area_ratio,
        contact.load_ratio,
        metrics::mean_central_film(&grid, &state.film, hertz.half_width_x, hertz.half_width_y)?,
        metrics::friction_coefficient(&grid, boundary, &solid, &shear, hertz.force)?,
    ])
}

/// A state of `n` by `n` cells on twice as many along each side: linear between their centres, flags of
/// contact from the nearest.
pub(crate) fn finer(state: &ContactState, n: usize) -> ContactState {
    let nodes = || (0..4 * n * n).map(|k| (k % (2 * n), k / (2 * n)));
    let neighbour =
        |k: usize| if k.is_multiple_of(2) { (k / 2).saturating_sub(1) } else { (k / 2 + 1).min(n - 1) };
    let linear = |field: &[f64]| -> Vec<f64> {
        let value = |(i, j): (usize, usize)| {
            let (i, j, near_i, near_j) = (i / 2, j / 2, neighbour(i), neighbour(j));
            let beside = field[j * n + near_i] + field[near_j * n + i];
            (9.0 * field[j * n + i] + 3.0 * beside + field[near_j * n + near_i]) / 16.0
        };
        nodes().map(value).collect()
    };
    let mut finer = state.clone();
    finer.pressure = linear(&state.pressure);
    finer.fluid_pressure = linear(&state.fluid_pressure);
    finer.film = linear(&state.film);
    finer.plastic_depth = linear(&state.plastic_depth);
    finer.theta = linear(&state.theta);
    finer.mass = linear(&state.mass);
    finer.in_contact = nodes().map(|(i, j)| state.in_contact[j / 2 * n + i / 2]).collect();
    finer
}
