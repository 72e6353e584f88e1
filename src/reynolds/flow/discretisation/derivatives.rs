//! Derivatives of the balances by pressures and films.
//!
//! They are exact; tests compare them with finite differences. A new face law or scheme adds its derivatives to
//! `FaceFlow` or `FaceFilm`. Newton's method assembles its linear system from them, face by face.

use super::super::direction::Direction;
use super::super::entrainment::DensityRise;
use super::super::face_mobility::{FaceFlow, FaceMobility};
use super::super::node::NodeFlow;
use super::{Discretisation, NearField, Scheme};

/// Derivatives of the entrainment correction of a face (its flux minus that of its first node): by the pressures
/// of that node and of its upstream neighbor; by the films of that node, of the second node of the face and of the
/// upstream neighbor.
pub(in crate::reynolds) type BeyondDerivatives = [f64; 5];

/// Weight of the first-order entrainment term in the preconditioner of the second-order one. The ratio of both is
/// between 1 (smooth fields) and 2 (node-to-node oscillations).
const SECOND_ORDER_WEIGHT: f64 = 1.25;

impl Discretisation {
    /// Derivatives of the pressure flow through the face east of node `k` in `column` at fixed face film ratio and
    /// inlet factor, by both pressures, then by both films; then those of its entrainment correction. Zero in the
    /// last column.
    #[inline]
    pub(in crate::reynolds) fn east_derivatives(
        &self,
        k: usize,
        column: usize,
    ) -> ([f64; 4], BeyondDerivatives) {
        if column + 1 == self.grid.nx() {
            return ([0.0; 4], [0.0; 5]);
        }
        let face = self.face_flow(k, k + 1, self.along_at(k));
        let by_flow = self.flow_derivatives(k, k + 1, self.coefficients[k][0], &face);
        (by_flow, self.beyond_derivatives(k, column, &face))
    }

    /// Derivatives of the pressure flow through the face north of node `k`: by both pressures, then by both films.
    /// Zero across an edge.
    #[inline]
    pub(in crate::reynolds) fn north_derivatives(&self, k: usize) -> [f64; 4] {
        let Some(north) = self.grid.north_of(k) else { return [0.0; 4] };
        self.flow_derivatives(k, north, self.coefficients[k][1], &self.face_flow(k, north, Direction::Across))
    }

    /// Derivatives of the flow through the face of coefficient `c` between nodes `k` and `o`: by both
    /// pressures, then by both films.
    #[inline]
    fn flow_derivatives(&self, k: usize, o: usize, c: f64, face: &FaceFlow) -> [f64; 4] {
        let (own, other) = (&self.nodes[k], &self.nodes[o]);
        let (drop, mobility) = (c * (own.potential - other.potential), c * face.mobility);
        [
            mobility * own.potential_p + drop * face.first[0],
            drop * face.second[0] - mobility * other.potential_p,
            drop * face.first[1],
            drop * face.second[1],
        ]
    }

    /// Whether the flux through a face differs from that of its first node, or its mobility depends on the upstream
    /// neighbor.
    pub(in crate::reynolds) fn has_entrainment_corrections(&self) -> bool {
        self.scheme != Scheme::FirstOrder || self.face_mobility == FaceMobility::Inlet
    }

    /// Derivatives of the entrainment correction of the face east of node `k`, including its effect on the pressure
    /// flow.
    fn beyond_derivatives(&self, k: usize, column: usize, face: &FaceFlow) -> BeyondDerivatives {
        // At the inlet there is no upstream neighbor.
        let (up, own, next) = (&self.nodes[k - column.min(1)], &self.nodes[k], &self.nodes[k + 1]);
        let film = self.face_film(k, column);
        let own_film = self.masses[k] / own.density;
        let by_films = |density: f64| [film.by_own, film.by_next, film.by_up].map(|by| density * by);
        // Entrainment correction by densities and films.
        let (by_densities, by_films) = match self.scheme {
            Scheme::SecondOrder if column > 0 => {
                let up_film = self.masses[k - 1] / up.density;
                ([0.5 * own_film, -0.5 * up_film], [0.5 * own.density, 0.0, -0.5 * up.density])
            }
            Scheme::Limited if column > 0 => {
                let DensityRise { rise, by_density, by_own_film, by_up_film } = self.density_rise(k, column);
                let whole = own_film + film.beyond;
                let [by_own, by_next, by_up] = by_films(own.density + rise);
                (
                    [film.beyond + by_density * whole, -by_density * whole],
                    [by_own + rise + whole * by_own_film, by_next, by_up + whole * by_up_film],
                )
            }
            _ => ([film.beyond, 0.0], by_films(own.density)),
        };
        // The ratio of the face film to the node film is `1 + beyond / film`.
        let mut by_flow = [0.0; 3];
        if face.by_face_film != 0.0 {
            let drop = self.coefficients[k][0] * (own.potential - next.potential);
            let (per_film, per_inlet) = (drop * face.by_face_film / own.film, drop * face.by_inlet);
            let inlet = &self.inlets[k];
            by_flow = [
                per_film * (film.by_own - film.beyond / own.film) + per_inlet * inlet.by_own,
                per_film * film.by_next + per_inlet * inlet.by_next,
                per_film * film.by_up + per_inlet * inlet.by_up,
            ];
        }
        // Chain rule: densities depend on pressures, films on the unknown films.
        let slopes = [own.density_p, up.density_p];
        let films = [own.film_h, next.film_h, up.film_h];
        let wedge = if self.is_starved(k) { 0.0 } else { self.wedge_at(k) };
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

    /// Coefficients of the masses of a node and of its upstream neighbor in its balance, without entrainment
    /// corrections, in the row of node `first`.
    pub(in crate::reynolds) fn mass_coefficients(&self, first: usize) -> [f64; 2] {
        let wedge = self.wedge_at(first);
        [wedge + self.squeeze + self.pseudo_transient, -wedge]
    }

    /// The same for a five-point matrix that approximates the balances.
    pub(in crate::reynolds) fn five_point_mass_coefficients(&self, first: usize) -> [f64; 2] {
        let wedge = match self.scheme {
            Scheme::FirstOrder | Scheme::Limited => self.wedge_at(first),
            Scheme::SecondOrder => SECOND_ORDER_WEIGHT * self.wedge_at(first),
        };
        [wedge + self.squeeze + self.pseudo_transient, -wedge]
    }

    /// Coefficients `(below, diagonal, above)` of an implicit step along x at node `k` with frozen mobilities,
    /// first-order entrainment and an elastic response scaled by `stiffness`.
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
