//! Compliant tribofilms: their compliance against a thin layer and rigid springs, exact displacements, no
//! film as no film, histories, resuming and errors.
#![expect(clippy::float_cmp, reason = "tests")]

use std::f64::consts::PI;

use stribeck::elastic::{
    BondedFilm, DeformationModel, DryProblem, DrySolver, HalfSpace, Layer, LayeredHalfSpace, LineHalfSpace,
    WithLocalCompliance,
};
use stribeck::sim::scene::{FilmElasticSpec, InletSpec, LayerSpec, Material, Roughness, SolverKind};
use stribeck::sim::{BodyStart, ContactSolution, MixedLubricationSim, Scene, StepRecord, solve_contact};
use stribeck::testing::deformation_model;
use stribeck::{Grid, Status};

const STEEL: [f64; 2] = [210e9, 0.3];
const RIGID: [f64; 2] = [f64::INFINITY, 0.3];
const SOFT: FilmElasticSpec = FilmElasticSpec::new(30e9, 0.3);

/// Response of a thin layer to a wave, less that of the substrate, per thickness, extrapolated to zero
/// thickness.
#[test]
fn compliance_is_the_first_order_term_of_a_thin_layer() {
    for (film, below) in [
        ([30e9, 0.3], STEEL),
        ([90e9, 0.3], STEEL),
        ([15e9, 0.4], STEEL),
        ([60e9, 0.0], STEEL),
        ([60e9, -0.2], [118e9, 0.25]),
        ([30e9, 0.45], [70e9, 0.5]),
    ] {
        let at = |x: f64| {
            let layer = Layer::new(1.0, film, below).unwrap();
            let [own, substrate] = layer.compliances();
            2.0 * (own * layer.transform(x) - substrate) / x
        };
        let (found, coarser) = (at(1e-4), at(2e-4));
        let exact = BondedFilm::new(film, below).unwrap();
        let scale = 1.0 / exact.confined_modulus();
        let error = (2.0 * found - coarser - exact.compliance()) / scale;
        assert!(error.abs() < 1e-6, "{film:?} on {below:?}: {error:e}");
    }
    // The documented magnitude of the next orders.
    let layer = Layer::new(1.0, [30e9, 0.3], STEEL).unwrap();
    let exact = BondedFilm::new([30e9, 0.3], STEEL).unwrap().compliance();
    for (wavelength, bound) in [(600.0, 1.2e-3), (60.0, 1e-2)] {
        let x = 2.0 * PI / wavelength;
        let [own, substrate] = layer.compliances();
        let error = 2.0 * (own * layer.transform(x) - substrate) / x / exact - 1.0;
        assert!(error.abs() < bound && error.abs() > 0.5 * bound, "{wavelength}: {error:e}");
    }
}

/// Films slightly softer than their substrate add little, softer ones more.
#[test]
fn compliance_vanishes_for_a_film_of_the_substrate() {
    let almost = BondedFilm::new([0.999 * STEEL[0], STEEL[1]], STEEL).unwrap();
    assert!(almost.compliance() * almost.confined_modulus() < 2e-3);
    let [stiff, soft] = [60e9, 30e9].map(|modulus| BondedFilm::new([modulus, 0.3], RIGID).unwrap());
    assert_eq!(soft.compliance(), 2.0 * stiff.compliance());
    assert!((soft.compliance() * soft.confined_modulus() - 1.0).abs() < 1e-15);
}

/// Displacements under 1 GPa of films of 100 nm on steel and on a rigid body \[nm\], by modulus \[GPa\].
#[test]
fn displacements_of_films_match_the_documentation() {
    for (modulus, on_steel, on_rigid) in
        [(15.0, 4.73, 4.95), (30.0, 2.24, 2.48), (90.0, 0.55, 0.83), (130.0, 0.27, 0.57)]
    {
        for (below, documented) in [(STEEL, on_steel), (RIGID, on_rigid)] {
            let film = BondedFilm::new([modulus * 1e9, 0.3], below).unwrap();
            let found = 1e9 * 100e-9 * film.compliance() / 1e-9;
            assert!((found - documented).abs() <= 0.005, "{modulus} on {below:?}: {found}");
        }
    }
}

fn patchy(n: usize, largest: f64) -> Vec<f64> {
    (0..n).map(|k| largest * (0.5 + 0.5 * (0.7 * k as f64).sin()).powi(2)).collect()
}

/// `u = K p + c p` for `bare` bodies, and half of the additional displacement for a film of twice the
/// stiffness.
fn adds_up<M: DeformationModel + Clone>(mut bare: M) {
    let n = bare.grid().len();
    let pressure: Vec<f64> = (0..n).map(|k| 1e9 * (1.0 + (0.3 * k as f64).cos())).collect();
    let mut without = vec![0.0; n];
    bare.displacement(&pressure, &mut without).unwrap();
    let thickness = patchy(n, 200e-9);
    for modulus in [30e9, 60e9] {
        let film = BondedFilm::new([modulus, 0.3], RIGID).unwrap();
        let compliance: Vec<f64> = thickness.iter().map(|h| h * film.compliance()).collect();
        let mut body = WithLocalCompliance::new(bare.clone());
        body.set_compliance(&compliance).unwrap();
        let mut with = vec![0.0; n];
        body.displacement(&pressure, &mut with).unwrap();
        let own = 30e9 / modulus / BondedFilm::new([30e9, 0.3], RIGID).unwrap().confined_modulus();
        for k in 0..n {
            let added = own * thickness[k] * pressure[k];
            assert!((with[k] - without[k] - added).abs() <= 4.0 * f64::EPSILON * with[k].abs(), "{k}");
        }
        let approximations = body.approximations().unwrap();
        let mut near = vec![0.0; n];
        approximations.displacement_single(&pressure, &mut near).unwrap();
        let largest = with.iter().copied().fold(0.0, f64::max);
        assert!(with.iter().zip(&near).all(|(u, v)| (u - v).abs() < 3e-6 * largest));
        assert!(body.set_compliance(&compliance[1..]).is_err());
        assert!(body.set_compliance(&vec![-1e-18; n]).is_err());
    }
}

#[test]
fn displacements_of_body_and_film_add_up() {
    let plane = Grid::centred(24, 20, 1e-6, 2e-6).unwrap();
    adds_up(HalfSpace::new(plane, 230e9).unwrap());
    let layer = Layer::new(2e-6, [80e9, 0.3], STEEL).unwrap();
    adds_up(LayeredHalfSpace::new(plane, 230e9, layer).unwrap());
    adds_up(LineHalfSpace::new(Grid::centred(64, 1, 1e-6, 1.0).unwrap(), 230e9, 1e-2).unwrap());
}

#[test]
fn bodies_with_films_satisfy_the_contract() {
    let grid = Grid::centred(9, 8, 1e-6, 2e-6).unwrap();
    let mut body = WithLocalCompliance::new(HalfSpace::new(grid, 230e9).unwrap());
    deformation_model(&mut body).unwrap();
    for field in [vec![2e-18; grid.len()], patchy(grid.len(), 1e-17), vec![0.0; grid.len()]] {
        body.set_compliance(&field).unwrap();
        deformation_model(&mut body).unwrap();
        deformation_model(&mut *body.on_grid(Grid::centred(6, 7, 2e-6, 2e-6).unwrap()).unwrap()).unwrap();
    }
}

/// Without a film, with a film of zero thickness, and after the removal of a film.
#[test]
fn zero_compliance_is_bit_identical_to_the_half_space() {
    let grid = Grid::centred(24, 20, 1e-6, 2e-6).unwrap();
    let field: Vec<f64> = (0..grid.len()).map(|k| (k as f64).sin()).collect();
    let outcome = |body: &mut dyn DeformationModel| {
        let mut out = [(); 4].map(|()| vec![0.0; grid.len()]);
        let [exact, single, periodic, estimate] = &mut out;
        body.displacement(&field, exact).unwrap();
        let near = body.approximations().unwrap();
        near.displacement_single(&field, single).unwrap();
        near.displacement_periodic(&field, periodic).unwrap();
        near.pressure_estimate(&field, estimate).unwrap();
        (out, [(0, 0), (1, 0), (2, 3)].map(|(di, dj)| body.influence(di, dj)), body.self_influence(7))
    };
    let expected = outcome(&mut HalfSpace::new(grid, 230e9).unwrap());
    let mut body = WithLocalCompliance::new(HalfSpace::new(grid, 230e9).unwrap());
    assert!(outcome(&mut body) == expected);
    body.set_compliance(&patchy(grid.len(), 1e-17)).unwrap();
    assert!(outcome(&mut body) != expected);
    body.set_compliance(&vec![0.0; grid.len()]).unwrap();
    assert!(outcome(&mut body) == expected);
}

/// The estimate is the inverse on a periodic grid: for a wave, the wave over its displacement.
#[test]
fn pressure_estimate_includes_the_mean_compliance() {
    let n = 64;
    let grid = Grid::centred(n, n, 1e-6, 1e-6).unwrap();
    let compliance = 1e-17;
    let mut body = WithLocalCompliance::new(HalfSpace::new(grid, 230e9).unwrap());
    body.set_compliance(&vec![compliance; n * n]).unwrap();
    for waves in [4, 16, 31] {
        let phase = |k: usize| 2.0 * PI * waves as f64 * (k % n) as f64 / n as f64;
        let pressure: Vec<f64> = (0..n * n).map(|k| 1e9 * phase(k).cos()).collect();
        let (mut displacement, mut found) = (vec![0.0; n * n], vec![0.0; n * n]);
        let near = body.approximations().unwrap();
        near.displacement_periodic(&pressure, &mut displacement).unwrap();
        near.pressure_estimate(&displacement, &mut found).unwrap();
        let worst = pressure.iter().zip(&found).map(|(p, q)| (p - q).abs()).fold(0.0, f64::max);
        assert!(worst < 1e-5 * 1e9, "{waves}: {worst:e}");
    }
}

/// A rigid ball, or cylinder, on springs of `c` \[m/Pa\]: `p = (d - x^2/(2 R))/c` (Johnson 1985, section 4.3).
fn on_springs(mut body: WithLocalCompliance<impl DeformationModel>, c: f64, load: f64) -> [f64; 2] {
    let (grid, radius) = (body.grid(), 1e-2);
    body.set_compliance(&vec![c; grid.len()]).unwrap();
    let is_line = grid.ny() == 1;
    let gap: Vec<f64> =
        grid.nodes().map(|(x, y)| (x * x + if is_line { 0.0 } else { y * y }) / (2.0 * radius)).collect();
    let problem = DryProblem { gap: &gap, load, limit: None };
    let mut pressure = vec![1.0; grid.len()];
    let outcome = DrySolver::new(grid.len()).solve(&problem, &mut body, &mut pressure, 1e-9, 500).unwrap();
    assert!(outcome.converged, "{outcome:?}");
    [pressure.iter().copied().fold(0.0, f64::max), outcome.approach]
}

#[test]
fn soft_films_match_a_spring_foundation() {
    let (a, radius, thickness) = (1e-4, 1e-2, 10e-6);
    let film = BondedFilm::new([1e9, 0.3], RIGID).unwrap();
    let c = thickness * film.compliance();
    let (depth, stiff) = (a * a / (2.0 * radius), 230e14);
    let plane = Grid::centred(96, 96, 2.5 * a / 96.0, 2.5 * a / 96.0).unwrap();
    let line = Grid::centred(512, 1, 2.5 * a / 512.0, 1.0).unwrap();
    let found = [
        on_springs(WithLocalCompliance::new(HalfSpace::new(plane, stiff).unwrap()), c, {
            PI * film.confined_modulus() * a.powi(4) / (4.0 * radius * thickness)
        }),
        on_springs(
            WithLocalCompliance::new(LineHalfSpace::new(line, stiff, 1e-2).unwrap()),
            c,
            4.0 * depth * a / (3.0 * c),
        ),
    ];
    for [peak, approach] in found {
        assert!((peak * c / depth - 1.0).abs() < 1e-3, "{}", peak * c / depth);
        assert!((approach / depth - 1.0).abs() < 1e-3, "{}", approach / depth);
    }
}

/// The reference scene with a tribofilm, on `n` x `n` nodes.
fn scene(n: usize) -> Scene {
    Scene::azam_2019(n).with_tribofilm()
}

fn soft(n: usize) -> Scene {
    let mut scene = scene(n);
    scene.elastic.tribofilm = Some(SOFT);
    scene
}

/// The single contact of `scene` with a film of `thickness` \[m\] on a disc whose surface is that of the scene.
fn covered(scene: &Scene, thickness: impl Fn(usize) -> f64) -> ContactSolution {
    let grid = scene.grid().unwrap();
    let sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let film: Vec<f64> = (0..grid.len()).map(thickness).collect();
    let heights = sim.bodies()[1].initial().iter().zip(&film).map(|(z, h)| z - h).collect();
    let start = BodyStart::new(grid, heights).with_tribofilm(film);
    let solution = MixedLubricationSim::builder(scene.clone()).disc_start(start).solve().unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn scenes_without_film_are_bit_identical() {
    let (with, without) = (covered(&soft(32), |_| 0.0), covered(&scene(32), |_| 0.0));
    assert_eq!(bits(&with.state.pressure), bits(&without.state.pressure));
    assert_eq!(bits(&with.state.film), bits(&without.state.film));
    assert_eq!(with.report.work, without.report.work);
    // A rigid film only changes the height; a compliant one deflects.
    let (hard, soft) = (covered(&scene(32), |_| 1e-7), covered(&soft(32), |_| 1e-7));
    assert!(bits(&hard.state.pressure) != bits(&soft.state.pressure));
    assert!(soft.pressure.max < hard.pressure.max * (1.0 + 1e-9));
}

/// Gaps of a dry contact are consistent with its pressures: `gap + K p + c p - approach`.
#[test]
fn dry_gaps_are_consistent_with_the_pressures() {
    let mut scene = soft(48);
    (scene.lubricant, scene.plastic, scene.solver.tolerance) = (None, None, 1e-9);
    scene.roughness.ball = Roughness::None;
    let thickness = |k: usize| 1e-7 * (1.0 + (0.2 * k as f64).sin());
    let solution = covered(&scene, thickness);
    let film = scene.bonded_films().unwrap().unwrap()[1];
    let mut body = HalfSpace::new(solution.grid, scene.equivalent_modulus().unwrap()).unwrap();
    let mut displacement = vec![0.0; solution.grid.len()];
    body.displacement(&solution.state.pressure, &mut displacement).unwrap();
    for (k, u) in displacement.iter().enumerate() {
        let own = film.compliance() * thickness(k) * solution.state.pressure[k];
        let gap = solution.gap[k] + u + own - solution.state.approach;
        assert!((gap - solution.state.film[k]).abs() < 1e-15, "{k}: {gap:e} {:e}", solution.state.film[k]);
    }
    // Asperities on the film carry less load.
    scene.elastic.tribofilm = None;
    assert!(solution.pressure.max < 0.99 * covered(&scene, thickness).pressure.max);
}

/// All solvers find the same smooth film.
#[test]
fn solvers_agree_on_compliant_films() {
    let mut scene = soft(64);
    (scene.roughness, scene.plastic) = (Default::default(), None);
    scene.load.hertz_pressure = Some(0.6e9);
    scene.motion.entrainment_speed = 2.0;
    let oil = scene.lubricant.as_mut().unwrap();
    // Multigrid has ambient pressure at the edge of the box.
    (oil.eta0, oil.inlet) = (0.02, InletSpec::BoxEdge);
    // Softer than any real film: the deflection at the largest pressure is half of the thickness.
    scene.elastic.tribofilm = Some(SOFT.with_modulus(1e9));
    let found = [SolverKind::NewtonKrylov, SolverKind::Multigrid, SolverKind::SemiSystem].map(|kind| {
        scene.solver.kind = kind;
        let solution = covered(&scene, |_| 1e-7);
        (solution.film.central, solution.pressure.max)
    });
    for (film, pressure) in &found[1..] {
        assert!((film / found[0].0 - 1.0).abs() < 1e-3, "{found:?}");
        assert!((pressure / found[0].1 - 1.0).abs() < 1e-3, "{found:?}");
    }
}

/// Steps of the reference history with fast film growth.
fn history(scene: &Scene, steps: usize) -> Vec<StepRecord> {
    let mut sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    (0..steps).map(|_| sim.step(180.0).unwrap()).collect()
}

#[test]
#[ignore = "slow"]
fn histories_with_compliant_films_need_no_more_work() {
    let (without, with) = (history(&scene(64), 24), history(&soft(64), 24));
    // The first contact is bare.
    assert_eq!(without[0], with[0]);
    assert!(
        without[23].tribofilm.disc_mean > 20e-9
            && without[1].contact.load_ratio != with[1].contact.load_ratio
    );
    assert!(records_converged(&with) && records_converged(&without));
    let median = |records: &[StepRecord]| {
        let mut iterations: Vec<u64> = records.iter().map(|r| r.report.work.iterations).collect();
        iterations.sort_unstable();
        iterations[iterations.len() / 2] as f64
    };
    let ratio = median(&with) / median(&without);
    assert!((0.85..1.15).contains(&ratio), "{ratio}");
}

fn records_converged(records: &[StepRecord]) -> bool {
    records.iter().all(|record| record.report.status == Status::Converged && record.attempts == 1)
}

#[test]
fn results_are_bit_identical_with_threads() {
    let mut scene = soft(192);
    scene.solver.tolerance = 1e-3;
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| covered(&scene, |k| 1e-7 * (1.0 + (0.2 * k as f64).sin())))
    });
    assert_eq!(bits(&one.state.pressure), bits(&three.state.pressure));
    assert_eq!(bits(&one.state.film), bits(&three.state.film));
}

#[test]
fn compliance_uses_the_material_below_each_film() {
    let confined = |scene: &Scene| scene.bonded_films().unwrap().unwrap().map(|film| film.compliance());
    let on = |below: [f64; 2]| BondedFilm::new([30e9, 0.3], below).unwrap().compliance();
    let close = |found: [f64; 2], below: [[f64; 2]; 2]| {
        for (found, below) in found.into_iter().zip(below) {
            assert!((found / on(below) - 1.0).abs() < 1e-9, "{found:e} {below:?}");
        }
    };
    let mut scene = soft(16);
    scene.elastic.equivalent_modulus = 210e9 / 0.91;
    close(confined(&scene), [STEEL; 2]);
    let coating = LayerSpec::new(2e-6, 100e9, 0.2);
    scene.elastic.layer = Some(coating.with_substrate_modulus(Some(210e9)).with_substrate_poisson(Some(0.3)));
    close(confined(&scene), [STEEL, [100e9, 0.2]]);
    // A disc with all of the compliance leaves a rigid ball.
    scene.elastic.equivalent_modulus = 2.0 * 210e9 / 0.91;
    close(confined(&scene), [RIGID, [100e9, 0.2]]);
    let mut scene = soft(16);
    scene.elastic.equivalent_modulus = f64::INFINITY;
    let material = |modulus, ratio| Material::default().with_modulus(Some(modulus)).with_poisson(Some(ratio));
    (scene.materials.ball, scene.materials.disc) = (material(310e9, 0.27), material(118e9, 0.25));
    close(confined(&scene), [[310e9, 0.27], [118e9, 0.25]]);
}

#[test]
fn keys_are_read_and_written() {
    let scene = soft(16);
    let text = scene.to_toml().unwrap();
    assert_eq!(Scene::from_toml(&text).unwrap(), scene);
    let units = text.replace("modulus = 30000000000.0", "modulus = \"30 GPa\"");
    assert!(units != text, "{text}");
    assert_eq!(Scene::from_toml(&units).unwrap(), scene);
    let stray = text.replace("[elastic.tribofilm]", "[elastic.tribofilm]\nthickness = 1e-7");
    assert!(Scene::from_toml(&stray).unwrap_err().to_string().contains("thickness"));
}

#[test]
fn errors_name_field_and_value() {
    let refused = |spec: FilmElasticSpec| {
        let mut scene = soft(16);
        scene.elastic.tribofilm = Some(spec);
        solve_contact(&scene).unwrap_err().to_string()
    };
    let mut none = soft(16);
    none.tribofilm = None;
    for (error, parts) in [
        (refused(SOFT.with_modulus(0.0)), ["elastic.tribofilm.modulus", "= 0"]),
        (refused(SOFT.with_modulus(f64::NAN)), ["elastic.tribofilm.modulus", "NaN"]),
        (refused(SOFT.with_modulus(f64::INFINITY)), ["elastic.tribofilm.modulus", "inf"]),
        (refused(SOFT.with_modulus(300e9)), ["elastic.tribofilm.modulus = 3", "than its substrate"]),
        (refused(SOFT.with_poisson(0.46)), ["elastic.tribofilm.poisson = 0.46", "0.45"]),
        (refused(SOFT.with_poisson(-1.0)), ["elastic.tribofilm.poisson = -1", "above -1"]),
        (solve_contact(&none).unwrap_err().to_string(), ["elastic.tribofilm", "no tribofilm"]),
    ] {
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
    let substrate = |below| BondedFilm::new([30e9, 0.3], below).unwrap_err().to_string();
    assert!(substrate([-1.0, 0.3]).contains("= -1"));
    assert!(substrate([210e9, 0.6]).contains("= 0.6"));
}
