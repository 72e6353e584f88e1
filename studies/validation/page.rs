//! Files of the study: numbers, figures, and the parts of the page of the book that are made from them.

use std::error::Error;
use std::path::Path;

use crate::report::{CSV_HEADER, Row};

/// Writes all numbers to the file `csv` and the figures into `folder`.
pub(crate) fn write_files(rows: &[Row], csv: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let numbers: String = rows.iter().map(Row::csv).collect();
    std::fs::write(csv, format!("{CSV_HEADER}\n{numbers}"))?;
    write_figures(rows, folder)
}

fn write_figures(rows: &[Row], folder: &Path) -> Result<(), Box<dyn Error>> {
    for (name, figure) in rows.iter().flat_map(|row| &row.figures) {
        figure.write(&folder.join(format!("{name}.svg")))?;
    }
    Ok(())
}

/// Renews the tables of `rows` in `validation.md` of `folder`, between `<!-- NAME -->` and `<!-- /NAME -->`, their lines in the
/// table of all rows, and their part of the files beside it.
pub(crate) fn renew(rows: &[Row], folder: &Path) -> Result<(), Box<dyn Error>> {
    let path = folder.join("validation.md");
    let mut page = std::fs::read_to_string(&path)?;
    for row in rows {
        let is_own = |line: &str| line.starts_with('|') && line.contains(&format!("](#{})", row.anchor()));
        page = renewed(&page, &row.trust_line(), is_own)
            .ok_or_else(|| format!("the table of all rows has no line that links to #{}", row.anchor()))?;
        page = replaced(&page, row.name, &row.table())?;
    }
    std::fs::write(&path, page)?;
    let csv = folder.join("validation.csv");
    let mut numbers = std::fs::read_to_string(&csv)?;
    for row in rows {
        let is_own = |line: &str| line.starts_with(&format!("{},", row.name));
        let own = row.csv();
        numbers = renewed(&numbers, own.trim_end(), is_own).unwrap_or_else(|| format!("{numbers}{own}"));
    }
    let figures = folder.join("validation");
    std::fs::create_dir_all(&figures)?;
    std::fs::write(csv, numbers)?;
    write_figures(rows, &figures)
}

/// The lines of `text` with `own` in place of those that `is_own` finds; `None` where it finds none.
fn renewed(text: &str, own: &str, is_own: impl Fn(&str) -> bool) -> Option<String> {
    let first = text.lines().position(&is_own)?;
    let lines = text.lines().enumerate().filter(|(k, line)| *k == first || !is_own(line));
    let lines: Vec<&str> = lines.map(|(k, line)| if k == first { own } else { line }).collect();
    Some(lines.join("\n") + "\n")
}

fn replaced(page: &str, name: &str, text: &str) -> Result<String, Box<dyn Error>> {
    let (start, end) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let parts = page.split_once(&start).and_then(|(head, rest)| Some((head, rest.split_once(&end)?.1)));
    let (head, tail) = parts.ok_or_else(|| format!("the page has no part between {start}and {end}"))?;
    Ok(format!("{head}{start}{text}{end}{tail}"))
}
