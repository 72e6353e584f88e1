//! Rigid bearings: journal bearings of finite width and a slider with a pocket.

use std::f64::consts::PI;

use rayon::prelude::*;
use stribeck::Grid;
use stribeck::lubricant::{Barus, DowsonHigginson, Incompressible, Lubricant};
use stribeck::reynolds::{FilmThickness, GivenFilm, SideEdges};

use crate::pocket_slider::{ETA, PocketSlider};
use crate::report::{Effort, Number, Outcome, Row};

/// Eccentricity, width over diameter, Sommerfeld number, attitude angle \[deg\], side flow: Butenschoen (1976),
/// Dissertation, Karlsruhe; Reynolds' condition.
const BUTENSCHOEN: [[f64; 5]; 24] = [
    [0.1, 1.0, 0.1196, 79.41, 0.1603],
    [0.1, 0.5, 0.0368, 81.767, 0.0939],
    [0.1, 0.25, 0.0098, 82.481, 0.0492],
    [0.1, 0.125, 0.0025, 82.653, 0.0249],
    [0.3, 1.0, 0.4091, 68.264, 0.4765],
    [0.3, 0.5, 0.1304, 68.493, 0.2816],
    [0.3, 0.25, 0.0354, 68.204, 0.1476],
    [0.3, 0.125, 0.0091, 68.211, 0.0747],
    [0.5, 1.0, 0.8903, 56.705, 0.7852],
    [0.5, 0.5, 0.3124, 54.993, 0.4694],
    [0.5, 0.25, 0.0888, 54.069, 0.246],
    [0.5, 0.125, 0.0231, 53.784, 0.1245],
    [0.7, 1.0, 2.0432, 43.859, 1.0888],
    [0.7, 0.5, 0.8595, 40.803, 0.6578],
    [0.7, 0.25, 0.2708, 39.326, 0.3446],
    [0.7, 0.125, 0.0732, 38.865, 0.1743],
    [0.9, 1.0, 8.4352, 26.482, 1.3898],
    [0.9, 0.5, 5.0881, 23.566, 0.8453],
    [0.9, 0.25, 2.1595, 21.79, 0.4436],
    [0.9, 0.125, 0.6776, 21.089, 0.2241],
    [0.96, 1.0, 24.1172, 17.609, 1.4808],
    [0.96, 0.5, 17.7934, 15.66, 0.9084],
    [0.96, 0.25, 9.8517, 14.109, 0.4737],
    [0.96, 0.125, 3.7907, 13.262, 0.2391],
];

/// Sommerfeld number `W psi^2/(B D eta omega)`, attitude angle \[deg\] and side flow over `R^3 psi omega` of a bearing
/// that is supplied where its gap is widest.
fn journal_bearing(eccentricity: f64, width_over_diameter: f64) -> Outcome<[f64; 3]> {
    let (radius, psi, omega, eta) = (0.05_f64, 1e-3, 100.0, 0.01);
    let (length, width, clearance) = (2.0 * PI * radius, 2.0 * radius * width_over_diameter, psi * radius);
    let grid = Grid::from_edges(720, 64, [0.0, length], [0.0, width])?;
    let gap = |x: f64| clearance * (1.0 + eccentricity * (x / radius).cos());
    let film = FilmThickness::from_function(grid, |x, _| gap(x))?;
    let oil = Lubricant::new(Barus::new(eta, 0.0)?, Incompressible);
    let solution = GivenFilm::new(&film, &oil, [omega * radius, 0.0]).solve()?;
    solution.report.require_converged()?;
    let sum = |of: fn(f64) -> f64| {
        let parts = grid.nodes().zip(&solution.pressure).map(|((x, _), p)| p * of(x / radius));
        parts.sum::<f64>() * grid.cell_area()
    };
    let (along, across) = (sum(f64::cos), sum(f64::sin));
    // The side lies half a cell outside of the nodes next to it; the other side is its mirror.
    let side = (0..grid.nx()).map(|i| {
        let gradient = solution.pressure[i] / (0.5 * grid.dy());
        2.0 * gap(grid.x(i)).powi(3) / (12.0 * eta) * gradient * grid.dx()
    });
    Ok([
        along.hypot(across) * psi * psi / (width * 2.0 * radius * eta * omega),
        across.abs().atan2(along.abs()).to_degrees(),
        side.sum::<f64>() / (radius.powi(3) * psi * omega),
    ])
}

pub(crate) fn journal_bearings(effort: Effort) -> Outcome<Row> {
    let stride = if effort.is_full() { 1 } else { 5 };
    let cases: Vec<[f64; 5]> = BUTENSCHOEN.into_iter().step_by(stride).collect();
    let found: Vec<[f64; 3]> =
        cases.par_iter().map(|case| journal_bearing(case[0], case[1])).collect::<Outcome<_>>()?;
    let mut numbers = Vec::new();
    for ([eccentricity, width, sommerfeld, attitude, flow], found) in cases.iter().zip(&found) {
        let case = format!("eccentricity {eccentricity} B/D {width}");
        // The tables have four decimals.
        let rounding = 0.5e-4 / sommerfeld;
        numbers.push(Number::relative(
            "Sommerfeld number",
            case.clone(),
            "",
            *sommerfeld,
            found[0],
            0.004 + rounding,
        ));
        numbers.push(Number::absolute(
            "attitude angle in degrees",
            case.clone(),
            "deg",
            *attitude,
            found[1],
            0.5,
        ));
        numbers.push(Number::relative("side flow", case, "", *flow, found[2], 0.006));
    }
    Ok(Row {
        name: "journal_bearings",
        quantity: "Journal bearings of finite width",
        reference: "independent computation: Butenschoen (1976)",
        range: "eccentricity 0.1 to 0.96, width over diameter 1/8 to 1",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}

/// Peak pressure \[Pa\] of the pocket of finite width and its place over the length.
fn pocket_peak() -> Outcome<[f64; 2]> {
    let (length, width) = (20e-3, 10e-3);
    let grid = Grid::from_edges(200, 100, [0.0, length], [-0.5 * width, 0.5 * width])?;
    let film = FilmThickness::from_function(grid, |x, y| {
        let in_pocket = x > 4e-3 && x < 10e-3 && y.abs() < 3.5e-3;
        1.1e-6 - 0.1e-6 * x / length + if in_pocket { 0.4e-6 } else { 0.0 }
    })?;
    let oil = Lubricant::new(Barus::new(0.01, 1.2e-8)?, DowsonHigginson::new(0.6e-9, 1.7e-9)?);
    let solution = GivenFilm::new(&film, &oil, [1.0, 0.0]).solve()?;
    solution.report.require_converged()?;
    let largest = |best: (usize, f64), (k, &p): (usize, &f64)| if p > best.1 { (k, p) } else { best };
    let (k, peak) = solution.pressure.iter().enumerate().fold((0, 0.0), largest);
    Ok([peak, grid.x(k % grid.nx()) / length])
}

pub(crate) fn pocket(_effort: Effort) -> Outcome<Row> {
    let [peak, place] = pocket_peak()?;
    Ok(Row {
        name: "pocket",
        quantity: "Slider with a pocket, cavitation",
        reference: "independent computation: Bertocchi et al. (2013), read from a figure",
        range: "20 x 10 mm, 1.0 to 1.1 um, pocket of 0.4 um, piezoviscous and compressible",
        numbers: vec![
            Number::relative("peak pressure", "200 x 100 cells", "MPa", 8.50, 1e-6 * peak, 0.025),
            Number::absolute("place of the peak over the length", "200 x 100 cells", "", 0.504, place, 0.003),
        ],
        extra: String::new(),
        figures: Vec::new(),
    })
}

/// Cells of the slider.
const CELLS: usize = 1000;

pub(crate) fn slider(effort: Effort) -> Outcome<Row> {
    let speeds: &[f64] = if effort.is_full() { &[1e-4, 0.02, 0.05, 0.2, 1.0, 5.0] } else { &[0.02, 5.0] };
    let of_speed = |speed: &f64| (format!("pocket of 1 um; {speed} m/s"), PocketSlider::fowell(*speed));
    let deep = ("pocket of 5 um; 1 m/s".to_owned(), PocketSlider::giacopini());
    let oil = Lubricant::new(Barus::new(ETA, 0.0)?, Incompressible);
    let mut numbers = Vec::new();
    for (case, slider) in speeds.iter().map(of_speed).chain([deep]) {
        let (film, exact) = (slider.film_on(CELLS)?, slider.exact());
        let solution = slider.problem(&film, &oil).solve()?;
        solution.report.require_converged()?;
        let end = solution.pressure_at(PocketSlider::POCKET[1], 0).ok_or("no pressure")?;
        // of second order
        let bound = 0.3 / (CELLS * CELLS) as f64;
        let mut add = |group, unit, exact: f64, found: f64, bound| {
            numbers.push(Number::relative(group, case.clone(), unit, exact, found, bound));
        };
        add("pressure at the end of the pocket", "MPa", 1e-6 * exact.pressures[1], 1e-6 * end, 1e-8);
        add("flow", "mm^2/s", 1e6 * exact.flow, 1e6 * solution.flow.outflow, 1e-9);
        add("load", "N/m", exact.load, solution.load, bound);
        if let (Some(exact), Some(found)) = (exact.reformation, solution.reformation(0)) {
            add("place of reformation", "mm", 1e3 * exact, 1e3 * found, bound);
        }
    }
    Ok(Row {
        name: "slider",
        quantity: "Sliders with a pocket, cavitation",
        reference: "closed form: integrals of the film, after Fowell et al. (2007) and Giacopini et al. (2010)",
        range: "10 mm, films 1 to 6 um, 1e-4 to 5 m/s, 1000 cells",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}

/// Pressure at the step and load per width of a wide bearing with films `first` over the length `before` and `second` over
/// `after` by Reynolds' equation, whose pressure is linear on both sides of the step.
fn step_pressure([first, second]: [f64; 2], [before, after]: [f64; 2], speed: f64) -> [f64; 2] {
    let peak = 6.0 * ETA * speed * before * after * (first - second)
        / (after * first.powi(3) + before * second.powi(3));
    [peak, 0.5 * peak * (before + after)]
}

pub(crate) fn step_bearing(_effort: Effort) -> Outcome<Row> {
    let oil = Lubricant::new(Barus::new(ETA, 0.0)?, Incompressible);
    let (second, length, speed) = (10e-6, 10e-3, 2.0);
    let mut numbers = Vec::new();
    // The largest load has the ratio of films 1.866 and the share of length 0.718.
    for (ratio, share) in [(1.5, 0.5), (1.866, 0.718), (4.0, 0.9)] {
        let grid = Grid::from_edges(1000, 1, [0.0, length], [0.0, 1.0])?;
        let step = share * length;
        let film = FilmThickness::from_function(grid, |x, _| if x < step { ratio * second } else { second })?;
        let problem = GivenFilm::new(&film, &oil, [speed, 0.0]).with_sides(SideEdges::Closed);
        let solution = problem.solve()?;
        solution.report.require_converged()?;
        let [peak, load] = step_pressure([ratio * second, second], [step, length - step], speed);
        let case = format!("films {ratio} to 1; step at {share}");
        let found = solution.pressure_at(step, 0).ok_or("no pressure")?;
        let mpa = 1e-6;
        numbers.push(Number::relative(
            "pressure at the step",
            case.clone(),
            "MPa",
            mpa * peak,
            mpa * found,
            1e-9,
        ));
        numbers.push(Number::relative("load", case, "N/m", load, solution.load, 1e-9));
    }
    Ok(Row {
        name: "step_bearing",
        quantity: "Step bearings",
        reference: "closed form: Rayleigh (1918)",
        range: "10 mm, films 10 to 40 um, 1000 cells",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}
