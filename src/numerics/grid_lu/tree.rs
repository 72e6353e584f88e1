//! The tree of fronts with what they own; its branches are worked on side by side.
//!
//! Fronts are in the order in which they are eliminated, children before their parents, so that a branch is a
//! range of fronts that follow one another and owns slices of factors and vectors. Remainders live on two
//! stacks, as they are used up in the order in which they come.

use std::ops::Range;

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::Matrix;
use super::dense::{Block, VECTOR};
use super::dissection::{Dissection, Piece};
use super::front::{Elimination, add_runs};
use super::structure::{Front, Structure};
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
    /// One for each lane.
    scratch: &'a mut [Vec<f32>],
}

/// The tree of fronts with what they own.
#[derive(Debug)]
pub(super) struct Tree {
    /// The pieces that the fronts are of.
    dissection: Dissection,
    /// The fronts of the matrix.
    pub(super) structure: Structure,
    /// Right-hand sides, then solutions, front by front.
    vectors: Vec<f32>,
    /// What all fronts keep of their elimination, front by front.
    factors: Vec<f32>,
    /// What fronts leave for their parents, on two stacks: those of a front and of its grandchildren, those
    /// of its children.
    remainders: [Vec<f32>; 2],
    /// What a branch needs of the stack of its last front and of the other.
    depths: Vec<[usize; 2]>,
    /// Threads that may work on branches of each front.
    lanes: Vec<usize>,
    /// Work space, one for each lane.
    scratch: Vec<Vec<f32>>,
}

impl Tree {
    /// Room for all matrices on a grid of `nx` x `ny` nodes, that so many `lanes` work on. Memory that smaller
    /// fronts leave untouched is none.
    pub(super) fn new(nx: usize, ny: usize, lanes: usize) -> Self {
        let dissection = Dissection::new(nx, ny);
        let structure = Structure::full(&dissection, nx, ny);
        let scratch = structure.fronts.iter().map(Front::scratch).max().unwrap_or_default();
        let mut tree = Self {
            vectors: vec![0.0; structure.vectors],
            factors: vec![0.0; structure.factors],
            remainders: Default::default(),
            depths: Vec::with_capacity(structure.fronts.len()),
            lanes: lanes_of(&dissection.pieces, lanes),
            scratch: vec![vec![0.0; scratch]; lanes],
            dissection,
            structure,
        };
        tree.find_depths();
        tree.remainders = tree.depths.last().copied().unwrap_or_default().map(|depth| vec![0.0; depth]);
        tree
    }

    /// Takes over a matrix (see [`Structure::update`]).
    pub(super) fn update(&mut self, links: impl Fn(usize, usize) -> bool) {
        self.structure.update(&self.dissection, links);
        self.find_depths();
    }

    /// What does not change while the tree is walked, the whole tree as a branch, and the two stacks.
    fn parts(&mut self) -> (Walk<'_>, Branch<'_>, [&mut [f32]; 2]) {
        let Self {
            dissection, structure, factors, vectors, remainders: [own, other], depths, scratch, ..
        } = self;
        let branch = Branch { first: 0, factors, vectors, scratch };
        (Walk { pieces: &dissection.pieces, structure, depths, arch: Arch::new() }, branch, [own, other])
    }

    /// Eliminates all fronts of a matrix. Returns whether all pivots were numbers.
    pub(super) fn eliminate(&mut self, matrix: Matrix<'_>) -> bool {
        let root = self.structure.fronts.len() - 1;
        let (walk, branch, stacks) = self.parts();
        walk.eliminate(root, branch, stacks, matrix)
    }

    /// Turns the right-hand side at the nodes that are linked into the solution.
    pub(super) fn solve(&mut self, rhs: &mut [f32]) {
        for front in &self.structure.fronts {
            let nodes = &self.structure.nodes[front.pivots.clone()];
            for (right, &node) in self.vectors[front.vectors_at..].iter_mut().zip(nodes) {
                *right = rhs[node as usize];
            }
        }
        let root = self.structure.fronts.len() - 1;
        let (walk, mut branch, _) = self.parts();
        walk.forward(root, branch.all());
        walk.backward(root, branch);
        for front in &self.structure.fronts {
            let nodes = &self.structure.nodes[front.pivots.clone()];
            for (solution, &node) in self.vectors[front.vectors_at..].iter().zip(nodes) {
                rhs[node as usize] = *solution;
            }
        }
    }

    /// What the branch of each front needs of both stacks: branches that run side by side have parts of their
    /// own.
    fn find_depths(&mut self) {
        let Self { dissection, structure: Structure { fronts, .. }, depths, lanes, .. } = self;
        depths.clear();
        for (f, (piece, front)) in dissection.pieces.iter().zip(&*fronts).enumerate() {
            let [mut own, mut other] = [front.remainder(), 0];
            if let Some([one, two]) = piece.halves {
                let ([one_own, one_other], [two_own, two_other]) = (depths[one], depths[two]);
                if lanes[f] > 1 {
                    own = own.max(one_other + two_other);
                    other = one_own + two_own;
                } else {
                    own = own.max(one_other).max(two_other);
                    other = one_own.max(fronts[one].remainder() + two_own);
                }
            }
            depths.push([own, other]);
        }
    }
}

/// How many of `lanes` may work on branches of each piece.
fn lanes_of(pieces: &[Piece], lanes: usize) -> Vec<usize> {
    let mut lanes_of = vec![lanes; pieces.len()];
    for (f, piece) in pieces.iter().enumerate().rev() {
        let half = lanes_of[f] / 2;
        for (child, lanes) in piece.halves.into_iter().flatten().zip([half, lanes_of[f] - half]) {
            lanes_of[child] = lanes.max(1);
        }
    }
    lanes_of
}

impl Branch<'_> {
    /// The same branch, borrowed for a shorter time.
    #[inline(always)]
    fn all(&mut self) -> Branch<'_> {
        Branch { first: self.first, factors: self.factors, vectors: self.vectors, scratch: self.scratch }
    }
}

/// The ways along the tree.
#[derive(Debug, Clone, Copy)]
struct Walk<'a> {
    /// All pieces.
    pieces: &'a [Piece],
    /// All fronts.
    structure: &'a Structure,
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

impl Walk<'_> {
    /// The branch up to front `at`, and what follows.
    fn split<'b>(&self, branch: Branch<'b>, at: usize) -> (Branch<'b>, Branch<'b>) {
        let Branch { first, factors, vectors, scratch } = branch;
        let (from, to) = (&self.structure.fronts[first], &self.structure.fronts[at]);
        let factors = factors.split_at_mut(to.factors_at - from.factors_at);
        let vectors = vectors.split_at_mut(to.vectors_at - from.vectors_at);
        let lanes = scratch.len();
        let scratch = scratch.split_at_mut(lanes / 2);
        (
            Branch { first, factors: factors.0, vectors: vectors.0, scratch: scratch.0 },
            Branch { first: at, factors: factors.1, vectors: vectors.1, scratch: scratch.1 },
        )
    }

    /// The two branches of a front if there is more than one lane for them.
    fn fork(&self, root: usize, branch: &Branch<'_>) -> Option<[usize; 2]> {
        self.pieces[root].halves.filter(|_| branch.scratch.len() > 1)
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
        let structure = self.structure;
        let (mut sound, mut second) = (true, 0);
        if let Some([one, two]) = self.fork(root, &branch) {
            second = self.depths[one][0];
            let (left, right) = self.split(branch.all(), one + 1);
            let (one_own, two_own) = other.split_at_mut(second);
            let (one_other, two_other) = own.split_at_mut(self.depths[one][1]);
            let sounds = both(
                || self.eliminate(one, left, [one_own, one_other], matrix),
                || self.eliminate(two, right, [two_own, two_other], matrix),
            );
            sound = sounds.0 && sounds.1;
        } else if let Some([one, two]) = self.pieces[root].halves {
            second = structure.fronts[one].remainder();
            sound &= self.eliminate(one, branch.all(), [&mut *other, &mut *own], matrix);
            sound &= self.eliminate(two, branch.all(), [&mut other[second..], &mut *own], matrix);
        }
        let front = &structure.fronts[root];
        let Branch { first, factors, scratch, .. } = branch;
        let Some(scratch) = scratch.first_mut().filter(|_| !front.is_empty()) else { return sound };
        let values = &mut factors[front.factors_at - structure.fronts[first].factors_at..][..front.factors()];
        let mut children = [None; 2];
        if let Some(halves) = self.pieces[root].halves {
            for ((child, left), start) in halves.into_iter().zip(&mut children).zip([0, second]) {
                let child = &structure.fronts[child];
                let values = &other[start..][..child.remainder()];
                let block = Block { values, stride: child.border_rows() };
                *left = (!values.is_empty()).then(|| (block, structure.runs(child)));
            }
        }
        let remainder = &mut own[..front.remainder()];
        let work = Elimination { front, structure, matrix, values, children, remainder, scratch };
        self.arch.dispatch(work) && sound
    }

    /// Turns right-hand sides into what the pivots make of them, from the leaves to the root.
    fn forward(&self, root: usize, mut branch: Branch<'_>) {
        let Some([one, other]) = self.fork(root, &branch) else {
            self.run(self.pieces[root].first..root + 1, branch, true);
            return;
        };
        let (left, right) = self.split(branch.all(), one + 1);
        both(|| self.forward(one, left), || self.forward(other, right));
        self.run(root..root + 1, branch, true);
    }

    /// Adds what the borders make of the pivots, from the root to the leaves.
    fn backward(&self, root: usize, mut branch: Branch<'_>) {
        let Some([one, other]) = self.fork(root, &branch) else {
            self.run(self.pieces[root].first..root + 1, branch, false);
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

    /// What front `f` keeps and its vector, those of the fronts before it, and work space.
    #[inline(always)]
    fn open<'b>(&self, f: usize, branch: Branch<'b>) -> Option<(&'b mut [f32], [&'b mut [f32]; 3])> {
        let Branch { first, factors, vectors, scratch } = branch;
        let (from, front) = (&self.structure.fronts[first], &self.structure.fronts[f]);
        let (below, own) = vectors.split_at_mut(front.vectors_at - from.vectors_at);
        let own = &mut own[..front.pivot_rows() + front.border_rows()];
        let values = &mut factors[front.factors_at - from.factors_at..][..front.factors()];
        let scratch = scratch.first_mut().filter(|_| !front.is_empty())?;
        Some((below, [values, own, scratch]))
    }

    /// Where the border of a front is in the vectors of those from front `first` on.
    #[inline(always)]
    fn border_at(&self, front: &Front, first: usize) -> usize {
        front.vectors_at + front.pivot_rows() - self.structure.fronts[first].vectors_at
    }

    /// Gathers what the children leave at the pivots of front `f` and eliminates it.
    #[inline(always)]
    fn forward_front<S: Simd>(&self, simd: S, f: usize, branch: Branch<'_>) {
        let (structure, first) = (self.structure, branch.first);
        let front = &structure.fronts[f];
        let Some((below, [values, own, scratch])) = self.open(f, branch) else { return };
        own[front.pivot_rows()..].fill(0.0);
        for child in self.pieces[f].halves.into_iter().flatten() {
            let child = &structure.fronts[child];
            add_runs(own, &below[self.border_at(child, first)..], structure.runs(child), 0);
        }
        front.forward(simd, structure.edges(front), [values, own, scratch]);
    }

    /// Solution at the pivots of front `f` from that at its border, which its children then take over.
    #[inline(always)]
    fn backward_front<S: Simd>(&self, simd: S, f: usize, branch: Branch<'_>) {
        let (structure, first) = (self.structure, branch.first);
        let front = &structure.fronts[f];
        let Some((below, [values, own, scratch])) = self.open(f, branch) else { return };
        front.backward(simd, structure.edges(front), [values, own, scratch]);
        for child in self.pieces[f].halves.into_iter().flatten() {
            let child = &structure.fronts[child];
            let to = &mut below[self.border_at(child, first)..];
            for run in structure.runs(child) {
                to[run.from as usize..][..run.length as usize].copy_from_slice(&own[run.rows()]);
            }
        }
    }
}
