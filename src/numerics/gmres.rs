//! Restart-free flexible GMRES in single precision, with buffers that are kept.
//!
//! After `k` steps the solution is `x = Z y` with the `y` that makes `|b - A Z y|` least, over the directions
//! `Z` that the preconditioner gave so far. The norm of the residual falls from step to step and is known
//! without forming the residual. Vectors and their products are in single precision, rotations in double.
//!
//! The basis of `limit + 1` vectors is made once; memory that no step reaches is not taken.

/// Cosine of the rotation of a step below which it has left the residual as it was: its norm has fallen by
/// half the square.
const STAGNANT: f64 = 0.02;

/// A linear operator with its preconditioner.
pub(crate) trait PreconditionedOperator {
    /// Why a product could not be formed; it ends the solve.
    type Error;
    /// `out = A x`.
    fn apply(&mut self, x: &[f32], out: &mut [f32]) -> Result<(), Self::Error>;
    /// `out = M^-1 r`.
    fn precondition(&mut self, r: &[f32], out: &mut [f32]) -> Result<(), Self::Error>;
}

/// Basis and rotations of a GMRES solve (Saad and Schultz 1986, SIAM J. Sci. Stat. Comput. 7, 856-869), the
/// preconditioned basis kept as well (Saad 1993, SIAM J. Sci. Comput. 14, 461-469): the solution needs no
/// further preconditioning. The preconditioner acts on the present residual in place of the last basis vector.
/// If it is linear, both span the same space; if it is not, the next direction is then made of what the last
/// one has left. After a step that left the residual as it was it acts on the basis vector, since the same
/// residual would give the same direction again.
#[derive(Debug, Clone)]
pub(crate) struct Gmres {
    /// Orthonormal vectors `V`, one more than steps.
    basis: Vec<Vec<f32>>,
    /// What the preconditioner made of them, `Z`: `A Z = V H`.
    directions: Vec<Vec<f32>>,
    /// `H`, made triangular by the rotations, row-major, `limit` columns.
    hessenberg: Vec<f64>,
    /// Givens rotations, one a step.
    cosines: Vec<f64>,
    /// The other half of the rotations.
    sines: Vec<f64>,
    /// Right-hand side of the triangular system; its last entry is the norm of the residual.
    rhs: Vec<f64>,
    /// The residual over its norm.
    residual: Vec<f32>,
    /// Largest number of steps.
    limit: usize,
}

/// How a linear solve ended.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinearOutcome {
    /// Steps that were taken, a product each.
    pub(crate) steps: u64,
}

impl Gmres {
    /// Solver for vectors of at most `n` entries and at most `limit` steps.
    pub(crate) fn new(n: usize, limit: usize) -> Self {
        // Zeroed memory is not backed by pages before it is written: what is not needed costs nothing.
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
        while steps < self.limit {
            let next_norm = self.extend(operator, steps, b.len())?;
            let residual = self.rotate(steps, next_norm);
            steps += 1;
            if residual <= tolerance * norm || next_norm == 0.0 || !residual.is_finite() {
                break;
            }
            self.follow_residual(steps - 1, b.len());
        }
        self.assemble(steps, x);
        Ok(LinearOutcome { steps: steps as u64 })
    }

    /// The shares of the directions in the solution that ended with `outcome`, in the order of their products.
    pub(crate) fn shares(&self, outcome: LinearOutcome) -> &[f64] {
        &self.rhs[..outcome.steps as usize]
    }

    /// One Arnoldi step with vectors of `n` entries; returns the norm of the new direction.
    fn extend<O: PreconditionedOperator>(
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

    /// Applies the Givens rotations to column `step`; returns the residual norm.
    fn rotate(&mut self, step: usize, next_norm: f64) -> f64 {
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

    /// The residual that step `step` leaves, over its norm: `q -> cosine v - sine q` with the new direction
    /// `v`.
    fn follow_residual(&mut self, step: usize, n: usize) {
        let (cosine, sine) = (self.cosines[step] as f32, self.sines[step] as f32);
        for (q, v) in self.residual[..n].iter_mut().zip(&self.basis[step + 1]) {
            *q = cosine * v - sine * *q;
        }
    }

    /// `x = Z y` with `y` from the triangular system.
    fn assemble(&mut self, steps: usize, x: &mut [f32]) {
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

/// Scalar product in many sums side by side: one sum would wait for itself at every entry, and lose digits.
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

    /// Moves every entry to the next place: the residual stays as it is until the last step.
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
    fn goes_on_where_the_residual_does_not_fall() {
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
