//! Derivatives of the flow through faces, in single precision.

use crate::numerics::FieldLines;

/// Bound of derivatives; those of real films are some 1e12.
const LARGEST: f64 = 1e30;

/// Derivatives of the flow through the faces of one direction: by the pressures of its two nodes, by their
/// films.
pub(super) type FaceFlows = [Vec<f32>; 4];

/// Stores the derivatives of face `i` of these lines.
#[inline]
pub(super) fn store(flows: &mut [FieldLines<'_, f32>; 4], i: usize, derivatives: [f64; 4], stiffness: f64) {
    let [first, second, first_film, second_film] = flows;
    first.values[i] = single(stiffness * derivatives[0]);
    second.values[i] = single(stiffness * derivatives[1]);
    first_film.values[i] = single(derivatives[2]);
    second_film.values[i] = single(derivatives[3]);
}

/// In single precision, clamped to finite numbers.
pub(super) fn single(value: f64) -> f32 {
    value.clamp(-LARGEST, LARGEST) as f32
}
