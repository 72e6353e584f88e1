//! Hybrid line relaxation along x.
//!
//! Where pressure flow dominates, lines are relaxed in Gauss-Seidel order with immediate updates. Where
//! entrainment dominates, a single-node change affects films far away. There each change is distributed as a
//! dipole (subtracted from the four neighbors), whose influence is short-ranged, and all lines use the
//! pressures before the sweep (Jacobi). Rows contain the entrained mass of both film and compression.
//!
//! Films far from the contact respond little to the low pressures there. Additional sweeps over those nodes
//! without a new film cost no convolution.
//!
//! The ratio `c/K0` of the conductance `c` of a face (flow over pressure difference) to the self-influence
//! `K0` of a node decides between the two: a unit change of pressure changes the flow through the faces by
//! `c` and the entrained flow by the film change `K0`. Each row has a band of six entries, because
//! entrainment uses the films of up to two upstream nodes.

use super::level::Level;
use crate::elastic::NEAR;
use crate::grid::Grid;

/// Ratio `c/K0` below which entrainment dominates a node.
const DIPOLE_RATIO: f64 = 0.3;
/// Range of the ratio over which the relaxation factor grows from [`RelaxationFactors::near`] to one.
const FACTOR_RANGE: (f64, f64) = (2.0, 50.0);
/// Range of the evenness (smallest over largest conductance of a node) over which that growth takes effect.
/// In uneven cells the viscosity changes by large factors from node to node.
const EVENNESS: (f64, f64) = (0.3, 0.7);
/// Ratio above which the film response is negligible and nodes get additional sweeps.
const FAR_RATIO: f64 = 5.0;
/// Additional sweeps over the nodes far from the contact.
const FAR_PASSES: usize = 3;
/// Entries of a row: three upstream, the diagonal, two downstream.
const BAND: usize = 6;
/// Index of the diagonal.
const DIAGONAL: usize = 3;

/// Buffers of one line.
#[derive(Debug, Clone)]
pub(super) struct LineRelaxation {
    /// Rows of the band matrix.
    rows: Vec<[f64; BAND]>,
    /// Right-hand sides, overwritten by changes of pressure \[Pa\].
    change: Vec<f64>,
    /// Relaxation factor of each node; negative for a dipole.
    factor: Vec<f64>,
    /// Relaxation factor of nodes far from the contact, zero elsewhere.
    far_factor: Vec<f64>,
}

/// Row of a node with fixed pressure.
const FIXED_ROW: [f64; BAND] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0];

/// Whether a node and its neighbors are cavitated and the node remains so.
fn stays_cavitated(level: &Level, k: usize, nx: usize) -> bool {
    let p = &level.pressure;
    level.drive[k] <= 0.0 && p[k] + p[k + 1] + p[k - 1] + p[k + nx] + p[k - nx] <= 0.0
}

/// Conductances of the faces of a node.
#[derive(Debug, Clone, Copy)]
struct Conductances {
    /// Downstream face.
    east: f64,
    /// Upstream face.
    west: f64,
    /// Face to the next line.
    north: f64,
    /// Face to the previous line.
    south: f64,
}

impl Conductances {
    /// Conductances of node `k`.
    fn of(level: &Level, k: usize) -> Self {
        let nx = level.grid.nx();
        Self {
            east: level.east[k],
            west: level.east[k - 1],
            north: level.north[k],
            south: level.north[k - nx],
        }
    }

    /// Sum of the four: the diagonal of the pressure flow.
    fn sum(self) -> f64 {
        self.east + self.west + self.north + self.south
    }

    /// Ratio of the smallest to the largest conductance.
    fn evenness(self) -> f64 {
        self.east.min(self.west).min(self.north).min(self.south) / self.largest()
    }

    /// Largest of the four.
    fn largest(self) -> f64 {
        self.east.max(self.west).max(self.north).max(self.south)
    }

    /// Pressure flow out of node `k` for the pressures `p`.
    fn outflow(self, p: &[f64], k: usize, nx: usize) -> f64 {
        self.east * (p[k] - p[k + 1])
            + self.west * (p[k] - p[k - 1])
            + self.north * (p[k] - p[k + nx])
            + self.south * (p[k] - p[k - nx])
    }
}

/// Relaxation factors.
#[derive(Debug, Clone, Copy)]
pub(super) struct RelaxationFactors {
    /// Factor where entrainment dominates.
    pub(super) dipole: f64,
    /// Factor where pressure flow dominates weakly.
    pub(super) near: f64,
    /// Whether rows next to cavitated nodes include the couplings to their other neighbors.
    pub(super) keeps_couplings: bool,
}

/// Relaxation factor of a node where pressure flow dominates, for its ratio and evenness.
fn flow_factor(ratio: f64, evenness: f64, near: f64) -> f64 {
    let weight = ((evenness - EVENNESS.0) / (EVENNESS.1 - EVENNESS.0)).clamp(0.0, 1.0);
    let (low, high) = FACTOR_RANGE;
    if ratio <= low {
        return near;
    }
    let position = weight * ((ratio - low) / (high - low)).min(1.0);
    near + position * (1.0 - near)
}

impl LineRelaxation {
    /// Buffers for grids of at most the size of `grid`.
    pub(super) fn new(grid: &Grid) -> Self {
        let nx = grid.nx();
        Self {
            rows: vec![[0.0; BAND]; nx],
            change: vec![0.0; nx],
            factor: vec![0.0; nx],
            far_factor: vec![0.0; grid.len()],
        }
    }

    /// One sweep over all lines of an evaluated level, and additional sweeps over the nodes far from the
    /// contact. `largest` \[Pa\] bounds the change of a node per sweep.
    pub(super) fn sweep(&mut self, level: &mut Level, largest: f64, factors: RelaxationFactors) {
        level.before.copy_from_slice(&level.pressure);
        level.compute_drive();
        let ny = level.grid.ny();
        // assemble, solve and apply line by line
        for j in 1..ny - 1 {
            self.assemble(level, j, factors);
            self.solve(level.grid.nx() - 2);
            self.update(level, j, largest);
        }
        // far nodes, in alternating direction
        for pass in 0..FAR_PASSES {
            for line in 1..ny - 1 {
                let j = if pass % 2 == 0 { ny - 1 - line } else { line };
                self.relax_far(level, j, largest);
            }
        }
        level.is_evaluated = false;
    }

    /// Assembles the rows of the interior nodes of line `j`; node `i` has row `i - 1`.
    fn assemble(&mut self, level: &Level, j: usize, factors: RelaxationFactors) {
        let nx = level.grid.nx();
        let self_influence = level.influence.single[0];
        for i in 1..nx - 1 {
            let (k, r) = (j * nx + i, i - 1);
            // nodes that remain cavitated keep their pressure
            if stays_cavitated(level, k, nx) {
                (self.rows[r], self.change[r], self.factor[r]) = (FIXED_ROW, 0.0, 1.0);
                self.far_factor[k] = 1.0;
                continue;
            }
            // Gauss-Seidel or Jacobi dipole, by the ratio of conductance to self-influence
            let conductances = Conductances::of(level, k);
            let ratio = conductances.largest() / self_influence;
            let is_flow = ratio > DIPOLE_RATIO;
            self.far_factor[k] = 0.0;
            let (p, influence) = if is_flow {
                self.factor[r] = flow_factor(ratio, conductances.evenness(), factors.near);
                if ratio > FAR_RATIO {
                    self.far_factor[k] = self.factor[r];
                }
                (&level.pressure, &level.influence.single)
            } else {
                self.factor[r] = -factors.dipole;
                (&level.before, &level.influence.dipole)
            };
            self.change[r] = level.drive[k] - conductances.outflow(p, k, nx);
            let [_, next, second] = level.fluid.upwind(k);
            let upwind = [level.fluid.own_mass(k), next, second];
            // Derivatives of the entrained mass with respect to the node's pressure (compression) and film.
            let carried: [[f64; 2]; 3] = std::array::from_fn(|m| {
                level.fluid.mass_derivatives(k - m).map(|derivative| upwind[m] * derivative)
            });
            let transport = |slot: usize| transport(&carried, influence, is_flow, slot);
            let (sum, east, west) = (conductances.sum(), conductances.east, conductances.west);
            let has_fluid = |i: usize| i == 0 || i + 1 >= nx || level.pressure[j * nx + i] > 0.0;
            // Cavitated neighbors may not accept the change that a coupling assumes.
            let has_fluid_at = |slot: usize| has_fluid((i + slot).saturating_sub(DIAGONAL));
            let is_inside = [1, 2, 4, 5].into_iter().all(has_fluid_at);
            let mut row = [0.0; BAND];
            row[DIAGONAL] = transport(DIAGONAL) + if is_flow { sum } else { 1.25 * sum };
            if is_flow && has_fluid(i) && (is_inside || factors.keeps_couplings) {
                for slot in [0, 1, 2, 4, 5].into_iter().filter(|slot| has_fluid_at(*slot)) {
                    row[slot] = transport(slot);
                }
                row[DIAGONAL - 1] -= if has_fluid(i - 1) { west } else { 0.0 };
                row[DIAGONAL + 1] -= if has_fluid(i + 1) { east } else { 0.0 };
            } else if !is_flow && is_inside {
                for slot in [0, 1, 2, 4, 5] {
                    row[slot] = transport(slot);
                }
                row[DIAGONAL - 2] += 0.25 * west;
                row[DIAGONAL - 1] -= west + 0.25 * sum;
                row[DIAGONAL + 1] -= east + 0.25 * sum;
                row[DIAGONAL + 2] += 0.25 * east;
            }
            self.rows[r] = row;
        }
    }

    /// Relaxes the pressure flow of line `j` at the nodes far from the contact, with the others fixed.
    fn relax_far(&mut self, level: &mut Level, j: usize, largest: f64) {
        let nx = level.grid.nx();
        // The change of node i is `change[i]` plus `above[i]` times that of node i + 1.
        let (change, above) = (&mut self.change, &mut self.factor);
        let (mut last_change, mut last_above) = (0.0, 0.0);
        for i in 1..nx - 1 {
            let k = j * nx + i;
            // A node that is not relaxed here starts a new system.
            if self.far_factor[k] == 0.0 || stays_cavitated(level, k, nx) {
                (last_change, last_above) = (0.0, 0.0);
            } else {
                let p = &level.pressure;
                let conductances = Conductances::of(level, k);
                let has_fluid = |i: usize| i == 0 || i == nx - 1 || p[j * nx + i] > 0.0;
                // Next to cavitation the balance has no couplings along the line.
                let (west, east) = if has_fluid(i - 1) && has_fluid(i + 1) {
                    (conductances.west, conductances.east)
                } else {
                    (0.0, 0.0)
                };
                // Forward elimination.
                let residual = level.drive[k] - conductances.outflow(p, k, nx);
                let pivot = 1.0 / (conductances.sum() - west * last_above);
                last_change = (residual + west * last_change) * pivot;
                last_above = east * pivot;
            }
            (change[i], above[i]) = (last_change, last_above);
        }
        // Back substitution, and the damped and bounded change of the pressures.
        let mut next = 0.0;
        for i in (1..nx - 1).rev() {
            let k = j * nx + i;
            next = change[i] + above[i] * next;
            if next.is_finite() {
                let taken = self.far_factor[k] * next.clamp(-largest, largest);
                level.pressure[k] = (level.pressure[k] + taken).max(0.0);
            } else {
                next = 0.0;
            }
        }
    }

    /// Band elimination without pivoting; the solution replaces `change`.
    fn solve(&mut self, n: usize) {
        let (rows, change) = (&mut self.rows[..n], &mut self.change[..n]);
        for r in 0..n {
            let pivot = rows[r];
            let inverse = 1.0 / pivot[DIAGONAL];
            // Eliminate the column below the pivot; the two entries above the diagonal change.
            for below in 1..=DIAGONAL.min(n - 1 - r) {
                let slot = DIAGONAL - below;
                let factor = rows[r + below][slot] * inverse;
                if factor != 0.0 {
                    rows[r + below][slot + 1] -= factor * pivot[DIAGONAL + 1];
                    rows[r + below][slot + 2] -= factor * pivot[DIAGONAL + 2];
                    change[r + below] -= factor * change[r];
                }
            }
        }
        // Back substitution.
        let (mut next, mut second) = (0.0, 0.0);
        for r in (0..n).rev() {
            let value = (change[r] - rows[r][DIAGONAL + 1] * next - rows[r][DIAGONAL + 2] * second)
                / rows[r][DIAGONAL];
            (next, second) = (value, next);
            change[r] = value;
        }
    }

    /// Applies the changes of line `j`; changes that are not finite (a zero pivot) are skipped.
    fn update(&self, level: &mut Level, j: usize, largest: f64) {
        let (nx, ny) = (level.grid.nx(), level.grid.ny());
        let p = &mut level.pressure;
        for i in 1..nx - 1 {
            let k = j * nx + i;
            let (change, factor) = (self.change[i - 1], self.factor[i - 1]);
            if !change.is_finite() {
                continue;
            }
            let old = p[k];
            p[k] = (old + factor.abs() * change.clamp(-largest, largest)).max(0.0);
            // a dipole subtracts a quarter of the change from each neighbor
            if factor > 0.0 || p[k] == 0.0 {
                continue;
            }
            let neighbors = [k - 1, k + 1, k - nx, k + nx];
            if neighbors.iter().all(|&o| p[o] > 0.0) {
                let back = 0.25 * (p[k] - old);
                for o in neighbors {
                    let (column, line) = (o % nx, o / nx);
                    if column > 0 && column < nx - 1 && line > 0 && line < ny - 1 {
                        p[o] = (p[o] - back).max(0.0);
                    }
                }
            }
        }
    }
}

/// Derivative of the mass that enters and leaves a cell with respect to the change at the `slot` of its row, by the derivatives
/// `carried` of the masses at the cell and at the two upstream.
fn transport(carried: &[[f64; 2]; 3], influence: &[f64; NEAR], is_flow: bool, slot: usize) -> f64 {
    let along = |m: usize| {
        let distance = (slot + m).abs_diff(DIAGONAL);
        let share = match distance {
            0 => 1.0,
            1 if !is_flow => -0.25,
            _ => 0.0,
        };
        carried[m][1] * influence[distance] + carried[m][0] * share
    };
    along(0) + along(1) + along(2)
}
