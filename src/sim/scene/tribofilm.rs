//! Growth laws of a tribofilm by name.

use crate::error::InputError;
use crate::tribochem::{
    Activation, FilmGrowthLaw, Ghanbarzadeh, ProportionalRemoval, StressActivated, ThermalArrhenius,
};

/// Growth of a tribofilm by one of the laws of the crate.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{GhanbarzadehSpec, TribofilmSpec};
/// let thin = GhanbarzadehSpec { maximum_thickness: 50e-9, removal_limit: 10e-9, ..Default::default() };
/// let law = TribofilmSpec::Ghanbarzadeh(thin).law()?;
/// assert_eq!(law.maximum_thickness(), 50e-9);
/// let broken = TribofilmSpec::Ghanbarzadeh(GhanbarzadehSpec { x_tribo: -1.0, ..thin });
/// assert!(broken.law().unwrap_err().to_string().starts_with("tribofilm.x_tribo"));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(tag = "law", rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum TribofilmSpec {
    /// Growth and removal, two states: [`Ghanbarzadeh`].
    Ghanbarzadeh(GhanbarzadehSpec),
    /// Stress-activated growth: [`StressActivated`].
    StressActivated(StressActivatedSpec),
    /// Thermally activated growth: [`ThermalArrhenius`].
    ThermalArrhenius(ThermalArrheniusSpec),
    /// Growth by shear stress, removal in proportion to thickness: [`ProportionalRemoval`].
    ProportionalRemoval(ProportionalRemovalSpec),
}

/// Constants of [`Ghanbarzadeh`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct GhanbarzadehSpec {
    /// Limit thickness of growth without removal \[m\].
    pub maximum_thickness: f64,
    /// Mechanical activation factor.
    pub x_tribo: f64,
    /// Limit thickness of removal \[m\].
    pub removal_limit: f64,
    /// Rate of removal \[1/s\].
    pub removal_rate: f64,
    /// Nodes that grow and lose film.
    pub activation: Activation,
}

/// Constants of [`StressActivated`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(from = "StressActivatedTable")
)]
pub struct StressActivatedSpec {
    /// Limit thickness of growth \[m\].
    pub maximum_thickness: f64,
    /// Pre-exponential rate constant \[1/s\].
    pub prefactor: f64,
    /// Activation energy \[J\].
    pub activation_energy: f64,
    /// Activation volume \[m^3\].
    pub activation_volume: f64,
    /// Activating stress.
    pub stress: DrivingStress,
    /// Nodes that grow film.
    pub activation: Activation,
}

/// Activating stress of [`StressActivated`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum DrivingStress {
    /// Shear stress of contact and fluid.
    Shear,
    /// Pressure.
    Normal,
}

/// Constants of [`ThermalArrhenius`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct ThermalArrheniusSpec {
    /// Limit thickness of growth \[m\].
    pub maximum_thickness: f64,
    /// Pre-exponential rate constant \[1/s\].
    pub prefactor: f64,
    /// Activation energy \[J\].
    pub activation_energy: f64,
    /// Nodes that grow film.
    #[cfg_attr(feature = "serde", serde(default))]
    pub activation: Activation,
}

/// Constants of [`ProportionalRemoval`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct ProportionalRemovalSpec {
    /// Largest thickness \[m\].
    pub maximum_thickness: f64,
    /// Pre-exponential growth rate \[m/s\].
    pub growth_rate: f64,
    /// Activation energy \[J\].
    pub activation_energy: f64,
    /// Activation volume of the shear stress \[m^3\].
    pub activation_volume: f64,
    /// Rate of removal \[1/s\].
    pub removal_rate: f64,
    /// Nodes that grow and lose film.
    #[cfg_attr(feature = "serde", serde(default = "by_shear_stress"))]
    pub activation: Activation,
}

impl Default for GhanbarzadehSpec {
    /// The constants of Azam et al. (2019).
    fn default() -> Self {
        Self {
            maximum_thickness: 200e-9,
            x_tribo: 1.66e-16,
            removal_limit: 54.32e-9,
            removal_rate: 4.022e-4,
            activation: Activation::SolidContact,
        }
    }
}

impl Default for TribofilmSpec {
    /// The law and the constants of Azam et al. (2019).
    fn default() -> Self {
        Self::Ghanbarzadeh(GhanbarzadehSpec::default())
    }
}

impl TribofilmSpec {
    /// Limit thickness of growth, or largest thickness \[m\].
    pub fn maximum_thickness(&self) -> f64 {
        match self {
            Self::Ghanbarzadeh(spec) => spec.maximum_thickness,
            Self::StressActivated(spec) => spec.maximum_thickness,
            Self::ThermalArrhenius(spec) => spec.maximum_thickness,
            Self::ProportionalRemoval(spec) => spec.maximum_thickness,
        }
    }

    /// The law.
    ///
    /// # Errors
    /// A constant out of range.
    pub fn law(&self) -> Result<Box<dyn FilmGrowthLaw>, InputError> {
        self.bare_law().map_err(|error| error.within("tribofilm"))
    }

    /// The law; errors name its constants only.
    fn bare_law(&self) -> Result<Box<dyn FilmGrowthLaw>, InputError> {
        Ok(match *self {
            Self::Ghanbarzadeh(spec) => {
                let GhanbarzadehSpec { maximum_thickness, x_tribo, removal_limit, removal_rate, activation } =
                    spec;
                let law = Ghanbarzadeh::new(maximum_thickness, x_tribo, removal_limit, removal_rate)?;
                Box::new(law.with_activation(activation))
            }
            Self::StressActivated(spec) => {
                let by = match spec.stress {
                    DrivingStress::Shear => StressActivated::by_shear_stress,
                    DrivingStress::Normal => StressActivated::by_normal_stress,
                };
                let law = by(
                    spec.maximum_thickness,
                    spec.prefactor,
                    spec.activation_energy,
                    spec.activation_volume,
                )?;
                Box::new(law.with_activation(spec.activation))
            }
            Self::ThermalArrhenius(spec) => {
                let law =
                    ThermalArrhenius::new(spec.maximum_thickness, spec.prefactor, spec.activation_energy)?;
                Box::new(law.with_activation(spec.activation))
            }
            Self::ProportionalRemoval(spec) => {
                let law = ProportionalRemoval::new(
                    spec.maximum_thickness,
                    spec.growth_rate,
                    spec.activation_energy,
                    spec.activation_volume,
                    spec.removal_rate,
                )?;
                Box::new(law.with_activation(spec.activation))
            }
        })
    }
}

/// Value of `law` of a table without it.
#[cfg(feature = "serde")]
pub(super) const DEFAULT_LAW: &str = "ghanbarzadeh";

/// Default of `activation` of a law by the shear stress.
#[cfg(feature = "serde")]
fn by_shear_stress() -> Activation {
    Activation::ShearStress
}

/// `law = "stress_activated"` as written: the nodes that grow follow from the stress.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct StressActivatedTable {
    maximum_thickness: f64,
    prefactor: f64,
    activation_energy: f64,
    activation_volume: f64,
    stress: DrivingStress,
    activation: Option<Activation>,
}

#[cfg(feature = "serde")]
impl From<StressActivatedTable> for StressActivatedSpec {
    fn from(table: StressActivatedTable) -> Self {
        let StressActivatedTable { maximum_thickness, prefactor, stress, .. } = table;
        let StressActivatedTable { activation_energy, activation_volume, .. } = table;
        let activation = table.activation.unwrap_or(match stress {
            DrivingStress::Shear => Activation::ShearStress,
            DrivingStress::Normal => Activation::SolidContact,
        });
        Self { maximum_thickness, prefactor, activation_energy, activation_volume, stress, activation }
    }
}
