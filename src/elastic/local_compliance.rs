//! Bodies whose nodes give way each by itself too: springs between what presses and the bodies below.

use super::{DeformationModel, ResponseApproximations};
use crate::error::InputError;
use crate::grid::Grid;

/// Bodies with a compliance of each node of its own, such as that of a thin [`BondedFilm`](super::BondedFilm)
/// whose thickness is a field: `u = K p + c p` with the displacement `K p` of the bodies `M` and the field
/// `c` \[m/Pa\], row-major on their grid, zero or more everywhere.
///
/// Exact in [`displacement`](DeformationModel::displacement). Where one number has to stand for all nodes, in
/// the self-influence `influence(0, 0)`, in estimated pressures and on other grids, it is
/// [`typical`](WithLocalCompliance::typical). Without a compliance, or with one of zeros, this is `M` to the
/// last bit, at its cost.
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
    /// What the compliance adds to.
    bodies: M,
    /// `c` \[m/Pa\].
    compliance: Vec<f64>,
    /// The compliance that stands for all; zero where there is none.
    typical: f64,
}

impl<M: DeformationModel> WithLocalCompliance<M> {
    /// `bodies` without a compliance of their nodes.
    pub fn new(bodies: M) -> Self {
        Self { compliance: Vec::new(), typical: 0.0, bodies }
    }

    /// Takes `compliance` \[m/Pa\], one value a node, in place of that before.
    ///
    /// # Errors
    /// A slice that does not fit the grid, a value below zero or not finite.
    pub fn set_compliance(&mut self, compliance: &[f64]) -> Result<(), InputError> {
        InputError::require_len("compliance", compliance, self.grid().len())?;
        for &value in compliance {
            InputError::require_non_negative("compliance", value)?;
        }
        let (mut sum, mut squares) = (0.0, 0.0);
        let largest = compliance.iter().fold(0.0_f64, |largest, value| largest.max(*value));
        // In units of the largest: squares of compliances are small numbers.
        for share in compliance.iter().map(|value| value / largest) {
            sum += share;
            squares += share * share;
        }
        self.set(compliance.iter().copied(), if largest > 0.0 { largest * (squares / sum) } else { 0.0 });
        Ok(())
    }

    /// Takes over values and what stands for them.
    fn set(&mut self, compliance: impl Iterator<Item = f64>, typical: f64) {
        self.compliance.clear();
        self.compliance.extend(compliance);
        self.typical = typical;
        if let Some(approximations) = self.bodies.approximations() {
            approximations.soften(typical);
        }
    }

    /// The bodies below.
    pub fn bodies(&self) -> &M {
        &self.bodies
    }

    /// Mean of the compliance, weighted with itself \[m/Pa\]: that of the film where nodes have one.
    pub fn typical(&self) -> f64 {
        self.typical
    }

    /// Adds `c p` to displacements.
    fn add(&self, pressure: &[f64], out: &mut [f64]) {
        for ((u, p), c) in out.iter_mut().zip(pressure).zip(&self.compliance) {
            *u += c * p;
        }
    }

    /// Whether this is more than the bodies.
    fn is_soft(&self) -> bool {
        self.typical > 0.0
    }
}

impl<M: DeformationModel> DeformationModel for WithLocalCompliance<M> {
    fn grid(&self) -> Grid {
        self.bodies.grid()
    }

    fn displacement(&mut self, pressure: &[f64], out: &mut [f64]) -> Result<(), InputError> {
        self.bodies.displacement(pressure, out)?;
        if self.is_soft() {
            self.add(pressure, out);
        }
        Ok(())
    }

    fn influence(&self, di: usize, dj: usize) -> f64 {
        let bodies = self.bodies.influence(di, dj);
        if di + dj == 0 { bodies + self.typical } else { bodies }
    }

    fn self_influence(&self, node: usize) -> f64 {
        let bodies = self.bodies.self_influence(node);
        self.compliance.get(node).map_or(bodies, |c| bodies + c)
    }

    fn on_grid(&self, grid: Grid) -> Option<Box<dyn DeformationModel>> {
        let bodies = self.bodies.on_grid(grid)?;
        if !self.is_soft() {
            return Some(bodies);
        }
        let mut soft = WithLocalCompliance::new(bodies);
        soft.set(std::iter::repeat_n(self.typical, grid.len()), self.typical);
        Some(Box::new(soft))
    }

    fn approximations(&mut self) -> Option<&mut dyn ResponseApproximations> {
        if !self.is_soft() {
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
