//! The discrete Reynolds equation, once for all solvers.
//!
//! Finite volumes on the cells of the grid. The net outflow of cell `k`, multiplied by `dx / U` with `U` the
//! entrainment speed (or `dx / dt` if that is larger), is a film thickness \[m\]:
//!
//! `F_k = sum over faces of c a_face (phi_k - phi_neighbour) + w (M_east - M_west) + s (m_k - m_previous)`
//!
//! with `m = rho/rho_0 h`, `c = 1 / (U dx)` (faces in x) or `dx / (U dy^2)` (faces in y), `w = u / U` and
//! `s = dx / (U dt)`. `M` is `m` on a face: that of the node upstream (first order) or `3/2` of it less half of the
//! next one (second order). Mobility `a`, its arithmetic mean on a face, and potential `phi` are
//!
//! | [`FaceMobility`] | `a` | `phi` |
//! |---|---|---|
//! | `Arithmetic` | `rho/rho_0 h^3 / (12 eta)` | `p` |
//! | `ReducedPressure` | `h^3 / (12 eta_0)` | `q = integral of (rho/rho_0) (eta_0/eta) dp` |
//!
//! In `a` the film counts as at least half the contact film, in `m` it counts as it is.
//!
//! Why means and not harmonic means: an asperity flank that the mesh does not resolve is drained by its deep neighbour,
//! so it ends in solid contact. The harmonic mean seals such a flank and traps films that no mesh refinement confirms.

use super::active_set::{Fluid, Kind};
use super::problem::{FaceMobility, LubricatedContact, Scheme};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::STENCIL;

/// Weight of the first-order entrainment term in the preconditioner of the second-order one. Their ratio lies between 1
/// (smooth fields) and 2 (from node to node).
const SECOND_ORDER_WEIGHT: f64 = 1.25;

/// Pressure difference over sum below which the secant of a potential is taken as the mean of its slopes.
const SECANT_SHARE: f64 = 1e-6;

/// What the balance needs to know of one node; `_p` and `_h` are derivatives by pressure and film.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct NodeFlow {
    pub(super) density: f64,
    pub(super) density_p: f64,
    pub(super) mobility: f64,
    pub(super) mobility_p: f64,
    pub(super) mobility_h: f64,
    pub(super) potential: f64,
    pub(super) potential_p: f64,
}

/// Sums over the faces of a node, neighbours `o` held.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FaceSums {
    /// `c / 2`.
    pub(super) half: f64,
    /// `c a_o / 2`.
    pub(super) mobility: f64,
    /// `c phi_o / 2`.
    pub(super) potential: f64,
    /// `c a_o phi_o / 2`.
    pub(super) inflow: f64,
}

/// Quantities of the nodes at the current pressure and film, and the coefficients of the balance.
#[derive(Debug, Clone)]
pub(super) struct Discretisation {
    pub(super) grid: Grid,
    face_mobility: FaceMobility,
    scheme: Scheme,
    film_floor: f64,
    /// Film below which pressure moves nothing, and film below which none is carried along \[m\]; no such film in hard
    /// contact.
    closed_film: f64,
    least_film: f64,
    face_x: f64,
    face_y: f64,
    wedge: f64,
    squeeze: f64,
    /// `1 / (12 eta_0)`.
    fluidity: f64,
    /// `U / dx` \[1/s\].
    rate: f64,
    nodes: Vec<NodeFlow>,
}

/// First influence coefficients, for implicit relaxation \[m/Pa\].
#[derive(Debug, Clone, Copy)]
pub(super) struct NearField {
    pub(super) own: f64,
    pub(super) next_x: f64,
    pub(super) second_x: f64,
}

impl Discretisation {
    pub(super) fn new(grid: Grid) -> Self {
        Self {
            grid,
            face_mobility: FaceMobility::default(),
            scheme: Scheme::default(),
            film_floor: 0.0,
            closed_film: f64::NEG_INFINITY,
            least_film: f64::NEG_INFINITY,
            face_x: 0.0,
            face_y: 0.0,
            wedge: 0.0,
            squeeze: 0.0,
            fluidity: 0.0,
            rate: 1.0,
            nodes: vec![NodeFlow::default(); grid.len()],
        }
    }

    /// Takes speeds, steps and schemes from the problem.
    pub(super) fn configure(&mut self, problem: &LubricatedContact<'_>) {
        let (dx, dy) = (self.grid.dx(), self.grid.dy());
        let grid_speed = problem.squeeze.map_or(0.0, |s| dx / s.time_step);
        let speed = problem.entrainment_speed.max(grid_speed);
        self.face_mobility = problem.face_mobility;
        self.scheme = problem.scheme;
        // Below the contact film, where only unfinished iterations are, the mobility keeps falling: a floor at the
        // contact film itself would hide from Newton that a node just under it can open.
        self.film_floor = 0.5 * problem.contact_film();
        (self.closed_film, self.least_film) = if problem.is_paper() {
            (problem.contact_film(), 0.0)
        } else {
            (f64::NEG_INFINITY, f64::NEG_INFINITY)
        };
        self.rate = speed / dx;
        self.face_x = 1.0 / (speed * dx);
        self.face_y = if self.grid.ny() == 1 { 0.0 } else { dx / (speed * dy * dy) };
        self.wedge = problem.entrainment_speed / speed;
        self.squeeze = grid_speed / speed;
        self.fluidity = problem.lubricant.map_or(0.0, |l| 1.0 / (12.0 * l.viscosity().viscosity(0.0)));
    }

    /// The quantities of a node at fluid pressure `p` and film `h`.
    #[inline]
    pub(super) fn node_flow(&self, lubricant: &Lubricant, p: f64, h: f64) -> NodeFlow {
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        let square = self.fluidity * floored * floored;
        let cube = if h < self.closed_film { 0.0 } else { square * floored };
        let cube_h = if h > self.film_floor { 3.0 * square } else { 0.0 };
        let (density, density_p) = (point.density, point.density_slope);
        match self.face_mobility {
            FaceMobility::Arithmetic => NodeFlow {
                density,
                density_p,
                mobility: cube * point.reduced_slope,
                mobility_p: cube * point.reduced_curvature,
                mobility_h: cube_h * point.reduced_slope,
                potential: p,
                potential_p: 1.0,
            },
            FaceMobility::ReducedPressure => NodeFlow {
                density,
                density_p,
                mobility: cube,
                mobility_p: 0.0,
                mobility_h: cube_h,
                potential: point.reduced_pressure,
                potential_p: point.reduced_slope,
            },
        }
    }

    /// Takes over fluid pressure and film of every node.
    pub(super) fn update(&mut self, lubricant: &Lubricant, pressure: &[f64], film: &[f64]) {
        for (k, (&p, &h)) in pressure.iter().zip(film).enumerate() {
            self.nodes[k] = self.node_flow(lubricant, p, h);
        }
    }

    /// Density ratio of node `k`.
    pub(super) fn density(&self, k: usize) -> f64 {
        self.nodes[k].density
    }

    /// What node `k` carries along at `film`, `rho/rho_0 h` \[m\].
    pub(super) fn carried(&self, k: usize, film: f64) -> f64 {
        self.nodes[k].density * film.max(self.least_film)
    }

    /// Neighbours of node `k` (east, west, north, south) with their face coefficients; across a line contact they are the
    /// node itself.
    #[inline]
    fn neighbours(&self, k: usize) -> [(usize, f64); 4] {
        let nx = if self.grid.ny() == 1 { 0 } else { self.grid.nx() };
        [(k + 1, self.face_x), (k - 1, self.face_x), (k + nx, self.face_y), (k - nx, self.face_y)]
    }

    #[inline]
    fn face(&self, a: usize, b: usize) -> f64 {
        0.5 * (self.nodes[a].mobility + self.nodes[b].mobility)
    }

    /// Overrides the schemes of the problem until the next [`Self::configure`].
    pub(super) fn set_scheme(&mut self, scheme: Scheme, face_mobility: FaceMobility) {
        self.scheme = scheme;
        self.face_mobility = face_mobility;
    }

    /// Physical imbalance per `F`: `U / dx` \[1/s\].
    pub(super) fn rate(&self) -> f64 {
        self.rate
    }

    /// Flow over pressure difference of the faces to the east and to the north of node `k` \[m/Pa\], at the pressures of
    /// the last update.
    pub(super) fn conductances(&self, k: usize, pressure: &[f64]) -> [f64; 2] {
        let towards = |o: usize, c: f64| {
            let (a, b) = (&self.nodes[k], &self.nodes[o]);
            let difference = pressure[k] - pressure[o];
            let slope = if difference.abs() > SECANT_SHARE * (pressure[k] + pressure[o]) {
                (a.potential - b.potential) / difference
            } else {
                0.5 * (a.potential_p + b.potential_p)
            };
            c * self.face(k, o) * slope
        };
        [towards(k + 1, self.face_x), towards(k + self.grid.nx(), self.face_y)]
    }

    /// Coefficients of `m` at `k`, `k - 1` and `k - 2` in the entrainment term. The second-order scheme starts one cell
    /// behind the inlet, where there is a second node upstream.
    #[inline]
    pub(super) fn upwind(&self, k: usize) -> [f64; 3] {
        let w = self.wedge;
        match self.scheme {
            Scheme::SecondOrder if k % self.grid.nx() >= 2 => [1.5 * w, -2.0 * w, 0.5 * w],
            Scheme::SecondOrder => [1.5 * w, -1.5 * w, 0.0],
            Scheme::FirstOrder => [w, -w, 0.0],
        }
    }

    /// `F_k` for an interior node.
    pub(super) fn balance(&self, k: usize, film: &[f64], previous: Option<&[f64]>) -> f64 {
        let mut sum = self.transport(k, film, previous);
        for (o, c) in self.neighbours(k) {
            sum += c * self.face(k, o) * (self.nodes[k].potential - self.nodes[o].potential);
        }
        sum
    }

    /// Entrainment and squeeze of `F_k`.
    pub(super) fn transport(&self, k: usize, film: &[f64], previous: Option<&[f64]>) -> f64 {
        let mass = |q: usize| self.carried(q, film[q]);
        let own = mass(k);
        let [here, up, second] = self.upwind(k);
        let mut sum = here * own + up * mass(k - 1);
        if second != 0.0 {
            sum += second * mass(k - 2);
        }
        if let Some(previous) = previous {
            sum += self.squeeze * (own - previous[k]);
        }
        sum
    }

    /// Flow through all faces of node `k` per potential, neighbours held.
    fn conductance(&self, k: usize) -> f64 {
        self.neighbours(k).into_iter().map(|(o, c)| c * self.face(k, o)).sum()
    }

    /// Sum of the coefficients that multiply the own pressure: how strongly `F_k` resists it \[m/Pa\].
    pub(super) fn diagonal(&self, k: usize, near: NearField) -> f64 {
        let faces = self.conductance(k);
        self.wedge * (self.nodes[k].density * near.own - self.nodes[k - 1].density * near.next_x)
            + self.squeeze * self.nodes[k].density * near.own
            + faces * self.nodes[k].potential_p
    }

    /// Pressure flow through the faces of node `k` over the entrainment and squeeze of its elastic response.
    pub(super) fn flow_ratio(&self, k: usize, near: NearField) -> f64 {
        self.conductance(k) * self.nodes[k].potential_p
            / ((self.wedge + self.squeeze) * self.nodes[k].density * near.own)
    }

    /// How strongly `F_k` depends on the own mass: entrainment and squeeze together.
    pub(super) fn own_mass(&self, k: usize) -> f64 {
        self.upwind(k)[0] + self.squeeze
    }

    pub(super) fn face_sums(&self, k: usize) -> FaceSums {
        let mut sums = FaceSums::default();
        for (o, c) in self.neighbours(k) {
            let (half, other) = (0.5 * c, &self.nodes[o]);
            sums.half += half;
            sums.mobility += half * other.mobility;
            sums.potential += half * other.potential;
            sums.inflow += half * other.mobility * other.potential;
        }
        sums
    }

    /// Change of `F_k` under a change of fluid pressure `dp` and film `dh`.
    pub(super) fn balance_change(&self, k: usize, film: &[f64], dp: &[f64], dh: &[f64]) -> f64 {
        let mass_change =
            |q: usize| self.nodes[q].density_p * film[q] * dp[q] + self.nodes[q].density * dh[q];
        let mobility_change = |q: usize| self.nodes[q].mobility_p * dp[q] + self.nodes[q].mobility_h * dh[q];
        let own = &self.nodes[k];
        let [here, up, second] = self.upwind(k);
        let mut sum = (here + self.squeeze) * mass_change(k) + up * mass_change(k - 1);
        if second != 0.0 {
            sum += second * mass_change(k - 2);
        }
        let (own_potential, own_mobility) = (own.potential_p * dp[k], mobility_change(k));
        for (o, c) in self.neighbours(k) {
            let other = &self.nodes[o];
            sum += c
                * (0.5 * (own.mobility + other.mobility) * (own_potential - other.potential_p * dp[o])
                    + 0.5 * (own_mobility + mobility_change(o)) * (own.potential - other.potential));
        }
        sum
    }

    /// Row `k` of the fluid block: derivatives of `F_k` with respect to the fluid unknowns of `k` and its four
    /// neighbours, entrainment of first order, the film of a node following its own pressure alone.
    ///
    /// The unknown of a free fluid node is its pressure, which also moves films; of a contact node its fluid
    /// pressure at fixed film; of a node where the fluid itself reaches the limit its film in units of `own_influence`.
    pub(super) fn stencil_row(
        &self,
        k: usize,
        kinds: &[Kind],
        film: &[f64],
        own_influence: f64,
    ) -> [f64; STENCIL] {
        let mut row = [0.0; STENCIL];
        let moves_pressure = |m: usize| kinds[m].has_fluid_pressure();
        // Each film follows its own pressure alone: solid contact around a fluid node screens what lies further off.
        let film_response = |q: usize| -> f64 {
            let responds = kinds[q].is_open_fluid() || kinds[q].fluid == Fluid::AtLimit;
            if responds { own_influence } else { 0.0 }
        };
        let faces = self.neighbours(k);
        let own = &self.nodes[k];
        let wedge = match self.scheme {
            Scheme::FirstOrder => self.wedge,
            Scheme::SecondOrder => SECOND_ORDER_WEIGHT * self.wedge,
        };
        let by_film = (wedge + self.squeeze) * own.density
            + faces
                .iter()
                .map(|&(o, c)| 0.5 * c * own.mobility_h * (own.potential - self.nodes[o].potential))
                .sum::<f64>();
        row[0] += by_film * film_response(k);
        if moves_pressure(k) {
            row[0] += (wedge + self.squeeze) * own.density_p * film[k];
        }
        // Upstream mass.
        let up = k - 1;
        if moves_pressure(up) {
            row[2] -= wedge * self.nodes[up].density_p * film[up];
        }
        row[2] -= wedge * self.nodes[up].density * film_response(up);
        // Faces: potentials and mobilities of both nodes.
        for (face, (o, c)) in faces.into_iter().enumerate() {
            let (slot, other) = (face + 1, &self.nodes[o]);
            let mobility = c * self.face(k, o);
            let half = 0.5 * c * (own.potential - other.potential);
            if moves_pressure(k) {
                row[0] += mobility * own.potential_p + half * own.mobility_p;
            }
            if moves_pressure(o) {
                row[slot] += half * other.mobility_p - mobility * other.potential_p;
            }
            row[slot] += half * other.mobility_h * film_response(o);
        }
        row
    }

    /// Coefficients `(below, diagonal, above)` of an implicit step along x at node `k` with mobilities frozen,
    /// entrainment of first order and the elastic response of the line stiffened by `stiffness`.
    pub(super) fn line_row(&self, k: usize, near: NearField, stiffness: f64) -> (f64, f64, f64) {
        let [east, west, north, south] = self.neighbours(k).map(|(o, c)| c * self.face(k, o));
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
