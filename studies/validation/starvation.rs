//! Starved films over the supplied film, beside the curves of Chevalier and others.

use rayon::prelude::*;
use stribeck::lubricant::{DensityLaw, DowsonHigginson};
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{ContactSolution, Scene, solve_contact};

use crate::report::{Effort, Number, Outcome, Row};

/// A smooth steel ball in an oil of 40 mPa s and 20 1/GPa.
fn scene(pressure: f64) -> Outcome<Scene> {
    let mut scene = Scene::azam_2019(16);
    (scene.roughness, scene.plastic, scene.wear) = (Default::default(), None, None);
    scene.load.hertz_pressure = Some(pressure);
    (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (0.2, 0.0);
    if let Some(oil) = &mut scene.lubricant {
        (oil.eta0, oil.alpha, oil.formula_alpha) = (0.04, Some(20e-9), None);
    }
    let a = scene.hertz()?.half_width_x;
    scene.grid = GridSpec::Cells { nx: 160, ny: 112, x: [-5.0 * a, 1.5 * a], y: [-2.25 * a, 2.25 * a] };
    Ok(scene)
}

/// Central film at ambient density \[m\].
fn central_mass(solution: &ContactSolution) -> Outcome<f64> {
    let density = DowsonHigginson::new(0.6e-9, 1.7e-9)?;
    Ok(density.ratio(solution.pressure.central) * solution.film.central)
}

fn solved(scene: &Scene) -> Outcome<ContactSolution> {
    let solution = solve_contact(scene)?;
    solution.report.require_converged()?;
    Ok(solution)
}

/// Film over the flooded one by the curve with the exponent `gamma`; `supply` over the flooded film, both at ambient
/// density.
fn curve(supply: f64, gamma: f64) -> f64 {
    supply / (1.0 + supply.powf(gamma)).powf(1.0 / gamma)
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let (pressures, supplies): (&[f64], &[f64]) = if effort.is_full() {
        (&[0.5e9, 1.0e9], &[0.3, 0.5, 0.8, 1.0, 1.3, 2.0])
    } else {
        (&[0.5e9], &[0.5, 1.0])
    };
    let mut cases = Vec::new();
    for pressure in pressures {
        let scene = scene(*pressure)?;
        let flooded = central_mass(&solved(&scene)?)?;
        cases.extend(supplies.iter().map(|supply| (scene.clone(), flooded, *supply, 1e-9 * pressure)));
    }
    let numbers = (cases.into_par_iter())
        .map(|(mut scene, flooded, supply, gpa)| {
            scene.lubricant = scene.lubricant.map(|oil| oil.with_supplied_film(Some(supply * flooded)));
            let found = central_mass(&solved(&scene)?)? / flooded;
            let ends = [2.0, 5.0].map(|gamma| curve(supply, gamma));
            Ok(Number::between(
                "film over the flooded film",
                format!("{gpa} GPa; supply {supply}"),
                ends,
                found,
            ))
        })
        .collect::<Outcome<_>>()?;
    Ok(Row {
        name: "starvation",
        quantity: "Starved films of balls",
        reference: "fit to computations: Chevalier et al. (1998), exponents 2 to 5",
        range: "0.5 and 1 GPa, supplied film 0.3 to 2 of the flooded one",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}
