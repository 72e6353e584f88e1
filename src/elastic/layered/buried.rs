//! Potentials of uniformly loaded cells below the surface.
//!
//! [`rectangle`] and [`strip`] generalize Love's potential of a surface cell to an image source at a depth.
//! Far away, where the closed forms lose digits by cancellation, a Gauss rule replaces them.

/// Distance, in units of the larger half size, beyond which the three-point Gauss rule is accurate to 1e-9.
const FAR_FIELD: f64 = 16.0;
/// Nodes and weights of the three-point Gauss-Legendre rule.
const GAUSS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Integral of `1/sqrt(r^2 + depth^2)` \[m\] over the rectangle `|x'| <= half_x`, `|y'| <= half_y`, evaluated
/// at `(x, y)`; `depth > 0`.
pub(super) fn rectangle(x: f64, y: f64, [half_x, half_y]: [f64; 2], depth: f64) -> f64 {
    let square = depth * depth;
    if x * x + y * y + square > (FAR_FIELD * half_x.max(half_y)).powi(2) {
        let mut sum = 0.0;
        for (s, weight_s) in GAUSS {
            let u = x - s * half_x;
            for (t, weight_t) in GAUSS {
                let v = y - t * half_y;
                sum += weight_s * weight_t / (u * u + v * v + square).sqrt();
            }
        }
        return sum * half_x * half_y;
    }
    let corner = |u: f64, v: f64| {
        let (across, along) = (u.hypot(depth), v.hypot(depth));
        let distance = across.hypot(v);
        u * (v / across).asinh() + v * (u / along).asinh() - depth * (u * v / (depth * distance)).atan()
    };
    let (left, right) = (x - half_x, x + half_x);
    let (below, above) = (y - half_y, y + half_y);
    corner(right, above) - corner(left, above) - corner(right, below) + corner(left, below)
}

/// Integral of `ln(reference/sqrt((x - s)^2 + depth^2))` \[m\] over the strip `|s| <= half_width`, evaluated
/// at `x`; `depth > 0`.
pub(super) fn strip(x: f64, half_width: f64, depth: f64, reference: f64) -> f64 {
    let square = depth * depth;
    if x * x + square > (FAR_FIELD * half_width).powi(2) {
        let point = |(s, weight): (f64, f64)| {
            let u = x - s * half_width;
            -0.5 * weight * ((u * u + square) / (reference * reference)).ln()
        };
        return half_width * GAUSS.into_iter().map(point).sum::<f64>();
    }
    let edge = |u: f64| u * (reference / u.hypot(depth)).ln() + u - depth * (u / depth).atan();
    edge(x + half_width) - edge(x - half_width)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::{rectangle_potential, strip_potential};

    /// Mean over `n` x `n` midpoints times the area.
    fn sum(n: usize, [half_x, half_y]: [f64; 2], value: impl Fn(f64, f64) -> f64) -> f64 {
        let at = |i: usize, half: f64| half * ((2 * i + 1) as f64 / n as f64 - 1.0);
        let total: f64 = (0..n * n).map(|k| value(at(k % n, half_x), at(k / n, half_y))).sum();
        4.0 * half_x * half_y * total / (n * n) as f64
    }

    #[test]
    fn rectangles_are_their_integral() {
        let half = [1.0, 0.4];
        for (x, y) in [(0.0, 0.0), (1.0, 0.4), (3.0, -1.0), (0.0, 12.0), (17.0, 0.3), (100.0, 40.0)] {
            for depth in [0.5, 3.0, 15.0, 17.0, 200.0] {
                let exact =
                    sum(400, half, |u, v| 1.0 / ((x - u).powi(2) + (y - v).powi(2) + depth * depth).sqrt());
                let found = rectangle(x, y, half, depth);
                assert!((found / exact - 1.0).abs() < 1e-5, "{x}, {y}, {depth}: {found} {exact}");
            }
        }
    }

    #[test]
    fn branches_meet_and_shallow_cells_are_those_of_the_surface() {
        for depth in [1e-12, 1e-9] {
            for (x, y) in [(0.0, 0.0), (2.0, 1.0)] {
                let surface = rectangle_potential(x, y, 1.0, 1.0);
                assert!((rectangle(x, y, [1.0, 1.0], depth) / surface - 1.0).abs() < 1e-8);
                let surface = strip_potential(x, 1.0, 10.0);
                assert!((strip(x, 1.0, depth, 10.0) / surface - 1.0).abs() < 1e-8);
            }
        }
        for depth in [1e-3, 4.0, 15.0] {
            let edge = (FAR_FIELD * FAR_FIELD - depth * depth).sqrt();
            let (near, far) = (edge * (1.0 - 1e-13), edge * (1.0 + 1e-13));
            let [a, b] = [near, far].map(|x| rectangle(x, 0.0, [1.0, 0.3], depth));
            assert!((a / b - 1.0).abs() < 3e-9, "rectangle at {depth}: {a} {b}");
            let [a, b] = [near, far].map(|x| strip(x, 1.0, depth, 100.0));
            assert!((a / b - 1.0).abs() < 3e-9, "strip at {depth}: {a} {b}");
        }
    }
}
