//! Plausible ranges of quantities, their common units, and guesses of the intended unit.
//!
//! A value outside of its range is interpreted in the other common units; the message offers the one closest to the
//! typical size, by logarithm. A length too large or too small for a plain number was given with a unit: the message then
//! offers a unit a thousand times smaller or larger.

use super::{Warning, short};
use crate::error::InputError;

/// A unit and its alternatives: name, factor and offset to the SI unit.
struct Unit {
    /// The SI unit.
    name: &'static str,
    /// The others: name, factor and offset.
    others: &'static [(&'static str, f64, f64)],
    /// Smallest and largest plain number in these units; outside of this range a wrong unit was given.
    numbers: [f64; 2],
}

/// A quantity without bounds on plain numbers.
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
const NEWTON_PER_METRE: Unit = unit("N/m", &[("mN/m", 1e-3, 0.0), ("kN/m", 1e3, 0.0)]);
const DIFFUSIVITY: Unit = unit("m^2/s", &[("mm^2/s", 1e-6, 0.0)]);
const CONDUCTIVITY: Unit = unit("W/(m K)", &[]);
const JOULE: Unit = unit("J", &[("eV", 1.602176634e-19, 0.0), ("kJ/mol", 1.66053906717e-21, 0.0)]);
const VOLUME_PER_ENERGY: Unit = unit("m^3/J", &[("mm^3/J", 1e-9, 0.0)]);
const HEAT_CAPACITY: Unit = unit("J/(m^3 K)", &[("kJ/(m^3 K)", 1e3, 0.0), ("MJ/(m^3 K)", 1e6, 0.0)]);
const VOLUME: Unit = unit("m^3", &[("nm^3", 1e-27, 0.0), ("A^3", 1e-30, 0.0)]);
const PER_SECOND: Unit = unit("1/s", &[("1/h", 1.0 / 3600.0, 0.0)]);
const PASCAL_PER_METRE: Unit = unit("Pa/m", &[("GPa/um", 1e15, 0.0), ("MPa/um", 1e12, 0.0)]);
const RATIO: Unit = unit("", &[("%", 0.01, 0.0)]);
/// Numbers that are not given in per cent.
const PURE: Unit = unit("", &[]);

/// Plausible range and typical size of a quantity. Zero is not checked and signs are ignored.
pub(super) struct Plausible {
    /// Smallest plausible size.
    low: f64,
    /// Largest plausible size.
    high: f64,
    /// Typical size, to guess a unit.
    usual: f64,
    /// The unit of all three.
    unit: &'static Unit,
    /// Smallest and largest size that is accepted at all.
    accepted: [f64; 2],
}

/// Range from `low` to `high`, typical size and unit.
const fn plausible(low: f64, high: f64, usual: f64, unit: &'static Unit) -> Plausible {
    Plausible { low, high, usual, unit, accepted: [0.0, f64::INFINITY] }
}

/// Radii of bodies, from a microscope tip to a bearing ring.
pub(super) const RADIUS: Plausible = plausible(1e-8, 1.0, 1e-2, &METRE);
/// Crowned rollers are nearly straight along their axis.
pub(super) const LONGER_RADIUS: Plausible = plausible(1e-8, 100.0, 1e-2, &METRE);
/// Moduli, from rubber to diamond.
pub(super) const MODULUS: Plausible = plausible(1e6, 3e12, 2e11, &PASCAL);
/// Hertz pressures.
pub(super) const HERTZ_PRESSURE: Plausible = plausible(1e3, 3e10, 1e9, &PASCAL);
/// Loads, from a microscope to a rolling mill.
pub(super) const FORCE: Plausible = plausible(1e-9, 1e7, 50.0, &NEWTON);
/// Loads of line contacts.
pub(super) const FORCE_PER_LENGTH: Plausible = plausible(1e-9, 1e8, 1e5, &NEWTON_PER_METRE);
/// Entrainment speeds.
pub(super) const SPEED: Plausible = plausible(1e-9, 200.0, 0.3, &METRE_PER_SECOND);
/// Above 2 the surfaces move in opposite directions.
pub(super) const SLIDE_ROLL_RATIO: Plausible = plausible(0.0, 2.0, 0.1, &RATIO);
/// From boiling water to the heaviest gear oils at 40 degC.
pub(super) const VISCOSITY: Plausible = plausible(1e-4, 2.0, 0.01, &PASCAL_SECOND);
/// Viscosities including gases.
pub(super) const GAS_VISCOSITY: Plausible = plausible(5e-6, 2.0, 0.01, &PASCAL_SECOND);
/// Pressure-viscosity coefficients.
pub(super) const PRESSURE_VISCOSITY: Plausible =
    plausible(1e-10, 1e-7, 2e-8, &PER_PASCAL).accepted(0.0, 1e-5);
/// The constant `p_0` of Roelands' law.
pub(super) const ROELANDS_PRESSURE: Plausible = plausible(1e7, 2e9, 2e8, &PASCAL);
/// The index `z` of Roelands' law.
pub(super) const ROELANDS_INDEX: Plausible = plausible(0.05, 2.0, 0.6, &PURE).accepted(0.0, 5.0);
/// Constants of the law of Dowson and Higginson.
pub(super) const COMPRESSIBILITY: Plausible = plausible(0.0, 1e-8, 1e-9, &PER_PASCAL);
/// Supplied oil films.
pub(super) const FILM: Plausible = plausible(1e-10, 1e-4, 1e-7, &METRE);
/// Films between rigid surfaces.
pub(super) const GIVEN_FILM: Plausible = plausible(1e-9, 1e-2, 1e-5, &METRE);
/// Hardnesses, up to that of diamond.
pub(super) const HARDNESS: Plausible = plausible(1e6, 1.5e11, 6e9, &PASCAL);
/// Coefficients of friction.
pub(super) const FRICTION: Plausible = plausible(0.0, 2.0, 0.1, &RATIO).accepted(0.0, 10.0);
/// Shear stresses of fluids: limiting, and of Eyring.
pub(super) const STRESS: Plausible = plausible(1e4, 1e10, 5e7, &PASCAL);
/// Limiting shear stresses of fluids over their pressures.
pub(super) const STRESS_RATIO: Plausible = plausible(1e-3, 0.3, 0.06, &RATIO);
/// Yield strengths, from lead to whiskers.
pub(super) const STRENGTH: Plausible = plausible(1e6, 3e10, 1.5e9, &PASCAL);
/// Growth of the hardness over plastic depth.
pub(super) const HARDENING: Plausible = plausible(1e9, 1e19, 1e15, &PASCAL_PER_METRE);
/// Thicknesses of coatings, from a layer of molecules to a sleeve.
pub(super) const LAYER: Plausible = plausible(1e-9, 1e-2, 2e-6, &METRE);
/// Depths of stresses.
pub(super) const DEPTH: Plausible = plausible(1e-9, 0.1, 1e-4, &METRE);
/// Thicknesses of tribofilms.
pub(super) const TRIBOFILM: Plausible = plausible(1e-10, 1e-5, 1e-7, &METRE);
/// Archard's coefficients, up to that of bare metals without oil.
pub(super) const WEAR: Plausible = plausible(0.0, 0.02, 1e-6, &PURE).accepted(0.0, 1.0);
/// Worn volumes per frictional energy.
pub(super) const WEAR_PER_ENERGY: Plausible = plausible(0.0, 1e-9, 1e-16, &VOLUME_PER_ENERGY);
/// Factors of mechanical activation.
pub(super) const ACTIVATION: Plausible = plausible(1e-20, 1e-10, 4e-16, &PURE);
/// Removal rates of films.
pub(super) const REMOVAL: Plausible = plausible(0.0, 10.0, 1e-3, &PER_SECOND);
/// Activation volumes, from atoms to large molecules.
pub(super) const ACTIVATION_VOLUME: Plausible = plausible(1e-31, 1e-25, 1e-29, &VOLUME);
/// Up to 10 eV.
pub(super) const BARRIER: Plausible = plausible(1e-21, 1.6e-18, 1.3e-19, &JOULE);
/// Bulk temperatures, from arctic cold to softening steel.
pub(super) const TEMPERATURE: Plausible = plausible(200.0, 1500.0, 350.0, &KELVIN).accepted(100.0, 5000.0);
/// Temperatures of oils by their data sheets: viscosities are extrapolated from 40 and 100 degC, and oils decompose.
pub(super) const OIL_TEMPERATURE: Plausible =
    plausible(200.0, 523.15, 350.0, &KELVIN).accepted(100.0, 5000.0);
/// Conductivities of solids including diamond.
pub(super) const HEAT_CONDUCTIVITY: Plausible = plausible(0.01, 3000.0, 46.0, &CONDUCTIVITY);
/// Diffusivities of solids.
pub(super) const HEAT_DIFFUSIVITY: Plausible = plausible(1e-8, 3e-3, 1e-5, &DIFFUSIVITY);
/// Conductivities of fluids.
pub(super) const OIL_CONDUCTIVITY: Plausible = plausible(0.05, 1.0, 0.14, &CONDUCTIVITY);
/// Volumetric heat capacities of fluids.
pub(super) const OIL_HEAT_CAPACITY: Plausible = plausible(5e5, 1e7, 1.7e6, &HEAT_CAPACITY);
/// Radii of tracks.
pub(super) const TRACK_RADIUS: Plausible = plausible(1e-6, 1.0, 2e-2, &METRE);
/// Contact films: the size of molecules.
pub(super) const CONTACT_FILM: Plausible = plausible(1e-11, 1e-7, 1e-9, &METRE);
/// Residuals at convergence.
pub(super) const TOLERANCE: Plausible = plausible(1e-12, 1e-2, 1e-6, &PURE);

/// Heights of surfaces, including form and offset.
pub(super) const HEIGHT: Plausible = plausible(0.0, 0.1, 1e-7, &METRE);
/// Rq of a crystal face, the smallest of any surface \[m\].
const SMALLEST_RQ: f64 = 1e-11;
/// Largest Rq over the half-width of the contact.
const LARGEST_RQ: f64 = 0.1;

/// Rq from that of a crystal up to a tenth of the half-width \[m\] of the contact.
pub(super) fn rq_range(half_width: f64) -> Plausible {
    plausible(SMALLEST_RQ, LARGEST_RQ * half_width, 1e-7, &METRE)
}

/// Factor outside of the plausible range at which a value is rejected if another unit explains it.
const ABSURD: f64 = 100.0;

impl Plausible {
    /// The same with limits beyond which a value is refused also if no other unit explains it.
    const fn accepted(self, least: f64, most: f64) -> Self {
        Self { accepted: [least, most], ..self }
    }

    /// Error for a `value` so far out of its range that it is clearly in another unit, or meaningless.
    pub(super) fn reject_unit(&self, field: &str, value: f64) -> Result<(), InputError> {
        let size = value.abs();
        let beyond = size > ABSURD * self.high || ABSURD * size < self.low;
        let [least, most] = self.accepted;
        let is_refused = size > most || size < least || beyond && self.guess(value).is_some();
        if is_refused { self.refuse(field, value) } else { Ok(()) }
    }

    /// Error for a `value` out of its range.
    pub(super) fn refuse(&self, field: &str, value: f64) -> Result<(), InputError> {
        self.check(field, value).map_or(Ok(()), |Warning { message, remedy, .. }| {
            let field = format!("{field} = {}", short(value));
            Err(InputError::Conflict { field, reason: format!("{message}; {remedy}") })
        })
    }

    /// The warning about an implausible `value`; zero and NaN are input errors.
    pub(super) fn check(&self, field: &str, value: f64) -> Option<Warning> {
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

    /// The intended value of an implausible `value`: number, unit and value in the SI unit.
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
