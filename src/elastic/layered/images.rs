//! The response of a layer as that of loads below the surface.
//!
//! A unit load at the depth `a` below the surface has the potential `1/sqrt(r^2 + a^2)`, whose transform is
//! `exp(-q a)/q`. The correction `f - 1` of a layer to a half-space of its own material is smooth in `q` and
//! falls as `exp(-2 q h)`: a sum of such exponentials reproduces it, and turns the response on a cell into
//! closed forms at any ratio of cell, thickness and distance, with no periodic image. In the field theory of
//! layered media this is the method of discrete images.

use nalgebra::{DMatrix, DVector, SVD};

use super::Layer;
use crate::error::InputError;

/// Depths over the thickness: geometric from the first on. The nearest images lie at twice the thickness, the
/// farthest where the stiffest layer bends, at its thickness times the cube root of the ratio of moduli.
const FIRST_DEPTH: f64 = 0.7;
/// Each depth over the one before.
const RATIO: f64 = 1.2;
/// Number of depths; the last one is at some 3700 thicknesses.
const IMAGES: usize = 48;
/// Wave numbers of the fit times the thickness: zero and these, geometric.
const WAVES: [f64; 2] = [1e-5, 30.0];
/// Number of the geometric wave numbers.
const SAMPLES: usize = 400;
/// Weight of long waves in the fit, which fix the load that is felt far away.
const WEIGHT_OF_ZERO: f64 = 10.0;
/// Singular values below this share of the largest one are rounding.
const RANK: f64 = 1e-14;
/// Iterations for the singular values, which take some two each.
const SWEEPS: usize = 10_000;
/// A transform this close to one is that of a half-space.
const NONE: f64 = 1e-13;

/// A load below the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Image {
    /// Depth \[m\].
    pub(super) depth: f64,
    /// Its size over the load on the surface.
    pub(super) strength: f64,
}

/// The images of `layer`, by least squares of the relative error; none where the layer is the substrate.
pub(super) fn images(layer: &Layer) -> Result<Vec<Image>, InputError> {
    let growth = (WAVES[1] / WAVES[0]).powf(1.0 / (SAMPLES - 1) as f64);
    let waves: Vec<f64> =
        std::iter::once(0.0).chain((0..SAMPLES).map(|i| WAVES[0] * growth.powi(i as i32))).collect();
    if waves.iter().all(|&x| (layer.transform(x) - 1.0).abs() < NONE) {
        return Ok(Vec::new());
    }
    let depths: Vec<f64> = (0..IMAGES).map(|k| FIRST_DEPTH * RATIO.powi(k as i32)).collect();
    let weight = |x: f64| if x == 0.0 { WEIGHT_OF_ZERO } else { 1.0 } / layer.transform(x);
    let matrix =
        DMatrix::from_fn(waves.len(), IMAGES, |i, k| weight(waves[i]) * (-waves[i] * depths[k]).exp());
    let none = || InputError::Conflict {
        field: "elastic.layer".to_owned(),
        reason: "its response has no images".to_owned(),
    };
    let aim = DVector::from_fn(waves.len(), |i, _| weight(waves[i]) * (layer.transform(waves[i]) - 1.0));
    let decomposition = SVD::try_new(matrix, true, true, f64::EPSILON, SWEEPS).ok_or_else(none)?;
    let rank = RANK * decomposition.singular_values.max();
    let strengths = decomposition.solve(&aim, rank).map_err(|_| none())?;
    let image = |(depth, strength): (f64, f64)| Image { depth: depth * layer.thickness(), strength };
    Ok(depths.into_iter().zip(strengths.iter().copied()).map(image).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_have_the_transform_of_the_layer() {
        for (bound, moduli) in [(5e-6, &[1e-4, 1e-2, 0.1, 0.5, 0.9, 2.0, 10.0, 100.0][..]), (3e-5, &[999.0])]
        {
            for (&m, (v1, v2)) in moduli
                .iter()
                .flat_map(|m| [(0.3, 0.3), (0.5, 0.3), (0.2, 0.5), (0.0, 0.0)].map(|poisson| (m, poisson)))
            {
                let modulus = m * (1.0 + v1) / (1.0 + v2);
                let layer = Layer::new(1.0, [modulus, v1], [1.0, v2]).unwrap();
                let images = images(&layer).unwrap();
                for x in (0..700).map(|i| 1e-6 * 1.03_f64.powi(i)).chain([0.0]).filter(|x| *x < 60.0) {
                    let sum: f64 = images.iter().map(|image| image.strength * (-x * image.depth).exp()).sum();
                    let error = (1.0 + sum) / layer.transform(x) - 1.0;
                    assert!(error.abs() < bound, "M = {m}, v = {v1}, {v2}, x = {x}: {error:e}");
                }
            }
        }
    }

    #[test]
    fn a_layer_of_the_substrate_has_none() {
        assert!(images(&Layer::new(1e-6, [210e9, 0.3], [210e9, 0.3]).unwrap()).unwrap().is_empty());
    }
}
