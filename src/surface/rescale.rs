//! Scaling of heights to a given root mean square, for generated and measured surfaces.

use crate::numerics::map_lines;

/// Removes the mean of `heights`, rows of `nx` values, and scales them to the root mean square
/// `Rq = sqrt(mean((z - mean)^2))` of `rq` \[m\]. Values for which `counts` is false are excluded and unchanged. Returns
/// `None` without changes if no finite factor exists: heights that are equal up to rounding (`Rq` at most 1e-12 of their
/// mean), none at all, or too large. An `rq` of zero sets all heights to zero.
pub(crate) fn rescale(
    heights: &mut [f64],
    nx: usize,
    counts: impl Fn(usize) -> bool + Sync,
    rq: f64,
) -> Option<()> {
    let count = (0..heights.len()).filter(|k| counts(*k)).count() as f64;
    let mean = sum(heights, nx, &counts, |height| height) / count;
    let square = sum(heights, nx, &counts, |height| (height - mean) * (height - mean)) / count;
    let flat = square.sqrt() <= 1e-12 * mean.abs();
    let factor = match rq {
        0.0 => 0.0,
        _ if flat => return None,
        _ => rq / square.sqrt(),
    };
    if !(factor.is_finite() && mean.is_finite()) {
        return None;
    }
    map_lines(heights, nx, |j, row| {
        for (_, z) in row.iter_mut().enumerate().filter(|(i, _)| counts(j * nx + i)) {
            *z = factor * (*z - mean);
        }
    });
    Some(())
}

/// Sum over rows of `each`, computed by several threads.
fn sum(
    heights: &[f64],
    nx: usize,
    counts: impl Fn(usize) -> bool + Sync,
    each: impl Fn(f64) -> f64 + Sync,
) -> f64 {
    let mut rows: Vec<f64> = vec![0.0; heights.len() / nx];
    map_lines(&mut rows, 1, |j, sum| {
        let row = heights[j * nx..][..nx].iter().enumerate();
        sum[0] = row.filter(|(i, _)| counts(j * nx + i)).map(|(_, height)| each(*height)).sum();
    });
    rows.iter().sum()
}
