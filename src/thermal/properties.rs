//! Thermal properties of a fluid.

use crate::error::InputError;

/// Upper bound of the expansivity of liquids \[1/K\].
const LARGEST_EXPANSIVITY: f64 = 0.01;

/// Thermal properties of a lubricant, independent of pressure and temperature.
///
/// The conductivity of mineral oils is 0.12 to 0.15 W/(m K) at ambient pressure and about twice that at 1
/// GPa; use the value at the contact pressure.
///
/// # Examples
///
/// ```
/// use stribeck::thermal::{FilmProfile, FilmThermal};
/// let oil = FilmThermal::default().with_profile(FilmProfile::Collocation);
/// assert_eq!(oil.conductivity, 0.14);
/// assert!(FilmThermal::new(-0.1, 1.7e6, 6.5e-4).is_err());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct FilmThermal {
    /// Thermal conductivity `k` \[W/(m K)\].
    pub conductivity: f64,
    /// Volumetric heat capacity `rho c` \[J/(m^3 K)\].
    pub heat_capacity: f64,
    /// Volumetric thermal expansivity `a_V` \[1/K\], for heat of compression and film density.
    pub expansivity: f64,
    /// Model of the temperature profile across the film.
    pub profile: super::FilmProfile,
}

impl FilmThermal {
    /// Properties with the parabolic profile.
    ///
    /// # Errors
    /// The errors of [`validate`](Self::validate).
    pub fn new(conductivity: f64, heat_capacity: f64, expansivity: f64) -> Result<Self, InputError> {
        let profile = super::FilmProfile::default();
        let properties = Self { conductivity, heat_capacity, expansivity, profile };
        properties.validate().map(|()| properties)
    }

    /// The same properties with `profile`.
    #[must_use]
    pub fn with_profile(mut self, profile: super::FilmProfile) -> Self {
        self.profile = profile;
        self
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// A conductivity that is not finite and positive, a heat capacity that is negative or not finite, an
    /// expansivity outside 0 to 0.01.
    pub fn validate(&self) -> Result<(), InputError> {
        InputError::require_positive("conductivity", self.conductivity)?;
        InputError::require_non_negative("heat_capacity", self.heat_capacity)?;
        let is_possible = (0.0..=LARGEST_EXPANSIVITY).contains(&self.expansivity);
        InputError::require(is_possible, "expansivity", self.expansivity, "from 0 to 0.01")
    }
}

impl Default for FilmThermal {
    /// A mineral oil at ambient pressure: 0.14 W/(m K), 1.7 MJ/(m^3 K), 6.5e-4 1/K.
    fn default() -> Self {
        Self {
            conductivity: 0.14,
            heat_capacity: 1.7e6,
            expansivity: 6.5e-4,
            profile: super::FilmProfile::default(),
        }
    }
}
