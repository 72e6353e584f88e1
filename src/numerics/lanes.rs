//! Lines of a field shared among threads. Without the feature `parallel`, and on small fields, there is one
//! lane.
//!
//! A lane is a piece of the lines with buffers of its own. Which thread works on which lane is open; what
//! happens to a line is not. As no sum runs over lanes, results are those of one thread to the last bit.

/// Nodes of a field from which threads are worth their overhead.
#[cfg(feature = "parallel")]
const WORTHWHILE: usize = 1 << 15;
/// Lanes per thread: one that is held up leaves its other lanes to the rest.
#[cfg(feature = "parallel")]
const PER_THREAD: usize = 4;

/// Number of lanes, each with buffers of its own, for fields of `nodes` values.
#[cfg(feature = "parallel")]
pub(super) fn lanes_for(nodes: usize) -> usize {
    let threads = if nodes < WORTHWHILE { 1 } else { rayon::current_num_threads() };
    if threads < 2 { 1 } else { PER_THREAD * threads }
}

/// One: there are no threads.
#[cfg(not(feature = "parallel"))]
pub(super) fn lanes_for(_nodes: usize) -> usize {
    1
}

/// Shares the lines of `field`, `length` values each, among `lanes`: `work` gets the number of its first
/// line, its lines and its lane.
pub(super) fn share_lines<T: Send, L: Send>(
    lanes: &mut [L],
    field: &mut [T],
    length: usize,
    work: impl Fn(usize, &mut [T], &mut L) + Sync,
) {
    split(lanes, 0, field, length, &work);
}

/// Changes the lines of `field`, `length` values each; `work` gets the number of a line and the line.
pub(crate) fn map_lines<T: Send>(field: &mut [T], length: usize, work: impl Fn(usize, &mut [T]) + Sync) {
    let mut lanes = vec![(); lanes_for(field.len())];
    share_lines(&mut lanes, field, length, |first, lines, ()| {
        for (line, values) in (first..).zip(lines.chunks_exact_mut(length)) {
            work(line, values);
        }
    });
}

/// Halves lanes and lines in proportion until one lane is left, and works on both halves side by side.
fn split<T: Send, L: Send>(
    lanes: &mut [L],
    first: usize,
    field: &mut [T],
    length: usize,
    work: &(impl Fn(usize, &mut [T], &mut L) + Sync),
) {
    let lines = field.len() / length;
    match lanes {
        [] => {}
        _ if lines == 0 => {}
        [lane] => work(first, field, lane),
        _ => {
            let (left, right) = lanes.split_at_mut(lanes.len() / 2);
            let count = lines * left.len() / (left.len() + right.len());
            let (head, tail) = field.split_at_mut(count * length);
            both(
                || split(left, first, head, length, work),
                || split(right, first + count, tail, length, work),
            );
        }
    }
}

/// What two pieces of work give, on two threads where there are.
#[cfg(feature = "parallel")]
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// What two pieces of work give: there are no threads.
#[cfg(not(feature = "parallel"))]
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    (first(), second())
}
