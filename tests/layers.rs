//! A layer on the disc: its transform, its influence coefficients, dry and lubricated contacts of coated
//! bodies, errors.

use std::f64::consts::PI;

use stribeck::analytic::{rectangle_potential, strip_potential};
use stribeck::elastic::{DeformationModel, HalfSpace, Layer, LayeredHalfSpace, LineHalfSpace};
use stribeck::sim::scene::{
    Elastic, GridSpec, InletSpec, LayerSpec, Load, Material, NamedMaterial, SolverKind,
};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::testing::deformation_model;
use stribeck::{Grid, Status};

use crate::common::dense::solve;

/// The transform from the equations of elasticity in plane strain at unit wave number: Airy's function
/// `phi(z) cos x`, `phi = (A + B z) exp(-z) + (C + D z) exp(z)` in the layer and `(E + F z) exp(-z)` below,
/// pressure at `z = 0`, bonded at `z = h`.
fn by_airy(h: f64, [g1, v1]: [f64; 2], [g2, v2]: [f64; 2]) -> f64 {
    // Value and three derivatives of the functions.
    let decaying = |z: f64| {
        [
            [1.0, -1.0, 1.0, -1.0].map(|s| s * (-z).exp()),
            [z, 1.0 - z, z - 2.0, 3.0 - z].map(|s| s * (-z).exp()),
        ]
    };
    // Scaled to one at the interface.
    let growing = |z: f64| {
        [[1.0; 4].map(|s| s * (z - h).exp()), [z, z + 1.0, z + 2.0, z + 3.0].map(|s| s * (z - h).exp())]
    };
    // 2 G u of cos and sin waves: w = [v phi' ...] from the strains, (1 - v) phi''' - (2 - v) phi' and (1 -
    // v) phi'' + v phi.
    let w = |f: [f64; 4], g: f64, v: f64| ((1.0 - v) * f[3] - (2.0 - v) * f[1]) / (2.0 * g);
    let u = |f: [f64; 4], g: f64, v: f64| ((1.0 - v) * f[2] + v * f[0]) / (2.0 * g);
    let [below, above] = [h, 0.0].map(|z| {
        let ([a, b], [c, d]) = (decaying(z), growing(z));
        [a, b, c, d]
    });
    let mut matrix = [[0.0; 6]; 6];
    for k in 0..4 {
        // sigma_zz = -phi cos x = -cos x and no shear at the surface.
        matrix[0][k] = above[k][0];
        matrix[1][k] = above[k][1];
        matrix[2][k] = below[k][0];
        matrix[3][k] = below[k][1];
        matrix[4][k] = w(below[k], g1, v1);
        matrix[5][k] = u(below[k], g1, v1);
    }
    for (k, f) in decaying(h).into_iter().enumerate() {
        matrix[2][4 + k] = -f[0];
        matrix[3][4 + k] = -f[1];
        matrix[4][4 + k] = -w(f, g2, v2);
        matrix[5][4 + k] = -u(f, g2, v2);
    }
    let c = solve(matrix, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let surface: f64 = (0..4).map(|k| c[k] * w(above[k], g1, v1)).sum();
    surface / ((1.0 - v1) / g1)
}

#[test]
fn transform_solves_the_equations_of_elasticity() {
    for m in [1e-3, 0.1, 0.5, 1.0, 2.0, 30.0] {
        for (v1, v2) in [(0.3, 0.3), (0.5, 0.2), (0.1, 0.45)] {
            let young = |g: f64, v: f64| 2.0 * g * (1.0 + v);
            let layer = Layer::new(1.0, [young(m, v1), v1], [young(1.0, v2), v2]).unwrap();
            for x in [1e-3, 0.03, 0.2, 0.7, 1.0, 2.5, 6.0] {
                let (found, exact) = (layer.transform(x), by_airy(x, [m, v1], [1.0, v2]));
                assert!(
                    (found / exact - 1.0).abs() < 1e-8,
                    "M = {m}, v = {v1}, {v2}, x = {x}: {found} {exact}"
                );
            }
            assert!((layer.transform(0.0) / (m * (1.0 - v2) / (1.0 - v1)) - 1.0).abs() < 1e-11);
            assert!((layer.transform(40.0) - 1.0).abs() < 1e-12);
        }
    }
}

/// Bessel function of order zero by its integral; the trapezoidal rule is exact for periodic functions.
fn j0(x: f64) -> f64 {
    let n = 40 + 2 * x.abs() as usize;
    (0..n).map(|k| (x * (PI * (k as f64 + 0.5) / n as f64).sin()).cos()).sum::<f64>() / n as f64
}

/// Simpson's rule on `n` pairs of panels.
fn simpson(to: f64, n: usize, value: impl Fn(f64) -> f64) -> f64 {
    let step = 0.5 * to / n as f64;
    (0..n)
        .map(|k| 2.0 * k as f64 * step)
        .map(|x| value(x) + 4.0 * value(x + step) + value(x + 2.0 * step))
        .sum::<f64>()
        * step
        / 3.0
}

const STEEL: [f64; 2] = [210e9, 0.3];
/// Rigid body on steel.
const RIGID: f64 = 2.0 * 210e9 / 0.91;

#[test]
fn coefficients_equal_the_integral_of_the_transform() {
    let grid = Grid::centred(64, 64, 1e-6, 1e-6).unwrap();
    for (thickness, own) in [(3e-6, [70e9, 0.2]), (20e-6, [600e9, 0.25]), (50e-6, [20e9, 0.4])] {
        let layer = Layer::new(thickness, own, STEEL).unwrap();
        let mut body = LayeredHalfSpace::new(grid, RIGID, layer).unwrap();
        let mut pressure = vec![0.0; grid.len()];
        pressure[0] = 1.0;
        let mut out = vec![0.0; grid.len()];
        body.displacement(&pressure, &mut out).unwrap();
        let correction =
            |r: f64| simpson(30.0, 3000, |x| (layer.transform(x) - 1.0) * j0(x * r / thickness)) / thickness;
        for k in [3_usize, 20, 40, 63] {
            // The correction is smooth: Gauss rule with 2 x 2 points.
            let (r, g) = (1e-6 * k as f64, 0.5e-6 / 3.0_f64.sqrt());
            let mean = 0.5 * (correction((r - g).hypot(g)) + correction((r + g).hypot(g)));
            let exact =
                layer.compliances()[0] / PI * (rectangle_potential(r, 0.0, 0.5e-6, 0.5e-6) + mean * 1e-12);
            for (place, offset) in [("along x", k), ("along y", 64 * k)] {
                let error = out[offset] / exact - 1.0;
                assert!(error.abs() < 2e-5, "{thickness}, {k} {place}: {error:e}");
            }
        }
    }
}

#[test]
fn strip_coefficients_equal_the_integral_of_the_transform() {
    let grid = Grid::from_edges(64, 1, [0.0, 64e-6], [-0.5, 0.5]).unwrap();
    let layer = Layer::new(10e-6, [70e9, 0.2], STEEL).unwrap();
    let mut body = LayeredHalfSpace::plane_strain(grid, RIGID, layer, 1e-2).unwrap();
    let mut pressure = vec![0.0; 64];
    pressure[0] = 1.0;
    let mut out = vec![0.0; 64];
    body.displacement(&pressure, &mut out).unwrap();
    let wave = |x: f64, r: f64| {
        if x == 0.0 {
            0.0
        } else {
            (layer.transform(x) - 1.0) * ((x * r * 1e5).cos() - (x * 6e-5 * 1e5).cos()) / x
        }
    };
    for k in [0, 5, 20, 40] {
        let r = 1e-6 * k as f64;
        let plain = strip_potential(r, 0.5e-6, 1.0) - strip_potential(6e-5, 0.5e-6, 1.0);
        let exact = 2.0 * layer.compliances()[0] / PI * (plain + 1e-6 * simpson(30.0, 6000, |x| wave(x, r)));
        let found = out[k] - out[60];
        assert!((found / exact - 1.0).abs() < 1e-3, "{k}: {found:e} {exact:e}");
    }
    let grid = Grid::from_edges(64, 1, [0.0, 64e-6], [-0.5, 0.5]).unwrap();
    let mut bare = LineHalfSpace::new(grid, RIGID, 1e-2).unwrap();
    let same = Layer::new(10e-6, STEEL, STEEL).unwrap();
    let mut coated = LayeredHalfSpace::plane_strain(grid, RIGID, same, 1e-2).unwrap();
    assert_same(&mut bare, &mut coated, 1e-14);
}

fn assert_same(one: &mut dyn DeformationModel, other: &mut dyn DeformationModel, bound: f64) {
    let pressure: Vec<f64> = (0..one.grid().len()).map(|k| 1e9 * ((k * 37 % 11) as f64)).collect();
    let [mut a, mut b] = [vec![0.0; pressure.len()], vec![0.0; pressure.len()]];
    one.displacement(&pressure, &mut a).unwrap();
    other.displacement(&pressure, &mut b).unwrap();
    for (k, (a, b)) in a.iter().zip(&b).enumerate() {
        assert!((a / b - 1.0).abs() < bound, "{k}: {a:e} {b:e}");
    }
}

#[test]
fn thin_and_thick_layers_approach_half_spaces() {
    let grid = Grid::centred(33, 20, 1e-6, 1.5e-6).unwrap();
    let layered = |pair, thickness, own| {
        LayeredHalfSpace::new(grid, pair, Layer::new(thickness, own, STEEL).unwrap()).unwrap()
    };
    for pair in [RIGID, 230.77e9, 1e9] {
        let mut bare = HalfSpace::new(grid, pair).unwrap();
        assert_same(&mut bare, &mut layered(pair, 5e-6, STEEL), 1e-14);
        // Thin compared with the cells: twelve times or a fifth of the stiffness, over 1e-12 m.
        assert_same(&mut bare, &mut layered(pair, 1e-12, [600e9, 0.3]), 1e-5);
        assert_same(&mut bare, &mut layered(pair, 1e-12, [40e9, 0.3]), 1e-5);
    }
    // Thick compared with the box; the substrate contributes a uniform displacement.
    let soft = [42e9, 0.3];
    let mut thick = HalfSpace::new(grid, 2.0 * 42e9 / 0.91).unwrap();
    assert_same(&mut thick, &mut layered(RIGID, 1.0, soft), 1e-3);
}

#[test]
fn coated_bodies_satisfy_the_contract() {
    for (nx, ny) in [(8, 8), (7, 13)] {
        let grid = Grid::centred(nx, ny, 1e-6, 1.5e-6).unwrap();
        for (thickness, own) in [(1e-7, [600e9, 0.2]), (3e-6, [20e9, 0.4]), (1e-3, [2e9, 0.35])] {
            let layer = Layer::new(thickness, own, STEEL).unwrap();
            deformation_model(&mut LayeredHalfSpace::new(grid, 230.77e9, layer).unwrap()).unwrap();
        }
    }
}

/// A rigid ball on a layer of a tenth of its radius, under the load of a contact of that radius on the
/// substrate.
fn coated_ball(ratio: f64, n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.form = Form::Sphere { radius: 1e-3 };
    scene.elastic = Elastic::new(2.0 * 2.1e9 / 0.91);
    scene.elastic.layer = Some(
        LayerSpec::new(1e-4, ratio * 2.1e9, 0.3)
            .with_substrate_modulus(Some(2.1e9))
            .with_substrate_poisson(Some(0.3)),
    );
    scene.load = Load::hertz_pressure(0.1 * scene.elastic.equivalent_modulus / PI);
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-2e-4, 2e-4], y: [-2e-4, 2e-4] };
    scene.roughness = Default::default();
    scene.lubricant = None;
    scene.plastic = None;
    scene.solver.tolerance = 1e-8;
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

#[test]
fn coated_ball_matches_published_peaks() {
    for (ratio, peak) in [(0.5, 0.705), (1.0, 1.0), (2.0, 1.475)] {
        let solution = solved(&coated_ball(ratio, 128));
        assert!((solution.hertz.half_width_x / 1e-4 - 1.0).abs() < 1e-12);
        let found = solution.pressure.max / solution.hertz.pressure;
        assert!((found - peak).abs() < 1e-3, "E1/E2 = {ratio}: {found}");
    }
}

/// The contact on extreme layers lies between those of substrate and layer.
#[test]
#[ignore = "slow"]
fn extreme_layers_converge() {
    for ratio in [0.01, 0.1, 10.0, 100.0] {
        for thickness in [1e-7, 1e-5, 1e-4] {
            let mut scene = coated_ball(ratio, 64);
            scene.grid = GridSpec::Cells { nx: 96, ny: 96, x: [-6e-4, 6e-4], y: [-6e-4, 6e-4] };
            scene.elastic.layer.as_mut().unwrap().thickness = thickness;
            let solution = solved(&scene);
            let found = solution.pressure.max / solution.hertz.pressure;
            let bounds = [ratio.powf(2.0 / 3.0), 1.0];
            let [low, high] = if ratio < 1.0 { bounds } else { [bounds[1], bounds[0]] };
            assert!((0.98 * low..=1.02 * high).contains(&found), "{ratio}, {thickness}: {found}");
        }
    }
}

#[test]
#[ignore = "slow"]
fn accuracy_selects_box_and_cells_of_a_coated_ball() {
    for ratio in [0.1, 2.0] {
        let mut scene = coated_ball(ratio, 256);
        scene.grid = GridSpec::Cells { nx: 256, ny: 256, x: [-3e-4, 3e-4], y: [-3e-4, 3e-4] };
        let reference = solved(&scene).pressure.max;
        scene.grid = GridSpec::Accuracy { accuracy: 0.01 };
        let found = solved(&scene).pressure.max;
        assert!((found / reference - 1.0).abs() < 0.01, "{ratio}: {found} {reference}");
    }
}

/// Steel ball on coated steel in oil.
fn lubricated(layer: [f64; 3], n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    let steel = Material::default().with_modulus(Some(210e9)).with_poisson(Some(0.3));
    scene.materials.ball = steel;
    scene.materials.disc = steel;
    scene.elastic = Elastic::default();
    let [thickness, modulus, poisson] = layer;
    scene.elastic.layer = Some(LayerSpec::new(thickness, modulus, poisson));
    scene.load.hertz_pressure = Some(0.6e9);
    scene.motion.entrainment_speed = 2.0;
    scene.lubricant.as_mut().unwrap().eta0 = 0.02;
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-0.3e-3, 0.2e-3], y: [-0.25e-3, 0.25e-3] };
    scene
}

#[test]
fn layer_of_the_substrate_material_leaves_the_lubricated_contact_unchanged() {
    let with = solved(&lubricated([10e-6, 210e9, 0.3], 64));
    let mut bare = lubricated([10e-6, 210e9, 0.3], 64);
    bare.elastic.layer = None;
    let without = solved(&bare);
    assert!((with.film.central / without.film.central - 1.0).abs() < 1e-9);
    assert!((with.pressure.max / without.pressure.max - 1.0).abs() < 1e-9);
}

/// Newton's method and multigrid agree; a soft layer reduces the pressure.
#[test]
fn solvers_agree_on_coated_bodies_in_oil() {
    for (layer, above) in [([10e-6, 70e9, 0.35], false), ([5e-6, 500e9, 0.2], true)] {
        let mut scene = lubricated(layer, 64);
        scene.lubricant.as_mut().unwrap().inlet = InletSpec::BoxEdge;
        let mut results = Vec::new();
        for kind in [SolverKind::NewtonKrylov, SolverKind::Multigrid] {
            scene.solver.kind = kind;
            let solution = solved(&scene);
            results.push((solution.film.central, solution.pressure.max));
        }
        assert!((results[0].0 / results[1].0 - 1.0).abs() < 1e-3, "{results:?}");
        assert!((results[0].1 / results[1].1 - 1.0).abs() < 1e-3, "{results:?}");
        scene.elastic.layer = None;
        let bare = solved(&scene).pressure.max;
        assert_eq!(results[0].1 > bare, above, "{results:?} {bare}");
    }
}

/// Elasticity factors of pairs of materials in ISO 6336-2, `sqrt{1/(pi [(1 - v1^2)/E1 + (1 - v2^2)/E2])}` in
/// MPa^(1/2); a named disc is the substrate of its layer.
#[test]
fn named_materials_match_iso_6336() {
    let named = |material| Material::default().with_material(Some(material));
    for (disc, factor) in [
        (NamedMaterial::Steel, 189.8),
        (NamedMaterial::CastSteel, 188.9),
        (NamedMaterial::NodularCastIron, 181.4),
        (NamedMaterial::GreyCastIron, 162.0),
    ] {
        let mut scene = lubricated([10e-6, 70e9, 0.3], 32);
        (scene.materials.ball, scene.materials.disc) = (named(NamedMaterial::Steel), named(disc));
        let found = (scene.equivalent_modulus().unwrap() / (2.0 * PI) / 1e6).sqrt();
        assert!((found - factor).abs() < 0.05, "{disc:?}: {found}");
        let substrate = scene.layer().unwrap().unwrap().compliances()[1];
        assert!((substrate * disc.modulus() / 0.91 - 1.0).abs() < 1e-12);
        scene.materials.disc.modulus = Some(100e9);
        assert!((scene.layer().unwrap().unwrap().compliances()[1] * 100e9 / 0.91 - 1.0).abs() < 1e-12);
    }
    let text = lubricated([10e-6, 70e9, 0.3], 32).to_toml().unwrap();
    let wrong = text.replacen("[materials.ball]", "[materials.ball]\nmaterial = \"cheese\"", 1);
    let error = Scene::from_toml(&wrong).unwrap_err().to_string();
    assert!(
        ["cheese", "steel", "materials.ball.material"].iter().all(|part| error.contains(part)),
        "{error}"
    );
}

/// A coated roller: the same limits, and a response to the layer.
#[test]
fn coated_roller_lies_between_layer_and_substrate() {
    let mut scene = coated_ball(0.5, 64);
    scene.form = Form::Cylinder { radius: 1e-3 };
    scene.grid = GridSpec::Row { nx: 512, x: [-3e-4, 3e-4] };
    let mut peaks = Vec::new();
    for thickness in [1e-9, 1e-4, 1e-1] {
        scene.elastic.layer.as_mut().unwrap().thickness = thickness;
        let solution = solved(&scene);
        peaks.push(solution.pressure.max / solution.hertz.pressure);
    }
    assert!((peaks[0] - 1.0).abs() < 1e-3, "{peaks:?}");
    assert!((peaks[2] - 0.5_f64.sqrt()).abs() < 1e-3, "{peaks:?}");
    assert!(peaks[2] < peaks[1] && peaks[1] < peaks[0], "{peaks:?}");
}

#[test]
fn errors_name_field_and_value() {
    let refused = |change: &dyn Fn(&mut Scene)| {
        let mut scene = coated_ball(0.5, 16);
        change(&mut scene);
        solve_contact(&scene).unwrap_err().to_string()
    };
    let layer = |change: fn(&mut LayerSpec)| refused(&|scene| change(scene.elastic.layer.as_mut().unwrap()));
    for (error, parts) in [
        (layer(|l| l.thickness = 0.0), ["elastic.layer.thickness", "= 0"]),
        (layer(|l| l.modulus = -1.0), ["elastic.layer.modulus", "= -1"]),
        (layer(|l| l.modulus = 1e-9), ["elastic.layer", "1e-4"]),
        (layer(|l| l.poisson = 0.6), ["elastic.layer.poisson", "= 0.6"]),
        (layer(|l| l.substrate_modulus = Some(f64::NAN)), ["elastic.layer.substrate_modulus", "NaN"]),
        (layer(|l| l.substrate_poisson = Some(-1.0)), ["elastic.layer.substrate_poisson", "= -1"]),
        (
            layer(|l| l.substrate_modulus = None),
            ["elastic.layer.substrate_modulus", "materials.disc.modulus"],
        ),
        (refused(&|scene| scene.elastic.equivalent_modulus *= 1.1), ["elastic.equivalent_modulus", "rigid"]),
        (refused(&|scene| scene.materials.disc.modulus = Some(2e9)), ["materials.", "modulus"]),
    ] {
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
}
