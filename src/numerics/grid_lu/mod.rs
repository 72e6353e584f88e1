//! LU factorisation of a matrix on the five-point stencil of a grid, factorised again and again: buffers are kept.
//!
//! Multifrontal elimination in the order of nested dissection, without exchange of rows, in single precision: it serves
//! as a preconditioner. Nodes that no entry links to others cost nothing beyond a division.

mod dense;
mod dissection;

use std::fmt;

use dense::{Blocks, dot, subtract_product};
use dissection::{Dissection, Front};
use pulp::Arch;

/// Number of entries in a row of the five-point stencil: centre, east, west, north, south.
pub(crate) const STENCIL: usize = 5;

/// Smallest pivot, the largest entry of a row being one.
const SMALLEST_PIVOT: f32 = 1e-6;

/// LU factorisation of a matrix that couples each node of an `nx` x `ny` grid to its four neighbours.
pub(crate) struct GridLu {
    fronts: Vec<Front>,
    /// Place of each node in the order of elimination.
    place: Vec<usize>,
    /// Node that a slot of the stencil points to, by node and slot; the node itself where that is outside.
    reach: Vec<u32>,
    /// Where in `factors` an entry of the stencil goes, by node and slot.
    target: Vec<u32>,
    /// Start of each front's blocks in `factors`: pivots, lower, upper.
    start: Vec<usize>,
    factors: Vec<f32>,
    /// One over the largest entry of each row.
    scale: Vec<f64>,
    linked: Vec<bool>,
    /// Fronts whose nodes and children are all unlinked.
    idle: Vec<bool>,
    stack: Vec<f32>,
    scratch: Vec<f32>,
    values: Vec<f32>,
    gathered: Vec<f32>,
    factorised: bool,
    arch: Arch,
}

impl fmt::Debug for GridLu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("GridLu").field("rows", &self.place.len()).finish_non_exhaustive()
    }
}

impl GridLu {
    /// Order of elimination and buffers for a grid.
    pub(crate) fn new(nx: usize, ny: usize) -> Self {
        let n = nx * ny;
        let Dissection { fronts, place } = Dissection::new(nx, ny);
        let mut start = Vec::with_capacity(fronts.len());
        let (mut size, mut depth, mut deepest, mut widest, mut largest) = (0, 0, 0, 0, 0);
        for front in &fronts {
            let (s, b) = (front.pivots.len(), front.border.len());
            start.push(size);
            size += s * (s + 2 * b);
            let below: usize = front.children.iter().map(|(child, _)| square(&fronts[*child])).sum();
            deepest = deepest.max(depth + b * b);
            depth = depth + b * b - below;
            widest = widest.max(b).max(s);
            largest = largest.max(s * b.max(s));
        }
        let mut lu = Self {
            linked: vec![false; n],
            idle: vec![false; fronts.len()],
            scale: vec![1.0; n],
            values: vec![0.0; n],
            gathered: vec![0.0; widest],
            stack: vec![0.0; deepest],
            scratch: vec![0.0; largest],
            factors: vec![0.0; size],
            reach: Vec::with_capacity(STENCIL * n),
            target: vec![0; STENCIL * n],
            fronts,
            place,
            start,
            factorised: false,
            arch: Arch::new(),
        };
        lu.place_entries(nx, ny);
        lu
    }

    /// Finds where each entry of the stencil stands in the blocks of the front that eliminates it.
    fn place_entries(&mut self, nx: usize, ny: usize) {
        let n = nx * ny;
        for k in 0..n {
            let (i, j) = (k % nx, k / nx);
            let inside = [true, i + 1 < nx, i > 0, j + 1 < ny, j > 0];
            let nodes = [k, k + 1, k.wrapping_sub(1), k + nx, k.wrapping_sub(nx)];
            let reach = inside.into_iter().zip(nodes).map(|(inside, node)| if inside { node } else { k });
            self.reach.extend(reach.map(|node| node as u32));
        }
        let mut front_of = vec![0_usize; n];
        for (f, front) in self.fronts.iter().enumerate() {
            front_of[front.pivots.clone()].fill(f);
        }
        for k in 0..n {
            for slot in 0..STENCIL {
                let (row, column) = (self.place[k], self.place[self.reach[STENCIL * k + slot] as usize]);
                let f = front_of[row.min(column)];
                let front = &self.fronts[f];
                let (s, b) = (front.pivots.len(), front.border.len());
                let in_border = |place: usize| front.border.partition_point(|&other| other < place);
                let (row_in, column_in) =
                    (row.wrapping_sub(front.pivots.start), column.wrapping_sub(front.pivots.start));
                let offset = match (row_in < s, column_in < s) {
                    (true, true) => column_in * s + row_in,
                    (false, _) => s * s + column_in * b + in_border(row),
                    (_, false) => s * (s + b) + row_in * b + in_border(column),
                };
                self.target[STENCIL * k + slot] = (self.start[f] + offset) as u32;
            }
        }
    }

    /// Factorises the matrix with row `k` at `stencil[5 k..5 k + 5]` in the order centre, east, west, north, south.
    /// Entries that point outside the grid must be zero. Returns whether it succeeded.
    pub(crate) fn factorise(&mut self, stencil: &[f64]) -> bool {
        self.assemble(stencil);
        let arch = self.arch;
        self.factorised = arch.dispatch(|| self.eliminate());
        self.factorised
    }

    fn assemble(&mut self, stencil: &[f64]) {
        self.factors.fill(0.0);
        self.linked.fill(false);
        for (k, row) in stencil.chunks_exact(STENCIL).enumerate() {
            let largest = row.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            self.scale[k] = if largest > 0.0 { 1.0 / largest } else { 1.0 };
            for (slot, value) in row.iter().enumerate() {
                let at = STENCIL * k + slot;
                self.factors[self.target[at] as usize] += (value * self.scale[k]) as f32;
                if slot > 0 && *value != 0.0 {
                    self.linked[self.place[k]] = true;
                    self.linked[self.place[self.reach[at] as usize]] = true;
                }
            }
        }
    }

    #[inline(always)]
    fn eliminate(&mut self) -> bool {
        let Self { fronts, start, factors, linked, idle, stack, scratch, .. } = self;
        let mut top = 0;
        for (f, front) in fronts.iter().enumerate() {
            let (s, b) = (front.pivots.len(), front.border.len());
            let children = || front.children.iter().filter(|(child, _)| !idle[*child]);
            let below: usize = children().map(|(child, _)| square(&fronts[*child])).sum();
            let is_idle = children().next().is_none() && linked[front.pivots.clone()].iter().all(|&l| !l);
            if is_idle {
                idle[f] = true;
                continue;
            }
            let (waiting, free) = stack.split_at_mut(top);
            let remainder = &mut free[..b * b];
            remainder.fill(0.0);
            let (own, rest) = factors[start[f]..].split_at_mut(s * s);
            let (lower, rest) = rest.split_at_mut(b * s);
            let mut blocks = Blocks { own, lower, upper: &mut rest[..b * s], remainder };
            let mut from = top - below;
            for (child, slots) in children() {
                let size = square(&fronts[*child]);
                add(&mut blocks, s, b, &waiting[from..from + size], slots);
                from += size;
            }
            if !blocks.eliminate(s, b, SMALLEST_PIVOT, scratch) {
                return false;
            }
            idle[f] = false;
            stack.copy_within(top..top + b * b, top - below);
            top = top - below + b * b;
        }
        true
    }

    /// Solves in place; without a factorisation the right-hand side is left as it is.
    pub(crate) fn solve(&mut self, rhs: &mut [f64]) {
        if !self.factorised {
            return;
        }
        for ((value, &place), scale) in rhs.iter().zip(&self.place).zip(&self.scale) {
            self.values[place] = (value * scale) as f32;
        }
        let arch = self.arch;
        arch.dispatch(|| self.substitute());
        for (value, &place) in rhs.iter_mut().zip(&self.place) {
            *value = f64::from(self.values[place]);
        }
    }

    #[inline(always)]
    fn substitute(&mut self) {
        let Self { fronts, start, factors, idle, values, gathered, .. } = self;
        for (f, front) in fronts.iter().enumerate().filter(|(f, _)| !idle[*f]) {
            let (s, b) = (front.pivots.len(), front.border.len());
            if b == 0 {
                continue;
            }
            let lower = &factors[start[f] + s * s..][..b * s];
            let sums = &mut gathered[..b];
            sums.fill(0.0);
            subtract_product(sums, lower, &values[front.pivots.clone()]);
            for (&place, sum) in front.border.iter().zip(&*sums) {
                values[place] += sum;
            }
        }
        for (f, front) in fronts.iter().enumerate().rev() {
            let (s, b) = (front.pivots.len(), front.border.len());
            let (own, rest) = factors[start[f]..].split_at(s * s);
            if idle[f] {
                for (k, value) in values[front.pivots.clone()].iter_mut().enumerate() {
                    *value /= own[k * s + k];
                }
                continue;
            }
            if b > 0 {
                let known = &mut gathered[..b];
                for (known, &place) in known.iter_mut().zip(&front.border) {
                    *known = values[place];
                }
                let rows = rest[b * s..2 * b * s].chunks_exact(b);
                for (value, row) in values[front.pivots.clone()].iter_mut().zip(rows) {
                    *value = dot(row, known) - *value;
                }
            } else {
                values[front.pivots.clone()].iter_mut().for_each(|value| *value = -*value);
            }
            let sums = &mut gathered[..s];
            sums.fill(0.0);
            subtract_product(sums, own, &values[front.pivots.clone()]);
            values[front.pivots.clone()].copy_from_slice(sums);
        }
    }
}

/// Size of what a front leaves for its parent.
fn square(front: &Front) -> usize {
    front.border.len() * front.border.len()
}

/// Adds the remainder of a child to the blocks of a front with `s` pivots and a border of `b`.
#[inline(always)]
fn add(blocks: &mut Blocks<'_>, s: usize, b: usize, child: &[f32], slots: &[usize]) {
    // Places in a border ascend, so the slots among the pivots come first.
    let split = slots.partition_point(|&slot| slot < s);
    for (column, &to) in child.chunks_exact(slots.len()).zip(slots) {
        let (in_pivots, in_border) = column.split_at(split);
        if to < s {
            for (value, &row) in in_pivots.iter().zip(slots) {
                blocks.own[to * s + row] += value;
            }
            for (value, &row) in in_border.iter().zip(&slots[split..]) {
                blocks.lower[to * b + row - s] += value;
            }
        } else {
            for (value, &row) in in_pivots.iter().zip(slots) {
                blocks.upper[row * b + to - s] += value;
            }
            for (value, &row) in in_border.iter().zip(&slots[split..]) {
                blocks.remainder[(to - s) * b + row - s] += value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A diagonally dominant, unsymmetric matrix without entries that leave the grid; some nodes stand alone.
    fn matrix(nx: usize, ny: usize) -> Vec<f64> {
        let mut seed = 3_u64;
        let mut noise = move || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let alone = |k: usize| k % 7 == 3 || k % nx > nx / 2;
        let mut stencil = vec![0.0; STENCIL * nx * ny];
        for (k, row) in stencil.chunks_exact_mut(STENCIL).enumerate() {
            let (i, j) = (k % nx, k / nx);
            let inside = [i + 1 < nx, i > 0, j + 1 < ny, j > 0];
            let nodes = [k + 1, k.wrapping_sub(1), k + nx, k.wrapping_sub(nx)];
            for slot in 0..4 {
                if inside[slot] && !alone(k) && !alone(nodes[slot]) {
                    row[slot + 1] = -noise();
                }
            }
            row[0] = 0.1 + row[1..].iter().map(|v| v.abs()).sum::<f64>();
            let unit = 10.0_f64.powf(6.0 * noise() - 20.0);
            row.iter_mut().for_each(|v| *v *= unit);
        }
        stencil
    }

    fn product(stencil: &[f64], nx: usize, x: &[f64]) -> Vec<f64> {
        let at = |k: usize, offset: isize| x.get(k.wrapping_add_signed(offset)).copied().unwrap_or(0.0);
        let nx = nx as isize;
        let offsets = [0, 1, -1, nx, -nx];
        stencil
            .chunks_exact(STENCIL)
            .enumerate()
            .map(|(k, row)| row.iter().zip(offsets).map(|(v, o)| v * at(k, o)).sum())
            .collect()
    }

    #[test]
    fn solves_on_grids_of_any_shape() {
        for (nx, ny) in [(1, 1), (1, 40), (40, 1), (5, 3), (17, 16), (64, 48), (101, 67)] {
            let stencil = matrix(nx, ny);
            let exact: Vec<f64> = (0..nx * ny).map(|k| 1e8 * (1.0 + (k as f64).sin())).collect();
            let mut lu = GridLu::new(nx, ny);
            // Twice: nothing of the first factorisation may be left.
            for _ in 0..2 {
                let mut x = product(&stencil, nx, &exact);
                assert!(lu.factorise(&stencil), "{nx} x {ny}");
                lu.solve(&mut x);
                let worst = x.iter().zip(&exact).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
                assert!(worst < 1e-4 * 2e8, "{nx} x {ny}: off by {worst}");
            }
        }
    }

    #[test]
    fn says_when_the_matrix_holds_no_numbers() {
        let mut stencil = matrix(9, 9);
        stencil[STENCIL * 40] = f64::NAN;
        assert!(!GridLu::new(9, 9).factorise(&stencil), "NaN");
    }
}
