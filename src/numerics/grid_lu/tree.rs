//! The tree of fronts and its storage; disjoint subtrees are processed in parallel.
//!
//! Fronts are in postorder, children before their parents, so a subtree is a contiguous range of fronts and
//! owns contiguous slices of factors and vectors. Update matrices live on two stacks, as they are consumed in
//! the order of their creation.

use std::ops::Range;

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::Matrix;
use super::dense::{Block, VECTOR};
use super::dissection::{Dissection, Supernode};
use super::front::{Elimination, extend_add};
use super::structure::{Front, Structure};
use crate::numerics::parallel::join;

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

    /// The read-only part of a traversal, the storage of the whole tree, and the two stacks.
    fn parts(&mut self) -> (Traversal<'_>, Subtree<'_>, [&mut [f32]; 2]) {
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
            subtree,
            [own, other],
        )
    }

    /// Factorizes a matrix; returns whether all pivots are finite and `must_stop` was false throughout.
    pub(super) fn eliminate(&mut self, matrix: Matrix<'_>, must_stop: &(dyn Fn() -> bool + Sync)) -> bool {
        let root = self.structure.fronts.len() - 1;
        let (traversal, subtree, stacks) = self.parts();
        traversal.eliminate(root, subtree, stacks, matrix, must_stop)
    }

    /// Overwrites the right-hand side at the coupled nodes with the solution.
    pub(super) fn solve(&mut self, rhs: &mut [f32]) {
        for front in &self.structure.fronts {
            let nodes = &self.structure.nodes[front.pivots.clone()];
            for (right, &node) in self.vectors[front.vectors_at..].iter_mut().zip(nodes) {
                *right = rhs[node as usize];
            }
        }
        let root = self.structure.fronts.len() - 1;
        // substitution on all fronts
        let (traversal, mut subtree, _) = self.parts();
        traversal.forward(root, subtree.all());
        traversal.backward(root, subtree);
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

    /// Factorizes the subtree with the root front `root` and leaves its update matrix on the first stack.
    /// Returns whether all pivots are finite and `must_stop` was false throughout.
    fn eliminate(
        &self,
        root: usize,
        mut subtree: Subtree<'_>,
        [own, other]: [&mut [f32]; 2],
        matrix: Matrix<'_>,
        must_stop: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let structure = self.structure;
        if structure.fronts[root].pivots.len() >= LARGE_FRONT && must_stop() {
            return false;
        }
        // the two subtrees, in parallel or one after the other
        let (mut is_finite, mut second) = (true, 0);
        if let Some([one, two]) = self.parallel_children(root, &subtree) {
            second = self.stack_sizes[one][0];
            let (left, right) = self.split(subtree.all(), one + 1);
            let (one_own, two_own) = other.split_at_mut(second);
            let (one_other, two_other) = own.split_at_mut(self.stack_sizes[one][1]);
            let are_finite = join(
                || self.eliminate(one, left, [one_own, one_other], matrix, must_stop),
                || self.eliminate(two, right, [two_own, two_other], matrix, must_stop),
            );
            is_finite = are_finite.0 && are_finite.1;
        } else if let Some([one, two]) = self.supernodes[root].children {
            second = structure.fronts[one].update_length();
            is_finite = self.eliminate(one, subtree.all(), [&mut *other, &mut *own], matrix, must_stop)
                && self.eliminate(two, subtree.all(), [&mut other[second..], &mut *own], matrix, must_stop);
        }
        if !is_finite {
            return false;
        }
        // assemble the children's update matrices and eliminate the pivots
        let front = &structure.fronts[root];
        let Subtree { first, factors, scratch, .. } = subtree;
        let Some(scratch) = scratch.first_mut().filter(|_| !front.is_empty()) else { return true };
        let values = &mut factors[front.factors_at - structure.fronts[first].factors_at..][..front.factors()];
        let mut children = [None; 2];
        if let Some(pair) = self.supernodes[root].children {
            for ((child, update), start) in pair.into_iter().zip(&mut children).zip([0, second]) {
                let child = &structure.fronts[child];
                let values = &other[start..][..child.update_length()];
                let block = Block { values, stride: child.border_rows() };
                *update = (!values.is_empty()).then(|| (block, structure.index_ranges(child)));
            }
        }
        let update_matrix = &mut own[..front.update_length()];
        let work = Elimination { front, structure, matrix, values, children, update_matrix, scratch };
        self.arch.dispatch(work)
    }

    /// Forward substitution, from the leaves to the root.
    fn forward(&self, root: usize, mut subtree: Subtree<'_>) {
        let Some([one, other]) = self.parallel_children(root, &subtree) else {
            self.run(self.supernodes[root].first..root + 1, subtree, true);
            return;
        };
        let (left, right) = self.split(subtree.all(), one + 1);
        join(|| self.forward(one, left), || self.forward(other, right));
        self.run(root..root + 1, subtree, true);
    }

    /// Backward substitution, from the root to the leaves.
    fn backward(&self, root: usize, mut subtree: Subtree<'_>) {
        let Some([one, other]) = self.parallel_children(root, &subtree) else {
            self.run(self.supernodes[root].first..root + 1, subtree, false);
            return;
        };
        self.run(root..root + 1, subtree.all(), false);
        let (left, right) = self.split(subtree, one + 1);
        join(|| self.backward(one, left), || self.backward(other, right));
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
