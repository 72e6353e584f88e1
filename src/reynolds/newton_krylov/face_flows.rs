//! Derivatives of the flow through faces, in single precision, and its changes.

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

/// Changes of the flows through the faces between nodes `stride` apart, of those from node `first` on as many as `out`
/// has; the last `stride` nodes of the grid have no face.
pub(super) fn flow_changes(
    flows: &FaceFlows,
    stride: usize,
    [pressure, film]: [&[f32]; 2],
    first: usize,
    out: &mut [f32],
) {
    let end = (first + out.len()).min(pressure.len() - stride);
    let n = end.saturating_sub(first);
    changes_between(flows, [first.min(end), end - n + stride], [pressure, film], &mut out[..n]);
}

/// Changes of the flows through as many faces as `out` has, from the nodes from `first` on to those from `other` on.
#[inline]
pub(super) fn changes_between(
    flows: &FaceFlows,
    [first, other]: [usize; 2],
    [pressure, film]: [&[f32]; 2],
    out: &mut [f32],
) {
    let n = out.len();
    let [own_p, other_p, own_h, other_h] = flows.each_ref().map(|derivatives| &derivatives[first..][..n]);
    let (p, p_other) = (&pressure[first..][..n], &pressure[other..][..n]);
    let (h, h_other) = (&film[first..][..n], &film[other..][..n]);
    for (k, out) in out.iter_mut().enumerate() {
        *out = (own_p[k] * p[k] + other_p[k] * p_other[k]) + (own_h[k] * h[k] + other_h[k] * h_other[k]);
    }
}

/// Changes of the entrainment through the faces to the east beyond the masses of their first nodes, in whole rows from
/// node `first` on; the last node of the grid keeps its value.
pub(super) fn higher_order_changes(
    derivatives: &[Vec<f32>; 5],
    [pressure, film]: [&[f32]; 2],
    first: usize,
    out: &mut [f32],
) {
    let end = (first + out.len()).min(pressure.len() - 1);
    // The first node of the grid has no upstream neighbor.
    let from = first.max(1);
    let n = end - from;
    let [own_p, up_p, own_h, next_h, up_h] =
        derivatives.each_ref().map(|derivatives| &derivatives[from..][..n]);
    let (p_up, p) = (&pressure[from - 1..][..n], &pressure[from..][..n]);
    let (h_up, h, h_next) = (&film[from - 1..][..n], &film[from..][..n], &film[from + 1..][..n]);
    for (k, out) in out[from - first..][..n].iter_mut().enumerate() {
        *out = (own_p[k] * p[k] + up_p[k] * p_up[k])
            + (own_h[k] * h[k] + next_h[k] * h_next[k] + up_h[k] * h_up[k]);
    }
    if first == 0 {
        let [own_p, _, own_h, next_h, _] = derivatives;
        out[0] = own_p[0] * pressure[0] + own_h[0] * film[0] + next_h[0] * film[1];
    }
}
