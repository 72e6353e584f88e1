//! Results in words.

use std::collections::BTreeMap;
use std::fmt::{Result as Written, Write as _};

use super::results::{Results, distinct};
use super::row::{Row, Verdict};

/// Failed runs that are listed of each kind.
const LISTED: usize = 10;

impl Results {
    /// Counts of verdicts, work, the order of the contestants, and the runs that failed, with their reasons.
    pub fn summary(&self) -> String {
        let mut text = String::new();
        // Writing to a string cannot fail.
        let _ = counts(&mut text, self);
        for contestant in self.contestants() {
            let _ = costs(&mut text, contestant, self);
        }
        let _ = order(&mut text, self, "convolutions", Row::work);
        let _ = order(&mut text, self, "seconds", |row| row.seconds);
        let _ = failures(&mut text, self);
        text
    }
}

/// Verdicts by contestant and group.
fn counts(text: &mut String, results: &Results) -> Written {
    let contestants = results.contestants();
    let width = contestants.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(10);
    let verdicts: Vec<Verdict> = Verdict::ALL
        .into_iter()
        .filter(|verdict| results.rows().iter().any(|row| row.verdict == *verdict))
        .collect();
    write!(text, "{:<width$} {:<12} {:>6}", "contestant", "cases", "all")?;
    for verdict in &verdicts {
        write!(text, " {verdict:>17}")?;
    }
    writeln!(text)?;
    for contestant in contestants {
        for group in distinct(results.of(contestant).map(Row::group)) {
            let rows: Vec<&Row> = results.of(contestant).filter(|row| row.group() == group).collect();
            write!(text, "{contestant:<width$} {group:<12} {:>6}", rows.len())?;
            for verdict in &verdicts {
                write!(text, " {:>17}", rows.iter().filter(|row| row.verdict == *verdict).count())?;
            }
            writeln!(text)?;
        }
    }
    Ok(())
}

/// Convolutions of a contestant, of histories those of the last contact, and its strategies.
fn costs(text: &mut String, contestant: &str, results: &Results) -> Written {
    let (mut total, mut converged, mut most, mut strategies) = (0.0, 0.0, 0.0_f64, BTreeMap::new());
    for row in results.of(contestant).filter(|row| row.convolutions.is_finite()) {
        total += row.convolutions;
        if row.is_solved() {
            converged += row.convolutions;
            most = most.max(row.convolutions);
            let strategy = if row.strategy.is_empty() { "no strategy" } else { &row.strategy };
            *strategies.entry(strategy).or_insert(0_u32) += 1;
        }
    }
    let solved: u32 = strategies.values().sum();
    if solved == 0 {
        return Ok(());
    }
    write!(text, "{contestant}: {total:.0} convolutions; of the converged {converged:.0}, ")?;
    write!(text, "mean {:.0}, most {most:.0}", converged / f64::from(solved))?;
    for (strategy, count) in strategies {
        write!(text, "; {strategy} {count}")?;
    }
    writeln!(text)
}

/// Contestants by their work over the runs that all of them solve, best first.
fn order(text: &mut String, results: &Results, unit: &str, cost: impl Fn(&Row) -> f64) -> Written {
    let contestants = results.contestants();
    if contestants.len() < 2 {
        return Ok(());
    }
    let problems = results.problems(&contestants);
    let common: Vec<&Vec<&Row>> =
        problems.iter().filter(|rows| rows.iter().all(|row| row.is_solved() && cost(row) > 0.0)).collect();
    if common.is_empty() {
        return writeln!(text, "No run is solved by all contestants.");
    }
    let mean = |k: usize| {
        let sum: f64 = common.iter().filter_map(|rows| rows.get(k)).map(|row| cost(row).ln()).sum();
        (sum / common.len() as f64).exp()
    };
    let mut means: Vec<(&str, f64)> =
        contestants.iter().enumerate().map(|(k, name)| (*name, mean(k))).collect();
    means.sort_by(|a, b| a.1.total_cmp(&b.1));
    let Some(((best, least), others)) = means.split_first() else { return Ok(()) };
    write!(text, "{best} takes the fewest {unit} over the {} runs that all solve", common.len())?;
    write!(text, " (geometric mean {least:.3})")?;
    for (name, mean) in others {
        write!(text, "; {name} takes {:.2} times as many", mean / least)?;
    }
    writeln!(text, ".")
}

/// Runs that were not solved: those that all contestants refuse, then those of each contestant.
fn failures(text: &mut String, results: &Results) -> Written {
    let first = results.contestants().first().copied().unwrap_or_default();
    let refused: Vec<&Row> = results.of(first).filter(|row| is_refused_by_all(row, results)).collect();
    if !refused.is_empty() {
        let count = results.of(first).count();
        writeln!(text, "{} of {count} runs are refused for every contestant:", refused.len())?;
        listed(text, &refused)?;
    }
    for contestant in results.contestants() {
        let failed: Vec<&Row> = results
            .of(contestant)
            .filter(|row| !row.is_solved() && !is_refused_by_all(row, results))
            .collect();
        if failed.is_empty() {
            continue;
        }
        writeln!(text, "{contestant} fails in {} of {} runs:", failed.len(), results.of(contestant).count())?;
        listed(text, &failed)?;
    }
    Ok(())
}

/// The first of the failed runs, with their reasons.
fn listed(text: &mut String, failed: &[&Row]) -> Written {
    for row in failed.iter().take(LISTED) {
        write!(text, "  {} ({} cells, {:e}): {}", row.case, row.cells, row.tolerance, row.verdict)?;
        let separator = if row.reason.is_empty() { "" } else { ": " };
        writeln!(text, "{separator}{}", row.reason)?;
    }
    if failed.len() > LISTED {
        writeln!(text, "  and {} more", failed.len() - LISTED)?;
    }
    Ok(())
}

/// Whether the case of a row has no solution: every contestant has the same refusal.
fn is_refused_by_all(row: &Row, results: &Results) -> bool {
    row.verdict == Verdict::Refused
        && results
            .rows()
            .iter()
            .filter(|other| other.case == row.case)
            .all(|other| other.verdict == Verdict::Refused && other.reason == row.reason)
}
