//! Flexible GMRES without restarts, in single precision, with reusable buffers.
//!
//! After `k` steps the solution is `x = Z y`, where `y` minimizes `|b - A Z y|` over the preconditioned
//! directions `Z`. The residual norm does not increase from step to step and follows from the rotations,
//! without forming the residual. Vectors and their products are in single precision, rotations in double.
//!
//! The basis of `limit + 1` vectors is allocated once; the operating system commits memory only for the steps
//! taken.

/// Cosine of the rotation below which a step counts as stagnant: it reduced the residual norm by half the
/// square of this value.
const STAGNANT: f64 = 0.02;

/// A linear operator and its preconditioner.
pub(crate) trait PreconditionedOperator {
    /// Failure of a product; it ends the solve.
    type Error;
    /// `out = A x`.
    fn apply(&mut self, x: &[f32], out: &mut [f32]) -> Result<(), Self::Error>;
    /// `out = M^-1 r`.
    fn precondition(&mut self, r: &[f32], out: &mut [f32]) -> Result<(), Self::Error>;
}

/// Basis and rotations of a GMRES solve (Saad and Schultz 1986, SIAM J. Sci. Stat. Comput. 7, 856-869). The
/// preconditioned basis is stored as well (Saad 1993, SIAM J. Sci. Comput. 14, 461-469), so the solution
/// needs no further preconditioning. The preconditioner is applied to the current residual instead of the
/// last basis vector. Both span the same space if the preconditioner is linear; if it is nonlinear, the
/// residual gives a direction for the remaining error. After a stagnant step the preconditioner is applied to
/// the basis vector, since an unchanged residual would reproduce the last direction.
#[derive(Debug, Clone)]
pub(crate) struct Gmres {
    /// Orthonormal vectors `V`, one more than steps taken.
    basis: Vec<Vec<f32>>,
    /// Preconditioned directions `Z` with `A Z = V H`.
    directions: Vec<Vec<f32>>,
    /// `H`, triangularized by the rotations, row-major, `limit` columns.
    hessenberg: Vec<f64>,
    /// Cosines of the Givens rotations, one per step.
    cosines: Vec<f64>,
    /// Sines of the Givens rotations.
    sines: Vec<f64>,
    /// Right-hand side of the triangular system; the last entry is the residual norm.
    rhs: Vec<f64>,
    /// Normalized residual.
    residual: Vec<f32>,
    /// Largest number of steps.
    limit: usize,
}

/// Outcome of a linear solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinearOutcome {
    /// Number of steps, each with one product.
    pub(crate) steps: u64,
}

impl Gmres {
    /// Solver for vectors of at most `n` entries and at most `limit` steps.
    pub(crate) fn new(n: usize, limit: usize) -> Self {
        // Zeroed memory is committed by the operating system on first write only.
        let vectors = |count: usize| (0..count).map(|_| vec![0.0; n]).collect();
        Self {
            basis: vectors(limit + 1),
            directions: vectors(limit),
            hessenberg: vec![0.0; limit * (limit + 1)],
            cosines: vec![0.0; limit],
            sines: vec![0.0; limit],
            rhs: vec![0.0; limit + 1],
            residual: vec![0.0; n],
            limit,
        }
    }

    /// Solves `A x = b` to a residual below `tolerance * |b|`, starting from zero.
    pub(crate) fn solve<O: PreconditionedOperator>(
        &mut self,
        operator: &mut O,
        b: &[f32],
        tolerance: f64,
        x: &mut [f32],
    ) -> Result<LinearOutcome, O::Error> {
        x.fill(0.0);
        let norm = f64::from(dot(b, b)).sqrt();
        if norm == 0.0 || !norm.is_finite() {
            return Ok(LinearOutcome { steps: 0 });
        }
        scaled(b, 1.0 / norm as f32, &mut self.basis[0]);
        self.residual[..b.len()].copy_from_slice(&self.basis[0][..b.len()]);
        self.rhs.fill(0.0);
        self.rhs[0] = norm;
        let mut steps = 0;
        // one Arnoldi step, one rotation, test of the residual norm
        while steps < self.limit {
            let next_norm = self.arnoldi_step(operator, steps, b.len())?;
            let residual = self.apply_rotations(steps, next_norm);
            steps += 1;
            if residual <= tolerance * norm || next_norm == 0.0 || !residual.is_finite() {
                break;
            }
            self.update_residual(steps - 1, b.len());
        }
        self.compute_solution(steps, x);
        Ok(LinearOutcome { steps: steps as u64 })
    }

    /// Coefficients of the solution in the directions of the solve with `outcome`, in the order of the steps.
    pub(crate) fn coefficients(&self, outcome: LinearOutcome) -> &[f64] {
        &self.rhs[..outcome.steps as usize]
    }

    /// One Arnoldi step with vectors of `n` entries; returns the norm of the new basis vector before
    /// normalization.
    fn arnoldi_step<O: PreconditionedOperator>(
        &mut self,
        operator: &mut O,
        step: usize,
        n: usize,
    ) -> Result<f64, O::Error> {
        let (known, fresh) = self.basis.split_at_mut(step + 1);
        let (direction, next) = (&mut self.directions[step][..n], &mut fresh[0][..n]);
        let stagnates = step > 0 && self.cosines[step - 1].abs() < STAGNANT;
        operator.precondition(&(if stagnates { &known[step] } else { &self.residual })[..n], direction)?;
        operator.apply(direction, next)?;
        // modified Gram-Schmidt
        for (i, v) in known.iter().enumerate() {
            let v = &v[..n];
            let projection = dot(next, v);
            self.hessenberg[i * self.limit + step] = f64::from(projection);
            for (n, v) in next.iter_mut().zip(v) {
                *n -= projection * v;
            }
        }
        let norm = f64::from(dot(next, next)).sqrt();
        if norm > 0.0 {
            let inverse = 1.0 / norm as f32;
            for n in next.iter_mut() {
                *n *= inverse;
            }
        }
        Ok(norm)
    }

    /// Applies the previous Givens rotations to column `step` and adds a new one; returns the residual norm.
    fn apply_rotations(&mut self, step: usize, next_norm: f64) -> f64 {
        let at = |i: usize| i * self.limit + step;
        for i in 0..step {
            let (upper, lower) = (self.hessenberg[at(i)], self.hessenberg[at(i + 1)]);
            self.hessenberg[at(i)] = self.cosines[i] * upper + self.sines[i] * lower;
            self.hessenberg[at(i + 1)] = -self.sines[i] * upper + self.cosines[i] * lower;
        }
        let diagonal = self.hessenberg[at(step)];
        let length = diagonal.hypot(next_norm);
        let (cosine, sine) = if length > 0.0 { (diagonal / length, next_norm / length) } else { (1.0, 0.0) };
        self.cosines[step] = cosine;
        self.sines[step] = sine;
        self.hessenberg[at(step)] = length;
        self.rhs[step + 1] = -sine * self.rhs[step];
        self.rhs[step] *= cosine;
        self.rhs[step + 1].abs()
    }

    /// Updates the normalized residual after `step`: `q -> cosine v - sine q` with the new basis vector `v`.
    fn update_residual(&mut self, step: usize, n: usize) {
        let (cosine, sine) = (self.cosines[step] as f32, self.sines[step] as f32);
        for (q, v) in self.residual[..n].iter_mut().zip(&self.basis[step + 1]) {
            *q = cosine * v - sine * *q;
        }
    }

    /// `x = Z y` with `y` from back substitution in the triangular system.
    fn compute_solution(&mut self, steps: usize, x: &mut [f32]) {
        for i in (0..steps).rev() {
            let mut value = self.rhs[i];
            for l in i + 1..steps {
                value -= self.hessenberg[i * self.limit + l] * self.rhs[l];
            }
            let pivot = self.hessenberg[i * self.limit + i];
            self.rhs[i] = if pivot == 0.0 { 0.0 } else { value / pivot };
        }
        for (y, direction) in self.rhs[..steps].iter().zip(&self.directions) {
            let y = *y as f32;
            for (x, z) in x.iter_mut().zip(direction) {
                *x += y * z;
            }
        }
    }
}

/// `out = factor a`.
fn scaled(a: &[f32], factor: f32, out: &mut [f32]) {
    for (o, a) in out.iter_mut().zip(a) {
        *o = factor * a;
    }
}

/// Scalar product with 32 partial sums, which break the dependency chain and reduce rounding errors.
fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut sums = [0.0; 32];
    let (mut left, mut right) = (a.chunks_exact(32), b.chunks_exact(32));
    for (x, y) in left.by_ref().zip(right.by_ref()) {
        for ((sum, x), y) in sums.iter_mut().zip(x).zip(y) {
            *sum += x * y;
        }
    }
    let rest: f32 = left.remainder().iter().zip(right.remainder()).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f32>() + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cyclic shift: the residual stagnates until the last step.
    struct Shift;

    impl PreconditionedOperator for Shift {
        type Error = std::convert::Infallible;

        fn apply(&mut self, x: &[f32], out: &mut [f32]) -> Result<(), Self::Error> {
            out.copy_from_slice(x);
            out.rotate_right(1);
            Ok(())
        }

        fn precondition(&mut self, r: &[f32], out: &mut [f32]) -> Result<(), Self::Error> {
            out.copy_from_slice(r);
            Ok(())
        }
    }

    #[test]
    fn stagnant_residual_converges_in_n_steps() {
        const N: usize = 12;
        let mut b = [0.0; N];
        b[0] = 2.0;
        let mut x = [0.0; N];
        let Ok(outcome) = Gmres::new(N, 2 * N).solve(&mut Shift, &b, 1e-6, &mut x);
        assert_eq!(outcome.steps, N as u64);
        for (k, value) in x.iter().enumerate() {
            let exact = if k == N - 1 { 2.0 } else { 0.0 };
            assert!((value - exact).abs() < 1e-5, "{value} in place of {exact} at {k}");
        }
    }
}
