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
//! With shear thinning the mean mobility of a face is divided by the mean of `eta*/eta` of its two nodes
//! ([`ShearThinning`](super::ShearThinning)). Why not a mean of `a eta/eta*`: at steep viscosities the node of high pressure
//! has nearly all of that and nearly none of the change of `q`. Divided like this the flow through a face still grows with
//! the pressure of its node where `ln eta` is linear in pressure, as `q_end - q <= (dq/dp) / (d ln eta/dp)`.
//!
//! In `a` the film counts as at least half the contact film, in `m` it counts as it is.
//!
//! Why means and not harmonic means: an asperity flank that the mesh does not resolve is drained by its deep neighbour,
//! so it ends in solid contact. The harmonic mean seals such a flank and traps films that no mesh refinement confirms.

use super::problem::{FaceMobility, LubricatedContact, Scheme};
use super::shear_thinning::{ShearThinning, ViscosityRatio};
use crate::grid::Grid;
use crate::lubricant::Lubricant;

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

/// Mobility of a face with its derivatives by pressure and film of the own node and of the other.
#[derive(Debug, Clone, Copy)]
struct FaceFlow {
    mobility: f64,
    own: [f64; 2],
    other: [f64; 2],
}

impl FaceFlow {
    /// The mean of both nodes.
    #[inline]
    fn newtonian(own: &NodeFlow, other: &NodeFlow) -> Self {
        Self {
            mobility: 0.5 * (own.mobility + other.mobility),
            own: [0.5 * own.mobility_p, 0.5 * own.mobility_h],
            other: [0.5 * other.mobility_p, 0.5 * other.mobility_h],
        }
    }

    /// That over the mean of the viscosity ratios.
    fn thinned(nodes: [(&NodeFlow, ViscosityRatio); 2]) -> Self {
        let [(own, r), (other, r_other)] = nodes;
        let sum = r.value + r_other.value;
        let mobility = (own.mobility + other.mobility) / sum;
        let by = |node: &NodeFlow, r: ViscosityRatio| {
            [
                (node.mobility_p - mobility * r.by_pressure) / sum,
                (node.mobility_h - mobility * r.by_film) / sum,
            ]
        };
        Self { mobility, own: by(own, r), other: by(other, r_other) }
    }
}

/// A node across a face of coefficient `c`, held.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeldNeighbour {
    c: f64,
    flow: NodeFlow,
    ratio: ViscosityRatio,
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
    /// Squeeze against the masses at which a linear step begins: in the derivatives alone, as it vanishes there.
    step_squeeze: f64,
    /// `1 / (12 eta_0)`.
    fluidity: f64,
    /// `U / dx` \[1/s\].
    rate: f64,
    nodes: Vec<NodeFlow>,
    /// Film in which the fluid at ambient pressure has `x = 1` \[m\]; zero without shear thinning.
    thinning: f64,
    /// `eta*/eta` of the nodes; empty without shear thinning.
    ratios: Vec<ViscosityRatio>,
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
            step_squeeze: 0.0,
            fluidity: 0.0,
            rate: 1.0,
            nodes: vec![NodeFlow::default(); grid.len()],
            thinning: 0.0,
            ratios: Vec::new(),
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
        self.step_squeeze = 0.0;
        let ambient = problem.lubricant.map(|l| l.viscosity().viscosity(0.0));
        self.fluidity = ambient.map_or(0.0, |eta| 1.0 / (12.0 * eta));
        let thinning = |(law, eta): (ShearThinning, f64)| law.length(eta);
        self.thinning = problem.shear_thinning.zip(ambient).map_or(0.0, thinning);
        let thinned = if self.thinning > 0.0 { self.grid.len() } else { 0 };
        self.ratios.resize(thinned, ViscosityRatio::NEWTONIAN);
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

    /// `eta*/eta` of a node at fluid pressure `p` and film `h`.
    fn viscosity_ratio(&self, lubricant: &Lubricant, p: f64, h: f64) -> ViscosityRatio {
        let point = lubricant.at(p);
        let floored = h.max(self.film_floor);
        // Density over slope of the reduced pressure is the viscosity over that at ambient pressure.
        let x = self.thinning / floored * (point.density / point.reduced_slope);
        let by_pressure = point.density_slope / point.density - point.reduced_curvature / point.reduced_slope;
        ViscosityRatio::new(x, by_pressure, if h > self.film_floor { -1.0 / h } else { 0.0 })
    }

    /// Takes over fluid pressure and film of every node.
    pub(super) fn update(&mut self, lubricant: &Lubricant, pressure: &[f64], film: &[f64]) {
        for (k, (&p, &h)) in pressure.iter().zip(film).enumerate() {
            self.nodes[k] = self.node_flow(lubricant, p, h);
        }
        if !self.ratios.is_empty() {
            for (k, (&p, &h)) in pressure.iter().zip(film).enumerate() {
                self.ratios[k] = self.viscosity_ratio(lubricant, p, h);
            }
        }
    }

    /// The quantities of node `k` at the last update.
    pub(super) fn present_flow(&self, k: usize) -> NodeFlow {
        self.nodes[k]
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
        let sum = self.nodes[a].mobility + self.nodes[b].mobility;
        if self.ratios.is_empty() { 0.5 * sum } else { sum / (self.ratios[a].value + self.ratios[b].value) }
    }

    /// Overrides the schemes of the problem until the next [`Self::configure`].
    pub(super) fn set_scheme(&mut self, scheme: Scheme, face_mobility: FaceMobility) {
        self.scheme = scheme;
        self.face_mobility = face_mobility;
    }

    /// Makes the next linear steps, until [`Self::configure`], steps in time of `1 / share` passages of a cell.
    pub(super) fn set_step_squeeze(&mut self, share: f64) {
        self.step_squeeze = share * self.wedge;
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

    /// How strongly `F_k` depends on the own mass: entrainment and squeezes together.
    pub(super) fn own_mass(&self, k: usize) -> f64 {
        self.upwind(k)[0] + self.squeeze + self.step_squeeze
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

    /// The neighbours of a node, where shear thinning keeps their sums from being all that counts.
    pub(super) fn held_neighbours(&self, k: usize) -> Option<[HeldNeighbour; 4]> {
        let held = |(o, c): (usize, f64)| HeldNeighbour { c, flow: self.nodes[o], ratio: self.ratios[o] };
        (!self.ratios.is_empty()).then(|| self.neighbours(k).map(held))
    }

    /// Flow through all faces of a node at fluid pressure `p` and film `h`, and its derivatives by both.
    pub(super) fn thinned_outflow(
        &self,
        lubricant: &Lubricant,
        neighbours: &[HeldNeighbour; 4],
        p: f64,
        h: f64,
    ) -> [f64; 3] {
        let node = (&self.node_flow(lubricant, p, h), self.viscosity_ratio(lubricant, p, h));
        let mut sums = [0.0; 3];
        for HeldNeighbour { c, flow, ratio } in neighbours {
            let face = FaceFlow::thinned([node, (flow, *ratio)]);
            let drop = c * (node.0.potential - flow.potential);
            sums[0] += face.mobility * drop;
            sums[1] += face.own[0] * drop + c * face.mobility * node.0.potential_p;
            sums[2] += face.own[1] * drop;
        }
        sums
    }

    /// Derivatives of the flow through the face to the east of node `k`: by both pressures, then by both films.
    pub(super) fn east_flow_derivatives(&self, k: usize) -> [f64; 4] {
        self.flow_derivatives(k, k + 1, self.face_x)
    }

    /// Those of the face to the north.
    pub(super) fn north_flow_derivatives(&self, k: usize) -> [f64; 4] {
        self.flow_derivatives(k, k + self.grid.nx(), self.face_y)
    }

    #[inline]
    fn flow_derivatives(&self, k: usize, o: usize, c: f64) -> [f64; 4] {
        let face = if self.ratios.is_empty() {
            FaceFlow::newtonian(&self.nodes[k], &self.nodes[o])
        } else {
            FaceFlow::thinned([k, o].map(|k| (&self.nodes[k], self.ratios[k])))
        };
        let (own, other) = (&self.nodes[k], &self.nodes[o]);
        let (drop, mobility) = (c * (own.potential - other.potential), c * face.mobility);
        [
            mobility * own.potential_p + drop * face.own[0],
            drop * face.other[0] - mobility * other.potential_p,
            drop * face.own[1],
            drop * face.other[1],
        ]
    }

    /// Derivatives of the mass of node `k` by its pressure and by its film, which is `film`.
    pub(super) fn mass_derivatives(&self, k: usize, film: f64) -> [f64; 2] {
        [self.nodes[k].density_p * film, self.nodes[k].density]
    }

    /// Coefficients of the masses of a node in `column` and of two upstream in its balance.
    pub(super) fn mass_coefficients(&self, column: usize) -> [f64; 3] {
        let [here, up, second] = self.upwind(column);
        [here + self.squeeze + self.step_squeeze, up, second]
    }

    /// Those of a node and of the one upstream with which a matrix of five points stands in for the balances.
    pub(super) fn five_point_mass_coefficients(&self) -> [f64; 2] {
        let wedge = match self.scheme {
            Scheme::FirstOrder => self.wedge,
            Scheme::SecondOrder => SECOND_ORDER_WEIGHT * self.wedge,
        };
        [wedge + self.squeeze + self.step_squeeze, -wedge]
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lubricant::{Barus, DowsonHigginson, Incompressible, Roelands};

    const FILM: f64 = 4e-8;
    const MOBILITIES: [FaceMobility; 2] = [FaceMobility::Arithmetic, FaceMobility::ReducedPressure];

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
                fluid.update(&oil, &[p; 5], &[FILM; 5]);
                let eta = oil.viscosity().viscosity(p);
                let effective = eta * law.viscosity_ratio(eta, FILM);
                let exact = oil.density().ratio(p) * FILM.powi(3) / (12.0 * effective);
                let found = fluid.face(2, 3) * fluid.nodes[2].potential_p;
                assert!(
                    (found / exact - 1.0).abs() < 1e-4,
                    "{found:e}, {exact:e} at {p:e}, {face_mobility:?}"
                );
            }
        }
    }

    /// The flow between two pressures through a film of one thickness is `h^3/12` times the integral of `dp / eta*`.
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
                fluid.update(&oil, &pressure, &[FILM; 5]);
                fluid.face(3, 2) * (fluid.nodes[3].potential - fluid.nodes[2].potential) / exact(low, high)
                    - 1.0
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
                if face_mobility == FaceMobility::ReducedPressure {
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
                fluid.update(&oil, &pressure, &film);
                let neighbours = fluid.held_neighbours(2).unwrap();
                let flow = |p: f64, h: f64| fluid.thinned_outflow(&oil, &neighbours, p, h);
                let (p, h) = (pressure[2], film[2]);
                let [value, by_pressure, by_film] = flow(p, h);
                assert!((fluid.balance(2, &film, None) / value - 1.0).abs() < 1e-13, "{value:e}");
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
                    fluid.update(&oil, &[other; 5], &films);
                    let neighbours = fluid.held_neighbours(2).unwrap();
                    for step in 0..150 {
                        let p = f64::from(step) * 1e7;
                        let slope = fluid.thinned_outflow(&oil, &neighbours, p, film[0])[1];
                        assert!(slope > 0.0, "{slope:e} at {p:e}, {other:e}, films {film:?}, {thinning:e}");
                    }
                }
            }
        }
    }
}
