//! The tree of fronts with what they own; its branches are worked on side by side.

use std::ops::Range;

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::dense::VECTOR;
use super::dissection::{Dissection, Front};
use crate::numerics::lanes::both;

/// What each front owns, one after the other; of a whole tree or of one branch.
///
/// A front with `s` pivots and a border of `b` has a block of `s` columns, whose rows are the pivots and the border, and
/// a block of `b` columns, whose rows are the pivots. Elimination turns the first into the inverse of the pivots and its
/// negative product with the border, the second into its product with the inverse.
#[derive(Debug)]
pub(super) struct Branch<'a> {
    /// Its first front.
    pub(super) first: usize,
    pub(super) factors: &'a mut [f32],
    /// What each front leaves for its parent: its border squared, columns padded.
    pub(super) remainders: &'a mut [f32],
    /// Right-hand side, then solution, at the pivots and at the border of each front, both padded.
    pub(super) vectors: &'a mut [f32],
    /// Fronts whose nodes and children are all unlinked.
    pub(super) idle: &'a mut [bool],
    /// One for each lane.
    pub(super) scratch: &'a mut [Vec<f32>],
}

/// Where the values of each front start.
#[derive(Debug, Clone, Default)]
pub(super) struct Starts {
    pub(super) factors: Vec<usize>,
    pub(super) remainders: Vec<usize>,
    pub(super) vectors: Vec<usize>,
}

/// The tree of fronts with what they own.
#[derive(Debug)]
pub(super) struct Tree {
    pub(super) fronts: Vec<Front>,
    pub(super) starts: Starts,
    pub(super) factors: Vec<f32>,
    pub(super) vectors: Vec<f32>,
    remainders: Vec<f32>,
    idle: Vec<bool>,
    scratch: Vec<Vec<f32>>,
}

impl Tree {
    pub(super) fn new(dissection: Dissection, lanes: usize) -> Self {
        let fronts = dissection.fronts;
        let mut starts = Starts::default();
        let (mut factors, mut remainders, mut vectors, mut widest) = (0, 0, 0, 0);
        for front in &fronts {
            let (s, b) = (front.pivots.len(), front.border.len());
            let (rows, border_rows) = (front.pivot_rows(), front.border_rows());
            starts.factors.push(factors);
            starts.remainders.push(remainders);
            starts.vectors.push(vectors);
            factors += s * (rows + border_rows) + rows * b;
            remainders += border_rows * b;
            vectors += rows + border_rows;
            widest = widest.max(s * (rows + border_rows)).max(rows * b).max(rows);
        }
        Self {
            factors: vec![0.0; factors],
            remainders: vec![0.0; remainders],
            vectors: vec![0.0; vectors],
            idle: vec![false; fronts.len()],
            scratch: vec![vec![0.0; widest]; lanes],
            fronts,
            starts,
        }
    }

    fn parts(&mut self) -> (Walk<'_>, Branch<'_>) {
        let Self { fronts, starts, factors, vectors, remainders, idle, scratch } = self;
        let branch = Branch { first: 0, factors, remainders, vectors, idle, scratch };
        (Walk { fronts, starts, arch: Arch::new() }, branch)
    }

    /// Eliminates all fronts, of whose nodes `linked` says which have entries beside the diagonal. Returns whether all
    /// pivots were numbers.
    pub(super) fn eliminate(&mut self, linked: &[bool]) -> bool {
        let root = self.fronts.len() - 1;
        let (walk, branch) = self.parts();
        walk.eliminate(root, branch, linked)
    }

    /// Turns the right-hand side in the pivot rows of `vectors` into the solution.
    pub(super) fn substitute(&mut self) {
        let root = self.fronts.len() - 1;
        let (walk, mut branch) = self.parts();
        walk.forward(root, branch.all());
        walk.backward(root, branch);
    }
}

impl Branch<'_> {
    #[inline(always)]
    fn all(&mut self) -> Branch<'_> {
        Branch {
            first: self.first,
            factors: self.factors,
            remainders: self.remainders,
            vectors: self.vectors,
            idle: self.idle,
            scratch: self.scratch,
        }
    }
}

/// The ways along the tree.
#[derive(Debug, Clone, Copy)]
pub(super) struct Walk<'a> {
    pub(super) fronts: &'a [Front],
    pub(super) starts: &'a Starts,
    arch: Arch,
}

/// What is done on a front.
#[derive(Debug, Clone, Copy)]
enum Task<'a> {
    Eliminate { linked: &'a [bool] },
    Forward,
    Backward,
}

/// A task on fronts that follow one another: with all vector instructions of the machine only what is inlined here.
struct OnFronts<'a, 'b> {
    walk: Walk<'a>,
    fronts: Range<usize>,
    branch: Branch<'b>,
    task: Task<'a>,
}

impl WithSimd for OnFronts<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        // Wider vectors than the columns are padded for: rare, and correct without any.
        if S::F32_LANES > VECTOR { self.work(Scalar) } else { self.work(simd) }
    }
}

impl OnFronts<'_, '_> {
    #[inline(always)]
    fn work<S: Simd>(mut self, simd: S) -> bool {
        let mut sound = true;
        match self.task {
            Task::Eliminate { linked } => {
                for f in self.fronts {
                    sound &= self.walk.eliminate_front(simd, f, self.branch.all(), linked);
                }
            }
            Task::Forward => {
                for f in self.fronts {
                    self.walk.forward_front(simd, f, self.branch.all());
                }
            }
            Task::Backward => {
                for f in self.fronts.rev() {
                    self.walk.backward_front(simd, f, self.branch.all());
                }
            }
        }
        sound
    }
}

/// Cuts a slice that starts at `starts[first]` before front `at`.
fn cut<'b>(
    values: &'b mut [f32],
    starts: &[usize],
    first: usize,
    at: usize,
) -> (&'b mut [f32], &'b mut [f32]) {
    values.split_at_mut(starts[at] - starts[first])
}

impl Walk<'_> {
    /// The branch up to front `at`, and what follows.
    fn split<'b>(&self, branch: Branch<'b>, at: usize) -> (Branch<'b>, Branch<'b>) {
        let Branch { first, factors, remainders, vectors, idle, scratch } = branch;
        let factors = cut(factors, &self.starts.factors, first, at);
        let remainders = cut(remainders, &self.starts.remainders, first, at);
        let vectors = cut(vectors, &self.starts.vectors, first, at);
        let idle = idle.split_at_mut(at - first);
        let lanes = scratch.len();
        let scratch = scratch.split_at_mut(lanes / 2);
        (
            Branch {
                first,
                factors: factors.0,
                remainders: remainders.0,
                vectors: vectors.0,
                idle: idle.0,
                scratch: scratch.0,
            },
            Branch {
                first: at,
                factors: factors.1,
                remainders: remainders.1,
                vectors: vectors.1,
                idle: idle.1,
                scratch: scratch.1,
            },
        )
    }

    /// The two branches of a front if there is more than one lane for them.
    fn fork(&self, root: usize, branch: &Branch<'_>) -> Option<[usize; 2]> {
        match self.fronts[root].children.as_slice() {
            [one, other] if branch.scratch.len() > 1 => Some([one.front, other.front]),
            _ => None,
        }
    }

    /// Eliminates the fronts of a branch, whose last is `root`. Returns whether all pivots were numbers.
    fn eliminate(&self, root: usize, mut branch: Branch<'_>, linked: &[bool]) -> bool {
        let task = Task::Eliminate { linked };
        let Some([one, other]) = self.fork(root, &branch) else {
            return self.run(self.fronts[root].first..root + 1, branch, task);
        };
        let (left, right) = self.split(branch.all(), one + 1);
        let sound = both(|| self.eliminate(one, left, linked), || self.eliminate(other, right, linked));
        sound.0 && sound.1 && self.run(root..root + 1, branch, task)
    }

    /// Turns right-hand sides into what the pivots make of them, from the leaves to the root.
    fn forward(&self, root: usize, mut branch: Branch<'_>) {
        let Some([one, other]) = self.fork(root, &branch) else {
            self.run(self.fronts[root].first..root + 1, branch, Task::Forward);
            return;
        };
        let (left, right) = self.split(branch.all(), one + 1);
        both(|| self.forward(one, left), || self.forward(other, right));
        self.run(root..root + 1, branch, Task::Forward);
    }

    /// Adds what the borders make of the pivots, from the root to the leaves.
    fn backward(&self, root: usize, mut branch: Branch<'_>) {
        let Some([one, other]) = self.fork(root, &branch) else {
            self.run(self.fronts[root].first..root + 1, branch, Task::Backward);
            return;
        };
        self.run(root..root + 1, branch.all(), Task::Backward);
        let (left, right) = self.split(branch, one + 1);
        both(|| self.backward(one, left), || self.backward(other, right));
    }

    fn run(&self, fronts: Range<usize>, branch: Branch<'_>, task: Task<'_>) -> bool {
        self.arch.dispatch(OnFronts { walk: *self, fronts, branch, task })
    }
}
