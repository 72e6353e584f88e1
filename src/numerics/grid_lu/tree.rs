//! The tree of fronts with what they own; its branches are worked on side by side.
//!
//! Fronts are in the order in which they are eliminated, children before their parents, so that a branch is a
//! range of fronts that follow one another and owns slices of factors and vectors. Remainders live on two
//! stacks, as they are used up in the order in which they come.

use std::ops::Range;

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::STENCIL;
use super::dense::{Block, VECTOR, raised};
use super::dissection::{Dissection, Front};
use super::front::{Elimination, SMALLEST_PIVOT, add_runs};
use crate::numerics::lanes::both;

/// What each front owns, one after the other; of a whole tree or of one branch.
#[derive(Debug)]
struct Branch<'a> {
    /// Its first front.
    first: usize,
    /// What its fronts keep of their elimination.
    factors: &'a mut [f32],
    /// Right-hand side, then solution, at the pivots and at the border of each front, both padded.
    vectors: &'a mut [f32],
    /// Fronts whose nodes and children are all unlinked.
    idle: &'a mut [bool],
    /// One for each lane.
    scratch: &'a mut [Vec<f32>],
}

/// Where the values of each front start.
#[derive(Debug, Clone, Default)]
pub(super) struct Starts {
    /// In the factors of all.
    factors: Vec<usize>,
    /// In the vectors of all.
    pub(super) vectors: Vec<usize>,
}

/// The tree of fronts with what they own.
#[derive(Debug)]
pub(super) struct Tree {
    /// In the order of elimination.
    pub(super) fronts: Vec<Front>,
    /// Where each front's values begin.
    pub(super) starts: Starts,
    /// Right-hand sides, then solutions, front by front.
    pub(super) vectors: Vec<f32>,
    /// What all fronts keep of their elimination, front by front.
    factors: Vec<f32>,
    /// What fronts leave for their parents, on two stacks: those of a front and of its grandchildren, those
    /// of its children.
    remainders: [Vec<f32>; 2],
    /// What a branch needs of the stack of its last front and of the other.
    depths: Vec<[usize; 2]>,
    /// Fronts whose nodes and children are all unlinked.
    idle: Vec<bool>,
    /// Work space, one for each lane.
    scratch: Vec<Vec<f32>>,
}

impl Tree {
    /// Room for all fronts of a `dissection` that so many `lanes` work on.
    pub(super) fn new(dissection: Dissection, lanes: usize) -> Self {
        let fronts = dissection.fronts;
        let mut starts = Starts::default();
        let (mut factors, mut vectors, mut widest) = (0, 0, 0);
        for front in &fronts {
            starts.factors.push(factors);
            starts.vectors.push(vectors);
            factors += front.factors();
            vectors += front.pivot_rows() + front.border_rows();
            widest = widest.max(front.scratch());
        }
        let depths = depths(&fronts, lanes);
        let remainders = depths.last().copied().unwrap_or_default().map(|depth| vec![0.0; depth]);
        Self {
            factors: vec![0.0; factors],
            vectors: vec![0.0; vectors],
            remainders,
            depths,
            idle: vec![false; fronts.len()],
            scratch: vec![vec![0.0; widest]; lanes],
            fronts,
            starts,
        }
    }

    /// What does not change while the tree is walked, the whole tree as a branch, and the two stacks.
    fn parts(&mut self) -> (Walk<'_>, Branch<'_>, [&mut [f32]; 2]) {
        let Self { fronts, starts, factors, vectors, remainders: [own, other], depths, idle, scratch } = self;
        let branch = Branch { first: 0, factors, vectors, idle, scratch };
        (Walk { fronts, starts, depths, arch: Arch::new() }, branch, [own, other])
    }

    /// Eliminates all fronts of the matrix `scaled`, of whose nodes `linked` says which have entries beside
    /// the diagonal. Returns whether all pivots were numbers.
    pub(super) fn eliminate(&mut self, scaled: &[f32], linked: &[bool]) -> bool {
        let root = self.fronts.len() - 1;
        let (walk, branch, stacks) = self.parts();
        walk.eliminate(root, branch, stacks, Matrix { scaled, linked })
    }

    /// Turns the right-hand side in the pivot rows of `vectors` into the solution.
    pub(super) fn substitute(&mut self) {
        let root = self.fronts.len() - 1;
        let (walk, mut branch, _) = self.parts();
        walk.forward(root, branch.all());
        walk.backward(root, branch);
    }
}

/// What the branch of each front needs of both stacks: branches that run side by side have parts of their
/// own.
fn depths(fronts: &[Front], lanes: usize) -> Vec<[usize; 2]> {
    let mut lanes_of = vec![lanes; fronts.len()];
    for (f, front) in fronts.iter().enumerate().rev() {
        let half = lanes_of[f] / 2;
        for (child, lanes) in front.children.iter().zip([half, lanes_of[f] - half]) {
            lanes_of[child.front] = lanes.max(1);
        }
    }
    let mut depths: Vec<[usize; 2]> = Vec::with_capacity(fronts.len());
    for (f, front) in fronts.iter().enumerate() {
        let [mut own, mut other] = [front.remainder(), 0];
        if let [one, two] = front.children.as_slice() {
            let ([one_own, one_other], [two_own, two_other]) = (depths[one.front], depths[two.front]);
            if lanes_of[f] > 1 {
                own = own.max(one_other + two_other);
                other = one_own + two_own;
            } else {
                own = own.max(one_other).max(two_other);
                other = one_own.max(fronts[one.front].remainder() + two_own);
            }
        }
        depths.push([own, other]);
    }
    depths
}

impl Branch<'_> {
    /// The same branch, borrowed for a shorter time.
    #[inline(always)]
    fn all(&mut self) -> Branch<'_> {
        Branch {
            first: self.first,
            factors: self.factors,
            vectors: self.vectors,
            idle: self.idle,
            scratch: self.scratch,
        }
    }
}

/// The matrix of an elimination.
#[derive(Debug, Clone, Copy)]
struct Matrix<'a> {
    /// Its entries, scaled.
    scaled: &'a [f32],
    /// Whether a place has entries beside its diagonal.
    linked: &'a [bool],
}

/// The ways along the tree.
#[derive(Debug, Clone, Copy)]
struct Walk<'a> {
    /// All fronts.
    fronts: &'a [Front],
    /// Where the values of each begin.
    starts: &'a Starts,
    /// What each branch needs of both stacks.
    depths: &'a [[usize; 2]],
    /// Vector instructions of the machine.
    arch: Arch,
}

/// A half of a substitution on fronts that follow one another.
struct Substitution<'a, 'b> {
    /// The tree.
    walk: Walk<'a>,
    /// Which fronts.
    fronts: Range<usize>,
    /// What they own.
    branch: Branch<'b>,
    /// Whether from the leaves to the root.
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
    /// Substitutes on the fronts, in their order forward and against it backward.
    #[inline(always)]
    fn work<S: Simd>(mut self, simd: S) {
        if self.forward {
            for f in self.fronts {
                self.walk.forward_front(simd, f, self.branch.all());
            }
        } else {
            for f in self.fronts.rev() {
                self.walk.backward_front(simd, f, self.branch.all());
            }
        }
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
        let Branch { first, factors, vectors, idle, scratch } = branch;
        let factors = cut(factors, &self.starts.factors, first, at);
        let vectors = cut(vectors, &self.starts.vectors, first, at);
        let idle = idle.split_at_mut(at - first);
        let lanes = scratch.len();
        let scratch = scratch.split_at_mut(lanes / 2);
        (
            Branch { first, factors: factors.0, vectors: vectors.0, idle: idle.0, scratch: scratch.0 },
            Branch { first: at, factors: factors.1, vectors: vectors.1, idle: idle.1, scratch: scratch.1 },
        )
    }

    /// The two branches of a front if there is more than one lane for them.
    fn fork(&self, root: usize, branch: &Branch<'_>) -> Option<[usize; 2]> {
        match self.fronts[root].children.as_slice() {
            [one, other] if branch.scratch.len() > 1 => Some([one.front, other.front]),
            _ => None,
        }
    }

    /// Eliminates the fronts of a branch, whose last is `root`, with the remainder of that on the first
    /// stack. Returns whether all pivots were numbers.
    fn eliminate(
        &self,
        root: usize,
        mut branch: Branch<'_>,
        [own, other]: [&mut [f32]; 2],
        matrix: Matrix<'_>,
    ) -> bool {
        let front = &self.fronts[root];
        let (mut sound, mut second) = (true, 0);
        if let [one, two] = front.children.as_slice() {
            let (one, two) = (one.front, two.front);
            if branch.scratch.len() > 1 {
                second = self.depths[one][0];
                let (left, right) = self.split(branch.all(), one + 1);
                let (one_own, two_own) = other.split_at_mut(second);
                let (one_other, two_other) = own.split_at_mut(self.depths[one][1]);
                let sounds = both(
                    || self.eliminate(one, left, [one_own, one_other], matrix),
                    || self.eliminate(two, right, [two_own, two_other], matrix),
                );
                sound = sounds.0 && sounds.1;
            } else {
                second = self.fronts[one].remainder();
                sound &= self.eliminate(one, branch.all(), [&mut *other, &mut *own], matrix);
                sound &= self.eliminate(two, branch.all(), [&mut other[second..], &mut *own], matrix);
            }
        }
        let Branch { first, factors, idle, scratch, .. } = branch;
        let start = self.starts.factors[root] - self.starts.factors[first];
        let values = &mut factors[start..][..front.factors()];
        idle[root - first] = front.children.iter().all(|child| idle[child.front - first])
            && matrix.linked[front.pivots.clone()].iter().all(|&linked| !linked);
        if idle[root - first] {
            let diagonal = front.entries.iter().filter(|entry| entry.from % STENCIL == 0);
            for (value, entry) in values.iter_mut().zip(diagonal) {
                let pivot = raised(matrix.scaled[entry.from], SMALLEST_PIVOT);
                sound &= pivot.is_finite();
                *value = 1.0 / pivot;
            }
            return sound;
        }
        let mut children = [None; 2];
        for ((child, left), start) in front.children.iter().zip(&mut children).zip([0, second]) {
            if !idle[child.front - first] {
                let front = &self.fronts[child.front];
                let values = &other[start..][..front.remainder()];
                *left = Some(Block { values, stride: front.border_rows() });
            }
        }
        let Some(scratch) = scratch.first_mut() else { return false };
        let remainder = &mut own[..front.remainder()];
        let scaled = matrix.scaled;
        self.arch.dispatch(Elimination { front, scaled, values, children, remainder, scratch }) && sound
    }

    /// Turns right-hand sides into what the pivots make of them, from the leaves to the root.
    fn forward(&self, root: usize, mut branch: Branch<'_>) {
        let Some([one, other]) = self.fork(root, &branch) else {
            self.run(self.fronts[root].first..root + 1, branch, true);
            return;
        };
        let (left, right) = self.split(branch.all(), one + 1);
        both(|| self.forward(one, left), || self.forward(other, right));
        self.run(root..root + 1, branch, true);
    }

    /// Adds what the borders make of the pivots, from the root to the leaves.
    fn backward(&self, root: usize, mut branch: Branch<'_>) {
        let Some([one, other]) = self.fork(root, &branch) else {
            self.run(self.fronts[root].first..root + 1, branch, false);
            return;
        };
        self.run(root..root + 1, branch.all(), false);
        let (left, right) = self.split(branch, one + 1);
        both(|| self.backward(one, left), || self.backward(other, right));
    }

    /// Substitutes on fronts that follow one another, with the vector instructions of the machine.
    fn run(&self, fronts: Range<usize>, branch: Branch<'_>, forward: bool) {
        self.arch.dispatch(Substitution { walk: *self, fronts, branch, forward });
    }

    /// Gathers what the children leave at the pivots of front `f` and eliminates it.
    #[inline(always)]
    fn forward_front<S: Simd>(&self, simd: S, f: usize, branch: Branch<'_>) {
        let Branch { first, factors, vectors, idle, scratch, .. } = branch;
        if idle[f - first] {
            return;
        }
        let front = &self.fronts[f];
        let rows = front.pivot_rows();
        let start = self.starts.vectors[f] - self.starts.vectors[first];
        let (below, own) = vectors.split_at_mut(start);
        let own = &mut own[..rows + front.border_rows()];
        own[rows..].fill(0.0);
        for child in front.children.iter().filter(|child| !idle[child.front - first]) {
            let start = self.starts.vectors[child.front] - self.starts.vectors[first];
            add_runs(own, &below[start + self.fronts[child.front].pivot_rows()..], &child.runs, 0);
        }
        let Some(scratch) = scratch.first_mut() else { return };
        let start = self.starts.factors[f] - self.starts.factors[first];
        front.forward(simd, &mut factors[start..][..front.factors()], own, scratch);
    }

    /// Solution at the pivots of front `f` from that at its border, which its children then take over.
    #[inline(always)]
    fn backward_front<S: Simd>(&self, simd: S, f: usize, branch: Branch<'_>) {
        let Branch { first, factors, vectors, idle, scratch } = branch;
        let front = &self.fronts[f];
        let rows = front.pivot_rows();
        let start = self.starts.vectors[f] - self.starts.vectors[first];
        let (below, own) = vectors.split_at_mut(start);
        let own = &mut own[..rows + front.border_rows()];
        let start = self.starts.factors[f] - self.starts.factors[first];
        let values = &mut factors[start..][..front.factors()];
        if idle[f - first] {
            for (value, inverse) in own[..front.pivots.len()].iter_mut().zip(values) {
                *value *= *inverse;
            }
            return;
        }
        let Some(scratch) = scratch.first_mut() else { return };
        front.backward(simd, values, own, scratch);
        for child in front.children.iter().filter(|child| !idle[child.front - first]) {
            let start = self.starts.vectors[child.front] - self.starts.vectors[first];
            let to = &mut below[start + self.fronts[child.front].pivot_rows()..];
            for run in &child.runs {
                to[run.from..][..run.length].copy_from_slice(&own[run.to..][..run.length]);
            }
        }
    }
}
