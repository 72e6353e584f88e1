//! One row of a history.
//!
//! A new number is a field and one of the `COLUMNS`, and a line in `docs/output.md`; where it gets its value is
//! `MixedLubricationSim::record`. Records are read back to the last bit, which resuming rests on.

use std::io::{self, Write};

use crate::error::InputError;
use crate::report::{Residuals, SolveReport, Status};
use crate::reynolds::FlowBalance;
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::numbers::{
    ContactNumbers, DepthNumbers, FilmNumbers, FrictionNumbers, PlasticNumbers, PressureNumbers,
    RoughnessNumbers, ThermalNumbers, WearNumbers,
};
use crate::sim::history::columns::{COLUMNS, Cell, Column};
use crate::sim::scene::Motion;
use crate::solver_id::SolverId;

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
/// assert_eq!((read.time, read.wear), (record.time, record.wear));
/// assert!(read.report.residual_history.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct StepRecord {
    /// Number of the step, from 0.
    pub step: u64,
    /// Time at the end of the step \[s\].
    pub time: f64,
    /// Length of the step \[s\].
    pub time_step: f64,
    /// Normal load \[N\].
    pub load: f64,
    /// Speeds of the surfaces.
    pub motion: Motion,
    /// Bulk temperature \[K\].
    pub bulk_temperature: f64,
    /// Roughness on the track, as the bodies met in the contact.
    pub roughness: RoughnessNumbers,
    /// Film thickness.
    pub film: FilmNumbers,
    /// Total pressure.
    pub pressure: PressureNumbers,
    /// Solid contact.
    pub contact: ContactNumbers,
    /// Friction over load.
    pub friction: FrictionNumbers,
    /// What flows into the box and out of it; none without lubricant.
    pub flow: Option<FlowBalance>,
    /// Temperature of the film; none where it has that of the bulk.
    pub thermal: Option<ThermalNumbers>,
    /// Largest flash temperature rise, of a film with a temperature of its own the largest rise of a surface
    /// \[K\]; none where it is not modelled.
    pub flash_rise: Option<f64>,
    /// Worn depth and volume.
    pub wear: WearNumbers,
    /// Thickness of the tribofilms.
    pub tribofilm: DepthNumbers,
    /// What was flattened.
    pub plastic: PlasticNumbers,
    /// Estimated errors of the numbers of the contact; none where the scene does not ask for them
    /// ([`estimate`](crate::sim::scene::SolverSpec::estimate)), with squeeze, and where the contact on half the cells was
    /// not solved.
    pub error_estimate: Option<ErrorEstimate>,
    /// Positions of the roughness that were tried before the contact converged.
    pub attempts: u32,
    /// The solve. One that was read from `history.csv` tells neither its strategy nor the residuals of its steps.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub report: SolveReport,
}

impl StepRecord {
    /// Names of the columns of a history and their units, empty for ratios, counts and words.
    ///
    /// ```
    /// let mut columns = stribeck::sim::StepRecord::columns();
    /// assert!(columns.any(|column| column == ("film.mean_central", "m")));
    /// ```
    pub fn columns() -> impl Iterator<Item = (&'static str, &'static str)> {
        COLUMNS.iter().map(|column| (column.name, column.unit))
    }

    /// The first line of `history.csv`: names of the columns that [`StepRecord::write_csv`] writes, each the
    /// path of a field with its unit behind it.
    pub fn csv_header() -> String {
        COLUMNS.iter().map(Column::heading).collect::<Vec<_>>().join(",")
    }

    /// Writes the record as one line of comma-separated values, every digit kept; what is not modelled is an
    /// empty cell.
    ///
    /// # Errors
    /// Those of the writer.
    pub fn write_csv(&self, out: &mut impl Write) -> io::Result<()> {
        for (index, column) in COLUMNS.iter().enumerate() {
            let comma = if index == 0 { "" } else { "," };
            match (column.get)(self) {
                Cell::Empty => write!(out, "{comma}")?,
                Cell::Number(number) => write!(out, "{comma}{number:e}")?,
                Cell::Count(count) => write!(out, "{comma}{count}")?,
                Cell::Word(word) => write!(out, "{comma}{word}")?,
            }
        }
        writeln!(out)
    }

    /// The record that [`write_csv`](Self::write_csv) wrote as `line`, every bit of it, but for the name of a
    /// solver that is not one of the crate, which reads `other`, and the way and the residuals of the steps
    /// of the solve, which a line does not hold.
    ///
    /// # Errors
    /// A cell that is missing, too many or not what its column holds.
    pub fn from_csv(line: &str) -> Result<Self, InputError> {
        let mut record = Self::blank();
        let mut cells = line.trim_end().split(',');
        for column in &COLUMNS {
            let cell = cells.next().unwrap_or_default();
            if (column.set)(&mut record, cell).is_none() {
                return Err(unreadable(&column.heading(), cell));
            }
        }
        match cells.next() {
            Some(stray) => Err(unreadable("history", stray)),
            None => Ok(record),
        }
    }

    /// A record that nothing was put into yet.
    fn blank() -> Self {
        Self {
            step: 0,
            time: 0.0,
            time_step: 0.0,
            load: 0.0,
            motion: Motion::default(),
            bulk_temperature: 0.0,
            roughness: RoughnessNumbers::default(),
            film: FilmNumbers::default(),
            pressure: PressureNumbers::default(),
            contact: ContactNumbers::default(),
            friction: FrictionNumbers::default(),
            flow: None,
            thermal: None,
            flash_rise: None,
            wear: WearNumbers::default(),
            tribofilm: DepthNumbers::default(),
            plastic: PlasticNumbers::default(),
            error_estimate: None,
            attempts: 0,
            report: SolveReport::new(SolverId::Auto, Status::Stalled, Residuals::default()),
        }
    }
}

/// The error for a cell that does not hold what its column does.
fn unreadable(column: &str, cell: &str) -> InputError {
    InputError::Conflict { field: column.to_owned(), reason: format!("`{cell}` is no value of this column") }
}
