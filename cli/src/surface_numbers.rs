//! The parameters of a surface.

use serde_json::{Map, Value, json};
use stribeck::metrics::{
    AreaCorrelation, BearingCurve, HybridParameters, SpatialParameters, height_statistics, hybrid_parameters,
};
use stribeck::surface::{Heights, SurfaceError};
use stribeck::{Boundary, Grid, InputError};

/// Share of the mean square height from which on a plane or form is spoken of.
const MOST: f64 = 0.5;
/// Points from which on a plane or form is no mere interpolation.
const FEWEST_POINTS: usize = 16;
/// Degree of the polynomial that stands for a form.
const FORM_DEGREE: usize = 2;
/// Value of the autocorrelation at which Sal and Str are read.
const THRESHOLD: f64 = 0.2;
/// Material ratios that bound the volumes.
const PEAKS: f64 = 0.1;
const VALLEYS: f64 = 0.8;

/// All that is printed and drawn.
pub(crate) struct Numbers {
    size: [usize; 2],
    undefined: usize,
    unit: Option<String>,
    pub(crate) grid: Option<Grid>,
    /// Mean of the defined heights \[m\].
    pub(crate) mean: f64,
    pub(crate) curve: BearingCurve,
    pub(crate) correlation: Option<AreaCorrelation>,
    /// Key, value in SI units (none when the surface has none).
    parameters: Vec<(&'static str, Option<f64>)>,
}

impl Numbers {
    pub(crate) fn of(surface: &Heights) -> Result<Self, SurfaceError> {
        let heights = surface.defined_heights();
        if heights.is_empty() {
            return Err(SurfaceError::AllUndefined { points: surface.undefined() });
        }
        let grid = match (surface.dx(), surface.dy()) {
            (Some(dx), Some(dy)) => Some(Grid::centred(surface.nx(), surface.ny(), dx, dy)?),
            _ => None,
        };
        let statistics = height_statistics(&heights)?;
        let curve = BearingCurve::new(&heights)?;
        let (core, volumes) = (curve.core(), curve.volumes(PEAKS, VALLEYS)?);
        let (field, mask) = (surface.heights(), surface.defined());
        let correlation =
            grid.as_ref().and_then(|grid| absent(AreaCorrelation::new(grid, field, mask, Boundary::Open)));
        let hybrid: Option<HybridParameters> =
            grid.as_ref().and_then(|grid| absent(hybrid_parameters(grid, field, mask)));
        let spatial: Option<SpatialParameters> =
            correlation.as_ref().map(|correlation| correlation.spatial(THRESHOLD)).transpose()?;
        let parameters = vec![
            ("sa", Some(statistics.sa)),
            ("sq", Some(statistics.sq)),
            ("ssk", Some(statistics.ssk)),
            ("sku", Some(statistics.sku)),
            ("sp", Some(statistics.sp)),
            ("sv", Some(statistics.sv)),
            ("sz", Some(statistics.sz)),
            ("sdq", hybrid.map(|hybrid| hybrid.sdq)),
            ("sdr", hybrid.map(|hybrid| hybrid.sdr).filter(|sdr| sdr.is_finite())),
            ("sal", spatial.and_then(|spatial| spatial.sal)),
            ("str", spatial.and_then(|spatial| spatial.str)),
            ("sk", Some(core.sk)),
            ("spk", Some(core.spk)),
            ("svk", Some(core.svk)),
            ("smr1", Some(core.smr1)),
            ("smr2", Some(core.smr2)),
            ("vmp", Some(volumes.vmp)),
            ("vmc", Some(volumes.vmc)),
            ("vvc", Some(volumes.vvc)),
            ("vvv", Some(volumes.vvv)),
            ("mean", Some(statistics.mean)),
            ("min", Some(statistics.mean - statistics.sv)),
            ("max", Some(statistics.mean + statistics.sp)),
        ];
        Ok(Self {
            size: [surface.nx(), surface.ny()],
            undefined: surface.undefined(),
            unit: surface.unit().map(|unit| unit.to_string()),
            grid,
            mean: statistics.mean,
            curve,
            correlation,
            parameters,
        })
    }

    fn lengths(&self) -> [(&'static str, Option<f64>); 4] {
        let of = |length: fn(&Grid) -> f64| self.grid.as_ref().map(length);
        [
            ("size_x", of(Grid::size_x)),
            ("size_y", of(Grid::size_y)),
            ("dx", of(Grid::dx)),
            ("dy", of(Grid::dy)),
        ]
    }

    /// One object in SI units with the `warnings`, a sentence each; a parameter that the surface lacks is null.
    pub(crate) fn to_json(&self, warnings: &[String]) -> Value {
        let mut object = Map::new();
        object.insert("nx".to_owned(), json!(self.size[0]));
        object.insert("ny".to_owned(), json!(self.size[1]));
        object.insert("undefined".to_owned(), json!(self.undefined));
        object.insert("unit".to_owned(), json!(self.unit));
        for (key, value) in self.lengths().iter().chain(&self.parameters) {
            object.insert((*key).to_owned(), json!(value));
        }
        object.insert("warnings".to_owned(), json!(warnings));
        Value::Object(object)
    }

    pub(crate) fn to_text(&self) -> String {
        let [nx, ny] = self.size;
        let mut text = format!("points     {nx} x {ny}, {} undefined\n", self.undefined);
        let unit = self.unit.as_deref().unwrap_or("an unknown unit, taken as m");
        text += &format!("file       heights in {unit}\n");
        for (key, value) in self.lengths().iter().chain(&self.parameters) {
            let unit = unit_of(key);
            let value = value.map_or_else(|| "-".to_owned(), |v| format!("{v:.6e}{unit}"));
            text += &format!("{key:<10} {value}\n");
        }
        text
    }
}

/// The unit of a parameter in the report, with a space before it.
fn unit_of(key: &str) -> &'static str {
    match key {
        "ssk" | "sku" | "sdq" | "sdr" | "str" | "smr1" | "smr2" => "",
        "vmp" | "vmc" | "vvc" | "vvv" => " m^3/m^2",
        _ => " m",
    }
}

/// Parameters that a flat or tiny surface does not have.
fn absent<T>(result: Result<T, InputError>) -> Option<T> {
    result.ok()
}

/// A plane or form that holds most of the mean square height, as a sentence.
pub(crate) fn dominant_form(surface: &Heights) -> Option<String> {
    if surface.defined_heights().len() < FEWEST_POINTS {
        return None;
    }
    let square = |surface: &Heights| Some(height_statistics(&surface.defined_heights()).ok()?.sq.powi(2));
    let whole = square(surface).filter(|square| *square > 0.0)?;
    let share = |degree: usize| {
        let mut rest = surface.clone();
        rest.remove_polynomial(degree).ok()?;
        Some(1.0 - square(&rest)? / whole)
    };
    let (plane, form) = (share(1)?, share(FORM_DEGREE)?);
    let says = |part: &str, share: f64, option: &str| {
        format!("{part} holds {:.0} % of Sq^2; {option} removes it", 100.0 * share)
    };
    if plane > MOST {
        Some(says("a plane", plane, "--level"))
    } else if form > MOST {
        Some(says("a form of the second degree", form, "--form sphere, cylinder or polynomial"))
    } else {
        None
    }
}
