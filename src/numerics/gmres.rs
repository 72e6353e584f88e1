//! Restart-free GMRES with a right preconditioner and buffers that are kept.

/// A linear operator with its preconditioner.
pub(crate) trait PreconditionedOperator {
    /// `out = A x`.
    fn apply(&mut self, x: &[f64], out: &mut [f64]);
    /// `out = M^-1 r`.
    fn precondition(&mut self, r: &[f64], out: &mut [f64]);
}

/// Basis and rotations of a GMRES solve (Saad and Schultz 1986, SIAM J. Sci. Stat. Comput. 7, 856-869).
#[derive(Debug, Clone)]
pub(crate) struct Gmres {
    basis: Vec<Vec<f64>>,
    hessenberg: Vec<f64>,
    cosines: Vec<f64>,
    sines: Vec<f64>,
    rhs: Vec<f64>,
    scratch: Vec<f64>,
    limit: usize,
}

/// How a linear solve ended.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinearOutcome {
    pub(crate) steps: u64,
}

impl Gmres {
    /// Solver for vectors of `n` entries and at most `limit` steps.
    pub(crate) fn new(n: usize, limit: usize) -> Self {
        Self {
            // Zeroed memory is not backed by pages before it is written: what is not needed costs nothing.
            basis: (0..=limit).map(|_| vec![0.0; n]).collect(),
            hessenberg: vec![0.0; limit * (limit + 1)],
            cosines: vec![0.0; limit],
            sines: vec![0.0; limit],
            rhs: vec![0.0; limit + 1],
            scratch: vec![0.0; n],
            limit,
        }
    }

    /// Solves `A x = b` to a residual below `tolerance * |b|`, starting from zero.
    pub(crate) fn solve(
        &mut self,
        operator: &mut impl PreconditionedOperator,
        b: &[f64],
        tolerance: f64,
        x: &mut [f64],
    ) -> LinearOutcome {
        x.fill(0.0);
        let norm = dot(b, b).sqrt();
        if norm == 0.0 || !norm.is_finite() {
            return LinearOutcome { steps: 0 };
        }
        for (v, b) in self.basis[0].iter_mut().zip(b) {
            *v = b / norm;
        }
        self.rhs.fill(0.0);
        self.rhs[0] = norm;
        let mut steps = 0;
        while steps < self.limit {
            let next_norm = self.extend(operator, steps);
            let residual = self.rotate(steps, next_norm);
            steps += 1;
            if residual <= tolerance * norm || next_norm == 0.0 || !residual.is_finite() {
                break;
            }
        }
        self.assemble(operator, steps, x);
        LinearOutcome { steps: steps as u64 }
    }

    /// One Arnoldi step; returns the norm of the new direction.
    fn extend(&mut self, operator: &mut impl PreconditionedOperator, step: usize) -> f64 {
        let (known, fresh) = self.basis.split_at_mut(step + 1);
        let next = &mut fresh[0];
        operator.precondition(&known[step], &mut self.scratch);
        operator.apply(&self.scratch, next);
        for (i, v) in known.iter().enumerate() {
            let projection = dot(next, v);
            self.hessenberg[i * self.limit + step] = projection;
            for (n, v) in next.iter_mut().zip(v) {
                *n -= projection * v;
            }
        }
        let norm = dot(next, next).sqrt();
        if norm > 0.0 {
            for n in next.iter_mut() {
                *n /= norm;
            }
        }
        norm
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

    /// `x = M^-1 V y` with `y` from the triangular system.
    fn assemble(&mut self, operator: &mut impl PreconditionedOperator, steps: usize, x: &mut [f64]) {
        for i in (0..steps).rev() {
            let mut value = self.rhs[i];
            for l in i + 1..steps {
                value -= self.hessenberg[i * self.limit + l] * self.rhs[l];
            }
            let pivot = self.hessenberg[i * self.limit + i];
            self.rhs[i] = if pivot == 0.0 { 0.0 } else { value / pivot };
        }
        self.scratch.fill(0.0);
        for (y, v) in self.rhs[..steps].iter().zip(&self.basis) {
            for (s, v) in self.scratch.iter_mut().zip(v) {
                *s += y * v;
            }
        }
        operator.precondition(&self.scratch, x);
    }
}

/// Scalar product in several sums side by side: one sum would wait for itself at every entry.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (mut left, mut right) = (a.chunks_exact(8), b.chunks_exact(8));
    for (x, y) in left.by_ref().zip(right.by_ref()) {
        for ((sum, x), y) in sums.iter_mut().zip(x).zip(y) {
            *sum += x * y;
        }
    }
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(x, y)| x * y).sum();
    sums.iter().sum::<f64>() + rest
}
