//! Pressures between rigid bodies, and the load that they carry beyond the outer contact.

use super::outer::OuterContact;
use super::outer_grid::gap_at;
use crate::lubricant::Lubricant;
use crate::reynolds::outermost;

/// Range of films searched around that of the formula, and bisections of the search.
const RIGID_RANGE: f64 = 4.0;
const RIGID_BISECTIONS: u32 = 12;
/// Upper bound of the fraction of the load outside of the box during the iteration.
const MOST_OUTSIDE: f64 = 0.97;
/// Upper bound of the edge pressures \[Pa\]: larger reduced pressures may not correspond to any pressure.
const LARGEST_PRESSURE: f64 = 1e9;
/// Quadrature angles and radii for the load beyond the outer box.
const POINTS: u32 = 64;

impl OuterContact<'_> {
    /// Pressure between rigid bodies with central film `film` \[Pa\].
    pub(super) fn rigid_pressure(&self, point: [f64; 2], film: f64) -> f64 {
        let gap = film + gap_at(self.curvatures, point);
        let oil = self.model.lubricant.as_ref();
        oil.map_or(0.0, |oil| pressure_of(oil, self.far.reduced_pressure(self.drag, point, gap)))
    }

    /// The film that carries the load between rigid bodies, near `film` \[m\].
    pub(super) fn rigid_film(&self, film: f64) -> f64 {
        let grid = self.model.grid;
        let Some(oil) = &self.model.lubricant else { return film };
        let carried = |film: f64| {
            self.load_beyond(oil, film)
                + grid.nodes().map(|(x, y)| self.rigid_pressure([x, y], film)).sum::<f64>() * grid.cell_area()
        };
        let (mut low, mut high) = (film / RIGID_RANGE, film * RIGID_RANGE);
        for _ in 0..RIGID_BISECTIONS {
            let middle = (low * high).sqrt();
            if carried(middle) > self.model.hertz.force { low = middle } else { high = middle }
        }
        (low * high).sqrt()
    }

    /// Relaxes the edge pressures and the load beyond the edge towards those of the films.
    pub(super) fn relax_edge(&self, films: &[f64], share: f64, edge: &mut [f64], outside: &mut f64) {
        let grid = self.model.grid;
        let Some(oil) = &self.model.lubricant else { return };
        for k in outermost(&grid) {
            let point = [grid.x(k % grid.nx()), grid.y(k / grid.nx())];
            let reduced = self.far.reduced_pressure(self.drag, point, films[k]);
            edge[k] += share * (pressure_of(oil, reduced) - edge[k]);
        }
        let middle = grid.ny() / 2 * grid.nx();
        let film = films[middle] - self.gap[middle];
        if self.model.supplied_film.is_some_and(|supply| supply < films[middle]) {
            // The oil supply is inside the outer box.
            edge.fill(0.0);
            *outside = 0.0;
            return;
        }
        let beyond = self.load_beyond(oil, film).min(MOST_OUTSIDE * self.model.hertz.force);
        *outside += share * (beyond - *outside);
    }

    /// The load beyond the inner nodes' cells, for films equal to the gap plus `offset` \[N\].
    pub(super) fn load_beyond(&self, oil: &Lubricant, offset: f64) -> f64 {
        let grid = self.model.grid;
        let [x0, x1] = [grid.x(0) + 0.5 * grid.dx(), grid.x(grid.nx() - 1) - 0.5 * grid.dx()];
        let pressure = |[x, y]: [f64; 2]| {
            let film = offset + gap_at(self.curvatures, [x, y]);
            if film > 0.0 {
                pressure_of(oil, self.far.reduced_pressure(self.drag, [x, y], film))
            } else {
                0.0
            }
        };
        let middles = (0..POINTS).map(|i| (f64::from(i) + 0.5) / f64::from(POINTS));
        if grid.ny() == 1 {
            // With x = x0/s the integrand is smooth up to infinity.
            return middles.map(|s| pressure([x0 / s, 0.0]) * -x0 / (s * s)).sum::<f64>() / f64::from(POINTS)
                * grid.dy();
        }
        let [y0, y1] = [grid.y(0) + 0.5 * grid.dy(), grid.y(grid.ny() - 1) - 0.5 * grid.dy()];
        let mut sum = 0.0;
        for turn in middles.clone() {
            let (sin, cos) = (2.0 * std::f64::consts::PI * turn).sin_cos();
            let reach = |direction: f64, low: f64, high: f64| match direction {
                d if d < 0.0 => low / d,
                d if d > 0.0 => high / d,
                _ => f64::INFINITY,
            };
            let radius = reach(cos, x0, x1).min(reach(sin, y0, y1));
            let along =
                |s: f64| pressure([cos * radius / s, sin * radius / s]) * radius * radius / (s * s * s);
            sum += middles.clone().map(along).sum::<f64>();
        }
        sum * 2.0 * std::f64::consts::PI / f64::from(POINTS * POINTS)
    }
}

/// The pressure whose reduced pressure is `reduced` \[Pa\].
fn pressure_of(oil: &Lubricant, reduced: f64) -> f64 {
    // The reduced pressure is concave: Newton's method increases to the root from below.
    let mut pressure = reduced.max(0.0);
    for _ in 0..60 {
        let point = oil.at(pressure);
        let change = (reduced - point.reduced_pressure) / point.reduced_slope;
        pressure += change;
        if change.is_nan() || change <= 1e-9 * pressure {
            break;
        }
    }
    pressure.min(LARGEST_PRESSURE)
}
