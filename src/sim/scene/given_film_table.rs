//! Scene files of rigid bearings: `[given_film]` as written, with `[lubricant]` and `[thermal]`.

use std::path::PathBuf;

use serde::Deserialize;

use super::ThermalSpec;
use super::given_film::{
    BearingSpec, GrooveSpec, HeatBalance, HoleSpec, JournalPosition, PadFilm, PadRelief, RoughnessSpec,
};
use super::lubricant_table::RigidFilmLubricant;
use super::tables::required;
use crate::reynolds::ElasticBore;

/// A scene file of a rigid bearing.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::sim) struct BearingFile {
    pub(in crate::sim) given_film: BearingTable,
    pub(in crate::sim) lubricant: RigidFilmLubricant,
    #[serde(default)]
    pub(in crate::sim) thermal: ThermalSpec,
}

/// `[given_film]` as written.
#[derive(Deserialize)]
pub(in crate::sim) struct BearingTable {
    #[serde(flatten)]
    kind: BearingKind,
    /// Speed of the moving surface \[m/s\].
    speed: Option<f64>,
    /// Width \[m\]; a pad without it is wide.
    width: Option<f64>,
    /// Load \[N\].
    load: Option<f64>,
    /// Pressure at which the oil cavitates \[Pa\].
    cavitation_pressure: Option<f64>,
    /// Pressure of grooves and holes above ambient \[Pa\].
    supply_pressure: Option<f64>,
    /// Diameter of holes \[m\].
    hole_diameter: Option<f64>,
    /// Temperature of the supplied oil \[K\].
    supply_temperature: Option<f64>,
    /// Heat capacity of a volume of oil \[J/(m^3 K)\].
    heat_capacity: Option<f64>,
    /// Share of the power loss that the oil carries.
    heat_share: Option<f64>,
    /// Roughness of both surfaces.
    roughness: Option<RoughnessSpec>,
    /// Cells along the motion.
    nx: Option<usize>,
    /// Cells across it.
    ny: Option<usize>,
}

/// The keys of a kind of bearing.
#[derive(Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
enum BearingKind {
    Journal(JournalTable),
    Pad(PadTable),
    Step(PadTable),
}

/// The keys of a journal bearing.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct JournalTable {
    /// Diameter \[m\].
    diameter: f64,
    /// Radial clearance \[m\].
    clearance: f64,
    /// Eccentricity over the clearance.
    eccentricity: Option<f64>,
    /// Angles of grooves from the load \[rad\].
    groove_angles: Option<Vec<f64>>,
    /// Width of grooves \[m\].
    groove_width: Option<f64>,
    /// Length of grooves along the axis \[m\].
    groove_length: Option<f64>,
    /// Angles of holes from the load \[rad\].
    hole_angles: Option<Vec<f64>>,
    /// Equivalent modulus of journal and bush \[Pa\].
    bore_modulus: Option<f64>,
    /// Thickness of the liner of the bush \[m\].
    liner_thickness: Option<f64>,
    /// Young's modulus of the liner \[Pa\].
    liner_modulus: Option<f64>,
    /// Poisson's ratio of the liner.
    liner_poisson: Option<f64>,
}

/// The keys of a pad.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PadTable {
    /// Length \[m\].
    length: f64,
    /// Film at the inlet \[m\].
    inlet_film: Option<f64>,
    /// Film at the outlet \[m\].
    outlet_film: Option<f64>,
    /// Film at the inlet less that at the outlet \[m\].
    taper: Option<f64>,
    /// Distance of the pivot from the inlet \[m\].
    pivot: Option<f64>,
    /// Length of the part before the step \[m\]; of `kind = "step"` alone.
    step: Option<f64>,
    /// Pressures at inlet, outlet and both sides \[Pa\].
    edge_pressures: Option<Vec<f64>>,
    /// Whether the film repeats along the motion.
    periodic: Option<bool>,
    /// Diameter of dimples \[m\].
    dimple_diameter: Option<f64>,
    /// Depth of dimples \[m\].
    dimple_depth: Option<f64>,
    /// Area share of dimples.
    dimple_density: Option<f64>,
    /// File of the heights.
    heights: Option<PathBuf>,
    /// Spacing of their points \[m\].
    spacing: Option<f64>,
    /// Distances of holes from the inlet \[m\].
    hole_positions: Option<Vec<f64>>,
}

/// Cells along the diameter of a dimple by default. Around a ring of dimples of 5 um, on 5 to 10 times as many nodes the load differs by
/// 1 % at films of 2 um and by 15 % at 1 um.
pub(in crate::sim) const CELLS_IN_DIMPLE: f64 = 20.0;
/// Most cells along a side by default.
const MOST_CELLS: usize = 512;

/// Heat capacity of a volume of mineral oil \[J/(m^3 K)\].
const OIL_HEAT_CAPACITY: f64 = 1.7e6;

impl BearingTable {
    /// Cells along and across the motion.
    pub(in crate::sim) fn cells(&self) -> [usize; 2] {
        let is_row = !matches!(self.kind, BearingKind::Journal(_)) && self.width.is_none();
        let dimple = self.pad().and_then(|pad| pad.dimple_diameter).filter(|diameter| *diameter > 0.0);
        // Dimples need cells of their own.
        let usual = |least: usize, size: Option<f64>| match (dimple, size) {
            (Some(diameter), Some(size)) => {
                ((CELLS_IN_DIMPLE * size / diameter).ceil() as usize).clamp(least, MOST_CELLS)
            }
            _ => least,
        };
        let length = self.pad().map(|pad| pad.length);
        let [nx, ny] = [usual(180, length), usual(40, self.width)];
        [self.nx.unwrap_or(nx), if is_row { 1 } else { self.ny.unwrap_or(ny) }]
    }

    /// Pressures at inlet, outlet and both sides of a pad.
    pub(in crate::sim) fn edge_pressures(&self) -> Result<[f64; 4], String> {
        let Some(given) = self.pad().and_then(|pad| pad.edge_pressures.as_deref()) else {
            return Ok([0.0; 4]);
        };
        let wrong = || {
            format!("`edge_pressures` has {} values, expected 4: inlet, outlet and both sides", given.len())
        };
        given.try_into().map_err(|_| wrong())
    }

    /// Pressure at which the oil cavitates.
    pub(in crate::sim) fn cavitation_pressure(&self) -> f64 {
        self.cavitation_pressure.unwrap_or(0.0)
    }

    /// Whether the film of a pad repeats along the motion.
    pub(in crate::sim) fn is_periodic(&self) -> Result<bool, String> {
        let is_periodic = self.pad().and_then(|pad| pad.periodic).unwrap_or(false);
        if is_periodic && self.width.is_none() {
            return Err(
                "`periodic` needs the `width` of the pad, through whose sides the film is fed".to_owned()
            );
        }
        Ok(is_periodic)
    }

    /// Roughness of both surfaces.
    pub(in crate::sim) fn roughness(&self) -> Option<RoughnessSpec> {
        self.roughness
    }

    /// Relief of a pad.
    pub(in crate::sim) fn relief(&self) -> Result<Option<PadRelief>, String> {
        let Some(pad) = self.pad() else { return Ok(None) };
        let dimples = [pad.dimple_diameter, pad.dimple_depth, pad.dimple_density];
        match (&pad.heights, dimples) {
            (None, [None, None, None]) if pad.spacing.is_some() => {
                Err("`spacing` is that of the points of `heights`, which is missing".to_owned())
            }
            (None, [None, None, None]) => Ok(None),
            (Some(path), [None, None, None]) => {
                Ok(Some(PadRelief::File { path: path.clone(), spacing: pad.spacing }))
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
        let BearingKind::Journal(journal) = &self.kind else { return Ok(None) };
        let feeds_holes = self.hole_diameter.is_some() || journal.hole_angles.is_some();
        let any = journal.groove_angles.is_some()
            || journal.groove_width.is_some()
            || journal.groove_length.is_some()
            || (self.supply_pressure.is_some() && !feeds_holes);
        if !any {
            return Ok(None);
        }
        Ok(Some(GrooveSpec {
            angles: required("groove_angles", journal.groove_angles.clone())?,
            width: required("groove_width", journal.groove_width)?,
            length: journal.groove_length,
            pressure: self.supply_pressure.unwrap_or(0.0),
        }))
    }

    /// Holes.
    pub(in crate::sim) fn holes(&self) -> Result<Option<HoleSpec>, String> {
        let (key, places) = match &self.kind {
            BearingKind::Journal(journal) => ("hole_angles", &journal.hole_angles),
            BearingKind::Pad(pad) | BearingKind::Step(pad) => ("hole_positions", &pad.hole_positions),
        };
        if places.is_none() && self.hole_diameter.is_none() {
            return match self.supply_pressure {
                Some(_) if self.pad().is_some() => {
                    Err("`supply_pressure` is that of holes; `hole_positions` is missing".to_owned())
                }
                _ => Ok(None),
            };
        }
        Ok(Some(HoleSpec {
            places: required(key, places.clone())?,
            diameter: required("hole_diameter", self.hole_diameter)?,
            pressure: self.supply_pressure.ok_or_else(|| {
                format!(
                    "missing field `supply_pressure` of the table [given_film]: `{key}` need the pressure of their oil above ambient, \
                     such as supply_pressure = \"1 bar\""
                )
            })?,
        }))
    }

    /// Deflection of the bore of a journal.
    pub(in crate::sim) fn bore(&self) -> Result<Option<ElasticBore>, String> {
        let BearingKind::Journal(journal) = &self.kind else { return Ok(None) };
        let liner = [journal.liner_thickness, journal.liner_modulus, journal.liner_poisson];
        match (journal.bore_modulus, liner) {
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

    /// The bearing.
    pub(in crate::sim) fn spec(&self) -> Result<BearingSpec, String> {
        let (speed, width) = (required("speed", self.speed)?, self.width);
        Ok(match &self.kind {
            BearingKind::Journal(JournalTable { diameter, clearance, eccentricity, .. }) => {
                let position = match (*eccentricity, self.load) {
                    (Some(eccentricity), None) => JournalPosition::Eccentricity(eccentricity),
                    (None, Some(load)) => JournalPosition::Load(load),
                    (Some(_), Some(_)) => {
                        return Err("`load` determines `eccentricity`; give only one".to_owned());
                    }
                    (None, None) => {
                        return Err("missing field `load`, or `eccentricity` in place of it".to_owned());
                    }
                };
                let (width, diameter, clearance) = (required("width", width)?, *diameter, *clearance);
                BearingSpec::Journal { diameter, width, clearance, speed, position }
            }
            BearingKind::Pad(PadTable { step: Some(_), .. }) => {
                return Err("unknown key `step`, kind = \"pad\" has none; kind = \"step\" has one".to_owned());
            }
            BearingKind::Step(PadTable { pivot: Some(_), .. }) => {
                return Err(
                    "unknown key `pivot`, kind = \"step\" has none; kind = \"pad\" has one".to_owned()
                );
            }
            BearingKind::Pad(pad) => {
                BearingSpec::Pad { length: pad.length, width, film: pad.film(self.load)?, step: None, speed }
            }
            BearingKind::Step(pad) => {
                let step = Some(required("step", pad.step)?);
                BearingSpec::Pad { length: pad.length, width, film: pad.film(self.load)?, step, speed }
            }
        })
    }

    /// The keys of a pad.
    fn pad(&self) -> Option<&PadTable> {
        match &self.kind {
            BearingKind::Journal(_) => None,
            BearingKind::Pad(pad) | BearingKind::Step(pad) => Some(pad),
        }
    }
}

impl PadTable {
    /// Prescribed films, or those under a `load`.
    fn film(&self, load: Option<f64>) -> Result<PadFilm, String> {
        let films = [("inlet_film", self.inlet_film), ("outlet_film", self.outlet_film)];
        let shapes = [("taper", self.taper), ("pivot", self.pivot)];
        let first =
            |keys: [(&'static str, Option<f64>); 2]| keys.into_iter().find(|(_, given)| given.is_some());
        let Some(load) = load else {
            if let Some((shape, _)) = first(shapes) {
                return Err(format!("missing field `load`, with which `{shape}` determines the films"));
            }
            let missing = |key| {
                format!("missing field `{key}`, or `load` with `taper` or `pivot` in place of both films")
            };
            let [inlet, outlet] = films.map(|(key, film)| film.ok_or_else(|| missing(key)));
            return Ok(PadFilm::Given { inlet: inlet?, outlet: outlet? });
        };
        if let Some((film, _)) = first(films) {
            return Err(format!(
                "`load` determines `{film}`; leave it out and give `taper`, the film at the inlet less that at the outlet"
            ));
        }
        match [self.taper, self.pivot] {
            [Some(taper), None] => Ok(PadFilm::Fixed { load, taper }),
            [None, Some(pivot)] => Ok(PadFilm::Pivoted { load, pivot }),
            [Some(_), Some(_)] => Err("`pivot` determines `taper`; give only one".to_owned()),
            [None, None] => Err(
                "missing field `taper`, the film at the inlet less that at the outlet, or `pivot`, the distance of the pivot from the inlet"
                    .to_owned(),
            ),
        }
    }
}
