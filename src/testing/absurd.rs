//! Random invalid scenes, for the property that nothing panics and every error names its field.
//!
//! A new scene key with a restricted range belongs to [`CHANGES`].

use proptest::prelude::*;

use super::strategies::{decades, scenes};
use crate::sim::Scene;
use crate::sim::scene::{
    ArchardSpec, FileRoughness, FrictionSpec, GhanbarzadehSpec, GridSpec, Load, LubricantSpec, Material,
    PlasticSpec, Roughness, Schedule, SolverSpec, ThermalSpec, TribofilmSpec, WearLawSpec, WearSpec,
};
use crate::surface::{Autocorrelation, Form, RoughnessSpec};

/// Values outside the plausible range of most quantities.
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

/// Scenes of [`scenes`] with up to three absurd values: zero, negative, huge, tiny or NaN, boxes beside the
/// contact, grids of one or two nodes, a hardness too low for the load, an accuracy that is unattainable.
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
///     // Rejected or not, validation neither panics nor solves anything.
///     if let Err(error) = MixedLubricationSim::builder(scene).check_contact() {
///         assert!(!error.to_string().is_empty());
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn absurd_scenes() -> impl Strategy<Value = Scene> {
    let values = prop_oneof![prop::sample::select(&ABSURD[..]), any::<f64>(), decades(1e-12, 1e12)];
    let changes = prop::collection::vec((0..CHANGES.len(), values), 0..4);
    (scenes(), changes).prop_map(|(mut scene, changes)| {
        for (change, value) in changes {
            CHANGES[change](&mut scene, value);
        }
        let smooth = scene.is_smooth();
        if let (GridSpec::Accuracy { .. }, false) = (scene.grid, smooth) {
            // Refinement of a rough contact would take long.
            scene.grid = GridSpec::Accuracy { accuracy: 0.5 };
        }
        scene
    })
}

/// Changes that put `value` into a field of a scene; grid sizes use it modulo a small integer.
const CHANGES: &[fn(&mut Scene, f64)] = &[
    |scene, value| scene.form = Form::Sphere { radius: value },
    |scene, value| scene.form = Form::Ellipsoid { radius_x: value, radius_y: 1e-2, angle: 0.0 },
    |scene, value| scene.form = Form::Cylinder { radius: value },
    |scene, value| scene.elastic.equivalent_modulus = value,
    |scene, value| scene.load = Load::hertz_pressure(value),
    |scene, value| scene.load = Load::force(value),
    |scene, value| scene.load = Load { hertz_pressure: Some(value), force: Some(value) },
    |scene, _| scene.load = Load::default(),
    |scene, value| scene.motion.entrainment_speed = value,
    |scene, value| scene.motion.slide_roll_ratio = value,
    |scene, value| scene.motion.spin_radius = Some(value),
    |scene, value| change_oil(scene, |spec| spec.eta0 = value),
    |scene, value| change_oil(scene, |spec| spec.roelands_z = value),
    |scene, value| change_oil(scene, |spec| spec.roelands_p0 = value),
    |scene, value| change_oil(scene, |spec| spec.alpha = Some(value)),
    |scene, value| change_oil(scene, |spec| spec.density_a = value),
    |scene, value| change_oil(scene, |spec| spec.density_b = value),
    |scene, _| scene.grid = GridSpec::Cells { nx: 1, ny: 16, x: [-3e-4, 3e-4], y: [-3e-4, 3e-4] },
    |scene, value| {
        scene.grid = GridSpec::Cells { nx: 16, ny: small(value), x: [-3e-4, 3e-4], y: [-3e-4, 3e-4] }
    },
    |scene, value| {
        scene.grid = GridSpec::Cells { nx: small(value), ny: small(value), x: [-1.0, 1.0], y: [-1.0, 1.0] }
    },
    // A contact across the edge of the box, or outside.
    |scene, _| scene.grid = GridSpec::Cells { nx: 16, ny: 16, x: [-2e-5, 4e-4], y: [-3e-4, 3e-4] },
    |scene, value| scene.grid = GridSpec::Cells { nx: 16, ny: 16, x: [value, 4e-4], y: [-3e-4, value] },
    |scene, _| scene.grid = GridSpec::Cells { nx: 16, ny: 16, x: [1e-5, 4e-4], y: [-3e-4, 3e-4] },
    |scene, _| {
        scene.grid = GridSpec::Cells { nx: usize::MAX, ny: usize::MAX, x: [-1.0, 1.0], y: [-1.0, 1.0] }
    },
    |scene, value| scene.grid = GridSpec::Row { nx: small(value), x: [-value, value] },
    |scene, value| scene.grid = GridSpec::Accuracy { accuracy: if value < 0.1 { value } else { 0.5 } },
    |scene, value| scene.roughness.ball = Roughness::gaussian(value, 1e-5, 1),
    |scene, value| {
        let autocorrelation = Autocorrelation::Exponential;
        let spec = RoughnessSpec { autocorrelation, rq: 1e-7, length_x: value, length_y: 1e-5, seed: 1 };
        scene.roughness.disc = spec.into();
    },
    |scene, value| {
        scene.roughness.disc =
            Roughness::File(FileRoughness { path: "there is no such file.npy".into(), rq: Some(value) });
    },
    |scene, value| {
        scene.plastic = Some(PlasticSpec { hardness: value, film_hardness: None, hardening_modulus: None });
    },
    // Below the mean pressure, so the load cannot be carried.
    |scene, _| {
        scene.plastic = Some(PlasticSpec { hardness: 1e6, film_hardness: None, hardening_modulus: None });
    },
    |scene, value| {
        scene.plastic =
            Some(PlasticSpec { hardness: 6e9, film_hardness: Some(value), hardening_modulus: Some(value) });
    },
    |scene, value| scene.friction = FrictionSpec { boundary_coefficient: value, ..scene.friction },
    |scene, value| {
        scene.friction =
            FrictionSpec { limiting_shear_stress: value, eyring_stress: Some(value), ..scene.friction };
    },
    |scene, value| {
        let film = GhanbarzadehSpec { maximum_thickness: value, ..GhanbarzadehSpec::default() };
        scene.tribofilm = Some(TribofilmSpec::Ghanbarzadeh(film));
    },
    |scene, value| {
        let film = GhanbarzadehSpec { x_tribo: value, removal_rate: value, ..GhanbarzadehSpec::default() };
        scene.tribofilm = Some(TribofilmSpec::Ghanbarzadeh(film));
    },
    |scene, value| {
        let wear = ArchardSpec { coefficient: value, film_coefficient: 0.0, ..ArchardSpec::default() };
        scene.wear = Some(WearSpec::azam_2019().with_law(WearLawSpec::Archard(wear)));
    },
    |scene, value| {
        let wear = ArchardSpec { hardness: value, ..ArchardSpec::default() };
        scene.wear = Some(WearSpec::azam_2019().with_law(WearLawSpec::Archard(wear)));
        scene.track.radius_ball = Some(value);
    },
    |scene, value| {
        scene.thermal = ThermalSpec { bulk_temperature: value, conductivity: value, ..scene.thermal }
    },
    |scene, value| (scene.materials.ball.modulus, scene.materials.ball.poisson) = (Some(value), Some(0.3)),
    |scene, value| {
        scene.materials.disc =
            Material { hardness: Some(value), diffusivity: Some(value), ..Material::default() }
    },
    |scene, value| scene.schedule.load = Some(Schedule::ramps(&[(0.0, value), (value, 20.0)])),
    |scene, value| {
        scene.schedule.entrainment_speed = Some(Schedule::steps(&[(-1.0, 0.1), (0.0, value)]));
        scene.schedule.bulk_temperature = Some(Schedule::Constant { value });
    },
    |scene, value| scene.solver = SolverSpec { tolerance: value, max_iterations: 0, ..scene.solver },
    |scene, value| {
        scene.solver = SolverSpec { film_cutoff: value, relaxation: value, stiffness: value, ..scene.solver };
    },
];

fn small(value: f64) -> usize {
    value.abs().min(3.0) as usize
}

fn change_oil(scene: &mut Scene, change: impl FnOnce(&mut LubricantSpec)) {
    if let Some(spec) = &mut scene.lubricant {
        change(spec);
    }
}
