//! Derivatives of the flow through faces, in single precision.

/// Bound of derivatives; those of real films are some 1e12.
const LARGEST: f64 = 1e30;

/// Derivatives of the flow through the faces of one direction: by the pressures of its two nodes, by their
/// films.
pub(super) type FaceFlows = [Vec<f32>; 4];

/// Stores the derivatives of a face.
#[inline]
pub(super) fn store(flows: &mut FaceFlows, k: usize, derivatives: [f64; 4], stiffness: f64) {
    flows[0][k] = single(stiffness * derivatives[0]);
    flows[1][k] = single(stiffness * derivatives[1]);
    flows[2][k] = single(derivatives[2]);
    flows[3][k] = single(derivatives[3]);
}

/// In single precision, clamped to finite numbers.
pub(super) fn single(value: f64) -> f32 {
    value.clamp(-LARGEST, LARGEST) as f32
}
