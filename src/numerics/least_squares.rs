//! Least squares by singular values.

use faer::Mat;

/// Minimum-norm solution of `matrix x = right` by least squares. Directions whose singular value is at most
/// `threshold` times the largest one count as undetermined. `None` if the decomposition does not converge.
pub(crate) fn least_squares(matrix: &Mat<f64>, right: &[f64], threshold: f64) -> Option<Vec<f64>> {
    let decomposition = matrix.thin_svd().ok()?;
    let values = decomposition.S().column_vector();
    let least = threshold * values.iter().copied().fold(0.0, f64::max);
    let mut solution = vec![0.0; matrix.ncols()];
    let vectors = decomposition.U().col_iter().zip(decomposition.V().col_iter());
    for (value, (left, direction)) in values.iter().zip(vectors).filter(|(value, _)| **value > least) {
        let weight = right.iter().zip(left.iter()).map(|(r, u)| r * u).sum::<f64>() / value;
        solution.iter_mut().zip(direction.iter()).for_each(|(part, v)| *part += weight * v);
    }
    Some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn least_squares_has_the_smallest_norm() {
        // Two equal columns share the coefficient; the residual is normal to them.
        let matrix = Mat::from_fn(3, 2, |i, _| [1.0, 2.0, 2.0][i]);
        let solution = least_squares(&matrix, &[1.0, 2.0, 11.0], 1e-12).unwrap();
        assert!(solution.iter().all(|x| (x - 1.5).abs() < 1e-13), "{solution:?}");
    }
}
