//! Cavitation with and without conservation of mass.

use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Cavitation, ContactSolver, ContactState, Evaluation, LubricatedContact, NewtonKrylov, Scheme, Squeeze,
    StoppingRule,
};
use stribeck::sim::scene::{GridSpec, Load, Roughness, SolverKind};
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    solution.report.require_converged().unwrap();
    solution
}

/// The oil of a scene.
fn lubricant(scene: &Scene) -> Lubricant {
    let oil = scene.lubricant.unwrap();
    Lubricant::new(
        Roelands::new(oil.eta0, oil.roelands_z, oil.roelands_p0).unwrap(),
        DowsonHigginson::new(oil.density_a, oil.density_b).unwrap(),
    )
}

/// The problem of a solved scene, without its limit.
fn problem<'a>(
    scene: &Scene,
    solution: &'a ContactSolution,
    oil: &'a Lubricant,
    body: &'a mut HalfSpace,
) -> LubricatedContact<'a> {
    LubricatedContact::new(
        &solution.gap,
        body,
        solution.hertz.force,
        (solution.hertz.half_width_x, solution.hertz.half_width_y),
        solution.hertz.pressure,
    )
    .with_lubricant(Some(oil))
    .with_entrainment_speed(scene.motion.entrainment_speed)
    .with_film_cutoff(scene.solver.film_cutoff)
    .with_contact(scene.solver.contact)
    .with_scheme(scene.scheme())
    .with_face_mobility(scene.face_mobility())
    .with_cavitation(scene.cavitation())
}

/// Asserts that a solution is one by its fields alone, and that its flows are those of its fields.
fn assert_evaluates(scene: &Scene, solution: &ContactSolution) {
    let oil = lubricant(scene);
    let limit = scene.plastic.map(|plastic| vec![plastic.hardness; solution.grid.len()]);
    let mut state = solution.state.clone();
    let mut body = HalfSpace::new(solution.grid, scene.elastic.equivalent_modulus).unwrap();
    let mut problem = problem(scene, solution, &oil, &mut body);
    problem.pressure_limit = limit.as_deref();
    let mut evaluation = Evaluation::new(solution.grid);
    let residuals = evaluation.evaluate(&mut problem, &mut state).unwrap();
    assert!(residuals.max() < 1e-5, "{residuals:?}");
    assert_eq!(state.theta, solution.state.theta);
    assert_eq!(evaluation.flow_balance(&problem, &solution.state).unwrap(), solution.flow);
}

#[test]
fn inflow_of_a_rough_contact_equals_its_outflow() {
    let mut scene = Scene::azam_2019(64);
    scene.solver.cavitation = Some(Cavitation::Reynolds);
    let solution = solved(&scene);
    assert_evaluates(&scene, &solution);
    let flow = solution.flow.unwrap();
    assert!(flow.inflow > 0.0, "{flow:?}");
    assert!((flow.imbalance - (flow.outflow / flow.inflow - 1.0)).abs() < 1e-12, "{flow:?}");
    assert!(flow.imbalance > 1e-3, "Reynolds' condition makes fluid where it reforms: {flow:?}");
    scene.solver.cavitation = Some(Cavitation::MassConserving);
    let solution = solved(&scene);
    assert_evaluates(&scene, &solution);
    let flow = solution.flow.unwrap();
    assert!(flow.imbalance <= scene.solver.tolerance, "{flow:?}");
    let state = &solution.state;
    let partly = state.theta.iter().filter(|content| **content < 1.0).count();
    assert!(partly > 100, "{partly} nodes are not filled");
    for (content, pressure) in state.theta.iter().zip(&state.fluid_pressure) {
        assert!(
            (0.0..=1.0).contains(content) && (*pressure <= 0.0 || *content >= 1.0),
            "{content}, {pressure}"
        );
    }
}

/// The balances of the cells add up to that of the box: the mass residual bounds its imbalance.
#[test]
fn the_mass_residual_bounds_the_imbalance_of_the_box() {
    let mut scenes: Vec<Scene> = [(0.01, 5), (1.0, 6)]
        .map(|(speed, seed)| {
            let mut scene = Scene::azam_2019(48);
            scene.motion.entrainment_speed = speed;
            if let Roughness::Random(random) = &mut scene.roughness.disc {
                random.seed = seed;
            }
            scene
        })
        .to_vec();
    let mut smooth = Scene::azam_2019(48);
    (smooth.roughness, smooth.plastic) = (Default::default(), None);
    let mut line = smooth.clone();
    line.form = Form::Cylinder { radius: 0.01 };
    line.load = Load::hertz_pressure(0.6e9);
    line.grid = GridSpec::Row { nx: 256, x: [-4e-4, 2e-4] };
    scenes.extend([smooth, line]);
    for mut scene in scenes {
        scene.solver.cavitation = Some(Cavitation::MassConserving);
        for tolerance in [1e-4, 1e-8] {
            scene.solver.tolerance = tolerance;
            let solution = solved(&scene);
            let (flow, mass) = (solution.flow.unwrap(), solution.report.residual.mass);
            assert!(flow.imbalance <= mass + 1e-13, "{flow:?}, mass residual {mass:e}");
        }
    }
}

/// With a squeeze term the box may store the inflow: a film that is thicker than the one before takes up the
/// difference.
#[test]
fn stored_mass_is_not_counted_as_imbalance() {
    let mut scene = Scene::azam_2019(32);
    scene.solver.cavitation = Some(Cavitation::MassConserving);
    let solution = solved(&scene);
    let oil = lubricant(&scene);
    let limit = vec![6e9; solution.grid.len()];
    let previous: Vec<f64> = solution.state.mass.iter().map(|mass| 0.8 * mass).collect();
    let mut body = HalfSpace::new(solution.grid, scene.elastic.equivalent_modulus).unwrap();
    let mut problem = problem(&scene, &solution, &oil, &mut body);
    problem.pressure_limit = Some(&limit);
    problem.squeeze = Some(Squeeze { previous_mass: &previous, time_step: 1e-4 });
    let mut state = solution.state.clone();
    let rule = StoppingRule::default().with_tolerance(1e-9);
    let report = NewtonKrylov::new().solve(&mut problem, &mut state, &rule).unwrap();
    report.require_converged().unwrap();
    let flow = Evaluation::new(solution.grid).flow_balance(&problem, &state).unwrap().unwrap();
    assert!((flow.outflow / flow.inflow - 1.0).abs() > 1e-3, "{flow:?}");
    assert!(flow.imbalance <= report.residual.mass + 1e-13, "{flow:?}, {report:?}");
}

/// Nothing reforms behind a smooth contact.
#[test]
fn smooth_films_do_not_depend_on_the_condition() {
    for kind in [SolverKind::NewtonKrylov, SolverKind::Auto] {
        let films = [Cavitation::Reynolds, Cavitation::MassConserving].map(|cavitation| {
            let mut scene = Scene::azam_2019(64);
            scene.roughness = Default::default();
            scene.plastic = None;
            scene.solver.kind = kind;
            scene.solver.cavitation = Some(cavitation);
            scene.solver.tolerance = 1e-8;
            solved(&scene).film
        });
        for (one, other) in [(films[0].central, films[1].central), (films[0].minimum, films[1].minimum)] {
            assert!((one / other - 1.0).abs() < 1e-6, "{kind:?}: {films:?}");
        }
    }
}

#[test]
fn contents_beyond_one_are_refused() {
    let mut state = ContactState::new(&stribeck::Grid::centred(8, 8, 1e-6, 1e-6).unwrap());
    state.theta[3] = 1.5;
    let error = state.validate(&stribeck::Grid::centred(8, 8, 1e-6, 1e-6).unwrap()).unwrap_err().to_string();
    assert!(error.contains("state.theta") && error.contains("1.5"), "{error}");
}

/// Nothing of a solve by another scheme is left in a solver that is used again.
#[test]
fn a_solver_is_used_again_with_another_scheme() {
    let mut scene = Scene::azam_2019(32);
    let oil = lubricant(&scene);
    scene.plastic = None;
    let solution = solved(&scene);
    let mut body = HalfSpace::new(solution.grid, scene.elastic.equivalent_modulus).unwrap();
    let mut solve = |solver: &mut NewtonKrylov, scheme: Scheme| {
        let mut problem = problem(&scene, &solution, &oil, &mut body);
        problem.scheme = scheme;
        let mut state = ContactState::new(&solution.grid);
        let report = solver.solve(&mut problem, &mut state, &StoppingRule::default()).unwrap();
        (report.work, state)
    };
    let mut used = NewtonKrylov::new();
    let _ = solve(&mut used, Scheme::Limited);
    assert_eq!(solve(&mut used, Scheme::FirstOrder), solve(&mut NewtonKrylov::new(), Scheme::FirstOrder));
}
