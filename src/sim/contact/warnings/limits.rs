//! Warnings about models outside of their valid range.

use super::{Warning, short};
use crate::error::InputError;
use crate::sim::contact::formula::ellipticity;
use crate::sim::contact::oil;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::operating_schedule::OperatingSchedule;
use crate::sim::scene::{BODIES, OilSpec, Roughness, Scene};
use crate::surface::{Form, Texture};

/// Largest half-width of a contact over the radius: bodies are treated as parabolas and half-spaces.
const LARGEST_SLOPE: f64 = 0.1;
/// Largest half-width of a contact in a concave body over the radius of a body. With nearly equal radii `r` the gap of parabolas
/// differs at the half-width `a` from that of circles by its share `3 a^2/(4 r^2)`, here 7 %.
const LARGEST_CONFORMAL: f64 = 0.3;
/// Largest depth of dimples over their diameter.
const STEEPEST_DIMPLE: f64 = 0.1;
/// Range of ellipticities of the formula of Hamrock and Dowson.
const ELLIPTICITIES: [f64; 2] = [1.0, 8.0];
/// Largest von Mises stress over the Hertz pressure for circular and line contacts at Poisson's ratio 0.3 (Johnson, K. L.
/// (1985), Contact Mechanics, sections 4.2 and 4.4).
const POINT_MISES: f64 = 0.62;
const LINE_MISES: f64 = 0.558;

/// Warnings about half-spaces, parabolas, film formula and yield.
pub(super) fn of_models(scene: &Scene) -> Vec<Warning> {
    let Ok(operating_schedule) = OperatingSchedule::new(scene) else { return Vec::new() };
    let [_, largest] = operating_schedule.loads();
    let heaviest = if scene.schedule.load.is_some() { scene.hertz_under(largest) } else { scene.hertz() };
    let Ok(hertz) = heaviest else { return Vec::new() };
    let formula = scene.hertz().and_then(|at_start| film_formula(scene, &at_start)).ok().flatten();
    let index = scene.lubricant.and_then(|lubricant| negative_index(&lubricant.oil?));
    let checks =
        [slope(scene, &hertz), formula, soft_surface(scene, &hertz), weak_body(scene, &hertz), index];
    checks.into_iter().flatten().chain(dimples(scene)).collect()
}

/// An oil whose viscosity falls faster with temperature than that of the reference oils of the viscosity index.
pub(super) fn negative_index(oil: &OilSpec) -> Option<Warning> {
    let index = oil.viscosity_index.filter(|index| *index < 0.0)?;
    let message =
        "the viscosity falls faster with temperature than that of the reference oils of index 0".to_owned();
    let remedy =
        "paraffinic mineral oils have about 95; check the data sheet, or give two viscosities".to_owned();
    Some(Warning::new("lubricant.viscosity_index", index, message, remedy))
}

/// Dimples of the bodies of a lubricated contact that are too steep for the Reynolds equation.
fn dimples(scene: &Scene) -> Vec<Warning> {
    if !scene.is_lubricated() {
        return Vec::new();
    }
    let bodies = BODIES.into_iter().zip([&scene.roughness.ball, &scene.roughness.disc]);
    let steep = bodies.filter_map(|(name, roughness)| match roughness {
        Roughness::Texture(Texture::Dimples { radius, depth, .. }) => {
            steep_dimples(&format!("roughness.{name}.depth"), *depth, 2.0 * radius)
        }
        _ => None,
    });
    steep.collect()
}

/// The warning about dimples of a `depth` and a `diameter` \[m\] that are steep.
pub(super) fn steep_dimples(field: &str, depth: f64, diameter: f64) -> Option<Warning> {
    (depth > STEEPEST_DIMPLE * diameter).then(|| {
        let message = format!(
            "it is {} of the diameter: the Reynolds equation holds for films of small slopes",
            short((1e3 * depth / diameter).round() / 1e3)
        );
        Warning::new(field, depth, message, "shallower dimples; take load and friction as a guess".to_owned())
    })
}

/// A contact whose width is comparable to the reduced radii, or in a concave body to the radii of the bodies.
fn slope(scene: &Scene, hertz: &HertzContact) -> Option<Warning> {
    let (radius_x, radius_y) = scene.form.radii();
    let ratio = (hertz.half_width_x / radius_x).max(hertz.half_width_y / radius_y);
    let conformal = conformal_ratio(scene, hertz);
    let message = if conformal > LARGEST_CONFORMAL {
        format!(
            "the contact has a half-width of {} of the smaller radius of a body: at its edge the gap of parabolas differs by {} % from \
             that of circles, and half-spaces do not hold; up to {LARGEST_CONFORMAL} it is 7 %",
            short((1e3 * conformal).round() / 1e3),
            short((75.0 * conformal.powi(2)).round())
        )
    } else if ratio > LARGEST_SLOPE {
        format!(
            "the contact has a half-width of {} of the radius: elastic half-spaces and parabolas hold up to {LARGEST_SLOPE}",
            short(ratio)
        )
    } else {
        return None;
    };
    let (field, value) = match scene.load.hertz_pressure {
        Some(pressure) if scene.schedule.load.is_none() => ("load.hertz_pressure", pressure),
        _ => ("load.force", hertz.force),
    };
    let remedy = match osculation(scene) {
        _ if conformal <= LARGEST_CONFORMAL => "lower the load or check radius and modulus".to_owned(),
        Some(osculation) => format!(
            "less load or a wider groove: its osculation, the radius of the groove over the diameter of the ball, is {}; of rolling bearings it is \
             0.51 to 0.54",
            short((1e4 * osculation).round() / 1e4)
        ),
        None => {
            "less load or more clearance; [given_film] with kind = \"journal\" computes a journal in its bush"
                .to_owned()
        }
    };
    Some(Warning::new(field, value, message, remedy))
}

/// Radius of a groove over the diameter of the ball in it; `None` for bodies that are concave in both sections or in none.
fn osculation(scene: &Scene) -> Option<f64> {
    let Form::Bodies { x, y, .. } = scene.form else { return None };
    let is_concave = |radii: [f64; 2]| radii.iter().any(|radius| *radius < 0.0);
    let [ball, groove] = match (scene.form.is_line(), is_concave(x), is_concave(y)) {
        (false, true, false) => x,
        (false, false, true) => y,
        _ => return None,
    };
    Some((ball / groove).abs().max((groove / ball).abs()) / 2.0)
}

/// Half-width of the contact over the smaller radius of the bodies in sections with a concave body; zero without one.
fn conformal_ratio(scene: &Scene, hertz: &HertzContact) -> f64 {
    let Form::Bodies { x, y, .. } = scene.form else { return 0.0 };
    let section = |radii: [f64; 2], half_width: f64| {
        let smaller = radii.iter().fold(f64::INFINITY, |smaller, radius| smaller.min(radius.abs()));
        if radii.iter().any(|radius| *radius < 0.0) { half_width / smaller } else { 0.0 }
    };
    section(x, hertz.half_width_x).max(section(y, hertz.half_width_y))
}

/// A pressure limit below the pressure of the smooth contact.
fn soft_surface(scene: &Scene, hertz: &HertzContact) -> Option<Warning> {
    let [ball, disc] = scene.hardnesses(scene.plastic?.hardness);
    let hardness = ball.min(disc);
    (hardness < hertz.pressure).then(|| {
        Warning::new(
            "plastic.hardness",
            hardness,
            format!(
                "the hardness is below the Hertz pressure of {} Pa: the bodies yield as wholes, while `[plastic]` limits the pressure of \
                 asperities on elastic bodies",
                short(hertz.pressure)
            ),
            "lower the load; the hardness of steel is 2 to 8 GPa".to_owned(),
        )
    })
}

/// A disc that yields below the surface of the smooth contact.
fn weak_body(scene: &Scene, hertz: &HertzContact) -> Option<Warning> {
    let strength = scene.stress?.yield_strength?;
    let share = if scene.form.is_line() { LINE_MISES } else { POINT_MISES };
    let ratio = share * hertz.pressure / strength;
    (ratio > 1.0).then(|| {
        Warning::new(
            "stress.yield_strength",
            strength,
            format!(
                "the von Mises stress below the smooth contact is {} times the yield strength: bodies yield below the surface, which no part \
                 of the model follows",
                short((1e3 * ratio).round() / 1e3)
            ),
            format!("Hertz pressures up to {} Pa", short(strength / share)),
        )
    })
}

/// Entrainment outside of the range of the film formulas.
fn film_formula(scene: &Scene, hertz: &HertzContact) -> Result<Option<Warning>, InputError> {
    let Some(formulas) = scene.formula_film()? else { return Ok(None) };
    let ellipticity = ellipticity(scene, hertz)?;
    let [narrowest, widest] = ELLIPTICITIES;
    let message = if hertz.angle != 0.0 {
        format!(
            "the formula of {} is for entrainment along an axis of the ellipse; it takes the sections along and across it",
            formulas.formula
        )
    } else if !scene.form.is_line() && !(narrowest - 1e-9..=widest).contains(&ellipticity) {
        format!(
            "the ellipticity of {} is outside the range of the formula of {}, 1 to 8",
            short(ellipticity),
            formulas.formula
        )
    } else {
        return Ok(None);
    };
    let remedy = "take the film of the solve, not that of the formula".to_owned();
    let density = oil::density(scene, scene.conditions(0.0)?.bulk_temperature)?;
    let film = formulas.compressed(scene, hertz, density.as_deref());
    Ok(Some(Warning::new("film.formula_central", film, message, remedy)))
}
