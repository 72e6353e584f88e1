//! Floating-point types of the convolutions.

use rustfft::FftNum;

/// Floating-point type of the transforms; fields are always in double precision.
pub(crate) trait Precision: FftNum + Default {
    /// The nearest value of this type.
    fn rounded(value: f64) -> Self;
    /// The value in double precision.
    fn wide(self) -> f64;
}

impl Precision for f64 {
    #[inline]
    fn rounded(value: f64) -> Self {
        value
    }

    #[inline]
    fn wide(self) -> f64 {
        self
    }
}

impl Precision for f32 {
    #[inline]
    fn rounded(value: f64) -> Self {
        value as Self
    }

    #[inline]
    fn wide(self) -> f64 {
        f64::from(self)
    }
}
