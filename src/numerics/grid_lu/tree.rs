//! The tree of fronts and its storage; disjoint subtrees are processed in parallel, then the fronts above them, level
//! by level.
//!
//! Fronts are in postorder, children before their parents, so a subtree is a contiguous range of fronts and
//! owns contiguous slices of factors and vectors. Update matrices live on two stacks, as they are consumed in
//! the order of their creation.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::Matrix;
use super::dense::{Block, VECTOR};
use super::dissection::{Dissection, Supernode};
use super::front::{Elimination, extend_add};
use super::structure::{Front, Structure};
use crate::numerics::parallel::{CHUNKS_PER_THREAD, for_each_task};

/// Pivots of a front from which on an interruption is polled before it.
const LARGE_FRONT: usize = 64;

/// Storage of the fronts of a subtree.
#[derive(Debug)]
struct Subtree<'a> {
    /// First front of the subtree.
    first: usize,
    /// Factors of its fronts.
    factors: &'a mut [f32],
    /// Right-hand sides, overwritten by solutions, at pivots and border of each front, both padded.
    vectors: &'a mut [f32],
    /// One workspace for each task.
    scratch: &'a mut [Vec<f32>],
}

/// A subtree with its root front and its parts of the two stacks.
struct Part<'a> {
    root: usize,
    subtree: Subtree<'a>,
    stacks: [&'a mut [f32]; 2],
}

/// Parts of the tree that do not depend on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    /// The subtrees of one task each.
    Subtrees,
    /// The fronts above them at this distance from the root.
    Fronts(u32),
}

/// The tree of fronts with its storage.
#[derive(Debug)]
pub(super) struct Tree {
    /// The separator tree.
    dissection: Dissection,
    /// The fronts of the matrix.
    pub(super) structure: Structure,
    /// Right-hand sides, overwritten by solutions, front by front.
    vectors: Vec<f32>,
    /// Factors, front by front.
    factors: Vec<f32>,
    /// Two stacks of update matrices that alternate between levels of the tree: one for a front and its
    /// grandchildren, the other for its children.
    update_stacks: [Vec<f32>; 2],
    /// Sizes that the subtree of each front needs on its own stack and on the other one.
    stack_sizes: Vec<[usize; 2]>,
    /// Number of tasks for the subtree of each front.
    tasks: Vec<usize>,
    /// One workspace for each task.
    scratch: Vec<Vec<f32>>,
}

impl Tree {
    /// Storage for all matrices on a grid of `nx` x `ny` nodes, with `tasks` parallel tasks. Memory that
    /// small fronts never write is not committed.
    pub(super) fn new(nx: usize, ny: usize, tasks: usize) -> Self {
        let dissection = Dissection::new(nx, ny);
        let structure = Structure::full(&dissection, nx, ny);
        let scratch = structure.fronts.iter().map(Front::scratch).max().unwrap_or_default();
        let mut tree = Self {
            vectors: vec![0.0; structure.vectors],
            factors: vec![0.0; structure.factors],
            update_stacks: Default::default(),
            stack_sizes: Vec::with_capacity(structure.fronts.len()),
            tasks: distribute_tasks(&dissection.supernodes, tasks),
            scratch: vec![vec![0.0; scratch]; tasks],
            dissection,
            structure,
        };
        tree.compute_stack_sizes();
        tree.update_stacks =
            tree.stack_sizes.last().copied().unwrap_or_default().map(|depth| vec![0.0; depth]);
        tree
    }

    /// Updates the structure for a sparsity pattern (see [`Structure::update`]).
    pub(super) fn update(&mut self, is_coupled: impl Fn(usize, usize) -> bool) {
        self.structure.update(&self.dissection, is_coupled);
        self.compute_stack_sizes();
    }

    /// The read-only part of a traversal, and the whole tree.
    fn parts(&mut self) -> (Traversal<'_>, Part<'_>) {
        let Self {
            dissection,
            structure,
            factors,
            vectors,
            update_stacks: [own, other],
            stack_sizes,
            scratch,
            ..
        } = self;
        let subtree = Subtree { first: 0, factors, vectors, scratch };
        (
            Traversal { supernodes: &dissection.supernodes, structure, stack_sizes, arch: Arch::new() },
            Part { root: structure.fronts.len() - 1, subtree, stacks: [own, other] },
        )
    }

    /// The levels from the leaves to the root.
    fn levels(&self) -> impl DoubleEndedIterator<Item = Level> + use<> {
        let fronts = self.scratch.len().next_power_of_two().ilog2();
        std::iter::once(Level::Subtrees).chain((0..fronts).rev().map(Level::Fronts))
    }

    /// Factorizes a matrix; returns whether all pivots are finite and `must_stop` was false throughout.
    pub(super) fn eliminate(&mut self, matrix: Matrix<'_>, must_stop: &(dyn Fn() -> bool + Sync)) -> bool {
        let (levels, is_finite) = (self.levels(), AtomicBool::new(true));
        for level in levels {
            let (traversal, tree) = self.parts();
            traversal.for_each_part(tree, level, |part, is_alone| {
                let is_done = match level {
                    Level::Subtrees => traversal.eliminate_subtree(part, matrix, must_stop),
                    Level::Fronts(_) => {
                        !traversal.is_interrupted(part.root, must_stop)
                            && traversal.eliminate_front(part, is_alone, matrix)
                    }
                };
                if !is_done {
                    is_finite.store(false, Ordering::Relaxed);
                }
            });
            if !is_finite.load(Ordering::Relaxed) {
                return false;
            }
        }
        true
    }

    /// Overwrites the right-hand side at the coupled nodes with the solution.
    pub(super) fn solve(&mut self, rhs: &mut [f32]) {
        for front in &self.structure.fronts {
            let nodes = &self.structure.nodes[front.pivots.clone()];
            for (right, &node) in self.vectors[front.vectors_at..].iter_mut().zip(nodes) {
                *right = rhs[node as usize];
            }
        }
        // substitution on all fronts, from the leaves to the root and back
        for (level, forward) in
            self.levels().map(|level| (level, true)).chain(self.levels().rev().map(|level| (level, false)))
        {
            let (traversal, tree) = self.parts();
            traversal.for_each_part(tree, level, |part, _| {
                let first =
                    if level == Level::Subtrees { traversal.supernodes[part.root].first } else { part.root };
                traversal.run(first..part.root + 1, part.subtree, forward);
            });
        }
        for front in &self.structure.fronts {
            let nodes = &self.structure.nodes[front.pivots.clone()];
            for (solution, &node) in self.vectors[front.vectors_at..].iter().zip(nodes) {
                rhs[node as usize] = *solution;
            }
        }
    }

    /// Stack sizes of each subtree. Parallel siblings have disjoint parts of the stacks.
    fn compute_stack_sizes(&mut self) {
        let Self { dissection, structure: Structure { fronts, .. }, stack_sizes, tasks, .. } = self;
        stack_sizes.clear();
        for (f, (supernode, front)) in dissection.supernodes.iter().zip(&*fronts).enumerate() {
            let [mut own, mut other] = [front.update_length(), 0];
            if let Some([one, two]) = supernode.children {
                let ([one_own, one_other], [two_own, two_other]) = (stack_sizes[one], stack_sizes[two]);
                if tasks[f] > 1 {
                    own = own.max(one_other + two_other);
                    other = one_own + two_own;
                } else {
                    own = own.max(one_other).max(two_other);
                    other = one_own.max(fronts[one].update_length() + two_own);
                }
            }
            stack_sizes.push([own, other]);
        }
    }
}

/// Distributes the tasks over the subtrees of each supernode.
fn distribute_tasks(supernodes: &[Supernode], tasks: usize) -> Vec<usize> {
    let mut tasks_of = vec![tasks; supernodes.len()];
    for (f, supernode) in supernodes.iter().enumerate().rev() {
        let half = tasks_of[f] / 2;
        for (child, tasks) in supernode.children.into_iter().flatten().zip([half, tasks_of[f] - half]) {
            tasks_of[child] = tasks.max(1);
        }
    }
    tasks_of
}

impl Subtree<'_> {
    /// A shorter borrow of the storage.
    #[inline(always)]
    fn all(&mut self) -> Subtree<'_> {
        Subtree { first: self.first, factors: self.factors, vectors: self.vectors, scratch: self.scratch }
    }
}

/// Read-only data of a traversal.
#[derive(Debug, Clone, Copy)]
struct Traversal<'a> {
    /// All supernodes.
    supernodes: &'a [Supernode],
    /// All fronts.
    structure: &'a Structure,
    /// Stack sizes of each subtree.
    stack_sizes: &'a [[usize; 2]],
    /// SIMD instruction set of the machine.
    arch: Arch,
}

/// One half of a substitution on consecutive fronts.
struct Substitution<'a, 'b> {
    /// The tree.
    traversal: Traversal<'a>,
    /// Range of fronts.
    fronts: Range<usize>,
    /// Their storage.
    subtree: Subtree<'b>,
    /// Forward (from the leaves to the root) or backward.
    forward: bool,
}

impl WithSimd for Substitution<'_, '_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        if S::F32_LANES > VECTOR { self.work(Scalar) } else { self.work(simd) }
    }
}

impl Substitution<'_, '_> {
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
    fn split<'b>(&self, subtree: Subtree<'b>, at: usize) -> (Subtree<'b>, Subtree<'b>) {
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
    fn parallel_children(&self, root: usize, subtree: &Subtree<'_>) -> Option<[usize; 2]> {
        self.supernodes[root].children.filter(|_| subtree.scratch.len() > 1)
    }

    /// Applies `work` to the parts of `tree` on a level, in parallel. Where they are fewer than the threads, one after
    /// the other, and `work` is told that each is alone and may use all threads.
    fn for_each_part(&self, tree: Part<'_>, level: Level, work: impl Fn(Part<'_>, bool) + Sync) {
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
    fn divide<'b>(&self, tree: Part<'b>, level: Level, parts: &mut Vec<Part<'b>>) {
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
    fn is_interrupted(&self, front: usize, must_stop: &dyn Fn() -> bool) -> bool {
        self.structure.fronts[front].pivots.len() >= LARGE_FRONT && must_stop()
    }

    /// Factorizes a subtree, front after front, and leaves its update matrix on the first stack. Returns whether all
    /// pivots are finite and `must_stop` was false throughout.
    fn eliminate_subtree(
        &self,
        part: Part<'_>,
        matrix: Matrix<'_>,
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
    fn eliminate_front(&self, part: Part<'_>, is_alone: bool, matrix: Matrix<'_>) -> bool {
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

    /// Substitutes on consecutive fronts with the SIMD instructions of the machine.
    fn run(&self, fronts: Range<usize>, subtree: Subtree<'_>, forward: bool) {
        self.arch.dispatch(Substitution { traversal: *self, fronts, subtree, forward });
    }

    /// The vectors of the earlier fronts, and factors, vector and workspace of front `f`.
    #[inline(always)]
    fn open<'b>(&self, f: usize, subtree: Subtree<'b>) -> Option<(&'b mut [f32], [&'b mut [f32]; 3])> {
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
    fn forward_front<S: Simd>(&self, simd: S, f: usize, subtree: Subtree<'_>) {
        let (structure, first) = (self.structure, subtree.first);
        let front = &structure.fronts[f];
        let Some((below, [values, own, scratch])) = self.open(f, subtree) else { return };
        own[front.pivot_rows()..].fill(0.0);
        for child in self.supernodes[f].children.into_iter().flatten() {
            let child = &structure.fronts[child];
            extend_add(own, &below[self.border_at(child, first)..], structure.index_ranges(child), 0);
        }
        front.forward(simd, structure.edges(front), [values, own, scratch]);
    }

    /// Solution at the pivots of front `f` from that at its border, copied to the borders of its children.
    #[inline(always)]
    fn backward_front<S: Simd>(&self, simd: S, f: usize, subtree: Subtree<'_>) {
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
