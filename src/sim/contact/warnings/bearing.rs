//! Warnings about rigid bearings of scenes.

use super::Warning;
use super::given_film::{ISOVISCOUS, LARGEST_RISE};
use super::limits::{negative_index, steep_dimples};
use super::quantity::{GIVEN_FILM, OIL_TEMPERATURE};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::petroleum_density;
use crate::sim::scene::{BearingSpec, CELLS_IN_DIMPLE, OilSpec, PadRelief};
use crate::units::by_size;

/// Reynolds number `rho u c/eta` of a journal over `sqrt(R/c)` above which the film has Taylor vortices (Taylor, G. I. (1923),
/// Philosophical Transactions of the Royal Society A 223, 289-343; Frene, J. and others (1997), Hydrodynamic Lubrication, Elsevier).
const TAYLOR: f64 = 41.2;
/// Reynolds number `rho u h/eta` above which films without curvature become turbulent (Harnoy, A. (2003), Bearing Design in
/// Machinery, section 5.5: the transition begins at about 1000 and ends at about 1600).
const TRANSITION: f64 = 1000.0;

/// Standard atmosphere \[Pa\].
const ATMOSPHERE: f64 = 101_325.0;
/// Relative difference of diameters from which on they are two.
const SAME_DIAMETER: f64 = 0.01;

/// Warning about the speed of a journal that is a rate of rotation on another diameter \[m\] than its own.
pub(in crate::sim) fn other_diameter(bearing: &BearingSpec, stated: Option<f64>) -> Option<Warning> {
    let (BearingSpec::Journal { diameter, speed, .. }, Some(stated)) = (*bearing, stated) else {
        return None;
    };
    ((stated / diameter - 1.0).abs() > SAME_DIAMETER).then(|| {
        let message = format!(
            "the rate of rotation is on a diameter of {}, the journal has {}",
            by_size(stated, "m"),
            by_size(diameter, "m")
        );
        let remedy = "the rate alone, such as \"3000 rpm\", is on the diameter of the journal".to_owned();
        Warning::new("given_film.speed", speed, message, remedy)
    })
}

/// Warning about a cavitation pressure \[Pa\] relative to ambient that is below that of a vacuum.
pub(in crate::sim) fn tension(cavitation_pressure: f64) -> Option<Warning> {
    (cavitation_pressure < -ATMOSPHERE).then(|| {
        let message = format!(
            "an absolute vacuum is {} below an ambient pressure of one atmosphere: no bubble has a lower pressure, and the oil would hold a tension \
             of {}",
            by_size(ATMOSPHERE, "Pa"),
            by_size(-cavitation_pressure - ATMOSPHERE, "Pa")
        );
        let remedy = "-1 bar or more, unless the oil is degassed or the ambient pressure is higher".to_owned();
        Warning::new("given_film.cavitation_pressure", cavitation_pressure, message, remedy)
    })
}

/// Warnings about a solved bearing of a scene with its load \[N\] and the temperature of its oil \[K\]: one without load, an oil by its data sheet at a temperature that oils do not have, steep dimples.
pub(in crate::sim) fn bearing_warnings(
    [load, temperature]: [f64; 2],
    oil: Option<&OilSpec>,
    relief: Option<&PadRelief>,
) -> Vec<Warning> {
    let idle = (load <= 0.0).then(|| {
        let message = if load < 0.0 {
            "the film pulls the surfaces together: its mean pressure is below ambient"
        } else if relief.is_some() {
            "the film carries no load: it cavitates behind its first dimples, or its pressures cancel"
        } else {
            "the film carries no load: it does not converge in the direction of motion"
        };
        let remedy = "inlet_film above outlet_film, an eccentricity above 0, or a supply pressure".to_owned();
        Warning::new("load", load, message.to_owned(), remedy)
    });
    let steep = match relief {
        Some(&PadRelief::Dimples { diameter, depth, .. }) => {
            steep_dimples("given_film.dimple_depth", depth, diameter)
        }
        _ => None,
    };
    let index = oil.and_then(negative_index);
    let hot = oil.and_then(|_| OIL_TEMPERATURE.check("temperature", temperature));
    [idle, steep, hot, index].into_iter().flatten().collect()
}

/// Error for films at inlet and outlet \[m\] that are clearly in another unit.
pub(in crate::sim) fn reject_film_units([inlet, outlet]: [f64; 2]) -> Result<(), InputError> {
    GIVEN_FILM.reject_unit("given_film.inlet_film", inlet)?;
    GIVEN_FILM.reject_unit("given_film.outlet_film", outlet)
}

/// Error for a temperature of the oil \[K\] that is clearly in another unit.
pub(in crate::sim) fn reject_oil_temperature(field: &str, temperature: f64) -> Result<(), InputError> {
    OIL_TEMPERATURE.reject_unit(field, temperature)
}

/// Warning about dimples on few cells of `grid`.
pub(in crate::sim) fn coarse_dimples(relief: Option<&PadRelief>, grid: Grid) -> Option<Warning> {
    let Some(&PadRelief::Dimples { diameter, .. }) = relief else { return None };
    let [along, across] = [grid.dx(), grid.dy()].map(|cell| diameter / cell);
    let cells = along.min(across);
    // Cells may miss the number by rounding.
    (cells < CELLS_IN_DIMPLE - 0.5).then(|| {
        let message = format!(
            "{cells:.1} cells lie in the diameter of a dimple: where films are thin beside the depth, load and friction of the dimples are off by up to a \
             factor of two"
        );
        let needed = |count: usize, cells: f64| (count as f64 * (CELLS_IN_DIMPLE / cells).max(1.0)).ceil();
        let remedy = format!("nx = {} and ny = {}", needed(grid.nx(), along), needed(grid.ny(), across));
        Warning::new("given_film.dimple_diameter", diameter, message, remedy)
    })
}

/// Warning about a bearing with the mean film \[m\], the viscosity \[Pa s\] and the temperature \[K\] of its oil whose flow is not laminar. The
/// density is that of `oil`, and of the usual mineral oil at 15 degrees Celsius without one.
pub(in crate::sim) fn turbulent_film(
    bearing: &BearingSpec,
    [mean_film, viscosity, temperature]: [f64; 3],
    oil: Option<&OilSpec>,
) -> Option<Warning> {
    let density = match oil {
        Some(oil) => petroleum_density(oil.density_at_15(), temperature),
        None => OilSpec::default().density_at_15(),
    };
    let number = |speed: f64, film: f64| density * speed * film / viscosity;
    let (speed, reynolds, message, narrower) = match *bearing {
        BearingSpec::Journal { diameter, clearance, speed, .. } => {
            let (reynolds, limit) = (number(speed, clearance), TAYLOR * (0.5 * diameter / clearance).sqrt());
            let message = format!("above {TAYLOR} sqrt(R/c) = {limit:.0} the film has Taylor vortices");
            (speed, reynolds, (reynolds > limit).then_some(message)?, "a smaller clearance")
        }
        BearingSpec::Pad { speed, .. } => {
            let reynolds = number(speed, mean_film);
            let message = format!("above {TRANSITION} films become turbulent");
            (speed, reynolds, (reynolds > TRANSITION).then_some(message)?, "a thinner film")
        }
    };
    let message = format!(
        "the Reynolds number is {reynolds:.0} at a density of {density:.0} kg/m^3, and {message}: friction and power loss are larger than those of \
         the laminar film that is solved"
    );
    let remedy = format!("a thicker oil, a lower speed or {narrower}; turbulent films are not modelled");
    Some(Warning::new("given_film.speed", speed, message, remedy))
}

/// Warning about a bearing whose film is not converged, with `alpha` \[1/Pa\] and the viscosity ratio of the last iteration.
pub(in crate::sim) fn unsolved_bearing([alpha, viscosity_ratio]: [f64; 2], is_rigid: bool) -> Warning {
    let message = "the film is not converged: load, friction, flows and power are unknown";
    if is_rigid && viscosity_ratio > LARGEST_RISE {
        let message = format!("{message}; the viscosity rises with pressure between rigid surfaces");
        return Warning::new("alpha", alpha, message, ISOVISCOUS.to_owned());
    }
    let remedy = "other cells (nx, ny), a lower load or a thicker film".to_owned();
    Warning::new("status", f64::NAN, message.to_owned(), remedy)
}
