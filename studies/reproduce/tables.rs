//! The tables: every statement at each tenth of the run, every number, every history; and short ones to
//! print.

use std::fmt::Write as _;
use std::fs;

use crate::case_run::Run;
use crate::cases::Case;
use crate::history;
use crate::options::Options;
use crate::statements::{PARTS, Pair, STATEMENTS, Statement, Value, share};

/// A variant and its pairs that are complete, by seed.
pub(crate) struct Results {
    pub(crate) case: Case,
    pub(crate) seeds: Vec<u64>,
    pub(crate) pairs: Vec<Pair>,
}

/// Reads complete variants, in the order of `cases`; variants without a pair are left out.
pub(crate) fn gather(runs: &[Run], options: &Options) -> Result<Vec<Results>, String> {
    let mut all: Vec<Results> = Vec::new();
    for run in runs.iter().filter(|run| run.film) {
        let without = Run { film: false, ..*run };
        if !history::is_complete(run, options) || !history::is_complete(&without, options) {
            continue;
        }
        let pair = Pair { with: history::read(run, options)?, without: history::read(&without, options)? };
        match all.iter_mut().find(|results| results.case.name == run.case.name) {
            Some(results) => {
                results.seeds.push(run.seed);
                results.pairs.push(pair);
            }
            None => all.push(Results { case: run.case, seeds: vec![run.seed], pairs: vec![pair] }),
        }
    }
    let place = |name| crate::cases::CASES.iter().position(|case| case.name == name);
    all.sort_by_key(|results| place(results.case.name));
    Ok(all)
}

impl Results {
    /// Seeds whose answer at `part` is yes; none where the statement is not one of that tenth.
    fn agree(&self, statement: &Statement, part: usize) -> Option<usize> {
        let answers = self.pairs.iter().map(|pair| statement.answer(pair, part));
        answers.collect::<Option<Vec<bool>>>().map(|yes| yes.into_iter().filter(|yes| *yes).count())
    }

    /// Mean over the seeds and sample standard deviation; NaN for one seed.
    fn spread(&self, value: impl Fn(&Pair) -> f64) -> (f64, f64) {
        let n = self.pairs.len() as f64;
        let mean = self.pairs.iter().map(&value).sum::<f64>() / n;
        let sum: f64 = self.pairs.iter().map(|pair| (value(pair) - mean).powi(2)).sum();
        (mean, (sum / (n - 1.0)).sqrt())
    }
}

/// A number of the tables: name, unit, factor from SI, decimals, value, and whether it adds up, so that a
/// tenth has it at its end and not in its mean.
struct Quantity(&'static str, &'static str, f64, usize, Value, bool);

const QUANTITIES: [Quantity; 15] = [
    Quantity("Rq of the ball", "nm", 1e9, 1, |r| r.roughness.ball_rq, false),
    Quantity("Rq of the disc", "nm", 1e9, 1, |r| r.roughness.disc_rq, false),
    Quantity("h_avg", "nm", 1e9, 1, |r| r.film.mean_central, false),
    Quantity("lambda", "1", 1.0, 3, |r| r.film.lambda.unwrap_or(f64::NAN), false),
    Quantity("lambda_OLD", "1", 1.0, 4, |r| r.film.formula_lambda.unwrap_or(f64::NAN), false),
    Quantity("area ratio", "1", 1.0, 3, |r| r.contact.area_ratio, false),
    Quantity("load ratio", "1", 1.0, 3, |r| r.contact.load_ratio, false),
    Quantity("friction coefficient", "1", 1.0, 4, |r| r.friction.coefficient, false),
    Quantity("largest pressure", "GPa", 1e-9, 2, |r| r.pressure.max, false),
    Quantity("wear of the ball, track", "nm", 1e9, 1, |r| r.wear.ball_in_contact, true),
    Quantity("wear of the disc, track", "nm", 1e9, 1, |r| r.wear.disc_in_contact, true),
    Quantity("wear of the disc, deepest", "nm", 1e9, 1, |r| r.wear.disc_max, true),
    Quantity("tribofilm of the ball, track", "nm", 1e9, 1, |r| r.tribofilm.ball_in_contact, true),
    Quantity("tribofilm of the disc, track", "nm", 1e9, 1, |r| r.tribofilm.disc_in_contact, true),
    Quantity("volume flattened", "um^3", 1e18, 1, |r| r.plastic.volume, true),
];

impl Quantity {
    fn of(&self, pair: &Pair, film: bool, part: usize) -> f64 {
        let history = if film { &pair.with } else { &pair.without };
        let value = match (part, self.5) {
            (0, true) => 0.0,
            (0, false) => history.records.first().map_or(f64::NAN, self.4),
            (_, true) => history.at(part, self.4),
            (_, false) => history.mean(part, self.4),
        };
        self.2 * value
    }
}

const SIDES: [(&str, bool); 2] = [("with", true), ("without", false)];

/// Writes `statements.csv`, `numbers.csv` and `histories.csv` into the report folder.
///
/// # Errors
/// A file that cannot be written.
pub(crate) fn write(all: &[Results], options: &Options) -> Result<(), String> {
    for (name, text) in [
        ("statements.csv", statements(all)),
        ("numbers.csv", numbers(all)),
        ("histories.csv", histories(all)),
    ] {
        let file = options.report.join(name);
        fs::write(&file, text).map_err(|error| format!("{}: {error}", file.display()))?;
    }
    Ok(())
}

fn tenths() -> String {
    (1..=PARTS).map(|part| format!(",tenth{part}")).collect()
}

/// Writing to a string cannot fail, here and below.
fn statements(all: &[Results]) -> String {
    let mut text = String::from("variant,seeds,steps,statement,share");
    text.push_str(&tenths());
    text.push('\n');
    for results in all {
        for statement in &STATEMENTS {
            let (case, seeds) = (&results.case, results.pairs.len());
            let _ = write!(
                text,
                "{},{seeds},{},\"{}\",{:.3}",
                case.name,
                case.steps,
                statement.text,
                share(statement, &results.pairs).unwrap_or(f64::NAN)
            );
            for part in 1..=PARTS {
                let agree = results.agree(statement, part).map_or_else(String::new, |n| n.to_string());
                let _ = write!(text, ",{agree}");
            }
            text.push('\n');
        }
    }
    text
}

fn numbers(all: &[Results]) -> String {
    let mut text = String::from("variant,seeds,steps,quantity,unit,tribofilm,start");
    text.push_str(&tenths());
    text.push_str(",deviation_of_seeds_tenth10\n");
    for results in all {
        for quantity in &QUANTITIES {
            for (side, film) in SIDES {
                let (case, seeds) = (&results.case, results.pairs.len());
                let _ = write!(
                    text,
                    "{},{seeds},{},\"{}\",{},{side}",
                    case.name, case.steps, quantity.0, quantity.1
                );
                for part in 0..=PARTS {
                    let (mean, _) = results.spread(|pair| quantity.of(pair, film, part));
                    let _ = write!(text, ",{mean:.5e}");
                }
                let (_, deviation) = results.spread(|pair| quantity.of(pair, film, PARTS));
                let deviation = if seeds > 1 { format!("{deviation:.2e}") } else { String::new() };
                let _ = writeln!(text, ",{deviation}");
            }
        }
    }
    text
}

fn histories(all: &[Results]) -> String {
    let mut text = String::from(
        "variant,seed,tribofilm,cells,side_mm,steps,positions_passed_over,convolutions_per_step\n",
    );
    for results in all {
        for (seed, pair) in results.seeds.iter().zip(&results.pairs) {
            for (side, history) in [("with", &pair.with), ("without", &pair.without)] {
                let Case { name, cells, side: length, .. } = results.case;
                let steps = history.records.len();
                let work: f64 = history.records.iter().map(|record| record.report.work.convolutions).sum();
                let _ = writeln!(
                    text,
                    "{name},{seed},{side},{cells},{},{steps},{},{:.0}",
                    1e3 * length,
                    history.passed_over(),
                    work / steps as f64
                );
            }
        }
    }
    text
}

/// Three tables in Markdown, one column a variant: its runs, shares of seeds and tenths that agree,
/// numbers of the last tenth.
pub(crate) fn summary(all: &[Results]) -> String {
    let mut text = String::new();
    row(&mut text, "", all, |results| results.case.name.to_owned());
    let _ = writeln!(text, "|---|{}", "---|".repeat(all.len()));
    row(&mut text, "seeds", all, |results| results.pairs.len().to_string());
    row(&mut text, "steps", all, |results| results.case.steps.to_string());
    row(&mut text, "cells", all, |results| results.case.cells.to_string());
    row(&mut text, "positions skipped", all, |results| {
        let passed_over =
            results.pairs.iter().map(|pair| pair.with.passed_over() + pair.without.passed_over());
        passed_over.sum::<u32>().to_string()
    });
    for statement in &STATEMENTS {
        row(&mut text, statement.text, all, |results| {
            format!("{:.2}", share(statement, &results.pairs).unwrap_or(f64::NAN))
        });
    }
    for quantity in &QUANTITIES {
        for (side, film) in SIDES {
            // No film grows without one.
            if quantity.0.starts_with("tribofilm") && !film {
                continue;
            }
            let name = format!("{}, {}, {side}", quantity.0, quantity.1);
            row(&mut text, &name, all, |results| {
                cell(results.spread(|pair| quantity.of(pair, film, PARTS)), quantity.3)
            });
        }
    }
    row(&mut text, "wear of the disc, with ZDDP over without", all, |results| {
        let wear: Value = |record| record.wear.disc_in_contact;
        cell(results.spread(|pair| pair.with.at(PARTS, wear) / pair.without.at(PARTS, wear)), 3)
    });
    text
}

fn row(text: &mut String, name: &str, all: &[Results], cell: impl Fn(&Results) -> String) {
    let cells: Vec<String> = all.iter().map(cell).collect();
    let _ = writeln!(text, "| {name} | {} |", cells.join(" | "));
}

/// Mean and, of several seeds, their standard deviation.
fn cell((mean, deviation): (f64, f64), decimals: usize) -> String {
    if deviation.is_finite() {
        format!("{mean:.decimals$} +- {deviation:.decimals$}")
    } else {
        format!("{mean:.decimals$}")
    }
}
