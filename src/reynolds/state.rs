//! The state of a contact.
//!
//! A solve starts from pressures and approach of the given state and overwrites all of it. `film`, `plastic_depth`,
//! `theta`, `mass` and `in_contact` follow from pressures and problem; in a converged state they satisfy the
//! equations to the tolerance.

use crate::error::InputError;
use crate::grid::Grid;

/// Pressures, film and approach of a contact; fields are row-major slices over the grid.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::reynolds::ContactState;
/// let grid = Grid::centred(8, 4, 1e-6, 1e-6)?;
/// let mut state = ContactState::new(&grid);
/// (state.pressure[5], state.fluid_pressure[5], state.in_contact[5]) = (3e8, 1e8, true);
/// assert_eq!(state.solid_pressure(5), 2e8);
/// assert!(state.validate(&Grid::centred(4, 4, 1e-6, 1e-6)?).is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactState {
    /// Total pressure, fluid plus solid \[Pa\].
    pub pressure: Vec<f64>,
    /// Fluid pressure \[Pa\].
    pub fluid_pressure: Vec<f64>,
    /// Film thickness (gap) with the plastic depth of this solve included \[m\].
    pub film: Vec<f64>,
    /// Plastic depth of this solve, not yet applied to any surface \[m\].
    pub plastic_depth: Vec<f64>,
    /// Film fraction `theta`: share of the gap filled with fluid, 1 under pressure.
    pub theta: Vec<f64>,
    /// `theta rho/rho_0 h`, for the squeeze term of a following transient solve \[m\].
    pub mass: Vec<f64>,
    /// Whether the node is in solid contact.
    pub in_contact: Vec<bool>,
    /// Approach of the undeformed bodies \[m\], positive towards each other.
    pub approach: f64,
}

impl Clone for ContactState {
    fn clone(&self) -> Self {
        Self {
            pressure: self.pressure.clone(),
            fluid_pressure: self.fluid_pressure.clone(),
            film: self.film.clone(),
            plastic_depth: self.plastic_depth.clone(),
            theta: self.theta.clone(),
            mass: self.mass.clone(),
            in_contact: self.in_contact.clone(),
            approach: self.approach,
        }
    }

    /// Copies into the existing buffers, so that solvers keep their best state without allocation.
    fn clone_from(&mut self, source: &Self) {
        self.pressure.clone_from(&source.pressure);
        self.fluid_pressure.clone_from(&source.fluid_pressure);
        self.film.clone_from(&source.film);
        self.plastic_depth.clone_from(&source.plastic_depth);
        self.theta.clone_from(&source.theta);
        self.mass.clone_from(&source.mass);
        self.in_contact.clone_from(&source.in_contact);
        self.approach = source.approach;
    }
}

impl ContactState {
    /// An unloaded state: no pressure, no approach.
    pub fn new(grid: &Grid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        Self {
            pressure: zeros(),
            fluid_pressure: zeros(),
            film: zeros(),
            plastic_depth: zeros(),
            theta: vec![1.0; grid.len()],
            mass: zeros(),
            in_contact: vec![false; grid.len()],
            approach: 0.0,
        }
    }

    /// Solid pressure of node `k`, total minus fluid, zero outside solid contact \[Pa\].
    pub fn solid_pressure(&self, k: usize) -> f64 {
        match (self.in_contact.get(k), self.pressure.get(k), self.fluid_pressure.get(k)) {
            (Some(true), Some(p), Some(f)) => (p - f).max(0.0),
            _ => 0.0,
        }
    }

    /// Checks that every field fits `grid` and film fractions are in 0..=1. Pressures that are NaN are accepted:
    /// solvers then start again.
    ///
    /// # Errors
    /// [`InputError`] naming the field.
    pub fn validate(&self, grid: &Grid) -> Result<(), InputError> {
        // Lengths, then film fractions.
        for (field, values) in [
            ("state.pressure", &self.pressure),
            ("state.fluid_pressure", &self.fluid_pressure),
            ("state.film", &self.film),
            ("state.plastic_depth", &self.plastic_depth),
            ("state.theta", &self.theta),
            ("state.mass", &self.mass),
        ] {
            InputError::require_len(field, values, grid.len())?;
        }
        if let Some(&theta) = self.theta.iter().find(|c| !(0.0..=1.0).contains(*c)) {
            InputError::require(false, "state.theta", theta, "from 0 to 1")?;
        }
        if self.in_contact.len() != grid.len() {
            return Err(InputError::Shape {
                field: "state.in_contact".to_owned(),
                expected: grid.len(),
                found: self.in_contact.len(),
            });
        }
        Ok(())
    }
}
