//! Wear: laws by name, wear pressure and exposure.

use super::track::Exposure;
use crate::error::InputError;
use crate::wear::{Archard, FrictionalEnergy, WearLaw, WearPressure};
use crate::with_fields::with_fields;

/// Wear of both bodies: a law, the pressure that causes it, and the exposure of a point of the track.
///
/// # Examples
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::sim::scene::{ArchardSpec, Exposure, WearLawSpec, WearSpec};
/// let archard = ArchardSpec { coefficient: 6e-8, film_coefficient: 6e-9, ..Default::default() };
/// let law = WearSpec::new(WearLawSpec::Archard(archard), Exposure::Track).law(6e9, Some(100e-9))?;
/// // k p u / H: 1e-17 1/Pa times 1 GPa of solid contact times 0.1 m/s, bare and under a film of full thickness.
/// let at = SurfaceState::new(1e9, 300.0).with_solid_pressure(1e9).with_sliding_speed(0.1);
/// assert!((law.depth_rate(&at, 0.0) / 1e-9 - 1.0).abs() < 1e-12);
/// assert!((law.depth_rate(&at, 100e-9) / 1e-10 - 1.0).abs() < 1e-9);
/// assert_eq!(law.depth_rate(&at.with_solid_pressure(0.0), 0.0), 0.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct WearSpec {
    /// The law and its constants.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub law: WearLawSpec,
    /// The pressure that causes wear.
    #[cfg_attr(feature = "serde", serde(default))]
    pub pressure: WearPressure,
    /// Exposure of a point of the track to wear. It belongs to the constants of the law and has no default.
    pub exposure: Exposure,
}

/// Laws of wear by name.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{ArchardSpec, FrictionalEnergySpec, WearLawSpec};
/// assert_eq!(WearLawSpec::Archard(ArchardSpec::default()).hardness(), Some(6e9));
/// let energy = FrictionalEnergySpec { volume_per_energy: 1e-16, film_volume_per_energy: 1e-17 };
/// assert_eq!(WearLawSpec::FrictionalEnergy(energy).hardness(), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(tag = "law", rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum WearLawSpec {
    /// Proportional to pressure and sliding distance: [`Archard`].
    Archard(ArchardSpec),
    /// Proportional to frictional energy: [`FrictionalEnergy`].
    FrictionalEnergy(FrictionalEnergySpec),
}

/// Constants of [`Archard`], with a film-dependent coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct ArchardSpec {
    /// Dimensionless coefficient of the bare surface.
    pub coefficient: f64,
    /// Dimensionless coefficient under a film of full thickness.
    pub film_coefficient: f64,
    /// Hardness in the denominator \[Pa\].
    pub hardness: f64,
    /// Hardness under a tribofilm of full thickness \[Pa\], linear in the film thickness; absent: constant
    /// hardness.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub film_hardness: Option<f64>,
}

/// Constants of [`FrictionalEnergy`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "FrictionalEnergyTable")
)]
pub struct FrictionalEnergySpec {
    /// Worn volume of the bare surface per frictional energy \[m^3/J\].
    pub volume_per_energy: f64,
    /// The same under a film of full thickness \[m^3/J\].
    pub film_volume_per_energy: f64,
}

impl Default for ArchardSpec {
    /// The constants of Azam et al. (2019).
    fn default() -> Self {
        Self { coefficient: 5.45e-8, film_coefficient: 5.45e-9, hardness: 6e9, film_hardness: None }
    }
}

impl WearLawSpec {
    /// Hardness in the denominator of the law \[Pa\]; `None` for a law without hardness.
    pub fn hardness(&self) -> Option<f64> {
        match self {
            Self::Archard(spec) => Some(spec.hardness),
            Self::FrictionalEnergy(_) => None,
        }
    }
}

impl WearSpec {
    /// Wear by `law` under the solid pressure.
    pub const fn new(law: WearLawSpec, exposure: Exposure) -> Self {
        Self { law, pressure: WearPressure::Solid, exposure }
    }

    /// The choices of Azam et al. (2019): their constants, total pressure, time of the test.
    pub fn azam_2019() -> Self {
        Self::new(WearLawSpec::Archard(ArchardSpec::default()), Exposure::ContactClock)
            .with_pressure(WearPressure::Total)
    }

    /// The law for a body of `hardness` \[Pa\] (ignored by laws without hardness) under films of full thickness
    /// `film_thickness` \[m\]; `None` for no films.
    ///
    /// # Errors
    /// A constant out of range.
    pub fn law(&self, hardness: f64, film_thickness: Option<f64>) -> Result<Box<dyn WearLaw>, InputError> {
        // Without a film the reference thickness is never reached: any positive value works.
        let full = film_thickness.unwrap_or(1.0);
        self.bare_law(hardness, full).map_err(|error| error.within("wear"))
    }

    /// The law under films of the `full` thickness \[m\]; errors name its constants only.
    fn bare_law(&self, hardness: f64, full: f64) -> Result<Box<dyn WearLaw>, InputError> {
        Ok(match self.law {
            WearLawSpec::Archard(spec) => {
                let mut law = Archard::new(spec.coefficient, spec.film_coefficient, full, hardness)?;
                if let Some(film_hardness) = spec.film_hardness {
                    law = law.with_film_hardness(film_hardness)?;
                }
                Box::new(law.with_pressure(self.pressure))
            }
            WearLawSpec::FrictionalEnergy(spec) => {
                let law = FrictionalEnergy::new(spec.volume_per_energy, spec.film_volume_per_energy, full)?;
                Box::new(law.with_pressure(self.pressure))
            }
        })
    }

    /// Checks the constants by building the law.
    pub(in crate::sim) fn validate(&self) -> Result<(), InputError> {
        self.law(self.law.hardness().unwrap_or(1.0), None).map(|_| ())
    }
}

with_fields!(WearSpec {
    with_law law: WearLawSpec,
    with_pressure pressure: WearPressure,
    with_exposure exposure: Exposure,
});

/// Value of `law` of a table without it.
#[cfg(feature = "serde")]
pub(super) const DEFAULT_LAW: &str = "archard";

/// `law = "frictional_energy"` as written: a film wears as the bare surface if it has no value of its own.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct FrictionalEnergyTable {
    volume_per_energy: f64,
    film_volume_per_energy: Option<f64>,
}

#[cfg(feature = "serde")]
impl From<FrictionalEnergyTable> for FrictionalEnergySpec {
    fn from(
        FrictionalEnergyTable { volume_per_energy, film_volume_per_energy }: FrictionalEnergyTable,
    ) -> Self {
        let film_volume_per_energy = film_volume_per_energy.unwrap_or(volume_per_energy);
        Self { volume_per_energy, film_volume_per_energy }
    }
}
