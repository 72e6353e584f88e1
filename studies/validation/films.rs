//! Central films of smooth contacts over the regimes, beside the formulas of Moes and others.

use std::f64::consts::PI;

use rayon::prelude::*;
use stribeck::analytic::{FilmConditions, LineFilmConditions};
use stribeck::reynolds::{FaceMobility, Scheme};
use stribeck::sim::scene::{BarusConstants, GridSpec, Load, LubricantSpec, ViscositySpec};
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::Form;

use crate::report::{Effort, Number, Outcome, Row};

const MODULUS: f64 = 226e9;
const ALPHA: f64 = 22e-9;
const ETA0: f64 = 0.04;

/// A smooth contact.
fn scene(form: Form, load: f64, speed: f64, oil: LubricantSpec) -> Scene {
    let mut scene = Scene::azam_2019(16);
    scene.form = form;
    scene.elastic.equivalent_modulus = MODULUS;
    scene.load = Load::force(load);
    scene.motion.entrainment_speed = speed;
    scene.motion.slide_roll_ratio = 0.0;
    scene.lubricant = Some(oil);
    (scene.roughness, scene.plastic, scene.wear) = (Default::default(), None, None);
    scene
}

fn central(scene: &Scene) -> Outcome<f64> {
    let solution = solve_contact(scene)?;
    solution.report.require_converged()?;
    Ok(solution.film.central)
}

/// Film by the formula and film of the solution \[m\] of a ball in a Roelands oil with the density of Dowson and Higginson.
fn point(moes_load: f64, moes_lubricant: f64) -> Outcome<[f64; 2]> {
    let radius = 1.0;
    let double_speed = (moes_lubricant / (ALPHA * MODULUS)).powi(4);
    let load = moes_load * double_speed.powf(0.75) * MODULUS * radius * radius;
    let speed = 0.5 * double_speed * MODULUS * radius / ETA0;
    let conditions = FilmConditions {
        entrainment_speed: speed,
        eta0: ETA0,
        alpha: ALPHA,
        equivalent_modulus: MODULUS,
        radius,
        load,
        ellipticity: 1.0,
    };
    let oil = LubricantSpec::roelands(ETA0, 0.68).with_alpha(Some(ALPHA));
    let mut scene = scene(Form::Sphere { radius }, load, speed, oil);
    scene.grid = GridSpec::Accuracy { accuracy: 0.02 };
    Ok([conditions.moes_central()?, central(&scene)?])
}

/// The same of a line contact in an incompressible Barus oil, in a box that holds its inlet.
fn line(moes_load: f64, moes_lubricant: f64) -> Outcome<[f64; 2]> {
    let (film, scene) = line_scene(moes_load, moes_lubricant)?;
    Ok([film, central(&scene)?])
}

/// Film of a line on 2048 nodes, and on 101 nodes with first-order entrainment and mean viscosities \[m\].
fn coarse_line(moes_load: f64, moes_lubricant: f64) -> Outcome<[f64; 2]> {
    let (_, fine) = line_scene(moes_load, moes_lubricant)?;
    let mut coarse = fine.clone();
    if let GridSpec::Row { nx, .. } = &mut coarse.grid {
        *nx = 101;
    }
    coarse.solver.scheme = Some(Scheme::FirstOrder);
    coarse.solver.face_mobility = Some(FaceMobility::Arithmetic);
    Ok([central(&fine)?, central(&coarse)?])
}

/// Film by the formula \[m\] and scene of a line.
fn line_scene(moes_load: f64, moes_lubricant: f64) -> Outcome<(f64, Scene)> {
    let radius = 1.0;
    let double_speed = (moes_lubricant / (ALPHA * MODULUS)).powi(4);
    let load = moes_load * double_speed.sqrt() * MODULUS * radius;
    let speed = 0.5 * double_speed * MODULUS * radius / ETA0;
    let conditions = LineFilmConditions {
        entrainment_speed: speed,
        eta0: ETA0,
        alpha: ALPHA,
        equivalent_modulus: MODULUS,
        radius,
        load,
    };
    let film = conditions.moes_central()?;
    let half_width = (8.0 * load * radius / (PI * MODULUS)).sqrt();
    let inlet = (4.0 * half_width).max(20.0 * (2.0 * radius * film).sqrt());
    let barus = ViscositySpec::Barus(BarusConstants { eta0: ETA0, alpha: ALPHA });
    let oil = LubricantSpec::roelands(0.0, 0.0).with_viscosity(Some(barus));
    let oil = oil.with_density_a(0.0).with_density_b(0.0);
    let mut scene = scene(Form::Cylinder { radius }, load, speed, oil);
    scene.grid = GridSpec::Row { nx: 2048, x: [-inlet, (2.0 * half_width).max(0.2 * inlet)] };
    Ok((film, scene))
}

fn numbers(
    group: &'static str,
    cases: &[(f64, f64)],
    bound: f64,
    films: fn(f64, f64) -> Outcome<[f64; 2]>,
) -> Outcome<Vec<Number>> {
    (cases.par_iter())
        .map(|(m, l)| {
            let [formula, found] = films(*m, *l)?.map(|film| 1e6 * film);
            Ok(Number::relative(group, format!("M {m}; L {l}"), "um", formula, found, bound))
        })
        .collect()
}

pub(crate) fn points(effort: Effort) -> Outcome<Row> {
    let full =
        [5.0, 10.0, 30.0, 100.0, 300.0].into_iter().flat_map(|m| [1.0, 2.5, 5.0, 10.0].map(|l| (m, l)));
    let cases: Vec<_> = if effort.is_full() { full.collect() } else { vec![(10.0, 5.0), (30.0, 10.0)] };
    Ok(Row {
        name: "point_films",
        quantity: "Central films of balls",
        reference: "fit to computations: Nijenbanning, Venner and Moes (1994)",
        range: "M 5 to 300, L 1 to 10, oil of Roelands and Dowson and Higginson",
        numbers: numbers("central film", &cases, 0.22, point)?,
        extra: String::new(),
        figures: Vec::new(),
    })
}

pub(crate) fn lines(effort: Effort) -> Outcome<Row> {
    let full = [1.0, 3.0, 10.0, 30.0, 100.0].into_iter().flat_map(|m| [1.0, 5.0, 10.0].map(|l| (m, l)));
    let cases: Vec<_> = if effort.is_full() { full.collect() } else { vec![(10.0, 5.0), (30.0, 10.0)] };
    Ok(Row {
        name: "line_films",
        quantity: "Central films of lines",
        reference: "fit to computations: Moes (1992)",
        range: "M 1 to 100, L 1 to 10, incompressible Barus oil",
        numbers: numbers("central film", &cases, 0.2, line)?,
        extra: String::new(),
        figures: Vec::new(),
    })
}

pub(crate) fn coarse_lines(effort: Effort) -> Outcome<Row> {
    let full = [10.0, 30.0, 100.0].into_iter().flat_map(|m| [2.5, 5.0, 10.0].map(|l| (m, l)));
    let cases: Vec<_> = if effort.is_full() { full.collect() } else { vec![(30.0, 5.0)] };
    Ok(Row {
        name: "coarse_lines",
        quantity: "Films of lines on 101 nodes, first order",
        reference: "own computation: 2048 nodes, second order",
        range: "M 10 to 100, L 2.5 to 10, incompressible Barus oil",
        numbers: numbers("central film", &cases, 0.13, coarse_line)?,
        extra: String::new(),
        figures: Vec::new(),
    })
}

/// Film by the formula of Brewe, Hamrock and Taylor and film of the solution \[m\] of a ball of 15 mm that hardly deflects.
fn rigid_ball() -> Outcome<[f64; 2]> {
    let (radius, modulus, eta0, load, speed) = (15e-3, 230e9, 0.05, 0.765, 3.15);
    let oil = LubricantSpec::roelands(eta0, 0.6).with_alpha(Some(ALPHA));
    let mut scene = scene(Form::Sphere { radius }, load, speed, oil);
    scene.elastic.equivalent_modulus = modulus;
    let a = scene.hertz()?.half_width_x;
    scene.grid = GridSpec::Cells { nx: 54, ny: 48, x: [-5.0 * a, 1.75 * a], y: [-3.0 * a, 3.0 * a] };
    let side = (1.0 + 2.0_f64 / 3.0).powi(-2) * (0.131 * 0.5_f64.atan() + 1.683).powi(2);
    let speed_over_load = eta0 * speed * radius / load;
    Ok([128.0 * radius * side * speed_over_load * speed_over_load, central(&scene)?])
}

pub(crate) fn rigid(_: Effort) -> Outcome<Row> {
    let [formula, film] = rigid_ball()?;
    Ok(Row {
        name: "rigid_films",
        quantity: "Film of a ball that hardly deflects",
        reference: "fit to computations: Brewe, Hamrock and Taylor (1979)",
        range: "M 0.5, L 15.6",
        numbers: vec![Number::relative(
            "central film",
            "15 mm; 0.77 N; 3.15 m/s",
            "um",
            1e6 * formula,
            1e6 * film,
            0.02,
        )],
        extra: String::new(),
        figures: Vec::new(),
    })
}

/// Radius \[m\], equivalent modulus \[Pa\], load \[N\], viscosity \[Pa s\], mean speed \[m/s\] of soft balls.
const SOFT: [(&str, [f64; 5]); 4] = [
    ("hip", [0.8, 2e9, 1000.0, 5e-3, 0.02]),
    ("rubber", [0.01, 13e6, 5.0, 0.05, 0.05]),
    ("rubber; 0.5 m/s", [0.01, 13e6, 5.0, 0.05, 0.5]),
    ("gel", [0.01, 1e6, 0.1, 0.01, 0.02]),
];

/// Films by the formulas of Hamrock and Dowson and of Nijenbanning, Venner and Moes, and film of the solution \[m\].
fn soft_ball([radius, modulus, load, eta0, speed]: [f64; 5]) -> Outcome<[f64; 3]> {
    let alpha = 1e-9;
    let oil = LubricantSpec::roelands(eta0, 0.6).with_alpha(Some(alpha));
    let mut scene = scene(Form::Sphere { radius }, load, speed, oil);
    scene.elastic.equivalent_modulus = modulus;
    let a = scene.hertz()?.half_width_x;
    scene.grid = GridSpec::Cells { nx: 192, ny: 160, x: [-3.0 * a, 2.0 * a], y: [-2.25 * a, 2.25 * a] };
    let conditions = FilmConditions {
        entrainment_speed: speed,
        eta0,
        alpha,
        equivalent_modulus: modulus,
        radius,
        load,
        ellipticity: 1.0,
    };
    Ok([conditions.hamrock_dowson_soft()?, conditions.moes_central()?, central(&scene)?])
}

pub(crate) fn soft(effort: Effort) -> Outcome<Row> {
    let cases = if effort.is_full() { &SOFT[..] } else { &SOFT[..2] };
    let films: Vec<_> = cases.par_iter().map(|(_, ball)| soft_ball(*ball)).collect::<Outcome<_>>()?;
    let mut numbers = Vec::new();
    for ((name, _), film) in cases.iter().zip(films) {
        let [dowson, moes, found] = film.map(|film| 1e6 * film);
        numbers.push(Number::relative("Hamrock and Dowson (1978)", *name, "um", dowson, found, 0.3));
        numbers.push(Number::relative("Nijenbanning, Venner and Moes (1994)", *name, "um", moes, found, 0.1));
    }
    Ok(Row {
        name: "soft_films",
        quantity: "Central films of soft balls",
        reference: "fits to computations: Hamrock and Dowson (1978); Nijenbanning, Venner and Moes (1994)",
        range: "equivalent modulus 1 MPa to 2 GPa, nearly isoviscous oil",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}
