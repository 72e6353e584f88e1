//! Resampling of measured heights to a grid: separable averages or interpolation, with mirror images if needed.

use crate::grid::Grid;

/// Mapping of the measured area to the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tiling {
    /// One window of the size of the grid.
    Window,
    /// An even number of mirrored windows, the largest that fit the measured area.
    Mirrored,
}

/// One axis of the resampling: source points of each target node, with weights of sum 1.
struct Axis {
    /// Points and weights of each node.
    weights: Vec<Vec<(usize, f64)>>,
}

/// The geometry of one axis, lengths in metres.
struct Folding {
    /// Length of one window.
    window: f64,
    /// Distance of the window's start from the start of the measured area.
    start: f64,
    /// Spacing of the points \[m\].
    spacing: f64,
    /// Number of the points.
    points: usize,
}

impl Folding {
    /// From `points` points to a grid of `size` \[m\].
    fn new(points: usize, spacing: f64, size: f64, tiling: Tiling) -> Self {
        let extent = points as f64 * spacing;
        let window = match tiling {
            Tiling::Window => size,
            Tiling::Mirrored => size / (2.0 * (0.5 * size / extent * (1.0 - 1e-9)).ceil().max(1.0)),
        };
        Self { window, start: 0.5 * (extent - window), spacing, points }
    }

    /// Source points and overlaps for the target interval from `low` to `high`, between folds.
    fn overlaps(&self, low: f64, high: f64) -> Vec<(usize, f64)> {
        let mut weights = Vec::new();
        for tile in (low / self.window) as usize..=(high / self.window) as usize {
            let edge = tile as f64 * self.window;
            let (from, to) = (low.max(edge) - edge, high.min(edge + self.window) - edge);
            if to <= from {
                continue;
            }
            let (from, to) =
                if tile.is_multiple_of(2) { (from, to) } else { (self.window - to, self.window - from) };
            let (from, to) = ((self.start + from) / self.spacing, (self.start + to) / self.spacing);
            let last = self.points - 1;
            for point in (from as usize).min(last)..=(to as usize).min(last) {
                let overlap = to.min((point + 1) as f64) - from.max(point as f64);
                if overlap > 0.0 {
                    weights.push((point, overlap));
                }
            }
        }
        let total: f64 = weights.iter().map(|(_, weight)| weight).sum();
        weights.iter_mut().for_each(|(_, weight)| *weight /= total);
        weights
    }

    /// The two source points around the target position `at`, linear between them.
    fn linear(&self, at: f64) -> Vec<(usize, f64)> {
        let tile = (at / self.window) as usize;
        let inside = at - tile as f64 * self.window;
        let inside = if tile.is_multiple_of(2) { inside } else { self.window - inside };
        let last = self.points - 1;
        let position = ((self.start + inside) / self.spacing - 0.5).clamp(0.0, last as f64);
        let low = position as usize;
        let part = position - low as f64;
        vec![(low, 1.0 - part), ((low + 1).min(last), part)]
    }
}

impl Axis {
    /// Weights of `nodes` nodes at a spacing of `step` \[m\]: cell averages if cells are not finer than the points,
    /// otherwise linear.
    fn new(points: usize, spacing: f64, nodes: usize, step: f64, tiling: Tiling) -> Self {
        let folding = Folding::new(points, spacing, nodes as f64 * step, tiling);
        let coarser = step >= spacing * (1.0 - 1e-9);
        let weights = (0..nodes)
            .map(|node| {
                let low = node as f64 * step;
                let averaged = if coarser { folding.overlaps(low, low + step) } else { Vec::new() };
                if averaged.is_empty() { folding.linear(low + 0.5 * step) } else { averaged }
            })
            .collect();
        Self { weights }
    }
}

/// `heights` of `[nx, ny]` points and `[dx, dy]` spacing \[m\] on `grid`, along x first, then along y.
pub(super) fn resample(
    heights: &[f64],
    [nx, ny]: [usize; 2],
    [dx, dy]: [f64; 2],
    grid: &Grid,
    tiling: Tiling,
) -> Vec<f64> {
    let along_x = Axis::new(nx, dx, grid.nx(), grid.dx(), tiling);
    let along_y = Axis::new(ny, dy, grid.ny(), grid.dy(), tiling);
    let mut rows = Vec::with_capacity(grid.nx() * ny);
    for row in heights.chunks_exact(nx) {
        rows.extend(along_x.weights.iter().map(|part| part.iter().map(|&(i, w)| w * row[i]).sum::<f64>()));
    }
    let mut out = vec![0.0; grid.len()];
    for (target, part) in out.chunks_exact_mut(grid.nx()).zip(&along_y.weights) {
        for &(j, weight) in part {
            let source = &rows[j * grid.nx()..(j + 1) * grid.nx()];
            for (value, height) in target.iter_mut().zip(source) {
                *value += weight * height;
            }
        }
    }
    out
}
