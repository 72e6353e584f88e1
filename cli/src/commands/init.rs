//! `stribeck init`: a scene file from options, or from the answers to a few questions.

mod answers;
mod disc;
mod element;
mod given;
mod machine;
mod oil;
mod quantity;

use std::error::Error;
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use stribeck::sim::{MixedLubricationSim, Scene};
use stribeck::units::Dimension;
use stribeck::{InputError, Status};

use self::answers::Answers;
use self::disc::Finish;
use crate::files;
use crate::output::{self, Outcome};

/// Options of a ball on a disc.
const OPTIONS: [&str; 10] = [
    "--radius",
    "--load",
    "--speed",
    "--slide-roll-ratio",
    given::OIL,
    "--roughness",
    "--length",
    "--finish",
    "--surface",
    "--cells",
];
/// Half a side of the box in Hertz half-widths.
const BOX: f64 = 1.7;
/// Most nodes of a scene that is solved to see whether that goes without a warning.
const MOST_SOLVED: usize = 1 << 16;
/// Cells along each side at most.
const MOST_CELLS: u64 = 2048;
/// Longest inlet in half-widths on cells of the usual size: longer ones take wider cells, which thicker films
/// allow.
const LONGEST_INLET: f64 = 6.0;
/// Longest inlet over the radius: further out a ball is no paraboloid.
const LARGEST_SLOPE: f64 = 0.3;
/// Asperities reach over this many times Rq, and touch up to where the bodies part by that: beyond the contact of
/// the half-width `a` by `1.2 e^1.5 a^2/R` at the distance `e a`.
const REACH: f64 = 5.0;
const GAP_BEYOND: f64 = 1.2;
/// Room between them and the edge of the box, in half-widths.
const ROOM: f64 = 0.3;
/// Young's modulus \[Pa\] and Poisson's ratio of steel.
const STEEL: (f64, f64) = (210e9, 0.3);
/// Fields of the warnings that other answers can remove.
const LARGEST_PRESSURE: &str = "pressure.max";
const FILMS: [&str; 2] = ["film.central", "film.minimum"];
/// Wanted error of a smooth contact.
const ACCURACY: f64 = 0.02;
/// The warning about the heat of an isothermal film.
const FRICTION: &str = "friction.coefficient";
const ESTIMATE: &str = "solver.estimate";
/// Beginning of the field of warnings about the mesh error.
const MESH_ERROR: &str = "error_estimate.";
/// The warning about smooth bodies that touch.
const TOUCHING: &str = "contact.load_ratio";
/// Pressure that steel carries before it yields for good \[Pa\].
const HARDNESS: &str = "6 GPa";

/// A steel ball on a steel disc in oil, a test rig (--rig), a bearing (--bearing, --journal), a roller, or a machine (--gear, --cam,
/// --reciprocating). Numbers are in SI units or have a unit: "9.525 mm". Without options
/// and on a terminal each is asked for.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// File to write
    #[arg(default_value = "scene.toml")]
    file: PathBuf,
    /// Radius of the ball [default: 9.525 mm]
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH")]
    radius: Option<String>,
    /// Load [default: 20 N]
    #[arg(long, allow_hyphen_values = true, value_name = "FORCE")]
    load: Option<String>,
    /// Viscosity of the oil at ambient pressure and the temperature of the contact [default: 10 mPa s]
    #[arg(long, allow_hyphen_values = true, value_name = "VISCOSITY")]
    eta0: Option<String>,
    /// Pressure-viscosity coefficient of the oil [default: 18 1/GPa]
    #[arg(long, allow_hyphen_values = true, value_name = "ONE OVER PRESSURE")]
    alpha: Option<String>,
    /// ISO viscosity grade of the oil, "ISO VG 46", in place of --eta0 and --alpha
    #[arg(long, conflicts_with_all = ["eta0", "alpha"])]
    grade: Option<String>,
    /// Viscosity index of the oil of this grade [default: 95]
    #[arg(long, allow_hyphen_values = true, requires = "grade")]
    viscosity_index: Option<f64>,
    /// Temperature of the contact, for the oil of this grade [default: 40 degC]
    #[arg(
        long, allow_hyphen_values = true, requires = "grade",
        value_parser = |text: &str| output::positive(Dimension::Temperature, "--temperature", text)
    )]
    temperature: Option<f64>,
    /// Mean speed of the two surfaces [default: 0.5 m/s]
    #[arg(long, allow_hyphen_values = true, value_name = "SPEED")]
    speed: Option<String>,
    /// Sliding speed over mean speed [default: 0.1]
    #[arg(
        long, value_name = "RATIO", allow_hyphen_values = true,
        value_parser = |text: &str| output::ratio("--slide-roll-ratio", text)
    )]
    slide_roll_ratio: Option<f64>,
    /// Root mean square height of the disc, 0 for a smooth one [default: 0]; others need --length
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH")]
    roughness: Option<String>,
    /// Correlation length of the heights: where their autocorrelation has fallen to 10 %
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH", requires = "roughness")]
    length: Option<String>,
    /// Typical height and length of a finish, in place of --roughness
    #[arg(long, conflicts_with = "roughness")]
    finish: Option<Finish>,
    /// File of a measured surface, in place of --roughness
    #[arg(long, value_name = "FILE", conflicts_with_all = ["roughness", "finish"])]
    surface: Option<PathBuf>,
    /// Cells along each side of the box [default: four in the correlation length, at least 64 and at most 262 144 nodes; smooth 128]
    #[arg(
        long, allow_hyphen_values = true,
        value_parser = |text: &str| output::count::<u32>("--cells", text, 16..=MOST_CELLS)
    )]
    cells: Option<u32>,
    #[command(flatten)]
    element: element::Options,
    #[command(flatten)]
    machine: machine::Options,
    /// Write over a file that is there
    #[arg(long)]
    force: bool,
    /// Print the scene as one JSON object in SI units on standard output too
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(options: &Options) -> Result<Outcome, Box<dyn Error>> {
    let ask = given::is_empty(options) && io::stdin().is_terminal();
    files::require_folder(&options.file)?;
    if !options.force && options.file.exists() {
        return Err(format!("{}: the file exists; --force writes over it", options.file.display()).into());
    }
    if let Some(outcome) = element::run(options)? {
        return Ok(outcome);
    }
    if let Some(outcome) = machine::run(options)? {
        return Ok(outcome);
    }
    given::require_used(options, "a ball on a disc", &OPTIONS)?;
    let mut answers = answers::answers(options, ask, None)?;
    let (text, scene) = loop {
        match written(options, &answers) {
            Ok(done) => break done,
            // The answers are offered again.
            Err(error) if ask => {
                output::complain("error", &error.to_string());
                answers = answers::answers(options, ask, Some(&answers))?;
            }
            Err(error) => return Err(error),
        }
    };
    write(&options.file, &text, options.force)?;
    if options.json {
        output::print(&serde_json::to_value(&scene)?)?;
    }
    output::report_files(std::slice::from_ref(&options.file), options.json)?;
    Ok(Outcome::Converged)
}

/// The scene file and its text: the text must be a valid scene that solves without a warning, which
/// is tried if the solve is short. Smooth contacts then have an accuracy.
fn written(options: &Options, answers: &Answers) -> Result<(String, Scene), Box<dyn Error>> {
    let mut text = scene(options, answers)?;
    let mut scene = Scene::from_toml(&text)?;
    let sim = MixedLubricationSim::builder(scene.clone()).build()?;
    let mut warnings = sim.warnings().to_vec();
    if warnings.is_empty() && sim.grid().len() <= MOST_SOLVED {
        let solution = MixedLubricationSim::builder(scene.clone()).solve()?;
        if solution.report.status != Status::Converged {
            let status = solution.report.status;
            return Err(format!(
                "the contact is not solved, it ends as {status}; more speed or viscosity, less roughness, or other --cells"
            )
            .into());
        }
        warnings = solution.warnings;
    }
    // `init` writes isothermal scenes; solves warn where the film is too hot.
    warnings.retain(|warning| warning.field != FRICTION);
    // Mesh errors and smooth bodies that touch are part of the answer, no slips of the scene.
    let (errors, mistakes): (Vec<_>, Vec<_>) = warnings
        .into_iter()
        .partition(|warning| warning.field.starts_with(MESH_ERROR) || warning.field == TOUCHING);
    let Some(warning) = mistakes.first() else {
        output::warn(&errors);
        // Where smooth bodies touch, cells would be halved for a share that the contact film decides.
        if answers.disc.rq() == 0.0 && errors.iter().all(|warning| warning.field != TOUCHING) {
            writeln!(
                text,
                "accuracy = {ACCURACY} # cells are halved until the estimated errors of the mesh are below it"
            )?;
            scene.solver.accuracy = Some(ACCURACY);
        }
        return Ok((text, scene));
    };
    let remedy = match warning.field.as_str() {
        LARGEST_PRESSURE => "less speed or viscosity, or more load",
        field if field == ESTIMATE || FILMS.contains(&field) => "more --cells, or more speed or viscosity",
        _ => &warning.remedy,
    };
    let (field, message) = (&warning.field, &warning.message);
    Err(format!("the contact would be solved with a warning: {field}: {message}; {remedy}").into())
}

fn write(file: &Path, text: &str, force: bool) -> Result<(), String> {
    let opened = if force { File::create(file) } else { File::create_new(file) };
    let written = opened.and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|error| {
        let hint = if error.kind() == io::ErrorKind::AlreadyExists { "; --force writes over it" } else { "" };
        format!("{}: {error}{hint}", file.display())
    })
}

/// The text of the scene file.
fn scene(options: &Options, answers: &Answers) -> Result<String, Box<dyn Error>> {
    let bodies = bodies(options, answers)?;
    let trial = Scene::from_toml(&format!("{bodies}{}", grid([1.0; 2], [16; 2])))?;
    let half_width = trial.hertz()?.half_width_x;
    let inlet = half_width * flooded_inlet(&trial, half_width)?;
    if inlet > LARGEST_SLOPE * answers.radius.value {
        return Err(format!(
            "--speed = {}: the oil carries the ball on a film that fills an inlet of {} mm, more than {LARGEST_SLOPE} of the radius; less \
             speed or viscosity, or more load",
            answers.speed.text,
            plain(1e3 * inlet)
        )
        .into());
    }
    let disc = &answers.disc;
    let beyond =
        (REACH * disc.rq() * answers.radius.value / (GAP_BEYOND * half_width.powi(2))).powf(2.0 / 3.0);
    let touching = half_width * (1.0 + beyond + ROOM);
    let half_side = rounded((BOX * half_width.max(inlet / LONGEST_INLET)).max(touching));
    let cells = disc.cells(options.cells, 2.0 * half_side)?;
    disc.require_nodes(options.cells, [cells; 2])?;
    let cell = 2.0 * half_side / f64::from(cells);
    let more = ((inlet - half_side) / cell).ceil().max(0.0);
    let inlet = half_side + more * cell;
    disc.require_size([inlet + half_side, 2.0 * half_side])?;
    let tables = disc.tables(&options.file, HARDNESS)?;
    let tolerance = if disc.rq() > 0.0 { "tolerance = 1e-5 # bound for each residual\n" } else { "" };
    Ok(format!(
        "{bodies}{}{tables}\n[solver]\n\
         estimate = true # errors of the mesh, from a solve on half the cells along each side\n{tolerance}",
        grid([inlet, half_side], [cells + more as u32, cells])
    ))
}

/// Distance of the inlet edge from the middle, in half-widths, from which on the oil floods the contact:
/// `1 + 3.06 ((R/a)^2 H)^0.58` with the film `H` by formula over the radius (Hamrock and Dowson 1977,
/// starvation).
fn flooded_inlet(scene: &Scene, half_width: f64) -> Result<f64, InputError> {
    let (radius, _) = scene.form.radii();
    let film = scene.formula_film()?.map_or(0.0, |formula| formula.central);
    Ok((1.0 + 3.06 * (radius * film / (half_width * half_width)).powf(0.58)).max(BOX))
}

/// All of the scene that does not depend on the size of the contact.
fn bodies(options: &Options, answers: &Answers) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    let (modulus, ratio) = STEEL;
    writeln!(
        text,
        "# A steel ball on a steel disc in oil. Numbers are in SI units or have a unit. `stribeck check` estimates the\n\
         # contact, `stribeck solve` solves it, `stribeck curve` varies the speed. Every key: docs/scene.md.\n\n\
         [form]\nkind = \"sphere\"\nradius = {}\n",
        answers.radius.entry()
    )?;
    for body in ["ball", "disc"] {
        writeln!(
            text,
            "[materials.{body}] # steel\nmodulus = \"{} GPa\" # Young's modulus\npoisson = {ratio}\n",
            modulus * 1e-9
        )?;
    }
    writeln!(text, "[load]\nforce = {} # or hertz_pressure = \"1 GPa\"\n", answers.load.entry())?;
    writeln!(
        text,
        "[motion]\nentrainment_speed = {} # mean of the two surface speeds; the oil flows along +x\n\
         slide_roll_ratio = {:?} # sliding speed over that; positive: the ball is faster\n",
        answers.speed.entry(),
        answers.slide_roll_ratio
    )?;
    write!(
        text,
        "{}\n\
         [friction]\n\
         boundary_coefficient = 0.115 # where solids touch\n\
         eyring_stress = \"5 MPa\" # shear stress from which on the oil thins; leave the line out for a Newtonian oil\n{}",
        oil::tables(options, [&answers.eta0, &answers.alpha]),
        answers.disc.fluid_limit()
    )?;
    Ok(text)
}

/// A box of so many cells along x and y that ends `inlet` before the middle and `half_side` on the other
/// sides \[m\].
fn grid([inlet, half_side]: [f64; 2], [nx, ny]: [u32; 2]) -> String {
    let [inlet, edge] = [inlet, half_side].map(|length| format!("{} um", plain(length * 1e6)));
    format!(
        "\n[grid] # cells that fill a box around the contact: {BOX} Hertz half-widths or more to each side, as far as asperities\n\
         nx = {nx} # touch, and further at the inlet where a thick film needs it\nny = {ny}\nx = [\"-{inlet}\", \"{edge}\"]\ny = [\"-{edge}\", \"{edge}\"]\n"
    )
}

/// The next larger number of two digits.
fn rounded(length: f64) -> f64 {
    let step = 10_f64.powf(length.log10().floor() - 1.0);
    (length / step).ceil() * step
}

/// The number without the noise of its last digits.
fn plain(number: f64) -> String {
    format!("{}", format!("{number:.6e}").parse().unwrap_or(number))
}
