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
#[cfg(feature = "parallel")]
const CHUNKS_PER_THREAD: usize = 4;

/// Number of chunks, each with its own workspace, for fields of `nodes` values.
#[cfg(feature = "parallel")]
pub(super) fn chunk_count(nodes: usize) -> usize {
    let threads = if nodes < PARALLEL_THRESHOLD { 1 } else { super::threads::count() };
    if threads < 2 { 1 } else { CHUNKS_PER_THREAD * threads }
}

/// One chunk without threads.
#[cfg(not(feature = "parallel"))]
pub(super) fn chunk_count(_nodes: usize) -> usize {
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
    split(workspaces, 0, field, length, &work);
}

/// Recursive bisection of chunks and lines in proportion; the halves run in parallel.
fn split<T: Send, L: Send>(
    workspaces: &mut [L],
    first: usize,
    field: &mut [T],
    length: usize,
    work: &(impl Fn(usize, &mut [T], &mut L) + Sync),
) {
    let lines = field.len() / length;
    match workspaces {
        [] => {}
        _ if lines == 0 => {}
        [workspace] => work(first, field, workspace),
        _ => {
            let (left, right) = workspaces.split_at_mut(workspaces.len() / 2);
            let count = lines * left.len() / (left.len() + right.len());
            let (head, tail) = field.split_at_mut(count * length);
            join(
                || split(left, first, head, length, work),
                || split(right, first + count, tail, length, work),
            );
        }
    }
}

/// Results of two closures that may run in parallel.
#[cfg(feature = "parallel")]
pub(crate) fn join<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    super::threads::join(first, second)
}

/// Results of two closures; serial fallback.
#[cfg(not(feature = "parallel"))]
pub(crate) fn join<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    (first(), second())
}
