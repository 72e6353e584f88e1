//! Warnings about values that are probably in another unit.
//!
//! Each [quantity](super::quantity) has a range that is wider than that of engineering contacts. A new key is an entry in
//! one of the lists below, with its own range if none fits.

use super::Warning;
use super::quantity::{
    ACTIVATION, ACTIVATION_VOLUME, BARRIER, COMPRESSIBILITY, CONTACT_FILM, DEPTH, FILM, FORCE,
    FORCE_PER_LENGTH, FRICTION, HARDENING, HARDNESS, HEAT_CONDUCTIVITY, HEAT_DIFFUSIVITY, HEIGHT,
    HERTZ_PRESSURE, LAYER, LONGER_RADIUS, MODULUS, OIL_CONDUCTIVITY, OIL_HEAT_CAPACITY, OIL_TEMPERATURE,
    PRESSURE_VISCOSITY, Plausible, RADIUS, REMOVAL, ROELANDS_INDEX, ROELANDS_PRESSURE, SLIDE_ROLL_RATIO,
    SPEED, STRENGTH, STRESS, STRESS_RATIO, TEMPERATURE, TOLERANCE, TRACK_RADIUS, TRIBOFILM, VISCOSITY, WEAR,
    WEAR_PER_ENERGY, rq_range,
};
use crate::error::InputError;
use crate::lubricant::ViscosityLaw;
use crate::metrics::height_statistics;
use crate::sim::contact::oil;
use crate::sim::scene::{BODIES, LubricantSpec, Scene, Schedule, TribofilmSpec, WearLawSpec};

/// Rq above which heights are rejected if the contact is narrower \[m\].
const ROUGHEST: f64 = 1e-3;
/// Equivalent modulus \[Pa\] below which bodies are soft: joints and seals are conformal, with reduced radii of several
/// metres.
const SOFT: f64 = 2e10;

/// Key, value if given, and range.
type Entry = (String, Option<f64>, Plausible);

/// Implausible values of the scene.
pub(super) fn values(scene: &Scene) -> Vec<Warning> {
    let given = entries(scene).into_iter().chain(roughness(scene));
    given.filter_map(|(field, value, range)| range.check(&field, value?)).collect()
}

/// Error for the first value of the scene that is clearly in another unit.
pub(in crate::sim) fn reject_units(scene: &Scene) -> Result<(), InputError> {
    for (field, value, range) in entries(scene) {
        value.map_or(Ok(()), |value| range.reject_unit(&field, value))?;
    }
    let roughest = ROUGHEST.max(half_width(scene));
    for (field, rq, range) in roughness(scene) {
        rq.filter(|rq| *rq > roughest).map_or(Ok(()), |rq| range.refuse(&field, rq))?;
    }
    Ok(())
}

/// All values of the scene with a plausible range of their own.
fn entries(scene: &Scene) -> Vec<Entry> {
    let mut entries = bodies(scene);
    entries.extend(conditions(scene));
    entries.extend(scene.lubricant.iter().flat_map(oil));
    entries.extend(viscosity_law(scene));
    entries.extend(processes(scene));
    entries.extend(heat_and_solver(scene));
    entries
}

/// Error for `heights` \[m\] rougher than both the width of a contact of `half_width` \[m\] and any surface of a lubricated
/// contact: they are in another unit.
pub(in crate::sim) fn reject_height_unit(
    field: &str,
    heights: &[f64],
    half_width: f64,
) -> Result<(), InputError> {
    let rq = height_statistics(heights).map_or(0.0, |statistics| statistics.sq);
    if rq > ROUGHEST.max(half_width) {
        rq_range(half_width).refuse(&format!("{field}_rq"), rq)
    } else {
        Ok(())
    }
}

/// Warnings about `heights` \[m\] far from zero, and about an Rq that is implausible for a contact of `half_width` \[m\].
pub(super) fn height(field: &str, heights: &[f64], half_width: f64) -> Vec<Warning> {
    let largest = heights.iter().fold(0.0, |largest, height| height.abs().max(largest));
    let rq = height_statistics(heights).map_or(f64::NAN, |statistics| statistics.sq);
    let rq = rq_range(half_width).check(&format!("{field}_rq"), rq);
    rq.into_iter().chain(HEIGHT.check(field, largest)).collect()
}

/// Warnings about custom laws: viscosity at ambient pressure, limit thickness \[m\] of a tribofilm.
pub(in crate::sim) fn of_own_laws(
    viscosity: Option<&dyn ViscosityLaw>,
    thickness: Option<f64>,
) -> Vec<Warning> {
    let eta0 = viscosity.and_then(|law| VISCOSITY.check("viscosity", law.viscosity(0.0)));
    let alpha = viscosity.and_then(|law| PRESSURE_VISCOSITY.check("viscosity", law.log_slope(0.0)));
    let film = thickness.and_then(|thickness| TRIBOFILM.check("growth", thickness));
    eta0.into_iter().chain(alpha).chain(film).collect()
}

/// A key, its value if given, and its range.
fn entry(field: &str, value: impl Into<Option<f64>>, range: Plausible) -> Entry {
    (field.to_owned(), value.into(), range)
}

/// Whether the bodies are soft.
fn is_soft(scene: &Scene) -> bool {
    scene.equivalent_modulus().is_ok_and(|modulus| modulus < SOFT)
}

/// Form and materials.
fn bodies(scene: &Scene) -> Vec<Entry> {
    use crate::surface::Form;
    let mut list = match scene.form {
        Form::Sphere { radius } | Form::Cylinder { radius } => {
            vec![entry("form.radius", radius, if is_soft(scene) { LONGER_RADIUS } else { RADIUS })]
        }
        Form::Ellipsoid { radius_x, radius_y, .. } => {
            let longer = if radius_x > radius_y { [LONGER_RADIUS, RADIUS] } else { [RADIUS, LONGER_RADIUS] };
            let [along_x, along_y] = longer;
            vec![entry("form.radius_x", radius_x, along_x), entry("form.radius_y", radius_y, along_y)]
        }
        Form::Bodies { x, y, .. } => {
            let radii = x.into_iter().chain(y).filter(|radius| radius.is_finite());
            radii.map(|radius| entry("form.radii", radius.abs(), LONGER_RADIUS)).collect()
        }
    };
    let elastic = scene.elastic;
    list.push(entry("elastic.equivalent_modulus", elastic.equivalent_modulus, MODULUS));
    list.push(entry("elastic.tribofilm.modulus", elastic.tribofilm.map(|film| film.modulus), MODULUS));
    if let Some(layer) = elastic.layer {
        list.push(entry("elastic.layer.thickness", layer.thickness, LAYER));
        list.push(entry("elastic.layer.modulus", layer.modulus, MODULUS));
        list.push(entry("elastic.layer.hardness", layer.hardness, HARDNESS));
        list.push(entry("elastic.layer.substrate_modulus", layer.substrate_modulus, MODULUS));
    }
    if let Some(stress) = scene.stress {
        list.push(entry("stress.deepest", stress.deepest, DEPTH));
        list.push(entry("stress.yield_strength", stress.yield_strength, STRENGTH));
    }
    for (name, body) in BODIES.into_iter().zip(scene.materials.bodies()) {
        let key = |key: &str| format!("materials.{name}.{key}");
        list.push((key("modulus"), body.modulus, MODULUS));
        list.push((key("hardness"), body.hardness, HARDNESS));
        list.push((key("conductivity"), body.conductivity, HEAT_CONDUCTIVITY));
        list.push((key("diffusivity"), body.diffusivity, HEAT_DIFFUSIVITY));
    }
    list
}

/// Load, speeds and temperature, the smallest and the largest of a schedule.
fn conditions(scene: &Scene) -> Vec<Entry> {
    let (schedule, motion) = (&scene.schedule, scene.motion);
    let force = || if scene.form.is_line() { FORCE_PER_LENGTH } else { FORCE };
    let mut list = vec![
        entry("load.hertz_pressure", scene.load.hertz_pressure, HERTZ_PRESSURE),
        entry("load.force", scene.load.force, force()),
        entry("motion.entrainment_speed", motion.entrainment_speed, SPEED),
        entry("motion.slide_roll_ratio", motion.slide_roll_ratio, SLIDE_ROLL_RATIO),
        entry("motion.spin_radius", motion.spin_radius.map(f64::abs), LONGER_RADIUS),
        entry(
            "thermal.bulk_temperature",
            scene.thermal.bulk_temperature,
            temperature(scene.lubricant.as_ref()),
        ),
    ];
    for (key, schedule, range) in [
        ("load", &schedule.load, force()),
        ("entrainment_speed", &schedule.entrainment_speed, SPEED),
        ("slide_roll_ratio", &schedule.slide_roll_ratio, SLIDE_ROLL_RATIO),
        ("bulk_temperature", &schedule.bulk_temperature, TEMPERATURE),
    ] {
        let values: &[f64] = match schedule {
            Some(Schedule::Constant { value }) => std::slice::from_ref(value),
            Some(Schedule::Steps { values, .. } | Schedule::Ramps { values, .. }) => values,
            Some(Schedule::Table { .. }) | None => &[],
        };
        let beyond = values.iter().copied().find(|value| range.check("", *value).is_some());
        list.push((format!("schedule.{key}"), beyond, range));
    }
    list
}

/// Temperatures, where a data sheet describes the oil those of oils.
fn temperature(oil: Option<&LubricantSpec>) -> Plausible {
    if oil.is_some_and(|oil| oil.oil.is_some()) { OIL_TEMPERATURE } else { TEMPERATURE }
}

/// The lubricant.
fn oil(oil: &LubricantSpec) -> Vec<Entry> {
    vec![
        entry("lubricant.eta0", oil.eta0, VISCOSITY),
        entry("lubricant.roelands_z", oil.roelands_z, ROELANDS_INDEX),
        entry("lubricant.roelands_p0", oil.roelands_p0, ROELANDS_PRESSURE),
        entry("lubricant.alpha", oil.alpha, PRESSURE_VISCOSITY),
        entry("lubricant.formula_alpha", oil.formula_alpha, PRESSURE_VISCOSITY),
        entry("lubricant.density_a", oil.density_a, COMPRESSIBILITY),
        entry("lubricant.density_b", oil.density_b, COMPRESSIBILITY),
        entry("lubricant.supplied_film", oil.supplied_film, FILM),
        entry("lubricant.thermal.conductivity", oil.thermal.map(|heat| heat.conductivity), OIL_CONDUCTIVITY),
        entry(
            "lubricant.thermal.heat_capacity",
            oil.thermal.map(|heat| heat.heat_capacity),
            OIL_HEAT_CAPACITY,
        ),
    ]
}

/// A viscosity law other than Roelands', by its values at ambient pressure.
fn viscosity_law(scene: &Scene) -> Vec<Entry> {
    let field = scene.lubricant.and_then(|oil| match (oil.oil, oil.viscosity) {
        (Some(_), _) => Some("lubricant"),
        (None, Some(_)) => Some("lubricant.viscosity"),
        (None, None) => None,
    });
    let (Some(field), Ok(conditions)) = (field, scene.conditions(0.0)) else { return Vec::new() };
    let Ok(Some(law)) = oil::viscosity(scene, conditions.bulk_temperature) else { return Vec::new() };
    vec![entry(field, law.viscosity(0.0), VISCOSITY), entry(field, law.log_slope(0.0), PRESSURE_VISCOSITY)]
}

/// Smaller half-width of the Hertz contact \[m\]; infinite if unknown.
fn half_width(scene: &Scene) -> f64 {
    scene.hertz().map_or(f64::INFINITY, |hertz| hertz.half_width_x.min(hertz.half_width_y))
}

/// Rq of both bodies, relative to the Hertz contact.
fn roughness(scene: &Scene) -> Vec<Entry> {
    let half_width = half_width(scene);
    let bodies = BODIES.into_iter().zip([&scene.roughness.ball, &scene.roughness.disc]);
    bodies.map(|(name, body)| (format!("roughness.{name}.rq"), body.rq(), rq_range(half_width))).collect()
}

/// Friction, plasticity, tribofilm and wear.
fn processes(scene: &Scene) -> Vec<Entry> {
    let friction = scene.friction;
    let mut list = vec![
        entry("friction.boundary_coefficient", friction.boundary_coefficient, FRICTION),
        entry("friction.film_coefficient", friction.film_coefficient, FRICTION),
        entry("friction.covering_thickness", friction.covering_thickness, TRIBOFILM),
        entry("friction.limiting_shear_stress", friction.limiting_shear_stress, STRESS),
        entry("friction.limiting_stress_coefficient", friction.limiting_stress_coefficient, STRESS_RATIO),
        entry("friction.eyring_stress", friction.eyring_stress, STRESS),
        entry("friction.carreau_stress", friction.carreau_stress, STRESS),
    ];
    if let Some(plastic) = scene.plastic {
        list.push(entry("plastic.hardness", plastic.hardness, HARDNESS));
        list.push(entry("plastic.film_hardness", plastic.film_hardness, HARDNESS));
        list.push(entry("plastic.hardening_modulus", plastic.hardening_modulus, HARDENING));
    }
    if let Some(film) = scene.tribofilm {
        list.push(entry("tribofilm.maximum_thickness", film.maximum_thickness(), TRIBOFILM));
    }
    list.extend(scene.tribofilm.iter().flat_map(growth));
    match scene.wear.map(|wear| wear.law) {
        None => {}
        Some(WearLawSpec::Archard(wear)) => {
            list.push(entry("wear.coefficient", wear.coefficient, WEAR));
            list.push(entry("wear.hardness", wear.hardness, HARDNESS));
            list.push(entry("wear.film_hardness", wear.film_hardness, HARDNESS));
        }
        Some(WearLawSpec::FrictionalEnergy(wear)) => {
            list.push(entry("wear.volume_per_energy", wear.volume_per_energy, WEAR_PER_ENERGY));
        }
    }
    list
}

/// Constants of the growth law.
fn growth(film: &TribofilmSpec) -> Vec<Entry> {
    let barrier = |energy: f64| entry("tribofilm.activation_energy", energy, BARRIER);
    let volume = |volume: f64| entry("tribofilm.activation_volume", volume, ACTIVATION_VOLUME);
    let removal = |rate: f64| entry("tribofilm.removal_rate", rate, REMOVAL);
    match film {
        TribofilmSpec::Ghanbarzadeh(film) => vec![
            entry("tribofilm.x_tribo", film.x_tribo, ACTIVATION),
            entry("tribofilm.removal_limit", film.removal_limit, TRIBOFILM),
            removal(film.removal_rate),
        ],
        TribofilmSpec::StressActivated(film) => {
            vec![barrier(film.activation_energy), volume(film.activation_volume)]
        }
        TribofilmSpec::ThermalArrhenius(film) => vec![barrier(film.activation_energy)],
        TribofilmSpec::ProportionalRemoval(film) => {
            vec![barrier(film.activation_energy), volume(film.activation_volume), removal(film.removal_rate)]
        }
    }
}

/// Thermal constants, radii of the tracks, contact film and tolerance.
fn heat_and_solver(scene: &Scene) -> Vec<Entry> {
    vec![
        entry("thermal.conductivity", scene.thermal.conductivity, HEAT_CONDUCTIVITY),
        entry("thermal.diffusivity", scene.thermal.diffusivity, HEAT_DIFFUSIVITY),
        entry("track.radius_ball", scene.track.radius_ball, TRACK_RADIUS),
        entry("track.radius_disc", scene.track.radius_disc, TRACK_RADIUS),
        entry("solver.film_cutoff", scene.solver.film_cutoff, CONTACT_FILM),
        entry("solver.tolerance", scene.solver.tolerance, TOLERANCE),
    ]
}
