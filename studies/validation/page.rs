//! Files of the study: numbers, figures, and the parts of the page of the book that are made from them.

use std::error::Error;
use std::path::Path;

use crate::report::{CSV_HEADER, Row};

/// Writes all numbers to the file `csv` and the figures into `folder`.
pub(crate) fn write_files(rows: &[Row], csv: &Path, folder: &Path) -> Result<(), Box<dyn Error>> {
    let numbers: String = rows.iter().map(Row::csv).collect();
    std::fs::write(csv, format!("{CSV_HEADER}\n{numbers}"))?;
    for (name, figure) in rows.iter().flat_map(|row| &row.figures) {
        figure.write(&folder.join(format!("{name}.svg")))?;
    }
    Ok(())
}

/// Renews the tables of `validation.md` in `folder`, between `<!-- NAME -->` and `<!-- /NAME -->`, and the files beside it.
pub(crate) fn renew(rows: &[Row], folder: &Path) -> Result<(), Box<dyn Error>> {
    let path = folder.join("validation.md");
    let mut page = std::fs::read_to_string(&path)?;
    let lines: Vec<String> = rows.iter().map(Row::trust_line).collect();
    let trust =
        format!("| compared | reference | range | deviation |\n|---|---|---|---|\n{}\n", lines.join("\n"));
    page = replaced(&page, "trust", &trust)?;
    for row in rows {
        page = replaced(&page, row.name, &row.table())?;
    }
    std::fs::write(&path, page)?;
    let figures = folder.join("validation");
    std::fs::create_dir_all(&figures)?;
    write_files(rows, &folder.join("validation.csv"), &figures)
}

fn replaced(page: &str, name: &str, text: &str) -> Result<String, Box<dyn Error>> {
    let (start, end) = (format!("<!-- {name} -->\n"), format!("<!-- /{name} -->"));
    let parts = page.split_once(&start).and_then(|(head, rest)| Some((head, rest.split_once(&end)?.1)));
    let (head, tail) = parts.ok_or_else(|| format!("the page has no part between {start}and {end}"))?;
    Ok(format!("{head}{start}{text}{end}{tail}"))
}
