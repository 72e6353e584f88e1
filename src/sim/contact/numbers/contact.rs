//! Film, pressure and solid contact.

use super::{FrictionNumbers, RoughnessNumbers};
use crate::error::InputError;
use crate::metrics;
use crate::reynolds::{Cavitation, ContactDefinition, ContactState, reaches_limit};
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::model::ContactModel;

/// Largest overlap of the bodies under pressure, over the film by formula, of a contact whose film is known.
const LARGEST_OVERLAP: f64 = 0.01;

/// Film thickness \[m\], and over roughness.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let solution = solve_contact(&Scene::azam_2019(32))?;
/// let film = solution.film;
/// assert!(film.minimum_gap <= film.minimum && film.minimum <= film.mean_central);
/// assert_eq!(film.lambda, Some(film.mean_central / solution.roughness.composite_rq));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
    /// `mean_central` over the composite roughness; `None` for smooth surfaces and an unknown film.
    pub lambda: Option<f64>,
    /// `minimum` over the composite roughness; `None` for smooth surfaces and an unknown film.
    pub minimum_lambda: Option<f64>,
    /// `central`, between rough bodies `mean_central`, over the central film by formula; `None` for a dry contact and an unknown film.
    pub formula_ratio: Option<f64>,
    /// Central film by formula (Hamrock and Dowson; Dowson and Toyoda for a line contact), with the stated
    /// pressure-viscosity coefficient, over the composite roughness; `None` for smooth surfaces and a dry contact.
    pub formula_lambda: Option<f64>,
    /// Volume of oil over the volume of the gap inside the Hertz contact; `None` for a dry contact, an unknown film and
    /// cavitation that does not conserve mass.
    pub fluid_fraction: Option<f64>,
}

impl FilmNumbers {
    /// Values of a solve that diverged or whose bodies overlap.
    const UNKNOWN: Self = Self {
        central: f64::NAN,
        minimum: f64::NAN,
        mean_central: f64::NAN,
        minimum_gap: f64::NAN,
        lambda: None,
        minimum_lambda: None,
        formula_ratio: None,
        formula_lambda: None,
        fluid_fraction: None,
    };

    /// From `state`, over the `roughness`.
    pub(in crate::sim) fn of(
        model: &ContactModel,
        state: &ContactState,
        roughness: &RoughnessNumbers,
    ) -> Result<Self, InputError> {
        let mean_central = metrics::mean_central_film_in(&model.grid, &state.film, &model.hertz.ellipse())?;
        let central = model.grid.interpolate(&state.film, 0.0, 0.0)?;
        // Films of solved contacts are negative by residuals alone.
        let overlap = model.lubricant.as_ref().map_or(f64::INFINITY, |_| LARGEST_OVERLAP * model.stated_film);
        let minimum = metrics::minimum_film(&state.film, &state.pressure)?.unwrap_or(0.0);
        if model.contact == ContactDefinition::Hard && central.min(minimum) < -overlap {
            return Ok(Self::UNKNOWN);
        }
        let formula = model.lubricant.as_ref().map(|_| model.stated_film).filter(|film| *film > 0.0);
        Ok(Self {
            central,
            minimum,
            mean_central,
            minimum_gap: metrics::minimum_gap(&state.film)?,
            lambda: roughness.lambda(mean_central),
            minimum_lambda: roughness.lambda(minimum),
            // The film at one node of rough bodies is that of a peak or a valley.
            formula_ratio: formula
                .map(|formula| if roughness.composite_rq > 0.0 { mean_central } else { central } / formula),
            formula_lambda: model.lubricant.as_ref().and_then(|_| roughness.lambda(model.stated_film)),
            fluid_fraction: fluid_fraction(model, state),
        })
    }
}

/// Volume of oil over that of the gap inside the Hertz contact; `None` where the film fraction is not solved for.
fn fluid_fraction(model: &ContactModel, state: &ContactState) -> Option<f64> {
    let conserves_mass = model.cavitation == Cavitation::MassConserving;
    if model.lubricant.is_none() || !conserves_mass {
        return None;
    }
    let ellipse = model.hertz.ellipse();
    let (mut oil, mut gap) = (0.0, 0.0);
    for ((x, y), (film, theta)) in model.grid.nodes().zip(state.film.iter().zip(&state.theta)) {
        if ellipse.radius_squared(x, y) <= 1.0 {
            oil += theta * film.max(0.0);
            gap += film.max(0.0);
        }
    }
    (gap > 0.0).then(|| oil / gap)
}

/// Total pressure, fluid plus solid \[Pa\].
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let solution = solve_contact(&Scene::azam_2019(32))?;
/// let pressure = solution.pressure;
/// // Rough surfaces: asperities exceed the Hertz pressure and yield at 6 GPa.
/// assert!(pressure.max > solution.hertz.pressure && pressure.max <= 6e9);
/// assert!(pressure.mean < pressure.max);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct PressureNumbers {
    /// Maximum, interpolated between nodes if the peak is resolved (see [`metrics::peak`]), at most the limit of its
    /// node.
    pub max: f64,
    /// At x = y = 0.
    pub central: f64,
    /// Mean over the nodes under pressure.
    pub mean: f64,
    /// Load carried by the fluid outside of the box if the box cuts a flooded inlet \[N\]; the pressures in the box carry
    /// the rest.
    pub load_outside: f64,
}

impl PressureNumbers {
    /// Values of a solve that diverged.
    const UNKNOWN: Self = Self { max: f64::NAN, central: f64::NAN, mean: f64::NAN, load_outside: f64::NAN };

    /// From `state`, whose pressure does not exceed the `limit`.
    pub(in crate::sim) fn of(
        model: &ContactModel,
        state: &ContactState,
        limit: Option<&[f64]>,
    ) -> Result<Self, InputError> {
        // Interpolated between nodes, but not above the limit of the node of largest pressure.
        let top = state.pressure.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1));
        let bound = top.and_then(|(k, _)| limit?.get(k).copied()).unwrap_or(f64::INFINITY);
        let carrying = state.pressure.iter().filter(|p| **p > 0.0).count().max(1);
        let sum = state.pressure.iter().sum::<f64>();
        let carried = sum * model.grid.cell_area();
        let outside = model.far_field.as_ref().map(|far| far.load_outside(model.hertz.force, carried));
        Ok(Self {
            max: metrics::peak(&model.grid, &state.pressure)?.min(bound),
            central: model.grid.interpolate(&state.pressure, 0.0, 0.0)?,
            mean: sum / carrying as f64,
            load_outside: outside.unwrap_or(0.0) / model.grid.contact_length(),
        })
    }
}

/// Solid contact. Areas of a line contact are per metre of its length.
///
/// Solids touch where the gap is the contact film, `solver.film_cutoff`. They carry the pressure that the fluid does not.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let solution = solve_contact(&Scene::azam_2019(32))?;
/// let contact = solution.contact;
/// assert!(contact.load_ratio > 0.0 && contact.load_ratio < 1.0);
/// assert!(contact.area_ratio <= contact.area / solution.hertz.area + 1e-12);
/// assert_eq!(contact.film_cutoff, 1e-9);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ContactNumbers {
    /// Area of solid contact inside the Hertz ellipse over its area.
    pub area_ratio: f64,
    /// Load ratio: share of the load carried by solid contact.
    pub load_ratio: f64,
    /// Area of solid contact \[m^2\].
    pub area: f64,
    /// Area ratio with corrected contact edges, see [`metrics::ContactStatistics`].
    pub corrected_area_ratio: f64,
    /// Area with corrected contact edges \[m^2\].
    pub corrected_area: f64,
    /// Area of nodes at the pressure limit \[m^2\].
    pub plastic_area: f64,
    /// Contact film, on which the ratios depend; zero in a dry contact \[m\].
    pub film_cutoff: f64,
}

impl ContactNumbers {
    const UNKNOWN: Self = Self {
        area_ratio: f64::NAN,
        load_ratio: f64::NAN,
        area: f64::NAN,
        corrected_area_ratio: f64::NAN,
        corrected_area: f64::NAN,
        plastic_area: f64::NAN,
        film_cutoff: f64::NAN,
    };

    /// Area and load of solid contact under the pressure `solid`, and area at the `limit`.
    pub(in crate::sim) fn of(
        model: &ContactModel,
        state: &ContactState,
        solid: &[f64],
        limit: Option<&[f64]>,
    ) -> Result<Self, InputError> {
        let ellipse = model.hertz.ellipse();
        let statistics =
            metrics::statistics_in(&model.grid, &state.in_contact, solid, model.hertz.force, &ellipse)?;
        let ellipse = std::f64::consts::PI * model.hertz.half_width_x * model.hertz.half_width_y;
        let length = model.grid.contact_length();
        let at_limit = limit.map_or(0, |limit| {
            state.pressure.iter().zip(limit).filter(|(p, limit)| reaches_limit(**p, **limit)).count()
        });
        Ok(Self {
            area_ratio: statistics.area_ratio * ellipse / model.hertz.area,
            load_ratio: statistics.load_ratio,
            area: statistics.area / length,
            corrected_area_ratio: statistics.corrected_area_ratio * ellipse / model.hertz.area,
            corrected_area: statistics.corrected_area / length,
            plastic_area: at_limit as f64 * model.grid.cell_area() / length,
            film_cutoff: if model.lubricant.is_some() { model.film_cutoff } else { 0.0 },
        })
    }
}

/// The results of a solved contact.
pub(in crate::sim) struct Numbers {
    /// Film thickness.
    pub(in crate::sim) film: FilmNumbers,
    /// Total pressure.
    pub(in crate::sim) pressure: PressureNumbers,
    /// Solid contact.
    pub(in crate::sim) contact: ContactNumbers,
    /// Coefficient of friction and its parts.
    pub(in crate::sim) friction: FrictionNumbers,
    /// Roughness on the track.
    pub(in crate::sim) roughness: RoughnessNumbers,
}

impl Numbers {
    /// From `state` between bodies of the roughness `rq`, whose pressure does not exceed the `limit`. Without `friction` the
    /// solve diverged, and the results are unknown.
    pub(in crate::sim) fn of(
        model: &ContactModel,
        state: &ContactState,
        friction: Option<&FrictionFields>,
        limit: Option<&[f64]>,
        rq: [f64; 2],
    ) -> Result<Self, InputError> {
        let roughness = RoughnessNumbers::of(rq);
        let Some(friction) = friction else {
            return Ok(Self {
                film: FilmNumbers::UNKNOWN,
                pressure: PressureNumbers::UNKNOWN,
                contact: ContactNumbers::UNKNOWN,
                friction: FrictionNumbers::UNKNOWN,
                roughness,
            });
        };
        Ok(Self {
            film: FilmNumbers::of(model, state, &roughness)?,
            pressure: PressureNumbers::of(model, state, limit)?,
            contact: ContactNumbers::of(model, state, &friction.solid, limit)?,
            friction: friction.numbers(model)?,
            roughness,
        })
    }
}
