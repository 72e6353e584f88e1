//! Quantities as people write them: a number and a unit, `9.525 mm` or `14.9 1/GPa`.
//!
//! Scene files and options of the command take such text where a quantity has a [`Dimension`]; all that is
//! behind them is in SI units. A power of ten moves the decimal exponent of the
//! text, so that `9.525 mm` and `9.525e-3` are the same double. A new unit is an entry in a table here, a new
//! dimension a variant, its table and its name.

use crate::error::{InputError, quoted};

/// What a quantity measures, and with it the units that do for it.
///
/// ```
/// use stribeck::units::Dimension;
/// assert_eq!(Dimension::Length.parse("radius", "9.525 mm")?, 9.525e-3);
/// assert_eq!(Dimension::Temperature.parse("temperature", "80 degC")?, 353.15);
/// let error = Dimension::Length.parse("radius", "9.5 kg").unwrap_err();
/// assert_eq!(error.to_string(), "radius = \"9.5 kg\": `kg` is no unit of length; m, cm, mm, um, nm or in would do");
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Dimension {
    /// In m.
    Length,
    /// In Pa.
    Pressure,
    /// In 1/Pa: pressure-viscosity coefficients, constants of the density.
    InversePressure,
    /// In Pa/m: hardening.
    PressurePerLength,
    /// In N.
    Force,
    /// In N/m: load of a line contact.
    ForcePerLength,
    /// In m/s.
    Speed,
    /// In Pa s.
    Viscosity,
    /// In s.
    Time,
    /// In 1/s.
    Rate,
    /// In K.
    Temperature,
    /// In W/(m K).
    Conductivity,
    /// In m^2/s.
    Diffusivity,
    /// In J: barriers of reactions, per molecule.
    Energy,
    /// In m^3: activation volumes.
    Volume,
    /// In m^3/J: wear per energy of friction.
    VolumePerEnergy,
    /// In rad.
    Angle,
    /// In J/(m^3 K): heat capacity of a volume.
    HeatCapacity,
    /// A part of something: its unit is per cent, without one it is a number.
    Ratio,
}

/// How a number in a unit becomes one in SI units.
#[derive(Debug, Clone, Copy)]
enum Scale {
    /// Times this power of ten, in decimal digits, so that `9.525 mm` is `9.525e-3` to the last bit.
    Ten(i32),
    /// Times this factor.
    Times(f64),
    /// Plus this zero of the scale.
    Plus(f64),
}
use Scale::{Plus, Ten, Times};

/// Units of one dimension: the first of each line is what messages offer, the others are spellings of it.
type Units = &'static [(&'static [&'static str], Scale)];

/// Lengths.
const LENGTH: Units = &[
    (&["m"], Ten(0)),
    (&["cm"], Ten(-2)),
    (&["mm"], Ten(-3)),
    (&["um", "micron", "microns"], Ten(-6)),
    (&["nm"], Ten(-9)),
    (&["in", "inch"], Times(25.4e-3)),
];
/// Pressures, stresses, moduli and hardnesses.
const PRESSURE: Units = &[
    (&["Pa", "N/m^2"], Ten(0)),
    (&["kPa"], Ten(3)),
    (&["MPa", "N/mm^2"], Ten(6)),
    (&["GPa"], Ten(9)),
    (&["bar"], Ten(5)),
];
/// Inverse pressures.
const INVERSE_PRESSURE: Units = &[
    (&["1/Pa", "Pa^-1", "m^2/N"], Ten(0)),
    (&["1/MPa", "MPa^-1", "mm^2/N"], Ten(-6)),
    (&["1/GPa", "GPa^-1"], Ten(-9)),
];
/// Pressures per depth.
const PRESSURE_PER_LENGTH: Units =
    &[(&["Pa/m"], Ten(0)), (&["GPa/mm"], Ten(12)), (&["MPa/um"], Ten(12)), (&["GPa/um"], Ten(15))];
/// Forces.
const FORCE: Units = &[(&["N"], Ten(0)), (&["mN"], Ten(-3)), (&["kN"], Ten(3))];
/// Forces per metre of a line contact.
const FORCE_PER_LENGTH: Units =
    &[(&["N/m"], Ten(0)), (&["kN/m"], Ten(3)), (&["N/mm"], Ten(3)), (&["kN/mm", "MN/m"], Ten(6))];
/// Speeds.
const SPEED: Units = &[
    (&["m/s"], Ten(0)),
    (&["cm/s"], Ten(-2)),
    (&["mm/s"], Ten(-3)),
    (&["um/s"], Ten(-6)),
    (&["nm/s"], Ten(-9)),
    (&["km/h"], Times(1.0 / 3.6)),
];
/// Dynamic viscosities.
const VISCOSITY: Units =
    &[(&["Pa s", "Pas"], Ten(0)), (&["mPa s", "mPas"], Ten(-3)), (&["cP", "cp"], Ten(-3)), (&["P"], Ten(-1))];
/// Times.
const TIME: Units = &[
    (&["s"], Ten(0)),
    (&["ms"], Ten(-3)),
    (&["us"], Ten(-6)),
    (&["min"], Times(60.0)),
    (&["h"], Times(3600.0)),
    (&["d"], Times(86_400.0)),
];
/// Inverse times.
const RATE: Units = &[
    (&["1/s", "s^-1"], Ten(0)),
    (&["1/min", "min^-1"], Times(1.0 / 60.0)),
    (&["1/h", "h^-1"], Times(1.0 / 3600.0)),
];
/// Absolute temperatures; differences of temperature are given in kelvin.
const TEMPERATURE: Units = &[(&["K"], Ten(0)), (&["degC", "C"], Plus(273.15))];
/// Thermal conductivities.
const CONDUCTIVITY: Units = &[(&["W/(m K)", "W/m/K", "W/mK"], Ten(0))];
/// Thermal diffusivities.
const DIFFUSIVITY: Units =
    &[(&["m^2/s", "m2/s"], Ten(0)), (&["cm^2/s", "cm2/s"], Ten(-4)), (&["mm^2/s", "mm2/s"], Ten(-6))];
/// Energies of one molecule; `kJ/mol` is divided by Avogadro's number.
const ENERGY: Units = &[
    (&["J"], Ten(0)),
    (&["eV"], Times(1.602176634e-19)),
    // Per mole, over Avogadro's number.
    (&["kJ/mol"], Times(1e3 / 6.02214076e23)),
];
/// Volumes.
const VOLUME: Units = &[(&["m^3", "m3"], Ten(0)), (&["nm^3", "nm3"], Ten(-27)), (&["A^3", "A3"], Ten(-30))];
/// Volumes per energy.
const VOLUME_PER_ENERGY: Units =
    &[(&["m^3/J", "m3/J"], Ten(0)), (&["mm^3/J", "mm3/J"], Ten(-9)), (&["um^3/J", "um3/J"], Ten(-18))];
/// Angles.
const ANGLE: Units = &[(&["rad"], Ten(0)), (&["deg"], Times(std::f64::consts::PI / 180.0))];
/// Heat capacities of a volume.
const HEAT_CAPACITY: Units =
    &[(&["J/(m^3 K)", "J/m^3/K"], Ten(0)), (&["kJ/(m^3 K)"], Ten(3)), (&["MJ/(m^3 K)"], Ten(6))];
/// Ratios.
const RATIO: Units = &[(&["%"], Ten(-2))];

impl Dimension {
    /// The name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "length",
            Self::Pressure => "pressure",
            Self::InversePressure => "one over pressure",
            Self::PressurePerLength => "pressure per length",
            Self::Force => "force",
            Self::ForcePerLength => "force per length",
            Self::Speed => "speed",
            Self::Viscosity => "viscosity",
            Self::Time => "time",
            Self::Rate => "one over time",
            Self::Temperature => "temperature",
            Self::Conductivity => "thermal conductivity",
            Self::Diffusivity => "diffusivity",
            Self::Energy => "energy",
            Self::Volume => "volume",
            Self::VolumePerEnergy => "volume per energy",
            Self::Angle => "angle",
            Self::HeatCapacity => "heat capacity of a volume",
            Self::Ratio => "ratio",
        }
    }

    /// The table of its units, the SI one first.
    fn units(self) -> Units {
        match self {
            Self::Length => LENGTH,
            Self::Pressure => PRESSURE,
            Self::InversePressure => INVERSE_PRESSURE,
            Self::PressurePerLength => PRESSURE_PER_LENGTH,
            Self::Force => FORCE,
            Self::ForcePerLength => FORCE_PER_LENGTH,
            Self::Speed => SPEED,
            Self::Viscosity => VISCOSITY,
            Self::Time => TIME,
            Self::Rate => RATE,
            Self::Temperature => TEMPERATURE,
            Self::Conductivity => CONDUCTIVITY,
            Self::Diffusivity => DIFFUSIVITY,
            Self::Energy => ENERGY,
            Self::Volume => VOLUME,
            Self::VolumePerEnergy => VOLUME_PER_ENERGY,
            Self::Angle => ANGLE,
            Self::HeatCapacity => HEAT_CAPACITY,
            Self::Ratio => RATIO,
        }
    }

    /// The units that do, the SI one first; other spellings of them (`µm`, `°C`, `Pa*s`, `GPa^-1`) do too.
    pub fn unit_names(self) -> impl Iterator<Item = &'static str> {
        self.units().iter().filter_map(|(names, _)| names.first().copied())
    }

    /// The value of `text`, a number and a unit, in SI units; a space between them may be left out. `field`
    /// is for the error.
    ///
    /// # Errors
    /// Text that is no number and unit, a unit of something else, no unit.
    pub fn parse(self, field: &str, text: &str) -> Result<f64, InputError> {
        let refused = |reason: String| InputError::Conflict {
            field: format!("{field} = \"{}\"", quoted(text)),
            reason,
        };
        let Some((number, unit)) = split(text) else {
            return Err(refused(format!(
                "must be a number, alone or with a unit of {}: {}",
                self.name(),
                self.offer()
            )));
        };
        if unit.is_empty() {
            return Err(refused(format!("the unit is missing: {}", self.offer())));
        }
        let plain = plain(unit);
        let known = self.units().iter().find(|(names, _)| names.contains(&plain.as_str()));
        let Some((_, scale)) = known else {
            return Err(refused(format!(
                "`{}` is no unit of {}; {}",
                quoted(unit),
                self.name(),
                self.offer()
            )));
        };
        let value = match *scale {
            Ten(power) => times_power_of_ten(number, power),
            Times(factor) => number.parse().ok().map(|number: f64| number * factor),
            Plus(zero) => number.parse().ok().map(|number: f64| number + zero),
        };
        value
            .filter(|value| value.is_finite())
            .ok_or_else(|| refused("is beyond the range of numbers".into()))
    }

    /// The units that do, for messages: `m, cm or mm would do`.
    fn offer(self) -> String {
        let names: Vec<&str> = self.unit_names().collect();
        match names.as_slice() {
            [] => String::new(),
            [only] => format!("{only} would do"),
            [first @ .., last] => format!("{} or {last} would do", first.join(", ")),
        }
    }
}

/// Number and unit of `text`; none where it does not begin with a number.
fn split(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    if !text.starts_with(|c: char| c.is_ascii_digit() || ['+', '-', '.'].contains(&c)) {
        return None;
    }
    // No number is longer than its digits, signs and exponent.
    let longest = text.find(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c))).unwrap_or(text.len());
    let end = (1..=longest).rev().find(|end| text[..*end].parse::<f64>().is_ok())?;
    Some((&text[..end], text[end..].trim()))
}

/// The spelling of `unit` that the tables have.
fn plain(unit: &str) -> String {
    let mut plain = unit.replace(['\u{b5}', '\u{3bc}'], "u").replace('\u{b0}', "deg");
    plain = plain
        .replace(['*', '\u{b7}'], " ")
        .replace('\u{b2}', "^2")
        .replace('\u{b3}', "^3")
        .replace("\u{207b}\u{b9}", "^-1");
    plain.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The number with `power` added to its exponent, correctly rounded.
fn times_power_of_ten(number: &str, power: i32) -> Option<f64> {
    let (digits, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent = exponent.parse::<i32>().ok()?.checked_add(power)?;
    format!("{digits}e{exponent}").parse().ok()
}
