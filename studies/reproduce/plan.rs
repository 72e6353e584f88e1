//! Which histories are run, and running them.

use std::collections::VecDeque;
use std::sync::{Mutex, PoisonError};

use crate::case_run::Run;
use crate::cases::{CASES, Case, TEST_TIME};
use crate::history;
use crate::options::Options;

/// Length of a step of a quick run \[s\].
const QUICK_STEP: f64 = 10.0;

/// The histories that the options ask for, in the order in which they are run: with few seeds of every
/// variant before all seeds of any.
pub(crate) fn runs(options: &Options) -> Vec<Run> {
    let cases: Vec<Case> =
        CASES.iter().map(|case| if options.quick { case.quick() } else { *case }).collect();
    let wanted = |case: &&Case| options.case.as_ref().is_none_or(|name| name == case.name);
    let mut runs = Vec::new();
    for seed in 1..=options.seeds {
        for case in cases.iter().filter(wanted).filter(|case| seed <= case.seeds) {
            let time_step = if options.quick { QUICK_STEP } else { TEST_TIME / case.steps as f64 };
            runs.extend([true, false].map(|film| Run { case: *case, seed, film, time_step }));
        }
    }
    runs
}

/// Runs those that have not ended yet.
///
/// # Errors
/// A file that cannot be written, a scene that cannot be built. A history that ends early is noted in its
/// folder.
pub(crate) fn execute(runs: &[Run], options: &Options) -> Result<(), String> {
    let missing: VecDeque<&Run> = runs.iter().filter(|run| !history::has_ended(run, options)).collect();
    println!("{} of {} histories have ended", runs.len() - missing.len(), runs.len());
    let queue = Mutex::new((missing, None));
    std::thread::scope(|scope| {
        for _ in 0..options.threads {
            scope.spawn(|| work(&queue, options));
        }
    });
    queue.into_inner().unwrap_or_else(PoisonError::into_inner).1.map_or(Ok(()), Err)
}

type Queue<'a> = Mutex<(VecDeque<&'a Run>, Option<String>)>;

/// Takes runs until none is left or one cannot be written. Histories side by side use the processors better
/// than the parts of one, so that each has one thread.
fn work(queue: &Queue<'_>, options: &Options) {
    let locked = || queue.lock().unwrap_or_else(PoisonError::into_inner);
    let pool = match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool,
        Err(error) => {
            locked().1 = Some(error.to_string());
            return;
        }
    };
    loop {
        let next = {
            let mut queue = locked();
            if queue.1.is_some() { None } else { queue.0.pop_front() }
        };
        let Some(run) = next else { return };
        let name = run.folder(options);
        match pool.install(|| history::run(run, options)) {
            Ok(line) => println!("{}: {line}", name.display()),
            Err(error) => locked().1 = Some(format!("{}: {error}", name.display())),
        }
    }
}
