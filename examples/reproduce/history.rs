//! One history: its run, its files, and reading them back.

use std::fmt::Write as _;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use stribeck::metrics::BearingCurve;
use stribeck::sim::{MixedLubricationSim, RunEnd, StepRecord};

use crate::options::Options;
use crate::plan::Run;

/// Points of a bearing area curve.
const BEARING_POINTS: u32 = 200;

/// Positions of the roughness that a history may pass over because they were not solved: each costs as much as tens of steps,
/// and what is left is a selection.
const MOST_PASSED_OVER: u32 = 20;

/// Columns of a history file besides the material ratio and height of its curves.
const COLUMNS: [&str; 17] = [
    "time_s",
    "rq_ball_m",
    "rq_disc_m",
    "rq_composite_m",
    "h_avg_m",
    "lambda",
    "lambda_old",
    "area_ratio",
    "load_ratio",
    "max_pressure_pa",
    "track_wear_ball_m",
    "track_wear_disc_m",
    "max_wear_disc_m",
    "track_film_disc_m",
    "friction_coefficient",
    "flash_rise_k",
    "attempts",
];

fn row(record: &StepRecord) -> [f64; COLUMNS.len()] {
    [
        record.time,
        record.rq[0],
        record.rq[1],
        record.composite_rq,
        record.average_film,
        record.lambda,
        record.lambda_old,
        record.area_ratio,
        record.load_ratio,
        record.max_pressure,
        record.track_wear[0],
        record.track_wear[1],
        record.max_wear[1],
        record.track_film[1],
        record.friction_coefficient,
        record.flash_rise.unwrap_or(0.0),
        f64::from(record.attempts),
    ]
}

/// A history as its files have it.
#[derive(Debug, Clone)]
pub(crate) struct History {
    rows: Vec<Vec<f64>>,
    /// Film over y at x = 0 after the last step.
    pub(crate) profile: Vec<(f64, f64)>,
    /// Height of the disc over material ratio, at the start and after the last step.
    pub(crate) bearing: [Vec<(f64, f64)>; 2],
    /// Why it ended early.
    pub(crate) failure: Option<String>,
}

impl History {
    /// Step by step the mean of `histories`, as long as the shortest; curves are those of the first.
    pub(crate) fn mean_of(histories: &[&Self]) -> Option<Self> {
        let mut mean = (*histories.first()?).clone();
        mean.rows.truncate(histories.iter().map(|history| history.rows.len()).min()?);
        for (step, row) in mean.rows.iter_mut().enumerate() {
            for (column, cell) in row.iter_mut().enumerate() {
                *cell = histories.iter().map(|h| h.rows[step][column]).sum::<f64>() / histories.len() as f64;
            }
        }
        Some(mean)
    }

    /// A column over the steps.
    pub(crate) fn column(&self, name: &str) -> Vec<f64> {
        let index = COLUMNS.iter().position(|column| *column == name);
        self.rows.iter().filter_map(|row| index.and_then(|k| row.get(k))).copied().collect()
    }

    pub(crate) fn steps(&self) -> usize {
        self.rows.len()
    }

    /// Steps over which scattered columns are averaged.
    pub(crate) fn window(&self) -> usize {
        (self.rows.len() / 8).clamp(1, 36)
    }

    /// Mean of a column over the first steps.
    pub(crate) fn start(&self, name: &str) -> f64 {
        mean(self.column(name).iter().take(self.window()))
    }

    /// Mean of a column over the last steps.
    pub(crate) fn end(&self, name: &str) -> f64 {
        mean(self.column(name).iter().rev().take(self.window()))
    }

    /// Mean of a column over as many steps, before the last quarter.
    pub(crate) fn before_last_quarter(&self, name: &str) -> f64 {
        let (column, window) = (self.column(name), self.window());
        let middle = 3 * column.len() / 4;
        mean(column[middle.saturating_sub(window)..middle].iter())
    }

    pub(crate) fn last(&self, name: &str) -> f64 {
        self.column(name).last().copied().unwrap_or(f64::NAN)
    }

    pub(crate) fn first(&self, name: &str) -> f64 {
        self.column(name).first().copied().unwrap_or(f64::NAN)
    }
}

fn mean<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for value in values {
        sum += value;
        count += 1.0;
    }
    sum / count
}

fn path(run: &Run, options: &Options, extension: &str) -> PathBuf {
    // Not `with_extension`: stems may hold a dot.
    let mut name = run.stem(options).into_os_string();
    name.push(extension);
    PathBuf::from(name)
}

/// Whether the history of `run` is there, complete or with the note why not, by the same steps.
pub(crate) fn is_there(run: &Run, options: &Options) -> bool {
    read(run, options).is_ok_and(|history| {
        let same_step = history
            .rows
            .first()
            .and_then(|row| row.first())
            .is_some_and(|time| (time - run.time_step(options)).abs() < 1e-9 * run.time_step(options));
        let complete = history.steps() as u64 == run.steps(options);
        same_step && (complete || history.failure.is_some() && (history.steps() as u64) < run.steps(options))
    })
}

/// Runs and writes one history; a line on how it went.
pub(crate) fn write(run: &Run, options: &Options) -> Result<String, String> {
    let start = Instant::now();
    let stem = run.stem(options);
    let mut sim = run.build().map_err(|error| format!("{}: {error}", stem.display()))?;
    let mut rows = String::from("# history\n");
    let (mut profile, mut passed_over) = (String::new(), 0);
    let outcome = sim.run(
        run.steps(options),
        run.time_step(options),
        &mut |sim: &MixedLubricationSim, record: &StepRecord| {
            push(&mut rows, &row(record));
            profile = film_profile(sim);
            passed_over += record.attempts - 1;
            if passed_over > MOST_PASSED_OVER { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        },
    );
    let mut text = rows;
    let _ = writeln!(text, "# profile\n{profile}# initial");
    let disc = &sim.bodies()[1];
    for (heights, next) in [(disc.initial(), "# final\n"), (disc.surface(), "")] {
        let on_track = sim.track_roughness(heights).map_err(|error| error.to_string())?;
        let curve = BearingCurve::new(&on_track).map_err(|error| error.to_string())?;
        for k in 0..=BEARING_POINTS {
            let share = f64::from(k) / f64::from(BEARING_POINTS);
            push(&mut text, &[share, curve.height_at(share)]);
        }
        text.push_str(next);
    }
    let failure = match outcome {
        Ok(RunEnd::Finished) => None,
        Ok(_) => Some(format!("{passed_over} positions of the roughness were passed over")),
        Err(error) => Some(error.to_string()),
    };
    let note = path(run, options, ".failed.txt");
    let saved = match &failure {
        Some(reason) => fs::write(&note, reason),
        // One from an earlier attempt is out of date.
        None if note.exists() => fs::remove_file(&note),
        None => Ok(()),
    };
    saved.map_err(|error| format!("{}: {error}", note.display()))?;
    // Whole or not at all, so that an interrupted run leaves nothing that looks complete.
    let (draft, file) = (path(run, options, ".part"), path(run, options, ".csv"));
    fs::write(&draft, text)
        .and_then(|()| fs::rename(&draft, &file))
        .map_err(|error| format!("{}: {error}", file.display()))?;
    let outcome = failure.map_or_else(String::new, |reason| format!(", ended early: {reason}"));
    Ok(format!(
        "{} in {:.0} s, {} steps{outcome}",
        stem.display(),
        start.elapsed().as_secs_f64(),
        sim.steps()
    ))
}

fn push(text: &mut String, numbers: &[f64]) {
    for (k, number) in numbers.iter().enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(text, "{}{number:e}", if k > 0 { "," } else { "" });
    }
    text.push('\n');
}

/// Film along y through x = 0, inside the Hertz contact.
fn film_profile(sim: &MixedLubricationSim) -> String {
    let (grid, radius, mut text) = (sim.grid(), sim.hertz().a_y, String::new());
    for y in (0..grid.ny()).map(|j| grid.y(j)).filter(|y| y.abs() <= radius) {
        push(&mut text, &[y, grid.interpolate(&sim.state().film, 0.0, y).unwrap_or(f64::NAN)]);
    }
    text
}

/// Reads the history of `run`.
pub(crate) fn read(run: &Run, options: &Options) -> Result<History, String> {
    let file = path(run, options, ".csv");
    let text = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
    let mut history = History {
        rows: Vec::new(),
        profile: Vec::new(),
        bearing: [Vec::new(), Vec::new()],
        failure: fs::read_to_string(path(run, options, ".failed.txt")).ok(),
    };
    let mut section = "";
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("# ") {
            section = name;
            continue;
        }
        let numbers = parse(line, &file)?;
        match (section, numbers.as_slice()) {
            ("history", row) if row.len() == COLUMNS.len() => history.rows.push(numbers),
            ("profile", &[y, film]) => history.profile.push((y, film)),
            ("initial", &[ratio, height]) => history.bearing[0].push((ratio, height)),
            ("final", &[ratio, height]) => history.bearing[1].push((ratio, height)),
            _ => return Err(format!("{}: `{line}` does not fit", file.display())),
        }
    }
    Ok(history)
}

fn parse(line: &str, file: &Path) -> Result<Vec<f64>, String> {
    let numbers = line.split(',').map(|cell| cell.parse::<f64>().map_err(|_| cell.to_owned()));
    numbers.collect::<Result<_, _>>().map_err(|cell| format!("{}: `{cell}` is no number", file.display()))
}
