//! Pads in equilibrium with a load and films that repeat along the motion, beside closed forms; journals that cavitate below ambient.

use std::f64::consts::PI;

use stribeck::Grid;
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::{Feed, FilmThickness, GivenFilm, JournalBearing, SideEdges};
use stribeck::sim::{BearingNumbers, RigidBearing};

const ETA: f64 = 0.02;
const LENGTH: f64 = 0.02;
const SPEED: f64 = 2.0;

fn oil() -> Lubricant {
    Lubricant::new(Barus::new(ETA, 0.0).unwrap(), Incompressible)
}

fn solve_with(table: &str, lubricant: &str) -> Result<BearingNumbers, String> {
    let length = if table.contains("length") { String::new() } else { format!("length = {LENGTH}\n") };
    let scene = format!("[given_film]\n{length}speed = {SPEED}\n{table}\n[lubricant]\n{lubricant}\n");
    let bearing = RigidBearing::from_toml(&scene).map_err(|error| error.to_string())?;
    let solution = bearing.solve(|| false).map_err(|error| error.to_string())?;
    solution.film.report.require_converged().map_err(|error| error.to_string())?;
    Ok(solution.numbers)
}

fn solve(table: &str) -> Result<BearingNumbers, String> {
    solve_with(table, &format!("eta0 = {ETA}"))
}

/// Load of a wide inclined pad per metre and its center from the inlet, for the film at the outlet and the film ratio less one
/// (Cameron, Basic Lubrication Theory).
fn inclined(outlet: f64, k: f64) -> [f64; 2] {
    let log = (1.0 + k).ln();
    let load = 6.0 * ETA * SPEED * (LENGTH / outlet).powi(2) * (log - 2.0 * k / (2.0 + k)) / (k * k);
    let from_outlet = (k * (6.0 + k) - 2.0 * (3.0 + 2.0 * k) * log) / (2.0 * k * ((2.0 + k) * log - 2.0 * k));
    [load, (1.0 - from_outlet) * LENGTH]
}

#[test]
fn pads_under_a_load_have_the_films_of_closed_forms() {
    for (outlet, k) in [(10e-6, 1.0), (20e-6, 1.19), (25e-6, 0.2), (15e-6, 5.0)] {
        let [load, center] = inclined(outlet, k);
        let fixed = solve(&format!("kind = \"pad\"\nload = \"{load} N/m\"\ntaper = {}", k * outlet)).unwrap();
        assert!((fixed.load / load - 1.0).abs() < 1e-5, "{fixed:?}");
        assert!((fixed.outlet_film.unwrap() / outlet - 1.0).abs() < 2e-4, "{outlet} {k}: {fixed:?}");
        assert!((fixed.pressure_center.unwrap() / center - 1.0).abs() < 1e-3, "{center}: {fixed:?}");
        let tilting = solve(&format!("kind = \"pad\"\nload = \"{load} N/m\"\npivot = {center}")).unwrap();
        let ratio = tilting.inlet_film.unwrap() / tilting.outlet_film.unwrap();
        assert!((tilting.load / load - 1.0).abs() < 1e-5, "{tilting:?}");
        assert!(((ratio - 1.0) / k - 1.0).abs() < 0.01, "{outlet} {k}: {tilting:?}");
    }
    // Rayleigh's step: half of the pressure at the step over the length.
    let (inlet, outlet, step) = (18e-6_f64, 10e-6_f64, 14e-3);
    let peak =
        6.0 * ETA * SPEED * (inlet - outlet) / (inlet.powi(3) / step + outlet.powi(3) / (LENGTH - step));
    let stepped =
        format!("kind = \"step\"\nstep = {step}\nload = {}\ntaper = {}", 0.5 * peak * LENGTH, inlet - outlet);
    let stepped = solve(&stepped).unwrap();
    assert!((stepped.outlet_film.unwrap() / outlet - 1.0).abs() < 1e-4, "{stepped:?}");
}

#[test]
fn pads_of_finite_width_carry_their_load_in_all_parts_of_the_model() {
    let pad = "kind = \"pad\"\nwidth = \"20 mm\"\nnx = 60\nny = 24\n";
    let oil = "grade = \"ISO VG 46\"\nviscosity_index = 98";
    let heat = "supply_temperature = \"40 degC\"\n";
    let rough = "[given_film.roughness]\nrq = [\"0.3 um\", \"0.4 um\"]\nasperity_number = 0.05\nrq_over_radius = 0.01\n\
                 equivalent_modulus = \"230 GPa\"\nboundary_friction = 0.1\n";
    for table in [
        format!("{pad}load = 400\npivot = \"11.8 mm\"\n{heat}"),
        format!("{pad}load = 400\ntaper = \"10 um\"\n{heat}{rough}"),
        format!("{pad}load = 3000\ntaper = \"2 um\"\n{rough}"),
        format!(
            "{pad}load = 1.5\ntaper = 0\nperiodic = true\ncavitation_pressure = \"-1 bar\"\ndimple_diameter = \"5 mm\"\n\
                 dimple_depth = \"4 um\"\ndimple_density = 0.3\nedge_pressures = [0, 0, 0, 0]\n"
        ),
        format!(
            "{pad}load = 500\ntaper = \"10 um\"\nedge_pressures = [\"1 bar\", \"1 bar\", \"1 bar\", \"1 bar\"]\n"
        ),
    ] {
        let load: f64 =
            table.split("load = ").nth(1).and_then(|rest| rest.lines().next()).unwrap().parse().unwrap();
        let numbers = solve_with(&table, oil).unwrap_or_else(|error| panic!("{table}: {error}"));
        assert!((numbers.load / load - 1.0).abs() < 1e-5, "{table}: {numbers:?}");
        assert!(numbers.contact_share.is_some() == table.contains("roughness"), "{numbers:?}");
        if table.contains("pivot") {
            assert!((numbers.pressure_center.unwrap() - 11.8e-3).abs() < 1e-6, "{numbers:?}");
        }
    }
}

#[test]
fn loads_that_no_film_carries_are_refused_with_a_remedy() {
    for (table, parts) in [
        ("kind = \"pad\"\nload = 100", ["taper", "pivot"]),
        ("kind = \"pad\"\nload = 100\ntaper = 1e-5\noutlet_film = 1e-5", ["outlet_film", "leave it out"]),
        ("kind = \"pad\"\nload = 100\ntaper = 1e-5\npivot = 0.011", ["pivot", "only one"]),
        ("kind = \"pad\"\npivot = 0.011", ["load", "missing"]),
        ("kind = \"step\"\nstep = 0.01\nload = 100\npivot = 0.011", ["pivot", "kind = \"pad\" has one"]),
        ("kind = \"pad\"\nload = 100\npivot = 0.03", ["given_film.pivot = 0.03", "below the length"]),
        ("kind = \"pad\"\nload = 100\npivot = 0.008", ["given_film.pivot", "8.0000 mm behind the inlet"]),
        ("kind = \"pad\"\nload = -100\ntaper = 1e-5", ["given_film.load = -100", "> 0"]),
        ("kind = \"pad\"\nload = 100\ntaper = 0", ["parallel smooth", "taper above 0"]),
        ("kind = \"pad\"\nload = 1e6\ntaper = 1e-3", ["a smaller load", "carries"]),
        (
            "kind = \"pad\"\nload = 1\ntaper = 1e-5\nedge_pressures = [1e5, 1e5, 1e5, 1e5]",
            ["alone carry", "lower pressures"],
        ),
        ("kind = \"pad\"\ninlet_film = 1e-5\noutlet_film = 1e-5\nperiodic = true", ["periodic", "width"]),
        ("kind = \"pad\"\ninlet_film = 1e-5", ["outlet_film", "`load`"]),
        (
            "kind = \"pad\"\nlength = 1e-3\ninlet_film = 2e-3\noutlet_film = 1e-3",
            ["given_film.inlet_film = 0.002", "below the length of the pad"],
        ),
    ] {
        let error = solve(table).unwrap_err();
        assert!(parts.iter().all(|part| error.contains(part)), "{table}: {error}");
    }
}

/// Films that repeat five times between open ends have, in the middle, the pressure of the periodic film.
#[test]
fn periodic_film_is_the_middle_of_many_periods() {
    let (period, width, [nx, ny]) = (2e-3, 2e-3, [40, 20]);
    let film = |x: f64, y: f64| {
        let x = x.rem_euclid(period) - 0.55 * period;
        let depth = 1.0 - (x * x + (y - 0.5 * width).powi(2)) / 0.5e-6;
        4e-6 + 1e-6 * (2.0 * PI * x / period).sin() + 3e-6 * depth.max(0.0)
    };
    let oil = oil();
    // Film fractions of cavitated oil are carried on from period to period: their deviations decay slowly.
    for (speeds, cavitation, deviation) in
        [([1.0, 0.0], -1e5, 0.02), ([-1.0, 0.0], -1e5, 0.02), ([1.0, 1.0], -1e9, 2e-5)]
    {
        let solved = |count: usize, is_periodic: bool| {
            let x = [0.0, period * count as f64];
            let grid = Grid::from_edges(nx * count, ny, x, [0.0, width]).unwrap();
            let film = FilmThickness::from_function(grid, film).unwrap();
            let problem = GivenFilm::new(&film, &oil, speeds)
                .with_cavitation_pressure(cavitation)
                .with_periodic(is_periodic);
            let solution = problem.solve().unwrap();
            solution.report.require_converged().unwrap();
            solution
        };
        let (one, two, many) = (solved(1, true), solved(2, true), solved(9, false));
        let largest = one.pressure.iter().fold(0.0_f64, |most, p| most.max(p.abs()));
        for (k, pressure) in one.pressure.iter().enumerate() {
            let (i, j) = (k % nx, k / nx);
            let repeated = two.pressure[j * 2 * nx + nx + i];
            let middle = many.pressure[j * 9 * nx + 4 * nx + i];
            assert!((pressure - repeated).abs() < 1e-8 * largest, "{speeds:?}: {pressure} {repeated}");
            assert!((pressure - middle).abs() < deviation * largest, "{speeds:?}: {pressure} {middle}");
        }
        assert!((two.load / one.load - 2.0).abs() < 1e-7, "{} {}", one.load, two.load);
        assert!((two.friction[0] / one.friction[0] - 2.0).abs() < 1e-7);
        let [inlet, outlet, south, north] = one.edge_flows;
        assert!((inlet + outlet).abs() < 1e-12 * outlet.abs() && (south + north).abs() < 1e-7 * outlet.abs());
        // The profile ends with the pressure with which it begins.
        let ends = [0.0, period].map(|x| one.pressure_at(x, ny / 2).unwrap());
        assert!((ends[0] - ends[1]).abs() < 1e-9 * largest, "{ends:?}");
    }
}

#[test]
fn periodic_film_that_nothing_feeds_is_refused() {
    let oil = oil();
    let grid = Grid::from_edges(12, 8, [0.0, 1e-2], [0.0, 1e-2]).unwrap();
    let film = FilmThickness::from_function(grid, |x, _| 1e-5 + 1e-4 * x).unwrap();
    let closed = GivenFilm::new(&film, &oil, [1.0, 0.0]).with_sides(SideEdges::Closed).with_periodic(true);
    assert!(closed.solve().unwrap_err().to_string().contains("runs dry"));
    let hole = [Feed::hole([5e-3, 5e-3], 2e-3, 1e5)];
    closed.with_feeds(&hole).solve().unwrap().report.require_converged().unwrap();
    let row = Grid::from_edges(12, 1, [0.0, 1e-2], [0.0, 1.0]).unwrap();
    let row = FilmThickness::from_function(row, |_, _| 1e-5).unwrap();
    let row = GivenFilm::new(&row, &oil, [1.0, 0.0]).with_periodic(true);
    assert!(row.solve().unwrap_err().to_string().contains("3 x 3"));
}

/// Far below ambient nothing cavitates: twice the load across the line of centers of the half film, none along it (Ocvirk).
#[test]
fn short_journal_without_cavitation_has_the_load_of_the_full_film() {
    let oil = oil();
    let [radius, width, clearance, omega, eccentricity] = [0.05, 0.1 / 16.0, 5e-5, 100.0, 0.5_f64];
    let bearing = JournalBearing::new([radius, width, clearance], omega, &oil).with_cells([120, 24]);
    let full = bearing.with_cavitation_pressure(-1e9).solve(eccentricity).unwrap();
    let exact = ETA * omega * radius * width.powi(3) / (2.0 * clearance * clearance) * PI * eccentricity
        / (1.0 - eccentricity * eccentricity).powf(1.5);
    assert!((full.load / exact - 1.0).abs() < 0.01, "{} {exact}", full.load);
    assert!((full.attitude - 0.5 * PI).abs() < 1e-3, "{}", full.attitude);
    let half = bearing.solve(eccentricity).unwrap();
    assert!(half.load < 0.8 * full.load);
    assert!(
        bearing
            .with_cavitation_pressure(1e5)
            .solve(0.5)
            .unwrap_err()
            .to_string()
            .contains("cavitation_pressure")
    );
}
