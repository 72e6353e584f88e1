//! The smooth contact in a box that contains its inlet, with edge pressures of rigid bodies.

use super::hand_over::{interpolate, shares_outside};
use super::outer_grid::{curvatures, film_lengths, outer_grid, start};
use super::{Closure, FarField};
use crate::analytic::RigidParaboloids;
use crate::elastic::{DeformationModel, WithLocalCompliance};
use crate::error::InputError;
use crate::grid::Grid;
use crate::report::Status;
use crate::reynolds::{ContactState, FaceMobility, FilmFlows, NewtonKrylov, StoppingRule, outermost};
use crate::sim::contact::components::half_space;
use crate::sim::contact::film_heat::{self, FilmIteration, SolveContext};
use crate::sim::contact::film_temperature;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::interrupt::Interruptible;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::model::ContactModel;
use crate::sim::error::SimError;
use crate::sim::scene::Scene;

/// Film length, in half-widths, above which a solve starts from rigid bodies.
const RIGID: f64 = 1.5;
/// Relaxation of the edge pressures, largest number of iterations, and tolerance of the central film.
const RELAXATION: f64 = 0.6;
const TURNS: usize = 40;
const SETTLED: f64 = 2e-4;
/// Fraction of the load outside of the inner box above which its film is prescribed instead of its load.
const FILM_FROM: f64 = 0.9;
/// Position of the prescribed film, in distances of the inlet edge of the inner box.
const FILM_AT: f64 = 0.9;

/// The outer contact of an inner one.
pub(in crate::sim) struct OuterContact<'a> {
    scene: &'a Scene,
    pub(super) model: ContactModel,
    pub(super) far: RigidParaboloids,
    /// Viscosity at ambient pressure times entrainment speed \[N/m\].
    pub(super) drag: f64,
    /// Gap of the undeformed bodies \[m\].
    pub(super) gap: Vec<f64>,
    /// Second derivatives of that gap along x, across and along y \[1/m\].
    pub(super) curvatures: [f64; 3],
    /// Half-width of the Hertz contact along x \[m\].
    half_width: f64,
}

impl<'a> OuterContact<'a> {
    /// For the smooth bodies of `inner` under its conditions, with a central film of about `film` \[m\].
    pub(in crate::sim) fn new(scene: &'a Scene, inner: &ContactModel, film: f64) -> Result<Self, InputError> {
        let is_line = scene.form.is_line();
        let curvatures = curvatures(scene);
        let grid = outer_grid(inner, curvatures, film, is_line)?;
        let mut gap = vec![0.0; grid.len()];
        scene.form.gap_into(&grid, &mut gap)?;
        let reference = scene.form.radii().0.max(grid.size_x());
        let body = Interruptible::new(
            half_space(scene, grid, reference)?,
            inner.deformation.bodies().interrupt().cloned(),
        );
        let hertz = inner.hertz.per_metre(&inner.grid);
        let [a, _] = hertz.half_extents();
        let hertz = start(hertz, film_lengths(curvatures, film), [grid.dx(), grid.dy()], is_line);
        let mut lubricant = inner.lubricant.clone();
        if let Some(lubricant) = &mut lubricant {
            lubricant.forget_film_temperatures();
        }
        let viscosity = lubricant.as_ref().map_or(0.0, |oil| oil.viscosity().viscosity(0.0));
        let model = ContactModel {
            grid,
            hertz,
            form_gap: Vec::new(),
            deformation: WithLocalCompliance::new(body),
            films: None,
            lubricant,
            solver: Box::new(NewtonKrylov::new()),
            verifies: false,
            rule: StoppingRule::default(),
            scheme: inner.scheme,
            face_mobility: FaceMobility::Wedge,
            cavitation: inner.cavitation,
            supplied_film: inner.supplied_film,
            shear_thinning: inner.shear_thinning,
            film_cutoff: inner.film_cutoff,
            contact: inner.contact,
            motion: inner.motion,
            load: inner.load,
            bulk_temperature: inner.bulk_temperature,
            formulas: inner.formulas,
            stated_film: inner.stated_film,
            evaluation: None,
            reuses_buffers: true,
            flow: None,
            film_flows: film_temperature::models_film_temperature(scene).then(FilmFlows::default),
            inlet: None,
            far_field: None,
        };
        let far = RigidParaboloids::new(curvatures)?;
        Ok(Self {
            half_width: a,
            curvatures,
            scene,
            drag: viscosity * inner.motion.entrainment_speed,
            model,
            far,
            gap,
        })
    }

    /// Solves it, from pressures for a film of about `film` \[m\]; `None` if a solve does not converge.
    pub(in crate::sim) fn solve(
        mut self,
        inner: &Grid,
        laws: &Laws,
        film: f64,
    ) -> Result<Option<FarField>, SimError> {
        let solved = self.far_field(inner, laws, film);
        let is_interrupted = self.model.deformation.bodies().is_interrupted();
        if is_interrupted { Err(SimError::Interrupted) } else { solved }
    }

    fn far_field(&mut self, inner: &Grid, laws: &Laws, film: f64) -> Result<Option<FarField>, SimError> {
        let grid = self.model.grid;
        let films = [vec![0.0; grid.len()], vec![0.0; grid.len()]];
        let mut friction = FrictionFields::new(self.scene, grid.len())?;
        let mut heat = FilmIteration::new(self.scene, &self.model)?;
        let (mut state, film) = self.start(film)?;
        let (mut edge, mut outside) = (vec![0.0; grid.len()], 0.0);
        let mut edge_film: Vec<f64> = self.gap.iter().map(|gap| gap + film).collect();
        let mut central = film;
        for turn in 0..TURNS {
            let share = if turn == 0 { 1.0 } else { RELAXATION };
            self.relax_edge(&edge_film, share, &mut edge, &mut outside);
            // At first the film is known better than the load.
            let closure = if turn == 0 { Closure::Approach } else { Closure::LoadOutside(outside) };
            self.model.far_field = Some(FarField::at_edge(edge.clone(), closure));
            let given = SolveContext { laws, tribofilms: &films };
            let gap = &self.gap;
            let mut once =
                |model: &mut ContactModel, state: &mut ContactState| model.solve(gap, None, None, state);
            let contact = (&mut self.model, &mut state, &mut friction);
            let (report, _) = film_heat::solve(&given, heat.as_mut(), contact, &mut once)?;
            if report.status != Status::Converged {
                return Ok(None);
            }
            edge_film.copy_from_slice(&state.film);
            let now = interpolate(&grid, &state.film, [0.0; 2], false);
            if turn > 0 && (now / central - 1.0).abs() < SETTLED {
                return self.hand_over(inner, &state, &edge, &friction).map(Some);
            }
            central = now;
        }
        Ok(None)
    }

    /// A state near the solution, and its central film \[m\]: Hertz pressure with `film` between the bodies, or the pressure
    /// between rigid bodies if the film is wider than the contact.
    fn start(&mut self, film: f64) -> Result<(ContactState, f64), InputError> {
        let grid = self.model.grid;
        let mut state = ContactState::new(&grid);
        let hertz = self.model.hertz;
        let (a, b) = (hertz.half_width_x, hertz.half_width_y);
        let is_rigid = film_lengths(self.curvatures, film)[0] > RIGID * self.half_width;
        let film = if is_rigid { self.rigid_film(film) } else { film };
        for (k, (x, y)) in grid.nodes().enumerate() {
            state.pressure[k] = if is_rigid {
                self.rigid_pressure([x, y], film)
            } else {
                let across = if grid.ny() == 1 { 0.0 } else { (y / b).powi(2) };
                hertz.pressure * (1.0 - (x / a).powi(2) - across).max(0.0).sqrt()
            };
        }
        for k in outermost(&grid) {
            state.pressure[k] = 0.0;
        }
        state.fluid_pressure.clone_from(&state.pressure);
        let mut displacement = vec![0.0; grid.len()];
        self.model.deformation.displacement(&state.pressure, &mut displacement)?;
        state.approach = interpolate(&grid, &displacement, [0.0; 2], false) - film;
        Ok((state, film))
    }

    /// The far field of the inner box.
    fn hand_over(
        &mut self,
        inner: &Grid,
        state: &ContactState,
        edge: &[f64],
        friction: &FrictionFields,
    ) -> Result<FarField, SimError> {
        let grid = self.model.grid;
        let shares: Vec<f64> = shares_outside(&grid, inner).collect();
        let area = grid.cell_area();
        let inside: f64 =
            state.pressure.iter().zip(&shares).map(|(p, share)| p * (1.0 - share)).sum::<f64>() * area;
        let (mut full, mut beyond) = (state.pressure.clone(), vec![0.0; grid.len()]);
        for k in outermost(&grid) {
            full[k] = edge[k];
        }
        for (beyond, (p, share)) in beyond.iter_mut().zip(full.iter().zip(&shares)) {
            *beyond = p * share;
        }
        let mut displaced = vec![0.0; grid.len()];
        self.model.deformation.displacement(&beyond, &mut displaced)?;
        let take = |field: &[f64], positive| -> Vec<f64> {
            inner.nodes().map(|(x, y)| interpolate(&grid, field, [x, y], positive)).collect()
        };
        // A line carries its load per metre, a strip that of its width.
        let length = inner.contact_length();
        let load = self.model.hertz.force;
        let load_outside = load - inside;
        let place = [FILM_AT * inner.x(0), 0.0];
        let closure = if load_outside > FILM_FROM * load {
            Closure::Film(place, interpolate(&grid, &state.film, place, false))
        } else {
            Closure::LoadOutside(load_outside * length)
        };
        let stress = |(k, share): (usize, &f64)| share * friction.stress(k);
        Ok(FarField {
            pressure: take(&full, true),
            displacement: take(&displaced, false),
            closure,
            approach: state.approach,
            friction_force: shares.iter().enumerate().map(stress).sum::<f64>() * area * length,
            gap: vec![0.0; inner.len()],
        })
    }
}
