//! Floating-point types of the factorization, with their SIMD vectors.

use std::ops::{AddAssign, DivAssign, MulAssign, SubAssign};

use pulp::Simd;

use crate::numerics::precision::Precision;

/// Floating-point type of a factorization.
pub(crate) trait Real: Precision + PartialOrd + AddAssign + SubAssign + MulAssign + DivAssign {
    /// SIMD vector.
    type Vector<S: Simd>: Copy;
    /// Magnitude below which values are set to zero, so that products of the others are normal numbers.
    /// Couplings decay by orders of magnitude from node to node, and denormal numbers cost up to a hundred
    /// times as much on some processors.
    const NEGLIGIBLE: Self;
    /// Static pivot threshold relative to the largest entry of a row. Units of the unknowns alone can make
    /// pivots small: a flow beside pressures that are 1e9 times larger.
    const STATIC_PIVOT: Self;

    /// Entries of a SIMD vector.
    fn lanes<S: Simd>() -> usize;
    /// The vectors of a slice, without the remainder.
    fn vectors<S: Simd>(values: &[Self]) -> &[Self::Vector<S>];
    /// As [`vectors`](Self::vectors), mutable.
    fn vectors_mut<S: Simd>(values: &mut [Self]) -> &mut [Self::Vector<S>];
    /// A vector of equal entries.
    fn splat<S: Simd>(simd: S, value: Self) -> Self::Vector<S>;
    /// `a + b`.
    fn sum<S: Simd>(simd: S, a: Self::Vector<S>, b: Self::Vector<S>) -> Self::Vector<S>;
    /// `a b + c`, with one rounding or two.
    fn multiply_add<S: Simd>(simd: S, factors: [Self::Vector<S>; 2], c: Self::Vector<S>) -> Self::Vector<S>;
    /// Whether the value is neither infinite nor NaN.
    fn is_finite(self) -> bool;
    /// The magnitude with the sign of `sign`.
    fn with_sign_of(self, sign: Self) -> Self;
}

/// Implements [`Real`] by the functions of `pulp` for one type.
macro_rules! real {
    ($type:ty, $negligible:literal, $pivot:literal, $vector:ident, $lanes:ident, $slice:ident, $slice_mut:ident,
     $splat:ident, $sum:ident, $multiply_add:ident) => {
        impl Real for $type {
            type Vector<S: Simd> = S::$vector;
            const NEGLIGIBLE: Self = $negligible;
            const STATIC_PIVOT: Self = $pivot;

            #[inline(always)]
            fn lanes<S: Simd>() -> usize {
                S::$lanes
            }

            #[inline(always)]
            fn vectors<S: Simd>(values: &[Self]) -> &[S::$vector] {
                S::$slice(values).0
            }

            #[inline(always)]
            fn vectors_mut<S: Simd>(values: &mut [Self]) -> &mut [S::$vector] {
                S::$slice_mut(values).0
            }

            #[inline(always)]
            fn splat<S: Simd>(simd: S, value: Self) -> S::$vector {
                simd.$splat(value)
            }

            #[inline(always)]
            fn sum<S: Simd>(simd: S, a: S::$vector, b: S::$vector) -> S::$vector {
                simd.$sum(a, b)
            }

            #[inline(always)]
            fn multiply_add<S: Simd>(simd: S, [a, b]: [S::$vector; 2], c: S::$vector) -> S::$vector {
                simd.$multiply_add(a, b, c)
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                self.is_finite()
            }

            #[inline(always)]
            fn with_sign_of(self, sign: Self) -> Self {
                self.copysign(sign)
            }
        }
    };
}

real!(
    f32,
    1e-18,
    1e-15,
    f32s,
    F32_LANES,
    as_simd_f32s,
    as_mut_simd_f32s,
    splat_f32s,
    add_f32s,
    mul_add_e_f32s
);
real!(
    f64,
    1e-150,
    1e-30,
    f64s,
    F64_LANES,
    as_simd_f64s,
    as_mut_simd_f64s,
    splat_f64s,
    add_f64s,
    mul_add_e_f64s
);
