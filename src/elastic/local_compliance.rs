//! Bodies with an additional local compliance at each node, as if springs covered their surface.

use super::{DeformationModel, ResponseApproximations};
use crate::error::InputError;
use crate::grid::Grid;

/// Bodies with a local compliance at each node, such as that of a thin [`BondedFilm`](super::BondedFilm) of
/// variable thickness: `u = K p + c p` with the displacement `K p` of the bodies `M` and the field `c`
/// \[m/Pa\], non-negative and row-major on their grid.
///
/// [`displacement`](DeformationModel::displacement) is exact. The self-influence `influence(0, 0)`, the
/// estimated pressure and the body on another grid use one value for all nodes, the
/// [`mean_compliance`](WithLocalCompliance::mean_compliance). Without a compliance, or with zeros only,
/// results and cost are those of `M` to the last bit.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::elastic::{BondedFilm, DeformationModel, HalfSpace, WithLocalCompliance};
/// let grid = Grid::centred(8, 8, 1e-6, 1e-6)?;
/// let mut body = WithLocalCompliance::new(HalfSpace::new(grid, 230e9)?);
/// let film = BondedFilm::new([30e9, 0.3], [210e9, 0.3])?;
/// let thickness: Vec<f64> = (0..64).map(|k| 1e-9 * f64::from(k)).collect();
/// let compliance: Vec<f64> = thickness.iter().map(|h| h * film.compliance()).collect();
/// body.set_compliance(&compliance)?;
/// let (pressure, mut bare, mut coated) = ([1e9; 64], [0.0; 64], [0.0; 64]);
/// body.displacement(&pressure, &mut coated)?;
/// HalfSpace::new(grid, 230e9)?.displacement(&pressure, &mut bare)?;
/// assert!((coated[63] - bare[63] - 63.0 * film.compliance()).abs() < 1e-18);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct WithLocalCompliance<M> {
    /// The bodies to which the compliance is added.
    bodies: M,
    /// `c` \[m/Pa\].
    compliance: Vec<f64>,
    /// Mean compliance \[m/Pa\]; zero without a compliance.
    mean_compliance: f64,
}

impl<M: DeformationModel> WithLocalCompliance<M> {
    /// `bodies` without a local compliance.
    pub fn new(bodies: M) -> Self {
        Self { compliance: Vec::new(), mean_compliance: 0.0, bodies }
    }

    /// Replaces the compliance \[m/Pa\], one value for each node.
    ///
    /// # Errors
    /// A slice that does not fit the grid, a value that is negative or not finite.
    pub fn set_compliance(&mut self, compliance: &[f64]) -> Result<(), InputError> {
        InputError::require_len("compliance", compliance, self.grid().len())?;
        for &value in compliance {
            InputError::require_non_negative("compliance", value)?;
        }
        let (mut sum, mut squares) = (0.0, 0.0);
        let largest = compliance.iter().fold(0.0_f64, |largest, value| largest.max(*value));
        // The sums are scaled by the largest value: squares of compliances would underflow.
        for share in compliance.iter().map(|value| value / largest) {
            sum += share;
            squares += share * share;
        }
        self.set(compliance.iter().copied(), if largest > 0.0 { largest * (squares / sum) } else { 0.0 });
        Ok(())
    }

    /// Stores the values and passes their mean on to the approximations of the bodies.
    fn set(&mut self, compliance: impl Iterator<Item = f64>, mean_compliance: f64) {
        self.compliance.clear();
        self.compliance.extend(compliance);
        self.mean_compliance = mean_compliance;
        if let Some(approximations) = self.bodies.approximations() {
            approximations.set_mean_compliance(mean_compliance);
        }
    }

    /// The elastic bodies without the local compliance.
    pub fn bodies(&self) -> &M {
        &self.bodies
    }

    /// Mean of the compliance weighted with itself, `sum(c^2)/sum(c)` \[m/Pa\]: the typical value of covered
    /// nodes.
    pub fn mean_compliance(&self) -> f64 {
        self.mean_compliance
    }

    /// Adds `c p` to the displacements `out`.
    fn add(&self, pressure: &[f64], out: &mut [f64]) {
        for ((u, p), c) in out.iter_mut().zip(pressure).zip(&self.compliance) {
            *u += c * p;
        }
    }

    /// Whether any node has a compliance.
    fn has_compliance(&self) -> bool {
        self.mean_compliance > 0.0
    }
}

impl<M: DeformationModel> DeformationModel for WithLocalCompliance<M> {
    fn grid(&self) -> Grid {
        self.bodies.grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.bodies.displacement(pressure, out)?;
        if self.has_compliance() {
            self.add(pressure, out);
        }
        Ok(())
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        let bodies = self.bodies.influence(di, dj);
        if di + dj == 0 { bodies + self.mean_compliance } else { bodies }
    }

    fn self_influence(&self, node: usize) -> f64 {
        let bodies = self.bodies.self_influence(node);
        self.compliance.get(node).map_or(bodies, |c| bodies + c)
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let bodies = self.bodies.on_grid(grid)?;
        if !self.has_compliance() {
            return Some(bodies);
        }
        let mut soft = WithLocalCompliance::new(bodies);
        soft.set(std::iter::repeat_n(self.mean_compliance, grid.len()), self.mean_compliance);
        Some(Box::new(soft))
    }

    fn must_stop(&self) -> bool {
        self.bodies.must_stop()
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        if !self.has_compliance() {
            return self.bodies.approximations();
        }
        self.bodies.approximations().is_some().then_some(self)
    }
}

impl<M: DeformationModel> ResponseApproximations for WithLocalCompliance<M> {
    fn displacement_single(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        (&mut self.bodies as &mut dyn DeformationModel).displacement_single(pressure, out)?;
        self.add(pressure, out);
        Ok(())
    }

    fn displacement_periodic(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        (&mut self.bodies as &mut dyn DeformationModel).displacement_periodic(pressure, out)?;
        self.add(pressure, out);
        Ok(())
    }

    fn pressure_estimate(&mut self, displacement: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        (&mut self.bodies as &mut dyn DeformationModel).pressure_estimate(displacement, out)
    }
}
