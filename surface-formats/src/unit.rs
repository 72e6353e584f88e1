//! Units of length in files.

use std::fmt;

/// Unit in which a file states a length; all lengths in memory are metres.
///
/// ```
/// use surface_formats::LengthUnit;
/// assert_eq!(LengthUnit::parse("µm"), Some(LengthUnit::Micrometre));
/// assert_eq!(LengthUnit::Nanometre.metres(), 1e-9);
/// assert_eq!(LengthUnit::parse("V"), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LengthUnit {
    /// km
    Kilometre,
    /// m
    Metre,
    /// cm
    Centimetre,
    /// mm
    Millimetre,
    /// um
    Micrometre,
    /// nm
    Nanometre,
    /// Angstrom, 0.1 nm
    Angstrom,
    /// pm
    Picometre,
    /// Inch, 25.4 mm
    Inch,
    /// mil, a thousandth of an inch
    Mil,
    /// Millionth of an inch, 25.4 nm
    Microinch,
}

impl LengthUnit {
    /// All units.
    const ALL: [Self; 11] = [
        Self::Kilometre,
        Self::Metre,
        Self::Centimetre,
        Self::Millimetre,
        Self::Micrometre,
        Self::Nanometre,
        Self::Angstrom,
        Self::Picometre,
        Self::Inch,
        Self::Mil,
        Self::Microinch,
    ];

    /// The unit with the symbol or name `text`, with the micro sign in any of its encodings.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        Some(match text {
            "km" => Self::Kilometre,
            "m" | "\u{43c}" => Self::Metre,
            "cm" => Self::Centimetre,
            "mm" | "MM" | "\u{43c}\u{43c}" => Self::Millimetre,
            // micro sign, Greek mu, the micro sign of an old code page read as Latin-1, and that of Nanoscope
            "um"
            | "UM"
            | "\u{b5}m"
            | "\u{3bc}m"
            | "\u{e6}m"
            | "~m"
            | "\u{43c}\u{43a}\u{43c}"
            | "\u{339b}" => Self::Micrometre,
            "nm" | "NM" | "\u{43d}\u{43c}" | "\u{339a}" => Self::Nanometre,
            "\u{c5}" | "\u{212b}" | "A" => Self::Angstrom,
            "pm" => Self::Picometre,
            "in" => Self::Inch,
            "mil" => Self::Mil,
            "uin" | "\u{b5}in" | "\u{3bc}in" => Self::Microinch,
            _ => return Self::parse_word(&text.to_lowercase()),
        })
    }

    /// The unit with the English name `word`, in the singular or plural.
    fn parse_word(word: &str) -> Option<Self> {
        let singular = word.strip_suffix('s').unwrap_or(word);
        let stem = singular.strip_suffix("meter").or_else(|| singular.strip_suffix("metre"));
        Some(match (stem, singular) {
            (Some(""), _) => Self::Metre,
            (Some("centi"), _) => Self::Centimetre,
            (Some("milli"), _) => Self::Millimetre,
            (Some("micro"), _) | (None, "micron") => Self::Micrometre,
            (Some("nano"), _) => Self::Nanometre,
            (Some("pico"), _) => Self::Picometre,
            (None, "angstrom" | "ang" | "\u{e5}ngstr\u{f6}m") => Self::Angstrom,
            (None, "inch" | "inche") => Self::Inch,
            (None, "mil" | "thou") => Self::Mil,
            (None, "microinch" | "microinche") => Self::Microinch,
            _ => return None,
        })
    }

    /// The unit of this length \[m\].
    pub(crate) fn of_length(metres: f64) -> Option<Self> {
        Self::ALL.into_iter().find(|unit| unit.metres().to_bits() == metres.to_bits())
    }

    /// Length of the unit \[m\].
    #[must_use]
    pub fn metres(self) -> f64 {
        match self {
            Self::Kilometre => 1e3,
            Self::Metre => 1.0,
            Self::Centimetre => 1e-2,
            Self::Millimetre => 1e-3,
            Self::Micrometre => 1e-6,
            Self::Nanometre => 1e-9,
            Self::Angstrom => 1e-10,
            Self::Picometre => 1e-12,
            Self::Inch => 25.4e-3,
            Self::Mil => 25.4e-6,
            Self::Microinch => 25.4e-9,
        }
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Kilometre => "km",
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Micrometre => "um",
            Self::Nanometre => "nm",
            Self::Angstrom => "Angstrom",
            Self::Picometre => "pm",
            Self::Inch => "in",
            Self::Mil => "mil",
            Self::Microinch => "uin",
        })
    }
}
