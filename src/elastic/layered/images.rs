//! The response of a layer as a sum of image sources below the surface.
//!
//! A unit load at the depth `a` below the surface has the potential `1/sqrt(r^2 + a^2)`, with the transform
//! `exp(-q a)/q`. The correction `f - 1` of a layer, relative to a half-space of its material, is smooth in
//! `q` and decays as `exp(-2 q h)`. A sum of exponentials approximates it and turns the response to a loaded
//! cell into closed forms at any ratio of cell, thickness and distance, without periodic images. The approach
//! is the discrete complex image method of layered media.

use faer::Mat;

use super::Layer;
use crate::error::InputError;
use crate::numerics;

/// Smallest image depth over the thickness; depths form a geometric sequence. The nearest images lie at twice
/// the thickness, the farthest at the bending length of the stiffest layer, its thickness times the cube root
/// of the modulus ratio.
const SMALLEST_DEPTH: f64 = 0.7;
/// Ratio of consecutive depths.
const DEPTH_RATIO: f64 = 1.2;
/// Number of depths; the last one is at about 3700 thicknesses.
const IMAGES: usize = 48;
/// Range of the wave numbers of the fit, times the thickness; geometric, with zero in addition.
const WAVE_NUMBERS: [f64; 2] = [1e-5, 30.0];
/// Number of geometric wave numbers.
const SAMPLES: usize = 400;
/// Weight of wave number zero in the fit, which determines the far field.
const ZERO_WEIGHT: f64 = 10.0;
/// Relative threshold below which singular values are rounding errors.
const RANK_TOLERANCE: f64 = 1e-14;
/// Deviation of the transform from one below which the layer equals its substrate.
const IDENTITY_TOLERANCE: f64 = 1e-13;

/// An image source: a load below the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ImageSource {
    /// Depth \[m\].
    pub(super) depth: f64,
    /// Strength relative to the load on the surface.
    pub(super) strength: f64,
}

/// Image sources of `layer` by least squares of the relative error; empty for a layer of the substrate's
/// material.
pub(super) fn images(layer: &Layer) -> Result<Vec<ImageSource>, InputError> {
    let growth = (WAVE_NUMBERS[1] / WAVE_NUMBERS[0]).powf(1.0 / (SAMPLES - 1) as f64);
    let waves: Vec<f64> =
        std::iter::once(0.0).chain((0..SAMPLES).map(|i| WAVE_NUMBERS[0] * growth.powi(i as i32))).collect();
    if waves.iter().all(|&x| (layer.transform(x) - 1.0).abs() < IDENTITY_TOLERANCE) {
        return Ok(Vec::new());
    }
    let depths: Vec<f64> = (0..IMAGES).map(|k| SMALLEST_DEPTH * DEPTH_RATIO.powi(k as i32)).collect();
    let weight = |x: f64| if x == 0.0 { ZERO_WEIGHT } else { 1.0 } / layer.transform(x);
    let matrix = Mat::from_fn(waves.len(), IMAGES, |i, k| weight(waves[i]) * (-waves[i] * depths[k]).exp());
    let none = || InputError::Conflict {
        field: "elastic.layer".to_owned(),
        reason: "the singular value decomposition of its image sources did not converge".to_owned(),
    };
    let aim: Vec<f64> = waves.iter().map(|&x| weight(x) * (layer.transform(x) - 1.0)).collect();
    let strengths = numerics::least_squares(&matrix, &aim, RANK_TOLERANCE).ok_or_else(none)?;
    let image = |(depth, strength): (f64, f64)| ImageSource { depth: depth * layer.thickness(), strength };
    Ok(depths.into_iter().zip(strengths).map(image).collect())
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
