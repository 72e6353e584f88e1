//! `grid.accuracy`: meshes that reach it, estimates that hold, scenes it is not for.

use std::path::Path;

use stribeck::reynolds::ContactDefinition;
use stribeck::sim::scene::{
    FileRoughness, GridSpec, Load, LubricantSpec, Roughness, RoughnessPair, SolverKind,
};
use stribeck::sim::{ContactSolution, ErrorEstimate, MixedLubricationSim, Scene, solve_contact};
use stribeck::surface::{
    Autocorrelation, Form, HeightDistribution, Heights, RandomShape, RandomSurface, RoughnessSpec,
    SelfAffine, Synthesis, write_npy,
};
use stribeck::{Boundary, Status};

const RADIUS: f64 = 1.0;
const MODULUS: f64 = 226e9;
const ALPHA: f64 = 2.2e-8;

/// A smooth contact by its Moes parameters, which are formed with the sum of the speeds.
fn contact(moes_load: f64, moes_lubricant: f64, accuracy: f64) -> Scene {
    let speed_parameter = (moes_lubricant / (ALPHA * MODULUS)).powi(4);
    let mut scene = Scene::azam_2019(16);
    scene.form = Form::Sphere { radius: RADIUS };
    scene.elastic.equivalent_modulus = MODULUS;
    let force = moes_load * speed_parameter.powf(0.75) * MODULUS * RADIUS * RADIUS;
    scene.load = Load::force(force);
    scene.motion.entrainment_speed = 0.5 * speed_parameter * MODULUS * RADIUS / 0.04;
    scene.lubricant = Some(
        LubricantSpec::roelands(0.04, 0.68)
            .with_alpha(Some(ALPHA))
            .with_density_a(0.34 / 5.9e8)
            .with_density_b(1.0 / 5.9e8),
    );
    scene.roughness = Default::default();
    scene.plastic = None;
    scene.grid = GridSpec::Accuracy { accuracy };
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    solution
}

/// Central and minimum film with a flooded inlet, in units of `a^2/R`. In a box that ends 4.5 half-widths in front of the
/// contact two independent programs found 0.4325 and 0.2928, 0.1372 and 0.0735 in the limit of fine meshes. In boxes of
/// 18 half-widths films are 1.2 and 1.6 %, 0.27 and 0.23 % thicker.
#[test]
fn estimates_hold_against_known_films() {
    for (m, l, central, minimum) in [(20.0, 10.0, 0.4377, 0.2975), (100.0, 10.0, 0.1376, 0.0737)] {
        let solution = solved(&contact(m, l, 0.05));
        let moes = solution.moes.unwrap();
        assert!((moes.m / m - 1.0).abs() < 1e-6 && (moes.l / l - 1.0).abs() < 1e-6);
        let unit = solution.hertz.radius.powi(2) / RADIUS;
        let estimate = solution.error_estimate.unwrap();
        assert!(estimate.film_central <= 0.05, "{estimate:?}");
        let error = solution.film.central / unit / central - 1.0;
        assert!(error.abs() <= estimate.film_central, "M {m}: error {error}, {estimate:?}");
        let error = solution.film.minimum / unit / minimum - 1.0;
        assert!(error.abs() <= estimate.film_minimum, "M {m}: error {error}, {estimate:?}");
    }
}

/// The film of a soft ball is a thousandth of its indentation.
#[test]
#[ignore = "slow"]
fn soft_contacts_reach_their_accuracy_on_the_first_meshes() {
    let mut meshes = 0;
    let builder = MixedLubricationSim::builder(contact(3000.0, 1.0, 0.02));
    let solution = builder.solve_observed(|_| meshes += 1).unwrap();
    assert_eq!((solution.report.status, meshes), (Status::Converged, 3));
    assert!(solution.error_estimate.unwrap().film_central < 0.02);
}

#[test]
fn dry_contacts_are_estimated_by_their_pressure() {
    for accuracy in [0.1, 0.01, 0.001] {
        for form in [
            Form::Sphere { radius: 10e-3 },
            Form::Ellipsoid { radius_x: 12e-3, radius_y: 8e-3, angle: 0.0 },
            Form::Cylinder { radius: 10e-3 },
        ] {
            let mut scene = contact(100.0, 10.0, accuracy);
            scene.form = form;
            scene.load = Load::hertz_pressure(1e9);
            scene.lubricant = None;
            let solution = solved(&scene);
            let estimate = solution.error_estimate.unwrap();
            let error = (solution.pressure.max / 1e9 - 1.0).abs();
            assert!(error <= estimate.pressure_max.max(1e-3 * accuracy), "{form:?}: {error:e}, {estimate:?}");
            assert!(estimate.pressure_max <= accuracy);
            assert!(estimate.film_central == 0.0 && estimate.film_minimum == 0.0);
        }
    }
}

#[test]
fn line_contacts_are_estimated_too() {
    let line = |accuracy| {
        let mut scene = contact(100.0, 10.0, accuracy);
        scene.form = Form::Cylinder { radius: 10e-3 };
        scene.load = Load::hertz_pressure(0.8e9);
        scene.motion.entrainment_speed = 1.0;
        solved(&scene)
    };
    let fine = line(5e-4);
    for accuracy in [0.05, 0.02, 0.005] {
        let solution = line(accuracy);
        let estimate = solution.error_estimate.unwrap();
        let error = (solution.film.central / fine.film.central - 1.0).abs();
        assert!(error <= estimate.film_central && estimate.film_central <= accuracy, "{error}, {estimate:?}");
        let error = (solution.film.minimum / fine.film.minimum - 1.0).abs();
        assert!(error <= estimate.film_minimum, "{error}, {estimate:?}");
    }
}

#[test]
fn estimate_rejects_unsupported_scenes() {
    let named = |scene: &Scene, part: &str| {
        let message = solve_contact(scene).unwrap_err().to_string();
        assert!(message.starts_with("grid.accuracy") && message.contains(part), "{message}");
    };
    for accuracy in [0.0, -0.01, 0.2, 1e-9, f64::NAN] {
        named(&contact(20.0, 10.0, accuracy), "between");
    }
    let mut rough = Scene::azam_2019(16);
    rough.grid = GridSpec::Accuracy { accuracy: 0.01 };
    // A history needs one grid for all of its steps.
    let message = MixedLubricationSim::builder(rough).build().unwrap_err().to_string();
    assert!(message.starts_with("grid.accuracy"), "{message}");
    // A film of a ten-thousandth of the Hertz approach has no affordable mesh.
    named(&contact(1e7, 3.0, 1e-4), "nodes");
}

#[test]
fn files_say_it_in_place_of_a_grid() {
    let text = |grid: &str| {
        format!(
            "[form]\nkind = \"sphere\"\nradius = 1e-2\n[elastic]\nequivalent_modulus = 2e11\n[load]\nforce = 10.0\n[grid]\n{grid}\n"
        )
    };
    let scene = Scene::from_toml(&text("accuracy = 0.01")).unwrap();
    assert_eq!(scene.grid, GridSpec::Accuracy { accuracy: 0.01 });
    assert_eq!(Scene::from_toml(&scene.to_toml().unwrap()).unwrap(), scene);
    for (grid, part) in [
        ("accuracy = 0.01\nnx = 64", "`nx`"),
        ("accuracy = \"fine\"", "accuracy"),
        ("nx = 64\nx = [-1e-3, 1e-3]\nny = 64", "`y`"),
        ("", "`grid.nx`"),
    ] {
        let message = Scene::from_toml(&text(grid)).unwrap_err().to_string();
        assert!(message.contains(part) && message.contains("grid"), "{message}");
    }
    let row = Scene::from_toml(&text("nx = 64\nx = [-1e-3, 1e-3]")).unwrap();
    let message = solve_contact(&row).unwrap_err().to_string();
    assert!(message.contains("ny and y are missing"), "{message}");
}

/// A small mixed contact on `n` x `n` cells.
fn rough(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.form = Form::Sphere { radius: 2.0e-3 };
    let edges = [-80e-6, 80e-6];
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: edges, y: edges };
    scene.motion.entrainment_speed = 0.03;
    scene
}

/// The heights of `of` on its grid as node-by-node files in `folder`, by their Fourier series on `n` x `n`
/// cells.
fn as_files(of: &Scene, n: usize, folder: &Path) -> RoughnessPair {
    let grid = of.grid().unwrap();
    let file = |roughness: &Roughness, name: &str| {
        let Roughness::Random(random) = roughness else { panic!("not a random surface") };
        let heights = random.generate(&grid).unwrap();
        let surface = Heights::new(grid.nx(), grid.ny(), None, heights, None).unwrap();
        let path = folder.join(name);
        write_npy(&path, n, n, surface.resample_fourier(n, n).unwrap().heights()).unwrap();
        Roughness::File(FileRoughness { path, rq: None })
    };
    RoughnessPair {
        ball: file(&of.roughness.ball, &format!("ball{n}.npy")),
        disc: file(&of.roughness.disc, &format!("disc{n}.npy")),
    }
}

fn four(solution: &ContactSolution) -> [f64; 4] {
    let contact = solution.contact;
    [contact.load_ratio, contact.area_ratio, solution.film.mean_central, solution.friction.coefficient]
}

fn four_estimates(estimate: &ErrorEstimate) -> [f64; 4] {
    [
        estimate.contact_load_ratio,
        estimate.contact_area_ratio,
        estimate.film_mean_central,
        estimate.friction_coefficient,
    ]
}

/// The solution is that of the grid alone, and its errors against four times finer cells are below the
/// estimates.
#[test]
fn a_coarser_solve_estimates_a_rough_contact() {
    let folder = tempfile::tempdir().unwrap();
    let given = rough(32);
    let on = |n: usize, estimate: bool| {
        let mut scene = rough(n);
        scene.roughness = as_files(&given, n, folder.path());
        scene.solver.estimate = estimate;
        solved(&scene)
    };
    let (alone, solution, fine) = (on(64, false), on(64, true), on(256, false));
    assert!(alone.error_estimate.is_none());
    assert_eq!(alone.state.pressure, solution.state.pressure);
    assert!(solution.report.work.convolutions > alone.report.work.convolutions);
    assert!((0.05..0.95).contains(&solution.contact.load_ratio), "{:?}", solution.contact);
    let estimate = solution.error_estimate.unwrap();
    let [found, truth] = [&solution, &fine].map(four);
    for (k, bound) in four_estimates(&estimate).into_iter().enumerate() {
        let scale = if k < 2 { 1.0 } else { truth[k] };
        let error = (found[k] - truth[k]).abs() / scale;
        assert!(error <= bound && bound < 0.5, "number {k}: {error}, {estimate:?}");
    }
}

#[test]
#[ignore = "slow"]
fn the_surface_of_a_seed_is_refined_by_its_fourier_series() {
    let folder = tempfile::tempdir().unwrap();
    let refined = |mut scene: Scene, accuracy| {
        scene.solver.accuracy = Some(accuracy);
        solved(&scene)
    };
    // Dry, so that two refinements are cheap.
    let mut given = rough(24);
    given.solver.kind = SolverKind::Dry;
    let coarse = refined(given.clone(), 0.1);
    let fine = refined(given.clone(), 0.01);
    assert!(fine.grid.nx() > coarse.grid.nx() && fine.grid.nx() % 24 == 0);
    for (solution, accuracy) in [(&coarse, 0.1), (&fine, 0.01)] {
        let largest = four_estimates(&solution.error_estimate.unwrap()).into_iter().fold(0.0, f64::max);
        assert!(largest <= accuracy, "{largest}");
    }
    let n = fine.grid.nx();
    let mut by_file = rough(n);
    by_file.roughness = as_files(&given, n, folder.path());
    by_file.solver.kind = SolverKind::Dry;
    assert_eq!(solved(&by_file).state.pressure, fine.state.pressure);
    // Node-by-node files hold the waves of their own cells.
    let mut from_file = given.clone();
    from_file.roughness = as_files(&given, 24, folder.path());
    let by_file = refined(from_file, 0.01);
    assert_eq!(by_file.grid, fine.grid);
    assert!((by_file.contact.area_ratio - fine.contact.area_ratio).abs() < 1e-9);
}

#[test]
fn a_random_surface_picks_its_own_cells() {
    let mut scene = rough(16);
    scene.solver.kind = SolverKind::Dry;
    scene.grid = GridSpec::Accuracy { accuracy: 0.05 };
    let solution = solved(&scene);
    let largest = four_estimates(&solution.error_estimate.unwrap()).into_iter().fold(0.0, f64::max);
    assert!(largest <= 0.05, "{largest}");
    assert!(solution.grid.dx() <= 10e-6 / 3.0, "{}", solution.grid.dx());
}

/// A self-affine surface with a shortest wave is a finite Fourier series.
#[test]
fn a_self_affine_surface_picks_its_own_cells() {
    let shape = |shortest| {
        RandomShape::SelfAffine(SelfAffine {
            hurst: 0.8,
            longest: f64::INFINITY,
            roll_off: 40e-6,
            shortest,
            synthesis: Synthesis::FilteredNoise,
        })
    };
    let mut scene = rough(16);
    scene.solver.kind = SolverKind::Dry;
    scene.grid = GridSpec::Accuracy { accuracy: 0.05 };
    let surface = RandomSurface::new(shape(12e-6), 100e-9, 3);
    scene.roughness = RoughnessPair { ball: Roughness::None, disc: Roughness::Random(surface) };
    let solution = solved(&scene);
    let largest = four_estimates(&solution.error_estimate.unwrap()).into_iter().fold(0.0, f64::max);
    assert!(largest <= 0.05, "{largest}");
    assert!(solution.grid.dx() <= 4e-6, "{}", solution.grid.dx());
    let of_mesh = |field: &str| field.starts_with("error_estimate.");
    assert!(solution.warnings.iter().all(|warning| of_mesh(&warning.field)), "{:?}", solution.warnings);
    // The heights of the first mesh are kept: the height asked for is that of all meshes.
    assert!(
        (solution.roughness.composite_rq / 100e-9 - 1.0).abs() < 0.3,
        "{}",
        solution.roughness.composite_rq
    );
    let message = |surface: RandomSurface| {
        let mut scene = scene.clone();
        scene.roughness.disc = Roughness::Random(surface);
        solve_contact(&scene).unwrap_err().to_string()
    };
    let endless = message(surface.with_shape(shape(0.0)));
    assert!(endless.starts_with("roughness.disc.shortest") && endless.contains("nx"), "{endless}");
    for other in [
        surface.with_boundary(Boundary::Open),
        surface.with_distribution(HeightDistribution::Johnson { skewness: -1.0, kurtosis: 5.0 }),
    ] {
        let text = message(other);
        assert!(text.starts_with("roughness.disc: ") && text.contains("nx"), "{text}");
    }
}

#[test]
fn surfaces_and_grids_without_an_estimate_are_refused() {
    let message = |scene: &Scene| solve_contact(scene).unwrap_err().to_string();
    let mut scene = rough(16);
    scene.grid = GridSpec::Accuracy { accuracy: 0.05 };
    let autocorrelation = Autocorrelation::Exponential;
    let random = RoughnessSpec { autocorrelation, rq: 1e-7, length_x: 1e-5, length_y: 1e-5, seed: 1 };
    scene.roughness.disc = random.into();
    let text = message(&scene);
    assert!(text.starts_with("roughness.disc.kind = \"exponential\"") && text.contains("nx"), "{text}");
    scene.roughness.disc = Roughness::File(FileRoughness { path: "disc.npy".into(), rq: None });
    let text = message(&scene);
    assert!(text.starts_with("roughness.disc.path = disc.npy") && text.contains("nx"), "{text}");
    scene.roughness.disc =
        RoughnessSpec { autocorrelation: Autocorrelation::Gaussian, length_x: 1e-9, ..random }.into();
    assert!(message(&scene).contains("nodes"), "{}", message(&scene));
    let mut few = rough(9);
    few.solver.estimate = true;
    assert!(message(&few).starts_with("grid.nx = 9"), "{}", message(&few));
    let mut paper = rough(16);
    paper.solver.estimate = true;
    paper.solver.contact = ContactDefinition::UnifiedReynolds;
    assert!(message(&paper).starts_with("solver.contact = \"paper\""), "{}", message(&paper));
    let mut wrong = rough(16);
    wrong.solver.accuracy = Some(0.5);
    assert!(message(&wrong).starts_with("solver.accuracy = 0.5"), "{}", message(&wrong));
    wrong.solver.accuracy = Some(0.05);
    wrong.grid = GridSpec::Accuracy { accuracy: 0.05 };
    assert!(message(&wrong).starts_with("solver.accuracy"), "{}", message(&wrong));
}

/// A limit of iterations is a status: the best state is there, and no estimate that it would not bear out.
#[test]
fn unconverged_contact_has_no_error_estimate() {
    let mut scene = rough(32);
    scene.solver.estimate = true;
    scene.solver.max_iterations = 1;
    let solution = solve_contact(&scene).unwrap();
    assert_ne!(solution.report.status, Status::Converged);
    assert!(solution.error_estimate.is_none() && solution.film.mean_central.is_finite());
}
