//! Steps in time: errors of wear and film of one history against the number of its steps.

use std::error::Error;
use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use stribeck::sim::{MixedLubricationSim, Scene, StepControl, StepRecord};
use stribeck::surface::Fixed;

use crate::chart::{BLACK, BLUE, Figure, Line, Panel, Pen, XScale};

/// Time of the history \[s\].
const END: f64 = 2400.0;
/// Lengths of fixed steps \[s\] and that of the reference.
const LENGTHS: [f64; 6] = [600.0, 300.0, 150.0, 75.0, 37.5, 18.75];
const REFERENCE: f64 = 4.6875;
/// Largest change of wear or film of any node in a step \[m\].
const DEPTHS: [f64; 5] = [32e-9, 16e-9, 8e-9, 4e-9, 2e-9];

/// Steps, seconds, convolutions, and mean wear and film of the disc of one history of the rough reference contact with its
/// tribofilm. The roughness stays where it is: moved at random it would scatter by more than the steps err.
fn history(cells: usize, end: f64, control: &StepControl) -> Result<[f64; 5], Box<dyn Error>> {
    let scene = Scene::azam_2019(cells).with_tribofilm();
    let mut sim = MixedLubricationSim::builder(scene).motion(Fixed).build()?;
    let (started, mut convolutions, mut values) = (Instant::now(), 0.0, [0.0; 2]);
    sim.run_until(end, control, &mut |_: &MixedLubricationSim, record: &StepRecord| {
        convolutions += record.report.work.convolutions;
        values = [record.wear.disc_mean, record.tribofilm.disc_mean];
        ControlFlow::Continue(())
    })?;
    Ok([sim.steps() as f64, started.elapsed().as_secs_f64(), convolutions, values[0], values[1]])
}

/// Solves all histories, and writes table and figure.
pub(crate) fn run(quick: bool, folder: &Path) -> Result<(), Box<dyn Error>> {
    let (cells, end, reference, count) =
        if quick { (32, END / 4.0, LENGTHS[4], 3) } else { (64, END, REFERENCE, usize::MAX) };
    let exact = history(cells, end, &StepControl::fixed(reference))?;
    println!("steps in time: {} steps of {reference} s", exact[0]);
    let fixed = LENGTHS.iter().take(count).map(|length| ("fixed", *length, StepControl::fixed(*length)));
    let bounded =
        DEPTHS.iter().take(count).map(|depth| ("bounded", *depth, StepControl::new(LENGTHS[0], *depth)));
    let mut table =
        String::from("control,bound_s_or_m,steps,seconds,convolutions,mean_wear_error,mean_film_error\n");
    let pens = [("fixed", BLACK), ("bounded", BLUE)].map(|(name, colour)| (name, Pen::strong(colour)));
    let mut lines = pens.map(|(_, pen)| [(); 2].map(|()| Line { pen, points: Vec::new() }));
    for (control, bound, step) in fixed.chain(bounded) {
        let [steps, seconds, convolutions, wear, film] = history(cells, end, &step)?;
        let errors = [wear / exact[3] - 1.0, film / exact[4] - 1.0].map(f64::abs);
        let [wear, film] = errors;
        writeln!(table, "{control},{bound:e},{steps},{seconds:.3},{convolutions:.0},{wear:.3e},{film:.3e}")?;
        for (line, error) in lines[usize::from(control == "bounded")].iter_mut().zip(errors) {
            line.points.push((steps.log10(), error.log10()));
        }
    }
    std::fs::write(folder.join("time_steps.csv"), table)?;
    let [[fixed_wear, fixed_film], [bounded_wear, bounded_film]] = lines;
    let panels = [
        ("log10 error of wear", fixed_wear, bounded_wear),
        ("log10 error of film", fixed_film, bounded_film),
    ];
    let figure = Figure {
        title: "Errors of a history by its steps".to_owned(),
        x_label: "steps",
        x_scale: XScale::Decades,
        legend: vec![(pens[0].1, "equal steps".to_owned()), (pens[1].1, "changes bounded".to_owned())],
        panels: panels.map(|(y_label, fixed, bounded)| Panel { y_label, lines: vec![fixed, bounded] }).into(),
    };
    figure.write(&folder.join("time_steps.svg"))
}
