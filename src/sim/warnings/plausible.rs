//! Values that are rather those of another unit.
//!
//! Each quantity has a range that engineering contacts stay in with room to spare, and a usual size. A value
//! outside is tried in the other units that people write: the one that comes closest to the usual size, by
//! the logarithm, is offered. A length of no size that people write as a number alone was given with a unit:
//! then the unit a thousand times smaller or larger is offered. A new key is an entry in one of the lists
//! below, with a range of its own where none fits.

use super::{Warning, short};
use crate::metrics::height_statistics;
use crate::sim::scene::{
    BODIES, LubricantSpec, ProportionalRemovalSpec, Scene, Schedule, StressActivatedSpec,
    ThermalArrheniusSpec, TribofilmSpec, WearSpec,
};

/// A unit with others that people write in its place: name, factor and offset to the SI one.
struct Unit {
    /// The SI unit.
    name: &'static str,
    /// The others: name, factor and offset.
    others: &'static [(&'static str, f64, f64)],
    /// Smallest and largest number that people write in one of them; beyond, a unit was given and is wrong.
    numbers: [f64; 2],
}

/// A quantity of which any number may be written.
const fn unit(name: &'static str, others: &'static [(&'static str, f64, f64)]) -> Unit {
    Unit { name, others, numbers: [0.0, f64::INFINITY] }
}

const PASCAL: Unit = unit("Pa", &[("GPa", 1e9, 0.0), ("MPa", 1e6, 0.0)]);
const PER_PASCAL: Unit = unit("1/Pa", &[("1/GPa", 1e-9, 0.0), ("1/MPa", 1e-6, 0.0)]);
const METRE: Unit = Unit {
    name: "m",
    others: &[("nm", 1e-9, 0.0), ("um", 1e-6, 0.0), ("mm", 1e-3, 0.0)],
    numbers: [1e-3, 1e5],
};
const METRE_PER_SECOND: Unit = unit("m/s", &[("mm/s", 1e-3, 0.0)]);
const PASCAL_SECOND: Unit = unit("Pa s", &[("mPa s", 1e-3, 0.0)]);
const KELVIN: Unit = unit("K", &[("degC", 1.0, 273.15)]);
const NEWTON: Unit = unit("N", &[("mN", 1e-3, 0.0)]);
const DIFFUSIVITY: Unit = unit("m^2/s", &[("mm^2/s", 1e-6, 0.0)]);
const CONDUCTIVITY: Unit = unit("W/(m K)", &[]);
const JOULE: Unit = unit("J", &[("eV", 1.602176634e-19, 0.0), ("kJ/mol", 1.66053906717e-21, 0.0)]);
const VOLUME_PER_ENERGY: Unit = unit("m^3/J", &[("mm^3/J", 1e-9, 0.0)]);
const HEAT_CAPACITY: Unit = unit("J/(m^3 K)", &[("kJ/(m^3 K)", 1e3, 0.0), ("MJ/(m^3 K)", 1e6, 0.0)]);
const RATIO: Unit = unit("", &[("%", 0.01, 0.0)]);
/// Numbers that nobody gives in per cent.
const PURE: Unit = unit("", &[]);

/// What a quantity may plausibly be, and what it is like as a rule.
/// Zero is left to the errors, signs are ignored.
struct Plausible {
    /// Smallest plausible size.
    low: f64,
    /// Largest plausible size.
    high: f64,
    /// Size as a rule, which a guess of the unit is measured by.
    usual: f64,
    /// The unit of all three.
    unit: &'static Unit,
}

/// Range from `low` to `high`, size as a rule and unit.
const fn plausible(low: f64, high: f64, usual: f64, unit: &'static Unit) -> Plausible {
    Plausible { low, high, usual, unit }
}

/// Radii of bodies, from the tip of a microscope to a bearing ring.
const RADIUS: Plausible = plausible(1e-8, 1.0, 1e-2, &METRE);
/// Crowned rollers are nearly straight along their axis.
const LONGER_RADIUS: Plausible = plausible(1e-8, 100.0, 1e-2, &METRE);
/// Moduli, from rubber to beyond diamond.
const MODULUS: Plausible = plausible(1e6, 3e12, 2e11, &PASCAL);
/// Hertz pressures.
const HERTZ_PRESSURE: Plausible = plausible(1e3, 3e10, 1e9, &PASCAL);
/// Loads, from a microscope to a mill.
const FORCE: Plausible = plausible(1e-9, 1e7, 50.0, &NEWTON);
/// Entrainment speeds.
const SPEED: Plausible = plausible(1e-9, 200.0, 0.3, &METRE_PER_SECOND);
/// Beyond 2 the surfaces move against each other.
const SLIDE_ROLL_RATIO: Plausible = plausible(0.0, 2.0, 0.1, &RATIO);
/// Thicker than the heaviest gear oils at 40 degC.
const VISCOSITY: Plausible = plausible(1e-5, 2.0, 0.01, &PASCAL_SECOND);
/// Pressure-viscosity coefficients.
const PRESSURE_VISCOSITY: Plausible = plausible(1e-10, 1e-7, 2e-8, &PER_PASCAL);
/// The constant `p_0` of Roelands' law.
const ROELANDS_PRESSURE: Plausible = plausible(1e7, 2e9, 2e8, &PASCAL);
/// The index `z` of Roelands' law.
const ROELANDS_INDEX: Plausible = plausible(0.05, 2.0, 0.6, &PURE);
/// Constants of the law of Dowson and Higginson.
const COMPRESSIBILITY: Plausible = plausible(0.0, 1e-8, 1e-9, &PER_PASCAL);
/// Films of oil that are supplied.
const FILM: Plausible = plausible(1e-10, 1e-4, 1e-7, &METRE);
/// Hardnesses, up to that of diamond.
const HARDNESS: Plausible = plausible(1e6, 1.5e11, 6e9, &PASCAL);
/// Coefficients of friction.
const FRICTION: Plausible = plausible(0.0, 2.0, 0.1, &RATIO);
/// Shear stresses of fluids: limiting, and of Eyring.
const STRESS: Plausible = plausible(1e4, 1e10, 5e7, &PASCAL);
/// Thicknesses of tribofilms.
const TRIBOFILM: Plausible = plausible(1e-10, 1e-5, 1e-7, &METRE);
/// Archard's coefficients, up to that of bare metals without oil.
const WEAR: Plausible = plausible(0.0, 0.02, 1e-6, &PURE);
/// Worn volumes per energy of friction.
const WEAR_PER_ENERGY: Plausible = plausible(0.0, 1e-9, 1e-16, &VOLUME_PER_ENERGY);
/// Up to 10 eV.
const BARRIER: Plausible = plausible(1e-21, 1.6e-18, 1.3e-19, &JOULE);
/// Bulk temperatures, from an arctic night to where steel is soft.
const TEMPERATURE: Plausible = plausible(200.0, 1500.0, 350.0, &KELVIN);
/// Conductivities of solids, diamond among them.
const HEAT_CONDUCTIVITY: Plausible = plausible(0.01, 3000.0, 46.0, &CONDUCTIVITY);
/// Diffusivities of solids.
const HEAT_DIFFUSIVITY: Plausible = plausible(1e-8, 3e-3, 1e-5, &DIFFUSIVITY);
/// Conductivities of fluids.
const OIL_CONDUCTIVITY: Plausible = plausible(0.05, 1.0, 0.14, &CONDUCTIVITY);
/// Heat capacities of a volume of fluid.
const OIL_HEAT_CAPACITY: Plausible = plausible(5e5, 1e7, 1.7e6, &HEAT_CAPACITY);
/// Radii of tracks.
const TRACK_RADIUS: Plausible = plausible(1e-6, 10.0, 2e-2, &METRE);
/// Solids touch at the size of molecules.
const CONTACT_FILM: Plausible = plausible(1e-11, 1e-7, 1e-9, &METRE);
/// Residuals that a solve may end with.
const TOLERANCE: Plausible = plausible(1e-12, 1e-2, 1e-6, &PURE);
/// Largest Rq over the half-width of the contact.
const LARGEST_RQ: f64 = 0.1;

impl Plausible {
    /// The warning about `value`, unless it is plausible; zero and what is no number are for the errors.
    fn check(&self, field: &str, value: f64) -> Option<Warning> {
        let size = value.abs();
        if !value.is_finite() || size == 0.0 || (self.low..=self.high).contains(&size) {
            return None;
        }
        let unit = self.unit.name;
        let [low, high] = [self.low, self.high].map(short);
        let (side, bound) = if size > self.high { ("above", high) } else { ("below", low) };
        let remedy = match self.guess(value) {
            Some((number, name, si)) => {
                format!("did you mean {} {name} = {} {unit}?", short(number), short(si)).replace(" ?", "?")
            }
            None if unit.is_empty() => format!("{} is usual", short(self.usual)),
            None => format!("it is taken in {unit}, of which {} is usual", short(self.usual)),
        };
        let message = format!("{} {unit} is implausible, {side} {bound} {unit}", short(value));
        Some(Warning::new(
            field,
            value,
            message.replace("  ", " ").replace(" ,", ",").trim_end().to_owned(),
            remedy,
        ))
    }
}

impl Plausible {
    /// What is rather meant by the implausible `value`: number, unit and value in the SI unit.
    fn guess(&self, value: f64) -> Option<(f64, &'static str, f64)> {
        let Unit { others, numbers: [least, most], .. } = self.unit;
        let fits = |si: f64| (self.low..=self.high).contains(&si.abs());
        let distance = |si: f64| (si.abs() / self.usual).ln().abs();
        if (*least..*most).contains(&value.abs()) {
            let meant = others.iter().map(|(name, factor, offset)| (value, *name, value * factor + offset));
            return meant.filter(|(.., si)| fits(*si)).min_by(|a, b| distance(a.2).total_cmp(&distance(b.2)));
        }
        let slips = [1e-3, 1e3].map(|slip| slip * value).into_iter().filter(|si| fits(*si));
        let best = slips.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
        let mut shown = others.iter().map(|(name, factor, _)| (best / factor, *name, best));
        shown.find(|(number, ..)| (1.0 - 1e-9..1e3).contains(&number.abs()))
    }
}

/// Key, value where there is one, and what it may be.
type Entry = (String, Option<f64>, Plausible);

/// Values of the scene that are implausible.
pub(super) fn values(scene: &Scene) -> Vec<Warning> {
    let mut entries = bodies(scene);
    entries.extend(conditions(scene));
    entries.extend(scene.lubricant.iter().flat_map(oil));
    entries.extend(roughness(scene));
    entries.extend(processes(scene));
    entries.extend(heat_and_solver(scene));
    let given = entries.into_iter().filter_map(|(field, value, range)| Some((field, value?, range)));
    given.filter_map(|(field, value, range)| range.check(&field, value)).collect()
}

/// The warning about `heights` \[m\] that are too high for a contact of `half_width` \[m\]; where their squares
/// are beyond the range of numbers the largest height stands for Rq.
pub(super) fn height(field: &str, heights: &[f64], half_width: f64) -> Vec<Warning> {
    let rq = height_statistics(heights).map(|statistics| statistics.sq).ok().filter(|rq| rq.is_finite());
    let rq = rq.unwrap_or_else(|| heights.iter().fold(0.0, |largest, height| height.abs().max(largest)));
    largest_rq(half_width).check(&format!("{field}_rq"), rq).into_iter().collect()
}

/// Rq up to a tenth of the half-width \[m\] of the contact.
fn largest_rq(half_width: f64) -> Plausible {
    plausible(0.0, LARGEST_RQ * half_width, 1e-7, &METRE)
}

/// A key, its value where it is given, and its range.
fn entry(field: &str, value: impl Into<Option<f64>>, range: Plausible) -> Entry {
    (field.to_owned(), value.into(), range)
}

/// Form and materials.
fn bodies(scene: &Scene) -> Vec<Entry> {
    use crate::surface::Form;
    let mut list = match scene.form {
        Form::Sphere { radius } | Form::Cylinder { radius } => vec![entry("form.radius", radius, RADIUS)],
        Form::Ellipsoid { radius_x, radius_y, .. } => {
            let longer = if radius_x > radius_y { [LONGER_RADIUS, RADIUS] } else { [RADIUS, LONGER_RADIUS] };
            let [along_x, along_y] = longer;
            vec![entry("form.radius_x", radius_x, along_x), entry("form.radius_y", radius_y, along_y)]
        }
    };
    list.push(entry("elastic.equivalent_modulus", scene.elastic.equivalent_modulus, MODULUS));
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
    let mut list = vec![
        entry("load.hertz_pressure", scene.load.hertz_pressure, HERTZ_PRESSURE),
        entry("load.force", scene.load.force, FORCE),
        entry("motion.entrainment_speed", motion.entrainment_speed, SPEED),
        entry("motion.slide_roll_ratio", motion.slide_roll_ratio, SLIDE_ROLL_RATIO),
        entry("thermal.bulk_temperature", scene.thermal.bulk_temperature, TEMPERATURE),
    ];
    for (key, schedule, range) in [
        ("load", &schedule.load, FORCE),
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

/// Rq of both bodies, against the Hertz contact.
fn roughness(scene: &Scene) -> Vec<Entry> {
    let half_width = scene.hertz().map_or(f64::INFINITY, |hertz| hertz.half_width_x.min(hertz.half_width_y));
    let bodies = BODIES.into_iter().zip([&scene.roughness.ball, &scene.roughness.disc]);
    bodies.map(|(name, body)| (format!("roughness.{name}.rq"), body.rq(), largest_rq(half_width))).collect()
}

/// Friction, plasticity, tribofilm and wear.
fn processes(scene: &Scene) -> Vec<Entry> {
    let friction = scene.friction;
    let mut list = vec![
        entry("friction.boundary_coefficient", friction.boundary_coefficient, FRICTION),
        entry("friction.film_coefficient", friction.film_coefficient, FRICTION),
        entry("friction.covering_thickness", friction.covering_thickness, TRIBOFILM),
        entry("friction.limiting_shear_stress", friction.limiting_shear_stress, STRESS),
        entry("friction.eyring_stress", friction.eyring_stress, STRESS),
    ];
    if let Some(plastic) = scene.plastic {
        list.push(entry("plastic.hardness", plastic.hardness, HARDNESS));
        list.push(entry("plastic.film_hardness", plastic.film_hardness, HARDNESS));
    }
    if let Some(film) = scene.tribofilm {
        list.push(entry("tribofilm.maximum_thickness", film.maximum_thickness(), TRIBOFILM));
    }
    if let Some(TribofilmSpec::Ghanbarzadeh(film)) = scene.tribofilm {
        list.push(entry("tribofilm.removal_limit", film.removal_limit, TRIBOFILM));
    }
    match scene.tribofilm {
        Some(TribofilmSpec::StressActivated(StressActivatedSpec { activation_energy, .. }))
        | Some(TribofilmSpec::ThermalArrhenius(ThermalArrheniusSpec { activation_energy, .. }))
        | Some(TribofilmSpec::ProportionalRemoval(ProportionalRemovalSpec { activation_energy, .. })) => {
            list.push(entry("tribofilm.activation_energy", activation_energy, BARRIER));
        }
        _ => {}
    }
    match scene.wear {
        None => {}
        Some(WearSpec::Archard(wear)) => {
            list.push(entry("wear.coefficient", wear.coefficient, WEAR));
            list.push(entry("wear.hardness", wear.hardness, HARDNESS));
            list.push(entry("wear.film_hardness", wear.film_hardness, HARDNESS));
        }
        Some(WearSpec::FrictionalEnergy(wear)) => {
            list.push(entry("wear.volume_per_energy", wear.volume_per_energy, WEAR_PER_ENERGY));
        }
    }
    list
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
