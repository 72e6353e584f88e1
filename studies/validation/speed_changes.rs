//! Contacts whose entrainment speed rises and falls: their film beside the steady film of the same speed.

use std::f64::consts::{PI, TAU};

use stribeck::Grid;
use stribeck::analytic::{HertzPoint, equivalent_modulus};
use stribeck::elastic::{DeformationModel, HalfSpace, LineHalfSpace};
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::Auto;

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::report::{Effort, Number, Outcome, Row};
use crate::rolling::{Passage, Rolling};

const RADIUS: f64 = 9.525e-3;
const PRESSURE: f64 = 0.5e9;
const MEAN_SPEED: f64 = 0.2;
/// Change of the speed over its mean.
const CHANGE: f64 = 0.5;
/// Half-widths that the mean film moves in a period.
const WAY: f64 = 16.0;
const STEPS: usize = 64;

/// A steel ball of 9.525 mm, or a roller of that radius, on glass at 0.5 GPa in an oil of 0.05 Pa s and 20 1/GPa.
fn contact(is_ball: bool) -> Outcome<Rolling> {
    let modulus = equivalent_modulus([210e9, 0.3], [75e9, 0.22])?;
    let oil = Lubricant::new(
        Roelands::from_alpha(0.05, 20e-9, 0.68, 1.96e8)?,
        DowsonHigginson::new(0.6e-9, 1.7e-9)?,
    );
    let (a, load, n) = if is_ball {
        let hertz = HertzPoint::from_max_pressure(RADIUS, RADIUS, modulus, PRESSURE)?;
        (hertz.half_width_x, hertz.force, 64)
    } else {
        let a = 4.0 * PRESSURE * RADIUS / modulus;
        (a, 0.5 * PI * PRESSURE * a, 384)
    };
    let x = [-3.0 * a, 1.5 * a];
    let grid = if is_ball {
        Grid::from_edges(n, n, x, [-2.25 * a, 2.25 * a])?
    } else {
        Grid::from_edges(n, 1, x, [-0.5, 0.5])?
    };
    let body: Box<dyn DeformationModel> = if is_ball {
        Box::new(HalfSpace::new(grid, modulus)?)
    } else {
        Box::new(LineHalfSpace::new(grid, modulus, RADIUS)?)
    };
    let middle = n * 2 / 3 + if is_ball { n / 2 * n } else { 0 };
    Ok(Rolling {
        radius: RADIUS,
        grid,
        body,
        oil,
        solver: Auto::new(),
        half_width: a,
        pressure: PRESSURE,
        speed: MEAN_SPEED,
        load,
        reference_film: 2e-7,
        middle,
        way: [0.0; 2],
        periods: 0.0,
    })
}

/// Central films of the second of two periods and the speeds, over those of the steady contact under the mean speed.
fn period(is_ball: bool) -> Outcome<Vec<[f64; 2]>> {
    let mut rolling = contact(is_ball)?;
    let gap = rolling.smooth_gap();
    let time_step = WAY * rolling.half_width / MEAN_SPEED / STEPS as f64;
    let mut passage = Passage::start(&mut rolling, &gap, time_step)?;
    let steady = passage.state.film[rolling.middle];
    let mut found = Vec::with_capacity(STEPS);
    for step in 1..=2 * STEPS {
        let speed = 1.0 + CHANGE * (TAU * step as f64 / STEPS as f64).sin();
        rolling.speed = MEAN_SPEED * speed;
        passage.step(&mut rolling, &gap, true)?;
        if step > STEPS {
            found.push([passage.state.film[rolling.middle] / steady, speed]);
        }
    }
    Ok(found)
}

/// Lag of the first harmonic of the film behind the speed, in periods.
fn lag(found: &[[f64; 2]]) -> f64 {
    let part = |wave: fn(f64) -> f64| -> f64 {
        let terms = found.iter().enumerate();
        terms.map(|(k, [film, _])| film * wave(TAU * (k + 1) as f64 / STEPS as f64)).sum()
    };
    (-part(f64::cos)).atan2(part(f64::sin)) / TAU
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let kinds: &[(bool, &str)] =
        if effort.is_full() { &[(false, "line"), (true, "ball")] } else { &[(false, "line")] };
    let (mut numbers, mut lines) = (Vec::new(), Vec::new());
    for (is_ball, name) in kinds {
        let found = period(*is_ball)?;
        // the mean speed is passed at half of the period while it falls, at its end while it rises
        let (falling, rising) = (found[STEPS / 2 - 1][0], found[STEPS - 1][0]);
        numbers.push(Number::between(
            "lag of the film behind the speed, periods",
            *name,
            [0.0, 0.25],
            lag(&found),
        ));
        numbers.push(Number::between("film over the steady one, speed rises", *name, [0.0, 1.0], rising));
        numbers.push(Number::between("film over the steady one, speed falls", *name, [1.0, 2.0], falling));
        let color = if *is_ball { BLUE } else { VERMILION };
        let points = found.iter().chain(found.first()).map(|[film, speed]| (*speed, *film)).collect();
        lines.push(Line { pen: Pen::strong(color), points });
    }
    let steady =
        (0..=20).map(|k| 0.5 + f64::from(k) / 20.0).map(|speed: f64| (speed, speed.powf(0.67))).collect();
    lines.push(Line { pen: Pen::dashed(BLACK), points: steady });
    let figure = Figure {
        title: "Central film of contacts whose speed rises and falls".to_owned(),
        x_label: "speed over its mean",
        x_scale: XScale::FromZero,
        legend: vec![
            (Pen::strong(VERMILION), "line".to_owned()),
            (Pen::strong(BLUE), "ball".to_owned()),
            (Pen::dashed(BLACK), "steady, speed to the power 0.67".to_owned()),
        ],
        panels: vec![Panel { y_label: "film / steady", lines }],
    };
    Ok(Row {
        name: "speed_changes",
        quantity: "Films under a speed that rises and falls",
        reference: "statement on measured films: Sugimura, Jones and Spikes (1998)",
        range: "steel on glass, 0.5 GPa, speed 0.1 to 0.3 m/s, the film moves 16 half-widths in a period",
        numbers,
        extra: String::new(),
        figures: vec![("speed_changes", figure)],
    })
}
