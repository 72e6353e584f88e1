//! The discrete Reynolds equation, once for all solvers.
//!
//! Finite volumes on the cells of the grid. The net outflow of cell `k`, multiplied by `dx / U` with `U` the
//! entrainment speed (or `dx / dt` if that is larger), is a film thickness \[m\]:
//!
//! `F_k = sum over faces of c a_face (phi_k - phi_neighbour) + w (M_east - M_west) + s (m_k - m_previous)`
//!
//! with `m = rho/rho_0 h`, `c = 1 / (U dx)` (faces in x) or `dx / (U dy^2)` (faces in y), `w = u / U` and
//! `s = dx / (U dt)`. `M` is what entrainment carries through a face ([`Scheme`]); `a_face`, a mean of
//! `h^3 / (12 eta_0)`, and the potential `phi` are those of the [`FaceMobility`].
//!
//! With shear thinning the mobility of a face is divided by the mean of `eta*/eta` of its two nodes
//! ([`ShearThinning`](super::ShearThinning)). Why not a mean of `a eta/eta*`: at steep viscosities the node
//! of high pressure has nearly all of that and nearly none of the change of `q`. Divided like this the flow
//! through a face still grows with the pressure of its node where `ln eta` is linear in pressure, as
//! `q_end - q <= (dq/dp) / (d ln eta/dp)`.
//!
//! Films that are warmer than the law have `eta*/eta` times the ratio of viscosities that the lubricant holds
//! for the node ([`Lubricant::viscosity_ratios`]); shear thinning then is that of the warmer fluid.
//!
//! In `a` the film counts as at least half the contact film, in `m` it counts as it is.

use super::balance::FlowBalance;
use super::cavitation::Cavitation;
use super::entrainment::{DensityRise, FaceFilm, Scheme};
use super::face_mobility::{Direction, FaceFlow, FaceMobility};
use super::inlet::Inlet;
use super::node::NodeFlow;
use super::shear_thinning::{ShearThinning, ViscosityRatio};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::reynolds::problem::{LubricatedContact, inner_rows, interior};

/// Weight of the first-order entrainment term in the preconditioner of the second-order one. Their ratio lies
/// between 1 (smooth fields) and 2 (from node to node).
const SECOND_ORDER_WEIGHT: f64 = 1.25;

/// The pressure is ambient at the edge of the box, half a cell beyond the outermost nodes, whose own pressure
/// counts as ambient: of the difference to the next nodes this share is left.
const EDGE_SHARE: f64 = 2.0 / 3.0;

/// Pressure difference over sum below which the secant of a potential is taken as the mean of its slopes.
const SECANT_SHARE: f64 = 1e-6;

/// A node across a face of coefficient `c`, held.
#[derive(Debug, Clone, Copy)]
pub(in crate::reynolds) struct HeldNeighbour {
    c: f64,
    flow: NodeFlow,
    ratio: ViscosityRatio,
    direction: Direction,
    /// Whether it is the first node of the face.
    is_first: bool,
}

/// Derivatives of what entrainment carries through a face beyond what its first node holds: by the pressures
/// of that node and of the one upstream, by the films of that node, of the second of the face and of the one
/// upstream.
pub(in crate::reynolds) type BeyondDerivatives = [f64; 5];

/// Quantities of the nodes and faces at the current pressure and film, and the coefficients of the balance.
#[derive(Debug, Clone)]
pub(in crate::reynolds) struct Discretisation {
    pub(in crate::reynolds) grid: Grid,
    face_mobility: FaceMobility,
    scheme: Scheme,
    cavitation: Cavitation,
    /// What enters a row of cells at most \[m\]; infinite at a flooded inlet.
    supply: f64,
    film_floor: f64,
    /// Film below which pressure moves nothing \[m\]; no such film in hard contact.
    closed_film: f64,
    face_x: f64,
    face_y: f64,
    wedge: f64,
    squeeze: f64,
    /// Squeeze against the masses at which a linear step begins: in the derivatives alone, as it vanishes
    /// there.
    pseudo_transient: f64,
    /// `1 / (12 eta_0)`.
    fluidity: f64,
    /// `U / dx` \[1/s\].
    rate: f64,
    nodes: Vec<NodeFlow>,
    /// `m` of the nodes \[m\].
    masses: Vec<f64>,
    /// `M` less `m` of the first node, and film over that of the first node, of the faces to the east.
    beyond: Vec<f64>,
    face_films: Vec<f64>,
    /// Factors of the inlets, and squares of the cosines between the flow and the gradient of the undeformed
    /// gap, at the faces to the east.
    inlets: Vec<f64>,
    alignments: Vec<f64>,
    /// `M` of the faces to the east \[m\], and the share `theta` of the gap that is filled.
    carried: Vec<f64>,
    content: Vec<f64>,
    /// Of nodes that are not filled, what of their inflow they carry on; zero elsewhere.
    passed: Vec<f64>,
    /// `a` of the faces to the east and to the north of the nodes.
    east: Vec<f64>,
    north: Vec<f64>,
    /// Film in which the fluid at ambient pressure has `x = 1` \[m\]; zero without shear thinning.
    thinning: f64,
    /// Viscosity of the nodes over that of the law; empty where they have its temperature.
    warmth: Vec<f64>,
    /// `eta*/eta` of the nodes; empty without shear thinning in films that have the temperature of the law.
    ratios: Vec<ViscosityRatio>,
}

/// First influence coefficients, for implicit relaxation \[m/Pa\].
#[derive(Debug, Clone, Copy)]
pub(in crate::reynolds) struct NearField {
    pub(in crate::reynolds) own: f64,
    pub(in crate::reynolds) next_x: f64,
    pub(in crate::reynolds) second_x: f64,
}

impl Discretisation {
    pub(in crate::reynolds) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self {
            grid,
            face_mobility: FaceMobility::default(),
            scheme: Scheme::default(),
            cavitation: Cavitation::default(),
            supply: f64::INFINITY,
            film_floor: 0.0,
            closed_film: f64::NEG_INFINITY,
            face_x: 0.0,
            face_y: 0.0,
            wedge: 0.0,
            squeeze: 0.0,
            pseudo_transient: 0.0,
            fluidity: 0.0,
            rate: 1.0,
            nodes: vec![NodeFlow::default(); grid.len()],
            masses: zeros(),
            beyond: zeros(),
            carried: zeros(),
            content: vec![1.0; grid.len()],
            passed: zeros(),
            face_films: vec![1.0; grid.len()],
            inlets: vec![1.0; grid.len()],
            alignments: vec![1.0; grid.len()],
            east: zeros(),
            north: zeros(),
            thinning: 0.0,
            warmth: Vec::new(),
            ratios: Vec::new(),
        }
    }

    /// Takes speeds, steps and schemes from the problem.
    pub(in crate::reynolds) fn configure(&mut self, problem: &LubricatedContact<'_>) {
        let (dx, dy) = (self.grid.dx(), self.grid.dy());
        let grid_speed = problem.squeeze.map_or(0.0, |s| dx / s.time_step);
        let speed = problem.entrainment_speed.max(grid_speed);
        self.face_mobility = problem.face_mobility;
        self.scheme = problem.scheme;
        self.cavitation = problem.cavitation;
        self.supply = problem.supplied_film.unwrap_or(f64::INFINITY);
        // Below the contact film, where only unfinished iterations are, the mobility keeps falling: a floor
        // at the contact film itself would hide from Newton that a node just under it can open.
        self.film_floor = 0.5 * problem.contact_film();
        self.closed_film = if problem.is_paper() { problem.contact_film() } else { f64::NEG_INFINITY };
        self.rate = speed / dx;
        self.face_x = 1.0 / (speed * dx);
        self.face_y = if self.grid.ny() == 1 { 0.0 } else { dx / (speed * dy * dy) };
        self.wedge = problem.entrainment_speed / speed;
        self.squeeze = grid_speed / speed;
        self.pseudo_transient = 0.0;
        let ambient = problem.lubricant.map(|l| l.viscosity().viscosity(0.0));
        self.fluidity = ambient.map_or(0.0, |eta| 1.0 / (12.0 * eta));
        let thinning = |(law, eta): (ShearThinning, f64)| law.length(eta);
        self.thinning = problem.shear_thinning.zip(ambient).map_or(0.0, thinning);
        self.warm(problem.lubricant.map_or(&[], Lubricant::viscosity_ratios), &problem.grid());
        let is_newtonian = self.thinning == 0.0 && self.warmth.is_empty();
        let thinned = if is_newtonian { 0 } else { self.grid.len() };
        self.ratios.resize(thinned, ViscosityRatio::NEWTONIAN);
        // Coarser grids, whose gaps are not those of the problem, only make corrections.
        if problem.gap.len() == self.grid.len() {
            self.align(problem.gap);
        }
    }

    /// Takes over the ratios of viscosity of the nodes of the grid `of` the problem, on a coarser grid those of
    /// the nodes next to its own.
    fn warm(&mut self, ratios: &[f64], of: &Grid) {
        self.warmth.clear();
        if ratios.len() == self.grid.len() {
            self.warmth.extend_from_slice(ratios);
        } else if !ratios.is_empty() {
            let (nx, ny) = (self.grid.nx(), self.grid.ny());
            let near = |i: usize, n: usize, fine: usize| ((2 * i + 1) * fine / (2 * n)).min(fine - 1);
            let nodes = (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j)));
            let at = |(i, j)| ratios[near(j, ny, of.ny()) * of.nx() + near(i, nx, of.nx())];
            self.warmth.extend(nodes.map(at));
        }
    }

    /// Takes the normals of edges from the undeformed gap.
    fn align(&mut self, gap: &[f64]) {
        let (nx, ny, n) = (self.grid.nx(), self.grid.ny(), self.grid.len());
        for k in (0..n - 1).filter(|k| k % nx + 1 < nx) {
            let (above, below) = (if k + nx < n { k + nx } else { k }, if k >= nx { k - nx } else { k });
            let rows = ((above - below) / nx).max(1) as f64;
            let along = (gap[k + 1] - gap[k]) / self.grid.dx();
            let rise = gap[above] + gap[above + 1] - gap[below] - gap[below + 1];
            let across = if ny == 1 { 0.0 } else { 0.5 * rise / (rows * self.grid.dy()) };
            let steepness = along * along + across * across;
            self.alignments[k] = if steepness > 0.0 { along * along / steepness } else { 1.0 };
        }
    }

    /// The quantities of a node at fluid pressure `p` and film `h`.
    #[inline]
    fn node_flow(&self, lubricant: &Lubricant, p: f64, h: f64) -> NodeFlow {
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        let square = self.fluidity * floored * floored;
        let is_closed = h < self.closed_film;
        let (film, cube) = if is_closed { (0.0, 0.0) } else { (floored, square * floored) };
        let film_h = if h > self.film_floor { 1.0 } else { 0.0 };
        let cube_h = 3.0 * square * film_h;
        let (density, density_p) = (point.density, point.density_slope);
        match self.face_mobility {
            FaceMobility::Arithmetic => NodeFlow {
                density,
                density_p,
                film,
                film_h,
                mobility: cube * point.reduced_slope,
                mobility_p: cube * point.reduced_curvature,
                mobility_h: cube_h * point.reduced_slope,
                potential: p,
                potential_p: 1.0,
            },
            FaceMobility::ReducedPressure | FaceMobility::Wedge | FaceMobility::Inlet => NodeFlow {
                density,
                density_p,
                film,
                film_h,
                mobility: cube,
                mobility_p: 0.0,
                mobility_h: cube_h,
                potential: point.reduced_pressure,
                potential_p: point.reduced_slope,
            },
        }
    }

    /// `eta*/eta` of node `k` at fluid pressure `p` and film `h`.
    fn viscosity_ratio(&self, lubricant: &Lubricant, k: usize, p: f64, h: f64) -> ViscosityRatio {
        let warmth = self.warmth.get(k).copied().unwrap_or(1.0);
        if self.thinning == 0.0 {
            return ViscosityRatio::NEWTONIAN.times(warmth);
        }
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        // Density over slope of the reduced pressure is the viscosity over that at ambient pressure.
        let x = warmth * self.thinning / floored * (point.density / point.reduced_slope);
        let by_pressure = point.density_slope / point.density - point.reduced_curvature / point.reduced_slope;
        let by_film = if h > self.film_floor { -1.0 / h } else { 0.0 };
        ViscosityRatio::new(x, by_pressure, by_film).times(warmth)
    }

    /// Takes over fluid pressure and film of every node, and the masses of the previous time, where there is
    /// one.
    pub(in crate::reynolds) fn update(
        &mut self,
        lubricant: &Lubricant,
        pressure: &[f64],
        film: &[f64],
        previous: Option<&[f64]>,
    ) {
        for (k, (&p, &h)) in pressure.iter().zip(film).enumerate() {
            self.nodes[k] = self.node_flow(lubricant, p, h);
            self.masses[k] = self.nodes[k].density * h;
        }
        if !self.ratios.is_empty() {
            for (k, (&p, &h)) in pressure.iter().zip(film).enumerate() {
                self.ratios[k] = self.viscosity_ratio(lubricant, k, p, h);
            }
        }
        self.update_entrainment();
        let (nx, n) = (self.grid.nx(), self.grid.len());
        for k in 0..n - 1 {
            self.east[k] = self.face_flow(k, k + 1, self.along(k)).mobility;
        }
        for k in 0..n - nx {
            self.north[k] = self.face_flow(k, k + nx, Direction::Across).mobility;
        }
        for (carried, (mass, beyond)) in self.carried.iter_mut().zip(self.masses.iter().zip(&self.beyond)) {
            *carried = mass + beyond;
        }
        self.content.fill(1.0);
        self.passed.fill(0.0);
        if self.cavitation == Cavitation::MassConserving {
            self.starve();
            for k in interior(&self.grid).filter(|k| pressure[*k] <= 0.0) {
                self.fill(k, previous);
            }
        }
    }

    /// Lets no more than the supply through the faces at the inlet edge.
    fn starve(&mut self) {
        for first in (0..self.grid.len()).step_by(self.grid.nx()) {
            let full = self.carried[first];
            if full > self.supply {
                self.content[first] = self.supply / full;
                self.carried[first] = self.supply;
            }
        }
    }

    /// Whether node `k` is one of the inlet edge that gets less than fills it: what it carries on does not
    /// depend on its film.
    #[inline]
    fn is_starved(&self, k: usize) -> bool {
        self.content[k] < 1.0 && k.is_multiple_of(self.grid.nx())
    }

    /// Fills the gap of node `k`, which has no pressure, by what enters it; upstream nodes come first.
    fn fill(&mut self, k: usize, previous: Option<&[f64]>) {
        let full = self.wedge * self.carried[k];
        let whole = full + self.squeeze * self.masses[k];
        let kept = previous.map_or(0.0, |previous| self.squeeze * previous[k]);
        let content = (self.wedge * self.carried[k - 1] + kept - self.pressure_outflow(k)) / whole;
        if whole > 0.0 && content < 1.0 {
            self.content[k] = content.max(0.0);
            self.carried[k] *= self.content[k];
            self.passed[k] = full / (whole + self.pseudo_transient * self.masses[k]);
        }
    }

    /// Flow by pressure out of node `k`.
    fn pressure_outflow(&self, k: usize) -> f64 {
        let own = self.nodes[k].potential;
        self.neighbours(k)
            .into_iter()
            .map(|(o, c, mobility)| c * mobility * (own - self.nodes[o].potential))
            .sum()
    }

    /// What entrainment carries through faces beyond what their first nodes hold, and the inlets.
    fn update_entrainment(&mut self) {
        for k in 0..self.nodes.len() {
            let film = self.face_film(k);
            self.inlets[k] = self.inlet(k).factor;
            let own = &self.nodes[k];
            self.face_films[k] = if film.beyond == 0.0 { 1.0 } else { 1.0 + film.beyond / own.film };
            self.beyond[k] = match self.scheme {
                Scheme::FirstOrder => 0.0,
                Scheme::Limited => {
                    let rise = self.density_rise(k).rise;
                    own.density * film.beyond + rise * (self.masses[k] / own.density + film.beyond)
                }
                Scheme::SecondOrder if k % self.grid.nx() == 0 => own.density * film.beyond,
                Scheme::SecondOrder => 0.5 * (self.masses[k] - self.masses[k - 1]),
            };
        }
    }

    /// Density of the face to the east of node `k` beyond that of the node, extrapolated from the nodes
    /// upstream.
    #[inline]
    fn density_rise(&self, k: usize) -> DensityRise {
        if k.is_multiple_of(self.grid.nx()) {
            return DensityRise::default();
        }
        let (own, up) = (&self.nodes[k], &self.nodes[k - 1]);
        let up_film = if self.face_mobility == FaceMobility::Inlet { up.film } else { own.film };
        DensityRise::new((own.density, own.film), (up.density, up_film))
    }

    /// The film of the face to the east of node `k`; that of the node itself of first order.
    #[inline]
    fn face_film(&self, k: usize) -> FaceFilm {
        let column = k % self.grid.nx();
        if self.scheme == Scheme::FirstOrder || column + 1 == self.grid.nx() {
            return FaceFilm::default();
        }
        let (own, next) = (self.nodes[k].film, self.nodes[k + 1].film);
        if column == 0 {
            FaceFilm::central(own, next)
        } else {
            FaceFilm::limited(self.nodes[k - 1].film, own, next)
        }
    }

    /// The inlet at the face to the east of node `k`.
    #[inline]
    fn inlet(&self, k: usize) -> Inlet {
        let column = k % self.grid.nx();
        if self.face_mobility != FaceMobility::Inlet || column == 0 || column + 1 == self.grid.nx() {
            return Inlet::NONE;
        }
        Inlet::new(self.nodes[k - 1].film, self.nodes[k].film, self.nodes[k + 1].film, self.alignments[k])
    }

    /// The direction of the face to the east of node `k`: nothing distinguishes it from one across where
    /// nothing is carried.
    #[inline]
    fn along(&self, k: usize) -> Direction {
        if self.wedge > 0.0 {
            Direction::Along(self.face_films[k], self.inlets[k])
        } else {
            Direction::Across
        }
    }

    /// Mobility of the face between the nodes `a` and `b`.
    #[inline]
    fn face_flow(&self, a: usize, b: usize, direction: Direction) -> FaceFlow {
        let flow = self.face_mobility.of(self.fluidity, &self.nodes[a], &self.nodes[b], direction);
        if self.ratios.is_empty() { flow } else { flow.thinned(self.ratios[a], self.ratios[b]) }
    }

    /// What node `k` holds, `theta rho/rho_0 h` \[m\].
    pub(in crate::reynolds) fn held_mass(&self, k: usize) -> f64 {
        self.content[k] * self.masses[k]
    }

    /// The share of the gaps that is filled.
    pub(in crate::reynolds) fn content(&self) -> &[f64] {
        &self.content
    }

    /// What node `k` carries on of a change of its inflow, where it is not filled; zero elsewhere.
    pub(in crate::reynolds) fn passed(&self, k: usize) -> f64 {
        self.passed[k]
    }

    /// `c` of the face to the east of node `k`.
    #[inline]
    fn coefficient_east(&self, k: usize) -> f64 {
        let column = k % self.grid.nx();
        let at_edge = column == 0 || column + 2 == self.grid.nx();
        if at_edge { EDGE_SHARE * self.face_x } else { self.face_x }
    }

    /// `c` of the face to the north of node `k`.
    #[inline]
    fn coefficient_north(&self, k: usize) -> f64 {
        let nx = self.grid.nx();
        let at_edge = k < nx || k + 2 * nx >= self.grid.len();
        if at_edge { EDGE_SHARE * self.face_y } else { self.face_y }
    }

    /// Neighbours of node `k` (east, west, north, south) with coefficients and mobilities of the faces;
    /// across a line contact they are the node itself.
    #[inline]
    fn neighbours(&self, k: usize) -> [(usize, f64, f64); 4] {
        let nx = if self.grid.ny() == 1 { 0 } else { self.grid.nx() };
        [
            (k + 1, self.coefficient_east(k), self.east[k]),
            (k - 1, self.coefficient_east(k - 1), self.east[k - 1]),
            (k + nx, self.coefficient_north(k), self.north[k]),
            (k - nx, self.coefficient_north(k - nx), self.north[k - nx]),
        ]
    }

    /// Overrides the schemes of the problem until the next [`Self::configure`].
    pub(in crate::reynolds) fn set_scheme(&mut self, scheme: Scheme, face_mobility: FaceMobility) {
        self.scheme = scheme;
        self.face_mobility = face_mobility;
    }

    /// Overrides the condition of the problem until the next [`Self::configure`].
    pub(in crate::reynolds) fn set_cavitation(&mut self, cavitation: Cavitation) {
        self.cavitation = cavitation;
    }

    /// Makes the next linear steps, until [`Self::configure`], steps in time of `1 / share` passages of a
    /// cell.
    pub(in crate::reynolds) fn set_pseudo_transient(&mut self, share: f64) {
        self.pseudo_transient = share * self.wedge;
    }

    /// Physical imbalance per `F`: `U / dx` \[1/s\].
    pub(in crate::reynolds) fn rate(&self) -> f64 {
        self.rate
    }

    /// Flow over pressure difference of the faces to the east and to the north of node `k` \[m/Pa\], at the
    /// pressures of the last update.
    pub(in crate::reynolds) fn conductances(&self, k: usize, pressure: &[f64]) -> [f64; 2] {
        let towards = |o: usize, c: f64, mobility: f64| {
            let (a, b) = (&self.nodes[k], &self.nodes[o]);
            let difference = pressure[k] - pressure[o];
            let slope = if difference.abs() > SECANT_SHARE * (pressure[k] + pressure[o]) {
                (a.potential - b.potential) / difference
            } else {
                0.5 * (a.potential_p + b.potential_p)
            };
            c * mobility * slope
        };
        [
            towards(k + 1, self.coefficient_east(k), self.east[k]),
            towards(k + self.grid.nx(), self.coefficient_north(k), self.north[k]),
        ]
    }

    /// Coefficients of `m` at `k`, `k - 1` and `k - 2` in the entrainment term, where it is linear in `m`;
    /// those of first order of the limited scheme and beside the inlet.
    #[inline]
    pub(in crate::reynolds) fn upwind(&self, k: usize) -> [f64; 3] {
        let w = self.wedge;
        match self.scheme {
            Scheme::SecondOrder if k % self.grid.nx() >= 2 => [1.5 * w, -2.0 * w, 0.5 * w],
            _ => [w, -w, 0.0],
        }
    }

    /// `F_k` for an interior node at the last update, its own gap filled.
    pub(in crate::reynolds) fn balance(&self, k: usize, previous: Option<&[f64]>) -> f64 {
        self.transport(k, previous) + self.pressure_outflow(k)
    }

    /// What leaves interior node `k` beyond what enters, its gap filled to its content: zero where the
    /// content makes it so.
    pub(in crate::reynolds) fn imbalance(&self, k: usize, previous: Option<&[f64]>) -> f64 {
        let stored = previous.map_or(0.0, |previous| self.squeeze * (self.held_mass(k) - previous[k]));
        self.wedge * (self.carried[k] - self.carried[k - 1]) + stored + self.pressure_outflow(k)
    }

    /// Whether cells that are not filled carry on what they got.
    pub(in crate::reynolds) fn conserves_mass(&self) -> bool {
        self.cavitation == Cavitation::MassConserving
    }

    /// Flows through the edges of the box and growth of the mass in it.
    pub(in crate::reynolds) fn flow_balance(&self, previous: Option<&[f64]>) -> FlowBalance {
        let (inflow, outflow) = self.edge_flow();
        let grown = previous.map_or(0.0, |previous| {
            interior(&self.grid).map(|k| self.held_mass(k) - previous[k]).sum::<f64>()
        });
        FlowBalance::new(inflow, outflow, self.rate * self.grid.cell_area() * self.squeeze * grown)
    }

    /// Flow into and out of the box through the faces to its outermost nodes \[m^3/s\].
    pub(in crate::reynolds) fn edge_flow(&self) -> (f64, f64) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let (mut inflow, mut outflow) = (0.0, 0.0);
        let mut count = |out: f64| if out > 0.0 { outflow += out } else { inflow -= out };
        for first in inner_rows(&self.grid).map(|j| j * nx) {
            let through = |k: usize| {
                let drop = self.nodes[k].potential - self.nodes[k + 1].potential;
                self.wedge * self.carried[k] + self.coefficient_east(k) * self.east[k] * drop
            };
            count(-through(first));
            count(through(first + nx - 2));
        }
        if self.grid.ny() > 1 {
            let through = |k: usize| {
                let drop = self.nodes[k].potential - self.nodes[k + nx].potential;
                self.coefficient_north(k) * self.north[k] * drop
            };
            for i in 1..nx - 1 {
                count(-through(i));
                count(through(n - 2 * nx + i));
            }
        }
        let unit = self.rate * self.grid.cell_area();
        (unit * inflow, unit * outflow)
    }

    /// Entrainment and squeeze of `F_k`.
    pub(in crate::reynolds) fn transport(&self, k: usize, previous: Option<&[f64]>) -> f64 {
        let mut sum = self.wedge * (self.masses[k] + self.beyond[k] - self.carried[k - 1]);
        if let Some(previous) = previous {
            sum += self.squeeze * (self.masses[k] - previous[k]);
        }
        sum
    }

    /// Flow through all faces of node `k` per potential, neighbours held.
    fn conductance(&self, k: usize) -> f64 {
        self.neighbours(k).into_iter().map(|(_, c, mobility)| c * mobility).sum()
    }

    /// Sum of the coefficients that multiply the own pressure: how strongly `F_k` resists it \[m/Pa\].
    pub(in crate::reynolds) fn diagonal(&self, k: usize, near: NearField) -> f64 {
        let faces = self.conductance(k);
        self.wedge * (self.nodes[k].density * near.own - self.nodes[k - 1].density * near.next_x)
            + self.squeeze * self.nodes[k].density * near.own
            + faces * self.nodes[k].potential_p
    }

    /// Pressure flow through the faces of node `k` over the entrainment and squeeze of its elastic response.
    pub(in crate::reynolds) fn flow_ratio(&self, k: usize, near: NearField) -> f64 {
        self.conductance(k) * self.nodes[k].potential_p
            / ((self.wedge + self.squeeze) * self.nodes[k].density * near.own)
    }

    /// How strongly `F_k` depends on the own mass: entrainment and squeezes together.
    pub(in crate::reynolds) fn own_mass(&self, k: usize) -> f64 {
        self.upwind(k)[0] + self.squeeze + self.pseudo_transient
    }

    /// The neighbours of a node.
    #[inline]
    pub(in crate::reynolds) fn held_neighbours(&self, k: usize) -> [HeldNeighbour; 4] {
        let [east, west, north, south] = self.neighbours(k);
        let held = |(o, c, _): (usize, f64, f64), direction: Direction, is_first: bool| HeldNeighbour {
            c,
            flow: self.nodes[o],
            ratio: self.ratios.get(o).copied().unwrap_or(ViscosityRatio::NEWTONIAN),
            direction,
            is_first,
        };
        [
            held(east, self.along(k), false),
            // What flows into a node that is not filled comes back with all it carries on.
            held((west.0, west.1 * (1.0 - self.passed[k - 1]), west.2), self.along(k - 1), true),
            held(north, Direction::Across, false),
            held(south, Direction::Across, true),
        ]
    }

    /// Density, its slope, then flow through all faces of node `k` at fluid pressure and film `(p, h)` and its
    /// derivatives by both.
    pub(in crate::reynolds) fn outflow(
        &self,
        lubricant: &Lubricant,
        k: usize,
        neighbours: &[HeldNeighbour; 4],
        (p, h): (f64, f64),
    ) -> ([f64; 2], [f64; 3]) {
        let node = self.node_flow(lubricant, p, h);
        let ratio = self.viscosity_ratio(lubricant, k, p, h);
        ([node.density, node.density_p], self.flow_of(&node, ratio, neighbours))
    }

    /// The same of node `k` as it was at the last update.
    pub(in crate::reynolds) fn present_outflow(
        &self,
        k: usize,
        neighbours: &[HeldNeighbour; 4],
    ) -> ([f64; 2], [f64; 3]) {
        let node = &self.nodes[k];
        let ratio = self.ratios.get(k).copied().unwrap_or(ViscosityRatio::NEWTONIAN);
        ([node.density, node.density_p], self.flow_of(node, ratio, neighbours))
    }

    #[inline]
    fn flow_of(&self, node: &NodeFlow, ratio: ViscosityRatio, neighbours: &[HeldNeighbour; 4]) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for held in neighbours {
            let (first, second) = if held.is_first { (&held.flow, node) } else { (node, &held.flow) };
            let mut face = self.face_mobility.of(self.fluidity, first, second, held.direction);
            if !self.ratios.is_empty() {
                let (first, second) = if held.is_first { (held.ratio, ratio) } else { (ratio, held.ratio) };
                face = face.thinned(first, second);
            }
            let own = if held.is_first { face.second } else { face.first };
            let drop = held.c * (node.potential - held.flow.potential);
            sums[0] += face.mobility * drop;
            sums[1] += own[0] * drop + held.c * face.mobility * node.potential_p;
            sums[2] += own[1] * drop;
        }
        sums
    }

    /// Derivatives of the flow by pressure through the face to the east of node `k`, its film over that of
    /// the node and the factor of the inlet held: by both pressures, then by both films.
    pub(in crate::reynolds) fn east_flow_derivatives(&self, k: usize) -> [f64; 4] {
        self.flow_derivatives(k, k + 1, self.coefficient_east(k), self.along(k))
    }

    /// Those of the face to the north.
    pub(in crate::reynolds) fn north_flow_derivatives(&self, k: usize) -> [f64; 4] {
        self.flow_derivatives(k, k + self.grid.nx(), self.coefficient_north(k), Direction::Across)
    }

    #[inline]
    fn flow_derivatives(&self, k: usize, o: usize, c: f64, direction: Direction) -> [f64; 4] {
        let face = self.face_flow(k, o, direction);
        let (own, other) = (&self.nodes[k], &self.nodes[o]);
        let (drop, mobility) = (c * (own.potential - other.potential), c * face.mobility);
        [
            mobility * own.potential_p + drop * face.first[0],
            drop * face.second[0] - mobility * other.potential_p,
            drop * face.first[1],
            drop * face.second[1],
        ]
    }

    /// Whether anything is carried through faces beyond what their first nodes hold, or their mobility
    /// depends on the node upstream.
    pub(in crate::reynolds) fn carries_beyond(&self) -> bool {
        self.scheme != Scheme::FirstOrder || self.face_mobility == FaceMobility::Inlet
    }

    /// Derivatives of that through the face to the east of node `k`, with what it adds to the flow by
    /// pressure.
    pub(in crate::reynolds) fn beyond_derivatives(&self, k: usize) -> BeyondDerivatives {
        let nx = self.grid.nx();
        let column = k % nx;
        if column + 1 == nx {
            return [0.0; 5];
        }
        // Nothing upstream enters at the inlet.
        let (up, own, next) = (&self.nodes[k - column.min(1)], &self.nodes[k], &self.nodes[k + 1]);
        let film = self.face_film(k);
        let own_film = self.masses[k] / own.density;
        let by_films = |density: f64| [film.by_own, film.by_next, film.by_up].map(|by| density * by);
        let (by_densities, by_films) = match self.scheme {
            Scheme::SecondOrder if column > 0 => {
                let up_film = self.masses[k - 1] / up.density;
                ([0.5 * own_film, -0.5 * up_film], [0.5 * own.density, 0.0, -0.5 * up.density])
            }
            Scheme::Limited if column > 0 => {
                let DensityRise { rise, by_density, by_own_film, by_up_film } = self.density_rise(k);
                let whole = own_film + film.beyond;
                let [by_own, by_next, by_up] = by_films(own.density + rise);
                (
                    [film.beyond + by_density * whole, -by_density * whole],
                    [by_own + rise + whole * by_own_film, by_next, by_up + whole * by_up_film],
                )
            }
            _ => ([film.beyond, 0.0], by_films(own.density)),
        };
        let face = self.face_flow(k, k + 1, self.along(k));
        // The film of the face over that of the node is `1 + beyond / film`.
        let mut by_flow = [0.0; 3];
        if face.by_face_film != 0.0 {
            let drop = self.coefficient_east(k) * (own.potential - next.potential);
            let (per_film, per_inlet) = (drop * face.by_face_film / own.film, drop * face.by_inlet);
            let inlet = self.inlet(k);
            by_flow = [
                per_film * (film.by_own - film.beyond / own.film) + per_inlet * inlet.by_own,
                per_film * film.by_next + per_inlet * inlet.by_next,
                per_film * film.by_up + per_inlet * inlet.by_up,
            ];
        }
        let slopes = [own.density_p, up.density_p];
        let films = [own.film_h, next.film_h, up.film_h];
        let wedge = if self.is_starved(k) { 0.0 } else { self.wedge };
        std::array::from_fn(|slot| match slot {
            0..2 => wedge * by_densities[slot] * slopes[slot],
            _ => (wedge * by_films[slot - 2] + by_flow[slot - 2]) * films[slot - 2],
        })
    }

    /// Derivatives of the mass of node `k` by its pressure and by its film.
    pub(in crate::reynolds) fn mass_derivatives(&self, k: usize) -> [f64; 2] {
        if self.is_starved(k) {
            return [0.0; 2];
        }
        let NodeFlow { density, density_p, .. } = self.nodes[k];
        [density_p * self.masses[k] / density, density]
    }

    /// Coefficients of the masses of a node and of the one upstream in its balance, without what faces carry
    /// beyond them.
    pub(in crate::reynolds) fn mass_coefficients(&self) -> [f64; 2] {
        [self.wedge + self.squeeze + self.pseudo_transient, -self.wedge]
    }

    /// Those with which a matrix of five points stands in for the balances.
    pub(in crate::reynolds) fn five_point_mass_coefficients(&self) -> [f64; 2] {
        let wedge = match self.scheme {
            Scheme::FirstOrder | Scheme::Limited => self.wedge,
            Scheme::SecondOrder => SECOND_ORDER_WEIGHT * self.wedge,
        };
        [wedge + self.squeeze + self.pseudo_transient, -wedge]
    }

    /// Coefficients `(below, diagonal, above)` of an implicit step along x at node `k` with mobilities
    /// frozen, entrainment of first order and the elastic response of the line stiffened by `stiffness`.
    pub(in crate::reynolds) fn line_row(&self, k: usize, near: NearField, stiffness: f64) -> (f64, f64, f64) {
        let [east, west, north, south] = self.neighbours(k).map(|(_, c, mobility)| c * mobility);
        let cross = north + south;
        let slope = |q: usize| self.nodes[q].potential_p;
        let (own, up) = (self.nodes[k].density * stiffness, self.nodes[k - 1].density * stiffness);
        let (w, s) = (self.wedge, self.squeeze);
        (
            -west * slope(k - 1) + w * (own * near.next_x - up * near.own) + s * own * near.next_x,
            (east + west + cross) * slope(k) + w * (own * near.own - up * near.next_x) + s * own * near.own,
            -east * slope(k + 1) + w * (own * near.next_x - up * near.second_x) + s * own * near.next_x,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lubricant::{Barus, DowsonHigginson, Incompressible, Roelands};

    const FILM: f64 = 4e-8;
    const MOBILITIES: [FaceMobility; 4] =
        [FaceMobility::Arithmetic, FaceMobility::ReducedPressure, FaceMobility::Wedge, FaceMobility::Inlet];

    fn oil() -> Lubricant {
        Lubricant::new(
            Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
            DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
        )
    }

    /// A row of nodes with the coefficients that fluxes are counted in.
    fn row(face_mobility: FaceMobility, thinning: f64) -> Discretisation {
        let mut fluid = Discretisation::new(Grid::from_edges(5, 1, [0.0, 5e-5], [-0.5, 0.5]).unwrap());
        (fluid.face_mobility, fluid.face_x, fluid.fluidity) = (face_mobility, 1.0, 1.0 / (12.0 * 0.04));
        fluid.thinning = thinning;
        fluid.ratios = vec![ViscosityRatio::NEWTONIAN; if thinning > 0.0 { 5 } else { 0 }];
        fluid
    }

    #[test]
    fn equal_nodes_flow_by_the_effective_viscosity() {
        let oil = oil();
        let law = ShearThinning { eyring_stress: 5e6, sliding_speed: 0.3 };
        for face_mobility in MOBILITIES {
            let mut fluid = row(face_mobility, law.length(0.04));
            for p in [0.0, 1e8, 5e8, 1e9] {
                fluid.update(&oil, &[p; 5], &[FILM; 5], None);
                let eta = oil.viscosity().viscosity(p);
                let effective = eta * law.viscosity_ratio(eta, FILM);
                let exact = oil.density().ratio(p) * FILM.powi(3) / (12.0 * effective);
                let found = fluid.east[2] * fluid.nodes[2].potential_p;
                assert!(
                    (found / exact - 1.0).abs() < 1e-4,
                    "{found:e}, {exact:e} at {p:e}, {face_mobility:?}"
                );
            }
        }
    }

    /// The flow between two pressures through a film of one thickness is `h^3/12` times the integral of
    /// `dp / eta*`.
    #[test]
    fn flow_between_two_pressures_tends_to_the_integral() {
        let oil = Lubricant::new(Barus::new(0.04, 20e-9).unwrap(), Incompressible);
        let law = ShearThinning { eyring_stress: 5e6, sliding_speed: 0.3 };
        let exact = |low: f64, high: f64| {
            let steps = 10_000;
            let width = (high - low) / f64::from(steps);
            let middle = |i: i32| low + (f64::from(i) + 0.5) * width;
            let sum: f64 = (0..steps)
                .map(|i| oil.viscosity().viscosity(middle(i)))
                .map(|eta| 1.0 / (eta * law.viscosity_ratio(eta, FILM)))
                .sum();
            FILM.powi(3) / 12.0 * sum * width
        };
        for face_mobility in MOBILITIES {
            let mut fluid = row(face_mobility, law.length(0.04));
            let mut error = |low: f64, high: f64| {
                let pressure = [low, low, low, high, high];
                fluid.update(&oil, &pressure, &[FILM; 5], None);
                fluid.east[2] * (fluid.nodes[3].potential - fluid.nodes[2].potential) / exact(low, high) - 1.0
            };
            for low in [0.0, 3e8, 1e9] {
                let errors = [5e7, 2.5e7].map(|step| error(low, low + step));
                // The trapezoidal rule of a Newtonian fluid is wrong by 2.1 % over the smaller step.
                assert!(errors[1].abs() < 0.021, "{errors:?} from {low:e}, {face_mobility:?}");
                assert!(
                    errors[1].abs() < 0.3 * errors[0].abs(),
                    "{errors:?} from {low:e}, {face_mobility:?}"
                );
            }
            // Steep ones: exponents of the viscosity 10 and 20 apart.
            for (low, high) in [(0.0, 5e8), (0.0, 1e9), (5e8, 1.5e9)] {
                let wrong = error(low, high);
                if face_mobility != FaceMobility::Arithmetic {
                    assert!(wrong.abs() < 1.0, "{wrong} from {low:e} to {high:e}");
                }
            }
        }
    }

    #[test]
    fn thinned_flow_has_exact_derivatives() {
        let oil = oil();
        let pressure = [1e8, 3e8, 5e8, 4.2e8, 2e8];
        let film = [6e-8, 4e-8, 3e-8, 5e-8, 7e-8];
        for face_mobility in MOBILITIES {
            for thinning in [1e-14, 1e-10, 1e-6] {
                let mut fluid = row(face_mobility, thinning);
                fluid.update(&oil, &pressure, &film, None);
                let neighbours = fluid.held_neighbours(2);
                let flow = |p: f64, h: f64| fluid.outflow(&oil, 2, &neighbours, (p, h)).1;
                let (p, h) = (pressure[2], film[2]);
                let [value, by_pressure, by_film] = flow(p, h);
                assert!((fluid.balance(2, None) / value - 1.0).abs() < 1e-13, "{value:e}");
                // Steps that stay within one interval of the table.
                let (dp, dh) = (2e4, 1e-5 * h);
                let p = p + 1e6;
                let [_, at_p, _] = flow(p, h);
                let difference = (flow(p + dp, h)[0] - flow(p - dp, h)[0]) / (2.0 * dp);
                assert!((difference / at_p - 1.0).abs() < 1e-7, "{difference:e}, {at_p:e}");
                let difference = (flow(pressure[2], h + dh)[0] - flow(pressure[2], h - dh)[0]) / (2.0 * dh);
                assert!((difference / by_film - 1.0).abs() < 1e-7, "{difference:e}, {by_film:e}");
                // The same as the flows through both faces.
                let (west, east) = (fluid.east_flow_derivatives(1), fluid.east_flow_derivatives(2));
                for (derivative, slot) in [(by_pressure, 0), (by_film, 2)] {
                    let change = east[slot] - west[slot + 1];
                    assert!((change / derivative - 1.0).abs() < 1e-12, "{change:e}, {derivative:e}");
                }
            }
        }
    }

    /// Where the logarithm of the viscosity is linear in pressure, whatever the films.
    #[test]
    fn thinned_flow_grows_with_the_pressure_of_its_node() {
        let oil = Lubricant::new(Barus::new(0.04, 20e-9).unwrap(), Incompressible);
        for thinning in [1e-12, 1e-9, 1e-6] {
            for film in [[1e-9, 1e-7], [1e-7, 1e-9], [3e-8, 3e-8]] {
                for other in [0.0, 2e8, 1e9] {
                    let mut fluid = row(FaceMobility::ReducedPressure, thinning);
                    let films = [film[1], film[1], film[0], film[1], film[1]];
                    fluid.update(&oil, &[other; 5], &films, None);
                    let neighbours = fluid.held_neighbours(2);
                    for step in 0..150 {
                        let p = f64::from(step) * 1e7;
                        let slope = fluid.outflow(&oil, 2, &neighbours, (p, film[0])).1[1];
                        assert!(slope > 0.0, "{slope:e} at {p:e}, {other:e}, films {film:?}, {thinning:e}");
                    }
                }
            }
        }
    }
}
