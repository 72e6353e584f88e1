//! Blocks of rows behind their headers.

use super::keys::meaning;
use super::style::{Line, Style, is_like_row, loose_fields, loose_number};
use crate::source::shortened;

/// A header and the rows behind it.
pub(super) struct Block<'a> {
    pub(super) header: Vec<Line<'a>>,
    pub(super) rows: Vec<Line<'a>>,
    /// Whether the first field of each row is a label.
    pub(super) is_labelled: bool,
}

impl<'a> Block<'a> {
    fn new(header: Vec<Line<'a>>, rows: Vec<Line<'a>>) -> Self {
        Self { header, rows, is_labelled: false }
    }

    /// The last line of the header, or the numbers of the lines.
    pub(super) fn title(&self) -> String {
        match (self.header.last(), self.rows.first(), self.rows.last()) {
            (Some((_, line)), ..) => shortened(line.trim()),
            (None, Some((first, _)), Some((last, _))) if first == last => format!("line {first}"),
            (None, Some((first, _)), Some((last, _))) => format!("lines {first} to {last}"),
            _ => String::new(),
        }
    }

    /// Numbers in the first row.
    pub(super) fn columns(&self) -> usize {
        let first = self.rows.first().map_or("", |(_, line)| *line);
        Style::of_line(first).map_or(0, |style| style.separator.split(first).len())
    }

    /// The parts of the block between empty lines, the first of which has the header; the block itself where each
    /// part is a single row.
    pub(super) fn split_at_empty_lines(self) -> Vec<Self> {
        let parts = self.rows.split(|(_, line)| is_empty(line)).filter(|part| !part.is_empty());
        let parts: Vec<Vec<Line<'_>>> = parts.map(<[_]>::to_vec).collect();
        if parts.len() < 2 || parts.iter().all(|part| part.len() == 1) {
            return vec![self];
        }
        let mut header = Some(self.header);
        parts.into_iter().map(|rows| Self::new(header.take().unwrap_or_default(), rows)).collect()
    }

    /// The line before which an empty line divides rows, unless each row stands alone.
    pub(super) fn division(&self) -> Option<usize> {
        let filled = |lines: &[Line<'_>]| lines.iter().filter(|(_, line)| !is_empty(line)).count();
        let single = self.rows.split(|(_, line)| is_empty(line)).all(|part| part.len() < 2);
        let place = self.rows.windows(2).position(|pair| is_empty(pair[0].1) && !is_empty(pair[1].1))?;
        (!single && filled(&self.rows[..place]) > 0).then(|| self.rows[place + 1].0)
    }
}

/// Whether a line holds nothing, not even a tab.
fn is_empty(line: &str) -> bool {
    line.trim_matches(' ').is_empty()
}

/// Whether a line is a comment of `NumPy`, Gwyddion or MATLAB.
pub(super) fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with(['#', '%', '\\'])
}

/// Blocks of rows with their headers, and the lines behind the last of them.
pub(super) fn blocks<'a>(lines: &[Line<'a>]) -> (Vec<Block<'a>>, Vec<Line<'a>>) {
    let mut found: Vec<Block<'_>> = Vec::new();
    let (mut header, mut rows) = (Vec::new(), Vec::new());
    for (number, line) in lines {
        let is_blank = line.trim().is_empty();
        let is_row = if rows.is_empty() { begins_rows(line) } else { is_blank || is_like_row(line) };
        if is_row && !is_comment(line) {
            rows.push((*number, *line));
            continue;
        }
        if !rows.is_empty() {
            found.push(Block::new(std::mem::take(&mut header), std::mem::take(&mut rows)));
        }
        if !is_blank {
            header.push((*number, *line));
        }
    }
    if !rows.is_empty() {
        found.push(Block::new(std::mem::take(&mut header), rows));
    }
    if found.is_empty() {
        found.extend(labelled(&mut header));
    }
    for block in &mut found {
        while block.rows.last().is_some_and(|(_, line)| line.trim_matches([' ', '\t']).is_empty()) {
            block.rows.pop();
        }
    }
    (found, header)
}

/// Whether a line is the first of a block of rows: its first field is a number, or all fields are numbers or
/// markers of undefined points.
fn begins_rows(line: &str) -> bool {
    if line.trim().is_empty() || is_comment(line) {
        return false;
    }
    let begins = loose_fields(line).next().and_then(loose_number).is_some_and(f64::is_finite);
    begins || is_like_row(line) && loose_fields(line).all(|field| loose_number(field).is_some())
}

/// The block of rows that begin with a label each, taken off the end of `header`, where all lines from one on
/// hold a word and two numbers or more.
fn labelled<'a>(header: &mut Vec<Line<'a>>) -> Option<Block<'a>> {
    let is_labelled = |(_, line): &Line<'_>| {
        let Ok(style) = Style::of_line(line) else { return false };
        let fields = style.separator.split(line);
        let is_number = |field: &&str| style.decimal.parse(field).is_some();
        let key = fields.first().map(|field| field.to_lowercase()).unwrap_or_default();
        // a date or a time is no label
        let is_word = !key.starts_with(|letter: char| letter.is_ascii_digit());
        fields.len() > 2 && is_word && meaning(&key).is_none() && fields[1..].iter().all(is_number)
    };
    let count = header.iter().rev().take_while(|line| !is_comment(line.1) && is_labelled(line)).count();
    if count < 2 {
        return None;
    }
    let rows = header.split_off(header.len() - count);
    Some(Block { is_labelled: true, ..Block::new(std::mem::take(header), rows) })
}
