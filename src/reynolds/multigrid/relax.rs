//! Hybrid line relaxation along x.
//!
//! Where pressure flow dominates, a line takes its changes at once and the next lines see them (Gauss-Seidel). Where
//! entrainment dominates, a change moves films far away, so each node takes its change back from its four neighbours
//! (a dipole), whose reach is short, and all lines start from the pressures before the sweep (Jacobi).

use super::level::Level;

/// Largest conductance of a node over its self-influence below which entrainment dominates.
const SWITCH: f64 = 0.42;
/// Share of a change taken where pressure flow dominates.
const FLOW_SHARE: f64 = 0.4;
/// Share of a change taken where entrainment dominates.
const DIPOLE_SHARE: f64 = 0.2;
/// Entries of a row: three upstream, the own one, two downstream.
const BAND: usize = 6;
/// Place of the diagonal.
const OWN: usize = 3;

/// Buffers of one line.
#[derive(Debug, Clone)]
pub(super) struct LineRelaxation {
    rows: Vec<[f64; BAND]>,
    change: Vec<f64>,
    is_flow: Vec<bool>,
}

impl LineRelaxation {
    /// For lines of at most `nx` nodes.
    pub(super) fn new(nx: usize) -> Self {
        Self { rows: vec![[0.0; BAND]; nx], change: vec![0.0; nx], is_flow: vec![false; nx] }
    }

    /// One pass over all lines of an evaluated level; no node changes by more than `largest` \[Pa\].
    pub(super) fn sweep(&mut self, level: &mut Level, largest: f64) {
        level.before.copy_from_slice(&level.pressure);
        for j in 1..level.grid.ny() - 1 {
            self.assemble(level, j);
            self.solve(level.grid.nx() - 2);
            self.update(level, j, largest);
        }
        level.is_evaluated = false;
    }

    /// Rows of the interior nodes of line `j`; node `i` has row `i - 1`.
    fn assemble(&mut self, level: &Level, j: usize) {
        let nx = level.grid.nx();
        let self_influence = level.influence.single[0];
        for i in 1..nx - 1 {
            let (k, r) = (j * nx + i, i - 1);
            let (east, west) = (level.east[k], level.east[k - 1]);
            let (north, south) = (level.north[k], level.north[k - nx]);
            let is_flow = east.max(west).max(north).max(south) > SWITCH * self_influence;
            let p = if is_flow { &level.pressure } else { &level.before };
            let flux = east * (p[k] - p[k + 1])
                + west * (p[k] - p[k - 1])
                + north * (p[k] - p[k + nx])
                + south * (p[k] - p[k - nx]);
            let transport = level.fluid.transport(k, &level.film, level.previous.as_deref());
            self.change[r] = level.source[k] - transport - flux;
            self.is_flow[r] = is_flow;
            let influence = if is_flow { &level.influence.single } else { &level.influence.dipole };
            let upwind = level.fluid.upwind(k);
            let masses = [
                level.fluid.own_mass(k) * level.fluid.density(k),
                upwind[1] * level.fluid.density(k - 1),
                if i >= 2 { upwind[2] * level.fluid.density(k - 2) } else { 0.0 },
            ];
            let transport_row = |offset: isize| -> f64 {
                let at = |t: isize| influence[(offset + t).unsigned_abs()];
                masses[0] * at(0) + masses[1] * at(1) + masses[2] * at(2)
            };
            let sum = east + west + north + south;
            let mut row = [0.0; BAND];
            row[OWN] = transport_row(0) + if is_flow { sum } else { 1.25 * sum };
            let wet = |o: usize| o % nx == 0 || o % nx == nx - 1 || level.pressure[o] > 0.0;
            let inside = wet(k - 1) && wet(k + 1) && (i < 2 || wet(k - 2)) && (i + 2 >= nx || wet(k + 2));
            if inside {
                for (slot, entry) in row.iter_mut().enumerate() {
                    if slot != OWN {
                        *entry = transport_row(slot as isize - OWN as isize);
                    }
                }
                if is_flow {
                    row[OWN - 1] -= west;
                    row[OWN + 1] -= east;
                } else {
                    row[OWN - 1] -= west + 0.25 * sum;
                    row[OWN + 1] -= east + 0.25 * sum;
                    row[OWN - 2] += 0.25 * west;
                    row[OWN + 2] += 0.25 * east;
                }
            }
            self.rows[r] = row;
        }
    }

    /// Gauss elimination without pivots; the changes end up in `change`.
    fn solve(&mut self, n: usize) {
        let (rows, change) = (&mut self.rows[..n], &mut self.change[..n]);
        for r in 0..n {
            let pivot = rows[r];
            for below in 1..=OWN.min(n - 1 - r) {
                let slot = OWN - below;
                let factor = rows[r + below][slot] / pivot[OWN];
                if factor != 0.0 {
                    rows[r + below][slot + 1] -= factor * pivot[OWN + 1];
                    rows[r + below][slot + 2] -= factor * pivot[OWN + 2];
                    change[r + below] -= factor * change[r];
                }
            }
        }
        for r in (0..n).rev() {
            let next = if r + 1 < n { rows[r][OWN + 1] * change[r + 1] } else { 0.0 };
            let second = if r + 2 < n { rows[r][OWN + 2] * change[r + 2] } else { 0.0 };
            change[r] = (change[r] - next - second) / rows[r][OWN];
        }
    }

    fn update(&self, level: &mut Level, j: usize, largest: f64) {
        let nx = level.grid.nx();
        let ny = level.grid.ny();
        for i in 1..nx - 1 {
            let k = j * nx + i;
            let wanted = self.change[i - 1];
            if !wanted.is_finite() {
                continue;
            }
            let wanted = wanted.clamp(-largest, largest);
            let p = &mut level.pressure;
            if self.is_flow[i - 1] {
                p[k] = (p[k] + FLOW_SHARE * wanted).max(0.0);
                continue;
            }
            let old = p[k];
            p[k] = (old + DIPOLE_SHARE * wanted).max(0.0);
            let back = 0.25 * (p[k] - old);
            let around = [k - 1, k + 1, k - nx, k + nx];
            if p[k] > 0.0 && around.iter().all(|&o| p[o] > 0.0) {
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
