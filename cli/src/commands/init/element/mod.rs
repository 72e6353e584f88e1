//! Scenes of test rigs, rolling bearings, rollers and journal bearings.

mod bearing;
mod bearing_list;
mod rig;
mod roller;
mod rough;

use std::error::Error;

use stribeck::analytic::HertzPoint;
use stribeck::sim::scene::NamedMaterial;
use stribeck::sim::{MixedLubricationSim, RigidBearing, Scene};
use stribeck::units::Dimension;

use super::given::{self, OIL};
use super::{Options as Init, answers, oil, plain, rounded};
use crate::output::{self, Outcome};

/// Half a side of the box of a dry contact, in half-widths: room for the scar to grow.
const DRY_BOX: f64 = 3.0;
/// Usual temperature of the oil that is supplied to a journal bearing \[degC\].
const USUAL_SUPPLY: f64 = 40.0;
/// Keys of `[grid]` of line contacts.
const LINE_GRID: &str = "accuracy = \"2 %\" # estimated error, for which cells and box are chosen\n";

/// The table of the solver of a lubricated contact on given cells.
const ESTIMATE: &str = "\n[solver]\nestimate = true # errors of the mesh\n";

/// Temperature of the oil in the inlet where no standard names one \[degC\].
const USUAL_CELSIUS: f64 = 60.0;

/// Options of the elements.
#[derive(clap::Args)]
pub(super) struct Options {
    /// Contact of a test rig with its usual bodies
    #[arg(long, value_enum, conflicts_with_all = ["gear", "cam", "reciprocating", "bearing", "roller", "journal"])]
    rig: Option<rig::Rig>,
    /// Heaviest loaded contact at the inner ring of a rolling bearing under the radial --load, "6205"
    #[arg(long, value_name = "NAME", conflicts_with_all = ["gear", "cam", "reciprocating", "roller", "journal"])]
    bearing: Option<String>,
    /// Steel roller of --radius on a flat
    #[arg(long, conflicts_with_all = ["gear", "cam", "reciprocating", "journal"])]
    roller: bool,
    /// Journal bearing under --load, with grooves and a heat balance
    #[arg(long, conflicts_with_all = ["gear", "cam", "reciprocating"])]
    journal: bool,
}

/// A contact to write.
struct Element {
    /// Comment lines at the top: the element, and the source of its geometry.
    title: String,
    /// Keys of `[form]`.
    form: String,
    /// Named materials of ball and disc.
    materials: [&'static str; 2],
    /// Keys of `[load]`.
    load: String,
    /// Keys of `[motion]`.
    motion: String,
    /// Boundary friction coefficient.
    boundary: f64,
    /// Table of the rolling bearing, or nothing.
    bearing: String,
    is_dry: bool,
    /// Usual temperature of the oil \[degC\].
    celsius: f64,
    /// Keys of `[grid]`.
    grid: String,
}

/// Writes the scene of the element that the options describe; `None` without one.
pub(super) fn run(options: &Init) -> Result<Option<Outcome>, Box<dyn Error>> {
    let element = &options.element;
    let rough = |used: &[&'static str]| [used, &rough::OPTIONS].concat();
    let text = if let Some(rig) = element.rig {
        require_used(options, "--rig", &rough(rig.options()))?;
        text(options, &rough::roughened(options, "--rig", rig.element(options)?)?)?
    } else if let Some(name) = &element.bearing {
        require_used(options, "--bearing", &rough(&["--rotation", "--slide-roll-ratio", OIL]))?;
        text(options, &rough::roughened(options, "--bearing", bearing::element(options, name)?)?)?
    } else if element.roller {
        require_used(options, "--roller", &rough(&["--radius", "--speed", "--slide-roll-ratio", OIL]))?;
        text(options, &rough::roughened(options, "--roller", roller::element(options)?)?)?
    } else if element.journal {
        require_used(options, "--journal", &["--rotation", OIL])?;
        journal(options)?
    } else {
        return Ok(None);
    };
    let json = if element.journal {
        RigidBearing::from_toml(&text)?;
        serde_json::to_value(toml::from_str::<toml::Table>(&text)?)?
    } else {
        let scene = Scene::from_toml(&text)?;
        output::warn(&MixedLubricationSim::builder(scene.clone()).check_contact()?);
        serde_json::to_value(&scene)?
    };
    super::write(&options.file, &text, options.force)?;
    if options.json {
        output::print(&json)?;
    }
    output::report_files(std::slice::from_ref(&options.file), options.json)?;
    Ok(Some(Outcome::Converged))
}

/// Error for a given option that the element `name`, which takes the load and the `used` options, leaves out.
fn require_used(options: &Init, name: &str, used: &[&str]) -> Result<(), String> {
    given::require_used(options, name, &[used, &["--load"]].concat())
}

/// The text of a quantity: that of the option `key`, or the usual one; and its value.
fn quantity(
    dimension: Dimension,
    key: &str,
    given: Option<&String>,
    usual: &str,
) -> Result<(String, f64), Box<dyn Error>> {
    let text = given.map_or(usual, String::as_str);
    let value = output::positive(dimension, key, text)?;
    Ok((if text.parse::<f64>().is_ok() { text.to_owned() } else { format!("{text:?}") }, value))
}

/// Revolutions per minute.
fn rotation(options: &Init, usual: f64) -> Result<f64, Box<dyn Error>> {
    let given = options.machine.rotation().unwrap_or(usual);
    Ok(output::require(given > 0.0, "--rotation", given, "finite and > 0, in rpm")?)
}

/// The tables of the oil: by the options, or of the usual grade at the usual temperature.
fn oil_tables(options: &Init, grade: &str, celsius: f64) -> Result<String, Box<dyn Error>> {
    if options.grade.is_some() || options.eta0.is_some() || options.alpha.is_some() {
        let oil = answers::oil(options)?;
        return Ok(oil::tables(options, oil.each_ref()));
    }
    Ok(format!(
        "[lubricant]\ngrade = \"{grade}\" # kinematic viscosity at 40 degC\nviscosity_index = 95 # paraffinic mineral oils\n\n[thermal]\n\
         bulk_temperature = \"{celsius} degC\" # of the oil in the inlet\n"
    ))
}

/// The scene file of `element`.
fn text(options: &Init, element: &Element) -> Result<String, Box<dyn Error>> {
    let Element {
        title,
        form,
        materials: [ball, disc],
        load,
        motion,
        boundary,
        bearing,
        is_dry,
        celsius,
        grid,
    } = element;
    let bodies = format!(
        "{title}# `stribeck check` lists the contact, `stribeck solve` solves it. Every key: docs/scene.md.\n\n[form]\n{form}\n\
         [materials.ball]\nmaterial = \"{ball}\"\n\n[materials.disc]\nmaterial = \"{disc}\"\n\n[load]\n{load}\n[motion]\n{motion}\n"
    );
    let oil = if *is_dry {
        format!("[friction]\nboundary_coefficient = {boundary}\n")
    } else {
        format!(
            "{}\n[friction]\nboundary_coefficient = {boundary} # where solids touch\neyring_stress = \"5 MPa\" # shear stress above which the oil \
             thins\n{}",
            oil_tables(options, "ISO VG 68", *celsius)?,
            answers::disc(options)?.map_or("", |disc| disc.fluid_limit())
        )
    };
    Ok(format!("{bodies}{oil}{bearing}\n[grid]\n{grid}"))
}

/// Cells around a circular contact of the radius \[m\] and `force` \[N\] with the effective modulus \[Pa\]: a box for a scar to grow in, or with an
/// inlet.
fn round_grid([radius, force]: [f64; 2], modulus: f64, is_dry: bool) -> Result<String, Box<dyn Error>> {
    let half_width = HertzPoint::from_load(radius, radius, modulus, force)?.half_width_x;
    let length = |reach: f64| plain(1e6 * rounded(reach * half_width));
    Ok(if is_dry {
        let side = length(DRY_BOX);
        format!(
            "nx = 96\nny = 96\nx = [\"-{side} um\", \"{side} um\"]\ny = [\"-{side} um\", \"{side} um\"]\n"
        )
    } else {
        let [inlet, outlet, side] = [3.5, 1.7, 2.0].map(length);
        format!(
            "nx = 128\nny = 108\nx = [\"-{inlet} um\", \"{outlet} um\"] # the oil flows along +x\ny = [\"-{side} um\", \"{side} um\"]\n{ESTIMATE}"
        )
    })
}

/// Effective modulus of steel on steel \[Pa\].
fn steel() -> f64 {
    let steel = NamedMaterial::Steel;
    steel.modulus() / (1.0 - steel.poisson().powi(2))
}

/// A journal bearing.
fn journal(options: &Init) -> Result<String, Box<dyn Error>> {
    let (load, _) = quantity(Dimension::Force, "--load", options.load.as_ref(), "2 kN")?;
    let rotation = rotation(options, 3000.0)?;
    let oil = oil_tables(options, "ISO VG 32", USUAL_SUPPLY)?;
    // With a heat balance the temperature of an oil by its grade is that of the supply.
    let (oil, heat) = match oil.split_once("\n\n[thermal]\n") {
        Some((oil, _)) => (
            format!(
                "{oil}\nalpha = 0 # isoviscous: rigid surfaces with a piezoviscous oil overestimate pressure and film\n"
            ),
            format!(
                "supply_temperature = \"{} degC\" # heat balance: the oil has the mean of supply and outlet\n",
                plain(options.temperature.map_or(USUAL_SUPPLY, |kelvin| kelvin - 273.15))
            ),
        ),
        None => (oil, String::new()),
    };
    Ok(format!(
        "# A steady loaded journal bearing with one axial groove opposite the load. Relative clearance 1.5 per mille, width over diameter 0.5.\n\
         # `stribeck solve` computes eccentricity, friction, flows and temperature. Every key: docs/given_film.md.\n\n\
         [given_film]\nkind = \"journal\"\ndiameter = \"50 mm\"\nwidth = \"25 mm\"\nclearance = \"37.5 um\" # radial\n\
         speed = \"{rotation} rpm\"\nload = {load}\n\
         groove_angles = [\"180 deg\"] # from the load, in the direction of rotation\ngroove_width = \"5 mm\"\nsupply_pressure = \"1 bar\" # above ambient\nnx = 120 # cells along and across the motion\nny = 16\n\
         {heat}\n{oil}"
    ))
}
