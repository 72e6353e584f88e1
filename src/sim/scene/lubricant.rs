//! The lubricant: viscosity, density and supply.

use crate::lubricant::{DoolittleTaitConstants, ImprovedYasutomiConstants};
use crate::thermal::FilmThermal;
use crate::with_fields::with_fields;

/// Viscosity by the law of Roelands, unless `viscosity` names another one, and Dowson-Higginson density.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::LubricantSpec;
/// let mut scene = Scene::azam_2019(32);
/// let thin = scene.formula_film()?.ok_or("dry")?.central;
/// scene.lubricant = Some(LubricantSpec::roelands(0.04, 0.68));
/// let thick = scene.formula_film()?.ok_or("dry")?.central;
/// assert!(thick > 3.0 * thin); // ten times the viscosity, to a power of at least 0.67
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "LubricantTable")
)]
#[non_exhaustive]
pub struct LubricantSpec {
    /// Viscosity at ambient pressure \[Pa s\], at `temperature` or else the bulk temperature; zero if `viscosity`
    /// is given.
    pub eta0: f64,
    /// Roelands index; zero if `viscosity` is given.
    pub roelands_z: f64,
    /// Roelands reference pressure \[Pa\].
    pub roelands_p0: f64,
    /// Pressure-viscosity coefficient \[1/Pa\]. If given, it sets the slope of the law; otherwise it follows from
    /// `eta0`, `roelands_z` and `roelands_p0`.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub alpha: Option<f64>,
    /// Temperature at which `eta0` and `alpha` hold \[K\]. With `roelands_s0`, the viscosity depends on the bulk
    /// temperature.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub temperature: Option<f64>,
    /// Temperature index of the law of Roelands, see
    /// [`ThermalRoelands`](crate::lubricant::ThermalRoelands).
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub roelands_s0: Option<f64>,
    /// Another viscosity law in place of that of Roelands.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub viscosity: Option<ViscositySpec>,
    /// Pressure-viscosity coefficient \[1/Pa\] for film formulas only, if the data sheet states another one than
    /// the slope of the viscosity law. Default: that slope.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub formula_alpha: Option<f64>,
    /// Dowson-Higginson `a` \[1/Pa\].
    pub density_a: f64,
    /// Dowson-Higginson `b` \[1/Pa\].
    pub density_b: f64,
    /// Thickness of the film supplied at the inlet edge of the box \[m\]; `None` for a flooded inlet. Needs
    /// mass-conserving cavitation.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub supplied_film: Option<f64>,
    /// Position of the oil supply.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "InletSpec::is_flooded"))]
    pub inlet: InletSpec,
    /// Thermal properties of the fluid. If given, the film temperature is computed; otherwise the film is
    /// isothermal. Needs a viscosity law that depends on temperature.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub thermal: Option<FilmThermal>,
}

impl LubricantSpec {
    /// Roelands' law with the viscosity `eta0` \[Pa s\] at ambient pressure and the index `roelands_z`. All other
    /// fields have the defaults of scene files.
    pub const fn roelands(eta0: f64, roelands_z: f64) -> Self {
        Self {
            eta0,
            roelands_z,
            roelands_p0: 1.96e8,
            alpha: None,
            temperature: None,
            roelands_s0: None,
            viscosity: None,
            formula_alpha: None,
            density_a: 0.6e-9,
            density_b: 1.7e-9,
            supplied_film: None,
            inlet: InletSpec::Flooded,
            thermal: None,
        }
    }
}

with_fields!(LubricantSpec {
    with_eta0 eta0: f64,
    with_roelands_z roelands_z: f64,
    with_roelands_p0 roelands_p0: f64,
    with_alpha alpha: Option<f64>,
    with_temperature temperature: Option<f64>,
    with_roelands_s0 roelands_s0: Option<f64>,
    with_viscosity viscosity: Option<ViscositySpec>,
    with_formula_alpha formula_alpha: Option<f64>,
    with_density_a density_a: f64,
    with_density_b density_b: f64,
    with_supplied_film supplied_film: Option<f64>,
    with_inlet inlet: InletSpec,
    with_thermal thermal: Option<FilmThermal>,
});

/// Position of the oil supply upstream of a contact.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{InletSpec, LubricantSpec};
/// let oil = LubricantSpec::roelands(0.04, 0.68);
/// assert_eq!(oil.inlet, InletSpec::Flooded);
/// let meniscus = oil.with_inlet(InletSpec::BoxEdge);
/// assert_ne!(meniscus, oil);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum InletSpec {
    /// Far upstream: the film does not depend on the box. If the box cuts the inlet, the pressure at its edge is
    /// that of the smooth contact in a wider box.
    #[default]
    Flooded,
    /// At the edges of the box: ambient pressure at a meniscus there.
    BoxEdge,
}

impl InletSpec {
    /// Whether it is the default.
    #[cfg(feature = "serde")]
    fn is_flooded(&self) -> bool {
        *self == Self::Flooded
    }
}

/// A viscosity law of pressure and temperature, evaluated at the bulk temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(tag = "law", rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum ViscositySpec {
    /// Exponential in pressure: [`Barus`](crate::lubricant::Barus).
    Barus(BarusConstants),
    /// Free volume, with the density of Tait in place of that of Dowson and Higginson:
    /// [`DoolittleTait`](crate::lubricant::DoolittleTait).
    DoolittleTait(DoolittleTaitConstants),
    /// Distance from the glass transition: [`ImprovedYasutomi`](crate::lubricant::ImprovedYasutomi).
    ImprovedYasutomi(ImprovedYasutomiConstants),
}

/// Constants of [`Barus`](crate::lubricant::Barus).
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::{BarusConstants, LubricantSpec, ViscositySpec};
/// let barus = ViscositySpec::Barus(BarusConstants { eta0: 0.08, alpha: 20e-9 });
/// let oil = LubricantSpec::roelands(0.0, 0.0).with_viscosity(Some(barus));
/// assert_eq!(oil.viscosity, Some(barus));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(deny_unknown_fields))]
pub struct BarusConstants {
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Pressure-viscosity coefficient \[1/Pa\].
    pub alpha: f64,
}

/// `[lubricant]` as written in a scene file.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct LubricantTable {
    eta0: Option<f64>,
    roelands_z: Option<f64>,
    roelands_p0: Option<f64>,
    alpha: Option<f64>,
    temperature: Option<f64>,
    roelands_s0: Option<f64>,
    viscosity: Option<ViscositySpec>,
    formula_alpha: Option<f64>,
    density_a: Option<f64>,
    density_b: Option<f64>,
    supplied_film: Option<f64>,
    #[serde(default)]
    inlet: InletSpec,
    thermal: Option<FilmThermal>,
}

#[cfg(feature = "serde")]
impl TryFrom<LubricantTable> for LubricantSpec {
    type Error = String;

    fn try_from(table: LubricantTable) -> Result<Self, String> {
        let needed = |key: &str, value: Option<f64>| match (value, table.viscosity) {
            (Some(value), _) => Ok(value),
            (None, Some(_)) => Ok(0.0),
            (None, None) => Err(format!("missing field `{key}`")),
        };
        let usual = Self::roelands(needed("eta0", table.eta0)?, needed("roelands_z", table.roelands_z)?);
        let of_roelands = [
            ("eta0", table.eta0, 0.0),
            ("roelands_z", table.roelands_z, 0.0),
            ("alpha", table.alpha, 0.0),
            ("temperature", table.temperature, 0.0),
            ("roelands_s0", table.roelands_s0, 0.0),
            ("roelands_p0", table.roelands_p0, usual.roelands_p0),
        ];
        let of_density = [
            ("density_a", table.density_a, usual.density_a),
            ("density_b", table.density_b, usual.density_b),
        ];
        // Scenes are written with all their values: accept default values.
        let refuse = |keys: &[(&str, Option<f64>, f64)], reason: &str| {
            let stray = keys.iter().find(|(_, value, usual)| value.is_some_and(|value| value - usual != 0.0));
            stray.map_or(Ok(()), |(key, ..)| Err(format!("unknown key `{key}`, `viscosity` {reason}")))
        };
        if table.viscosity.is_some() {
            refuse(&of_roelands, "gives another law than that of Roelands")?;
        }
        if matches!(table.viscosity, Some(ViscositySpec::DoolittleTait(_))) {
            refuse(&of_density, "brings the density of Tait")?;
        }
        Ok(Self {
            roelands_p0: table.roelands_p0.unwrap_or(usual.roelands_p0),
            alpha: table.alpha,
            temperature: table.temperature,
            roelands_s0: table.roelands_s0,
            viscosity: table.viscosity,
            formula_alpha: table.formula_alpha,
            density_a: table.density_a.unwrap_or(usual.density_a),
            density_b: table.density_b.unwrap_or(usual.density_b),
            supplied_film: table.supplied_film,
            inlet: table.inlet,
            thermal: table.thermal,
            ..usual
        })
    }
}
