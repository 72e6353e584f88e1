//! Rough contacts over the nominal film ratio, beside statements on measured films.

use rayon::prelude::*;
use stribeck::analytic::{FilmConditions, equivalent_modulus};
use stribeck::sim::scene::{GridSpec, LubricantSpec, Roughness, RoughnessPair, SolverModel};
use stribeck::sim::{Scene, solve_contact};
use stribeck::surface::Form;

use crate::chart::{BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use crate::report::{Effort, Number, Outcome, Row};

const RADIUS: f64 = 9.525e-3;
const RQ: f64 = 60e-9;
const ETA0: f64 = 0.05;
const ALPHA: f64 = 20e-9;
/// Correlation lengths \[m\].
pub(crate) const LENGTHS: [f64; 2] = [16e-6, 48e-6];
/// Nominal film ratios, and those above which the law of asperity inlets does not hold.
const LAMBDAS: [f64; 9] = [0.05, 0.1, 0.2, 0.35, 0.5, 1.0, 1.5, 2.0, 3.0];
const LARGEST_OF_LAW: f64 = 0.5;
const SMALLEST_RESOLVED: f64 = 0.2;

/// A steel ball on glass at 0.5 GPa whose film by the formula of Hamrock and Dowson is `lambda` times Rq.
fn scene(lambda: f64) -> Outcome<Scene> {
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Sphere { radius: RADIUS };
    scene.elastic.equivalent_modulus = equivalent_modulus([210e9, 0.3], [75e9, 0.22])?;
    scene.load.hertz_pressure = Some(0.5e9);
    scene.lubricant = Some(LubricantSpec::roelands(ETA0, 0.68).with_alpha(Some(ALPHA)));
    scene.friction.eyring_stress = Some(5e6);
    (scene.roughness, scene.plastic, scene.wear) = (RoughnessPair::default(), None, None);
    let conditions = FilmConditions {
        entrainment_speed: 1.0,
        eta0: ETA0,
        alpha: ALPHA,
        equivalent_modulus: scene.elastic.equivalent_modulus,
        radius: RADIUS,
        load: scene.hertz()?.force,
        ellipticity: 1.0,
    };
    // The formula has the speed to the power 0.67.
    let film = conditions.hamrock_dowson_central()?;
    scene.motion.entrainment_speed = (lambda * RQ / film).powf(1.0 / 0.67);
    scene.motion.slide_roll_ratio = 0.5;
    Ok(scene)
}

/// Mean film in nanometers, share of the load on solids, friction.
fn solved(scene: &Scene) -> Outcome<[f64; 3]> {
    let solution = solve_contact(scene)?;
    solution.report.require_converged()?;
    let film = 1e9 * solution.film.mean_central;
    Ok([film, solution.contact.load_ratio, solution.friction.coefficient])
}

#[derive(Debug, Clone, Copy)]
pub(crate) struct Case {
    pub(crate) lambda: f64,
    pub(crate) length: f64,
    pub(crate) seed: u64,
    pub(crate) model: SolverModel,
}

impl Case {
    pub(crate) fn is_at(&self, lambda: f64, length: f64) -> bool {
        (self.lambda - lambda).abs() < 1e-9 && (self.length - length).abs() < 1e-9
    }

    fn solve(&self) -> Outcome<[f64; 3]> {
        let mut scene = scene(self.lambda)?;
        let a = scene.hertz()?.half_width_x;
        let n = if self.model.is_resolved() { 192 } else { 256 };
        scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-2.0 * a, 1.4 * a], y: [-1.7 * a, 1.7 * a] };
        scene.solver.model = self.model;
        scene.roughness.ball = Roughness::gaussian(RQ, self.length, self.seed);
        solved(&scene)
    }
}

fn smooth(lambda: f64) -> Outcome<f64> {
    let mut scene = scene(lambda)?;
    let a = scene.hertz()?.half_width_x;
    scene.grid = GridSpec::Cells { nx: 128, ny: 128, x: [-2.0 * a, 1.4 * a], y: [-1.7 * a, 1.7 * a] };
    solved(&scene).map(|found| found[0])
}

/// Film over the smooth film, share on solids and friction of each case.
pub(crate) fn computed(cases: &[Case], lambdas: &[f64]) -> Outcome<Vec<(Case, [f64; 3])>> {
    let smooth: Vec<f64> = lambdas.par_iter().map(|lambda| smooth(*lambda)).collect::<Outcome<_>>()?;
    (cases.par_iter())
        .map(|case| {
            let [film, share, friction] = case.solve()?;
            let k = lambdas.partition_point(|lambda| *lambda < case.lambda);
            Ok((*case, [film / smooth[k], share, friction]))
        })
        .collect()
}

/// All contacts, or one resolved one.
fn cases(effort: Effort) -> Vec<Case> {
    if !effort.is_full() {
        return vec![Case { lambda: 2.0, length: LENGTHS[0], seed: 1, model: SolverModel::Resolved }];
    }
    let mut cases = Vec::new();
    for length in LENGTHS {
        for seed in 1..=2 {
            for lambda in LAMBDAS {
                let mut add = |model| cases.push(Case { lambda, length, seed, model });
                if lambda <= LARGEST_OF_LAW {
                    add(SolverModel::AsperityInlets);
                }
                if lambda >= SMALLEST_RESOLVED {
                    add(SolverModel::Resolved);
                }
            }
        }
    }
    cases
}

fn figure(found: &[(Case, [f64; 3])]) -> Figure {
    let mut panels = Vec::new();
    for (k, y_label) in ["film / smooth", "load on solids", "friction"].into_iter().enumerate() {
        let mut lines = Vec::new();
        for (length, colour) in LENGTHS.into_iter().zip([BLUE, VERMILION]) {
            for model in [SolverModel::Resolved, SolverModel::AsperityInlets] {
                for seed in 1..=2 {
                    let of = |case: &Case| {
                        case.is_at(case.lambda, length) && case.model == model && case.seed == seed
                    };
                    let points = found.iter().filter(|(case, _)| of(case));
                    let points = points.map(|(case, values)| (case.lambda.log10(), values[k])).collect();
                    let pen = if model.is_resolved() { Pen::strong(colour) } else { Pen::dashed(colour) };
                    lines.push(Line { pen, points });
                }
            }
        }
        panels.push(Panel { y_label, lines });
    }
    Figure {
        title: "Rough contacts over the nominal film ratio; two surfaces each".to_owned(),
        x_label: "nominal lambda",
        x_scale: XScale::Decades,
        legend: vec![
            (Pen::strong(BLUE), "16 \u{b5}m, resolved".to_owned()),
            (Pen::dashed(BLUE), "16 \u{b5}m, asperity inlets".to_owned()),
            (Pen::strong(VERMILION), "48 \u{b5}m, resolved".to_owned()),
            (Pen::dashed(VERMILION), "48 \u{b5}m, asperity inlets".to_owned()),
        ],
        panels,
    }
}

/// Smallest and largest value, once if both are the same text.
fn range(values: &[f64], decimals: usize) -> String {
    let [low, high] = [f64::min, f64::max].map(|of| values.iter().copied().reduce(of).unwrap_or(f64::NAN));
    let [low, high] = [low, high].map(|value| format!("{value:.decimals$}"));
    if low == high { low } else { format!("{low} to {high}") }
}

/// Ranges over the surfaces, one line per film ratio, correlation length and model.
fn table(found: &[(Case, [f64; 3])]) -> String {
    let mut text = String::from(
        "\n| nominal lambda | correlation length, um | model | mean film over smooth film | load on solids | friction |\n\
         |---|---|---|---|---|---|\n",
    );
    for lambda in LAMBDAS {
        for length in LENGTHS {
            for (model, name) in
                [(SolverModel::Resolved, "resolved"), (SolverModel::AsperityInlets, "asperity inlets")]
            {
                let of = |case: &Case| case.is_at(lambda, length) && case.model == model;
                let values: Vec<[f64; 3]> =
                    found.iter().filter(|(case, _)| of(case)).map(|found| found.1).collect();
                if values.is_empty() {
                    continue;
                }
                let [film, share, friction] =
                    [0, 1, 2].map(|k| range(&values.iter().map(|value| value[k]).collect::<Vec<f64>>(), 3));
                text +=
                    &format!("| {lambda} | {:.0} | {name} | {film} | {share} | {friction} |\n", 1e6 * length);
            }
        }
    }
    text
}

/// Largest film ratio at which solids carry more than a hundredth of the load of any surface; resolved contacts count where
/// both models have one.
fn onset(found: &[(Case, [f64; 3])], length: f64) -> f64 {
    let counts = |case: &Case| case.model.is_resolved() || case.lambda < SMALLEST_RESOLVED;
    let of = found.iter().filter(|(case, _)| case.is_at(case.lambda, length) && counts(case));
    of.filter(|(_, values)| values[1] > 0.01).map(|(case, _)| case.lambda).fold(0.0, f64::max)
}

pub(crate) fn row(effort: Effort) -> Outcome<Row> {
    let found = computed(&cases(effort), if effort.is_full() { &LAMBDAS } else { &[2.0] })?;
    let mut numbers = Vec::new();
    for (case, [film, share, _]) in found.iter().filter(|(case, _)| case.model.is_resolved()) {
        let text = format!("lambda {}; {:.0} um; seed {}", case.lambda, 1e6 * case.length, case.seed);
        if case.lambda >= 2.0 {
            numbers.push(Number::relative(
                "mean film over smooth film, lambda 2 and 3",
                text.clone(),
                "",
                1.0,
                *film,
                0.06,
            ));
            numbers.push(Number::between("load on solids, lambda 2 and 3", text, [0.0, 0.01], *share));
        } else if let Some((_, law)) = found.iter().find(|(other, _)| {
            other.is_at(case.lambda, case.length) && other.seed == case.seed && !other.model.is_resolved()
        }) {
            numbers.push(Number::absolute(
                "load on solids, asperity inlets beside resolved, lambda 0.2 to 0.5",
                text,
                "",
                *share,
                law[1],
                0.035,
            ));
        }
    }
    if effort.is_full() {
        for length in LENGTHS {
            let case = format!("{:.0} um", 1e6 * length);
            let found = onset(&found, length);
            let number = Number::between("lambda below which solids carry 1 %", case, [0.1, 2.0], found);
            numbers.push(Number { bound: 0.06, ..number });
        }
    }
    Ok(Row {
        name: "rough_films",
        quantity: "Mean film of rough contacts",
        reference: "statements on measured films: Guangteng et al. (2000)",
        range: "steel on glass, 0.5 GPa, Rq 60 nm, correlation lengths 16 and 48 um, nominal lambda 0.05 to 3",
        numbers,
        extra: table(&found),
        figures: vec![("rough_films", figure(&found))],
    })
}
