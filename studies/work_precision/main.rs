//! The cost of accuracy: errors of four contacts against seconds and convolutions, one line per solver, that
//! of the example `custom_solver` among them; errors of wear and film of a history against its steps.
//!
//! ```text
//! cargo run --release -p studies --bin work_precision                      # docs/work_precision.{csv,svg}, docs/time_steps.{csv,svg}, minutes
//! cargo run --release -p studies --bin work_precision -- --quick --out DIR # coarse grids, seconds
//! ```
//!
//! Errors are relative differences to a finer grid, solved to 1e-8. Seconds are the mean of some solves
//! from a cold start with all buffers still to be made, the kernel's spectrum apart.

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "a program that talks to its user")]

#[path = "../../examples/chart/mod.rs"]
mod chart;
#[path = "../../examples/command/mod.rs"]
mod command;
#[path = "../../examples/command/quick.rs"]
mod quick;
#[path = "../../examples/custom_solver/steepest_descent.rs"]
mod steepest_descent;
mod stepping;

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::process::ExitCode;

use quick::{Options, options};
use steepest_descent::SteepestDescent;
use stribeck::benchmark::{Benchmark, Budget, Case, Contestant, HeightsOnGrid, Limits, Quantity, Results};
use stribeck::sim::Scene;
use stribeck::sim::scene::{GridSpec, InletSpec, Load};
use stribeck::surface::Form;

const USAGE: &str = "\
usage: cargo run --release -p studies --bin work_precision -- [--quick] [--out DIR]

  --quick    coarse grids and few tolerances
  --out DIR  where to write work_precision and time_steps, .csv and .svg (default docs)
";
/// The solver that is not of the crate.
const OWN: &str = "steepest_descent";
/// Newton's method with the other face law that resolves inlets.
const WEDGE: &str = "newton_krylov:face_mobility=wedge";
/// Root mean square of the roughness and its longest and shortest wavelength \[m\].
const RQ: f64 = 100e-9;
const WAVELENGTHS: (f64, f64) = (100e-6, 25e-6);
const WAVES: u32 = 60;

/// One contact and its solved quantities.
struct Contact {
    name: &'static str,
    quantities: [Quantity; 2],
    scene: fn() -> Scene,
    rough: bool,
    grids: &'static [usize],
    /// Solvers and the cells along each side of the finest grid each is given; the first one solves the
    /// reference.
    solvers: &'static [(&'static str, usize)],
    /// Cells along each side of the reference.
    reference: usize,
}

const FILMS: [Quantity; 2] = [Quantity::CentralFilm, Quantity::MinimumFilm];
const SMOOTH: [(&str, usize); 4] =
    [("auto", 256), ("multigrid", 256), ("newton_krylov", 256), ("semi_system", 64)];
const CONTACTS: [Contact; 4] = [
    Contact {
        name: "full film, M = 20",
        quantities: FILMS,
        scene: || ball(20.0),
        rough: false,
        grids: &[32, 64, 128, 256],
        solvers: &SMOOTH,
        reference: 512,
    },
    Contact {
        name: "highly loaded, M = 1000",
        quantities: FILMS,
        scene: || ball(1000.0),
        rough: false,
        grids: &[64, 128, 256],
        solvers: &SMOOTH,
        reference: 512,
    },
    Contact {
        name: "dry, rough",
        quantities: [Quantity::AreaRatio, Quantity::MeanFilm],
        scene: || reference_contact(None),
        rough: true,
        grids: &[32, 64, 128, 256, 512],
        solvers: &[("dry", 512), (OWN, 256)],
        reference: 1024,
    },
    Contact {
        name: "mixed, rough",
        quantities: [Quantity::LoadRatio, Quantity::Friction],
        scene: || reference_contact(Some(0.02)),
        rough: true,
        grids: &[32, 64, 128, 256],
        solvers: &[("newton_krylov", 256), (WEDGE, 256), ("semi_system", 64)],
        reference: 512,
    },
];

fn main() -> ExitCode {
    command::run("work_precision", USAGE, options("docs"), run)
}

/// A smooth ball by its Moes load parameter, L = 10; the Moes parameters hold all of it.
fn ball(moes_load: f64) -> Scene {
    const RADIUS: f64 = 1.0;
    const MODULUS: f64 = 226e9;
    let mut scene = Scene::azam_2019(64);
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
        scene.grid = GridSpec::Cells { nx: 64, ny: 64, x: [-4.5 * a, 1.5 * a], y: [-3.0 * a, 3.0 * a] };
    }
    scene
}

/// The reference contact, dry, or at a speed at which solids and oil carry about half of the load each.
fn reference_contact(speed: Option<f64>) -> Scene {
    let mut scene = Scene::azam_2019(64);
    scene.roughness = Default::default();
    match speed {
        Some(speed) => {
            scene.motion.entrainment_speed = speed;
            scene.lubricant = scene.lubricant.map(|oil| oil.with_inlet(InletSpec::BoxEdge));
        }
        // Elastic: no asperity of these waves reaches the hardness.
        None => (scene.lubricant, scene.plastic) = (None, None),
    }
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

fn contestant(name: &str) -> Result<Contestant, Box<dyn Error>> {
    Ok(match name {
        OWN => Contestant::new(OWN, |_| Box::new(SteepestDescent)),
        name => Contestant::named(name)?,
    })
}

/// The contact with the limits of its reference.
fn case(contact: &Contact, quick: bool) -> Result<Case, Box<dyn Error>> {
    let heights = HeightsOnGrid::new(|grid| {
        Ok([grid.nodes().map(|(x, y)| height(x, y)).collect(), vec![0.0; grid.len()]])
    });
    let scene = (contact.scene)();
    let case = Case::new(contact.name, scene).with_heights(contact.rough.then_some(heights));
    let cells = if quick { 128 } else { contact.reference };
    let benchmark = Benchmark::new(vec![case.clone()]).contestant(contestant(contact.solvers[0].0)?);
    let solved = benchmark.meshes([cells]).tolerances([1e-8]).budget(Budget::unlimited()).run()?;
    let row = &solved.rows()[0];
    println!("{}: reference on {cells} x {cells} cells {}", contact.name, row.verdict);
    let of = Limits::of(&case.scene)?;
    let limits = contact.quantities.iter().fold(of, |limits, q| limits.with(*q, row.value(*q), 0.0));
    Ok(case.with_reference(Some(limits)))
}

fn run(options: &Options) -> Result<(), Box<dyn Error>> {
    let (largest, tolerances): (usize, &[f64]) =
        if options.quick { (64, &[1e-2, 1e-6]) } else { (usize::MAX, &[1e-2, 1e-4, 1e-6]) };
    let mut results = Results::default();
    for contact in &CONTACTS {
        let case = case(contact, options.quick)?;
        for (name, most) in contact.solvers {
            for cells in contact.grids.iter().copied().filter(|n| *n <= largest.min(*most)) {
                let benchmark = Benchmark::new(vec![case.clone()]).contestant(contestant(name)?);
                let benchmark = benchmark.meshes([cells]).tolerances(tolerances.iter().copied());
                let benchmark = benchmark.repeats(if cells <= 64 { 10 } else { 1 });
                results = results.merged(benchmark.budget(Budget::unlimited()).threads(1).run()?);
            }
        }
    }
    std::fs::create_dir_all(&options.out)?;
    std::fs::write(options.out.join("work_precision.csv"), results.to_csv())?;
    std::fs::write(options.out.join("work_precision.svg"), results.work_precision())?;
    stepping::run(options.quick, &options.out)?;
    println!("tables and figures are in {}", options.out.display());
    Ok(())
}
