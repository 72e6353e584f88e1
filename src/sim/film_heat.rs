//! A contact and the temperature of its film as one converged state.
//!
//! The film warms, its viscosity falls, pressures and films change, and with them the heat: a fixed point in
//! the logarithms of the ratios of viscosity at the nodes. Each turn solves the contact with the ratios so
//! far, finds the temperature of the film that this contact has, and mixes what follows into the ratios
//! ([`Mixing`]). It ends where no node's `ln eta` would change by more than [`TOLERANCE`] and the heat is
//! balanced. Only a single contact is solved so; a history knows the bulk temperature alone.

use super::SimError;
use super::contact::ContactModel;
use super::friction::FrictionFields;
use super::laws::Laws;
use super::mixing::Mixing;
use super::scene::Scene;
use super::solution::is_known;
use crate::error::InputError;
use crate::lubricant::ViscosityLaw;
use crate::metrics;
use crate::report::{SolveReport, Status};
use crate::reynolds::ContactState;
use crate::thermal::{FilmFlow, FilmTemperature, HeatBalance};

/// Solves of the contact at most.
const MAX_SOLVES: usize = 40;
/// Largest difference of `ln eta` at a node between what the contact was solved with and what its heat makes.
const TOLERANCE: f64 = 5e-3;
/// Largest logarithm of a ratio of viscosities.
const LARGEST: f64 = 30.0;
/// Share of the way to the new viscosities that is gone in a direction of which nothing is known.
const STEP: f64 = 0.5;

/// Film temperature of a solved contact.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// use stribeck::thermal::FilmThermal;
/// let mut scene = Scene::azam_2019(32);
/// // A viscosity that knows temperature: 4 mPa s hold at 80 C.
/// scene.lubricant = scene.lubricant.map(|oil| {
///     let known = oil.with_temperature(Some(353.15)).with_roelands_s0(Some(1.1));
///     known.with_thermal(Some(FilmThermal::default()))
/// });
/// let heat = solve_contact(&scene)?.film_heat.ok_or("not asked for")?;
/// assert!(heat.maximum > 353.15 && heat.balance.imbalance() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FilmHeatNumbers {
    /// Mean temperature across the film at every node \[K\].
    pub temperature: Vec<f64>,
    /// Largest temperature of the film \[K\].
    pub maximum: f64,
    /// Mean over r <= 2a/3 \[K\].
    pub mean_central: f64,
    /// Largest rises of the surfaces of ball and disc above the bulk temperature \[K\].
    pub surface_rises: [f64; 2],
    /// Heat of the contact.
    pub balance: HeatBalance,
    /// Solves of the contact.
    pub solves: usize,
    /// Largest difference of `ln eta` at a node between what the contact was solved with and what its heat
    /// makes.
    pub change: f64,
}

/// Checks that a film whose temperature is asked for has a viscosity `law` that knows temperature.
pub(super) fn validate(scene: &Scene, law: Option<&dyn ViscosityLaw>) -> Result<(), InputError> {
    let asked = scene.lubricant.is_some_and(|lubricant| lubricant.thermal.is_some());
    match law {
        Some(law) if asked && law.viscosity_at(0.0, scene.thermal.bulk_temperature).is_none() => {
            Err(InputError::Conflict {
                field: "lubricant.thermal".to_owned(),
                reason: "the viscosity does not know temperature: give lubricant.temperature and lubricant.roelands_s0, or \
                         another law as lubricant.viscosity"
                    .to_owned(),
            })
        }
        _ => Ok(()),
    }
}

/// A history knows the bulk temperature alone.
pub(super) fn refuse_history(scene: &Scene) -> Result<(), InputError> {
    if !scene.is_lubricated() || scene.lubricant.is_none_or(|lubricant| lubricant.thermal.is_none()) {
        return Ok(());
    }
    Err(InputError::Conflict {
        field: "lubricant.thermal".to_owned(),
        reason: "only a single contact has a film temperature, a history knows the bulk temperature alone"
            .to_owned(),
    })
}

/// What stays the same from solve to solve.
pub(super) struct Surroundings<'a> {
    /// Laws of friction, plasticity, growth and wear.
    pub(super) laws: &'a Laws,
    /// Undeformed gap \[m\].
    pub(super) gap: &'a [f64],
    /// Pressure limit \[Pa\]; none without plasticity.
    pub(super) limit: Option<&'a [f64]>,
    /// Tribofilms of ball and disc \[m\].
    pub(super) tribofilms: &'a [Vec<f64>; 2],
}

/// What finds the temperature of the film; none where the scene does not ask for it.
pub(super) fn temperature(
    scene: &Scene,
    model: &ContactModel,
) -> Result<Option<FilmTemperature>, InputError> {
    let Some(properties) = scene.lubricant.and_then(|lubricant| lubricant.thermal) else { return Ok(None) };
    if model.lubricant.is_none() {
        return Ok(None);
    }
    let (bodies, speeds) = (scene.thermal_bodies(), model.motion.surface_speeds());
    FilmTemperature::new(&model.grid, properties, bodies, speeds).map(Some)
}

/// Solves the contact as [`ContactModel::solve`] does and, with a `temperature` of the film, again with the
/// viscosities that belong to it, until both agree; overwrites `friction` with the stresses of the warm film.
/// Where they do not agree within [`MAX_SOLVES`] the status is
/// [`Status::MaxIterations`].
pub(super) fn solve(
    given: &Surroundings<'_>,
    temperature: Option<FilmTemperature>,
    model: &mut ContactModel,
    state: &mut ContactState,
    friction: &mut FrictionFields,
) -> Result<(SolveReport, Option<FilmHeatNumbers>), SimError> {
    let report = model.solve(given.gap, given.limit, None, state)?;
    let known = is_known(state);
    if known {
        friction.update(model, state, given.laws.friction.as_ref(), given.tribofilms)?;
    }
    let (Some(temperature), true) = (temperature, known) else { return Ok((report, None)) };
    let zeros = vec![0.0; state.film.len()];
    Loop { temperature, used: zeros.clone(), residual: zeros, mixing: Mixing::default() }.run(
        given,
        (model, state, friction),
        report,
    )
}

/// The iteration between contact and temperature.
struct Loop {
    /// What finds the temperature of a solved contact.
    temperature: FilmTemperature,
    /// Logarithms of the ratios of viscosity that the contact was solved with, and those that its heat makes
    /// beyond them.
    used: Vec<f64>,
    /// Those that its heat makes, less those it was solved with.
    residual: Vec<f64>,
    /// The way from one turn to the next.
    mixing: Mixing,
}

impl Loop {
    /// Turns until contact and heat agree, until [`MAX_SOLVES`], or until a contact does not converge.
    /// `report` is that of the cool contact; the one that is returned counts the work of all.
    fn run(
        mut self,
        given: &Surroundings<'_>,
        (model, state, friction): (&mut ContactModel, &mut ContactState, &mut FrictionFields),
        mut report: SolveReport,
    ) -> Result<(SolveReport, Option<FilmHeatNumbers>), SimError> {
        let mut solves = 1;
        loop {
            let balance = self.heat(model, state, friction)?;
            let change = self.compare();
            let agree = change <= TOLERANCE && balance.is_converged();
            let done = agree || solves >= MAX_SOLVES || report.status != Status::Converged;
            if done {
                if !agree && report.status == Status::Converged {
                    report.status = Status::MaxIterations;
                }
                friction.shear.copy_from_slice(self.temperature.stress());
                return Ok((report, Some(self.numbers(model, balance, (solves, change))?)));
            }
            // The first heat is that of the cool film, of which nothing but the way is known.
            self.mixing.advance(&mut self.used, &self.residual, if solves == 1 { 1.0 } else { STEP });
            for used in &mut self.used {
                *used = used.clamp(-LARGEST, LARGEST);
            }
            let ratios: Vec<f64> = self.used.iter().map(|used| used.exp()).collect();
            if let Some(lubricant) = &mut model.lubricant {
                lubricant.set_viscosity_ratios(&ratios)?;
            }
            report = model.solve(given.gap, given.limit, None, state)?.preceded_by(report);
            solves += 1;
            if !is_known(state) {
                return Ok((report, None));
            }
            friction.update(model, state, given.laws.friction.as_ref(), given.tribofilms)?;
        }
    }

    /// Temperatures of the contact as it is.
    fn heat(
        &mut self,
        model: &ContactModel,
        state: &ContactState,
        friction: &FrictionFields,
    ) -> Result<HeatBalance, InputError> {
        let Some(lubricant) = &model.lubricant else {
            return Err(InputError::Conflict {
                field: "lubricant.thermal".to_owned(),
                reason: "the contact is dry".to_owned(),
            });
        };
        self.temperature.update(&FilmFlow {
            lubricant,
            rheology: friction.rheology(),
            pressure: &state.fluid_pressure,
            film: &state.film,
            content: &state.content,
            boundary_heat: &friction.boundary_heat(),
            speeds: (model.motion.entrainment_speed, model.motion.sliding_speed()),
            bulk_temperature: model.bulk_temperature,
        })
    }

    /// The largest difference of the logarithms of what was used and what the heat makes.
    fn compare(&mut self) -> f64 {
        let pairs = self.used.iter().zip(self.temperature.viscosity_ratios());
        for (residual, (used, new)) in self.residual.iter_mut().zip(pairs) {
            *residual = new.ln() - used;
        }
        self.residual.iter().fold(0.0, |largest, residual| residual.abs().max(largest))
    }

    /// Numbers of the film as it is, after so many `solves` and with the last `change`.
    fn numbers(
        &self,
        model: &ContactModel,
        balance: HeatBalance,
        (solves, change): (usize, f64),
    ) -> Result<FilmHeatNumbers, InputError> {
        let temperature = self.temperature.mean().to_vec();
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |largest, value| largest.max(*value));
        Ok(FilmHeatNumbers {
            maximum: largest(&temperature),
            mean_central: metrics::average_film_in(&model.grid, &temperature, &model.hertz.ellipse())?,
            surface_rises: self.temperature.surface_rises().map(largest),
            temperature,
            balance,
            solves,
            change,
        })
    }
}
