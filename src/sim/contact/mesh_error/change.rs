//! Error estimates from the change of a solution between a coarse and a fine mesh.
//!
//! Results of a mixed contact do not converge smoothly: asperities touch on one mesh and separate on the
//! next, and the totals may agree by chance. The estimates therefore add changes node by node, and those of
//! the mean film block by block, so that they do not cancel. The factors were fitted to random contacts and
//! tested on others, see `docs/errors.md`.

use crate::grid::Grid;
use crate::metrics::{CENTRAL, is_central};
use crate::report::Status;
use crate::reynolds::ContactState;
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::numbers::{ContactNumbers, FilmNumbers, FrictionNumbers, PressureNumbers};
use crate::sim::contact::solution::ContactSolution;
use crate::sim::scene::hertz::HertzContact;

/// Error of the load ratio over the load of the nodes that switch between solid and fluid.
const LOAD: f64 = 0.75;
/// The same for nodes that separate, but by less than the change of their film.
const NEARLY: f64 = 0.1;
/// Error of the area ratio over that of the load ratio.
const AREA: f64 = 0.6;
/// Error of the boundary friction over the load that switches.
const BOUNDARY: f64 = 0.75;
/// Error of the shear over the change of the fluid shear, node by node.
const SHEAR: f64 = 0.15;
/// Blocks along each axis of the central region; within a block changes of the film cancel.
const PIECES: usize = 4;
/// Error of the mean film over the changes of the film in these blocks.
const FILM: f64 = 1.2;
/// Error of a film or a pressure at one point over its change.
const POINT: f64 = 1.5;
/// Upper bound of the box error of the minimum film over that of the central film; measured 0.8 to 1.4.
pub(in crate::sim) const BOX_MINIMUM: f64 = 1.4;
/// Changes of the film below this fraction of the approach are rounding errors of a contact without film.
const NO_FILM: f64 = 1e-9;

/// A solved contact on one mesh.
pub(in crate::sim) struct Mesh<'a> {
    pub(in crate::sim) status: Status,
    pub(in crate::sim) grid: Grid,
    pub(in crate::sim) hertz: HertzContact,
    pub(in crate::sim) state: &'a ContactState,
    /// Shear stress of the fluid \[Pa\].
    pub(in crate::sim) shear: &'a [f64],
    pub(in crate::sim) film: FilmNumbers,
    pub(in crate::sim) pressure: PressureNumbers,
    pub(in crate::sim) contact: ContactNumbers,
    pub(in crate::sim) friction: FrictionNumbers,
    /// Boundary friction coefficient.
    pub(in crate::sim) boundary_friction: f64,
    /// Relative error of the central film by the box.
    pub(in crate::sim) box_error: f64,
}

impl<'a> From<&'a ContactSolution> for Mesh<'a> {
    fn from(solution: &'a ContactSolution) -> Self {
        Self {
            status: solution.report.status,
            grid: solution.grid,
            hertz: solution.hertz,
            state: &solution.state,
            shear: &solution.shear,
            film: solution.film,
            pressure: solution.pressure,
            contact: solution.contact,
            friction: solution.friction,
            boundary_friction: solution.boundary_friction,
            box_error: solution.box_error,
        }
    }
}

/// Estimates the errors of `fine` from `coarse`, the same contact on larger cells. `None` unless both converged.
pub(in crate::sim) fn estimate(coarse: &Mesh<'_>, fine: &Mesh<'_>) -> Option<ErrorEstimate> {
    if [coarse, fine].iter().any(|mesh| mesh.status != Status::Converged) {
        return None;
    }
    let change = Change::between(coarse, fine);
    let relative = |value: fn(&Mesh<'_>) -> f64| {
        let (change, now) = ((value(fine) - value(coarse)).abs(), value(fine).abs());
        if change <= NO_FILM * fine.state.approach.abs() { 0.0 } else { change / now }
    };
    let sides = (LOAD * change.sides).max(NEARLY * change.nearly);
    let fluid = 1.0 - fine.contact.load_ratio.min(coarse.contact.load_ratio);
    let load_ratio = sides.min(fluid.max(0.0));
    let edge = fine.contact.area_ratio - fine.contact.corrected_area_ratio;
    let friction = fine.friction.coefficient;
    let of_friction = |stress: f64| if friction > 0.0 { stress / friction } else { 0.0 };
    Some(ErrorEstimate {
        film_central: POINT * relative(|solution| solution.film.central) + fine.box_error,
        film_minimum: POINT * relative(|solution| solution.film.minimum) + BOX_MINIMUM * fine.box_error,
        pressure_max: POINT * relative(|solution| solution.pressure.max),
        film_mean_central: if fine.film.mean_central <= NO_FILM * fine.state.approach.abs() {
            0.0
        } else {
            FILM * change.film + fine.box_error
        },
        contact_load_ratio: load_ratio,
        contact_area_ratio: edge + AREA * sides,
        friction_coefficient: of_friction(
            BOUNDARY * fine.boundary_friction * load_ratio
                + SHEAR * change.shear
                + fine.friction.fluid * fine.box_error,
        ),
        film_by_box: fine.box_error,
    })
}

/// Changes summed over nodes. All but that of the film are relative to the load.
#[derive(Debug, Default)]
struct Change {
    /// Load of the nodes times the change of their solid share.
    sides: f64,
    /// Load of the nodes that separate by less than the change of their film.
    nearly: f64,
    /// Change of the fluid shear stress.
    shear: f64,
    /// Change of the mean film of each block of the central region, over the mean film of all.
    film: f64,
}

impl Change {
    /// Changes from `coarse`. Each cell of `fine` is compared with the cell of `coarse` that contains its node.
    fn between(coarse: &Mesh<'_>, fine: &Mesh<'_>) -> Self {
        let (mut sum, mut load) = (Self::default(), 0.0);
        let (mut pieces, mut films) = ([0.0; PIECES * PIECES], 0.0);
        for (k, (x, y)) in fine.grid.nodes().enumerate() {
            let before = cell_at(&coarse.grid, x, y);
            let pressure = fine.state.pressure[k];
            load += pressure;
            sum.shear += (fine.shear[k] - coarse.shear[before]).abs();
            let (now, then) = (solid_share(fine, k), solid_share(coarse, before));
            if let (Some(now), Some(then)) = (now, then) {
                sum.sides += pressure * (now - then).abs();
            }
            let film = fine.state.film[k];
            let change: f64 = film - coarse.state.film[before];
            if !fine.state.in_contact[k] && film - change.abs() <= fine.contact.film_cutoff {
                sum.nearly += pressure;
            }
            if let Some(piece) = piece_at(fine, x, y) {
                pieces[piece] += change;
                films += film;
            }
        }
        let over = |value: f64, whole: f64| if whole > 0.0 { value / whole } else { 0.0 };
        Self {
            sides: over(sum.sides, load),
            nearly: over(sum.nearly, load),
            shear: over(sum.shear, load),
            film: over(pieces.iter().map(|change: &f64| change.abs()).sum(), films),
        }
    }
}

/// The block of the central region that contains the point `(x, y)`; `None` outside.
fn piece_at(solution: &Mesh<'_>, x: f64, y: f64) -> Option<usize> {
    let ellipse = solution.hertz.ellipse();
    let along = |share: f64| {
        let share = 0.5 * (1.0 + share / CENTRAL);
        ((share * PIECES as f64) as usize).min(PIECES - 1)
    };
    let [first, mut second] = ellipse.normalised(x, y);
    if solution.grid.is_strip() {
        // The region of a strip is its whole width.
        second = CENTRAL * (2.0 * (y - solution.grid.y(0)) / solution.grid.size_y() - 1.0);
    }
    is_central(x, y, &ellipse).then(|| along(second) * PIECES + along(first))
}

/// Share of the pressure of node `k` carried by solids; `None` without pressure.
fn solid_share(solution: &Mesh<'_>, k: usize) -> Option<f64> {
    let pressure = solution.state.pressure[k];
    (pressure > 0.0).then(|| (solution.state.solid_pressure(k) / pressure).min(1.0))
}

/// The cell of `grid` that contains the point `(x, y)`, or the nearest one.
fn cell_at(grid: &Grid, x: f64, y: f64) -> usize {
    let along = |distance: f64, n: usize| ((distance + 0.5).max(0.0) as usize).min(n - 1);
    let column = along((x - grid.x(0)) / grid.dx(), grid.nx());
    let row = along((y - grid.y(0)) / grid.dy(), grid.ny());
    row * grid.nx() + column
}
