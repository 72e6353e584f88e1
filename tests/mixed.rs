//! Mixed lubrication: both definitions of contact, and scenes over the whole map that must keep converging.

use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Cavitation, ContactDefinition, ContactSolver, Evaluation, FaceMobility, LubricatedContact, NewtonKrylov,
    Scheme, StoppingRule,
};
use stribeck::sim::scene::{GridSpec, InletSpec, Load, Roughness, SolverKind};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::{SolverId, Status, Work};

/// Roughness of one of two bodies whose roughness together has the given Rq.
fn random(rq: f64, length: f64, seed: u64) -> Roughness {
    if rq > 0.0 { Roughness::gaussian(rq / 2.0_f64.sqrt(), length, seed) } else { Roughness::None }
}

/// The reference bodies with composite roughness `rq` of correlation length `length`, on a box of 3.6 Hertz
/// radii.
fn scene(n: usize, speed: f64, rq: f64, length: f64, pressure: f64, hardness: Option<f64>) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.motion.entrainment_speed = speed;
    scene.load = Load::hertz_pressure(pressure);
    scene.plastic = hardness.map(|hardness| scene.plastic.unwrap().with_hardness(hardness));
    scene.roughness.ball = random(rq, length, 1);
    scene.roughness.disc = random(rq, length, 2);
    let a = scene.hertz().unwrap().half_width_x;
    scene.grid = GridSpec::Cells { nx: n, ny: n, x: [-1.8 * a, 1.8 * a], y: [-1.8 * a, 1.8 * a] };
    scene
}

/// No film below the cut-off, no negative pressure, none above the limit, the load carried.
fn assert_sound(scene: &Scene, solution: &ContactSolution) {
    let (state, cutoff) = (&solution.state, scene.solver.film_cutoff);
    let limit = scene.plastic.map_or(f64::INFINITY, |plastic| plastic.hardness);
    assert!(state.film.iter().all(|&film| film > cutoff - 0.1e-9), "{}", solution.film.minimum_gap);
    assert!(state.pressure.iter().chain(&state.fluid_pressure).all(|p| (0.0..=limit).contains(p)));
    let inside = state.pressure.iter().sum::<f64>() * solution.grid.cell_area();
    let carried = inside + solution.pressure.load_outside;
    assert!((carried / solution.hertz.force - 1.0).abs() < 2e-6, "{carried}");
}

/// The solution of a scene that has to have one.
fn solve_soundly(scene: &Scene, name: &str) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{name}: {:?}", solution.report);
    assert_sound(scene, &solution);
    solution
}

#[test]
#[ignore = "slow"]
fn scenes_all_over_the_map_converge() {
    for (n, speed, rq, length, pressure, hardness) in [
        (64, 10.0, 20e-9, 10e-6, 0.5e9, None),
        (64, 10.0, 300e-9, 10e-6, 2.0e9, Some(2e9)),
        (64, 1.0, 130e-9, 40e-6, 1.15e9, Some(6e9)),
        (64, 1.0, 60e-9, 10e-6, 2.0e9, None),
        (64, 0.1, 20e-9, 10e-6, 1.15e9, Some(2e9)),
        (64, 0.1, 130e-9, 10e-6, 1.15e9, Some(6e9)),
        (64, 0.1, 300e-9, 40e-6, 0.5e9, None),
        (64, 0.01, 0.0, 10e-6, 1.15e9, None),
        (64, 0.01, 60e-9, 40e-6, 2.0e9, Some(6e9)),
        (64, 0.01, 300e-9, 10e-6, 1.15e9, Some(2e9)),
        (64, 0.001, 130e-9, 10e-6, 2.0e9, Some(2e9)),
        (64, 0.001, 20e-9, 40e-6, 0.5e9, None),
        (128, 0.1, 60e-9, 10e-6, 1.15e9, Some(6e9)),
        (128, 0.01, 130e-9, 10e-6, 1.15e9, Some(2e9)),
    ] {
        let scene = scene(n, speed, rq, length, pressure, hardness);
        let name = format!("{speed} m/s, {rq} m, {length} m, {pressure} Pa, {hardness:?}");
        let solution = solve_soundly(&scene, &name);
        assert!(solution.report.residual.max() <= 1e-6, "{name}: {:?}", solution.report);
    }
}

/// High asperities reach as far as the box does where the load is low; a smaller box shows it whatever their
/// seed.
#[test]
fn solids_touch_on_the_outermost_nodes_too() {
    for (speed, length, hardness) in [(1.0, 10e-6, None), (0.1, 40e-6, Some(2e9)), (0.01, 10e-6, Some(6e9))] {
        let mut scene = scene(64, speed, 300e-9, length, 0.5e9, hardness);
        let half = 1.05 * scene.hertz().unwrap().half_width_x;
        scene.grid = GridSpec::Cells { nx: 64, ny: 64, x: [-half, half], y: [-half, half] };
        scene.solver.edge_contact = true;
        let solution = solve_soundly(&scene, "a small box");
        let nodes = (0..64 * 64).map(|k| (k, [k % 64, k / 64]));
        let ring: Vec<usize> =
            nodes.filter(|(_, at)| at.iter().any(|i| i % 63 == 0)).map(|(k, _)| k).collect();
        assert!(ring.iter().any(|&k| solution.state.in_contact[k]), "no solids touch at the edge");
        assert!(ring.iter().all(|&k| solution.state.fluid_pressure[k] == 0.0), "fluid at the edge");
    }
}

/// Convolutions of the dry contact of the same surfaces, to which the tests below compare the work in oil.
fn dry_work(scene: &Scene) -> f64 {
    let mut dry = scene.clone();
    (dry.lubricant, dry.solver.tolerance) = (None, 1e-8);
    let report = solve_contact(&dry).unwrap().report;
    assert_eq!(report.status, Status::Converged, "{report:?}");
    report.work.convolutions
}

/// On 512 x 512 nodes cells are so small that an error of a film of some nanometres takes gigapascals to correct. A
/// start from bodies in contact costs a thousand convolutions there.
#[test]
#[ignore = "slow"]
fn the_rough_reference_contact_is_found_on_every_mesh() {
    let work = |n: usize, cavitation, mobility| {
        let mut scene = Scene::azam_2019(n);
        (scene.solver.cavitation, scene.solver.face_mobility) = (Some(cavitation), Some(mobility));
        solve_soundly(&scene, &format!("{n} cells")).report.work
    };
    let full = |n| work(n, Cavitation::Reynolds, FaceMobility::Wedge);
    let [coarse, fine] = [full(64), full(512)];
    let reference = dry_work(&Scene::azam_2019(64));
    // Where mass is conserved gaps drain one after the other.
    for (n, most) in [(64, 4.0 * reference), (128, 6.0 * reference)] {
        let work = work(n, Cavitation::MassConserving, FaceMobility::Inlet);
        assert!(work.convolutions <= most, "{n} cells: {work:?}");
    }
    let per_step = |work: Work| work.inner_iterations as f64 / work.iterations as f64;
    assert!(coarse.convolutions <= 6.0 * reference, "{coarse:?}, {reference}");
    assert!(fine.convolutions <= 1.9 * coarse.convolutions, "{coarse:?}, {fine:?}");
    assert!(per_step(fine) < 1.15 * per_step(coarse), "{coarse:?}, {fine:?}");
}

/// Rows of the flow, its derivatives and the elimination of nodes are divided between threads on grids of this size.
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let mut scene = scene(184, 0.1, 100e-9, 20e-6, 1.15e9, Some(6e9));
    scene.solver.tolerance = 1e-2;
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| solve_contact(&scene).unwrap())
    });
    assert_eq!(one.report.work, three.report.work);
    let bits = |values: &[f64]| -> Vec<u64> { values.iter().map(|value| value.to_bits()).collect() };
    assert_eq!(bits(&one.state.pressure), bits(&three.state.pressure));
    assert_eq!(bits(&one.state.film), bits(&three.state.film));
}

/// A Newton step leaves touching solids some nanometres off the contact film. Fluid flow through those films
/// would drain the isolated regions that they enclose, and the contacts would take ten to fifty times as many
/// convolutions.
#[test]
fn boundary_of_isolated_region_converges() {
    for (speed, rq, length, pressure) in
        [(0.01, 60e-9, 10e-6, 2e9), (0.01, 130e-9, 40e-6, 1.15e9), (0.001, 60e-9, 10e-6, 2e9)]
    {
        let scene = scene(64, speed, rq, length, pressure, None);
        let report = solve_soundly(&scene, &format!("{speed} m/s, {rq} m")).report;
        assert!(report.work.convolutions <= 9.0 * dry_work(&scene), "{report:?}");
    }
}

/// A region of one node may switch between cavitation and fluid in every step, an endless cycle without a
/// safeguard. Of sixteen such contacts one takes more than twice the median number of Newton steps, by continuation
/// from thicker contact films. Single counts depend on rounding.
#[test]
#[ignore = "slow"]
fn isolated_regions_do_not_cycle() {
    let steps = |scene: &Scene| solve_soundly(scene, "isolated regions").report.work.iterations;
    let (mut of_default, mut all) = (Vec::new(), Vec::new());
    for seed in (1..16).step_by(2) {
        let mut rough = scene(64, 0.1, 300e-9, 10e-6, 2e9, Some(2e9));
        rough.roughness.ball = random(300e-9, 10e-6, seed);
        rough.roughness.disc = random(300e-9, 10e-6, seed + 1);
        let mut simple = rough.clone();
        simple.solver.scheme = Some(Scheme::FirstOrder);
        simple.solver.face_mobility = Some(FaceMobility::ReducedPressure);
        simple.solver.cavitation = Some(Cavitation::Reynolds);
        of_default.push(steps(&rough));
        all.extend([of_default[of_default.len() - 1], steps(&simple)]);
    }
    all.sort_unstable();
    let median = all[all.len() / 2];
    assert!(of_default.iter().all(|steps| *steps <= 6 * median), "{of_default:?}");
    assert!(all.iter().filter(|steps| **steps > 3 * median).count() <= 1, "{all:?}");
}

/// The plastic depth of fluid at the limit does not follow from the pressures: a start keeps it.
#[test]
fn a_solution_with_fluid_at_the_limit_is_one() {
    let limit = 2e9;
    let scene = scene(64, 1.0, 130e-9, 10e-6, limit, Some(limit));
    let ContactSolution { gap, grid, hertz, mut state, report, .. } = solve_contact(&scene).unwrap();
    assert_eq!(report.status, Status::Converged, "{report:?}");
    let deep =
        state.fluid_pressure.iter().zip(&state.plastic_depth).filter(|(p, d)| **p >= limit && **d > 1e-9);
    assert!(deep.count() > 10, "fluid at the limit");
    let oil = Lubricant::new(
        Roelands::new(0.004, 0.68, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    );
    let limits = vec![limit; grid.len()];
    let mut body = HalfSpace::new(grid, scene.elastic.equivalent_modulus).unwrap();
    let mut problem = LubricatedContact::new(
        &gap,
        &mut body,
        hertz.force,
        (hertz.half_width_x, hertz.half_width_y),
        hertz.pressure,
    )
    .with_lubricant(Some(&oil))
    .with_entrainment_speed(scene.motion.entrainment_speed)
    .with_pressure_limit(Some(&limits))
    .with_film_cutoff(scene.solver.film_cutoff)
    .with_contact(ContactDefinition::Hard)
    .with_scheme(scene.scheme())
    .with_face_mobility(scene.face_mobility());
    let residuals = Evaluation::new(grid).evaluate(&mut problem, &mut state).unwrap();
    assert!(residuals.max() <= 1e-6, "{residuals:?}");
    let report = NewtonKrylov::new().solve(&mut problem, &mut state, &StoppingRule::default()).unwrap();
    assert_eq!((report.status, report.work.iterations), (Status::Converged, 0), "{report:?}");
}

/// From the dry contact these stall with every kind of attempt, the last two also by continuation over other speeds;
/// pseudo-time steps reach them.
#[test]
#[ignore = "slow"]
fn contacts_that_stall_from_the_dry_one_are_reached() {
    for (seed, hardness) in [(1, None), (1, Some(6e9)), (2, None), (6, None)] {
        let mut scene = scene(64, 0.01, 0.0, 10e-6, 2e9, hardness);
        let random = |rq, seed| Roughness::gaussian(rq, 10e-6, seed);
        (scene.roughness.ball, scene.roughness.disc) =
            (random(19.768e-9, seed), random(128.489e-9, 100 + seed));
        let half = 0.25e-3 * 2.0 / 1.15;
        scene.grid = GridSpec::Cells { nx: 64, ny: 64, x: [-half, half], y: [-half, half] };
        solve_soundly(&scene, &format!("seed {seed}"));
    }
}

#[test]
fn both_contacts_are_the_same_film_where_nothing_touches() {
    let mut hard = scene(64, 10.0, 20e-9, 40e-6, 1.15e9, Some(6e9));
    hard.lubricant.as_mut().unwrap().inlet = InletSpec::BoxEdge;
    let mut paper = hard.clone();
    paper.solver.contact = ContactDefinition::UnifiedReynolds;
    let mut sweeps = paper.clone();
    sweeps.solver.kind = SolverKind::SemiSystem;
    for scene in [&mut hard, &mut paper, &mut sweeps] {
        scene.solver.tolerance = 1e-8;
        scene.solver.scheme = Some(Scheme::Limited);
        scene.solver.face_mobility = Some(FaceMobility::Wedge);
    }
    let [hard, paper, sweeps] = [hard, paper, sweeps].map(|scene| solve_contact(&scene).unwrap());
    assert!(!hard.state.in_contact.contains(&true), "a full film");
    for other in [&paper, &sweeps] {
        assert_eq!(other.report.status, Status::Converged, "{:?}", other.report);
        for (ours, theirs) in [
            (hard.film.central, other.film.central),
            (hard.film.minimum, other.film.minimum),
            (hard.pressure.max, other.pressure.max),
        ] {
            assert!((ours / theirs - 1.0).abs() < 1e-6, "{}: {ours} and {theirs}", other.report.solver);
        }
    }
}

/// Nodes at the limit are pinned in the sweeps: beside clipped ones no balance would hold.
#[test]
#[ignore = "slow"]
fn the_papers_contact_converges_with_nodes_at_the_limit() {
    let mut scene = Scene::azam_2019(64);
    scene.motion.entrainment_speed = 1.0;
    scene.solver.contact = ContactDefinition::UnifiedReynolds;
    scene.solver.kind = SolverKind::SemiSystem;
    let solution = solve_contact(&scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    assert!(solution.contact.plastic_area > 0.0);
    assert!(solution.state.plastic_depth.iter().any(|depth| *depth > 1e-9));
}

/// Values of the published contact model where asperities touch: films settle at negative gaps long before the balances
/// do, and nodes at the limit yield. The stiffness of the sweeps does not affect them.
#[test]
#[ignore = "slow"]
fn the_papers_contact_lets_gaps_become_negative() {
    let mut scene = Scene::azam_2019(64);
    scene.solver.contact = ContactDefinition::UnifiedReynolds;
    scene.solver.max_iterations = 3000;
    let solution = solve_contact(&scene).unwrap();
    let state = &solution.state;
    assert_eq!(solution.report.solver, SolverId::SemiSystem);
    assert!(solution.report.residual.is_finite());
    assert_eq!(solution.report.status, Status::MaxIterations, "{:?}", solution.report);
    assert!((solution.contact.area_ratio - 0.457).abs() < 5e-4, "{}", solution.contact.area_ratio);
    assert!((solution.film.mean_central - 41.0e-9).abs() < 0.05e-9, "{:e}", solution.film.mean_central);
    assert!((solution.film.minimum_gap + 341e-9).abs() < 0.5e-9, "{:e}", solution.film.minimum_gap);
    // Relaxed steps end some units in the last place short of the limit: they are at it all the same.
    let deepest = state.plastic_depth.iter().copied().fold(0.0, f64::max);
    assert!((deepest - 50.3e-9).abs() < 0.1e-9, "{deepest:e}");
    assert!(solution.contact.plastic_area > 0.0);
    for (k, depth) in state.plastic_depth.iter().enumerate() {
        let yields = state.pressure[k] >= 6e9 * (1.0 - 1e-12) && state.film[k] < 0.0;
        assert!(
            if yields { (depth + state.film[k]).abs() < 1e-18 } else { *depth == 0.0 },
            "node {k}: {depth:e}"
        );
    }
    assert!(state.pressure.iter().all(|p| (0.0..=6e9).contains(p)), "pressures are cut");
    for (k, &touches) in state.in_contact.iter().enumerate() {
        assert_eq!(touches, state.pressure[k] > 0.0 && state.film[k] < scene.solver.film_cutoff, "node {k}");
        assert!(!touches || state.fluid_pressure[k] < f64::MIN_POSITIVE, "node {k}: all of it is solid");
    }
    (scene.solver.kind, scene.solver.stiffness) = (SolverKind::SemiSystem, 20.0);
    let stiffer = solve_contact(&scene).unwrap();
    assert!((stiffer.contact.area_ratio - 0.457).abs() < 5e-4, "{}", stiffer.contact.area_ratio);
    assert!((stiffer.film.mean_central - 41.0e-9).abs() < 0.05e-9, "{:e}", stiffer.film.mean_central);
    scene.solver.kind = SolverKind::NewtonKrylov;
    let refused = solve_contact(&scene).unwrap_err().to_string();
    assert!(refused.contains("newton_krylov") && refused.contains("paper"), "{refused}");
}
