//! Roughness of a worn scar: heights about the form that wear gives a body at rest.

use faer::Mat;

use crate::grid::Grid;
use crate::metrics::Ellipse;
use crate::numerics;

/// Size of the region over that of the Hertz contact. In the middle half a scar as deep as the semi-ellipse of the Hertz
/// pressure differs by 0.06 % of its depth (root mean square) from a form of second degree; over the whole contact it
/// is 5 %. A scar that conforms to the other body is of second degree.
const REGION: f64 = 0.5;
/// Terms of a form of second degree: 1, x, y, x^2, xy, y^2.
const TERMS: usize = 6;
/// Singular value over the largest one up to which terms count as undetermined: those along y in a single row.
const UNDETERMINED: f64 = 1e-12;

/// Root mean square \[m\] of `heights` on `grid` about their form of second degree, by least squares in the middle of the
/// `contact`.
pub(in crate::sim) fn scar_rq(grid: &Grid, contact: &Ellipse, heights: &[f64]) -> f64 {
    let inside = || {
        let nodes = grid.nodes().map(|(x, y)| contact.normalised(x, y)).zip(heights);
        nodes.filter(|([x, y], _)| x.powi(2) + y.powi(2) <= REGION.powi(2))
    };
    let (mut matrix, mut right, mut count) = (Mat::<f64>::zeros(TERMS, TERMS), [0.0; TERMS], 0.0);
    for (point, height) in inside() {
        let terms = terms(point);
        for (row, term) in terms.iter().enumerate() {
            right[row] += term * height;
            terms.iter().enumerate().for_each(|(column, other)| matrix[(row, column)] += term * other);
        }
        count += 1.0;
    }
    if count == 0.0 {
        return 0.0;
    }
    // Without a form the mean of the heights remains in them.
    let form = numerics::least_squares(&matrix, &right, UNDETERMINED).unwrap_or_else(|| vec![0.0; TERMS]);
    let square = |(point, height): ([f64; 2], &f64)| {
        let of_form: f64 = terms(point).iter().zip(&form).map(|(term, factor)| term * factor).sum();
        (height - of_form).powi(2)
    };
    (inside().map(square).sum::<f64>() / count).sqrt()
}

/// The terms at a point.
fn terms([x, y]: [f64; 2]) -> [f64; TERMS] {
    [1.0, x, y, x * x, x * y, y * y]
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEPTH: f64 = 3e-6;
    const RQ: f64 = 20e-9;

    /// Rq of a wave of `RQ` on a scar of `depth(r^2)`, on a grid of `ny` rows.
    fn of_scar(ny: usize, depth: impl Fn(f64) -> f64) -> f64 {
        let grid = Grid::centred(192, ny, 2e-6, 2e-6).unwrap();
        let half_width = if ny == 1 { f64::INFINITY } else { 110e-6 };
        let contact = Ellipse::turned(120e-6, half_width, 0.0);
        let wave = |x: f64| RQ * 2.0_f64.sqrt() * (std::f64::consts::TAU * x / 10e-6).sin();
        let heights: Vec<f64> =
            grid.nodes().map(|(x, y)| wave(x) - DEPTH * depth(contact.radius_squared(x, y))).collect();
        scar_rq(&grid, &contact, &heights)
    }

    #[test]
    fn rq_of_a_worn_body_is_that_of_its_waves() {
        for ny in [1, 192] {
            // No scar, the first wear by Hertz's pressure, and a scar that conforms to a flat.
            for rq in
                [of_scar(ny, |_| 0.0), of_scar(ny, |r| (1.0 - r).max(0.0).sqrt()), of_scar(ny, |r| 1.0 - r)]
            {
                assert!((rq / RQ - 1.0).abs() < 0.02, "{rq:e} for {ny} rows");
            }
        }
    }
}
