//! The solved cycles of a history: the printed table and the file.

use stribeck::sim::CycleRecord;

/// A table of the solved cycles of a history.
pub(super) fn table(cycles: &[CycleRecord], is_line: bool) -> Vec<String> {
    if cycles.is_empty() {
        return Vec::new();
    }
    let volume = if is_line { "mm3/m" } else { "mm3" };
    let mut lines = vec![format!(
        "\n{:>12} {:>9} {:>9} {:>9} {:>11} {:>11} {:>10} {:>10}",
        "cycles",
        "h min, nm",
        "on solids",
        "friction",
        format!("ball, {volume}"),
        format!("disc, {volume}"),
        "depth, nm",
        "film, nm"
    )];
    let row = |cycle: &CycleRecord| {
        format!(
            "{:>12.5e} {:>9.1} {:>9.4} {:>9.4} {:>11.4e} {:>11.4e} {:>10.2} {:>10.2}",
            cycle.cycles,
            1e9 * cycle.film_minimum,
            cycle.contact_load_ratio,
            cycle.friction_coefficient,
            1e9 * cycle.wear_ball_volume,
            1e9 * cycle.wear_disc_volume,
            1e9 * cycle.wear_ball_max.max(cycle.wear_disc_max),
            1e9 * cycle.tribofilm_ball_max.max(cycle.tribofilm_disc_max)
        )
    };
    let every = cycles.len().div_ceil(super::LINES).max(1);
    lines.extend(cycles.iter().step_by(every).map(row));
    lines
}

/// The same as comma-separated values.
pub(super) fn csv(cycles: &[CycleRecord], is_line: bool) -> String {
    let lines: String = cycles.iter().map(|cycle| format!("{}\n", cycle.csv())).collect();
    format!("{}\n{lines}", super::columns(CycleRecord::COLUMNS, is_line))
}
