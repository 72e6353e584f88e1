//! Running-in: a speed sweep on new surfaces, wear under the load steps of a schedule (20, 40, 60 N), and the
//! same sweep on the surfaces that this leaves. Writes the Stribeck curves of new and worn surfaces into one
//! figure and one table, and the folder of the run, into `target/running_in`.
//!
//! ```text
//! cargo run --release --example running_in [-- SPEEDS [END]]   # 13 from 1 mm/s to 1 m/s, after 1800 s
//! ```
#![expect(clippy::print_stdout, reason = "a program that talks to its user")]

#[path = "../chart/mod.rs"]
mod chart;

use std::error::Error;
use std::fmt::Write as _;
use std::path::Path;

use chart::{BLUE, Figure, Line, Panel, Pen, VERMILION, XScale};
use stribeck::InputError;
use stribeck::metrics::height_statistics;
use stribeck::sim::{MixedLubricationSim, RunFolder, Scene, StepControl};

/// Load of both sweeps \[N\].
const SWEEP_LOAD: f64 = 20.0;
/// Longest step \[s\] and largest change of a node in it \[m\].
const CONTROL: StepControl = StepControl::new(20.0, 5e-9);

/// Decade of the speed, and friction coefficient, its boundary share, load ratio and lambda at it.
type Sweep = Vec<(f64, [f64; 4])>;

/// Root mean square roughness of `heights` on the track of `sim` \[m\].
fn track_rq(sim: &MixedLubricationSim, heights: &[f64]) -> Result<f64, InputError> {
    Ok(height_statistics(&sim.track_roughness(heights)?)?.sq)
}

/// Contacts of the bodies as they stand from 1 mm/s to 1 m/s.
fn sweep(sim: &mut MixedLubricationSim, count: u32) -> Result<Sweep, Box<dyn Error>> {
    let mut curve = Vec::new();
    for k in 0..count {
        let decade = 3.0 * f64::from(k) / f64::from(count - 1) - 3.0;
        let mut conditions = sim.conditions();
        conditions.load = SWEEP_LOAD;
        conditions.motion.entrainment_speed = 10_f64.powf(decade);
        let solution = sim.solve_under(&conditions)?;
        if let Err(error) = solution.report.require_converged() {
            println!("{:.4} m/s is left out: {error}", conditions.motion.entrainment_speed);
            continue;
        }
        let lambda = solution.film.lambda.ok_or("the surfaces are smooth")?;
        let (friction, solids) = (solution.friction.coefficient, solution.contact.load_ratio);
        curve.push((decade, [friction, solution.friction.boundary, solids, lambda]));
    }
    Ok(curve)
}

fn figure(new: &Sweep, worn: &Sweep, end: f64) -> Figure {
    let panel = |y_label, column: usize| {
        let line = |sweep: &Sweep, colour| Line {
            pen: Pen::strong(colour),
            points: sweep.iter().map(|(decade, numbers)| (*decade, numbers[column])).collect(),
        };
        Panel { y_label, lines: vec![line(new, BLUE), line(worn, VERMILION)] }
    };
    Figure {
        title: "Stribeck curves before and after running in".to_owned(),
        x_label: "entrainment speed, m/s",
        x_scale: XScale::Decades,
        legend: vec![
            (Pen::strong(BLUE), "new".to_owned()),
            (Pen::strong(VERMILION), format!("after {end} s of running in")),
        ],
        panels: vec![panel("friction", 0), panel("load ratio", 2), panel("\u{3bb} = h_avg / Rq", 3)],
    }
}

fn table(new: &Sweep, worn: &Sweep) -> Result<String, std::fmt::Error> {
    let mut text = String::from(
        "surfaces,entrainment_speed_m_per_s,friction_coefficient,friction_boundary,load_ratio,lambda\n",
    );
    for (name, sweep) in [("new", new), ("worn", worn)] {
        for (decade, [friction, boundary, solids, lambda]) in sweep {
            let speed = 10_f64.powf(*decade);
            writeln!(text, "{name},{speed:e},{friction:e},{boundary:e},{solids:e},{lambda:e}")?;
        }
    }
    Ok(text)
}

fn main() -> Result<(), Box<dyn Error>> {
    let count = std::env::args().nth(1).map_or(Ok(13), |count| count.parse::<u32>())?.max(2);
    let end = std::env::args().nth(2).map_or(Ok(1800.0), |end| end.parse::<f64>())?;
    let scene = Scene::from_toml(include_str!("../scenes/running_in.toml"))?;
    let mut sim = MixedLubricationSim::builder(scene).build()?;
    let new = sweep(&mut sim, count)?;
    let folder = Path::new("target/running_in");
    let mut files = RunFolder::create(folder, &sim, 0)?;
    sim.run_until(end, &CONTROL, &mut files)?;
    files.finish(&sim)?;
    let worn = sweep(&mut sim, count)?;
    let [_, disc] = sim.bodies();
    println!(
        "{} steps; Rq of the disc on its track {:.1} nm new, {:.1} nm worn",
        sim.steps(),
        1e9 * track_rq(&sim, disc.initial())?,
        1e9 * track_rq(&sim, disc.surface())?
    );
    println!("{:>10} {:>22} {:>22}", "", "friction", "load ratio");
    println!("{:>10} {:>11}{:>11} {:>11}{:>11}", "speed, m/s", "new", "worn", "new", "worn");
    for (decade, numbers) in &new {
        let other = worn.iter().find(|(other, _)| (other - decade).abs() < 1e-9);
        let [friction, solids] = [0, 2].map(|k| other.map_or(f64::NAN, |(_, numbers)| numbers[k]));
        let speed = 10_f64.powf(*decade);
        println!("{speed:10.4} {:11.4}{friction:11.4} {:11.4}{solids:11.4}", numbers[0], numbers[2]);
    }
    std::fs::write(folder.join("stribeck_curves.csv"), table(&new, &worn)?)?;
    figure(&new, &worn, end).write(&folder.join("stribeck_curves.svg"))?;
    println!("table, figure and run are in {}", folder.display());
    Ok(())
}
