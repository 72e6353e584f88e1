//! Mass balance of each cell, with exact derivatives.
//!
//! Flows along x are divided by width and entrainment speed, which gives a film thickness \[m\]. The surfaces
//! move along +x. With the integrals `I_2` and `I_3` of `1/h^2` and `1/h^3` between two nodes the flow of a
//! full film is
//!
//! `f = rho I_2 / I_3 + (q_0 - q_1) / (12 eta_0 u I_3)`,
//!
//! exactly, where `q` are the reduced pressures of the nodes. The interval has two pieces, see `film`. If the
//! pressure at their joint would be below the cavitation pressure, the film ruptures there. The flow is then
//! that of the upstream piece alone: the smaller of the two.
//!
//! Each node has one unknown `s`. In a full node it is the pressure above cavitation over the scale of the
//! node, in a cavitated one the film fraction minus one. The scale makes the derivative of the outflow by `s`
//! continuous at zero.

use super::faces::{Face, conductances_across, faces_along};
use super::film::FilmThickness;
use super::{EAST, GivenFilm, NORTH, SOUTH, WEST};
use crate::lubricant::Lubricant;
use crate::numerics::STENCIL;

/// Rounding error of a balance over its cancelling terms: that of the pressures and of their sums.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Relative shift of the diagonal of cavitated nodes of a periodic film: above the rounding errors of single precision.
const PERIOD_SHIFT: f64 = 1e-6;

/// Newton steps on the balance of one cell in a sweep.
const LOCAL_STEPS: usize = 3;

/// Fluid at a node, with derivatives by its unknown.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Fluid {
    /// Reduced pressure above that of cavitation \[Pa\].
    pub(super) potential: f64,
    /// Its derivative.
    potential_s: f64,
    /// `rho/rho_0`.
    pub(super) density: f64,
    /// Its derivative.
    density_s: f64,
    /// Film fraction.
    pub(super) theta: f64,
    /// Its derivative.
    theta_s: f64,
}

/// Flow through a face, with derivatives by the unknowns of both nodes.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Flow {
    /// The flow \[m\].
    pub(super) value: f64,
    /// Derivative by the unknown of the upstream node.
    by_first: f64,
    /// Derivative by the unknown of the downstream node.
    by_second: f64,
    /// Whether the film ruptures between the two pieces.
    pub(super) ruptured: bool,
    /// Sum of the absolute values of the cancelling pressure flow terms.
    terms: f64,
}

/// Flow through the edges of the box and from the feeds \[m\].
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BoundaryFlux {
    /// Inflow through all edges and feeds.
    pub(super) inflow: f64,
    /// Outflow through all edges and feeds.
    pub(super) outflow: f64,
    /// Bound on the rounding error of the sum of all absolute imbalances \[m\].
    pub(super) rounding: f64,
}

impl BoundaryFlux {
    /// `|out - in| / in`; zero without flow.
    pub(super) fn imbalance(self) -> f64 {
        let difference = (self.outflow - self.inflow).abs();
        if difference > 0.0 { difference / self.inflow } else { 0.0 }
    }
}

/// The balance of the cells of a film.
#[derive(Debug)]
pub(super) struct Balance<'a> {
    /// The film and its grid.
    pub(super) film: &'a FilmThickness,
    /// Viscosity and density.
    pub(super) lubricant: &'a Lubricant,
    /// Cavitation pressure \[Pa\].
    pub(super) cavitation: f64,
    /// Mean pressure of the edges \[Pa\].
    pub(super) edge_mean: f64,
    /// `12 eta_0 u` \[Pa m\]; without entrainment `u` is 1 m/s.
    pub(super) drag: f64,
    /// 1, or 0 without entrainment.
    pub(super) entrained: f64,
    /// Nodes with the pressure of a feed \[Pa\].
    fed: Vec<Option<f64>>,
    /// Intervals along x from edge to edge of the box, `nx + 1` per row; of a periodic film the first and the last one
    /// are the same.
    faces: Vec<Face>,
    /// Whether the film repeats along x.
    is_periodic: bool,
    /// Conductances along y, times `dx / dy`, `ny + 1` rows \[m/Pa\].
    across: Vec<f64>,
    /// Pressure per unknown of full nodes \[Pa\].
    scale: Vec<f64>,
    /// Growth of the outflow of a full node with its pressure, over the growth with a film that ruptures
    /// downstream of it.
    rupture_ratio: Vec<f64>,
    /// The fluid at the edges west and east, a value per row.
    ends: [Vec<Fluid>; 2],
    /// The fluid at the edges south and north.
    sides: [Fluid; 2],
    /// Density ratio where the film is cavitated.
    pub(super) cavitated_density: f64,
    /// Reduced pressure there \[Pa\].
    cavitated_potential: f64,
    /// The fluid at each node.
    fluids: Vec<Fluid>,
}

/// Reduced pressure \[Pa\], its slope, density ratio and its slope. Below zero the laws have their values at
/// zero.
fn point(lubricant: &Lubricant, pressure: f64) -> [f64; 4] {
    if pressure < 0.0 {
        return [pressure, 1.0, 1.0, 0.0];
    }
    let at = lubricant.at(pressure);
    [at.reduced_pressure, at.reduced_slope, at.density, at.density_slope]
}

impl<'a> Balance<'a> {
    /// The balance of `film` under the conditions of `problem`, entrained with `speed` along +x, 0 or more.
    pub(super) fn new(problem: &GivenFilm<'a>, film: &'a FilmThickness, speed: f64) -> Self {
        let grid = film.grid();
        let (nx, ny) = (grid.nx(), grid.ny());
        let (entrained, unit) = if speed > 0.0 { (1.0, speed) } else { (0.0, 1.0) };
        let drag = 12.0 * problem.lubricant.viscosity().viscosity(0.0) * unit;
        let faces = faces_along(problem, film, entrained, drag);
        let across = conductances_across(problem, film, drag);
        let [q_cavitation, slope, density, _] = point(problem.lubricant, problem.cavitation_pressure);
        let at_edge = |pressure: f64| {
            let [q, _, density, _] = point(problem.lubricant, pressure);
            Fluid { potential: q - q_cavitation, density, theta: 1.0, ..Fluid::default() }
        };
        let ends =
            [WEST, EAST].map(|edge| (0..ny).map(|j| at_edge(problem.end_pressure(edge, j, grid))).collect());
        let sides = [SOUTH, NORTH].map(|edge| at_edge(problem.edge_pressures[edge]));
        let (mut scale, mut rupture_ratio) = (Vec::with_capacity(grid.len()), Vec::with_capacity(grid.len()));
        for (j, i) in (0..ny).flat_map(|j| (0..nx).map(move |i| (j, i))) {
            let k = j * nx + i;
            let [west, east] = [0, 1].map(|side| faces[j * (nx + 1) + i + side]);
            let conductances = west.conductance + east.conductance + across[k] + across[k + nx];
            let [first, second] = problem.pieces(film, i + 1, j);
            scale.push(density * first.and(second).film() / (slope * conductances));
            rupture_ratio.push(conductances / (conductances - east.conductance + east.first_conductance));
        }
        Self {
            film,
            lubricant: problem.lubricant,
            cavitation: problem.cavitation_pressure,
            edge_mean: 0.25 * problem.edge_pressures.iter().sum::<f64>(),
            drag,
            entrained,
            fed: problem.fed(grid),
            faces,
            is_periodic: problem.is_periodic,
            across,
            scale,
            rupture_ratio,
            ends,
            sides,
            cavitated_density: density,
            cavitated_potential: q_cavitation,
            fluids: vec![Fluid::default(); grid.len()],
        }
    }

    /// The unknown of a node at `pressure` and film fraction `theta`; that of a fed node has its own pressure.
    pub(super) fn unknown(&self, k: usize, pressure: f64, theta: f64) -> f64 {
        if let Some(pressure) = self.fed[k] {
            return (pressure - self.cavitation) / self.scale[k];
        }
        let above = pressure - self.cavitation;
        if above > 0.0 { above / self.scale[k] } else { theta - 1.0 }
    }

    /// Pressure \[Pa\] of a node.
    pub(super) fn pressure(&self, k: usize, unknown: f64) -> f64 {
        self.cavitation + self.scale[k] * unknown.max(0.0)
    }

    /// Pressure \[Pa\] at the reduced pressure `potential`, linearized about `pressure` and its reduced
    /// pressure `known`. Both reduced pressures count from cavitation.
    pub(super) fn pressure_beside(&self, pressure: f64, known: f64, potential: f64) -> f64 {
        let [_, slope, ..] = point(self.lubricant, pressure);
        (pressure + (potential - known) / slope).max(self.cavitation)
    }

    /// The unknown of a node minus `change`. A node that becomes full starts with a smaller pressure if a
    /// film that ruptures downstream of it has a larger outflow than a full one. In a period that is cavitated all around,
    /// film fractions are determined up to a constant, and changes are arbitrarily large: a film fraction stays above 0, and
    /// the pressure of a node that becomes full drives at most the flow of its full film.
    pub(super) fn moved(&self, k: usize, unknown: f64, change: f64) -> f64 {
        let mut next = unknown - change;
        if self.is_periodic {
            next = if unknown < 0.0 { next.clamp(-1.0, 1.0) } else { next.max(-1.0) };
        }
        if unknown < 0.0 && next > 0.0 { self.rupture_ratio[k] * next } else { next }
    }

    /// Updates the fluid of all nodes from their unknowns.
    pub(super) fn update(&mut self, unknowns: &[f64]) {
        for (k, &s) in unknowns.iter().enumerate() {
            self.fluids[k] = self.fluid(k, s);
        }
    }

    /// The fluid at node `k` with the unknown `s`.
    fn fluid(&self, k: usize, s: f64) -> Fluid {
        if s < 0.0 {
            return Fluid {
                density: self.cavitated_density,
                theta: 1.0 + s,
                theta_s: 1.0,
                ..Fluid::default()
            };
        }
        let scale = self.scale[k];
        let [q, slope, density, density_slope] = point(self.lubricant, self.cavitation + scale * s);
        Fluid {
            potential: q - self.cavitated_potential,
            potential_s: scale * slope,
            density,
            density_s: scale * density_slope,
            theta: 1.0,
            theta_s: 0.0,
        }
    }

    /// Balances each cell with its neighbors held fixed, one after the other along the flow, rows in the
    /// order of `rows`.
    pub(super) fn sweep(&mut self, unknowns: &mut [f64], rows: impl Iterator<Item = usize>) {
        let nx = self.film.grid().nx();
        for (j, i) in rows.flat_map(|j| (0..nx).map(move |i| (j, i))) {
            let k = j * nx + i;
            if self.fed[k].is_some() {
                continue;
            }
            for _ in 0..LOCAL_STEPS {
                // Newton step on the net outflow of the cell.
                let [west, east] = [self.flow_along(i, j), self.flow_along(i + 1, j)];
                let [south, north] = [self.flow_across(i, j), self.flow_across(i, j + 1)];
                let outflow = east.value - west.value + north.value - south.value;
                let slope = east.by_first - west.by_second + north.by_first - south.by_second;
                let before = unknowns[k];
                if slope > 0.0 {
                    unknowns[k] = self.moved(k, before, outflow / slope);
                    self.fluids[k] = self.fluid(k, unknowns[k]);
                }
                // Repeat only if the cell changes between full and cavitated.
                if (unknowns[k] < 0.0) == (before < 0.0) {
                    break;
                }
            }
        }
    }

    /// Share of the interval along x that ends at node `(i, j)` outside of feeds.
    pub(super) fn free_share(&self, i: usize, j: usize) -> f64 {
        self.faces[j * (self.film.grid().nx() + 1) + i].free_share
    }

    /// The nodes at both ends of the interval along x that ends at node `(i, j)`; `None` for an edge of the box.
    fn nodes_along(&self, i: usize, j: usize) -> [Option<usize>; 2] {
        let nx = self.film.grid().nx();
        let (row, wraps) = (j * nx, self.is_periodic);
        let first = i.checked_sub(1).or_else(|| wraps.then_some(nx - 1));
        let second = if i < nx { Some(i) } else { wraps.then_some(0) };
        [first, second].map(|node| node.map(|i| row + i))
    }

    /// The fluid at both ends of the interval along x that ends at node `(i, j)`.
    pub(super) fn ends_along(&self, i: usize, j: usize) -> [Fluid; 2] {
        let [first, second] = self.nodes_along(i, j);
        [
            first.map_or(self.ends[0][j], |k| self.fluids[k]),
            second.map_or(self.ends[1][j], |k| self.fluids[k]),
        ]
    }

    /// The flow along x through the face before node `(i, j)` \[m\].
    pub(super) fn flow_along(&self, i: usize, j: usize) -> Flow {
        let face = self.faces[j * (self.film.grid().nx() + 1) + i];
        let [first, second] = self.ends_along(i, j);
        let density = 0.5 * (first.density + second.density);
        let c = face.conductance;
        // Flow of a full film through both pieces.
        let joined = density * first.theta * face.film + c * (first.potential - second.potential);
        // Flow of the first piece alone, with rupture at the joint.
        let ruptured_density = 0.5 * (first.density + self.cavitated_density);
        let alone =
            ruptured_density * first.theta * face.first_film + face.first_conductance * first.potential;
        if alone < joined {
            Flow {
                value: alone,
                by_first: face.first_film
                    * (ruptured_density * first.theta_s + 0.5 * first.density_s * first.theta)
                    + face.first_conductance * first.potential_s,
                by_second: 0.0,
                ruptured: true,
                terms: face.first_conductance * first.potential,
            }
        } else {
            Flow {
                value: joined,
                by_first: face.film * (density * first.theta_s + 0.5 * first.density_s * first.theta)
                    + c * first.potential_s,
                by_second: 0.5 * face.film * first.theta * second.density_s - c * second.potential_s,
                ruptured: false,
                terms: c * (first.potential + second.potential),
            }
        }
    }

    /// The flow along y through the face before node `(i, j)`, times `dx / dy` \[m\].
    pub(super) fn flow_across(&self, i: usize, j: usize) -> Flow {
        let grid = self.film.grid();
        let (nx, ny, is_strip) = (grid.nx(), grid.ny(), grid.is_strip());
        let c = self.across[j * nx + i];
        let at = |j: usize| self.fluids[j * nx + i];
        let first = match j.checked_sub(1) {
            Some(south) => at(south),
            None if is_strip => at(ny - 1),
            None => self.sides[0],
        };
        let second = match j {
            _ if j < ny => at(j),
            _ if is_strip => at(0),
            _ => self.sides[1],
        };
        Flow {
            value: c * (first.potential - second.potential),
            by_first: c * first.potential_s,
            by_second: -c * second.potential_s,
            ruptured: false,
            terms: c * (first.potential + second.potential),
        }
    }

    /// Flows out through the edges west, east, south and north \[m\]; a strip has no edges south and north.
    pub(super) fn edge_flows(&self) -> [f64; 4] {
        let (nx, ny) = (self.film.grid().nx(), self.film.grid().ny());
        let along = |i: usize| (0..ny).map(|j| self.flow_along(i, j).value).sum::<f64>();
        let across = |j: usize| (0..nx).map(|i| self.flow_across(i, j).value).sum::<f64>();
        let sides = if self.film.grid().is_strip() { [0.0; 2] } else { [-across(0), across(ny)] };
        [-along(0), along(nx), sides[0], sides[1]]
    }

    /// Net outflow of cell `(i, j)` \[m\].
    pub(super) fn source(&self, i: usize, j: usize) -> f64 {
        self.flow_along(i + 1, j).value - self.flow_along(i, j).value + self.flow_across(i, j + 1).value
            - self.flow_across(i, j).value
    }

    /// Net outflow of each cell \[m\], and its derivatives by the unknowns of the cell and its neighbors to
    /// the east, west, north and south. Returns the flow through the edges of the box.
    pub(super) fn linearise(&self, outflow: &mut [f64], stencil: &mut [f64]) -> BoundaryFlux {
        let grid = self.film.grid();
        let (nx, ny) = (grid.nx(), grid.ny());
        outflow.fill(0.0);
        stencil.fill(0.0);
        let (mut boundary_flux, mut terms) = ([0.0; 2], 0.0);
        // Adds the flow of a face to the balances of both nodes, or to that of the box.
        let mut add = |flow: Flow, first: Option<usize>, second: Option<usize>, forward: usize| {
            terms += flow.terms;
            if let Some(k) = first {
                outflow[k] += flow.value;
                stencil[STENCIL * k] += flow.by_first;
            } else {
                boundary_flux[usize::from(flow.value < 0.0)] += flow.value.abs();
            }
            if let Some(k) = second {
                outflow[k] -= flow.value;
                stencil[STENCIL * k] -= flow.by_second;
            } else {
                boundary_flux[usize::from(flow.value > 0.0)] += flow.value.abs();
            }
            if let (Some(first), Some(second)) = (first, second) {
                stencil[STENCIL * first + forward] += flow.by_second;
                stencil[STENCIL * second + forward + 1] -= flow.by_first;
            }
        };
        // Faces along x; the one at both ends of a period counts once.
        let (first_face, mut circulating) = (usize::from(self.is_periodic), 0.0);
        for j in 0..ny {
            for i in first_face..=nx {
                let ([first, second], flow) = (self.nodes_along(i, j), self.flow_along(i, j));
                add(flow, first, second, 1);
                if self.is_periodic && i == nx {
                    circulating += flow.value;
                }
            }
        }
        // Faces along y; that of a strip from its last row to its first one is the northern one.
        for j in usize::from(grid.is_strip())..=ny {
            for i in 0..nx {
                let first = j.checked_sub(1).map(|j| j * nx + i);
                let second = if j < ny { Some(j * nx + i) } else { grid.is_strip().then_some(i) };
                add(self.flow_across(i, j), first, second, 3);
            }
        }
        // Film fractions of a period that is cavitated all around are determined up to a constant: a shift makes the step along
        // that constant large, in the direction of the net flow into the period.
        if self.is_periodic {
            for (row, fluid) in stencil.chunks_exact_mut(STENCIL).zip(&self.fluids) {
                row[0] *= 1.0 + PERIOD_SHIFT * fluid.theta_s;
            }
        }
        // A fed node keeps its pressure; its net outflow comes from the feed.
        for (k, _) in self.fed.iter().enumerate().filter(|(_, fed)| fed.is_some()) {
            boundary_flux[usize::from(outflow[k] < 0.0)] += outflow[k].abs();
            outflow[k] = 0.0;
            stencil[STENCIL * k..STENCIL * (k + 1)].fill(0.0);
            stencil[STENCIL * k] = 1.0;
        }
        // The flow out of one end of a period enters at the other.
        let [inflow, outflow] = boundary_flux.map(|flux| flux + circulating.abs());
        BoundaryFlux { inflow, outflow, rounding: ROUNDING * terms }
    }
}
