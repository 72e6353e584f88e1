//! Random surfaces of a curve.

use std::{panic, thread};

use stribeck::InputError;
use stribeck::sim::ContactSolution;
use stribeck::sim::scene::{GridSpec, Roughness, Scene};

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

/// How many of `count` surfaces are solved at once: one for each processor.
pub(super) fn at_once(count: usize) -> usize {
    thread::available_parallelism().map_or(1, usize::from).clamp(1, count.max(1))
}

/// Does all `solves` at once, each on a thread.
pub(super) fn together<T: Send>(solves: Vec<impl FnOnce() -> T + Send>) -> Vec<T> {
    thread::scope(|scope| {
        let threads: Vec<_> = solves.into_iter().map(|solve| scope.spawn(solve)).collect();
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
