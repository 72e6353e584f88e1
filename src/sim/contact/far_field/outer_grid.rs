//! The box and the mesh of the outer contact.

use crate::error::InputError;
use crate::grid::Grid;
use crate::sim::contact::model::ContactModel;
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::HertzContact;

/// Upstream length of the box, in half-widths of the contact and in film lengths `sqrt(2 R h)`.
const UPSTREAM: [f64; 2] = [10.0, 7.0];
/// Downstream and lateral length over the upstream one.
const DOWNSTREAM: f64 = 0.5;
const ASIDE: f64 = 0.6;
/// Smallest length over that of the inner box.
const LONGER: f64 = 1.5;
/// Cell size, in half-widths and film lengths.
const CELLS: [f64; 2] = [0.25, 0.1];
/// Half-width of the initial pressures, in film lengths and in cells.
const START: [f64; 2] = [0.7, 1.6];

/// Second derivatives of the gap along x, across and along y \[1/m\].
pub(super) fn curvatures(scene: &Scene) -> [f64; 3] {
    let (radius_x, radius_y) = scene.form.radii();
    let (sin, cos) = scene.form.angle().sin_cos();
    let (first, second) = (1.0 / radius_x, 1.0 / radius_y);
    [
        cos * cos * first + sin * sin * second,
        sin * cos * (first - second),
        sin * sin * first + cos * cos * second,
    ]
}

pub(super) fn gap_at([xx, xy, yy]: [f64; 3], [x, y]: [f64; 2]) -> f64 {
    0.5 * (xx * x * x + 2.0 * xy * x * y + yy * y * y)
}

/// The Hertz contact with the pressure of its load on half-widths that the outer cells and the inlet of the film can hold.
pub(super) fn start(
    mut hertz: HertzContact,
    lengths: [f64; 2],
    cells: [f64; 2],
    is_line: bool,
) -> HertzContact {
    let [a, b] = hertz.half_extents();
    let wide = |half: f64, axis: usize| half.max(START[0] * lengths[axis]).max(START[1] * cells[axis]);
    hertz.angle = 0.0;
    hertz.half_width_x = wide(a, 0);
    if is_line {
        hertz.pressure = 2.0 * hertz.force / (std::f64::consts::PI * hertz.half_width_x);
    } else {
        hertz.half_width_y = wide(b, 1);
        let area = std::f64::consts::PI * hertz.half_width_x * hertz.half_width_y;
        hertz.pressure = 1.5 * hertz.force / area;
    }
    hertz
}

/// Distances along x and y at which the gap equals the film \[m\].
pub(super) fn film_lengths([xx, _, yy]: [f64; 3], film: f64) -> [f64; 2] {
    [xx, yy].map(|curvature| (2.0 * film / curvature).sqrt())
}

/// Mesh of the outer contact, larger than the inner box on all sides.
pub(super) fn outer_grid(
    inner: &ContactModel,
    curvatures: [f64; 3],
    film: f64,
    is_line: bool,
) -> Result<Grid, InputError> {
    let halves = inner.hertz.half_extents();
    let lengths = film_lengths(curvatures, film);
    let of = |shares: [f64; 2], axis: usize| {
        let film = if lengths[axis].is_finite() { shares[1] * lengths[axis] } else { 0.0 };
        film.max(shares[0] * halves[axis])
    };
    let box_ = &inner.grid;
    let span = |first: f64, width: f64, n: usize| [first - 0.5 * width, first + (n as f64 - 0.5) * width];
    let [x0, x1] = span(box_.x(0), box_.dx(), box_.nx());
    let upstream = of(UPSTREAM, 0).max(-LONGER * x0);
    let downstream = (DOWNSTREAM * upstream).max(LONGER * x1);
    let dx = of(CELLS, 0);
    let count = |length: f64, cell: f64| (length / cell).ceil().max(3.0);
    let (west, east) = (count(upstream, dx), count(downstream, dx));
    let nx = (west + east) as usize + 1;
    // One node is at the center of the contact.
    let x = [-(west + 0.5) * dx, (east + 0.5) * dx];
    if is_line {
        return Grid::from_edges(nx, 1, x, [-0.5, 0.5]);
    }
    let [y0, y1] = span(box_.y(0), box_.dy(), box_.ny());
    let aside = (ASIDE * of(UPSTREAM, 1)).max(LONGER * y1.max(-y0));
    let dy = of(CELLS, 1);
    let half = count(aside, dy);
    Grid::from_edges(nx, 2 * half as usize + 1, x, [-(half + 0.5) * dy, (half + 0.5) * dy])
}
