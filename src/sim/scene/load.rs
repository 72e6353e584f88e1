//! The load of a scene and the Hertz contact under it.
//!
//! A load is a force or the maximum Hertz pressure of the smooth bodies. The Hertz contact determines boxes,
//! starts and scales.

use super::Scene;
use crate::analytic::{HertzLine, HertzPoint};
use crate::error::InputError;
use crate::sim::scene::hertz::HertzContact;

/// Normal load, given by exactly one of two values.
///
/// # Examples
///
/// ```
/// use stribeck::sim::Scene;
/// use stribeck::sim::scene::Load;
/// let mut scene = Scene::azam_2019(32);
/// let hertz = scene.hertz()?;
/// scene.load = Load::force(hertz.force);
/// assert!((scene.hertz()?.pressure / 1.15e9 - 1.0).abs() < 1e-12);
/// scene.load.hertz_pressure = Some(1e9);
/// assert!(scene.hertz().unwrap_err().to_string().contains("not both"));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[non_exhaustive]
pub struct Load {
    /// Maximum Hertz pressure of the smooth contact \[Pa\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub hertz_pressure: Option<f64>,
    /// Force \[N\]; of a line contact force per length \[N/m\].
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub force: Option<f64>,
}

impl Load {
    /// The load under which the smooth contact has this maximum Hertz pressure \[Pa\].
    pub const fn hertz_pressure(pressure: f64) -> Self {
        Self { hertz_pressure: Some(pressure), force: None }
    }

    /// A force \[N\]; of a line contact force per length \[N/m\].
    pub const fn force(force: f64) -> Self {
        Self { hertz_pressure: None, force: Some(force) }
    }

    /// Key and value of the load.
    fn given(&self) -> Result<(&'static str, f64), InputError> {
        let reason = match (self.hertz_pressure, self.force) {
            (Some(pressure), None) => return Ok(("load.hertz_pressure", pressure)),
            (None, Some(force)) => return Ok(("load.force", force)),
            (Some(pressure), Some(force)) => format!(
                "give hertz_pressure or force, not both (hertz_pressure = {pressure:?}, force = {force:?})"
            ),
            (None, None) => "hertz_pressure or force is missing".to_owned(),
        };
        Err(InputError::Conflict { field: "load".to_owned(), reason })
    }
}

impl Scene {
    /// The Hertz contact of the smooth bodies, at time zero if the load is scheduled.
    ///
    /// # Errors
    /// Form, modulus, load or schedule out of range; both kinds of load or neither.
    pub fn hertz(&self) -> Result<HertzContact, InputError> {
        match self.schedule.load {
            None => self.constant_hertz(),
            Some(_) => self.hertz_under(self.conditions(0.0)?.load),
        }
    }

    /// The Hertz contact under the `load` \[N\] of a schedule.
    pub(in crate::sim) fn hertz_under(&self, load: f64) -> Result<HertzContact, InputError> {
        self.hertz_by(Load::force(load))
    }

    /// The Hertz contact under the load of the scene, without its schedule.
    pub(in crate::sim) fn constant_hertz(&self) -> Result<HertzContact, InputError> {
        self.hertz_by(self.load)
    }

    /// The Hertz contact under `load`, rotated with the form. Errors name the key of the load or of the form.
    fn hertz_by(&self, load: Load) -> Result<HertzContact, InputError> {
        self.form.validate()?;
        let (radius_x, radius_y) = self.form.radii();
        let line = self.form.is_line();
        let ratio = radius_x / radius_y;
        let largest = HertzPoint::MAX_RADIUS_RATIO;
        let fits = line || (1.0 / largest..=largest).contains(&ratio);
        InputError::require(fits, "form.radius_x / form.radius_y", ratio, "between 1e-8 and 1e8")?;
        let modulus = self.equivalent_modulus()?;
        let (field, value) = load.given()?;
        InputError::require_positive(field, value)?;
        let contact = match (load.hertz_pressure, line) {
            (Some(pressure), true) => {
                HertzLine::from_max_pressure(radius_x, modulus, pressure).map(HertzContact::from)
            }
            (Some(pressure), false) => {
                HertzPoint::from_max_pressure(radius_x, radius_y, modulus, pressure).map(HertzContact::from)
            }
            (None, true) => HertzLine::from_load(radius_x, modulus, value).map(HertzContact::from),
            (None, false) => {
                HertzPoint::from_load(radius_x, radius_y, modulus, value).map(HertzContact::from)
            }
        };
        let turned = contact.map(|contact| HertzContact { angle: self.form.angle(), ..contact });
        // All inputs are in range: only the result can be out of range.
        turned.map_err(|error| InputError::Conflict {
            field: format!("{field} = {value:?}"),
            reason: format!("the values of its Hertz contact are not finite ({error})"),
        })
    }
}
