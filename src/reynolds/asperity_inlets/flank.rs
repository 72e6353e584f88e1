//! The inlet of an asperity: the integral of `(h - h_c)/h^3` over the flank in front of a contact.

use std::f64::consts::PI;

use super::Field;
use super::valley_flow::ValleyFlow;

/// Limit of [`inlet_integral`] for a large argument, `4 pi/(27 sqrt 3)`.
pub(super) const WHOLE_INLET: f64 = 4.0 * PI / (27.0 * 1.732_050_807_568_877_2);

/// Gaps below this share of the contact film count as closed, which keeps slopes finite.
const CLOSED: f64 = 1e-9;

/// Changes of the gap to the power 2/3 over a half interval below this share have the film of the middle.
const UNIFORM: f64 = 1e-3;

/// `F(y) = integral from 0 to y of t^1.5/(1 + t^1.5)^3 dt`, the inlet integral of a flank whose gap to the power 2/3
/// rises with slope one.
pub(super) fn inlet_integral(y: f64) -> f64 {
    let s = y.max(0.0).sqrt();
    if s < 0.05 {
        // The difference of the integrals cancels here.
        return 2.0 * s.powi(5) * (0.2 - 0.375 * s.powi(3) + 6.0 / 11.0 * s.powi(6));
    }
    let [squares, cubes] = film_integrals(y);
    squares - cubes
}

/// Integrals of `1/h^2` and `1/h^3`, `h = 1 + t^1.5`, from 0 to `y >= 0`. With `s = sqrt(y)`, `J` the integral of
/// `s/(1 + s^3)` and `I = s^2/(1 + s^3) + J` they are `2/3 I` and `4/9 I + s^2/(3 (1 + s^3)^2)`.
fn film_integrals(y: f64) -> [f64; 2] {
    let s = y.sqrt();
    let cube = 1.0 + s.powi(3);
    let root = 3.0_f64.sqrt();
    // ln[(s^2 - s + 1)/(1 + s)^2] without overflow or cancellation at large s.
    let logarithm = (-3.0 * s / (1.0 + s).powi(2)).ln_1p() / 6.0;
    let primitive = logarithm + ((2.0 * s - 1.0) / root).atan() / root + PI / (6.0 * root);
    let sum = y / cube + primitive;
    [2.0 / 3.0 * sum, 4.0 / 9.0 * sum + y / (3.0 * cube * cube)]
}

/// Integrals of `1/h^2` and `1/h^3` over the half of the interval between two nodes that is next to the film `near`, of length
/// `length`. `far` is the film at the other node. The gap above `contact_film` to the power 2/3 is linear between the nodes.
pub(super) fn half_interval(near: f64, far: f64, length: f64, contact_film: f64) -> [f64; 2] {
    let root = |film: f64| (film / contact_film - 1.0).max(0.0).cbrt().powi(2);
    let first = root(near);
    let last = 0.5 * (first + root(far));
    let width = last - first;
    let [squares, cubes] = if width.abs() < UNIFORM * (1.0 + first) {
        let film = 1.0 + (0.5 * (first + last)).powf(1.5);
        [film.powi(-2), film.powi(-3)]
    } else {
        let [from, to] = [first, last].map(film_integrals);
        [(to[0] - from[0]) / width, (to[1] - from[1]) / width]
    };
    [length * squares / contact_film.powi(2), length * cubes / contact_film.powi(3)]
}

/// The inlet of the contact that begins at column `front` of row `j`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Front {
    /// Rise of the reduced pressure of an incompressible fluid up to the contact over `12 eta0 u` \[1/m\].
    pub(super) rise: f64,
    /// Slope of the gap over the contact film to the power 2/3 normal to the edge \[1/m\].
    pub(super) slope: f64,
}

impl Front {
    /// The rise up to the first node in front of the contact is that of the flow through the valleys. From there to the edge it
    /// is `cos^2(t) integral of (h - h_c)/h^3 dx`, `h = h_c + gap`. The gap to the power 2/3 is linear between nodes, so that the
    /// edge lies within its cell. `t` is the angle of the edge's normal to x: the flow across an oblique edge is `u cos(t)`, and
    /// its path is shorter by `cos(t)`.
    pub(super) fn new(
        field: &Field<'_>,
        valleys: &ValleyFlow,
        (j, front): (usize, usize),
        contact_film: f64,
    ) -> Self {
        // (gap/h_c)^(2/3) at a node; `None` in contact.
        let open = |i: usize, j: usize| {
            let k = j * field.grid.nx() + i;
            (field.pressure[k] <= 0.0).then(|| (field.gap[k] / contact_film).max(CLOSED).cbrt().powi(2))
        };
        let Some((node, first)) = front.checked_sub(1).and_then(|i| Some((i, open(i, j)?))) else {
            return Self::default();
        };
        // From the edge, at most one cell away, to the first node; the slope is that upstream of it.
        let second = node.checked_sub(1).and_then(|i| open(i, j)).unwrap_or(first);
        let along = (second - first).max(first) / field.grid.dx();
        let alignment = cosine_squared(&open, (front, j), along, &field.grid);
        let within_cell = inlet_integral(first) / along * alignment / contact_film.powi(2);
        // Without a flow through the valleys, that of the row alone from where the gap begins to fall.
        let rise = within_cell
            + valleys.rise(j * field.grid.nx() + node).unwrap_or_else(|| {
                let row = (0..node).rev().map_while(|i| open(i, j));
                let rows: f64 = row
                    .scan(first, |last, y| (y > *last).then(|| [std::mem::replace(last, y), y]))
                    .map(|[from, to]| (inlet_integral(to) - inlet_integral(from)) / (to - from))
                    .sum();
                rows * field.grid.dx() * alignment / contact_film.powi(2)
            });
        Self { rise, slope: along / alignment.sqrt() }
    }
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
    let k = j * grid.nx() + i;
    let [before, after] =
        [grid.south_of(k), grid.north_of(k)].map(|node| node.and_then(|node| open(i, node / grid.nx())));
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
    fn slope_of_a_straight_flank_is_exact_wherever_its_edge_lies() {
        let grid = Grid::centred(64, 5, 2e-7, 2e-7).unwrap();
        for (angle, offset) in [(0.0_f64, 0.0), (0.0, 3e-8), (0.0, 1.7e-7), (0.5, 3e-8), (-0.5, 1.1e-7)] {
            let [pressure, gap] = flank(&grid, angle, offset);
            let field = Field { grid, pressure: &pressure, gap: &gap };
            let front = (0..64).find(|i| pressure[2 * 64 + i] > 0.0).unwrap();
            let mut valleys = ValleyFlow::default();
            valleys.update(grid, &gap, 1e-9, || false).unwrap();
            let found = Front::new(&field, &valleys, (2, front), 1e-9);
            assert!((found.slope * 1e-7 - 1.0).abs() < 1e-3, "{angle} {offset}: {}", found.slope);
        }
    }

    /// Valley and inlet together, on cells of a quarter to eight flank lengths and for any place of the edge in its cell. The
    /// imbalance of the flow leaves up to 0.7 %.
    #[test]
    fn rise_to_a_straight_flank_is_that_of_its_whole_inlet() {
        for cell in [0.25, 1.0, 2.0, 4.0, 8.0] {
            let grid = Grid::centred(512, 1, cell * 1e-7, 1.0).unwrap();
            let whole = WHOLE_INLET * 1e-7 / 1e-18;
            for place in [0.0, 0.2, 0.4, 0.6, 0.8] {
                let [pressure, gap] = flank(&grid, 0.0, place * grid.dx());
                let mut valleys = ValleyFlow::default();
                valleys.update(grid, &gap, 1e-9, || false).unwrap();
                assert!(valleys.is_solved(), "{cell} {place}");
                let field = Field { grid, pressure: &pressure, gap: &gap };
                let front = (0..512).find(|i| pressure[*i] > 0.0).unwrap();
                let rise = Front::new(&field, &valleys, (0, front), 1e-9).rise;
                assert!((rise / whole - 1.0).abs() < 1e-2, "{cell} {place}: {}", rise / whole - 1.0);
            }
        }
    }

    #[test]
    fn contact_without_a_node_in_front_has_no_inlet() {
        let grid = Grid::centred(5, 5, 2e-7, 2e-7).unwrap();
        let field = Field { grid, pressure: &[1e9; 25], gap: &[0.0; 25] };
        assert!(Front::new(&field, &ValleyFlow::default(), (2, 0), 1e-9).rise.abs() == 0.0);
    }

    #[test]
    fn rise_without_a_valley_flow_is_that_of_the_row() {
        let grid = Grid::centred(512, 1, 1e-7, 1.0).unwrap();
        let [pressure, gap] = flank(&grid, 0.0, 3e-8);
        let field = Field { grid, pressure: &pressure, gap: &gap };
        let front = (0..512).find(|i| pressure[*i] > 0.0).unwrap();
        let rise = Front::new(&field, &ValleyFlow::default(), (0, front), 1e-9).rise;
        assert!((rise / (WHOLE_INLET * 1e-7 / 1e-18) - 1.0).abs() < 2e-3, "{rise:e}");
    }
}
