//! The lubricant: viscosity, density and supply.

use super::OilSpec;
#[cfg(feature = "serde")]
use super::lubricant_table::LubricantTable;
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
