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
//! With shear thinning the mobility of a face is divided by the mean of `eta*/eta` of its two nodes along the
//! face ([`ShearThinning`](super::ShearThinning)). Why not a mean of `a eta/eta*`: at steep viscosities the
//! node of high pressure has nearly all of that and nearly none of the change of `q`. Divided like this the
//! flow through a face still grows with the pressure of its node where `ln eta` is linear in pressure, as
//! `q_end - q <= (dq/dp) / (d ln eta/dp)`, while `eta*/eta` falls no faster than `1/eta`.
//!
//! Films that are warmer than the laws ([`Lubricant::set_film_temperatures`]) have `rho/rho_0` times a ratio
//! of densities and `eta*/eta` times a ratio of viscosities over that of densities, both by the pressure of
//! the node; shear thinning then is that of the warmer fluid.
//!
//! In `a` the film counts as at least half the contact film, in `m` it counts as it is.

mod across;
mod balances;
mod derivatives;
mod faces;
mod own_share;
#[cfg(test)]
mod tests;
mod window;

pub(in crate::reynolds) use balances::NearField;
pub(in crate::reynolds) use own_share::HeldNeighbour;
pub(in crate::reynolds) use window::MARGIN;

use super::cavitation::Cavitation;
use super::entrainment::Scheme;
use super::face_mobility::{Direction, FaceMobility};
use super::node::NodeFlow;
use super::shear_thinning::{NodeRatios, ShearThinning};
use super::spin::Spin;
use crate::grid::Grid;
use crate::lubricant::{Lubricant, NodeTemperature, ThermalRatios};
use crate::reynolds::problem::{LubricatedContact, interior, outermost};

/// Quantities of the nodes and faces at the current pressure and film, and the coefficients of the balance.
#[derive(Debug, Clone)]
pub(in crate::reynolds) struct Discretisation {
    /// The grid.
    pub(in crate::reynolds) grid: Grid,
    /// How pressure drives fluid through a face.
    face_mobility: FaceMobility,
    /// What entrainment carries through a face.
    scheme: Scheme,
    /// What holds where the fluid cavitates.
    cavitation: Cavitation,
    /// What enters a row of cells at most \[m\]; infinite at a flooded inlet.
    supply: f64,
    /// Fluid pressures of the outermost nodes \[Pa\]; empty where the pressure is ambient beyond them.
    edge_pressure: Vec<f64>,
    /// Least film that mobilities count with \[m\].
    film_floor: f64,
    /// Film below which pressure moves nothing \[m\]; no such film in hard contact.
    closed_film: f64,
    /// `c` of the faces to the east of the nodes of each column \[s/m^2\].
    east_coefficients: Vec<f64>,
    /// And to the north of those of each row.
    north_coefficients: Vec<f64>,
    /// `w`; with spin that of the row through the centre.
    wedge: f64,
    /// Surfaces that turn; none where they move along x alone.
    spin: Option<Box<Spin>>,
    /// `s`; zero without a squeeze term.
    squeeze: f64,
    /// Squeeze against the masses at which a linear step begins: in the derivatives alone, as it vanishes
    /// there.
    pseudo_transient: f64,
    /// `1 / (12 eta_0)`.
    fluidity: f64,
    /// `U / dx` \[1/s\].
    rate: f64,
    /// Quantities of the nodes.
    nodes: Vec<NodeFlow>,
    /// `m` of the nodes \[m\].
    masses: Vec<f64>,
    /// `M` less `m` of the first node, of the faces to the east \[m\].
    beyond: Vec<f64>,
    /// Film over that of the first node, of these faces.
    face_films: Vec<f64>,
    /// Factors of the inlets at these faces.
    inlet_factors: Vec<f64>,
    /// Squares of the cosines between the flow and the gradient of the undeformed gap, at these faces.
    alignments: Vec<f64>,
    /// `M` of the faces to the east \[m\].
    carried: Vec<f64>,
    /// Share `theta` of the gap that is filled.
    content: Vec<f64>,
    /// Of nodes that are not filled, what of their inflow they carry on; zero elsewhere.
    passed: Vec<f64>,
    /// `a` of the faces to the east of the nodes.
    east: Vec<f64>,
    /// And to the north.
    north: Vec<f64>,
    /// Flow by pressure through the faces to the east \[m\].
    east_flow: Vec<f64>,
    /// And to the north.
    north_flow: Vec<f64>,
    /// Shear thinning and the film in which the fluid at ambient pressure has `x = 1` \[m\]; none where it
    /// is Newtonian.
    thinning: Option<(ShearThinning, f64)>,
    /// Temperatures of the films at the nodes; empty where they are those of the laws.
    film_temperatures: Vec<NodeTemperature>,
    /// `eta*/eta` of the nodes; empty without shear thinning in films that have the temperature of the law.
    ratios: Vec<NodeRatios>,
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
            edge_pressure: Vec::new(),
            film_floor: 0.0,
            closed_film: f64::NEG_INFINITY,
            east_coefficients: vec![0.0; grid.nx()],
            north_coefficients: vec![0.0; grid.ny()],
            wedge: 0.0,
            spin: None,
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
            inlet_factors: vec![1.0; grid.len()],
            alignments: vec![1.0; grid.len()],
            east: zeros(),
            north: zeros(),
            east_flow: zeros(),
            north_flow: zeros(),
            thinning: None,
            film_temperatures: Vec::new(),
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
        self.edge_pressure.clear();
        if let Some(edge) = problem.edge_pressure.filter(|edge| edge.field.len() == self.grid.len()) {
            self.edge_pressure.extend_from_slice(edge.field);
        }
        // Below the contact film, where only unfinished iterations are, the mobility keeps falling: a floor
        // at the contact film itself would hide from Newton that a node just under it can open.
        self.film_floor = 0.5 * problem.contact_film();
        self.closed_film = if problem.is_paper() { problem.contact_film() } else { f64::NEG_INFINITY };
        self.rate = speed / dx;
        let across = if self.grid.ny() == 1 { 0.0 } else { dx / (speed * dy * dy) };
        self.set_coefficients(1.0 / (speed * dx), across);
        self.wedge = problem.entrainment_speed / speed;
        self.spin = problem.spin_radius.map(|radius| {
            let mut spin = self.spin.take().unwrap_or_default();
            spin.configure(&self.grid, radius, self.wedge);
            spin
        });
        self.squeeze = grid_speed / speed;
        self.pseudo_transient = 0.0;
        let ambient = problem.lubricant.map(|l| l.viscosity().viscosity(0.0));
        self.fluidity = ambient.map_or(0.0, |eta| 1.0 / (12.0 * eta));
        let thinning = problem.shear_thinning.zip(ambient).map(|(law, eta)| (law, law.length(eta)));
        self.thinning = thinning.filter(|(_, length)| *length > 0.0);
        self.warm(problem.lubricant.map_or(&[], Lubricant::film_temperatures), &problem.grid());
        let is_newtonian = self.thinning.is_none() && self.film_temperatures.is_empty();
        let thinned = if is_newtonian { 0 } else { self.grid.len() };
        self.ratios.resize(thinned, NodeRatios::NEWTONIAN);
        // Coarser grids, whose gaps are not those of the problem, only make corrections.
        if problem.gap.len() == self.grid.len() {
            self.align(problem.gap);
        }
    }

    /// Takes over the temperatures of the films at the nodes of the grid `of` the problem, on a coarser grid
    /// those of the nodes next to its own.
    fn warm(&mut self, films: &[NodeTemperature], of: &Grid) {
        self.film_temperatures.clear();
        if films.len() == self.grid.len() {
            self.film_temperatures.extend_from_slice(films);
        } else if !films.is_empty() {
            let (nx, ny) = (self.grid.nx(), self.grid.ny());
            let near = |i: usize, n: usize, fine: usize| ((2 * i + 1) * fine / (2 * n)).min(fine - 1);
            let nodes = (0..ny).flat_map(|j| (0..nx).map(move |i| (i, j)));
            let at = |(i, j)| films[near(j, ny, of.ny()) * of.nx() + near(i, nx, of.nx())];
            self.film_temperatures.extend(nodes.map(at));
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

    /// Ratios to the laws at node `k` under fluid pressure `p`; none where films have their temperature.
    #[inline]
    fn thermal_ratios(&self, lubricant: &Lubricant, k: usize, p: f64) -> Option<ThermalRatios> {
        self.film_temperatures.get(k).and_then(|films| lubricant.thermal_ratios(films, p))
    }

    /// The quantities of a node at fluid pressure `p` and film `h`, the film `warm` or not.
    #[inline]
    fn node_flow(&self, lubricant: &Lubricant, warm: Option<ThermalRatios>, p: f64, h: f64) -> NodeFlow {
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        let square = self.fluidity * floored * floored;
        let is_closed = h < self.closed_film;
        let (film, cube) = if is_closed { (0.0, 0.0) } else { (floored, square * floored) };
        let film_h = if h > self.film_floor { 1.0 } else { 0.0 };
        let cube_h = 3.0 * square * film_h;
        let (mut density, mut density_p) = (point.density, point.density_slope);
        if let Some(warm) = warm {
            density_p = warm.density * (density_p + density * warm.density_slope);
            density *= warm.density;
        }
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

    /// `eta*/eta` of a node at fluid pressure `p` and film `h`, the film `warm` or not.
    fn viscosity_ratios(
        &self,
        lubricant: &Lubricant,
        warm: Option<ThermalRatios>,
        p: f64,
        h: f64,
    ) -> NodeRatios {
        let warmed = |ratios: NodeRatios| warm.map_or(ratios, |warm| ratios.warmed(&warm));
        let Some((law, length)) = self.thinning else { return warmed(NodeRatios::NEWTONIAN) };
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        // Density over slope of the reduced pressure is the viscosity over that at ambient pressure.
        let (ratio, slope) = warm.map_or((1.0, 0.0), |warm| (warm.viscosity, warm.viscosity_slope));
        let x = ratio * length / floored * (point.density / point.reduced_slope);
        let by_pressure =
            slope + point.density_slope / point.density - point.reduced_curvature / point.reduced_slope;
        let by_film = if h > self.film_floor { -1.0 / h } else { 0.0 };
        warmed(law.node_ratios(x, [by_pressure, by_film]))
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
        self.update_faces(lubricant, pressure, film);
        self.carry(0, pressure, previous);
    }

    /// What the gaps hold and carry through the faces to the east, where the first `held` columns are as they
    /// should be.
    fn carry(&mut self, held: usize, pressure: &[f64], previous: Option<&[f64]>) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        for k in (0..n).step_by(nx).flat_map(|first| first + held..first + nx) {
            self.carried[k] = self.masses[k] + self.beyond[k];
            self.content[k] = 1.0;
        }
        self.passed.fill(0.0);
        if self.cavitation == Cavitation::MassConserving {
            self.starve();
            if self.spin.is_some() {
                self.fill_across(pressure, previous);
                return;
            }
            for k in interior(&self.grid).filter(|k| pressure[*k] <= 0.0 && k % nx >= held) {
                self.fill(k, previous);
            }
        }
    }

    /// The quantities of node `k` at fluid pressure `p` and film `h`.
    #[inline]
    fn update_node(&mut self, lubricant: &Lubricant, k: usize, p: f64, h: f64) {
        let warm = self.thermal_ratios(lubricant, k, p);
        self.nodes[k] = self.node_flow(lubricant, warm, p, h);
        self.masses[k] = self.nodes[k].density * h;
        if !self.ratios.is_empty() {
            self.ratios[k] = self.viscosity_ratios(lubricant, warm, p, h);
        }
    }

    /// Nodes, faces, and what entrainment carries beyond the nodes.
    fn update_faces(&mut self, lubricant: &Lubricant, pressure: &[f64], film: &[f64]) {
        for (k, (&p, &h)) in pressure.iter().zip(film).enumerate() {
            self.update_node(lubricant, k, p, h);
        }
        if !self.edge_pressure.is_empty() {
            for k in outermost(&self.grid) {
                self.update_node(lubricant, k, self.edge_pressure[k], film[k]);
            }
        }
        self.update_entrainment();
        let (nx, n) = (self.grid.nx(), self.grid.len());
        for k in 0..n - 1 {
            self.east[k] = self.face_flow(k, k + 1, self.along(k)).mobility;
            let drop = self.nodes[k].potential - self.nodes[k + 1].potential;
            self.east_flow[k] = self.coefficients(k)[0] * self.east[k] * drop;
        }
        for k in 0..n - nx {
            self.north[k] = self.face_flow(k, k + nx, Direction::Across).mobility;
            let drop = self.nodes[k].potential - self.nodes[k + nx].potential;
            self.north_flow[k] = self.coefficients(k)[1] * self.north[k] * drop;
        }
        if let Some(spin) = &mut self.spin {
            spin.update(&self.nodes);
        }
    }

    /// Lets no more than the supply through the faces at the inlet edge.
    fn starve(&mut self) {
        for first in (0..self.grid.len()).step_by(self.grid.nx()) {
            let full = self.carried[first];
            // A meniscus upstream of the box has filled the gap where pressure reaches its edge.
            let is_filled = self.edge_pressure.get(first).is_some_and(|pressure| *pressure > 0.0);
            if full > self.supply && !is_filled {
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
        if let Some((content, taken)) = self.content_of(k, [self.wedge * self.carried[k - 1], full], previous)
        {
            self.content[k] = content;
            self.carried[k] *= content;
            self.passed[k] = full / taken;
        }
    }

    /// The content of node `k`, which has no pressure, where it is not filled, and what it takes of a change of
    /// its inflow to fill it; `[enters, leaves]` is what is carried into it, and out of it with its own gap
    /// filled.
    fn content_of(
        &self,
        k: usize,
        [enters, leaves]: [f64; 2],
        previous: Option<&[f64]>,
    ) -> Option<(f64, f64)> {
        let mass = self.masses[k];
        let whole = leaves + self.squeeze * mass;
        let kept = previous.map_or(0.0, |previous| self.squeeze * previous[k]);
        let content = (enters + kept - self.pressure_outflow(k)) / whole;
        let taken = whole + self.pseudo_transient * mass;
        (whole > 0.0 && content < 1.0).then_some((content.max(0.0), taken))
    }

    /// Flow by pressure out of node `k`.
    #[inline]
    fn pressure_outflow(&self, k: usize) -> f64 {
        let along = self.east_flow[k] - self.east_flow[k - 1];
        if self.grid.ny() == 1 {
            return along;
        }
        along + (self.north_flow[k] - self.north_flow[k - self.grid.nx()])
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
}
