//! The solution of a contact and its results.

use crate::grid::Grid;
use crate::report::SolveReport;
use crate::reynolds::{Cavitation, ContactDefinition, ContactState, FaceMobility, FlowBalance, Scheme};
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::far_field::Inlet;
use crate::sim::contact::film_heat::Solved;
use crate::sim::contact::formula::FilmFormula;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::{
    ContactNumbers, FilmNumbers, FrictionNumbers, Moes, Numbers, PressureNumbers, RoughnessNumbers,
    StarvationNumbers, StressNumbers, ThermalNumbers,
};
use crate::sim::contact::warnings::Warning;
use crate::sim::scene::SolverModel;
use crate::sim::scene::hertz::HertzContact;
use crate::solver_id::SolverId;

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
    /// Status, residuals and work of the solve.
    pub report: SolveReport,
    /// The grid.
    pub grid: Grid,
    /// Hertz contact of the smooth bodies.
    pub hertz: HertzContact,
    /// Moes' parameters; `None` for a dry contact.
    pub moes: Option<Moes>,
    /// Formula of `film.formula_ratio` and `film.formula_lambda`; `None` for a dry contact.
    pub film_formula: Option<FilmFormula>,
    /// Treatment of the inlets of asperities; `None` for a dry contact.
    pub model: Option<SolverModel>,
    /// Entrainment scheme; `None` for a dry contact and with `SolverModel::AsperityInlets`, as the next four fields.
    pub scheme: Option<Scheme>,
    /// Law of the pressure flow through faces.
    pub face_mobility: Option<FaceMobility>,
    /// Definition of solid contact.
    pub contact_definition: Option<ContactDefinition>,
    /// Cavitation condition.
    pub cavitation: Option<Cavitation>,
    /// Flow balance of the box.
    pub flow: Option<FlowBalance>,
    /// Fields and approach.
    pub state: ContactState,
    /// Undeformed gap, including form and roughness \[m\].
    pub gap: Vec<f64>,
    /// Estimated errors if the scene has an accuracy or an estimate; `None` also if the coarser meshes did not converge.
    pub error_estimate: Option<ErrorEstimate>,
    /// Stresses below the surface of the disc; `None` if not requested.
    pub stress: Option<StressNumbers>,
    /// Film temperature; `None` for an isothermal film.
    pub thermal: Option<ThermalNumbers>,
    /// Largest flash temperature rise of the surfaces, steady under the solved friction \[K\]; `None` without sliding and
    /// with `thermal.flash = "off"`.
    pub flash_rise: Option<f64>,
    /// Film over that of the flooded contact; `None` without [`supplied_film`](crate::sim::scene::LubricantSpec::supplied_film).
    pub starvation: Option<StarvationNumbers>,
    /// Mean temperature across the film at every node \[K\]; empty for an isothermal film.
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
    /// Implausible values of the scene ([`Scene::warnings`](crate::sim::Scene::warnings)), of surfaces from files, and of
    /// the solution.
    pub warnings: Vec<Warning>,
    /// Boundary friction coefficient; zero without sliding.
    pub(in crate::sim) boundary_friction: f64,
    /// Shear stress of the fluid \[Pa\].
    pub(in crate::sim) shear: Vec<f64>,
    /// Relative box error of the central film.
    pub(in crate::sim) box_error: f64,
}

impl ContactSolution {
    /// Fields by name, one value per node: `pressure` and `fluid_pressure` \[Pa\], `film` \[m\], `theta` (film fraction),
    /// `gap` and `plastic_depth` \[m\]; with [`thermal`](Self::thermal) also `film_temperature` \[K\].
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

impl ContactModel {
    /// The solution of a solve with this model; without `friction` it diverged.
    pub(in crate::sim) fn solution(
        &self,
        (report, heat): Solved,
        state: ContactState,
        gap: Vec<f64>,
        friction: Option<&FrictionFields>,
        numbers: Numbers,
    ) -> ContactSolution {
        let is_law = report.solver == SolverId::AsperityInlets;
        let model = if is_law { SolverModel::AsperityInlets } else { SolverModel::Resolved };
        let lubricated = self.lubricant.is_some();
        let resolved = lubricated && !is_law;
        let (thermal, film_temperature) = heat.unzip();
        ContactSolution {
            report,
            grid: self.grid,
            hertz: self.hertz.per_metre(&self.grid),
            moes: self.formulas.map(|formulas| formulas.moes),
            film_formula: self.formulas.map(|formulas| formulas.formula),
            film: numbers.film,
            pressure: numbers.pressure,
            contact: numbers.contact,
            friction: numbers.friction,
            roughness: numbers.roughness,
            boundary_friction: friction.map_or(f64::NAN, FrictionFields::first_boundary),
            shear: friction.map_or_else(|| vec![f64::NAN; state.film.len()], |fields| fields.shear.clone()),
            model: lubricated.then_some(model),
            scheme: resolved.then_some(self.scheme),
            face_mobility: resolved.then_some(self.face_mobility),
            contact_definition: resolved.then_some(self.contact),
            cavitation: resolved.then_some(self.cavitation),
            flow: self.flow,
            state,
            gap,
            error_estimate: None,
            box_error: self.inlet.as_ref().map_or(0.0, Inlet::film_error),
            warnings: self.inlet.iter().filter_map(|inlet| inlet.warning(&self.grid)).collect(),
            stress: None,
            flash_rise: None,
            starvation: None,
            thermal,
            film_temperature: film_temperature.unwrap_or_default(),
        }
    }
}
