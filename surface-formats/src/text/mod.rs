//! Heights as text: matrices and columns of numbers, with or without a header that gives sizes and units.
//!
//! A file is blocks of rows, each behind lines of a header. The header is pairs of keys and values, whose
//! spellings are in `keys`; rows are split by `style`, and `layout` decides between matrices and columns. Nothing is
//! passed over in silence: keys that are not understood, choices and missing units become warnings, all else
//! an error with its line.

mod columns;
mod edges;
mod header;
mod keys;
mod layout;
mod number;
mod pairs;
mod raster;
mod style;
mod table;
mod titles;
mod write;
mod wyko;
mod zygo;

pub(crate) use self::number::parse_height;
pub use self::write::write_text;

use self::edges::Corner;
use self::header::Header;
use self::keys::meaning;
use self::layout::Content;
use self::style::{Line, Style, is_like_row, loose_fields, loose_number};
use self::table::Table;
use self::titles::Titles;
use crate::error::Error;
use crate::prf;
use crate::source::{Source, decode_text, is_utf_16, shortened};
use crate::surface::Surface;

/// Bytes at the start that must look like text.
const LOOK: usize = 4096;

/// Whether the start of the file holds no bytes that text does not hold.
pub(crate) fn recognises(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(LOOK)];
    is_utf_16(start)
        || !start.is_empty()
            && start.iter().all(|&byte| byte >= 0x20 || matches!(byte, b'\t' | b'\n' | b'\r' | 0x0c))
}

/// A header and the rows behind it.
struct Block<'a> {
    header: Vec<Line<'a>>,
    rows: Vec<Line<'a>>,
    /// Whether the first field of each row is a label.
    is_labelled: bool,
}

/// The surface of a text file.
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let content = decode_text(source.bytes);
    let lines = lines(&content);
    match lines.iter().find(|(_, line)| !line.trim().is_empty()) {
        Some((_, first)) if first.starts_with(wyko::MAGIC) => return wyko::read(source, &lines),
        Some((_, first)) if first.starts_with(zygo::MAGIC) => return zygo::read(source, &lines),
        Some(_) if prf::recognises(&lines) => return prf::read(source, &lines),
        _ => {}
    }
    let (blocks, rest) = blocks(&lines);
    if blocks.is_empty() {
        return Err(without_rows(source, &rest));
    }
    let headers: Vec<Header> =
        blocks.iter().map(|block| Header::read(source, &block.header)).collect::<Result<_, _>>()?;
    // without a name the line before the rows stands in
    let names = headers.iter().zip(&blocks).map(|(header, block)| {
        let title = || block.header.last().map(|(_, line)| shortened(line.trim()));
        header.name.clone().or_else(title).unwrap_or_default()
    });
    let chosen = if blocks.len() > 1 { source.choose(names.collect())? } else { 0 };
    // a block without a header of its own has that of the first
    let described = if headers[chosen].is_known { chosen } else { 0 };
    read_block(source, &blocks[chosen], &blocks[described].header, &rest)
}

/// The lines of a text with their numbers; they end with a line feed, a carriage return or both.
fn lines(content: &str) -> Vec<Line<'_>> {
    let mut number = 0;
    let mut found = Vec::new();
    for line in content.split('\n') {
        let line = line.strip_suffix('\r').unwrap_or(line);
        for part in line.split('\r') {
            number += 1;
            found.push((number, part));
        }
    }
    found
}

/// Whether a line is a comment of `NumPy`, Gwyddion or MATLAB.
fn is_comment(line: &str) -> bool {
    line.trim_start().starts_with(['#', '%', '\\'])
}

/// Blocks of rows with their headers, and the lines behind the last of them.
fn blocks<'a>(lines: &[Line<'a>]) -> (Vec<Block<'a>>, Vec<Line<'a>>) {
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
            let (header, rows) = (std::mem::take(&mut header), std::mem::take(&mut rows));
            found.push(Block { header, rows, is_labelled: false });
        }
        if !is_blank {
            header.push((*number, *line));
        }
    }
    if !rows.is_empty() {
        found.push(Block { header: std::mem::take(&mut header), rows, is_labelled: false });
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
        fields.len() > 2 && meaning(&key).is_none() && fields[1..].iter().all(is_number)
    };
    let count = header.iter().rev().take_while(|line| !is_comment(line.1) && is_labelled(line)).count();
    if count < 2 {
        return None;
    }
    let rows = header.split_off(header.len() - count);
    Some(Block { header: std::mem::take(header), rows, is_labelled: true })
}

/// The error of a text without rows.
fn without_rows(source: Source<'_>, lines: &[Line<'_>]) -> Error {
    match Header::read(source, lines) {
        Ok(header) if header.is_known => source.corrupt("no heights after the header".to_owned()),
        Err(error) => error,
        Ok(_) => source.unknown(),
    }
}

/// The surface of one block, described by the lines `header`; `rest` are the lines behind all blocks.
fn read_block(
    source: Source<'_>,
    block: &Block<'_>,
    header: &[Line<'_>],
    rest: &[Line<'_>],
) -> Result<Surface, Error> {
    let style = Style::of(source, &block.rows)?;
    let table = Table::read(source, &block.rows, style, block.is_labelled)?;
    let mut warnings = Vec::new();
    if style.is_doubtful {
        let reading = match style.separator {
            style::Separator::None => "as decimal marks, not as separators of two columns",
            _ => "as separators of two columns, not as decimal marks",
        };
        warnings.push(format!("commas are read {reading}"));
    }
    if let Some((number, line)) = rest.first() {
        let more = rest.len() - 1;
        let more = if more > 0 { format!(" and {more} more lines") } else { String::new() };
        warnings.push(format!(
            "line {number}: \"{}\"{more} behind the heights is not understood",
            shortened(line)
        ));
    }
    let fields = table.columns + usize::from(block.is_labelled);
    let titles = Titles::read(header, style, fields).filter(|_| !block.is_labelled);
    let corner = match (&titles, header.last()) {
        (None, Some((_, line))) if !block.is_labelled => Corner::read(line, style, table.columns),
        _ => None,
    };
    let used = titles.as_ref().map_or(usize::from(corner.is_some()), |(_, lines)| *lines);
    let header = Header::read(source, &header[..header.len() - used])?;
    let titles = titles.map(|(titles, _)| titles);
    Content { source, header: &header, titles: titles.as_ref(), table, corner, warnings }.arrange()
}
