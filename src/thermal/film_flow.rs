//! The heat problem of a solved contact: its input and the heat balance of its solution.

use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{Lubricant, Rheology};
use crate::reynolds::FilmFlows;

/// Input of the heat problem of a solved contact; fields have one value per node.
#[derive(Debug, Clone, Copy)]
pub struct FilmFlow<'a> {
    /// The lubricant, with its laws at the bulk temperature.
    pub lubricant: &'a Lubricant,
    /// Shear stress of the fluid.
    pub rheology: &'a Rheology,
    /// Pressure of the fluid \[Pa\].
    pub pressure: &'a [f64],
    /// Film thickness \[m\].
    pub film: &'a [f64],
    /// Film fraction, 1 under pressure: the filled share of a cavitated cell is sheared.
    pub theta: &'a [f64],
    /// Flows through the cells, from the solution of the contact.
    pub flows: &'a FilmFlows,
    /// Heat of solid friction \[W/m^2\].
    pub boundary_heat: &'a [f64],
    /// Mean speed of the surfaces and sliding speed, both non-negative \[m/s\].
    pub speeds: (f64, f64),
    /// Temperature of the bodies far from the contact and of the inflowing oil \[K\].
    pub bulk_temperature: f64,
}

impl FilmFlow<'_> {
    /// The film; zero for overlaps, which the unified Reynolds model can have.
    pub(super) fn film_at(&self, k: usize) -> f64 {
        self.film[k].max(0.0)
    }

    /// Flow through node `k` in a row of `nx`: that of entrainment, and the whole flow \[m^2/s\].
    pub(super) fn through(&self, k: usize, nx: usize) -> [f64; 2] {
        let (through, east) = (self.flows.through[k], &self.flows.east);
        let before = if k.is_multiple_of(nx) { east[k] } else { east[k - 1] };
        let after = if k % nx + 1 < nx { east[k] } else { before };
        [through - 0.5 * (before + after), through]
    }

    /// Checks fields on `grid`, heats and speeds.
    pub(super) fn validate(&self, grid: &Grid) -> Result<(), InputError> {
        for (field, values) in [
            ("pressure", self.pressure),
            ("film", self.film),
            ("flows.east", &self.flows.east),
            ("flows.north", &self.flows.north),
            ("flows.through", &self.flows.through),
            ("boundary_heat", self.boundary_heat),
        ] {
            grid.require_field(field, values)?;
        }
        for &heat in self.boundary_heat {
            InputError::require_non_negative("boundary_heat", heat)?;
        }
        InputError::require_non_negative("speeds.0", self.speeds.0)?;
        InputError::require_non_negative("speeds.1", self.speeds.1)?;
        InputError::require_positive("bulk_temperature", self.bulk_temperature)
    }
}

/// Heat of a contact.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant, Rheology};
/// use stribeck::reynolds::FilmFlows;
/// use stribeck::thermal::{FilmFlow, FilmTemperature, FilmThermal};
/// use stribeck::tribochem::ThermalBody;
/// let grid = Grid::centred(16, 16, 1e-5, 1e-5)?;
/// let (fluid, none) = (Lubricant::new(Barus::new(0.1, 0.0)?, Incompressible), vec![0.0; grid.len()]);
/// let bodies = [ThermalBody::STEEL; 2];
/// let mut flows = FilmFlows::default();
/// flows.resize(grid.len());
/// flows.through.fill(1e-6); // 1 um at 1 m/s
/// let mut temperature = FilmTemperature::new(&grid, FilmThermal::default(), bodies, [1.5, 0.5])?;
/// let balance = temperature.update(&FilmFlow {
///     lubricant: &fluid,
///     rheology: &Rheology::newtonian(),
///     pressure: &none,
///     film: &vec![1e-6; grid.len()],
///     theta: &vec![1.0; grid.len()],
///     flows: &flows,
///     boundary_heat: &none,
///     speeds: (1.0, 1.0),
///     bulk_temperature: 300.0,
/// })?;
/// // 0.1 Pa s at 1e6 1/s: a stress of 0.1 MPa and 0.1 MW/m^2 of heat.
/// let area = grid.len() as f64 * grid.cell_area();
/// assert!((balance.generated / (1e5 * area) - 1.0).abs() < 0.01);
/// assert!(balance.is_converged() && balance.imbalance() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HeatBalance {
    /// Heat of shear, pressure flow, compression and solid friction \[W\].
    pub generated: f64,
    /// Heat conducted into the two bodies \[W\].
    pub conducted: [f64; 2],
    /// Heat advected out of the box \[W\].
    pub carried: f64,
    /// Passes over film and surfaces.
    pub passes: usize,
    /// Convergence measure: the larger of the temperature change in the last pass and the mismatch of the
    /// heat partition, over the tolerance.
    pub change: f64,
}

impl HeatBalance {
    /// Relative energy imbalance: generated heat less conducted and advected heat, over the sum of
    /// magnitudes; zero without heat.
    pub fn imbalance(&self) -> f64 {
        let [first, second] = self.conducted;
        let scale = [self.generated, first, second, self.carried].iter().map(|heat| heat.abs()).sum::<f64>();
        let gone = first + second + self.carried;
        if scale == 0.0 { 0.0 } else { (gone - self.generated).abs() / scale }
    }

    /// Whether film and surface temperatures have converged.
    pub fn is_converged(&self) -> bool {
        self.change <= 1.0
    }
}
