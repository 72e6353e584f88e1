//! Plasticity, friction and heat.

use crate::error::InputError;
use crate::lubricant::Rheology;
use crate::reynolds::ShearThinning;
use crate::with_fields::with_fields;

/// Pressure limit.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::PlasticSpec;
/// let steel = PlasticSpec::new(6e9).with_film_hardness(Some(2e9));
/// assert!(steel.hardening_modulus.is_none());
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
#[non_exhaustive]
pub struct PlasticSpec {
    /// Hardness of the substrate \[Pa\].
    pub hardness: f64,
    /// Hardness of a tribofilm of full thickness \[Pa\]; the limit falls linearly with the film.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub film_hardness: Option<f64>,
    /// Growth of the hardness with the plastic depth \[Pa/m\] in a history; absent: perfectly plastic.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub hardening_modulus: Option<f64>,
}

impl PlasticSpec {
    /// Elastic and perfectly plastic at `hardness` \[Pa\].
    pub const fn new(hardness: f64) -> Self {
        Self { hardness, film_hardness: None, hardening_modulus: None }
    }
}

with_fields!(PlasticSpec {
    with_hardness hardness: f64,
    with_film_hardness film_hardness: Option<f64>,
    with_hardening_modulus hardening_modulus: Option<f64>,
});

/// Friction of solid contact and of the fluid.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::FrictionSpec;
/// let spec = FrictionSpec::default().with_eyring_stress(Some(5e6));
/// // The stress of Eyring's fluid grows with the logarithm of the shear rate: 1 Pa s at 1e8 1/s.
/// let stress = spec.rheology()?.shear_stress(1.0, 1e8);
/// assert!((stress / (5e6 * 20.0_f64.asinh()) - 1.0).abs() < 1e-12);
/// // Carreau's law needs both constants.
/// assert!(FrictionSpec::default().with_carreau_stress(Some(5e6)).rheology().is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct FrictionSpec {
    /// Boundary friction coefficient; of bare surfaces if `film_coefficient` is given.
    pub boundary_coefficient: f64,
    /// Boundary friction coefficient of surfaces covered by a tribofilm; default: that of bare ones. See
    /// [`FilmFriction`](crate::FilmFriction).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub film_coefficient: Option<f64>,
    /// Total tribofilm thickness of both bodies \[m\] at which they count as covered; default:
    /// `tribofilm.maximum_thickness`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub covering_thickness: Option<f64>,
    /// Limiting shear stress of the fluid \[Pa\].
    pub limiting_shear_stress: f64,
    /// Eyring stress of the fluid \[Pa\]; absent for a Newtonian fluid.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub eyring_stress: Option<f64>,
    /// Stress \[Pa\] at the onset of Carreau's shear thinning; with `carreau_exponent`, in place of
    /// `eyring_stress`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub carreau_stress: Option<f64>,
    /// Exponent of Carreau's shear thinning.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub carreau_exponent: Option<f64>,
    /// Limiting shear stress over pressure, in place of `limiting_shear_stress`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub limiting_stress_coefficient: Option<f64>,
    /// Shear-thinned viscosity of the pressure flow; absent: Newtonian viscosity.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub flow_thinning: Option<FlowThinning>,
}

with_fields!(FrictionSpec {
    with_boundary_coefficient boundary_coefficient: f64,
    with_film_coefficient film_coefficient: Option<f64>,
    with_covering_thickness covering_thickness: Option<f64>,
    with_limiting_shear_stress limiting_shear_stress: f64,
    with_eyring_stress eyring_stress: Option<f64>,
    with_carreau_stress carreau_stress: Option<f64>,
    with_carreau_exponent carreau_exponent: Option<f64>,
    with_limiting_stress_coefficient limiting_stress_coefficient: Option<f64>,
    with_flow_thinning flow_thinning: Option<FlowThinning>,
});

impl FrictionSpec {
    /// Shear stress law of the fluid.
    ///
    /// # Errors
    /// A stress, exponent or coefficient out of range; one of Carreau's constants without the other, or together
    /// with an Eyring stress.
    pub fn rheology(&self) -> Result<Rheology, InputError> {
        InputError::require_positive("friction.limiting_shear_stress", self.limiting_shear_stress)?;
        let conflict = |field: &str, reason: &str| {
            Err(InputError::Conflict { field: format!("friction.{field}"), reason: reason.to_owned() })
        };
        let fluid = match (self.eyring_stress, self.carreau_stress, self.carreau_exponent) {
            (None, None, None) => Rheology::newtonian(),
            (Some(stress), None, None) => Rheology::eyring(stress)?,
            (None, Some(stress), Some(exponent)) => Rheology::carreau(stress, exponent)?,
            (_, None, Some(_)) => return conflict("carreau_stress", "is missing, carreau_exponent is given"),
            (_, Some(_), None) => return conflict("carreau_exponent", "is missing, carreau_stress is given"),
            (Some(_), Some(_), Some(_)) => {
                return conflict("carreau_stress", "friction.eyring_stress is given too; give only one");
            }
        };
        match self.limiting_stress_coefficient {
            None => fluid.with_limit(self.limiting_shear_stress),
            Some(share) => fluid.with_limit_by_pressure(share),
        }
    }

    /// Shear thinning of the pressure flow at `sliding_speed` \[m/s\]; `None` if not modelled.
    ///
    /// # Errors
    /// A negative speed; a Newtonian fluid with `flow_thinning`; the errors of [`FrictionSpec::rheology`].
    pub fn shear_thinning(&self, sliding_speed: f64) -> Result<Option<ShearThinning>, InputError> {
        let Some(flow) = self.flow_thinning else { return Ok(None) };
        if self.eyring_stress.is_none() && self.carreau_stress.is_none() {
            return Err(InputError::Conflict {
                field: "friction.flow_thinning".to_owned(),
                reason: "the fluid is Newtonian: friction.eyring_stress is missing, or carreau_stress and \
                         carreau_exponent"
                    .to_owned(),
            });
        }
        let effective = ShearThinning::new(self.rheology()?, sliding_speed)?;
        Ok(Some(match flow {
            FlowThinning::Effective => effective,
            FlowThinning::Directional => effective.directional(),
        }))
    }
}

/// Shear-thinned viscosity of the pressure flow, see [`ShearThinning`].
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{FlowThinning, FrictionSpec};
/// let eyring = FrictionSpec::default().with_eyring_stress(Some(5e6));
/// assert!(eyring.shear_thinning(1.0)?.is_none()); // off by default
/// let thinned = eyring.with_flow_thinning(Some(FlowThinning::Effective));
/// assert!(thinned.shear_thinning(1.0)?.is_some());
/// assert!(FrictionSpec::default().with_flow_thinning(Some(FlowThinning::Effective)).shear_thinning(1.0).is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum FlowThinning {
    /// The effective viscosity of the sheared film, in all directions.
    Effective,
    /// Along sliding the derivative of the stress by the shear rate, across it the effective viscosity.
    Directional,
}

impl Default for FrictionSpec {
    fn default() -> Self {
        Self {
            boundary_coefficient: 0.115,
            film_coefficient: None,
            covering_thickness: None,
            limiting_shear_stress: 1e8,
            eyring_stress: None,
            carreau_stress: None,
            carreau_exponent: None,
            limiting_stress_coefficient: None,
            flow_thinning: None,
        }
    }
}

/// Temperatures and thermal constants of both bodies.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{Flash, ThermalSpec};
/// let hot = ThermalSpec::default().with_bulk_temperature(393.15).with_flash(Flash::On);
/// assert_eq!(hot.conductivity, 46.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct ThermalSpec {
    /// Bulk temperature \[K\].
    pub bulk_temperature: f64,
    /// Flash temperature: on, off or automatic.
    pub flash: Flash,
    /// Thermal conductivity \[W/(m K)\].
    pub conductivity: f64,
    /// Thermal diffusivity \[m^2/s\].
    pub diffusivity: f64,
}

with_fields!(ThermalSpec {
    with_bulk_temperature bulk_temperature: f64,
    with_flash flash: Flash,
    with_conductivity conductivity: f64,
    with_diffusivity diffusivity: f64,
});

impl Default for ThermalSpec {
    fn default() -> Self {
        Self { bulk_temperature: 353.15, flash: Flash::Auto, conductivity: 46.0, diffusivity: 1.27e-5 }
    }
}

/// Whether the flash temperature is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Flash {
    /// Computed if its estimate is 1 K or more.
    #[default]
    Auto,
    /// Computed.
    On,
    /// Not computed.
    Off,
}
