//! Explanations of keys and warnings from the pages of the book.

use super::explain_output::output;
use super::markdown::{cells, plain, quoted};
use crate::error::{InputError, escape};
use crate::nearest::nearest;

/// Pages with tables of keys.
const PAGES: [(&str, &str); 8] = [
    ("docs/scene_contact.md", include_str!("../../../docs/scene_contact.md")),
    ("docs/scene_bodies.md", include_str!("../../../docs/scene_bodies.md")),
    ("docs/scene_fluid.md", include_str!("../../../docs/scene_fluid.md")),
    ("docs/scene_laws.md", include_str!("../../../docs/scene_laws.md")),
    ("docs/scene_history.md", include_str!("../../../docs/scene_history.md")),
    ("docs/cycles.md", include_str!("../../../docs/cycles.md")),
    ("docs/given_film.md", include_str!("../../../docs/given_film.md")),
    ("docs/flat_contact.md", include_str!("../../../docs/flat_contact.md")),
];
/// The page with the table of warnings, and the heading above it.
const WARNINGS: (&str, &str) = ("docs/errors.md", include_str!("../../../docs/errors.md"));
const WARNINGS_HEADING: &str = "## Warnings";
/// Least number of common words of a warning and its row.
const COMMON_WORDS: usize = 3;

/// A row of a table of keys.
struct Row {
    page: &'static str,
    /// Tables of the scene that the row belongs to: `form`, or `materials.ball` and `materials.disc`.
    tables: Vec<String>,
    /// Keys in the first cell.
    keys: Vec<String>,
    /// Whether the table lists keys; others list values.
    lists_keys: bool,
    /// Whether the row is that of a key whose values are listed: the table has the key as its first heading.
    lists_values: bool,
    /// Headings and cells.
    cells: Vec<(String, String)>,
}

/// Explains a key of scene files (`lubricant.alpha`, `alpha`), a table, a result (`film.lambda`) or a warning by its text, in the words of the book. An empty text
/// lists all tables with their keys.
///
/// ```
/// use stribeck::sim::scene::explain;
/// let text = explain("form.radius")?;
/// assert!(text.contains("radius of the ball") && text.contains("docs/scene_contact.md"));
/// let error = explain("form.raduis").unwrap_err().to_string();
/// assert!(error.contains("form.radius"), "{error}");
/// assert!(explain("the mean shear stress of the Newtonian fluid is 60 MPa")?.contains("carreau"));
/// # Ok::<(), stribeck::InputError>(())
/// ```
///
/// # Errors
/// A text that is neither a key nor a warning; the error lists the keys closest to it.
pub fn explain(text: &str) -> Result<String, InputError> {
    let rows: Vec<Row> = PAGES.iter().flat_map(|(page, content)| rows(page, content)).collect();
    let asked = text.trim().trim_matches(['[', ']', '`']);
    if asked.is_empty() {
        return Ok(all_tables(&rows));
    }
    let found: Vec<String> = rows.iter().filter_map(|row| row.explained(asked)).collect();
    if !found.is_empty() {
        return Ok(found.join("\n\n"));
    }
    if let Some(result) = output(asked) {
        return Ok(result);
    }
    if let Some(warning) = warning(text) {
        return Ok(warning);
    }
    let paths: Vec<String> = rows.iter().flat_map(Row::paths).collect();
    let near = nearest(asked, paths.iter().map(String::as_str));
    Err(InputError::Conflict {
        field: format!("\"{}\"", escape(text)),
        reason: format!(
            "is neither a key of a scene nor a result nor a warning; the nearest keys: {}",
            near.join(", ")
        ),
    })
}

impl Row {
    /// The row of the key in the first `heading` of a table of its values, without values.
    fn of_values(page: &'static str, tables: &[String], heading: &str) -> Option<Self> {
        let keys = if heading.starts_with('`') { quoted(heading) } else { Vec::new() };
        let row = Self {
            page,
            tables: tables.to_vec(),
            keys,
            lists_keys: false,
            lists_values: true,
            cells: Vec::new(),
        };
        (!row.keys.is_empty() && !row.tables.is_empty()).then_some(row)
    }

    /// Full paths of the keys.
    fn paths(&self) -> Vec<String> {
        let of = |table: &String| self.keys.iter().map(|key| format!("{table}.{key}")).collect::<Vec<_>>();
        self.tables.iter().flat_map(of).collect()
    }

    /// The explanation, if `asked` is a key of this row, alone or with its table, or its table.
    fn explained(&self, asked: &str) -> Option<String> {
        let (table, key) = asked.rsplit_once('.').map_or(("", asked), |(table, key)| (table, key));
        let within = |own: &str| own.strip_prefix(asked).is_some_and(|rest| rest.starts_with('.'));
        let is_table = self.tables.iter().any(|own| own == asked || within(own));
        let is_key = self.keys.iter().any(|own| own == asked)
            || (self.keys.iter().any(|own| own == key)
                && (table.is_empty() || self.tables.iter().any(|own| own == table)));
        if !is_table && !is_key {
            return None;
        }
        let heading = format!("[{}] {}", self.tables.join("], ["), self.keys.join(", "));
        let cells = self.cells.iter().filter(|(_, cell)| !cell.is_empty());
        let lines = cells.map(|(name, cell)| format!("  {name}: {cell}"));
        let page = std::iter::once(format!("  page: {}", self.page));
        Some(std::iter::once(heading).chain(lines).chain(page).collect::<Vec<_>>().join("\n"))
    }
}

/// All tables with their keys, a table a line.
fn all_tables(rows: &[Row]) -> String {
    let mut lines: Vec<(String, Vec<&str>)> = Vec::new();
    for row in rows.iter().filter(|row| row.lists_keys || row.lists_values) {
        let heading = format!("[{}]", row.tables.join("], ["));
        if lines.iter().all(|(known, _)| *known != heading) {
            lines.push((heading.clone(), Vec::new()));
        }
        for (_, list) in lines.iter_mut().filter(|(known, _)| *known == heading) {
            let new = row.keys.iter().filter(|key| !list.contains(&key.as_str()));
            list.extend(new.map(String::as_str).collect::<Vec<_>>());
        }
    }
    let lines = lines.iter().map(|(heading, keys)| format!("{heading} {}", keys.join(", ")));
    lines.collect::<Vec<_>>().join("\n")
}

/// All rows of keys of a page.
fn rows(page: &'static str, content: &str) -> Vec<Row> {
    let (mut found, mut tables, mut headings) = (Vec::new(), Vec::new(), Vec::new());
    let mut previous_is_row = false;
    for line in content.lines() {
        if line.starts_with('#') {
            let named = bracketed(line);
            if !named.is_empty() {
                tables = named;
            } else if line.starts_with("## ") {
                tables = Vec::new();
            }
        }
        let Some(cells) = cells(line) else {
            previous_is_row = false;
            continue;
        };
        if !previous_is_row {
            found.extend(cells.first().and_then(|heading| Row::of_values(page, &tables, heading)));
            headings = cells;
        } else if let Some((first, rest)) = cells.split_first() {
            let keys = quoted(first);
            if !keys.is_empty() && !tables.is_empty() {
                let named = headings.iter().skip(1).zip(rest);
                let cells = named.map(|(heading, cell)| (plain(heading), plain(cell))).collect();
                let lists_keys = headings.first().is_some_and(|heading: &String| heading == "key");
                let key = found.iter_mut().rev().find(|row: &&mut Row| row.lists_values);
                let lists_values = headings.first().is_some_and(|heading: &String| heading.starts_with('`'));
                if let Some(key) = key.filter(|_| lists_values) {
                    key.cells.push((plain(first), rest.first().map_or_else(String::new, |cell| plain(cell))));
                }
                found.push(Row {
                    page,
                    tables: tables.clone(),
                    keys,
                    lists_keys,
                    lists_values: false,
                    cells,
                });
            }
        }
        previous_is_row = true;
    }
    found
}

/// The row of the table of warnings that shares the most words with `text`.
fn warning(text: &str) -> Option<String> {
    let words = |text: &str| -> Vec<String> {
        let words = text.split(|c: char| !c.is_alphabetic()).filter(|word| word.len() > 3);
        words.map(str::to_lowercase).collect()
    };
    let asked = words(text);
    let (_, table) = WARNINGS.1.split_once(WARNINGS_HEADING)?;
    let rows = table.lines().filter_map(cells).skip(2);
    let scored = rows.filter_map(|cells| {
        let own = words(&cells.join(" "));
        let common = asked.iter().filter(|word| own.contains(word)).count();
        (common >= COMMON_WORDS).then_some((common, cells))
    });
    let (_, cells) = scored.max_by_key(|(common, _)| *common)?;
    let [about, place, ..] = cells.as_slice() else { return None };
    Some(format!("warning about {}\n  where: {}\n  page: {}", plain(about), plain(place), WARNINGS.0))
}

/// Names of tables in a heading: `[form]` in backquotes.
fn bracketed(line: &str) -> Vec<String> {
    let names = quoted(line).into_iter();
    names.filter_map(|name| Some(name.strip_prefix('[')?.strip_suffix(']')?.to_owned())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sim::scene::keys::KEYS;

    #[test]
    fn every_key_with_a_dimension_is_explained() {
        let unknown: Vec<String> = KEYS
            .iter()
            .map(|(path, _)| path.replace('*', "ball"))
            .filter(|path| !path.starts_with("schedule.") && explain(path).is_err())
            .collect();
        assert!(unknown.is_empty(), "{unknown:?}");
    }

    #[test]
    fn tables_are_listed_and_explained_with_those_within() {
        let kinds = explain("roughness.disc.kind").unwrap();
        assert!(
            kinds.contains("\"gaussian\", \"exponential\": random") && kinds.contains("\"file\": measured"),
            "{kinds}"
        );
        assert!(explain("solver.kind").unwrap().contains("\"newton_krylov\": "));
        let all = explain("").unwrap();
        for table in ["[form] kind", "[given_film] kind", "[materials.ball], [materials.disc] material"] {
            assert!(all.contains(table), "{table}: {all}");
        }
        let materials = explain("materials").unwrap();
        assert!(materials.contains("[materials.ball], [materials.disc] hardness"), "{materials}");
        assert!(explain("elastic").unwrap().contains("[elastic.layer] thickness"));
    }

    #[test]
    fn links_and_quotes_are_plain_text() {
        assert_eq!(plain("a [b c](d.md#e) of `f` and [g](h)"), "a b c of f and g");
    }
}
