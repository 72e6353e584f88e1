//! Holes and elastic bores of rigid bearings beside closed forms and limits; warnings of bearings.

use std::f64::consts::PI;

use stribeck::Grid;
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::{
    ElasticBore, Feed, FilmThickness, GivenFilm, Grooves, Holes, JournalBearing, JournalSolution,
};
use stribeck::sim::{BearingSolution, RigidBearing};

const ETA: f64 = 0.01;
const RADIUS: f64 = 0.05;
const WIDTH: f64 = 0.05;
const CLEARANCE: f64 = 5e-5;

fn oil() -> Lubricant {
    Lubricant::new(Barus::new(ETA, 0.0).unwrap(), Incompressible)
}

/// `q = 2 pi h^3 p/(12 eta ln(4 B/(pi d)))` from a round hole of the diameter d in the middle of a long film of the width B.
fn hole_flow(film: f64, pressure: f64, width: f64, diameter: f64) -> f64 {
    2.0 * PI * film.powi(3) * pressure / (12.0 * ETA * (4.0 * width / (PI * diameter)).ln())
}

#[test]
fn hole_in_a_uniform_film_has_the_flow_of_its_closed_form() {
    let oil = oil();
    for (diameter, cells, tolerance) in
        [(0.01, [160, 40], 0.02), (0.02, [160, 40], 0.02), (0.01, [320, 80], 0.01)]
    {
        let grid = Grid::from_edges(cells[0], cells[1], [0.0, 0.2], [0.0, WIDTH]).unwrap();
        let film = FilmThickness::from_function(grid, |_, _| CLEARANCE).unwrap();
        let hole = [Feed::hole([0.1, 0.5 * WIDTH], diameter, 2e5)];
        let solution = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_feeds(&hole).solve().unwrap();
        let exact = hole_flow(CLEARANCE, 2e5, WIDTH, diameter);
        assert!(
            (solution.feed_flows[0] / exact - 1.0).abs() < tolerance,
            "{diameter} {cells:?}: {}",
            solution.feed_flows[0] / exact
        );
    }
}

#[test]
fn holes_of_a_concentric_journal_feed_both_sides() {
    let oil = oil();
    let bearing = JournalBearing::new([RADIUS, WIDTH, CLEARANCE], 1e-6, &oil).with_cells([252, 40]);
    let hole = Holes::new(&[PI], 0.01, 2e5);
    let solution = bearing.with_holes(Some(hole)).solve(0.0).unwrap();
    let exact = hole_flow(CLEARANCE, 2e5, WIDTH, 0.01);
    assert!((solution.hole_flow / exact - 1.0).abs() < 0.03, "{} {exact}", solution.hole_flow);
    assert!((solution.film.side_flow / solution.hole_flow - 1.0).abs() < 1e-6);
    // Two holes far from each other have twice the flow of one.
    let two = bearing.with_holes(Some(Holes::new(&[0.0, PI], 0.01, 2e5))).solve(0.0).unwrap();
    assert!((two.hole_flow / (2.0 * exact) - 1.0).abs() < 0.03, "{} {exact}", two.hole_flow);
    assert!(solution.groove_flow == 0.0, "{}", solution.groove_flow);
    // Holes and a groove: both feed.
    let grooves = Grooves::new(&[0.5 * PI], [0.01, 0.04], 2e5);
    let both = bearing
        .with_grooves(Some(grooves))
        .with_holes(Some(Holes::new(&[1.5 * PI], 0.01, 2e5)))
        .solve(0.0)
        .unwrap();
    assert!((both.hole_flow / exact - 1.0).abs() < 0.05, "{} {exact}", both.hole_flow);
    let sum = both.hole_flow + both.groove_flow;
    assert!((both.film.side_flow / sum - 1.0).abs() < 1e-6, "{} {sum}", both.film.side_flow);
    for (angles, diameter, pressure, part) in [
        (vec![PI], 0.06, 1e5, "hole_diameter = 0.06"),
        (vec![PI], 0.01, -1.0, "supply_pressure = -1"),
        (vec![], 0.01, 1e5, "hole_angles"),
        (vec![PI, PI + 0.1], 0.01, 1e5, "first hole"),
    ] {
        let holes = Holes::new(&angles, diameter, pressure);
        let error = bearing.with_holes(Some(holes)).solve(0.0).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// A hole of a loaded journal keeps its angle to the load; the film turned the other way is its mirror image.
#[test]
fn hole_keeps_its_angle_to_the_load() {
    let oil = oil();
    let solve = |speed: f64| {
        let bearing = JournalBearing::new([RADIUS, WIDTH, CLEARANCE], speed, &oil).with_cells([120, 20]);
        bearing.with_holes(Some(Holes::new(&[-0.5 * PI], 0.012, 2e5))).solve(0.6).unwrap()
    };
    let [forward, backward] = [100.0, -100.0].map(solve);
    assert!((forward.hole_flow / forward.film.side_flow - 1.0).abs() < 1e-6);
    assert!(forward.hole_flow > 0.0 && (forward.hole_flow / backward.hole_flow - 1.0).abs() < 1e-3);
    assert!((forward.load / backward.load - 1.0).abs() < 1e-4);
}

fn bearing(oil: &Lubricant) -> JournalBearing<'_> {
    JournalBearing::new([RADIUS, WIDTH, CLEARANCE], 100.0, oil).with_cells([80, 12])
}

/// The load of a film that is wider by `C p` of its own pressure, by repeated films from the rigid one.
fn load_of_repeated_films(
    rigid: &JournalSolution,
    compliance: f64,
    oil: &Lubricant,
    eccentricity: f64,
) -> f64 {
    let grid = rigid.film.grid();
    let mut pressure = rigid.film.pressure.clone();
    for _ in 0..7 {
        let film = FilmThickness::from_function(grid, |x, y| {
            let widening = compliance * grid.interpolate(&pressure, x, y).unwrap();
            CLEARANCE * (1.0 + eccentricity * (x / RADIUS).cos()) + widening
        })
        .unwrap();
        pressure = GivenFilm::new(&film, oil, [100.0 * RADIUS, 0.0]).solve().unwrap().pressure;
    }
    let moment = |of: fn(f64) -> f64| {
        grid.nodes().zip(&pressure).map(|((x, _), p)| p * grid.cell_area() * of(x / RADIUS)).sum::<f64>()
    };
    moment(f64::cos).hypot(moment(f64::sin))
}

#[test]
fn liner_has_the_load_of_a_film_that_its_own_pressure_widens() {
    let oil = oil();
    let rigid = bearing(&oil).solve(0.6).unwrap();
    let largest = rigid.film.pressure.iter().copied().fold(0.0, f64::max);
    for (share, least_change) in [(0.03, 0.002), (0.1, 0.015)] {
        let compliance = share * rigid.least_film / largest;
        let soft = bearing(&oil).with_bore(Some(ElasticBore::Column { compliance })).solve(0.6).unwrap();
        let repeated = load_of_repeated_films(&rigid, compliance, &oil, 0.6);
        assert!((soft.load / repeated - 1.0).abs() < 1e-4, "{share}: {} {repeated}", soft.load);
        assert!(soft.load < (1.0 - least_change) * rigid.load, "{share}: {} {}", soft.load, rigid.load);
        let expected = compliance * soft.film.pressure.iter().copied().fold(0.0, f64::max);
        // Within the tolerance of the deflection.
        assert!(
            (soft.bore_widening - expected).abs() <= 1e-3 * soft.least_film,
            "{} {expected}",
            soft.bore_widening
        );
    }
    let stiff = bearing(&oil)
        .with_bore(Some(ElasticBore::HalfSpace { equivalent_modulus: 1e16 }))
        .solve(0.6)
        .unwrap();
    assert!((stiff.load / rigid.load - 1.0).abs() < 1e-4 && stiff.bore_widening < 1e-9);
}

/// The liner of a modulus E and Poisson's ratio v deflects by `p t (1 + v)(1 - 2 v)/(E (1 - v))`.
#[test]
fn liner_has_the_compliance_of_its_oedometric_modulus() {
    let ElasticBore::Column { compliance } = ElasticBore::liner(1e-3, 1e9, 0.3) else { panic!() };
    assert!((compliance / (1e-3 * 1.3 * 0.4 / (1e9 * 0.7)) - 1.0).abs() < 1e-12);
}

/// Under one load a softer bore has a larger eccentricity and a lower largest pressure; axes may be farther apart than the clearance.
#[test]
fn soft_bore_spreads_the_pressure_of_its_load() {
    let oil = oil();
    let small = JournalBearing::new([25e-3, 25e-3, 25e-6], 314.0, &oil).with_cells([80, 12]);
    let under = |bore: Option<ElasticBore>| small.with_bore(bore).equilibrium(8e3).unwrap();
    let largest = |solution: &JournalSolution| solution.film.pressure.iter().copied().fold(0.0, f64::max);
    let half_space = |equivalent_modulus| Some(ElasticBore::HalfSpace { equivalent_modulus });
    let [rigid, steel, soft] = [None, half_space(230e9), half_space(90e9)].map(under);
    for solution in [&steel, &soft] {
        assert!((solution.load / 8e3 - 1.0).abs() < 3e-4, "{}", solution.load);
    }
    assert!(rigid.eccentricity < steel.eccentricity && steel.eccentricity < soft.eccentricity);
    assert!(largest(&soft) < 0.8 * largest(&rigid), "{} {}", largest(&soft), largest(&rigid));
    assert!(soft.eccentricity > 1.0 && soft.least_film > 0.0, "{} {}", soft.eccentricity, soft.least_film);
    for (bore, part) in [
        (ElasticBore::HalfSpace { equivalent_modulus: 0.0 }, "bore_modulus = 0"),
        (ElasticBore::Column { compliance: f64::NAN }, "liner_compliance = NaN"),
    ] {
        let error = bearing(&oil).with_bore(Some(bore)).solve(0.5).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

const OIL: &str = "[lubricant]\ndensity_a = 0.0\n[lubricant.viscosity]\nlaw = \"barus\"\neta0 = \"10 mPa s\"\nalpha = 0.0\n";
const JOURNAL: &str = "kind = \"journal\"\ndiameter = \"100 mm\"\nwidth = \"50 mm\"\nclearance = \"50 um\"\nspeed = \"1 m/s\"\n\
                       eccentricity = 0.5\nnx = 120\nny = 20\n";
const PAD: &str = "kind = \"pad\"\nlength = \"200 mm\"\nwidth = \"50 mm\"\ninlet_film = \"50 um\"\noutlet_film = \"50 um\"\n\
                   speed = \"1e-9 m/s\"\nnx = 160\nny = 40\n";

fn solved(table: &str, oil: &str) -> Result<BearingSolution, String> {
    let bearing = RigidBearing::from_toml(&format!("[given_film]\n{table}{oil}"));
    bearing.and_then(|bearing| bearing.solve(|| false)).map_err(|error| error.to_string())
}

#[test]
fn scenes_have_holes_and_elastic_bores() {
    let hole = "hole_angles = [\"-90 deg\"]\nhole_diameter = \"12 mm\"\nsupply_pressure = \"2 bar\"\n";
    let fed = solved(&format!("{JOURNAL}{hole}"), OIL).unwrap().numbers;
    assert!(fed.hole_flow.unwrap() > 0.0 && fed.groove_flow.is_none() && fed.bore_widening.is_none());
    let pad_hole = "hole_positions = [\"100 mm\"]\nhole_diameter = \"10 mm\"\nsupply_pressure = \"2 bar\"\n";
    let pad = solved(&format!("{PAD}{pad_hole}"), OIL).unwrap().numbers;
    assert!((pad.hole_flow.unwrap() / hole_flow(5e-5, 2e5, 0.05, 0.01) - 1.0).abs() < 0.02, "{pad:?}");
    assert!(pad.load > 2e5 * 0.25 * PI * 1e-4);
    let liner = "liner_thickness = \"0.5 mm\"\nliner_modulus = \"0.5 GPa\"\nliner_poisson = 0.4\n";
    let soft = solved(&format!("{JOURNAL}{liner}"), OIL).unwrap().numbers;
    assert!(soft.bore_widening.unwrap() > 0.0 && soft.load < solved(JOURNAL, OIL).unwrap().numbers.load);
    for (table, parts) in [
        (format!("{JOURNAL}hole_angles = [1.0]\nsupply_pressure = 1e5\n"), ["hole_diameter", "missing"]),
        (
            format!("{JOURNAL}hole_angles = [1.0]\nhole_diameter = 1e-2\n"),
            ["supply_pressure = \"1 bar\"", "missing"],
        ),
        (
            format!("{JOURNAL}hole_angles = [1.0]\nhole_diameter = 1e-4\nsupply_pressure = 1e5\n"),
            ["hole_diameter", "nx = "],
        ),
        (
            format!("{PAD}{}", pad_hole.replace("10 mm", "0.1 mm")),
            ["given_film.hole_diameter = 1e-4 m", "ny = "],
        ),
        (
            JOURNAL.replace("eccentricity = 0.5", "load = 1e6")
                + "groove_angles = [\"10 deg\"]\ngroove_width = \"5 mm\"\n",
            ["groove at 10 deg", "opposite the load"],
        ),
        (format!("{JOURNAL}hole_diameter = 1e-2\nsupply_pressure = 1e5\n"), ["hole_angles", "missing"]),
        (format!("{JOURNAL}hole_positions = [0.1]\n"), ["hole_positions", "journal"]),
        (format!("{JOURNAL}{liner}bore_modulus = \"200 GPa\"\n"), ["bore_modulus", "leave out"]),
        (format!("{JOURNAL}{}", liner.replace("0.4", "0.5")), ["liner_poisson", "below 0.5"]),
        (
            format!("{PAD}{}", pad_hole.replace("100 mm", "199 mm")),
            ["hole_positions = 0.199", "inlet and outlet"],
        ),
        (format!("{PAD}supply_pressure = \"1 bar\"\n"), ["supply_pressure", "hole_positions"]),
        (format!("{PAD}bore_modulus = \"200 GPa\"\n"), ["bore_modulus", "pad"]),
    ] {
        let error = solved(&table, OIL).map(|solution| solution.numbers).unwrap_err();
        assert!(parts.iter().all(|part| error.contains(part)), "{parts:?}: {error}");
    }
}

#[test]
fn bearings_without_load_steep_dimples_and_hot_oils_warn() {
    let pad = |inlet: f64, more: &str, oil: &str| {
        let table = format!(
            "kind = \"pad\"\nlength = \"10 mm\"\nwidth = \"10 mm\"\ninlet_film = {inlet}\noutlet_film = 5e-6\nspeed = 1.0\nnx = 100\nny = 100\n{more}"
        );
        let fields = solved(&table, oil).unwrap().warnings;
        fields.iter().map(|warning| warning.field.clone()).collect::<Vec<_>>()
    };
    assert!(pad(1e-5, "", OIL).is_empty());
    assert_eq!(pad(4e-6, "", OIL), ["load"]);
    // A parallel pad with dimples carries nothing without cavitation below ambient.
    let shallow = "dimple_diameter = \"2 mm\"\ndimple_depth = \"5 um\"\ndimple_density = 0.3\n";
    assert_eq!(pad(5e-6, shallow, OIL), ["load"]);
    assert_eq!(pad(5e-6, &format!("{shallow}cavitation_pressure = \"-1 bar\"\n"), OIL), ["load"]);
    let naphthenic = "[lubricant]\ngrade = \"ISO VG 32\"\nviscosity_index = -10\nalpha = 0\n";
    assert_eq!(pad(1e-5, "", naphthenic), ["lubricant.viscosity_index"]);
    let dimples = "dimple_diameter = \"2 mm\"\ndimple_depth = \"0.4 mm\"\ndimple_density = 0.2\n";
    assert_eq!(pad(1e-5, dimples, OIL), ["given_film.dimple_depth"]);
    // Ten cells in a diameter.
    let small = "dimple_diameter = \"1 mm\"\ndimple_depth = \"5 um\"\ndimple_density = 0.2\n";
    assert_eq!(pad(1e-5, small, OIL), ["given_film.dimple_diameter"]);
    let hot = "[lubricant]\ngrade = \"ISO VG 460\"\nviscosity_index = 95\n[thermal]\nbulk_temperature = \"300 degC\"\n";
    assert_eq!(pad(1e-5, "", hot), ["temperature"]);
}
