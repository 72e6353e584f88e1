//! One row of a history.
//!
//! A new column needs a field, an entry in `COLUMNS`, a value in `MixedLubricationSim::record` (`step_record`) and a line in
//! `docs/output.md`. Records are read back exactly, which resuming depends on.

use crate::report::{Residuals, SolveReport, Status};
use crate::reynolds::FlowBalance;
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::numbers::{
    ContactNumbers, DepthNumbers, FilmNumbers, FrictionNumbers, PlasticNumbers, PressureNumbers,
    RoughnessNumbers, ThermalNumbers, WearNumbers,
};
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
    /// Estimated errors of the contact. `None` if not requested
    /// ([`estimate`](crate::sim::scene::SolverSpec::estimate)), with squeeze, or if the contact on half the cells did not
    /// converge.
    pub error_estimate: Option<ErrorEstimate>,
    /// Number of roughness positions tried until the contact converged.
    pub attempts: u32,
    /// Report of the solve. Without strategy and residual history if read from `history.csv`.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub report: SolveReport,
}

impl StepRecord {
    /// An empty record.
    pub(in crate::sim) fn blank() -> Self {
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
