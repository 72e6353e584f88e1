//! Single contacts and histories through one builder: the same parts for both, interrupts, laws on whole
//! fields, failed steps.
#![expect(clippy::float_cmp, reason = "equal results are equal to the last bit")]

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use stribeck::lubricant::Barus;
use stribeck::sim::scene::{InletSpec, Roughness, RoughnessPair, SolverKind};
use stribeck::sim::{BodyStart, MixedLubricationSim, Scene, SimError, solve_contact};
use stribeck::surface::Fixed;
use stribeck::tribochem::{FilmGrowthLaw, Ghanbarzadeh, Tribofilm, integrate_rates};
use stribeck::wear::{Archard, WearDepth, WearLaw};
use stribeck::{BoundaryFriction, ConstantFriction, InputError, Status, SurfaceState};

fn scene() -> Scene {
    Scene::azam_2019(32)
}

fn heights(scene: &Scene) -> [Vec<f64>; 2] {
    let sim = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    sim.bodies().each_ref().map(|body| body.surface().to_vec())
}

#[test]
fn a_simulation_can_go_to_another_thread() {
    fn moves<T: Send>() {}
    moves::<MixedLubricationSim>();
}

#[test]
fn the_single_contact_is_that_of_the_first_step() {
    let scene = scene();
    let solution = solve_contact(&scene).unwrap();
    let mut sim = MixedLubricationSim::builder(scene).motion(Fixed).build().unwrap();
    let record = sim.step(1.0).unwrap();
    assert_eq!(solution.report, record.report);
    assert_eq!(solution.film.mean_central, record.film.mean_central);
    assert_eq!(solution.contact.load_ratio, record.contact.load_ratio);
    assert_eq!(solution.friction.coefficient, record.friction.coefficient);
    assert_eq!(solution.roughness.composite_rq, record.roughness.composite_rq);
    assert_eq!(solution.film, record.film);
    assert_eq!(solution.state.pressure, sim.state().pressure);
}

#[test]
fn heights_in_memory_are_as_good_as_the_scene_that_makes_them() {
    let scene = scene();
    let [ball, disc] = heights(&scene);
    let named = solve_contact(&scene).unwrap();
    let mut bare = scene;
    bare.roughness = RoughnessPair::default();
    let given =
        MixedLubricationSim::builder(bare.clone()).ball_heights(ball).disc_heights(disc).solve().unwrap();
    assert_eq!(named.state, given.state);
    assert_eq!(named.friction.coefficient, given.friction.coefficient);
    assert_eq!(given.face_mobility, named.face_mobility, "rough surfaces, wherever they come from");
    let smooth = solve_contact(&bare).unwrap();
    assert_eq!(smooth.film.lambda, None, "smooth surfaces have no ratio");
    let flat = MixedLubricationSim::builder(bare).disc_heights(vec![0.0; 32 * 32]).solve().unwrap();
    assert_eq!(flat.face_mobility, smooth.face_mobility);
    assert_eq!(flat.state, smooth.state);
}

#[test]
fn single_contacts_take_the_parts_of_histories() {
    let scene = scene();
    let build = || MixedLubricationSim::builder(scene.clone());
    let own = build().solve().unwrap();
    let slippery = build().boundary_friction(ConstantFriction::new(0.0).unwrap()).solve().unwrap();
    assert_eq!(slippery.state, own.state);
    assert_eq!(slippery.friction.boundary, 0.0);
    assert_eq!(slippery.friction.fluid, own.friction.fluid);
    let thick = build().viscosity(Barus::new(0.4, 1e-8).unwrap()).solve().unwrap();
    assert!(thick.contact.load_ratio < 0.1 * own.contact.load_ratio, "{}", thick.contact.load_ratio);
    let [_, disc] = heights(&scene);
    let grid = scene.grid().unwrap();
    let start = || BodyStart::new(grid, disc.clone());
    assert_eq!(build().disc_start(start()).solve().unwrap().state, own.state);
    // A disc that is worn flat is a smooth one.
    let lowest = disc.iter().copied().fold(f64::INFINITY, f64::min);
    let worn = start().with_wear(disc.iter().map(|z| z - lowest).collect());
    assert!(
        build().disc_start(worn).solve().unwrap().roughness.composite_rq < 0.5 * own.roughness.composite_rq
    );
}

#[test]
fn history_starts_from_the_given_contact() {
    let scene = scene();
    let builder = || MixedLubricationSim::builder(scene.clone()).motion(Fixed);
    let start = builder().solve().unwrap().state;
    let told = || builder().contact_start(start.clone());
    let (mut cold, mut warm) = (builder().build().unwrap(), told().build().unwrap());
    let standing = [&mut cold, &mut warm].map(|sim| sim.solve_under(&sim.conditions()).unwrap().report);
    assert_eq!(standing[0], standing[1], "other contacts know nothing of it");
    let (first, short) = (cold.step(60.0).unwrap(), warm.step(60.0).unwrap());
    assert!(short.report.work.convolutions < 0.5 * first.report.work.convolutions);
    assert!((short.film.mean_central / first.film.mean_central - 1.0).abs() < 1e-3, "{short:?} {first:?}");
    let single = told().solve().unwrap();
    assert_eq!(single.report, short.report, "the single contact takes the same way");
    assert_eq!(single.state.pressure, warm.state().pressure);
    let mut again = told().build().unwrap();
    again.step(60.0).unwrap();
    assert_eq!(again.step(60.0).unwrap(), warm.step(60.0).unwrap());
    let mut small = scene.clone();
    small.grid = Scene::azam_2019(16).grid;
    let other = MixedLubricationSim::builder(small).solve().unwrap().state;
    assert!(builder().contact_start(other.clone()).check().is_err());
    assert!(builder().contact_start(other).build().unwrap().step(60.0).is_err());
}

#[test]
fn a_single_contact_of_several_meshes_takes_no_own_parts() {
    let mut scene = scene();
    scene.solver.estimate = true;
    let [_, disc] = heights(&self::scene());
    let error = MixedLubricationSim::builder(scene.clone()).disc_heights(disc).solve().unwrap_err();
    assert!(error.to_string().starts_with("disc_heights: "), "{error}");
    let friction = ConstantFriction::new(0.1).unwrap();
    let error = MixedLubricationSim::builder(scene).boundary_friction(friction).solve().unwrap_err();
    assert!(error.to_string().starts_with("boundary_friction: "), "{error}");
}

#[test]
fn every_solver_stops_at_an_interrupt() {
    let mut smooth = scene();
    smooth.roughness = RoughnessPair { ball: Roughness::None, disc: Roughness::None };
    smooth.motion.entrainment_speed = 5.0;
    smooth.lubricant.as_mut().unwrap().inlet = InletSpec::BoxEdge;
    for (kind, scene) in [
        (SolverKind::Auto, scene()),
        (SolverKind::NewtonKrylov, scene()),
        (SolverKind::SemiSystem, scene()),
        (SolverKind::Dry, scene()),
        (SolverKind::Multigrid, smooth),
    ] {
        let mut scene = scene;
        scene.solver.kind = kind;
        let solve = |after: u32| {
            let asked = Arc::new(AtomicU32::new(0));
            let count = Arc::clone(&asked);
            let builder = MixedLubricationSim::builder(scene.clone());
            let solved = builder.interrupt(move || count.fetch_add(1, Ordering::Relaxed) >= after).solve();
            (solved, asked.load(Ordering::Relaxed))
        };
        let (whole, questions) = solve(u32::MAX);
        let whole = whole.unwrap();
        assert!(questions > 2, "{kind:?} asks {questions} times");
        assert!(u64::from(questions) >= whole.report.work.iterations, "{kind:?}: once an iteration at least");
        for after in [0, 1, questions / 2, questions - 1] {
            let (cut, questions) = solve(after);
            assert!(matches!(cut, Err(SimError::Interrupted)), "{kind:?} after {after}: {cut:?}");
            assert_eq!(questions, after + 1, "{kind:?}: it ends at once");
        }
    }
}

#[test]
fn one_true_poll_ends_a_solve_wherever_it_comes() {
    let scene = || Scene::azam_2019(128);
    let polls = Arc::new(AtomicU32::new(0));
    let count = Arc::clone(&polls);
    let counted = MixedLubricationSim::builder(scene())
        .interrupt(move || count.fetch_add(1, Ordering::Relaxed) == u32::MAX)
        .solve();
    assert_eq!(counted.unwrap().report.status, Status::Converged);
    let all = polls.load(Ordering::Relaxed);
    for at in (0..8).map(|k| k * (all - 1) / 7) {
        let count = AtomicU32::new(0);
        let solved = MixedLubricationSim::builder(scene())
            .interrupt(move || count.fetch_add(1, Ordering::Relaxed) == at)
            .solve();
        assert!(matches!(solved, Err(SimError::Interrupted)), "poll {at} of {all}: {solved:?}");
    }
}

#[test]
fn refinement_stops_at_an_interrupt() {
    let mut scene = scene();
    scene.solver.estimate = true;
    let solved = MixedLubricationSim::builder(scene).interrupt(|| true).solve();
    assert!(matches!(solved, Err(SimError::Interrupted)));
}

#[test]
fn preparation_heeds_an_interrupt() {
    let mut estimated = scene();
    estimated.solver.estimate = true;
    for scene in [scene(), estimated] {
        let asked = Arc::new(AtomicU32::new(0));
        let count = Arc::clone(&asked);
        let builder = MixedLubricationSim::builder(scene.clone());
        builder.interrupt(move || count.fetch_add(1, Ordering::Relaxed) == u32::MAX).check_contact().unwrap();
        let questions = asked.load(Ordering::Relaxed);
        assert!(questions >= 3, "{questions} questions");
        for after in 0..questions {
            let asked = Arc::new(AtomicU32::new(0));
            let count = Arc::clone(&asked);
            let builder = MixedLubricationSim::builder(scene.clone());
            let checked =
                builder.interrupt(move || count.fetch_add(1, Ordering::Relaxed) >= after).check_contact();
            assert!(matches!(checked, Err(SimError::Interrupted)), "after {after} questions: {checked:?}");
            assert_eq!(asked.load(Ordering::Relaxed), after + 1);
        }
    }
}

#[test]
fn an_interrupted_step_leaves_the_simulation_as_before() {
    let scene = scene().with_tribofilm();
    let mut whole = MixedLubricationSim::builder(scene.clone()).build().unwrap();
    let left = Arc::new(AtomicU32::new(u32::MAX));
    let asked = Arc::clone(&left);
    let interrupt = move || asked.fetch_sub(1, Ordering::Relaxed) == 0;
    let mut sim = MixedLubricationSim::builder(scene).interrupt(interrupt).build().unwrap();
    assert_eq!(sim.step(60.0).unwrap(), whole.step(60.0).unwrap());
    let before = sim.checkpoint().unwrap();
    for questions in [0, 5] {
        left.store(questions, Ordering::Relaxed);
        assert!(matches!(sim.step(60.0), Err(SimError::Interrupted)));
        assert!(sim.checkpoint().unwrap() == before);
    }
    left.store(u32::MAX, Ordering::Relaxed);
    assert_eq!(sim.step(60.0).unwrap(), whole.step(60.0).unwrap());
}

/// A law that fails from the second step on.
#[derive(Default)]
struct Failing(AtomicU32);

impl fmt::Debug for Failing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Checkpoints tell laws from one another by it: the count is none of its constants.
        f.write_str("Failing")
    }
}

impl WearLaw for Failing {
    fn depth_rate(&self, at: &SurfaceState, _film_thickness: f64) -> f64 {
        1e-20 * at.pressure
    }

    fn depth_rates(&self, at: &[SurfaceState], film_thickness: &[f64], rates: &mut [f64]) {
        let calls = self.0.fetch_add(1, Ordering::Relaxed);
        for (rate, (at, film)) in rates.iter_mut().zip(at.iter().zip(film_thickness)) {
            *rate = self.depth_rate(at, *film);
        }
        // The disc, after the ball was worn already.
        if let (3, Some(last)) = (calls, rates.last_mut()) {
            *last = f64::NAN;
        }
    }
}

#[test]
fn a_law_that_fails_leaves_the_simulation_as_before() {
    let mut sim = MixedLubricationSim::builder(scene()).wear_law(Failing::default()).build().unwrap();
    sim.step(60.0).unwrap();
    let before = sim.checkpoint().unwrap();
    let error = sim.step(60.0).unwrap_err();
    assert!(matches!(error, SimError::Input(InputError::Value { .. })), "{error}");
    assert!(sim.checkpoint().unwrap() == before);
    assert_eq!(sim.step(60.0).unwrap().report.status, Status::Converged);
}

fn points() -> Vec<SurfaceState> {
    let point = |k: u32| {
        SurfaceState::new(1e8 * f64::from(k), 300.0 + f64::from(k))
            .with_solid_pressure(0.5e8 * f64::from(k))
            .with_shear_stress(1e7 * f64::from(k))
            .with_sliding_speed(0.1)
            .with_gap(1e-9)
            .with_in_contact(!k.is_multiple_of(3))
    };
    (0..60).map(point).collect()
}

/// Growth and removal that balance at a node's own thickness, with a kink.
#[derive(Debug)]
struct Kinked;

impl FilmGrowthLaw for Kinked {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        let balance = 1e-18 * at.pressure;
        if !at.in_contact {
            0.0
        } else if thickness < balance {
            1e-10 * (1.0 + (1e9 * thickness).sin())
        } else {
            -3e-2 * thickness
        }
    }

    fn maximum_thickness(&self) -> f64 {
        3e-9
    }
}

#[test]
fn films_of_whole_fields_are_those_of_their_nodes() {
    let points = points();
    let starts: Vec<f64> = (0..60).map(|k| 0.05e-9 * f64::from(k)).collect();
    for time in [0.0, 0.3, 40.0, 1e5] {
        let mut fields = starts.clone();
        let rates = |thickness: &[f64], out: &mut [f64]| {
            for (out, (at, thickness)) in out.iter_mut().zip(points.iter().zip(thickness)) {
                *out = Kinked.rate(at, *thickness);
            }
        };
        integrate_rates(rates, Kinked.maximum_thickness(), time, &mut fields);
        for (k, (at, start)) in points.iter().zip(&starts).enumerate() {
            let mut node = [*start];
            Kinked.advance(at, time, &mut node);
            assert_eq!(fields[k], node[0], "node {k} after {time} s");
            assert!(time > 0.0 || node[0] == *start);
        }
    }
    let law = Ghanbarzadeh::azam_2019();
    let (mut all, mut each) = (Tribofilm::bare(&law, 60), Tribofilm::bare(&law, 60));
    all.advance_all(&law, 100.0, &points).unwrap();
    each.advance(&law, 100.0, |node| points[node]).unwrap();
    assert_eq!(all, each);
    assert!(all.thickness()[1] > 0.0);
    assert!(all.advance_all(&law, 100.0, &points[1..]).is_err());
    assert_eq!(all, each, "unchanged");
}

#[test]
fn wear_and_friction_of_whole_fields_are_those_of_their_nodes() {
    let (points, law) = (points(), Archard::azam_2019());
    let films: Vec<f64> = (0..60).map(|k| 2e-9 * f64::from(k)).collect();
    let (mut all, mut each, mut rates) = (WearDepth::new(60), WearDepth::new(60), vec![0.0; 60]);
    all.advance_all(&law, 10.0, (&points, &films), &mut rates).unwrap();
    each.advance(&law, 10.0, |node| (points[node], films[node])).unwrap();
    assert_eq!(all, each);
    assert!(all.values()[59] > 0.0);
    assert!(all.advance_all(&law, 10.0, (&points, &films[1..]), &mut rates).is_err());
    assert!(all.advance_all(&law, f64::NAN, (&points, &films), &mut rates).is_err());
    assert_eq!(all, each, "nothing is worn");
    let friction = stribeck::FilmFriction::new(0.08, 0.12, 20e-9).unwrap();
    let pressures: Vec<f64> = points.iter().map(|at| at.solid_pressure).collect();
    let mut out = vec![0.0; 60];
    friction.coefficients(&pressures, 0.1, [&films, &films], &mut out);
    for (k, coefficient) in out.iter().enumerate() {
        assert_eq!(*coefficient, friction.coefficient(pressures[k], 0.1, [films[k]; 2]));
    }
}
