//! Matrix products of large fronts, whose columns are divided between threads.
//!
//! A column is the same work for any division, so that results do not depend on the number of threads.

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::dense::{Block, VECTOR, add_matrix_product};
use super::real::Real;
use crate::numerics::parallel::for_each_task;

/// Multiplications of a part of a product, for which a further thread repays its overhead.
const LEAST_WORK: usize = 1 << 17;
/// Columns of a part are a multiple of those that a product computes at a time.
const COLUMNS: usize = 6;

/// A part of a product.
struct Part<'a, T> {
    out: &'a mut [T],
    pack: &'a mut [T],
    stride: usize,
    factors: [Block<'a, T>; 2],
    sizes: [usize; 3],
}

impl<T: Real> WithSimd for Part<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Part { out, pack, stride, factors: [a, b], sizes } = self;
        if T::lanes::<S>() > VECTOR {
            add_matrix_product(Scalar, [out, pack], stride, a, b, sizes);
        } else {
            add_matrix_product(simd, [out, pack], stride, a, b, sizes);
        }
    }
}

/// As [`add_matrix_product`], with a further thread for each of `packs` where the product is large.
#[inline(always)]
pub(super) fn add_divided_product<S: Simd, T: Real>(
    simd: S,
    [out, pack]: [&mut [T]; 2],
    packs: &mut [Vec<T>],
    stride: usize,
    [a, b]: [Block<'_, T>; 2],
    [rows, inner, columns]: [usize; 3],
) {
    let parts = (rows * inner * columns / LEAST_WORK).min(packs.len() + 1);
    if parts < 2 {
        return add_matrix_product(simd, [out, pack], stride, a, b, [rows, inner, columns]);
    }
    divide(
        [&mut out[..columns * stride], pack],
        packs,
        stride,
        [a, b],
        [rows, inner, columns.div_ceil(parts)],
    );
}

/// The product in parts of `columns` columns, rounded up.
#[inline(never)]
fn divide<T: Real>(
    [out, pack]: [&mut [T]; 2],
    packs: &mut [Vec<T>],
    stride: usize,
    [a, b]: [Block<'_, T>; 2],
    [rows, inner, columns]: [usize; 3],
) {
    let columns = columns.next_multiple_of(COLUMNS);
    let packs = std::iter::once(pack).chain(packs.iter_mut().map(Vec::as_mut_slice));
    let parts = out.chunks_mut(columns * stride).zip(packs).enumerate().map(|(part, (out, pack))| {
        let sizes = [rows, inner, out.len() / stride];
        Part { out, pack, stride, factors: [a, b.beside(part * columns)], sizes }
    });
    let arch = Arch::new();
    for_each_task(parts.collect(), |part| arch.dispatch(part));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn divided_products_are_bit_identical() {
        let (rows, inner, columns, stride) = (72, 70, 101, 80);
        let values = |length: usize| (0..length).map(|k| (k as f32).sin()).collect::<Vec<_>>();
        let (a, b) = (values(stride * inner), values(inner * columns));
        let product = |packs: usize| {
            let (mut out, mut pack) = (values(stride * columns), vec![0.0; 4096]);
            let mut packs = vec![pack.clone(); packs];
            let factors = [Block { values: &a, stride }, Block { values: &b, stride: inner }];
            let sizes = [rows, inner, columns];
            add_divided_product(Scalar, [&mut out, &mut pack], &mut packs, stride, factors, sizes);
            out.into_iter().map(f32::to_bits).collect::<Vec<_>>()
        };
        let mut whole = values(stride * columns);
        let factors = [Block { values: &a, stride }, Block { values: &b, stride: inner }];
        let arch = Arch::new();
        let mut pack = vec![0.0; 4096];
        let sizes = [rows, inner, columns];
        arch.dispatch(Part { out: &mut whole, pack: &mut pack, stride, factors, sizes });
        let whole: Vec<u32> = whole.into_iter().map(f32::to_bits).collect();
        for packs in [1, 2, 7] {
            assert_eq!(product(packs), whole, "{packs}");
        }
    }
}
