//! Viscosity and pressure-viscosity coefficient of the oil at the temperature of the contact, with their sources.

use crate::error::InputError;
use crate::sim::contact::formula::formula_film;
use crate::sim::contact::oil;
use crate::sim::scene::{LubricantSpec, OilSpec, Scene, ViscositySpec};

/// The oil at the temperature of the contact.
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::{LubricantSpec, OilSpec};
/// let mut scene = Scene::azam_2019(32);
/// scene.lubricant = Some(LubricantSpec::of_oil(OilSpec::iso_vg(46, 95.0)));
/// scene.thermal.bulk_temperature = 313.15;
/// let oil = scene.oil_numbers()?.ok_or("dry")?;
/// assert!((oil.eta0 - 0.0393).abs() < 1e-4);
/// // The film grows with alpha to the power 0.5.
/// assert!((oil.film_uncertainty / oil.alpha_uncertainty - 0.5).abs() < 0.05);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct OilNumbers {
    /// Bulk temperature \[K\].
    pub temperature: f64,
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Source of the viscosity: keys or statement.
    pub eta0_source: String,
    /// Pressure-viscosity coefficient at ambient pressure \[1/Pa\].
    pub alpha: f64,
    /// Source of the coefficient: a key or a correlation.
    pub alpha_source: String,
    /// Relative uncertainty of the coefficient, one standard deviation of its correlation; zero if given.
    pub alpha_uncertainty: f64,
    /// Relative uncertainty of the film by that of the coefficient, by the film formula.
    pub film_uncertainty: f64,
    /// Kinematic viscosity at ambient pressure \[m^2/s\]; with a density of 870 kg/m^3 if the scene gives no oil by its
    /// data sheet.
    pub kinematic_viscosity: f64,
    /// Viscosity ratio kappa of the bearing, `kinematic_viscosity` over `nu_1` of ISO 281
    /// ([`RollingBearingSpec::rated_viscosity`](crate::sim::scene::RollingBearingSpec::rated_viscosity)); `None` without a bearing.
    pub kappa: Option<f64>,
}

impl Scene {
    /// The oil at the bulk temperature of time zero; `None` for a dry contact.
    ///
    /// # Errors
    /// Values of oil, form, load or motion out of range.
    pub fn oil_numbers(&self) -> Result<Option<OilNumbers>, InputError> {
        let conditions = self.conditions(0.0)?;
        let temperature = conditions.bulk_temperature;
        let Some(spec) = self.lubricant.filter(|_| self.is_lubricated()) else { return Ok(None) };
        let Some(law) = oil::viscosity(self, temperature)? else { return Ok(None) };
        let (eta0, alpha) = (law.viscosity(0.0), law.log_slope(0.0));
        let (alpha_source, alpha_uncertainty) = alpha_source(&spec);
        let hertz = self.hertz()?;
        let speed = conditions.motion.entrainment_speed;
        let film = |alpha: f64| {
            let film = formula_film(self, &hertz, speed, Some(&*law), Some(alpha))?;
            Ok::<f64, InputError>(film.map_or(f64::NAN, |film| film.central))
        };
        let film_uncertainty = if alpha_uncertainty > 0.0 && speed > 0.0 {
            film(alpha * (1.0 + alpha_uncertainty))? / film(alpha)? - 1.0
        } else {
            0.0
        };
        let kinematic_viscosity = match spec.oil {
            Some(oil) => oil.walther()?.kinematic_viscosity(temperature),
            None => eta0 / OilSpec::default().density_at_15(),
        };
        let rated = self.bearing.map(|bearing| bearing.rated_viscosity()).transpose()?;
        Ok(Some(OilNumbers {
            temperature,
            eta0,
            eta0_source: eta0_source(&spec),
            alpha,
            alpha_source,
            alpha_uncertainty,
            film_uncertainty,
            kinematic_viscosity,
            kappa: rated.map(|rated| kinematic_viscosity / rated),
        }))
    }
}

/// Source of the viscosity.
fn eta0_source(spec: &LubricantSpec) -> String {
    if let Some(oil) = spec.oil {
        let density = match oil.density {
            Some(density) => format!("density {density} kg/m^3 at 15 degC"),
            None => format!("density {} kg/m^3 at 15 degC assumed", oil.density_at_15()),
        };
        return format!("{}, {density}, ASTM D341", oil.statement());
    }
    match spec.viscosity {
        Some(ViscositySpec::Barus(_)) => "lubricant.viscosity, Barus".to_owned(),
        Some(ViscositySpec::DoolittleTait(_)) => "lubricant.viscosity, Doolittle and Tait".to_owned(),
        Some(ViscositySpec::ImprovedYasutomi(_)) => "lubricant.viscosity, improved Yasutomi".to_owned(),
        None if spec.temperature.is_some() => "lubricant.eta0 and roelands_s0".to_owned(),
        None => "lubricant.eta0".to_owned(),
    }
}

/// Source of the pressure-viscosity coefficient and its relative uncertainty.
fn alpha_source(spec: &LubricantSpec) -> (String, f64) {
    match (spec.alpha, spec.oil, spec.viscosity) {
        (Some(_), ..) => ("lubricant.alpha".to_owned(), 0.0),
        (None, Some(oil), _) => {
            (format!("{} for {}", oil.base_oil.correlation(), oil.base_oil), oil.base_oil.uncertainty())
        }
        (None, None, Some(_)) => ("lubricant.viscosity".to_owned(), 0.0),
        (None, None, None) => ("lubricant.roelands_z".to_owned(), 0.0),
    }
}
