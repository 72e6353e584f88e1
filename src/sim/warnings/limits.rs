//! Models beyond what they hold for.

use super::{Warning, short};
use crate::error::InputError;
use crate::sim::formula::{ellipticity, formula_film};
use crate::sim::hertz::HertzContact;
use crate::sim::scene::Scene;
use crate::sim::setup;
use crate::sim::timetable::Timetable;

/// Largest half-width of a contact over the radius: bodies are parabolas and half-spaces.
const LARGEST_SLOPE: f64 = 0.1;
/// Ellipticities that the formula of Hamrock and Dowson was fitted to.
const ELLIPTICITIES: [f64; 2] = [1.0, 8.0];
/// Ratio of two film formulas, one for hard contacts and one for all regimes, from which on the former does
/// not hold.
const APART: f64 = 1.5;

/// Warnings about half-space, parabolas and film formula.
pub(super) fn of_models(scene: &Scene) -> Vec<Warning> {
    let Ok(timetable) = Timetable::new(scene) else { return Vec::new() };
    let [_, largest] = timetable.loads();
    let heaviest = if scene.schedule.load.is_some() { scene.hertz_under(largest) } else { scene.hertz() };
    let Ok(hertz) = heaviest else { return Vec::new() };
    slope(scene, &hertz).into_iter().chain(film_formula(scene).ok().flatten()).collect()
}

/// The contact that is as wide as the bodies are curved.
fn slope(scene: &Scene, hertz: &HertzContact) -> Option<Warning> {
    let (radius_x, radius_y) = scene.form.radii();
    let ratio = (hertz.half_width_x / radius_x).max(hertz.half_width_y / radius_y);
    (ratio > LARGEST_SLOPE).then(|| {
        let (field, value) = match scene.load.hertz_pressure {
            Some(pressure) if scene.schedule.load.is_none() => ("load.hertz_pressure", pressure),
            _ => ("load.force", hertz.force),
        };
        Warning::new(
            field,
            value,
            format!(
                "the contact has a half-width of {} of the radius: elastic half-spaces and parabolas hold up to \
                 {LARGEST_SLOPE}",
                short(ratio)
            ),
            "lower the load or check radius and modulus".to_owned(),
        )
    })
}

/// The film formula where its fit does not reach.
fn film_formula(scene: &Scene) -> Result<Option<Warning>, InputError> {
    let conditions = scene.conditions(0.0)?;
    let (hertz, law) = (scene.hertz()?, setup::viscosity(scene, conditions.bulk_temperature)?);
    let speed = conditions.motion.entrainment_speed;
    let Some(formulas) = formula_film(scene, &hertz, speed, law.as_deref(), None)? else { return Ok(None) };
    let ellipticity = ellipticity(scene, &hertz)?;
    let [narrowest, widest] = ELLIPTICITIES;
    let message = if hertz.angle != 0.0 {
        "the formula is for entrainment along an axis of the ellipse; it takes the sections along and across it"
            .to_owned()
    } else if !scene.form.is_line() && !(narrowest - 1e-9..=widest).contains(&ellipticity) {
        format!("the ellipticity of {} is outside the range of the formula, 1 to 8", short(ellipticity))
    } else {
        let apart = |other: &f64| !(1.0 / APART..=APART).contains(&(formulas.central / other));
        let Some(other) = formulas.all_regimes.filter(apart) else { return Ok(None) };
        format!(
            "the formula is for hard contacts of oils that thicken under pressure; the one for all regimes gives {} m",
            short(other)
        )
    };
    let remedy = "take the film of the solve, not that of the formula".to_owned();
    Ok(Some(Warning::new("film.formula_central", formulas.central, message, remedy)))
}
