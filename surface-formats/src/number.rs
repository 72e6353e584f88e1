//! Numbers in binary files.

/// Type of a stored number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// IEEE 754.
    Float,
    /// Two's complement.
    Signed,
    /// Without a sign.
    Unsigned,
}

/// A number of 1, 2, 4 or 8 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct NumberType {
    /// Whole or floating.
    kind: Kind,
    /// Bytes of a number.
    size: usize,
    /// Order of the bytes.
    big_endian: bool,
}

impl NumberType {
    /// `None` for a size that the kind does not come in (floats of 2, 4, 8; integers of 1, 2, 4, 8 bytes).
    pub(crate) fn new(kind: Kind, size: usize, big_endian: bool) -> Option<Self> {
        let exists = match kind {
            Kind::Float => matches!(size, 2 | 4 | 8),
            Kind::Signed | Kind::Unsigned => matches!(size, 1 | 2 | 4 | 8),
        };
        exists.then_some(Self { kind, size, big_endian })
    }

    /// Bytes of a number.
    pub(crate) fn size(self) -> usize {
        self.size
    }

    /// Whether it is a floating point number.
    pub(crate) fn is_float(self) -> bool {
        self.kind == Kind::Float
    }

    /// The numbers in `bytes`; an incomplete one at the end is left out.
    pub(crate) fn decode(self, bytes: &[u8]) -> Vec<f64> {
        bytes.chunks_exact(self.size).map(|chunk| self.value(chunk)).collect()
    }

    /// The number in `chunk`, which has its size.
    fn value(self, chunk: &[u8]) -> f64 {
        let append = |bits: u64, byte: &u8| (bits << 8) | u64::from(*byte);
        let bits =
            if self.big_endian { chunk.iter().fold(0, append) } else { chunk.iter().rev().fold(0, append) };
        match (self.kind, self.size) {
            (Kind::Float, 2) => half(bits),
            (Kind::Float, 4) => f64::from(f32::from_bits(bits as u32)),
            (Kind::Float, _) => f64::from_bits(bits),
            (Kind::Unsigned, _) => bits as f64,
            (Kind::Signed, size) => {
                let unused = 64 - 8 * size as u32;
                ((bits << unused).cast_signed() >> unused) as f64
            }
        }
    }
}

/// IEEE 754 binary16.
fn half(bits: u64) -> f64 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = ((bits >> 10 & 0x1f) as i32, (bits & 0x3ff) as f64);
    sign * match exponent {
        0 => fraction * 2f64.powi(-24),
        31 if fraction > 0.0 => f64::NAN,
        31 => f64::INFINITY,
        _ => (1024.0 + fraction) * 2f64.powi(exponent - 25),
    }
}
