//! Keys and values of a line.

use super::keys::meaning;
use super::number::parse_height;
use super::style::{Separator, unquoted};
use crate::unit::LengthUnit;

/// Marks between a key and its value; the last is that of Japanese texts.
const MARKS: [char; 3] = ['=', ':', '\u{ff1a}'];
/// Separators of tables, which may take the place of the mark.
const SEPARATORS: [char; 3] = ['\t', ';', ','];

/// The pairs of a line; none where it holds a title or a sentence.
pub(super) fn pairs(line: &str) -> Vec<(String, String)> {
    let pair = |key: &str, value: &str| vec![(unquoted(key).to_owned(), unquoted(value).to_owned())];
    let equals: Vec<usize> = line.match_indices('=').map(|(at, _)| at).collect();
    if equals.len() > 1 {
        return several(line, &equals);
    }
    let mark = line.char_indices().find(|(_, letter)| MARKS.contains(letter) || SEPARATORS.contains(letter));
    let Some((at, mark)) = mark else {
        return by_blank(line).map_or_else(Vec::new, |(key, value)| pair(key, value));
    };
    if MARKS.contains(&mark) {
        return pair(&line[..at], &line[at + mark.len_utf8()..]);
    }
    // an equals sign is stronger than a comma within its key
    if let [at] = *equals.as_slice() {
        return pair(&line[..at], &line[at + 1..]);
    }
    let separator = match mark {
        '\t' => Separator::Tab,
        ';' => Separator::Semicolon,
        _ => Separator::Comma,
    };
    let fields = separator.split(line);
    let value: Vec<&str> = fields.iter().skip(1).copied().filter(|field| !field.is_empty()).collect();
    match fields.first() {
        // the value and its unit are the next two fields
        Some(key) if !key.is_empty() && fields.len() > 1 => {
            pair(key.trim_end_matches(MARKS), value.join(" ").trim_start_matches(MARKS))
        }
        _ => Vec::new(),
    }
}

/// `h=3 w=4`: keys are all between a value and the next mark.
fn several(line: &str, equals: &[usize]) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut key = line[..equals[0]].trim();
    for (k, at) in equals.iter().enumerate() {
        let end = equals.get(k + 1).copied().unwrap_or(line.len());
        let between = line[at + 1..end].trim();
        let value = if k + 1 == equals.len() { between } else { leading_value(between) };
        found.push((key.to_owned(), value.trim_end_matches([',', ';']).to_owned()));
        key = between[value.len()..].trim_matches([' ', ',', ';', '\t']);
    }
    found
}

/// The first word, with the unit of length that may follow it.
fn leading_value(text: &str) -> &str {
    let end_of_word = |from: usize| {
        let rest = &text[from..];
        let begin = rest.len() - rest.trim_start().len();
        from + begin + rest[begin..].find(char::is_whitespace).unwrap_or(rest.len() - begin)
    };
    let first = end_of_word(0);
    let second = end_of_word(first);
    let unit = text[first..second].trim().trim_matches(['[', ']', '(', ')', ',', ';']);
    if LengthUnit::parse(unit).is_some() { &text[..second] } else { &text[..first] }
}

/// `ncols 4`: the last word is a number, or a marker behind a known key.
fn by_blank(line: &str) -> Option<(&str, &str)> {
    let (key, value) = line.rsplit_once(char::is_whitespace)?;
    parse_height(value).filter(|number| number.is_finite() || meaning(&plain_key(key)).is_some())?;
    Some((key.trim(), value))
}

/// A key in small letters, with blanks for hyphens and underscores.
pub(super) fn plain_key(key: &str) -> String {
    let spaced = key.to_lowercase().replace(['-', '_', '\u{a0}'], " ");
    spaced.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A title and the unit of length that follows it in brackets.
pub(super) fn split_unit(title: &str) -> (&str, &str) {
    let title = title.trim();
    let inside = title.strip_suffix([')', ']']).and_then(|rest| rest.rsplit_once(['(', '[']));
    match inside {
        Some((title, unit)) if LengthUnit::parse(unit).is_some() => (title.trim(), unit.trim()),
        _ => (title, ""),
    }
}

/// A title and its unit of length in words, `heights in um`.
pub(super) fn unit_in_words(title: &str) -> Option<(&str, &str)> {
    let (title, unit) = title.trim().rsplit_once(" in ")?;
    LengthUnit::parse(unit).map(|_| (title.trim(), unit.trim()))
}

/// A finite number, perhaps with a decimal comma, and the unit that follows it.
pub(super) fn quantity(text: &str) -> Option<(f64, &str)> {
    let text = text.trim();
    let is_number = |c: char| matches!(c, '0'..='9' | '+' | '-' | '.' | ',' | 'e' | 'E' | 'D');
    let end = text.find(|c: char| !is_number(c)).unwrap_or(text.len());
    let number = text[..end].trim_end_matches(',').replacen(',', ".", 1);
    let value = parse_height(&number).filter(|value| value.is_finite())?;
    let unit = text[end..].trim().trim_start_matches(['(', '[', ',', ';']).trim_end_matches([')', ']']);
    Some((value, unit.trim()))
}
