//! Warnings about neglected physics: heating of the film, shear thinning, flow around ridges, yield of asperities and below the surface.

use super::{Warning, short};
use crate::lubricant::ViscosityLaw;
use crate::sim::contact::film_temperature;
use crate::sim::contact::heating::{IsothermalFriction, film_rise};
use crate::sim::scene::Scene;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::Conditions;

/// Largest rise of an isothermal film without a warning \[K\].
const LARGEST_RISE: f64 = 10.0;
/// Largest mean shear stress of a Newtonian fluid \[Pa\]: oils thin above 5 to 10 MPa.
const LARGEST_NEWTONIAN: f64 = 50e6;
/// Largest friction coefficient by shear of an oil: traction oils reach 0.12.
const LARGEST_TRACTION: f64 = 0.15;
/// Load ratio of a profile under a line contact without a warning.
const LARGEST_RIDGE_LOAD: f64 = 0.01;
/// Film over the root mean square height of such a profile, below which surfaces that are rough along both axes touch.
const LEAST_RIDGE_LAMBDA: f64 = 3.0;
/// Largest pressure over the equivalent modulus of elastic bodies: 8 GPa of steel on steel. Hardnesses of hardened steels, ceramics and
/// glasses are .03 to .05 of it.
const LARGEST_ELASTIC: f64 = 0.035;
/// Equivalent modulus \[Pa\] below which bodies are elastomers, which do not yield.
const ELASTOMER: f64 = 1e9;

/// Largest pressure of a smooth contact over that of Hertz.
const LARGEST_PRESSURE: f64 = 2.0;

/// A contact at one operating point, solved or expected.
pub(in crate::sim) struct OperatingPoint<'a> {
    /// The contact between smooth dry bodies.
    pub(in crate::sim) hertz: &'a HertzContact,
    /// Load, motion and bulk temperature.
    pub(in crate::sim) conditions: Conditions,
    /// Viscosity at the bulk temperature; `None` for a dry contact.
    pub(in crate::sim) viscosity: Option<&'a dyn ViscosityLaw>,
    /// Root mean square height of both bodies together \[m\]; 0 of smooth ones.
    pub(in crate::sim) composite_rq: f64,
    /// Largest pressure \[Pa\], if it is solved.
    pub(in crate::sim) largest_pressure: Option<f64>,
    /// Friction coefficients of solid contact and of the fluid.
    pub(in crate::sim) friction: [f64; 2],
    /// Mean film in the center \[m\].
    pub(in crate::sim) film: f64,
    /// Load ratio.
    pub(in crate::sim) load_ratio: f64,
    /// Largest von Mises stress below the surface over the yield strength, if both are known.
    pub(in crate::sim) yield_ratio: Option<f64>,
}

/// Warnings about physics that the scene leaves out at this operating point.
pub(in crate::sim) fn left_out(scene: &Scene, point: &OperatingPoint<'_>) -> Vec<Warning> {
    let checks = [
        isothermal(scene, point),
        sheared(scene, point),
        ridges(scene, point),
        high_pressure(scene, point),
        yields(scene, point),
    ];
    checks.into_iter().flatten().collect()
}

/// An isothermal film with large frictional heating.
fn isothermal(scene: &Scene, point: &OperatingPoint<'_>) -> Option<Warning> {
    let law = point.viscosity.filter(|_| !film_temperature::models_film_temperature(scene))?;
    let [boundary, fluid] = point.friction;
    let friction = IsothermalFriction { boundary, fluid, film: point.film };
    let rise = film_rise(scene, point.hertz, &point.conditions, law, friction).ok()?.film;
    (rise > LARGEST_RISE).then(|| {
        Warning::new(
            "friction.coefficient",
            boundary + fluid,
            format!(
                "at {} m/s of sliding this friction would warm the film by about {rise:.0} K, which the isothermal model leaves out: \
                 friction and film are too large",
                short(point.conditions.motion.sliding_speed())
            ),
            "[lubricant.thermal] models it, with the viscosity by temperature (lubricant.temperature and roelands_s0, or an oil by its grade or kinematic viscosities)"
                .to_owned(),
        )
    })
}

/// A fluid whose shear stress exceeds that of oils: a Newtonian one by its stress, any other by its friction.
fn sheared(scene: &Scene, point: &OperatingPoint<'_>) -> Option<Warning> {
    let thins = scene.friction.eyring_stress.is_some() || scene.friction.carreau_stress.is_some();
    let [_, fluid] = point.friction;
    let stress = fluid * point.hertz.force / point.hertz.area;
    let (message, remedy) = if !thins && stress > LARGEST_NEWTONIAN {
        let stress = 1e-6 * stress;
        (
            format!(
                "the mean shear stress of the Newtonian fluid is {stress:.0} MPa; oils thin above 5 to 10 MPa: friction is too large"
            ),
            "friction.eyring_stress, 5 MPa for mineral oils",
        )
    } else if fluid > LARGEST_TRACTION {
        (
            format!(
                "shear of the fluid alone is above {LARGEST_TRACTION} of the load, oils do not reach that"
            ),
            "friction.limiting_stress_coefficient limits it in proportion to the pressure, 0.05 to 0.12 for oils",
        )
    } else {
        return None;
    };
    Some(Warning::new("friction.fluid", fluid, message, remedy.to_owned()))
}

/// A rough profile under a line contact with solid contact, or with so thin a film that a surface which is rough along both axes would touch.
fn ridges(scene: &Scene, point: &OperatingPoint<'_>) -> Option<Warning> {
    let rq = point.composite_rq;
    let touches = point.load_ratio > LARGEST_RIDGE_LOAD || point.film < LEAST_RIDGE_LAMBDA * rq;
    let is_ridged = scene.form.is_line() && !scene.is_strip();
    (is_ridged && scene.is_lubricated() && rq > 0.0 && touches).then(|| {
        Warning::new(
            "contact.load_ratio",
            point.load_ratio,
            format!(
                "a profile under a line contact is ridges across the flow, which oil cannot flow around: at a film of {} Rq load ratio and \
                 friction are not those of a surface that is rough along both axes",
                short((1e3 * point.film / rq).round() / 1e3)
            ),
            "a strip, with cells across the flow: grid.across = \"periodic\" with nx, ny and x".to_owned(),
        )
    })
}

/// A pressure between smooth bodies far above that of Hertz, or one that no elastic body carries without yielding.
fn high_pressure(scene: &Scene, point: &OperatingPoint<'_>) -> Option<Warning> {
    let (pressure, hertz) = (point.largest_pressure?, point.hertz.pressure);
    let modulus = scene.equivalent_modulus().ok()?;
    let is_elastic = scene.plastic.is_none() && modulus > ELASTOMER;
    let (message, remedy) = if point.composite_rq == 0.0 && pressure > LARGEST_PRESSURE * hertz {
        let ratio = short(pressure / hertz);
        (
            format!("between smooth bodies it is {ratio} times the Hertz pressure of {} Pa", short(hertz)),
            "check that the box holds the contact and the cells its film",
        )
    } else if is_elastic && pressure > LARGEST_ELASTIC * modulus {
        (
            format!(
                "it is above {LARGEST_ELASTIC} of the equivalent modulus, where asperities of any material yield: pressures are too high, and \
                 films at asperities too thin"
            ),
            "[plastic] with the hardness of the softer body limits the pressure: hardness = \"7 GPa\" for hardened steel",
        )
    } else {
        return None;
    };
    Some(Warning::new("pressure.max", pressure, message, remedy.to_owned()))
}

/// Subsurface stress above the yield strength of the disc.
fn yields(scene: &Scene, point: &OperatingPoint<'_>) -> Option<Warning> {
    let (ratio, strength) = (point.yield_ratio?, scene.stress?.yield_strength?);
    (ratio > 1.0).then(|| {
        Warning::new(
            "stress.yield_strength",
            strength,
            format!(
                "the largest von Mises stress is {} times the yield strength: bodies yield below the surface, which `[plastic]`, a \
                 limit of the pressure at asperities, does not model",
                short((1e3 * ratio).round() / 1e3)
            ),
            "lower the load; stresses hold up to a ratio of 1".to_owned(),
        )
    })
}
