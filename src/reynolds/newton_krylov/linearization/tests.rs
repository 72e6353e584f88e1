//! Rows of the fluid block against products.

use super::*;
use crate::elastic::StripHalfSpace;
use crate::lubricant::{DowsonHigginson, Lubricant, Roelands};
use crate::reynolds::inner_nodes::interior;
use crate::reynolds::{FaceMobility, LubricatedContact, Scheme};

#[test]
fn stencil_rows_of_a_strip_are_those_of_the_product() {
    let grid = Grid::strip(9, 7, [0.0, 9e-5], [0.0, 7e-5]).unwrap();
    let oil = Lubricant::new(
        Roelands::new(0.04, 0.6, 1.96e8).unwrap(),
        DowsonHigginson::new(0.6e-9, 1.7e-9).unwrap(),
    );
    let mut body = StripHalfSpace::new(grid, 230e9, 1e-2).unwrap();
    let film: Vec<f64> = (0..grid.len()).map(|k| 1e-8 * (1 + k * k % 11) as f64).collect();
    let pressure: Vec<f64> = (0..grid.len()).map(|k| 1e8 * (1 + k * k % 5) as f64).collect();
    // In the first order the five points of the block are all that a balance depends on.
    let problem = LubricatedContact::new(&film, &mut body, 1.0, (1e-5, 1e-5), 1e9)
        .with_lubricant(Some(&oil))
        .with_entrainment_speed(0.1)
        .with_scheme(Scheme::FirstOrder)
        .with_face_mobility(FaceMobility::ReducedPressure);
    let mut fluid = Discretisation::new(grid);
    fluid.configure(&problem);
    fluid.update(&oil, &pressure, &film, None);
    let mut linearization = Linearization::new(grid);
    linearization.update(&fluid, 1e-17);
    let change: Vec<f32> = (0..grid.len()).map(|k| 1.0 + (k as f32).sin()).collect();
    let mut product = vec![0.0; grid.len()];
    linearization.product(&change, &change, &mut product);
    for k in interior(&grid) {
        let row = linearization.stencil_row(k, |_| [1.0; 2], &[false; 63]);
        let nodes = [k, k + 1, k - 1, grid.north_of(k).unwrap(), grid.south_of(k).unwrap()];
        let terms = row.iter().zip(nodes).map(|(entry, node)| f64::from(*entry) * f64::from(change[node]));
        let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
        assert!((sum - f64::from(product[k])).abs() < 1e-5 * size, "node {k}: {sum:e}, {:e}", product[k]);
    }
}
