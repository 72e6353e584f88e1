//! Scenes of rigid bearings: `[given_film]` with `[lubricant]` and `[thermal]`.

use std::path::PathBuf;

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

/// Relief of the resting surface of a pad; the film is larger by its depth below its highest point.
///
/// ```
/// use stribeck::sim::scene::PadRelief;
/// let relief = PadRelief::Dimples { diameter: 1e-3, depth: 5e-6, density: 0.2 };
/// assert_ne!(relief, PadRelief::File { path: "pad.npy".into(), spacing: None });
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum PadRelief {
    /// Round dimples on a square lattice in the middle of the pad, with the depth `depth (1 - (2 r/diameter)^2)`.
    Dimples {
        /// Diameter of the rim \[m\].
        diameter: f64,
        /// Depth in the middle \[m\].
        depth: f64,
        /// Area of the dimples over that of their lattice.
        density: f64,
    },
    /// Heights of a file, averaged on the cells; its corner is that of the pad.
    File {
        /// The file.
        path: PathBuf,
        /// Spacing of its points \[m\], where the file has none.
        spacing: Option<f64>,
    },
}

/// Axial grooves in the bush of a journal: [`Grooves`](crate::reynolds::Grooves).
///
/// ```
/// use stribeck::sim::scene::GrooveSpec;
/// let opposite =
///     GrooveSpec { angles: vec![std::f64::consts::PI], width: 5e-3, length: Some(20e-3), pressure: 2e5 };
/// assert_eq!(opposite.angles.len(), 1);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct GrooveSpec {
    /// Angles of their middles from the load, in the direction of rotation \[rad\].
    pub angles: Vec<f64>,
    /// Width along the circumference \[m\].
    pub width: f64,
    /// Length along the axis \[m\]; `None` for 0.8 of the width of the bearing.
    pub length: Option<f64>,
    /// Pressure above ambient \[Pa\].
    pub pressure: f64,
}

/// Roughness of a bearing in the mean: [`MeanRoughness`](crate::reynolds::MeanRoughness). Its table is `[given_film.roughness]`.
///
/// ```
/// use stribeck::sim::scene::RoughnessSpec;
/// let lapped = RoughnessSpec {
///     rq: [0.2e-6, 0.3e-6], gamma: 1.0, asperity_number: 0.05, rq_over_radius: 0.01, equivalent_modulus: 230e9,
///     boundary_friction: 0.1,
/// };
/// assert_eq!(lapped.gamma, 1.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoughnessSpec {
    /// Root mean square heights of the moving and of the resting surface \[m\].
    pub rq: [f64; 2],
    /// Peklenik number: correlation length along the motion over that across.
    #[serde(default = "isotropic")]
    pub gamma: f64,
    /// Density times radius of the asperities times root mean square height.
    pub asperity_number: f64,
    /// Root mean square height over radius of the asperities.
    pub rq_over_radius: f64,
    /// Equivalent modulus of both bodies \[Pa\].
    pub equivalent_modulus: f64,
    /// Friction coefficient of solid contact.
    pub boundary_friction: f64,
}

/// Peklenik number of isotropic roughness.
fn isotropic() -> f64 {
    1.0
}

/// Heat balance of a bearing: the through-flow of oil carries a share of the power loss, and the oil has the mean of supply and
/// outlet temperature (ISO 7902-1).
///
/// ```
/// use stribeck::sim::scene::HeatBalance;
/// let balance = HeatBalance { supply_temperature: 313.15, heat_capacity: 1.7e6, share: 1.0 };
/// // 100 W in 10 ml/s
/// assert!((balance.rise(100.0, 1e-5) - 5.882).abs() < 1e-3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatBalance {
    /// Temperature of the supplied oil \[K\].
    pub supply_temperature: f64,
    /// Heat capacity of a volume of oil \[J/(m^3 K)\].
    pub heat_capacity: f64,
    /// Share of the power loss that the oil carries; the rest leaves through the bodies.
    pub share: f64,
}

impl HeatBalance {
    /// Rise of the temperature of the oil from supply to outlet \[K\] with the power loss \[W\] and the flow \[m^3/s\].
    #[must_use]
    pub fn rise(&self, power_loss: f64, flow: f64) -> f64 {
        self.share * power_loss / (self.heat_capacity * flow)
    }
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
        /// Pressures at inlet, outlet and both sides of a pad \[Pa\].
        edge_pressures: Vec<f64>,
        /// Diameter of dimples \[m\].
        dimple_diameter: f64,
        /// Depth of dimples \[m\].
        dimple_depth: f64,
        /// Area share of dimples.
        dimple_density: f64,
        /// File of the heights of a pad.
        heights: PathBuf,
        /// Spacing of their points \[m\].
        spacing: f64,
        /// Angles of grooves from the load \[rad\].
        groove_angles: Vec<f64>,
        /// Width of grooves \[m\].
        groove_width: f64,
        /// Length of grooves along the axis \[m\].
        groove_length: f64,
        /// Pressure of grooves above ambient \[Pa\].
        supply_pressure: f64,
        /// Temperature of the supplied oil \[K\].
        supply_temperature: f64,
        /// Heat capacity of a volume of oil \[J/(m^3 K)\].
        heat_capacity: f64,
        /// Share of the power loss that the oil carries.
        heat_share: f64,
        /// Roughness of both surfaces.
        roughness: RoughnessSpec,
        /// Cells along the motion.
        nx: usize,
        /// Cells across it.
        ny: usize,
    }
}

/// Keys of pads beside those of their shape.
const PAD_KEYS: [&str; 6] =
    ["edge_pressures", "dimple_diameter", "dimple_depth", "dimple_density", "heights", "spacing"];
/// Keys of every kind.
const COMMON_KEYS: [&str; 1] = ["roughness"];
/// Keys of the grooves of a journal.
const GROOVE_KEYS: [&str; 4] = ["groove_angles", "groove_width", "groove_length", "supply_pressure"];
/// Keys of the heat balance.
const HEAT_KEYS: [&str; 3] = ["supply_temperature", "heat_capacity", "heat_share"];
/// Heat capacity of a volume of mineral oil \[J/(m^3 K)\].
const OIL_HEAT_CAPACITY: f64 = 1.7e6;

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

    /// Pressures at inlet, outlet and both sides of a pad.
    pub(in crate::sim) fn edge_pressures(&self) -> Result<[f64; 4], String> {
        match self.edge_pressures.as_deref() {
            None => Ok([0.0; 4]),
            Some(given) => given.try_into().map_err(|_| {
                format!(
                    "`edge_pressures` has {} values, expected 4: inlet, outlet and both sides",
                    given.len()
                )
            }),
        }
    }

    /// Roughness of both surfaces.
    pub(in crate::sim) fn roughness(&self) -> Option<RoughnessSpec> {
        self.roughness
    }

    /// Relief of a pad.
    pub(in crate::sim) fn relief(&self) -> Result<Option<PadRelief>, String> {
        let dimples = [self.dimple_diameter, self.dimple_depth, self.dimple_density];
        match (&self.heights, dimples) {
            (None, [None, None, None]) if self.spacing.is_some() => {
                Err("`spacing` is that of the points of `heights`, which is missing".to_owned())
            }
            (None, [None, None, None]) => Ok(None),
            (Some(path), [None, None, None]) => {
                Ok(Some(PadRelief::File { path: path.clone(), spacing: self.spacing }))
            }
            (Some(_), _) => Err("`heights` are all of the relief; leave out the dimples".to_owned()),
            (None, [diameter, depth, density]) => Ok(Some(PadRelief::Dimples {
                diameter: required("dimple_diameter", diameter)?,
                depth: required("dimple_depth", depth)?,
                density: required("dimple_density", density)?,
            })),
        }
    }

    /// Grooves of a journal.
    pub(in crate::sim) fn grooves(&self) -> Result<Option<GrooveSpec>, String> {
        let any = self.groove_angles.is_some()
            || self.groove_width.is_some()
            || self.groove_length.is_some()
            || self.supply_pressure.is_some();
        if !any {
            return Ok(None);
        }
        Ok(Some(GrooveSpec {
            angles: self.groove_angles.clone().ok_or("missing field `groove_angles`")?,
            width: required("groove_width", self.groove_width)?,
            length: self.groove_length,
            pressure: self.supply_pressure.unwrap_or(0.0),
        }))
    }

    /// The heat balance.
    pub(in crate::sim) fn heat(&self) -> Result<Option<HeatBalance>, String> {
        let Some(supply_temperature) = self.supply_temperature else {
            return match (self.heat_capacity, self.heat_share) {
                (None, None) => Ok(None),
                _ => Err("missing field `supply_temperature` of the heat balance".to_owned()),
            };
        };
        Ok(Some(HeatBalance {
            supply_temperature,
            heat_capacity: self.heat_capacity.unwrap_or(OIL_HEAT_CAPACITY),
            share: self.heat_share.unwrap_or(1.0),
        }))
    }

    /// The bearing; a key of another kind is an error.
    pub(in crate::sim) fn spec(&self) -> Result<BearingSpec, String> {
        let speed = required("speed", self.speed)?;
        let pad = |known: &[&str]| {
            let known: Vec<&str> =
                known.iter().chain(&PAD_KEYS).chain(&HEAT_KEYS).chain(&COMMON_KEYS).copied().collect();
            self.reject_unknown_fields("this kind of pad", &known)?;
            let inlet_film = required("inlet_film", self.inlet_film)?;
            let outlet_film = required("outlet_film", self.outlet_film)?;
            Ok::<_, String>((required("length", self.length)?, inlet_film, outlet_film))
        };
        let width = self.width;
        Ok(match self.kind {
            BearingKind::Journal => {
                let own = ["diameter", "width", "clearance", "eccentricity", "load", "speed", "nx", "ny"];
                let known: Vec<&str> =
                    own.iter().chain(&GROOVE_KEYS).chain(&HEAT_KEYS).chain(&COMMON_KEYS).copied().collect();
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
