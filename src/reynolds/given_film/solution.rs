//! Results of a solve: fields, forces, flows.

use super::balance::Balance;
use super::newton::{self, Solved};
use super::row::{Row, edges, lengths};
use super::{EAST, Feed, GivenFilm, MeanContact, NORTH, SOUTH, WEST};
use crate::grid::Grid;
use crate::report::{Residuals, SolveReport, Status, Work};
use crate::reynolds::FlowBalance;
use crate::solver_id::SolverId;

/// Pressure, film fraction, forces and flows of a [`GivenFilm`].
///
/// On a grid of one row, one meter wide by convention, forces are in N and flows in m^3/s for that meter.
///
/// # Examples
///
/// A step bearing with films of 2 um and 1 um, and a triangular pressure:
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
    /// Film fraction of the nodes. In the cell of reformation it gives the position of the front.
    pub theta: Vec<f64>,
    /// Integral of the pressure over the box \[N\], ambient pressure and contact included.
    pub load: f64,
    /// Shear force of the fluid on the lower and on the upper surface along +x \[N\], `S - P` and `-S - P`, with
    /// the integrals `S` of `theta eta (u_2 - u_1)/h` and `P` of `h/2 dp/dx`. Rough surfaces have factors of both and the friction of contact.
    pub friction: [f64; 2],
    /// Part of `S` in cavitated fluid, where the film fraction is below one \[N\], its absolute value.
    pub cavitated_shear: f64,
    /// Flow out through the edges of the smallest and largest x, and of the smallest and largest y
    /// \[m^3/s at the density of zero pressure\]; negative where fluid enters.
    pub edge_flows: [f64; 4],
    /// Flow into the film from each feed \[m^3/s at the density of zero pressure\].
    pub feed_flows: Vec<f64>,
    /// Flow out through both edges across y, less the flow in \[m^3/s at the density of zero pressure\].
    pub side_flow: f64,
    /// Power of both surfaces against friction \[W\]: less the sum of forces times speeds.
    pub power_loss: f64,
    /// Solid contact of rough surfaces.
    pub contact: Option<MeanContact>,
    /// Flow into and out of the box and the feeds \[m^3/s at the density of zero pressure\]; the imbalance is at most 1e-10
    /// if the solve converged.
    pub flow: FlowBalance,
    /// Newton steps on grids coarser than that of the film.
    pub coarse_steps: u64,
    /// Status and work. `residual.mass` is the sum of the absolute imbalances of all cells over the inflow,
    /// `work.iterations` counts Newton steps on the grid of the film, `work.inner_iterations` substitutions.
    pub report: SolveReport,
    /// The grid of the film.
    grid: Grid,
    /// Pressure along each row from edge to edge: positions \[m\] and values \[Pa\], linear in between.
    profiles: Vec<Vec<[f64; 2]>>,
    /// Position of the first reformation in each row \[m\].
    reformation: Vec<Option<f64>>,
}

impl GivenFilmSolution {
    /// Pressure \[Pa\] at `x` \[m\] in row `row`, interpolated linearly between the nodes and the film jumps.
    /// Beyond the edges it is the edge pressure. `None` for a row outside the grid or if `x` is NaN.
    pub fn pressure_at(&self, x: f64, row: usize) -> Option<f64> {
        let profile = self.profiles.get(row).filter(|_| !x.is_nan())?;
        let next = profile.partition_point(|point| point[0] < x);
        let (before, after) = (profile.get(next.max(1) - 1)?, profile.get(next).or(profile.last())?);
        // Linear between two points of the profile.
        let width = after[0] - before[0];
        let share = if width > 0.0 { ((x - before[0]) / width).clamp(0.0, 1.0) } else { 0.0 };
        Some(before[1] + share * (after[1] - before[1]))
    }

    /// Positions \[m\] and pressures \[Pa\] along row `row` from edge to edge, linear in between. `None` for a
    /// row outside the grid.
    pub fn profile(&self, row: usize) -> Option<&[[f64; 2]]> {
        self.profiles.get(row).map(Vec::as_slice)
    }

    /// Position \[m\] of the first reformation along the flow in row `row`, resolved within its cell. `None`
    /// for a full film, without reformation, or for a row outside the grid.
    pub fn reformation(&self, row: usize) -> Option<f64> {
        self.reformation.get(row).copied().flatten()
    }

    /// Makes a converged film of a search that is not `is_found` one that is not converged.
    pub(crate) fn mark_search(&mut self, is_found: bool) {
        if !is_found && self.report.status == Status::Converged {
            self.report.status = Status::MaxIterations;
        }
    }

    /// Adds the flow `through` \[m^3/s\] out of each side, beside the box.
    pub(in crate::reynolds) fn add_side_flow(&mut self, through: f64) {
        self.edge_flows[SOUTH] += through;
        self.edge_flows[NORTH] += through;
        self.side_flow += 2.0 * through;
    }

    /// The grid.
    pub fn grid(&self) -> Grid {
        self.grid
    }
}

/// Solves a problem with valid fields; `None` if `interrupted`.
pub(super) fn solve(problem: &GivenFilm<'_>, interrupted: &dyn Fn() -> bool) -> Option<GivenFilmSolution> {
    let speed = problem.entrainment_speed();
    // A period has no edges across x.
    let [_, _, south, north] = problem.edge_pressures;
    let edge_pressures =
        if problem.is_periodic { [south, south, south, north] } else { problem.edge_pressures };
    let problem = &GivenFilm { edge_pressures, ..*problem };
    let mut solution = if speed < 0.0 {
        // Flow along -x is solved as its mirror image.
        let film = problem.film.mirrored();
        let speeds = problem.speeds.map(|speed| -speed);
        let [west, east, south, north] = problem.edge_pressures;
        let edge_pressures = [east, west, south, north];
        let ends = edges(film.grid());
        let feeds: Vec<Feed> = problem.feeds.iter().map(|feed| feed.mirrored(ends)).collect();
        let mirrored = GivenFilm { film: &film, speeds, edge_pressures, feeds: &feeds, ..*problem };
        let mut solution = forward(&mirrored, -speed, interrupted)?;
        solution.mirror();
        solution
    } else {
        forward(problem, speed, interrupted)?
    };
    solution.add_contact(problem);
    Some(solution)
}

/// Solves with entrainment along +x or without entrainment.
fn forward(problem: &GivenFilm<'_>, speed: f64, interrupted: &dyn Fn() -> bool) -> Option<GivenFilmSolution> {
    // Without speed and pressure differences the film rests.
    let pressure = problem.edge_pressures[WEST];
    let feeds = problem.feeds.iter().map(|feed| feed.pressure);
    if speed > 0.0
        || problem.edge_pressures.into_iter().chain(feeds).any(|other| (other - pressure).abs() > 0.0)
    {
        newton::solve(problem, problem.film, speed, interrupted).map(|solved| flowing(problem, speed, solved))
    } else {
        Some(resting(problem))
    }
}

/// Without entrainment and with one pressure at all edges and feeds there is no flow.
fn resting(problem: &GivenFilm<'_>) -> GivenFilmSolution {
    let grid = problem.film.grid();
    let pressure = problem.edge_pressures[WEST];
    let viscosity = problem.lubricant.viscosity().viscosity(pressure);
    let first = usize::from(problem.is_periodic);
    let ways = (0..grid.ny()).flat_map(|j| (first..=grid.nx()).map(move |i| (i, j)));
    // Drag of the film under uniform pressure.
    let shear = ways.map(|(i, j)| {
        let lengths = lengths(problem, i, j);
        let [first, second] = problem.interval(problem.film, i, j).pieces;
        viscosity * (lengths[0] / first.film() + lengths[1] / second.film())
    });
    let drag = shear.sum::<f64>() * (problem.speeds[1] - problem.speeds[0]) * grid.dy();
    let [west, east] = edges(grid);
    GivenFilmSolution {
        pressure: vec![pressure; grid.len()],
        theta: vec![1.0; grid.len()],
        load: pressure * grid.size_x() * grid.size_y(),
        friction: [drag, -drag],
        cavitated_shear: 0.0,
        edge_flows: [0.0; 4],
        feed_flows: vec![0.0; problem.feeds.len()],
        side_flow: 0.0,
        power_loss: drag * (problem.speeds[1] - problem.speeds[0]),
        contact: None,
        flow: FlowBalance::default(),
        coarse_steps: 0,
        report: report(Status::Converged, 0.0, 0, 0),
        grid,
        profiles: vec![vec![[west, pressure], [east, pressure]]; grid.ny()],
        reformation: vec![None; grid.ny()],
    }
}

/// The solution with flow: with entrainment at `speed` along +x, or by pressures alone.
fn flowing(problem: &GivenFilm<'_>, speed: f64, solved: Solved<'_>) -> GivenFilmSolution {
    let grid = problem.film.grid();
    let rows: Vec<Row> = (0..grid.ny()).map(|j| Row::new(problem, &solved, j)).collect();
    let Solved { balance, unknowns, status, residual, boundary_flux, steps, substitutions, coarse_steps } =
        solved;
    // Flows in m^3/s, forces summed over the rows.
    let unit = if speed > 0.0 { speed } else { 1.0 } * grid.dy();
    let edge_flows = balance.edge_flows().map(|flow| flow * unit);
    let sum = |of: fn(&Row) -> f64| rows.iter().map(of).sum::<f64>() * grid.dy();
    let friction = [sum(|row| row.friction[0]), sum(|row| row.friction[1])];
    GivenFilmSolution {
        pressure: (0..).zip(&unknowns).map(|(k, &s)| balance.pressure(k, s)).collect(),
        theta: unknowns.iter().map(|&s| 1.0 + s.min(0.0)).collect(),
        load: sum(Row::load),
        friction,
        cavitated_shear: sum(|row| row.cavitated_shear),
        edge_flows,
        feed_flows: feed_flows(problem, &balance).map(|flow| flow * unit).collect(),
        side_flow: edge_flows[SOUTH] + edge_flows[NORTH],
        power_loss: -friction.iter().zip(problem.speeds).map(|(force, speed)| force * speed).sum::<f64>(),
        contact: None,
        flow: FlowBalance {
            inflow: boundary_flux.inflow * unit,
            outflow: boundary_flux.outflow * unit,
            imbalance: boundary_flux.imbalance(),
        },
        coarse_steps,
        report: report(status, residual, steps, substitutions),
        grid,
        reformation: rows.iter().map(|row| row.reformation).collect(),
        profiles: rows.into_iter().map(|row| row.profile).collect(),
    }
}

/// Flow from each feed of `problem` \[m\]; a node in several feeds counts for the first.
fn feed_flows<'p>(problem: &'p GivenFilm<'_>, balance: &'p Balance<'_>) -> impl Iterator<Item = f64> + 'p {
    let grid = problem.film.grid();
    let of = move |point| problem.feeds.iter().position(|feed| feed.contains(point));
    (0..problem.feeds.len()).map(move |index| {
        let nodes = grid.nodes().enumerate().filter(|(_, point)| of(*point) == Some(index));
        nodes.map(|(k, _)| balance.source(k % grid.nx(), k / grid.nx())).sum()
    })
}

/// The report of this solver.
fn report(status: Status, mass: f64, iterations: u64, inner_iterations: u64) -> SolveReport {
    SolveReport::new(SolverId::GivenFilm, status, Residuals { mass, ..Residuals::default() })
        .with_work(Work { iterations, inner_iterations, ..Work::default() })
}

impl GivenFilmSolution {
    /// Mirrors the solution in x.
    fn mirror(&mut self) {
        let nx = self.grid.nx();
        for field in [&mut self.pressure, &mut self.theta] {
            field.chunks_exact_mut(nx).for_each(<[f64]>::reverse);
        }
        self.friction = self.friction.map(|force| -force);
        self.edge_flows.swap(WEST, EAST);
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
