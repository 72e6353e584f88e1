//! The benchmark: all combinations of cases, contestants, tolerances and meshes.

use std::collections::HashSet;
use std::fmt;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use super::budget::Budget;
use super::case::Case;
use super::cases::Cases;
use super::contestant::Contestant;
use super::job::Job;
use super::results::Results;
use super::row::Row;
use super::{run, scoring, table};
use crate::error::InputError;
use crate::reynolds::StoppingRule;
use crate::sim::SimError;

/// Time between two calls of the interrupt.
const PERIOD: Duration = Duration::from_millis(50);

/// Observer of new rows: the row, rows so far, rows in all.
type Observer<'a> = Box<dyn FnMut(&Row, usize, usize) + Send + 'a>;

/// All combinations of cases, contestants, tolerances and meshes; see [the module](super).
pub struct Benchmark<'a> {
    cases: Vec<Arc<Case>>,
    contestants: Vec<Contestant>,
    tolerances: Vec<f64>,
    meshes: Vec<usize>,
    budget: Budget,
    threads: usize,
    repeats: u32,
    file: Option<PathBuf>,
    observer: Option<Observer<'a>>,
    interrupt: Option<Box<dyn Fn() -> bool + Send + 'a>>,
}

impl fmt::Debug for Benchmark<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cases = self.cases.len();
        f.debug_struct("Benchmark").field("cases", &cases).field("contestants", &self.contestants).finish()
    }
}

impl<'a> Benchmark<'a> {
    /// A benchmark of `cases` at a tolerance of 1e-6, each on its own mesh, on all processors.
    pub fn new(cases: impl Into<Cases>) -> Self {
        Self {
            cases: cases.into().cases.into_iter().map(Arc::new).collect(),
            contestants: Vec::new(),
            tolerances: vec![1e-6],
            meshes: Vec::new(),
            budget: Budget::default(),
            threads: thread::available_parallelism().map_or(1, usize::from),
            repeats: 1,
            file: None,
            observer: None,
            interrupt: None,
        }
    }

    /// Adds a contestant.
    #[must_use]
    pub fn contestant(mut self, contestant: Contestant) -> Self {
        self.contestants.push(contestant);
        self
    }

    /// Adds contestants.
    #[must_use]
    pub fn contestants(mut self, contestants: impl IntoIterator<Item = Contestant>) -> Self {
        self.contestants.extend(contestants);
        self
    }

    /// Replaces the tolerances.
    #[must_use]
    pub fn tolerances(mut self, tolerances: impl IntoIterator<Item = f64>) -> Self {
        self.tolerances = tolerances.into_iter().collect();
        self
    }

    /// Solves each case on these meshes, cells along x, in place of its own; cells along y in proportion.
    #[must_use]
    pub fn meshes(mut self, cells: impl IntoIterator<Item = usize>) -> Self {
        self.meshes = cells.into_iter().collect();
        self
    }

    /// Replaces the limits of one case.
    #[must_use]
    pub fn budget(mut self, budget: Budget) -> Self {
        self.budget = budget;
        self
    }

    /// Solves on this number of threads, at least one. Seconds are those of the solving thread; a machine with
    /// other work on it still lengthens them.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = threads.max(1);
        self
    }

    /// Solves the first contact of each case so often; its seconds are the mean.
    #[must_use]
    pub fn repeats(mut self, repeats: u32) -> Self {
        self.repeats = repeats.max(1);
        self
    }

    /// Appends each row to the CSV file at `path`. Rows that the file has are not solved again: those of the same
    /// scene, contestant by name, tolerance and mesh. At the end the file has the rows of the benchmark in its
    /// order, followed by others that were there.
    #[must_use]
    pub fn file(mut self, path: impl Into<PathBuf>) -> Self {
        self.file = Some(path.into());
        self
    }

    /// Calls `observer` with each new row, the number of rows so far and their number in all.
    #[must_use]
    pub fn observe(mut self, observer: impl FnMut(&Row, usize, usize) + Send + 'a) -> Self {
        self.observer = Some(Box::new(observer));
        self
    }

    /// Ends with [`SimError::Interrupted`] once `asked` returns true; it is called on the calling thread. Rows so
    /// far are in the [file](Self::file).
    #[must_use]
    pub fn interrupt(mut self, asked: impl Fn() -> bool + Send + 'a) -> Self {
        self.interrupt = Some(Box::new(asked));
        self
    }

    /// Solves all combinations.
    ///
    /// # Errors
    /// No case or no contestant, two of one name, a tolerance, mesh or budget out of range; a file that cannot be
    /// written or holds another table; an interruption. Scenes and contestants that fail are rows, not errors.
    pub fn run(mut self) -> Result<Results, SimError> {
        self.validate()?;
        let jobs = self.jobs();
        let known = match &self.file {
            Some(path) if path.exists() => table::read(path)?,
            _ => Vec::new(),
        };
        let mut rows: Vec<Option<Row>> = jobs
            .iter()
            .map(|job| {
                let blank = scoring::blank(job);
                known.iter().find(|row| row.is_same_run(&blank)).cloned()
            })
            .collect();
        let mut file = match self.file.as_deref() {
            Some(path) => Some((open(path, &known)?, path.to_owned())),
            None => None,
        };
        self.solve(&jobs, &mut rows, &mut file)?;
        let rows: Vec<Row> = rows.into_iter().flatten().collect();
        if let Some(path) = &self.file {
            let others = known.into_iter().filter(|row| !rows.iter().any(|other| other.is_same_run(row)));
            table::write(path, &rows.iter().cloned().chain(others).collect::<Vec<_>>())?;
        }
        Ok(Results::new(rows))
    }

    /// Solves the jobs without a row on threads.
    fn solve(
        &mut self,
        jobs: &[Job],
        rows: &mut [Option<Row>],
        file: &mut Option<(File, PathBuf)>,
    ) -> Result<(), SimError> {
        let todo: Vec<usize> = (0..jobs.len()).filter(|k| rows[*k].is_none()).collect();
        let (next, stop) = (AtomicUsize::new(0), Arc::new(AtomicBool::new(false)));
        let (sender, receiver) = mpsc::channel();
        let (budget, repeats, mut done) = (self.budget, self.repeats, jobs.len() - todo.len());
        thread::scope(|scope| {
            for _ in 0..self.threads.min(todo.len()) {
                let (sender, next, stop, todo) = (sender.clone(), &next, &stop, &todo);
                scope.spawn(move || {
                    while let Some(&k) = todo.get(next.fetch_add(1, Ordering::Relaxed)) {
                        let Some(row) = run::run(&jobs[k], budget, repeats, stop) else { break };
                        if sender.send((k, row)).is_err() {
                            break;
                        }
                    }
                });
            }
            drop(sender);
            loop {
                let (k, row) = match receiver.recv_timeout(PERIOD) {
                    Ok(found) => found,
                    Err(RecvTimeoutError::Disconnected) => return Ok(()),
                    Err(RecvTimeoutError::Timeout) => {
                        if self.interrupt.as_ref().is_some_and(|asked| asked()) {
                            stop.store(true, Ordering::Relaxed);
                            return Err(SimError::Interrupted);
                        }
                        continue;
                    }
                };
                done += 1;
                let kept = file.as_mut().map_or(Ok(()), |(file, path)| append(file, path, &row));
                if let Err(error) = kept {
                    stop.store(true, Ordering::Relaxed);
                    return Err(error);
                }
                if let Some(observer) = &mut self.observer {
                    observer(&row, done, jobs.len());
                }
                rows[k] = Some(row);
            }
        })
    }

    /// All combinations, contestant by contestant.
    fn jobs(&self) -> Vec<Job> {
        let meshes: Vec<Option<usize>> = match self.meshes.as_slice() {
            [] => vec![None],
            meshes => meshes.iter().copied().map(Some).collect(),
        };
        let mut jobs = Vec::new();
        for contestant in &self.contestants {
            for case in &self.cases {
                for &mesh in &meshes {
                    for &tolerance in &self.tolerances {
                        let (case, contestant) = (Arc::clone(case), contestant.clone());
                        jobs.push(Job { case, contestant, tolerance, mesh });
                    }
                }
            }
        }
        jobs
    }

    fn validate(&self) -> Result<(), InputError> {
        let conflict = |field: &str, reason: String| InputError::Conflict { field: field.to_owned(), reason };
        if self.cases.is_empty() || self.contestants.is_empty() || self.tolerances.is_empty() {
            let reason = "there is no case, no contestant or no tolerance".to_owned();
            return Err(conflict("benchmark", reason));
        }
        let mut seen = HashSet::new();
        if let Some(case) = self.cases.iter().find(|case| !seen.insert(case.name.as_str())) {
            return Err(conflict("case.name", format!("two cases are called `{}`", case.name)));
        }
        seen.clear();
        if let Some(twin) = self.contestants.iter().find(|other| !seen.insert(other.name())) {
            let reason = format!("two contestants are called `{}`; give one with_name", twin.name());
            return Err(conflict("contestant", reason));
        }
        for case in &self.cases {
            case.validate()?;
        }
        for &tolerance in &self.tolerances {
            StoppingRule::default().with_tolerance(tolerance).validate()?;
        }
        for &cells in &self.meshes {
            InputError::require(cells >= 5, "meshes", cells as f64, "at least 5")?;
        }
        self.budget.validate()
    }
}

/// The file with the `known` rows, for appending.
fn open(path: &Path, known: &[Row]) -> Result<File, SimError> {
    table::write(path, known)?;
    let opened = OpenOptions::new().append(true).open(path);
    opened.map_err(|source| SimError::Io { path: path.to_owned(), source })
}

fn append(file: &mut File, path: &Path, row: &Row) -> Result<(), SimError> {
    let written = file.write_all(table::of_row(row).as_bytes()).and_then(|()| file.flush());
    written.map_err(|source| SimError::Io { path: path.to_owned(), source })
}
