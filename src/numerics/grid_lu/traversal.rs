//! Traversals of the tree of fronts: factorization and both halves of a substitution.

use std::ops::Range;

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::Matrix;
use super::dense::{Block, VECTOR};
use super::dissection::Supernode;
use super::front::{Elimination, extend_add};
use super::real::Real;
use super::structure::{Front, Structure};
use crate::numerics::parallel::{CHUNKS_PER_THREAD, for_each_task};

/// Pivots of a front from which on an interruption is polled before it.
const LARGE_FRONT: usize = 64;

/// Storage of the fronts of a subtree.
#[derive(Debug)]
pub(super) struct Subtree<'a, T> {
    /// First front of the subtree.
    pub(super) first: usize,
    /// Factors of its fronts.
    pub(super) factors: &'a mut [T],
    /// Right-hand sides, overwritten by solutions, at pivots and border of each front, both padded.
    pub(super) vectors: &'a mut [T],
    /// One workspace for each task.
    pub(super) scratch: &'a mut [Vec<T>],
}

/// A subtree with its root front and its parts of the two stacks.
pub(super) struct Part<'a, T> {
    pub(super) root: usize,
    pub(super) subtree: Subtree<'a, T>,
    pub(super) stacks: [&'a mut [T]; 2],
}

/// Parts of the tree that do not depend on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Level {
    /// The subtrees of one task each.
    Subtrees,
    /// The fronts above them at this distance from the root.
    Fronts(u32),
}

impl<T> Subtree<'_, T> {
    /// A shorter borrow of the storage.
    #[inline(always)]
    fn all(&mut self) -> Subtree<'_, T> {
        Subtree { first: self.first, factors: self.factors, vectors: self.vectors, scratch: self.scratch }
    }
}

/// Read-only data of a traversal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Traversal<'a> {
    /// All supernodes.
    pub(super) supernodes: &'a [Supernode],
    /// All fronts.
    pub(super) structure: &'a Structure,
    /// Stack sizes of each subtree.
    pub(super) stack_sizes: &'a [[usize; 2]],
    /// SIMD instruction set of the machine.
    pub(super) arch: Arch,
}

/// One half of a substitution on consecutive fronts.
struct Substitution<'a, 'b, T> {
    /// The tree.
    traversal: Traversal<'a>,
    /// Range of fronts.
    fronts: Range<usize>,
    /// Their storage.
    subtree: Subtree<'b, T>,
    /// Forward (from the leaves to the root) or backward.
    forward: bool,
}

impl<T: Real> WithSimd for Substitution<'_, '_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        if T::lanes::<S>() > VECTOR { self.work(Scalar) } else { self.work(simd) }
    }
}

impl<T: Real> Substitution<'_, '_, T> {
    /// Substitutes on the fronts, in order for the forward and in reverse for the backward half.
    #[inline(always)]
    fn work<S: Simd>(mut self, simd: S) {
        if self.forward {
            for f in self.fronts {
                self.traversal.forward_front(simd, f, self.subtree.all());
            }
        } else {
            for f in self.fronts.rev() {
                self.traversal.backward_front(simd, f, self.subtree.all());
            }
        }
    }
}

impl Traversal<'_> {
    /// Splits the storage before front `at`.
    fn split<'b, T: Real>(&self, subtree: Subtree<'b, T>, at: usize) -> (Subtree<'b, T>, Subtree<'b, T>) {
        let Subtree { first, factors, vectors, scratch } = subtree;
        let (from, to) = (&self.structure.fronts[first], &self.structure.fronts[at]);
        let factors = factors.split_at_mut(to.factors_at - from.factors_at);
        let vectors = vectors.split_at_mut(to.vectors_at - from.vectors_at);
        let tasks = scratch.len();
        let scratch = scratch.split_at_mut(tasks / 2);
        (
            Subtree { first, factors: factors.0, vectors: vectors.0, scratch: scratch.0 },
            Subtree { first: at, factors: factors.1, vectors: vectors.1, scratch: scratch.1 },
        )
    }

    /// The children of a front if more than one task is available for them.
    fn parallel_children<T: Real>(&self, root: usize, subtree: &Subtree<'_, T>) -> Option<[usize; 2]> {
        self.supernodes[root].children.filter(|_| subtree.scratch.len() > 1)
    }

    /// Applies `work` to the parts of `tree` on a level, in parallel. Where they are fewer than the threads, one after
    /// the other, and `work` gets the flag that each is alone and may use all threads.
    pub(super) fn for_each_part<T: Real>(
        &self,
        tree: Part<'_, T>,
        level: Level,
        work: impl Fn(Part<'_, T>, bool) + Sync,
    ) {
        let tasks = tree.subtree.scratch.len();
        if tasks == 1 {
            return work(tree, true);
        }
        let mut parts = Vec::new();
        self.divide(tree, level, &mut parts);
        if CHUNKS_PER_THREAD * parts.len() <= tasks {
            parts.into_iter().for_each(|part| work(part, true));
        } else {
            for_each_task(parts, |part| work(part, false));
        }
    }

    /// Collects the parts of `tree` on a level.
    fn divide<'b, T: Real>(&self, tree: Part<'b, T>, level: Level, parts: &mut Vec<Part<'b, T>>) {
        let Some([one, two]) = self.parallel_children(tree.root, &tree.subtree) else {
            if level == Level::Subtrees {
                parts.push(tree);
            }
            return;
        };
        let below = match level {
            Level::Fronts(0) => return parts.push(tree),
            Level::Fronts(above) => Level::Fronts(above - 1),
            Level::Subtrees => level,
        };
        // siblings have disjoint parts of both stacks
        let Part { subtree, stacks: [own, other], .. } = tree;
        let (left, right) = self.split(subtree, one + 1);
        let (one_own, two_own) = other.split_at_mut(self.stack_sizes[one][0]);
        let (one_other, two_other) = own.split_at_mut(self.stack_sizes[one][1]);
        self.divide(Part { root: one, subtree: left, stacks: [one_own, one_other] }, below, parts);
        self.divide(Part { root: two, subtree: right, stacks: [two_own, two_other] }, below, parts);
    }

    /// Whether `must_stop` is true before a large front.
    pub(super) fn is_interrupted(&self, front: usize, must_stop: &dyn Fn() -> bool) -> bool {
        self.structure.fronts[front].pivots.len() >= LARGE_FRONT && must_stop()
    }

    /// Factorizes a subtree, front after front, and leaves its update matrix on the first stack. Returns whether all
    /// pivots are finite and `must_stop` was false throughout.
    pub(super) fn eliminate_subtree<T: Real>(
        &self,
        part: Part<'_, T>,
        matrix: Matrix<'_, T>,
        must_stop: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let Part { root, mut subtree, stacks: [own, other] } = part;
        if self.is_interrupted(root, must_stop) {
            return false;
        }
        if let Some([one, two]) = self.supernodes[root].children {
            let second = self.structure.fronts[one].update_length();
            for (child, start) in [(one, 0), (two, second)] {
                let stacks = [&mut other[start..], &mut *own];
                let part = Part { root: child, subtree: subtree.all(), stacks };
                if !self.eliminate_subtree(part, matrix, must_stop) {
                    return false;
                }
            }
        }
        self.eliminate_front(Part { root, subtree, stacks: [own, other] }, false, matrix)
    }

    /// Eliminates the root front of a part, whose children have left their update matrices on the second stack.
    /// A front that `is_alone` uses all threads. Returns whether all pivots are finite.
    pub(super) fn eliminate_front<T: Real>(
        &self,
        part: Part<'_, T>,
        is_alone: bool,
        matrix: Matrix<'_, T>,
    ) -> bool {
        let Part { root, subtree, stacks: [own, other] } = part;
        let (structure, is_divided) = (self.structure, subtree.scratch.len() > 1);
        let front = &structure.fronts[root];
        let Subtree { first, factors, scratch, .. } = subtree;
        let Some((scratch, others)) = scratch.split_first_mut().filter(|_| !front.is_empty()) else {
            return true;
        };
        let packs = if is_alone { others } else { &mut [] };
        let values = &mut factors[front.factors_at - structure.fronts[first].factors_at..][..front.factors()];
        let mut children = [None; 2];
        if let Some([one, two]) = self.supernodes[root].children {
            let second =
                if is_divided { self.stack_sizes[one][0] } else { structure.fronts[one].update_length() };
            for ((child, update), start) in [one, two].into_iter().zip(&mut children).zip([0, second]) {
                let child = &structure.fronts[child];
                let values = &other[start..][..child.update_length()];
                let block = Block { values, stride: child.border_rows() };
                *update = (!values.is_empty()).then(|| (block, structure.index_ranges(child)));
            }
        }
        let update_matrix = &mut own[..front.update_length()];
        let work = Elimination { front, structure, matrix, values, children, update_matrix, scratch, packs };
        self.arch.dispatch(work)
    }

    /// One half of a substitution on a part of a level, the forward or the backward one.
    pub(super) fn substitute<T: Real>(&self, level: Level, part: Part<'_, T>, forward: bool) {
        let Part { root, subtree, .. } = part;
        let first = if level == Level::Subtrees { self.supernodes[root].first } else { root };
        self.run(first..root + 1, subtree, forward);
    }

    /// Substitutes on consecutive fronts with the SIMD instructions of the machine.
    fn run<T: Real>(&self, fronts: Range<usize>, subtree: Subtree<'_, T>, forward: bool) {
        self.arch.dispatch(Substitution { traversal: *self, fronts, subtree, forward });
    }

    /// The vectors of the earlier fronts, and factors, vector and workspace of front `f`.
    #[inline(always)]
    fn open<'b, T: Real>(
        &self,
        f: usize,
        subtree: Subtree<'b, T>,
    ) -> Option<(&'b mut [T], [&'b mut [T]; 3])> {
        let Subtree { first, factors, vectors, scratch } = subtree;
        let (from, front) = (&self.structure.fronts[first], &self.structure.fronts[f]);
        let (below, own) = vectors.split_at_mut(front.vectors_at - from.vectors_at);
        let own = &mut own[..front.pivot_rows() + front.border_rows()];
        let values = &mut factors[front.factors_at - from.factors_at..][..front.factors()];
        let scratch = scratch.first_mut().filter(|_| !front.is_empty())?;
        Some((below, [values, own, scratch]))
    }

    /// Offset of a front's border in the vectors of the fronts from `first` on.
    #[inline(always)]
    fn border_at(&self, front: &Front, first: usize) -> usize {
        front.vectors_at + front.pivot_rows() - self.structure.fronts[first].vectors_at
    }

    /// Assembles the contributions of the children to front `f` and eliminates its pivots.
    #[inline(always)]
    fn forward_front<S: Simd, T: Real>(&self, simd: S, f: usize, subtree: Subtree<'_, T>) {
        let (structure, first) = (self.structure, subtree.first);
        let front = &structure.fronts[f];
        let Some((below, [values, own, scratch])) = self.open(f, subtree) else { return };
        own[front.pivot_rows()..].fill(T::zero());
        for child in self.supernodes[f].children.into_iter().flatten() {
            let child = &structure.fronts[child];
            extend_add(own, &below[self.border_at(child, first)..], structure.index_ranges(child), 0);
        }
        front.forward(simd, structure.edges(front), [values, own, scratch]);
    }

    /// Solution at the pivots of front `f` from that at its border, copied to the borders of its children.
    #[inline(always)]
    fn backward_front<S: Simd, T: Real>(&self, simd: S, f: usize, subtree: Subtree<'_, T>) {
        let (structure, first) = (self.structure, subtree.first);
        let front = &structure.fronts[f];
        let Some((below, [values, own, scratch])) = self.open(f, subtree) else { return };
        front.backward(simd, structure.edges(front), [values, own, scratch]);
        for child in self.supernodes[f].children.into_iter().flatten() {
            let child = &structure.fronts[child];
            let to = &mut below[self.border_at(child, first)..];
            for range in structure.index_ranges(child) {
                to[range.from as usize..][..range.length as usize].copy_from_slice(&own[range.rows()]);
            }
        }
    }
}
