//! Coupled solution of a contact and the temperature of its film.
//!
//! Heating lowers viscosity and density of the film, which changes pressures, films and the heat: a fixed-point problem
//! in the film temperatures at the nodes. Each iteration solves the contact at the present temperatures, computes the
//! film temperature of this solution and mixes it in ([`Mixing`]). It converges when no node's `ln eta` changes by more
//! than [`TOLERANCE`], no density by more than [`DENSITY_TOLERANCE`], and the heat is balanced. If the contact does not
//! converge, the temperatures are moved halfway back to the last contact that did.

use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{LEAST_TEMPERATURE, Saturating, ViscosityLaw as _};
use crate::metrics;
use crate::report::{SolveReport, Status};
use crate::reynolds::ContactState;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::laws::Laws;
use crate::sim::contact::mixing::Mixing;
use crate::sim::contact::model::ContactModel;
use crate::sim::contact::numbers::{ThermalNumbers, is_known};
use crate::sim::error::SimError;
use crate::sim::scene::Scene;
use crate::thermal::{FilmFlow, FilmTemperature, FilmThermal, HeatBalance};
use crate::tribochem::ThermalBody;

/// Most solves of the contact.
const MAX_SOLVES: u64 = 40;
/// Tolerance of `ln eta` at a node.
const TOLERANCE: f64 = 5e-3;
/// Relative tolerance of the film density, by thermal expansion.
const DENSITY_TOLERANCE: f64 = 5e-4;
/// Most halvings of the step from the last contact that converged.
const MAX_RETREATS: usize = 4;
/// Step length towards the new temperatures, apart from Anderson mixing. The first iteration takes a full step.
const STEP: f64 = 0.5;

/// Report of a contact, with the results of its film temperature and the temperature at every node \[K\], if modelled.
pub(in crate::sim) type Solved = (SolveReport, Option<(ThermalNumbers, Vec<f64>)>);

/// Context that is fixed during the solves.
pub(in crate::sim) struct SolveContext<'a> {
    /// Laws of friction, plasticity, growth and wear.
    pub(in crate::sim) laws: &'a Laws,
    /// Tribofilms of ball and disc \[m\].
    pub(in crate::sim) tribofilms: &'a [Vec<f64>; 2],
}

/// One solve of the contact.
pub(in crate::sim) type SolveOnce<'a> =
    &'a mut dyn FnMut(&mut ContactModel, &mut ContactState) -> Result<SolveReport, SimError>;

/// The contact, its state and its shear stresses.
type Contact<'a> = (&'a mut ContactModel, &'a mut ContactState, &'a mut FrictionFields);

/// Solves the contact. With the `heat` of a film it is solved repeatedly, with viscosities and densities of the film
/// temperature, until both agree. Overwrites `friction` with the stresses of the film. Without agreement within
/// [`MAX_SOLVES`] the status is [`Status::MaxIterations`].
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

/// Temperature iteration of the film of a contact.
///
/// A solve depends only on the contact and on `start`: surface temperatures are computed anew from zero rise, so that
/// a checkpoint only needs `start`. Only [`commit`](FilmIteration::commit) changes it.
#[derive(Debug, Clone)]
pub(in crate::sim) struct FilmIteration {
    /// Thermal properties of the fluid.
    properties: FilmThermal,
    /// Conductivity and diffusivity of ball and disc.
    bodies: [ThermalBody; 2],
    /// Surface speeds of the plan \[m/s\].
    speeds: [f64; 2],
    /// Computes the temperature of a solved contact.
    temperature: FilmTemperature,
    /// Initial temperature rises of the film above the bulk \[K\]: for the viscosity at all nodes, then for the density.
    /// Zero at first.
    start: Vec<f64>,
    /// Rises used in the last contact solve.
    used: Vec<f64>,
    /// Rises from the heat of that solve minus those used in it.
    residual: Vec<f64>,
}

/// The last contact that converged, and its rises.
type Good = (ContactState, Vec<f64>);

impl FilmIteration {
    /// An iteration from zero rise; `None` if the scene is isothermal.
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

    /// Makes a new plan if the `speeds` \[m/s\] have changed.
    pub(in crate::sim) fn move_at(&mut self, speeds: [f64; 2], grid: &Grid) -> Result<(), InputError> {
        if speeds.map(f64::to_bits) != self.speeds.map(f64::to_bits) {
            self.temperature = FilmTemperature::new(grid, self.properties, self.bodies, speeds)?;
            self.speeds = speeds;
        }
        Ok(())
    }

    /// Initial rises of the next solve \[K\].
    #[cfg(feature = "serde")]
    pub(in crate::sim) fn start(&self) -> &[f64] {
        &self.start
    }

    /// Sets the initial rises of the next solve \[K\].
    pub(in crate::sim) fn set_start(&mut self, rises: Vec<f64>) {
        self.start = rises;
    }

    /// Takes the initial rises and resets them to zero, as for a single contact.
    pub(in crate::sim) fn take_start(&mut self) -> Vec<f64> {
        let cool = vec![0.0; self.start.len()];
        std::mem::replace(&mut self.start, cool)
    }

    /// Starts the next solve from the film temperature of the last one.
    pub(in crate::sim) fn commit(&mut self) {
        self.start.copy_from_slice(&self.used);
    }

    /// Rises of the surfaces above the bulk temperature in the last contact \[K\].
    pub(in crate::sim) fn surface_rises(&self) -> [&[f64]; 2] {
        self.temperature.surface_rises()
    }

    /// Iterates until contact and heat agree, until [`MAX_SOLVES`], or until a contact does not converge even close to the
    /// last one that did. The report sums the work of all solves; `friction` has the stresses of the film; the fluid keeps
    /// the temperatures of the last solve.
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

    /// Sets the temperature rises of the fluid, or the bulk temperature at zero rise.
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

    /// Computes the temperatures of the present contact.
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

    /// Overwrites the residual. Returns the largest change of `ln eta` at a node, or of `ln rho` scaled to the same
    /// tolerance.
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

    /// Results and temperatures of the present film, after `solves` solves with the last `change`.
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
            heat: balance.generated / model.grid.contact_length(),
            imbalance: balance.imbalance(),
            solves,
            change,
        };
        Ok((numbers, temperature))
    }
}
