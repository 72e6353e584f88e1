//! One row of a history.
//!
//! A new number is a field, a column at the end of the header and of a line, and a line in `docs/output.md`;
//! where it gets its value is `MixedLubricationSim::record`. Records are read back to the last bit, which
//! resuming rests on.

use std::io::{self, Write};

use super::film_heat_record::{self, FilmHeatRecord};
use super::scene::Motion;
use crate::error::InputError;
use crate::report::{Residuals, SolveReport, Status, Work};
use crate::reynolds::FlowBalance;
use crate::solver_id::SolverId;

/// What a line calls a solver that is not one of the crate.
const OTHER: SolverId = SolverId::Custom("other");

/// The numbers of one committed step; all SI. Those of the contact (roughness, film, pressures, friction,
/// heat) are of one instant, the start of the step, under the conditions that held then: the contact of the
/// first record is that of time zero. Wear, tribofilm and flattened volume are those at its end.
///
/// # Examples
///
/// A line of `history.csv` is the record again, but for what the line does not hold:
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene, StepRecord};
/// let mut sim = MixedLubricationSim::builder(Scene::azam_2019(16)).build()?;
/// let record = sim.step(10.0)?;
/// let mut line = Vec::new();
/// record.write_csv(&mut line)?;
/// let read = StepRecord::from_csv(String::from_utf8(line)?.trim_end())?;
/// assert_eq!((read.time, read.max_wear), (record.time, record.max_wear));
/// assert!(read.report.residual_history.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StepRecord {
    /// Number of the step, from 0.
    pub step: u64,
    /// Time at the end of the step \[s\].
    pub time: f64,
    /// Length of the step \[s\].
    pub time_step: f64,
    /// Root mean square roughness of ball and disc on the track without its form, as they met in the contact
    /// ([`track_roughness`](super::MixedLubricationSim::track_roughness)) \[m\].
    pub rq: [f64; 2],
    /// Composite `sqrt(rq_ball^2 + rq_disc^2)` \[m\].
    pub composite_rq: f64,
    /// Mean film over r <= 2a/3 \[m\].
    pub average_film: f64,
    /// `average_film / composite_rq`.
    pub lambda: f64,
    /// Central film by formula (Hamrock and Dowson, of a line contact Dowson and Toyoda) with the stated
    /// pressure-viscosity coefficient over `composite_rq`; zero without lubricant.
    pub formula_lambda: f64,
    /// Solid contact area inside the Hertz ellipse over its area.
    pub area_ratio: f64,
    /// Share of the load that solid contact carries.
    pub load_ratio: f64,
    /// Largest pressure, never above the limit of its node \[Pa\].
    pub max_pressure: f64,
    /// Mean pressure over the nodes that carry any \[Pa\].
    pub mean_pressure: f64,
    /// Worn depth of ball and disc, mean over the patch \[m\].
    pub mean_wear: [f64; 2],
    /// Largest worn depth of ball and disc \[m\].
    pub max_wear: [f64; 2],
    /// Tribofilm of ball and disc, mean over the patch \[m\].
    pub mean_film: [f64; 2],
    /// Worn depth of ball and disc, mean over the width of the track `|y| <= a`
    /// ([`mean_on_track`](super::MixedLubricationSim::mean_on_track)) \[m\].
    pub track_wear: [f64; 2],
    /// Tribofilm of ball and disc, mean over the width of the track \[m\].
    pub track_film: [f64; 2],
    /// Volume flattened away, both bodies \[m^3\].
    pub plastic_volume: f64,
    /// Largest flash temperature rise \[K\]; none where it is not modelled.
    pub flash_rise: Option<f64>,
    /// Friction coefficient, from boundary friction under the solid pressure and shear of the fluid; zero
    /// without sliding.
    pub friction_coefficient: f64,
    /// Part of the friction coefficient that solid contact makes.
    pub friction_boundary: f64,
    /// Part of the friction coefficient that shear of the fluid makes.
    pub friction_fluid: f64,
    /// Normal load \[N\].
    pub load: f64,
    /// Speeds of the surfaces.
    pub motion: Motion,
    /// Bulk temperature \[K\].
    pub bulk_temperature: f64,
    /// Temperature of the film; none where it has that of the bulk.
    pub film_heat: Option<FilmHeatRecord>,
    /// Smallest film over all nodes \[m\].
    pub minimum_gap: f64,
    /// What flows into the box and out of it; none without lubricant.
    pub flow: Option<FlowBalance>,
    /// Positions of the roughness that were tried before the contact converged.
    pub attempts: u32,
    /// The solve. One that was read from `history.csv` tells neither its strategy nor the residuals of its steps.
    pub report: SolveReport,
}

impl StepRecord {
    /// Names of the columns that [`StepRecord::write_csv`] writes, with units.
    pub const CSV_HEADER: &'static str = "step,time_s,time_step_s,rq_ball_m,rq_disc_m,rq_composite_m,h_avg_m,lambda,formula_lambda,\
        contact_area_ratio,contact_load_ratio,max_pressure_pa,mean_pressure_pa,mean_wear_ball_m,mean_wear_disc_m,\
        max_wear_ball_m,max_wear_disc_m,mean_film_ball_m,mean_film_disc_m,track_wear_ball_m,track_wear_disc_m,\
        track_film_ball_m,track_film_disc_m,plastic_volume_m3,flash_rise_k,\
        friction_coefficient,minimum_gap_m,inflow_m3_s,outflow_m3_s,flow_imbalance,attempts,solver,status,mass_residual,load_residual,\
        complementarity_residual,energy_error,convolutions,iterations,inner_iterations,friction_boundary,friction_fluid,load_n,\
         entrainment_speed_m_s,slide_roll_ratio,bulk_temperature_k,film_temperature_max_k,film_temperature_mean_central_k,\
         surface_rise_ball_k,surface_rise_disc_k,film_heat_w,film_heat_imbalance,film_heat_solves,film_heat_change";

    /// Writes the record as one line of comma-separated values, every digit kept; a flash temperature that is
    /// not modelled is an empty cell, as are the flows of a dry contact and the energy error of others.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_csv(&self, out: &mut impl Write) -> io::Result<()> {
        let numbers = [
            self.time,
            self.time_step,
            self.rq[0],
            self.rq[1],
            self.composite_rq,
            self.average_film,
            self.lambda,
            self.formula_lambda,
            self.area_ratio,
            self.load_ratio,
            self.max_pressure,
            self.mean_pressure,
            self.mean_wear[0],
            self.mean_wear[1],
            self.max_wear[0],
            self.max_wear[1],
            self.mean_film[0],
            self.mean_film[1],
            self.track_wear[0],
            self.track_wear[1],
            self.track_film[0],
            self.track_film[1],
            self.plastic_volume,
        ];
        write!(out, "{}", self.step)?;
        for number in numbers {
            write!(out, ",{number:e}")?;
        }
        match self.flash_rise {
            Some(rise) => write!(out, ",{rise:e}")?,
            None => write!(out, ",")?,
        }
        write!(out, ",{:e},{:e}", self.friction_coefficient, self.minimum_gap)?;
        match self.flow {
            Some(flow) => write!(out, ",{:e},{:e},{:e}", flow.inflow, flow.outflow, flow.imbalance)?,
            None => write!(out, ",,,")?,
        }
        let (report, residuals) = (&self.report, &self.report.residuals);
        write!(
            out,
            ",{},{},{},{:e},{:e},{:e}",
            self.attempts,
            report.solver,
            report.status,
            residuals.mass,
            residuals.load,
            residuals.complementarity
        )?;
        match report.energy_error {
            Some(error) => write!(out, ",{error:e}")?,
            None => write!(out, ",")?,
        }
        let work = report.work;
        write!(out, ",{},{},{}", work.convolutions, work.iterations, work.inner_iterations)?;
        let Motion { entrainment_speed, slide_roll_ratio } = self.motion;
        let shares = [self.friction_boundary, self.friction_fluid];
        for number in shares.into_iter().chain([self.load, entrainment_speed, slide_roll_ratio]) {
            write!(out, ",{number:e}")?;
        }
        write!(out, ",{:e}", self.bulk_temperature)?;
        FilmHeatRecord::write(self.film_heat.as_ref(), out)?;
        writeln!(out)
    }

    /// The record that [`write_csv`](Self::write_csv) wrote as `line`, every bit of it, but for the name of a
    /// solver that is not one of the crate, which reads `other`, and the way and the residuals of the steps
    /// of the solve, which a line does not hold.
    ///
    /// # Errors
    /// A cell that is missing, too many or not what its column holds.
    pub fn from_csv(line: &str) -> Result<Self, InputError> {
        let mut columns = Self::CSV_HEADER.split(',');
        let mut cells = line.trim_end().split(',');
        let mut next = || {
            let column = columns.next().unwrap_or("history");
            match cells.next() {
                Some(cell) => Ok((column, cell)),
                None => Err(unreadable(column, "")),
            }
        };
        let mut whole = || next().and_then(|(column, cell)| parsed::<u64>(column, cell));
        let step = whole()?;
        let mut number = || next().and_then(|(column, cell)| parsed::<f64>(column, cell));
        let (time, time_step) = (number()?, number()?);
        let (rq, composite_rq, average_film) = ([number()?, number()?], number()?, number()?);
        let (lambda, formula_lambda, area_ratio, load_ratio) = (number()?, number()?, number()?, number()?);
        let (max_pressure, mean_pressure) = (number()?, number()?);
        let (mean_wear, max_wear) = ([number()?, number()?], [number()?, number()?]);
        let (mean_film, track_wear) = ([number()?, number()?], [number()?, number()?]);
        let (track_film, plastic_volume) = ([number()?, number()?], number()?);
        let (column, cell) = next()?;
        let flash_rise = if cell.is_empty() { None } else { Some(parsed(column, cell)?) };
        let mut number = || next().and_then(|(column, cell)| parsed::<f64>(column, cell));
        let (friction_coefficient, minimum_gap) = (number()?, number()?);
        let flows = [next()?, next()?, next()?];
        let flow = if flows.iter().all(|(_, cell)| cell.is_empty()) {
            None
        } else {
            let [inflow, outflow, imbalance] = flows.map(|(column, cell)| parsed(column, cell));
            Some(FlowBalance { inflow: inflow?, outflow: outflow?, imbalance: imbalance? })
        };
        let (column, cell) = next()?;
        let attempts = parsed(column, cell)?;
        let (_, name) = next()?;
        let solver = name.parse().unwrap_or(OTHER);
        let (column, cell) = next()?;
        let statuses = [
            Status::Converged,
            Status::MaxIterations,
            Status::Stalled,
            Status::Diverged,
            Status::MeshTooCoarse,
            Status::Unconfirmed,
        ];
        let status = statuses.into_iter().find(|status| status.to_string() == cell);
        let status = status.ok_or_else(|| unreadable(column, cell))?;
        let mut number = || next().and_then(|(column, cell)| parsed::<f64>(column, cell));
        let residuals = Residuals { mass: number()?, load: number()?, complementarity: number()? };
        let (column, cell) = next()?;
        let energy_error = if cell.is_empty() { None } else { Some(parsed(column, cell)?) };
        let (column, cell) = next()?;
        let convolutions = parsed(column, cell)?;
        let mut whole = || next().and_then(|(column, cell)| parsed::<u64>(column, cell));
        let work = Work { convolutions, iterations: whole()?, inner_iterations: whole()? };
        let mut number = || next().and_then(|(column, cell)| parsed::<f64>(column, cell));
        let (friction_boundary, friction_fluid, load) = (number()?, number()?, number()?);
        let motion = Motion { entrainment_speed: number()?, slide_roll_ratio: number()? };
        let bulk_temperature = number()?;
        let mut heat = [0.0; film_heat_record::NUMBERS];
        let mut is_empty = true;
        for number in &mut heat {
            let (column, cell) = next()?;
            is_empty &= cell.is_empty();
            *number = if is_empty { 0.0 } else { parsed(column, cell)? };
        }
        let film_heat = (!is_empty).then(|| FilmHeatRecord::from_numbers(heat));
        if let Some(stray) = cells.next() {
            return Err(unreadable("history", stray));
        }
        Ok(Self {
            step,
            time,
            time_step,
            rq,
            composite_rq,
            average_film,
            lambda,
            formula_lambda,
            area_ratio,
            load_ratio,
            max_pressure,
            mean_pressure,
            mean_wear,
            max_wear,
            mean_film,
            track_wear,
            track_film,
            plastic_volume,
            flash_rise,
            friction_coefficient,
            friction_boundary,
            friction_fluid,
            load,
            motion,
            bulk_temperature,
            film_heat,
            minimum_gap,
            flow,
            attempts,
            report: SolveReport {
                energy_error,
                ..SolveReport::new(solver, status, residuals).with_work(work)
            },
        })
    }
}

/// The value of a cell, or the error that names its column.
fn parsed<T: std::str::FromStr>(column: &str, cell: &str) -> Result<T, InputError> {
    cell.parse().map_err(|_| unreadable(column, cell))
}

/// That error.
fn unreadable(column: &str, cell: &str) -> InputError {
    InputError::Conflict { field: column.to_owned(), reason: format!("`{cell}` is no value of this column") }
}
