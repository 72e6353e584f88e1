//! Explanations of numbers that solves and runs write: names in JSON and columns of tables.

use super::markdown::{cells, plain, quoted};

/// The pages with the tables of results.
const PAGES: [(&str, &str); 5] = [
    ("docs/output.md", include_str!("../../../docs/output.md")),
    ("docs/given_film.md", include_str!("../../../docs/given_film.md")),
    ("docs/cycles.md", include_str!("../../../docs/cycles.md")),
    ("docs/running.md", include_str!("../../../docs/running.md")),
    ("docs/flat_contact.md", include_str!("../../../docs/flat_contact.md")),
];
/// Headings of the first column of these tables.
const HEADINGS: [&str; 4] = ["field", "column", "result", "number"];

/// How a result is asked for, the closest first.
const WAYS: [fn(&str, &str) -> bool; 2] = [is_name, is_ending];

/// The explanation of the result `asked`: as in JSON (`film.lambda`), as the column of a table (`film_lambda`, `friction_power_W`), without its
/// table (`kappa`), or a table (`error_estimate`), by its first entry.
pub(super) fn output(asked: &str) -> Option<String> {
    let by_name = WAYS.into_iter().find_map(|is_asked| {
        // Of names that are equally long that of the first page.
        let pages = PAGES.iter().rev();
        let length = |name: &str| is_asked(asked, name).then_some(name.len());
        let found = pages.filter_map(|(page, content)| row_of(length, page, content));
        found.max_by_key(|(length, _)| *length).map(|(_, text)| text)
    });
    let first = |name: &str| is_table(asked, name).then_some(1);
    by_name.or_else(|| PAGES.iter().find_map(|(page, content)| Some(row_of(first, page, content)?.1)))
}

/// The first row of `page` with a name of the largest `weight`, and this weight; names without weight are left out.
fn row_of(weight: impl Fn(&str) -> Option<usize>, page: &str, content: &str) -> Option<(usize, String)> {
    let (mut headings, mut best): (Vec<String>, Option<(usize, String)>) = (Vec::new(), None);
    for line in content.lines() {
        let Some(cells) = cells(line) else {
            headings.clear();
            continue;
        };
        if headings.is_empty() {
            headings = cells;
            continue;
        }
        let of_results =
            headings.first().is_some_and(|first| HEADINGS.iter().any(|known| first.starts_with(known)));
        // Rows that refer to another table have no meaning of their own.
        let has_meaning = of_results && cells.get(1).is_some_and(|meaning| meaning != "as above");
        let Some((names, rest)) = cells.split_first().filter(|_| has_meaning) else { continue };
        let weighted = quoted(names).into_iter().filter_map(|name| Some((weight(&name)?, name)));
        let Some((heaviest, name)) = weighted.max_by_key(|(weight, _)| *weight) else { continue };
        if best.as_ref().is_some_and(|(weight, _)| *weight >= heaviest) {
            continue;
        }
        let named = headings.iter().skip(1).zip(rest).filter(|(_, cell)| !cell.is_empty());
        let lines: String =
            named.map(|(heading, cell)| format!("\n  {}: {}", plain(heading), plain(cell))).collect();
        best = Some((heaviest, format!("result {name}{lines}\n  page: {page}")));
    }
    best
}

/// Whether `asked` is the result `name`, or its column: with underscores in place of dots, and perhaps a unit behind it.
fn is_name(asked: &str, name: &str) -> bool {
    let [asked, column] = [asked.to_lowercase(), name.to_lowercase().replace('.', "_")];
    asked == name.to_lowercase() || asked == column || asked.strip_prefix(&column).is_some_and(is_unit)
}

/// Whether `asked` is the last part of the result `name`, or a column with the ending `name`, as `_sd`.
fn is_ending(asked: &str, name: &str) -> bool {
    let of_table = name.strip_suffix(asked).is_some_and(|table| table.ends_with('.'));
    of_table || (name.starts_with('_') && asked.ends_with(name))
}

/// Whether `asked` is a table of results that holds `name`.
fn is_table(asked: &str, name: &str) -> bool {
    name.strip_prefix(asked).is_some_and(|rest| rest.starts_with('.'))
}

/// Whether the end of the name of a column is a unit.
fn is_unit(ending: &str) -> bool {
    [
        "_m", "_nm", "_um", "_pa", "_n", "_w", "_k", "_s", "_rad", "_m2", "_m3", "_m3_s", "_m_s", "_n_per_m",
        "_w_per_m",
    ]
    .contains(&ending)
}

#[cfg(test)]
mod tests {
    use super::output;

    #[test]
    fn results_are_explained_by_their_names_and_columns() {
        for (asked, part) in [
            ("film.lambda", "composite roughness"),
            ("film_lambda", "film.lambda"),
            ("pressure_max_Pa", "largest pressure"),
            ("friction_power_W", "friction force times sliding speed"),
            ("sommerfeld", "relative clearance"),
            ("least_film", "docs/given_film.md"),
            ("kappa", "viscosity ratio"),
            ("film.formula_central", "docs/running.md"),
            ("friction_coefficient_sd", "standard deviation"),
            ("error_estimate", "relative error of the central film"),
        ] {
            let text = output(asked).unwrap_or_default();
            assert!(text.contains(part), "{asked}: {text}");
        }
        assert!(output("film.nothing").is_none() && output("film_lambda_of_mine").is_none());
    }
}
