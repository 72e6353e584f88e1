//! Blocked transposition of fields.
//!
//! Transforms along columns copy them into contiguous lines, in blocks that fit the cache.

/// Edge length of the square blocks: two blocks of complex numbers fit the first-level cache.
pub(super) const BLOCK: usize = 16;

/// Copies column `first + k` of `source` into line `k` of `lines`, `n` values each, block by block.
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
