//! The closing table: each history at its start and at its end.

use std::fmt::Write;

use stribeck::sim::StepRecord;

use crate::history::History;

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
    Row("Rq of the ball", "nm", 1e9, 1, End::Last, |r| r.rq[0]),
    Row("Rq of the disc", "nm", 1e9, 1, End::Last, |r| r.rq[1]),
    Row("Rq, composite", "nm", 1e9, 1, End::Last, |r| r.composite_rq),
    Row("average film h_avg", "nm", 1e9, 1, End::Mean, |r| r.average_film),
    Row("lambda = h_avg/Rq", "", 1.0, 3, End::Mean, |r| r.lambda),
    Row("lambda_OLD = h_c/Rq", "", 1.0, 4, End::Last, |r| r.lambda_old),
    Row("contact area ratio", "", 1.0, 3, End::Mean, |r| r.area_ratio),
    Row("contact load ratio", "", 1.0, 3, End::Mean, |r| r.load_ratio),
    Row("largest pressure", "GPa", 1e-9, 2, End::Mean, |r| r.max_pressure),
    Row("mean pressure", "GPa", 1e-9, 3, End::Mean, |r| r.mean_pressure),
    Row("wear of the ball, track", "nm", 1e9, 2, End::Sum, |r| r.track_wear[0]),
    Row("wear of the disc, track", "nm", 1e9, 2, End::Sum, |r| r.track_wear[1]),
    Row("wear of the disc, largest", "nm", 1e9, 1, End::Sum, |r| r.max_wear[1]),
    Row("tribofilm of the ball, track", "nm", 1e9, 1, End::Sum, |r| r.track_film[0]),
    Row("tribofilm of the disc, track", "nm", 1e9, 1, End::Sum, |r| r.track_film[1]),
    Row("volume flattened", "um^3", 1e18, 1, End::Sum, |r| r.plastic_volume),
    Row("flash temperature rise", "K", 1.0, 2, End::Mean, |r| r.flash_rise.unwrap_or(f64::NAN)),
    Row("friction coefficient", "", 1.0, 4, End::Mean, |r| r.friction_coefficient),
];

/// The table and how it is read. Histories without a step have dashes.
pub(crate) fn closing(with: &History, without: &History) -> String {
    let mut text = String::new();
    let histories = [without, with];
    let [left, right] = histories.map(|history| format!("{:>22}", history.title));
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{:36}{left}  {right}", "");
    let _ = writeln!(text, "{:36}{:>11}{:>11}  {:>11}{:>11}", "", "start", "end", "start", "end");
    for row in ROWS {
        let Row(name, unit, _, _, end, _) = row;
        let mark = if end == End::Mean { "*" } else { "" };
        let [left, right] = histories.map(|history| ends(history, &row));
        let _ = writeln!(text, "{:<29}{unit:<7}{left}  {right}", format!("{name}{mark}"));
    }
    let _ = writeln!(
        text,
        "start: time zero; end: last step (*: mean of the last {}); track: mean over its width",
        with.window()
    );
    for history in histories {
        let moved = history.records.iter().filter(|record| record.attempts > 1).count();
        let count = history.records.len();
        let _ = writeln!(text, "{}: {moved} of {count} steps needed another position", history.title);
    }
    text
}

/// Start and end of one history, two cells.
fn ends(history: &History, &Row(_, _, factor, decimals, end, value): &Row) -> String {
    let records = &history.records;
    let [Some(first), Some(last)] = [records.first(), records.last()] else {
        return format!("{:>11}{:>11}", "-", "-");
    };
    let sums = end == End::Sum;
    let end = match end {
        End::Last | End::Sum => value(last),
        End::Mean => {
            let tail = &records[records.len().saturating_sub(history.window())..];
            tail.iter().map(value).sum::<f64>() / tail.len() as f64
        }
    };
    // The contact of the first step is that of time zero.
    let start = if sums { 0.0 } else { value(first) };
    format!("{:>11.decimals$}{:>11.decimals$}", factor * start, factor * end)
}
