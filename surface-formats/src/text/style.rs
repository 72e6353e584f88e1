//! Separators and decimal marks of a block of rows.

use super::number::{Decimal, Evidence, evidence, is_grouped, is_undefined, parse_height};
use crate::error::Error;
use crate::source::{Source, shortened};

/// A line of the file and its number, counted from 1.
pub(super) type Line<'a> = (usize, &'a str);

/// Separator of the fields of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Separator {
    /// Any number of blanks and tabs.
    Blanks,
    /// One tab.
    Tab,
    Comma,
    Semicolon,
    /// Nothing: one number a line, whose commas are decimal.
    None,
}

/// Separator and decimal mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Style {
    pub(super) separator: Separator,
    pub(super) decimal: Decimal,
    /// The reading that was taken where another one was possible.
    pub(super) doubt: Option<&'static str>,
}

impl Separator {
    /// The fields of a line without quotes and blanks around them; a separator at the end of the line is
    /// followed by no field.
    pub(super) fn split(self, line: &str) -> Vec<&str> {
        let mark = match self {
            Self::Blanks => return line.split_whitespace().map(unquoted).collect(),
            Self::None => return vec![unquoted(line)],
            Self::Tab => '\t',
            Self::Comma => ',',
            Self::Semicolon => ';',
        };
        let line = line.trim_end_matches(' ');
        let line = line.strip_suffix(mark).unwrap_or(line);
        split_outside_quotes(line, mark).into_iter().map(unquoted).collect()
    }

    /// Whether a separator that is no blank ends the line.
    pub(super) fn ends(self, line: &str) -> bool {
        let line = line.trim_end_matches(' ');
        match self {
            Self::Blanks | Self::None => false,
            Self::Tab => line.ends_with('\t'),
            Self::Comma => line.ends_with(','),
            Self::Semicolon => line.ends_with(';'),
        }
    }
}

/// Parts of `line` between those of the marks `mark` that stand outside of double quotes.
fn split_outside_quotes(line: &str, mark: char) -> Vec<&str> {
    let mut is_quoted = false;
    line.split(|letter| {
        is_quoted ^= letter == '"';
        letter == mark && !is_quoted
    })
    .collect()
}

/// A field without blanks and quotes around it.
pub(super) fn unquoted(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')).unwrap_or(field).trim()
}

/// Whether `mark` stands in the line outside of quotes.
fn has_outside_quotes(line: &str, mark: char) -> bool {
    line.contains(mark) && split_outside_quotes(line, mark).len() > 1
}

/// Whether a number has digits on both sides of its only comma, if it has one.
fn may_have_decimal_comma(number: &str) -> bool {
    number.split_once(',').is_none_or(|(whole, rest)| {
        whole.ends_with(|c: char| c.is_ascii_digit())
            && rest.starts_with(|c: char| c.is_ascii_digit())
            && !rest.contains(',')
    })
}

impl Style {
    /// The style in which all `lines` are rows of numbers.
    pub(super) fn of(source: Source<'_>, lines: &[Line<'_>]) -> Result<Self, Error> {
        Self::found(lines).map_err(|clash| source.corrupt(clash))
    }

    /// The style of a single line.
    pub(super) fn of_line(line: &str) -> Result<Self, String> {
        Self::found(&[(1, line)])
    }

    /// The style of `lines`; the error names two decimal marks that contradict each other.
    fn found(lines: &[Line<'_>]) -> Result<Self, String> {
        let (separator, is_doubtful) = separator_of(lines);
        if separator == Separator::None {
            let doubt =
                is_doubtful.then_some("commas are read as decimal marks, not as separators of two columns");
            return Ok(Self { separator, decimal: Decimal::Comma, doubt });
        }
        let decimal = decimal_of(lines, separator)?;
        let doubt = if is_doubtful {
            Some("commas are read as separators of two columns, not as decimal marks")
        } else if decimal == Decimal::Comma && may_be_thousands(lines, separator) {
            Some("commas are read as decimal marks, not as marks of thousands")
        } else {
            None
        };
        Ok(Self { separator, decimal, doubt })
    }
}

/// Whether all commas within numbers stand before three digits and behind one to three that are not zero.
fn may_be_thousands(lines: &[Line<'_>], separator: Separator) -> bool {
    let mut fields =
        lines.iter().flat_map(|(_, line)| separator.split(line)).filter(|field| field.contains(','));
    fields.all(|field| {
        let digits = field.trim_start_matches(['+', '-']);
        is_grouped(digits, ',') && !digits.starts_with('0')
    })
}

/// The separator of the rows `lines`, and whether another one was possible.
fn separator_of(lines: &[Line<'_>]) -> (Separator, bool) {
    let any = |mark: char| lines.iter().any(|(_, line)| has_outside_quotes(line, mark));
    if any(';') {
        return (Separator::Semicolon, false);
    }
    let trimmed_tab = lines.iter().any(|(_, line)| line.trim().contains('\t'));
    if trimmed_tab {
        // tabs among blanks are blanks
        let holds_several = |field: &str| !is_undefined(field) && field.split_whitespace().nth(1).is_some();
        let mixed = lines.iter().any(|(_, line)| line.split('\t').any(|f| holds_several(unquoted(f))));
        return (if mixed { Separator::Blanks } else { Separator::Tab }, false);
    }
    if !any(',') {
        return (Separator::Blanks, false);
    }
    let several = lines.iter().any(|(_, line)| line.split_whitespace().nth(1).is_some());
    if several {
        let decimal = lines.iter().all(|(_, line)| line.split_whitespace().all(may_have_decimal_comma));
        return (if decimal { Separator::Blanks } else { Separator::Comma }, false);
    }
    let (is_column, is_doubtful) = decimal_commas_in_one_column(lines);
    (if is_column { Separator::None } else { Separator::Comma }, is_doubtful)
}

/// Whether lines with one comma each are rather numbers with a decimal comma than pairs, and whether both could be.
///
/// Pairs are taken where the first numbers rise or fall all along, as positions do, or where all second numbers
/// have one digit.
fn decimal_commas_in_one_column(lines: &[Line<'_>]) -> (bool, bool) {
    let pairs: Option<Vec<(f64, &str)>> = lines
        .iter()
        .map(|(_, line)| {
            let (whole, rest) = line.trim().split_once(',')?;
            let digits = !rest.is_empty() && rest.chars().all(|c| c.is_ascii_digit());
            let sign = whole.trim_start_matches(['+', '-']);
            let is_whole = !sign.is_empty() && sign.chars().all(|c| c.is_ascii_digit());
            (digits && is_whole).then(|| Some((whole.parse::<f64>().ok()?, rest)))?
        })
        .collect();
    let Some(pairs) = pairs else { return (false, false) };
    let rises = pairs.windows(2).all(|pair| pair[0].0 < pair[1].0);
    let falls = pairs.windows(2).all(|pair| pair[0].0 > pair[1].0);
    let has_digits = pairs.iter().any(|(_, rest)| rest.len() > 1);
    (has_digits && !rises && !falls, has_digits)
}

/// The decimal mark of the fields of `lines`; the error names two that contradict each other.
fn decimal_of(lines: &[Line<'_>], separator: Separator) -> Result<Decimal, String> {
    // the first line with each kind of number
    let (mut point, mut comma, mut points, mut commas) = (None, None, None, None);
    for (number, line) in lines {
        if !line.contains([',', '.']) {
            continue;
        }
        for field in separator.split(line) {
            let found = match evidence(field) {
                Evidence::None => continue,
                Evidence::Point => &mut point,
                Evidence::Comma => &mut comma,
                Evidence::PointWithThousands => &mut points,
                Evidence::CommaWithThousands => &mut commas,
            };
            found.get_or_insert((*number, field));
        }
    }
    let clash = |(first, a): (usize, &str), (second, b): (usize, &str)| {
        Err(format!(
            "line {first}: \"{}\" and line {second}: \"{}\" have different decimal marks",
            shortened(a),
            shortened(b)
        ))
    };
    match (point, comma, points, commas) {
        (_, _, Some(a), Some(b)) => clash(a, b),
        (_, Some((_, b)), Some(a), None) if !is_grouped(b.trim_start_matches(['+', '-']), ',') => {
            clash(a, comma.unwrap_or(a))
        }
        (_, _, Some(_), None) => Ok(Decimal::PointWithThousands),
        (Some((_, a)), _, None, Some(b)) if !is_grouped(a.trim_start_matches(['+', '-']), '.') => {
            clash(point.unwrap_or(b), b)
        }
        (_, _, None, Some(_)) => Ok(Decimal::CommaWithThousands),
        (Some(a), Some(b), None, None) => clash(a, b),
        (None, Some(_), None, None) => Ok(Decimal::Comma),
        _ => Ok(Decimal::Point),
    }
}

/// The fields of a line that are not empty, whatever separates them.
pub(super) fn loose_fields(line: &str) -> impl Iterator<Item = &str> {
    let mut is_quoted = false;
    let is_separator = move |letter: char| {
        is_quoted ^= letter == '"';
        !is_quoted && matches!(letter, ',' | ';' | '\t' | ' ')
    };
    line.split(is_separator).map(unquoted).filter(|field| !field.is_empty())
}

/// The number in a field, NaN of a marker, whatever its decimal mark.
pub(super) fn loose_number(field: &str) -> Option<f64> {
    parse_height(field).or_else(|| parse_height(&field.replace(',', "")))
}

/// Whether a line is one of a table: all its fields, however separated, are numbers or markers, or one of them
/// is a number.
pub(super) fn is_like_row(line: &str) -> bool {
    let mut fields = loose_fields(line).peekable();
    if fields.peek().is_none() {
        return line.contains([',', ';']);
    }
    let (mut any, mut all) = (false, true);
    for field in fields {
        match loose_number(field) {
            Some(number) => any |= number.is_finite(),
            None => all = false,
        }
    }
    any || all
}
