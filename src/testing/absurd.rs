//! Random scenes that no user means, for the promise that nothing panics and every error names its field.
//!
//! A new key of scenes that can be wrong belongs into [`distort`], with [`CHANGES`] raised by one.

use proptest::prelude::*;

use super::strategies::{decades, scenes};
use crate::sim::Scene;
use crate::sim::scene::{
    ArchardSpec, FileRoughness, FrictionSpec, GhanbarzadehSpec, GridSpec, Load, LubricantSpec, Material,
    PlasticSpec, Roughness, Schedule, SolverSpec, ThermalSpec, TribofilmSpec, WearSpec,
};
use crate::surface::{Autocorrelation, Form, RoughnessSpec};

/// Values that no physical quantity should have, or hardly any.
const ABSURD: [f64; 12] = [
    0.0,
    -0.0,
    -1.0,
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::MIN_POSITIVE,
    1e-300,
    1e-30,
    1e30,
    1e300,
    f64::MAX,
];

/// Scenes of [`scenes`] of which up to three values are absurd: zero, negative, huge, tiny or no number,
/// boxes beside the contact, grids of one or two nodes, a hardness that cannot carry the load, an accuracy
/// that cannot be reached.
///
/// # Examples
///
/// ```
/// use proptest::strategy::{Strategy, ValueTree};
/// use proptest::test_runner::TestRunner;
/// use stribeck::sim::MixedLubricationSim;
/// let mut runner = TestRunner::deterministic();
/// for _ in 0..20 {
///     let tree = stribeck::testing::absurd_scenes().new_tree(&mut runner);
///     let scene = tree.map_err(|reason| reason.to_string())?.current();
///     // Refused or not: it neither panics nor solves anything.
///     if let Err(error) = MixedLubricationSim::builder(scene).check_contact() {
///         assert!(!error.to_string().is_empty());
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn absurd_scenes() -> impl Strategy<Value = Scene> {
    let values = prop_oneof![prop::sample::select(&ABSURD[..]), any::<f64>(), decades(1e-12, 1e12)];
    let changes = prop::collection::vec((0_usize..CHANGES, values), 0..4);
    (scenes(), changes).prop_map(|(mut scene, changes)| {
        for (change, value) in changes {
            distort(&mut scene, change, value);
        }
        let smooth = scene.is_smooth();
        if let (GridSpec::Accuracy { .. }, false) = (scene.grid, smooth) {
            // A rough contact would be refined for long.
            scene.grid = GridSpec::Accuracy { accuracy: 0.5 };
        }
        scene
    })
}

/// Kinds of changes that [`distort`] knows.
const CHANGES: usize = 44;

/// Puts `value` where number `change` (below [`CHANGES`]) says; sizes of grids take what is left of it as a
/// small whole number.
fn distort(scene: &mut Scene, change: usize, value: f64) {
    let small = |value: f64| value.abs().min(3.0) as usize;
    let lubricant = |scene: &mut Scene, set: fn(&mut LubricantSpec, f64), value: f64| {
        if let Some(spec) = &mut scene.lubricant {
            set(spec, value);
        }
    };
    match change {
        0 => scene.form = Form::Sphere { radius: value },
        1 => scene.form = Form::Ellipsoid { radius_x: value, radius_y: 1e-2, angle: 0.0 },
        2 => scene.form = Form::Cylinder { radius: value },
        3 => scene.elastic.equivalent_modulus = value,
        4 => scene.load = Load::hertz_pressure(value),
        5 => scene.load = Load::force(value),
        6 => scene.load = Load { hertz_pressure: Some(value), force: Some(value) },
        7 => scene.load = Load::default(),
        8 => scene.motion.entrainment_speed = value,
        9 => scene.motion.slide_roll_ratio = value,
        10 => lubricant(scene, |spec, value| spec.eta0 = value, value),
        11 => lubricant(scene, |spec, value| spec.roelands_z = value, value),
        12 => lubricant(scene, |spec, value| spec.roelands_p0 = value, value),
        13 => lubricant(scene, |spec, value| spec.alpha = Some(value), value),
        14 => lubricant(scene, |spec, value| spec.density_a = value, value),
        15 => lubricant(scene, |spec, value| spec.density_b = value, value),
        16 => scene.grid = GridSpec::Cells { nx: 1, ny: 16, x: [-3e-4, 3e-4], y: [-3e-4, 3e-4] },
        17 => scene.grid = GridSpec::Cells { nx: 16, ny: small(value), x: [-3e-4, 3e-4], y: [-3e-4, 3e-4] },
        18 => {
            scene.grid =
                GridSpec::Cells { nx: small(value), ny: small(value), x: [-1.0, 1.0], y: [-1.0, 1.0] }
        }
        // The contact over the edge of the box, or outside.
        19 => scene.grid = GridSpec::Cells { nx: 16, ny: 16, x: [-2e-5, 4e-4], y: [-3e-4, 3e-4] },
        20 => scene.grid = GridSpec::Cells { nx: 16, ny: 16, x: [value, 4e-4], y: [-3e-4, value] },
        21 => scene.grid = GridSpec::Cells { nx: 16, ny: 16, x: [1e-5, 4e-4], y: [-3e-4, 3e-4] },
        22 => scene.grid = GridSpec::Cells { nx: usize::MAX, ny: usize::MAX, x: [-1.0, 1.0], y: [-1.0, 1.0] },
        23 => scene.grid = GridSpec::Row { nx: small(value), x: [-value, value] },
        24 => scene.grid = GridSpec::Accuracy { accuracy: if value < 0.1 { value } else { 0.5 } },
        25 => scene.roughness.ball = Roughness::gaussian(value, 1e-5, 1),
        26 => {
            let autocorrelation = Autocorrelation::Exponential;
            let spec = RoughnessSpec { autocorrelation, rq: 1e-7, length_x: value, length_y: 1e-5, seed: 1 };
            scene.roughness.disc = spec.into();
        }
        27 => {
            scene.roughness.disc =
                Roughness::File(FileRoughness { path: "there is no such file.npy".into(), rq: Some(value) });
        }
        28 => {
            scene.plastic =
                Some(PlasticSpec { hardness: value, film_hardness: None, hardening_modulus: None });
        }
        // Below the mean pressure: nothing carries the load.
        29 => {
            scene.plastic = Some(PlasticSpec { hardness: 1e6, film_hardness: None, hardening_modulus: None });
        }
        30 => {
            scene.plastic = Some(PlasticSpec {
                hardness: 6e9,
                film_hardness: Some(value),
                hardening_modulus: Some(value),
            });
        }
        31 => scene.friction = FrictionSpec { boundary_coefficient: value, ..scene.friction },
        32 => {
            scene.friction =
                FrictionSpec { limiting_shear_stress: value, eyring_stress: Some(value), ..scene.friction };
        }
        33 => {
            let film = GhanbarzadehSpec { maximum_thickness: value, ..GhanbarzadehSpec::default() };
            scene.tribofilm = Some(TribofilmSpec::Ghanbarzadeh(film));
        }
        34 => {
            let film =
                GhanbarzadehSpec { x_tribo: value, removal_rate: value, ..GhanbarzadehSpec::default() };
            scene.tribofilm = Some(TribofilmSpec::Ghanbarzadeh(film));
        }
        35 => {
            let wear = ArchardSpec { coefficient: value, film_coefficient: 0.0, ..ArchardSpec::default() };
            scene.wear = Some(WearSpec::Archard(wear));
        }
        36 => {
            scene.wear = Some(WearSpec::Archard(ArchardSpec { hardness: value, ..ArchardSpec::default() }));
            scene.track.radius_ball = Some(value);
        }
        37 => scene.thermal = ThermalSpec { bulk_temperature: value, conductivity: value, ..scene.thermal },
        38 => (scene.materials.ball.modulus, scene.materials.ball.poisson) = (Some(value), Some(0.3)),
        39 => {
            scene.materials.disc =
                Material { hardness: Some(value), diffusivity: Some(value), ..Material::default() }
        }
        40 => scene.schedule.load = Some(Schedule::ramps(&[(0.0, value), (value, 20.0)])),
        41 => {
            scene.schedule.entrainment_speed = Some(Schedule::steps(&[(-1.0, 0.1), (0.0, value)]));
            scene.schedule.bulk_temperature = Some(Schedule::Constant { value });
        }
        42 => scene.solver = SolverSpec { tolerance: value, max_iterations: 0, ..scene.solver },
        _ => {
            scene.solver =
                SolverSpec { film_cutoff: value, relaxation: value, stiffness: value, ..scene.solver };
        }
    }
}
