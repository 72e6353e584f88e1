//! What accuracy costs: errors of four contacts against seconds and convolutions, one line per solver, that
//! of the example `custom_solver` among them; errors of wear and film of a history against its steps.
//!
//! ```text
//! cargo run --release -p studies --bin work_precision                      # docs/work_precision.{csv,svg}, docs/time_steps.csv, minutes
//! cargo run --release -p studies --bin work_precision -- --quick --out DIR # coarse grids, seconds
//! ```
//!
//! Errors are relative differences to a finer grid, solved to 1e-8. Seconds are those of one solve from a
//! cold start with all buffers still to be made, the kernel's spectrum apart: processor time where the system
//! tells it (Linux), so that other programs on the machine matter less, else time on the clock. What did not
//! converge is in the table and not in the figure.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;
#[path = "../../examples/command/quick.rs"]
mod quick;
#[path = "../../examples/custom_solver/steepest_descent.rs"]
mod steepest_descent;
mod stepping;

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use plotters::coord::Shift;
use plotters::prelude::*;
use quick::{Options, options};
use steepest_descent::SteepestDescent;
use stribeck::analytic::FilmConditions;
use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::metrics::{friction_coefficient, mean_central_film, viscous_shear_into};
use stribeck::reynolds::{
    Auto, ContactSolver, ContactState, Dry, FaceMobility, LubricatedContact, Multigrid, NewtonKrylov,
    SemiSystem, StoppingRule,
};
use stribeck::sim::Scene;
use stribeck::sim::scene::{GridSpec, InletSpec, Load};
use stribeck::surface::Form;
use stribeck::{Grid, SolveReport, Status};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin work_precision -- [--quick] [--out DIR]

  --quick    coarse grids and few tolerances
  --out DIR  where to write work_precision.csv and .svg and time_steps.csv (default docs)
";
const TIGHT: f64 = 1e-6;
/// A solve is repeated until it has taken this long \[s\]: the system counts processor time in steps of
/// milliseconds.
const LEAST_SECONDS: f64 = 0.1;
const MOST_REPEATS: f64 = 30.0;
const REFERENCE: f64 = 1e-8;
/// The solver that is not of the crate.
const OWN: &str = "steepest_descent";
/// Newton's method with the other face law that resolves inlets.
const WEDGE: &str = "newton_krylov (wedge)";
/// Root mean square of the roughness and its longest and shortest wavelength \[m\].
const RQ: f64 = 100e-9;
const WAVELENGTHS: (f64, f64) = (100e-6, 25e-6);
const WAVES: u32 = 60;
const SIZE: (u32, u32) = (1000, 1560);
const HEAD: i32 = 64;
/// Black, blue, vermilion, green, purple, orange and sky blue of the palette of Okabe and Ito.
const COLOURS: [(&str, RGBColor); 7] = [
    ("auto", RGBColor(0, 0, 0)),
    ("multigrid", RGBColor(0, 114, 178)),
    ("newton_krylov", RGBColor(213, 94, 0)),
    ("semi_system", RGBColor(0, 158, 115)),
    ("dry", RGBColor(204, 121, 167)),
    (OWN, RGBColor(230, 159, 0)),
    (WEDGE, RGBColor(86, 180, 233)),
];

/// One contact and what is solved of it.
struct Case {
    name: &'static str,
    title: &'static str,
    /// What the two errors are of.
    quantities: [&'static str; 2],
    scene: fn(usize) -> Scene,
    rough: bool,
    grids: &'static [usize],
    /// Solvers and the cells along each side of the finest grid each is given.
    solvers: &'static [(&'static str, usize)],
    /// Cells along each side of the reference.
    reference: usize,
}

const FILMS: [&str; 2] = ["central film", "minimum film"];
const CASES: [Case; 4] = [
    Case {
        name: "full_film",
        title: "full film, M = 20",
        quantities: FILMS,
        scene: |n| ball(20.0, n),
        rough: false,
        grids: &[32, 64, 128, 256],
        solvers: &[("auto", 256), ("multigrid", 256), ("newton_krylov", 256), ("semi_system", 64)],
        reference: 512,
    },
    Case {
        name: "highly_loaded",
        title: "highly loaded, M = 1000",
        quantities: FILMS,
        scene: |n| ball(1000.0, n),
        rough: false,
        grids: &[64, 128, 256],
        solvers: &[("auto", 256), ("multigrid", 256), ("newton_krylov", 256), ("semi_system", 64)],
        reference: 512,
    },
    Case {
        name: "dry_rough",
        title: "dry, rough",
        quantities: ["contact area", "mean gap"],
        // Elastic: no asperity of these waves reaches the hardness.
        scene: |n| {
            let mut scene = Scene::azam_2019(n);
            (scene.lubricant, scene.plastic) = (None, None);
            scene
        },
        rough: true,
        grids: &[32, 64, 128, 256, 512],
        solvers: &[("dry", 512), (OWN, 256)],
        reference: 1024,
    },
    Case {
        name: "mixed",
        title: "mixed, rough",
        quantities: ["load ratio", "friction"],
        scene: transition,
        rough: true,
        grids: &[32, 64, 128, 256],
        solvers: &[("newton_krylov", 256), (WEDGE, 256), ("semi_system", 64)],
        reference: 512,
    },
];

/// Lines of one colour.
struct Series {
    colour: RGBColor,
    /// Cost and the two errors.
    points: [Vec<(f64, f64)>; 2],
    /// Single points beside the lines.
    loose: Vec<(f64, f64)>,
}

/// One solve.
struct Row {
    case: &'static str,
    solver: &'static str,
    cells: usize,
    tolerance: f64,
    report: SolveReport,
    seconds: f64,
    errors: [f64; 2],
}

impl Row {
    fn converged(&self) -> bool {
        self.report.status == Status::Converged
    }
}

fn main() -> ExitCode {
    command::run("work_precision", USAGE, options("docs"), run)
}

/// A smooth ball by its Moes load parameter, L = 10, in second order; the Moes parameters hold all of it.
fn ball(moes_load: f64, n: usize) -> Scene {
    const RADIUS: f64 = 1.0;
    const MODULUS: f64 = 226e9;
    let mut scene = Scene::azam_2019(n);
    let Some(oil) = &mut scene.lubricant else { return scene };
    (oil.eta0, oil.alpha, oil.inlet) = (0.04, Some(2.2e-8), InletSpec::BoxEdge);
    let speed = (10.0 / (2.2e-8 * MODULUS)).powi(4);
    scene.form = Form::Sphere { radius: RADIUS };
    scene.elastic.equivalent_modulus = MODULUS;
    scene.load = Load::force(moes_load * speed.powf(0.75) * MODULUS * RADIUS * RADIUS);
    scene.motion.entrainment_speed = 0.5 * speed * MODULUS * RADIUS / 0.04;
    scene.roughness = Default::default();
    scene.plastic = None;
    if let Ok(hertz) = scene.hertz() {
        let a = hertz.half_width_x;
        scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-4.5 * a, 1.5 * a], y: [-3.0 * a, 3.0 * a] };
    }
    scene
}

/// The reference contact at a speed at which solids and oil carry about half of the load each.
fn transition(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.motion.entrainment_speed = 0.02;
    scene
}

/// Height of a roughness that is the same on every grid: waves of equal height in all directions.
fn height(x: f64, y: f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (longest, shortest) = WAVELENGTHS;
    let waves = (0..WAVES).map(|k| {
        let share = f64::from(k) / f64::from(WAVES - 1);
        let number = TAU / longest * (longest / shortest).powf(share);
        let (angle, phase) = (PI * (golden * f64::from(k)).fract(), TAU * (0.7548 * f64::from(k)).fract());
        (number * (x * angle.cos() + y * angle.sin()) + phase).cos()
    });
    RQ * (2.0 / f64::from(WAVES)).sqrt() * waves.sum::<f64>()
}

/// Time since a start.
struct Stopwatch {
    clock: Instant,
    processor: Option<f64>,
}

impl Stopwatch {
    fn start() -> Self {
        Self { clock: Instant::now(), processor: Self::processor() }
    }

    /// Seconds that this thread, the only one, has run.
    fn processor() -> Option<f64> {
        let text = std::fs::read_to_string("/proc/self/schedstat").ok()?;
        let nanoseconds: f64 = text.split_whitespace().next()?.parse().ok()?;
        Some(1e-9 * nanoseconds)
    }

    fn seconds(&self) -> f64 {
        match (self.processor, Self::processor()) {
            (Some(from), Some(to)) => to - from,
            _ => self.clock.elapsed().as_secs_f64(),
        }
    }
}

fn solver(name: &str) -> Box<dyn ContactSolver> {
    match name {
        "multigrid" => Box::new(Multigrid::new()),
        "newton_krylov" | WEDGE => Box::new(NewtonKrylov::new()),
        "semi_system" => Box::new(SemiSystem::default()),
        "dry" => Box::new(Dry::new()),
        OWN => Box::new(SteepestDescent),
        _ => Box::new(Auto::new()),
    }
}

/// Solves one case on `n` by `n` cells: the report, the seconds and the two quantities.
fn solve(
    case: &Case,
    name: &str,
    n: usize,
    tolerance: f64,
) -> Result<(SolveReport, f64, [f64; 2]), Box<dyn Error>> {
    let scene = (case.scene)(n);
    let (grid, hertz, modulus) = (scene.grid()?, scene.hertz()?, scene.elastic.equivalent_modulus);
    let mut gap = vec![0.0; grid.len()];
    scene.form.gap_into(&grid, &mut gap)?;
    if case.rough {
        for (gap, (x, y)) in gap.iter_mut().zip(grid.nodes()) {
            *gap -= height(x, y);
        }
    }
    let mut body = HalfSpace::new(grid, modulus)?;
    let oil = match scene.lubricant {
        None => None,
        Some(spec) => {
            let viscosity = match spec.alpha {
                None => Roelands::new(spec.eta0, spec.roelands_z, spec.roelands_p0)?,
                Some(alpha) => Roelands::from_alpha(spec.eta0, alpha, spec.roelands_z, spec.roelands_p0)?,
            };
            Some(Lubricant::new(viscosity, DowsonHigginson::new(spec.density_a, spec.density_b)?))
        }
    };
    let reference_film = match &oil {
        None => 0.0,
        Some(oil) => FilmConditions {
            entrainment_speed: scene.motion.entrainment_speed,
            eta0: oil.viscosity().viscosity(0.0),
            alpha: oil.pressure_viscosity_coefficient(),
            equivalent_modulus: modulus,
            radius: scene.form.radii().0,
            load: hertz.force,
            ellipticity: 1.0,
        }
        .hamrock_dowson_central()?,
    };
    let limit = scene.plastic.map(|plastic| vec![plastic.hardness; grid.len()]);
    let face_mobility = if name == WEDGE { FaceMobility::Wedge } else { scene.face_mobility() };
    let mut problem = LubricatedContact::new(
        &gap,
        &mut body,
        hertz.force,
        (hertz.half_width_x, hertz.half_width_y),
        hertz.pressure,
    )
    .with_lubricant(oil.as_ref())
    .with_entrainment_speed(scene.motion.entrainment_speed)
    .with_pressure_limit(limit.as_deref())
    .with_film_cutoff(scene.solver.film_cutoff)
    .with_contact(scene.solver.contact)
    .with_scheme(scene.scheme())
    .with_face_mobility(face_mobility)
    .with_cavitation(scene.cavitation())
    .with_reference_film(reference_film);
    let stop = StoppingRule::default().with_tolerance(tolerance);
    let (start, mut repeats) = (Stopwatch::start(), 0.0);
    let (state, report) = loop {
        let (mut state, mut solver) = (ContactState::new(&grid), solver(name));
        let report = solver.solve(&mut problem, &mut state, &stop)?;
        repeats += 1.0;
        if repeats >= MOST_REPEATS || start.seconds() > LEAST_SECONDS {
            break (state, report);
        }
    };
    let seconds = start.seconds() / repeats;
    let mean = mean_central_film(&grid, &state.film, hertz.half_width_x, hertz.half_width_y)?;
    let touching = state.in_contact.iter().filter(|flag| **flag).count() as f64 * grid.cell_area();
    let solid: f64 = (0..grid.len()).map(|k| state.solid_pressure(k)).sum::<f64>() * grid.cell_area();
    let under_pressure = state.film.iter().zip(&state.pressure).filter(|(_, p)| **p > 0.0);
    let minimum = under_pressure.fold(f64::INFINITY, |least, (h, _)| least.min(*h));
    let values = match case.name {
        "dry_rough" => [touching, mean],
        "mixed" => [solid / hertz.force, friction(&scene, problem.lubricant, &grid, &state, hertz.force)?],
        _ => [grid.interpolate(&state.film, 0.0, 0.0)?, minimum],
    };
    Ok((report, seconds, values))
}

/// Friction coefficient: boundary friction of the solids, shear of the oil where it is under pressure.
fn friction(
    scene: &Scene,
    oil: Option<&Lubricant>,
    grid: &Grid,
    state: &ContactState,
    load: f64,
) -> Result<f64, Box<dyn Error>> {
    let viscosity_at = |p: f64| match oil {
        Some(oil) if p > 0.0 => oil.viscosity().viscosity(p),
        _ => 0.0,
    };
    let viscosity: Vec<f64> = state.fluid_pressure.iter().map(|p| viscosity_at(*p)).collect();
    let solid: Vec<f64> = (0..grid.len()).map(|k| state.solid_pressure(k)).collect();
    let sliding = scene.motion.entrainment_speed * scene.motion.slide_roll_ratio;
    let mut shear = vec![0.0; grid.len()];
    viscous_shear_into(&viscosity, &state.film, sliding, &scene.friction.rheology()?, &mut shear)?;
    Ok(friction_coefficient(grid, scene.friction.boundary_coefficient, &solid, &shear, load)?)
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let (largest, tolerances): (usize, &[f64]) =
        if options.quick { (64, &[1e-2, TIGHT]) } else { (usize::MAX, &[1e-2, 1e-4, TIGHT]) };
    let mut rows = Vec::new();
    for case in &CASES {
        let finest = if options.quick { 2 * largest } else { case.reference };
        let best = if case.name == "dry_rough" { "dry" } else { "auto" };
        let (report, _, exact) = solve(case, best, finest, REFERENCE)?;
        println!("{}: reference on {finest} x {finest} cells {}, {exact:?}", case.name, report.status);
        for (name, most) in case.solvers {
            for &cells in case.grids.iter().filter(|n| **n <= largest.min(*most)) {
                for &tolerance in tolerances {
                    let (report, seconds, values) = solve(case, name, cells, tolerance)?;
                    let errors = [0, 1].map(|k: usize| (values[k] / exact[k] - 1.0).abs());
                    rows.push(Row {
                        case: case.name,
                        solver: name,
                        cells,
                        tolerance,
                        report,
                        seconds,
                        errors,
                    });
                }
            }
        }
    }
    std::fs::create_dir_all(&options.out).map_err(|error| format!("{}: {error}", options.out.display()))?;
    write_table(&rows, &options.out.join("work_precision.csv"))?;
    let histories = stepping::rows(options.quick)?;
    stepping::write_table(&histories, &options.out.join("time_steps.csv"))?;
    let steps = stepping::panels(&histories, options.quick);
    draw(&rows, &steps, &options.out.join("work_precision.svg"))?;
    println!("tables and figure are in {}", options.out.display());
    Ok(())
}

fn write_table(rows: &[Row], path: &Path) -> Result<(), Box<dyn Error>> {
    let mut text = String::from(
        "scene,solver,cells,tolerance,status,ran,seconds,convolutions,iterations,first_quantity,first_error,second_quantity,second_error\n",
    );
    for row in rows {
        let [first, second] =
            CASES.iter().find(|case| case.name == row.case).map_or(FILMS, |case| case.quantities);
        let (report, work) = (&row.report, row.report.work);
        writeln!(
            text,
            "{},{},{},{:e},{},{},{:.4},{:.1},{},{first},{:.3e},{second},{:.3e}",
            row.case,
            row.solver,
            row.cells,
            row.tolerance,
            report.status,
            report.solver,
            row.seconds,
            work.convolutions,
            work.iterations,
            row.errors[0],
            row.errors[1]
        )?;
    }
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()).into())
}

/// A row of two panels for every case, errors over seconds and over convolutions, and one for the steps in
/// time.
fn draw(rows: &[Row], steps: &[Vec<Series>; 2], path: &Path) -> Result<(), Box<dyn Error>> {
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (head, body) = root.split_vertically(HEAD);
    let font = |size: u32| ("sans-serif", size).into_font();
    for (k, (name, colour)) in COLOURS.iter().enumerate() {
        let (x, y) = (20 + 200 * (k as i32 % 4), 20 + 24 * (k as i32 / 4));
        head.draw(&PathElement::new(vec![(x, y), (x + 28, y)], colour.stroke_width(3)))?;
        head.draw(&Text::new(*name, (x + 34, y - 9), font(18)))?;
    }
    head.draw(&Text::new("tolerance", (848, 2), font(16)))?;
    head.draw(&Circle::new((930, 12), 4, BLACK.filled()))?;
    head.draw(&Text::new("1e-6", (940, 2), font(16)))?;
    head.draw(&Circle::new((930, 32), 3, BLACK.stroke_width(1)))?;
    head.draw(&Text::new("looser", (940, 22), font(16)))?;
    let areas = body.split_evenly((CASES.len() + 1, 2));
    let mut areas = areas.chunks(2);
    for (case, areas) in CASES.iter().zip(areas.by_ref()) {
        let shown: Vec<&Row> = rows.iter().filter(|row| row.case == case.name && row.converged()).collect();
        let title =
            format!("{}: {} (solid), {} (broken)", case.title, case.quantities[0], case.quantities[1]);
        let [seconds, convolutions] = areas else { continue };
        panel(seconds, &title, "seconds", &solver_series(&shown, |row| row.seconds))?;
        let work = solver_series(&shown, |row| row.report.work.convolutions);
        panel(convolutions, &title, "convolutions of the grid", &work)?;
    }
    if let Some([lengths, seconds]) = areas.next() {
        let title = "steps of a history: mean wear (solid), mean film (broken)";
        panel(lengths, title, "mean step, seconds of the history", &steps[0])?;
        panel(seconds, "the same; black: equal steps, blue: changes bounded", "seconds", &steps[1])?;
    }
    root.present()?;
    Ok(())
}

/// Lines at the tight tolerance and single points at the looser ones, a colour for each solver.
fn solver_series(rows: &[&Row], cost: fn(&Row) -> f64) -> Vec<Series> {
    let of_solver = |(name, colour): (&str, RGBColor)| {
        let points = |k: usize, tight: bool| {
            let of_solver = rows.iter().filter(|row| row.solver == name && row.errors[k] > 0.0);
            let rows = of_solver.filter(|row| (row.tolerance <= TIGHT) == tight);
            rows.map(|row| (cost(row), row.errors[k])).collect()
        };
        Series { colour, points: [points(0, true), points(1, true)], loose: points(0, false) }
    };
    COLOURS.map(of_solver).into()
}

/// The first error with full lines, the second with broken ones.
fn panel(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    title: &str,
    x_label: &str,
    series: &[Series],
) -> Result<(), Box<dyn Error>> {
    let points = || series.iter().flat_map(|s| s.points.iter().flatten().chain(&s.loose));
    // Two at least.
    let decades = |low: f64, high: f64| {
        let first = low.log10().floor();
        10_f64.powf(first)..10_f64.powf(high.log10().ceil().max(first + 2.0))
    };
    let range = |of: fn(&(f64, f64)) -> f64| {
        let all = || points().map(of);
        [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)]
    };
    let ([least_cost, most_cost], [least, most]) = (range(|point| point.0), range(|point| point.1));
    let y = decades(least.clamp(1e-8, 1e-2), most.clamp(0.1, 10.0));
    let x = decades(least_cost.clamp(1e-4, 1e3), most_cost.clamp(1e-2, 1e5));
    let font = |size: u32| ("sans-serif", size).into_font();
    let mut chart = ChartBuilder::on(area)
        .caption(title, font(16))
        .margin(8)
        .margin_right(24)
        .x_label_area_size(44)
        .y_label_area_size(70)
        .build_cartesian_2d(x.log_scale(), y.log_scale())?;
    chart
        .configure_mesh()
        .x_desc(x_label)
        .y_desc("relative error")
        .label_style(font(15))
        .axis_desc_style(font(17))
        .x_label_formatter(&|v| power(*v))
        .y_label_formatter(&|v| power(*v))
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.12))
        .draw()?;
    for Series { colour, points: [first, second], loose } in series {
        let style = colour.stroke_width(2);
        chart.draw_series(LineSeries::new(first.iter().copied(), style))?;
        chart.draw_series(DashedLineSeries::new(second.iter().copied(), 7, 5, style))?;
        chart.draw_series(first.iter().chain(second).map(|point| Circle::new(*point, 4, colour.filled())))?;
        chart.draw_series(loose.iter().map(|point| Circle::new(*point, 3, colour.stroke_width(1))))?;
    }
    Ok(())
}

/// A power of ten as it is read; nothing between them.
fn power(value: f64) -> String {
    let exponent = value.log10().round();
    if (value.log10() - exponent).abs() > 1e-6 {
        String::new()
    } else if (-2.0..=3.0).contains(&exponent) {
        format!("{}", 10_f64.powi(exponent as i32))
    } else {
        format!("1e{exponent}")
    }
}
