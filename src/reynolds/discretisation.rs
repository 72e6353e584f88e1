//! The discrete Reynolds equation, once for all solvers.
//!
//! Finite volumes on the cells of the grid. The net outflow of cell `k`, multiplied by `dx / U` with `U` the
//! entrainment speed (or `dx / dt` if that is larger), is a film thickness \[m\]:
//!
//! `F_k = sum over faces of c e_face (p_k - p_neighbour) + w (m_k - m_upstream) + s (m_k - m_previous)`
//!
//! with `m = rho/rho_0 h`, mobility `e = rho/rho_0 h^3 / (12 eta)`, its arithmetic mean on a face, `c = 1 / (U dx)` (faces
//! in x) or `dx / (U dy^2)` (faces in y), `w = u / U` and `s = dx / (U dt)`. In mobility the film counts as at least
//! half the contact film, in `m` it counts as it is.
//!
//! Why the arithmetic mean: an asperity flank that the mesh does not resolve is drained by its deep neighbour, so it
//! ends in solid contact. The harmonic mean seals such a flank and traps films that no mesh refinement confirms.

use super::active_set::{Fluid, Kind};
use super::problem::LubricatedContact;
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::numerics::STENCIL;

/// Fluid quantities of the current pressure and film, and the coefficients of the balance.
#[derive(Debug, Clone)]
pub(super) struct Discretisation {
    pub(super) grid: Grid,
    contact_film: f64,
    face_x: f64,
    face_y: f64,
    wedge: f64,
    squeeze: f64,
    /// Pseudo-transient term of the linearised equations alone.
    pub(super) inertia: f64,
    pub(super) density: Vec<f64>,
    density_slope: Vec<f64>,
    viscosity: Vec<f64>,
    viscosity_slope: Vec<f64>,
    mobility: Vec<f64>,
    mobility_by_pressure: Vec<f64>,
    mobility_by_film: Vec<f64>,
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
        let zeros = || vec![0.0; grid.len()];
        Self {
            grid,
            contact_film: 0.0,
            face_x: 0.0,
            face_y: 0.0,
            wedge: 0.0,
            squeeze: 0.0,
            inertia: 0.0,
            density: zeros(),
            density_slope: zeros(),
            viscosity: zeros(),
            viscosity_slope: zeros(),
            mobility: zeros(),
            mobility_by_pressure: zeros(),
            mobility_by_film: zeros(),
        }
    }

    /// Takes speeds and steps from the problem.
    pub(super) fn configure(&mut self, problem: &LubricatedContact<'_>) {
        let (dx, dy) = (self.grid.dx(), self.grid.dy());
        let grid_speed = problem.squeeze.map_or(0.0, |s| dx / s.time_step);
        let speed = problem.entrainment_speed.max(grid_speed);
        self.contact_film = problem.contact_film();
        self.face_x = 1.0 / (speed * dx);
        self.face_y = dx / (speed * dy * dy);
        self.wedge = problem.entrainment_speed / speed;
        self.squeeze = grid_speed / speed;
    }

    /// Fluid quantities at fluid pressure `pressure` and film `film`.
    pub(super) fn update(&mut self, lubricant: &Lubricant, pressure: &[f64], film: &[f64]) {
        lubricant.density().fill(pressure, &mut self.density, &mut self.density_slope);
        lubricant.viscosity().fill_with_slope(pressure, &mut self.viscosity, &mut self.viscosity_slope);
        // Below the contact film, where only unfinished iterations are, the mobility keeps falling: a floor at the
        // contact film itself would hide from Newton that a node just under it can open.
        let floor = 0.5 * self.contact_film;
        for (k, &raw) in film.iter().enumerate() {
            let h = raw.max(floor);
            let base = self.density[k] / (12.0 * self.viscosity[k]);
            self.mobility[k] = base * h * h * h;
            self.mobility_by_pressure[k] =
                self.mobility[k] * (self.density_slope[k] / self.density[k] - self.viscosity_slope[k]);
            self.mobility_by_film[k] = if raw > floor { 3.0 * base * h * h } else { 0.0 };
        }
    }

    /// Neighbour `slot` of node `k` (east, west, north, south) with the face coefficient.
    #[inline]
    fn neighbours(&self, k: usize) -> [(usize, f64); 4] {
        let nx = self.grid.nx();
        [(k + 1, self.face_x), (k - 1, self.face_x), (k + nx, self.face_y), (k - nx, self.face_y)]
    }

    #[inline]
    fn face(&self, a: usize, b: usize) -> f64 {
        0.5 * (self.mobility[a] + self.mobility[b])
    }

    /// `F_k` for an interior node.
    pub(super) fn balance(&self, k: usize, pressure: &[f64], film: &[f64], previous: Option<&[f64]>) -> f64 {
        let mass = self.density[k] * film[k];
        let mut sum = self.wedge * (mass - self.density[k - 1] * film[k - 1]);
        if let Some(previous) = previous {
            sum += self.squeeze * (mass - previous[k]);
        }
        for (o, c) in self.neighbours(k) {
            sum += c * self.face(k, o) * (pressure[k] - pressure[o]);
        }
        sum
    }

    /// Sum of the coefficients that multiply the own pressure: how strongly `F_k` resists it \[m/Pa\].
    pub(super) fn diagonal(&self, k: usize, near: NearField) -> f64 {
        let mut sum = self.wedge * (self.density[k] * near.own - self.density[k - 1] * near.next_x)
            + self.squeeze * self.density[k] * near.own;
        for (o, c) in self.neighbours(k) {
            sum += c * self.face(k, o);
        }
        sum
    }

    /// Change of `F_k` under a change of fluid pressure `dp` and film `dh`.
    pub(super) fn balance_change(
        &self,
        k: usize,
        pressure: &[f64],
        film: &[f64],
        dp: &[f64],
        dh: &[f64],
    ) -> f64 {
        let mass_change = |q: usize| self.density_slope[q] * film[q] * dp[q] + self.density[q] * dh[q];
        let mobility_change =
            |q: usize| self.mobility_by_pressure[q] * dp[q] + self.mobility_by_film[q] * dh[q];
        let own_mass = mass_change(k);
        let own_mobility = mobility_change(k);
        let mut sum = self.wedge * (own_mass - mass_change(k - 1)) + (self.squeeze + self.inertia) * own_mass;
        for (o, c) in self.neighbours(k) {
            sum += c
                * (self.face(k, o) * (dp[k] - dp[o])
                    + 0.5 * (own_mobility + mobility_change(o)) * (pressure[k] - pressure[o]));
        }
        sum
    }

    /// Row `k` of the fluid block: derivatives of `F_k` with respect to the fluid unknowns of `k` and its four
    /// neighbours, the elastic response cut off after the neighbours along x.
    ///
    /// The unknown of a free fluid node is its pressure, which also moves films; of a contact node its fluid
    /// pressure at fixed film; of a node where the fluid itself reaches the limit its film in units of `near.own`.
    pub(super) fn stencil_row(
        &self,
        k: usize,
        kinds: &[Kind],
        pressure: &[f64],
        film: &[f64],
        near: NearField,
    ) -> [f64; STENCIL] {
        let mut row = [0.0; STENCIL];
        // Derivatives of mass and mobility of node q by the unknown of node m, as (by pressure, by film).
        let moves_pressure = |m: usize| kinds[m].has_fluid_pressure();
        let film_response = |q: usize, m: usize, coefficient: f64| -> f64 {
            if kinds[q].film_is_free() && kinds[m].is_open_fluid() {
                coefficient
            } else if q == m && kinds[m].fluid == Fluid::AtLimit {
                near.own
            } else {
                0.0
            }
        };
        let nodes = [k, k + 1, k - 1, k + self.grid.nx(), k - self.grid.nx()];
        // Along x alone: without the neighbours across the flow, and theirs, a row keeps its balance.
        let coupling = [near.own, near.next_x, near.next_x, 0.0, 0.0];
        let gradient: [f64; STENCIL] = std::array::from_fn(|slot| pressure[k] - pressure[nodes[slot]]);
        let own_mass = self.wedge + self.squeeze + self.inertia;
        for (slot, &m) in nodes.iter().enumerate() {
            // Own mass and own mobility.
            let own_film = film_response(k, m, coupling[slot]);
            row[slot] += own_mass * self.density[k] * own_film;
            for (face, (_, c)) in self.neighbours(k).into_iter().enumerate() {
                row[slot] += 0.5 * c * self.mobility_by_film[k] * own_film * gradient[face + 1];
            }
        }
        if moves_pressure(k) {
            row[0] += own_mass * self.density_slope[k] * film[k];
        }
        // Upstream mass.
        let up = k - 1;
        if moves_pressure(up) {
            row[2] -= self.wedge * self.density_slope[up] * film[up];
        }
        let upstream_coupling = [near.next_x, near.second_x, near.own, 0.0, 0.0];
        for (slot, coefficient) in upstream_coupling.into_iter().enumerate() {
            row[slot] -= self.wedge * self.density[up] * film_response(up, nodes[slot], coefficient);
        }
        // Faces: gradient of the unknown, mobility of the neighbour, mobility by the own pressure.
        for (face, (o, c)) in self.neighbours(k).into_iter().enumerate() {
            let slot = face + 1;
            let conductance = c * self.face(k, o);
            let half = 0.5 * c * gradient[slot];
            if moves_pressure(k) {
                row[0] += conductance + half * self.mobility_by_pressure[k];
            }
            if moves_pressure(o) {
                row[slot] += half * self.mobility_by_pressure[o] - conductance;
            }
            row[slot] += half * self.mobility_by_film[o] * film_response(o, o, near.own);
            row[0] += half * self.mobility_by_film[o] * film_response(o, k, coupling[slot]);
        }
        row
    }

    /// Coefficients `(below, diagonal, above)` of an implicit step along x at node `k` with mobilities frozen and the
    /// elastic response of the line stiffened by `stiffness`.
    pub(super) fn line_row(&self, k: usize, near: NearField, stiffness: f64) -> (f64, f64, f64) {
        let nx = self.grid.nx();
        let (east, west) = (self.face_x * self.face(k, k + 1), self.face_x * self.face(k, k - 1));
        let cross = self.face_y * (self.face(k, k + nx) + self.face(k, k - nx));
        let (own, up) = (self.density[k] * stiffness, self.density[k - 1] * stiffness);
        let (w, s) = (self.wedge, self.squeeze);
        (
            -west + w * (own * near.next_x - up * near.own) + s * own * near.next_x,
            east + west + cross + w * (own * near.own - up * near.next_x) + s * own * near.own,
            -east + w * (own * near.next_x - up * near.second_x) + s * own * near.next_x,
        )
    }
}
