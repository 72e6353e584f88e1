mod strip;

use super::*;
use crate::lubricant::{Barus, DowsonHigginson, Incompressible, Rheology, Roelands};
use crate::reynolds::inner_nodes::interior;

const FILM: f64 = 4e-8;
const MOBILITIES: [FaceMobility; 4] =
    [FaceMobility::Arithmetic, FaceMobility::ReducedPressure, FaceMobility::Wedge, FaceMobility::Inlet];

fn oil() -> Lubricant {
    Lubricant::new(Roelands::new(0.04, 0.6, 1.96e8).unwrap(), DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap())
}

/// Fluids with effective and directional thinning at a sliding speed of 0.3 m/s.
fn laws() -> impl Iterator<Item = ShearThinning> {
    let rheologies = [Rheology::eyring(5e6), Rheology::carreau(5e6, 0.5), Rheology::carreau(5e6, 0.34)];
    let laws = rheologies.into_iter().map(|rheology| ShearThinning::new(rheology.unwrap(), 0.3).unwrap());
    laws.flat_map(|law| [law, law.directional()])
}

/// A row of nodes with unit coefficients, whose fluid has `x = 1` at ambient pressure in a film of `length`.
fn row(face_mobility: FaceMobility, law: ShearThinning, length: f64) -> Discretisation {
    let mut fluid = Discretisation::new(Grid::from_edges(5, 1, [0.0, 5e-5], [-0.5, 0.5]).unwrap());
    (fluid.face_mobility, fluid.fluidity) = (face_mobility, 1.0 / (12.0 * 0.04));
    fluid.set_coefficients(1.0, 0.0);
    fluid.thinning = Some((law, length));
    fluid.ratios = vec![NodeRatios::NEWTONIAN; 5];
    fluid
}

#[test]
fn flow_between_equal_nodes_has_the_viscosity_along_sliding() {
    let oil = oil();
    for (law, face_mobility) in laws().flat_map(|law| MOBILITIES.map(|mobility| (law, mobility))) {
        let mut fluid = row(face_mobility, law, law.length(0.04));
        for p in [0.0, 1e8, 5e8, 1e9] {
            fluid.update(&oil, &[p; 5], &[FILM; 5], None);
            let eta = oil.viscosity().viscosity(p);
            let [along, _] = law.viscosity_ratios(eta, FILM);
            let exact = oil.density().ratio(p) * FILM.powi(3) / (12.0 * eta * along);
            let found = fluid.east[2] * fluid.nodes[2].potential_p;
            assert!(
                (found / exact - 1.0).abs() < 1e-4,
                "{found:e}, {exact:e} at {p:e}, {face_mobility:?}, {law:?}"
            );
        }
    }
}

/// Faces across the sliding direction have the secant viscosity, faces along it the tangent, with or without
/// entrainment.
#[test]
fn faces_have_the_viscosity_of_their_direction() {
    let oil = oil();
    for law in laws() {
        for wedge in [0.0, 1.0] {
            let mut fluid = Discretisation::new(Grid::centred(5, 5, 5e-5, 5e-5).unwrap());
            (fluid.face_mobility, fluid.wedge, fluid.fluidity) = (FaceMobility::Wedge, wedge, 1.0);
            let mut mobilities = |thinning: Option<(ShearThinning, f64)>| {
                fluid.changes.forget();
                fluid.thinning = thinning;
                fluid.ratios.resize(if thinning.is_some() { 25 } else { 0 }, NodeRatios::NEWTONIAN);
                fluid.update(&oil, &[5e8; 25], &[FILM; 25], None);
                [fluid.east[12], fluid.north[12]]
            };
            let newtonian = mobilities(None);
            let thinned = mobilities(Some((law, law.length(0.04))));
            let exact = law.viscosity_ratios(oil.viscosity().viscosity(5e8), FILM);
            for ((newtonian, thinned), ratio) in newtonian.into_iter().zip(thinned).zip(exact) {
                let found = newtonian / thinned;
                assert!((found / ratio - 1.0).abs() < 1e-4, "{found} and {ratio} of {law:?}, {wedge}");
            }
        }
    }
}

/// The flow between two pressures through a film of one thickness is `h^3/12` times the integral of
/// `dp / eta*`.
#[test]
fn flow_between_two_pressures_tends_to_the_integral() {
    let oil = Lubricant::new(Barus::new(0.04, 20e-9).unwrap(), Incompressible);
    let eyring = ShearThinning::new(Rheology::eyring(5e6).unwrap(), 0.3).unwrap();
    // The trapezoidal rule for a Newtonian fluid has an error of 2.1 % over the smaller step.
    for (law, bound) in [(eyring, 0.021), (eyring.directional(), 0.022)] {
        check_flow_between_two_pressures(&oil, law, bound);
    }
}

fn check_flow_between_two_pressures(oil: &Lubricant, law: ShearThinning, bound: f64) {
    let exact = |low: f64, high: f64| {
        let steps = 10_000;
        let width = (high - low) / f64::from(steps);
        let middle = |i: i32| low + (f64::from(i) + 0.5) * width;
        let sum: f64 = (0..steps)
            .map(|i| oil.viscosity().viscosity(middle(i)))
            .map(|eta| 1.0 / (eta * law.viscosity_ratios(eta, FILM)[0]))
            .sum();
        FILM.powi(3) / 12.0 * sum * width
    };
    for face_mobility in MOBILITIES {
        let mut fluid = row(face_mobility, law, law.length(0.04));
        let mut error = |low: f64, high: f64| {
            let pressure = [low, low, low, high, high];
            fluid.update(oil, &pressure, &[FILM; 5], None);
            fluid.east[2] * (fluid.nodes[3].potential - fluid.nodes[2].potential) / exact(low, high) - 1.0
        };
        for low in [0.0, 3e8, 1e9] {
            let errors = [5e7, 2.5e7].map(|step| error(low, low + step));
            assert!(errors[1].abs() < bound, "{errors:?} from {low:e}, {face_mobility:?}");
            // Second order, unless parts of the error cancel.
            assert!(
                errors[1].abs() < (0.3 * errors[0].abs()).max(2e-4),
                "{errors:?} from {low:e}, {face_mobility:?}"
            );
        }
        // Steep viscosities with exponents that differ by 10 and 20.
        for (low, high) in [(0.0, 5e8), (0.0, 1e9), (5e8, 1.5e9)] {
            let wrong = error(low, high);
            if face_mobility != FaceMobility::Arithmetic {
                assert!(wrong.abs() < 1.0, "{wrong} from {low:e} to {high:e}");
            }
        }
    }
}

#[test]
fn thinned_flow_has_exact_derivatives() {
    let oil = oil();
    let pressure = [1e8, 3e8, 5e8, 4.2e8, 2e8];
    let film = [6e-8, 4e-8, 3e-8, 5e-8, 7e-8];
    for (law, face_mobility) in laws().flat_map(|law| MOBILITIES.map(|mobility| (law, mobility))) {
        for length in [1e-14, 1e-10, 1e-6] {
            let mut fluid = row(face_mobility, law, length);
            fluid.update(&oil, &pressure, &film, None);
            let neighbours = fluid.held_neighbours(2);
            let flow = |p: f64, h: f64| fluid.outflow(&oil, 2, &neighbours, (p, h)).1;
            let (p, h) = (pressure[2], film[2]);
            let [value, by_pressure, by_film] = flow(p, h);
            assert!((fluid.balance(2, None) / value - 1.0).abs() < 1e-13, "{value:e}");
            // Steps within one interval of the table.
            let (dp, dh) = (2e4, 1e-5 * h);
            let p = p + 1e6;
            let [_, at_p, _] = flow(p, h);
            let difference = (flow(p + dp, h)[0] - flow(p - dp, h)[0]) / (2.0 * dp);
            assert!((difference / at_p - 1.0).abs() < 1e-7, "{difference:e}, {at_p:e}");
            let difference = (flow(pressure[2], h + dh)[0] - flow(pressure[2], h - dh)[0]) / (2.0 * dh);
            assert!((difference / by_film - 1.0).abs() < 1e-7, "{difference:e}, {by_film:e}");
            // The sum must equal the flows through both faces.
            let (west, east) = (fluid.east_derivatives(1, 1).0, fluid.east_derivatives(2, 2).0);
            for (derivative, slot) in [(by_pressure, 0), (by_film, 2)] {
                let change = east[slot] - west[slot + 1];
                assert!((change / derivative - 1.0).abs() < 1e-12, "{change:e}, {derivative:e}");
            }
        }
    }
}

/// If the logarithm of the viscosity is linear in pressure, for any films.
#[test]
fn thinned_flow_increases_with_the_pressure_of_its_node() {
    let oil = Lubricant::new(Barus::new(0.04, 20e-9).unwrap(), Incompressible);
    for (law, length) in laws().flat_map(|law| [1e-12, 1e-9, 1e-6].map(|length| (law, length))) {
        for film in [[1e-9, 1e-7], [1e-7, 1e-9], [3e-8, 3e-8]] {
            for other in [0.0, 2e8, 1e9] {
                let mut fluid = row(FaceMobility::ReducedPressure, law, length);
                let films = [film[1], film[1], film[0], film[1], film[1]];
                fluid.update(&oil, &[other; 5], &films, None);
                let neighbours = fluid.held_neighbours(2);
                for step in 0..150 {
                    let p = f64::from(step) * 1e7;
                    let slope = fluid.outflow(&oil, 2, &neighbours, (p, film[0])).1[1];
                    assert!(
                        slope > 0.0,
                        "{slope:e} at {p:e}, {other:e}, films {film:?}, {length:e}, {law:?}"
                    );
                }
            }
        }
    }
}

/// Pressures on a few cells, a third of them zero, and films of a nanometre to a tenth of a micrometre.
fn rough_state(grid: &Grid) -> (Vec<f64>, Vec<f64>) {
    let wave = |k: usize, a: f64| (a * k as f64).sin();
    let pressure = (0..grid.len()).map(|k| 3e8 * (0.4 + wave(k, 1.7) * wave(k, 0.31)).max(0.0)).collect();
    let film = (0..grid.len()).map(|k| 1e-8 * 10f64.powf(wave(k, 2.3))).collect();
    (pressure, film)
}

#[test]
fn balances_in_a_window_equal_those_of_the_full_grid() {
    let oil = oil();
    let grid = Grid::from_edges(30, 20, [0.0, 3e-5], [0.0, 2e-5]).unwrap();
    let (pressure, film) = rough_state(&grid);
    let previous: Vec<f64> = film.iter().map(|h| 1.1 * h).collect();
    for face_mobility in MOBILITIES {
        for scheme in [Scheme::FirstOrder, Scheme::SecondOrder, Scheme::Limited] {
            let mut whole = Discretisation::new(grid);
            (whole.face_mobility, whole.scheme, whole.cavitation) =
                (face_mobility, scheme, Cavitation::MassConserving);
            whole.fluidity = 1.0 / (12.0 * 0.04);
            whole.set_coefficients(3e4, 2e4);
            (whole.wedge, whole.squeeze, whole.rate) = (1.0, 0.2, 1e5);
            whole.align(&film);
            whole.update(&oil, &pressure, &film, Some(&previous));
            let (first, nx, ny) = (2 * grid.nx() + 5, 20, 16);
            let there = |q: usize| first + q % nx + q / nx * grid.nx();
            let here = |values: &[f64]| (0..nx * ny).map(|q| values[there(q)]).collect::<Vec<_>>();
            let mut window = Discretisation::new(grid.corner(nx, ny));
            window.set_window(&whole, |j| first + j * grid.nx());
            let previous_here = here(&previous);
            window.update_window(&oil, &here(&pressure), &here(&film), Some(&previous_here));
            let mut unfilled = 0;
            let is_core = |q: &usize| {
                let (i, j) = (q % nx, q / nx);
                (MARGIN..nx - MARGIN).contains(&i) && (MARGIN..ny - MARGIN).contains(&j)
            };
            for q in (0..nx * ny).filter(is_core) {
                let k = there(q);
                let pairs = [
                    (window.balance(q, Some(&previous_here)), whole.balance(k, Some(&previous))),
                    (window.imbalance(q, Some(&previous_here)), whole.imbalance(k, Some(&previous))),
                ];
                for (found, exact) in pairs {
                    assert!(
                        (found - exact).abs() <= 1e-12 * film[k] + 1e-14 * exact.abs(),
                        "{found:e}, {exact:e} at {q}, {face_mobility:?}, {scheme:?}"
                    );
                }
                unfilled += usize::from(whole.theta[k] < 1.0);
            }
            assert!(unfilled > 3, "{unfilled} cells are not filled, {face_mobility:?}, {scheme:?}");
        }
    }
}

/// Masses, faces, film fractions and balances, bit by bit.
fn bits(fluid: &Discretisation) -> Vec<u64> {
    let fields = [
        &fluid.masses,
        &fluid.beyond,
        &fluid.face_films,
        &fluid.east,
        &fluid.north,
        &fluid.east_flow,
        &fluid.north_flow,
        &fluid.entrained,
        &fluid.theta,
    ];
    let balances = interior(&fluid.grid).map(|k| fluid.balance(k, None).to_bits());
    fields.into_iter().flatten().map(|value| value.to_bits()).chain(balances).collect()
}

#[test]
fn updates_of_changed_nodes_equal_updates_of_all_nodes_to_the_last_bit() {
    let (oil, grid) = (oil(), Grid::centred(9, 7, 1e-5, 1e-5).unwrap());
    let cases =
        MOBILITIES.into_iter().flat_map(|mobility| [false, true].map(|has_edge| (mobility, has_edge)));
    for (face_mobility, has_edge) in cases {
        let fresh = || {
            let mut fluid = Discretisation::new(grid);
            (fluid.face_mobility, fluid.wedge, fluid.fluidity) = (face_mobility, 1.0, 1.0 / 0.48);
            fluid.film_floor = 0.5e-9;
            if has_edge {
                fluid.edge_pressure = vec![3e6; grid.len()];
            }
            fluid.set_coefficients(1e3, 1e3);
            fluid
        };
        let mut kept = fresh();
        let mut pressure: Vec<f64> = (0..63).map(|k| 1e8 * f64::from(k % 5)).collect();
        let mut film: Vec<f64> = (0..63).map(|k| 1e-8 * f64::from(1 + k * k % 11)).collect();
        for round in 0..40 {
            // One pressure and one film, edges among them; nothing at all in every fifth round.
            if round % 5 > 0 {
                pressure[(7 * round + 3) % 63] += 2e7;
                film[(5 * round + 11) % 63] *= 0.8;
            }
            kept.update(&oil, &pressure, &film, None);
            let mut whole = fresh();
            whole.update(&oil, &pressure, &film, None);
            assert_eq!(
                bits(&kept),
                bits(&whole),
                "round {round}, {face_mobility:?}, edge pressure {has_edge}"
            );
        }
    }
}
