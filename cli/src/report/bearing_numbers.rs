//! The table of a rigid bearing.

use serde_json::Value;

use super::numbers::{ErrorOf, Number, list, number};

const fn celsius<'a>(name: &'a str, key: &'a str) -> Number<'a> {
    Number { name, key, unit: "°C", factor: 1.0, offset: -273.15, error: ErrorOf::None }
}

/// Numbers of a rigid bearing. Those that an object does not have are left out.
const BEARING: [Number<'static>; 37] = [
    number("Load", "load", "N", 1.0),
    number("Load without the least pressure of the edges", "load_above_edges", "N", 1.0),
    number("Force towards the widest gap", "force.0", "N", 1.0),
    number("Force across", "force.1", "N", 1.0),
    number("Eccentricity", "eccentricity", "", 1.0),
    number("Attitude angle", "attitude", "°", 180.0 / std::f64::consts::PI),
    number("Sommerfeld number", "sommerfeld", "", 1.0),
    number("Film at the inlet", "inlet_film", "µm", 1e6),
    number("Film at the outlet", "outlet_film", "µm", 1e6),
    number("Center of pressure behind the inlet", "pressure_center", "mm", 1e3),
    number("Least film", "least_film", "µm", 1e6),
    number("Least film over Rq", "film_over_rq", "", 1.0),
    number("Widening by the elastic bore", "bore_widening", "µm", 1e6),
    number("Largest pressure", "pressure_max", "MPa", 1e-6),
    number("Friction coefficient", "friction_coefficient", "", 1.0),
    number("Friction on the moving surface", "friction_moving", "N", 1.0),
    number("Friction on the resting surface", "friction_resting", "N", 1.0),
    number("Shear of cavitated oil", "cavitated_shear", "N", 1.0),
    number("Friction of solids", "contact_friction", "N", 1.0),
    number("Load on solids", "contact_share", "%", 100.0),
    number("Area of contact", "contact_area", "mm²", 1e6),
    number("Power loss", "power_loss", "W", 1.0),
    number("Flow out at the inlet or begin", "edge_flows.0", "ml/s", 1e6),
    number("Flow out at the outlet or end", "edge_flows.1", "ml/s", 1e6),
    number("Flow out at one side", "edge_flows.2", "ml/s", 1e6),
    number("Flow out at the other side", "edge_flows.3", "ml/s", 1e6),
    number("Flow out through both sides", "side_flow", "ml/s", 1e6),
    number("Flow from grooves", "groove_flow", "ml/s", 1e6),
    number("Flow from holes", "hole_flow", "ml/s", 1e6),
    number("Viscosity of the oil", "eta0", "mPa s", 1e3),
    number("Pressure-viscosity coefficient", "alpha", "1/GPa", 1e9),
    number("Viscosity at the largest pressure over that at ambient pressure", "viscosity_ratio", "", 1.0),
    celsius("Temperature of the oil", "temperature"),
    celsius("Temperature of the supply", "supply_temperature"),
    celsius("Temperature at the outlet", "outlet_temperature"),
    number("Heat that the oil carries", "carried_heat", "W", 1.0),
    number("Time of the computation", "seconds", "s", 1.0),
];

/// The numbers of a rigid bearing; those of a pad without width are per metre.
pub(crate) fn bearing(json: &Value, has_width: bool) -> String {
    let per_metre = |number: &Number<'static>| {
        let unit = match number.unit {
            "N" => "N/m",
            "W" => "W/m",
            "ml/s" => "ml/(s m)",
            "mm²" => "mm²/m",
            unit => unit,
        };
        Number { unit, ..*number }
    };
    let numbers = BEARING.iter().map(|number| if has_width { *number } else { per_metre(number) });
    list(json, &numbers.collect::<Vec<_>>())
}
