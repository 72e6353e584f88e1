//! An own solver against two of the crate: the program of `docs/comparing_solvers.md`.

use std::path::Path;

use stribeck::SolverId;
use stribeck::benchmark::{Benchmark, Cases, Contestant, Results};
use stribeck::reynolds::{ContactSolver, ContactState, LubricatedContact, NewtonKrylov};
use stribeck::reynolds::{ReynoldsError, StoppingRule};
use stribeck::sim::SimError;
use stribeck::{SolveReport, Work};

/// Newton's method in two stages: to a hundred times the tolerance, then from there.
#[derive(Debug, Default)]
pub struct TwoStages(NewtonKrylov);

impl ContactSolver for TwoStages {
    fn id(&self) -> SolverId {
        SolverId::Custom("two_stages")
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        let mut work = Work::default();
        for factor in [100.0, 1.0] {
            let stage = stop.with_tolerance((factor * stop.tolerance).min(0.1));
            let report = self.0.solve(problem, state, &stage)?;
            work += report.work;
            if factor <= 1.0 {
                return Ok(SolveReport::new(self.id(), report.status, report.residual).with_work(work));
            }
        }
        unreachable!("the last factor returns")
    }
}

/// Solves `cases` and writes map, chart and profile to `folder`.
///
/// # Errors
/// A folder that cannot be written.
pub fn compare(cases: Cases, folder: &Path) -> Result<Results, SimError> {
    let results = Benchmark::new(cases)
        .contestant(Contestant::new("two_stages", |_| Box::new(TwoStages::default())))
        .contestant(Contestant::named("auto")?)
        .contestant(Contestant::named("newton_krylov:halvings=1")?)
        .tolerances([1e-2, 1e-4, 1e-6])
        .file(folder.join("rows.csv"))
        .run()?;
    let pictures = [
        ("map.svg", results.stability_map()),
        ("precision.svg", results.work_precision()),
        ("profile.svg", results.performance_profile()),
    ];
    for (name, picture) in pictures {
        let path = folder.join(name);
        std::fs::write(&path, picture).map_err(|source| SimError::Io { path, source })?;
    }
    Ok(results)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn own_solver_is_compared_with_two_of_the_crate() -> Result<(), SimError> {
        let folder = std::env::temp_dir().join(format!("stribeck_downstream_{}", std::process::id()));
        let mut cases = Cases::named("battery", 1)?.every(101);
        for case in &mut cases.cases {
            case.scene = shrunk(case.scene.clone());
        }
        let results = compare(cases, &folder)?;
        assert_eq!(results.rows().len(), 5 * 3 * 3);
        assert!(results.rows().iter().all(|row| row.is_solved()), "{}", results.summary());
        assert!(results.summary().contains("takes the fewest convolutions"), "{}", results.summary());
        for name in ["map.svg", "precision.svg", "profile.svg", "rows.csv"] {
            assert!(folder.join(name).exists(), "{name}");
        }
        std::fs::remove_dir_all(&folder).map_err(|source| SimError::Io { path: folder, source })
    }

    /// The same box with 16 x 16 cells.
    fn shrunk(mut scene: stribeck::sim::Scene) -> stribeck::sim::Scene {
        if let stribeck::sim::scene::GridSpec::Cells { nx, ny, .. } = &mut scene.grid {
            (*nx, *ny) = (16, 16);
        }
        scene
    }
}
