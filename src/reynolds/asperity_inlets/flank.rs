//! The inlet of an asperity: the integral of `(h - h_c)/h^3` over the flank in front of a contact.

use std::f64::consts::PI;

use super::Field;

/// Limit of [`inlet_integral`] for a large argument, `4 pi/(27 sqrt 3)`.
pub(super) const WHOLE_INLET: f64 = 4.0 * PI / (27.0 * 1.732_050_807_568_877_2);

/// Gaps below this share of the contact film count as closed, which keeps slopes finite.
const CLOSED: f64 = 1e-9;

/// `F(y) = integral from 0 to y of t^1.5/(1 + t^1.5)^3 dt`, the inlet integral of a flank whose gap to the power 2/3
/// rises with slope one. With `s = sqrt(y)`,
/// `F = (2/9) [s^2/(1 + s^3) + J] - s^2/(3 (1 + s^3)^2)`, `J = integral of s/(1 + s^3)`.
pub(super) fn inlet_integral(y: f64) -> f64 {
    let s = y.max(0.0).sqrt();
    if s < 0.05 {
        // The closed form cancels here.
        return 2.0 * s.powi(5) * (0.2 - 0.375 * s.powi(3) + 6.0 / 11.0 * s.powi(6));
    }
    let cube = 1.0 + s.powi(3);
    let root = 3.0_f64.sqrt();
    // ln[(s^2 - s + 1)/(1 + s)^2] without overflow or cancellation at large s.
    let logarithm = (-3.0 * s / (1.0 + s).powi(2)).ln_1p() / 6.0;
    let primitive = logarithm + ((2.0 * s - 1.0) / root).atan() / root + PI / (6.0 * root);
    2.0 / 9.0 * (s * s / cube + primitive) - s * s / (3.0 * cube * cube)
}

/// Rise of the reduced pressure of an incompressible fluid over `12 eta0 u` in the inlet of the contact that begins at
/// column `front` of row `j` \[1/m\]:
/// `cos^2(t) integral of (h - h_c)/h^3 dx`, `h = h_c + gap`, from the front edge upstream until the gap decreases or
/// another contact begins. The gap to the power 2/3 is linear between nodes, so that the edge lies within its
/// cell. `t` is the angle of the edge's normal to x: the flow across an oblique edge is `u cos(t)`, and its path is
/// shorter by `cos(t)`.
pub(super) fn rise_in_inlet(field: &Field<'_>, j: usize, front: usize, contact_film: f64) -> f64 {
    let dx = field.grid.dx();
    // (gap/h_c)^(2/3) at a node; `None` in contact.
    let open = |i: usize, j: usize| {
        let k = j * field.grid.nx() + i;
        (field.pressure[k] <= 0.0).then(|| (field.gap[k] / contact_film).max(CLOSED).cbrt().powi(2))
    };
    let Some(first) = front.checked_sub(1).and_then(|i| open(i, j)) else { return 0.0 };
    let mut integral = 0.0;
    let (mut last, mut slope) = (first, None);
    for i in (0..front.saturating_sub(1)).rev() {
        let Some(y) = open(i, j).filter(|y| *y > last) else { break };
        let rise = y - last;
        slope.get_or_insert(rise / dx);
        integral += dx * (inlet_integral(y) - inlet_integral(last)) / rise;
        last = y;
    }
    // From the edge, at most one cell away, to the first node.
    let along = slope.unwrap_or(0.0).max(first / dx);
    integral += inlet_integral(first) / along;
    integral * cosine_squared(&open, (front, j), along, &field.grid) / (contact_film * contact_film)
}

/// Square of the cosine of the angle between the normal of a front edge and x, from the slope of the gap to the power
/// 2/3 `along` x and that across it at the node in front of the edge.
fn cosine_squared(
    open: &impl Fn(usize, usize) -> Option<f64>,
    (front, j): (usize, usize),
    along: f64,
    grid: &crate::grid::Grid,
) -> f64 {
    let i = front - 1;
    let here = open(i, j).unwrap_or(0.0);
    let before = j.checked_sub(1).and_then(|j| open(i, j));
    let after = if j + 1 < grid.ny() { open(i, j + 1) } else { None };
    let across = match (before, after) {
        (Some(before), Some(after)) => 0.5 * (after - before),
        (Some(before), None) => here - before,
        (None, Some(after)) => after - here,
        (None, None) => 0.0,
    } / grid.dy();
    along * along / (along * along + across * across)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Grid;

    #[test]
    fn inlet_integral_equals_quadrature_and_its_limit() {
        // Midpoint rule in s = sqrt(t).
        let quadrature = |y: f64| {
            let n = 20_000;
            let ds = y.sqrt() / f64::from(n);
            let at = |i: i32| {
                let s = (f64::from(i) + 0.5) * ds;
                2.0 * s.powi(4) / (1.0 + s.powi(3)).powi(3) * ds
            };
            (0..n).map(at).sum::<f64>()
        };
        for y in [1e-4, 2.4e-3, 2.6e-3, 0.03, 0.5, 1.0, 7.0, 300.0] {
            assert!((inlet_integral(y) / quadrature(y) - 1.0).abs() < 1e-6, "{y}");
        }
        assert!((inlet_integral(1e8) / WHOLE_INLET - 1.0).abs() < 1e-12);
    }

    /// Gap `(distance to the edge x cos(t) + y sin(t) = -offset)^1.5` over contact.
    fn flank(grid: &Grid, angle: f64, offset: f64) -> [Vec<f64>; 2] {
        let distance = |x: f64, y: f64| -x * angle.cos() - y * angle.sin() - offset;
        let gap = grid.nodes().map(|(x, y)| 1e-9 * (distance(x, y).max(0.0) / 1e-7).powf(1.5)).collect();
        let pressure = grid.nodes().map(|(x, y)| if distance(x, y) <= 0.0 { 1e9 } else { 0.0 }).collect();
        [pressure, gap]
    }

    #[test]
    fn rise_of_a_straight_flank_is_exact_wherever_its_edge_lies_and_falls_with_the_cosine() {
        let grid = Grid::centred(64, 5, 2e-7, 2e-7).unwrap();
        let whole = WHOLE_INLET * 1e-7 / 1e-18;
        for (angle, offset) in [(0.0_f64, 0.0), (0.0, 3e-8), (0.0, 1.7e-7), (0.5, 3e-8), (-0.5, 1.1e-7)] {
            let [pressure, gap] = flank(&grid, angle, offset);
            let field = Field { grid, pressure: &pressure, gap: &gap };
            let front = (0..64).find(|i| pressure[2 * 64 + i] > 0.0).unwrap();
            let rise = rise_in_inlet(&field, 2, front, 1e-9);
            // The path along x is longer by 1/cos(t), the rise smaller by cos^2(t).
            let exact = whole * angle.cos();
            assert!((rise / exact - 1.0).abs() < 2e-3, "{angle} {offset}: {rise:e} {exact:e}");
        }
    }

    #[test]
    fn contact_without_a_node_in_front_has_no_inlet() {
        let grid = Grid::centred(5, 5, 2e-7, 2e-7).unwrap();
        let field = Field { grid, pressure: &[1e9; 25], gap: &[0.0; 25] };
        assert!(rise_in_inlet(&field, 2, 0, 1e-9).abs() == 0.0);
    }
}
