//! Restriction and interpolation between a grid and the next coarser one over the same box.
//!
//! Both grids are cell-centered: nodes do not coincide, and the numbers of nodes need not be multiples of
//! each other. A transfer is the tensor product of stencils along x and y with four entries each. Pressures
//! and residuals are restricted by averages, which conserve loads and flows; gaps are sampled. Changes of
//! pressure are interpolated linearly, initial pressures cubically.

use crate::grid::Grid;

/// Weights of four neighboring entries along one axis: the value is `sum weights[m] from[first + m]`.
#[derive(Debug, Clone, Copy)]
struct Stencil {
    /// First of the four entries.
    first: usize,
    /// Their weights.
    weights: [f64; 4],
}

/// Stencils of one axis.
#[derive(Debug, Clone)]
struct Axis {
    /// Averages over each coarse cell.
    average: Vec<Stencil>,
    /// Cubic interpolation at each coarse node.
    sample: Vec<Stencil>,
    /// Linear interpolation at each fine node.
    linear: Vec<Stencil>,
    /// Cubic interpolation at each fine node.
    cubic: Vec<Stencil>,
}

impl Axis {
    /// Stencils between `fine` and `coarse` cells over the same length.
    fn new(fine: usize, coarse: usize) -> Self {
        let ratio = fine as f64 / coarse as f64;
        // Center of coarse cell I on the fine axis, and of fine cell i on the coarse axis.
        let down = |i: usize| (i as f64 + 0.5) * ratio - 0.5;
        let up = |i: usize| (i as f64 + 0.5) / ratio - 0.5;
        Self {
            average: (0..coarse).map(|i| overlaps(i as f64 * ratio, ratio, fine)).collect(),
            sample: (0..coarse).map(|i| cubic(down(i), fine)).collect(),
            linear: (0..fine).map(|i| linear(up(i), coarse)).collect(),
            cubic: (0..fine).map(|i| cubic(up(i), coarse)).collect(),
        }
    }
}

/// Overlap of the cells `0..n` with the interval of length `length` from `low`, relative to the length.
fn overlaps(low: f64, length: f64, n: usize) -> Stencil {
    let first = (low as usize).min(n - 4);
    let weights = std::array::from_fn(|m| {
        let (left, right) = ((first + m) as f64, (first + m + 1) as f64);
        (right.min(low + length) - left.max(low)).max(0.0) / length
    });
    Stencil { first, weights }
}

/// Linear interpolation at `position` between the nodes 0..n, constant beyond the outermost ones.
fn linear(position: f64, n: usize) -> Stencil {
    let position = position.clamp(0.0, (n - 1) as f64);
    let left = (position as usize).min(n - 2);
    let share = position - left as f64;
    let first = left.min(n - 4);
    let mut weights = [0.0; 4];
    weights[left - first] = 1.0 - share;
    weights[left - first + 1] = share;
    Stencil { first, weights }
}

/// Cubic through the four nodes neighbors `position`: exact for parabolas, beyond the outermost nodes too.
fn cubic(position: f64, n: usize) -> Stencil {
    let first = (position.max(1.0) as usize - 1).min(n - 4);
    let t = position - first as f64;
    let weights = [
        -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0,
        t * (t - 2.0) * (t - 3.0) / 2.0,
        -t * (t - 1.0) * (t - 3.0) / 2.0,
        t * (t - 1.0) * (t - 2.0) / 6.0,
    ];
    Stencil { first, weights }
}

/// Transfers between two grids over one box; the numbers of nodes need not be multiples of each other.
#[derive(Debug, Clone)]
pub(in crate::reynolds) struct Transfer {
    /// Stencils along rows.
    x: Axis,
    /// Stencils along columns.
    y: Axis,
    /// Intermediate field after the pass along x.
    scratch: Vec<f64>,
}

impl Transfer {
    /// Transfers between grids with at least four nodes along each axis.
    pub(in crate::reynolds) fn new(fine: &Grid, coarse: &Grid) -> Self {
        Self {
            x: Axis::new(fine.nx(), coarse.nx()),
            y: Axis::new(fine.ny(), coarse.ny()),
            scratch: vec![0.0; fine.len()],
        }
    }

    /// Averages over the coarse cells; conserves integrals.
    pub(in crate::reynolds) fn average(&mut self, fine: &[f64], coarse: &mut [f64]) {
        apply(&self.x.average, &self.y.average, self.x.linear.len(), fine, &mut self.scratch, coarse);
    }

    /// Values at the coarse nodes; exact for parabolas.
    pub(in crate::reynolds) fn sample(&mut self, fine: &[f64], coarse: &mut [f64]) {
        apply(&self.x.sample, &self.y.sample, self.x.linear.len(), fine, &mut self.scratch, coarse);
    }

    /// Bilinear interpolation.
    pub(in crate::reynolds) fn interpolate(&mut self, coarse: &[f64], fine: &mut [f64]) {
        apply(&self.x.linear, &self.y.linear, self.x.average.len(), coarse, &mut self.scratch, fine);
    }

    /// Bicubic interpolation.
    pub(in crate::reynolds) fn interpolate_cubic(&mut self, coarse: &[f64], fine: &mut [f64]) {
        apply(&self.x.cubic, &self.y.cubic, self.x.average.len(), coarse, &mut self.scratch, fine);
    }
}

/// `to = Y X from`, rows of `width` entries in `from`.
fn apply(
    along_x: &[Stencil],
    along_y: &[Stencil],
    width: usize,
    from: &[f64],
    scratch: &mut [f64],
    to: &mut [f64],
) {
    let nx = along_x.len();
    // Along x: four entries of a row make one.
    for (row, out) in from.chunks_exact(width).zip(scratch.chunks_exact_mut(nx)) {
        for (value, stencil) in out.iter_mut().zip(along_x) {
            let [a, b, c, d] = stencil.weights;
            let s = &row[stencil.first..stencil.first + 4];
            *value = a * s[0] + b * s[1] + c * s[2] + d * s[3];
        }
    }
    // Along y: four rows make one.
    for (out, stencil) in to.chunks_exact_mut(nx).zip(along_y) {
        out.fill(0.0);
        for (m, weight) in stencil.weights.into_iter().enumerate() {
            if weight != 0.0 {
                let row = &scratch[(stencil.first + m) * nx..][..nx];
                for (value, s) in out.iter_mut().zip(row) {
                    *value += weight * s;
                }
            }
        }
    }
}
