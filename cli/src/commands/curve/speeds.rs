//! Speeds of a Stribeck curve by default.

use stribeck::analytic::MixedLoadShare;
use stribeck::metrics::composite_rq;
use stribeck::sim::scene::{Roughness, Scene};
use stribeck::sim::{MixedLubricationSim, SimError};

/// Films over the composite Rq at the lowest and the highest speed. Above the second asperities do not touch.
const LAMBDAS: [f64; 2] = [0.03, 3.0];
/// Load ratio by the inlets of the asperities at the lowest speed, if that is lower still.
const BOUNDARY: f64 = 0.97;
/// Lowest and highest speed over that of the scene for smooth bodies; between rough ones the highest is at most the second.
const AROUND: [f64; 2] = [0.1, 10.0];
/// Speed \[m/s\] that is within the range of rough bodies in any case: shear in the inlet then thins the film of an oil of 10 mPa s by a
/// tenth, which isothermal films leave out (Gupta et al. 1992, J. Tribol. 114, 55-62).
const ISOTHERMAL_SPEED: f64 = 10.0;
/// Decades of speed about that of the scene that are searched.
const DECADES: f64 = 6.0;
/// Bisections of that range.
const BISECTIONS: u32 = 40;

/// Lowest and highest speed by default, about that of the scene: from a load on solids to full films, by formula.
pub(super) fn usual(scene: &Scene, own: f64) -> Result<[f64; 2], SimError> {
    let around = AROUND.map(|factor| factor * own);
    let rq = [&scene.roughness.ball, &scene.roughness.disc].map(|surface| match surface {
        Roughness::Random(surface) => surface.rq,
        Roughness::File(file) => file.rq.unwrap_or(0.0),
        _ => 0.0,
    });
    let rq = composite_rq(rq[0], rq[1]);
    if rq == 0.0 || own == 0.0 {
        return Ok(around);
    }
    let [low, high] = LAMBDAS.map(|lambda| speed_of_film(scene, own, lambda * rq));
    let (low, highest) = (low?.min(own), ISOTHERMAL_SPEED.max(around[1]));
    Ok([boundary_speed(scene, low)?.unwrap_or(low), high?.min(highest).max(own)])
}

/// The speed \[m/s\] at which solids carry the load, if it is below `speed`; the inlet number is proportional to the speed.
fn boundary_speed(scene: &Scene, speed: f64) -> Result<Option<f64>, SimError> {
    let mut scene = scene.clone();
    scene.schedule.entrainment_speed = None;
    scene.motion.entrainment_speed = speed;
    let film = MixedLubricationSim::builder(scene).build()?.expectation()?.film;
    let slower = |number: f64| speed * MixedLoadShare::inlet_number_at(BOUNDARY) / number;
    Ok(film.and_then(|film| film.inlet_number).map(slower).filter(|slower| *slower < speed))
}

/// The speed \[m/s\] at which the central film by formula is `film` \[m\].
fn speed_of_film(scene: &Scene, own: f64, film: f64) -> Result<f64, SimError> {
    let mut scene = scene.clone();
    scene.schedule.entrainment_speed = None;
    let [mut low, mut high] = [-DECADES, DECADES];
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        scene.motion.entrainment_speed = own * 10.0_f64.powf(middle);
        let is_thinner = scene.formula_film()?.is_none_or(|formula| formula.central < film);
        *(if is_thinner { &mut low } else { &mut high }) = middle;
    }
    Ok(own * 10.0_f64.powf(0.5 * (low + high)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The disc of 130 nm of Azam et al. at 0.1 m/s has a film of 0.06 Rq by formula, of 3 Rq far above 10 m/s. Rougher discs have most
    /// of the load on solids at 0.03 Rq, ground ones only far below.
    #[test]
    fn speeds_span_thin_to_full_films() {
        let mut scene = Scene::azam_2019(32);
        let lambda = |scene: &Scene, speed: f64| {
            let mut scene = scene.clone();
            scene.motion.entrainment_speed = speed;
            scene.formula_film().unwrap().unwrap().central / 20e-9_f64.hypot(130e-9)
        };
        let [low, high] = usual(&scene, 0.1).unwrap();
        assert!(lambda(&scene, low) <= LAMBDAS[0] * (1.0 + 1e-6), "{low}");
        let mut slow = scene.clone();
        slow.motion.entrainment_speed = low;
        let film = MixedLubricationSim::builder(slow).build().unwrap().expectation().unwrap().film.unwrap();
        let number = film.inlet_number.unwrap() / MixedLoadShare::inlet_number_at(BOUNDARY);
        assert!(number < 1.0 + 1e-9, "{film:?}");
        assert!((high - ISOTHERMAL_SPEED).abs() < 1e-12, "{high}");
        scene.lubricant = scene.lubricant.map(|oil| oil.with_eta0(0.4));
        let [_, high] = usual(&scene, 0.1).unwrap();
        assert!((lambda(&scene, high) / LAMBDAS[1] - 1.0).abs() < 1e-6 && high < 10.0, "{high}");
        scene.roughness = Default::default();
        let [low, high] = usual(&scene, 0.5).unwrap();
        assert!((low - 0.05).abs() < 1e-12 && (high - 5.0).abs() < 1e-12, "{low} {high}");
    }
}
