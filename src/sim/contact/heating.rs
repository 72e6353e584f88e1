//! Estimated heating of an isothermal film by its friction.

use crate::error::InputError;
use crate::lubricant::ViscosityLaw;
use crate::sim::contact::friction_laws::mean_fluid_stress;
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::Conditions;
use crate::tribochem::estimate_rise_under_flux;

/// Temperature exponent of Roelands' viscosity for mineral oils.
const ROELANDS_S0: f64 = 1.1;
/// Temperature at which that viscosity is infinite \[K\].
const ROELANDS_ORIGIN: f64 = 138.0;
/// Logarithm of the common viscosity of oils at high temperature in Pa s.
const ROELANDS_LOG: f64 = -9.67;
/// Bisections of the interval of the rise.
const HALVINGS: u32 = 30;

/// Friction coefficients of an isothermal contact.
#[derive(Debug, Clone, Copy)]
pub(in crate::sim) struct IsothermalFriction {
    /// Boundary friction.
    pub(in crate::sim) boundary: f64,
    /// Fluid friction.
    pub(in crate::sim) fluid: f64,
    /// Thickness of the sheared film \[m\].
    pub(in crate::sim) film: f64,
}

/// Estimated rises above the bulk temperature \[K\].
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::sim) struct Rises {
    /// Of the surfaces.
    pub(in crate::sim) surfaces: f64,
    /// Of the film in the center, mean across it.
    pub(in crate::sim) film: f64,
}

/// Estimated rises by the friction of an isothermal contact, with the viscosity law `law`; zero without sliding.
///
///
/// With the boundary and fluid stresses `t_b` and `t_f` at the sliding speed `v`, the surfaces warm by the flash
/// temperature of the flux `(t_b + t_f) v` and the film by a further `t_f v h/(12 k)`. The fluid stress decreases with
/// temperature by the law of the scene, or by Roelands' law with exponent 1.1 if that does not depend on temperature.
///
/// Compared with solutions of the film temperature (0.006 to 0.02 Pa s, 2 to 8 m/s, slide-roll ratios 0.5 to 1.5) the
/// film rise is within 17 % of the mean rise in the center. At a slide-roll ratio of 0.1, where compression and inlet
/// shear matter too, it is up to 45 % low.
pub(in crate::sim) fn film_rise(
    scene: &Scene,
    hertz: &HertzContact,
    conditions: &Conditions,
    law: &dyn ViscosityLaw,
    friction: IsothermalFriction,
) -> Result<Rises, InputError> {
    let (motion, bulk) = (conditions.motion, conditions.bulk_temperature);
    let sliding = motion.sliding_speed();
    let is_known = friction.boundary.is_finite() && friction.fluid.is_finite() && friction.film > 0.0;
    if sliding <= 0.0 || !is_known {
        return Ok(Rises::default());
    }
    let rheology = scene.friction.rheology()?;
    let mean_pressure = hertz.force / hertz.area;
    let stress = |rise: f64| {
        let viscosity = |pressure: f64| warm_viscosity(law, pressure, bulk, rise);
        let contact = (hertz.pressure, scene.form.is_line());
        mean_fluid_stress(&viscosity, &rheology, contact, friction.film, sliding)
    };
    let conductivity = scene.lubricant.and_then(|oil| oil.thermal).unwrap_or_default().conductivity;
    let cool = stress(0.0);
    let heated = |rise: f64| -> Result<Rises, InputError> {
        let left = if cool > 0.0 { stress(rise) / cool } else { 1.0 };
        let fluid = mean_pressure * friction.fluid * left;
        let flux = (mean_pressure * friction.boundary + fluid) * sliding;
        let (bodies, speeds) = (scene.thermal_bodies(), motion.surface_speeds());
        let surfaces = estimate_rise_under_flux(bodies, speeds, flux, hertz.radius)?;
        Ok(Rises { surfaces, film: surfaces + fluid * sliding * friction.film / (12.0 * conductivity) })
    };
    // Heat decreases with the rise: bisect for the rise that this heat sustains.
    let (mut low, mut high) = (0.0, heated(0.0)?.film);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if heated(middle)?.film > middle { low = middle } else { high = middle }
    }
    heated(high)
}

/// Viscosity \[Pa s\] of an oil at the `rise` \[K\] above the `bulk` temperature \[K\].
fn warm_viscosity(law: &dyn ViscosityLaw, pressure: f64, bulk: f64, rise: f64) -> f64 {
    law.viscosity_at(pressure, bulk + rise).unwrap_or_else(|| {
        let above = (bulk - ROELANDS_ORIGIN).max(1.0);
        let cooling = (above / (above + rise)).powf(ROELANDS_S0);
        (ROELANDS_LOG + (law.viscosity(pressure).ln() - ROELANDS_LOG) * cooling).exp()
    })
}
