//! What became of a scene, and whether it is what the solver says.

use std::fmt;
use std::fmt::Write as _;

use stribeck::reynolds::{ContactDefinition, ContactState};
use stribeck::sim::scene::SolverKind;
use stribeck::sim::{MixedLubricationSim, Scene, SimError, solve_contact};
use stribeck::surface::Advected;
use stribeck::{SolveReport, Status};

use crate::scenes::Case;

/// Residual at which a scene counts as converged.
const TOLERANCE: f64 = 1e-6;
/// Sweeps that the paper's contact is given: where it converges it mostly does so within 2000.
const SWEEPS: u64 = 3000;
/// Distance below the contact film that no gap may have \[m\].
const SLACK: f64 = 0.1e-9;

/// Steps of a transient scene; the first has no squeeze.
const STEPS: u32 = 6;

/// The solvers of the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Solver {
    Auto,
    NewtonKrylov,
    SemiSystem,
    /// The paper's definition of contact, which only sweeps can solve.
    PaperContact,
}

pub(crate) const SOLVERS: [Solver; 4] =
    [Solver::Auto, Solver::NewtonKrylov, Solver::SemiSystem, Solver::PaperContact];

impl Solver {
    /// Whether the map takes it far longer than the others.
    pub(crate) fn is_slow(self) -> bool {
        matches!(self, Self::SemiSystem | Self::PaperContact)
    }
}

impl fmt::Display for Solver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::NewtonKrylov => "newton_krylov",
            Self::SemiSystem => "semi_system",
            Self::PaperContact => "paper_contact",
        })
    }
}

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Verdict {
    Converged,
    MeshTooCoarse,
    Stalled,
    MaxIterations,
    Diverged,
    Refused,
    Lie,
}

impl Verdict {
    pub(crate) const ALL: [Self; 7] = [
        Self::Converged,
        Self::MeshTooCoarse,
        Self::Stalled,
        Self::MaxIterations,
        Self::Diverged,
        Self::Refused,
        Self::Lie,
    ];
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Converged => "converged",
            Self::MeshTooCoarse => "too coarse",
            Self::Stalled => "stalled",
            Self::MaxIterations => "out of time",
            Self::Diverged => "diverged",
            Self::Refused => "refused",
            Self::Lie => "lies",
        })
    }
}

/// A scene, a solver and what became of them.
#[derive(Debug)]
pub(crate) struct Entry {
    pub(crate) case: Case,
    pub(crate) solver: Solver,
    pub(crate) verdict: Verdict,
    pub(crate) report: Option<SolveReport>,
    /// Least gap \[m\], load ratio and area ratio.
    numbers: [f64; 3],
    /// What the error or the check says.
    remark: String,
}

pub(crate) fn solve(case: &Case, solver: Solver) -> Entry {
    let entry = |verdict, remark| Entry {
        case: case.clone(),
        solver,
        verdict,
        report: None,
        numbers: [f64::NAN; 3],
        remark,
    };
    let mut scene = match case.scene() {
        Ok(scene) => scene,
        Err(error) => return entry(Verdict::Refused, error.to_string()),
    };
    scene.solver.tolerance = TOLERANCE;
    scene.solver.kind = match solver {
        Solver::Auto | Solver::PaperContact => SolverKind::Auto,
        Solver::NewtonKrylov => SolverKind::NewtonKrylov,
        Solver::SemiSystem => SolverKind::SemiSystem,
    };
    if solver == Solver::PaperContact {
        scene.solver.contact = ContactDefinition::UnifiedReynolds;
        scene.solver.max_iterations = SWEEPS;
    }
    let solved = if case.cells > 0 { in_time(case, scene) } else { at_once(&scene) };
    match solved {
        Err(SimError::NotConverged { source, step, .. }) => {
            let remark = format!("at step {step}");
            let verdict = verdict(source.report.status);
            Entry { report: Some(*source.report), ..entry(verdict, remark) }
        }
        Err(error) => entry(Verdict::Refused, error.to_string()),
        Ok(Solved { report, numbers, fault }) => {
            let (verdict, remark) = match (report.status, fault) {
                (Status::Converged, Some(fault)) => (Verdict::Lie, fault),
                (status, _) => (verdict(status), String::new()),
            };
            Entry { report: Some(report), numbers, ..entry(verdict, remark) }
        }
    }
}

/// A solve with what contradicts it.
struct Solved {
    report: SolveReport,
    numbers: [f64; 3],
    fault: Option<String>,
}

fn verdict(status: Status) -> Verdict {
    match status {
        Status::Converged => Verdict::Converged,
        Status::MeshTooCoarse => Verdict::MeshTooCoarse,
        Status::MaxIterations => Verdict::MaxIterations,
        Status::Diverged => Verdict::Diverged,
        // Stalled, or a status that is new to this example.
        _ => Verdict::Stalled,
    }
}

fn at_once(scene: &Scene) -> Result<Solved, SimError> {
    let solution = solve_contact(scene)?;
    let load = (solution.hertz.force, solution.grid.cell_area());
    Ok(Solved {
        report: solution.report,
        numbers: [solution.film.minimum_gap, solution.contact.load_ratio, solution.contact.area_ratio],
        fault: fault(scene, &solution.state, load),
    })
}

/// Some steps with moving roughness and squeeze; the first step that contradicts itself, or the last.
fn in_time(case: &Case, scene: Scene) -> Result<Solved, SimError> {
    let (grid, checked) = (scene.grid()?, scene.clone());
    let time_step = f64::from(case.cells) * grid.dx() / case.speed;
    let builder = MixedLubricationSim::builder(scene).motion(Advected).with_squeeze();
    let mut sim = builder.build()?;
    loop {
        let record = sim.step(time_step)?;
        let state = sim.state();
        let fault = fault(&checked, state, (sim.hertz().force, grid.cell_area()));
        if fault.is_some() || record.step + 1 >= u64::from(STEPS) {
            let gap = state.film.iter().copied().fold(f64::INFINITY, f64::min);
            let numbers = [gap, record.contact.load_ratio, record.contact.area_ratio];
            return Ok(Solved { report: record.report, numbers, fault });
        }
    }
}

/// What in the fields contradicts a converged solve.
fn fault(scene: &Scene, state: &ContactState, (load, cell_area): (f64, f64)) -> Option<String> {
    let cutoff = scene.solver.film_cutoff;
    let fields = [&state.pressure, &state.fluid_pressure, &state.film];
    if fields.into_iter().flatten().any(|value| !value.is_finite()) {
        return Some("a field is not finite".to_owned());
    }
    let least = |field: &[f64]| field.iter().copied().fold(f64::INFINITY, f64::min);
    let (pressure, gap) = (least(&state.fluid_pressure).min(least(&state.pressure)), least(&state.film));
    if pressure < 0.0 {
        return Some(format!("a pressure of {pressure:.3e} Pa"));
    }
    if gap < cutoff - SLACK {
        return Some(format!("a gap of {gap:.3e} m"));
    }
    let touching = state.in_contact.iter().zip(&state.film).filter(|(touches, _)| **touches);
    let furthest = touching.fold(0.0_f64, |most, (_, film)| most.max((film - cutoff).abs()));
    if furthest > SLACK {
        return Some(format!("solid contact {furthest:.3e} m off the contact film"));
    }
    let carried = state.pressure.iter().sum::<f64>() * cell_area;
    let error = (carried / load - 1.0).abs();
    (error > 2.0 * TOLERANCE).then(|| format!("a relative load error of {error:.1e}"))
}

/// All entries as CSV.
pub(crate) fn table(entries: &[Entry]) -> String {
    let mut text = String::from(
        "solver,group,nodes,entrainment_speed_m_per_s,rq_m,length_x_m,length_y_m,hertz_pressure_pa,hardness_pa,cells_per_step,verdict,\
         ran,strategy,mass_residual,load_residual,complementarity_residual,iterations,convolutions,minimum_gap_m,load_ratio,\
         area_ratio,remark\n",
    );
    for entry in entries {
        let Case { group, nodes, speed, rq, lengths, pressure, hardness, cells, sliding: _, seed: _ } =
            &entry.case;
        let hardness = hardness.map_or_else(String::new, |value| format!("{value:e}"));
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "{},{group},{nodes},{speed:e},{rq:e},{:e},{:e},{pressure:e},{hardness},{cells},{}",
            entry.solver, lengths[0], lengths[1], entry.verdict
        );
        let _ = match &entry.report {
            Some(SolveReport { solver, strategy, residual, work, .. }) => write!(
                text,
                ",{solver},{},{:.2e},{:.2e},{:.2e},{},{:.0}",
                strategy.map_or_else(String::new, |strategy| strategy.to_string()),
                residual.mass,
                residual.load,
                residual.complementarity,
                work.iterations,
                work.convolutions
            ),
            None => write!(text, ",,,,,,,"),
        };
        for number in entry.numbers {
            let _ = write!(text, ",{number:.4e}");
        }
        let _ = writeln!(text, ",\"{}\"", entry.remark.replace('"', "'"));
    }
    text
}
