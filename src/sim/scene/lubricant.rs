//! The lubricant: viscosity, density and supply.

use super::OilSpec;
#[cfg(feature = "serde")]
use super::oil::OilKeys;
#[cfg(feature = "serde")]
use crate::lubricant::BaseOil;
use crate::lubricant::{DoolittleTaitConstants, ImprovedYasutomiConstants};
use crate::thermal::FilmThermal;
use crate::with_fields::with_fields;

/// Viscosity by the law of Roelands, unless `oil` or `viscosity` gives another one, and Dowson-Higginson density.
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
    /// or `oil` is given.
    pub eta0: f64,
    /// Roelands index; zero if `viscosity` or `oil` is given.
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
    /// The oil by its data sheet, at the bulk temperature, in place of `eta0` and the index of Roelands. `alpha`, if
    /// given, holds at `temperature` or else at the bulk temperature.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub oil: Option<OilSpec>,
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
            oil: None,
            formula_alpha: None,
            density_a: 0.6e-9,
            density_b: 1.7e-9,
            supplied_film: None,
            inlet: InletSpec::Flooded,
            thermal: None,
        }
    }

    /// An oil by its data sheet. All other fields have the defaults of scene files.
    ///
    /// ```
    /// use stribeck::sim::Scene;
    /// use stribeck::sim::scene::{LubricantSpec, OilSpec};
    /// let mut scene = Scene::azam_2019(32);
    /// let film = |scene: &Scene| scene.formula_film().map(|film| film.map_or(0.0, |film| film.central));
    /// scene.lubricant = Some(LubricantSpec::of_oil(OilSpec::iso_vg(46, 95.0)));
    /// scene.thermal.bulk_temperature = 313.15;
    /// let warm = film(&scene)?;
    /// scene.thermal.bulk_temperature = 373.15;
    /// assert!(warm > 3.0 * film(&scene)?); // viscosity and its rise with pressure both fall
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub const fn of_oil(oil: OilSpec) -> Self {
        let mut spec = Self::roelands(0.0, 0.0);
        spec.oil = Some(oil);
        spec
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
    with_oil oil: Option<OilSpec>,
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
    grade: Option<String>,
    viscosity_index: Option<f64>,
    kinematic: Option<String>,
    density: Option<f64>,
    base_oil: Option<BaseOil>,
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
        let oil = OilKeys {
            grade: table.grade.clone(),
            viscosity_index: table.viscosity_index,
            kinematic: table.kinematic.clone(),
            density: table.density,
            base_oil: table.base_oil,
        };
        let other_law = table.viscosity.is_some() || oil.first().is_some();
        let needed = |key: &str, value: Option<f64>| match value {
            Some(value) => Ok(value),
            None if other_law => Ok(0.0),
            None => Err(format!("missing field `{key}`")),
        };
        let usual = Self::roelands(needed("eta0", table.eta0)?, needed("roelands_z", table.roelands_z)?);
        table.reject_other_laws(&usual, oil.first())?;
        Ok(Self {
            roelands_p0: table.roelands_p0.unwrap_or(usual.roelands_p0),
            alpha: table.alpha,
            temperature: table.temperature,
            roelands_s0: table.roelands_s0,
            viscosity: table.viscosity,
            oil: oil.into_spec().map_err(|error| error.to_string())?,
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

#[cfg(feature = "serde")]
impl LubricantTable {
    /// Error for keys of one law beside another one; `oil` is the first key of an oil by its data sheet.
    fn reject_other_laws(&self, usual: &LubricantSpec, oil: Option<&str>) -> Result<(), String> {
        let law = [
            ("eta0", self.eta0, 0.0),
            ("roelands_z", self.roelands_z, 0.0),
            ("roelands_s0", self.roelands_s0, 0.0),
            ("roelands_p0", self.roelands_p0, usual.roelands_p0),
        ];
        let slope = [("alpha", self.alpha, 0.0), ("temperature", self.temperature, 0.0)];
        let of_density =
            [("density_a", self.density_a, usual.density_a), ("density_b", self.density_b, usual.density_b)];
        // Scenes are written with all their values: accept default values.
        let refuse = |keys: &[(&str, Option<f64>, f64)], reason: &str| {
            let stray = keys.iter().find(|(_, value, usual)| value.is_some_and(|value| value - usual != 0.0));
            stray.map_or(Ok(()), |(key, ..)| Err(format!("unknown key `{key}`, {reason}")))
        };
        if self.viscosity.is_some() {
            if let Some(key) = oil {
                return Err(format!("unknown key `{key}`, `viscosity` gives another law"));
            }
            refuse(&law, "`viscosity` gives another law than that of Roelands")?;
            refuse(&slope, "`viscosity` gives another law than that of Roelands")?;
        }
        if let Some(key) = oil {
            refuse(
                &law,
                &format!("`{key}` describes the oil by its data sheet, from which viscosities follow"),
            )?;
        }
        if matches!(self.viscosity, Some(ViscositySpec::DoolittleTait(_))) {
            refuse(&of_density, "`viscosity` brings the density of Tait")?;
        }
        Ok(())
    }
}
