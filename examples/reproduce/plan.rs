//! Which histories are run, and running them.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use stribeck::sim::scene::{Flash, Roughness, TrackMotion};
use stribeck::sim::{MixedLubricationSim, Scene, SimError};

use crate::choices::{BASE, CHOICES, Choice, LONG_STEPS, NO_FLIP};
use crate::history;
use crate::options::Options;

/// Bound of every residual of a solve: one solve stands for hundreds of passages at one position of the roughness,
/// and columns scatter by some 10 % from one position to the next.
const TOLERANCE: f64 = 1e-3;

/// Added to the steps of convected roughness \[s\]: a body carries its periodic patch past in 5 ms, and steps that are
/// multiples of it would find the patches where they were.
const OFF_BEAT: f64 = 3.09e-3;

/// One history.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    pub(crate) choice: &'static Choice,
    pub(crate) seed: u64,
    pub(crate) grid: usize,
    pub(crate) film: bool,
}

impl Run {
    /// Stem of its files.
    pub(crate) fn stem(&self, options: &Options) -> PathBuf {
        let film = if self.film { "with" } else { "without" };
        options.out.join(format!("{}_{}_seed{}_{film}", self.choice.name, self.grid, self.seed))
    }

    pub(crate) fn steps(&self, options: &Options) -> u64 {
        ((options.steps as f64 / self.choice.time_step).round() as u64).max(1)
    }

    pub(crate) fn time_step(&self, options: &Options) -> f64 {
        let time_step = options.time_step * self.choice.time_step;
        match self.choice.motion {
            TrackMotion::Carried => time_step + OFF_BEAT,
            _ => time_step,
        }
    }

    pub(crate) fn build(&self) -> Result<MixedLubricationSim, SimError> {
        let mut scene = Scene::azam_2019(self.grid);
        if self.film {
            scene = scene.with_tribofilm();
        }
        // Below a kelvin, but then the history can say so.
        scene.thermal.flash = Flash::On;
        scene.solver.tolerance = TOLERANCE;
        let bodies = [&mut scene.roughness.ball, &mut scene.roughness.disc];
        for (roughness, seed) in bodies.into_iter().zip([2 * self.seed - 1, 2 * self.seed]) {
            if let Roughness::Gaussian(random) = roughness {
                random.seed = seed;
            }
        }
        (scene.track.motion, scene.track.seed) = (self.choice.motion, self.seed);
        (self.choice.flip)(&mut scene);
        MixedLubricationSim::builder(scene).build()
    }
}

/// All histories that the options ask for, pairs side by side, those that take longest first.
pub(crate) fn runs(options: &Options) -> Vec<Run> {
    let mut pairs: Vec<(&'static Choice, u64, usize)> = Vec::new();
    if options.fine {
        pairs.extend([(&LONG_STEPS, 1, 2 * options.grid), (&LONG_STEPS, 1, options.grid)]);
    }
    if options.choices {
        pairs.extend([&NO_FLIP].into_iter().chain(&CHOICES).map(|choice| (choice, 1, options.grid)));
    }
    pairs.extend((1..=options.seeds).map(|seed| (&BASE, seed, options.grid)));
    let both = |(choice, seed, grid)| [true, false].map(|film| Run { choice, seed, grid, film });
    pairs.into_iter().flat_map(both).collect()
}

/// Runs those that are not there yet.
///
/// # Errors
/// A file that cannot be written, a scene that cannot be built. A history that ends early is noted in its files.
pub(crate) fn execute(runs: &[Run], options: &Options) -> Result<(), String> {
    std::fs::create_dir_all(&options.out).map_err(|error| format!("{}: {error}", options.out.display()))?;
    let missing: VecDeque<&Run> = runs.iter().filter(|run| !history::is_there(run, options)).collect();
    println!("{} of {} histories are there", runs.len() - missing.len(), runs.len());
    let (total, queue) = (missing.len(), Mutex::new(missing));
    let failure: Mutex<Option<String>> = Mutex::new(None);
    std::thread::scope(|scope| {
        for _ in 0..options.threads {
            scope.spawn(|| {
                // Histories side by side use the processors better than the parts of one.
                let pool = match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
                    Ok(pool) => pool,
                    Err(error) => {
                        *failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error.to_string());
                        return;
                    }
                };
                loop {
                    let next = queue.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
                    let Some(run) = next else { return };
                    let outcome = pool.install(|| history::write(run, options));
                    let left = queue.lock().unwrap_or_else(PoisonError::into_inner).len();
                    match outcome {
                        Ok(line) => println!("[{}/{total}] {line}", total - left),
                        Err(error) => {
                            *failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                            queue.lock().unwrap_or_else(PoisonError::into_inner).clear();
                        }
                    }
                }
            });
        }
    });
    failure.into_inner().unwrap_or_else(PoisonError::into_inner).map_or(Ok(()), Err)
}
