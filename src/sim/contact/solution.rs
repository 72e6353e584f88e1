//! The solution of one contact and its numbers.

use crate::grid::Grid;
use crate::report::SolveReport;
use crate::reynolds::{Cavitation, ContactDefinition, ContactState, FaceMobility, FlowBalance, Scheme};
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::far_field::Inlet;
use crate::sim::contact::film_heat::Solved;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::{
    ContactNumbers, FilmNumbers, FrictionNumbers, Moes, Numbers, PressureNumbers, RoughnessNumbers,
    StressNumbers, ThermalNumbers,
};
use crate::sim::contact::warnings::Warning;
use crate::sim::scene::hertz::HertzContact;

/// The solution of one contact.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let solution = solve_contact(&Scene::azam_2019(32))?;
/// assert!(solution.pressure.max > solution.hertz.pressure); // the surfaces are rough
/// assert!((0.0..=1.0).contains(&solution.contact.load_ratio) && solution.film.minimum >= 0.9e-9);
/// let friction = solution.friction;
/// assert!((friction.boundary + friction.fluid - friction.coefficient).abs() < 1e-12);
/// assert_eq!(solution.fields()[0].1.len(), 32 * 32);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone)]
pub struct ContactSolution {
    /// How the solve ended, residuals and work.
    pub report: SolveReport,
    /// The grid.
    pub grid: Grid,
    /// Hertz contact of the smooth bodies.
    pub hertz: HertzContact,
    /// Moes' parameters; none for a dry contact.
    pub moes: Option<Moes>,
    /// Entrainment scheme; none for a dry contact, as are the next three.
    pub scheme: Option<Scheme>,
    /// Pressure flow through faces.
    pub face_mobility: Option<FaceMobility>,
    /// What solid contact is.
    pub contact_definition: Option<ContactDefinition>,
    /// What holds where the fluid cavitates.
    pub cavitation: Option<Cavitation>,
    /// What flows into the box and out of it; none for a dry contact.
    pub flow: Option<FlowBalance>,
    /// Fields and approach.
    pub state: ContactState,
    /// Undeformed gap, form and roughness \[m\].
    pub gap: Vec<f64>,
    /// Estimated errors where the scene asks for an accuracy or for an estimate; none also where the coarser
    /// meshes were not solved.
    pub error_estimate: Option<ErrorEstimate>,
    /// Stresses below the surface of the disc; none where the scene does not ask for them.
    pub stress: Option<StressNumbers>,
    /// Heat of the film; none where the scene does not ask for it.
    pub thermal: Option<ThermalNumbers>,
    /// Mean temperature across the film at every node \[K\]; empty where the scene does not ask for it.
    pub film_temperature: Vec<f64>,
    /// Film thickness.
    pub film: FilmNumbers,
    /// Total pressure.
    pub pressure: PressureNumbers,
    /// Solid contact.
    pub contact: ContactNumbers,
    /// Friction over load.
    pub friction: FrictionNumbers,
    /// Roughness on the track.
    pub roughness: RoughnessNumbers,
    /// What is unlikely to be meant or to hold: that of [`Scene::warnings`](crate::sim::Scene::warnings), of
    /// surfaces from files, and of the solution.
    pub warnings: Vec<Warning>,
    /// Coefficient of friction of solid contact; zero without sliding.
    pub(in crate::sim) boundary_friction: f64,
    /// Shear stress of the fluid \[Pa\].
    pub(in crate::sim) shear: Vec<f64>,
    /// Relative error of the central film by the box.
    pub(in crate::sim) box_error: f64,
}

impl ContactSolution {
    /// Fields by name, one value a node: `pressure` and `fluid_pressure` \[Pa\], `film` \[m\], `theta` (the
    /// share of the gap that is filled), `gap` and `plastic_depth` \[m\], with [`thermal`](Self::thermal)
    /// numbers `film_temperature` \[K\] too.
    pub fn fields(&self) -> Vec<(&'static str, &[f64])> {
        let state = &self.state;
        let mut fields: Vec<(&'static str, &[f64])> = vec![
            ("pressure", &state.pressure),
            ("fluid_pressure", &state.fluid_pressure),
            ("film", &state.film),
            ("theta", &state.theta),
            ("gap", &self.gap),
            ("plastic_depth", &state.plastic_depth),
        ];
        if self.thermal.is_some() {
            fields.push(("film_temperature", &self.film_temperature));
        }
        fields
    }
}

/// Whether a state is a state: one of a solve that diverged may be none.
pub(in crate::sim) fn is_known(state: &ContactState) -> bool {
    state.pressure.iter().chain(&state.film).all(|value| value.is_finite())
}

impl ContactModel {
    /// The solution that a solve with this model has led to; without `friction` it diverged.
    pub(in crate::sim) fn solution(
        &self,
        (report, heat): Solved,
        state: ContactState,
        gap: Vec<f64>,
        friction: Option<&FrictionFields>,
        numbers: Numbers,
    ) -> ContactSolution {
        let lubricated = self.lubricant.is_some();
        let (thermal, film_temperature) = heat.unzip();
        ContactSolution {
            report,
            grid: self.grid,
            hertz: self.hertz,
            moes: self.formulas.map(|formulas| formulas.moes),
            film: numbers.film,
            pressure: numbers.pressure,
            contact: numbers.contact,
            friction: numbers.friction,
            roughness: numbers.roughness,
            boundary_friction: friction.map_or(f64::NAN, FrictionFields::first_boundary),
            shear: friction.map_or_else(|| vec![f64::NAN; state.film.len()], |fields| fields.shear.clone()),
            scheme: lubricated.then_some(self.scheme),
            face_mobility: lubricated.then_some(self.face_mobility),
            contact_definition: lubricated.then_some(self.contact),
            cavitation: lubricated.then_some(self.cavitation),
            flow: self.flow,
            state,
            gap,
            error_estimate: None,
            box_error: self.inlet.as_ref().map_or(0.0, Inlet::film_error),
            warnings: self.inlet.iter().filter_map(|inlet| inlet.warning(&self.grid)).collect(),
            stress: None,
            thermal,
            film_temperature: film_temperature.unwrap_or_default(),
        }
    }
}
