//! One history: the run, its table and its final fields.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::ops::ControlFlow;
use std::path::Path;

use indicatif::ProgressBar;
use stribeck::reynolds::ContactState;
use stribeck::sim::{MixedLubricationSim, SimError, StepRecord, write_npz};

use crate::options::Options;

/// What a run leaves behind.
pub(crate) struct History {
    /// Stem of the file names, `with` or `without`.
    name: &'static str,
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

/// Takes the steps that `options` asks for and writes `name.csv` on the way, so that an interrupted run leaves its rows.
///
/// # Errors
/// A file that cannot be written. A contact that was not solved ends the run and is noted in the history.
pub(crate) fn run(
    mut sim: MixedLubricationSim,
    name: &'static str,
    options: &Options,
    bar: &ProgressBar,
) -> Result<History, SimError> {
    let title = format!("{name} tribofilm");
    bar.set_prefix(title.clone());
    let path = options.out.join(format!("{name}.csv"));
    let mut csv = Csv::create(&path).map_err(|source| SimError::Io { path: path.clone(), source })?;
    let (mut records, mut last_contact) = (Vec::new(), None);
    let mut written = Ok(());
    let outcome =
        sim.run(options.steps, options.time_step, &mut |sim: &MixedLubricationSim, record: &StepRecord| {
            records.push(*record);
            // A failed solve would leave its half-way state in the simulation.
            last_contact.get_or_insert_with(|| sim.state().clone()).clone_from(sim.state());
            tick(bar, &title, record);
            written = csv.row(record);
            if written.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
    written.map_err(|source| SimError::Io { path, source })?;
    if outcome.is_ok() {
        bar.finish();
    } else {
        bar.abandon();
    }
    Ok(History { name, title, records, last_contact, sim, failure: outcome.err() })
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

/// The table of the steps; every row reaches the file at once.
struct Csv(BufWriter<File>);

impl Csv {
    fn create(path: &Path) -> io::Result<Self> {
        let mut out = BufWriter::new(File::create(path)?);
        writeln!(out, "{}", StepRecord::CSV_HEADER)?;
        out.flush()?;
        Ok(Self(out))
    }

    fn row(&mut self, record: &StepRecord) -> io::Result<()> {
        record.write_csv(&mut self.0)?;
        self.0.flush()
    }
}

impl History {
    /// Writes the fields of the last contact and of both bodies as they are in the end, `name.npz` in `folder`.
    pub(crate) fn write_fields(&self, folder: &Path) -> Result<(), SimError> {
        let [ball, disc] = self.sim.bodies();
        let mut fields = vec![
            ("ball_initial_m", ball.initial()),
            ("ball_surface_m", ball.surface()),
            ("ball_wear_m", ball.wear_depth()),
            ("ball_plastic_m", ball.plastic_depth()),
            ("ball_tribofilm_m", ball.film_thickness()),
            ("disc_initial_m", disc.initial()),
            ("disc_surface_m", disc.surface()),
            ("disc_wear_m", disc.wear_depth()),
            ("disc_plastic_m", disc.plastic_depth()),
            ("disc_tribofilm_m", disc.film_thickness()),
        ];
        if let Some(contact) = &self.last_contact {
            fields.extend([
                ("pressure_pa", contact.pressure.as_slice()),
                ("fluid_pressure_pa", &contact.fluid_pressure),
                ("film_m", &contact.film),
            ]);
        }
        let grid = self.sim.grid();
        write_npz(folder.join(format!("{}.npz", self.name)), grid.nx(), grid.ny(), &fields)
    }

    /// Steps over which scattered columns are averaged: 21, fewer in a short history.
    pub(crate) fn window(&self) -> usize {
        (self.records.len() / 8).clamp(1, 21) | 1
    }
}
