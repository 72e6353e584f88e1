//! Coated bodies for tests of stresses.

use stribeck::Grid;
use stribeck::elastic::{Layer, StressField};

pub(crate) fn components(field: &StressField, k: usize) -> [f64; 6] {
    [field.xx[k], field.yy[k], field.zz[k], field.xy[k], field.xz[k], field.yz[k]]
}

/// Shear moduli and Poisson's ratios of layer and substrate.
pub(crate) type Materials = [[f64; 2]; 2];

pub(crate) fn layer(thickness: f64, [own, below]: Materials) -> Layer {
    let young = |[g, v]: [f64; 2]| [2.0 * g * (1.0 + v), v];
    Layer::new(thickness, young(own), young(below)).unwrap()
}

pub(crate) const PAIRS: [Materials; 3] =
    [[[4.0, 0.25], [1.0, 0.3]], [[0.2, 0.4], [1.0, 0.3]], [[30.0, 0.2], [1.0, 0.5]]];

/// Hertz pressure of unit radius and unit peak.
pub(crate) fn hertz(grid: &Grid) -> Vec<f64> {
    grid.nodes().map(|(x, y)| (1.0 - x * x - y * y).max(0.0).sqrt()).collect()
}
