//! Checkpoints: the complete state of a simulation in one file, exact to the last bit.
use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::error::InputError;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::CheckpointError;
use crate::sim::files::atomic_file;
use crate::sim::files::checkpoint_content::{
    BodyPart, Content, checked_content, read, validate_rises, with_header,
};
use crate::sim::history::identity::{CONDITIONS, Identity};
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::GridSpec;

/// Name of a checkpoint in memory, for error messages.
const IN_MEMORY: &str = "checkpoint in memory";
impl MixedLubricationSim {
    /// Writes the state to a file. A simulation of the same scene and laws that [restores](Self::restore) it
    /// continues as this one does, equal to the last bit on the same kind of processor. The file is replaced
    /// atomically: if the process is killed meanwhile, the old file remains.
    ///
    /// Custom laws and solvers must be stateless: their results may depend on their arguments only.
    ///
    /// # Errors
    /// [`CheckpointError::Io`] when the file cannot be written.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("checkpoint");
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let build = || MixedLubricationSim::builder(Scene::azam_2019(32).with_tribofilm()).build();
    /// let mut sim = build()?;
    /// sim.step(10.0)?;
    /// sim.save(&path)?;
    /// let mut other = build()?;
    /// other.restore(&path)?;
    /// assert_eq!(other.step(10.0)?, sim.step(10.0)?);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), CheckpointError> {
        let path = path.as_ref();
        let io = |source| CheckpointError::Io { path: path.to_owned(), source };
        let bytes = self.checkpoint().map_err(|error| io(std::io::Error::other(error)))?;
        atomic_file::replace(path, &bytes).map_err(io)
    }

    /// The bytes that [`save`](Self::save) writes, for copies in memory.
    ///
    /// # Errors
    /// [`CheckpointError::Damaged`] if the state cannot be serialized.
    ///
    /// ```
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let build = || MixedLubricationSim::builder(Scene::azam_2019(32)).build();
    /// let mut sim = build()?;
    /// sim.step(10.0)?;
    /// let mut fork = build()?;
    /// fork.restore_checkpoint(&sim.checkpoint()?)?;
    /// assert_eq!(fork.step(10.0)?, sim.step(10.0)?);
    /// # Ok::<(), stribeck::sim::SimError>(())
    /// ```
    pub fn checkpoint(&self) -> Result<Vec<u8>, CheckpointError> {
        let damaged = |reason: String| CheckpointError::Damaged { path: PathBuf::from(IN_MEMORY), reason };
        let [ball, disc] = self.bodies();
        let content = Content {
            identity: self.identity().map_err(|error| damaged(error.to_string()))?,
            bodies: [BodyPart::of(ball), BodyPart::of(disc)],
            state: Cow::Borrowed(&self.state),
            squeeze_memory: Cow::Borrowed(&self.squeeze_memory),
            time: self.time,
            step: self.step,
            draws: self.draws,
            film_rises: self.film_heat.as_ref().map(|heat| heat.start().into()),
            warnings: Cow::Borrowed(&self.warnings),
        };
        let content = postcard::to_stdvec(&content).map_err(|error| damaged(error.to_string()))?;
        Ok(with_header(&content))
    }

    /// Restores the state from the bytes of [`checkpoint`](Self::checkpoint).
    ///
    /// # Errors
    /// As of [`restore`](Self::restore).
    pub fn restore_checkpoint(&mut self, bytes: &[u8]) -> Result<(), CheckpointError> {
        self.restore_from(Path::new(IN_MEMORY), bytes, &[]).map(|_| ())
    }

    /// Restores the state from the bytes of [`checkpoint`](Self::checkpoint) under other
    /// [conditions](Self::restore_under_other_conditions). Returns the names of the parts that differ.
    ///
    /// # Errors
    /// As of [`restore`](Self::restore).
    pub fn restore_checkpoint_under_other_conditions(
        &mut self,
        bytes: &[u8],
    ) -> Result<Vec<String>, CheckpointError> {
        self.restore_from(Path::new(IN_MEMORY), bytes, &CONDITIONS)
    }

    /// Restores the state from a file written by [`save`](Self::save). The simulation must be built from the
    /// same scene, laws, motion and heights. Time, steps and all fields are replaced by those of the file. An
    /// error leaves the simulation unchanged.
    ///
    /// # Errors
    /// A file that cannot be read, is no checkpoint, is damaged, has a newer format or belongs to another
    /// simulation.
    pub fn restore(&mut self, path: impl AsRef<Path>) -> Result<(), CheckpointError> {
        let path = path.as_ref();
        self.restore_from(path, &read(path)?, &[]).map(|_| ())
    }

    /// Restores a file written by [`save`](Self::save) and continues under other conditions: load, speeds,
    /// lubricant, friction, temperatures, schedule and solver may differ from those of the file. Returns the
    /// names of the parts that differ. Time and steps continue from those of the file; a schedule is evaluated
    /// at that time.
    ///
    /// # Errors
    /// As of [`restore`](Self::restore); the simulation is then unchanged.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("checkpoint");
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut slow = MixedLubricationSim::builder(Scene::azam_2019(32)).build()?;
    /// slow.step(10.0)?;
    /// slow.save(&path)?;
    /// let mut scene = Scene::azam_2019(32);
    /// scene.motion.entrainment_speed = 0.2;
    /// let mut fast = MixedLubricationSim::builder(scene).build()?;
    /// assert!(fast.restore(&path).unwrap_err().to_string().contains("scene.motion"));
    /// assert_eq!(fast.restore_under_other_conditions(&path)?, ["scene.motion"]);
    /// fast.step(10.0)?;
    /// assert_eq!(fast.time(), 20.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn restore_under_other_conditions(
        &mut self,
        path: impl AsRef<Path>,
    ) -> Result<Vec<String>, CheckpointError> {
        let path = path.as_ref();
        self.restore_from(path, &read(path)?, &CONDITIONS)
    }

    /// Restores the state from a file written by [`save`](Self::save). The named `parts` may differ: tables of the
    /// scene (`scene.load`) and laws as errors name them (`wear law`). Returns the names of those that differ.
    ///
    /// # Errors
    /// As of [`restore`](Self::restore); the simulation is then as before.
    ///
    /// ```
    /// # let folder = tempfile::tempdir()?;
    /// # let path = folder.path().join("checkpoint");
    /// use stribeck::sim::{MixedLubricationSim, Scene};
    /// let mut run = MixedLubricationSim::builder(Scene::azam_2019(32)).build()?;
    /// run.step(10.0)?;
    /// run.save(&path)?;
    /// let mut scene = Scene::azam_2019(32);
    /// scene.wear = None;
    /// let mut other = MixedLubricationSim::builder(scene).build()?;
    /// assert!(other.restore(&path).is_err());
    /// assert_eq!(other.restore_accepting(&path, &["scene.wear"])?, ["scene.wear"]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn restore_accepting(
        &mut self,
        path: impl AsRef<Path>,
        parts: &[&str],
    ) -> Result<Vec<String>, CheckpointError> {
        let path = path.as_ref();
        self.restore_from(path, &read(path)?, parts)
    }

    /// The box of the saved run if it has grown from the box of this one.
    fn grown_to(&self, saved: &Identity) -> Option<GridSpec> {
        let GridSpec::Growing { nx, ny, .. } = self.scene.grid else { return None };
        let grid = saved.grid()?;
        let wider = |now: usize, then: usize| then > now && then.is_multiple_of(now);
        match grid {
            GridSpec::Growing { nx: columns, ny: rows, .. }
                if (wider(nx, columns) || columns == nx)
                    && (wider(ny, rows) || rows == ny)
                    && (columns, rows) != (nx, ny) =>
            {
                Some(grid)
            }
            _ => None,
        }
    }

    /// The key of a body whose initial heights are not those of `saved`.
    fn other_heights(&self, saved: &[BodyPart<'_>; 2]) -> Option<&'static str> {
        // A box that has grown combines heights of two generations: they cannot be compared.
        let names = ["ball_heights", "disc_heights"].into_iter().filter(|_| !self.scene.grid.grows());
        let mut bodies = names.zip(self.bodies.iter().zip(saved));
        bodies.find(|(_, (own, saved))| !same_bits(own.initial(), &saved.initial)).map(|(name, _)| name)
    }

    /// Restores the state from the `bytes` of the file at `path`, which may differ in the parts `allowed`.
    /// Returns the parts that differ.
    fn restore_from(
        &mut self,
        path: &Path,
        bytes: &[u8],
        allowed: &[&str],
    ) -> Result<Vec<String>, CheckpointError> {
        let content = checked_content(path, bytes)?;
        let damaged = |reason: String| CheckpointError::Damaged { path: path.to_owned(), reason };
        let content: Content<'_> =
            postcard::from_bytes(content).map_err(|error| damaged(error.to_string()))?;
        if let Some(grid) = self.grown_to(&content.identity) {
            let mut wide = self.rebuilt(grid).map_err(|error| damaged(error.to_string()))?;
            let differences = wide.restore_from(path, bytes, allowed)?;
            *self = wide;
            return Ok(differences);
        }
        let own = self.identity().map_err(|error| damaged(error.to_string()))?;
        let differences = own.differences(&content.identity);
        let other =
            |part: String, detail: String| CheckpointError::Other { path: path.to_owned(), part, detail };
        if !differences.iter().all(|part| allowed.contains(&part.as_str())) {
            return Err(other(differences.join(", "), own.details(&content.identity)));
        }
        if let Some(name) = self.other_heights(&content.bodies) {
            return Err(other(name.to_owned(), String::new()));
        }
        let grid = self.contact.grid;
        let law = self.laws.growth.as_deref();
        let Content {
            bodies: [ball, disc],
            state,
            squeeze_memory,
            time,
            step,
            draws,
            film_rises,
            warnings,
            ..
        } = content;
        let bodies =
            ball.into_body(law, grid.len()).and_then(|ball| Ok([ball, disc.into_body(law, grid.len())?]));
        let bodies = bodies.map_err(|error| damaged(error.to_string()))?;
        state
            .validate(&grid)
            .and_then(|()| squeeze_memory.validate(&grid))
            .and_then(|()| InputError::require_non_negative("time", time))
            .and_then(|()| validate_rises(film_rises.as_deref(), &grid))
            .map_err(|error| damaged(error.to_string()))?;
        self.bodies = bodies;
        self.backup.clone_from(&self.bodies);
        self.state = state.into_owned();
        self.squeeze_memory = squeeze_memory.into_owned();
        (self.time, self.step, self.draws) = (time, step, draws);
        self.restore_heat(film_rises);
        self.restore_warnings(warnings.into_owned(), !differences.is_empty());
        Ok(differences)
    }

    /// Restores the temperature rises of the film. Under other conditions the film may have been isothermal: they start at
    /// zero.
    fn restore_heat(&mut self, rises: Option<Cow<'_, [f64]>>) {
        let Some(heat) = &mut self.film_heat else { return };
        match rises {
            Some(rises) => heat.set_start(rises.into_owned()),
            None => drop(heat.take_start()),
        }
    }

    /// Restores the `warnings`. Where conditions differ, those of this simulation remain beside them.
    fn restore_warnings(&mut self, mut warnings: Vec<Warning>, differs: bool) {
        let own = std::mem::take(&mut self.warnings);
        if differs {
            warnings.extend(own.into_iter().filter(|own| !warnings.contains(own)).collect::<Vec<_>>());
        }
        self.warnings = warnings;
    }
}

/// Whether two fields agree to the last bit.
fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}
