//! The solution of one contact and its numbers.

use super::accuracy::ErrorEstimate;
use super::contact::ContactModel;
use super::film_heat::FilmHeatNumbers;
use super::friction::{FrictionFields, FrictionShares};
use super::hertz::HertzContact;
use super::scene::Scene;
use super::warnings::Warning;
use crate::elastic::{LayerStressExtremes, LayeredStress, StressExtremes, stress_extremes};
use crate::error::InputError;
use crate::grid::Grid;
use crate::metrics;
use crate::report::SolveReport;
use crate::reynolds::{
    Cavitation, ContactDefinition, ContactState, FaceMobility, FlowBalance, Scheme, reaches_limit,
};

/// The solution of one contact.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let solution = solve_contact(&Scene::azam_2019(32))?;
/// let (contact, film) = (&solution.contact, &solution.film);
/// assert!(contact.max_pressure > solution.hertz.p_max); // the surfaces are rough
/// assert!((0.0..=1.0).contains(&contact.load_ratio) && film.minimum >= 0.9e-9);
/// let friction = solution.friction_boundary + solution.friction_fluid;
/// assert!((friction - solution.friction_coefficient).abs() < 1e-12);
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
    /// Moes parameters `(M, L)`; none for a dry contact.
    pub moes: Option<(f64, f64)>,
    /// Entrainment scheme, pressure flow and solid contact; none for a dry contact.
    pub discretisation: Option<(Scheme, FaceMobility, ContactDefinition)>,
    /// What holds where the fluid cavitates; none for a dry contact.
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
    /// Temperature of the film; none where the scene does not ask for it.
    pub film_heat: Option<FilmHeatNumbers>,
    /// Film numbers.
    pub film: FilmNumbers,
    /// Contact numbers.
    pub contact: ContactNumbers,
    /// Friction coefficient, from boundary friction under the solid pressure and shear of the fluid; zero
    /// without sliding.
    pub friction_coefficient: f64,
    /// Part of the friction coefficient that solid contact makes.
    pub friction_boundary: f64,
    /// Part of the friction coefficient that shear of the fluid makes.
    pub friction_fluid: f64,
    /// Composite roughness `sqrt(rq_ball^2 + rq_disc^2)` on the track, as in a [record](super::StepRecord)
    /// \[m\].
    pub composite_rq: f64,
    /// `film.mean_central / composite_rq`; none between smooth surfaces and where the film is not known.
    pub lambda: Option<f64>,
    /// What is unlikely to be meant or to hold: that of [`Scene::warnings`](super::Scene::warnings), of
    /// surfaces from files, and of the solution.
    pub warnings: Vec<Warning>,
    /// Coefficient of friction of solid contact; zero without sliding.
    pub(super) boundary_friction: f64,
    /// Shear stress of the fluid \[Pa\].
    pub(super) shear: Vec<f64>,
}

impl ContactSolution {
    /// Fields by name, one value a node: `pressure` and `fluid_pressure` \[Pa\], `film` \[m\], `theta` (the
    /// share of the gap that is filled), `gap` and `plastic_depth` \[m\], with [`film_heat`](Self::film_heat)
    /// `film_temperature` \[K\] too.
    pub fn fields(&self) -> Vec<(&'static str, &[f64])> {
        let state = &self.state;
        let mut fields: Vec<(&'static str, &[f64])> = vec![
            ("pressure", &state.pressure),
            ("fluid_pressure", &state.fluid_pressure),
            ("film", &state.film),
            ("theta", &state.content),
            ("gap", &self.gap),
            ("plastic_depth", &state.plastic_depth),
        ];
        fields.extend(self.film_heat.iter().map(|heat| ("film_temperature", &*heat.temperature)));
        fields
    }
}

/// Film thickness of a solution \[m\].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FilmNumbers {
    /// At x = y = 0, interpolated between nodes.
    pub central: f64,
    /// Smallest over the nodes that carry pressure.
    pub minimum: f64,
    /// Mean over r <= 2a/3.
    pub mean_central: f64,
    /// Smallest over all nodes.
    pub minimum_gap: f64,
}

impl FilmNumbers {
    /// Of a solve that diverged.
    const UNKNOWN: Self =
        Self { central: f64::NAN, minimum: f64::NAN, mean_central: f64::NAN, minimum_gap: f64::NAN };
}

/// Pressure and contact of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ContactNumbers {
    /// Largest pressure, between nodes where the peak is resolved (see [`metrics::peak`]) \[Pa\].
    pub max_pressure: f64,
    /// Pressure at x = y = 0 \[Pa\].
    pub central_pressure: f64,
    /// Area of solid contact inside the Hertz ellipse over its area.
    pub area_ratio: f64,
    /// Share of the load that solid contact carries.
    pub load_ratio: f64,
    /// Area of solid contact \[m^2\].
    pub area: f64,
    /// The area ratio with the edges of the contacts corrected, see [`metrics::ContactStatistics`].
    pub corrected_area_ratio: f64,
    /// The area with the edges of the contacts corrected \[m^2\].
    pub corrected_area: f64,
    /// Area of nodes at the pressure limit \[m^2\].
    pub plastic_area: f64,
    /// Film at which solids touch, without which the ratios say little; zero in a dry contact \[m\].
    pub film_cutoff: f64,
}

impl ContactNumbers {
    const UNKNOWN: Self = Self {
        max_pressure: f64::NAN,
        central_pressure: f64::NAN,
        area_ratio: f64::NAN,
        load_ratio: f64::NAN,
        area: f64::NAN,
        corrected_area_ratio: f64::NAN,
        corrected_area: f64::NAN,
        plastic_area: f64::NAN,
        film_cutoff: f64::NAN,
    };
}

/// Stresses below the surface of the disc, under pressure and friction.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct StressNumbers {
    /// Largest stress of von Mises and largest orthogonal shear stress, below a layer those of the substrate.
    pub largest: StressExtremes,
    /// Those of the layer and of its bond; none without a layer.
    pub layer: Option<LayerStressExtremes>,
    /// Largest stress of von Mises over the yield strength; none without one.
    pub yield_ratio: Option<f64>,
    /// Largest orthogonal shear stress over the yield stress in shear, `yield strength / sqrt 3`: the load is
    /// below the elastic shakedown limit of free rolling where it is below one (see
    /// [`StressExtremes::orthogonal_shear`]); none without a strength.
    pub shakedown_ratio: Option<f64>,
}

impl StressNumbers {
    /// Those of `state`, if `scene` asks for them. The disc is dragged along the motion of the ball against
    /// it.
    pub(super) fn of(
        scene: &Scene,
        model: &ContactModel,
        state: &ContactState,
        friction: &FrictionFields,
    ) -> Result<Option<Self>, InputError> {
        let Some(spec) = scene.stress else { return Ok(None) };
        let sliding = model.motion.sliding_speed() > 0.0;
        let direction = model.motion.slide_roll_ratio.signum();
        let traction: Option<Vec<f64>> =
            sliding.then(|| (0..state.pressure.len()).map(|k| direction * friction.stress(k)).collect());
        let depths = spec.depths(model.hertz.a_x.min(model.hertz.a_y));
        let (grid, pressure, traction) = (&model.grid, &state.pressure, traction.as_deref());
        let (largest, layer) = match scene.layer()? {
            None => (stress_extremes(grid, spec.poisson(scene), &depths, pressure, traction)?, None),
            Some(layer) => {
                let both = LayeredStress::new(grid, layer, pressure, traction)?.extremes(&depths)?;
                (both.substrate, Some(both.layer))
            }
        };
        let over = |stress: f64, share: f64| spec.yield_strength.map(|strength| stress / (share * strength));
        Ok(Some(Self {
            largest,
            layer,
            yield_ratio: over(largest.von_mises.stress, 1.0),
            shakedown_ratio: over(largest.orthogonal_shear.stress, 1.0 / 3.0_f64.sqrt()),
        }))
    }
}

/// Whether a state is a state: one of a solve that diverged may be none.
pub(super) fn is_known(state: &ContactState) -> bool {
    state.pressure.iter().chain(&state.film).all(|value| value.is_finite())
}

/// The numbers of a solved contact.
pub(super) struct Numbers {
    /// Film thicknesses.
    film: FilmNumbers,
    /// Pressures and solid contact.
    contact: ContactNumbers,
    /// Coefficient of friction and its parts.
    friction: FrictionShares,
    /// Coefficient of solid contact at the first node.
    boundary_friction: f64,
    /// Shear stress of the fluid \[Pa\].
    shear: Vec<f64>,
}

impl Numbers {
    /// Those of `state`; without `friction` the solve diverged, which is a status, and its numbers are
    /// unknown.
    pub(super) fn of(
        model: &ContactModel,
        state: &ContactState,
        friction: Option<&FrictionFields>,
        limit: Option<&[f64]>,
    ) -> Result<Self, InputError> {
        let Some(friction) = friction else {
            let (film, contact) = (FilmNumbers::UNKNOWN, ContactNumbers::UNKNOWN);
            let (boundary_friction, shear) = (f64::NAN, vec![f64::NAN; state.film.len()]);
            return Ok(Self { film, contact, friction: FrictionShares::UNKNOWN, boundary_friction, shear });
        };
        Ok(Self {
            film: film_numbers(model, state)?,
            contact: contact_numbers(model, state, &friction.solid, limit)?,
            friction: friction.shares(model)?,
            boundary_friction: friction.first_boundary(),
            shear: friction.shear.clone(),
        })
    }
}

impl ContactModel {
    /// The solution that a solve with this model has led to.
    pub(super) fn solution(
        &self,
        (report, state): (SolveReport, ContactState),
        gap: Vec<f64>,
        numbers: Numbers,
        rq: [f64; 2],
    ) -> ContactSolution {
        let lubricated = self.lubricant.is_some();
        let composite_rq = metrics::composite_rq(rq[0], rq[1]);
        let lambda = numbers.film.mean_central / composite_rq;
        ContactSolution {
            report,
            grid: self.grid,
            hertz: self.hertz,
            moes: self.formulas.map(|formulas| formulas.moes),
            film: numbers.film,
            contact: numbers.contact,
            friction_coefficient: numbers.friction.coefficient,
            friction_boundary: numbers.friction.boundary,
            friction_fluid: numbers.friction.fluid,
            boundary_friction: numbers.boundary_friction,
            shear: numbers.shear,
            discretisation: lubricated.then_some((self.scheme, self.face_mobility, self.contact)),
            cavitation: lubricated.then_some(self.cavitation),
            composite_rq,
            lambda: lambda.is_finite().then_some(lambda),
            flow: self.flow,
            state,
            gap,
            error_estimate: None,
            warnings: Vec::new(),
            stress: None,
            film_heat: None,
        }
    }
}

/// Central film interpolated at `x = y = 0`, mean within two thirds of the Hertz radii, minima with and
/// without pressure.
pub(super) fn film_numbers(model: &ContactModel, state: &ContactState) -> Result<FilmNumbers, InputError> {
    Ok(FilmNumbers {
        central: model.grid.interpolate(&state.film, 0.0, 0.0)?,
        minimum: metrics::minimum_film(&state.film, &state.pressure)?.unwrap_or(0.0),
        mean_central: metrics::average_film_in(&model.grid, &state.film, &model.hertz.ellipse())?,
        minimum_gap: metrics::minimum_gap(&state.film)?,
    })
}

/// Largest and central pressure, area and load of solid contact under the pressure `solid`, and area at the
/// `limit`.
pub(super) fn contact_numbers(
    model: &ContactModel,
    state: &ContactState,
    solid: &[f64],
    limit: Option<&[f64]>,
) -> Result<ContactNumbers, InputError> {
    let ellipse = model.hertz.ellipse();
    let statistics =
        metrics::statistics_in(&model.grid, &state.in_contact, solid, model.hertz.load, &ellipse)?;
    let ellipse = std::f64::consts::PI * model.hertz.a_x * model.hertz.a_y;
    // Between nodes no more than the node of the largest pressure may carry.
    let top = state.pressure.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
    let bound = top.and_then(|(k, _)| limit?.get(k).copied()).unwrap_or(f64::INFINITY);
    let at_limit = limit.map_or(0, |limit| {
        state.pressure.iter().zip(limit).filter(|(p, limit)| reaches_limit(**p, **limit)).count()
    });
    Ok(ContactNumbers {
        max_pressure: metrics::peak(&model.grid, &state.pressure)?.min(bound),
        central_pressure: model.grid.interpolate(&state.pressure, 0.0, 0.0)?,
        area_ratio: statistics.area_ratio * ellipse / model.hertz.area,
        load_ratio: statistics.load_ratio,
        area: statistics.area,
        corrected_area_ratio: statistics.corrected_area_ratio * ellipse / model.hertz.area,
        corrected_area: statistics.corrected_area,
        plastic_area: at_limit as f64 * model.grid.cell_area(),
        film_cutoff: if model.lubricant.is_some() { model.film_cutoff } else { 0.0 },
    })
}
