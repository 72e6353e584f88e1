//! Both factorizations in Newton's preconditioner, on contacts.

use std::error::Error;

use faer::linalg::solvers::Solve as _;
use faer::sparse::SparseColMat;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use stribeck::benchmark::{Benchmark, Budget, Cases, Contestant};
use stribeck::testing::{StencilFactorization, StencilLu, newton_by};

/// The supernodal LU of faer, with the pattern of each matrix.
#[derive(Debug)]
struct FaerLu {
    nx: usize,
    factors: Option<Lu<u32, f32>>,
}

impl StencilFactorization for FaerLu {
    fn new(nx: usize, _ny: usize) -> Self {
        Self { nx, factors: None }
    }

    fn factorize(&mut self, stencil: &[f32]) -> bool {
        let n = stencil.len() / 5;
        let matrix = SparseColMat::try_new_from_triplets(n, n, &crate::triplets(self.nx, stencil)).ok();
        self.factors = matrix.and_then(|matrix| {
            let pattern = SymbolicLu::try_new(matrix.symbolic()).ok()?;
            Lu::try_new_with_symbolic(pattern, matrix.as_ref()).ok()
        });
        self.factors.is_some()
    }

    fn solve(&mut self, right_hand_side: &mut [f32]) {
        let n = right_hand_side.len();
        if let Some(factors) = &self.factors {
            factors.solve_in_place(faer::MatMut::from_column_major_slice_mut(right_hand_side, n, 1));
        }
    }
}

/// Solves every `every`-th case of the battery with both and prints table and summary.
pub(crate) fn compare(every: usize) -> Result<(), Box<dyn Error>> {
    let results = Benchmark::new(Cases::named("battery", 1)?.every(every))
        .contestant(Contestant::new("grid_lu", |_| Box::new(newton_by::<StencilLu>())))
        .contestant(Contestant::new("faer_sparse_lu", |_| Box::new(newton_by::<FaerLu>())))
        .budget(Budget::unlimited())
        .threads(1)
        .run()?;
    println!("| factorization | converged | Newton steps | convolutions | seconds |\n|---|---|---|---|---|");
    for name in ["grid_lu", "faer_sparse_lu"] {
        let rows: Vec<_> = results.rows().iter().filter(|row| row.contestant == name).collect();
        let converged = rows.iter().filter(|row| row.is_solved()).count();
        let steps: u64 = rows.iter().map(|row| row.iterations).sum();
        let convolutions: f64 = rows.iter().map(|row| row.all_convolutions).sum();
        let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
        println!("| `{name}` | {converged} of {} | {steps} | {convolutions:.0} | {seconds:.1} |", rows.len());
    }
    print!("{}", results.summary());
    Ok(())
}
