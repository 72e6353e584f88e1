//! Dimensions of quantities.

/// Dimension of a quantity, which determines its valid units.
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
    /// In m^2/s: kinematic viscosities.
    KinematicViscosity,
    /// In kg/m^3.
    Density,
    /// In s.
    Time,
    /// In 1/s.
    Rate,
    /// In rad/s: rates of rotation.
    Rotation,
    /// In K.
    Temperature,
    /// In W/(m K).
    Conductivity,
    /// In m^2/s.
    Diffusivity,
    /// In J: activation energies, per molecule.
    Energy,
    /// In m^3: activation volumes.
    Volume,
    /// In m^3/J: wear per frictional energy.
    VolumePerEnergy,
    /// In rad.
    Angle,
    /// In J/(m^3 K): volumetric heat capacity.
    HeatCapacity,
    /// Dimensionless; its unit is per cent, or none.
    Ratio,
}

impl Dimension {
    /// Its name.
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
            Self::KinematicViscosity => "kinematic viscosity",
            Self::Density => "density",
            Self::Time => "time",
            Self::Rate => "one over time",
            Self::Rotation => "rate of rotation",
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
}
