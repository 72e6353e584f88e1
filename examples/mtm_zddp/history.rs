//! One history: the run and its results.

use indicatif::ProgressBar;
use stribeck::InputError;
use stribeck::reynolds::ContactState;
use stribeck::sim::{MixedLubricationSim, Observer, RunFolder, SimError, StepControl, StepRecord, write_vtk};

use crate::options::Options;
use crate::statements::{self, PARTS, bearing_heights, film_profile};

/// Results of a run.
pub(crate) struct History {
    /// `with tribofilm` or `without tribofilm`.
    pub(crate) title: String,
    /// The committed steps.
    pub(crate) records: Vec<StepRecord>,
    /// The contact of the last committed step; none before the first.
    pub(crate) last_contact: Option<ContactState>,
    /// The bodies as they are in the end.
    pub(crate) sim: MixedLubricationSim,
    /// Why the run ended before its last step.
    pub(crate) failure: Option<SimError>,
}

/// Runs to the end time of `options`, from the start or from where a stopped run was, and writes them into the folder
/// `name` of the output.
///
/// # Errors
/// A file that cannot be written or resumed from. A contact that was not solved ends the run and is noted in
/// the history.
pub(crate) fn run(
    mut sim: MixedLubricationSim,
    name: &'static str,
    options: &Options,
    bar: &ProgressBar,
) -> Result<History, SimError> {
    let title = format!("{name} tribofilm");
    bar.set_prefix(title.clone());
    let path = options.out.join(name);
    let (mut folder, mut records) = if options.resume {
        RunFolder::resume(&path, &mut sim, options.every)?
    } else {
        (RunFolder::create(&path, &sim, options.every)?, Vec::new())
    };
    let (end, control) = (options.end(), StepControl::fixed(options.time_step));
    bar.set_length(sim.steps() + sim.steps_until(end, options.time_step));
    bar.set_position(sim.steps());
    let outcome = sim.run_until(end, &control, &mut |sim: &MixedLubricationSim, record: &StepRecord| {
        records.push(record.clone());
        tick(bar, &title, record);
        folder.after_step(sim, record)
    });
    let last_contact = folder.last_contact().cloned();
    folder.finish(&sim)?;
    if let Some(contact) = &last_contact {
        let fields: [(&str, &[f64]); 2] = [("pressure", &contact.pressure), ("film", &contact.film)];
        write_vtk(path.join("contact.vtk"), &sim.grid(), &fields)?;
    }
    for (file, extension) in [("history.csv", "csv"), ("fields.npz", "npz")] {
        let copy = path.with_extension(extension);
        let copied = std::fs::copy(path.join(file), &copy);
        let _bytes = copied.map_err(|source| SimError::Io { path: copy, source })?;
    }
    if outcome.is_ok() {
        bar.finish();
    } else {
        bar.abandon();
    }
    Ok(History { title, records, last_contact, sim, failure: outcome.err() })
}

/// Moves the bar; without a terminal every tenth of the way is a line.
fn tick(bar: &ProgressBar, title: &str, record: &StepRecord) {
    bar.inc(1);
    let steps = bar.length().unwrap_or(0);
    let done = record.step + 1;
    if bar.is_hidden() && done.is_multiple_of(steps.div_ceil(10).max(1)) {
        eprintln!("{title}: {done} of {steps} steps");
    }
}

impl History {
    /// Steps over which scattered columns are averaged: 21, fewer in a short history.
    pub(crate) fn window(&self) -> usize {
        (self.records.len() / 8).clamp(1, 21) | 1
    }

    /// Input of the paper's statements: bearing curves at the start and the end alone.
    ///
    /// # Errors
    /// Heights that are not finite.
    pub(crate) fn for_statements(&self) -> Result<statements::History, InputError> {
        let (sim, disc) = (&self.sim, &self.sim.bodies()[1]);
        let curves =
            [(0, bearing_heights(sim, disc.initial())?), (PARTS, bearing_heights(sim, disc.surface())?)];
        let film = self.last_contact.as_ref().map(|contact| contact.film.as_slice());
        Ok(statements::History {
            records: self.records.clone(),
            profile: film.map(|film| film_profile(sim, film)).unwrap_or_default(),
            bearing: curves.into(),
        })
    }
}
