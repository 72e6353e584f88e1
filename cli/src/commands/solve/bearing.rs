//! Rigid bearings: scenes with the table `[given_film]`.

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use stribeck::Status;
use stribeck::sim::scene::BearingSpec;
use stribeck::sim::{BearingNumbers, BearingSolution, RigidBearing};
use stribeck::units::by_size;

use super::bearing_profile::profile;
use super::{Options, write_fields};
use crate::output::{self, Outcome};
use crate::picture;
use crate::report::{self, Report};
use crate::{files, interrupt};

/// Flow over the largest one below which it is rounding.
const ROUNDING: f64 = 1e-9;
/// Flow below which it is printed in ul/s \[m^3/s\].
const SMALL_FLOW: f64 = 1e-8;

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
        let film = &solution.film;
        let mut fields = vec![
            ("pressure", &film.pressure[..]),
            ("theta", &film.theta[..]),
            ("film", &solution.thickness[..]),
        ];
        fields.extend(solution.film.contact.as_ref().map(|solid| ("contact_pressure", &solid.pressure[..])));
        write_fields(path, &grid, &fields)?;
    }
    let mut numbers = serde_json::to_value(solution.numbers)?;
    numbers["status"] = serde_json::to_value(status)?;
    numbers["warnings"] = serde_json::to_value(&solution.warnings)?;
    numbers["seconds"] = start.elapsed().as_secs_f64().into();
    numbers["version"] = env!("CARGO_PKG_VERSION").into();
    let chart = profile(&options.scene, bearing, &solution);
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
        BearingSpec::Pad { width: None, .. } => "/m",
        _ => "",
    }
}

/// The numbers for people.
pub(in crate::commands) fn report(
    bearing: &RigidBearing,
    solution: &BearingSolution,
    status: Status,
) -> String {
    let numbers = &solution.numbers;
    let per = per(bearing);
    let is_line = !per.is_empty();
    let force = |value: f64| by_size(value, if is_line { "N/m" } else { "N" });
    let widening = numbers.bore_widening.map_or_else(String::new, |widening| {
        format!("; wider by up to {} where the bore deflects", by_size(widening, "m"))
    });
    let mut lines = vec![format!("status     {status}")];
    if status != Status::Converged {
        lines.push("result     unknown: the film is not converged; the warnings name the way out".to_owned());
        lines.extend(oil(bearing, numbers));
        return lines.join("\n");
    }
    lines.extend(position(numbers));
    lines.extend(pad_films(numbers));
    let BearingNumbers { friction_moving, friction_resting, .. } = numbers;
    let above = numbers.load_above_edges.map_or_else(String::new, |above| {
        format!("; {} without the least pressure of the edges", force(above))
    });
    lines.extend([
        if numbers.load == 0.0 {
            "load       none".to_owned()
        } else {
            format!("load       {}{above}", force(numbers.load))
        },
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
    lines.extend(oil(bearing, numbers));
    lines.extend(heat(numbers, per));
    lines.join("\n")
}

/// Solid contact of rough surfaces.
fn solids(numbers: &BearingNumbers, per: &str) -> Option<String> {
    Some(format!(
        "contact    {:.2} % of the load on solids, on {} mm^2{per}; {} of the friction; least film {:.3} Rq",
        100.0 * numbers.contact_share?,
        output::digits(1e6 * numbers.contact_area?),
        by_size(numbers.contact_friction?, if per.is_empty() { "N" } else { "N/m" }),
        numbers.film_over_rq?
    ))
}

/// A flow \[m^3/s\] in ml/s, or in ul/s if it is small.
fn flow(value: f64, per: &str) -> String {
    if value != 0.0 && value.abs() < SMALL_FLOW {
        format!("{:.4} ul/s{per}", 1e9 * value)
    } else {
        format!("{:.4} ml/s{per}", 1e6 * value)
    }
}

/// Flows through the edges, and from grooves and holes.
fn flows(bearing: &RigidBearing, numbers: &BearingNumbers, per: &str) -> Vec<String> {
    let largest = numbers.edge_flows.iter().fold(0.0_f64, |most, flow| most.max(flow.abs()));
    // Smaller ones are rounding.
    let flow = |value: f64| flow(if value.abs() < ROUNDING * largest { 0.0 } else { value }, per);
    let [start, end, left, right] = numbers.edge_flows;
    let sides = format!("{}: {} and {}", flow(left + right), flow(left), flow(right));
    let holes = numbers.hole_flow.map(|holes| format!("holes      {}", flow(holes)));
    if matches!(bearing.bearing, BearingSpec::Journal { .. }) {
        let mut lines = vec![format!("side flow  {sides}")];
        lines.extend(numbers.groove_flow.map(|grooves| format!("grooves    {}", flow(grooves))));
        lines.extend(holes);
        return lines;
    }
    let along = format!("flow       {} in at the inlet, {} out at the outlet", flow(-start), flow(end));
    let sides = if per.is_empty() { format!("; out through the sides {sides}") } else { String::new() };
    std::iter::once(format!("{along}{sides}")).chain(holes).collect()
}

/// Viscosity of the oil, its temperature where it depends on that, and its rise with pressure.
fn oil(bearing: &RigidBearing, numbers: &BearingNumbers) -> [String; 2] {
    let at = if bearing.has_thermal_oil() || bearing.heat.is_some() {
        format!(" at {:.2} degC", celsius(numbers.temperature))
    } else {
        ", at any temperature".to_owned()
    };
    let ratio = if numbers.viscosity_ratio.is_finite() {
        format!("; {:.4} times the viscosity at the largest pressure", numbers.viscosity_ratio)
    } else {
        String::new()
    };
    [
        format!("oil        {:.4} mPa s{at}", 1e3 * numbers.eta0),
        format!("alpha      {} 1/GPa{ratio}", output::digits(1e9 * numbers.alpha)),
    ]
}

/// The heat balance.
fn heat(numbers: &BearingNumbers, per: &str) -> Option<String> {
    let [supply, outlet] = [numbers.supply_temperature?, numbers.outlet_temperature?];
    let carried = numbers.carried_heat?;
    Some(format!(
        "heat       oil in at {:.2} degC, out at {:.2} degC: a rise of {:.2} K by {}, {:.0} % of the power loss",
        celsius(supply),
        celsius(outlet),
        outlet - supply,
        by_size(carried, if per.is_empty() { "W" } else { "W/m" }),
        100.0 * carried / numbers.power_loss
    ))
}

fn celsius(temperature: f64) -> f64 {
    temperature - 273.15
}

/// Films at both ends of a pad, and where its load acts.
fn pad_films(numbers: &BearingNumbers) -> Option<String> {
    let [inlet, outlet] = [numbers.inlet_film?, numbers.outlet_film?].map(|film| by_size(film, "m"));
    let center = numbers.pressure_center.map_or_else(String::new, |center| {
        format!("; center of pressure {} behind the inlet", by_size(center, "m"))
    });
    Some(format!("pad        film {inlet} at the inlet, {outlet} at the outlet{center}"))
}

/// Position of a journal and the direction of its load.
fn position(numbers: &BearingNumbers) -> Option<String> {
    let [towards, across] = numbers.force?;
    Some(format!(
        "journal    eccentricity {:.4}, attitude {:.2} deg, Sommerfeld number {:.4} (W psi^2/(L D eta omega)); force of the film \
         {} towards the widest gap, {} across",
        numbers.eccentricity?,
        numbers.attitude?.to_degrees(),
        numbers.sommerfeld?,
        by_size(towards, "N"),
        by_size(across, "N")
    ))
}
