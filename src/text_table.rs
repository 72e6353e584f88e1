//! Tables in text files: lines of cells between commas, semicolons, tabs or blanks.
//!
//! ```
//! use stribeck::text_table::rows;
//! let text = "# flank of a gear\nangle (deg);load (N)\n0;100\n90;120\n";
//! let lines: Vec<usize> = rows(text).map(|row| row.line).collect();
//! assert_eq!(lines, [2, 3, 4]);
//! ```

/// A line of a table.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Row<'a> {
    /// Number of the line in its file, counted from 1.
    pub line: usize,
    /// The line without blanks around it.
    pub text: &'a str,
    /// Its cells without blanks and double quotes around them; a cell may be empty.
    pub cells: Vec<&'a str>,
}

/// The lines of `text` that are neither empty nor begin with `#`.
///
/// Semicolons separate the cells of a line that has one, else tabs, else commas, else blanks. A unit in parentheses belongs
/// to the cell before it.
///
/// ```
/// use stribeck::text_table::rows;
/// let cells = |text| rows(text).next().map(|row| row.cells).unwrap_or_default();
/// assert_eq!(cells("angle (deg)  load (N/mm)"), ["angle (deg)", "load (N/mm)"]);
/// assert_eq!(cells("0.5; 1; 2"), ["0.5", "1", "2"]);
/// assert_eq!(cells("0.5\t\t2"), ["0.5", "", "2"]);
/// ```
pub fn rows(text: &str) -> impl Iterator<Item = Row<'_>> {
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim).zip(1..);
    let lines = lines.filter(|(text, _)| !text.is_empty() && !text.starts_with('#'));
    lines.map(|(text, line)| Row { line, text, cells: cells(text) })
}

/// The cells of a line.
fn cells(line: &str) -> Vec<&str> {
    match [';', '\t', ','].into_iter().find(|mark| line.contains(*mark)) {
        Some(mark) => line.split(mark).map(unquoted).collect(),
        None => between_blanks(line).into_iter().map(unquoted).collect(),
    }
}

/// A cell without blanks and double quotes around it.
fn unquoted(cell: &str) -> &str {
    cell.trim().trim_matches('"').trim()
}

/// The parts of a line between blanks outside of parentheses.
fn between_blanks(line: &str) -> Vec<&str> {
    let (mut parts, mut rest) = (Vec::new(), line.trim());
    while !rest.is_empty() {
        let (part, after) = rest.split_at(end_of_part(rest));
        parts.push(part);
        rest = after.trim_start();
    }
    parts
}

/// Length of the first part of `text`, with the parentheses behind it.
fn end_of_part(text: &str) -> usize {
    let end = text.find(char::is_whitespace).unwrap_or(text.len());
    let (_, after) = text.split_at(end);
    match after.trim_start().strip_prefix('(') {
        Some(unit) => text.len() - unit.len() + unit.find(')').map_or(unit.len(), |close| close + 1),
        None => end,
    }
}
