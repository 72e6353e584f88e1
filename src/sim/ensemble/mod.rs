//! Ensembles of histories: parameter sweeps, seeds of the roughness.
//!
//! [`run`] returns the records. `run_in` (features `serde` and `npz`) also writes a folder for each member and
//! continues an interrupted run. Members are independent: each history equals that of a single run, and an
//! error stops its own member only. With the feature `mpi`, `run_over_ranks` distributes members over the
//! processes of an MPI program. Outcomes have the order of the members, for any number of threads.

#[cfg(feature = "mpi")]
mod over_ranks;

use std::ops::ControlFlow;
#[cfg(all(feature = "serde", feature = "npz"))]
use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

#[cfg(all(feature = "serde", feature = "npz"))]
use crate::error::InputError;
use crate::sim::error::SimError;
#[cfg(all(feature = "serde", feature = "npz"))]
use crate::sim::files::run_folder::RunFolder;
use crate::sim::history::builder::SimBuilder;
#[cfg(all(feature = "serde", feature = "npz"))]
use crate::sim::history::observer::Observer;
use crate::sim::history::record::StepRecord;
use crate::sim::history::simulation::MixedLubricationSim;
use crate::sim::scene::Scene;

#[cfg(feature = "mpi")]
pub use over_ranks::run_over_ranks;

/// One history of an ensemble.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::ensemble::Member;
/// let seeds = (1..=3).map(|seed| {
///     let mut scene = Scene::azam_2019(16);
///     scene.track.seed = seed;
///     Member::new(format!("seed_{seed}"), scene, 2, 10.0)
/// });
/// assert_eq!(seeds.map(|member| member.name).collect::<Vec<_>>(), ["seed_1", "seed_2", "seed_3"]);
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Member {
    /// Name of the member and of its folder.
    pub name: String,
    /// The scene.
    pub scene: Scene,
    /// Number of steps.
    pub steps: u64,
    /// Length of a step \[s\].
    pub time_step: f64,
}

impl Member {
    /// The history of `scene` in `steps` steps of `time_step` \[s\], in the folder `name`.
    pub fn new(name: impl Into<String>, scene: Scene, steps: u64, time_step: f64) -> Self {
        Self { name: name.into(), scene, steps, time_step }
    }
}

impl Member {
    /// The builder of its simulation.
    fn builder(&self) -> SimBuilder {
        MixedLubricationSim::builder(self.scene.clone())
    }
}

/// Result of a member.
#[derive(Debug)]
#[non_exhaustive]
pub struct Outcome {
    /// The committed steps.
    pub records: Vec<StepRecord>,
    /// Error that stopped it before its last step.
    pub failure: Option<SimError>,
}

/// Runs `members` on `threads` threads (at least one).
///
/// ```
/// use stribeck::sim::ensemble::{self, Member};
/// use stribeck::sim::Scene;
/// let members: Vec<Member> = [1.0e9, -1.0, 1.15e9]
///     .map(|pressure| {
///         let mut scene = Scene::azam_2019(32);
///         scene.load.hertz_pressure = Some(pressure);
///         Member::new(format!("{pressure:e}"), scene, 1, 10.0)
///     })
///     .into();
/// let outcomes = ensemble::run(&members, 2);
/// let wear = |k: usize| outcomes[k].records[0].wear.disc_mean;
/// assert!(wear(0) < wear(2));
/// // The second cannot be built; the others are not affected.
/// let failure = outcomes[1].failure.as_ref().map(ToString::to_string).unwrap_or_default();
/// assert!(failure.starts_with("load.hertz_pressure = -1"));
/// ```
pub fn run(members: &[Member], threads: usize) -> Vec<Outcome> {
    share(members, threads, |member| {
        let mut records = Vec::with_capacity(usize::try_from(member.steps).unwrap_or(0).min(1 << 16));
        let outcome = member.builder().build().and_then(|mut sim| {
            sim.run(member.steps, member.time_step, &mut |_: &MixedLubricationSim, record: &StepRecord| {
                records.push(record.clone());
                ControlFlow::Continue(())
            })
        });
        Outcome { records, failure: outcome.err() }
    })
}

/// Runs `members` on `threads` threads and writes each into a folder of its name in `folder`, with a
/// checkpoint after each `every` steps (see [`RunFolder`]). A second call continues from the checkpoints of
/// an interrupted one; finished members are read, not computed again.
///
/// # Errors
/// A name that is taken, empty or not valid for a folder. Other errors are in the outcome of the member.
#[cfg(all(feature = "serde", feature = "npz"))]
pub fn run_in(
    folder: impl AsRef<Path>,
    members: &[Member],
    threads: usize,
    every: u64,
) -> Result<Vec<Outcome>, SimError> {
    let folder = folder.as_ref();
    check_names(members)?;
    Ok(share(members, threads, |member| run_member(folder, member, every)))
}

#[cfg(all(feature = "serde", feature = "npz"))]
fn check_names(members: &[Member]) -> Result<(), InputError> {
    let mut taken = std::collections::BTreeSet::new();
    for member in members {
        let name = member.name.as_str();
        let plain = !name.is_empty() && name != "." && name != ".." && !name.contains(['/', '\\', '\0']);
        if !plain || !taken.insert(name) {
            return Err(InputError::Conflict {
                field: format!("name \"{name}\" of a member"),
                reason: "every member needs the name of a folder of its own".to_owned(),
            });
        }
    }
    Ok(())
}

#[cfg(all(feature = "serde", feature = "npz"))]
fn run_member(folder: &Path, member: &Member, every: u64) -> Outcome {
    let mut records = Vec::new();
    let mut run = || {
        let mut sim = member.builder().build()?;
        let (mut files, before) = RunFolder::resume(folder.join(&member.name), &mut sim, every)?;
        records = before;
        let left = member.steps.saturating_sub(sim.steps());
        let outcome =
            sim.run(left, member.time_step, &mut |sim: &MixedLubricationSim, record: &StepRecord| {
                records.push(record.clone());
                files.after_step(sim, record)
            });
        // The files of a history that failed are finished too.
        files.finish(&sim).and(outcome)
    };
    let failure = run().err();
    Outcome { records, failure }
}

/// Maps `members` in order; each free thread takes the next one.
fn share<T: Send>(members: &[Member], threads: usize, work: impl Fn(&Member) -> T + Sync) -> Vec<T> {
    let slots: Vec<Mutex<Option<T>>> = members.iter().map(|_| Mutex::new(None)).collect();
    let next = AtomicUsize::new(0);
    let take = || {
        while let Some((member, slot)) = {
            let k = next.fetch_add(1, Ordering::Relaxed);
            members.get(k).zip(slots.get(k))
        } {
            let result = work(member);
            if let Ok(mut slot) = slot.lock() {
                *slot = Some(result);
            }
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads.min(members.len()) {
            scope.spawn(take);
        }
        take();
    });
    slots.into_iter().filter_map(|slot| slot.into_inner().ok().flatten()).collect()
}
