//! A contact and the temperature of its film as one converged state.
//!
//! The film warms, its viscosity and density fall, pressures and films change, and with them the heat: a fixed
//! point in the temperatures of the film at the nodes. Each turn solves the contact with the temperatures so
//! far, at any pressure of a node with the viscosity that this temperature makes of it, finds the temperature
//! of the film that this contact has, and mixes what follows into them ([`Mixing`]). It ends where no node's
//! `ln eta` would change by more than [`TOLERANCE`], no density by more than [`DENSITY_TOLERANCE`], and the
//! heat is balanced. A contact that does not converge is tried again halfway to the last one that did.

use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{LEAST_TEMPERATURE, Saturating, ViscosityLaw};
use crate::metrics;
use crate::report::{SolveReport, Status};
use crate::reynolds::ContactState;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::mixing::Mixing;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::ThermalNumbers;
use crate::sim::contact::solution::is_known;
use crate::sim::error::SimError;
use crate::sim::scene::Scene;
use crate::thermal::{FilmFlow, FilmTemperature, FilmThermal, HeatBalance};
use crate::tribochem::ThermalBody;

/// Solves of the contact at most.
const MAX_SOLVES: u64 = 40;
/// Largest difference of `ln eta` at a node between what the contact was solved with and what its heat makes.
const TOLERANCE: f64 = 5e-3;
/// Largest relative change of the density of a film, by its thermal expansion.
const DENSITY_TOLERANCE: f64 = 5e-4;
/// Halvings of the way from the last contact that converged.
const MAX_RETREATS: usize = 4;
/// Share of the way to the new temperatures that a turn takes, beyond what the turns before tell of it. The
/// first turn takes all of the way.
const STEP: f64 = 0.5;

/// The report of a contact, with the numbers of its film's temperature and that of every node \[K\] where
/// the film has one.
pub(in crate::sim) type Solved = (SolveReport, Option<(ThermalNumbers, Vec<f64>)>);

/// Whether films have a temperature of their own.
pub(in crate::sim) fn is_asked(scene: &Scene) -> bool {
    scene.is_lubricated() && scene.lubricant.is_some_and(|lubricant| lubricant.thermal.is_some())
}

/// Checks that a film whose temperature is asked for has a viscosity `law` that knows temperature.
pub(in crate::sim) fn validate(scene: &Scene, law: Option<&dyn ViscosityLaw>) -> Result<(), InputError> {
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

/// What stays the same from solve to solve.
pub(in crate::sim) struct SolveContext<'a> {
    /// Laws of friction, plasticity, growth and wear.
    pub(in crate::sim) laws: &'a Laws,
    /// Tribofilms of ball and disc \[m\].
    pub(in crate::sim) tribofilms: &'a [Vec<f64>; 2],
}

/// One solve of the contact as it stands.
pub(in crate::sim) type SolveOnce<'a> =
    &'a mut dyn FnMut(&mut ContactModel, &mut ContactState) -> Result<SolveReport, SimError>;

/// What is solved: the contact, its state and its shear stresses.
type Contact<'a> = (&'a mut ContactModel, &'a mut ContactState, &'a mut FrictionFields);

/// Solves the contact and, with the `heat` of a film, again with the viscosities and densities that belong to
/// its temperature, until both agree; overwrites `friction` with the stresses of the film. Where they do not
/// agree within [`MAX_SOLVES`] the status is [`Status::MaxIterations`].
pub(in crate::sim) fn solve(
    given: &SolveContext<'_>,
    heat: Option<&mut FilmIteration>,
    (model, state, friction): Contact<'_>,
    solve_once: SolveOnce<'_>,
) -> Result<Solved, SimError> {
    model.find_far_field(given.laws)?;
    match heat {
        Some(heat) => heat.solve(given, (model, state, friction), solve_once),
        None => {
            let report = solve_once(model, state)?;
            if is_known(state) {
                friction.update(model, state, given.laws.friction.as_ref(), given.tribofilms)?;
            }
            Ok((report, None))
        }
    }
}

/// Temperature of the film of a contact, and what its solves start from.
///
/// A solve depends on the contact and on `start` alone: temperatures of surfaces are found anew from cool
/// ones, so that a checkpoint holds `start` and nothing else. Only [`commit`](FilmIteration::commit) moves
/// it.
#[derive(Debug, Clone)]
pub(in crate::sim) struct FilmIteration {
    /// Thermal properties of the fluid.
    properties: FilmThermal,
    /// Conductivity and diffusivity of ball and disc.
    bodies: [ThermalBody; 2],
    /// Speeds of the surfaces that the plan is made for \[m/s\].
    speeds: [f64; 2],
    /// What finds the temperature of a solved contact.
    temperature: FilmTemperature,
    /// Rises of the film above the bulk that a solve starts from \[K\]: those of its viscosity at all nodes,
    /// then those of its density. Zeros at first.
    start: Vec<f64>,
    /// Those that the contact was solved with.
    used: Vec<f64>,
    /// Those that its heat makes, less those it was solved with.
    residual: Vec<f64>,
}

/// The last contact of an iteration that converged, and the rises it was solved with.
type Good = (ContactState, Vec<f64>);

impl FilmIteration {
    /// Of a cool film; none where the scene does not ask for it.
    pub(in crate::sim) fn new(scene: &Scene, model: &ContactModel) -> Result<Option<Self>, InputError> {
        let properties = scene.lubricant.and_then(|lubricant| lubricant.thermal);
        let (Some(properties), true) = (properties, model.lubricant.is_some()) else { return Ok(None) };
        let (bodies, speeds) = (scene.thermal_bodies(), model.motion.surface_speeds());
        let zeros = vec![0.0; 2 * model.grid.len()];
        Ok(Some(Self {
            properties,
            bodies,
            speeds,
            temperature: FilmTemperature::new(&model.grid, properties, bodies, speeds)?,
            start: zeros.clone(),
            used: zeros.clone(),
            residual: zeros,
        }))
    }

    /// Plans anew where the surfaces move at other `speeds` \[m/s\] than before.
    pub(in crate::sim) fn move_at(&mut self, speeds: [f64; 2], grid: &Grid) -> Result<(), InputError> {
        if speeds.map(f64::to_bits) != self.speeds.map(f64::to_bits) {
            self.temperature = FilmTemperature::new(grid, self.properties, self.bodies, speeds)?;
            self.speeds = speeds;
        }
        Ok(())
    }

    /// Rises that the next solve starts from \[K\].
    #[cfg(feature = "serde")]
    pub(in crate::sim) fn start(&self) -> &[f64] {
        &self.start
    }

    /// Takes over rises that the next solve starts from \[K\].
    pub(in crate::sim) fn set_start(&mut self, rises: Vec<f64>) {
        self.start = rises;
    }

    /// Takes them away: the next solve starts from a cool film, as that of a single contact does.
    pub(in crate::sim) fn take_start(&mut self) -> Vec<f64> {
        let cool = vec![0.0; self.start.len()];
        std::mem::replace(&mut self.start, cool)
    }

    /// The next solve starts from the film of the last one.
    pub(in crate::sim) fn commit(&mut self) {
        self.start.copy_from_slice(&self.used);
    }

    /// Rises of the surfaces above the bulk temperature in the last contact \[K\].
    pub(in crate::sim) fn surface_rises(&self) -> [&[f64]; 2] {
        self.temperature.surface_rises()
    }

    /// Turns until contact and heat agree, until [`MAX_SOLVES`], or until a contact does not converge even
    /// close to the last one that did. The report counts the work of all solves, `friction` gets the stresses
    /// of the film, and the fluid keeps the temperatures that the last contact was solved with.
    fn solve(
        &mut self,
        given: &SolveContext<'_>,
        (model, state, friction): Contact<'_>,
        solve_once: SolveOnce<'_>,
    ) -> Result<Solved, SimError> {
        self.temperature.forget();
        self.used.copy_from_slice(&self.start);
        let is_cool = self.start.iter().all(|rise| *rise == 0.0);
        self.warm(model, is_cool)?;
        let (mut mixing, mut solves, mut retreats) = (Mixing::default(), 0, 0);
        let mut good: Option<Good> = None;
        let mut before: Option<SolveReport> = None;
        loop {
            let mut report = solve_once(model, state)?;
            if let Some(before) = before.take() {
                report = report.preceded_by(before);
            }
            solves += 1;
            if !is_known(state) {
                return Ok((report, None));
            }
            friction.update(model, state, given.laws.friction.as_ref(), given.tribofilms)?;
            let balance = self.heat(model, state, friction)?;
            let change = self.compare(model, state);
            let agrees = change <= TOLERANCE && balance.is_converged();
            let converged = report.status == Status::Converged;
            let retreat = if converged { None } else { good.as_ref().filter(|_| retreats < MAX_RETREATS) };
            if solves >= MAX_SOLVES || (converged && agrees) || (!converged && retreat.is_none()) {
                if !agrees && converged {
                    report.status = Status::MaxIterations;
                }
                friction.shear.copy_from_slice(self.temperature.stress());
                return Ok((report, Some(self.numbers(model, balance, (solves, change))?)));
            }
            if let Some((last, rises)) = retreat {
                state.clone_from(last);
                self.used.iter_mut().zip(rises).for_each(|(used, rise)| *used = 0.5 * (*used + rise));
                (mixing, retreats) = (Mixing::default(), retreats + 1);
            } else {
                good = Some((state.clone(), self.used.clone()));
                let share = if solves == 1 { 1.0 } else { STEP };
                mixing.advance(&mut self.used, &self.residual, share);
            }
            self.warm(model, false)?;
            before = Some(report);
        }
    }

    /// Gives the fluid of the contact the rises, or the temperature of the bulk where it is cool.
    fn warm(&self, model: &mut ContactModel, is_cool: bool) -> Result<(), InputError> {
        let Some(lubricant) = &mut model.lubricant else { return Ok(()) };
        let bulk = model.bulk_temperature;
        if is_cool {
            return lubricant.set_film_temperatures(bulk, &[], &[], self.properties.expansivity);
        }
        let films: Vec<f64> = self.used.iter().map(|rise| bulk + rise).collect();
        let (flow, mean) = films.split_at(films.len() / 2);
        lubricant.set_film_temperatures(bulk, flow, mean, self.properties.expansivity)
    }

    /// Temperatures of the contact as it is.
    fn heat(
        &mut self,
        model: &ContactModel,
        state: &ContactState,
        friction: &FrictionFields,
    ) -> Result<HeatBalance, InputError> {
        let (Some(lubricant), Some(flows)) = (&model.lubricant, &model.film_flows) else {
            return Err(InputError::Conflict {
                field: "lubricant.thermal".to_owned(),
                reason: "the contact is dry".to_owned(),
            });
        };
        let mut pressure = state.fluid_pressure.clone();
        if let Some(far) = &model.far_field {
            far.fill_edge(&model.grid, &mut pressure);
        }
        self.temperature.update(&FilmFlow {
            lubricant,
            rheology: friction.rheology(),
            pressure: &pressure,
            film: &state.film,
            theta: &state.theta,
            flows,
            boundary_heat: &friction.boundary_heat(),
            speeds: (model.motion.entrainment_speed, model.motion.sliding_speed()),
            bulk_temperature: model.bulk_temperature,
        })
    }

    /// Overwrites the residual and returns the largest change of `ln eta` at a node, or of `ln rho` in terms
    /// of its own tolerance.
    fn compare(&mut self, model: &ContactModel, state: &ContactState) -> f64 {
        let Some(lubricant) = &model.lubricant else { return 0.0 };
        let (law, bulk) = (Saturating::new(lubricant.viscosity()), model.bulk_temperature);
        let new = self.temperature.flow_temperature().iter().chain(self.temperature.mean());
        for (residual, (used, new)) in self.residual.iter_mut().zip(self.used.iter().zip(new)) {
            *residual = new - bulk - used;
        }
        let per_kelvin = self.properties.expansivity * TOLERANCE / DENSITY_TOLERANCE;
        let (flow, mean) = self.residual.split_at(state.film.len());
        let mut largest = mean.iter().fold(0.0_f64, |most, change| most.max(per_kelvin * change.abs()));
        for (k, (change, pressure)) in flow.iter().zip(&state.fluid_pressure).enumerate() {
            let at = |temperature| law.viscosity_at(*pressure, temperature);
            let used = (bulk + self.used[k]).max(LEAST_TEMPERATURE);
            if let (Some(old), Some(new)) = (at(used), at(used + change)) {
                largest = largest.max((new / old).ln().abs());
            }
        }
        largest
    }

    /// Numbers and temperatures of the film as it is, after so many `solves` and with the last `change`.
    fn numbers(
        &self,
        model: &ContactModel,
        balance: HeatBalance,
        (solves, change): (u64, f64),
    ) -> Result<(ThermalNumbers, Vec<f64>), InputError> {
        let temperature = self.temperature.mean().to_vec();
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |largest, value| largest.max(*value));
        let [surface_rise_ball, surface_rise_disc] = self.temperature.surface_rises().map(largest);
        let numbers = ThermalNumbers {
            film_temperature_max: largest(&temperature),
            film_temperature_mean_central: metrics::mean_central_film_in(
                &model.grid,
                &temperature,
                &model.hertz.ellipse(),
            )?,
            surface_rise_ball,
            surface_rise_disc,
            heat: balance.generated,
            imbalance: balance.imbalance(),
            solves,
            change,
        };
        Ok((numbers, temperature))
    }
}
