//! Scenes with a cycle for `stribeck cycle`: gear flanks, cams, reciprocating balls.

mod cam;
mod gear;
mod reciprocating;
mod scene;

use std::error::Error;
use std::path::PathBuf;

use stribeck::sim::{MixedLubricationSim, Scene};
use stribeck::units::Dimension;

use super::given::{self, OIL};
use super::{Options as Init, answers};
use crate::output::{self, Outcome};

/// Options of the oil, the roughness and the cells, which all machines take.
const COMMON_OPTIONS: [&str; 5] = [OIL, "--roughness", "--length", "--finish", "--cells"];

/// The number of `text`, with one of the `units` and its factor behind it or alone.
fn with_unit(units: &[(&str, f64)], text: &str) -> Result<f64, String> {
    let text = text.trim();
    let in_unit =
        units.iter().find_map(|(unit, factor)| Some((text.strip_suffix(unit)?.trim_end(), *factor)));
    let (digits, factor) = in_unit.unwrap_or((text, 1.0));
    let wrong = || {
        let names: Vec<&str> = units.iter().map(|(unit, _)| *unit).collect();
        format!("a number is expected, alone or with its unit: {}", names.join(", "))
    };
    digits.parse::<f64>().map(|value| factor * value).map_err(|_| wrong())
}

/// Options of the machines.
#[derive(clap::Args)]
pub(super) struct Options {
    /// Flanks of a spur gear: a scene for `stribeck cycle`
    #[arg(long, requires_all = ["module", "teeth", "face_width", "torque", "rotation"], conflicts_with_all = ["cam", "reciprocating"])]
    gear: bool,
    /// Module of the gear
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH")]
    module: Option<String>,
    /// Teeth of pinion and wheel
    #[arg(long, num_args = 2, value_names = ["PINION", "WHEEL"])]
    teeth: Option<Vec<u32>>,
    /// Pressure angle of the basic rack [default: 20 deg]
    #[arg(long, allow_hyphen_values = true, value_name = "ANGLE")]
    pressure_angle: Option<String>,
    /// Profile shift coefficients of pinion and wheel [default: 0 0]
    #[arg(long, num_args = 2, allow_hyphen_values = true, value_names = ["PINION", "WHEEL"])]
    shift: Option<Vec<f64>>,
    /// Centre distance [default: without backlash]
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH")]
    centre_distance: Option<String>,
    /// Width of the flanks or of the cam
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH")]
    face_width: Option<String>,
    /// Torque of the pinion, N m
    #[arg(long, allow_hyphen_values = true, value_name = "N m", value_parser = |text: &str| with_unit(&[("N m", 1.0), ("Nm", 1.0)], text))]
    torque: Option<f64>,
    /// Rate of rotation of the pinion or the cam, revolutions per minute
    #[arg(long, allow_hyphen_values = true, value_name = "RPM", value_parser = |text: &str| with_unit(&[("rpm", 1.0)], text))]
    rotation: Option<f64>,
    /// Load of a pair of teeth where two pairs are in mesh: from a third to two thirds of the load, or half of it
    /// [default: trapezoid]
    #[arg(long, value_enum)]
    load_sharing: Option<gear::Sharing>,
    /// Cam and flat follower with the lift in this file, lines of an angle in degrees and a lift in metres
    #[arg(long, value_name = "FILE", requires_all = ["base_circle", "face_width", "rotation", "spring_rate", "preload", "mass"], conflicts_with = "reciprocating")]
    cam: Option<PathBuf>,
    /// Radius of the base circle of the cam
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH")]
    base_circle: Option<String>,
    /// Rate of the spring of the follower, N/m
    #[arg(long, allow_hyphen_values = true, value_name = "N/m", value_parser = |text: &str| with_unit(&[("N/mm", 1e3), ("N/m", 1.0)], text))]
    spring_rate: Option<f64>,
    /// Force of the spring without lift
    #[arg(long, allow_hyphen_values = true, value_name = "FORCE")]
    preload: Option<String>,
    /// Mass that moves with the follower, kg
    #[arg(long, allow_hyphen_values = true, value_name = "kg", value_parser = |text: &str| with_unit(&[("kg", 1.0), ("g", 1e-3)], text))]
    mass: Option<f64>,
    /// Ball of --radius under --load on a disc that reciprocates
    #[arg(long, requires_all = ["stroke", "frequency"])]
    reciprocating: bool,
    /// Stroke of the disc, from end to end
    #[arg(long, allow_hyphen_values = true, value_name = "LENGTH")]
    stroke: Option<String>,
    /// Frequency of the strokes, Hz
    #[arg(long, allow_hyphen_values = true, value_name = "Hz", value_parser = |text: &str| with_unit(&[("Hz", 1.0)], text))]
    frequency: Option<f64>,
}

impl Options {
    /// Names of the options beside those that select a machine, and whether each is given.
    pub(super) fn given(&self) -> [(&'static str, bool); 15] {
        [
            ("--module", self.module.is_some()),
            ("--teeth", self.teeth.is_some()),
            ("--pressure-angle", self.pressure_angle.is_some()),
            ("--shift", self.shift.is_some()),
            ("--centre-distance", self.centre_distance.is_some()),
            ("--face-width", self.face_width.is_some()),
            ("--torque", self.torque.is_some()),
            ("--rotation", self.rotation.is_some()),
            ("--load-sharing", self.load_sharing.is_some()),
            ("--base-circle", self.base_circle.is_some()),
            ("--spring-rate", self.spring_rate.is_some()),
            ("--preload", self.preload.is_some()),
            ("--mass", self.mass.is_some()),
            ("--stroke", self.stroke.is_some()),
            ("--frequency", self.frequency.is_some()),
        ]
    }

    /// Revolutions per minute of the option `--rotation`.
    pub(super) fn rotation(&self) -> Option<f64> {
        self.rotation
    }
}

/// A contact over a cycle.
struct Machine {
    /// First line of the scene file.
    title: String,
    /// Names of ball and disc.
    bodies: [&'static str; 2],
    is_line: bool,
    /// Whether the flow turns back.
    reverses: bool,
    /// A key of the cycle beside the lists: `once` or `period`.
    key: String,
    /// Time \[s\] or angle \[rad\] of the rows.
    places: (&'static str, Vec<f64>),
    /// Loads \[N\], of a line per length \[N/m\].
    loads: Vec<f64>,
    /// Speeds of ball and disc relative to the contact \[m/s\].
    speeds: [Vec<f64>; 2],
    /// Reduced radii \[m\].
    radii: Vec<f64>,
}

/// Writes the scene of the machine that the options describe; `None` without one.
pub(super) fn run(options: &Init) -> Result<Option<Outcome>, Box<dyn Error>> {
    let machine = &options.machine;
    let (name, used): (_, &[&str]) = match (machine.gear, &machine.cam, machine.reciprocating) {
        (true, ..) => ("--gear", &gear::OPTIONS),
        (_, Some(_), _) => ("--cam", &cam::OPTIONS),
        (.., true) => ("--reciprocating", &reciprocating::OPTIONS),
        _ => return Ok(None),
    };
    given::require_used(options, name, &[used, &COMMON_OPTIONS].concat())?;
    let answers = answers::answers(options, false, None)?;
    let machine = match name {
        "--gear" => gear::machine(machine)?,
        "--cam" => cam::machine(machine)?,
        _ => reciprocating::machine(machine, &answers)?,
    };
    let text = scene::text(options, &answers, &machine)?;
    let scene = Scene::from_toml(&text)?;
    let warnings = MixedLubricationSim::builder(scene.clone()).check_contact()?;
    output::warn(&warnings);
    super::write(&options.file, &text, options.force)?;
    if options.json {
        output::print(&serde_json::to_value(&scene)?)?;
    }
    output::report_files(std::slice::from_ref(&options.file), options.json)?;
    Ok(Some(Outcome::Converged))
}

/// Length \[m\] of a part of a machine from which on it needs its unit.
const WITHOUT_UNIT: f64 = 1.0;

/// The positive value of the option `key`.
fn length(key: &str, text: &Option<String>) -> Result<f64, Box<dyn Error>> {
    let text = text.as_ref().ok_or_else(|| format!("{key} is missing"))?;
    if text.trim().parse::<f64>().is_ok_and(|metres| metres >= WITHOUT_UNIT) {
        return Err(format!("{key} = {text}: the unit is missing; \"{text} mm\", or \"{text} m\"").into());
    }
    Ok(output::positive(Dimension::Length, key, text)?)
}

/// The positive number of the option `key`.
fn number(key: &str, value: Option<f64>) -> Result<f64, Box<dyn Error>> {
    let value = value.ok_or_else(|| format!("{key} is missing"))?;
    Ok(output::require(value > 0.0, key, value, "finite and > 0")?)
}
