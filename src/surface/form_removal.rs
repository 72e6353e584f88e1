//! Form removal: least-squares plane or polynomial.

use faer::Mat;

use super::error::SurfaceError;
use super::measured::Heights;
use crate::error::InputError;
use crate::numerics;

/// Highest degree of a polynomial.
const MAX_DEGREE: usize = 10;
/// Relative singular value below which a direction is not fitted.
const DEGENERATE: f64 = 1e-12;

impl Heights {
    /// Subtracts the least-squares plane through the defined points. The slope in a direction in which they do not extend
    /// is kept.
    ///
    /// # Errors
    /// [`SurfaceError::AllUndefined`] if no point is defined; [`SurfaceError::Input`] for heights so large that the sums
    /// overflow.
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let tilted = (0..12).map(|k| 1e-6 * f64::from(k % 4) - 2e-6 * f64::from(k / 4)).collect();
    /// let mut surface = Heights::new(4, 3, None, tilted, None)?;
    /// surface.remove_plane()?;
    /// assert!(surface.heights().iter().all(|z| z.abs() < 1e-18));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn remove_plane(&mut self) -> Result<(), SurfaceError> {
        self.remove_polynomial(1)
    }

    /// Subtracts the least-squares polynomial `sum c_mn x^m y^n` over `m + n <= degree` through the defined points.
    /// Undetermined terms (a slope across a single row) are kept.
    ///
    /// # Errors
    /// A degree above 10; the errors of [`Heights::remove_plane`].
    ///
    /// ```
    /// # use stribeck::surface::Heights;
    /// let bowl = (0..35).map(|k| 1e-8 * f64::from((k % 7) * (k / 7)) + 1e-9 * f64::from(k % 7).powi(2)).collect();
    /// let mut surface = Heights::new(7, 5, None, bowl, None)?;
    /// surface.remove_polynomial(2)?;
    /// assert!(surface.heights().iter().all(|z| z.abs() < 1e-20));
    /// # Ok::<(), stribeck::surface::SurfaceError>(())
    /// ```
    pub fn remove_polynomial(&mut self, degree: usize) -> Result<(), SurfaceError> {
        InputError::require(degree <= MAX_DEGREE, "degree", degree as f64, "at most 10")?;
        let mean = self.mean()?;
        let terms: Vec<[usize; 2]> =
            (0..=degree).flat_map(|a| (0..=degree - a).map(move |b| [a, b])).collect();
        let along_x: Vec<Vec<f64>> = (0..self.nx).map(|i| legendre(centred(i, self.nx), degree)).collect();
        let along_y: Vec<Vec<f64>> = (0..self.ny).map(|j| legendre(centred(j, self.ny), degree)).collect();
        let share = 1.0 / (self.heights.len() - self.undefined()) as f64;
        let mut matrix = Mat::<f64>::zeros(terms.len(), terms.len());
        let mut right = vec![0.0; terms.len()];
        let count = degree + 1;
        let (mut products, mut sums) = (vec![0.0; count * count], vec![0.0; count]);
        for (j, q) in along_y.iter().enumerate() {
            products.fill(0.0);
            sums.fill(0.0);
            for (i, p) in along_x.iter().enumerate() {
                let k = j * self.nx + i;
                if !self.is_defined(k) {
                    continue;
                }
                let height = self.heights[k] - mean;
                for (a, pa) in p.iter().enumerate() {
                    sums[a] += pa * height;
                    for (b, pb) in p.iter().enumerate() {
                        products[a * count + b] += pa * pb;
                    }
                }
            }
            for (row, [a, c]) in terms.iter().enumerate() {
                right[row] += share * sums[*a] * q[*c];
                for (column, [b, d]) in terms.iter().enumerate() {
                    matrix[(row, column)] += share * products[a * count + b] * q[*c] * q[*d];
                }
            }
        }
        let form = least_squares(&matrix, &right)?;
        for (j, q) in along_y.iter().enumerate() {
            sums.fill(0.0);
            terms.iter().zip(&form).for_each(|([a, c], factor)| sums[*a] += factor * q[*c]);
            for (i, p) in along_x.iter().enumerate() {
                let k = j * self.nx + i;
                if self.is_defined(k) {
                    self.heights[k] -= mean + p.iter().zip(&sums).map(|(p, sum)| p * sum).sum::<f64>();
                }
            }
        }
        Ok(())
    }

    /// Mean of the defined heights.
    pub(super) fn mean(&self) -> Result<f64, SurfaceError> {
        let points = self.heights.len();
        let count = points - self.undefined();
        if count == 0 {
            return Err(SurfaceError::AllUndefined { points });
        }
        let defined = self.heights.iter().enumerate().filter(|(k, _)| self.is_defined(*k));
        let mean = defined.map(|(_, z)| z / count as f64).sum::<f64>();
        InputError::require_finite("heights, summed over all points", &[mean])?;
        Ok(mean)
    }
}

/// Position of point `i` of `n` between -1 and 1.
pub(super) fn centred(i: usize, n: usize) -> f64 {
    (2.0 * i as f64 + 1.0) / n as f64 - 1.0
}

/// Legendre polynomials up to `degree` with mean square 1 between -1 and 1.
fn legendre(x: f64, degree: usize) -> Vec<f64> {
    let mut values = vec![1.0, x];
    for n in 1..degree {
        let n_real = n as f64;
        values.push(((2.0 * n_real + 1.0) * x * values[n] - n_real * values[n - 1]) / (n_real + 1.0));
    }
    values.truncate(degree + 1);
    for (n, value) in values.iter_mut().enumerate() {
        *value *= (2.0 * n as f64 + 1.0).sqrt();
    }
    values
}

/// Minimum-norm solution of the normal equations.
pub(super) fn least_squares(matrix: &Mat<f64>, right: &[f64]) -> Result<Vec<f64>, SurfaceError> {
    InputError::require_finite("heights, summed over all points", right)?;
    let unknown = || InputError::Conflict {
        field: "heights".to_owned(),
        reason: "the form of least squares cannot be found".to_owned(),
    };
    numerics::least_squares(matrix, right, DEGENERATE).ok_or_else(|| unknown().into())
}
