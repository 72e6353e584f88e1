//! Error of the film by the edges of the box, relative to a flooded inlet.
//!
//! A flooded film has the reduced pressure `q` at an edge; ambient pressure there lacks it. The contact begins at the
//! reduced pressure `q_c = 1/(alpha + 1/(0.35 p_H))`, where the oil stiffens or the bodies deflect, or at the largest one between rigid
//! bodies, if that is lower. The film is then too thin by at most `0.7 q/q_c` of its thickness, summed over the inlet edge and the sides. The load `W_o` outside makes
//! it thinner by up to `c W_o/W` with `c = H^2`, `H = h R/a^2`, between 0.3 and, for nearly rigid bodies, 1.5. For a
//! point contact `W_o/W = 8.8 / (M^(4/3) X)`, with the distance `X` of the inlet edge in half-widths.

use crate::analytic::RigidParaboloids;
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::ViscosityLaw;
use crate::sim::contact::formula::FormulaFilm;
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::HertzContact;

/// Film error that is accepted.
const SMALL: f64 = 5e-3;
/// Film error over the fraction of the reduced pressure missing at an edge, and its remaining part with the pressures of
/// an outer contact.
const BY_PRESSURE: f64 = 0.7;
const HANDED_OVER: f64 = 0.04;
/// Error by the mesh of the outer contact for rigid bodies, and the film `H` above which they are rigid.
const BY_OUTER_MESH: f64 = 7e-3;
const RIGID_FILM: f64 = 4.0;
/// Pressure at which bodies deflect, over the Hertz pressure.
const DEFLECTING: f64 = 0.35;
/// Position of the largest pressure at a side, upstream, in half-widths.
const SIDE_AT: f64 = -0.5;
/// Positions upstream in film lengths, among which the pressure between rigid bodies is largest.
const RIGID_PEAKS: [f64; 8] = [0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.8, 1.0];
/// Load outside of the box of a point contact, times `M^(4/3) X` over the load.
const LOAD_OUTSIDE: f64 = 8.8;
/// Film error over the relative load outside, for strongly deflecting and for rigid bodies.
const BY_LOAD: [f64; 2] = [0.3, 1.5];

/// Film error of a flooded contact by the edges of its box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) struct BoxError {
    /// Relative error with ambient pressure at the edges.
    pub(in crate::sim) ambient: f64,
    /// Relative error with the pressures of an outer contact at the edges.
    pub(in crate::sim) handed_over: f64,
}

impl BoxError {
    /// Error without an inlet.
    pub(in crate::sim) const NONE: Self = Self { ambient: 0.0, handed_over: 0.0 };

    /// Whether the box contains the inlet: ambient pressure at its edges is accurate enough.
    pub(in crate::sim) fn is_small(&self) -> bool {
        self.ambient < SMALL
    }

    /// The film error of a solve.
    pub(in crate::sim) fn of_solve(&self) -> f64 {
        if self.is_small() { self.ambient } else { self.handed_over }
    }
}

/// Smallest extent of a box with given edge pressures, in half-widths of the contact.
const LEAST_BOX: f64 = 1.2;

/// Lengths and pressures of a flooded contact, for the error of any box.
#[derive(Debug, Clone)]
pub(in crate::sim) struct InletScale {
    rigid: RigidParaboloids,
    /// Viscosity at ambient pressure times entrainment speed \[N/m\].
    drag: f64,
    is_line: bool,
    /// Half extents of the Hertz contact along x and y \[m\], and the curvatures along them \[1/m\].
    halves: [f64; 2],
    curvatures: [f64; 2],
    /// Central film \[m\].
    film: f64,
    /// Reduced pressure at which the contact begins \[Pa\].
    stiff: f64,
    /// Moes' load parameter.
    moes_load: f64,
}

/// The parts of a lubricated contact that determine its inlet.
pub(in crate::sim) struct Contact<'a> {
    pub(in crate::sim) scene: &'a Scene,
    pub(in crate::sim) hertz: &'a HertzContact,
    pub(in crate::sim) viscosity: &'a dyn ViscosityLaw,
    pub(in crate::sim) entrainment_speed: f64,
    pub(in crate::sim) formulas: FormulaFilm,
}

impl InletScale {
    /// From a `contact` with a flooded inlet.
    pub(in crate::sim) fn new(contact: &Contact<'_>) -> Result<Self, InputError> {
        let (radius_x, radius_y) = contact.scene.form.radii_of_entrainment();
        let curvatures = [1.0 / radius_x, 1.0 / radius_y];
        let alpha = contact.viscosity.log_slope(0.0).max(0.0);
        let rigid = RigidParaboloids::new([curvatures[0], 0.0, curvatures[1]])?;
        let drag = contact.viscosity.viscosity(0.0) * contact.entrainment_speed;
        let film = contact.formulas.map.central;
        let film_length = (2.0 * film / curvatures[0]).sqrt();
        let between_rigid = |place: f64| {
            let gap = film * (1.0 + place * place);
            rigid.reduced_pressure(drag, [-place * film_length, 0.0], gap)
        };
        let largest = RIGID_PEAKS.into_iter().map(between_rigid).fold(0.0, f64::max);
        let stiff = 1.0 / (alpha + 1.0 / (DEFLECTING * contact.hertz.pressure));
        Ok(Self {
            rigid,
            drag,
            is_line: contact.scene.form.is_line(),
            halves: contact.hertz.half_extents(),
            curvatures,
            film,
            stiff: if largest > 0.0 { stiff.min(largest) } else { stiff },
            moes_load: contact.formulas.moes.m,
        })
    }

    /// Central film by formula \[m\].
    pub(in crate::sim) fn film(&self) -> f64 {
        self.film
    }

    /// The error in the box of `grid`.
    pub(in crate::sim) fn error_on(&self, grid: &Grid) -> BoxError {
        let inlet = 0.5 * grid.dx() - grid.x(0);
        let side = (0.5 * grid.dy() - grid.y(0)).min(grid.y(grid.ny() - 1) + 0.5 * grid.dy());
        self.box_error(inlet, side)
    }

    /// Distance along `axis` at which the gap equals the film, at least the half-width of the contact \[m\].
    ///
    pub(in crate::sim) fn length(&self, axis: usize) -> f64 {
        (2.0 * self.film / self.curvatures[axis]).sqrt().max(self.halves[axis])
    }

    /// Whether the box of `grid` contains the contact with a margin at its edges.
    pub(in crate::sim) fn is_held_by(&self, grid: &Grid) -> bool {
        let reaches = |first: f64, width: f64, n: usize, half: f64| {
            let (low, high) = (first - 0.5 * width, first + (n as f64 - 0.5) * width);
            high.min(-low) > LEAST_BOX * half
        };
        reaches(grid.x(0), grid.dx(), grid.nx(), self.halves[0])
            && (self.is_line || reaches(grid.y(0), grid.dy(), grid.ny(), self.halves[1]))
    }

    /// The error of a box that ends `inlet` \[m\] upstream and `side` \[m\] beside the center.
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
            // The pressure decays as `x^-3`; half of it lies within the film length.
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

    /// Hertz gap of the elastic bodies without film at a `distance` from the center along `axis` \[m\].
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
