//! Errors of asperity inlets and of resolved solves on coarse cells, over the inlet number, lambda, lays and spectra.
//!
//! ```text
//! cargo run --release -p studies --bin asperity_inlets                      # asperity_inlets.{csv,svg}, seven minutes of processor time
//! cargo run --release -p studies --bin asperity_inlets -- --film-cutoff 1   # the same with the default film cut-off
//! cargo run --release -p studies --bin asperity_inlets -- --quick --out DIR # coarse cells, seconds
//! ```
//!
//! The reference of each contact is a resolved solve on cells of 0.24 um. Inlets of asperities are as long as the film
//! cut-off to the power 2/3: these cells resolve those of 4 nm (0.32 um), and not those of 1 nm (0.13 um).

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;
mod figure;
mod surfaces;
mod tables;

use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use lexopt::prelude::*;
use stribeck::Status;
use stribeck::analytic::MixedLoadShare;
use stribeck::reynolds::AsperityInlets;
use stribeck::sim::scene::{GridSpec, InletSpec, Motion};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, SimBuilder};
use stribeck::surface::Form;
use surfaces::{SURFACES, Surface};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin asperity_inlets -- [--quick] [--film-cutoff NM] [--out DIR]

  --quick           two surfaces on coarse cells
  --film-cutoff NM  film cut-off [nm] (default 4)
  --out DIR         where to write asperity_inlets.csv and .svg (default target/asperity_inlets)
";
/// Radius of the ball and side of the box \[m\]: an eighth of those of Azam et al. (2019).
const RADIUS: f64 = 9.525e-3 / 8.0;
const BOX: f64 = 62.5e-6;
/// Inlet numbers.
const INLETS: [f64; 5] = [0.4, 0.8, 1.3, 2.0, 5.0];
/// Smooth films over Rq of further contacts of two surfaces.
const LAMBDAS: [f64; 3] = [0.3, 1.0, 3.0];
/// Steps to the speed of a lambda, and the power of the speed that a film grows with.
const FILM_STEPS: usize = 4;
const FILM_POWER: f64 = 0.67;
const SLIDE_ROLL_RATIO: f64 = 0.05;

/// A way to solve a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Method {
    Resolved,
    Inlets,
}

/// Method and cells along each side; the first is the reference.
const METHODS: [(Method, usize); 5] = [
    (Method::Resolved, 256),
    (Method::Inlets, 128),
    (Method::Inlets, 256),
    (Method::Resolved, 64),
    (Method::Resolved, 128),
];

impl Method {
    fn name(self) -> &'static str {
        match self {
            Self::Resolved => "resolved",
            Self::Inlets => "asperity_inlets",
        }
    }
}

/// Numbers of one solve.
#[derive(Clone, Copy)]
struct Found {
    load_ratio: f64,
    friction: f64,
    mean_film: f64,
    seconds: f64,
    converged: bool,
    /// Whether the law warns that few asperities decide its load ratio.
    is_sensitive: bool,
}

/// One contact by all methods.
struct Row {
    surface: &'static Surface,
    inlet: f64,
    speed: f64,
    lambda: f64,
    /// Whether the speed is that of a lambda.
    is_by_lambda: bool,
    found: Vec<Found>,
}

/// Contacts of a surface.
#[derive(Clone, Copy)]
enum Point {
    Inlet(f64),
    Lambda(f64),
}

struct Options {
    quick: bool,
    /// \[m\]
    film_cutoff: f64,
    out: PathBuf,
}

fn options() -> Result<Option<Options>, lexopt::Error> {
    let out = PathBuf::from("target/asperity_inlets");
    let mut options = Options { quick: false, film_cutoff: 4e-9, out };
    let mut parser = lexopt::Parser::from_env();
    while let Some(argument) = parser.next()? {
        match argument {
            Long("quick") => options.quick = true,
            Long("film-cutoff") => options.film_cutoff = 1e-9 * parser.value()?.parse::<f64>()?,
            Long("out") => options.out = PathBuf::from(parser.value()?),
            Long("help") | Short('h') => return Ok(None),
            other => return Err(other.unexpected()),
        }
    }
    Ok(Some(options))
}

fn main() -> ExitCode {
    command::run("asperity_inlets", USAGE, options(), work)
}

fn work(options: &Options) -> Result<(), Box<dyn Error>> {
    let divisor = if options.quick { 4 } else { 1 };
    let surfaces = if options.quick { &SURFACES[..2] } else { &SURFACES[..] };
    let mut rows = Vec::new();
    for surface in surfaces {
        let lambdas = if surface.has_lambdas { &LAMBDAS[..] } else { &[] };
        let points = INLETS.into_iter().map(Point::Inlet).chain(lambdas.iter().copied().map(Point::Lambda));
        for point in points {
            let row = row(surface, point, options.film_cutoff, divisor)?;
            let shares: Vec<String> =
                row.found.iter().map(|found| format!("{:.3}", found.load_ratio)).collect();
            eprintln!(
                "{} L {:.2} lambda {:.2}: load ratios {}",
                surface.name,
                row.inlet,
                row.lambda,
                shares.join(", ")
            );
            rows.push(row);
        }
    }
    let csv = csv(&rows, divisor);
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("asperity_inlets.csv"), csv)?;
    println!("{}", tables::of(&rows, divisor));
    figure::draw(&options.out.join("asperity_inlets.svg"), &rows)
}

/// The contact of `surface` at a `point`, by all methods.
fn row(
    surface: &'static Surface,
    point: Point,
    film_cutoff: f64,
    divisor: usize,
) -> Result<Row, Box<dyn Error>> {
    let cells = METHODS[1].1 / divisor;
    let unit = builder(surface, (1.0, film_cutoff), cells)?.build()?;
    let oil = unit.scene().oil_numbers()?.ok_or("no oil")?;
    let expected = unit.expectation()?;
    let contact = MixedLoadShare {
        entrainment_speed: 1.0,
        eta0: oil.eta0,
        alpha: oil.alpha,
        correlation_length: expected.correlation_length.ok_or("no correlation length")?,
        contact_film: unit.scene().solver.film_cutoff,
        composite_rq: expected.roughness.composite_rq,
    };
    let lambda_at = |speed: f64| -> Result<f64, Box<dyn Error>> {
        let film = builder(surface, (speed, film_cutoff), cells)?.build()?.expectation()?.film;
        Ok(film.and_then(|film| film.lambda).ok_or("no film")?)
    };
    let mut speed = 1.0;
    match point {
        Point::Inlet(inlet) => speed = inlet / contact.inlet_number()?,
        Point::Lambda(lambda) => {
            for _ in 0..FILM_STEPS {
                speed *= (lambda / lambda_at(speed)?).powf(1.0 / FILM_POWER);
            }
        }
    }
    let (inlet, lambda) = (speed * contact.inlet_number()?, lambda_at(speed)?);
    let mut found = Vec::with_capacity(METHODS.len());
    for (method, cells) in METHODS {
        let start = Instant::now();
        let solution = solve(surface, (speed, film_cutoff), method, cells / divisor)?;
        found.push(Found {
            load_ratio: solution.contact.load_ratio,
            friction: solution.friction.coefficient,
            mean_film: solution.film.mean_central,
            seconds: start.elapsed().as_secs_f64(),
            // The law does not satisfy the equations that a custom solver is verified by.
            converged: matches!(solution.report.status, Status::Converged) || method == Method::Inlets,
            is_sensitive: method == Method::Inlets
                && solution.warnings.iter().any(|warning| warning.field == "contact.load_ratio"),
        });
    }
    Ok(Row { surface, inlet, speed, lambda, is_by_lambda: matches!(point, Point::Lambda(_)), found })
}

/// The contact of a speed and a film cut-off on `cells` along each side.
fn builder(
    surface: &Surface,
    (speed, film_cutoff): (f64, f64),
    cells: usize,
) -> Result<SimBuilder, Box<dyn Error>> {
    let mut scene = Scene::azam_2019(cells);
    scene.form = Form::Sphere { radius: RADIUS };
    let half = 0.5 * BOX;
    scene.grid = GridSpec::Cells { nx: cells, ny: cells, x: [-half, half], y: [-half, half] };
    scene.motion = Motion::new(speed, SLIDE_ROLL_RATIO);
    scene.roughness = Default::default();
    scene.solver.edge_contact = true;
    scene.solver.film_cutoff = film_cutoff;
    // The law has no pressure at the edge of the box.
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    let heights = surface.heights(&scene.grid()?)?;
    Ok(MixedLubricationSim::builder(scene).disc_heights(heights))
}

fn solve(
    surface: &Surface,
    point: (f64, f64),
    method: Method,
    cells: usize,
) -> Result<ContactSolution, Box<dyn Error>> {
    let builder = builder(surface, point, cells)?;
    // As a solver of its own the law is not refused for lays.
    let builder = if method == Method::Inlets {
        builder.solver(AsperityInlets::allowing_edge_contact())
    } else {
        builder
    };
    Ok(builder.solve()?)
}

/// All numbers.
fn csv(rows: &[Row], divisor: usize) -> String {
    let mut text = "surface,inlet_number,entrainment_speed_m_per_s,lambda,model,cells,converged,warned,load_ratio,friction_coefficient,mean_film_m,seconds\n".to_owned();
    for row in rows {
        for (found, (method, cells)) in row.found.iter().zip(METHODS) {
            let Found { load_ratio, friction, mean_film, seconds, converged, is_sensitive } = found;
            let _ = writeln!(
                text,
                "\"{}\",{:.4},{:.6e},{:.4},{},{},{converged},{is_sensitive},{load_ratio:.6},{friction:.6},{mean_film:.6e},{seconds:.3}",
                row.surface.name,
                row.inlet,
                row.speed,
                row.lambda,
                method.name(),
                cells / divisor
            );
        }
    }
    text
}

impl Row {
    /// Whether the surface has no lay, the speed is that of an inlet number, and the load ratio of the reference is at least
    /// `low` and below `high`.
    fn is_isotropic_within(&self, low: f64, high: f64) -> bool {
        let reference = self.found.first().map_or(f64::NAN, |found| found.load_ratio);
        !self.surface.has_lay() && !self.is_by_lambda && (low..high).contains(&reference)
    }

    /// Whether the law warns that few asperities decide its load ratio.
    fn is_sensitive(&self) -> bool {
        self.found.get(1).is_some_and(|law| law.is_sensitive)
    }

    /// Errors of load ratio, friction and film of a method, the latter two relative; `None` unless it and the
    /// reference converged.
    fn errors(&self, method: usize) -> Option<[f64; 3]> {
        let (reference, found) = (self.found.first()?, self.found.get(method)?);
        (reference.converged && found.converged).then(|| {
            [
                found.load_ratio - reference.load_ratio,
                found.friction / reference.friction - 1.0,
                found.mean_film / reference.mean_film - 1.0,
            ]
        })
    }
}
