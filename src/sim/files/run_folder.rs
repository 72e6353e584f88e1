//! The folder of a run: the files needed to repeat it, to continue it and to read its results.

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::InputError;
use crate::regular_file;
use crate::reynolds::ContactState;
use crate::sim::error::{CheckpointError, SimError};
use crate::sim::files::atomic_file;
use crate::sim::files::npz::write_npz;
use crate::sim::history::observer::Observer;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::BODIES;

/// Writes a run into a folder, as an [`Observer`] or called from one.
///
/// | file | content |
/// |---|---|
/// | `scene.toml` | the scene |
/// | `run.toml` | version of the crate, motion of the roughness and its seed |
/// | `history.csv` | a line per step ([`StepRecord::csv_header()`]) |
/// | `checkpoint` | the simulation after the last multiple of `every` steps and at the end |
/// | `fields.npz` | heights, wear, plastic depth and tribofilm of both bodies, pressures and film; at the end |
/// | `lock` | empty; locked while a run writes into the folder |
///
/// The bodies in `fields.npz` are starts of other runs ([`BodyStart`](crate::sim::BodyStart)).
/// A run that was killed continues from its checkpoint and leaves the same files as an uninterrupted run.
///
/// ```
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run");
/// use stribeck::sim::{MixedLubricationSim, RunFolder, Scene};
/// let build = || MixedLubricationSim::builder(Scene::azam_2019(32)).build();
/// let mut sim = build()?;
/// let mut folder = RunFolder::create(&path, &sim, 2)?;
/// sim.run(3, 10.0, &mut folder)?;
/// drop(folder); // The run is killed. Its checkpoint holds two steps.
/// let mut sim = build()?;
/// let (mut folder, records) = RunFolder::resume(&path, &mut sim, 2)?;
/// assert_eq!((sim.steps(), records.len()), (2, 2));
/// sim.run(4 - sim.steps(), 10.0, &mut folder)?;
/// folder.finish(&sim)?;
/// assert!(path.join("fields.npz").exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct RunFolder {
    /// The folder.
    path: PathBuf,
    /// `history.csv`, opened at its end.
    history: BufWriter<File>,
    /// Keeps other runs out of the folder while it is open.
    _lock: File,
    /// Steps from one checkpoint to the next; 0 for one at the end only.
    every: u64,
    /// The contact of the last committed step.
    last_contact: Option<ContactState>,
    /// Number of steps at the last checkpoint.
    saved_steps: Option<u64>,
    /// Error that stopped the run.
    failure: Option<SimError>,
}

/// Data of a run that the scene does not hold.
#[derive(Serialize)]
struct RunTable {
    /// Version of the crate.
    stribeck: &'static str,
    /// Output of `Debug` of the motion.
    motion: String,
    /// Whether the film has a squeeze term.
    squeeze: bool,
}

impl RunFolder {
    /// Names of the files of a run, without the empty lock file.
    pub const FILES: [&str; 5] = ["scene.toml", "run.toml", "history.csv", "checkpoint", "fields.npz"];

    /// Creates the folder for a run from its start, with a checkpoint after each `every` steps (0: at the end
    /// only). Files of an earlier run are replaced.
    ///
    /// # Errors
    /// [`SimError::Io`] for a file that cannot be written, [`InputError::Conflict`] for a folder into which
    /// another run writes.
    pub fn create(path: impl Into<PathBuf>, sim: &MixedLubricationSim, every: u64) -> Result<Self, SimError> {
        let path = path.into();
        let lock = Self::lock(&path)?;
        Self::create_locked(path, lock, sim, every)
    }

    /// Creates the folder if needed and locks it for one run. The lock lasts while the returned file is open.
    fn lock(path: &Path) -> Result<File, SimError> {
        let file = path.join("lock");
        // Opening a pipe would block forever.
        let opened = fs::create_dir_all(path).and_then(|()| match regular_file::size(&file) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            // An existing file of this name keeps its content.
            _ => File::options().write(true).create(true).truncate(false).open(&file),
        });
        let lock = opened.map_err(|source| SimError::Io { path: file.clone(), source })?;
        match lock.try_lock() {
            Err(TryLockError::WouldBlock) => Err(SimError::Input(InputError::Conflict {
                field: path.display().to_string(),
                reason: "another run writes into this folder; end it, or give another folder".to_owned(),
            })),
            // Some file systems have no locks.
            Err(TryLockError::Error(source)) if source.kind() != io::ErrorKind::Unsupported => {
                Err(SimError::Io { path: file, source })
            }
            _ => Ok(lock),
        }
    }

    /// Creates the files of a run from its start.
    fn create_locked(
        path: PathBuf,
        lock: File,
        sim: &MixedLubricationSim,
        every: u64,
    ) -> Result<Self, SimError> {
        // First, so that the history never stands beside a checkpoint of another run.
        for name in ["checkpoint", "fields.npz"] {
            match fs::remove_file(path.join(name)) {
                Err(source) if source.kind() != io::ErrorKind::NotFound => {
                    return Err(SimError::Io { path: path.join(name), source });
                }
                _ => {}
            }
        }
        let motion = format!("{:?}", sim.motion());
        let run = RunTable { stribeck: env!("CARGO_PKG_VERSION"), motion, squeeze: sim.has_squeeze() };
        let run = toml::to_string(&run).map_err(|error| SimError::Scene { reason: error.to_string() })?;
        let header = format!("{}\n", StepRecord::csv_header());
        for (name, text) in
            [("scene.toml", &sim.scene().to_toml()?), ("run.toml", &run), ("history.csv", &header)]
        {
            let file = path.join(name);
            atomic_file::replace(&file, text.as_bytes())
                .map_err(|source| SimError::Io { path: file, source })?;
        }
        let mut history = Self::open_history(&path)?;
        let end = history.get_mut().seek(SeekFrom::End(0));
        end.map_err(|source| SimError::Io { path: path.join("history.csv"), source })?;
        Ok(Self { path, history, _lock: lock, every, last_contact: None, saved_steps: None, failure: None })
    }

    /// Continues the run in the folder. `sim`, built as for its start, is restored from the checkpoint; the
    /// history is cut to the steps of the checkpoint, which are returned. Without a checkpoint this is
    /// [`create`](Self::create).
    ///
    /// # Errors
    /// A checkpoint that cannot be used (see [`CheckpointError`]), a history that does not reach it,
    /// [`InputError::Conflict`] for a folder into which another run writes.
    pub fn resume(
        path: impl Into<PathBuf>,
        sim: &mut MixedLubricationSim,
        every: u64,
    ) -> Result<(Self, Vec<StepRecord>), SimError> {
        Self::resume_accepting(path, sim, every, &[])
    }

    /// [`resume`](Self::resume) of a run of which the named `parts` may differ, as in
    /// [`restore_accepting`](MixedLubricationSim::restore_accepting).
    ///
    /// # Errors
    /// As of [`resume`](Self::resume).
    pub fn resume_accepting(
        path: impl Into<PathBuf>,
        sim: &mut MixedLubricationSim,
        every: u64,
        parts: &[&str],
    ) -> Result<(Self, Vec<StepRecord>), SimError> {
        let path = path.into();
        let lock = Self::lock(&path)?;
        let checkpoint = path.join("checkpoint");
        match sim.restore_accepting(&checkpoint, parts) {
            Ok(_) => {}
            Err(CheckpointError::Io { source, .. }) if source.kind() == io::ErrorKind::NotFound => {
                return Ok((Self::create_locked(path, lock, sim, every)?, Vec::new()));
            }
            Err(error) => return Err(error.into()),
        }
        let mut history = Self::open_history(&path)?;
        let file = path.join("history.csv");
        let io = |source| SimError::Io { path: file.clone(), source };
        let mut text = String::new();
        history.get_mut().read_to_string(&mut text).map_err(io)?;
        let (records, length) = Self::rows(&text, sim.steps(), &file)?;
        history.get_mut().set_len(length).map_err(io)?;
        history.get_mut().seek(SeekFrom::End(0)).map_err(io)?;
        let (last_contact, saved_steps) = (Some(sim.state().clone()), Some(sim.steps()));
        let folder = Self { path, history, _lock: lock, every, last_contact, saved_steps, failure: None };
        Ok((folder, records))
    }

    /// The history of the folder at `path`, to read and write.
    fn open_history(path: &Path) -> Result<BufWriter<File>, SimError> {
        let file = path.join("history.csv");
        let opened = regular_file::size(&file);
        let opened = opened.and_then(|_| File::options().read(true).write(true).open(&file));
        opened.map(BufWriter::new).map_err(|source| SimError::Io { path: file, source })
    }

    /// The first `steps` records in `text`, and their length in bytes with the header.
    fn rows(text: &str, steps: u64, file: &Path) -> Result<(Vec<StepRecord>, u64), SimError> {
        let short = |records: &[StepRecord]| {
            SimError::Input(InputError::Conflict {
                field: file.display().to_string(),
                reason: format!("{} whole steps, the checkpoint is that of {steps}", records.len()),
            })
        };
        let mut lines = text.split_inclusive('\n');
        let mut records = Vec::new();
        let header = lines.next().unwrap_or_default();
        if header.trim_end() != StepRecord::csv_header() {
            return Err(SimError::Input(InputError::Conflict {
                field: file.display().to_string(),
                reason: "its columns are those of another version, which can continue the run".to_owned(),
            }));
        }
        let mut length = header.len();
        while (records.len() as u64) < steps {
            let Some(line) = lines.next().and_then(|line| line.strip_suffix('\n')) else {
                return Err(short(&records));
            };
            records.push(StepRecord::from_csv(line)?);
            length += line.len() + 1;
        }
        Ok((records, length as u64))
    }

    /// Writes a line of the history and, if one is due, a checkpoint.
    fn write_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> Result<(), SimError> {
        let file = self.path.join("history.csv");
        let written = record.write_csv(&mut self.history).and_then(|()| self.history.flush());
        written.map_err(|source| SimError::Io { path: file, source })?;
        self.last_contact.get_or_insert_with(|| sim.state().clone()).clone_from(sim.state());
        if self.every > 0 && sim.steps().is_multiple_of(self.every) { self.save(sim) } else { Ok(()) }
    }

    /// Flushes the history to disk before the checkpoint that counts its lines.
    fn save(&mut self, sim: &MixedLubricationSim) -> Result<(), SimError> {
        let synced = self.history.get_ref().sync_data();
        synced.map_err(|source| SimError::Io { path: self.path.join("history.csv"), source })?;
        sim.save(self.path.join("checkpoint"))?;
        self.saved_steps = Some(sim.steps());
        Ok(())
    }

    /// Writes the last checkpoint and the fields.
    ///
    /// # Errors
    /// The error that stopped the run, or one of writing.
    pub fn finish(mut self, sim: &MixedLubricationSim) -> Result<(), SimError> {
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        if self.saved_steps != Some(sim.steps()) {
            self.save(sim)?;
        }
        let [ball, disc] = sim.bodies();
        let mut fields = vec![
            ("ball_initial", ball.initial()),
            ("ball_surface", ball.surface()),
            ("ball_wear", ball.wear()),
            ("ball_plastic_depth", ball.plastic_depth()),
            ("ball_tribofilm", ball.tribofilm()),
            ("disc_initial", disc.initial()),
            ("disc_surface", disc.surface()),
            ("disc_wear", disc.wear()),
            ("disc_plastic_depth", disc.plastic_depth()),
            ("disc_tribofilm", disc.tribofilm()),
        ];
        if let Some(contact) = &self.last_contact {
            fields.extend([
                ("pressure", contact.pressure.as_slice()),
                ("fluid_pressure", &contact.fluid_pressure),
                ("film", &contact.film),
                ("theta", &contact.theta),
            ]);
        }
        let states = film_states(sim);
        fields.extend(states.iter().map(|(name, state)| (name.as_str(), state.as_slice())));
        let (file, grid) = (self.path.join("fields.npz"), sim.grid());
        let temporary = atomic_file::temporary_path(&file);
        let put =
            || atomic_file::put_in_place(&file).map_err(|source| SimError::Io { path: file.clone(), source });
        write_npz(&temporary, &grid, &fields)
            .and_then(|()| put())
            .inspect_err(|_| drop(fs::remove_file(&temporary)))
    }

    /// The contact of the last committed step; `None` before the first.
    pub fn last_contact(&self) -> Option<&ContactState> {
        self.last_contact.as_ref()
    }
}

/// State variables of the tribofilms whose law has more than the thickness. A start of another run needs
/// them.
fn film_states(sim: &MixedLubricationSim) -> Vec<(String, Vec<f64>)> {
    let mut fields = Vec::new();
    for (name, body) in BODIES.into_iter().zip(sim.bodies()) {
        let Some(film) = body.film.as_ref().filter(|film| film.n_states() > 1) else { continue };
        for state in 0..film.n_states() {
            let values = film.states().iter().skip(state).step_by(film.n_states());
            fields.push((format!("{name}_tribofilm_state_{state}"), values.copied().collect()));
        }
    }
    fields
}

impl Observer for RunFolder {
    /// Writes the step. An error stops the run; [`finish`](RunFolder::finish) returns it.
    fn after_step(&mut self, sim: &MixedLubricationSim, record: &StepRecord) -> ControlFlow<()> {
        match self.write_step(sim, record) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.failure = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}
