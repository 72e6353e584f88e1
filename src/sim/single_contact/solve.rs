//! Solves and checks of single contacts through the builder of simulations: one path for scenes, heights in memory,
//! custom components and finer meshes.
//!
//! `check_contact` and `solve` share one preparation ([`SimBuilder::begin`]). It returns all input errors, so
//! both have the same ones. A scene with an accuracy or an error estimate becomes a series of meshes
//! (`accuracy`), any other one mesh ([`PreparedContact`]).

use crate::error::InputError;
use crate::grid::Grid;
use crate::reynolds::ContactState;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::contact::warnings::Warning;
use crate::sim::contact::{strip, warnings};
use crate::sim::error::SimError;
use crate::sim::history::builder::SimBuilder;
use crate::sim::scene::{GridSpec, Scene};
use crate::sim::single_contact::accuracy::Meshes;
use crate::sim::single_contact::prepared::PreparedContact;
use crate::sim::single_contact::starvation::starvation;

impl SimBuilder {
    /// Solves the single contact of the bodies in the first position of their roughness under the initial
    /// conditions. It is [`solve_contact`](crate::sim::solve_contact) with the laws, heights and starts given to
    /// this builder. Bodies do not change: growth and wear laws are not called, and a hardness that grows with
    /// the plastic depth of this contact stays at its initial value. Of a scene whose roughness moves
    /// ([`RoughnessState::Moving`](crate::sim::scene::RoughnessState::Moving)) it is the last contact of
    /// [`solve_passage`](Self::solve_passage), with film, pressure, solid contact and friction in the mean of the passage.
    ///
    /// # Errors
    /// A scene, heights or starts that do not fit; a load that the pressure limit cannot carry; custom components
    /// together with an accuracy or an error estimate, which need other meshes. A solve that does not converge is
    /// no error: see the status of the report.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene, solve_contact};
    /// let scene = Scene::azam_2019(32);
    /// let first = solve_contact(&scene)?;
    /// // The same surfaces from memory, started from the solution.
    /// let heights = |k: usize| MixedLubricationSim::builder(scene.clone()).build().map(|sim| sim.bodies()[k].surface().to_vec());
    /// let builder = MixedLubricationSim::builder(scene.clone()).ball_heights(heights(0)?).disc_heights(heights(1)?);
    /// let again = builder.contact_start(first.state.clone()).solve()?;
    /// assert!((again.film.central / first.film.central - 1.0).abs() < 1e-3);
    /// assert!(again.report.work.iterations < first.report.work.iterations);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn solve(self) -> Result<ContactSolution, SimError> {
        self.solve_observed(|_| {})
    }

    /// As [`solve`](Self::solve); with an accuracy or an error estimate `observer` is called with the solution of
    /// each mesh, the last one included. These solutions have no warnings yet.
    ///
    /// # Errors
    /// As of [`solve`](Self::solve).
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut scene = Scene::azam_2019(32);
    /// scene.solver.estimate = true;
    /// let mut cells = Vec::new();
    /// MixedLubricationSim::builder(scene).solve_observed(|solution| cells.push(solution.grid.nx()))?;
    /// assert_eq!(cells, [16, 32]);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn solve_observed(
        self,
        mut observer: impl FnMut(&ContactSolution),
    ) -> Result<ContactSolution, SimError> {
        let scene = self.scene.clone();
        if !scene.motion.roughness.is_at_rest() {
            return self.solve_mean_contact();
        }
        let flooded = self.flooded();
        let mut solution = match self.begin()? {
            ReadySolve::Mesh(contact) => contact.solve()?,
            ReadySolve::Meshes(meshes) => meshes.solve(&mut observer)?,
        };
        let found = warnings::after_solve(&scene, &solution);
        solution.warnings.extend(found);
        solution.starvation = flooded.map(|flooded| starvation(&solution, flooded)).transpose()?.flatten();
        Ok(solution)
    }

    /// Prepares [`solve`](Self::solve) up to the first iteration of its solver, without solving. Returns the
    /// warnings known by then.
    ///
    /// # Errors
    /// The input errors of [`solve`](Self::solve), an interruption. Errors of a history only are found by
    /// [`check`](Self::check).
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut scene = Scene::azam_2019(32);
    /// let warnings = MixedLubricationSim::builder(scene.clone()).check_contact()?;
    /// assert!(warnings.starts_with(&scene.warnings()));
    /// scene.plastic.as_mut().unwrap().hardness = 1e6; // carries less than the load
    /// let builder = || MixedLubricationSim::builder(scene.clone());
    /// let [checked, solved] = [builder().check_contact().err(), builder().solve().err()]
    ///     .map(|error| error.map(|error| error.to_string()));
    /// assert!(checked.is_some() && checked == solved);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn check_contact(self) -> Result<Vec<Warning>, SimError> {
        if !self.scene.motion.roughness.is_at_rest() {
            return Ok(self.check_passage()?.0);
        }
        Ok(match self.begin()? {
            ReadySolve::Mesh(contact) => contact.warnings,
            ReadySolve::Meshes(meshes) => meshes.into_warnings(),
        })
    }

    /// Prepares the contact and returns all input errors.
    fn begin(self) -> Result<ReadySolve, SimError> {
        strip::validate(&self.scene)?;
        if needs_meshes(&self.scene) {
            if let Some(part) = self.custom_part() {
                return Err(SimError::Input(InputError::Conflict {
                    field: part.to_owned(),
                    reason: "it is known on one grid, an accuracy or an estimate of errors needs several"
                        .to_owned(),
                }));
            }
            let meshes = Meshes::new(&self.scene, self.custom.interrupt.as_ref())?;
            return Ok(ReadySolve::Meshes(meshes));
        }
        Ok(ReadySolve::Mesh(Box::new(self.prepare_from_start()?)))
    }

    /// The contact on the grid of the scene from the start that was given to this builder, or from an empty state.
    pub(super) fn prepare_from_start(mut self) -> Result<PreparedContact, SimError> {
        let start = self.contact_start.take();
        let replaced = self.replaced();
        self.prepare(replaced, |grid: &Grid| Ok(start.unwrap_or_else(|| ContactState::new(grid))))
    }
}

/// A checked contact before its first iteration.
enum ReadySolve {
    /// On the grid of the scene.
    Mesh(Box<PreparedContact>),
    /// On several meshes.
    Meshes(Meshes),
}

/// Whether the single contact of `scene` needs several meshes.
pub(super) fn needs_meshes(scene: &Scene) -> bool {
    let asked = scene.solver.estimate || scene.solver.accuracy.is_some();
    asked || matches!(scene.grid, GridSpec::Accuracy { .. })
}
