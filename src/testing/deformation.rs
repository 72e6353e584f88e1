//! The contract of elastic deformation.

use super::{Contract, Violation, close};
use crate::elastic::DeformationModel;
use crate::error::InputError;

/// Checks `model`, on a grid of at least 6 x 6 nodes, against the contract of [`DeformationModel`]: zero
/// displacement without pressure, non-negative displacement under pressure, linearity, symmetry, translation
/// invariance, influence coefficients that equal displacements, and rejection of slices of wrong length.
///
/// # Errors
/// The first violation.
///
/// ```
/// use stribeck::{Grid, elastic::HalfSpace};
/// let grid = Grid::centred(9, 8, 1e-6, 2e-6)?;
/// stribeck::testing::deformation_model(&mut HalfSpace::new(grid, 230e9)?)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn deformation_model(model: &mut dyn DeformationModel) -> Result<(), Violation> {
    let contract = Contract::of(model);
    let (nx, ny) = (model.grid().nx(), model.grid().ny());
    contract
        .require(nx >= 6 && ny >= 6, "the grid of the check has 6 x 6 nodes", || format!("{nx} x {ny}"))?;
    let n = nx * ny;
    let mut probe = Probe { contract, model, nx, pressure: vec![0.0; n], out: vec![0.0; n] };
    let idle = probe.displacement(&[])?;
    probe.contract.require(
        idle.iter().all(|u| *u == 0.0),
        "zero pressure gives zero displacement",
        || format!("largest {:e} m", idle.iter().copied().fold(0.0, f64::max)),
    )?;
    let (a, b) = ((1, 2), (4, 3));
    let of_a = probe.displacement(&[(a, 1e9)])?;
    let of_b = probe.displacement(&[(b, 1e9)])?;
    let largest = of_a[probe.at(a)];
    let positive = largest > 0.0 && of_a.iter().all(|u| *u >= 0.0);
    probe.contract.require(positive, "displacement is positive", || {
        format!("smallest {:e} m", of_a.iter().copied().fold(f64::INFINITY, f64::min))
    })?;
    let both = probe.displacement(&[(a, 2e9), (b, 3e9)])?;
    let linear = (0..n).all(|k| close(both[k], 2.0 * of_a[k] + 3.0 * of_b[k], largest, 1e-9));
    probe.contract.require(linear, "displacement is linear", || "sums of pressures differ".to_owned())?;
    let (there, back) = (of_a[probe.at(b)], of_b[probe.at(a)]);
    probe.contract.require(close(there, back, largest, 1e-9), "displacement is symmetric", || {
        format!("{there:e} and {back:e} m")
    })?;
    let moved = probe.displacement(&[((a.0 + 1, a.1 + 1), 1e9)])?;
    for (x, y) in [(0, 0), (3, 1), (nx - 2, ny - 2)] {
        let (here, shifted) = (of_a[probe.at((x, y))], moved[probe.at((x + 1, y + 1))]);
        probe.contract.require(
            close(here, shifted, largest, 1e-9),
            "displacement is translation invariant",
            || format!("{here:e} and {shifted:e} m"),
        )?;
    }
    for (di, dj) in [(0, 0), (1, 0), (0, 1), (3, 2)] {
        let own = di + dj == 0;
        let given = if own { probe.model.self_influence(probe.at(a)) } else { probe.model.influence(di, dj) };
        let found = of_a[probe.at((a.0 + di, a.1 + dj))] / 1e9;
        probe.contract.require(
            close(given, found, largest / 1e9, 1e-9),
            "influence coefficients are displacements",
            || format!("{given:e} and {found:e} m/Pa at an offset of {di}, {dj}"),
        )?;
    }
    let refused = probe.model.displacement(&probe.pressure[1..], &mut probe.out).is_err();
    probe.contract.require(refused, "slices that do not fit are refused", || "they were accepted".to_owned())
}

/// A model under loads on few nodes.
struct Probe<'a> {
    /// Reports violations.
    contract: Contract,
    /// The model under test.
    model: &'a mut dyn DeformationModel,
    /// Nodes in a row.
    nx: usize,
    /// The loads \[Pa\].
    pressure: Vec<f64>,
    /// Their displacement \[m\].
    out: Vec<f64>,
}

impl Probe<'_> {
    /// Index of the node in column `i` and row `j`.
    fn at(&self, (i, j): (usize, usize)) -> usize {
        j * self.nx + i
    }

    /// Displacement under `loads`, pressures at nodes.
    fn displacement(&mut self, loads: &[((usize, usize), f64)]) -> Result<Vec<f64>, Violation> {
        self.pressure.fill(0.0);
        for &(node, p) in loads {
            let k = self.at(node);
            self.pressure[k] = p;
        }
        // The result must not depend on earlier content.
        self.out.fill(1.0);
        let outcome = self.model.displacement(&self.pressure, &mut self.out);
        outcome.map_err(|error: InputError| {
            self.contract.broken("slices that fit are accepted", error.to_string())
        })?;
        Ok(self.out.clone())
    }
}
