//! Fields seen the other way round.
//!
//! Transforms along columns read them as lines: copied once in blocks that fit the cache, they are then
//! contiguous.

/// Edge length of the square blocks in which fields are transposed: two blocks of complex numbers fit the
/// first-level cache.
pub(super) const BLOCK: usize = 16;

/// Line `first + k` of `source`, seen the other way round, into line `k` of `lines`: `n` values, in blocks.
pub(super) fn transpose<T: Copy>(
    source: &[T],
    source_stride: usize,
    first: usize,
    lines: &mut [T],
    stride: usize,
    n: usize,
) {
    let count = lines.len() / stride;
    for k0 in (0..count).step_by(BLOCK) {
        for j0 in (0..n).step_by(BLOCK) {
            for k in k0..(k0 + BLOCK).min(count) {
                for j in j0..(j0 + BLOCK).min(n) {
                    lines[k * stride + j] = source[j * source_stride + first + k];
                }
            }
        }
    }
}
