//! A soft line contact that reciprocates: place and time of its least film.

use std::f64::consts::{PI, TAU};

use stribeck::Grid;
use stribeck::elastic::LineHalfSpace;
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::Auto;

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, XScale};
use crate::report::{Effort, Number, Outcome, Row};
use crate::rolling::{Passage, Rolling};

const STEPS: u32 = 300;
/// Largest displacement of the entrained film from the middle of its stroke, in half-widths.
const AMPLITUDE: f64 = 5.0;
const LARGEST_SPEED: f64 = 0.1;

/// A rubber roller of 10 mm and E' 10 MPa under 1 kN/m in an oil of 0.1 Pa s.
fn contact(nx: usize) -> Outcome<Rolling> {
    let (radius, modulus, load) = (10e-3, 10e6, 1e3);
    let half_width = (8.0 * load * radius / (PI * modulus)).sqrt();
    let grid = Grid::from_edges(nx, 1, [-4.0 * half_width, 4.0 * half_width], [-0.5, 0.5])?;
    Ok(Rolling {
        radius,
        grid,
        body: Box::new(LineHalfSpace::new(grid, modulus, 1.0)?),
        oil: Lubricant::new(Barus::new(0.1, 0.0)?, Incompressible),
        solver: Auto::new(),
        half_width,
        pressure: 2.0 * load / (PI * half_width),
        speed: LARGEST_SPEED,
        load,
        reference_film: 5e-6,
        middle: nx / 2,
        way: [0.0; 2],
        periods: 0.0,
    })
}

/// Least film at one time.
struct Least {
    /// Periods after the largest speed.
    phase: f64,
    film: f64,
    /// In half-widths.
    place: f64,
}

/// Least films of the second of two periods, and that of the steady film at the largest speed.
fn stroke(nx: usize) -> Outcome<(f64, Vec<Least>)> {
    let mut rolling = contact(nx)?;
    let (grid, gap) = (rolling.grid, rolling.smooth_gap());
    let omega = LARGEST_SPEED / (AMPLITUDE * rolling.half_width);
    let time_step = TAU / omega / f64::from(STEPS);
    let mut passage = Passage::start(&mut rolling, &gap, time_step)?;
    let inside = |k: &usize| grid.x(*k).abs() < 1.2 * rolling.half_width;
    let nodes: Vec<usize> = (0..grid.len()).filter(inside).collect();
    let half_width = rolling.half_width;
    let least =
        |film: &[f64]| nodes.iter().copied().min_by(|a, b| film[*a].total_cmp(&film[*b])).unwrap_or(0);
    let steady = passage.state.film[least(&passage.state.film)];
    let mut found = Vec::new();
    let mut direction = 1.0;
    for step in 1..=2 * STEPS {
        let phase = f64::from(step) / f64::from(STEPS);
        let speed = LARGEST_SPEED * (TAU * phase).cos();
        // Oil flows along +x: the contact is mirrored where its direction changes.
        if speed * direction < 0.0 {
            direction = -direction;
            passage.mirror();
        }
        rolling.speed = speed.abs().max(1e-9 * LARGEST_SPEED);
        passage.step(&mut rolling, &gap, true)?;
        if step > STEPS {
            let k = least(&passage.state.film);
            let place = direction * grid.x(k) / half_width;
            found.push(Least { phase: phase - 1.0, film: passage.state.film[k], place });
        }
    }
    Ok((steady, found))
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let (steady, films) = stroke(if effort.is_full() { 512 } else { 256 })?;
    // The stroke that ends at a quarter of the period: entrainment along +x before, along -x behind.
    let end = films.iter().filter(|least| (0.0..0.5).contains(&least.phase));
    let least = end.min_by(|a, b| a.film.total_cmp(&b.film)).ok_or("no film")?;
    let lines = [
        films.iter().map(|least| (least.phase, least.film / steady)).collect(),
        films.iter().map(|least| (least.phase, (TAU * least.phase).cos().abs())).collect(),
    ];
    let [film, speed] = lines;
    let figure = Figure {
        title: "Least film of a soft contact over a period".to_owned(),
        x_label: "time from the largest speed, periods",
        x_scale: XScale::FromZero,
        legend: vec![
            (Pen::strong(BLUE), "least film over the steady one of the largest speed".to_owned()),
            (Pen::dashed(BLACK), "speed".to_owned()),
        ],
        panels: vec![Panel {
            y_label: "ratio",
            lines: vec![
                Line { pen: Pen::strong(BLUE), points: film },
                Line { pen: Pen::dashed(BLACK), points: speed },
            ],
        }],
    };
    Ok(Row {
        name: "reciprocation",
        quantity: "Least film of a soft contact that reciprocates",
        reference: "independent computation (statement): Hooke (1986)",
        range: "rubber line, 0.4 MPa, stroke of 10 half-widths",
        numbers: vec![
            Number::between(
                "time of the least film (a stroke ends at 0.25)",
                "periods",
                [0.2, 0.3],
                least.phase,
            ),
            Number::between("its place in half-widths (swept side positive)", "", [-1.2, 0.0], least.place),
        ],
        extra: String::new(),
        figures: vec![("reciprocation", figure)],
    })
}
