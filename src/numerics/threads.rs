//! The threads of a process.
//!
//! A process that is forked has none of the threads of its parent, so that work sent to them would wait without
//! end. Each process has a pool of its own, made at the first field that is large enough, and found by the id of
//! the process. Within a pool of the caller (`ThreadPool::install`) that pool is used.
//!
//! The calling thread takes part in the work, so the pool has one thread less than the number that is set. A caller
//! that left all work to the pool would sleep in each loop, and wake slowly on virtual machines.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

use rayon::{Scope, ThreadPool, ThreadPoolBuilder};

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
    /// The threads beside the calling one; `None` where that works alone.
    others: Option<Arc<Helpers>>,
}

/// Threads that help callers outside of a pool.
struct Helpers {
    threads: ThreadPool,
    /// Threads that callers have asked for and that have not ended.
    busy: AtomicUsize,
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
        let others = match number - 1 {
            0 => None,
            others => {
                let threads = ThreadPoolBuilder::new().num_threads(others).build().ok()?;
                Some(Arc::new(Helpers { threads, busy: AtomicUsize::new(0) }))
            }
        };
        Some(Self { process, wanted, others })
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

/// The pool of this process. `None` for one thread, and where the pool cannot be had without waiting: another thread
/// is making it, or was when the process was forked. The work is then done on the calling thread.
fn pool() -> Option<Arc<Helpers>> {
    let (process, wanted) = (std::process::id(), WANTED.load(Ordering::Relaxed));
    if let Some(pool) = POOL.try_read().ok()?.as_ref().filter(|pool| pool.is_of(process, wanted)) {
        return pool.others.clone();
    }
    let mut place = POOL.try_write().ok()?;
    let made = Pool::new(process, wanted)?;
    let others = made.others.clone();
    if let Some(old) = place.replace(made).filter(|old| old.process != process) {
        // to end threads that this process does not have would wait for them
        std::mem::forget(old);
    }
    others
}

/// Number of threads for large fields, the calling one among them.
pub(super) fn count() -> usize {
    if rayon::current_thread_index().is_some() {
        return rayon::current_num_threads();
    }
    pool().map_or(1, |pool| pool.threads.current_num_threads() + 1)
}

/// Runs `work` on all `tasks` in any order, on the calling thread and on others that are free.
pub(super) fn for_each_task<T: Send>(tasks: Vec<T>, work: impl Fn(T) + Sync) {
    let others = tasks.len().min(count()).saturating_sub(1);
    let queue = Mutex::new(tasks.into_iter());
    // The queue is locked while a task is taken, not while it runs.
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let run = || std::iter::from_fn(next).for_each(&work);
    share(others, run, &run);
}

/// Result of `own` on the calling thread; `other` runs on another thread that is free, or after it.
pub(super) fn join<A>(own: impl FnOnce() -> A, other: impl FnOnce() + Send) -> A {
    let other = Mutex::new(Some(other));
    let run = || {
        let taken = other.lock().unwrap_or_else(PoisonError::into_inner).take();
        if let Some(other) = taken {
            other();
        }
    };
    let others = count().saturating_sub(1).min(1);
    let both = || {
        let result = own();
        run();
        result
    };
    share(others, both, &run)
}

/// Result of `own` on the calling thread, while up to `others` threads run `help`; waits for their end.
fn share<A>(others: usize, own: impl FnOnce() -> A, help: &(dyn Fn() + Sync)) -> A {
    if others == 0 {
        return own();
    }
    if rayon::current_thread_index().is_some() {
        let running = AtomicUsize::new(others);
        return rayon::in_place_scope(|scope| {
            ask_for_help(scope, others, help, &running);
            own()
        });
    }
    // Threads that help another caller would come late.
    let Some(pool) = pool() else { return own() };
    let free = pool.threads.current_num_threads().saturating_sub(pool.busy.load(Ordering::Relaxed));
    let others = others.min(free);
    if others == 0 {
        return own();
    }
    pool.busy.fetch_add(others, Ordering::Relaxed);
    let _end = CountDown { count: &pool.busy, by: others };
    let running = AtomicUsize::new(others);
    pool.threads.in_place_scope(|scope| {
        ask_for_help(scope, others, help, &running);
        let result = own();
        // The last tasks end within microseconds; a sleeping thread takes longer to wake.
        while running.load(Ordering::Acquire) > 0 {
            std::thread::yield_now();
        }
        result
    })
}

/// Lets `others` threads of the pool run `help`; counts `running` down as they end.
fn ask_for_help<'scope>(
    scope: &Scope<'scope>,
    others: usize,
    help: &'scope (dyn Fn() + Sync),
    running: &'scope AtomicUsize,
) {
    for _ in 0..others {
        scope.spawn(move |_| {
            let _end = CountDown { count: running, by: 1 };
            help();
        });
    }
}

/// Counts down when it is dropped, also by a panic.
struct CountDown<'a> {
    count: &'a AtomicUsize,
    by: usize,
}

impl Drop for CountDown<'_> {
    fn drop(&mut self) {
        self.count.fetch_sub(self.by, Ordering::Release);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pool_has_at_most_eight_threads_for_each_processor() {
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        for (wanted, expected) in [(3, 3), (1000, 1000.min(MOST_PER_PROCESSOR * processors))] {
            let others = Pool::new(0, wanted).and_then(|pool| pool.others);
            assert_eq!(others.map_or(0, |pool| pool.threads.current_num_threads()) + 1, expected);
        }
    }

    #[test]
    fn each_task_runs_once_within_and_outside_of_a_pool() {
        let pool = ThreadPoolBuilder::new().num_threads(3).build().unwrap();
        let run = || {
            let mut visits = vec![0; 100];
            for_each_task(visits.iter_mut().collect(), |visit| *visit += 1);
            assert!(visits.iter().all(|visits| *visits == 1));
            let mut other = 0;
            assert_eq!((join(|| 1, || other = 2), other), (1, 2));
        };
        run();
        pool.install(run);
    }

    #[test]
    fn a_panic_of_a_task_reaches_the_caller() {
        let result = std::panic::catch_unwind(|| for_each_task(vec![1, 2, 3, 4], |task| assert!(task != 3)));
        assert!(result.is_err());
    }
}
