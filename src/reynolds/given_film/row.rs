//! Results along one row of cells: pressure profile, friction, reformation.
//!
//! Between two nodes the pressure is linear on each piece, with a kink at the joint. The load is the integral
//! of this profile. The friction on each surface is `theta eta (u_2 - u_1)/h`, with the film fraction `theta`,
//! plus its share `h/2 dp/dx` of the pressure force, with the factors of the roughness. The film reforms where the entrained fluid fills the gap.

use super::newton::Solved;
use super::{EAST, GivenFilm, WEST};
use crate::grid::Grid;

/// Error of a position over the length of the box.
const ROUNDING: f64 = 1e-12;

/// The edges of the box across x \[m\].
pub(super) fn edges(grid: Grid) -> [f64; 2] {
    let west = grid.x(0) - 0.5 * grid.dx();
    [west, west + grid.size_x()]
}

/// Lengths of the two pieces of the interval that ends at node `(i, j)` \[m\].
pub(super) fn lengths(problem: &GivenFilm<'_>, i: usize, j: usize) -> [f64; 2] {
    let grid = problem.film.grid();
    let is_half = !problem.is_periodic && (i == 0 || i == grid.nx());
    let whole = if is_half { 0.5 * grid.dx() } else { grid.dx() };
    let share = problem.interval(problem.film, i, j).share;
    [share * whole, (1.0 - share) * whole]
}

/// The interval from one node of a row to the next.
struct Segment {
    /// The node at its end.
    node: [usize; 2],
    /// Its start \[m\].
    from: f64,
    /// Lengths of its two pieces \[m\].
    lengths: [f64; 2],
    /// Pressures at its ends \[Pa\].
    pressures: [f64; 2],
}

/// A row of cells, entrained along +x.
#[derive(Debug)]
pub(super) struct Row {
    /// Positions \[m\] and pressures \[Pa\] from edge to edge, linear in between.
    pub(super) profile: Vec<[f64; 2]>,
    /// Shear force on the lower and upper surface over the width of the row \[N/m\].
    pub(super) friction: [f64; 2],
    /// Part of the shear by sliding in cavitated fluid \[N/m\].
    pub(super) cavitated_shear: f64,
    /// Position of the first reformation \[m\].
    pub(super) reformation: Option<f64>,
}

impl Row {
    /// Row `j` of a solved problem, from edge to edge.
    pub(super) fn new(problem: &GivenFilm<'_>, solved: &Solved<'_>, j: usize) -> Self {
        let grid = problem.film.grid();
        let [west, _] = edges(grid);
        let mut row = Self {
            profile: Vec::with_capacity(2 * grid.nx() + 3),
            friction: [0.0; 2],
            cavitated_shear: 0.0,
            reformation: None,
        };
        // From edge to edge, node by node; over a period from its first node to the same node again.
        let at_node = |i: usize| {
            let k = j * grid.nx() + i;
            solved.balance.pressure(k, solved.unknowns[k])
        };
        let (start, x_start, [first, last]) = if problem.is_periodic {
            (1, grid.x(0), [at_node(0); 2])
        } else {
            (0, west, [WEST, EAST].map(|edge| problem.end_pressure(edge, j, grid)))
        };
        row.profile.push([x_start, first]);
        let (mut before, mut x) = (first, x_start);
        for i in start..=grid.nx() {
            // The pressure of the next node, or of the edge behind the last one.
            let after = if i < grid.nx() { at_node(i) } else { last };
            let lengths = lengths(problem, i, j);
            // Add friction and cavitation of the way between the two.
            row.walk(
                problem,
                solved,
                &Segment { node: [i, j], from: x, lengths, pressures: [before, after] },
            );
            x += lengths[0] + lengths[1];
            row.profile.push([x, after]);
            before = after;
        }
        if problem.is_periodic {
            row.wrap([west, west + grid.size_x()]);
        }
        row
    }

    /// Moves the part of a period beyond the last of its `ends` to the first one.
    fn wrap(&mut self, ends: [f64; 2]) {
        let [west, east] = ends;
        let count = self.profile.len();
        // The joint of the last interval lies at the end.
        let inside = self.profile.partition_point(|point| point[0] < east + ROUNDING * (east - west));
        if let Some(&[_, pressure]) = self.profile[..inside].last() {
            self.profile.rotate_left(inside);
            let beyond = count - inside;
            for point in &mut self.profile[..beyond] {
                point[0] -= east - west;
            }
            self.profile.insert(0, [west, pressure]);
        }
        if let Some(front) = self.reformation.as_mut().filter(|front| **front > east) {
            *front -= east - west;
        }
    }

    /// Integral of the pressure along the row \[N/m\].
    pub(super) fn load(&self) -> f64 {
        self.profile.windows(2).map(|ends| 0.5 * (ends[1][0] - ends[0][0]) * (ends[0][1] + ends[1][1])).sum()
    }

    /// Adds one interval.
    fn walk(&mut self, problem: &GivenFilm<'_>, solved: &Solved<'_>, segment: &Segment) {
        let Segment { node: [i, j], from: x, lengths, pressures } = *segment;
        let balance = &solved.balance;
        let pieces = problem.pieces(problem.film, i, j);
        let [first, second] = balance.ends_along(i, j);
        let flow = balance.flow_along(i, j);
        let density = 0.5 * (first.density + second.density);
        // Rise of the reduced pressure over a full piece.
        let [rise, further] = pieces.map(|piece| {
            let whole = balance.entrained * density * piece.squares - flow.value * piece.cubes;
            balance.drag * balance.free_share(i, j) * whole
        });
        // Reduced pressure at the joint of the two pieces.
        let cavitated = first.theta < 1.0;
        let potential = if flow.ruptured {
            0.0
        } else if !cavitated {
            (first.potential + rise).max(0.0)
        } else if second.potential > 0.0 {
            (second.potential - further).max(0.0)
        } else {
            0.0
        };
        let middle = if cavitated || flow.ruptured {
            balance.pressure_beside(pressures[1], second.potential, potential)
        } else {
            balance.pressure_beside(pressures[0], first.potential, potential)
        };
        let split = x + lengths[0];
        if second.potential > 0.0 && (cavitated || flow.ruptured) {
            let front = if potential > 0.0 {
                split - lengths[0] * share(potential, rise)
            } else {
                split + lengths[1] * (1.0 - share(second.potential, further))
            };
            self.reformation.get_or_insert(front);
            // Sort the reformation point and the joint by x.
            let [one, other] = if front < split {
                [[front, problem.cavitation_pressure], [split, middle]]
            } else {
                [[split, middle], [front, problem.cavitation_pressure]]
            };
            self.profile.extend([one, other]);
        } else {
            self.profile.push([split, middle]);
        }
        // Film fraction behind a rupture, by the flow.
        let behind = if flow.ruptured {
            (flow.value / (balance.cavitated_density * pieces[1].film())).min(1.0)
        } else {
            first.theta
        };
        let ends = [[pressures[0], middle], [middle, pressures[1]]];
        let nominal = problem.interval(problem.film, i, j).pieces;
        for (((piece, length), theta), ends) in
            nominal.iter().zip(lengths).zip([first.theta, behind]).zip(ends)
        {
            self.shear(problem, piece.film(), (length, theta), ends);
        }
    }

    /// Adds the friction of a piece of the `length` and of the film fraction `theta` between pressures at its ends.
    fn shear(
        &mut self,
        problem: &GivenFilm<'_>,
        film: f64,
        (length, theta): (f64, f64),
        [from, to]: [f64; 2],
    ) {
        let sliding = problem.speeds[1] - problem.speeds[0];
        let viscosity = problem.lubricant.viscosity().viscosity(0.5 * (from + to));
        // Couette and Poiseuille parts, with the factors of rough surfaces.
        let by_sliding = viscosity * theta * sliding * length / film;
        let [lower, upper, gradient] = problem.roughness.map_or([1.0; 3], |rough| rough.shear_factors(film));
        let by_pressure = gradient * 0.5 * film * (to - from);
        if theta < 1.0 {
            self.cavitated_shear += 0.5 * (lower + upper) * by_sliding.abs();
        }
        self.friction[0] += lower * by_sliding - by_pressure;
        self.friction[1] -= upper * by_sliding + by_pressure;
    }
}

/// Length share of a piece that produces `part` of its pressure rise `rise`.
fn share(part: f64, rise: f64) -> f64 {
    if rise > part { part / rise } else { 1.0 }
}
