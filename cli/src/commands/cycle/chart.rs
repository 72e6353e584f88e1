//! The picture of a cycle.

use stribeck::sim::CyclePoint;

use super::Kind;
use super::solved::Solved;
use crate::picture::{BLUE, Chart, GREEN, Line, Panel, Scale, VERMILION};

/// The unit of the pressures of a cycle and its size \[Pa\]: GPa, or MPa where all are below 0.1 GPa.
pub(super) fn pressure_unit(points: &[CyclePoint]) -> (&'static str, f64) {
    let largest = points.iter().fold(0.0, |most: f64, point| most.max(point.pressure_max));
    if largest < 1e8 { ("MPa", 1e6) } else { ("GPa", 1e9) }
}

/// Films, pressure, friction, power and flash temperature over angle or time.
pub(super) fn chart(name: &str, solution: &Solved, kind: Kind) -> Chart {
    let points = &solution.points;
    let (unit, pascals) = pressure_unit(points);
    let has_angles = points.iter().any(|point| point.angle.is_some());
    let x = |point: &CyclePoint| point.angle.map_or(1e3 * point.time, f64::to_degrees);
    let line = |name, colour, value: &dyn Fn(&CyclePoint) -> f64| {
        let points = points.iter().map(|point| (x(point), value(point))).collect();
        Line { name, colour, points, bands: Vec::new() }
    };
    let panel = |y_label: &str, lines| Panel::new(y_label, lines);
    let mut panels = vec![
        panel(
            "film (nm)",
            vec![
                line(if kind.is_rough { "mean" } else { "central" }, BLUE, &|p| 1e9 * kind.film(p)),
                line("least", VERMILION, &|p| 1e9 * p.film_minimum),
                line("formula", GREEN, &|p| 1e9 * p.formula_film),
            ],
        ),
        panel(
            &format!("pressure ({unit})"),
            vec![
                line("largest", BLUE, &|p| p.pressure_max / pascals),
                line("Hertz", GREEN, &|p| p.hertz_pressure / pascals),
            ],
        ),
        panel("on solids", vec![line("", BLUE, &|p| p.contact_load_ratio)]),
        panel("friction", vec![line("", BLUE, &|p| p.friction_coefficient)]),
        panel(
            if kind.is_line { "power (W/m)" } else { "power (W)" },
            vec![line("", BLUE, &|p| p.friction_power)],
        ),
    ];
    if points.iter().any(|point| point.flash_rise.is_some()) {
        panels.push(panel("flash (K)", vec![line("", BLUE, &|p| p.flash_rise.unwrap_or(f64::NAN))]));
    }
    Chart {
        title: format!("Cycle of {name}"),
        x_label: if has_angles { "angle (deg)" } else { "time (ms)" },
        x_scale: Scale::Linear,
        upper: None,
        panels,
    }
}
