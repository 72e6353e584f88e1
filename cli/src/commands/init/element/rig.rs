//! Test rigs.

use std::error::Error;
use std::f64::consts::TAU;

use stribeck::units::Dimension;

use super::super::{Options as Init, plain};
use super::{Element, LINE_GRID, OIL, USUAL_CELSIUS, quantity, rotation, round_grid, steel};

/// Effective modulus of steel on glass \[Pa\].
const GLASS: f64 = 117e9;
/// Temperature of the oil in ASTM D4172 \[degC\].
const D4172_CELSIUS: f64 = 75.0;

/// Test rigs with usual specimens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Rig {
    /// Mini traction machine: steel ball of 3/4 inch on a steel disc, slide-roll ratio 0.5
    Mtm,
    /// Pin on disc, dry: steel ball of 10 mm at rest on a steel disc
    PinOnDisc,
    /// Ball on disc for film thickness: steel ball of 3/4 inch rolling on glass
    BallOnDisc,
    /// Two steel discs of 80 mm
    TwinDisc,
    /// Four balls of 1/2 inch: a rotating one on three at rest
    FourBall,
}

impl Rig {
    /// Its options beside the load.
    pub(super) fn options(self) -> &'static [&'static str] {
        match self {
            Self::Mtm | Self::BallOnDisc | Self::TwinDisc => {
                &["--radius", "--speed", "--slide-roll-ratio", OIL]
            }
            Self::PinOnDisc => &["--radius", "--speed"],
            Self::FourBall => &["--radius", "--rotation", OIL],
        }
    }

    /// Its contact.
    pub(super) fn element(self, options: &Init) -> Result<Element, Box<dyn Error>> {
        match self {
            Self::Mtm => ball(
                options,
                "# A mini traction machine: a steel ball of 3/4 inch on a steel disc, 1 GPa at 37 N. Specimens: PCS Instruments MTM2.\n",
                ["9.525 mm", "37 N", "1 m/s"],
                (["steel"; 2], 0.5),
            ),
            Self::BallOnDisc => ball(
                options,
                "# A ball-on-disc rig for film thickness by interferometry: a steel ball of 3/4 inch rolls on a glass disc. Specimens: PCS\n\
                 # Instruments EHD2.\n",
                ["9.525 mm", "20 N", "0.5 m/s"],
                (["steel", "glass"], 0.0),
            ),
            Self::PinOnDisc => pin_on_disc(options),
            Self::TwinDisc => twin_disc(options),
            Self::FourBall => four_ball(options),
        }
    }
}

/// A ball on a disc with the usual `[radius, load, speed]`, materials and slide-roll ratio.
fn ball(
    options: &Init,
    title: &str,
    [radius, load, speed]: [&str; 3],
    (materials, slide_roll_ratio): ([&'static str; 2], f64),
) -> Result<Element, Box<dyn Error>> {
    let (radius, metres) = quantity(Dimension::Length, "--radius", options.radius.as_ref(), radius)?;
    let (load, force) = quantity(Dimension::Force, "--load", options.load.as_ref(), load)?;
    let modulus = if materials.contains(&"glass") { GLASS } else { steel() };
    let (speed, _) = quantity(Dimension::Speed, "--speed", options.speed.as_ref(), speed)?;
    Ok(Element {
        title: title.to_owned(),
        form: format!("kind = \"sphere\"\nradius = {radius}\n"),
        materials,
        load: format!("force = {load}\n"),
        motion: format!(
            "entrainment_speed = {speed} # mean of both surfaces\nslide_roll_ratio = {:?} # sliding speed over that\n",
            options.slide_roll_ratio.unwrap_or(slide_roll_ratio)
        ),
        boundary: 0.115,
        bearing: String::new(),
        is_dry: false,
        celsius: USUAL_CELSIUS,
        grid: round_grid([metres, force], modulus, false)?,
    })
}

/// ASTM G99 with its values of an interlaboratory test.
fn pin_on_disc(options: &Init) -> Result<Element, Box<dyn Error>> {
    let (radius_text, radius) = quantity(Dimension::Length, "--radius", options.radius.as_ref(), "5 mm")?;
    let (load, force) = quantity(Dimension::Force, "--load", options.load.as_ref(), "10 N")?;
    let (speed, _) = quantity(Dimension::Speed, "--speed", options.speed.as_ref(), "0.1 m/s")?;
    Ok(Element {
        title: "# A dry pin-on-disc test: a steel ball of 10 mm at rest on a steel disc at 0.1 m/s under 10 N, the conditions of the\n\
                # interlaboratory test of ASTM G99, with its friction coefficient of steel on steel.\n"
            .to_owned(),
        form: format!("kind = \"sphere\"\nradius = {radius_text}\n"),
        materials: ["steel"; 2],
        load: format!("force = {load}\n"),
        motion: format!("ball_speed = 0.0\ndisc_speed = {speed}\n"),
        boundary: 0.6,
        bearing: String::new(),
        is_dry: true,
        celsius: USUAL_CELSIUS,
        grid: round_grid([radius, force], steel(), true)?,
    })
}

/// Two discs.
fn twin_disc(options: &Init) -> Result<Element, Box<dyn Error>> {
    let (radius, _) = quantity(Dimension::Length, "--radius", options.radius.as_ref(), "40 mm")?;
    let (speed, _) = quantity(Dimension::Speed, "--speed", options.speed.as_ref(), "4 m/s")?;
    let load = match &options.load {
        Some(_) => {
            let (load, _) = quantity(Dimension::ForcePerLength, "--load", options.load.as_ref(), "")?;
            format!("force = {load} # per width of the discs\n")
        }
        None => "hertz_pressure = \"1 GPa\"\n".to_owned(),
    };
    Ok(Element {
        title: "# A twin-disc machine: two steel discs of 80 mm diameter and 5 mm width (specimens of FZG, Munich). Loads are per metre of width.\n"
            .to_owned(),
        form: format!("kind = \"cylinder\"\nradii = [{radius}, {radius}]\n"),
        materials: ["steel"; 2],
        load,
        motion: format!(
            "entrainment_speed = {speed} # mean of both surfaces\nslide_roll_ratio = {:?}\n",
            options.slide_roll_ratio.unwrap_or(0.1)
        ),
        boundary: 0.115,
        bearing: String::new(),
        is_dry: false,
        celsius: USUAL_CELSIUS,
        grid: LINE_GRID.to_owned(),
    })
}

/// One of the three contacts: with the radius `R` of the balls the normal force is `F/sqrt(6)`, and the contacts lie `R/sqrt(3)` from
/// the axis.
fn four_ball(options: &Init) -> Result<Element, Box<dyn Error>> {
    let (radius_text, radius) = quantity(Dimension::Length, "--radius", options.radius.as_ref(), "6.35 mm")?;
    let (load, force) = quantity(Dimension::Force, "--load", options.load.as_ref(), "147 N")?;
    let rotation = rotation(options, 1200.0)?;
    let speed = TAU * rotation / 60.0 * radius / 3.0_f64.sqrt();
    Ok(Element {
        title: format!(
            "# A four-ball test: one of three contacts of a steel ball of 1/2 inch that turns at {rotation} rpm under {load} (ASTM D4172,\n\
             # method A: 147 N, 1200 rpm, 75 degC). Each contact has the load over sqrt(6), at the radius over sqrt(3) from the axis. The\n\
             # rotating ball passes three contacts in a turn, each ball at rest has one: friction torque and wear of the rotating ball are\n\
             # three times those of one contact.\n"
        ),
        form: format!("kind = \"sphere\"\nradii = [{radius_text}, {radius_text}]\n"),
        materials: ["steel"; 2],
        load: format!("force = {} # N\n", plain(force / 6.0_f64.sqrt())),
        motion: format!("ball_speed = {} # m/s\ndisc_speed = 0.0\n", plain(speed)),
        boundary: 0.115,
        bearing: String::new(),
        is_dry: false,
        celsius: D4172_CELSIUS,
        grid: round_grid([0.5 * radius, force / 6.0_f64.sqrt()], steel(), false)?,
    })
}
