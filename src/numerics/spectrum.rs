//! The spectrum of a convolution kernel: halved and real for symmetric kernels, its product with spectra of
//! fields, and its reciprocal.

use num_complex::Complex;

use super::precision::Precision;

/// Spectrum of a kernel, column by column (`[kx][ky]`).
#[derive(Clone)]
pub(super) enum Spectrum<T> {
    /// Real and stored as the first half of each column, for kernels symmetric about both axes.
    Symmetric(Vec<T>),
    /// Complex and stored whole, for all other kernels.
    General(Vec<Complex<T>>),
}

/// Relative tolerance for asymmetry due to rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl Spectrum<f64> {
    /// Spectrum from columns of `length` values.
    pub(super) fn new(values: Vec<Complex<f64>>, length: usize) -> Self {
        let rounding = ROUNDING * values.iter().fold(0.0_f64, |largest, value| largest.max(value.norm()));
        let mirrored = |column: &[Complex<f64>]| {
            (0..length).all(|k| (column[k] - column[(length - k) % length].conj()).norm() <= rounding)
                && column.iter().all(|value| value.im.abs() <= rounding)
        };
        if values.chunks_exact(length).all(mirrored) {
            let half = |column: &[Complex<f64>]| -> Vec<f64> {
                column[..=length / 2].iter().map(|value| value.re).collect()
            };
            Self::Symmetric(values.chunks_exact(length).flat_map(half).collect())
        } else {
            Self::General(values)
        }
    }

    /// Applies `each` to real and imaginary parts.
    pub(super) fn map<U: Precision>(&self, each: impl Fn(f64) -> U) -> Spectrum<U> {
        match self {
            Self::Symmetric(values) => Spectrum::Symmetric(values.iter().map(|&value| each(value)).collect()),
            Self::General(values) => Spectrum::General(
                values.iter().map(|value| Complex::new(each(value.re), each(value.im))).collect(),
            ),
        }
    }

    /// The sum of both spectra, with columns of `length` values.
    pub(super) fn plus(&self, other: &Self, length: usize) -> Self {
        if let (Self::Symmetric(one), Self::Symmetric(two)) = (self, other) {
            return Self::Symmetric(one.iter().zip(two).map(|(a, b)| a + b).collect());
        }
        Self::General(self.whole(length).zip(other.whole(length)).map(|(a, b)| a + b).collect())
    }

    /// All values, column by column, with columns of `length` values.
    fn whole(&self, length: usize) -> Box<dyn Iterator<Item = Complex<f64>> + '_> {
        match self {
            Self::Symmetric(values) => Box::new(values.chunks_exact(length / 2 + 1).flat_map(move |half| {
                (0..length).filter_map(move |k| half.get(k.min(length - k)).copied().map(Complex::from))
            })),
            Self::General(values) => Box::new(values.iter().copied()),
        }
    }
}

impl<T: Precision> Spectrum<T> {
    /// Replaces each value `K` by `factor / (|K| + added)` with the phase of `1/K`; a value of zero counts as the smallest
    /// normal number.
    pub(super) fn reciprocal(&mut self, factor: f64, added: f64) {
        let reciprocal = |modulus: f64| T::rounded(factor / (modulus.max(f64::MIN_POSITIVE) + added));
        match self {
            Self::Symmetric(values) => {
                values.iter_mut().for_each(|value| *value = reciprocal(value.wide().abs()));
            }
            Self::General(values) => values.iter_mut().for_each(|value| {
                let whole = Complex::new(value.re.wide(), value.im.wide());
                let modulus = whole.norm().max(f64::MIN_POSITIVE);
                let phase = whole.conj() / modulus;
                let inverse = factor / (modulus + added);
                *value = Complex::new(T::rounded(inverse * phase.re), T::rounded(inverse * phase.im));
            }),
        }
    }

    /// Multiplies column `kx` of a field's spectrum by that of the kernel.
    pub(super) fn multiply(&self, kx: usize, column: &mut [Complex<T>]) {
        let length = column.len();
        match self {
            Self::Symmetric(values) => {
                let half = length / 2 + 1;
                let kernel = &values[kx * half..(kx + 1) * half];
                let (low, high) = column.split_at_mut(half);
                low.iter_mut().zip(kernel).for_each(|(value, &k)| *value = *value * k);
                let mirrored = kernel.iter().skip(1).rev().skip(usize::from(length.is_multiple_of(2)));
                high.iter_mut().zip(mirrored).for_each(|(value, &k)| *value = *value * k);
            }
            Self::General(values) => {
                let kernel = &values[kx * length..(kx + 1) * length];
                column.iter_mut().zip(kernel).for_each(|(value, k)| *value = *value * k);
            }
        }
    }
}
