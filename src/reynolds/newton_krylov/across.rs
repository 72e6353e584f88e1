//! What turning surfaces carry from row to row, linearised.
//!
//! A change goes on through nodes that are not filled, in shares: along x to the next column, and across to
//! the next row. Columns are gone through one after the other, each along its flow.

use super::linearisation::{FaceFlows, keep, single};
use crate::grid::Grid;
use crate::numerics::STENCIL;
use crate::reynolds::flow::{Course, Discretisation};

/// Derivatives of what turning surfaces carry through the faces to the north of the nodes, and its changes.
#[derive(Debug)]
pub(super) struct Across {
    /// Nodes in a row.
    nx: usize,
    /// Which way fluid is carried along the columns.
    course: Course,
    /// Derivatives, by face.
    pub(super) faces: FaceFlows,
    /// Changes of what is carried through these faces.
    pub(super) change: Vec<f32>,
    /// Changes of what is carried through the faces to the east.
    sent: Vec<f32>,
    /// What nodes that are not filled carry on to the next row of a change of their inflow; zero elsewhere.
    passed: Vec<f32>,
    /// Share of the gaps that is filled.
    content: Vec<f32>,
}

impl Across {
    pub(super) fn new(grid: &Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self {
            nx: grid.nx(),
            course: Course::default(),
            faces: std::array::from_fn(|_| zeros()),
            change: zeros(),
            sent: zeros(),
            passed: zeros(),
            content: zeros(),
        }
    }

    /// Takes the derivatives at the last update of `fluid`, whose surfaces carry along `course`.
    pub(super) fn update(&mut self, fluid: &Discretisation, course: &Course, stiffness: f64) {
        self.course.clone_from(course);
        for k in 0..self.change.len() - self.nx {
            keep(&mut self.faces, k, fluid.across_derivatives(k), stiffness);
        }
        for (k, passed) in self.passed.iter_mut().enumerate() {
            *passed = single(fluid.passed_across(k));
        }
        for (content, of_node) in self.content.iter_mut().zip(fluid.content()) {
            *content = single(*of_node);
        }
    }

    /// Adds to the changes of flow by pressure in `out` what is carried under the changes `mass` of the nodes
    /// and `beyond` them; `passed` is what nodes carry on along x, `upwind` the coefficients of the masses in
    /// each row.
    pub(super) fn carry(
        &mut self,
        mass: &[f32],
        beyond: &[f32],
        passed: &[f32],
        upwind: &[[f32; 2]],
        out: &mut [f32],
    ) {
        let nx = self.nx;
        let Self { course, change, sent, content, .. } = self;
        for (j, [_, up]) in upwind.iter().enumerate() {
            sent[j * nx] = beyond[j * nx] - up * mass[j * nx];
        }
        for k in (1..nx - 1).flat_map(|i| course.downstream(i)) {
            let ([enters, leaves], sign, [here, up]) = (course.faces(k), course.sign(k), upwind[k / nx]);
            let flow = out[k] - sent[k - 1] - sign * change[enters];
            // What leaves a full gap, along x and across it.
            let (east, next) = (beyond[k] - up * mass[k], sign * change[leaves]);
            let stored = (here + up) * mass[k];
            out[k] = flow + stored + east + next;
            sent[k] = east;
            if passed[k] > 0.0 {
                // What its own gap lets out, and its share of what enters less what that takes.
                let left = flow + content[k] * (stored + east + next);
                sent[k] = content[k] * east - passed[k] * left;
                change[leaves] = sign * (content[k] * next - self.passed[k] * left);
            }
        }
    }

    /// Adds to the `row` of node `k` of the fluid block what is carried through its two faces; arguments as of
    /// [`Linearisation::stencil_row`](super::linearisation::Linearisation::stencil_row), `passed` being what
    /// nodes carry on along x.
    pub(super) fn add_to_row(
        &self,
        k: usize,
        row: &mut [f32; STENCIL],
        follows: impl Fn(usize) -> [f32; 2],
        (linked, passed): (&[bool], &[f32]),
    ) {
        let (nx, [enters, _]) = (self.nx, self.course.faces(k));
        let share = if linked[k] { passed[k] } else { 1.0 };
        let by_unknown = |[p, h]: [f32; 2], o: usize| {
            let [pressure, film] = follows(o);
            p * pressure + h * film
        };
        let [_, _, _, north, south] = row;
        let mut own = 0.0;
        for (entry, o, face) in [(north, k + nx, k), (south, k - nx, k - nx)] {
            let is_north = o > k;
            if face == enters {
                if linked[o] {
                    *entry -= share * self.passed[o] / passed[o];
                    continue;
                }
            } else if linked[k] {
                continue;
            }
            let [first_p, second_p, first_h, second_h] = self.faces.each_ref().map(|by| by[face]);
            let (first, second) = ([first_p, first_h], [second_p, second_h]);
            let (sign, here, there) = if is_north { (share, first, second) } else { (-share, second, first) };
            own += sign * by_unknown(here, k);
            *entry += sign * by_unknown(there, o);
        }
        row[0] += own;
    }
}
