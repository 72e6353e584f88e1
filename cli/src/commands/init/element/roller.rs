//! A steel roller on a steel flat.

use std::error::Error;

use stribeck::units::Dimension;

use super::super::Options as Init;
use super::{Element, LINE_GRID, USUAL_CELSIUS, quantity};

/// A steel roller on a steel flat.
pub(super) fn element(options: &Init) -> Result<Element, Box<dyn Error>> {
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
