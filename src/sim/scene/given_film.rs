//! Scenes of rigid bearings: `[given_film]` with `[lubricant]` and `[thermal]`.

use serde::Deserialize;

use super::tables::{keyed, required};
use super::{LubricantSpec, ThermalSpec};

/// Shape and motion of a rigid bearing.
///
/// ```
/// use stribeck::sim::scene::{BearingSpec, JournalPosition};
/// let position = JournalPosition::Load(2000.0);
/// let journal =
///     BearingSpec::Journal { diameter: 50e-3, width: 25e-3, clearance: 25e-6, speed: 7.85, position };
/// assert_ne!(journal, BearingSpec::Pad { length: 1e-2, width: None, inlet_film: 2e-6, outlet_film: 1e-6, speed: 1.0 });
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum BearingSpec {
    /// A journal in a bush: [`JournalBearing`](crate::reynolds::JournalBearing).
    Journal {
        /// Diameter of the journal \[m\].
        diameter: f64,
        /// Width of the bearing \[m\].
        width: f64,
        /// Radial clearance \[m\].
        clearance: f64,
        /// Speed of the surface of the journal \[m/s\].
        speed: f64,
        /// Position of its axis.
        position: JournalPosition,
    },
    /// A plane inclined pad over a moving plane.
    Pad {
        /// Length along the motion \[m\].
        length: f64,
        /// Width \[m\]; `None` for a pad that is wide, with forces per metre.
        width: Option<f64>,
        /// Film at the inlet \[m\].
        inlet_film: f64,
        /// Film at the outlet \[m\].
        outlet_film: f64,
        /// Speed of the moving plane \[m/s\].
        speed: f64,
    },
    /// A pad with a step (Rayleigh) over a moving plane.
    Step {
        /// Length along the motion \[m\].
        length: f64,
        /// Width \[m\]; `None` for a pad that is wide, with forces per metre.
        width: Option<f64>,
        /// Film before the step \[m\].
        inlet_film: f64,
        /// Film behind it \[m\].
        outlet_film: f64,
        /// Length of the part before the step \[m\].
        step: f64,
        /// Speed of the moving plane \[m/s\].
        speed: f64,
    },
}

/// Position of the axis of a journal.
///
/// ```
/// use stribeck::sim::scene::JournalPosition;
/// assert_ne!(JournalPosition::Eccentricity(0.5), JournalPosition::Load(0.5));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JournalPosition {
    /// Distance of the axes over the clearance.
    Eccentricity(f64),
    /// In equilibrium with this load \[N\].
    Load(f64),
}

/// A scene file of a rigid bearing.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::sim) struct BearingFile {
    pub(in crate::sim) given_film: BearingTable,
    pub(in crate::sim) lubricant: LubricantSpec,
    #[serde(default)]
    pub(in crate::sim) thermal: ThermalSpec,
}

keyed! {
    /// `[given_film]` as written.
    #[derive(Deserialize)]
    pub(in crate::sim) struct BearingTable {
        kind: BearingKind;
        /// Diameter of a journal \[m\].
        diameter: f64,
        /// Width \[m\].
        width: f64,
        /// Radial clearance \[m\].
        clearance: f64,
        /// Eccentricity over the clearance.
        eccentricity: f64,
        /// Load on the journal \[N\].
        load: f64,
        /// Length of a pad \[m\].
        length: f64,
        /// Film at the inlet \[m\].
        inlet_film: f64,
        /// Film at the outlet \[m\].
        outlet_film: f64,
        /// Length of the part before the step \[m\].
        step: f64,
        /// Speed of the moving surface \[m/s\].
        speed: f64,
        /// Cells along the motion.
        nx: usize,
        /// Cells across it.
        ny: usize,
    }
}

/// Values of `kind` in `[given_film]`.
#[derive(Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum BearingKind {
    Journal,
    Pad,
    Step,
}

impl BearingTable {
    /// Cells along and across the motion.
    pub(in crate::sim) fn cells(&self) -> [usize; 2] {
        let row = !matches!(self.kind, BearingKind::Journal) && self.width.is_none();
        [self.nx.unwrap_or(180), if row { 1 } else { self.ny.unwrap_or(40) }]
    }

    /// The bearing; a key of another kind is an error.
    pub(in crate::sim) fn spec(&self) -> Result<BearingSpec, String> {
        let speed = required("speed", self.speed)?;
        let pad = |known: &[&str]| {
            self.reject_unknown_fields("this kind of pad", known)?;
            let inlet_film = required("inlet_film", self.inlet_film)?;
            let outlet_film = required("outlet_film", self.outlet_film)?;
            Ok::<_, String>((required("length", self.length)?, inlet_film, outlet_film))
        };
        let width = self.width;
        Ok(match self.kind {
            BearingKind::Journal => {
                let known = ["diameter", "width", "clearance", "eccentricity", "load", "speed", "nx", "ny"];
                self.reject_unknown_fields("kind = \"journal\"", &known)?;
                let position = match (self.eccentricity, self.load) {
                    (Some(eccentricity), None) => JournalPosition::Eccentricity(eccentricity),
                    (None, Some(load)) => JournalPosition::Load(load),
                    (Some(_), Some(_)) => {
                        return Err("`load` determines `eccentricity`; give only one".to_owned());
                    }
                    (None, None) => {
                        return Err("missing field `load`, or `eccentricity` in place of it".to_owned());
                    }
                };
                BearingSpec::Journal {
                    diameter: required("diameter", self.diameter)?,
                    width: required("width", width)?,
                    clearance: required("clearance", self.clearance)?,
                    speed,
                    position,
                }
            }
            BearingKind::Pad => {
                let (length, inlet_film, outlet_film) =
                    pad(&["length", "width", "inlet_film", "outlet_film", "speed", "nx", "ny"])?;
                BearingSpec::Pad { length, width, inlet_film, outlet_film, speed }
            }
            BearingKind::Step => {
                let (length, inlet_film, outlet_film) =
                    pad(&["length", "width", "inlet_film", "outlet_film", "step", "speed", "nx", "ny"])?;
                let step = required("step", self.step)?;
                BearingSpec::Step { length, width, inlet_film, outlet_film, step, speed }
            }
        })
    }
}
