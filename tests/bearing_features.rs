//! Rigid bearings beside hand formulas: pressures of the edges, feeds, grooves, heat balance, dimples and heights.
#![expect(clippy::panic, reason = "tests")]

use std::f64::consts::{PI, TAU};

use stribeck::Grid;
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::{Feed, FilmThickness, GivenFilm, Grooves, JournalBearing, SideEdges};
use stribeck::sim::{BearingNumbers, RigidBearing, SceneFile};

const ETA: f64 = 0.01;

fn oil() -> Lubricant {
    Lubricant::new(Barus::new(ETA, 0.0).unwrap(), Incompressible)
}

/// `q = h^3 (p_1 - p_2)/(12 eta L) + u h` per width, in either direction of motion and along both axes.
#[test]
fn slot_between_two_edge_pressures_has_couette_and_poiseuille_flow() {
    let grid = Grid::from_edges(24, 18, [0.0, 0.02], [0.0, 0.01]).unwrap();
    let film = FilmThickness::from_function(grid, |_, _| 2e-5).unwrap();
    let oil = oil();
    let pressure_flow = |drop: f64, length: f64| 2e-5_f64.powi(3) * drop / (12.0 * ETA * length);
    for speeds in [[0.0, 0.0], [0.3, -0.3], [0.4, 0.0], [-0.4, 0.0]] {
        let problem = GivenFilm::new(&film, &oil, speeds)
            .with_edge_pressures([3e5, 1e5, 0.0, 0.0])
            .with_sides(SideEdges::Closed);
        let solution = problem.solve().unwrap();
        solution.report.require_converged().unwrap();
        let exact = 0.01 * (pressure_flow(2e5, 0.02) + 0.5 * (speeds[0] + speeds[1]) * 2e-5);
        let [west, east, south, north] = solution.edge_flows;
        assert!((east / exact - 1.0).abs() < 1e-8 && (west + east).abs() < 1e-9 * exact.abs(), "{speeds:?}");
        assert_eq!((south, north), (0.0, 0.0));
        assert!((solution.load / (2e5 * 2e-4) - 1.0).abs() < 1e-9, "{speeds:?}: {}", solution.load);
        // The pressure force h/2 (p_2 - p_1) and the shear eta u/h of Couette flow.
        let shear = ETA * (speeds[1] - speeds[0]) / 2e-5 * 2e-4;
        let by_pressure = 0.5 * 2e-5 * -2e5 * 0.01;
        for (force, exact) in solution.friction.iter().zip([shear - by_pressure, -shear - by_pressure]) {
            assert!((force / exact - 1.0).abs() < 1e-6, "{speeds:?}: {force} {exact}");
        }
    }
    // Across the motion: two lengths differ by the slot between them, without the flow near the ends.
    let [long, short] = [(0.4, 400), (0.2, 200)].map(|(length, cells)| {
        let grid = Grid::from_edges(cells, 10, [0.0, length], [0.0, 0.01]).unwrap();
        let film = FilmThickness::from_function(grid, |_, _| 2e-5).unwrap();
        let problem = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_edge_pressures([1.5e5, 1.5e5, 2e5, 1e5]);
        let [_, _, south, north] = problem.solve().unwrap().edge_flows;
        assert!((south / north + 1.0).abs() < 1e-6, "{south} {north}");
        north
    });
    let exact = 0.2 * pressure_flow(1e5, 0.01);
    assert!(((long - short) / exact - 1.0).abs() < 1e-6, "{long} {short} {exact}");
}

/// Of two feeds the one of higher pressure supplies the other and the edges: `h^3 dp/(12 eta L)` between them.
#[test]
fn feeds_have_the_flows_of_slots_between_them() {
    let grid = Grid::from_edges(90, 1, [0.0, 0.09], [0.0, 1.0]).unwrap();
    let film = FilmThickness::from_function(grid, |_, _| 1e-5).unwrap();
    let oil = oil();
    let feeds = [Feed::new([0.02, 0.03], [0.0, 1.0], 1e6), Feed::new([0.06, 0.07], [0.0, 1.0], 2e5)];
    let solution = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_feeds(&feeds).solve().unwrap();
    let slot = |drop: f64, length: f64| 1e-15 * drop / (12.0 * ETA * length);
    let exact = [slot(1e6, 0.02) + slot(8e5, 0.03), slot(2e5, 0.02) - slot(8e5, 0.03)];
    for (flow, exact) in solution.feed_flows.iter().zip(exact) {
        assert!((flow / exact - 1.0).abs() < 1e-9, "{flow} {exact}");
    }
    // The same with motion to the left is its mirror image with motion to the right.
    let mirror = [Feed::new([0.06, 0.07], [0.0, 1.0], 1e6), Feed::new([0.02, 0.03], [0.0, 1.0], 2e5)];
    let [left, right] = [(-0.2, &feeds), (0.2, &mirror)]
        .map(|(speed, feeds)| GivenFilm::new(&film, &oil, [speed, 0.0]).with_feeds(feeds).solve().unwrap());
    for (one, other) in left.feed_flows.iter().zip(&right.feed_flows) {
        assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
    }
    assert!((left.edge_flows[0] / right.edge_flows[1] - 1.0).abs() < 1e-9);
    let absent = [Feed::new([0.0201, 0.0203], [0.0, 1.0], 1e6)];
    let error = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_feeds(&absent).solve().unwrap_err().to_string();
    assert!(error.contains("feeds.0") && error.contains("more cells"), "{error}");
    let error = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_edge_pressures([0.0, -1.0, 0.0, 0.0]).solve();
    assert!(error.unwrap_err().to_string().starts_with("edge_pressures.1 = -1"));
}

/// A narrow groove without pressure at the widest gap leaves the film as it is without groove.
#[test]
fn groove_at_the_widest_gap_without_pressure_changes_nothing() {
    let oil = oil();
    let bearing = JournalBearing::new([0.05, 0.05, 5e-5], 100.0, &oil).with_cells([180, 24]);
    let plain = bearing.solve(0.6).unwrap();
    let angles = [plain.attitude + PI];
    let grooved = bearing.with_grooves(Some(Grooves::new(&angles, [1e-6, 0.05], 0.0))).solve(0.6).unwrap();
    assert!((grooved.load / plain.load - 1.0).abs() < 1e-4, "{} {}", grooved.load, plain.load);
    assert!((grooved.attitude - plain.attitude).abs() < 1e-3);
    assert!((grooved.film.side_flow / plain.film.side_flow - 1.0).abs() < 1e-3);
}

/// A concentric journal at rest with a groove: all oil leaves through the lands, and more than straight through those beside the groove,
/// `2 w h^3 p/(12 eta l)`. A groove as long as the bush under pressure is refused.
#[test]
fn groove_of_a_journal_leaks_through_its_lands() {
    let oil = oil();
    let bearing = JournalBearing::new([0.05, 0.05, 5e-5], 1e-6, &oil).with_cells([180, 24]);
    let angles = [PI];
    let flow = |length: f64| {
        let grooves = Grooves::new(&angles, [0.01, length], 2e5);
        let solution = bearing.with_grooves(Some(grooves)).solve(0.0).unwrap();
        assert!((solution.groove_flow / solution.film.side_flow - 1.0).abs() < 1e-6);
        solution.groove_flow
    };
    let straight = 2.0 * 0.01 * 1.25e-13 * 2e5 / (12.0 * ETA * 0.005);
    let [short, long] = [flow(0.03), flow(0.04)];
    assert!(long > 1.5 * straight && long < 4.0 * straight && short < long, "{short} {long} {straight}");
    let whole = bearing.with_grooves(Some(Grooves::new(&angles, [0.01, 0.05], 2e5))).solve(0.0);
    assert!(whole.unwrap_err().to_string().contains("groove_length = 0.05"));
}

/// The groove supplies all that leaves through the sides; the numbers are those of a mesh of four times the nodes.
#[test]
fn grooved_journal_converges_and_its_groove_feeds_both_sides() {
    let oil = oil();
    let angles = [PI, 0.5 * PI];
    let grooves = Grooves::new(&angles, [0.01, 0.04], 2e5);
    let solve = |cells| {
        let bearing = JournalBearing::new([0.05, 0.05, 5e-5], 100.0, &oil).with_cells(cells);
        bearing.with_grooves(Some(grooves)).solve(0.6).unwrap()
    };
    let [coarse, fine] = [[90, 12], [180, 24]].map(solve);
    for solution in [&coarse, &fine] {
        solution.film.report.require_converged().unwrap();
        assert!((solution.groove_flow / solution.film.side_flow - 1.0).abs() < 1e-6);
    }
    assert!((coarse.load / fine.load - 1.0).abs() < 0.03, "{} {}", coarse.load, fine.load);
    assert!(
        (coarse.groove_flow / fine.groove_flow - 1.0).abs() < 0.02,
        "{} {}",
        coarse.groove_flow,
        fine.groove_flow
    );
    // Turned the other way it is the same bearing.
    let turned = JournalBearing::new([0.05, 0.05, 5e-5], -100.0, &oil).with_cells([90, 12]);
    let turned = turned.with_grooves(Some(grooves)).solve(0.6).unwrap();
    assert!((turned.load / coarse.load - 1.0).abs() < 1e-3, "{} {}", turned.load, coarse.load);
    let bearing = JournalBearing::new([0.05, 0.05, 5e-5], 100.0, &oil).with_cells([90, 12]);
    for (angles, width, pressure, part) in [
        (vec![], 0.01, 0.0, "groove_angles"),
        (vec![0.0, TAU], 0.01, 0.0, "apart"),
        (vec![0.0], 0.0, 0.0, "groove_width = 0"),
        (vec![0.0], 0.4, 0.0, "apart"),
        (vec![0.0], 0.01, -1.0, "supply_pressure = -1"),
    ] {
        let grooves = Grooves::new(&angles, [width, 0.04], pressure);
        let error = bearing.with_grooves(Some(grooves)).solve(0.5).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

const OIL: &str = "[lubricant]\ndensity_a = 0.0\n[lubricant.viscosity]\nlaw = \"barus\"\neta0 = \"10 mPa s\"\nalpha = 0.0\n";
const PAD: &str =
    "kind = \"pad\"\nlength = \"10 mm\"\ninlet_film = \"20 um\"\noutlet_film = \"10 um\"\nspeed = 1.0\n";

fn solved(table: &str, oil: &str) -> Result<BearingNumbers, String> {
    let bearing = RigidBearing::from_toml(&format!("[given_film]\n{table}{oil}"));
    let solved = bearing.and_then(|bearing| bearing.solve(|| false));
    solved.map(|solution| solution.numbers).map_err(|error| error.to_string())
}

/// With a constant viscosity the power is constant: `T = T_s + k P/(2 c Q)`. A wide pad of the films 2 : 1 has the friction
/// `eta u L/h_2 (4 ln 2 - 2)` and the flow `u h_2 K/(1 + K)` with `K = h_1/h_2`.
#[test]
fn heat_balance_of_constant_viscosity_has_a_closed_form() {
    let pad =
        solved(&format!("{PAD}supply_temperature = \"40 degC\"\nheat_share = \"80 %\"\n"), OIL).unwrap();
    let (power, flow) = (ETA * 1e-2 / 1e-5 * (4.0 * 2.0_f64.ln() - 2.0), 1e-5 * 2.0 / 3.0);
    let rise = 0.8 * power / (1.7e6 * flow);
    assert!((pad.outlet_temperature.unwrap() - 313.15 - rise).abs() < 1e-3 * rise, "{pad:?}");
    assert!((pad.temperature - 313.15 - 0.5 * rise).abs() < 2e-3);
    assert!((pad.carried_heat.unwrap() / (0.8 * power) - 1.0).abs() < 1e-3);
    assert!((-pad.edge_flows[0] / flow - 1.0).abs() < 1e-6 && (pad.edge_flows[1] / flow - 1.0).abs() < 1e-6);
}

/// An oil that thins: power and flow at the printed temperature give that temperature.
#[test]
#[ignore = "slow"]
fn heat_balance_of_a_journal_is_a_fixed_point() {
    let table = "kind = \"journal\"\ndiameter = \"50 mm\"\nwidth = \"25 mm\"\nclearance = \"25 um\"\nspeed = \"3000 rpm on 50 mm\"\n\
                 load = \"2 kN\"\nnx = 90\nny = 12\n";
    let oil = "[lubricant]\ngrade = \"ISO VG 32\"\nviscosity_index = 98\n";
    let groove = "groove_angles = [\"180 deg\"]\ngroove_width = \"4 mm\"\nsupply_pressure = \"1 bar\"\n";
    let hot = solved(&format!("{table}{groove}supply_temperature = \"40 degC\"\n"), oil).unwrap();
    let rise = hot.power_loss / (1.7e6 * hot.side_flow);
    assert!((hot.outlet_temperature.unwrap() - 313.15 - rise).abs() < 1e-6, "{hot:?}");
    assert!((hot.temperature - 313.15 - 0.5 * rise).abs() < 2e-3 && rise > 5.0, "{hot:?}");
    assert!((hot.groove_flow.unwrap() / hot.side_flow - 1.0).abs() < 1e-5);
    let thermal = format!("{oil}[thermal]\nbulk_temperature = {}\n", hot.temperature);
    let same = solved(&format!("{table}{groove}"), &thermal).unwrap();
    assert!((same.power_loss / hot.power_loss - 1.0).abs() < 1e-4 && same.supply_temperature.is_none());
}

/// The volume of paraboloids is half that of cylinders: dimples of the density `s` and the depth `d` widen the mean film by `s d/2`;
/// in a wide gap between two speeds of opposite sign nothing but the shear feels them.
#[test]
fn dimples_and_heights_give_the_same_film() {
    let square = "kind = \"pad\"\nlength = \"10 mm\"\nwidth = \"10 mm\"\ninlet_film = \"11 um\"\noutlet_film = \"10 um\"\nspeed = 1.0\nnx = 100\nny = 100\n";
    let dimples = "dimple_diameter = \"1 mm\"\ndimple_depth = \"3 um\"\ndimple_density = 0.196349540849\n";
    let textured = solved(&format!("{square}{dimples}"), OIL).unwrap();
    let plain = solved(square, OIL).unwrap();
    assert!(textured.friction_moving < plain.friction_moving);
    // The same dimples as a file of heights at the nodes: a pitch of 2 mm, five along each side.
    let heights: Vec<String> = (0..100)
        .map(|j| {
            let row = (0..100).map(|i| {
                let [x, y] = [i, j].map(|k| ((f64::from(k) + 0.5) * 0.1) % 2.0 - 1.0);
                format!("{:e}", -3e-6 * (1.0 - 4.0 * (x * x + y * y)).max(0.0))
            });
            row.collect::<Vec<_>>().join(",")
        })
        .collect();
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("dimples.csv"), heights.join("\n") + "\n").unwrap();
    let scene = |more: &str| {
        let path = folder.path().join("pad.toml");
        std::fs::write(&path, format!("[given_film]\n{square}{more}{OIL}")).unwrap();
        let SceneFile::Bearing(bearing) = SceneFile::load(&path).unwrap() else { panic!("{more}") };
        bearing.solve(|| false).map(|solution| solution.numbers).map_err(|error| error.to_string())
    };
    let read = scene("heights = \"dimples.csv\"\nspacing = \"0.1 mm\"\n").unwrap();
    assert!((read.load / textured.load - 1.0).abs() < 0.02, "{} {}", read.load, textured.load);
    assert!((read.friction_moving / textured.friction_moving - 1.0).abs() < 2e-3);
    // Without a scale a file or picture is refused.
    let error = scene("heights = \"dimples.csv\"\n").unwrap_err();
    assert!(error.contains("given_film.heights") && error.contains("spacing"), "{error}");
    std::fs::write(folder.path().join("dimples.png"), b"\x89PNG\r\n\x1a\n0000000000000000").unwrap();
    let error = scene("heights = \"dimples.png\"\nspacing = \"0.1 mm\"\n").unwrap_err();
    assert!(error.contains("dimples.png") && error.contains("PNG picture"), "{error}");
}

#[test]
fn features_out_of_range_are_refused_with_a_remedy() {
    let wide = PAD.to_owned();
    let square = format!("{PAD}width = \"10 mm\"\n");
    let dimples = |diameter: &str, depth: &str, density: &str| {
        format!("dimple_diameter = \"{diameter}\"\ndimple_depth = \"{depth}\"\ndimple_density = {density}\n")
    };
    for (table, parts) in [
        (wide.clone() + "edge_pressures = [0.0, 1.0]\n", ["edge_pressures", "expected 4"]),
        (wide.clone() + "edge_pressures = [0.0, 0.0, 0.0, \"-1 bar\"]\n", ["given_film.edge_pressures.3", "cavitation"]),
        (wide.clone() + "groove_width = 0.1\n", ["groove_width", "pad"]),
        (wide.clone() + "heat_share = 0.5\n", ["supply_temperature", "missing"]),
        (wide.clone() + "supply_temperature = \"40 degC\"\nheat_share = \"150 %\"\n", ["heat_share = 1.5", "at most 1"]),
        (wide.clone() + "spacing = \"1 um\"\n", ["spacing", "heights"]),
        (wide.clone() + &dimples("1 mm", "5 um", "0.2"), ["dimple_diameter", "width"]),
        (square.clone() + &dimples("1 mm", "5 mm", "0.2"), ["dimple_depth = 0.005", "below dimple_diameter"]),
        (square.clone() + &dimples("1 mm", "5 um", "0.9"), ["dimple_density = 0.9", "pi/4"]),
        (square.clone() + &dimples("0.05 mm", "5 um", "0.2"), ["dimple_diameter", "more cells"]),
        (square + &dimples("9 mm", "5 um", "0.2"), ["dimple_density", "exceeds the pad"]),
        (
            "kind = \"journal\"\ndiameter = 0.1\nwidth = 0.05\nclearance = 5e-5\nspeed = 1.0\neccentricity = 0.0\nnx = 36\nny = 8\n\
             supply_temperature = \"40 degC\"\n"
                .to_owned(),
            ["supply_temperature", "no oil flows"],
        ),
    ] {
        let error = solved(&table, OIL).unwrap_err();
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
}

/// With the viscosity of a data sheet rigid surfaces under 22 MPa have no solution; isoviscous they have that of constant viscosity.
#[test]
fn unsolved_bearings_have_no_results_and_piezoviscous_oils_warn() {
    let journal = |load: &str, oil: &str| {
        let text = format!(
            "[given_film]\nkind = \"journal\"\ndiameter = \"60 mm\"\nwidth = \"30 mm\"\nclearance = \"60 um\"\nspeed = \"3000 rpm on 60 mm\"\n\
             load = \"{load}\"\nnx = 60\nny = 12\n[lubricant]\n{oil}[thermal]\nbulk_temperature = \"50 degC\"\n"
        );
        RigidBearing::from_toml(&text).unwrap().solve(|| false).unwrap()
    };
    let sheet = "grade = \"ISO VG 32\"\nviscosity_index = 95\n";
    let unsolved = journal("40 kN", sheet);
    assert!(unsolved.film.report.require_converged().is_err());
    let numbers = unsolved.numbers;
    assert!(numbers.load.is_nan() && numbers.friction_moving.is_nan() && numbers.power_loss.is_nan());
    let warnings: Vec<String> = unsolved.warnings.iter().map(ToString::to_string).collect();
    assert!(warnings.len() == 1 && warnings[0].contains("lubricant.alpha = 0"), "{warnings:?}");
    let isoviscous = journal("40 kN", &format!("{sheet}alpha = 0\n"));
    assert!(isoviscous.warnings.is_empty() && isoviscous.numbers.alpha == 0.0);
    let constant = journal("40 kN", &format!("eta0 = {}\n", isoviscous.numbers.eta0)).numbers;
    assert!((constant.least_film / isoviscous.numbers.least_film - 1.0).abs() < 1e-6, "{constant:?}");
    let moderate = journal("5 kN", sheet);
    let ratio = moderate.numbers.viscosity_ratio;
    assert!(ratio > 1.1 && moderate.warnings[0].message.contains(&format!("{ratio:.3} times")));
}

/// A journal in water has Taylor vortices from a Reynolds number of 41.2 sqrt(R/c) = 921 on, a pad is turbulent above 1000.
#[test]
fn bearings_with_a_film_that_is_not_laminar_warn() {
    let warnings = |table: &str, oil: &str| {
        let text = format!("[given_film]\nnx = 60\nny = 12\n{table}[lubricant]\n{oil}");
        let solution = RigidBearing::from_toml(&text).unwrap().solve(|| false).unwrap();
        assert!(solution.film.report.require_converged().is_ok(), "{text}");
        let about = solution.warnings.into_iter().filter(|warning| warning.field == "given_film.speed");
        about.map(|warning| warning.message).collect::<Vec<_>>()
    };
    let journal = |speed: f64| {
        format!(
            "kind = \"journal\"\ndiameter = 0.1\nwidth = 0.05\nclearance = 100e-6\neccentricity = 0.3\nspeed = {speed}\n"
        )
    };
    let pad = |speed: f64| {
        format!(
            "kind = \"pad\"\nlength = 0.05\nwidth = 0.05\ninlet_film = 100e-6\noutlet_film = 60e-6\nspeed = {speed}\n"
        )
    };
    // rho u h/eta with 870 kg/m^3 and 1 mPa s
    let water = "eta0 = 1e-3\n";
    for (table, reynolds, limit) in
        [(journal(20.0), "is 1740", "= 921"), (pad(20.0), "is 1392", "above 1000")]
    {
        let found = warnings(&table, water);
        assert!(found.len() == 1 && found[0].contains(reynolds) && found[0].contains(limit), "{found:?}");
    }
    for table in [journal(10.5), pad(14.0)] {
        assert_eq!(warnings(&table, water), Vec::<String>::new(), "{table}");
    }
    let oil = "grade = \"ISO VG 32\"\nviscosity_index = 95\nalpha = 0\n";
    assert_eq!(warnings(&journal(20.0), oil), Vec::<String>::new());
}

/// `lubricant.temperature` is that of `alpha`; beside an isoviscous oil it is meant as that of the contact.
#[test]
fn temperature_of_an_isoviscous_oil_is_refused() {
    let text = "[given_film]\nkind = \"journal\"\ndiameter = \"60 mm\"\nwidth = \"30 mm\"\nclearance = \"60 um\"\nspeed = \"3000 rpm\"\n\
                load = \"2 kN\"\nnx = 60\nny = 12\n[lubricant]\ngrade = \"ISO VG 32\"\nviscosity_index = 95\nalpha = 0\n\
                temperature = \"60 degC\"\n";
    let bearing = RigidBearing::from_toml(text);
    let error = bearing
        .map_err(|error| error.to_string())
        .and_then(|bearing| bearing.solve(|| false).map(|_| ()).map_err(|error| error.to_string()));
    let error = error.unwrap_err();
    assert!(
        error.starts_with("lubricant.temperature = 333.15") && error.contains("thermal.bulk_temperature"),
        "{error}"
    );
}
