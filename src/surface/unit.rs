//! Units of length in files.

use std::fmt;

/// The unit in which a file states its heights; all lengths in memory are metres.
///
/// ```
/// use stribeck::surface::LengthUnit;
/// assert_eq!(LengthUnit::parse("µm"), Some(LengthUnit::Micrometre));
/// assert_eq!(LengthUnit::Nanometre.metres(), 1e-9);
/// assert_eq!(LengthUnit::parse("V"), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LengthUnit {
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
}

impl LengthUnit {
    /// The unit with the symbol `text` as files write it, with the micro sign in any of its encodings.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        Some(match text.trim() {
            "m" | "meter" | "metre" | "meters" | "metres" => Self::Metre,
            "cm" => Self::Centimetre,
            "mm" => Self::Millimetre,
            // micro sign, Greek mu, and the micro sign of an old code page read as Latin-1
            "um" | "\u{b5}m" | "\u{3bc}m" | "\u{e6}m" | "micron" | "microns" | "micrometer"
            | "micrometre" => Self::Micrometre,
            "nm" | "nanometer" | "nanometre" => Self::Nanometre,
            "\u{c5}" | "\u{212b}" | "A" | "angstrom" | "Angstrom" => Self::Angstrom,
            "pm" => Self::Picometre,
            "in" | "inch" => Self::Inch,
            _ => return None,
        })
    }

    /// The unit of this length \[m\].
    #[cfg(feature = "formats")]
    pub(super) fn of_length(metres: f64) -> Option<Self> {
        use LengthUnit::{Angstrom, Centimetre, Inch, Metre, Micrometre, Millimetre, Nanometre, Picometre};
        [Metre, Centimetre, Millimetre, Micrometre, Nanometre, Angstrom, Picometre, Inch]
            .into_iter()
            .find(|unit| unit.metres().to_bits() == metres.to_bits())
    }

    /// Length of the unit \[m\].
    #[must_use]
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Centimetre => 1e-2,
            Self::Millimetre => 1e-3,
            Self::Micrometre => 1e-6,
            Self::Nanometre => 1e-9,
            Self::Angstrom => 1e-10,
            Self::Picometre => 1e-12,
            Self::Inch => 25.4e-3,
        }
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Metre => "m",
            Self::Centimetre => "cm",
            Self::Millimetre => "mm",
            Self::Micrometre => "um",
            Self::Nanometre => "nm",
            Self::Angstrom => "Angstrom",
            Self::Picometre => "pm",
            Self::Inch => "in",
        })
    }
}
