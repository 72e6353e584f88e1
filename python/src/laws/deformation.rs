//! Elastic bodies.

use std::fmt;
use std::sync::Arc;

use pyo3::prelude::*;
use stribeck::elastic::{DeformationModel, NEAR, ResponseApproximations};
use stribeck::{Grid, InputError};

use super::{Function, raised};

/// Largest breach of its contract over the largest displacement that counts as rounding.
const LARGEST_BREACH: f64 = 1e-6;

/// A deformation model: `displacement(pressure)` and, where there are, `pressure_estimate(displacement)` and
/// `influence(di, dj)`. A clone shares the functions.
#[derive(Clone)]
pub(crate) struct Deformation {
    displacement: Arc<Function>,
    estimated: Option<Estimated>,
    /// By rows and columns of the offset, up to `NEAR`.
    influences: [[f64; NEAR + 1]; NEAR + 1],
}

/// The methods of a deformation model with an estimate of pressures, beside its displacement.
#[derive(Clone)]
struct Estimated {
    displacement: Arc<Function>,
    estimate: Arc<Function>,
}

impl fmt::Debug for Deformation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.displacement.fmt(f)
    }
}

impl Deformation {
    /// Influence coefficients that are not given are the displacements under 1 Pa on the first node.
    pub(crate) fn new(
        py: Python<'_>,
        displacement: Function,
        estimate: Option<Function>,
        influence: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let of_unit = probed(py, &displacement)?;
        let mut influences = [[0.0; NEAR + 1]; NEAR + 1];
        if let Some(influence) = influence {
            for (dj, row) in influences.iter_mut().enumerate() {
                for (di, value) in row.iter_mut().enumerate() {
                    let given = influence.call1(py, (di, dj)).and_then(|value| value.extract(py));
                    *value = given.map_err(|error| raised(py, "influence", error))?;
                }
            }
            let (given, found) = (influences[0][0], of_unit.first().copied().unwrap_or_default());
            if (given - found).abs() > LARGEST_BREACH * found.abs() {
                let breach =
                    format!("is displaced by {found:e} m under 1 Pa, but its influence(0, 0) is {given:e}");
                return Err(displacement.refused(py, &breach, given.into_pyobject(py)?.into_any()));
            }
        } else {
            for (row, values) in influences.iter_mut().zip(of_unit.chunks(displacement.grid.nx())) {
                for (influence, value) in row.iter_mut().zip(values) {
                    *influence = *value;
                }
            }
        }
        let displacement = Arc::new(displacement);
        let estimated = estimate.map(|estimate| Estimated {
            displacement: Arc::clone(&displacement),
            estimate: Arc::new(estimate),
        });
        Ok(Self { displacement, estimated, influences })
    }
}

/// Displacements under 1 Pa on the first node, of a function that is linear and the same at its neighbour.
fn probed(py: Python<'_>, displacement: &Function) -> PyResult<Vec<f64>> {
    let under = |node: usize, pressure: f64| -> PyResult<Vec<f64>> {
        let mut field = vec![0.0; displacement.grid.len()];
        if let Some(loaded) = field.get_mut(node) {
            *loaded = pressure;
        }
        let mut out = vec![0.0; field.len()];
        displacement.try_fill(py, vec![displacement.array(py, &field)?], &mut out)?;
        Ok(out)
    };
    let [none, one, two, beside] = [under(0, 0.0)?, under(0, 1.0)?, under(0, 2.0)?, under(1, 1.0)?];
    let largest = one.iter().fold(0.0, |largest: f64, u| largest.max(u.abs()));
    let differ = |a: &f64, b: f64| (a - b).abs() > LARGEST_BREACH * largest;
    let nx = displacement.grid.nx();
    let breach = if none.iter().any(|u| differ(u, 0.0)) {
        Some("displaces without pressure")
    } else if two.iter().zip(&one).any(|(two, one)| differ(two, 2.0 * one)) {
        Some("displaces under 2 Pa not twice as far as under 1 Pa: it must be linear")
    } else if beside
        .iter()
        .skip(1)
        .zip(&one)
        .enumerate()
        .any(|(k, (beside, one))| (k + 1) % nx > 0 && differ(beside, *one))
    {
        Some(
            "displaces under 1 Pa on one node not as under 1 Pa on the next: it must be the same at all nodes",
        )
    } else {
        None
    };
    breach.map_or(Ok(one), |breach| {
        let value = largest.into_pyobject(py)?.into_any();
        Err(displacement.refused(py, breach, value))
    })
}

impl DeformationModel for Deformation {
    fn grid(&self) -> Grid {
        self.displacement.grid
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.displacement.field_into(pressure, out)
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        self.influences.get(dj).and_then(|row| row.get(di)).copied().unwrap_or(0.0)
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        self.estimated.as_mut().map(|estimated| estimated as _)
    }
}

impl ResponseApproximations for Estimated {
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.displacement.field_into(pressure, out)
    }

    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.estimate.field_into(displacement, out)
    }
}
