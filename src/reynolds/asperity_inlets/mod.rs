//! Mixed contact at the price of a dry one: the oil that the inlets of asperities draw into a dry contact.

mod compression;
mod flank;
mod split;
mod valley_flow;

use compression::EdgePressures;
use split::{Inlets, Split};
use valley_flow::ValleyFlow;

use super::problem::LubricatedContact;
use super::state::ContactState;
use super::{ContactSolver, Dry, ReynoldsError, StoppingRule};
use crate::elastic::{DeformationModel, HalfSpace, LineHalfSpace};
use crate::grid::Grid;
use crate::lubricant::Lubricant;
use crate::report::{Residuals, SolveReport};
use crate::solver_id::SolverId;

/// Factors on the rise of the reduced pressure in front of asperities within which the law is known
/// (`docs/asperity_inlets.md`).
const RISE_RANGE: [f64; 2] = [1.2, 0.8];

/// Pressure one flank length behind the edge of a Hertz contact over modulus, contact film and inverse flank length.
const BEHIND: f64 = 3.0 / 8.0;

/// Pressure and gap of a dry contact.
struct Field<'a> {
    grid: Grid,
    /// Pressure, zero outside contact \[Pa\].
    pressure: &'a [f64],
    /// Gap \[m\].
    gap: &'a [f64],
}

/// Load sharing of a rough contact from its dry solution.
///
/// The total pressure is that of the dry contact. Each run of nodes under pressure along x is an asperity with an
/// inlet. The reduced pressure of the fluid in front of it increases by
///
/// ```text
/// q = 12 eta0 u integral of (rho h - rho_1 h_c)/h^3 dx,   h = h_c + dry gap,
/// ```
///
/// by the Reynolds equation between the rigid bodies of the dry contact, with conservation of mass (`h_c`: contact film).
/// The density `rho` (`rho_1`: that at the edge, relative to that at ambient pressure) reduces the rise, the
/// elastic deformation of the edge increases it, both as in a straight inlet. Almost no fluid flows by pressure through a film of this thickness, so the
/// fluid keeps the pressure of the front edge: it carries `min(p, p(q))`, solids the rest. Where `q` exceeds what the
/// largest pressure of the run needs, the run floats on a film that is `(q/needed)^(3/4)` times the contact film, at most
/// that of the smooth contact ([`LubricatedContact::reference_film`]). Films elsewhere are the dry gap plus the contact film plus the mean lift of the asperities.
///
/// **Valid** for rough steady contacts whose smooth film is below half of the composite Rq, without a lay, with a flooded
/// inlet. The bodies between the asperities are rigid. Rises are known to about 20 %; where few asperities carry the
/// load, that may decide on solids. `docs/asperity_inlets.md` compares with solutions that resolve the inlets.
///
/// The result is not a solution of the discrete equations of the other solvers. Its report has the residuals of the dry
/// contact and no mass residual; film fractions of the state are one.
///
/// # Errors
/// Of [`ContactSolver::solve`]: besides invalid input and contact at the edge of the box, a problem without lubricant,
/// with squeeze, spin, a limited supply of oil, pressure at the edge, shear thinning, films with a temperature, or the paper's
/// contact.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, scene::SolverModel, solve_contact};
/// let mut scene = Scene::azam_2019(64);
/// scene.solver.model = SolverModel::AsperityInlets;
/// let slow = solve_contact(&scene)?;
/// scene.motion.entrainment_speed *= 10.0;
/// assert!(solve_contact(&scene)?.contact.load_ratio < slow.contact.load_ratio);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Default)]
pub struct AsperityInlets {
    /// The dry contact.
    dry: Dry,
    /// Buffers of the law.
    edges: EdgePressures,
    valleys: ValleyFlow,
    split: Split,
}

impl Clone for AsperityInlets {
    /// The clone allocates its buffers at its first solve.
    fn clone(&self) -> Self {
        Self { dry: self.dry.clone(), ..Self::default() }
    }
}

impl AsperityInlets {
    /// A solver; buffers are allocated at the first solve and kept.
    pub fn new() -> Self {
        Self::default()
    }

    /// A solver that accepts contact at the edge of the box. A run that begins there has no inlet: solids carry it.
    pub fn allowing_edge_contact() -> Self {
        Self { dry: Dry::allowing_edge_contact(), ..Self::default() }
    }
}

impl ContactSolver for AsperityInlets {
    fn id(&self) -> SolverId {
        SolverId::AsperityInlets
    }

    fn unsupported(&self, problem: &LubricatedContact<'_>) -> Option<&'static str> {
        let heated = |oil: &Lubricant| !oil.film_temperatures().is_empty();
        [
            (problem.lubricant.is_none(), "the problem has no lubricant"),
            (problem.squeeze.is_some(), "it is steady, and the problem has a squeeze term"),
            (problem.spin_radius.is_some(), "the surfaces spin"),
            (problem.supplied_film.is_some(), "the inlet is starved (supplied_film)"),
            (problem.edge_pressure.is_some(), "the edge of the box has a pressure"),
            (problem.shear_thinning.is_some(), "the flow thins by shear"),
            (problem.lubricant.is_some_and(heated), "the film has a temperature of its own"),
            (!problem.is_hard(), "the contact is that of the paper"),
        ]
        .into_iter()
        .find_map(|(applies, reason)| applies.then_some(reason))
    }

    fn solve(
        &mut self,
        problem: &mut LubricatedContact<'_>,
        state: &mut ContactState,
        stop: &StoppingRule,
    ) -> Result<SolveReport, ReynoldsError> {
        self.check(problem, state, stop)?;
        // The dry contact.
        let report = self.dry.solve(&mut problem.copied().with_lubricant(None), state, stop)?;
        let oil = problem.lubricant.filter(|_| report.residual.is_finite());
        let (mut load_ratio_range, mut has_valley_flow) = (None, None);
        // The oil that the inlets draw into it.
        if let Some(oil) = oil {
            let must_stop = || problem.deformation.must_stop();
            self.valleys.update(problem.grid(), &state.film, problem.contact_film(), must_stop)?;
            has_valley_flow = Some(self.valleys.is_solved());
            load_ratio_range = self.share(problem, oil, state);
        }
        let residual = Residuals { mass: 0.0, ..report.residual };
        let solved = SolveReport::new(self.id(), report.status, residual).with_work(report.work);
        Ok(SolveReport { load_ratio_range, has_valley_flow, ..solved })
    }
}

impl AsperityInlets {
    /// Shares the pressure of the dry contact in `state` between fluid and solids, and sets its films. Returns the load
    /// ratios at the ends of `RISE_RANGE`.
    fn share(
        &mut self,
        problem: &LubricatedContact<'_>,
        oil: &Lubricant,
        state: &mut ContactState,
    ) -> Option<[f64; 2]> {
        let contact_film = problem.contact_film();
        let peak = state.pressure.iter().copied().fold(0.0, f64::max);
        if peak <= 0.0 {
            return None;
        }
        // Pressures at the edges by the rise of the reduced pressure.
        self.edges.tabulate(oil, peak);
        let stiffness = BEHIND * local_modulus(&*problem.deformation) * contact_film;
        let entrainment = 12.0 * oil.viscosity().viscosity(0.0) * problem.entrainment_speed;
        // No asperity floats above the film of the smooth contact, where it is known.
        let smooth = Some(problem.reference_film).filter(|film| *film > 0.0);
        let inlets = Inlets {
            edges: &self.edges,
            valleys: &self.valleys,
            oil,
            entrainment,
            contact_film,
            highest_film: smooth.map_or(f64::INFINITY, |film| film.max(contact_film)),
            stiffness,
        };
        // Fluid and solid pressure of each asperity.
        let field = Field { grid: problem.grid(), pressure: &state.pressure, gap: &state.film };
        self.split.fill(&field, &inlets);
        // Films: contact film in the runs, the dry gap between them, both lifted by the runs that float.
        let lift = self.split.lift(contact_film);
        state.fluid_pressure.copy_from_slice(&self.split.fluid);
        state.in_contact.copy_from_slice(&self.split.solid);
        state.theta.fill(1.0);
        state.approach -= contact_film + lift;
        for (k, film) in state.film.iter_mut().enumerate() {
            let held = self.split.film[k];
            *film = if held > 0.0 { held } else { film.max(0.0) + contact_film + lift };
            state.mass[k] = *film * oil.at(state.fluid_pressure[k]).density;
        }
        Some(RISE_RANGE.map(|factor| self.split.solid_share(&state.pressure, &self.edges, factor)))
    }
}

/// The equivalent modulus of a half-space with the influence coefficients of `bodies` at neighboring nodes \[Pa\]; infinite for bodies
/// that have no such coefficients.
fn local_modulus(bodies: &dyn DeformationModel) -> f64 {
    let grid = bodies.grid();
    let near = Grid::centred(4, grid.ny().min(4), grid.dx(), grid.dy()).ok();
    let unit: Option<Box<dyn DeformationModel>> = near.and_then(|near| match near.ny() {
        1 => LineHalfSpace::new(near, 1.0, 1.0).ok().map(|bodies| Box::new(bodies) as _),
        _ => HalfSpace::new(near, 1.0).ok().map(|bodies| Box::new(bodies) as _),
    });
    let fall = |bodies: &dyn DeformationModel| bodies.influence(1, 0) - bodies.influence(2, 0);
    let modulus = unit.map_or(f64::NAN, |unit| fall(&*unit) / fall(bodies));
    if modulus > 0.0 { modulus } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn local_modulus_is_that_of_half_spaces() {
        let plane = Grid::centred(16, 8, 1e-6, 2e-6).unwrap();
        let line = Grid::centred(16, 1, 1e-6, 1.0).unwrap();
        let found = [
            local_modulus(&HalfSpace::new(plane, 2e11).unwrap()),
            local_modulus(&LineHalfSpace::new(line, 2e11, 1e-2).unwrap()),
        ];
        assert!(found.iter().all(|modulus| (modulus / 2e11 - 1.0).abs() < 1e-9), "{found:?}");
    }
}
