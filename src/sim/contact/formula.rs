//! Film formulas applied to a scene.

use std::fmt;

use crate::analytic::{FilmConditions, FilmMap, FilmRegime, HertzPoint, LineFilmConditions};
use crate::displayed::serialize_as_displayed;
use crate::error::InputError;
use crate::lubricant::{DensityLaw, ViscosityLaw};
use crate::sim::contact::numbers::Moes;
use crate::sim::contact::oil;
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::{HertzContact, LINE_LENGTH};
use crate::sim::scene::operating_schedule::Conditions;

/// Formula of the central film of a scene.
///
/// ```
/// use stribeck::sim::{FilmFormula, Scene};
/// let film = Scene::azam_2019(32).formula_film()?.ok_or("dry")?;
/// assert_eq!(film.formula, FilmFormula::HamrockDowson);
/// assert_eq!(film.formula.to_string(), "Hamrock and Dowson");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FilmFormula {
    /// Hamrock and Dowson: piezoviscous-elastic point contacts.
    HamrockDowson,
    /// Dowson and Toyoda: piezoviscous-elastic line contacts.
    DowsonToyoda,
    /// Moes for all regimes: contacts of the other regimes.
    Moes,
}

impl fmt::Display for FilmFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::HamrockDowson => "Hamrock and Dowson",
            Self::DowsonToyoda => "Dowson and Toyoda",
            Self::Moes => "Moes for all regimes",
        })
    }
}

serialize_as_displayed!(FilmFormula);

/// Film of a scene by formula.
///
/// # Examples
///
/// ```
/// use stribeck::analytic::FilmRegime;
/// use stribeck::sim::Scene;
/// let film = Scene::azam_2019(32).formula_film()?.ok_or("dry")?;
/// assert_eq!(film.map.regime, FilmRegime::PiezoviscousElastic);
/// assert!((film.central / film.map.central - 1.0).abs() < 0.15); // two formulas for one contact
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FormulaFilm {
    /// Moes' parameters.
    pub moes: Moes,
    /// Central film of an incompressible oil \[m\].
    pub central: f64,
    /// Formula of `central`.
    pub formula: FilmFormula,
    /// Regime, and the film by a formula for all regimes.
    pub map: FilmMap,
}

impl FormulaFilm {
    /// Central film at most the `supplied` one, over the relative density of the oil at the Hertz pressure \[m\]: film
    /// formulas are for incompressible oils, and the oil of the inlet fills less height once it is compressed.
    pub(in crate::sim) fn compressed(
        &self,
        scene: &Scene,
        hertz: &HertzContact,
        density: Option<&dyn DensityLaw>,
    ) -> f64 {
        let supplied = scene.lubricant.and_then(|oil| oil.supplied_film).unwrap_or(f64::INFINITY);
        self.central.min(supplied) / density.map_or(1.0, |law| law.ratio(hertz.pressure))
    }
}

impl Scene {
    /// Film formulas for the smooth, flooded contact at time zero, with the slope of the viscosity law; `None` for a
    /// dry contact.
    ///
    /// ```
    /// let film = stribeck::sim::Scene::azam_2019(64).formula_film()?.expect("it has an oil");
    /// assert!((7e-9..10e-9).contains(&film.central));
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    ///
    /// # Errors
    /// A form, modulus, load, speed, oil or schedule out of range.
    pub fn formula_film(&self) -> Result<Option<FormulaFilm>, InputError> {
        let conditions = self.conditions(0.0)?;
        let (hertz, law) = (self.hertz()?, oil::viscosity(self, conditions.bulk_temperature)?);
        let speed = conditions.motion.entrainment_speed;
        formula_film(self, &hertz, speed, law.as_deref(), None)
    }
}

/// Film formulas at `entrainment_speed` \[m/s\] with the pressure-viscosity coefficient `alpha` \[1/Pa\] or the
/// slope of the law; `None` without a lubricant.
pub(in crate::sim) fn formula_film(
    scene: &Scene,
    hertz: &HertzContact,
    entrainment_speed: f64,
    viscosity: Option<&dyn ViscosityLaw>,
    alpha: Option<f64>,
) -> Result<Option<FormulaFilm>, InputError> {
    let Some(law) = viscosity else { return Ok(None) };
    let equivalent_modulus = scene.equivalent_modulus()?;
    let (eta0, alpha) = (law.viscosity(0.0), alpha.unwrap_or_else(|| law.log_slope(0.0)));
    let ((radius, _), load) = (scene.form.radii_of_entrainment(), hertz.force);
    Ok(Some(if scene.form.is_line() {
        let line = LineFilmConditions {
            entrainment_speed,
            eta0,
            alpha,
            equivalent_modulus,
            radius,
            load: load / LINE_LENGTH,
        };
        let map = line.film_map()?;
        let (formula, central) = match map.regime {
            FilmRegime::PiezoviscousElastic => (FilmFormula::DowsonToyoda, line.dowson_toyoda_central()?),
            _ => (FilmFormula::Moes, map.central),
        };
        FormulaFilm { moes: Moes { m: line.moes_load(), l: line.moes_lubricant() }, central, formula, map }
    } else {
        let point = FilmConditions {
            entrainment_speed,
            eta0,
            alpha,
            equivalent_modulus,
            radius,
            load,
            ellipticity: ellipticity(scene, hertz)?,
        };
        let map = point.film_map()?;
        let (formula, central) = match map.regime {
            FilmRegime::PiezoviscousElastic => (FilmFormula::HamrockDowson, point.hamrock_dowson_central()?),
            _ => (FilmFormula::Moes, map.central),
        };
        FormulaFilm { moes: Moes { m: point.moes_load(), l: point.moes_lubricant() }, central, formula, map }
    }))
}

/// Semi-axis across entrainment over that along it. A rotated ellipse is replaced by the contact whose radii are those
/// of the sections along and across entrainment, as in Chittenden, Dowson, Dunn and Taylor (1985), Proceedings of
/// the Royal Society A 397, 271-294.
pub(in crate::sim) fn ellipticity(scene: &Scene, hertz: &HertzContact) -> Result<f64, InputError> {
    if hertz.angle == 0.0 {
        return Ok(hertz.half_width_y / hertz.half_width_x);
    }
    let (along, across) = scene.form.radii_of_entrainment();
    let sections = HertzPoint::from_load(along, across, scene.equivalent_modulus()?, hertz.force)?;
    Ok(sections.half_width_y / sections.half_width_x)
}

/// Central film by the formula of its regime, with the stated pressure-viscosity coefficient or else the slope of the
/// law; zero without lubricant \[m\].
pub(in crate::sim) fn stated_film(
    scene: &Scene,
    hertz: &HertzContact,
    conditions: &Conditions,
    law: Option<&dyn ViscosityLaw>,
) -> Result<f64, InputError> {
    let alpha = scene.lubricant.and_then(|lubricant| lubricant.formula_alpha);
    let film = formula_film(scene, hertz, conditions.motion.entrainment_speed, law, alpha)?;
    Ok(film.map_or(0.0, |film| film.central))
}
