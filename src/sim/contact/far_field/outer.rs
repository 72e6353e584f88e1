//! The smooth contact in a box that contains its inlet, with edge pressures of rigid bodies.

use super::hand_over::{interpolate, shares_outside};
use super::{Closure, FarField};
use crate::analytic::RigidParaboloids;
use crate::elastic::{DeformationModel, WithLocalCompliance};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::report::Status;
use crate::reynolds::{ContactState, FaceMobility, FilmFlows, NewtonKrylov, StoppingRule, outermost};
use crate::sim::contact::film_heat::{self, FilmIteration, SolveContext};
use crate::sim::contact::film_temperature;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::interrupt::Interruptible;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::{ContactModel, half_space};
use crate::sim::error::SimError;
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
/// Film length, in half-widths, above which a solve starts from rigid bodies; the range of films searched around that
/// of the formula, and the bisections of the search.
const RIGID: f64 = 1.5;
const RIGID_RANGE: f64 = 4.0;
const RIGID_BISECTIONS: u32 = 12;
/// Relaxation of the edge pressures, largest number of iterations, and tolerance of the central film.
const RELAXATION: f64 = 0.6;
const TURNS: usize = 40;
const SETTLED: f64 = 2e-4;
/// Upper bound of the fraction of the load outside of the box during the iteration.
const MOST_OUTSIDE: f64 = 0.97;
/// Fraction of the load outside of the inner box above which its film is prescribed instead of its load.
const FILM_FROM: f64 = 0.9;
/// Position of the prescribed film, in distances of the inlet edge of the inner box.
const FILM_AT: f64 = 0.9;
/// Upper bound of the edge pressures \[Pa\]: larger reduced pressures may not correspond to any pressure.
const LARGEST_PRESSURE: f64 = 1e9;
/// Quadrature angles and radii for the load beyond the outer box.
const POINTS: u32 = 64;

/// The outer contact of an inner one.
pub(in crate::sim) struct OuterContact<'a> {
    scene: &'a Scene,
    model: ContactModel,
    far: RigidParaboloids,
    /// Viscosity at ambient pressure times entrainment speed \[N/m\].
    drag: f64,
    /// Gap of the undeformed bodies \[m\].
    gap: Vec<f64>,
    /// Second derivatives of that gap along x, across and along y \[1/m\].
    curvatures: [f64; 3],
    /// Half-width of the Hertz contact along x \[m\].
    half_width: f64,
}

impl<'a> OuterContact<'a> {
    /// For the smooth bodies of `inner` under its conditions, with a central film of about `film` \[m\].
    pub(in crate::sim) fn new(scene: &'a Scene, inner: &ContactModel, film: f64) -> Result<Self, InputError> {
        let is_line = scene.form.is_line();
        let curvatures = curvatures(scene);
        let grid = outer_grid(inner, curvatures, film, is_line)?;
        let mut gap = vec![0.0; grid.len()];
        scene.form.gap_into(&grid, &mut gap)?;
        let reference = scene.form.radii().0.max(grid.size_x());
        let body = Interruptible::new(
            half_space(scene, grid, reference)?,
            inner.deformation.bodies().interrupt().cloned(),
        );
        let hertz = inner.hertz.per_metre(&inner.grid);
        let [a, _] = hertz.half_extents();
        let hertz = start(hertz, film_lengths(curvatures, film), [grid.dx(), grid.dy()], is_line);
        let mut lubricant = inner.lubricant.clone();
        if let Some(lubricant) = &mut lubricant {
            lubricant.forget_film_temperatures();
        }
        let viscosity = lubricant.as_ref().map_or(0.0, |oil| oil.viscosity().viscosity(0.0));
        let model = ContactModel {
            grid,
            hertz,
            form_gap: Vec::new(),
            deformation: WithLocalCompliance::new(body),
            films: None,
            lubricant,
            solver: Box::new(NewtonKrylov::new()),
            verifies: false,
            rule: StoppingRule::default(),
            scheme: inner.scheme,
            face_mobility: FaceMobility::Wedge,
            cavitation: inner.cavitation,
            supplied_film: inner.supplied_film,
            shear_thinning: inner.shear_thinning,
            film_cutoff: inner.film_cutoff,
            contact: inner.contact,
            motion: inner.motion,
            load: inner.load,
            bulk_temperature: inner.bulk_temperature,
            formulas: inner.formulas,
            stated_film: inner.stated_film,
            evaluation: None,
            reuses_buffers: true,
            flow: None,
            film_flows: film_temperature::models_film_temperature(scene).then(FilmFlows::default),
            inlet: None,
            far_field: None,
        };
        let far = RigidParaboloids::new(curvatures)?;
        Ok(Self {
            half_width: a,
            curvatures,
            scene,
            drag: viscosity * inner.motion.entrainment_speed,
            model,
            far,
            gap,
        })
    }

    /// Solves it, from pressures for a film of about `film` \[m\]; `None` if a solve does not converge.
    pub(in crate::sim) fn solve(
        mut self,
        inner: &Grid,
        laws: &Laws,
        film: f64,
    ) -> Result<Option<FarField>, SimError> {
        let solved = self.far_field(inner, laws, film);
        let is_interrupted = self.model.deformation.bodies().is_interrupted();
        if is_interrupted { Err(SimError::Interrupted) } else { solved }
    }

    fn far_field(&mut self, inner: &Grid, laws: &Laws, film: f64) -> Result<Option<FarField>, SimError> {
        let grid = self.model.grid;
        let films = [vec![0.0; grid.len()], vec![0.0; grid.len()]];
        let mut friction = FrictionFields::new(self.scene, grid.len())?;
        let mut heat = FilmIteration::new(self.scene, &self.model)?;
        let (mut state, film) = self.start(film)?;
        let (mut edge, mut outside) = (vec![0.0; grid.len()], 0.0);
        let mut edge_film: Vec<f64> = self.gap.iter().map(|gap| gap + film).collect();
        let mut central = film;
        for turn in 0..TURNS {
            let share = if turn == 0 { 1.0 } else { RELAXATION };
            self.relax_edge(&edge_film, share, &mut edge, &mut outside);
            // At first the film is known better than the load.
            let closure = if turn == 0 { Closure::Approach } else { Closure::LoadOutside(outside) };
            self.model.far_field = Some(FarField::at_edge(edge.clone(), closure));
            let given = SolveContext { laws, tribofilms: &films };
            let gap = &self.gap;
            let mut once =
                |model: &mut ContactModel, state: &mut ContactState| model.solve(gap, None, None, state);
            let contact = (&mut self.model, &mut state, &mut friction);
            let (report, _) = film_heat::solve(&given, heat.as_mut(), contact, &mut once)?;
            if report.status != Status::Converged {
                return Ok(None);
            }
            edge_film.copy_from_slice(&state.film);
            let now = interpolate(&grid, &state.film, [0.0; 2], false);
            if turn > 0 && (now / central - 1.0).abs() < SETTLED {
                return self.hand_over(inner, &state, &edge, &friction).map(Some);
            }
            central = now;
        }
        Ok(None)
    }

    /// A state near the solution, and its central film \[m\]: Hertz pressure with `film` between the bodies, or the pressure
    /// between rigid bodies if the film is wider than the contact.
    fn start(&mut self, film: f64) -> Result<(ContactState, f64), InputError> {
        let grid = self.model.grid;
        let mut state = ContactState::new(&grid);
        let hertz = self.model.hertz;
        let (a, b) = (hertz.half_width_x, hertz.half_width_y);
        let is_rigid = film_lengths(self.curvatures, film)[0] > RIGID * self.half_width;
        let film = if is_rigid { self.rigid_film(film) } else { film };
        for (k, (x, y)) in grid.nodes().enumerate() {
            state.pressure[k] = if is_rigid {
                self.rigid_pressure([x, y], film)
            } else {
                let across = if grid.ny() == 1 { 0.0 } else { (y / b).powi(2) };
                hertz.pressure * (1.0 - (x / a).powi(2) - across).max(0.0).sqrt()
            };
        }
        for k in outermost(&grid) {
            state.pressure[k] = 0.0;
        }
        state.fluid_pressure.clone_from(&state.pressure);
        let mut displacement = vec![0.0; grid.len()];
        self.model.deformation.displacement(&state.pressure, &mut displacement)?;
        state.approach = interpolate(&grid, &displacement, [0.0; 2], false) - film;
        Ok((state, film))
    }

    /// Pressure between rigid bodies with central film `film` \[Pa\].
    fn rigid_pressure(&self, point: [f64; 2], film: f64) -> f64 {
        let gap = film + gap_at(self.curvatures, point);
        let oil = self.model.lubricant.as_ref();
        oil.map_or(0.0, |oil| pressure_of(oil, self.far.reduced_pressure(self.drag, point, gap)))
    }

    /// The film that carries the load between rigid bodies, near `film` \[m\].
    fn rigid_film(&self, film: f64) -> f64 {
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
    fn relax_edge(&self, films: &[f64], share: f64, edge: &mut [f64], outside: &mut f64) {
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
    fn load_beyond(&self, oil: &Lubricant, offset: f64) -> f64 {
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

    /// The far field of the inner box.
    fn hand_over(
        &mut self,
        inner: &Grid,
        state: &ContactState,
        edge: &[f64],
        friction: &FrictionFields,
    ) -> Result<FarField, SimError> {
        let grid = self.model.grid;
        let shares: Vec<f64> = shares_outside(&grid, inner).collect();
        let area = grid.cell_area();
        let inside: f64 =
            state.pressure.iter().zip(&shares).map(|(p, share)| p * (1.0 - share)).sum::<f64>() * area;
        let (mut full, mut beyond) = (state.pressure.clone(), vec![0.0; grid.len()]);
        for k in outermost(&grid) {
            full[k] = edge[k];
        }
        for (beyond, (p, share)) in beyond.iter_mut().zip(full.iter().zip(&shares)) {
            *beyond = p * share;
        }
        let mut displaced = vec![0.0; grid.len()];
        self.model.deformation.displacement(&beyond, &mut displaced)?;
        let take = |field: &[f64], positive| -> Vec<f64> {
            inner.nodes().map(|(x, y)| interpolate(&grid, field, [x, y], positive)).collect()
        };
        // A line carries its load per metre, a strip that of its width.
        let length = inner.contact_length();
        let load = self.model.hertz.force;
        let load_outside = load - inside;
        let place = [FILM_AT * inner.x(0), 0.0];
        let closure = if load_outside > FILM_FROM * load {
            Closure::Film(place, interpolate(&grid, &state.film, place, false))
        } else {
            Closure::LoadOutside(load_outside * length)
        };
        let stress = |(k, share): (usize, &f64)| share * friction.stress(k);
        Ok(FarField {
            pressure: take(&full, true),
            displacement: take(&displaced, false),
            closure,
            approach: state.approach,
            friction_force: shares.iter().enumerate().map(stress).sum::<f64>() * area * length,
            gap: vec![0.0; inner.len()],
        })
    }
}

/// Second derivatives of the gap along x, across and along y \[1/m\].
fn curvatures(scene: &Scene) -> [f64; 3] {
    let (radius_x, radius_y) = scene.form.radii();
    let (sin, cos) = scene.form.angle().sin_cos();
    let (first, second) = (1.0 / radius_x, 1.0 / radius_y);
    [
        cos * cos * first + sin * sin * second,
        sin * cos * (first - second),
        sin * sin * first + cos * cos * second,
    ]
}

fn gap_at([xx, xy, yy]: [f64; 3], [x, y]: [f64; 2]) -> f64 {
    0.5 * (xx * x * x + 2.0 * xy * x * y + yy * y * y)
}

/// The Hertz contact with the pressure of its load on half-widths that the outer cells and the inlet of the film can hold.
fn start(mut hertz: HertzContact, lengths: [f64; 2], cells: [f64; 2], is_line: bool) -> HertzContact {
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
fn film_lengths([xx, _, yy]: [f64; 3], film: f64) -> [f64; 2] {
    [xx, yy].map(|curvature| (2.0 * film / curvature).sqrt())
}

/// Mesh of the outer contact, larger than the inner box on all sides.
fn outer_grid(
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
