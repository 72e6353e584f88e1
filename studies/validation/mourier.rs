//! A ball on a disc with a dimple that rolls and slides through the contact, beside the measured and computed films of
//! Mourier, Mazuyer, Lubrecht and Donnet (2006).

use stribeck::Grid;
use stribeck::analytic::HertzPoint;
use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::Auto;
use stribeck::sim::scene::{GridSpec, Load, LubricantSpec};
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::Form;

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::mourier_data::{FIRST, ROLLING, ROLLING_AT, SLIDING, SLIDING_AT};
use crate::report::{Effort, Number, Outcome, Row};
use crate::rolling::{Passage, Rolling};

/// A ball of 12.5 mm and E' 110 GPa under 15 N at 0.09 m/s in an oil of 0.25 Pa s and 22 1/GPa.
const RADIUS: f64 = 12.5e-3;
const MODULUS: f64 = 110e9;
const LOAD: f64 = 15.0;
const SPEED: f64 = 0.09;
const ETA0: f64 = 0.25;
const ALPHA: f64 = 22e-9;

/// The box of the dimples in half-widths: its inlet, and its size along both axes.
const INLET: f64 = 2.8;
const SIZE: f64 = 4.1;
const CELLS: usize = 144;

/// The contact in the box of the dimples.
fn contact() -> Outcome<Rolling> {
    let (radius, modulus, load) = (RADIUS, MODULUS, LOAD);
    let hertz = HertzPoint::from_load(radius, radius, modulus, load)?;
    let (a, n) = (hertz.half_width_x, CELLS);
    let side = 0.5 * SIZE * a;
    let grid = Grid::from_edges(n, n, [-INLET * a, (SIZE - INLET) * a], [-side, side])?;
    Ok(Rolling {
        radius,
        grid,
        body: Box::new(HalfSpace::new(grid, modulus)?),
        oil: Lubricant::new(
            Roelands::from_alpha(ETA0, ALPHA, 0.68, 1.96e8)?,
            DowsonHigginson::new(0.6e-9, 1.7e-9)?,
        ),
        solver: Auto::new(),
        half_width: a,
        pressure: hertz.pressure,
        speed: SPEED,
        load,
        reference_film: 210e-9,
        middle: n / 2 * n + (INLET / SIZE * n as f64) as usize,
        way: [0.0; 2],
        periods: 0.0,
    })
}

/// Position \[um\] and film \[nm\] along the center line.
type Profile = Vec<(f64, f64)>;

fn center_line(grid: &Grid, film: &[f64]) -> Profile {
    let row = grid.ny() / 2 * grid.nx()..(grid.ny() / 2 + 1) * grid.nx();
    row.map(|k| (1e6 * grid.x(k % grid.nx()), 1e9 * film[k])).collect()
}

/// Linear interpolation.
fn at(profile: &Profile, x: f64) -> f64 {
    let next = profile.partition_point(|point| point.0 < x).clamp(1, profile.len() - 1);
    let ((x0, y0), (x1, y1)) = (profile[next - 1], profile[next]);
    y0 + (y1 - y0) * (x - x0) / (x1 - x0)
}

#[derive(Clone, Copy)]
struct Dimple {
    depth: f64,
    radius: f64,
    /// Speed of its surface over the entrainment speed.
    speed: f64,
    positions: [f64; 5],
}

const DIMPLES: [Dimple; 2] = [
    Dimple { depth: 175e-9, radius: 15.5e-6, speed: 1.0, positions: ROLLING_AT },
    Dimple { depth: 160e-9, radius: 21.5e-6, speed: 0.5, positions: SLIDING_AT },
];

impl Dimple {
    fn depth_at(&self, distance: f64) -> f64 {
        let r = distance / (1.2 * self.radius);
        if r < 1.0 { self.depth * (0.5 * std::f64::consts::PI * r).cos() * (-2.0 * r * r).exp() } else { 0.0 }
    }

    /// Profiles when the dimple is at its positions; one cell of the grid a step.
    fn profiles(&self) -> Outcome<Vec<Profile>> {
        let mut rolling = contact()?;
        let (grid, smooth) = (rolling.grid, rolling.smooth_gap());
        let time_step = grid.dx() / rolling.speed;
        let mut passage = Passage::start(&mut rolling, &smooth, time_step)?;
        passage.carries_waves = true;
        let (start, stride) = (-1.9 * rolling.half_width, self.speed * grid.dx());
        let mut profiles = Vec::new();
        let mut dimple = start;
        for position in self.positions {
            while dimple + 0.5 * stride < 1e-6 * position {
                dimple += stride;
                let gap: Vec<f64> = (grid.nodes().zip(&smooth))
                    .map(|((x, y), gap)| gap + self.depth_at((x - dimple).hypot(y)))
                    .collect();
                passage.step(&mut rolling, &gap, true)?;
            }
            profiles.push(center_line(&grid, &passage.state.film));
        }
        Ok(profiles)
    }
}

/// The smooth contact with a flooded inlet.
fn smooth_film() -> Outcome<Profile> {
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Sphere { radius: RADIUS };
    scene.elastic.equivalent_modulus = MODULUS;
    scene.load = Load::force(LOAD);
    (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (SPEED, 0.0);
    scene.lubricant = Some(LubricantSpec::roelands(ETA0, 0.68).with_alpha(Some(ALPHA)));
    (scene.roughness, scene.plastic, scene.wear) = (Default::default(), None, None);
    scene.grid = GridSpec::Accuracy { accuracy: 0.01 };
    let solution = solve_contact(&scene)?;
    solution.report.require_converged()?;
    Ok(center_line(&solution.grid, &solution.state.film))
}

fn positions() -> impl Iterator<Item = f64> {
    (0..29).map(|k| FIRST + 10.0 * f64::from(k))
}

fn published(films: &[u16; 29]) -> Profile {
    positions().zip(films.iter().map(|film| f64::from(*film))).collect()
}

/// Mean film within the contact, `clear` um and more from the dimple; measured films of 345 nm and more are not readable.
fn mean_outside(profile: &Profile, measured: &Profile, dimple: f64, clear: f64) -> f64 {
    let seen = measured.iter().filter(|(x, film)| (-100.0..=110.0).contains(x) && *film < 345.0);
    let (sum, count) = seen
        .filter(|(x, _)| (x - dimple).abs() > clear)
        .fold((0.0, 0.0), |(sum, count), (x, _)| (sum + at(profile, *x), count + 1.0));
    sum / count
}

fn least(profile: &Profile, from: f64, to: f64) -> f64 {
    positions().filter(|x| (from..=to).contains(x)).map(|x| at(profile, x)).fold(f64::INFINITY, f64::min)
}

/// Largest films of the rolling dimple computed by the authors \[nm\], from its second position on.
const LARGEST: [f64; 4] = [358.0, 354.0, 355.0, 354.0];

fn dimple_numbers(rolling: &[Profile], sliding: &[Profile]) -> Vec<Number> {
    let mut numbers = Vec::new();
    for (k, profile) in rolling.iter().enumerate() {
        let (place, measured) = (ROLLING_AT[k], published(&ROLLING[2 * k]));
        let [reference, computed] =
            [&measured, profile].map(|film| mean_outside(film, &measured, place, 40.0));
        let case = format!("dimple at {place} um");
        numbers.push(Number::relative(
            "outside of the rolling dimple (measured)",
            case,
            "nm",
            reference,
            computed,
            0.03,
        ));
    }
    for (k, reference) in LARGEST.into_iter().enumerate() {
        let near = rolling[k + 1].iter().filter(|(x, _)| (x - ROLLING_AT[k + 1]).abs() < 40.0);
        let computed = near.map(|point| point.1).fold(0.0, f64::max);
        let case = format!("dimple at {} um", ROLLING_AT[k + 1]);
        numbers.push(Number::relative(
            "largest film of the rolling dimple (authors' computation)",
            case,
            "nm",
            reference,
            computed,
            0.07,
        ));
    }
    for (k, profile) in sliding.iter().enumerate().take(4).skip(1) {
        let (place, case) = (SLIDING_AT[k], format!("dimple at {} um", SLIDING_AT[k]));
        let groups = [
            ("thin film ahead of the sliding dimple (measured)", 0, 0.16),
            ("thin film ahead of the sliding dimple (authors' computation)", 1, 0.08),
        ];
        for (group, computed, bound) in groups {
            let reference = least(&published(&SLIDING[2 * k + computed]), place + 45.0, 110.0);
            let found = least(profile, place + 45.0, 110.0);
            numbers.push(Number::relative(group, case.clone(), "nm", reference, found, bound));
        }
    }
    numbers
}

fn figure(title: &str, data: &[[u16; 29]; 10], profiles: &[Profile], shown: [usize; 3]) -> Figure {
    let panel = |k: usize| {
        let shown = profiles[k].iter().copied().filter(|(x, _)| x.abs() <= 140.0).collect();
        Panel {
            y_label: "film, nm",
            lines: vec![
                Line { pen: Pen::strong(BLACK), points: published(&data[2 * k]) },
                Line { pen: Pen::dashed(VERMILION), points: published(&data[2 * k + 1]) },
                Line { pen: Pen::strong(BLUE), points: shown },
            ],
        }
    };
    Figure {
        title: title.to_owned(),
        x_label: "position along the flow, \u{b5}m",
        x_scale: XScale::FromZero,
        legend: vec![
            (Pen::strong(BLACK), "measured".to_owned()),
            (Pen::dashed(VERMILION), "computed by the authors".to_owned()),
            (Pen::strong(BLUE), "stribeck".to_owned()),
        ],
        panels: shown.map(panel).into(),
    }
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let smooth = smooth_film()?;
    let (center, exit) = (at(&smooth, 0.0), smooth.iter().filter(|(x, _)| (100.0..140.0).contains(x)));
    let exit = exit.map(|point| point.1).fold(f64::INFINITY, f64::min);
    let mut numbers = vec![
        Number::relative("center, smooth", "measured", "nm", 211.2, center, 0.03),
        Number::relative("center, smooth", "computed by the authors", "nm", 209.7, center, 0.035),
        Number::relative("constriction, smooth", "measured", "nm", 167.7, exit, 0.07),
        Number::relative("constriction, smooth", "computed by the authors", "nm", 175.3, exit, 0.03),
    ];
    let mut figures = Vec::new();
    if effort.is_full() {
        let (rolling, sliding) = rayon::join(|| DIMPLES[0].profiles(), || DIMPLES[1].profiles());
        let (rolling, sliding) = (rolling?, sliding?);
        numbers.extend(dimple_numbers(&rolling, &sliding));
        figures.push((
            "mourier_rolling",
            figure("A dimple that rolls through the contact", &ROLLING, &rolling, [1, 2, 3]),
        ));
        figures.push((
            "mourier_sliding",
            figure("A dimple that slides through the contact", &SLIDING, &sliding, [1, 2, 3]),
        ));
    }
    Ok(Row {
        name: "mourier",
        quantity: "Film of a ball, smooth and with a dimple",
        reference: "experiment: Mourier et al. (2006)",
        range: "0.39 GPa, 0.09 m/s, M 64, L 5.8; a dimple 175 nm deep that rolls, one of 160 nm that slides",
        numbers,
        extra: String::new(),
        figures,
    })
}
