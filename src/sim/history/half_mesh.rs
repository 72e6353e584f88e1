//! The contact of a step on half the cells along each side, to estimate the errors of its results.
//!
//! Heights of both bodies on the large cells are evaluated from their Fourier series; tribofilms and plastic depths are
//! interpolated linearly. Like that of a step, the solve starts from the dry contact.

use crate::error::InputError;
use crate::grid::Grid;
use crate::report::SolveReport;
use crate::reynolds::ContactState;
use crate::sim::contact::components::CustomComponents;
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::far_field::Inlet;
use crate::sim::contact::film_heat::{self, FilmIteration, SolveContext};
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::interrupt::Interrupt;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::mesh_error::{self, Mesh, require_half};
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::Numbers;
use crate::sim::contact::numbers::is_known;
use crate::sim::error::SimError;
use crate::sim::history::placement::Placement;
use crate::sim::history::yielding::Yielding;
use crate::sim::scene::Scene;
use crate::sim::scene::operating_schedule::Conditions;
use crate::surface::series_at_nodes;

/// A solved contact: its model, the report, its state, its shear stresses, and pressure limits if any.
pub(in crate::sim) type Solved<'a> =
    (&'a ContactModel, &'a SolveReport, &'a ContactState, &'a FrictionFields, Option<&'a [f64]>);

/// The contact of a history on half the cells.
#[derive(Debug, Clone)]
pub(in crate::sim) struct HalfMesh {
    scene: Scene,
    model: ContactModel,
    placement: Placement,
    yielding: Yielding,
    state: ContactState,
    friction: FrictionFields,
    film_heat: Option<FilmIteration>,
}

impl HalfMesh {
    /// For histories of `scene`, with the face mobility of `model`; `None` if the scene requests no estimate.
    ///
    /// # Errors
    /// A scene that cannot be solved on half its cells.
    pub(in crate::sim) fn new(
        scene: &Scene,
        model: &ContactModel,
        interrupt: Option<Interrupt>,
    ) -> Result<Option<Self>, SimError> {
        if !scene.solver.estimate {
            return Ok(None);
        }
        require_half(scene, "solver.estimate")?;
        let mut scene = Scene { grid: scene.grid.with_counts(|n| n.div_ceil(2)), ..scene.clone() };
        // Contact at the edge of the box is checked in the step itself.
        scene.solver.edge_contact = true;
        let custom = CustomComponents { interrupt, ..CustomComponents::default() };
        let mut half = ContactModel::new(&scene, custom)?;
        half.face_mobility = model.face_mobility;
        let n = half.grid.len();
        Ok(Some(Self {
            placement: Placement::new(half.grid),
            yielding: Yielding::new(n),
            state: ContactState::new(&half.grid),
            friction: FrictionFields::new(&scene, n)?,
            film_heat: FilmIteration::new(&scene, &half)?,
            model: half,
            scene,
        }))
    }

    /// Estimated errors of a contact solved under `conditions` between the bodies of `placement`; `None` if the contact on
    /// half the cells does not converge.
    ///
    /// # Errors
    /// The errors of a solve, including interrupts.
    pub(in crate::sim) fn estimate(
        &mut self,
        laws: &Laws,
        conditions: &Conditions,
        placement: &Placement,
        fine: Solved<'_>,
    ) -> Result<Option<ErrorEstimate>, SimError> {
        self.place(placement, fine.0)?;
        let Self { scene, model, placement, yielding, state, friction, film_heat } = self;
        model.set_conditions(scene, conditions)?;
        model.set_tribofilms(&placement.films)?;
        state.pressure.fill(0.0);
        if let Some(heat) = film_heat {
            heat.move_at(conditions.motion.surface_speeds(), &model.grid)?;
        }
        let given = SolveContext { laws, tribofilms: &placement.films };
        let models = laws.plasticity.as_ref();
        let mut once = |model: &mut ContactModel, state: &mut ContactState| {
            yielding.solve(models, placement, model, None, state)
        };
        let contact = (&mut *model, &mut *state, &mut *friction);
        let (report, _) = film_heat::solve(&given, film_heat.as_mut(), contact, &mut once)?;
        if !is_known(state) {
            return Ok(None);
        }
        let limit = laws.plasticity.is_some().then_some(yielding.limit.as_slice());
        let coarse = mesh((model, &report, state, friction, limit))?;
        Ok(mesh_error::estimate(&coarse, &mesh(fine)?))
    }

    /// Transfers the bodies of `fine` to the large cells.
    fn place(&mut self, fine: &Placement, model: &ContactModel) -> Result<(), SimError> {
        let (from, to) = (model.grid, self.model.grid);
        let heights: Vec<f64> = model.form_gap.iter().zip(&fine.gap).map(|(form, gap)| form - gap).collect();
        let heights = series_at_nodes(&heights, [from.nx(), from.ny()], [to.nx(), to.ny()])?;
        for ((gap, form), height) in self.placement.gap.iter_mut().zip(&self.model.form_gap).zip(heights) {
            *gap = form - height;
        }
        let fields = fine.films.iter().chain(&fine.depths);
        let onto = self.placement.films.iter_mut().chain(&mut self.placement.depths);
        for (field, onto) in fields.zip(onto) {
            linear_at_nodes(field, &from, &to, onto);
        }
        Ok(())
    }
}

/// A solved contact as input of the estimates.
fn mesh<'a>((model, report, state, friction, limit): Solved<'a>) -> Result<Mesh<'a>, InputError> {
    let numbers = Numbers::of(model, state, Some(friction), limit, [0.0; 2])?;
    Ok(Mesh {
        status: report.status,
        grid: model.grid,
        hertz: model.hertz,
        state,
        shear: &friction.shear,
        film: numbers.film,
        pressure: numbers.pressure,
        contact: numbers.contact,
        friction: numbers.friction,
        boundary_friction: friction.first_boundary(),
        box_error: model.inlet.as_ref().map_or(0.0, Inlet::film_error),
    })
}

/// Overwrites `onto` with the values of `field` at the nodes of `to`, linear between those of `from` in the same box.
fn linear_at_nodes(field: &[f64], from: &Grid, to: &Grid, onto: &mut [f64]) {
    let place = |at: f64, n: usize| {
        let at = at.clamp(0.0, (n - 1) as f64);
        let low = (at as usize).min(n.saturating_sub(2));
        (low, (low + 1).min(n - 1), at - low as f64)
    };
    for ((x, y), value) in to.nodes().zip(onto) {
        let (left, right, s) = place((x - from.x(0)) / from.dx(), from.nx());
        let (below, above, t) = place((y - from.y(0)) / from.dy(), from.ny());
        let along = |row: usize| {
            let row = row * from.nx();
            (1.0 - s) * field[row + left] + s * field[row + right]
        };
        *value = (1.0 - t) * along(below) + t * along(above);
    }
}
