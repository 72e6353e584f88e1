//! Hybrid line relaxation along x.
//!
//! Where pressure flow dominates, a line takes its changes at once and the next lines see them
//! (Gauss-Seidel). Where entrainment dominates, a change moves films far away, so each node takes its change
//! back from its four neighbours (a dipole), whose reach is short, and all lines start from the pressures
//! before the sweep (Jacobi). Rows hold what a node carries for its film and for its compression.
//!
//! Far from the contact, films hardly follow the low pressures there: further passes over those nodes,
//! without a new film, cost no convolution.
//!
//! With the conductance `c` of a face (flow over pressure difference) and the self-influence `K0` of a node,
//! `c/K0` says which of the two dominates: a unit change of pressure changes the flow through the faces by
//! `c` and what entrainment carries by the film, `K0`. The band of six entries of a row follows from
//! entrainment that takes its film from up to two nodes upstream.

use super::level::Level;
use crate::grid::Grid;

/// Conductance over self-influence below which entrainment dominates a node.
const SWITCH: f64 = 0.3;
/// Above it, the share of a change that is taken is [`Shares::near`] where the ratio is at most the first
/// number, and grows to one at the second.
const FLOW_RATIOS: (f64, f64) = (2.0, 50.0);
/// Smallest over largest conductance of a node below which that share is taken at any ratio: there the
/// viscosity changes by much from node to node. A share of one needs at least the second number.
const EVENNESS: (f64, f64) = (0.3, 0.7);
/// Ratio above which films hardly follow, and passes over such nodes.
const FAR_RATIO: f64 = 5.0;
/// Passes over the nodes far from the contact in each sweep.
const FAR_PASSES: usize = 3;
/// Entries of a row: three upstream, the own one, two downstream.
const BAND: usize = 6;
/// Place of the diagonal.
const OWN: usize = 3;

/// Buffers of one line.
#[derive(Debug, Clone)]
pub(super) struct LineRelaxation {
    /// Rows of the band matrix.
    rows: Vec<[f64; BAND]>,
    /// Right-hand sides, then changes of pressure \[Pa\].
    change: Vec<f64>,
    /// Share of the change that a node takes; negative where it is a dipole.
    share: Vec<f64>,
    /// Of all nodes far from the contact, zero elsewhere.
    far_share: Vec<f64>,
}

/// Row of a node that keeps its pressure.
const IDLE: [f64; BAND] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];

/// Whether a node is cavitated among cavitated ones and stays so.
fn is_idle(level: &Level, k: usize, nx: usize) -> bool {
    let p = &level.pressure;
    level.drive[k] <= 0.0 && p[k] + p[k + 1] + p[k - 1] + p[k + nx] + p[k - nx] <= 0.0
}

/// Conductances of the faces of a node.
#[derive(Debug, Clone, Copy)]
struct Faces {
    /// To the next node downstream.
    east: f64,
    /// To the next node upstream.
    west: f64,
    /// To the next line.
    north: f64,
    /// To the line before.
    south: f64,
}

impl Faces {
    /// Those of node `k`.
    fn of(level: &Level, k: usize) -> Self {
        let nx = level.grid.nx();
        Self {
            east: level.east[k],
            west: level.east[k - 1],
            north: level.north[k],
            south: level.north[k - nx],
        }
    }

    /// Sum of the four: diagonal of the pressure flow.
    fn sum(self) -> f64 {
        self.east + self.west + self.north + self.south
    }

    /// Smallest over largest.
    fn evenness(self) -> f64 {
        self.east.min(self.west).min(self.north).min(self.south) / self.largest()
    }

    /// Largest of the four.
    fn largest(self) -> f64 {
        self.east.max(self.west).max(self.north).max(self.south)
    }

    /// Pressure flow out of node `k` under the pressures `p`.
    fn outflow(self, p: &[f64], k: usize, nx: usize) -> f64 {
        self.east * (p[k] - p[k + 1])
            + self.west * (p[k] - p[k - 1])
            + self.north * (p[k] - p[k + nx])
            + self.south * (p[k] - p[k - nx])
    }
}

/// Shares of a change that nodes take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shares {
    /// Where entrainment dominates.
    pub(super) dipole: f64,
    /// Where pressure flow does, but not by far.
    pub(super) near: f64,
    /// Whether a node next to dry ones still counts on the changes of its wet neighbours.
    pub(super) keeps_neighbours: bool,
}

/// Share of a change taken at a node whose pressure flow dominates by `ratio`, with conductances of this
/// evenness.
fn flow_share(ratio: f64, evenness: f64, near: f64) -> f64 {
    let weight = ((evenness - EVENNESS.0) / (EVENNESS.1 - EVENNESS.0)).clamp(0.0, 1.0);
    let (low, high) = FLOW_RATIOS;
    if ratio <= low {
        return near;
    }
    let position = weight * ((ratio - low) / (high - low)).min(1.0);
    near + position * (1.0 - near)
}

impl LineRelaxation {
    /// For grids of at most the size of `grid`.
    pub(super) fn new(grid: &Grid) -> Self {
        let nx = grid.nx();
        Self {
            rows: vec![[0.0; BAND]; nx],
            change: vec![0.0; nx],
            share: vec![0.0; nx],
            far_share: vec![0.0; grid.len()],
        }
    }

    /// One pass over all lines of an evaluated level, and more over the nodes far from the contact. No node
    /// changes by more than `largest` \[Pa\] in a pass.
    pub(super) fn sweep(&mut self, level: &mut Level, largest: f64, shares: Shares) {
        level.before.copy_from_slice(&level.pressure);
        level.find_drive();
        let ny = level.grid.ny();
        for j in 1..ny - 1 {
            self.assemble(level, j, shares);
            self.solve(level.grid.nx() - 2);
            self.update(level, j, largest);
        }
        for pass in 0..FAR_PASSES {
            for line in 1..ny - 1 {
                let j = if pass % 2 == 0 { ny - 1 - line } else { line };
                self.relax_far(level, j, largest);
            }
        }
        level.is_evaluated = false;
    }

    /// Rows of the interior nodes of line `j`; node `i` has row `i - 1`.
    fn assemble(&mut self, level: &Level, j: usize, shares: Shares) {
        let nx = level.grid.nx();
        let self_influence = level.influence.single[0];
        for i in 1..nx - 1 {
            let (k, r) = (j * nx + i, i - 1);
            if is_idle(level, k, nx) {
                (self.rows[r], self.change[r], self.share[r]) = (IDLE, 0.0, 1.0);
                self.far_share[k] = 1.0;
                continue;
            }
            let faces = Faces::of(level, k);
            let ratio = faces.largest() / self_influence;
            let is_flow = ratio > SWITCH;
            self.far_share[k] = 0.0;
            let (p, influence) = if is_flow {
                self.share[r] = flow_share(ratio, faces.evenness(), shares.near);
                if ratio > FAR_RATIO {
                    self.far_share[k] = self.share[r];
                }
                (&level.pressure, &level.influence.single)
            } else {
                self.share[r] = -shares.dipole;
                (&level.before, &level.influence.dipole)
            };
            self.change[r] = level.drive[k] - faces.outflow(p, k, nx);
            let [_, next, second] = level.fluid.upwind(k);
            let upwind = [level.fluid.own_mass(k), next, second];
            // More mass for an own pressure, by compression, and for a film.
            let carried: [[f64; 2]; 3] = std::array::from_fn(|m| {
                level.fluid.mass_derivatives(k - m).map(|derivative| upwind[m] * derivative)
            });
            let transport = |slot: usize| -> f64 {
                let along = |m: usize| {
                    let distance = (slot + m).abs_diff(OWN);
                    let share = match distance {
                        0 => 1.0,
                        1 if !is_flow => -0.25,
                        _ => 0.0,
                    };
                    carried[m][1] * influence[distance] + carried[m][0] * share
                };
                along(0) + along(1) + along(2)
            };
            let (sum, east, west) = (faces.sum(), faces.east, faces.west);
            let is_wet = |i: usize| i == 0 || i + 1 >= nx || level.pressure[j * nx + i] > 0.0;
            // Dry nodes may not take the change that the row counts on.
            let is_wet_at = |slot: usize| is_wet((i + slot).saturating_sub(OWN));
            let is_inside = [1, 2, 4, 5].into_iter().all(is_wet_at);
            let mut row = [0.0; BAND];
            row[OWN] = transport(OWN) + if is_flow { sum } else { 1.25 * sum };
            if is_flow && is_wet(i) && (is_inside || shares.keeps_neighbours) {
                for slot in [0, 1, 2, 4, 5].into_iter().filter(|slot| is_wet_at(*slot)) {
                    row[slot] = transport(slot);
                }
                row[OWN - 1] -= if is_wet(i - 1) { west } else { 0.0 };
                row[OWN + 1] -= if is_wet(i + 1) { east } else { 0.0 };
            } else if !is_flow && is_inside {
                for slot in [0, 1, 2, 4, 5] {
                    row[slot] = transport(slot);
                }
                row[OWN - 2] += 0.25 * west;
                row[OWN - 1] -= west + 0.25 * sum;
                row[OWN + 1] -= east + 0.25 * sum;
                row[OWN + 2] += 0.25 * east;
            }
            self.rows[r] = row;
        }
    }

    /// Pressure flow of line `j` at the nodes far from the contact, the others held.
    fn relax_far(&mut self, level: &mut Level, j: usize, largest: f64) {
        let nx = level.grid.nx();
        // Of node i: the change is `change[i]` less `share[i]` of that of the next node.
        let (change, above) = (&mut self.change, &mut self.share);
        let (mut last_change, mut last_above) = (0.0, 0.0);
        for i in 1..nx - 1 {
            let k = j * nx + i;
            if self.far_share[k] == 0.0 || is_idle(level, k, nx) {
                (last_change, last_above) = (0.0, 0.0);
            } else {
                let p = &level.pressure;
                let faces = Faces::of(level, k);
                let wet = |i: usize| i == 0 || i == nx - 1 || p[j * nx + i] > 0.0;
                let (west, east) =
                    if wet(i - 1) && wet(i + 1) { (faces.west, faces.east) } else { (0.0, 0.0) };
                let residual = level.drive[k] - faces.outflow(p, k, nx);
                let pivot = 1.0 / (faces.sum() - west * last_above);
                last_change = (residual + west * last_change) * pivot;
                last_above = east * pivot;
            }
            (change[i], above[i]) = (last_change, last_above);
        }
        let mut next = 0.0;
        for i in (1..nx - 1).rev() {
            let k = j * nx + i;
            next = change[i] + above[i] * next;
            if next.is_finite() {
                let taken = self.far_share[k] * next.clamp(-largest, largest);
                level.pressure[k] = (level.pressure[k] + taken).max(0.0);
            } else {
                next = 0.0;
            }
        }
    }

    /// Gauss elimination without pivots; the changes end up in `change`.
    fn solve(&mut self, n: usize) {
        let (rows, change) = (&mut self.rows[..n], &mut self.change[..n]);
        for r in 0..n {
            let pivot = rows[r];
            let inverse = 1.0 / pivot[OWN];
            for below in 1..=OWN.min(n - 1 - r) {
                let slot = OWN - below;
                let factor = rows[r + below][slot] * inverse;
                if factor != 0.0 {
                    rows[r + below][slot + 1] -= factor * pivot[OWN + 1];
                    rows[r + below][slot + 2] -= factor * pivot[OWN + 2];
                    change[r + below] -= factor * change[r];
                }
            }
        }
        let (mut next, mut second) = (0.0, 0.0);
        for r in (0..n).rev() {
            let value = (change[r] - rows[r][OWN + 1] * next - rows[r][OWN + 2] * second) / rows[r][OWN];
            (next, second) = (value, next);
            change[r] = value;
        }
    }

    /// Takes the changes of line `j`; one that is not a number, of a row without a pivot, is left out.
    fn update(&self, level: &mut Level, j: usize, largest: f64) {
        let (nx, ny) = (level.grid.nx(), level.grid.ny());
        let p = &mut level.pressure;
        for i in 1..nx - 1 {
            let k = j * nx + i;
            let (wanted, share) = (self.change[i - 1], self.share[i - 1]);
            if !wanted.is_finite() {
                continue;
            }
            let old = p[k];
            p[k] = (old + share.abs() * wanted.clamp(-largest, largest)).max(0.0);
            if share > 0.0 || p[k] == 0.0 {
                continue;
            }
            let around = [k - 1, k + 1, k - nx, k + nx];
            if around.iter().all(|&o| p[o] > 0.0) {
                let back = 0.25 * (p[k] - old);
                for o in around {
                    let (column, line) = (o % nx, o / nx);
                    if column > 0 && column < nx - 1 && line > 0 && line < ny - 1 {
                        p[o] = (p[o] - back).max(0.0);
                    }
                }
            }
        }
    }
}
