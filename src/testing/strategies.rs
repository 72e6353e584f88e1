//! Random valid scenes and pressures for proptest. Invalid ones are in `absurd`.

use proptest::prelude::*;

use crate::grid::Grid;
use crate::sim::Scene;
use crate::sim::scene::{
    ArchardSpec, Elastic, Exposure, Flash, FlowThinning, FrictionSpec, GhanbarzadehSpec, GridSpec, Load,
    LubricantSpec, Materials, Motion, PlasticSpec, Roughness, RoughnessPair, Schedules, SolverKind,
    SolverSpec, ThermalSpec, TrackSpec, TribofilmSpec, WearLawSpec, WearSpec,
};
use crate::surface::{Autocorrelation, Form, RoughnessSpec};
use crate::tribochem::Activation;

/// Log-uniform between `low` and `high`.
pub(super) fn decades(low: f64, high: f64) -> impl Strategy<Value = f64> {
    (low.ln()..high.ln()).prop_map(f64::exp)
}

/// Balls, ellipsoids and cylinders of 1 mm to 0.1 m; ellipsoids have radii in ratios of 0.2 to 5.
fn forms() -> impl Strategy<Value = Form> {
    prop_oneof![
        4 => decades(1e-3, 0.1).prop_map(|radius| Form::Sphere { radius }),
        1 => (decades(1e-3, 0.1), decades(0.2, 5.0))
            .prop_map(|(radius_x, ratio)| Form::Ellipsoid { radius_x, radius_y: ratio * radius_x, angle: 0.0 }),
        1 => decades(1e-3, 0.1).prop_map(|radius| Form::Cylinder { radius }),
    ]
}

/// No roughness, or random heights of 1 to 500 nm Rq with correlation lengths of 5 to 50 um.
fn roughness() -> impl Strategy<Value = Roughness> {
    let random = |autocorrelation| {
        (decades(1e-9, 5e-7), decades(5e-6, 5e-5), decades(5e-6, 5e-5), any::<u64>()).prop_map(
            move |(rq, length_x, length_y, seed)| {
                Roughness::from(RoughnessSpec { autocorrelation, rq, length_x, length_y, seed })
            },
        )
    };
    prop_oneof![
        2 => Just(Roughness::None),
        2 => random(Autocorrelation::Gaussian),
        1 => random(Autocorrelation::Exponential),
    ]
}

/// No oil in a quarter of all scenes, otherwise Roelands oils of 1 mPa s to 0.5 Pa s with the
/// Dowson-Higginson density; half of them with `alpha`.
fn lubricants() -> impl Strategy<Value = Option<LubricantSpec>> {
    let oil = (decades(1e-3, 0.5), 0.3..0.8, any::<bool>()).prop_map(|(eta0, roelands_z, given)| {
        LubricantSpec::roelands(eta0, roelands_z).with_alpha(given.then_some(1.5e-8))
    });
    prop::option::weighted(0.75, oil)
}

/// Grids of 8 to 31 cells a side, or a row of 5 to 199, in boxes of 0.2 to 2 mm.
fn grids() -> impl Strategy<Value = GridSpec> {
    let half = || decades(1e-4, 1e-3);
    prop_oneof![
        6 => (8_usize..32, 8_usize..32, half(), half())
            .prop_map(|(nx, ny, a, b)| GridSpec::Cells { nx, ny, x: [-a, a], y: [-b, b] }),
        1 => (5_usize..200, half()).prop_map(|(nx, a)| GridSpec::Row { nx, x: [-a, a] }),
    ]
}

/// All solvers, the automatic choice in six of ten, to tolerances of 1e-6 to 1e-2 in at most 500 iterations.
fn solvers() -> impl Strategy<Value = SolverSpec> {
    let kinds = prop_oneof![
        6 => Just(SolverKind::Auto),
        1 => Just(SolverKind::NewtonKrylov),
        1 => Just(SolverKind::Dry),
        1 => Just(SolverKind::SemiSystem),
        1 => Just(SolverKind::Multigrid),
    ];
    (kinds, decades(1e-6, 1e-2), any::<bool>(), decades(1e-10, 1e-8)).prop_map(
        |(kind, tolerance, edge_contact, film_cutoff)| SolverSpec {
            kind,
            tolerance,
            edge_contact,
            film_cutoff,
            max_iterations: 500,
            ..SolverSpec::default()
        },
    )
}

/// Plasticity, tribofilm and wear, each present or not, and temperatures of 250 to 500 K.
fn processes()
-> impl Strategy<Value = (Option<PlasticSpec>, Option<TribofilmSpec>, Option<WearSpec>, ThermalSpec)> {
    let plastic =
        (decades(5e8, 2e10), prop::option::of(decades(5e8, 5e9)), prop::option::of(decades(1e14, 1e17)))
            .prop_map(|(hardness, film_hardness, hardening_modulus)| PlasticSpec {
                hardness,
                film_hardness,
                hardening_modulus,
            });
    let activation = prop_oneof![
        Just(Activation::SolidContact),
        Just(Activation::Pressure),
        Just(Activation::ShearStress)
    ];
    let film = (activation, decades(1e-18, 1e-14)).prop_map(|(activation, x_tribo)| {
        TribofilmSpec::Ghanbarzadeh(GhanbarzadehSpec { activation, x_tribo, ..GhanbarzadehSpec::default() })
    });
    let wear = (decades(1e-9, 1e-5), 0.0..1.0).prop_map(|(coefficient, share)| {
        let film_coefficient = share * coefficient;
        let law = ArchardSpec { coefficient, film_coefficient, ..ArchardSpec::default() };
        WearSpec::new(WearLawSpec::Archard(law), Exposure::ContactClock)
    });
    let flash = prop_oneof![Just(Flash::Auto), Just(Flash::On), Just(Flash::Off)];
    let thermal = (250.0..500.0, flash).prop_map(|(bulk_temperature, flash)| ThermalSpec {
        bulk_temperature,
        flash,
        ..ThermalSpec::default()
    });
    (prop::option::of(plastic), prop::option::of(film), prop::option::of(wear), thermal)
}

/// Scenes of every kind on small grids with values in their ranges, from dry to full film. Some contacts do
/// not fit their box and are rejected, and some do not converge.
///
/// # Examples
///
/// ```
/// use proptest::strategy::{Strategy, ValueTree};
/// use proptest::test_runner::TestRunner;
/// let mut runner = TestRunner::deterministic();
/// let tree = stribeck::testing::scenes().new_tree(&mut runner).map_err(|reason| reason.to_string())?;
/// let scene = tree.current();
/// assert!(scene.hertz().is_ok() && scene.grid().is_ok());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn scenes() -> impl Strategy<Value = Scene> {
    let load = prop_oneof![
        3 => decades(1e8, 3e9).prop_map(Load::hertz_pressure),
        1 => decades(0.1, 1e3).prop_map(Load::force),
    ];
    let motion = (decades(1e-4, 20.0), -2.0..2.0)
        .prop_map(|(entrainment_speed, slide_roll_ratio)| Motion::new(entrainment_speed, slide_roll_ratio));
    let flow_thinning =
        prop_oneof![Just(None), Just(Some(FlowThinning::Effective)), Just(Some(FlowThinning::Directional))];
    let friction = (0.0..0.3, prop::option::of((decades(1e6, 1e8), flow_thinning))).prop_map(
        |(boundary_coefficient, eyring)| FrictionSpec {
            boundary_coefficient,
            eyring_stress: eyring.map(|e| e.0),
            flow_thinning: eyring.and_then(|e| e.1),
            ..FrictionSpec::default()
        },
    );
    let physics = (forms(), decades(5e10, 5e11), load, motion, friction);
    let numerics = (lubricants(), grids(), roughness(), roughness(), solvers());
    (physics, numerics, processes()).prop_map(|(physics, numerics, processes)| {
        let (form, equivalent_modulus, load, motion, friction) = physics;
        let (lubricant, grid, ball, disc, solver) = numerics;
        let (plastic, tribofilm, wear, thermal) = processes;
        // One row requires a cylinder.
        let form = match (form, grid) {
            (form, GridSpec::Row { .. }) => Form::Cylinder { radius: form.radii().0 },
            (form, _) => form,
        };
        Scene {
            form,
            elastic: Elastic::new(equivalent_modulus),
            materials: Materials::default(),
            schedule: Schedules::default(),
            cycle: None,
            load,
            motion,
            lubricant,
            grid,
            roughness: RoughnessPair { ball, disc },
            plastic,
            friction,
            tribofilm,
            wear,
            track: TrackSpec::default(),
            thermal,
            stress: None,
            bearing: None,
            solver,
        }
    })
}

/// Pressure fields on `grid` from zero to those of a loaded contact \[Pa\], non-negative.
///
/// # Examples
///
/// ```
/// use proptest::strategy::{Strategy, ValueTree};
/// use proptest::test_runner::TestRunner;
/// let grid = stribeck::Grid::centred(8, 4, 1e-6, 1e-6)?;
/// let tree = stribeck::testing::pressures(&grid).new_tree(&mut TestRunner::deterministic());
/// let field = tree.map_err(|reason| reason.to_string())?.current();
/// assert!(field.len() == 32 && field.iter().all(|p| *p >= 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn pressures(grid: &Grid) -> impl Strategy<Value = Vec<f64>> + use<> {
    let node = prop_oneof![1 => Just(0.0), 2 => decades(1e3, 5e9)];
    prop::collection::vec(node, grid.len())
}
