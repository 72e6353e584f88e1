//! Steps in time: errors of wear and film of one history against the length and the number of its steps.

use std::error::Error;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;

use plotters::style::{BLACK, RGBColor};
use stribeck::sim::{MixedLubricationSim, Scene, StepControl, StepRecord};
use stribeck::surface::Fixed;

use crate::{Series, Stopwatch};

/// Time of the history \[s\].
const END: f64 = 2400.0;
/// Lengths of fixed steps \[s\] and that of the reference.
const LENGTHS: [f64; 6] = [600.0, 300.0, 150.0, 75.0, 37.5, 18.75];
const REFERENCE: f64 = 4.6875;
/// Largest change of wear or film of any node in a step \[m\].
const DEPTHS: [f64; 5] = [32e-9, 16e-9, 8e-9, 4e-9, 2e-9];

/// One history.
pub(crate) struct Row {
    control: &'static str,
    /// Length of a fixed step \[s\] or depth of a bounded one \[m\].
    bound: f64,
    steps: u64,
    seconds: f64,
    convolutions: f64,
    /// Relative errors of the mean wear and the mean film of the disc.
    errors: [f64; 2],
}

/// What a history costs and ends with.
struct Outcome {
    steps: u64,
    seconds: f64,
    convolutions: f64,
    values: [f64; 2],
}

/// The rough reference contact with its tribofilm. The roughness stays where it is: moved at random it would
/// scatter by more than the steps err.
fn history(cells: usize, end: f64, control: &StepControl) -> Result<Outcome, Box<dyn Error>> {
    let scene = Scene::azam_2019(cells).with_tribofilm();
    let mut sim = MixedLubricationSim::builder(scene).motion(Fixed).build()?;
    let watch = Stopwatch::start();
    let (mut convolutions, mut values) = (0.0, [0.0; 2]);
    sim.run_until(end, control, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        convolutions += record.report.work.convolutions;
        values = [record.wear.disc_mean, record.tribofilm.disc_mean];
        ControlFlow::Continue(())
    })?;
    Ok(Outcome { steps: sim.steps(), seconds: watch.seconds(), convolutions, values })
}

/// All histories.
pub(crate) fn rows(quick: bool) -> Result<Vec<Row>, Box<dyn Error>> {
    let (cells, end, reference, count) =
        if quick { (32, END / 4.0, LENGTHS[4], 3) } else { (64, END, REFERENCE, usize::MAX) };
    let exact = history(cells, end, &StepControl::fixed(reference))?;
    println!("steps in time: {} steps of {reference} s, {:?}", exact.steps, exact.values);
    let fixed = LENGTHS.iter().take(count).map(|length| ("fixed", *length, StepControl::fixed(*length)));
    let bounded =
        DEPTHS.iter().take(count).map(|depth| ("bounded", *depth, StepControl::new(LENGTHS[0], *depth)));
    fixed
        .chain(bounded)
        .map(|(control, bound, step)| {
            let Outcome { steps, seconds, convolutions, values } = history(cells, end, &step)?;
            let errors = [0, 1].map(|k: usize| (values[k] / exact.values[k] - 1.0).abs());
            Ok(Row { control, bound, steps, seconds, convolutions, errors })
        })
        .collect()
}

pub(crate) fn write_table(rows: &[Row], path: &Path) -> Result<(), Box<dyn Error>> {
    let mut text =
        String::from("control,bound_s_or_m,steps,seconds,convolutions,mean_wear_error,mean_film_error\n");
    for Row { control, bound, steps, seconds, convolutions, errors } in rows {
        let [wear, film] = errors;
        writeln!(text, "{control},{bound:e},{steps},{seconds:.3},{convolutions:.0},{wear:.3e},{film:.3e}")?;
    }
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()).into())
}

/// Errors over the mean length of a step \[s\] and over seconds, a colour for each control.
pub(crate) fn panels(rows: &[Row], quick: bool) -> [Vec<Series>; 2] {
    let end = if quick { END / 4.0 } else { END };
    let costs: [&dyn Fn(&Row) -> f64; 2] = [&|row| end / row.steps as f64, &|row| row.seconds];
    costs.map(|cost| {
        let of = |control: &str, colour: RGBColor| {
            let points = |k: usize| {
                let of_control = rows.iter().filter(|row| row.control == control && row.errors[k] > 0.0);
                of_control.map(|row| (cost(row), row.errors[k])).collect()
            };
            Series { colour, points: [points(0), points(1)], loose: Vec::new() }
        };
        vec![of("fixed", BLACK), of("bounded", RGBColor(0, 114, 178))]
    })
}
