//! Flow factors and mean contact of rough surfaces: beside published tables, quadrature and exact means; rough pads and journals
//! beside closed forms and smooth ones; scene files.

use std::f64::consts::PI;

use stribeck::Grid;
use stribeck::analytic::{GreenwoodTripp, PatirCheng, asperity_moment};
use stribeck::lubricant::{Barus, Incompressible, Lubricant};
use stribeck::reynolds::{FilmThickness, GivenFilm, JournalBearing, MeanRoughness, SideEdges};
use stribeck::sim::{BearingSolution, RigidBearing, SimError};

const ETA: f64 = 0.01;
const GAMMAS: [f64; 7] = [1.0 / 9.0, 1.0 / 6.0, 1.0 / 3.0, 1.0, 3.0, 6.0, 9.0];

fn oil() -> Lubricant {
    Lubricant::new(Barus::new(ETA, 0.0).unwrap(), Incompressible)
}

fn rough(rq: [f64; 2], gamma: f64) -> MeanRoughness {
    MeanRoughness::new(rq, gamma, GreenwoodTripp::new(0.05, 0.01, 230e9).unwrap(), 0.1).unwrap()
}

/// Integral of `of` from `from` to `to` by Simpson's rule.
fn integral(from: f64, to: f64, of: impl Fn(f64) -> f64) -> f64 {
    let step = (to - from) / 4000.0;
    let weight = |k: u32| if k == 0 || k == 4000 { 1.0 } else { f64::from(2 + 2 * (k % 2)) };
    (0..=4000).map(|k| weight(k) * of(from + step * f64::from(k))).sum::<f64>() * step / 3.0
}

fn gaussian(s: f64) -> f64 {
    (-0.5 * s * s).exp() / (2.0 * PI).sqrt()
}

/// The table of Greenwood and Tripp (1970), rounded to five decimals.
#[test]
fn asperity_moments_are_those_of_the_published_table_and_of_quadrature() {
    let table =
        [(0.5, 0.24040), (1.0, 0.08056), (1.5, 0.02286), (2.0, 0.00542), (2.5, 0.00106), (3.0, 0.00017)];
    for (separation, value) in table {
        assert!((asperity_moment(2.5, separation) - value).abs() <= 0.51e-5, "{separation}");
    }
    for separation in [-2.0, 0.0, 0.7, 2.3, 4.0] {
        for order in [1.0_f64, 2.0, 2.5] {
            let exact =
                integral(0.0, 3.5, |r| 2.0 * r.powf(2.0 * order + 1.0) * gaussian(separation + r * r));
            assert!((asperity_moment(order, separation) / exact - 1.0).abs() < 1e-9, "{order} {separation}");
        }
    }
    assert!(asperity_moment(2.5, 9.0) == 0.0);
}

/// Below and above five root mean square heights the shear flow has two fits, with constants of seven Peklenik numbers each.
#[test]
fn fits_of_the_shear_flow_meet_at_five_root_mean_square_heights() {
    for gamma in GAMMAS {
        let law = PatirCheng::new(gamma).unwrap();
        let [below, above] = [5.0, 5.000_001].map(|separation| law.shear_flow(separation));
        assert!((below / above - 1.0).abs() < 2e-3, "{gamma}: {below} {above}");
    }
}

/// Ridges across the flow have the least mean conductance of all textures of a height distribution, ridges along it the largest.
#[test]
fn pressure_flow_factors_grow_with_the_peklenik_number_between_the_exact_means_of_ridges() {
    for separation in [3.5_f64, 4.0, 5.0, 6.0] {
        let density = |s: f64| 35.0 / 32.0 * (1.0 - s * s).powi(3);
        let gap = |s: f64| 1.0 + 3.0 * s / separation;
        let across = 1.0 / integral(-1.0, 1.0, |s| density(s) / gap(s).powi(3));
        let along = integral(-1.0, 1.0, |s| density(s) * gap(s).powi(3));
        let factors = GAMMAS.map(|gamma| PatirCheng::new(gamma).unwrap().pressure_flow(separation)[0]);
        let ordered: Vec<f64> = [across].into_iter().chain(factors).chain([along]).collect();
        assert!(ordered.windows(2).all(|pair| pair[0] < pair[1]), "{separation}: {ordered:?}");
    }
    let law = PatirCheng::new(2.0).unwrap();
    let [along, across] = law.pressure_flow(2.0);
    let turned = PatirCheng::new(0.5).unwrap().pressure_flow(2.0);
    assert!((turned[0] - across).abs() < 1e-15 && (turned[1] - along).abs() < 1e-15);
    // Linear in the logarithm of the Peklenik number.
    let [one, three] = [1.0, 3.0].map(|gamma| PatirCheng::new(gamma).unwrap().pressure_flow(2.0)[0]);
    let share = 2.0_f64.ln() / 3.0_f64.ln();
    assert!((along - one - share * (three - one)).abs() < 1e-12);
}

/// Sinusoidal ridges of the amplitude `a h`: the conductance of the mean film times `(1 - a^2)^2.5/(1 + a^2/2)` across the flow, `1 + 1.5 a^2` along it.
#[test]
fn resolved_ridges_have_their_exact_mean_conductance() {
    let (oil, h, waves) = (oil(), 1e-6, 8.0);
    for amplitude in [0.2_f64, 0.5, 0.8] {
        let square = amplitude * amplitude;
        let exact = [(1.0 - square).powf(2.5) / (1.0 + 0.5 * square), 1.0 + 1.5 * square];
        for (cells, exact, is_along) in [([256, 3], exact[0], false), ([3, 256], exact[1], true)] {
            let grid = Grid::from_edges(cells[0], cells[1], [0.0, 0.01], [0.0, 0.01]).unwrap();
            let wave = |place: f64| h * (1.0 + amplitude * (2.0 * PI * waves * place / 0.01).cos());
            let film = FilmThickness::from_function(grid, |x, y| wave(if is_along { y } else { x })).unwrap();
            let slot = GivenFilm::new(&film, &oil, [0.0, 0.0])
                .with_edge_pressures([1e5, 0.0, 0.0, 0.0])
                .with_sides(SideEdges::Closed);
            let found = slot.solve().unwrap().edge_flows[1] * 12.0 * ETA / (h.powi(3) * 1e5);
            assert!((found / exact - 1.0).abs() < 0.01, "{amplitude} {is_along}: {found} {exact}");
        }
    }
}

/// The closed form is that of the paper, which leaves out a term of the least gap.
#[test]
fn mean_shear_stress_is_the_mean_over_the_gaps() {
    let law = PatirCheng::new(1.0).unwrap();
    for separation in [0.6_f64, 1.5, 2.9, 3.5, 6.0, 14.9, 15.1, 40.0] {
        let z = separation / 3.0;
        let density = |s: f64| 35.0 / 32.0 * (1.0 - s * s).powi(3);
        // Over the logarithm of the gap.
        let least = (z - 1.0_f64).max(1.0 / 300.0);
        let mean = integral(least.ln(), (z + 1.0).ln(), |g| z * density(g.exp() - z));
        let [found, ..] = law.shear_stress(separation);
        assert!((found / mean - 1.0).abs() < 3e-3, "{separation}: {found} {mean}");
    }
    for separation in [0.5, 1.0, 3.0] {
        let mean = integral(0.0, 12.0, |gap| gap * gaussian(gap - separation));
        assert!((law.mean_gap(separation) / mean - 1.0).abs() < 1e-8);
    }
}

/// Parallel planes: `phi h^3 dp/(12 eta L)` along both axes, and `u (h_T + s sigma phi_s)` of the motion.
#[test]
fn slot_of_rough_planes_has_the_mean_flows_and_shear_stresses() {
    let (oil, h, sigma) = (oil(), 1e-6, 5e-7);
    let grid = Grid::from_edges(12, 10, [0.0, 0.01], [0.0, 0.01]).unwrap();
    let film = FilmThickness::from_function(grid, |_, _| h).unwrap();
    for gamma in [1.0 / 3.0, 1.0, 4.0] {
        let law = PatirCheng::new(gamma).unwrap();
        let [along, across] = law.pressure_flow(h / sigma);
        let rest = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_roughness(Some(rough([0.0, sigma], gamma)));
        let driven =
            rest.with_edge_pressures([1e5, 0.0, 0.0, 0.0]).with_sides(SideEdges::Closed).solve().unwrap();
        let smooth = h.powi(3) * 1e5 / (12.0 * ETA);
        assert!((driven.edge_flows[1] / (along * smooth) - 1.0).abs() < 1e-8, "{gamma}");
        // Across: two lengths differ by the slot between them, without the flow near the ends.
        let [long, short] = [(0.4, 200), (0.2, 100)].map(|(length, cells)| {
            let grid = Grid::from_edges(cells, 10, [0.0, length], [0.0, 0.01]).unwrap();
            let film = FilmThickness::from_function(grid, |_, _| h).unwrap();
            let slot = GivenFilm::new(&film, &oil, [0.0, 0.0]).with_roughness(rest.roughness);
            slot.with_edge_pressures([5e4, 5e4, 1e5, 0.0]).solve().unwrap().edge_flows[3]
        });
        assert!(((long - short) / (20.0 * across * smooth) - 1.0).abs() < 1e-6, "{gamma}: {long} {short}");
        for (speeds, rq) in
            [([0.5, 0.0], [0.0, sigma]), ([0.5, 0.0], [sigma, 0.0]), ([0.1, 0.4], [0.3e-6, 0.4e-6])]
        {
            let [mean, sliding] = [0.5 * (speeds[0] + speeds[1]), speeds[1] - speeds[0]];
            let difference = (rq[0] * rq[0] - rq[1] * rq[1]) / (sigma * sigma);
            let gap =
                sigma * law.mean_gap(2.0) * mean - 0.5 * sliding * difference * sigma * law.shear_flow(2.0);
            let rough = rough(rq, gamma);
            let found = GivenFilm::new(&film, &oil, speeds)
                .with_sides(SideEdges::Closed)
                .with_roughness(Some(rough))
                .solve()
                .unwrap();
            assert!((found.edge_flows[1] / (0.01 * gap) - 1.0).abs() < 1e-8, "{gamma} {speeds:?}");
            let [factor, split, _] = law.shear_stress(2.0);
            let couette = ETA * sliding / h * 1e-4;
            let solids = 0.1 * rough.contact.pressure(2.0) * 1e-4 * sliding.signum();
            let lower = (factor - difference * split) * couette + solids;
            let upper = -(factor + difference * split) * couette - solids;
            for (force, exact) in found.friction.iter().zip([lower, upper]) {
                assert!((force / exact - 1.0).abs() < 1e-8, "{gamma} {speeds:?}: {force} {exact}");
            }
            assert!((found.load / (rough.contact.pressure(2.0) * 1e-4) - 1.0).abs() < 1e-8);
        }
    }
}

/// A pad of smooth surfaces is the limit of low roughness; the first difference is that of the flow factors.
#[test]
fn rough_pads_and_journals_approach_smooth_ones() {
    let oil = oil();
    let journal = JournalBearing::new([25e-3, 25e-3, 25e-6], 300.0, &oil).with_cells([90, 12]);
    let smooth = journal.solve(0.7).unwrap();
    let least = smooth.least_film;
    let mut last = f64::INFINITY;
    for (separation, most) in [(6.0, 0.05), (15.0, 0.01), (60.0, 5e-4)] {
        let sigma = least / separation;
        let found = journal.with_roughness(Some(rough([0.6 * sigma, 0.8 * sigma], 1.0))).solve(0.7).unwrap();
        let [load, friction, flow] = [
            found.load / smooth.load - 1.0,
            found.film.friction[0] / smooth.film.friction[0] - 1.0,
            found.film.side_flow / smooth.film.side_flow - 1.0,
        ];
        let error = load.abs().max(friction.abs()).max(flow.abs());
        assert!(error < most && error < last, "{separation}: {load} {friction} {flow}");
        assert!(found.contact_share < 1e-6 && found.film.contact.unwrap().load >= 0.0);
        last = error;
    }
}

#[test]
fn motion_to_the_left_is_the_mirror_image() {
    let oil = oil();
    let grid = Grid::from_edges(40, 6, [0.0, 0.01], [0.0, 0.01]).unwrap();
    let films = [-1e-4, 1e-4]
        .map(|slope| FilmThickness::from_function(grid, |x, _| 1.5e-6 + slope * (x - 0.005)).unwrap());
    let [right, left] = [0, 1].map(|k| {
        let speed = if k == 0 { 1.0 } else { -1.0 };
        let pad = GivenFilm::new(&films[k], &oil, [speed, 0.0]);
        pad.with_roughness(Some(rough([3e-7, 2e-7], 3.0))).solve().unwrap()
    });
    assert!((right.load / left.load - 1.0).abs() < 1e-9);
    assert!((right.friction[0] / -left.friction[0] - 1.0).abs() < 1e-9);
    assert!((right.power_loss / left.power_loss - 1.0).abs() < 1e-9 && right.power_loss > 0.0);
}

const BEARING: &str = "[given_film]\nkind = \"journal\"\ndiameter = \"50 mm\"\nwidth = \"25 mm\"\nclearance = \"25 um\"\n\
    speed = \"SPEED\"\nload = \"2 kN\"\nnx = 120\nny = 10\n[given_film.roughness]\nrq = [\"0.3 um\", \"0.4 um\"]\ngamma = 1.0\n\
    asperity_number = 0.05\nrq_over_radius = 0.01\nequivalent_modulus = \"230 GPa\"\nboundary_friction = 0.1\n\
    [lubricant]\ngrade = \"ISO VG 32\"\nviscosity_index = 98\n[thermal]\nbulk_temperature = \"60 degC\"\n";

fn solved(text: &str) -> Result<BearingSolution, SimError> {
    RigidBearing::from_toml(text)?.solve(|| false)
}

/// Friction over speed: that of solids, a minimum, that of the fluid.
#[test]
fn journal_under_a_load_has_a_stribeck_curve() {
    let speeds = ["0.001 m/s", "0.1 m/s", "1 m/s", "20 m/s"];
    let found = speeds.map(|speed| solved(&BEARING.replace("SPEED", speed)).unwrap().numbers);
    let [slow, mixed, full, fast] = &found;
    for numbers in &found {
        assert!((numbers.load / 2000.0 - 1.0).abs() < 1e-5);
        assert!((numbers.film_over_rq.unwrap() * 0.5e-6 / numbers.least_film - 1.0).abs() < 1e-12);
    }
    let share = found.each_ref().map(|numbers| numbers.contact_share.unwrap());
    assert!(share[0] > 0.9 && share[0] <= 1.0 && share[3] < 1e-3, "{share:?}");
    assert!(share.windows(2).all(|pair| pair[0] > pair[1]), "{share:?}");
    assert!(
        slow.friction_coefficient > 0.085 && slow.friction_coefficient < 0.11,
        "{}",
        slow.friction_coefficient
    );
    assert!(mixed.friction_coefficient < slow.friction_coefficient);
    assert!(full.friction_coefficient < fast.friction_coefficient);
    let boundary = slow.contact_friction.unwrap() / slow.friction_moving;
    assert!(boundary > 0.9 && boundary <= 1.0, "{boundary}");
    let fine =
        solved(&BEARING.replace("SPEED", "0.1 m/s").replace("120", "240").replace("ny = 10", "ny = 20"));
    let fine = fine.unwrap().numbers;
    assert!(
        (fine.contact_share.unwrap() / share[1] - 1.0).abs() < 0.04,
        "{share:?} {:?}",
        fine.contact_share
    );
}

#[test]
fn films_below_the_range_of_the_flow_factors_are_warned_of() {
    let text = BEARING.replace("load = \"2 kN\"", "eccentricity = 0.995").replace("SPEED", "1 m/s");
    let warnings = solved(&text).unwrap().warnings;
    let words = warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    assert!(words.contains("film_over_rq = 0.26") && words.contains("0.5 Rq"), "{words}");
    let text = BEARING.replace("SPEED", "10 m/s");
    assert!(solved(&text).unwrap().warnings.iter().all(|warning| warning.field != "film_over_rq"));
}

#[test]
fn roughness_out_of_range_is_refused_by_its_key() {
    let text = BEARING.replace("SPEED", "1 m/s");
    for (key, other, words) in [
        ("gamma = 1.0", "gamma = 20", "given_film.roughness.gamma = 20"),
        ("\"0.3 um\"", "-1e-7", "given_film.roughness.rq.0 = -1e-7"),
        ("[\"0.3 um\", \"0.4 um\"]", "[0.0, 0.0]", "given_film.roughness.rq = 0"),
        ("rq_over_radius = 0.01", "rq_over_radius = 0", "given_film.roughness.rq_over_radius = 0"),
        ("asperity_number = 0.05", "asperity_number = -0.05", "given_film.roughness.asperity_number = -0.05"),
        ("\"230 GPa\"", "0.0", "given_film.roughness.equivalent_modulus = 0"),
        (
            "boundary_friction = 0.1",
            "boundary_friction = -0.1",
            "given_film.roughness.boundary_friction = -0.1",
        ),
        ("boundary_friction = 0.1\n", "", "boundary_friction"),
        ("\"0.3 um\"", "\"0.3 GPa\"", "given_film.roughness.rq"),
        ("gamma = 1.0", "peklenik = 1.0", "peklenik"),
    ] {
        let error = solved(&text.replace(key, other)).unwrap_err().to_string();
        assert!(error.contains(words), "{words}: {error}");
    }
    let (oil, grid) = (oil(), Grid::from_edges(12, 1, [0.0, 0.01], [0.0, 1.0]).unwrap());
    let film = FilmThickness::from_function(grid, |x, _| 2e-6 - 1e-4 * x).unwrap();
    let pad = GivenFilm::new(&film, &oil, [1.0, -0.5]).with_roughness(Some(rough([0.0, 1e-7], 1.0)));
    let error = pad.solve().unwrap_err().to_string();
    assert!(error.contains("speeds = [1, -0.5]") && error.contains("one sign"), "{error}");
}
