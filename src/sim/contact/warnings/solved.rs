//! Warnings about a solution.

use super::left_out::{OperatingPoint, left_out};
use super::quantity::FRICTION;
use super::{Warning, short, strip_mesh};
use crate::sim::contact::error_estimate::ErrorEstimate;
use crate::sim::contact::oil;
use crate::sim::contact::solution::ContactSolution;
use crate::sim::scene::hertz::HertzContact;
use crate::sim::scene::{GridSpec, Scene};

/// Largest rise of a film above the bulk temperature \[K\].
const LARGEST_RISE: f64 = 100.0;
/// Largest cell width over inlet length: above it central films of smooth contacts may have errors of a tenth or more.
const WIDEST_CELL: f64 = 2.0;
/// Cell width over inlet length above which the film is not resolved at all.
const UNRESOLVED_CELL: f64 = 10.0;
/// Largest central film over the smaller reduced radius. Where the gap of paraboloids is two films it then differs by 2 % from
/// that of circles.
const THICKEST_FILM: f64 = 0.02;
/// Load ratio above which smooth bodies count as touching.
const SMOOTH_TOUCHING: f64 = 0.01;
/// Widest range of the load ratio by asperity inlets without a warning. Of many asperities it is at most 0.32, by the closed form
/// of the load ratio.
const WIDEST_LOAD_RATIO: f64 = 0.4;
/// Largest estimated error without a warning.
const LARGEST_ERROR: f64 = 0.1;

/// Values of a single contact, or of the first one of a history, that are checked.
pub(in crate::sim) struct SolvedContact<'a> {
    /// The contact between smooth dry bodies.
    pub(in crate::sim) hertz: &'a HertzContact,
    /// Width of the cells along the flow \[m\].
    pub(in crate::sim) dx: f64,
    /// Whether the bodies are smooth.
    pub(in crate::sim) smooth: bool,
    /// Central and minimum film \[m\].
    pub(in crate::sim) central_film: f64,
    pub(in crate::sim) minimum_film: f64,
    /// Friction over the load.
    pub(in crate::sim) friction: f64,
    /// Load ratio.
    pub(in crate::sim) load_ratio: f64,
    /// Largest temperature of the film and bulk temperature \[K\], if the film temperature is modelled.
    pub(in crate::sim) temperatures: Option<[f64; 2]>,
}

/// Warnings about a contact of `scene`; `with_error` if the error of its mesh is known.
pub(in crate::sim) fn of_contact(scene: &Scene, seen: &SolvedContact<'_>, with_error: bool) -> Vec<Warning> {
    let inlet = (seen.smooth && !with_error).then(|| coarse_inlet(scene, seen)).flatten();
    let hot = seen.temperatures.and_then(|[largest, bulk]| hot_film(largest, bulk));
    let thick = scene.is_lubricated().then(|| thick_film(scene, seen.central_film)).flatten();
    let friction = FRICTION.check("friction.coefficient", seen.friction).map(|found| Warning {
        remedy: "look at the friction of solids, the viscosity and the load".to_owned(),
        ..found
    });
    let touching = (seen.smooth && scene.is_lubricated()).then(|| touching(scene, seen.load_ratio)).flatten();
    let strip =
        (!seen.smooth && !with_error).then(|| strip_mesh::coarse_strip(scene, seen.load_ratio)).flatten();
    inlet.into_iter().chain(thick).chain(hot).chain(friction).chain(touching).chain(strip).collect()
}

/// Warnings about the finished `solution` of `scene`.
pub(in crate::sim) fn after_solve(scene: &Scene, solution: &ContactSolution) -> Vec<Warning> {
    let conditions = scene.conditions(0.0).ok();
    let film = solution.thermal.as_ref().zip(conditions);
    // Heights in memory may be rough although the scene has no roughness.
    let smooth = scene.is_smooth() && solution.roughness.composite_rq == 0.0;
    let seen = SolvedContact {
        hertz: &solution.hertz,
        dx: solution.grid.dx(),
        smooth,
        central_film: solution.film.central,
        minimum_film: solution.film.minimum,
        friction: solution.friction.coefficient,
        load_ratio: solution.contact.load_ratio,
        temperatures: film.map(|(heat, at)| [heat.film_temperature_max, at.bulk_temperature]),
    };
    let mut list = of_contact(scene, &seen, solution.error_estimate.is_some());
    list.extend(conditions.iter().flat_map(|&conditions| {
        let law = oil::viscosity(scene, conditions.bulk_temperature).ok().flatten();
        let point = OperatingPoint {
            hertz: &solution.hertz,
            conditions,
            viscosity: law.as_deref(),
            composite_rq: if smooth { 0.0 } else { solution.roughness.composite_rq },
            largest_pressure: Some(solution.pressure.max),
            friction: [solution.friction.boundary, solution.friction.fluid],
            film: solution.film.mean_central,
            load_ratio: solution.contact.load_ratio,
            yield_ratio: solution.stress.and_then(|stress| stress.yield_ratio),
        };
        left_out(scene, &point)
    }));
    list.extend(mesh_errors(scene, solution));
    list.extend(sensitive_inlets(solution));
    // Checks of the smooth contact may have reported the same field before the solve.
    list.retain(|found| solution.warnings.iter().all(|known| known.field != found.field));
    list
}

/// A load ratio by asperity inlets that their accuracy does not settle, or without the flow through the valleys.
fn sensitive_inlets(solution: &ContactSolution) -> Option<Warning> {
    let [least, most] = solution.report.load_ratio_range?;
    let reason = if solution.report.has_valley_flow == Some(false) {
        "the flow of the oil through the valleys between the asperities did not converge, its pressure is left out: load ratios may be \
         too large by up to 0.3"
            .to_owned()
    } else if most - least > WIDEST_LOAD_RATIO {
        format!(
            "few asperities decide it: it is between {least:.2} and {most:.2} where the pressure that builds up in their inlets is \
             20 % higher or lower, the accuracy of asperity inlets"
        )
    } else {
        return None;
    };
    Some(Warning::new(
        "contact.load_ratio",
        solution.contact.load_ratio,
        reason,
        "take the mean over several seeds of the roughness with a margin, or the resolved model".to_owned(),
    ))
}

/// Cells too wide for the inlet, which determines the films of a smooth contact. Around a wide plateau the film is thinner and
/// needs more cells: on 4.5 inlets a cell the central film of a soft ball errs by 1 %, the minimum film by 60 %.
///
/// The gap upstream of the contact is `a^2/R (s/a)^(3/2)` at the distance `s` from its edge; the fluid pressure builds up
/// where it equals the film.
fn coarse_inlet(scene: &Scene, seen: &SolvedContact<'_>) -> Option<Warning> {
    let SolvedContact { hertz, dx, central_film: central, .. } = *seen;
    let along = hertz.half_width_x;
    let length = (central * scene.form.radii().0 / along.powi(2)).powf(2.0 / 3.0) * along;
    (scene.is_lubricated() && hertz.angle == 0.0 && dx > WIDEST_CELL * length).then(|| {
        Warning::new(
            "film.minimum",
            seen.minimum_film,
            format!(
                "cells of {} m are wider than twice the inlet of the film, {} m: {}",
                short(dx),
                short(length),
                if dx > UNRESOLVED_CELL * length {
                    "minimum and central film may err by a half and more"
                } else {
                    "the minimum film may err by a half and more, the central film by up to a half"
                }
            ),
            "more cells, or solver.estimate or solver.accuracy, which tell the error".to_owned(),
        )
    })
}

/// A central film \[m\] so thick that the gap which makes it is no longer that of paraboloids.
///
/// The gap `x^2/2R` of a paraboloid differs from that of a circle by its share `x^2/4R^2`, which is `g/2R` where the gap is g.
fn thick_film(scene: &Scene, central: f64) -> Option<Warning> {
    let (along, across) = scene.form.radii();
    let radius = along.min(across);
    (central > THICKEST_FILM * radius).then(|| {
        Warning::new(
            "film.central",
            central,
            format!(
                "the film is {} of the radius of {} m: bodies are paraboloids, whose gap differs by {} % from that of circles \
                 where it is two films",
                short(central / radius),
                short(radius),
                short(100.0 * central / radius)
            ),
            "take the film as a guess, or more load, or less speed or viscosity".to_owned(),
        )
    })
}

/// Smooth bodies that touch: the film is the contact film, which then determines the load ratio.
fn touching(scene: &Scene, load_ratio: f64) -> Option<Warning> {
    (load_ratio > SMOOTH_TOUCHING).then(|| {
        Warning::new(
            "contact.load_ratio",
            load_ratio,
            format!(
                "smooth bodies touch at the contact film of {} m, which decides on the share of solids and the friction",
                short(scene.solver.film_cutoff)
            ),
            "give the roughness of the bodies, or the contact film (solver.film_cutoff)".to_owned(),
        )
    })
}

/// A film whose largest temperature \[K\] is so far above the `bulk` temperature that viscosity laws do not hold.
fn hot_film(largest: f64, bulk: f64) -> Option<Warning> {
    let rise = largest - bulk;
    (rise > LARGEST_RISE).then(|| {
        Warning::new(
            "thermal.film_temperature_max",
            largest,
            format!(
                "the film is {} K above the bulk temperature: laws of viscosity by temperature hold over some {LARGEST_RISE} K",
                short(rise)
            ),
            "take film and friction as a guess".to_owned(),
        )
    })
}

/// Large estimated errors, or requested estimates that are missing.
fn mesh_errors(scene: &Scene, solution: &ContactSolution) -> Vec<Warning> {
    let wanted = match scene.grid {
        GridSpec::Accuracy { accuracy } => Some(("grid.accuracy", accuracy)),
        _ => scene.solver.accuracy.map(|accuracy| ("solver.accuracy", accuracy)),
    };
    let Some(estimate) = solution.error_estimate else {
        let asked = wanted.or(scene.solver.estimate.then_some(("solver.estimate", 1.0)));
        let unknown = asked.map(|(field, value)| {
            let message = "no error could be estimated: a coarser mesh was not solved".to_owned();
            Warning::new(field, value, message, "more cells".to_owned())
        });
        return unknown.into_iter().collect();
    };
    let rough = solution.roughness.composite_rq > 0.0;
    let missed = wanted.and_then(|wanted| missed_accuracy(wanted, scene, (&estimate, solution)));
    missed.into_iter().chain(large_errors(&estimate, rough)).collect()
}

/// The warning about an accuracy that the meshes did not reach, with its field and value.
fn missed_accuracy(
    (field, accuracy): (&'static str, f64),
    scene: &Scene,
    (estimate, solution): (&ErrorEstimate, &ContactSolution),
) -> Option<Warning> {
    let friction = &solution.friction;
    let largest = match scene.grid {
        GridSpec::Accuracy { .. } if scene.is_smooth() => estimate.of_smooth(scene.is_lubricated()),
        _ => estimate.of_cells([friction.coefficient, friction.fluid]),
    };
    (largest > accuracy).then(|| {
        let message = format!("the estimated error is {}, above the accuracy asked for", short((1e4 * largest).round() / 1e4));
        let remedy = if estimate.film_by_box > 0.5 * largest {
            "a longer inlet, grid.x with nx in place of accuracy: the error is that of the box and not of its cells"
        } else {
            "more cells, nx and ny, than those of the last mesh"
        };
        Warning::new(field, accuracy, message, remedy.to_owned())
    })
}

/// The warning about the largest estimate above [`LARGEST_ERROR`]; it names the others too.
pub(in crate::sim) fn large_errors(estimate: &ErrorEstimate, rough: bool) -> Option<Warning> {
    let points = [
        ("film_central", estimate.film_central),
        ("film_minimum", estimate.film_minimum),
        ("pressure_max", estimate.pressure_max),
    ];
    let errors = [
        ("film_mean_central", estimate.film_mean_central),
        ("contact_load_ratio", estimate.contact_load_ratio),
        ("contact_area_ratio", estimate.contact_area_ratio),
        ("friction_coefficient", estimate.friction_coefficient),
    ];
    // NaN does not count as small.
    let points = points.into_iter().filter(|_| !rough);
    let large =
        errors.into_iter().chain(points).filter(|(_, error)| error.is_nan() || *error > LARGEST_ERROR);
    let large: Vec<(&str, f64)> = large.collect();
    let (worst, error) = large.iter().copied().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let names: Vec<String> =
        large.iter().map(|(name, error)| format!("{name} {}", short((1e3 * error).round() / 1e3))).collect();
    Some(Warning::new(
        format!("error_estimate.{worst}"),
        error,
        format!("errors of the mesh above {LARGEST_ERROR}: {}", names.join(", ")),
        "more cells: nx and ny, or solver.accuracy, which refines given cells".to_owned(),
    ))
}
