//! Numbers and markers of undefined points in text.

use std::borrow::Cow;

/// How the numbers of a file are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Decimal {
    /// `1250.5`
    Point,
    /// `1,250.5`
    PointWithThousands,
    /// `1250,5`
    Comma,
    /// `1.250,5`
    CommaWithThousands,
}

impl Decimal {
    /// The height in a field, NaN where undefined; `None` for a field that is neither.
    pub(super) fn parse(self, field: &str) -> Option<f64> {
        match self {
            Self::Point => parse_height(field),
            Self::PointWithThousands => parse_height(&field.replace(',', "")),
            Self::Comma => parse_height(&field.replacen(',', ".", 1)),
            Self::CommaWithThousands => parse_height(&field.replace('.', "").replacen(',', ".", 1)),
        }
    }
}

/// A height of a text file, NaN where undefined; `None` for text that is neither a finite number nor a marker
/// of undefined points. The exponent may be that of Fortran (`1.0D-6`).
pub(crate) fn parse_height(field: &str) -> Option<f64> {
    let field = field.trim();
    if is_undefined(field) {
        return Some(f64::NAN);
    }
    let begins = field.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.' | '\u{2212}'));
    if !begins {
        return None;
    }
    let number = match field.parse::<f64>() {
        Ok(number) => number,
        Err(_) => field.replace(['D', 'd'], "e").replace('\u{2212}', "-").parse().ok()?,
    };
    number.is_finite().then_some(number)
}

/// Whether a field marks an undefined point.
pub(super) fn is_undefined(field: &str) -> bool {
    let only = |mark: char| field.chars().all(|letter| letter == mark);
    // an empty field is one, too
    if only('-') || only('*') || only('?') {
        return true;
    }
    let word = field.trim_start_matches(['+', '-']).to_ascii_lowercase();
    matches!(
        word.as_str(),
        "nan"
            | "inf"
            | "infinity"
            | "bad"
            | "na"
            | "n/a"
            | "#n/a"
            | "#num!"
            | "no data"
            | "no_data"
            | "nodata"
            | "null"
            | "none"
            | "void"
            | "undefined"
            | "invalid"
            | "missing"
            | "masked"
    ) || word.starts_with("1.#")
        || word.starts_with("nan(")
}

/// Form of a number with commas or points, as far as it tells the decimal mark of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Evidence {
    /// Says nothing.
    None,
    /// `1,250.5`
    PointWithThousands,
    /// `1.250,5`
    CommaWithThousands,
    /// `1.5`
    Point,
    /// `0,5`
    Comma,
}

/// Evidence of a field about the decimal mark.
pub(super) fn evidence(field: &str) -> Evidence {
    let digits = field.trim().trim_start_matches(['+', '-']);
    let end = digits.find(['e', 'E', 'd', 'D']).unwrap_or(digits.len());
    let mantissa = &digits[..end];
    if mantissa.is_empty() || !mantissa.chars().all(|c| c.is_ascii_digit() || matches!(c, ',' | '.')) {
        return Evidence::None;
    }
    match (mantissa.rfind(','), mantissa.rfind('.')) {
        (Some(comma), Some(point)) if comma < point && is_grouped(&mantissa[..point], ',') => {
            Evidence::PointWithThousands
        }
        (Some(comma), Some(point)) if point < comma && is_grouped(&mantissa[..comma], '.') => {
            Evidence::CommaWithThousands
        }
        (Some(_), Some(_)) => Evidence::None,
        (Some(_), None) if mantissa.matches(',').count() > 1 => {
            if is_grouped(mantissa, ',') {
                Evidence::PointWithThousands
            } else {
                Evidence::None
            }
        }
        (None, Some(_)) if mantissa.matches('.').count() > 1 => {
            if is_grouped(mantissa, '.') {
                Evidence::CommaWithThousands
            } else {
                Evidence::None
            }
        }
        (Some(_), None) => Evidence::Comma,
        (None, Some(_)) => Evidence::Point,
        (None, None) => Evidence::None,
    }
}

/// The text with plain blanks for others, and without those and apostrophes that stand as marks of thousands: between
/// a digit and three more, a blank of them only in a line of fields that something else separates.
pub(super) fn without_marks_of_thousands(text: &str) -> Cow<'_, str> {
    if !text.contains(|letter| is_other_blank(letter) || is_apostrophe(letter)) {
        return Cow::Borrowed(text);
    }
    let lines = text.split_inclusive(['\n', '\r']).map(|line| {
        let is_separated = line.trim_end_matches(['\n', '\r']).contains([',', ';', '\t', ' ']);
        let mut plain = String::with_capacity(line.len());
        for (at, letter) in line.char_indices() {
            let (is_blank, is_apostrophe) = (is_other_blank(letter), is_apostrophe(letter));
            let mut rest = line[at + letter.len_utf8()..].chars();
            let groups = plain.ends_with(|c: char| c.is_ascii_digit())
                && rest.by_ref().take(3).filter(char::is_ascii_digit).count() == 3
                && !rest.next().is_some_and(|c| c.is_ascii_digit());
            if groups && (is_apostrophe || is_blank && is_separated) {
                continue;
            }
            plain.push(if is_blank { ' ' } else { letter });
        }
        plain
    });
    Cow::Owned(lines.collect())
}

/// Whether a letter is a blank that does not break a line, or a thin one.
fn is_other_blank(letter: char) -> bool {
    matches!(letter, '\u{a0}' | '\u{2007}' | '\u{2009}' | '\u{202f}')
}

/// Whether a letter is an apostrophe.
fn is_apostrophe(letter: char) -> bool {
    matches!(letter, '\'' | '\u{2019}')
}

/// Whether digits stand in groups of three between marks.
pub(super) fn is_grouped(text: &str, mark: char) -> bool {
    let mut groups = text.split(mark);
    let first = groups.next().unwrap_or("");
    (1..=3).contains(&first.len()) && groups.all(|group| group.len() == 3)
}

/// Digits after the decimal mark, less the exponent: the last printed digit counts `10^-digits`.
pub(super) fn decimals(field: &str) -> i32 {
    let field = field.trim();
    let end = field.find(['e', 'E', 'd', 'D']).unwrap_or(field.len());
    let exponent: i32 = field.get(end + 1..).and_then(|text| text.parse().ok()).unwrap_or(0);
    let after = field[..end].rfind(['.', ',']).map_or(0, |mark| end - mark - 1);
    (after as i32).saturating_sub(exponent)
}

/// Digits of a number without its exponent and the zeros in front.
pub(super) fn significant_digits(field: &str) -> usize {
    let field = field.trim();
    let end = field.find(['e', 'E', 'd', 'D']).unwrap_or(field.len());
    let digits = field[..end].chars().filter(char::is_ascii_digit);
    digits.skip_while(|digit| *digit == '0').count()
}
