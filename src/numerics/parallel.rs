//! Lines of a field distributed over threads. Without the feature `parallel`, and for small fields, the code
//! is serial.
//!
//! The lines are divided into chunks, each with its own workspace. The assignment of chunks to threads is
//! arbitrary, the operations on a line are not, and no sum runs over chunks: results are bit-identical to
//! serial ones.

/// Smallest number of nodes for which threads repay their overhead.
#[cfg(feature = "parallel")]
const PARALLEL_THRESHOLD: usize = 1 << 15;
/// Chunks per thread, for load balance when a thread is delayed.
pub(super) const CHUNKS_PER_THREAD: usize = 4;

/// Number of chunks, each with its own workspace, for fields of `nodes` values.
#[cfg(feature = "parallel")]
pub(crate) fn chunk_count(nodes: usize) -> usize {
    let threads = if nodes < PARALLEL_THRESHOLD { 1 } else { super::threads::count() };
    if threads < 2 { 1 } else { CHUNKS_PER_THREAD * threads }
}

/// One chunk without threads.
#[cfg(not(feature = "parallel"))]
pub(crate) fn chunk_count(_nodes: usize) -> usize {
    1
}

/// Divides the lines of `field`, `length` values each, into chunks. `work` receives the index of the first
/// line of a chunk, its lines and its workspace.
pub(super) fn for_each_chunk<T: Send, L: Send>(
    workspaces: &mut [L],
    field: &mut [T],
    length: usize,
    work: impl Fn(usize, &mut [T], &mut L) + Sync,
) {
    if let [workspace] = workspaces {
        return work(0, field, workspace);
    }
    let (lines, chunks) = (field.len() / length, workspaces.len());
    let (mut tasks, mut rest, mut first) = (Vec::with_capacity(chunks), field, 0);
    for (chunk, workspace) in workspaces.iter_mut().enumerate() {
        let end = lines * (chunk + 1) / chunks;
        let (own, others) = rest.split_at_mut((end - first) * length);
        if !own.is_empty() {
            tasks.push((first, own, workspace));
        }
        (first, rest) = (end, others);
    }
    for_each_task(tasks, |(first, lines, workspace)| work(first, lines, workspace));
}

/// Runs `work` on all `tasks` in any order, on several threads.
#[cfg(feature = "parallel")]
pub(super) fn for_each_task<T: Send>(tasks: Vec<T>, work: impl Fn(T) + Sync) {
    super::threads::for_each_task(tasks, work);
}

/// Runs `work` on all `tasks`.
#[cfg(not(feature = "parallel"))]
pub(super) fn for_each_task<T: Send>(tasks: Vec<T>, work: impl Fn(T) + Sync) {
    tasks.into_iter().for_each(work);
}

/// Result of `own`; another thread may run `other` at the same time.
#[cfg(feature = "parallel")]
pub(crate) fn join<A>(own: impl FnOnce() -> A, other: impl FnOnce() + Send) -> A {
    super::threads::join(own, other)
}

/// Result of `own`, after which `other` runs.
#[cfg(not(feature = "parallel"))]
pub(crate) fn join<A>(own: impl FnOnce() -> A, other: impl FnOnce() + Send) -> A {
    let result = own();
    other();
    result
}
