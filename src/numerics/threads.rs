//! The threads of a process.
//!
//! A process that is forked has none of the threads of its parent, so that work sent to them would wait without
//! end. Each process has a pool of its own, made at the first field that is large enough, and found by the id of
//! the process. Within a pool of the caller (`ThreadPool::install`) that pool is used.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, RwLock};

use rayon::{ThreadPool, ThreadPoolBuilder};

/// The environment variable that sets the number of threads; `RAYON_NUM_THREADS` is read where it is absent.
const VARIABLE: &str = "STRIBECK_NUM_THREADS";

/// Most threads for each processor: a thousand threads on two processors hold each other up for minutes.
const MOST_PER_PROCESSOR: usize = 8;

/// Number of threads that was set; 0 for the default.
static WANTED: AtomicUsize = AtomicUsize::new(0);
/// The pool of the process that made it last.
static POOL: RwLock<Option<Pool>> = RwLock::new(None);

/// Threads of one process.
#[derive(Clone)]
struct Pool {
    /// Id of the process.
    process: u32,
    /// Value of [`WANTED`] when it was made.
    wanted: usize,
    threads: Arc<ThreadPool>,
}

impl Pool {
    /// Threads of this process; `None` where the system refuses them.
    fn new(process: u32, wanted: usize) -> Option<Self> {
        let of_variable = |name| std::env::var(name).ok()?.parse::<usize>().ok().filter(|number| *number > 0);
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let number = Some(wanted)
            .filter(|wanted| *wanted > 0)
            .or_else(|| of_variable(VARIABLE))
            .or_else(|| of_variable("RAYON_NUM_THREADS"))
            .map_or(processors, |number| number.min(MOST_PER_PROCESSOR * processors));
        let threads = ThreadPoolBuilder::new().num_threads(number).build().ok()?;
        Some(Self { process, wanted, threads: Arc::new(threads) })
    }

    fn is_of(&self, process: u32, wanted: usize) -> bool {
        self.process == process && self.wanted == wanted
    }
}

/// Sets the number of threads of later work in this process; 0 for the default, which is that of the environment
/// variable `STRIBECK_NUM_THREADS` or of `RAYON_NUM_THREADS`, else the number of processors, and at most eight times that number. Results do not
/// depend on it. Within a pool of `rayon` (`ThreadPool::install`) that pool counts.
///
/// ```
/// stribeck::set_num_threads(1);
/// let report = stribeck::sim::solve_contact(&stribeck::sim::Scene::azam_2019(32))?.report;
/// stribeck::set_num_threads(0);
/// assert!(report.residual.mass < 1e-5);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
pub fn set_num_threads(threads: usize) {
    WANTED.store(threads, Ordering::Relaxed);
}

/// The pool of this process. `None` where it cannot be had without waiting: another thread is making it, or
/// was when the process was forked. The work is then done on the calling thread.
fn pool() -> Option<Arc<ThreadPool>> {
    let (process, wanted) = (std::process::id(), WANTED.load(Ordering::Relaxed));
    if let Some(pool) = POOL.try_read().ok()?.as_ref().filter(|pool| pool.is_of(process, wanted)) {
        return Some(Arc::clone(&pool.threads));
    }
    let mut place = POOL.try_write().ok()?;
    let made = Pool::new(process, wanted)?;
    let threads = Arc::clone(&made.threads);
    if let Some(old) = place.replace(made).filter(|old| old.process != process) {
        // to end threads that this process does not have would wait for them
        std::mem::forget(old);
    }
    Some(threads)
}

/// Number of threads for large fields.
pub(super) fn count() -> usize {
    if rayon::current_thread_index().is_some() {
        return rayon::current_num_threads();
    }
    pool().map_or(1, |pool| pool.current_num_threads())
}

/// Results of two closures that may run in parallel.
pub(super) fn join<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    if rayon::current_thread_index().is_some() {
        return rayon::join(first, second);
    }
    match pool() {
        Some(pool) => pool.install(|| rayon::join(first, second)),
        None => (first(), second()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pool_has_at_most_eight_threads_for_each_processor() {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        for (wanted, expected) in [(3, 3), (1000, 1000.min(MOST_PER_PROCESSOR * processors))] {
            let pool = Pool::new(0, wanted).map(|pool| pool.threads.current_num_threads());
            assert_eq!(pool, Some(expected));
        }
    }
}
