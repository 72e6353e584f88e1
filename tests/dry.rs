//! Dry contacts of scenes: errors that fall with the mesh, steps that do not grow with it, boxes that are too
//! small.

use stribeck::Status;
use stribeck::sim::scene::{GridSpec, PlasticSpec, SolverKind};
use stribeck::sim::{ContactSolution, Scene, SimError, solve_contact};

/// The reference scene without oil, to 1e-9.
fn dry(n: usize) -> Scene {
    let mut scene = Scene::azam_2019(n);
    scene.solver.kind = SolverKind::Dry;
    scene.solver.tolerance = 1e-9;
    scene
}

fn smooth(n: usize) -> Scene {
    let mut scene = dry(n);
    scene.roughness = Default::default();
    scene.plastic = None;
    scene
}

fn solved(scene: &Scene) -> ContactSolution {
    let solution = solve_contact(scene).unwrap();
    assert_eq!(solution.report.status, Status::Converged, "{:?}", solution.report);
    assert!(solution.report.residual.max() <= 1e-9, "{:?}", solution.report);
    solution
}

/// Peak, approach, force and radius of the smooth ball. Errors scatter about n^-2, as the contact edge
/// crosses cells: measured 3.6e-5, 6.8e-6 and 2.1e-6 for the peak, 2.1e-5, 7.4e-6 and 1.4e-6 for the
/// approach.
#[test]
#[ignore = "slow"]
fn smooth_ball_converges_to_hertz_at_second_order() {
    for (n, peak_bound) in [(128, 5e-5), (256, 1e-5), (512, 3e-6)] {
        let solution = solved(&smooth(n));
        let hertz = solution.hertz;
        let peak = solution.pressure.max / hertz.pressure - 1.0;
        let approach = solution.state.approach / (hertz.half_width_x.powi(2) / 9.525e-3) - 1.0;
        let load =
            solution.state.pressure.iter().sum::<f64>() * solution.grid.cell_area() / hertz.force - 1.0;
        // The second moment of the Hertz pressure is a^2/5.
        let (mut moment, mut sum) = (0.0, 0.0);
        for ((x, _), p) in solution.grid.nodes().zip(&solution.state.pressure) {
            moment += x * x * p;
            sum += p;
        }
        let radius = (5.0 * moment / sum).sqrt() / hertz.half_width_x - 1.0;
        assert!(peak.abs() < peak_bound, "{n}: peak {peak:e}");
        assert!(approach.abs() < 4e-5 * (128.0 / n as f64).powi(2), "{n}: approach {approach:e}");
        assert!(radius.abs() < 1.2e-4 * (128.0 / n as f64).powi(2), "{n}: radius {radius:e}");
        assert!(load.abs() < 1e-12, "{n}: load {load:e}");
    }
}

#[test]
#[ignore = "slow"]
fn steps_of_a_yielding_rough_contact_do_not_grow_with_the_grid() {
    let reference = solved(&dry(128)).report.work.inner_iterations;
    for n in [128, 256, 512] {
        for hardness in [6e9, 2e9] {
            let mut scene = dry(n);
            scene.plastic = Some(PlasticSpec::new(hardness));
            let solution = solved(&scene);
            let steps = solution.report.work.inner_iterations;
            assert!(3 * steps <= 4 * reference, "{n} nodes, {hardness:e} Pa: {steps} steps, {reference}");
            assert!(solution.state.pressure.iter().all(|&p| p <= hardness));
            assert!(solution.contact.plastic_area > 0.0, "the limit acts");
        }
    }
}

/// Conjugate-gradient steps on the finest grid, to 1e-8; the first contact is the reference.
#[test]
#[ignore = "slow"]
fn steps_of_rough_contacts_do_not_grow_with_the_grid() {
    let mut reference = None;
    for n in [128, 129, 256, 512] {
        for hardness in [None, Some(6e9), Some(2e9)] {
            let mut scene = dry(n);
            scene.solver.tolerance = 1e-8;
            let spec = |hardness| PlasticSpec::new(hardness);
            scene.plastic = hardness.map(spec);
            let report = solve_contact(&scene).unwrap().report;
            assert_eq!(report.status, Status::Converged, "{report:?}");
            let steps = report.work.inner_iterations;
            let reference = *reference.get_or_insert(steps);
            assert!(3 * steps <= 5 * reference, "{n} nodes, {hardness:?}: {report:?}, {reference}");
            let energy_error = report.energy_error.unwrap();
            assert!((0.0..1e-5).contains(&energy_error), "{n} nodes, {hardness:?}: {energy_error:e}");
        }
    }
}

#[test]
fn load_above_the_hardness_names_the_largest_load() {
    let mut scene = smooth(64);
    let area = solve_contact(&scene).unwrap().grid.cell_area() * 62.0 * 62.0;
    let hardness = 0.99 * scene.hertz().unwrap().force / area;
    scene.plastic = Some(PlasticSpec::new(hardness));
    let message = solve_contact(&scene).unwrap_err().to_string();
    let largest = format!("{:.6e} N", hardness * area);
    assert!(message.contains("plastic.hardness") && message.contains(&largest), "{message}");
}

#[test]
fn contact_at_the_box_edge_is_an_error_unless_allowed() {
    for x in [[-0.14e-3, 0.25e-3], [-0.25e-3, 0.1e-3], [-0.14e-3, 0.14e-3]] {
        for turned in [false, true] {
            let mut scene = smooth(64);
            let wide = [-0.25e-3, 0.25e-3];
            let (x, y) = if turned { (wide, x) } else { (x, wide) };
            scene.grid = GridSpec::Cells { nx: 64, ny: 64, x, y };
            for kind in [SolverKind::Dry, SolverKind::Auto] {
                scene.solver.kind = kind;
                scene.lubricant = None;
                let error = solve_contact(&scene).unwrap_err();
                let key = if turned { "grid.y" } else { "grid.x" };
                assert!(matches!(&error, SimError::BoxTooSmall(edge) if edge.field == key), "{error}");
                assert!(error.to_string().contains("edge of the box"), "{error}");
            }
            scene.solver.edge_contact = true;
            let solution = solved(&scene);
            assert!(solution.pressure.max > 1.0003 * 1.15e9, "the load outside of the box is carried inside");
            let load = solution.state.pressure.iter().sum::<f64>() * solution.grid.cell_area();
            assert!((load / solution.hertz.force - 1.0).abs() < 1e-9);
        }
    }
}

#[test]
fn tolerance_below_rounding_ends_as_stalled() {
    for tolerance in [1e-300, 1e-17] {
        let mut scene = dry(64);
        (scene.solver.tolerance, scene.solver.max_iterations) = (tolerance, u64::MAX);
        let report = solve_contact(&scene).unwrap().report;
        assert!(report.energy_error.unwrap() < 1e-9, "{report:?}");
        assert_eq!(report.status, Status::Stalled, "{report:?}");
        assert!(report.work.iterations < 1000 && report.residual.max() < 1e-12, "{report:?}");
    }
}

/// The area of a Hertz circle: whole cells along its edge overestimate it by a share of the cell size, which
/// the edge correction removes.
#[test]
#[ignore = "slow"]
fn corrected_area_converges_to_hertz_faster() {
    // Root mean square over adjacent sizes, as the error of a single rasterized circle is random.
    let errors = |sizes: [usize; 6]| {
        let mut squares = [0.0; 2];
        for n in sizes {
            let solution = solved(&smooth(n));
            for (sum, area) in
                squares.iter_mut().zip([solution.contact.area, solution.contact.corrected_area])
            {
                *sum += (area / solution.hertz.area - 1.0).powi(2);
            }
        }
        squares.map(|sum: f64| (sum / 6.0).sqrt())
    };
    let [coarse, coarse_corrected] = errors([60, 62, 64, 66, 68, 70]);
    let [fine, fine_corrected] = errors([240, 244, 248, 252, 256, 260]);
    // The figures of docs/errors.md.
    for (found, shown) in
        [(coarse, 1.19e-2), (coarse_corrected, 0.75e-2), (fine, 0.29e-2), (fine_corrected, 0.12e-2)]
    {
        assert!((found - shown).abs() < 1e-4, "{found} {shown}");
    }
    assert!(coarse_corrected / fine_corrected > coarse / fine);
}
