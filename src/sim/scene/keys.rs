//! Units in scene files: the dimension of each key, and text with a unit in place of a number.
//!
//! [`KEYS`] lists all keys with a dimension; a new one needs a line there. Text with a unit is replaced by its
//! number before the tables are read.

use toml::{Table, Value};

use crate::error::InputError;
use crate::units::Dimension;
use Dimension::{
    Angle, Conductivity, Density, Diffusivity, Energy, Force, ForcePerLength, HeatCapacity, InversePressure,
    Length, Pressure, PressurePerLength, Rate, Ratio, Rotation, Speed, Temperature, Time, Viscosity, Volume,
    VolumePerEnergy,
};

/// All keys with a dimension; `*` matches the name of a body. Loads of a line contact are per length.
pub(super) const KEYS: &[(&str, Dimension)] = &[
    ("form.radius", Length),
    ("form.radius_x", Length),
    ("form.radius_y", Length),
    ("form.radii", Length),
    ("form.radii_x", Length),
    ("form.radii_y", Length),
    ("form.angle", Angle),
    ("elastic.equivalent_modulus", Pressure),
    ("elastic.layer.thickness", Length),
    ("elastic.layer.modulus", Pressure),
    ("elastic.layer.hardness", Pressure),
    ("elastic.layer.substrate_modulus", Pressure),
    ("elastic.tribofilm.modulus", Pressure),
    ("materials.*.modulus", Pressure),
    ("materials.*.hardness", Pressure),
    ("materials.*.conductivity", Conductivity),
    ("materials.*.diffusivity", Diffusivity),
    ("load.hertz_pressure", Pressure),
    ("load.force", Force),
    ("load.mean_pressure", Pressure),
    ("load.mean_gap", Length),
    ("motion.entrainment_speed", Speed),
    ("motion.ball_speed", Speed),
    ("motion.disc_speed", Speed),
    ("motion.spin_radius", Length),
    ("motion.passage", Length),
    ("motion.slide_roll_ratio", Ratio),
    ("lubricant.eta0", Viscosity),
    ("lubricant.roelands_p0", Pressure),
    ("lubricant.temperature", Temperature),
    ("lubricant.alpha", InversePressure),
    ("lubricant.density", Density),
    ("lubricant.formula_alpha", InversePressure),
    ("lubricant.density_a", InversePressure),
    ("lubricant.density_b", InversePressure),
    ("lubricant.supplied_film", Length),
    ("lubricant.viscosity.eta0", Viscosity),
    ("lubricant.viscosity.alpha", InversePressure),
    ("lubricant.thermal.conductivity", Conductivity),
    ("lubricant.thermal.heat_capacity", HeatCapacity),
    ("lubricant.viscosity.viscosity", Viscosity),
    ("lubricant.viscosity.temperature", Temperature),
    ("lubricant.viscosity.k00", Pressure),
    ("lubricant.viscosity.glass_viscosity", Viscosity),
    ("lubricant.viscosity.glass_temperature", Temperature),
    ("lubricant.viscosity.a2", InversePressure),
    ("lubricant.viscosity.b1", InversePressure),
    ("given_film.diameter", Length),
    ("given_film.width", Length),
    ("given_film.clearance", Length),
    ("given_film.eccentricity", Ratio),
    ("given_film.load", Force),
    ("given_film.length", Length),
    ("given_film.inlet_film", Length),
    ("given_film.outlet_film", Length),
    ("given_film.taper", Length),
    ("given_film.pivot", Length),
    ("given_film.step", Length),
    ("given_film.speed", Speed),
    ("given_film.edge_pressures", Pressure),
    ("given_film.cavitation_pressure", Pressure),
    ("given_film.dimple_diameter", Length),
    ("given_film.dimple_depth", Length),
    ("given_film.dimple_density", Ratio),
    ("given_film.spacing", Length),
    ("given_film.groove_angles", Angle),
    ("given_film.groove_width", Length),
    ("given_film.groove_length", Length),
    ("given_film.supply_pressure", Pressure),
    ("given_film.hole_angles", Angle),
    ("given_film.hole_positions", Length),
    ("given_film.hole_diameter", Length),
    ("given_film.bore_modulus", Pressure),
    ("given_film.liner_thickness", Length),
    ("given_film.liner_modulus", Pressure),
    ("given_film.liner_poisson", Ratio),
    ("given_film.supply_temperature", Temperature),
    ("given_film.heat_capacity", HeatCapacity),
    ("given_film.heat_share", Ratio),
    ("given_film.roughness.rq", Length),
    ("given_film.roughness.gamma", Ratio),
    ("given_film.roughness.asperity_number", Ratio),
    ("given_film.roughness.rq_over_radius", Ratio),
    ("given_film.roughness.equivalent_modulus", Pressure),
    ("given_film.roughness.boundary_friction", Ratio),
    ("grid.x", Length),
    ("grid.y", Length),
    ("grid.accuracy", Ratio),
    ("roughness.*.rq", Length),
    ("roughness.*.length_x", Length),
    ("roughness.*.length_y", Length),
    ("roughness.*.roll_off", Length),
    ("roughness.*.longest", Length),
    ("roughness.*.shortest", Length),
    ("roughness.*.radius", Length),
    ("roughness.*.width", Length),
    ("roughness.*.depth", Length),
    ("roughness.*.pitch", Length),
    ("plastic.hardness", Pressure),
    ("plastic.film_hardness", Pressure),
    ("plastic.hardening_modulus", PressurePerLength),
    ("friction.boundary_coefficient", Ratio),
    ("friction.film_coefficient", Ratio),
    ("friction.limiting_stress_coefficient", Ratio),
    ("friction.covering_thickness", Length),
    ("friction.limiting_shear_stress", Pressure),
    ("friction.eyring_stress", Pressure),
    ("friction.carreau_stress", Pressure),
    ("tribofilm.maximum_thickness", Length),
    ("tribofilm.removal_limit", Length),
    ("tribofilm.removal_rate", Rate),
    ("tribofilm.prefactor", Rate),
    ("tribofilm.growth_rate", Speed),
    ("tribofilm.activation_energy", Energy),
    ("tribofilm.activation_volume", Volume),
    ("wear.coefficient", Ratio),
    ("wear.film_coefficient", Ratio),
    ("wear.hardness", Pressure),
    ("wear.film_hardness", Pressure),
    ("wear.volume_per_energy", VolumePerEnergy),
    ("wear.film_volume_per_energy", VolumePerEnergy),
    ("track.radius_ball", Length),
    ("track.radius_disc", Length),
    ("thermal.bulk_temperature", Temperature),
    ("thermal.conductivity", Conductivity),
    ("thermal.diffusivity", Diffusivity),
    ("schedule.load.value", Force),
    ("schedule.load.values", Force),
    ("schedule.load.times", Time),
    ("schedule.entrainment_speed.value", Speed),
    ("schedule.entrainment_speed.values", Speed),
    ("schedule.entrainment_speed.times", Time),
    ("schedule.slide_roll_ratio.value", Ratio),
    ("schedule.slide_roll_ratio.values", Ratio),
    ("schedule.slide_roll_ratio.times", Time),
    ("schedule.bulk_temperature.value", Temperature),
    ("schedule.bulk_temperature.values", Temperature),
    ("schedule.bulk_temperature.times", Time),
    ("cycle.time", Time),
    ("cycle.angle", Angle),
    ("cycle.period", Time),
    ("cycle.load", Force),
    ("cycle.ball_speed", Speed),
    ("cycle.disc_speed", Speed),
    ("cycle.radius", Length),
    ("cycle.bulk_temperature", Temperature),
    ("stress.deepest", Length),
    ("stress.yield_strength", Pressure),
    ("bearing.rotation", Rotation),
    ("bearing.mean_diameter", Length),
    ("solver.film_cutoff", Length),
    ("solver.accuracy", Ratio),
];

/// Number of parts of `pattern` below the key at `path`; `None` if the key is not a prefix of it.
fn parts_below(pattern: &str, path: &str) -> Option<usize> {
    let mut parts = pattern.split('.');
    let fit = path.split('.').all(|name| parts.next().is_some_and(|part| part == "*" || part == name));
    fit.then(|| parts.count())
}

/// Whether the key at `path` is a table: one of its keys has a dimension.
fn is_table(path: &str) -> bool {
    KEYS.iter().any(|(pattern, _)| parts_below(pattern, path).is_some_and(|parts| parts > 0))
}

/// Dimension of the key at `path` of a scene file; `None` if it has none or there is no such key.
fn dimension(path: &str, line: bool) -> Option<Dimension> {
    let found = KEYS.iter().find(|(pattern, _)| parts_below(pattern, path) == Some(0));
    let found = found.map(|(_, dimension)| *dimension)?;
    Some(if line && found == Force { ForcePerLength } else { found })
}

/// Replaces text with a unit in the `tables` of a scene by numbers in SI units.
///
/// # Errors
/// Text that is not a quantity of its key, a list in place of a table, a date; the error names the key.
pub(super) fn convert(tables: &mut Table) -> Result<(), InputError> {
    let kind_of = |table: &Value| table.get("kind").and_then(Value::as_str).map(str::to_owned);
    let is_cylinder = tables.get("form").and_then(kind_of).as_deref() == Some("cylinder");
    // A pad without width has a load per metre.
    let is_wide =
        |table: &Value| kind_of(table).as_deref() != Some("journal") && table.get("width").is_none();
    let is_line = is_cylinder || tables.get("given_film").is_some_and(is_wide);
    tables.iter_mut().try_for_each(|(key, value)| convert_value(value, key, is_line))
}

/// Replaces text with a unit in the `value` at `path`. Lists of values are skipped.
fn convert_value(value: &mut Value, path: &str, line: bool) -> Result<(), InputError> {
    let conflict = |reason: String| Err(InputError::Conflict { field: path.to_owned(), reason });
    match value {
        Value::Table(table) => {
            table.iter_mut().try_for_each(|(key, value)| convert_value(value, &format!("{path}.{key}"), line))
        }
        Value::String(quantity) => {
            if let Some(dimension) = dimension(path, line) {
                *value = Value::Float(dimension.parse(path, quantity)?);
            }
            Ok(())
        }
        Value::Datetime(_) => conflict("it is a date, and no key of a scene takes one".to_owned()),
        Value::Array(_) if is_table(path) => {
            conflict(format!("it is a list where a table is expected: one [{path}] with its keys"))
        }
        Value::Array(values) => {
            let Some(dimension) = dimension(path, line) else { return Ok(()) };
            for (index, value) in values.iter_mut().enumerate() {
                if let Value::String(quantity) = value {
                    *value = Value::Float(dimension.parse(&format!("{path}[{index}]"), quantity)?);
                }
            }
            Ok(())
        }
        _ => Ok(()),
    }
}
