//! What a solve gives: fields, forces, flows.

use super::GivenFilm;
use super::newton::{self, Solved};
use super::row::{Row, edges, lengths};
use crate::grid::Grid;
use crate::report::{Residuals, SolveReport, Status, Work};
use crate::reynolds::FlowBalance;
use crate::solver_id::SolverId;

/// Pressure, content, forces and flows of a [`GivenFilm`].
///
/// On a grid of one row, one metre wide by custom, forces are in N and flows in m^3/s for that metre.
///
/// # Examples
///
/// A step bearing, 2 um before and 1 um behind its middle, whose pressure is a triangle:
///
/// ```
/// use stribeck::Grid;
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{FilmThickness, GivenFilm};
/// let grid = Grid::from_edges(200, 1, [0.0, 1e-2], [0.0, 1.0])?;
/// let film = FilmThickness::from_function(grid, |x, _| if x < 5e-3 { 2e-6 } else { 1e-6 })?;
/// let oil = Lubricant::new(Barus::new(0.01, 0.0)?, Incompressible);
/// let solution = GivenFilm::new(&film, &oil, [1.0, 0.0]).solve()?;
/// // 6 eta U (h_1 - h_2) / (h_1^3/L_1 + h_2^3/L_2) at the step.
/// let exact = 6.0 * 0.01 * 1e-6 / ((8e-18 + 1e-18) / 5e-3);
/// let found = solution.pressure_at(5e-3, 0).ok_or("no such row")?;
/// assert!((found / exact - 1.0).abs() < 0.02);
/// assert!(solution.pressure_at(0.0, 1).is_none() && solution.reformation(0).is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct GivenFilmSolution {
    /// Pressure at the nodes \[Pa\].
    pub pressure: Vec<f64>,
    /// Content of the nodes: the share of the gap that is filled. In the cell in which the film
    /// reforms it says where.
    pub theta: Vec<f64>,
    /// Integral of the pressure over the box \[N\]; pressures count as they are, ambient ones too.
    pub load: f64,
    /// Shear force of the fluid on the lower and on the upper surface along +x \[N\].
    pub friction: [f64; 2],
    /// What flows into the box and out of it \[m^3/s at the density of zero pressure\]; the imbalance is at
    /// most 1e-10 where the solve converged.
    pub flow: FlowBalance,
    /// Newton steps on grids coarser than that of the film.
    pub coarse_steps: u64,
    /// How the solve ended: `residual.mass` is the sum of the absolute imbalances of all cells over the
    /// inflow, `work.iterations` counts Newton steps on the grid of the film, `work.inner_iterations`
    /// substitutions.
    pub report: SolveReport,
    /// The grid of the film.
    grid: Grid,
    /// Pressure along each row from edge to edge: places \[m\] and values \[Pa\], straight in between.
    profiles: Vec<Vec<[f64; 2]>>,
    /// Where the film reforms first in each row \[m\].
    reformation: Vec<Option<f64>>,
}

impl GivenFilmSolution {
    /// Pressure \[Pa\] at `x` \[m\] in row `row`, straight between the nodes and the places where the film
    /// jumps between them; that of the edges beyond them. None for a row that the grid does not have and an
    /// `x` that is no number.
    pub fn pressure_at(&self, x: f64, row: usize) -> Option<f64> {
        let profile = self.profiles.get(row).filter(|_| !x.is_nan())?;
        let next = profile.partition_point(|point| point[0] < x);
        let (before, after) = (profile.get(next.max(1) - 1)?, profile.get(next).or(profile.last())?);
        let width = after[0] - before[0];
        let share = if width > 0.0 { ((x - before[0]) / width).clamp(0.0, 1.0) } else { 0.0 };
        Some(before[1] + share * (after[1] - before[1]))
    }

    /// Where \[m\] the film reforms first along the flow in row `row`, within its cell; none where it is
    /// full, where it does not reform, and for a row that the grid does not have.
    pub fn reformation(&self, row: usize) -> Option<f64> {
        self.reformation.get(row).copied().flatten()
    }

    /// The grid.
    pub fn grid(&self) -> Grid {
        self.grid
    }
}

/// Solves a problem whose fields are valid; none once `interrupted`.
pub(super) fn solve(problem: &GivenFilm<'_>, interrupted: &dyn Fn() -> bool) -> Option<GivenFilmSolution> {
    let speed = problem.entrainment_speed();
    if speed < 0.0 {
        let film = problem.film.mirrored();
        let speeds = problem.speeds.map(|speed| -speed);
        let mut solution = forward(&GivenFilm { film: &film, speeds, ..*problem }, -speed, interrupted)?;
        solution.mirror();
        Some(solution)
    } else {
        forward(problem, speed, interrupted)
    }
}

/// Solves with entrainment along +x, or none.
fn forward(problem: &GivenFilm<'_>, speed: f64, interrupted: &dyn Fn() -> bool) -> Option<GivenFilmSolution> {
    if speed > 0.0 {
        newton::solve(problem, problem.film, speed, interrupted).map(|solved| moving(problem, speed, solved))
    } else {
        Some(resting(problem))
    }
}

/// Without entrainment pressure is ambient everywhere, and nothing flows.
fn resting(problem: &GivenFilm<'_>) -> GivenFilmSolution {
    let grid = problem.film.grid();
    let pressure = problem.ambient_pressure;
    let viscosity = problem.lubricant.viscosity().viscosity(pressure);
    let ways = (0..grid.ny()).flat_map(|j| (0..=grid.nx()).map(move |i| (i, j)));
    let shear = ways.map(|(i, j)| {
        let lengths = lengths(problem.film, i, j);
        let [first, second] = problem.film.along(i, j).pieces;
        viscosity * (lengths[0] / first.film() + lengths[1] / second.film())
    });
    let drag = shear.sum::<f64>() * (problem.speeds[1] - problem.speeds[0]) * grid.dy();
    let [west, east] = edges(grid);
    GivenFilmSolution {
        pressure: vec![pressure; grid.len()],
        theta: vec![1.0; grid.len()],
        load: pressure * grid.size_x() * grid.size_y(),
        friction: [drag, -drag],
        flow: FlowBalance::default(),
        coarse_steps: 0,
        report: report(Status::Converged, 0.0, 0, 0),
        grid,
        profiles: vec![vec![[west, pressure], [east, pressure]]; grid.ny()],
        reformation: vec![None; grid.ny()],
    }
}

/// The solution entrained with `speed` along +x, above zero.
fn moving(problem: &GivenFilm<'_>, speed: f64, solved: Solved<'_>) -> GivenFilmSolution {
    let grid = problem.film.grid();
    let rows: Vec<Row> = (0..grid.ny()).map(|j| Row::new(problem, &solved, j)).collect();
    let Solved { balance, unknowns, status, residual, through, steps, substitutions, coarse_steps } = solved;
    let unit = speed * grid.dy();
    let sum = |of: fn(&Row) -> f64| rows.iter().map(of).sum::<f64>() * grid.dy();
    GivenFilmSolution {
        pressure: (0..).zip(&unknowns).map(|(k, &s)| balance.pressure(k, s)).collect(),
        theta: unknowns.iter().map(|&s| 1.0 + s.min(0.0)).collect(),
        load: sum(Row::load),
        friction: [sum(|row| row.friction[0]), sum(|row| row.friction[1])],
        flow: FlowBalance {
            inflow: through.inflow * unit,
            outflow: through.outflow * unit,
            imbalance: through.imbalance(),
        },
        coarse_steps,
        report: report(status, residual, steps, substitutions),
        grid,
        reformation: rows.iter().map(|row| row.reformation).collect(),
        profiles: rows.into_iter().map(|row| row.profile).collect(),
    }
}

/// The report of this solver.
fn report(status: Status, mass: f64, iterations: u64, inner_iterations: u64) -> SolveReport {
    SolveReport::new(SolverId::GivenFilm, status, Residuals { mass, ..Residuals::default() })
        .with_work(Work { iterations, inner_iterations, ..Work::default() })
}

impl GivenFilmSolution {
    /// The same with x turned round.
    fn mirror(&mut self) {
        let nx = self.grid.nx();
        for field in [&mut self.pressure, &mut self.theta] {
            field.chunks_exact_mut(nx).for_each(<[f64]>::reverse);
        }
        self.friction = self.friction.map(|force| -force);
        let ends: f64 = edges(self.grid).iter().sum();
        for profile in &mut self.profiles {
            profile.reverse();
            profile.iter_mut().for_each(|point| point[0] = ends - point[0]);
        }
        for place in self.reformation.iter_mut().flatten() {
            *place = ends - *place;
        }
    }
}
