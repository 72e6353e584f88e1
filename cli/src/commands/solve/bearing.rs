//! Rigid bearings: scenes with the table `[given_film]`.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use stribeck::Status;
use stribeck::sim::scene::BearingSpec;
use stribeck::sim::{BearingNumbers, BearingSolution, RigidBearing};
use stribeck::units::by_size;

use super::{Options, write_fields};
use crate::output::{self, Outcome};
use crate::picture::{self, BLUE, Chart, GREEN, Line, Panel, Scale, VERMILION};
use crate::report::{self, Report};
use crate::{files, interrupt};

pub(super) fn run(options: &Options, bearing: &RigidBearing) -> Result<Outcome, Box<dyn Error>> {
    let start = Instant::now();
    if let Some(path) = &options.fields {
        files::claim(std::slice::from_ref(path), options.output.force, output::OTHER_NAME)?;
    }
    let (out, picture_name) = (&options.output.out, format!("{}_profile", output::stem(&options.scene)));
    if options.output.plot {
        files::make_folder(out)?;
        files::claim(&picture::files(out, &picture_name), options.output.force, output::OTHER_FOLDER)?;
    }
    let solved = bearing.solve(interrupt::is_requested);
    let solution = solved.map_err(|error| output::in_scene(&options.scene, &error))?;
    let (status, grid) = (solution.film.report.status, solution.film.grid());
    output::warn(&solution.warnings);
    if let Some(path) = &options.fields {
        let mut fields = vec![("pressure", &solution.film.pressure[..]), ("theta", &solution.film.theta[..])];
        fields.extend(solution.film.contact.as_ref().map(|solid| ("contact_pressure", &solid.pressure[..])));
        write_fields(path, &grid, &fields)?;
    }
    let mut numbers = serde_json::to_value(solution.numbers)?;
    numbers["status"] = serde_json::to_value(status)?;
    numbers["warnings"] = serde_json::to_value(&solution.warnings)?;
    numbers["seconds"] = start.elapsed().as_secs_f64().into();
    numbers["version"] = env!("CARGO_PKG_VERSION").into();
    let chart = profile(&options.scene, &solution);
    let pictures: Vec<PathBuf> =
        if options.output.plot { picture::write(&chart, out, &picture_name)?.into() } else { Vec::new() };
    if let Some(path) = &options.report.report {
        let mut report = Report::new(&options.scene, "rigid bearing", status)?;
        report.warn(solution.warnings.iter().map(ToString::to_string));
        report.table(&report::bearing(&numbers, per(bearing).is_empty()));
        report.chart(&chart)?;
        report.write(path)?;
    }
    if options.output.json {
        output::print(&numbers)?;
    } else {
        output::print(&report(bearing, &solution, status))?;
    }
    output::report_files(
        &options.fields.iter().chain(&pictures).chain(&options.report.report).cloned().collect::<Vec<_>>(),
        options.output.json,
    )?;
    Ok(status.into())
}

/// The unit behind forces, flows and powers of a pad without width.
fn per(bearing: &RigidBearing) -> &'static str {
    match bearing.bearing {
        BearingSpec::Pad { width: None, .. } | BearingSpec::Step { width: None, .. } => "/m",
        _ => "",
    }
}

/// Pressures and film fraction along the motion in the middle of the width.
fn profile(scene: &Path, solution: &BearingSolution) -> Chart {
    let (film, grid) = (&solution.film, solution.film.grid());
    let nodes = grid.nx() * (grid.ny() / 2)..grid.nx() * (grid.ny() / 2 + 1);
    let line = |name, colour, values: &[f64], factor: f64| Line {
        name,
        colour,
        points: nodes
            .clone()
            .enumerate()
            .filter_map(|(i, node)| values.get(node).map(|value| (1e3 * grid.x(i), factor * value)))
            .collect(),
        bands: Vec::new(),
    };
    let solids = film.contact.as_ref();
    let name = if solids.is_some() { "film" } else { "" };
    let mut pressures = vec![line(name, BLUE, &film.pressure, 1e-6)];
    pressures.extend(solids.map(|contact| line("solids", VERMILION, &contact.pressure, 1e-6)));
    let panels = vec![
        Panel::new("pressure (MPa)", pressures),
        Panel::new("film fraction", vec![line("", GREEN, &film.theta, 1.0)]),
    ];
    let title = format!("{}: profile in the middle of the width", output::stem(scene));
    Chart { title, x_label: "x along the motion (mm)", x_scale: Scale::Linear, panels, upper: None }
}

/// The numbers for people.
fn report(bearing: &RigidBearing, solution: &BearingSolution, status: Status) -> String {
    let numbers = &solution.numbers;
    let per = per(bearing);
    let is_line = !per.is_empty();
    let force = |value: f64| by_size(value, if is_line { "N/m" } else { "N" });
    let widening = numbers.bore_widening.map_or_else(String::new, |widening| {
        format!("; wider by up to {} where the bore deflects", by_size(widening, "m"))
    });
    let mut lines = vec![format!("status     {status}")];
    lines.extend(position(numbers));
    let BearingNumbers { friction_moving, friction_resting, .. } = numbers;
    lines.extend([
        format!("load       {}", force(numbers.load)),
        format!("film       least {}{widening}", by_size(numbers.least_film, "m")),
        format!("pressure   at most {}", by_size(numbers.pressure_max, "Pa")),
        format!(
            "friction   {} on the moving surface, {} on the surface at rest; coefficient {}",
            force(*friction_moving),
            force(*friction_resting),
            if numbers.friction_coefficient.is_finite() {
                format!("{:.5}", numbers.friction_coefficient)
            } else {
                "unknown without load".to_owned()
            }
        ),
        format!(
            "power      {} lost by friction",
            by_size(numbers.power_loss, if is_line { "W/m" } else { "W" })
        ),
    ]);
    lines.extend(solids(numbers, per));
    lines.extend(flows(bearing, numbers, per));
    lines.push(format!(
        "oil        {:.4} mPa s at {:.2} degC",
        1e3 * numbers.eta0,
        celsius(numbers.temperature)
    ));
    lines.extend(heat(numbers, per));
    lines.join("\n")
}

/// Solid contact of rough surfaces.
fn solids(numbers: &BearingNumbers, per: &str) -> Option<String> {
    Some(format!(
        "contact    {:.2} % of the load on solids, on {} mm^2{per}; {:.4} N{per} of the friction; least film {:.3} Rq",
        100.0 * numbers.contact_share?,
        output::digits(1e6 * numbers.contact_area?),
        numbers.contact_friction?,
        numbers.film_over_rq?
    ))
}

/// Flows through the edges, and from grooves.
fn flows(bearing: &RigidBearing, numbers: &BearingNumbers, per: &str) -> Vec<String> {
    let [start, end, left, right] = numbers.edge_flows.map(|flow| 1e6 * flow);
    let holes = numbers.hole_flow.map(|flow| format!("holes      {:.4} ml/s", 1e6 * flow));
    if matches!(bearing.bearing, BearingSpec::Journal { .. }) {
        let mut lines = vec![format!("side flow  {:.4} ml/s: {left:.4} and {right:.4} ml/s", left + right)];
        lines.extend(numbers.groove_flow.map(|flow| format!("grooves    {:.4} ml/s", 1e6 * flow)));
        lines.extend(holes);
        return lines;
    }
    let along =
        format!("flow       {:.4} ml/s{per} in at the inlet, {end:.4} ml/s{per} out at the outlet", -start);
    let sides = if per.is_empty() {
        format!("; {:.4} ml/s out through the sides: {left:.4} and {right:.4} ml/s", left + right)
    } else {
        String::new()
    };
    std::iter::once(format!("{along}{sides}")).chain(holes).collect()
}

/// The heat balance.
fn heat(numbers: &BearingNumbers, per: &str) -> Option<String> {
    let [supply, outlet] = [numbers.supply_temperature?, numbers.outlet_temperature?];
    let carried = numbers.carried_heat?;
    Some(format!(
        "heat       oil in at {:.2} degC, out at {:.2} degC: a rise of {:.2} K by {carried:.4} W{per}, {:.0} % of the power loss",
        celsius(supply),
        celsius(outlet),
        outlet - supply,
        100.0 * carried / numbers.power_loss
    ))
}

fn celsius(temperature: f64) -> f64 {
    temperature - 273.15
}

/// Position of a journal and the direction of its load.
fn position(numbers: &BearingNumbers) -> Option<String> {
    let [towards, across] = numbers.force?;
    Some(format!(
        "journal    eccentricity {:.4}, attitude {:.2} deg, Sommerfeld number {:.4}; force of the film {towards:.4} N towards the \
         widest gap, {across:.4} N across",
        numbers.eccentricity?,
        numbers.attitude?.to_degrees(),
        numbers.sommerfeld?
    ))
}
