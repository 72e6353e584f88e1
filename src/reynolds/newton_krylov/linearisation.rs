//! Derivatives of the mass balances, face by face, and what they make of changes of pressures and films.
//!
//! All is in single precision, balances and films over the self-influence, so that they are pressures. A flow is
//! computed once for the two nodes of its face: what rounding makes of it leaves one as it enters the other, and the balance
//! of a pocket, the small difference of large flows, keeps its digits.

use crate::grid::Grid;
use crate::numerics::STENCIL;
use crate::reynolds::discretisation::Discretisation;
use crate::reynolds::problem::inner_rows;

/// Largest derivative that counts: that of real films is some 1e12.
const LARGEST: f64 = 1e30;

/// Derivatives of the flow through the faces of one direction: by the pressures of its two nodes, by their films.
type FaceFlows = [Vec<f32>; 4];

/// The mass balances of all nodes, linearised.
#[derive(Debug)]
pub(super) struct Linearisation {
    grid: Grid,
    /// Derivatives of the mass of each node by its pressure and by its film.
    mass: [Vec<f32>; 2],
    /// Of the face to the east of each node, and of that to the north.
    east: FaceFlows,
    north: FaceFlows,
    /// Coefficients of the masses of a node and of two upstream: behind the inlet, and elsewhere.
    upwind: [[f32; 3]; 2],
    /// The first two of the preconditioner.
    near: [f32; 2],
    mass_change: Vec<f32>,
    east_change: Vec<f32>,
    north_change: Vec<f32>,
}

impl Linearisation {
    pub(super) fn new(grid: Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        let faces = || std::array::from_fn(|_| zeros());
        Self {
            grid,
            mass: [zeros(), zeros()],
            east: faces(),
            north: faces(),
            upwind: [[0.0; 3]; 2],
            near: [0.0; 2],
            mass_change: zeros(),
            east_change: zeros(),
            north_change: zeros(),
        }
    }

    /// Takes the derivatives at the last update of `fluid`, the films being `film`.
    pub(super) fn update(&mut self, fluid: &Discretisation, film: &[f64], own_influence: f64) {
        let (nx, n) = (self.grid.nx(), self.grid.len());
        let stiffness = 1.0 / own_influence;
        for (k, film) in film.iter().enumerate() {
            let [by_pressure, by_film] = fluid.mass_derivatives(k, *film);
            self.mass[0][k] = single(stiffness * by_pressure);
            self.mass[1][k] = single(by_film);
        }
        let keep = |flows: &mut FaceFlows, k: usize, derivatives: [f64; 4]| {
            flows[0][k] = single(stiffness * derivatives[0]);
            flows[1][k] = single(stiffness * derivatives[1]);
            flows[2][k] = single(derivatives[2]);
            flows[3][k] = single(derivatives[3]);
        };
        for k in 0..n - 1 {
            keep(&mut self.east, k, fluid.east_flow_derivatives(k));
        }
        for k in 0..n - nx {
            keep(&mut self.north, k, fluid.north_flow_derivatives(k));
        }
        self.upwind = [1, 2].map(|column| fluid.mass_coefficients(column).map(single));
        self.near = fluid.five_point_mass_coefficients().map(single);
    }

    /// Change of the balance of every inner node under changes of fluid pressure and film; others stay as they are.
    pub(super) fn product(&mut self, pressure: &[f32], film: &[f32], out: &mut [f32]) {
        let (nx, ny, n) = (self.grid.nx(), self.grid.ny(), self.grid.len());
        let [by_pressure, by_film] = &self.mass;
        let derivatives = by_pressure.iter().zip(by_film);
        let changes = pressure.iter().zip(film);
        for ((mass, (a, b)), (p, h)) in self.mass_change.iter_mut().zip(derivatives).zip(changes) {
            *mass = a * p + b * h;
        }
        flow_changes(&self.east, 1, pressure, film, &mut self.east_change);
        if ny > 1 {
            flow_changes(&self.north, nx, pressure, film, &mut self.north_change);
        }
        for first in inner_rows(&self.grid).map(|j| j * nx) {
            let (mass, east) = (&self.mass_change[first..first + nx], &self.east_change[first..first + nx]);
            let out = &mut out[first..first + nx];
            let [inlet, [here, up, second]] = self.upwind;
            out[1] = inlet[0] * mass[1] + inlet[1] * mass[0] + east[1] - east[0];
            for i in 2..nx - 1 {
                out[i] = here * mass[i] + up * mass[i - 1] + second * mass[i - 2] + (east[i] - east[i - 1]);
            }
            if ny > 1 {
                let (north, south) = (&self.north_change[first..n], &self.north_change[first - nx..first]);
                for ((out, north), south) in out[1..nx - 1].iter_mut().zip(&north[1..]).zip(&south[1..]) {
                    *out += north - south;
                }
            }
        }
    }

    /// Row of inner node `k` of the fluid block, centre, east, west, north and south: entrainment of first order, the film of a
    /// node following its own unknown by `response`, its pressure by `moves`.
    pub(super) fn stencil_row(&self, k: usize, moves: &[f32], response: &[f32]) -> [f32; STENCIL] {
        let nx = self.grid.nx();
        let [here, up] = self.near;
        let (east, north, mass) = (&self.east, &self.north, &self.mass);
        // Derivatives by pressures or by films, whose places in the flows are `a` and `a + 1`.
        let derivatives = |a: usize| {
            let across = if self.grid.ny() > 1 {
                [north[a][k] - north[a + 1][k - nx], north[a + 1][k], -north[a][k - nx]]
            } else {
                [0.0; 3]
            };
            let mass = &mass[a / 2];
            [
                here * mass[k] + (east[a][k] - east[a + 1][k - 1]) + across[0],
                east[a + 1][k],
                up * mass[k - 1] - east[a][k - 1],
                across[1],
                across[2],
            ]
        };
        let (by_pressure, by_film) = (derivatives(0), derivatives(2));
        let rows = if self.grid.ny() > 1 { nx } else { 0 };
        let nodes = [k, k + 1, k - 1, k + rows, k - rows];
        std::array::from_fn(|slot| {
            let node = nodes[slot];
            by_pressure[slot] * moves[node] + by_film[slot] * response[node]
        })
    }
}

/// In single precision, where absurd numbers stay finite.
fn single(value: f64) -> f32 {
    value.clamp(-LARGEST, LARGEST) as f32
}

/// Changes of the flows through faces to the node `stride` further on.
fn flow_changes(flows: &FaceFlows, stride: usize, pressure: &[f32], film: &[f32], out: &mut [f32]) {
    let n = out.len() - stride;
    let [own_p, other_p, own_h, other_h] = flows.each_ref().map(|derivatives| &derivatives[..n]);
    let (p, p_other) = (&pressure[..n], &pressure[stride..][..n]);
    let (h, h_other) = (&film[..n], &film[stride..][..n]);
    for (k, out) in out[..n].iter_mut().enumerate() {
        *out = (own_p[k] * p[k] + other_p[k] * p_other[k]) + (own_h[k] * h[k] + other_h[k] * h_other[k]);
    }
}
