//! Errors of asperity inlets and of resolved solves on coarse cells, over the inlet number, lambda, lays and spectra.
//!
//! ```text
//! cargo run --release -p studies --bin asperity_inlets                      # asperity_inlets.{csv,svg}, six minutes of processor time
//! cargo run --release -p studies --bin asperity_inlets -- --quick --out DIR # coarse cells, seconds
//! ```
//!
//! The reference of each contact is a resolved solve on cells of 0.24 um. It errs by about 0.01 in load ratio itself
//! (`docs/mixed.md`).

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/command/mod.rs"]
mod command;
mod figure;
#[path = "../../examples/command/quick.rs"]
mod quick;
mod surfaces;

use std::error::Error;
use std::fmt::Write as _;
use std::process::ExitCode;
use std::time::Instant;

use quick::{Options, options};
use stribeck::Status;
use stribeck::analytic::MixedLoadShare;
use stribeck::reynolds::AsperityInlets;
use stribeck::sim::scene::{GridSpec, InletSpec, Motion};
use stribeck::sim::{ContactSolution, MixedLubricationSim, Scene, SimBuilder};
use stribeck::surface::Form;
use surfaces::{SURFACES, Surface};

const USAGE: &str = "\
usage: cargo run --release -p studies --bin asperity_inlets -- [--quick] [--out DIR]

  --quick    two surfaces on coarse cells
  --out DIR  where to write asperity_inlets.csv and .svg (default target/asperity_inlets)
";
/// Radius of the ball and side of the box \[m\]: an eighth of those of Azam et al. (2019).
const RADIUS: f64 = 9.525e-3 / 8.0;
const BOX: f64 = 62.5e-6;
/// Inlet numbers.
const INLETS: [f64; 5] = [0.4, 0.8, 1.3, 2.0, 5.0];
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
}

/// One contact by all methods.
struct Row {
    surface: &'static Surface,
    inlet: f64,
    speed: f64,
    lambda: f64,
    found: Vec<Found>,
}

fn main() -> ExitCode {
    command::run("asperity_inlets", USAGE, options("target/asperity_inlets"), work)
}

fn work(options: &Options) -> Result<(), Box<dyn Error>> {
    let divisor = if options.quick { 4 } else { 1 };
    let surfaces = if options.quick { &SURFACES[..2] } else { &SURFACES[..] };
    let mut rows = Vec::new();
    for surface in surfaces {
        for inlet in INLETS {
            let row = row(surface, inlet, divisor)?;
            let shares: Vec<String> =
                row.found.iter().map(|found| format!("{:.3}", found.load_ratio)).collect();
            eprintln!("{} L {inlet}: load ratios {}", surface.name, shares.join(", "));
            rows.push(row);
        }
    }
    let csv = csv(&rows, divisor);
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("asperity_inlets.csv"), csv)?;
    figure::draw(&options.out.join("asperity_inlets.svg"), &rows)?;
    println!("{}", tables(&rows, divisor));
    Ok(())
}

/// The contact of `surface` at an inlet number, by all methods.
fn row(surface: &'static Surface, inlet: f64, divisor: usize) -> Result<Row, Box<dyn Error>> {
    let unit = builder(surface, 1.0, METHODS[1].1 / divisor)?.build()?;
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
    let speed = inlet / contact.inlet_number()?;
    let film = builder(surface, speed, METHODS[1].1 / divisor)?.build()?.expectation()?.film;
    let lambda = film.and_then(|film| film.lambda).ok_or("no film")?;
    let mut found = Vec::with_capacity(METHODS.len());
    for (method, cells) in METHODS {
        let start = Instant::now();
        let solution = solve(surface, speed, method, cells / divisor)?;
        found.push(Found {
            load_ratio: solution.contact.load_ratio,
            friction: solution.friction.coefficient,
            mean_film: solution.film.mean_central,
            seconds: start.elapsed().as_secs_f64(),
            // The law does not satisfy the equations that a custom solver is verified by.
            converged: matches!(solution.report.status, Status::Converged) || method == Method::Inlets,
        });
    }
    Ok(Row { surface, inlet, speed, lambda, found })
}

/// The contact on `cells` along each side.
fn builder(surface: &Surface, speed: f64, cells: usize) -> Result<SimBuilder, Box<dyn Error>> {
    let mut scene = Scene::azam_2019(cells);
    scene.form = Form::Sphere { radius: RADIUS };
    let half = 0.5 * BOX;
    scene.grid = GridSpec::Cells { nx: cells, ny: cells, x: [-half, half], y: [-half, half] };
    scene.motion = Motion::new(speed, SLIDE_ROLL_RATIO);
    scene.roughness = Default::default();
    scene.solver.edge_contact = true;
    // The law has no pressure at the edge of the box.
    scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
    let heights = surface.heights(&scene.grid()?)?;
    Ok(MixedLubricationSim::builder(scene).disc_heights(heights))
}

fn solve(
    surface: &Surface,
    speed: f64,
    method: Method,
    cells: usize,
) -> Result<ContactSolution, Box<dyn Error>> {
    let builder = builder(surface, speed, cells)?;
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
    let mut text = "surface,inlet_number,entrainment_speed_m_per_s,lambda,model,cells,converged,load_ratio,friction_coefficient,mean_film_m,seconds\n".to_owned();
    for row in rows {
        for (found, (method, cells)) in row.found.iter().zip(METHODS) {
            let Found { load_ratio, friction, mean_film, seconds, converged } = found;
            let _ = writeln!(
                text,
                "\"{}\",{},{:.6e},{:.4},{},{},{converged},{load_ratio:.6},{friction:.6},{mean_film:.6e},{seconds:.3}",
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
    /// Whether the surface has no lay and the load ratio of the reference is at least `low` and below `high`.
    fn is_isotropic_within(&self, low: f64, high: f64) -> bool {
        let reference = self.found.first().map_or(f64::NAN, |found| found.load_ratio);
        !self.surface.has_lay() && (low..high).contains(&reference)
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

/// Mean and largest of absolute values; empty for none.
fn mean_and_most(values: &[f64]) -> String {
    if values.is_empty() {
        return String::new();
    }
    let mean = values.iter().map(|value| value.abs()).sum::<f64>() / values.len() as f64;
    let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    format!("{mean:.3} ({most:.3})")
}

/// A set of contacts.
type Group = (&'static str, fn(&Row) -> bool);

/// Isotropic surfaces by the load ratio of the reference, and lays.
const GROUPS: [Group; 5] = [
    ("isotropic, below 0.1", |row| row.is_isotropic_within(f64::NEG_INFINITY, 0.1)),
    ("isotropic, 0.1 to 0.9", |row| row.is_isotropic_within(0.1, 0.9)),
    ("isotropic, above 0.9", |row| row.is_isotropic_within(0.9, f64::INFINITY)),
    ("lay along the flow", |row| row.surface.name.starts_with("lay along")),
    ("lay across the flow", |row| row.surface.name.starts_with("lay across")),
];

/// Markdown tables: errors by surface, and by groups and methods with seconds.
fn tables(rows: &[Row], divisor: usize) -> String {
    let mut text =
        "| surface | lambda | load ratio | friction | mean film |\n|---|---|---|---|---|\n".to_owned();
    let mut names: Vec<&str> = rows.iter().map(|row| row.surface.name).collect();
    names.dedup();
    for name in names {
        let of = || rows.iter().filter(|row| row.surface.name == name);
        let errors: Vec<[f64; 3]> = of().filter_map(|row| row.errors(1)).collect();
        let column = |k: usize| mean_and_most(&errors.iter().map(|error| error[k]).collect::<Vec<_>>());
        let lambdas: Vec<f64> = of().map(|row| row.lambda).collect();
        let [low, high] = [f64::INFINITY, 0.0]
            .map(|start| lambdas.iter().copied().fold(start, if start == 0.0 { f64::max } else { f64::min }));
        let _ = writeln!(
            text,
            "| {name} | {low:.2} to {high:.2} | {} | {} | {} |",
            column(0),
            column(1),
            column(2)
        );
    }
    text.push_str("\n| contacts | method | cells | load ratio | friction | mean film | seconds |\n|---|---|---|---|---|---|---|\n");
    for (group, holds) in GROUPS {
        let of: Vec<&Row> = rows.iter().filter(|row| holds(row)).collect();
        for (k, (method, cells)) in METHODS.into_iter().enumerate().skip(1) {
            let errors: Vec<[f64; 3]> = of.iter().filter_map(|row| row.errors(k)).collect();
            let column = |at: usize| mean_and_most(&errors.iter().map(|error| error[at]).collect::<Vec<_>>());
            let seconds = of.iter().map(|row| row.found[k].seconds).sum::<f64>() / of.len().max(1) as f64;
            let _ = writeln!(
                text,
                "| {group} ({}) | {} | {} | {} | {} | {} | {seconds:.2} |",
                errors.len(),
                method.name(),
                cells / divisor,
                column(0),
                column(1),
                column(2)
            );
        }
    }
    text
}
