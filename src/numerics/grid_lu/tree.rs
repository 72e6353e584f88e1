//! The tree of fronts and its storage; disjoint subtrees are processed in parallel, then the fronts above them, level
//! by level.
//!
//! Fronts are in postorder, children before their parents, so a subtree is a contiguous range of fronts and
//! owns contiguous slices of factors and vectors. Update matrices live on two stacks, as they are consumed in
//! the order of their creation.

use std::sync::atomic::{AtomicBool, Ordering};

use pulp::Arch;

use super::Matrix;
use super::dissection::{Dissection, Supernode};
use super::periodicity::{Neighbors, Periodicity};
use super::real::Real;
use super::structure::{Front, Structure};
use super::traversal::{Level, Part, Subtree, Traversal};

/// The tree of fronts with its storage.
#[derive(Debug)]
pub(super) struct Tree<T> {
    /// The separator tree.
    dissection: Dissection,
    /// The fronts of the matrix.
    pub(super) structure: Structure,
    /// Right-hand sides, overwritten by solutions, front by front.
    vectors: Vec<T>,
    /// Factors, front by front.
    factors: Vec<T>,
    /// Two stacks of update matrices that alternate between levels of the tree: one for a front and its
    /// grandchildren, the other for its children.
    update_stacks: [Vec<T>; 2],
    /// Sizes that the subtree of each front needs on its own stack and on the other one.
    stack_sizes: Vec<[usize; 2]>,
    /// Number of tasks for the subtree of each front.
    tasks: Vec<usize>,
    /// One workspace for each task.
    scratch: Vec<Vec<T>>,
}

impl<T: Real> Tree<T> {
    /// Storage for all matrices on a grid of `nx` x `ny` nodes, with `tasks` parallel tasks. Memory that
    /// small fronts never write is not committed.
    pub(super) fn new(nx: usize, ny: usize, periodicity: Periodicity, tasks: usize) -> Self {
        let dissection = Dissection::new(nx, ny, periodicity);
        let structure = Structure::full(&dissection, Neighbors::new(nx, ny, periodicity));
        let scratch = structure.fronts.iter().map(Front::scratch).max().unwrap_or_default();
        let mut tree = Self {
            vectors: vec![T::zero(); structure.vectors],
            factors: vec![T::zero(); structure.factors],
            update_stacks: Default::default(),
            stack_sizes: Vec::with_capacity(structure.fronts.len()),
            tasks: distribute_tasks(&dissection.supernodes, tasks),
            scratch: vec![vec![T::zero(); scratch]; tasks],
            dissection,
            structure,
        };
        tree.compute_stack_sizes();
        tree.update_stacks =
            tree.stack_sizes.last().copied().unwrap_or_default().map(|depth| vec![T::zero(); depth]);
        tree
    }

    /// Updates the structure for a sparsity pattern (see [`Structure::update`]).
    pub(super) fn update(&mut self, is_coupled: impl Fn(usize, usize) -> bool) {
        self.structure.update(&self.dissection, is_coupled);
        self.compute_stack_sizes();
    }

    /// The read-only part of a traversal, and the whole tree.
    fn parts(&mut self) -> (Traversal<'_>, Part<'_, T>) {
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

    /// Factorizes a matrix; returns whether all pivots are finite and `must_stop` was false throughout.
    pub(super) fn eliminate(&mut self, matrix: Matrix<'_, T>, must_stop: &(dyn Fn() -> bool + Sync)) -> bool {
        let (levels, is_finite) = (levels(self.scratch.len()), AtomicBool::new(true));
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
    pub(super) fn solve(&mut self, rhs: &mut [T]) {
        for front in &self.structure.fronts {
            let nodes = &self.structure.nodes[front.pivots.clone()];
            for (right, &node) in self.vectors[front.vectors_at..].iter_mut().zip(nodes) {
                *right = rhs[node as usize];
            }
        }
        // substitution on all fronts, from the leaves to the root and back
        let up = levels(self.scratch.len()).map(|level| (level, true));
        let down = levels(self.scratch.len()).rev().map(|level| (level, false));
        for (level, forward) in up.chain(down) {
            let (traversal, tree) = self.parts();
            traversal.for_each_part(tree, level, |part, _| traversal.substitute(level, part, forward));
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

/// The levels of a traversal with this number of tasks, from the leaves to the root.
fn levels(tasks: usize) -> impl DoubleEndedIterator<Item = Level> {
    let fronts = tasks.next_power_of_two().ilog2();
    std::iter::once(Level::Subtrees).chain((0..fronts).rev().map(Level::Fronts))
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
