//! Films thinned by the heat of their inlet, beside an independent solution of the line contact and the published fits.

use rayon::prelude::*;
use stribeck::analytic::ThermalInlet;
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::thermal::{FilmProfile, FilmThermal};

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::report::{Effort, Number, Outcome, Row};

const BULK: f64 = 313.15;
const PRESSURE: f64 = 1e9;
const RADIUS: f64 = 10e-3;
const ETA0: f64 = 0.04;
const ALPHA: f64 = 18e-9;
const INDEX: f64 = 1.1;

/// Loading parameter; film over the isothermal one of a line between steel bodies in pure rolling by an independent program
/// (Dowson's integrals across the film, energy equation along and across it, heat of compression; error 0.003); the integral
/// of Greenwood and Kauzlarich (1973).
const LINE: [[f64; 3]; 5] =
    [[0.1, 0.962, 0.975], [0.5, 0.880, 0.900], [1.0, 0.813, 0.834], [2.0, 0.726, 0.747], [5.0, 0.592, 0.608]];

/// Slide-roll ratio, loading parameter and the film over the isothermal one of a sliding line by the same program, with a
/// limiting shear stress of 100 MPa.
const SLIDING: [[f64; 3]; 6] = [
    [0.5, 0.1, 0.956],
    [0.5, 0.5, 0.858],
    [0.5, 1.0, 0.780],
    [0.5, 2.0, 0.682],
    [0.5, 5.0, 0.538],
    [1.0, 0.77, 0.733],
];

/// Temperature coefficient of the viscosity at ambient pressure \[1/K\].
fn coefficient() -> f64 {
    ALPHA * 1.96e8 / 0.68 * INDEX / (BULK - 138.0)
}

fn inlet(loading: f64, modulus: f64) -> ThermalInlet {
    let conductivity = FilmThermal::default().conductivity;
    ThermalInlet {
        entrainment_speed: (loading * conductivity / (coefficient() * ETA0)).sqrt(),
        eta0: ETA0,
        temperature_coefficient: coefficient(),
        conductivity,
        pressure_over_modulus: PRESSURE / modulus,
        slide_roll_ratio: 0.0,
    }
}

fn scene(form: Form, [ratio, loading]: [f64; 2]) -> Outcome<Scene> {
    let mut scene = Scene::azam_2019(16);
    (scene.roughness, scene.plastic, scene.wear) = (Default::default(), None, None);
    scene.form = form;
    scene.load.hertz_pressure = Some(PRESSURE);
    scene.motion.entrainment_speed = inlet(loading, 1.0).entrainment_speed;
    scene.motion.slide_roll_ratio = ratio;
    scene.thermal.bulk_temperature = BULK;
    if let Some(oil) = &mut scene.lubricant {
        (oil.eta0, oil.alpha, oil.formula_alpha) = (ETA0, Some(ALPHA), None);
        (oil.temperature, oil.roelands_s0) = (Some(BULK), Some(INDEX));
    }
    let hertz = scene.hertz()?;
    let (a, b) = (hertz.half_width_x, hertz.half_width_y);
    scene.grid = if form.is_line() {
        GridSpec::Row { nx: 640, x: [-10.0 * a, 1.5 * a] }
    } else {
        GridSpec::Cells { nx: 112, ny: 80, x: [-4.0 * a, 1.5 * a], y: [-2.0 * b, 2.0 * b] }
    };
    Ok(scene)
}

fn mass(solution: &ContactSolution) -> f64 {
    solution.grid.interpolate(&solution.state.mass, 0.0, 0.0).unwrap_or(f64::NAN)
}

/// Central film at ambient density over that of the isothermal contact, at a slide-roll ratio and loading parameter.
fn reduction(form: Form, motion: [f64; 2]) -> Outcome<f64> {
    let mut scene = scene(form, motion)?;
    let cool = solve_contact(&scene)?;
    let thermal = FilmThermal::default().with_profile(FilmProfile::Collocation);
    scene.lubricant = scene.lubricant.map(|oil| oil.with_thermal(Some(thermal)));
    let warm = solve_contact(&scene)?;
    for solution in [&cool, &warm] {
        solution.report.require_converged()?;
    }
    Ok(mass(&warm) / mass(&cool))
}

fn lines(cases: &[[f64; 3]]) -> Outcome<Vec<[f64; 6]>> {
    let modulus = Scene::azam_2019(16).elastic.equivalent_modulus;
    (cases.par_iter())
        .map(|[loading, own, integral]| {
            let found = reduction(Form::Cylinder { radius: RADIUS }, [0.0, *loading])?;
            let inlet = inlet(*loading, modulus);
            Ok([*loading, *own, found, inlet.murch_wilson()?, *integral, inlet.gupta()?])
        })
        .collect()
}

fn figure(found: &[[f64; 6]]) -> Figure {
    let line = |k: usize, pen: Pen| Line { pen, points: found.iter().map(|row| (row[0], row[k])).collect() };
    let pens = [
        (1, Pen::strong(BLACK), "independent solution"),
        (2, Pen::strong(BLUE), "stribeck"),
        (3, Pen::dashed(VERMILION), "Murch and Wilson"),
        (4, Pen::dashed(BLACK), "Greenwood and Kauzlarich"),
        (5, Pen::dashed(BLUE), "Gupta et al."),
    ];
    Figure {
        title: "Film over the isothermal film of a line contact in pure rolling".to_owned(),
        x_label: "thermal loading parameter L",
        x_scale: XScale::FromZero,
        legend: pens.iter().map(|(_, pen, name)| (*pen, (*name).to_owned())).collect(),
        panels: vec![Panel {
            y_label: "film ratio",
            lines: pens.iter().map(|(k, pen, _)| line(*k, *pen)).collect(),
        }],
    }
}

/// The rolling lines, one a line.
fn table(found: &[[f64; 6]]) -> String {
    let mut text = String::from(
        "\n| rolling line, L | independent solution | stribeck | Murch and Wilson | Greenwood and Kauzlarich | Gupta et al. |\n\
         |---|---|---|---|---|---|\n",
    );
    for [loading, rest @ ..] in found {
        let films: Vec<String> = rest.iter().map(|film| format!("{film:.3}")).collect();
        text += &format!("| {loading} | {} |\n", films.join(" | "));
    }
    text
}

/// Sliding lines beside the independent solution.
fn sliding(effort: Effort) -> Outcome<Vec<Number>> {
    let cases = if effort.is_full() { &SLIDING[..] } else { &SLIDING[1..2] };
    (cases.par_iter())
        .map(|[ratio, loading, own]| {
            let found = reduction(Form::Cylinder { radius: RADIUS }, [*ratio, *loading])?;
            let (group, bound) = if *ratio < 1.0 {
                ("sliding line, slide-roll ratio 0.5: independent solution", 0.04)
            } else {
                ("sliding line, slide-roll ratio 1: independent solution", 0.05)
            };
            Ok(Number::absolute(group, format!("L {loading}; steel"), "", *own, found, bound))
        })
        .collect()
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let found = lines(if effort.is_full() { &LINE } else { &LINE[..2] })?;
    let mut numbers = Vec::new();
    for [loading, own, found, murch, integral, gupta] in &found {
        let case = |name: &str| format!("L {loading}, {name}").replace(',', ";");
        numbers.push(Number::absolute("line: independent solution", case("steel"), "", *own, *found, 0.01));
        numbers.push(Number::absolute(
            "line: Murch and Wilson (1975)",
            case("fit"),
            "",
            *murch,
            *found,
            0.03,
        ));
        numbers.push(Number::absolute(
            "line: Greenwood and Kauzlarich (1973)",
            case("integral"),
            "",
            *integral,
            *found,
            0.03,
        ));
        numbers.push(Number::absolute("line: Gupta et al. (1992)", case("fit"), "", *gupta, *found, 0.04));
    }
    numbers.extend(sliding(effort)?);
    let ellipses: &[f64] = if effort.is_full() { &[1.0, 3.0, 10.0] } else { &[1.0] };
    let computed: Vec<f64> = (ellipses.par_iter())
        .map(|ratio| {
            let form = Form::Ellipsoid { radius_x: RADIUS, radius_y: ratio * RADIUS, angle: 0.0 };
            reduction(form, [0.0, 0.77])
        })
        .collect::<Outcome<_>>()?;
    for (ratio, found) in ellipses.iter().zip(computed) {
        let cut = inlet(0.77 / (1.0 + 2.0 / (3.0 * ratio)).powi(2), 1.0);
        let case = format!("L 0.77; Ry/Rx {ratio}");
        numbers.push(Number::absolute(
            "ellipse: Murch and Wilson with side flow",
            case,
            "",
            cut.murch_wilson()?,
            found,
            0.02,
        ));
    }
    Ok(Row {
        name: "inlet_heat",
        quantity: "Loss of film by inlet heating",
        reference: "independent computation of the line contact; fits of Murch and Wilson, Greenwood and Kauzlarich, Gupta et al.",
        range: "1 GPa, L 0.1 to 5, pure rolling; lines at slide-roll ratios 0.5 and 1",
        numbers,
        extra: table(&found),
        figures: vec![("inlet_heat", figure(&found))],
    })
}
