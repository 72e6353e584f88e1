//! Checkpoints: the complete state of a simulation in one file, exact to the last bit.
//!
//! | bytes | content |
//! |---|---|
//! | 0..20 | `stribeck checkpoint\n` |
//! | 20..24 | format version, little-endian |
//! | 24..32 | length of the content, little-endian |
//! | 32..36 | CRC-32 of the content, little-endian |
//! | 36.. | content in the `postcard` format |

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::error::InputError;
use crate::grid::Grid;
use crate::plastic::PlasticDepth;
use crate::regular_file;
use crate::reynolds::ContactState;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::CheckpointError;
use crate::sim::files::atomic_file;
use crate::sim::history::body::Body;
use crate::sim::history::identity::{CONDITIONS, Identity};
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::history::squeeze_memory::SqueezeMemory;
use crate::sim::scene::GridSpec;
use crate::tribochem::{FilmGrowthLaw, Tribofilm};
use crate::wear::WearDepth;

/// Name of a checkpoint in memory, for error messages.
const IN_MEMORY: &str = "checkpoint in memory";
/// First bytes of a checkpoint file.
const MAGIC: &[u8; 20] = b"stribeck checkpoint\n";
/// Format version that this version of the crate writes and reads.
const FORMAT: u32 = 9;
/// Bytes before the content.
const HEADER: usize = 36;

/// Checks the temperature rises of the film on both surfaces.
fn validate_rises(rises: Option<&[f64]>, grid: &Grid) -> Result<(), InputError> {
    let Some(rises) = rises else { return Ok(()) };
    InputError::require_len("film rises", rises, 2 * grid.len())?;
    InputError::require_finite("film rises", rises)
}

/// State of a body.
#[derive(Serialize, Deserialize)]
struct BodyPart<'a> {
    /// Initial heights; a simulation that resumes must have the same ones.
    initial: Cow<'a, [f64]>,
    /// Heights at the time of the checkpoint.
    surface: Cow<'a, [f64]>,
    /// Worn depth.
    wear: Cow<'a, [f64]>,
    /// Plastic depth.
    plastic: Cow<'a, [f64]>,
    /// The tribofilm, if there is one.
    film: Option<FilmPart<'a>>,
    /// Worn volume.
    worn_volume: f64,
}

/// State of a tribofilm.
#[derive(Serialize, Deserialize)]
struct FilmPart<'a> {
    /// State variables of the growth law, node by node.
    states: Cow<'a, [f64]>,
    /// Total thickness that the nodes have gained and lost \[m\].
    changes: [f64; 2],
}

/// All state that later steps depend on, and the identity of the run.
#[derive(Serialize, Deserialize)]
struct Content<'a> {
    /// Scene and parts that the simulation was built from.
    identity: Identity,
    /// Ball and disc.
    bodies: [BodyPart<'a>; 2],
    /// Solution of the last step: with squeeze, the next step starts from it.
    state: Cow<'a, ContactState>,
    /// The last two contacts.
    squeeze_memory: Cow<'a, SqueezeMemory>,
    /// Simulated time \[s\].
    time: f64,
    /// Number of committed steps.
    step: u64,
    /// Number of roughness positions tried so far.
    draws: u64,
    /// Initial temperature rise of the film in the next contact \[K\]; `None` for an isothermal film.
    film_rises: Option<Cow<'a, [f64]>>,
    /// Warnings so far.
    warnings: Cow<'a, [Warning]>,
}

impl<'a> BodyPart<'a> {
    /// The state of `body`.
    fn of(body: &'a Body) -> Self {
        Self {
            initial: body.initial().into(),
            surface: body.surface().into(),
            wear: body.wear().into(),
            plastic: body.plastic_depth().into(),
            film: body
                .film
                .as_ref()
                .map(|film| FilmPart { states: film.states().into(), changes: film.changes() }),
            worn_volume: body.worn_volume,
        }
    }

    /// Rebuilds the body, with a film that grows by `law`. Rejects fields that do not have `n` finite values.
    fn into_body(self, law: Option<&dyn FilmGrowthLaw>, n: usize) -> Result<Body, InputError> {
        let mut body = Body::new(self.initial.into_owned(), None);
        body.wear = WearDepth::from_values(self.wear.into_owned())?;
        body.plastic = PlasticDepth::from_values(self.plastic.into_owned())?;
        body.film = match (law, self.film) {
            (Some(law), Some(film)) => {
                Some(Tribofilm::from_states(law, film.states.into_owned(), film.changes)?)
            }
            (None, None) => None,
            _ => {
                return Err(InputError::Conflict {
                    field: "tribofilm".to_owned(),
                    reason: "there is a law or a film, not both".to_owned(),
                });
            }
        };
        body.surface = self.surface.into_owned();
        InputError::require_non_negative("worn volume", self.worn_volume)?;
        body.worn_volume = self.worn_volume;
        for (field, values) in [
            ("initial heights", body.initial()),
            ("surface", body.surface()),
            ("wear", body.wear()),
            ("plastic depth", body.plastic_depth()),
            ("tribofilm", body.tribofilm()),
        ] {
            InputError::require_len(field, values, n)?;
            InputError::require_finite(field, values)?;
        }
        Ok(body)
    }
}

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
        let mut bytes = Vec::with_capacity(HEADER + content.len());
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&FORMAT.to_le_bytes());
        bytes.extend_from_slice(&(content.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&crc32fast::hash(&content).to_le_bytes());
        bytes.extend_from_slice(&content);
        Ok(bytes)
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

/// The bytes of a file. Their number is not bounded: it depends on the grid.
fn read(path: &Path) -> Result<Vec<u8>, CheckpointError> {
    let io = |source| CheckpointError::Io { path: path.to_owned(), source };
    if !regular_file::begins_with(path, MAGIC).map_err(io)? {
        return Err(CheckpointError::Foreign { path: path.to_owned() });
    }
    regular_file::read(path, u64::MAX).map_err(io)
}

/// Whether two fields agree to the last bit.
fn same_bits(a: &[f64], b: &[f64]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits())
}

/// The content after a valid header.
fn checked_content<'a>(path: &Path, bytes: &'a [u8]) -> Result<&'a [u8], CheckpointError> {
    let damaged =
        |reason: &str| CheckpointError::Damaged { path: path.to_owned(), reason: reason.to_owned() };
    let Some(rest) = bytes.strip_prefix(MAGIC) else {
        return Err(CheckpointError::Foreign { path: path.to_owned() });
    };
    let Some((header, content)) = rest.split_first_chunk::<{ HEADER - MAGIC.len() }>() else {
        return Err(damaged("it ends within its header"));
    };
    let [f0, f1, f2, f3, length @ .., c0, c1, c2, c3] = header;
    let found = u32::from_le_bytes([*f0, *f1, *f2, *f3]);
    if found > FORMAT {
        return Err(CheckpointError::Newer { path: path.to_owned(), found, known: FORMAT });
    }
    if found < FORMAT {
        return Err(damaged("its format is not one that this version reads"));
    }
    if length != (content.len() as u64).to_le_bytes().as_slice() {
        return Err(damaged("its length is not the one it was written with"));
    }
    if crc32fast::hash(content) != u32::from_le_bytes([*c0, *c1, *c2, *c3]) {
        return Err(damaged("its checksum does not fit"));
    }
    Ok(content)
}
