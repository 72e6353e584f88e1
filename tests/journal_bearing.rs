//! Journal bearings beside Butenschoen's table, the short bearing of Ocvirk and balances of force and mass; pads beside
//! closed forms; scene files of rigid bearings.

use std::f64::consts::PI;

use stribeck::Grid;
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::{FilmThickness, GivenFilm, JournalBearing, JournalSolution};
use stribeck::sim::RigidBearing;

/// Radius \[m\], clearance \[m\], viscosity \[Pa s\] and angular speed \[rad/s\] of the bearings.
const RADIUS: f64 = 0.05;
const CLEARANCE: f64 = 5e-5;
const ETA: f64 = 0.01;
const OMEGA: f64 = 100.0;

fn oil() -> Lubricant {
    Lubricant::new(Barus::new(ETA, 0.0).unwrap(), Incompressible)
}

fn solved(width_over_diameter: f64, eccentricity: f64, cells: [usize; 2]) -> JournalSolution {
    let oil = oil();
    let size = [RADIUS, 2.0 * RADIUS * width_over_diameter, CLEARANCE];
    let solution = JournalBearing::new(size, OMEGA, &oil).with_cells(cells).solve(eccentricity).unwrap();
    solution.film.report.require_converged().unwrap();
    solution
}

/// Eccentricity, width over diameter, Sommerfeld number, attitude angle in degrees, side flow over `R^3 psi omega`:
/// Butenschoen (1976), Das hydrodynamische, zylindrische Gleitlager endlicher Breite unter instationaerer Belastung, thesis,
/// Karlsruhe.
const TABLE: [[f64; 5]; 12] = [
    [0.1, 1.0, 0.1196, 79.41, 0.1603],
    [0.1, 0.25, 0.0098, 82.481, 0.0492],
    [0.3, 0.5, 0.1304, 68.493, 0.2816],
    [0.5, 1.0, 0.8903, 56.705, 0.7852],
    [0.5, 0.5, 0.3124, 54.993, 0.4694],
    [0.5, 0.125, 0.0231, 53.784, 0.1245],
    [0.7, 1.0, 2.0432, 43.859, 1.0888],
    [0.7, 0.25, 0.2708, 39.326, 0.3446],
    [0.9, 1.0, 8.4352, 26.482, 1.3898],
    [0.9, 0.25, 2.1595, 21.79, 0.4436],
    [0.96, 0.5, 17.7934, 15.66, 0.9084],
    [0.98, 1.0, 51.4774, 12.903, 1.5124],
];

#[test]
fn journal_bearing_has_the_numbers_of_the_table() {
    for [eccentricity, ratio, sommerfeld, attitude, side_flow] in TABLE {
        let found = solved(ratio, eccentricity, [240, 40]);
        let flow = found.film.side_flow / (RADIUS.powi(2) * CLEARANCE * OMEGA);
        let errors = [
            found.sommerfeld / sommerfeld - 1.0,
            found.attitude.to_degrees() - attitude,
            flow / side_flow - 1.0,
        ];
        // The table has Reynolds' condition and two to four digits.
        assert!(
            errors[0].abs() < 0.012 && errors[1].abs() < 0.05 && errors[2].abs() < 0.006,
            "{eccentricity} {ratio}: {errors:?}"
        );
    }
}

/// A short bearing has a parabola of pressure across its width; Ocvirk leaves out the pressure of the diverging half.
#[test]
fn short_bearing_approaches_the_load_and_attitude_of_ocvirk() {
    for eccentricity in [0.2_f64, 0.5, 0.8] {
        let rest = 1.0 - eccentricity * eccentricity;
        let load = |width: f64| {
            ETA * OMEGA * RADIUS * width.powi(3) / (4.0 * CLEARANCE * CLEARANCE) * eccentricity
                / (rest * rest)
                * (PI * PI * rest + 16.0 * eccentricity * eccentricity).sqrt()
        };
        let attitude = (PI * rest.sqrt() / (4.0 * eccentricity)).atan();
        let deviations = [0.125, 0.0625].map(|ratio| {
            let found = solved(ratio, eccentricity, [240, 24]);
            [found.load / load(2.0 * RADIUS * ratio) - 1.0, found.attitude - attitude]
        });
        let [wide, narrow] = deviations;
        assert!(narrow[0].abs() < 0.01 && narrow[1].abs() < 0.02, "{eccentricity}: {deviations:?}");
        assert!(narrow[0].abs() < wide[0].abs() + 0.002, "{eccentricity}: {deviations:?}");
    }
}

/// The moments on journal and bush differ by that of the load on the eccentric axis.
#[test]
fn moments_of_friction_and_load_are_in_equilibrium() {
    for eccentricity in [0.3, 0.8] {
        let found = solved(0.5, eccentricity, [240, 40]);
        let [journal, bush] = found.film.friction;
        let moment = (-journal - bush) * RADIUS;
        let by_load = eccentricity * CLEARANCE * found.load * found.attitude.sin();
        assert!((moment / by_load - 1.0).abs() < 0.01, "{eccentricity}: {moment} {by_load}");
        assert!((found.film.power_loss / (-journal * OMEGA * RADIUS) - 1.0).abs() < 1e-12);
        assert!(found.force[0] > 0.0 && found.force[1] < 0.0, "{:?}", found.force);
    }
}

/// Without eccentricity the friction is that of Petroff.
#[test]
fn centered_journal_has_the_friction_of_petroff() {
    let found = solved(1.0, 0.0, [60, 10]);
    let petroff = ETA * OMEGA * RADIUS / CLEARANCE * 2.0 * PI * RADIUS * 2.0 * RADIUS;
    assert!((-found.film.friction[0] / petroff - 1.0).abs() < 1e-9);
    assert!(found.load < 1e-6 * petroff && found.film.side_flow.abs() < 1e-15);
}

#[test]
fn side_flow_is_the_difference_of_the_flows_along_the_film() {
    let found = solved(0.5, 0.6, [120, 20]);
    let along = found.film.flow.inflow - found.film.flow.outflow;
    assert!(along.abs() < 1e-9 * found.film.flow.inflow && found.film.side_flow > 0.0);
    // Pads leak through both sides; a pad of one row has none.
    let grid = Grid::from_edges(40, 1, [0.0, 1e-2], [0.0, 1.0]).unwrap();
    let film = FilmThickness::from_function(grid, |x, _| 2e-6 - 1e-4 * x).unwrap();
    let oil = oil();
    assert!(GivenFilm::new(&film, &oil, [1.0, 0.0]).solve().unwrap().side_flow.abs() < 1e-20);
}

#[test]
fn equilibrium_has_the_eccentricity_of_its_load() {
    let oil = oil();
    let bearing = JournalBearing::new([RADIUS, RADIUS, CLEARANCE], OMEGA, &oil).with_cells([90, 16]);
    for eccentricity in [0.01, 0.3, 0.7, 0.95] {
        let load = bearing.solve(eccentricity).unwrap().load;
        let found = bearing.equilibrium(load).unwrap();
        assert!((found.eccentricity - eccentricity).abs() < 1e-5, "{eccentricity}: {}", found.eccentricity);
        assert!((found.load / load - 1.0).abs() < 1e-6);
    }
    let error = bearing.equilibrium(1e9).unwrap_err().to_string();
    assert!(error.contains("load = 1000000000 N") && error.contains("0.99"), "{error}");
    for (bearing, eccentricity, part) in [
        (bearing, 1.0, "eccentricity = 1"),
        (bearing, -0.1, "eccentricity = -0.1"),
        (JournalBearing::new([RADIUS, 0.0, CLEARANCE], OMEGA, &oil), 0.5, "width = 0"),
        (JournalBearing::new([RADIUS, RADIUS, 0.01], OMEGA, &oil), 0.5, "clearance = 0.01"),
        (JournalBearing::new([RADIUS, RADIUS, CLEARANCE], f64::NAN, &oil), 0.5, "angular_speed = NaN"),
    ] {
        let error = bearing.solve(eccentricity).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

fn scene(table: &str) -> String {
    format!(
        "[given_film]\n{table}[lubricant]\ndensity_a = 0.0\n[lubricant.viscosity]\nlaw = \"barus\"\neta0 = \"10 mPa s\"\nalpha = 0.0\n"
    )
}

const JOURNAL: &str =
    "kind = \"journal\"\ndiameter = \"100 mm\"\nwidth = \"50 mm\"\nclearance = \"50 um\"\nnx = 90\nny = 16\n";

#[test]
fn bearings_of_scene_files_have_closed_forms() {
    let solve =
        |table: &str| RigidBearing::from_toml(&scene(table)).unwrap().solve(|| false).unwrap().numbers;
    // A wide pad of films 2 : 1: load and friction on the moving plane (Hamrock, Fundamentals of fluid film lubrication).
    let pad = solve(
        "kind = \"pad\"\nlength = \"10 mm\"\ninlet_film = \"20 um\"\noutlet_film = \"10 um\"\nspeed = 1.0\n",
    );
    let load = 6.0 * ETA * 1e-4 / 1e-10 * (2.0_f64.ln() - 2.0 / 3.0);
    let friction = ETA * 1e-2 / 1e-5 * (4.0 * 2.0_f64.ln() - 2.0);
    assert!(
        (pad.load / load - 1.0).abs() < 1e-4 && (pad.friction_moving / friction - 1.0).abs() < 1e-4,
        "{pad:?}"
    );
    assert!((pad.power_loss - pad.friction_moving).abs() < 1e-9 * pad.power_loss);
    // A Rayleigh step: pressure at the step over half the length.
    let step = solve(
        "kind = \"step\"\nlength = \"10 mm\"\nstep = \"7 mm\"\ninlet_film = \"18 um\"\noutlet_film = \"10 um\"\nspeed = 1.0\n",
    );
    let peak = 6.0 * ETA * 8e-6 / (1.8e-5_f64.powi(3) / 7e-3 + 1e-5_f64.powi(3) / 3e-3);
    assert!((step.load / (0.5 * peak * 1e-2) - 1.0).abs() < 1e-4, "{step:?} {peak}");
    let journal = solve(&format!("{JOURNAL}speed = \"600 rpm on 100 mm\"\neccentricity = 0.5\n"));
    let oil = oil();
    let same =
        JournalBearing::new([0.05, 0.05, 5e-5], 20.0 * PI, &oil).with_cells([90, 16]).solve(0.5).unwrap();
    assert!((journal.load / same.load - 1.0).abs() < 1e-9, "{journal:?} {}", same.load);
    // The diameter of the journal is that of a rate alone.
    let rate = solve(&format!("{JOURNAL}speed = \"600 rpm\"\neccentricity = 0.5\n"));
    assert!((rate.load / journal.load - 1.0).abs() < 1e-12, "{rate:?}");
    let loaded = solve(&format!("{JOURNAL}speed = \"600 rpm on 100 mm\"\nload = \"{} N\"\n", journal.load));
    assert!((loaded.eccentricity.unwrap() - 0.5).abs() < 1e-5);
}

#[test]
fn wrong_bearings_are_refused_with_a_remedy() {
    for (table, parts) in [
        (format!("{JOURNAL}speed = 1.0\n"), ["load", "missing"]),
        (format!("{JOURNAL}speed = 1.0\nload = 10.0\neccentricity = 0.5\n"), ["load", "only one"]),
        (format!("{JOURNAL}eccentricity = 0.5\n"), ["speed", "missing"]),
        // A pad has no diameter for a rate of rotation.
        (
            "kind = \"pad\"\nlength = 0.1\nspeed = \"600 rpm\"\ninlet_film = 2e-5\noutlet_film = 1e-5\n"
                .to_owned(),
            ["given_film.speed", "rpm on 40 mm"],
        ),
        (format!("{JOURNAL}speed = -1.0\nload = 10.0\n"), ["given_film.speed = -1", "> 0"]),
        (format!("{JOURNAL}speed = 1.0\nload = \"-3 N\"\n"), ["given_film.load = -3", "> 0"]),
        (
            format!("{JOURNAL}speed = 1.0\neccentricity = \"120 %\"\n"),
            ["given_film.eccentricity = 1.2", "below 1"],
        ),
        (format!("{JOURNAL}speed = 1.0\nload = 10.0\nlength = 0.1\n"), ["`length`", "journal"]),
        (JOURNAL.replace("50 um", "50 mm") + "speed = 1.0\nload = 10.0\n", ["given_film.clearance", "tenth"]),
        ("kind = \"bush\"\n".to_owned(), ["bush", "journal"]),
        (
            "kind = \"pad\"\nlength = 0.1\nspeed = 1.0\noutlet_film = 1e-5\n".to_owned(),
            ["inlet_film", "missing"],
        ),
        (
            "kind = \"step\"\nlength = 0.1\nspeed = 1.0\ninlet_film = 2e-5\noutlet_film = 1e-5\nstep = 0.2\n"
                .to_owned(),
            ["given_film.step = 0.2", "below the length"],
        ),
        (
            "kind = \"pad\"\nlength = 0.1\nspeed = 1.0\ninlet_film = 0.0\noutlet_film = 1e-5\n".to_owned(),
            ["given_film.inlet_film = 0", "> 0"],
        ),
    ] {
        let solved = RigidBearing::from_toml(&scene(&table)).and_then(|bearing| bearing.solve(|| false));
        let error = solved.map(|solution| solution.numbers).unwrap_err().to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
}
