//! One job on a thread of its own.

use std::any::Any;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use super::budget::Budget;
use super::case::History;
use super::contestant::Maker;
use super::entrant::Entrant;
use super::job::Job;
use super::metered::Meter;
use super::row::Row;
use super::scoring::{self, Outcome, Solved};
use crate::report::SolveReport;
use crate::sim::{
    ContactNumbers, ContactSolution, FilmNumbers, FrictionNumbers, SimBuilder, SimError, StepRecord,
};

/// Time between two looks whether the benchmark was stopped.
const PERIOD: Duration = Duration::from_millis(50);

/// Solves a job within its budget. A thread that does not return in time is left alone. `None` if the benchmark
/// was stopped meanwhile.
pub(super) fn run(job: &Job, budget: Budget, repeats: u32, stop: &Arc<AtomicBool>) -> Option<Row> {
    let meter = Arc::new(Meter::new(budget, Arc::clone(stop)));
    let (sender, receiver) = mpsc::channel();
    let (theirs, copy) = (Arc::clone(&meter), job.clone());
    let spawned = thread::Builder::new()
        .name("benchmark".to_owned())
        .spawn(move || drop(sender.send(solve(&copy, &theirs, repeats))));
    let Ok(thread) = spawned else {
        let message = "no thread could be started".to_owned();
        return Some(scoring::row(job, Outcome::Panicked(message), &meter));
    };
    let (started, patience) = (Instant::now(), 2.0 * budget.seconds + 1.0);
    let outcome = loop {
        match receiver.recv_timeout(PERIOD) {
            Ok(solved) => break Outcome::Returned(solved),
            Err(RecvTimeoutError::Disconnected) => {
                let message = thread.join().err().map_or_else(String::new, |panic| message(&*panic));
                break Outcome::Panicked(message);
            }
            Err(RecvTimeoutError::Timeout) if stop.load(Ordering::Relaxed) => return None,
            Err(RecvTimeoutError::Timeout) => {
                if started.elapsed().as_secs_f64() > patience {
                    break Outcome::GivenUp;
                }
            }
        }
    };
    (!stop.load(Ordering::Relaxed)).then(|| scoring::row(job, outcome, &meter))
}

/// The message of a panic.
fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "it panicked".to_owned())
}

/// Solves the contact or the history of a job.
fn solve(job: &Job, meter: &Arc<Meter>, repeats: u32) -> Result<Solved, SimError> {
    let scene = job.scene();
    let maker = job.contestant.maker();
    let entrant = Entrant::new(maker.clone(), Arc::new(scene.clone()), Arc::clone(meter), repeats);
    let builder = job.case.builder(scene)?;
    let builder = match maker {
        // States of custom solvers are completed by the simulation.
        Maker::Custom(_) => builder.solver(entrant),
        _ => builder.checked_solver(entrant),
    };
    match job.case.history {
        None => single(builder),
        Some(history) => in_time(builder, history),
    }
}

fn single(builder: SimBuilder) -> Result<Solved, SimError> {
    let ContactSolution { report, film, contact, friction, .. } = builder.solve()?;
    let convolutions = report.work.convolutions;
    Ok(solved((report, convolutions), &film, &contact, &friction))
}

/// All contacts of a history, up to the first that fails.
fn in_time(builder: SimBuilder, history: History) -> Result<Solved, SimError> {
    let mut sim = builder.build()?;
    let mut convolutions = 0.0;
    let mut last = None;
    for _ in 0..history.contacts {
        match sim.step(history.time_step) {
            Ok(record) => {
                convolutions += record.report.work.convolutions;
                last = Some(record);
            }
            Err(SimError::NotConverged { source, .. }) => {
                let report = *source.report;
                convolutions += report.work.convolutions;
                let (minimum_gap, values) = (f64::NAN, [f64::NAN; 6]);
                return Ok(Solved { report, convolutions, minimum_gap, values });
            }
            Err(error) => return Err(error),
        }
    }
    let Some(record) = last else { return Err(SimError::Interrupted) };
    let StepRecord { report, film, contact, friction, .. } = record;
    Ok(solved((report, convolutions), &film, &contact, &friction))
}

/// A solved contact; its values are in the order of [`Quantity::ALL`](super::Quantity::ALL).
fn solved(
    (report, convolutions): (SolveReport, f64),
    film: &FilmNumbers,
    contact: &ContactNumbers,
    friction: &FrictionNumbers,
) -> Solved {
    let values = [
        film.central,
        film.minimum,
        film.mean_central,
        contact.area_ratio,
        contact.load_ratio,
        friction.coefficient,
    ];
    Solved { report, convolutions, minimum_gap: film.minimum_gap, values }
}
