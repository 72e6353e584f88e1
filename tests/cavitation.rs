//! Cavitation with and without conservation of mass.
#![expect(clippy::unwrap_used, reason = "a panic is how a test fails")]

use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Cavitation, ContactSolver, ContactState, Evaluation, LubricatedContact, NewtonKrylov, Scheme,
    StoppingRule,
};
use stribeck::sim::scene::SolverKind;
use stribeck::sim::{ContactSolution, Scene, solve_contact};

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    let _ = solution.report.require_converged().unwrap();
    solution
}

/// Flow into and out of the box at a solution.
fn edge_flow(scene: &Scene, solution: &ContactSolution) -> (f64, f64) {
    let oil = scene.lubricant.unwrap();
    let oil = Lubricant::new(
        Roelands::new(oil.eta0, oil.roelands_z, oil.roelands_p0).unwrap(),
        DowsonHigginson::new(oil.density_a, oil.density_b).unwrap(),
    );
    let limit = scene.plastic.map(|plastic| vec![plastic.hardness; solution.grid.len()]);
    let mut state = solution.state.clone();
    let mut problem = LubricatedContact {
        gap: &solution.gap,
        deformation: &mut HalfSpace::new(solution.grid, scene.elastic.equivalent_modulus).unwrap(),
        lubricant: Some(&oil),
        entrainment_speed: scene.motion.entrainment_speed,
        squeeze: None,
        load: solution.hertz.load,
        pressure_limit: limit.as_deref(),
        film_cutoff: scene.solver.film_cutoff,
        contact: scene.solver.contact,
        scheme: scene.scheme(),
        face_mobility: scene.face_mobility(),
        cavitation: scene.solver.cavitation,
        shear_thinning: None,
        reference_half_widths: (solution.hertz.a_x, solution.hertz.a_y),
        reference_pressure: solution.hertz.p_max,
        reference_film: 0.0,
    };
    let mut evaluation = Evaluation::new(solution.grid);
    let residuals = evaluation.evaluate(&mut problem, &mut state).unwrap();
    assert!(residuals.max() < 1e-5, "{residuals:?}");
    assert_eq!(state.content, solution.state.content);
    evaluation.edge_flow()
}

#[test]
fn what_flows_into_a_rough_contact_flows_out() {
    let mut scene = Scene::azam_2019(64);
    let imbalance = |scene: &Scene, solution: &ContactSolution| {
        let (inflow, outflow) = edge_flow(scene, solution);
        assert!(inflow > 0.0 && outflow > 0.0, "{inflow:e}, {outflow:e}");
        outflow / inflow - 1.0
    };
    let made = imbalance(&scene, &solved(&scene));
    assert!(made > 1e-3, "Reynolds' condition makes fluid where it reforms: {made:e}");
    scene.solver.cavitation = Cavitation::MassConserving;
    let solution = solved(&scene);
    let made = imbalance(&scene, &solution);
    assert!(made.abs() <= scene.solver.tolerance, "{made:e}");
    let state = &solution.state;
    let partly = state.content.iter().filter(|content| **content < 1.0).count();
    assert!(partly > 100, "{partly} nodes are not filled");
    for (content, pressure) in state.content.iter().zip(&state.fluid_pressure) {
        assert!(
            (0.0..=1.0).contains(content) && (*pressure <= 0.0 || *content >= 1.0),
            "{content}, {pressure}"
        );
    }
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
            scene.solver.cavitation = cavitation;
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
    state.content[3] = 1.5;
    let error = state.validate(&stribeck::Grid::centred(8, 8, 1e-6, 1e-6).unwrap()).unwrap_err().to_string();
    assert!(error.contains("state.content") && error.contains("1.5"), "{error}");
}

/// Nothing of a solve by another scheme is left in a solver that is used again.
#[test]
fn a_solver_is_used_again_with_another_scheme() {
    let mut scene = Scene::azam_2019(32);
    let oil = scene.lubricant.unwrap();
    let oil = Lubricant::new(
        Roelands::new(oil.eta0, oil.roelands_z, oil.roelands_p0).unwrap(),
        DowsonHigginson::new(oil.density_a, oil.density_b).unwrap(),
    );
    scene.plastic = None;
    let solution = solved(&scene);
    let mut body = HalfSpace::new(solution.grid, scene.elastic.equivalent_modulus).unwrap();
    let mut solve = |solver: &mut NewtonKrylov, scheme: Scheme| {
        let mut problem = LubricatedContact {
            gap: &solution.gap,
            deformation: &mut body,
            lubricant: Some(&oil),
            entrainment_speed: scene.motion.entrainment_speed,
            squeeze: None,
            load: solution.hertz.load,
            pressure_limit: None,
            film_cutoff: scene.solver.film_cutoff,
            contact: scene.solver.contact,
            scheme,
            face_mobility: scene.face_mobility(),
            cavitation: scene.solver.cavitation,
            shear_thinning: None,
            reference_half_widths: (solution.hertz.a_x, solution.hertz.a_y),
            reference_pressure: solution.hertz.p_max,
            reference_film: 0.0,
        };
        let mut state = ContactState::new(&solution.grid);
        let report = solver.solve(&mut problem, &mut state, &StoppingRule::default()).unwrap();
        (report.work, state)
    };
    let mut used = NewtonKrylov::new();
    let _ = solve(&mut used, Scheme::Limited);
    assert_eq!(solve(&mut used, Scheme::FirstOrder), solve(&mut NewtonKrylov::new(), Scheme::FirstOrder));
}
