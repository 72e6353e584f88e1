//! Scene files of rigid bearings: `[given_film]` as written, with `[lubricant]` and `[thermal]`.

use std::path::PathBuf;

use serde::Deserialize;

use super::given_film::{
    BearingSpec, GrooveSpec, HeatBalance, HoleSpec, JournalPosition, PadRelief, RoughnessSpec,
};
use super::tables::{keyed, required};
use super::{LubricantSpec, ThermalSpec};
use crate::reynolds::ElasticBore;

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
        /// Pressure of grooves and holes above ambient \[Pa\].
        supply_pressure: f64,
        /// Angles of holes of a journal from the load \[rad\].
        hole_angles: Vec<f64>,
        /// Distances of holes of a pad from its inlet \[m\].
        hole_positions: Vec<f64>,
        /// Diameter of holes \[m\].
        hole_diameter: f64,
        /// Equivalent modulus of journal and bush \[Pa\].
        bore_modulus: f64,
        /// Thickness of the liner of the bush \[m\].
        liner_thickness: f64,
        /// Young's modulus of the liner \[Pa\].
        liner_modulus: f64,
        /// Poisson's ratio of the liner.
        liner_poisson: f64,
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
const PAD_KEYS: [&str; 9] = [
    "edge_pressures",
    "dimple_diameter",
    "dimple_depth",
    "dimple_density",
    "heights",
    "spacing",
    "hole_positions",
    "hole_diameter",
    "supply_pressure",
];
/// Keys of every kind.
const COMMON_KEYS: [&str; 1] = ["roughness"];
/// Keys of grooves and holes of a journal, and of its elastic bore.
const FEED_KEYS: [&str; 10] = [
    "groove_angles",
    "groove_width",
    "groove_length",
    "supply_pressure",
    "hole_angles",
    "hole_diameter",
    "bore_modulus",
    "liner_thickness",
    "liner_modulus",
    "liner_poisson",
];
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
            || (self.supply_pressure.is_some() && self.hole_diameter.is_none() && self.hole_angles.is_none());
        if !any || !matches!(self.kind, BearingKind::Journal) {
            return Ok(None);
        }
        Ok(Some(GrooveSpec {
            angles: self.groove_angles.clone().ok_or("missing field `groove_angles`")?,
            width: required("groove_width", self.groove_width)?,
            length: self.groove_length,
            pressure: self.supply_pressure.unwrap_or(0.0),
        }))
    }

    /// Holes.
    pub(in crate::sim) fn holes(&self) -> Result<Option<HoleSpec>, String> {
        let (key, places) = match self.kind {
            BearingKind::Journal => ("hole_angles", &self.hole_angles),
            BearingKind::Pad | BearingKind::Step => ("hole_positions", &self.hole_positions),
        };
        if places.is_none() && self.hole_diameter.is_none() {
            let pad = !matches!(self.kind, BearingKind::Journal);
            return match self.supply_pressure {
                Some(_) if pad => {
                    Err("`supply_pressure` is that of holes; `hole_positions` is missing".to_owned())
                }
                _ => Ok(None),
            };
        }
        Ok(Some(HoleSpec {
            places: places.clone().ok_or_else(|| format!("missing field `{key}`"))?,
            diameter: required("hole_diameter", self.hole_diameter)?,
            pressure: required("supply_pressure", self.supply_pressure)?,
        }))
    }

    /// Deflection of the bore of a journal.
    pub(in crate::sim) fn bore(&self) -> Result<Option<ElasticBore>, String> {
        let liner = [self.liner_thickness, self.liner_modulus, self.liner_poisson];
        match (self.bore_modulus, liner) {
            (None, [None, None, None]) => Ok(None),
            (Some(equivalent_modulus), [None, None, None]) => {
                Ok(Some(ElasticBore::HalfSpace { equivalent_modulus }))
            }
            (Some(_), _) => Err("the liner is all of the deflection; leave out `bore_modulus`".to_owned()),
            (None, [thickness, modulus, poisson]) => {
                let thickness = required("liner_thickness", thickness)?;
                let modulus = required("liner_modulus", modulus)?;
                let poisson = required("liner_poisson", poisson)?;
                if !(poisson > -1.0 && poisson < 0.5) {
                    return Err(format!(
                        "`liner_poisson` = {poisson} must be above -1 and below 0.5: a thin liner of an incompressible solid does not deflect \
                         column by column"
                    ));
                }
                Ok(Some(ElasticBore::liner(thickness, modulus, poisson)))
            }
        }
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
                    own.iter().chain(&FEED_KEYS).chain(&HEAT_KEYS).chain(&COMMON_KEYS).copied().collect();
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
