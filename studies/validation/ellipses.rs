//! Minimum films of crowned rollers over those of the formula of Hamrock and Dowson, beside the mean of measured ones.

use rayon::prelude::*;
use stribeck::analytic::{FilmConditions, HertzPoint, equivalent_modulus};
use stribeck::sim::scene::{GridSpec, Load, LubricantSpec};
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::Form;

use crate::report::{Effort, Number, Outcome, Row};

/// Minimum film over that of the formula, steel on sapphire; radius across over radius along the flow.
fn ratio(radii: f64, pressure: f64, speed: f64) -> Outcome<f64> {
    let (radius_x, eta0, alpha) = (10e-3, 0.05, 20e-9);
    let radius_y = radii * radius_x;
    let modulus = equivalent_modulus([210e9, 0.3], [400e9, 0.27])?;
    let hertz = HertzPoint::from_max_pressure(radius_x, radius_y, modulus, pressure)?;
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Ellipsoid { radius_x, radius_y, angle: 0.0 };
    scene.elastic.equivalent_modulus = modulus;
    scene.load = Load::force(hertz.force);
    (scene.motion.entrainment_speed, scene.motion.slide_roll_ratio) = (speed, 0.0);
    scene.lubricant = Some(LubricantSpec::roelands(eta0, 0.68).with_alpha(Some(alpha)));
    (scene.roughness, scene.plastic, scene.wear) = (Default::default(), None, None);
    let [a, b] = [hertz.half_width_x, hertz.half_width_y];
    scene.grid = GridSpec::Accuracy { accuracy: 0.03 };
    let solution = solve_contact(&scene)?;
    solution.report.require_converged()?;
    let conditions = FilmConditions {
        entrainment_speed: speed,
        eta0,
        alpha,
        equivalent_modulus: modulus,
        radius: radius_x,
        load: hertz.force,
        ellipticity: b / a,
    };
    Ok(solution.film.minimum / conditions.hamrock_dowson_minimum()?)
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let (radii, pressures, speeds): (&[f64], &[f64], &[f64]) = if effort.is_full() {
        (&[0.5, 1.0, 2.0, 4.0], &[0.5e9, 1.0e9], &[0.4, 1.6])
    } else {
        (&[1.0, 4.0], &[0.5e9], &[1.6])
    };
    let mut cases = Vec::new();
    for radii in radii {
        for pressure in pressures {
            cases.extend(speeds.iter().map(|speed| (*radii, *pressure, *speed)));
        }
    }
    let ratios: Vec<f64> = (cases.par_iter())
        .map(|(radii, pressure, speed)| ratio(*radii, *pressure, *speed))
        .collect::<Outcome<_>>()?;
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    let mut numbers = vec![Number::absolute(
        "mean of minimum film over formula",
        "57 measured films",
        "",
        1.30,
        mean,
        0.45,
    )];
    for ((radii, pressure, speed), ratio) in cases.iter().zip(&ratios) {
        let case = format!("Ry/Rx {radii}; {} GPa; {speed} m/s", 1e-9 * pressure);
        numbers.push(Number::relative(
            "minimum film over the formula of Hamrock and Dowson",
            case,
            "",
            1.0,
            *ratio,
            0.26,
        ));
    }
    Ok(Row {
        name: "crowned_rollers",
        quantity: "Minimum films of ellipses",
        reference: "experiment: mean of Koye and Winer (1981); fit: Hamrock and Dowson (1977)",
        range: "steel on sapphire, Ry/Rx 0.5 to 4, 0.5 and 1 GPa, 0.4 and 1.6 m/s",
        numbers,
        extra: String::new(),
        figures: Vec::new(),
    })
}
