use crate::numerics::GridLu;

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
pub struct StencilLu(GridLu);

impl StencilLu {
    /// Elimination order and buffers for a grid.
    pub fn new(nx: usize, ny: usize) -> Self {
        Self(GridLu::new(nx, ny))
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
