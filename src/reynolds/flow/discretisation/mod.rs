//! The discrete Reynolds equation, shared by all solvers.
//!
//! Finite volumes on the cells of the grid. The net outflow of cell `k`, multiplied by `dx / U` with `U` the
//! entrainment speed (or `dx / dt` if that is larger), is a film thickness \[m\]:
//!
//! `F_k = sum over faces of c a_face (phi_k - phi_neighbour) + w (M_east - M_west) + s (m_k - m_previous)`
//!
//! with `m = rho/rho_0 h`, `c = 1 / (U dx)` (faces in x) or `dx / (U dy^2)` (faces in y), `w = u / U` and
//! `s = dx / (U dt)`. `M` is the entrained flux through a face ([`Scheme`]); `a_face`, a mean of
//! `h^3 / (12 eta_0)`, and the potential `phi` are those of the [`FaceMobility`].
//!
//! With shear thinning the mobility of a face is divided by the mean of `eta*/eta` of its two nodes along the
//! face ([`ShearThinning`](super::ShearThinning)). A mean of `a eta/eta*` would fail at steep viscosities: it is
//! dominated by the node of high pressure, whose `q` hardly changes. With this division the flow through a face
//! increases with the pressure of its node if `ln eta` is linear in pressure, because
//! `q_end - q <= (dq/dp) / (d ln eta/dp)` and `eta*/eta` decreases no faster than `1/eta`.
//!
//! In films warmer than the laws ([`Lubricant::set_film_temperatures`]), `rho/rho_0` is multiplied by a density
//! ratio and `eta*/eta` by a viscosity ratio over that density ratio, both at the pressure of the node; shear
//! thinning is that of the warm fluid.
//!
//! The film in `a` is bounded below by half the contact film; the film in `m` is not bounded.

mod across;
mod balances;
mod changes;
mod derivatives;
mod faces;
mod film_fractions;
mod nodes;
mod own_share;
#[cfg(test)]
mod tests;
mod window;

pub(in crate::reynolds) use balances::NearField;
pub(in crate::reynolds) use own_share::HeldNeighbour;
pub(in crate::reynolds) use window::MARGIN;

use changes::Changes;

use super::cavitation::Cavitation;
use super::entrainment::Scheme;
use super::face_mobility::FaceMobility;
use super::inlet::Inlet;
use super::node::NodeFlow;
use super::shear_thinning::{NodeRatios, ShearThinning};
use super::spin::Spin;
use crate::grid::Grid;
use crate::lubricant::{Lubricant, NodeTemperature};
use crate::reynolds::problem::{LubricatedContact, outermost};

/// Quantities of the nodes and faces at the current pressure and film, and the coefficients of the balance.
#[derive(Debug, Clone)]
pub(in crate::reynolds) struct Discretisation {
    /// The grid.
    pub(in crate::reynolds) grid: Grid,
    /// Law of the pressure flow through a face.
    face_mobility: FaceMobility,
    /// Entrainment scheme.
    scheme: Scheme,
    /// Cavitation condition.
    cavitation: Cavitation,
    /// Largest film entrained into a row of cells \[m\]; infinite for a flooded inlet.
    supply: f64,
    /// Fluid pressures of the outermost nodes \[Pa\]; empty for ambient pressure outside of them.
    edge_pressure: Vec<f64>,
    /// Smallest film in mobilities \[m\].
    film_floor: f64,
    /// Film below which the mobility is zero \[m\]; zero for hard contact.
    closed_film: f64,
    /// `c` of the faces east and north of each node \[s/m^2\].
    coefficients: Vec<[f64; 2]>,
    /// `w`; with spin that of the center row.
    wedge: f64,
    /// Spin of the surfaces, if any.
    spin: Option<Box<Spin>>,
    /// `s`; zero without a squeeze term.
    squeeze: f64,
    /// Pseudo-transient squeeze coefficient relative to the masses at the start of a linear step. It enters the
    /// derivatives only, as the term vanishes there.
    pseudo_transient: f64,
    /// `1 / (12 eta_0)`.
    fluidity: f64,
    /// `U / dx` \[1/s\].
    rate: f64,
    /// Nodes whose quantities the present update computes anew.
    changes: Changes,
    /// Quantities of the nodes.
    nodes: Vec<NodeFlow>,
    /// `m` of the nodes \[m\].
    masses: Vec<f64>,
    /// Entrainment correction `M - m` of the faces to the east, with `m` of the first node \[m\].
    beyond: Vec<f64>,
    /// Film of these faces over that of the first node.
    face_films: Vec<f64>,
    /// Inlets of these faces.
    inlets: Vec<Inlet>,
    /// Squared cosines between flow and gradient of the undeformed gap at these faces.
    alignments: Vec<f64>,
    /// `M` of the faces to the east \[m\].
    entrained: Vec<f64>,
    /// Film fraction `theta` of the nodes.
    theta: Vec<f64>,
    /// Fraction of a change of inflow advected by nodes that are not filled; zero elsewhere.
    advected_fraction: Vec<f64>,
    /// `a` of the faces east of the nodes.
    east: Vec<f64>,
    /// `a` of the faces north of the nodes.
    north: Vec<f64>,
    /// Pressure flow through the faces to the east \[m\].
    east_flow: Vec<f64>,
    /// Pressure flow through the faces to the north.
    north_flow: Vec<f64>,
    /// Shear thinning and the film with `x = 1` at ambient pressure \[m\]; `None` for a Newtonian fluid.
    thinning: Option<(ShearThinning, f64)>,
    /// Temperatures of the films at the nodes; empty for isothermal films.
    film_temperatures: Vec<NodeTemperature>,
    /// `eta*/eta` of the nodes; empty for a Newtonian fluid in isothermal films.
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
            coefficients: vec![[0.0; 2]; grid.len()],
            wedge: 0.0,
            spin: None,
            squeeze: 0.0,
            pseudo_transient: 0.0,
            fluidity: 0.0,
            rate: 1.0,
            changes: Changes::new(grid.len()),
            nodes: vec![NodeFlow::default(); grid.len()],
            masses: zeros(),
            beyond: zeros(),
            entrained: zeros(),
            theta: vec![1.0; grid.len()],
            advected_fraction: zeros(),
            face_films: vec![1.0; grid.len()],
            inlets: vec![Inlet::NONE; grid.len()],
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

    /// Ends the pressure flow at nodes whose film is below `film` \[m\].
    pub(in crate::reynolds) fn close_below(&mut self, film: f64) {
        self.closed_film = film;
    }

    /// Sets speeds, time steps and schemes from the problem.
    pub(in crate::reynolds) fn configure(&mut self, problem: &LubricatedContact<'_>) {
        self.changes.forget();
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
        // Films below the contact film occur in unconverged iterates. Their mobility keeps decreasing: a floor at
        // the contact film itself would hide from Newton's method that a node just below it can open.
        self.film_floor = 0.5 * problem.contact_film();
        self.closed_film = f64::NEG_INFINITY;
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
        // Coarser grids, whose gaps are not those of the problem, only compute corrections.
        if problem.gap.len() == self.grid.len() {
            self.align(problem.gap);
        }
    }

    /// Sets the film temperatures from those on the grid `of` the problem; on a coarser grid from the nearest
    /// nodes.
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

    /// Sets the alignments of edges from the undeformed gap.
    fn align(&mut self, gap: &[f64]) {
        let (nx, ny, n) = (self.grid.nx(), self.grid.ny(), self.grid.len());
        for k in (0..n - 1).filter(|k| k % nx + 1 < nx) {
            let beside = [self.grid.north_of(k), self.grid.south_of(k)];
            let rows = beside.iter().flatten().count().max(1) as f64;
            let [above, below] = beside.map(|node| node.unwrap_or(k));
            let along = (gap[k + 1] - gap[k]) / self.grid.dx();
            let rise = gap[above] + gap[above + 1] - gap[below] - gap[below + 1];
            let across = if ny == 1 { 0.0 } else { 0.5 * rise / (rows * self.grid.dy()) };
            let steepness = along * along + across * across;
            self.alignments[k] = if steepness > 0.0 { along * along / steepness } else { 1.0 };
        }
    }

    /// Updates all quantities for the given fluid pressures and films, and the previous masses with squeeze.
    pub(in crate::reynolds) fn update(
        &mut self,
        lubricant: &Lubricant,
        pressure: &[f64],
        film: &[f64],
        previous: Option<&[f64]>,
    ) {
        self.update_faces(lubricant, pressure, film);
        self.update_entrained(0, pressure, previous);
    }

    /// Updates nodes, faces and entrainment corrections; those of nodes whose pressure and film are the ones of the
    /// last update are up to date.
    fn update_faces(&mut self, lubricant: &Lubricant, pressure: &[f64], film: &[f64]) {
        self.changes.compare(pressure, film);
        self.update_nodes(lubricant, pressure, film);
        if !self.edge_pressure.is_empty() {
            for k in outermost(&self.grid) {
                let (node, ratios) = self.node_at(lubricant, k, self.edge_pressure[k], film[k]);
                (self.nodes[k], self.masses[k]) = (node, node.density * film[k]);
                if let Some(stored) = self.ratios.get_mut(k) {
                    *stored = ratios;
                }
            }
        }
        self.update_east_faces();
        self.update_north_faces();
        if let Some(spin) = &mut self.spin {
            spin.update(&self.nodes);
        }
    }

    /// Pressure flow out of node `k`.
    #[inline]
    fn pressure_outflow(&self, k: usize) -> f64 {
        let along = self.east_flow[k] - self.east_flow[k - 1];
        // A grid that is no strip has no faces south of the first row and north of the last.
        match self.grid.south_of(k) {
            Some(south) => along + (self.north_flow[k] - self.north_flow[south]),
            None => along + self.north_flow[k],
        }
    }

    /// Mass per area of node `k`, `theta rho/rho_0 h` \[m\].
    pub(in crate::reynolds) fn held_mass(&self, k: usize) -> f64 {
        self.theta[k] * self.masses[k]
    }

    /// Film fractions of the nodes.
    pub(in crate::reynolds) fn film_fractions(&self) -> &[f64] {
        &self.theta
    }

    /// Fraction of a change of inflow advected by node `k` if it is not filled; zero elsewhere.
    pub(in crate::reynolds) fn advected_fraction(&self, k: usize) -> f64 {
        self.advected_fraction[k]
    }

    /// Overrides the schemes of the problem until the next [`Self::configure`].
    pub(in crate::reynolds) fn set_scheme(&mut self, scheme: Scheme, face_mobility: FaceMobility) {
        self.changes.forget();
        self.scheme = scheme;
        self.face_mobility = face_mobility;
    }

    /// Overrides the cavitation condition of the problem until the next [`Self::configure`].
    pub(in crate::reynolds) fn set_cavitation(&mut self, cavitation: Cavitation) {
        self.cavitation = cavitation;
    }

    /// Makes the next linear steps pseudo-time steps of `1 / share` cell transit times, until
    /// [`Self::configure`].
    pub(in crate::reynolds) fn set_pseudo_transient(&mut self, share: f64) {
        self.pseudo_transient = share * self.wedge;
    }

    /// Physical imbalance per `F`: `U / dx` \[1/s\].
    pub(in crate::reynolds) fn rate(&self) -> f64 {
        self.rate
    }
}
