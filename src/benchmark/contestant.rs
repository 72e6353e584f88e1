//! Contestants: solvers, or variants of a solver, by name.

use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

use serde::Deserialize as _;
use toml::{Table, Value};

use crate::error::InputError;
use crate::reynolds::{ContactSolver, LubricatedContact, NewtonKrylov, NewtonSettings};
use crate::sim::Scene;
use crate::sim::scene::{SolverKind, SolverSpec};

/// Makes the solver of a contact.
type Make = dyn Fn(&LubricatedContact<'_>) -> Box<dyn ContactSolver> + Send + Sync;
/// Changes a scene before it is solved.
type Change = dyn Fn(&mut Scene) + Send + Sync;

/// A solver that takes part in a [`Benchmark`](super::Benchmark).
///
/// ```
/// use stribeck::benchmark::Contestant;
/// use stribeck::reynolds::{FaceMobility, NewtonKrylov};
/// let own = Contestant::new("own", |_problem| Box::new(NewtonKrylov::new()));
/// let tight = Contestant::named("newton_krylov:krylov_tolerance=0.01,face_mobility=wedge")?;
/// let same = own.with_name("own, wedge").with_scene(|scene| scene.solver.face_mobility = Some(FaceMobility::Wedge));
/// assert_eq!(same.name(), "own, wedge");
/// let error = Contestant::named("newton_krylov:krylov=0.01").unwrap_err();
/// assert!(error.to_string().contains("unknown key `krylov`"), "{error}");
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Clone)]
pub struct Contestant {
    name: String,
    make: Maker,
    changes: Vec<Arc<Change>>,
}

/// Origin of a solver.
#[derive(Clone)]
pub(super) enum Maker {
    /// The solver that the scene names.
    OfScene,
    /// Newton's method with these settings.
    Newton(NewtonSettings),
    /// A custom solver.
    Custom(Arc<Make>),
}

impl fmt::Debug for Contestant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Contestant").field(&self.name).finish()
    }
}

impl Contestant {
    /// The contestant `name` whose solver is made by `make` for each case, with new buffers.
    pub fn new(
        name: impl Into<String>,
        make: impl Fn(&LubricatedContact<'_>) -> Box<dyn ContactSolver> + Send + Sync + 'static,
    ) -> Self {
        Self { name: name.into(), make: Maker::Custom(Arc::new(make)), changes: Vec::new() }
    }

    /// Newton's method with `settings`.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn newton(name: impl Into<String>, settings: NewtonSettings) -> Result<Self, InputError> {
        settings.validate()?;
        Ok(Self { name: name.into(), make: Maker::Newton(settings), changes: Vec::new() })
    }

    /// A solver of the crate by its name in scene files: `auto`, `newton_krylov`, `semi_system`, `multigrid`,
    /// `dry`. Settings follow after a colon, `newton_krylov:halvings=1,face_mobility=wedge`: those of
    /// [`NewtonSettings`] for `newton_krylov`, and the keys of the table `[solver]` of scene files for all.
    ///
    /// # Errors
    /// An unknown solver or key, a value out of range.
    pub fn named(text: &str) -> Result<Self, InputError> {
        let (solver, settings) = text.split_once(':').unwrap_or((text, ""));
        let kind = Table::from_iter([("kind".to_owned(), Value::String(solver.trim().to_owned()))]);
        let kind = spec(kind).map_err(|error| refused(text, &error))?.kind;
        let (mut newton, mut table) = (NewtonSettings::default(), Table::new());
        for setting in settings.split(',').map(str::trim).filter(|setting| !setting.is_empty()) {
            let parts = setting.split_once('=').map(|(key, value)| (key.trim(), value.trim()));
            let (key, value) =
                parts.ok_or_else(|| refused(text, &format!("`{setting}` is not KEY=VALUE")))?;
            let is_newton = kind == SolverKind::NewtonKrylov
                && set(&mut newton, key, value).map_err(|reason| refused(text, &reason))?;
            if !is_newton {
                if ["kind", "tolerance", "model"].contains(&key) {
                    return Err(refused(text, &format!("`{key}` is no setting of a contestant")));
                }
                table.insert(key.to_owned(), plain(value));
            }
        }
        newton.validate()?;
        spec(table.clone()).map_err(|error| refused(text, &error))?;
        let is_default = newton == NewtonSettings::default();
        let make = if is_default { Maker::OfScene } else { Maker::Newton(newton) };
        let change = move |scene: &mut Scene| change(scene, kind, &table);
        Ok(Self { name: text.to_owned(), make, changes: vec![Arc::new(change)] })
    }

    /// Replaces the name.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Changes the scene of each case before it is solved, after earlier changes: another discretization, for
    /// example.
    #[must_use]
    pub fn with_scene(mut self, change: impl Fn(&mut Scene) + Send + Sync + 'static) -> Self {
        self.changes.push(Arc::new(change));
        self
    }

    /// The name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The scene as the contestant solves it.
    pub(super) fn changed(&self, mut scene: Scene) -> Scene {
        self.changes.iter().for_each(|change| change(&mut scene));
        scene
    }

    pub(super) fn maker(&self) -> &Maker {
        &self.make
    }
}

impl FromStr for Contestant {
    type Err = InputError;

    /// As [`Contestant::named`].
    fn from_str(text: &str) -> Result<Self, InputError> {
        Self::named(text)
    }
}

impl Maker {
    /// The solver of a contact of `scene`.
    pub(super) fn solver(
        &self,
        scene: &Scene,
        problem: &LubricatedContact<'_>,
    ) -> Result<Box<dyn ContactSolver>, InputError> {
        match self {
            Self::OfScene => crate::sim::solver_of(scene),
            Self::Newton(settings) => Ok(Box::new(NewtonKrylov::with_settings(settings.clone())?)),
            Self::Custom(make) => Ok(make(problem)),
        }
    }
}

/// The table `[solver]` of a scene.
fn spec(table: Table) -> Result<SolverSpec, String> {
    SolverSpec::deserialize(table).map_err(|error| {
        let message = error.message().lines().next().unwrap_or_default();
        message.replace("unknown field", "unknown key").replace("unknown variant", "unknown value")
    })
}

/// Sets solver and keys in a scene. The table was checked before.
fn change(scene: &mut Scene, kind: SolverKind, table: &Table) {
    let Ok(mut all) = Table::try_from(scene.solver) else { return };
    all.extend(table.clone());
    if let Ok(solver) = spec(all) {
        scene.solver = solver.with_kind(kind);
    }
}

/// A number, a boolean, or text.
fn plain(value: &str) -> Value {
    if let Ok(number) = value.parse() {
        return Value::Integer(number);
    }
    value
        .parse()
        .map(Value::Float)
        .or_else(|_| value.parse().map(Value::Boolean))
        .unwrap_or_else(|_| Value::String(value.to_owned()))
}

/// Sets a setting of Newton's method. Returns whether it is one.
fn set(settings: &mut NewtonSettings, key: &str, value: &str) -> Result<bool, String> {
    let unfit = || format!("`{value}` is no value of `{key}`");
    let number = || value.parse::<f64>().map_err(|_| unfit());
    match key {
        "step_bound" => settings.step_bound = number()?,
        "krylov_tolerance" => settings.krylov_tolerance = number()?,
        "first_contact_film" => settings.first_contact_film = number()?,
        "pseudo_transient" => settings.pseudo_transient.0 = number()?,
        "pseudo_transient_reduction" => settings.pseudo_transient.1 = number()?,
        "warm_start_threshold" => settings.warm_start_threshold = number()?,
        "least_film_ratio" => settings.least_film_ratio = number()?,
        "stall_window" => settings.stall_window = value.parse().map_err(|_| unfit())?,
        "halvings" => settings.halvings = value.parse().map_err(|_| unfit())?,
        _ => return Ok(false),
    }
    Ok(true)
}

fn refused(text: &str, reason: &str) -> InputError {
    InputError::Conflict { field: format!("contestant \"{text}\""), reason: reason.to_owned() }
}
