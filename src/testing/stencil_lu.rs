use std::fmt::Debug;

use crate::grid::Grid;
use crate::numerics::{GridLu, Periodicity, STENCIL};
use crate::reynolds::{FluidBlock, NewtonKrylov, NewtonSettings};

/// A factorization of matrices on the five-point stencil, see [`StencilLu`] for their layout.
pub trait StencilFactorization: Debug + Send + Sync + 'static {
    /// For grids of `nx` by `ny` nodes with four edges.
    fn new(nx: usize, ny: usize) -> Self;

    /// Factorizes the matrix. Returns whether its factors are finite.
    fn factorize(&mut self, stencil: &[f32]) -> bool;

    /// Overwrites the right-hand side with the solution.
    fn solve(&mut self, right_hand_side: &mut [f32]);
}

/// Newton's method with the factorization `F` in its preconditioner, for comparisons of factorizations on contacts.
///
/// ```
/// use stribeck::benchmark::{Benchmark, Cases, Contestant};
/// use stribeck::testing::{StencilLu, newton_by};
/// let cases = Cases::named("battery", 1)?.tagged("smooth").every(30);
/// let results = Benchmark::new(cases)
///     .contestant(Contestant::named("newton_krylov")?)
///     .contestant(Contestant::new("stencil_lu", |_| Box::new(newton_by::<StencilLu>())))
///     .meshes([16])
///     .run()?;
/// let (first, second) = results.rows().split_at(results.rows().len() / 2);
/// for (first, second) in first.iter().zip(second) {
///     assert_eq!(first.all_convolutions, second.all_convolutions);
/// }
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
pub fn newton_by<F: StencilFactorization>() -> NewtonKrylov {
    NewtonKrylov::by(|grid| Box::new(Block::<F>::on(grid)), NewtonSettings::default())
}

/// A custom factorization as a part of the preconditioner. It has no couplings between the first and the last row of
/// a strip, which GMRES has to make up for.
#[derive(Debug)]
struct Block<F> {
    factorization: F,
    /// Entries in a row of nodes of a strip, zero on other grids.
    row: usize,
    /// Matrix of a strip without the couplings across its first and last row.
    stencil: Vec<f32>,
}

impl<F: StencilFactorization> Block<F> {
    fn on(grid: &Grid) -> Self {
        Self {
            factorization: F::new(grid.nx(), grid.ny()),
            row: if grid.is_strip() { STENCIL * grid.nx() } else { 0 },
            stencil: Vec::new(),
        }
    }
}

impl<F: StencilFactorization> FluidBlock for Block<F> {
    fn prepare(&mut self, stencil: &[f32], _must_stop: &(dyn Fn() -> bool + Sync)) -> bool {
        if self.row == 0 {
            return self.factorization.factorize(stencil);
        }
        self.stencil.clear();
        self.stencil.extend_from_slice(stencil);
        let last = stencil.len() - self.row;
        self.stencil[..self.row].iter_mut().skip(4).step_by(STENCIL).for_each(|south| *south = 0.0);
        self.stencil[last..].iter_mut().skip(3).step_by(STENCIL).for_each(|north| *north = 0.0);
        self.factorization.factorize(&self.stencil)
    }

    fn solve(&mut self, _stencil: &[f32], rhs: &mut [f32]) {
        self.factorization.solve(rhs);
    }

    /// All rows have the same weight, as for the factorization of the crate.
    fn row_size(&self, _diagonal: f32) -> f32 {
        1.0
    }
}

/// The sparse LU factorization of Newton's preconditioner, for comparisons with other factorizations.
///
/// The matrix couples each node of a grid to its four neighbors. Row `k`, node `(k % nx, k / nx)`, has the entries
/// `5 k..5 k + 5` in the order center, east, west, north, south. Single precision, no pivoting.
///
/// ```
/// use stribeck::testing::StencilLu;
/// // Laplace equation on 5 x 5 nodes with zero boundary values.
/// let mut lu = StencilLu::new(5, 5);
/// let has = |k: usize, side: usize| match side {
///     1 => k % 5 < 4,
///     2 => k % 5 > 0,
///     3 => k / 5 < 4,
///     _ => k / 5 > 0,
/// };
/// let row = |k| (0..5).map(move |s| if s == 0 { 4.0 } else if has(k, s) { -1.0 } else { 0.0 });
/// let stencil: Vec<f32> = (0..25).flat_map(row).collect();
/// assert!(lu.factorize(&stencil));
/// let mut x = vec![1.0; 25];
/// lu.solve(&mut x);
/// assert!((4.0 * x[12] - x[11] - x[13] - x[7] - x[17] - 1.0).abs() < 1e-5);
/// ```
#[derive(Debug)]
pub struct StencilLu(GridLu<f32>);

impl StencilLu {
    /// Elimination order and buffers for a grid.
    pub fn new(nx: usize, ny: usize) -> Self {
        Self(GridLu::new(nx, ny, Periodicity::None))
    }

    /// Factorizes the matrix. Entries that point outside the grid must be zero. Returns whether all pivots are finite.
    pub fn factorize(&mut self, stencil: &[f32]) -> bool {
        self.0.factorise(stencil)
    }

    /// Solves in place; without a factorization the right-hand side is unchanged.
    pub fn solve(&mut self, right_hand_side: &mut [f32]) {
        self.0.solve(right_hand_side);
    }
}

impl StencilFactorization for StencilLu {
    fn new(nx: usize, ny: usize) -> Self {
        Self::new(nx, ny)
    }

    fn factorize(&mut self, stencil: &[f32]) -> bool {
        Self::factorize(self, stencil)
    }

    fn solve(&mut self, right_hand_side: &mut [f32]) {
        Self::solve(self, right_hand_side);
    }
}
