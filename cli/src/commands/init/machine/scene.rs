//! The scene file of a machine.

use std::error::Error;
use std::fmt::{self, Write as _};

use stribeck::InputError;
use stribeck::analytic::{HertzLine, HertzPoint};
use stribeck::sim::Scene;
use stribeck::surface::Form;

use super::super::answers::Answers;
use super::super::disc::{Disc, STRIP, STRIP_ROWS};
use super::super::{HARDNESS, LARGEST_SLOPE, Options, STEEL, oil, plain, rounded};
use super::Machine;

/// Distance of the edges of the box from the middle, in the widest half-width: upstream, and downstream.
const UPSTREAM: f64 = 4.0;
const DOWNSTREAM: f64 = 2.0;
/// Cells along x of a line, and along each side of a point contact.
const LINE_CELLS: u32 = 256;
const POINT_CELLS: u32 = 96;
/// Cells in the half-width of the narrowest contact; cycles warn of fewer.
const NARROWEST: f64 = 10.0;

/// Values of a list in lines.
fn list(values: &[f64]) -> String {
    let lines =
        values.chunks(8).map(|chunk| chunk.iter().map(|v| format!("{v:.9e}")).collect::<Vec<_>>().join(", "));
    format!("[\n  {},\n]", lines.collect::<Vec<_>>().join(",\n  "))
}

/// Longest distance of a flooded inlet from the middle over the contacts of the machine \[m\]. `text` has all tables but the grid.
fn longest_inlet(text: &str, machine: &Machine) -> Result<f64, Box<dyn Error>> {
    let grid = if machine.is_line {
        "nx = 16\nx = [-1.0, 1.0]"
    } else {
        "nx = 16\nny = 16\nx = [-1.0, 1.0]\ny = [-1.0, 1.0]"
    };
    let mut scene = Scene::from_toml(&format!("{text}[grid]\n{grid}\n"))?;
    let mut longest = 0.0_f64;
    for (k, (&radius, &load)) in machine.radii.iter().zip(&machine.loads).enumerate() {
        scene.form = if machine.is_line { Form::Cylinder { radius } } else { Form::Sphere { radius } };
        scene.load.force = Some(load);
        let speed = 0.5 * (machine.speeds[0][k] + machine.speeds[1][k]).abs();
        if scene.is_lubricated() && speed > 0.0 {
            scene.motion.entrainment_speed = speed;
            let half_width = scene.hertz()?.half_width_x;
            let inlet = half_width * super::super::flooded_inlet(&scene, half_width)?;
            // The usual box reaches over shorter inlets, however wide the contact is.
            if inlet > (LARGEST_SLOPE * radius).max(UPSTREAM * half_width) {
                return Err(format!(
                    "row {} of the cycle: under {load:.4e} {} at {speed:.4e} m/s the oil fills an inlet of {} mm, more than {LARGEST_SLOPE} of the \
                     radius of {} mm; more load, or less speed or viscosity",
                    k + 1,
                    if machine.is_line { "N/m" } else { "N" },
                    plain(1e3 * inlet),
                    plain(1e3 * radius)
                )
                .into());
            }
            longest = longest.max(inlet);
        }
    }
    Ok(longest)
}

/// The text of the scene.
pub(super) fn text(
    options: &Options,
    answers: &Answers,
    machine: &Machine,
) -> Result<String, Box<dyn Error>> {
    let (modulus, poisson) = STEEL;
    let equivalent = modulus / (1.0 - poisson * poisson);
    let [narrowest, half_width] = half_widths(machine, equivalent)?;
    let means = (0..machine.radii.len()).map(|k| 0.5 * (machine.speeds[0][k] + machine.speeds[1][k]).abs());
    let (fastest, speed) =
        means.enumerate().fold((0, 0.0), |best, next| if next.1 > best.1 { next } else { best });
    let [ball, disc] = machine.bodies;
    let sign = (machine.speeds[0][fastest] + machine.speeds[1][fastest]).signum();
    let sliding = sign * (machine.speeds[0][fastest] - machine.speeds[1][fastest]);
    let mut text = format!(
        "# {}.\n# `stribeck cycle` solves it in time, `stribeck solve` one contact at the largest speed. Ball: the {ball}, disc: the {disc}.\n\
         # Every key: docs/scene.md and docs/cycles.md.\n\n",
        machine.title
    );
    let kind = if machine.is_line { "cylinder" } else { "sphere" };
    writeln!(text, "[form]\nkind = \"{kind}\"\nradius = {:e} # m\n", machine.radii[fastest])?;
    for body in ["ball", "disc"] {
        writeln!(
            text,
            "[materials.{body}] # steel\nmodulus = \"{} GPa\"\npoisson = {poisson}\n",
            modulus * 1e-9
        )?;
    }
    let unit = if machine.is_line { "N/m" } else { "N" };
    writeln!(text, "[load]\nforce = {:e} # {unit}\n", machine.loads[fastest])?;
    writeln!(
        text,
        "[motion]\nentrainment_speed = {speed:e} # m/s\nslide_roll_ratio = {:e}\n",
        sliding / speed
    )?;
    writeln!(
        text,
        "{}\n[friction]\nboundary_coefficient = 0.115 # where solids touch\neyring_stress = \"5 MPa\" # from which on the oil thins\n{}",
        oil::tables(options, [&answers.eta0, &answers.alpha]),
        answers.disc.fluid_limit()
    )?;
    let shortest = UPSTREAM * half_width;
    let up = longest_inlet(&text, machine)?.max(shortest);
    text.push_str(&grid(options, &answers.disc, machine, [narrowest, half_width], up)?);
    text.push_str(&cycle(machine)?);
    Ok(text)
}

/// Half-widths of the narrowest and of the widest contact \[m\].
fn half_widths(machine: &Machine, modulus: f64) -> Result<[f64; 2], InputError> {
    let [mut narrowest, mut widest] = [f64::INFINITY, 0.0];
    for (radius, load) in machine.radii.iter().zip(&machine.loads) {
        let half = if machine.is_line {
            HertzLine::from_load(*radius, modulus, *load)?.half_width
        } else {
            HertzPoint::from_load(*radius, *radius, modulus, *load)?.half_width_x
        };
        narrowest = half.min(narrowest);
        widest = half.max(widest);
    }
    Ok([narrowest, widest])
}

/// The table `[grid]` of a box that begins at `up` \[m\] before the contact, and the tables of a rough disc.
fn grid(
    options: &Options,
    disc: &Disc,
    machine: &Machine,
    [narrowest, half_width]: [f64; 2],
    up: f64,
) -> Result<String, Box<dyn Error>> {
    let (mut text, shortest) = ("[grid]\n".to_owned(), UPSTREAM * half_width);
    let down = if machine.reverses { up } else { DOWNSTREAM * half_width };
    let edge = |length: f64| format!("{} um", plain(rounded(length) * 1e6));
    let is_rough = disc.rq() > 0.0;
    let [along, across] = if is_rough {
        let [along, across] =
            [rounded(up) + rounded(down), 2.0 * rounded(up)].map(|size| disc.cells(options.cells, size));
        let [along, across] = [along?, if machine.is_line { STRIP_ROWS } else { across? }];
        disc.require_nodes(options.cells, [along, across])?;
        [along, across]
    } else {
        let usual = if machine.is_line { LINE_CELLS } else { POINT_CELLS };
        // Cells of a longer box are not wider.
        let shortest = shortest + if machine.reverses { shortest } else { DOWNSTREAM * half_width };
        let cell = (shortest / f64::from(usual)).min(narrowest / NARROWEST);
        let cells = 2 * (0.5 * (up + down) / cell).ceil() as u32;
        [options.cells.unwrap_or(cells), options.cells.unwrap_or(POINT_CELLS)]
    };
    if machine.is_line && is_rough {
        writeln!(text, "{STRIP}ny = {STRIP_ROWS}")?;
    }
    writeln!(text, "nx = {along}")?;
    if !machine.is_line {
        writeln!(text, "ny = {across}\ny = [\"-{}\", \"{}\"]", edge(up), edge(up))?;
    }
    writeln!(text, "x = [\"-{}\", \"{}\"]\n{}", edge(up), edge(down), disc.tables(&options.file, HARDNESS)?)?;
    Ok(text)
}

/// The table `[cycle]`.
fn cycle(machine: &Machine) -> Result<String, fmt::Error> {
    let mut text = String::new();
    let (key, places) = &machine.places;
    let values = [
        (*key, places),
        ("load", &machine.loads),
        ("ball_speed", &machine.speeds[0]),
        ("disc_speed", &machine.speeds[1]),
        ("radius", &machine.radii),
    ];
    writeln!(text, "[cycle] # speeds relative to the contact; SI units, angles in rad")?;
    if !machine.key.is_empty() {
        writeln!(text, "{}", machine.key)?;
    }
    for (key, values) in values {
        writeln!(text, "{key} = {}", list(values))?;
    }
    Ok(text)
}
