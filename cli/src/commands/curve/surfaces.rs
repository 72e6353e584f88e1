//! Random surfaces of a curve.

use std::{panic, thread};

use stribeck::InputError;
use stribeck::elastic::HalfSpace;
use stribeck::sim::scene::{GridSpec, Roughness, Scene};
use stribeck::sim::{ContactSolution, SimBuilder, SimError};

/// Difference of the seeds of one surface and the next.
const STRIDE: u64 = 1000;
/// Shares of the load on solids between which a contact is mixed.
const MIXED: std::ops::RangeInclusive<f64> = 0.02..=0.98;

/// Surfaces of a strip of the default width, one sample of which scatters.
const OF_STRIPS: u32 = 4;

/// The scene with so many random surfaces: its own and others whose seeds are 1000, 2000, ... larger. Without a number
/// the scene alone, or four surfaces of a strip whose width is the default of its roughness.
///
/// # Errors
/// A scene without a random surface.
pub(super) fn scenes(scene: &Scene, seeds: Option<u32>) -> Result<Vec<Scene>, InputError> {
    let has_default_width = matches!(scene.grid, GridSpec::Strip { y: None, .. });
    let seeds = seeds.unwrap_or(if has_default_width && is_random(scene) { OF_STRIPS } else { 1 });
    if seeds > 1 && !is_random(scene) {
        return Err(InputError::Conflict {
            field: format!("--seeds = {seeds}"),
            reason:
                "neither [roughness.ball] nor [roughness.disc] is random, so all surfaces would be the same; \
                     leave --seeds out"
                    .to_owned(),
        });
    }
    Ok((0..u64::from(seeds)).map(|number| with_seeds(scene, number)).collect())
}

/// The elastic half-space of a point contact on a fixed grid without a layer; `None` for any other.
pub(super) fn half_space(scene: &Scene) -> Option<HalfSpace> {
    let is_plain = matches!(scene.grid, GridSpec::Cells { .. }) && !scene.form.is_line();
    if !is_plain || scene.elastic.layer.is_some() {
        return None;
    }
    HalfSpace::new(scene.grid().ok()?, scene.equivalent_modulus().ok()?).ok()
}

/// How many of `count` surfaces are solved at once: one for each processor.
pub(super) fn at_once(count: usize) -> usize {
    thread::available_parallelism().map_or(1, usize::from).clamp(1, count.max(1))
}

/// Solves all contacts at once, each on a thread.
pub(super) fn solve_together(builders: Vec<SimBuilder>) -> Vec<Result<ContactSolution, SimError>> {
    thread::scope(|scope| {
        let threads: Vec<_> =
            builders.into_iter().map(|builder| scope.spawn(move || builder.solve())).collect();
        let ended = threads.into_iter().map(thread::ScopedJoinHandle::join);
        ended.map(|ended| ended.unwrap_or_else(|fault| panic::resume_unwind(fault))).collect()
    })
}

/// Whether ball or disc have generated random heights.
pub(super) fn is_random(scene: &Scene) -> bool {
    let bodies = [&scene.roughness.ball, &scene.roughness.disc];
    bodies.into_iter().any(|body| matches!(body, Roughness::Random(surface) if surface.rq > 0.0))
}

/// Whether solids and fluid share the load.
pub(super) fn is_mixed(solution: &ContactSolution) -> bool {
    MIXED.contains(&solution.contact.load_ratio)
}

fn with_seeds(scene: &Scene, number: u64) -> Scene {
    let mut scene = scene.clone();
    for body in [&mut scene.roughness.ball, &mut scene.roughness.disc] {
        if let Roughness::Random(surface) = body {
            surface.seed = surface.seed.wrapping_add(STRIDE * number);
        }
    }
    scene
}
