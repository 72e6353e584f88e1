//! Loops over the lines of several fields at once, distributed over threads as in `parallel`.

use std::ops::Range;

use super::parallel::{chunk_count, for_each_task};

/// Ranges of lines per chunk: lines of full films take longer than others, so that equal ranges end at other times.
const RANGES_PER_CHUNK: usize = 4;

/// Fields whose lines are divided between two threads.
pub(crate) trait Lines: Send + Sized {
    /// The first `count` lines, and the others.
    fn split_lines(self, count: usize) -> (Self, Self);
}

/// A field of lines of equal length; an empty one has empty lines.
#[derive(Debug)]
pub(crate) struct FieldLines<'a, T> {
    /// The values, line by line.
    pub(crate) values: &'a mut [T],
    length: usize,
}

impl<'a, T> FieldLines<'a, T> {
    /// The lines of `field`, `length` values each.
    pub(crate) fn new(field: &'a mut [T], length: usize) -> Self {
        Self { values: field, length }
    }
}

impl<T: Send> Lines for FieldLines<'_, T> {
    fn split_lines(self, count: usize) -> (Self, Self) {
        let at = (count * self.length).min(self.values.len());
        let (head, tail) = self.values.split_at_mut(at);
        (Self::new(head, self.length), Self::new(tail, self.length))
    }
}

impl<A: Lines, B: Lines> Lines for (A, B) {
    fn split_lines(self, count: usize) -> (Self, Self) {
        let ((a, a_rest), (b, b_rest)) = (self.0.split_lines(count), self.1.split_lines(count));
        ((a, b), (a_rest, b_rest))
    }
}

impl<A: Lines, B: Lines, C: Lines> Lines for (A, B, C) {
    fn split_lines(self, count: usize) -> (Self, Self) {
        let (a, b, c) = self;
        let (((a, b), c), ((a_rest, b_rest), c_rest)) = ((a, b), c).split_lines(count);
        ((a, b, c), (a_rest, b_rest, c_rest))
    }
}

impl<A: Lines, B: Lines, C: Lines, D: Lines> Lines for (A, B, C, D) {
    fn split_lines(self, count: usize) -> (Self, Self) {
        let (a, b, c, d) = self;
        let (((a, b), (c, d)), ((a_rest, b_rest), (c_rest, d_rest))) = ((a, b), (c, d)).split_lines(count);
        ((a, b, c, d), (a_rest, b_rest, c_rest, d_rest))
    }
}

impl<A: Lines> Lines for [A; 4] {
    fn split_lines(self, count: usize) -> (Self, Self) {
        let [a, b, c, d] = self;
        let ((a, b, c, d), (a_rest, b_rest, c_rest, d_rest)) = (a, b, c, d).split_lines(count);
        ([a, b, c, d], [a_rest, b_rest, c_rest, d_rest])
    }
}

impl<A: Lines> Lines for [A; 5] {
    fn split_lines(self, count: usize) -> (Self, Self) {
        let [a, b, c, d, e] = self;
        let (([a, b, c, d], e), ([a_rest, b_rest, c_rest, d_rest], e_rest)) =
            ([a, b, c, d], e).split_lines(count);
        ([a, b, c, d, e], [a_rest, b_rest, c_rest, d_rest, e_rest])
    }
}

/// Applies `work` to ranges of `count` lines and to the lines of `fields` in them; `nodes` is the size of the fields.
pub(crate) fn for_each_range<L: Lines>(
    fields: L,
    count: usize,
    nodes: usize,
    work: impl Fn(Range<usize>, L) + Sync,
) {
    let chunks = chunk_count(nodes);
    if chunks == 1 {
        return work(0..count, fields);
    }
    let ranges = (RANGES_PER_CHUNK * chunks).min(count);
    let (mut tasks, mut rest, mut start) = (Vec::with_capacity(ranges), fields, 0);
    for range in 0..ranges {
        let end = count * (range + 1) / ranges;
        let (own, others) = rest.split_lines(end - start);
        tasks.push((start..end, own));
        (start, rest) = (end, others);
    }
    for_each_task(tasks, |(lines, fields)| work(lines, fields));
}

/// Applies `work` to the index and the value of each node of `field`.
pub(crate) fn map_nodes<T: Send>(field: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    let count = field.len();
    for_each_range(FieldLines::new(field, 1), count, count, |nodes, field| {
        for (node, value) in nodes.zip(field.values) {
            work(node, value);
        }
    });
}

/// Applies `work` to the index and the values of each line of `field`, `length` values each.
pub(crate) fn map_lines<T: Send>(field: &mut [T], length: usize, work: impl Fn(usize, &mut [T]) + Sync) {
    let (count, nodes) = (field.len() / length, field.len());
    for_each_range(FieldLines::new(field, length), count, nodes, |lines, field| {
        for (line, values) in lines.zip(field.values.chunks_exact_mut(length)) {
            work(line, values);
        }
    });
}

/// Applies `work` to each of `items`.
pub(crate) fn for_each_with<T: Send>(items: &mut [T], work: impl Fn(&mut T) + Sync) {
    if let [item] = items {
        return work(item);
    }
    for_each_task(items.iter_mut().collect(), work);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_line_is_visited_once_with_the_values_of_all_fields() {
        for (count, length) in [(1, 40_000), (200, 200), (1023, 64), (5, 1)] {
            let (mut first, mut second) = (vec![0_usize; count * length], vec![[0_u8; 2]; count]);
            let mut none: Vec<f64> = Vec::new();
            let fields = (
                FieldLines::new(&mut first, length),
                [second.as_mut_slice(), &mut [], &mut [], &mut []].map(|field| FieldLines::new(field, 1)),
                FieldLines::new(&mut none, length),
            );
            for_each_range(fields, count, count * length, |lines, (first, [second, ..], none)| {
                assert!(none.values.is_empty());
                assert_eq!((first.values.len(), second.values.len()), (lines.len() * length, lines.len()));
                for (line, (values, visits)) in
                    lines.zip(first.values.chunks_exact_mut(length).zip(second.values))
                {
                    values.iter_mut().for_each(|value| *value += line + 1);
                    visits[0] += 1;
                }
            });
            assert!(first.iter().enumerate().all(|(k, value)| *value == k / length + 1), "{count} {length}");
            assert!(second.iter().all(|visits| visits[0] == 1));
        }
    }
}
