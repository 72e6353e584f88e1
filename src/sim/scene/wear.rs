//! Wear: the laws of the crate by name.

#[cfg(feature = "serde")]
use super::tables::{keyed, required};
use crate::error::InputError;
use crate::wear::{Archard, FrictionalEnergy, WearLaw, WearPressure};

/// Wear by one of the laws of the crate.
///
/// # Examples
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::sim::scene::{ArchardSpec, WearSpec};
/// let spec = WearSpec::Archard(ArchardSpec { coefficient: 6e-8, film_coefficient: 6e-9, ..Default::default() });
/// let law = spec.law(6e9, Some(100e-9))?;
/// // k p u / H: 1e-17 1/Pa times 1 GPa times 0.1 m/s, bare and under a full film.
/// let at = SurfaceState::new(1e9, 300.0).with_sliding_speed(0.1);
/// assert!((law.depth_rate(&at, 0.0) / 1e-9 - 1.0).abs() < 1e-12);
/// assert!((law.depth_rate(&at, 100e-9) / 1e-10 - 1.0).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(tag = "law", rename_all = "snake_case", try_from = "WearTable")
)]
#[non_exhaustive]
pub enum WearSpec {
    /// In proportion to pressure and distance: [`Archard`].
    Archard(ArchardSpec),
    /// In proportion to the energy of friction: [`FrictionalEnergy`].
    FrictionalEnergy(FrictionalEnergySpec),
}

/// Constants of [`Archard`], with a film-dependent coefficient.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ArchardSpec {
    /// Dimensionless coefficient of the bare surface.
    pub coefficient: f64,
    /// Dimensionless coefficient under a film of full thickness.
    pub film_coefficient: f64,
    /// Hardness that divides the coefficient \[Pa\].
    pub hardness: f64,
    /// Hardness under a tribofilm of full thickness \[Pa\], the divisor falling linearly with the film;
    /// absent: constant.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub film_hardness: Option<f64>,
    /// Whether only solid pressure wears, or all pressure.
    pub solid_pressure_only: bool,
}

/// Constants of [`FrictionalEnergy`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FrictionalEnergySpec {
    /// Volume worn of the bare surface over the energy of friction \[m^3/J\].
    pub volume_per_energy: f64,
    /// That under a film of full thickness \[m^3/J\].
    pub film_volume_per_energy: f64,
}

impl Default for ArchardSpec {
    /// The constants of Azam et al. (2019), all pressure.
    fn default() -> Self {
        Self {
            coefficient: 5.45e-8,
            film_coefficient: 5.45e-9,
            hardness: 6e9,
            film_hardness: None,
            solid_pressure_only: false,
        }
    }
}

impl Default for WearSpec {
    /// The law and the constants of Azam et al. (2019).
    fn default() -> Self {
        Self::Archard(ArchardSpec::default())
    }
}

impl WearSpec {
    /// Hardness that the law divides by \[Pa\]; none for a law without.
    pub fn hardness(&self) -> Option<f64> {
        match self {
            Self::Archard(spec) => Some(spec.hardness),
            Self::FrictionalEnergy(_) => None,
        }
    }

    /// The law of a body of `hardness` \[Pa\], which laws without one pass over, under films whose full
    /// thickness is `film_thickness` \[m\]; none where there are no films.
    ///
    /// # Errors
    /// A constant out of range.
    pub fn law(&self, hardness: f64, film_thickness: Option<f64>) -> Result<Box<dyn WearLaw>, InputError> {
        // Without a film the reference thickness is never reached: any positive one will do.
        let full = film_thickness.unwrap_or(1.0);
        self.bare_law(hardness, full).map_err(|error| error.within("wear"))
    }

    /// The same under films of the `full` thickness \[m\]; errors name the law's constants alone.
    fn bare_law(&self, hardness: f64, full: f64) -> Result<Box<dyn WearLaw>, InputError> {
        Ok(match *self {
            Self::Archard(spec) => {
                let mut law = Archard::new(spec.coefficient, spec.film_coefficient, full, hardness)?;
                if let Some(film_hardness) = spec.film_hardness {
                    law = law.with_film_hardness(film_hardness)?;
                }
                let pressure =
                    if spec.solid_pressure_only { WearPressure::Solid } else { WearPressure::Total };
                Box::new(law.with_pressure(pressure))
            }
            Self::FrictionalEnergy(spec) => {
                Box::new(FrictionalEnergy::new(spec.volume_per_energy, spec.film_volume_per_energy, full)?)
            }
        })
    }

    /// Checks the constants as the law itself does.
    pub(in crate::sim) fn validate(&self) -> Result<(), InputError> {
        self.law(self.hardness().unwrap_or(1.0), None).map(|_| ())
    }
}

#[cfg(feature = "serde")]
keyed! {
    /// What a scene file holds.
    #[derive(serde::Deserialize)]
    struct WearTable {
        law: Option<LawName>;
        coefficient: f64,
        film_coefficient: f64,
        hardness: f64,
        film_hardness: f64,
        solid_pressure_only: bool,
        volume_per_energy: f64,
        film_volume_per_energy: f64,
    }
}

/// What `law` says.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize, Clone, Copy)]
#[serde(rename_all = "snake_case")]
enum LawName {
    Archard,
    FrictionalEnergy,
}

/// Keys of `law = "archard"`.
#[cfg(feature = "serde")]
const ARCHARD: [&str; 5] =
    ["coefficient", "film_coefficient", "hardness", "film_hardness", "solid_pressure_only"];
/// Keys of `law = "frictional_energy"`.
#[cfg(feature = "serde")]
const FRICTIONAL_ENERGY: [&str; 2] = ["volume_per_energy", "film_volume_per_energy"];

#[cfg(feature = "serde")]
impl TryFrom<WearTable> for WearSpec {
    type Error = String;

    fn try_from(table: WearTable) -> Result<Self, String> {
        match table.law.unwrap_or(LawName::Archard) {
            LawName::Archard => {
                table.refuse_strays("law = \"archard\"", &ARCHARD)?;
                let usual = ArchardSpec::default();
                Ok(Self::Archard(ArchardSpec {
                    coefficient: table.coefficient.unwrap_or(usual.coefficient),
                    film_coefficient: table.film_coefficient.unwrap_or(usual.film_coefficient),
                    hardness: table.hardness.unwrap_or(usual.hardness),
                    film_hardness: table.film_hardness,
                    solid_pressure_only: table.solid_pressure_only.unwrap_or(usual.solid_pressure_only),
                }))
            }
            LawName::FrictionalEnergy => {
                table.refuse_strays("law = \"frictional_energy\"", &FRICTIONAL_ENERGY)?;
                let bare = required("volume_per_energy", table.volume_per_energy)?;
                Ok(Self::FrictionalEnergy(FrictionalEnergySpec {
                    volume_per_energy: bare,
                    film_volume_per_energy: table.film_volume_per_energy.unwrap_or(bare),
                }))
            }
        }
    }
}
