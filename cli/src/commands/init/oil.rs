//! The oil of a new scene: by its viscosity and pressure-viscosity coefficient, or by its grade.

use super::quantity::Quantity;
use super::{Options, plain};

/// Viscosity index of a paraffinic mineral oil.
const USUAL_INDEX: f64 = 95.0;
/// Temperature of an oil by its grade \[K\].
const USUAL_TEMPERATURE: f64 = 313.15;

/// The tables of the oil, of viscosity and pressure-viscosity coefficient `[eta0, alpha]` without a grade, and of its temperature.
pub(super) fn tables(options: &Options, [eta0, alpha]: [&Quantity; 2]) -> String {
    let head = "[lubricant] # leave the table out for a dry contact\n";
    match &options.grade {
        Some(grade) => format!(
            "{head}grade = {grade:?} # kinematic viscosity at 40 degC\n\
             viscosity_index = {:?} # its fall with temperature; paraffinic mineral oils: about 95\n\n\
             [thermal]\nbulk_temperature = \"{} degC\" # of the contact; the oil follows it\n",
            options.viscosity_index.unwrap_or(USUAL_INDEX),
            plain(options.temperature.unwrap_or(USUAL_TEMPERATURE) - 273.15)
        ),
        None => format!(
            "{head}eta0 = {} # viscosity at ambient pressure and the temperature of the contact\n\
             alpha = {} # pressure-viscosity coefficient\n\
             roelands_z = 0.68 # how the viscosity bends at high pressure; 0.6 to 0.7 for mineral oils\n",
            eta0.entry(),
            alpha.entry()
        ),
    }
}
