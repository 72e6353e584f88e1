//! A steel roller on a steel flat, smooth or rough.

use std::error::Error;

use stribeck::sim::Scene;
use stribeck::units::Dimension;

use super::super::answers::disc;
use super::super::disc::{Disc, STRIP};
use super::super::{HARDNESS, Options as Init, plain, rounded};
use super::{Element, LINE_GRID, USUAL_CELSIUS, quantity, text};

/// Ends of the box of a rough roller before and behind the middle, in half-widths.
const ENDS: [f64; 2] = [3.5, 1.7];

/// The scene of a smooth roller, or of a rough one as a strip: on a single row oil could not flow around asperities.
pub(super) fn element(options: &Init) -> Result<Element, Box<dyn Error>> {
    let smooth = smooth(options)?;
    let disc = disc(options)?.unwrap_or(Disc::Smooth);
    if disc.rq() == 0.0 {
        return Ok(smooth);
    }
    let half_width = Scene::from_toml(&text(options, &smooth)?)?.hertz()?.half_width_x;
    let [inlet, outlet] = ENDS.map(|reach| rounded(reach * half_width));
    let cells = disc.cells(options.cells, inlet + outlet)?;
    let grid = format!(
        "{STRIP}nx = {cells}\nx = [\"-{} um\", \"{} um\"] # the oil flows along +x\n{}",
        plain(1e6 * inlet),
        plain(1e6 * outlet),
        disc.tables(&options.file, HARDNESS)?
    );
    Ok(Element { grid, ..smooth })
}

/// A smooth steel roller on a steel flat.
fn smooth(options: &Init) -> Result<Element, Box<dyn Error>> {
    let (radius, _) = quantity(Dimension::Length, "--radius", options.radius.as_ref(), "10 mm")?;
    let (speed, _) = quantity(Dimension::Speed, "--speed", options.speed.as_ref(), "1 m/s")?;
    let load = match &options.load {
        Some(_) => {
            let (load, _) = quantity(Dimension::ForcePerLength, "--load", options.load.as_ref(), "")?;
            format!("force = {load} # per length of the roller\n")
        }
        None => "hertz_pressure = \"1 GPa\" # or force = \"200 kN/m\"\n".to_owned(),
    };
    Ok(Element {
        title: "# A steel roller on a steel flat: a line contact, loads and flows are per metre of length.\n"
            .to_owned(),
        form: format!(
            "kind = \"cylinder\"\nradius = {radius} # of two rollers: radii = [\"10 mm\", \"20 mm\"]\n"
        ),
        materials: ["steel"; 2],
        load,
        motion: format!(
            "entrainment_speed = {speed}\nslide_roll_ratio = {:?}\n",
            options.slide_roll_ratio.unwrap_or(0.05)
        ),
        boundary: 0.115,
        bearing: String::new(),
        is_dry: false,
        celsius: USUAL_CELSIUS,
        grid: LINE_GRID.to_owned(),
    })
}
