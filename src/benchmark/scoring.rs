//! From the outcome of a solve to its row.

use super::job::Job;
use super::limits::{Quantity, fingerprint};
use super::metered::{Fault, Meter};
use super::row::{Row, Verdict};
use crate::report::SolveReport;
use crate::sim::SimError;

/// The numbers of a solve that returned.
pub(super) struct Solved {
    /// Report of the last contact.
    pub(super) report: SolveReport,
    /// Convolutions of all contacts.
    pub(super) convolutions: f64,
    /// Smallest gap \[m\]; NaN for a contact that was not measured.
    pub(super) minimum_gap: f64,
    /// Numbers in the order of [`Quantity::ALL`].
    pub(super) values: [f64; 6],
}

/// How a job ended.
pub(super) enum Outcome {
    /// The simulation returned.
    Returned(Result<Solved, SimError>),
    /// The thread panicked.
    Panicked(String),
    /// The thread did not return in time.
    GivenUp,
}

/// The row of `job` before it is solved.
pub(super) fn blank(job: &Job) -> Row {
    let case = &job.case;
    let history = case.history.map_or_else(String::new, |history| {
        let kind = if history.is_transient { "t" } else { "h" };
        format!("-{}{kind}{:e}", history.contacts, history.time_step)
    });
    let scene = fingerprint(&case.scene).unwrap_or_default();
    Row {
        case: case.name.clone(),
        tags: case.tags.clone(),
        parameters: case.parameters.clone(),
        contestant: job.contestant.name().to_owned(),
        tolerance: job.tolerance,
        cells: job.scene().grid.nx(),
        scene: scene + &history,
        verdict: Verdict::Refused,
        ran: String::new(),
        strategy: String::new(),
        residuals: [f64::NAN; 3],
        iterations: 0,
        convolutions: f64::NAN,
        all_convolutions: f64::NAN,
        displacements: 0.0,
        seconds: 0.0,
        minimum_gap: f64::NAN,
        values: [f64::NAN; 6],
        error: f64::NAN,
        reason: String::new(),
    }
}

/// The row of an `outcome`.
pub(super) fn row(job: &Job, outcome: Outcome, meter: &Meter) -> Row {
    let mut row = blank(job);
    (row.displacements, row.seconds) = (meter.displacements(), meter.seconds());
    (row.verdict, row.reason) = match outcome {
        Outcome::GivenUp => (Verdict::GivenUp, "it did not return".to_owned()),
        Outcome::Panicked(message) => (Verdict::Panicked, message),
        Outcome::Returned(_) if meter.is_exceeded() => {
            (Verdict::OutOfBudget, format!("{:.0} displacements were computed", row.displacements))
        }
        Outcome::Returned(Ok(solved)) => {
            let verdict = solved.report.status.into();
            take(&mut row, solved);
            (verdict, String::new())
        }
        Outcome::Returned(Err(SimError::NotConverged { source, step, .. })) => {
            let (report, nan) = (*source.report, f64::NAN);
            let (verdict, convolutions) = (report.status.into(), report.work.convolutions);
            take(&mut row, Solved { report, convolutions, minimum_gap: nan, values: [nan; 6] });
            (verdict, format!("at contact {step}"))
        }
        Outcome::Returned(Err(error)) => (Verdict::Refused, error.to_string()),
    };
    match meter.fault() {
        Some(Fault::WrongGrid(reason)) => (row.verdict, row.reason) = (Verdict::WrongGrid, reason),
        Some(Fault::FalselyConverged(reason)) if is_judged(row.verdict) => {
            (row.verdict, row.reason) = (Verdict::FalselyConverged, reason);
        }
        _ => {}
    }
    compare(job, &mut row);
    row
}

/// Whether a contradiction of a returned state decides about the verdict.
fn is_judged(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::Converged | Verdict::FalselyConverged)
}

/// Takes report and numbers into the row.
fn take(row: &mut Row, solved: Solved) {
    let Solved { report, convolutions, minimum_gap, values } = solved;
    row.ran = report.solver.to_string();
    row.strategy = report.strategy.map_or_else(String::new, |strategy| strategy.to_string());
    row.residuals = [report.residual.mass, report.residual.load, report.residual.complementarity];
    row.iterations = report.work.iterations;
    (row.convolutions, row.all_convolutions) = (report.work.convolutions, convolutions);
    (row.minimum_gap, row.values) = (minimum_gap, values);
}

/// The error from the limits of the case, or a remark that they belong to another scene.
fn compare(job: &Job, row: &mut Row) {
    let Some(limits) = &job.case.reference else { return };
    match limits.is_of(&job.case.scene) {
        Ok(true) => {
            row.error = limits.error(|quantity: Quantity| row.value(quantity)).unwrap_or(f64::NAN);
        }
        _ => {
            let remark = format!(
                "the reference is of the scene {}, the case has the scene {}",
                limits.scene(),
                row.scene
            );
            let separator = if row.reason.is_empty() { "" } else { "; " };
            row.reason = format!("{}{separator}{remark}", row.reason);
        }
    }
}
