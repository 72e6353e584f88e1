//! Rigid surfaces with a given film: benchmarks of cavitation, conservation of mass, bad input.

use std::cell::Cell;

use stribeck::lubricant::{Barus, DowsonHigginson, Incompressible, Lubricant};
use stribeck::reynolds::{FilmThickness, GivenFilm, GivenFilmSolution, ReynoldsError, SideEdges};
use stribeck::{Grid, Status};

use crate::common::pocket_slider::{ETA, PocketSlider};

fn oil(eta: f64, alpha: f64) -> Lubricant {
    Lubricant::new(Barus::new(eta, alpha).unwrap(), Incompressible)
}

fn solved(problem: &GivenFilm<'_>) -> GivenFilmSolution {
    let solution = problem.solve().unwrap();
    solution.report.require_converged().unwrap();
    assert!(solution.flow.imbalance <= 1e-10, "imbalance {:e}", solution.flow.imbalance);
    let pairs = solution.pressure.iter().zip(&solution.theta);
    for (&p, &theta) in pairs {
        let p = p - problem.cavitation_pressure;
        assert!(p >= 0.0 && (0.0..=1.0).contains(&theta) && (p <= 0.0 || theta >= 1.0), "{p} {theta}");
    }
    solution
}

/// The slider on `cells`.
fn solved_slider(slider: &PocketSlider, cells: usize) -> GivenFilmSolution {
    let film = slider.film_on(cells).unwrap();
    let oil = oil(ETA, 0.0);
    solved(&slider.problem(&film, &oil))
}

/// Pressures, flows, load and place of reformation are exact to second order, wherever the edges of the
/// pocket lie in their cells.
fn check(slider: PocketSlider, cells: usize) {
    let (found, exact) = (solved_slider(&slider, cells), slider.exact());
    let off = |a: f64, b: f64| (a - b).abs() / b.abs();
    let order = 0.3 / (cells * cells) as f64;
    for (x, exact) in PocketSlider::POCKET.into_iter().zip(exact.pressures) {
        let p = found.pressure_at(x, 0).unwrap();
        assert!((p - exact).abs() < 1e-9 * exact.abs() + 1e-6, "{slider:?}, {cells}: {p} at {x}, {exact}");
    }
    for flow in [found.flow.inflow, found.flow.outflow] {
        assert!(off(flow, exact.flow) < 1e-10, "{slider:?}, {cells}: {flow}, {exact:?}");
    }
    assert!(off(found.load, exact.load) < order, "{slider:?}, {cells}: {}, {exact:?}", found.load);
    assert_eq!(found.reformation(0).is_some(), exact.reformation.is_some());
    if let (Some(found), Some(exact)) = (found.reformation(0), exact.reformation) {
        assert!(off(found, exact) < order, "{slider:?}, {cells}: {found}, {exact}");
    }
}

#[test]
fn slider_with_a_pocket_is_that_of_the_integrals() {
    let load = PocketSlider::fowell(0.02).exact().load;
    assert!((load - 2333.452).abs() < 1e-3, "{load}");
    for speed in [1e-4, 0.02, 0.033, 0.034, 0.05, 0.2, 1.0, 5.0] {
        for cells in [60, 97, 100, 333, 700, 1000] {
            check(PocketSlider::fowell(speed), cells);
        }
    }
}

#[test]
fn deep_pocket_in_a_parallel_slider() {
    for cells in [100, 333, 1000] {
        check(PocketSlider::giacopini(), cells);
    }
}

/// Peak pressure \[Pa\] of the pocket of finite width of Bertocchi et al. (2013), and its place over the
/// length.
fn pocket_of_finite_width(lubricant: &Lubricant) -> (f64, f64) {
    let (length, width) = (20e-3, 10e-3);
    let grid = Grid::from_edges(200, 100, [0.0, length], [-0.5 * width, 0.5 * width]).unwrap();
    let film = FilmThickness::from_function(grid, |x, y| {
        let in_pocket = x > 4e-3 && x < 10e-3 && y.abs() < 3.5e-3;
        1.1e-6 - 0.1e-6 * x / length + if in_pocket { 0.4e-6 } else { 0.0 }
    })
    .unwrap();
    let solution = solved(&GivenFilm::new(&film, lubricant, [1.0, 0.0]));
    let largest = |best: (usize, f64), (k, &p): (usize, &f64)| if p > best.1 { (k, p) } else { best };
    let (k, peak) = solution.pressure.iter().enumerate().fold((0, 0.0), largest);
    (peak, grid.x(k % grid.nx()) / length)
}

#[test]
fn pocket_of_finite_width_has_the_peak_of_the_figure() {
    let barus = || Barus::new(ETA, 1.2e-8).unwrap();
    let compressible = Lubricant::new(barus(), DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap());
    let (peak, place) = pocket_of_finite_width(&compressible);
    assert!((peak / 8.50e6 - 1.0).abs() < 0.03, "{peak}");
    assert!((place - 0.504).abs() < 0.01, "{place}");
    // The wedge of a tenth is so slight that half a per cent of compression takes a twentieth of the
    // pressure.
    let (incompressible, _) = pocket_of_finite_width(&Lubricant::new(barus(), Incompressible));
    assert!((incompressible / peak - 1.048).abs() < 0.005, "{incompressible} {peak}");
}

/// 5 x 5 square dimples, a third of their distance wide, in parallel squares of 80 mm.
fn textured_square(cells: usize) -> GivenFilmSolution {
    let side = 0.08;
    let grid = Grid::from_edges(cells, cells, [0.0, side], [0.0, side]).unwrap();
    let centre = |x: f64| (5.0 * x / side).fract() - 0.5;
    let film = FilmThickness::from_function(grid, |x, y| {
        if centre(x).abs() < 1.0 / 6.0 && centre(y).abs() < 1.0 / 6.0 { 27e-6 } else { 15e-6 }
    })
    .unwrap();
    solved(
        &GivenFilm::new(&film, &oil(0.03, 0.0), [5.0, 0.0])
            .with_ambient_pressure(1e5)
            .with_cavitation_pressure(3e4),
    )
}

#[test]
fn newton_steps_do_not_grow_with_the_grid() {
    let steps: Vec<u64> =
        [30, 60, 120, 240].into_iter().map(|cells| textured_square(cells).report.work.iterations).collect();
    let spread = steps.iter().max().unwrap() - steps.iter().min().unwrap();
    assert!(spread <= 2, "{steps:?}");
}

#[test]
fn edges_that_cut_cells_converge() {
    // Round dimples on grids that fit nothing, from hardly to heavily cavitated.
    for cells in [57, 83, 101] {
        for speed in [0.3, 0.7, 5.0] {
            let grid = Grid::from_edges(cells, cells, [0.0, 0.08], [0.0, 0.08]).unwrap();
            let centre = |x: f64| (125.0 * x).fract() - 0.5;
            let dimpled = |x: f64, y: f64| if centre(x).hypot(centre(y)) < 0.35 { 27e-6 } else { 15e-6 };
            let film = FilmThickness::from_function(grid, dimpled).unwrap();
            let _ = solved(
                &GivenFilm::new(&film, &oil(0.03, 0.0), [speed, 0.0])
                    .with_ambient_pressure(1e5)
                    .with_cavitation_pressure(3e4),
            );
        }
    }
}

/// A pad of 10 mm that converges from 2 to 1 um.
fn pad(rows: usize, lubricant: &Lubricant, speeds: [f64; 2], turned: bool) -> GivenFilmSolution {
    let grid = Grid::from_edges(400, rows, [0.0, 1e-2], [0.0, 1.0]).unwrap();
    let film = FilmThickness::from_function(grid, |x, _| {
        let x = if turned { 1e-2 - x } else { x };
        2e-6 - 1e-4 * x
    })
    .unwrap();
    solved(&GivenFilm::new(&film, lubricant, speeds).with_sides(SideEdges::Closed))
}

#[test]
fn friction_of_a_pad() {
    let (lubricant, u) = (oil(ETA, 0.0), 2.0);
    let unit = ETA * u * 1e-2 / 1e-6;
    let solution = pad(1, &lubricant, [u, 0.0], false);
    let [moving, resting] = solution.friction;
    let log = 2.0_f64.ln();
    assert!((moving / unit + 4.0 * log - 2.0).abs() < 1e-5, "{moving}");
    // Both forces and the pressure on the slope of the film balance.
    let on_slope = 1e-4 * solution.load;
    assert!(((moving + resting + on_slope) / unit).abs() < 1e-5, "{moving} {resting} {on_slope}");
    // The same entrainment by two surfaces that do not slide: no shear but that of the pressure.
    let rolling = pad(1, &lubricant, [0.5 * u, 0.5 * u], false);
    assert!((rolling.load / solution.load - 1.0).abs() < 1e-12);
    assert!((rolling.friction[0] / rolling.friction[1] - 1.0).abs() < 1e-12);
}

/// A film that opens from 1 to 2 um along the flow cavitates from its edge on and carries `theta h = h_0`: friction
/// is `eta u` times the integral of `h_0/h^2`, `eta u L/h_1`.
#[test]
fn friction_of_a_diverging_film_is_that_of_its_fluid() {
    let (length, u) = (1e-2, 2.0);
    let grid = Grid::from_edges(400, 1, [0.0, length], [0.0, 1.0]).unwrap();
    let film = FilmThickness::from_function(grid, |x, _| 1e-6 * (1.0 + x / length)).unwrap();
    let solution = solved(&GivenFilm::new(&film, &oil(ETA, 0.0), [u, 0.0]));
    assert!(solution.load.abs() < 1e-9 && solution.theta[399] < 0.51);
    let exact = ETA * u * length / 2e-6;
    assert!((solution.friction[1] / exact - 1.0).abs() < 2e-3, "{:?} {exact}", solution.friction);
}

#[test]
fn turned_round_it_is_the_same() {
    let lubricant = oil(ETA, 2e-9);
    let forward = pad(1, &lubricant, [1.0, 0.0], false);
    let backward = pad(1, &lubricant, [-1.0, 0.0], true);
    assert!((forward.load / backward.load - 1.0).abs() < 1e-12);
    assert!((forward.friction[0] / backward.friction[0] + 1.0).abs() < 1e-12);
    let turned = backward.pressure.iter().rev();
    assert!(forward.pressure.iter().zip(turned).all(|(a, b)| (a - b).abs() <= 1e-9 * a.abs()));
}

#[test]
fn closed_sides_make_many_rows_one() {
    let lubricant = oil(ETA, 0.0);
    let (one, many) = (pad(1, &lubricant, [1.0, 0.0], false), pad(5, &lubricant, [1.0, 0.0], false));
    assert!((one.load / many.load - 1.0).abs() < 1e-9);
    assert!((one.flow.inflow / many.flow.inflow - 1.0).abs() < 1e-9);
}

#[test]
fn viscosity_that_grows_with_pressure() {
    // The reduced pressure is the pressure of the fluid that does not thicken.
    let (alpha, speeds) = (2e-9, [1.0, 0.0]);
    let thin = pad(1, &oil(ETA, 0.0), speeds, false);
    let thick = pad(1, &oil(ETA, alpha), speeds, false);
    for (q, p) in thin.pressure.iter().zip(&thick.pressure) {
        let exact = -(-alpha * q).ln_1p() / alpha;
        assert!((p / exact - 1.0).abs() < 1e-6, "{p} {exact}");
    }
}

#[test]
fn films_on_nodes_and_of_functions_agree_where_edges_are_faces() {
    let slider = PocketSlider::giacopini();
    let grid = Grid::from_edges(500, 1, [0.0, PocketSlider::LENGTH], [0.0, 1.0]).unwrap();
    let values: Vec<f64> = grid.nodes().map(|(x, _)| slider.film(x)).collect();
    let film = FilmThickness::from_nodes(grid, &values).unwrap();
    let found = solved(&slider.problem(&film, &oil(ETA, 0.0)));
    assert!((found.load / solved_slider(&slider, 500).load - 1.0).abs() < 1e-9);
}

#[test]
fn nothing_flows_without_entrainment() {
    let grid = Grid::from_edges(10, 4, [0.0, 1e-2], [0.0, 1e-2]).unwrap();
    let film = FilmThickness::from_nodes(grid, &[1e-6; 40]).unwrap();
    let lubricant = oil(ETA, 0.0);
    let solution = solved(&GivenFilm::new(&film, &lubricant, [1.0, -1.0]).with_ambient_pressure(1e5));
    assert_eq!(solution.report.status, Status::Converged);
    assert_eq!((solution.flow.inflow, solution.flow.imbalance), (0.0, 0.0));
    assert!((solution.load - 10.0).abs() < 1e-9, "{}", solution.load);
    // eta (u_1 - u_0) / h over the area.
    assert!((solution.friction[0] + 2.0).abs() < 1e-9, "{:?}", solution.friction);
}

#[test]
fn a_solve_that_is_interrupted_is_an_error() {
    let (grid, oil) = (Grid::from_edges(40, 20, [0.0, 1e-2], [0.0, 1e-2]).unwrap(), oil(0.01, 0.0));
    let film = FilmThickness::from_function(grid, |x, _| 2e-6 - 1e-4 * x).unwrap();
    for speeds in [[1.0, 0.0], [-1.0, 0.0]] {
        let pad = GivenFilm::new(&film, &oil, speeds);
        let asked = Cell::new(0);
        let interrupted = pad.solve_unless(|| {
            asked.set(asked.get() + 1);
            asked.get() == 3
        });
        assert_eq!(interrupted, Err(ReynoldsError::Interrupted));
        assert_eq!(asked.get(), 3);
        assert_eq!(pad.solve_unless(|| false), pad.solve());
    }
}

#[test]
fn bad_input_names_field_and_value() {
    let grid = Grid::from_edges(10, 1, [0.0, 1e-2], [0.0, 1.0]).unwrap();
    let film = FilmThickness::from_nodes(grid, &[1e-6; 10]).unwrap();
    let lubricant = oil(ETA, 0.0);
    let good = GivenFilm::new(&film, &lubricant, [1.0, 0.0]).with_ambient_pressure(1e5);
    let error = |problem: GivenFilm<'_>| problem.solve().unwrap_err().to_string();
    assert!(error(good.with_speeds([0.0, f64::NAN])).starts_with("speeds.1 = NaN"));
    assert!(error(good.with_ambient_pressure(f64::INFINITY)).starts_with("edge_pressures.0 = inf"));
    assert!(error(good.with_cavitation_pressure(2e5)).starts_with("edge_pressures.0 = 100000"));
    let of = |film: &[f64]| FilmThickness::from_nodes(grid, film).unwrap_err().to_string();
    assert!(of(&[1e-6; 9]).contains("film has 9 values, expected 10"));
    assert!(of(&[0.0; 10]).starts_with("film[0] = 0"));
    assert!(of(&[f64::INFINITY; 10]).starts_with("film[0] = inf"));
}
