//! The flow of a strip.

use super::*;

const ROWS: usize = 7;

/// The flow on a strip whose fields are those of `k` in the row `shift` rows further north.
fn shifted(face_mobility: FaceMobility, shift: usize) -> Discretisation {
    let grid = Grid::strip(9, ROWS, [0.0, 9e-5], [0.0, 7e-5]).unwrap();
    let at = |k: usize| k % 9 + (k / 9 + shift) % ROWS * 9;
    let field = |value: &dyn Fn(usize) -> f64| (0..grid.len()).map(|k| value(at(k))).collect::<Vec<f64>>();
    let pressure = field(&|k| 1e8 * (k * k % 5) as f64);
    let film = field(&|k| 1e-8 * (1 + k * k % 11) as f64);
    let mut fluid = Discretisation::new(grid);
    (fluid.face_mobility, fluid.wedge, fluid.fluidity) = (face_mobility, 1.0, 1.0 / 0.48);
    (fluid.film_floor, fluid.cavitation) = (0.5e-9, Cavitation::MassConserving);
    fluid.set_coefficients(1e3, 2e3);
    fluid.align(&film);
    fluid.update(&oil(), &pressure, &film, None);
    fluid
}

#[test]
fn balances_of_a_strip_do_not_depend_on_its_first_row() {
    for face_mobility in MOBILITIES {
        let base = shifted(face_mobility, 0);
        for shift in 1..ROWS {
            let moved = shifted(face_mobility, shift);
            for k in interior(&base.grid) {
                let there = k % 9 + (k / 9 + shift) % ROWS * 9;
                let pairs = [
                    (moved.balance(k, None), base.balance(there, None)),
                    (moved.imbalance(k, None), base.imbalance(there, None)),
                    (moved.conductance(k), base.conductance(there)),
                    (moved.alignments[k], base.alignments[there]),
                ];
                for (found, exact) in pairs {
                    assert_eq!(found.to_bits(), exact.to_bits(), "node {k}, {face_mobility:?}, {shift} rows");
                }
            }
        }
    }
}

#[test]
fn flow_across_the_rows_of_a_strip_sums_to_zero() {
    for face_mobility in MOBILITIES {
        let fluid = shifted(face_mobility, 0);
        assert!(
            fluid.north_flow[(ROWS - 1) * 9..].iter().any(|flow| flow.abs() > 0.0),
            "flow into the first row"
        );
        for i in 1..8 {
            let column = || (0..ROWS).map(|j| j * 9 + i);
            let largest = column().fold(0.0_f64, |most, k| most.max(fluid.north_flow[k].abs()));
            let across = |k: usize| fluid.pressure_outflow(k) - (fluid.east_flow[k] - fluid.east_flow[k - 1]);
            let sum: f64 = column().map(across).sum();
            assert!(
                sum.abs() < 1e-12 * largest.max(1e-3),
                "{sum:e} of {largest:e} in column {i}, {face_mobility:?}"
            );
        }
    }
}
