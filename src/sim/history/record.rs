//! One row of a history.
//!
//! A new column needs a field, an entry in `COLUMNS`, a value in `MixedLubricationSim::record` and a line in
//! `docs/output.md`. Records are read back exactly, which resuming depends on.

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

/// Results of one committed step, in SI units. Roughness, film, pressures, friction and heat are those of the
/// contact at the start of the step: the contact of the first record is that of time zero. Wear, tribofilm
/// and plastic volume are those at its end.
///
/// # Examples
///
/// A line of `history.csv` contains the record except its strategy and residual history:
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
    /// Roughness on the track, as placed in the contact.
    pub roughness: RoughnessNumbers,
    /// Film thickness.
    pub film: FilmNumbers,
    /// Total pressure.
    pub pressure: PressureNumbers,
    /// Solid contact.
    pub contact: ContactNumbers,
    /// Friction over load.
    pub friction: FrictionNumbers,
    /// Flow balance of the box; `None` without lubricant.
    pub flow: Option<FlowBalance>,
    /// Temperature of the film; `None` for an isothermal film.
    pub thermal: Option<ThermalNumbers>,
    /// Largest flash temperature rise, or largest surface rise of a film with its own temperature \[K\]; `None`
    /// if not modelled.
    pub flash_rise: Option<f64>,
    /// Worn depth and volume.
    pub wear: WearNumbers,
    /// Thickness of the tribofilms.
    pub tribofilm: DepthNumbers,
    /// Plastic depth and volume.
    pub plastic: PlasticNumbers,
    /// Estimated errors of the numbers of the contact; none where the scene does not ask for them
    /// ([`estimate`](crate::sim::scene::SolverSpec::estimate)), with squeeze, and where the contact on half the cells was
    /// not solved.
    pub error_estimate: Option<ErrorEstimate>,
    /// Number of roughness positions tried until the contact converged.
    pub attempts: u32,
    /// Report of the solve. Without strategy and residual history if read from `history.csv`.
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

    /// The first line of `history.csv`: names and units of the columns of [`StepRecord::write_csv`]. A name is the
    /// path of its field.
    pub fn csv_header() -> String {
        COLUMNS.iter().map(Column::heading).collect::<Vec<_>>().join(",")
    }

    /// Writes the record as one line of comma-separated values with all digits. Cells of physics not modelled are
    /// empty.
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

    /// Reads the record from a `line` of [`write_csv`](Self::write_csv), exactly. A line does not hold the name of
    /// a custom solver, which becomes `other`, nor the strategy and the residual history of the solve.
    ///
    /// # Errors
    /// A missing or extra cell, or one whose text does not fit its column.
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

    /// An empty record.
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

/// The error for a cell whose text does not fit its column.
fn unreadable(column: &str, cell: &str) -> InputError {
    InputError::Conflict { field: column.to_owned(), reason: format!("`{cell}` is no value of this column") }
}
