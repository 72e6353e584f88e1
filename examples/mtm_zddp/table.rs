//! The closing table: the histories at their start and at their end, and the statements of the paper that hold.

use std::fmt::Write;

use stribeck::InputError;
use stribeck::sim::StepRecord;

use crate::history::History;
use crate::statements::{PARTS, Pair, STATEMENTS, share};

/// How start and end of a column are read.
#[derive(Clone, Copy, PartialEq)]
enum End {
    /// Belongs to the surfaces: the last step has it.
    Last,
    /// Adds up from nothing at the start: the last step has it.
    Sum,
    /// Belongs to one position of the roughness: the mean of the last steps tells more.
    Mean,
}

/// A line of the table: name, unit, factor from SI, decimals, how it ends, value.
struct Row(&'static str, &'static str, f64, usize, End, fn(&StepRecord) -> f64);

const ROWS: [Row; 18] = [
    Row("Rq of the ball", "nm", 1e9, 1, End::Last, |r| r.roughness.ball_rq),
    Row("Rq of the disc", "nm", 1e9, 1, End::Last, |r| r.roughness.disc_rq),
    Row("Rq, composite", "nm", 1e9, 1, End::Last, |r| r.roughness.composite_rq),
    Row("average film h_avg", "nm", 1e9, 1, End::Mean, |r| r.film.mean_central),
    Row("lambda = h_avg/Rq", "", 1.0, 3, End::Mean, |r| r.film.lambda.unwrap_or(f64::NAN)),
    Row("lambda_OLD = h_c/Rq", "", 1.0, 4, End::Last, |r| r.film.formula_lambda.unwrap_or(f64::NAN)),
    Row("contact area ratio", "", 1.0, 3, End::Mean, |r| r.contact.area_ratio),
    Row("contact load ratio", "", 1.0, 3, End::Mean, |r| r.contact.load_ratio),
    Row("largest pressure", "GPa", 1e-9, 2, End::Mean, |r| r.pressure.max),
    Row("mean pressure", "GPa", 1e-9, 3, End::Mean, |r| r.pressure.mean),
    Row("wear of the ball, track", "nm", 1e9, 2, End::Sum, |r| r.wear.ball_in_contact),
    Row("wear of the disc, track", "nm", 1e9, 2, End::Sum, |r| r.wear.disc_in_contact),
    Row("wear of the disc, largest", "nm", 1e9, 1, End::Sum, |r| r.wear.disc_max),
    Row("tribofilm of the ball, track", "nm", 1e9, 1, End::Sum, |r| r.tribofilm.ball_in_contact),
    Row("tribofilm of the disc, track", "nm", 1e9, 1, End::Sum, |r| r.tribofilm.disc_in_contact),
    Row("volume flattened", "um^3", 1e18, 1, End::Sum, |r| r.plastic.volume),
    Row("flash temperature rise", "K", 1.0, 2, End::Mean, |r| r.flash_rise.unwrap_or(f64::NAN)),
    Row("friction coefficient", "", 1.0, 4, End::Mean, |r| r.friction.coefficient),
];

/// The table, how it is read, and the share of the paper's statements that hold. Numbers are means over the
/// seeds, and their standard deviation at the end.
///
/// # Errors
/// Heights that are not finite.
pub(crate) fn closing(pairs: &[[History; 2]]) -> Result<String, InputError> {
    let mut text = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{:36}{:>26}  {:>26}", "", "without tribofilm", "with tribofilm");
    let _ = writeln!(text, "{:36}{:>9}{:>17}  {:>9}{:>17}", "", "start", "end", "start", "end");
    for row in ROWS {
        let Row(name, unit, _, _, end, _) = row;
        let mark = if end == End::Mean { "*" } else { "" };
        let [with, without] = [0, 1].map(|side| {
            let values: Vec<[f64; 2]> = pairs.iter().filter_map(|pair| ends(&pair[side], &row)).collect();
            cells(&values, row.3)
        });
        let _ = writeln!(text, "{:<29}{unit:<7}{without}  {with}", format!("{name}{mark}"));
    }
    let window = pairs.first().map_or(1, |[with, _]| with.window());
    let _ = writeln!(
        text,
        "start: time zero; end: last step (*: mean of the last {window}), mean of {} seeds +- their standard deviation; track: mean \
         over its width",
        pairs.len()
    );
    let asked = pairs
        .iter()
        .map(|[with, without]| Ok(Pair { with: with.for_statements()?, without: without.for_statements()? }));
    let asked: Vec<Pair> = asked.collect::<Result<_, InputError>>()?;
    let passed_over: u32 =
        asked.iter().map(|pair| pair.with.passed_over() + pair.without.passed_over()).sum();
    let _ = writeln!(
        text,
        "{passed_over} positions of the roughness were passed over: their contacts were not solved"
    );
    held(&mut text, &asked);
    Ok(text)
}

/// The statements of the paper, and how many of them hold. Histories of less than ten steps, or of which one ended
/// early, are not asked.
fn held(text: &mut String, pairs: &[Pair]) {
    let whole = |pair: &Pair| {
        let steps = [&pair.with, &pair.without].map(|history| history.records.len());
        steps[0] == steps[1] && steps[0] >= PARTS
    };
    if !pairs.iter().all(whole) {
        return;
    }
    let shares: Vec<(&str, f64)> =
        STATEMENTS.iter().filter_map(|statement| Some((statement.text, share(statement, pairs)?))).collect();
    let mean = shares.iter().map(|(_, share)| share).sum::<f64>() / shares.len() as f64;
    let always = shares.iter().filter(|(_, share)| *share >= 1.0).count();
    let _ = writeln!(
        text,
        "\nwhat the paper says, and the share of seeds and tenths of the run in which it holds: {mean:.2} in the mean, {always} of {} always",
        shares.len()
    );
    for (statement, share) in shares {
        let _ = writeln!(text, "{share:6.2}  {statement}");
    }
}

/// Start and end of one history; none without a step.
fn ends(history: &History, &Row(_, _, factor, _, end, value): &Row) -> Option<[f64; 2]> {
    let records = &history.records;
    let (first, last) = (records.first()?, records.last()?);
    // The contact of the first step is that of time zero.
    let start = if end == End::Sum { 0.0 } else { value(first) };
    let end = match end {
        End::Last | End::Sum => value(last),
        End::Mean => {
            let tail = &records[records.len().saturating_sub(history.window())..];
            tail.iter().map(value).sum::<f64>() / tail.len() as f64
        }
    };
    Some([factor * start, factor * end])
}

/// Start and end over the seeds, two cells.
fn cells(values: &[[f64; 2]], decimals: usize) -> String {
    let n = values.len() as f64;
    let [start, end] = [0, 1].map(|k| values.iter().map(|value| value[k]).sum::<f64>() / n);
    let square: f64 = values.iter().map(|value| (value[1] - end).powi(2)).sum();
    let end = match values.len() {
        0 => return format!("{:>9}{:>17}", "-", "-"),
        1 => format!("{end:.decimals$}"),
        _ => format!("{end:.decimals$} +- {:.decimals$}", (square / (n - 1.0)).sqrt()),
    };
    format!("{start:>9.decimals$}{end:>17}")
}
