//! Flooded inlets in any box.
//!
//! The pressure upstream and beside a lubricated contact decays slowly: in a point contact the load beyond a distance `X`
//! decays as `1/X`. Ambient pressure at the edge of a smaller box makes the film too thin. If the error is too large
//! ([`box_error`]), the smooth contact under the same conditions is solved first on a coarse mesh in a wide box
//! ([`outer`]); the pressure at its edge is that between rigid paraboloids. The [`FarField`] of the inner contact
//! contains the outer pressures at the edge of its box, the displacement by the pressures outside, and their load and
//! friction.
//!
//! If most of the load is outside, the load inside hardly depends on the film and cannot determine it. Then the film near
//! the inlet edge is prescribed instead: the inner contact is solved at fixed approach, which is varied until it has
//! this film.

mod beyond;
mod box_error;
mod hand_over;
pub(in crate::sim) mod outer;
mod outer_grid;

use crate::error::InputError;
use crate::grid::Grid;
use crate::report::{SolveReport, Status};
use crate::reynolds::{ContactDefinition, ContactState, EdgePressure, outermost};
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::scene::Scene;
use hand_over::interpolate;

pub(in crate::sim) use box_error::{BoxError, Contact, InletScale};

/// Most solves of the inner contact to find its approach.
const SOLVES: usize = 10;
/// Relative tolerance of the film near the inlet edge.
const FILM_TOLERANCE: f64 = 1e-4;

/// A flooded inlet and the box of a contact, estimated without solving.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// let mut scene = Scene::azam_2019(32);
/// let slow = MixedLubricationSim::builder(scene.clone()).build()?.inlet()?.ok_or("dry")?;
/// assert!(slow.box_holds_it && slow.film_error < 0.005);
/// scene.motion.entrainment_speed = 10.0; // a film 20 times as thick
/// let fast = MixedLubricationSim::builder(scene).build()?.inlet()?.ok_or("dry")?;
/// assert!(!fast.box_holds_it);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FloodedInlet {
    /// Relative error of the central film with ambient pressure at the edges of the box.
    pub film_error: f64,
    /// Whether that error is small and the box is solved as it is. Otherwise the pressures at its edges are those of the
    /// smooth contact in a wider box.
    pub box_holds_it: bool,
}

/// The fluid outside of the box of a contact.
#[derive(Debug, Clone)]
pub(in crate::sim) struct FarField {
    /// Pressure of which only the outermost nodes of the box are used \[Pa\].
    pressure: Vec<f64>,
    /// Displacement by the pressures outside \[m\].
    displacement: Vec<f64>,
    /// The equation that determines the approach.
    closure: Closure,
    /// Approach of the outer contact \[m\].
    approach: f64,
    /// Friction force outside \[N\].
    pub(in crate::sim) friction_force: f64,
    /// Undeformed gap with the displacement \[m\].
    gap: Vec<f64>,
}

/// The equation that determines the approach of a contact with a far field.
#[derive(Debug, Clone, Copy)]
enum Closure {
    /// The load that is carried outside \[N\].
    LoadOutside(f64),
    /// The film \[m\] at a point near the inlet edge.
    Film([f64; 2], f64),
    /// No equation: the approach is prescribed.
    Approach,
}

/// Conditions of a far field: load, speeds, temperature.
pub(in crate::sim) type Point = [u64; 4];

/// The far field of a contact model, updated when its conditions change.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Inlet {
    /// The scene, for the bodies of the outer contact.
    pub(in crate::sim) scene: Box<Scene>,
    /// Conditions of the last update.
    pub(in crate::sim) point: Option<Point>,
    /// Film error by the box under these conditions.
    pub(in crate::sim) error: BoxError,
    /// Whether an outer contact can be solved: bodies of the scene, no spin, hard contact.
    pub(in crate::sim) has_outer: bool,
    /// Whether the outer contact converged, if needed.
    pub(in crate::sim) is_solved: bool,
}

impl Inlet {
    /// For contacts of `scene`, or with a custom elastic body.
    pub(in crate::sim) fn new(scene: &Scene, has_own_body: bool) -> Self {
        let is_hard = scene.solver.contact == ContactDefinition::Hard;
        let has_outer = is_hard && !has_own_body && scene.motion.spin_radius.is_none();
        Self {
            scene: Box::new(scene.clone()),
            point: None,
            error: BoxError::NONE,
            has_outer,
            is_solved: true,
        }
    }

    /// Relative box error of the central film of a solve.
    pub(in crate::sim) fn film_error(&self) -> f64 {
        if self.is_solved { self.error.of_solve() } else { self.error.ambient }
    }

    /// The warning about a box that cuts an inlet.
    pub(in crate::sim) fn warning(&self, grid: &Grid) -> Option<Warning> {
        if self.is_solved {
            return None;
        }
        let reason = if self.has_outer {
            "the contact in a wider box, which tells the pressure at its edge, was not solved, or this box ends within 1.2 \
             half-widths of its middle"
        } else {
            "own bodies, spin and contact = \"paper\" take the pressure at its edge as ambient"
        };
        Some(Warning::new(
            "grid.x",
            grid.x(0) - 0.5 * grid.dx(),
            format!(
                "the box cuts the inlet, and {reason}: the film is up to {:.0} % too thin",
                100.0 * self.error.ambient
            ),
            "take a wider box, or say that the oil begins at its edge (lubricant.inlet = \"box_edge\")"
                .to_owned(),
        ))
    }
}

impl FarField {
    /// From edge pressures only.
    fn at_edge(pressure: Vec<f64>, closure: Closure) -> Self {
        let zeros = vec![0.0; pressure.len()];
        Self {
            displacement: zeros.clone(),
            gap: zeros,
            pressure,
            closure,
            approach: 0.0,
            friction_force: 0.0,
        }
    }

    /// Solves the inner contact from `state` by `once`, which gets the edge pressure and the undeformed gap. A state without
    /// pressure starts from the outer contact if the surfaces are `smooth`.
    pub(in crate::sim) fn solve(
        &mut self,
        grid: &Grid,
        gap: &[f64],
        smooth: bool,
        state: &mut ContactState,
        mut once: impl FnMut(EdgePressure<'_>, &[f64], &mut ContactState) -> Result<SolveReport, SimError>,
    ) -> Result<SolveReport, SimError> {
        self.displace(gap)?;
        let holds_load = matches!(self.closure, Closure::LoadOutside(_));
        if (smooth || !holds_load) && state.pressure.iter().all(|p| *p <= 0.0) {
            self.start(grid, state);
        }
        let load_outside = match self.closure {
            Closure::LoadOutside(load) => Some(load),
            Closure::Film(..) | Closure::Approach => None,
        };
        let edge = EdgePressure { field: &self.pressure, load_outside };
        let mut report = once(edge, &self.gap, state)?;
        let Closure::Film(place, film) = self.closure else { return Ok(report) };
        for _ in 1..SOLVES {
            let excess = interpolate(grid, &state.film, place, false) - film;
            if report.status != Status::Converged || excess.abs() < FILM_TOLERANCE * film {
                break;
            }
            state.approach += excess;
            report = once(edge, &self.gap, state)?.preceded_by(report);
        }
        Ok(report)
    }

    /// Load carried outside of a box whose pressures carry `carried` of `load` \[N\].
    pub(in crate::sim) fn load_outside(&self, load: f64, carried: f64) -> f64 {
        match self.closure {
            Closure::LoadOutside(outside) => outside,
            Closure::Film(..) | Closure::Approach => load - carried,
        }
    }

    /// Overwrites the outermost nodes of a pressure field with the edge pressures.
    pub(in crate::sim) fn fill_edge(&self, grid: &Grid, pressure: &mut [f64]) {
        for k in outermost(grid) {
            pressure[k] = self.pressure[k];
        }
    }

    fn displace(&mut self, gap: &[f64]) -> Result<(), InputError> {
        InputError::require_len("gap", gap, self.gap.len())?;
        for (sum, (gap, displacement)) in self.gap.iter_mut().zip(gap.iter().zip(&self.displacement)) {
            *sum = gap + displacement;
        }
        Ok(())
    }

    /// Sets the pressures of the outer contact as a start.
    fn start(&self, grid: &Grid, state: &mut ContactState) {
        state.pressure.copy_from_slice(&self.pressure);
        for k in outermost(grid) {
            state.pressure[k] = 0.0;
        }
        state.fluid_pressure.clone_from(&state.pressure);
        state.approach = self.approach;
    }
}
