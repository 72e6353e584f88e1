//! How far the film is from that of a flooded inlet, by the edges of the box.
//!
//! Ambient pressure at an edge lacks the reduced pressure `q` that the flooded film has there. The reduced pressure at
//! which the contact begins is `q_c = 1/(alpha + 1/(0.35 p_H))`: the oil stiffens, or the bodies deflect. The film is
//! then thinner by at most `0.7 q/q_c` of it, the sum over the inlet edge and the sides. The load outside `W_o` makes it
//! thinner by up to `c W_o/W` with `c = H^2`, `H = h R/a^2`, between 0.3 and, where bodies hardly deflect, 1.5; of a point
//! contact `W_o/W = 8.8 / (M^(4/3) X)` with the distance `X` of the inlet edge in half-widths.

use crate::analytic::RigidParaboloids;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::ViscosityLaw;
use crate::sim::contact::formula::FormulaFilm;
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::HertzContact;

/// Error that is left as it is, of the film.
const SMALL: f64 = 5e-3;
/// Error over the share of the reduced pressure that an edge lacks, and the part of it that is left where the outer
/// contact hands it over.
const BY_PRESSURE: f64 = 0.7;
const HANDED_OVER: f64 = 0.04;
/// Error of the outer contact where the bodies are rigid, by its mesh, and the film `H` from which they are.
const BY_OUTER_MESH: f64 = 7e-3;
const RIGID_FILM: f64 = 4.0;
/// Pressure at which bodies deflect, over that of Hertz.
const DEFLECTING: f64 = 0.35;
/// Place of the largest pressure at a side, upstream, in half-widths.
const SIDE_AT: f64 = -0.5;
/// Load outside of a point contact, times `M^(4/3) X` over the load.
const LOAD_OUTSIDE: f64 = 8.8;
/// Error of the film over the load outside over the load, of contacts whose bodies deflect much and of rigid ones.
const BY_LOAD: [f64; 2] = [0.3, 1.5];

/// What the edges of a box make of the film of a flooded contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) struct BoxError {
    /// Relative error with ambient pressure at the edges.
    pub(in crate::sim) ambient: f64,
    /// Relative error with the pressures of an outer contact at the edges.
    pub(in crate::sim) handed_over: f64,
}

impl BoxError {
    /// Of a box without an inlet.
    pub(in crate::sim) const NONE: Self = Self { ambient: 0.0, handed_over: 0.0 };

    /// Whether the box holds the inlet: ambient pressure at its edges does no harm.
    pub(in crate::sim) fn is_small(&self) -> bool {
        self.ambient < SMALL
    }

    /// The error of the film of a solve.
    pub(in crate::sim) fn of_solve(&self) -> f64 {
        if self.is_small() { self.ambient } else { self.handed_over }
    }
}

/// Half-widths of the contact that a box holds at least where pressures are handed to its edge.
const LEAST_BOX: f64 = 1.2;

/// Lengths and pressures of a flooded contact, which tell the error of any box.
#[derive(Debug, Clone)]
pub(in crate::sim) struct InletScale {
    rigid: RigidParaboloids,
    /// Viscosity at ambient pressure times entrainment speed \[N/m\].
    drag: f64,
    is_line: bool,
    /// Half the extent of the Hertz contact along x and y \[m\], and the curvatures along them \[1/m\].
    halves: [f64; 2],
    curvatures: [f64; 2],
    /// Central film \[m\].
    film: f64,
    /// Reduced pressure at which the contact begins \[Pa\].
    stiff: f64,
    /// Moes' load parameter.
    moes_load: f64,
}

/// A lubricated contact of a scene, as far as its inlet depends on it.
pub(in crate::sim) struct Contact<'a> {
    pub(in crate::sim) scene: &'a Scene,
    pub(in crate::sim) hertz: &'a HertzContact,
    pub(in crate::sim) viscosity: &'a dyn ViscosityLaw,
    pub(in crate::sim) entrainment_speed: f64,
    pub(in crate::sim) formulas: FormulaFilm,
}

impl InletScale {
    /// Of a `contact` whose inlet is flooded.
    pub(in crate::sim) fn new(contact: &Contact<'_>) -> Result<Self, InputError> {
        let (radius_x, radius_y) = contact.scene.form.radii_of_entrainment();
        let curvatures = [1.0 / radius_x, 1.0 / radius_y];
        let alpha = contact.viscosity.log_slope(0.0).max(0.0);
        Ok(Self {
            rigid: RigidParaboloids::new([curvatures[0], 0.0, curvatures[1]])?,
            drag: contact.viscosity.viscosity(0.0) * contact.entrainment_speed,
            is_line: contact.scene.form.is_line(),
            halves: contact.hertz.half_extents(),
            curvatures,
            film: contact.formulas.map.central,
            stiff: 1.0 / (alpha + 1.0 / (DEFLECTING * contact.hertz.pressure)),
            moes_load: contact.formulas.moes.m,
        })
    }

    /// Central film by formula \[m\].
    pub(in crate::sim) fn film(&self) -> f64 {
        self.film
    }

    /// Of the box of `grid`.
    pub(in crate::sim) fn error_on(&self, grid: &Grid) -> BoxError {
        let inlet = 0.5 * grid.dx() - grid.x(0);
        let side = (0.5 * grid.dy() - grid.y(0)).min(grid.y(grid.ny() - 1) + 0.5 * grid.dy());
        self.box_error(inlet, side)
    }

    /// Distance along `axis` at which the gap is as wide as the film, or the half-width of the contact where that is
    /// more \[m\].
    pub(in crate::sim) fn length(&self, axis: usize) -> f64 {
        (2.0 * self.film / self.curvatures[axis]).sqrt().max(self.halves[axis])
    }

    /// Whether the box of `grid` holds the contact with some room at its edges.
    pub(in crate::sim) fn is_held_by(&self, grid: &Grid) -> bool {
        let reaches = |first: f64, width: f64, n: usize, half: f64| {
            let (low, high) = (first - 0.5 * width, first + (n as f64 - 0.5) * width);
            high.min(-low) > LEAST_BOX * half
        };
        reaches(grid.x(0), grid.dx(), grid.nx(), self.halves[0])
            && (self.is_line || reaches(grid.y(0), grid.dy(), grid.ny(), self.halves[1]))
    }

    /// Of a box that ends `inlet` \[m\] upstream and `side` \[m\] aside of the middle.
    pub(in crate::sim) fn box_error(&self, inlet: f64, side: f64) -> BoxError {
        let share = |point: [f64; 2], gap: f64| {
            self.rigid.reduced_pressure(self.drag, point, self.film + gap) / self.stiff
        };
        let mut lacking = share([-inlet, 0.0], self.gap(0, inlet));
        if !self.is_line {
            let at = [SIDE_AT * self.length(0), side];
            lacking += share(at, self.gap(1, side) + 0.5 * self.curvatures[0] * at[0] * at[0]);
        }
        let scaled_film = self.film / (self.curvatures[0] * self.halves[0].powi(2));
        let outside = if self.is_line {
            // The pressure falls as `x^-3`, and half of it lies within the length of the film.
            0.5 * share([-inlet, 0.0], self.gap(0, inlet))
        } else {
            LOAD_OUTSIDE * self.moes_load.powf(-4.0 / 3.0) * self.halves[0] / inlet
        };
        let by_load = (scaled_film * scaled_film).clamp(BY_LOAD[0], BY_LOAD[1]) * outside;
        BoxError {
            ambient: (BY_PRESSURE * lacking + by_load).min(1.0),
            handed_over: HANDED_OVER * lacking.min(1.0) + BY_OUTER_MESH * (scaled_film / RIGID_FILM).min(1.0),
        }
    }

    /// Gap of the elastic bodies without film at a `distance` from the middle along `axis` \[m\], by Hertz.
    fn gap(&self, axis: usize, distance: f64) -> f64 {
        let half = self.halves[axis];
        let x = distance / half;
        if x <= 1.0 {
            return 0.0;
        }
        let root = (x * x - 1.0).sqrt();
        let of_hertz = if self.is_line {
            0.5 * (x * root - (x + root).ln())
        } else {
            (root + (x * x - 2.0) * (1.0 / x).acos()) / std::f64::consts::PI
        };
        half * half * self.curvatures[axis] * of_hertz
    }
}
