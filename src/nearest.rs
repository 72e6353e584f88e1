//! Names that resemble an unknown one, for error messages.

/// Most names that a message offers.
const OFFERED: usize = 3;

/// The names of `known` that are closest to `name` by the number of changed letters, the closest first.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let mut ranked: Vec<(usize, &str)> = known
        .into_iter()
        .map(|other| {
            let part = !name.is_empty() && (other.contains(name) || name.contains(other));
            (if part { 0 } else { changes(name, other) }, other)
        })
        .collect();
    ranked.sort_unstable();
    ranked.dedup();
    ranked.into_iter().take(OFFERED).map(|(_, other)| other).collect()
}

/// Letters to insert, delete or replace between two words (Levenshtein).
fn changes(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().collect();
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (i, letter) in one.chars().enumerate() {
        let mut diagonal = i;
        let mut left = i + 1;
        for (j, known) in other.iter().enumerate() {
            let above = row[j + 1];
            let next = (diagonal + usize::from(letter != *known)).min(above + 1).min(left + 1);
            row[j] = left;
            (diagonal, left) = (above, next);
        }
        if let Some(last) = row.last_mut() {
            *last = left;
        }
    }
    row.last().copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_are_the_levenshtein_distance() {
        for (one, other, expected) in
            [("kitten", "sitting", 3), ("", "abc", 3), ("abc", "", 3), ("abc", "abc", 0)]
        {
            assert_eq!(changes(one, other), expected, "{one} {other}");
        }
    }

    #[test]
    fn closest_names_come_first_and_once() {
        assert_eq!(nearest("init", ["grid.x", "unit", "grid.x", "unit"]), ["unit", "grid.x"]);
        assert_eq!(nearest("stell", ["glass", "steel", "ptfe"])[0], "steel");
    }
}
