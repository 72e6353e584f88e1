//! Pressures of blocks of nodes with prescribed films.

use std::sync::Arc;

use crate::elastic::DeformationModel;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Convolution, ConvolutionPlan, add_scaled, dot};
use crate::reynolds::coupled::UNPADDED;

/// Nodes of a block along each axis.
const WIDTH: usize = 3;
/// Conjugate gradient steps, a fixed number: a varying one costs more Krylov steps.
const STEPS: u32 = 3;
/// Cost of a convolution on the blocks in those on the padded grid of the nodes.
const COST: f64 = UNPADDED / (WIDTH * WIDTH) as f64;

/// One pressure for all prescribed nodes of a block, such that their mean film is the prescribed one.
///
/// With `n` prescribed nodes in a block (the sum of their squared weights) and `K` the mean influence of two
/// different nodes of two blocks, the mean film of a block is `sum of K n p + (1 - K_own) p`, its own nodes
/// having the self-influence, one, on themselves. Multiplied by `sqrt(n)` these equations are symmetric in
/// `sqrt(n) p`; conjugate gradients solve them, the inverse convolution for blocks full of such nodes being
/// the preconditioner.
#[derive(Debug)]
pub(super) struct CoarseFilms {
    /// Block of every node.
    block: Vec<u32>,
    influence: Convolution<f32>,
    inverse: Convolution<f32>,
    /// `1 - K_own`.
    excess: f64,
    /// Square root of the number of prescribed nodes of each block, and its inverse, zero without any.
    root: Vec<f64>,
    per_root: Vec<f64>,
    solution: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
    scratch: Vec<f64>,
}

impl CoarseFilms {
    /// Blocks for the grid of `body`; one convolution.
    pub(super) fn new(body: &mut dyn DeformationModel) -> Result<Self, InputError> {
        let grid = body.grid();
        let n = grid.len();
        // Influence coefficients of all distances: the deflection by a pressure on one node.
        let mut unit = vec![0.0; n];
        unit[0] = 1.0 / body.influence(0, 0);
        let mut table = vec![0.0; n];
        body.displacement(&unit, &mut table)?;
        // The self-influence of the first node represents that of all.
        table[0] += (body.influence(0, 0) - body.self_influence(0)) * unit[0];
        let (nx, ny) = (grid.nx().div_ceil(WIDTH), grid.ny().div_ceil(WIDTH));
        let mean = |di: isize, dj: isize| mean_influence(&grid, &table, [di, dj]);
        let pairs = (WIDTH * WIDTH) as f64;
        let own = (mean(0, 0) * pairs - 1.0) / (pairs - 1.0);
        let kernel = |di: isize, dj: isize| if (di, dj) == (0, 0) { own } else { mean(di, dj) };
        let full =
            |di: isize, dj: isize| pairs * kernel(di, dj) + if (di, dj) == (0, 0) { 1.0 - own } else { 0.0 };
        let blocks = || vec![0.0; nx * ny];
        Ok(Self {
            block: (0..n).map(|k| (k / grid.nx() / WIDTH * nx + k % grid.nx() / WIDTH) as u32).collect(),
            influence: Convolution::new(Arc::new(ConvolutionPlan::periodic(nx, ny, kernel).to_single(1.0))),
            inverse: Convolution::new(Arc::new(
                ConvolutionPlan::periodic(nx, ny, full).inverse_with(0.0).to_single(1.0),
            )),
            excess: 1.0 - own,
            root: blocks(),
            per_root: blocks(),
            solution: blocks(),
            residual: blocks(),
            direction: blocks(),
            image: blocks(),
            scratch: blocks(),
        })
    }

    /// Takes the nodes with prescribed films, and the weights of all nodes, zero at others.
    pub(super) fn prepare(&mut self, given: &[u32], weights: &[f64]) {
        self.root.fill(0.0);
        for &k in given {
            self.root[self.block[k as usize] as usize] += weights[k as usize].powi(2);
        }
        for (root, inverse) in self.root.iter_mut().zip(&mut self.per_root) {
            *root = root.sqrt();
            *inverse = if *root > 0.0 { 1.0 / *root } else { 0.0 };
        }
    }

    /// Adds to the pressures of the `given` nodes those of their blocks, such that together with all other
    /// pressures they cause the mean of `films`, in deflections of a node under unit pressure. Returns the cost in
    /// convolutions.
    pub(super) fn add_pressures(
        &mut self,
        given: &[u32],
        weights: &[f64],
        films: &[f64],
        pressures: &mut [f64],
    ) -> f64 {
        // Pressures and films of the blocks.
        self.residual.fill(0.0);
        self.direction.fill(0.0);
        for (pressure, &block) in pressures.iter().zip(&self.block) {
            self.direction[block as usize] += pressure;
        }
        for k in given.iter().map(|&k| k as usize) {
            self.residual[self.block[k] as usize] += weights[k].powi(2) * films[k];
        }
        // Residual: mean films less those under all pressures.
        self.influence.apply(&self.direction, &mut self.image);
        let roots = self.root.iter().zip(&self.per_root);
        for ((r, image), (root, inverse)) in self.residual.iter_mut().zip(&self.image).zip(roots) {
            *r = *r * inverse - root * image;
        }
        // Corrections of the blocks, spread over their nodes.
        let cost = COST * (1.0 + self.solve());
        for k in given.iter().map(|&k| k as usize) {
            let block = self.block[k] as usize;
            pressures[k] += weights[k].powi(2) * self.per_root[block] * self.solution[block];
        }
        cost
    }

    /// Subtracts the mean pressure of each block from `values`, pressures over their weights.
    pub(super) fn take_means(&mut self, given: &[u32], weights: &[f64], values: &mut [f64]) {
        self.scratch.fill(0.0);
        for k in given.iter().map(|&k| k as usize) {
            self.scratch[self.block[k] as usize] += weights[k] * values[k];
        }
        // Means over the blocks, subtracted from their nodes.
        for (mean, per_root) in self.scratch.iter_mut().zip(&self.per_root) {
            *mean *= per_root * per_root;
        }
        for k in given.iter().map(|&k| k as usize) {
            values[k] -= weights[k] * self.scratch[self.block[k] as usize];
        }
    }

    /// Conjugate gradients from zero for `self.residual`; returns their convolutions.
    fn solve(&mut self) -> f64 {
        self.solution.fill(0.0);
        self.precondition();
        self.direction.copy_from_slice(&self.image);
        let mut energy = dot(&self.residual, &self.image);
        let mut convolutions = 1.0;
        for step in 1..=STEPS {
            if energy <= 0.0 || !energy.is_finite() {
                break;
            }
            // Step along the direction.
            self.respond();
            convolutions += 1.0;
            let length = energy / dot(&self.direction, &self.image);
            add_scaled(&mut self.solution, length, &self.direction);
            if step == STEPS {
                break;
            }
            // Next residual and conjugate direction.
            add_scaled(&mut self.residual, -length, &self.image);
            self.precondition();
            convolutions += 1.0;
            let next = dot(&self.residual, &self.image);
            let share = next / energy;
            for (d, z) in self.direction.iter_mut().zip(&self.image) {
                *d = z + share * *d;
            }
            energy = next;
        }
        convolutions
    }

    /// Films of `self.direction` into `self.image`, both times the roots.
    fn respond(&mut self) {
        for ((s, d), root) in self.scratch.iter_mut().zip(&self.direction).zip(&self.root) {
            *s = d * root;
        }
        // The operator is the mean influence, and the excess of the self-influence on the diagonal.
        self.influence.apply(&self.scratch, &mut self.image);
        for ((image, root), d) in self.image.iter_mut().zip(&self.root).zip(&self.direction) {
            *image = *image * root + self.excess * d;
        }
    }

    /// The inverse for full blocks, of `self.residual` into `self.image`.
    fn precondition(&mut self) {
        self.inverse.apply(&self.residual, &mut self.image);
        for (image, root) in self.image.iter_mut().zip(&self.root) {
            // Blocks without prescribed films have no unknown.
            if *root <= 0.0 {
                *image = 0.0;
            }
        }
    }
}

/// Mean influence of the nodes of two blocks at an offset of `di` and `dj` blocks, from the influences in
/// `table`.
fn mean_influence(grid: &Grid, table: &[f64], offset: [isize; 2]) -> f64 {
    let reach = WIDTH as isize;
    let [columns, rows] = offset.map(|blocks| {
        (1 - reach..reach)
            .map(move |node| ((reach * blocks + node).unsigned_abs(), (reach - node.abs()) as f64))
    });
    let mut sum = 0.0;
    for (j, in_rows) in rows {
        for (i, in_columns) in columns.clone() {
            let (i, j) = (i.min(grid.nx() - 1), j.min(grid.ny() - 1));
            // Each offset of two nodes counts as often as it occurs between the blocks.
            sum += in_rows * in_columns * table[j * grid.nx() + i];
        }
    }
    sum / (WIDTH as f64).powi(4)
}
