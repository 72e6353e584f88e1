//! Heights as text: matrices and columns of numbers, with or without a header that gives sizes and units.
//!
//! A file is blocks of rows, each behind lines of a header. The header is pairs of keys and values, whose
//! spellings are in `keys`; rows are split by `style`, and `layout` decides between matrices and columns. Nothing is
//! passed over in silence: keys that are not understood, choices and missing units become warnings, all else
//! an error with its line.

mod blocks;
mod columns;
mod edges;
mod header;
mod keys;
mod lateral;
mod layout;
pub(crate) mod number;
mod pairs;
mod raster;
mod roles;
mod style;
mod suspicion;
mod table;
mod titles;
mod write;
mod wyko;
mod zygo;

pub use self::write::write_text;

use self::blocks::{Block, blocks};
use self::edges::Corner;
use self::header::Header;
use self::layout::Content;
use self::style::{Line, Style};
use self::table::Table;
use self::titles::Titles;
use crate::error::Error;
use crate::prf;
use crate::source::{Source, decode_text, is_utf_16, shortened};
use crate::surface::Surface;

/// Bytes at the start that must look like text.
const LOOK: usize = 4096;
/// Columns of a list of x, y and heights.
const POSITIONS: usize = 3;

/// Whether the start of the file holds no bytes that text does not hold.
pub(crate) fn recognises(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(LOOK)];
    is_utf_16(start)
        || !start.is_empty()
            && start.iter().all(|&byte| byte >= 0x20 || matches!(byte, b'\t' | b'\n' | b'\r' | 0x0c))
}

/// The surface of a text file.
pub(crate) fn read(source: Source<'_>) -> Result<Surface, Error> {
    let content = decode_text(source.bytes);
    let content = number::without_marks_of_thousands(&content);
    let lines = lines(&content);
    match lines.iter().find(|(_, line)| !line.trim().is_empty()) {
        Some((_, first)) if first.starts_with(wyko::MAGIC) => return wyko::read(source, &lines),
        Some((_, first)) if first.starts_with(zygo::MAGIC) => return zygo::read(source, &lines),
        Some(_) if prf::recognises(&lines) => return prf::read(source, &lines),
        Some(_) if is_mesh(&lines) => {
            let what = "a mesh of triangles; write x, y and heights of its points as columns".to_owned();
            return Err(source.unsupported(what));
        }
        _ => {}
    }
    let (found, rest) = blocks(&lines);
    let mut blocks = Vec::new();
    for block in found {
        if is_divisible(source, &block)? {
            blocks.extend(block.split_at_empty_lines());
        } else {
            blocks.push(block);
        }
    }
    if blocks.is_empty() {
        return Err(without_rows(source, &rest));
    }
    let headers: Vec<Header> =
        blocks.iter().map(|block| Header::read(source, &block.header)).collect::<Result<_, _>>()?;
    let names = headers.iter().zip(&blocks);
    let names = names.map(|(header, block)| header.name.clone().unwrap_or_else(|| block.title()));
    let chosen = source.choose(names.collect())?;
    // a block without a header of its own has that of the first
    let described = if headers[chosen].is_known { chosen } else { 0 };
    read_block(source, &blocks[chosen], &blocks[described].header, &rest)
}

/// Whether the first line is that of a mesh in the formats PLY or OBJ.
fn is_mesh(lines: &[Line<'_>]) -> bool {
    let begins = |line: &str| ["v ", "o ", "g ", "mtllib "].iter().any(|word| line.starts_with(word));
    let mut filled = lines.iter().map(|(_, line)| line.trim()).filter(|line| !line.is_empty());
    filled.clone().next() == Some("ply") || filled.find(|line| !line.starts_with('#')).is_some_and(begins)
}

/// Whether empty lines divide the rows of a block into surfaces: not those of lists of positions, and not where the
/// header counts the points.
fn is_divisible(source: Source<'_>, block: &Block<'_>) -> Result<bool, Error> {
    if block.division().is_none() || block.is_labelled {
        return Ok(false);
    }
    let columns = block.columns();
    let style = Style::of(source, &block.rows)?;
    let is_counted = Header::read(source, &block.header)?.counts().iter().all(Option::is_some);
    Ok(columns != POSITIONS && !is_counted && Titles::read(&block.header, style, columns).is_none())
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
    warnings.extend(style.doubt.map(str::to_owned));
    if let Some((number, line)) = rest.first() {
        let more = rest.len() - 1;
        let more = if more > 0 { format!(" and {more} more lines") } else { String::new() };
        warnings.push(format!(
            "line {number}: \"{}\"{more} behind the heights is not understood",
            shortened(line)
        ));
    }
    let labels = usize::from(block.is_labelled);
    // columns that hold nothing need no title
    let counts = (0..=table.undefined_columns_at_end()).map(|nothing| table.columns + labels - nothing);
    let titles = counts.filter(|count| *count > 0).find_map(|count| Titles::read(header, style, count));
    if let Some((titles, _)) = titles.as_ref().filter(|_| block.is_labelled) {
        let names = titles.names();
        return Err(
            source.unsupported(format!("rows with a label each below the titles {names}: no surface"))
        );
    }
    let corner = match (&titles, header.last()) {
        (None, Some((_, line))) if !block.is_labelled => Corner::read(line, style, table.columns),
        _ => None,
    };
    let used = titles.as_ref().map_or(usize::from(corner.is_some()), |(_, lines)| *lines);
    let header = Header::read(source, &header[..header.len() - used])?;
    let titles = titles.map(|(titles, _)| titles);
    let division = block.division();
    Content { source, header: &header, titles: titles.as_ref(), table, corner, division, warnings }.arrange()
}
