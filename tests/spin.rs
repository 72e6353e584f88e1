//! Surfaces that turn about a point beside the contact.

use stribeck::analytic::HertzPoint;
use stribeck::elastic::HalfSpace;
use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands};
use stribeck::reynolds::{
    Cavitation, ContactDefinition, ContactSolver, ContactState, LubricatedContact, Multigrid, NewtonKrylov,
    SemiSystem, StoppingRule,
};
use stribeck::sim::scene::GridSpec;
use stribeck::sim::{ContactSolution, Scene, solve_contact};
use stribeck::surface::Form;
use stribeck::{Grid, Status};

/// Half-width of the contact \[m\] and scene of a smooth ball that touches at (x, y) of a box of 2.8
/// half-widths around it.
fn with_ball<T>(
    cells: usize,
    centre: impl Fn(f64) -> (f64, f64),
    spin_radius: impl Fn(f64) -> Option<f64>,
    ask: impl FnOnce(&mut LubricatedContact<'_>, (f64, f64)) -> T,
) -> T {
    let (radius, modulus) = (9.525e-3, 230e9);
    let hertz = HertzPoint::from_max_pressure(radius, radius, modulus, 0.5e9).unwrap();
    let a = hertz.half_width_x;
    let ((cx, cy), half) = (centre(a), 2.8 * a);
    let grid = Grid::from_edges(cells, cells, [cx - half, cx + half], [cy - half, cy + half]).unwrap();
    let gap: Vec<f64> =
        grid.nodes().map(|(x, y)| ((x - cx).powi(2) + (y - cy).powi(2)) / (2.0 * radius)).collect();
    let law = Roelands::new(0.04, 0.6, 1.96e8).unwrap();
    let oil = Lubricant::new(law, DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap());
    let mut body = HalfSpace::new(grid, modulus).unwrap();
    let mut problem = LubricatedContact::new(&gap, &mut body, hertz.force, (a, a), hertz.pressure)
        .with_lubricant(Some(&oil))
        .with_entrainment_speed(0.5)
        .with_spin_radius(spin_radius(a))
        .with_reference_film(100e-9);
    ask(&mut problem, (cx, cy))
}

/// Film at the point of first touch and least film \[m\].
fn films(problem: &mut LubricatedContact<'_>, (cx, cy): (f64, f64)) -> [f64; 2] {
    let grid = problem.grid();
    let mut state = ContactState::new(&grid);
    let report = NewtonKrylov::new().solve(problem, &mut state, &StoppingRule::default()).unwrap();
    report.require_converged().unwrap();
    let centre = grid.interpolate(&state.film, cx, cy).unwrap();
    [centre, state.film.iter().copied().fold(f64::INFINITY, f64::min)]
}

/// The rough reference scene on 64 cells with a radius of spin.
fn rough(spin_radius: Option<f64>) -> Scene {
    let mut scene = Scene::azam_2019(64);
    scene.motion.spin_radius = spin_radius;
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    solution.report.require_converged().unwrap();
    solution
}

#[test]
fn a_contact_moved_along_the_circle_is_the_same_contact_turned() {
    const RADIUS: f64 = 8.0;
    let at = |degrees: f64| {
        let phi = degrees.to_radians();
        let centre = |a: f64| (RADIUS * a * phi.sin(), RADIUS * a * (1.0 - phi.cos()));
        with_ball(64, centre, |a| Some(RADIUS * a), films)
    };
    let [centre, least] = at(0.0);
    for degrees in [-20.0, 15.0, 30.0] {
        let [turned_centre, turned_least] = at(degrees);
        assert!((turned_centre / centre - 1.0).abs() < 0.005, "{degrees}: {turned_centre}, {centre}");
        assert!((turned_least / least - 1.0).abs() < 0.015, "{degrees}: {turned_least}, {least}");
    }
    // Without spin the film of a contact at that place is that of the speed along x.
    let [straight, _] = with_ball(64, |_| (0.0, 0.0), |_| None, films);
    assert!((straight / centre - 1.0).abs() < 0.01, "{straight}, {centre}");
}

#[test]
fn the_other_sense_of_rotation_is_the_mirror_image() {
    let mut scene = rough(Some(0.4e-3));
    scene.roughness = Default::default();
    let one = solved(&scene);
    scene.motion.spin_radius = Some(-0.4e-3);
    let other = solved(&scene);
    let (nx, ny) = (one.grid.nx(), one.grid.ny());
    for j in 0..ny {
        for i in 0..nx {
            let (film, mirrored) = (one.state.film[j * nx + i], other.state.film[(ny - 1 - j) * nx + i]);
            assert!((film / mirrored - 1.0).abs() < 1e-4, "{i}, {j}: {film}, {mirrored}");
        }
    }
    // The surfaces are slower at higher y.
    let row = |j: usize| one.state.mass[j * nx..(j + 1) * nx].iter().sum::<f64>();
    assert!((row(ny / 4) / row(ny - 1 - ny / 4) - 1.0).abs() > 1e-3, "nothing turns");
}

#[test]
fn a_distant_centre_is_no_spin() {
    let (none, far) = (solved(&rough(None)), solved(&rough(Some(1e3))));
    for (film, other) in none.state.film.iter().zip(&far.state.film) {
        assert!((film - other).abs() < 1e-4 * film.abs().max(1e-9), "{film}, {other}");
    }
    assert!((none.contact.load_ratio - far.contact.load_ratio).abs() < 1e-5);
}

#[test]
fn inflow_equals_outflow_with_spin() {
    for radius in [0.3e-3, -0.5e-3] {
        let mut scene = rough(Some(radius));
        let conserved = solved(&scene);
        let flow = conserved.flow.unwrap();
        assert!(flow.imbalance <= scene.solver.tolerance, "{flow:?}");
        assert!(conserved.state.theta.iter().any(|theta| *theta < 0.9), "nothing cavitates");
        scene.solver.cavitation = Some(Cavitation::Reynolds);
        assert!(solved(&scene).flow.unwrap().imbalance > 1e-3, "Reynolds' condition makes oil");
    }
}

#[test]
fn solvers_agree_or_say_that_they_do_not_know_spin() {
    let pressures = |solver: &mut dyn ContactSolver| {
        with_ball(
            32,
            |_| (0.0, 0.0),
            |a| Some(4.0 * a),
            |problem, _| {
                let mut state = ContactState::new(&problem.grid());
                let report = solver.solve(problem, &mut state, &StoppingRule::default())?;
                assert_eq!(report.status, Status::Converged);
                Ok::<_, stribeck::reynolds::ReynoldsError>(state.pressure)
            },
        )
    };
    let newton = pressures(&mut NewtonKrylov::new()).unwrap();
    let by_lines = pressures(&mut SemiSystem::default()).unwrap();
    for (p, other) in newton.iter().zip(&by_lines) {
        assert!((p - other).abs() < 1e-4 * 0.5e9, "{p}, {other}");
    }
    let error = pressures(&mut Multigrid::new()).unwrap_err().to_string();
    assert!(error.contains("which spin causes"), "{error}");
}

#[test]
fn spin_is_rejected_where_it_is_not_modelled() {
    let refusal = |change: &dyn Fn(&mut Scene)| {
        let mut scene = rough(Some(0.4e-3));
        change(&mut scene);
        solve_contact(&scene).unwrap_err().to_string()
    };
    for (change, wanted) in [
        (
            &(|scene: &mut Scene| scene.motion.spin_radius = Some(1e-4)) as &dyn Fn(&mut Scene),
            "0.0001: surfaces",
        ),
        (&|scene| scene.motion.spin_radius = Some(f64::NAN), "NaN"),
        (&|scene| scene.solver.contact = ContactDefinition::UnifiedReynolds, "the paper's contact"),
        (
            &|scene| {
                scene.lubricant = scene.lubricant.map(|oil| oil.with_supplied_film(Some(1e-7)));
            },
            "supplied_film",
        ),
        (
            &|scene| {
                scene.form = Form::Cylinder { radius: 0.01 };
                scene.grid = GridSpec::Row { nx: 64, x: [-0.25e-3, 0.25e-3] };
            },
            "second axis",
        ),
    ] {
        let error = refusal(change);
        assert!(error.contains("motion.spin_radius") && error.contains(wanted), "{error}");
    }
}
