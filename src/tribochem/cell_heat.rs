//! Heat of a moving source that is uniform over a cell.

/// Distance in half sides of a cell from which on four points represent the cell: the error of `1/r` is below 3e-6.
const FAR: f64 = 16.0;
/// Largest change of the exponent over such a cell, along x and along y: the error of the decay is below 2e-5.
const SMOOTH: f64 = 0.5;
/// Largest quadratic part of the exponent between the ends of such a cell: the error is below 2e-5.
const STRAIGHT: f64 = 0.08;
/// Exponent of the decay beyond which heat does not arrive: `e^-40` is below rounding.
const NO_HEAT: f64 = 40.0;

/// Integral of `exp[-decay (r - x)] / r` over the cell at `(x, y)` with half sides `half`: zero where no heat arrives, by
/// Gauss' rule with two points along each axis where the kernel is smooth over the cell, else by [`cell_integral`].
pub(super) fn heat_of_cell(x: f64, y: f64, half: [f64; 2], decay: f64) -> f64 {
    if is_cold(x, y, half, decay) {
        return 0.0;
    }
    let (radius, longest) = (length(x, y), half[0].max(half[1]));
    let change = |distance: f64, half: f64| 2.0 * decay * half * distance;
    let is_smooth = radius >= FAR * longest
        && 2.0 * decay * longest * longest <= STRAIGHT * radius
        && change(lag(x, y, radius), half[0]) <= SMOOTH * radius
        && change(y.abs(), half[1]) <= SMOOTH * radius;
    if !is_smooth {
        return cell_integral(x, y, half, decay);
    }
    let [along, across] = half.map(|half| half / 3.0_f64.sqrt());
    let mut sum = 0.0;
    for (x, y) in
        [(x - along, y - across), (x - along, y + across), (x + along, y - across), (x + along, y + across)]
    {
        let radius = length(x, y);
        sum += (-decay * lag(x, y, radius)).exp() / radius;
    }
    sum * half[0] * half[1]
}

/// Whether no heat arrives from a cell at `x` and at the distance `y` or more along y.
pub(super) fn is_cold(x: f64, y: f64, half: [f64; 2], decay: f64) -> bool {
    // Its corner from which heat arrives first.
    let (x, y) = (x + half[0], (y.abs() - half[1]).max(0.0));
    decay * lag(x, y, length(x, y)) > NO_HEAT
}

/// Integral of `exp[-decay (r - x)] / r` over the rectangle centred on `(x, y)` with half sides `half`.
///
/// In polar coordinates the radial integral is `R phi(decay (R - x))`, `phi(s) = (1 - e^-s)/s`, at the
/// boundary of the cell. One regular integral remains for each side, signed by its distance `d` from the
/// origin. With `t = |d| sinh(u)` along the side it is `d int phi du`, exact for a body at rest and without
/// singularity.
pub(super) fn cell_integral(x: f64, y: f64, half: [f64; 2], decay: f64) -> f64 {
    let (x0, x1, y0, y1) = (x - half[0], x + half[0], y - half[1], y + half[1]);
    let vertical = |d: f64| side(d, [y0, y1], |t, radius| phi(decay * lag(d, t, radius)));
    let horizontal = |d: f64| side(d, [x0, x1], |t, radius| phi(decay * lag(t, d, radius)));
    vertical(x1) - vertical(x0) + horizontal(y1) - horizontal(y0)
}

/// `d int f(t, R)/R dt` along a side at signed distance `d`, `R^2 = d^2 + t^2`.
fn side(d: f64, ends: [f64; 2], f: impl Fn(f64, f64) -> f64) -> f64 {
    let distance = d.abs();
    if distance <= 0.0 {
        return 0.0;
    }
    let along = |u: f64| {
        let growing = u.exp();
        let t = 0.5 * distance * (growing - 1.0 / growing);
        f(t, t.hypot(distance))
    };
    d * adaptive(&along, (ends[0] / distance).asinh(), (ends[1] / distance).asinh(), MAX_DEPTH)
}

/// Length of a vector whose squares neither overflow nor vanish.
fn length(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// `r - x` without cancellation downstream.
fn lag(x: f64, y: f64, radius: f64) -> f64 {
    if x > 0.0 { y * y / (radius + x) } else { radius - x }
}

/// `(1 - e^-s)/s`.
fn phi(s: f64) -> f64 {
    if s < 1e-12 { 1.0 } else { -(-s).exp_m1() / s }
}

/// Largest recursion depth of the quadrature.
const MAX_DEPTH: usize = 14;
/// Accepted difference of the two rules, relative to the length of the interval (integrands are at most 1).
const QUADRATURE_TOLERANCE: f64 = 1e-10;

/// Nodes and weights of the Gauss (7) and Kronrod (15) pair: node, Kronrod weight, Gauss weight.
const RULE: [(f64, f64, f64); 8] = [
    (0.991_455_371_120_812_6, 0.022_935_322_010_529_224, 0.0),
    (0.949_107_912_342_758_5, 0.063_092_092_629_978_55, 0.129_484_966_168_869_7),
    (0.864_864_423_359_769_1, 0.104_790_010_322_250_18, 0.0),
    (0.741_531_185_599_394_4, 0.140_653_259_715_525_92, 0.279_705_391_489_276_67),
    (0.586_087_235_467_691_1, 0.169_004_726_639_267_9, 0.0),
    (0.405_845_151_377_397_2, 0.190_350_578_064_785_4, 0.381_830_050_505_118_9),
    (0.207_784_955_007_898_47, 0.204_432_940_075_298_9, 0.0),
    (0.0, 0.209_482_141_084_727_82, 0.417_959_183_673_469_4),
];

/// Adaptive Gauss-Kronrod quadrature of `f` from `a` to `b`.
fn adaptive(f: &impl Fn(f64) -> f64, a: f64, b: f64, depth: usize) -> f64 {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    let (mut fine, mut coarse) = (0.0, 0.0);
    for (node, kronrod, gauss) in RULE {
        let value = if node > 0.0 { f(middle - half * node) + f(middle + half * node) } else { f(middle) };
        fine += kronrod * value;
        coarse += gauss * value;
    }
    if depth == 0 || (fine - coarse).abs() <= QUADRATURE_TOLERANCE {
        half * fine
    } else {
        adaptive(f, a, middle, depth - 1) + adaptive(f, middle, b, depth - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resting_cell_matches_the_closed_form() {
        let expected = 8.0 * 0.5 * 1.0_f64.asinh();
        assert!((cell_integral(0.0, 0.0, [0.5, 0.5], 0.0) - expected).abs() < 1e-14);
        let far = cell_integral(300.0, 40.0, [0.5, 0.5], 0.0);
        let monopole = 1.0 / 300.0_f64.hypot(40.0);
        assert!((far / monopole - 1.0).abs() < 1e-6, "{far} {monopole}");
    }

    /// Compared with midpoint sums on a fine mesh away from the singular point.
    #[test]
    fn moving_cell_matches_a_fine_sum() {
        for decay in [0.1, 3.0, 50.0] {
            for (x, y) in [(2.0, 0.0), (2.0, 1.0), (-2.0, 1.0), (0.0, 1.0), (30.0, 2.0)] {
                let n = 800;
                let mut sum = 0.0;
                for j in 0..n {
                    for i in 0..n {
                        let xs: f64 = x - 0.5 + (i as f64 + 0.5) / n as f64;
                        let ys: f64 = y - 0.5 + (j as f64 + 0.5) / n as f64;
                        let r = xs.hypot(ys);
                        sum += (-decay * lag(xs, ys, r)).exp() / r;
                    }
                }
                sum /= (n * n) as f64;
                let found = cell_integral(x, y, [0.5, 0.5], decay);
                assert!((found - sum).abs() < 1e-4 * sum + 1e-9, "{decay} {x} {y}: {found} {sum}");
            }
        }
    }

    /// Bodies at rest, slow, fast and very fast ones, square and oblong cells: the largest difference from the exact
    /// integral, over the integral of the cell under the node.
    #[test]
    fn far_cells_by_four_points_match_the_integral() {
        for decay in [0.0, 0.01, 0.3, 3.0, 30.0] {
            for half in [[0.5, 0.5], [0.25, 1.0], [1.0, 0.25]] {
                let largest = cell_integral(0.0, 0.0, half, decay);
                for (i, j) in (-60..60).step_by(3).flat_map(|i| (0..60).step_by(2).map(move |j| (i, j))) {
                    let (x, y) = (2.0 * half[0] * f64::from(i), 2.0 * half[1] * f64::from(j));
                    let (found, exact) = (heat_of_cell(x, y, half, decay), cell_integral(x, y, half, decay));
                    assert!(
                        (found - exact).abs() < 1e-6 * largest,
                        "{decay} {half:?} {i} {j}: {found} {exact}"
                    );
                    assert!((found - exact).abs() < 3e-5 * exact + 1e-12, "{decay} {i} {j}: {found} {exact}");
                }
            }
        }
    }

    /// The integral is additive over the quarters of a cell.
    #[test]
    fn quarters_add_up_to_the_cell_under_the_node() {
        for decay in [0.0, 0.5, 20.0, 400.0] {
            let whole = cell_integral(0.1, 0.2, [0.5, 0.5], decay);
            let mut parts = 0.0;
            for (i, j) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
                parts += cell_integral(0.1 + 0.25 * i, 0.2 + 0.25 * j, [0.25, 0.25], decay);
            }
            assert!((whole / parts - 1.0).abs() < 1e-8, "{decay}: {whole} {parts}");
        }
    }
}
