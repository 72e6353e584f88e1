//! The units of each dimension. Messages offer the first of a line; the others are alternative spellings in the form of
//! [`plain`](super::spelling::plain).

use super::dimension::Dimension;

/// Conversion of a number to SI units.
#[derive(Debug, Clone, Copy)]
pub(super) enum Scale {
    /// Multiplication by this power of ten in decimal digits, so that `9.525 mm` is exactly `9.525e-3`.
    Ten(i32),
    /// Multiplication by this factor.
    Times(f64),
    /// Addition of this offset.
    Plus(f64),
}
use Scale::{Plus, Ten, Times};

/// Units of one dimension: messages offer the first of each line; the others are alternative spellings.
pub(super) type Units = &'static [(&'static [&'static str], Scale)];

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
const VISCOSITY: Units = &[
    (&["Pa s", "Pas", "Pa-s", "N s/m^2"], Ten(0)),
    (&["mPa s", "mPas", "mPa-s", "mN s/m^2"], Ten(-3)),
    (&["cP", "cp"], Ten(-3)),
    (&["P"], Ten(-1)),
];
/// Kinematic viscosities.
const KINEMATIC_VISCOSITY: Units = &[
    (&["m^2/s"], Ten(0)),
    (&["mm^2/s"], Ten(-6)),
    (&["cSt"], Ten(-6)),
    (&["cm^2/s"], Ten(-4)),
    (&["St"], Ten(-4)),
];
/// Densities.
const DENSITY: Units = &[
    (&["kg/m^3"], Ten(0)),
    (&["g/cm^3", "kg/l", "kg/L", "g/ml", "g/mL", "kg/dm^3", "t/m^3"], Ten(3)),
    (&["g/l", "g/L"], Ten(0)),
];
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
/// Rates of rotation.
const ROTATION: Units =
    &[(&["rad/s"], Ten(0)), (&["rpm", "1/min", "r/min", "rev/min"], Times(std::f64::consts::TAU / 60.0))];
/// Absolute temperatures; give temperature differences in kelvin.
const TEMPERATURE: Units = &[(&["K"], Ten(0)), (&["degC", "deg C", "C", "Celsius"], Plus(273.15))];
/// Thermal conductivities.
const CONDUCTIVITY: Units = &[(&["W/(m K)", "W/m/K", "W/mK"], Ten(0))];
/// Thermal diffusivities.
const DIFFUSIVITY: Units = &[(&["m^2/s"], Ten(0)), (&["cm^2/s"], Ten(-4)), (&["mm^2/s"], Ten(-6))];
/// Energies of one molecule; `kJ/mol` is divided by Avogadro's number.
const ENERGY: Units = &[
    (&["J"], Ten(0)),
    (&["eV"], Times(1.602176634e-19)),
    // Per mole, over Avogadro's number.
    (&["kJ/mol"], Times(1e3 / 6.02214076e23)),
];
/// Volumes.
const VOLUME: Units = &[(&["m^3"], Ten(0)), (&["nm^3"], Ten(-27)), (&["A^3"], Ten(-30))];
/// Volumes per energy.
const VOLUME_PER_ENERGY: Units = &[(&["m^3/J"], Ten(0)), (&["mm^3/J"], Ten(-9)), (&["um^3/J"], Ten(-18))];
/// Angles.
const ANGLE: Units = &[(&["rad"], Ten(0)), (&["deg"], Times(std::f64::consts::PI / 180.0))];
/// Volumetric heat capacities.
const HEAT_CAPACITY: Units =
    &[(&["J/(m^3 K)", "J/m^3/K"], Ten(0)), (&["kJ/(m^3 K)"], Ten(3)), (&["MJ/(m^3 K)"], Ten(6))];
/// Ratios.
const RATIO: Units = &[(&["%"], Ten(-2))];

impl Dimension {
    /// The table of units, the SI one first.
    pub(super) fn units(self) -> Units {
        match self {
            Self::Length => LENGTH,
            Self::Pressure => PRESSURE,
            Self::InversePressure => INVERSE_PRESSURE,
            Self::PressurePerLength => PRESSURE_PER_LENGTH,
            Self::Force => FORCE,
            Self::ForcePerLength => FORCE_PER_LENGTH,
            Self::Speed => SPEED,
            Self::Viscosity => VISCOSITY,
            Self::KinematicViscosity => KINEMATIC_VISCOSITY,
            Self::Density => DENSITY,
            Self::Time => TIME,
            Self::Rate => RATE,
            Self::Rotation => ROTATION,
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
}
