//! The temperature of the film in a contact.

use super::streams::Streams;
use super::{FilmSection, FilmThermal, SectionSolver};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{Lubricant, Rheology, Saturating};
use crate::reynolds::FilmFlows;
use crate::tribochem::{FlashTemperature, ThermalBody};

/// Passes over film and surfaces at most.
const MAX_PASSES: usize = 60;
/// Change of a temperature in the last pass, and what the split of the heat leaves, over the largest rise.
const TOLERANCE: f64 = 3e-4;
/// The same where nothing gets warm \[K\].
const LEAST_CHANGE: f64 = 1e-9;

/// A solved contact as its heat needs it; fields have one value a node.
#[derive(Debug, Clone, Copy)]
pub struct FilmFlow<'a> {
    /// The lubricant, its laws at the bulk temperature.
    pub lubricant: &'a Lubricant,
    /// Shear stress of the fluid.
    pub rheology: &'a Rheology,
    /// Pressure of the fluid \[Pa\].
    pub pressure: &'a [f64],
    /// Film thickness \[m\].
    pub film: &'a [f64],
    /// Flows through the cells, those that the contact was solved with.
    pub flows: &'a FilmFlows,
    /// Heat of solid friction \[W/m^2\].
    pub boundary_heat: &'a [f64],
    /// Mean speed of the surfaces and sliding speed, neither negative \[m/s\].
    pub speeds: (f64, f64),
    /// Temperature of the bodies far from the contact and of the oil that flows in \[K\].
    pub bulk_temperature: f64,
}

impl FilmFlow<'_> {
    /// Where a contact as published has an overlap there is no film.
    fn film_at(&self, k: usize) -> f64 {
        self.film[k].max(0.0)
    }

    /// What layers that move along x carry through node `k`, in a row of `nx`, and what those that turn back
    /// carry.
    fn streams(&self, k: usize, nx: usize) -> Streams {
        let (through, east) = (self.flows.through[k], &self.flows.east);
        let before = if k.is_multiple_of(nx) { east[k] } else { east[k - 1] };
        let after = if k % nx + 1 < nx { east[k] } else { before };
        let (speed, sliding) = self.speeds;
        let skew = if speed > 0.0 { sliding / speed } else { 0.0 };
        Streams::new(through - 0.5 * (before + after), through, skew)
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
///     flows: &flows,
///     boundary_heat: &none,
///     speeds: (1.0, 1.0),
///     bulk_temperature: 300.0,
/// })?;
/// // 0.1 Pa s at 1e6 1/s shears with 0.1 MPa, which makes 0.1 MW/m^2.
/// let area = grid.len() as f64 * grid.cell_area();
/// assert!((balance.generated / (1e5 * area) - 1.0).abs() < 0.01);
/// assert!(balance.is_converged() && balance.imbalance() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HeatBalance {
    /// Heat of shear, of flow by pressure, of compression and of solid friction \[W\].
    pub generated: f64,
    /// What goes into the two bodies \[W\].
    pub conducted: [f64; 2],
    /// What the flow carries out of the box \[W\].
    pub carried: f64,
    /// Passes over film and surfaces.
    pub passes: usize,
    /// Change of a temperature in the last pass, or what the split of the heat between the bodies leaves
    /// where that is more, over what is accepted.
    pub change: f64,
}

impl HeatBalance {
    /// Heat that comes from nowhere, over what comes and goes; zero without any.
    pub fn imbalance(&self) -> f64 {
        let [first, second] = self.conducted;
        let scale = [self.generated, first, second, self.carried].iter().map(|heat| heat.abs()).sum::<f64>();
        let gone = first + second + self.carried;
        if scale == 0.0 { 0.0 } else { (gone - self.generated).abs() / scale }
    }

    /// Whether film and surfaces agree.
    pub fn is_converged(&self) -> bool {
        self.change <= 1.0
    }
}

/// Temperatures of film and surfaces in a contact.
///
/// A node is a [`FilmSection`]. Sections of a row are connected by the heat that two streams carry,
/// `C = rho c (Q+ + Q-) / dx`: layers that move on, `Q+`, bring the mean temperature of the node upstream,
/// those that turn back, `Q-`, that of the node downstream, first order upwind. `Q+ - Q-` is the flow through
/// the section, what is entrained less what pressure drives back: in an inlet a small difference, for which
/// both must be those that the contact was solved with. The streams are those of a film of one viscosity.
///
/// What goes to the surfaces heats them as [`FlashTemperature::rises_through_film`] has it. Film and surfaces
/// are found in passes, one after the other, in which the surfaces of a node follow its heat in proportion.
///
/// Heat of the flow by pressure is the flow through a face times the drop of pressure over it, half to each
/// of its nodes; that of compression `T a_V Q dp/dx`. Left out: heat along the film by conduction, what the
/// flow across x carries, and that layers have temperatures of their own.
#[derive(Debug, Clone)]
pub struct FilmTemperature {
    /// The grid of the contact.
    grid: Grid,
    /// Thermal properties of the fluid.
    properties: FilmThermal,
    /// What solves a section.
    solver: SectionSolver,
    /// What heats the surfaces.
    flash: FlashTemperature,
    /// Mean temperature across the film \[K\].
    mean: Vec<f64>,
    /// Shear stress of the fluid \[Pa\].
    stress: Vec<f64>,
    /// Temperature of the viscosity that the flow by pressure has \[K\].
    flow_temperature: Vec<f64>,
    /// Rises of the surfaces \[K\].
    rises: [Vec<f64>; 2],
    /// Those of the pass under way \[K\].
    new_rises: [Vec<f64>; 2],
    /// Heat that leaves the film \[W/m^2\].
    conducted: Vec<f64>,
    /// Heat that goes into the surfaces: that of the film and that of solid friction \[W/m^2\].
    heat: Vec<f64>,
    /// Resistance of the film to heat \[K m^2/W\].
    resistance: Vec<f64>,
    /// Heat of the flow by pressure \[W/m^2\].
    pressure_heat: Vec<f64>,
    /// Heat of compression \[W/m^2\].
    compression: Vec<f64>,
    /// Whether the next call starts from films of the bulk temperature.
    is_cool: bool,
    /// Largest change of the mean temperature in the pass under way \[K\].
    moved: f64,
}

impl FilmTemperature {
    /// Plans for a contact on `grid` of a fluid between `bodies` whose surfaces move at `speeds` along x
    /// \[m/s\].
    ///
    /// # Errors
    /// A property out of range, a speed that is not finite.
    pub fn new(
        grid: &Grid,
        properties: FilmThermal,
        bodies: [ThermalBody; 2],
        speeds: [f64; 2],
    ) -> Result<Self, InputError> {
        properties.validate()?;
        let zeros = || vec![0.0; grid.len()];
        Ok(Self {
            grid: *grid,
            properties,
            solver: SectionSolver::new(properties.profile),
            flash: FlashTemperature::new(grid, bodies, speeds)?,
            mean: zeros(),
            stress: zeros(),
            flow_temperature: zeros(),
            rises: [zeros(), zeros()],
            new_rises: [zeros(), zeros()],
            conducted: zeros(),
            heat: zeros(),
            resistance: zeros(),
            pressure_heat: zeros(),
            compression: zeros(),
            is_cool: true,
            moved: 0.0,
        })
    }

    /// Mean temperature across the film \[K\].
    pub fn mean(&self) -> &[f64] {
        &self.mean
    }

    /// Shear stress of the film \[Pa\].
    pub fn stress(&self) -> &[f64] {
        &self.stress
    }

    /// Temperature at which the law has the viscosity of the flow by pressure: the mean one with a parabola
    /// \[K\].
    pub fn flow_temperature(&self) -> &[f64] {
        &self.flow_temperature
    }

    /// Forgets the last call: the next one begins with cool surfaces.
    pub fn forget(&mut self) {
        let [first, second] = &mut self.rises;
        for field in [first, second, &mut self.conducted, &mut self.heat] {
            field.fill(0.0);
        }
        self.is_cool = true;
    }

    /// Rises of the two surfaces above the bulk temperature \[K\].
    pub fn surface_rises(&self) -> [&[f64]; 2] {
        [&self.rises[0], &self.rises[1]]
    }

    /// Finds the temperatures of `flow`, from those of the last call. Allocates nothing.
    ///
    /// # Errors
    /// Fields that do not fit the grid or are not finite, a heat of solid friction below zero, a temperature
    /// that is not finite and positive.
    pub fn update(&mut self, flow: &FilmFlow<'_>) -> Result<HeatBalance, InputError> {
        self.check(flow)?;
        self.find_other_heat(flow);
        if self.is_cool {
            self.mean.fill(flow.bulk_temperature);
            self.is_cool = false;
        }
        let (mut passes, mut change) = (0, f64::INFINITY);
        let (mut generated, mut carried) = (0.0, 0.0);
        while passes < MAX_PASSES && change > 1.0 {
            self.moved = 0.0;
            (generated, carried) = self.heat_film(flow);
            for (k, heat) in self.heat.iter_mut().enumerate() {
                *heat = self.conducted[k] + flow.boundary_heat[k];
            }
            let [first, second] = &mut self.new_rises;
            let report = self.flash.rises_through_film(&self.heat, &self.resistance, [first, second])?;
            let moved = self.rises.iter().flatten().zip(self.new_rises.iter().flatten());
            let moved = moved.fold(self.moved, |largest, (old, new)| largest.max((new - old).abs()));
            change = moved.max(report.mismatch) / (TOLERANCE * report.maximum).max(LEAST_CHANGE);
            std::mem::swap(&mut self.rises, &mut self.new_rises);
            passes += 1;
        }
        let area = self.grid.cell_area();
        let conducted = self.flash.fluxes().map(|flux| flux.iter().sum::<f64>() * area);
        Ok(HeatBalance { generated: generated * area, conducted, carried: carried * area, passes, change })
    }

    fn check(&self, flow: &FilmFlow<'_>) -> Result<(), InputError> {
        for (field, values) in [
            ("pressure", flow.pressure),
            ("film", flow.film),
            ("flows.east", &flow.flows.east),
            ("flows.north", &flow.flows.north),
            ("flows.through", &flow.flows.through),
            ("boundary_heat", flow.boundary_heat),
        ] {
            self.grid.require_field(field, values)?;
        }
        for &heat in flow.boundary_heat {
            InputError::require_non_negative("boundary_heat", heat)?;
        }
        InputError::require_non_negative("speeds.0", flow.speeds.0)?;
        InputError::require_non_negative("speeds.1", flow.speeds.1)?;
        InputError::require_positive("bulk_temperature", flow.bulk_temperature)
    }

    /// Heat of the flow by pressure, of compression per temperature, and what else does not depend on
    /// temperature.
    fn find_other_heat(&mut self, flow: &FilmFlow<'_>) {
        let (nx, ny, n) = (self.grid.nx(), self.grid.ny(), self.grid.len());
        let (dx, dy) = (self.grid.dx(), self.grid.dy());
        self.pressure_heat.fill(0.0);
        for k in 0..n {
            if k % nx + 1 < nx {
                self.drive(
                    flow,
                    [k, k + 1],
                    flow.flows.east[k] / (cells_to_next(flow.flows, k % nx, nx) * dx),
                );
            }
            if k + nx < n {
                self.drive(
                    flow,
                    [k, k + nx],
                    flow.flows.north[k] / (cells_to_next(flow.flows, k / nx, ny) * dy),
                );
            }
            self.resistance[k] = flow.film_at(k) / self.properties.conductivity;
            let (before, after) = (k - usize::from(k % nx > 0), k + usize::from(k % nx + 1 < nx));
            let rise = (flow.pressure[after] - flow.pressure[before]) / (after - before) as f64;
            self.compression[k] = self.properties.expansivity * flow.flows.through[k] * rise / dx;
        }
    }

    /// Heat of a flow by pressure between two nodes, half to each: the flow over the distance \[m/s\] times
    /// the drop of pressure.
    fn drive(&mut self, flow: &FilmFlow<'_>, [k, o]: [usize; 2], driven: f64) {
        let made = driven * (flow.pressure[k] - flow.pressure[o]);
        self.pressure_heat[k] += 0.5 * made;
        self.pressure_heat[o] += 0.5 * made;
    }

    /// Temperatures of the film under the last ones of the surfaces; heat per area that is made and carried
    /// out, as sums over the nodes.
    fn heat_film(&mut self, flow: &FilmFlow<'_>) -> (f64, f64) {
        let nx = self.grid.nx();
        let (sliding, law) = (flow.speeds.1, Saturating::new(flow.lubricant.viscosity()));
        let per_flow = self.properties.heat_capacity / self.grid.dx();
        // As if all nodes were as warm for their heat as the warmest: no node follows more.
        let hottest = self.rises.iter().flatten().fold(0.0_f64, |largest, rise| largest.max(*rise));
        let most = hottest / self.heat.iter().fold(f64::MIN_POSITIVE, |largest, heat| largest.max(*heat));
        let (mut generated, mut carried) = (0.0, 0.0);
        for k in 0..self.grid.len() {
            let upstream = if k % nx == 0 { flow.bulk_temperature } else { self.mean[k - 1] };
            // What comes back into the box from behind it is as warm as what leaves it.
            let downstream = if k % nx + 1 == nx { upstream } else { self.mean[k + 1] };
            let streams = flow.streams(k, nx);
            let both = streams.along + streams.back;
            let share = if both > 0.0 { streams.along / both } else { 1.0 };
            let around = share * upstream + (1.0 - share) * downstream;
            let film = flow.film_at(k);
            let rises = [self.rises[0][k], self.rises[1][k]];
            let mean_rise = 0.5 * (rises[0] + rises[1]);
            let response = if self.heat[k] > 0.0 { (mean_rise / self.heat[k]).clamp(0.0, most) } else { 0.0 };
            let other_heat = (self.pressure_heat[k], self.compression[k] * around);
            let heat = self.solver.solve(&FilmSection {
                viscosity: &law,
                rheology: flow.rheology,
                conductivity: self.properties.conductivity,
                pressure: flow.pressure[k],
                film,
                sliding,
                surfaces: rises.map(|rise| flow.bulk_temperature + rise),
                response: (response, self.conducted[k]),
                other_heat,
                carried: (per_flow * both, around),
            });
            self.moved = self.moved.max((heat.mean - self.mean[k]).abs());
            (self.mean[k], self.stress[k], self.conducted[k]) = (heat.mean, heat.stress, heat.conducted);
            self.flow_temperature[k] = heat.flow_temperature;
            generated += heat.stress * sliding + other_heat.0 + other_heat.1 + flow.boundary_heat[k];
            carried += heat.carried;
        }
        (generated, carried)
    }
}

/// Cells over which the pressure drops between node `i` of `n` in a row and the next one: without pressures at the
/// edges of the box it is ambient half a cell beyond the outermost nodes.
fn cells_to_next(flows: &FilmFlows, i: usize, n: usize) -> f64 {
    if !flows.has_edge_pressure && (i == 0 || i + 2 == n) { 1.5 } else { 1.0 }
}
