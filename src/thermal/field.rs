//! The film temperature in a contact.

use super::streams::Streams;
use super::{FilmSection, FilmThermal, SectionSolver};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::{Lubricant, Rheology, Saturating};
use crate::reynolds::FilmFlows;
use crate::tribochem::{FlashTemperature, ThermalBody};

/// Largest number of passes over film and surfaces.
const MAX_PASSES: usize = 60;
/// Convergence tolerance, relative to the largest rise, of the temperature change in a pass and of the
/// heat-partition mismatch.
const TOLERANCE: f64 = 3e-4;
/// Absolute lower bound of that tolerance \[K\].
const LEAST_CHANGE: f64 = 1e-9;

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
    fn film_at(&self, k: usize) -> f64 {
        self.film[k].max(0.0)
    }

    /// Flow through node `k` in a row of `nx`: that of entrainment, and the whole flow \[m^2/s\].
    fn through(&self, k: usize, nx: usize) -> [f64; 2] {
        let (through, east) = (self.flows.through[k], &self.flows.east);
        let before = if k.is_multiple_of(nx) { east[k] } else { east[k - 1] };
        let after = if k % nx + 1 < nx { east[k] } else { before };
        [through - 0.5 * (before + after), through]
    }

    /// Forward and reverse flow through node `k`, in a row of `nx`.
    fn streams(&self, k: usize, nx: usize) -> Streams {
        let [entrained, through] = self.through(k, nx);
        let (speed, sliding) = self.speeds;
        Streams::new(entrained, through, if speed > 0.0 { sliding / speed } else { 0.0 })
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

/// Temperatures of film and surfaces in a contact.
///
/// Each node is a [`FilmSection`]. Sections of a row are coupled by two advecting streams,
/// `C = rho c (Q+ + Q-) / dx`, first-order upwind: forward flow `Q+` brings the temperature of the layers that move
/// forward at the upstream node, reverse flow `Q-` that of the layers that move backward at the downstream node.
/// Reverse flow turns in the hot middle of the film. `Q+ - Q-` is the flow through the section,
/// entrainment less pressure backflow. In an inlet it is a small difference, so both must be those of the
/// solved contact. The streams are those of a film of uniform viscosity.
///
/// Heat conducted to the surfaces raises their temperature by [`FlashTemperature::rises_through_film`]. Film
/// and surfaces are solved in alternating passes, in which the surface temperature of a node responds in
/// proportion to its heat.
///
/// The heat of pressure flow is the flow through a face times the pressure drop, half to each of its nodes.
/// The heat of compression is `T a_V Q dp/dx`. Not included: conduction along the film and advection by flow
/// across x. Advection cools all layers of a section alike.
#[derive(Debug, Clone)]
pub struct FilmTemperature {
    /// The grid of the contact.
    grid: Grid,
    /// Thermal properties of the fluid.
    properties: FilmThermal,
    /// Solver of film sections.
    solver: SectionSolver,
    /// Surface temperatures.
    flash: FlashTemperature,
    /// Mean temperature across the film \[K\].
    mean: Vec<f64>,
    /// Forward and reverse flow through each node.
    flows: Vec<Streams>,
    /// Temperatures of the layers that move forward and of those that move backward \[K\].
    streams: [Vec<f64>; 2],
    /// Sign of the sliding of the second surface against the first.
    sliding_sign: f64,
    /// Shear stress of the fluid \[Pa\].
    stress: Vec<f64>,
    /// Temperature at the effective viscosity of the pressure flow \[K\].
    flow_temperature: Vec<f64>,
    /// Temperature rises of the surfaces \[K\].
    rises: [Vec<f64>; 2],
    /// Rises of the current pass \[K\].
    new_rises: [Vec<f64>; 2],
    /// Heat conducted out of the film \[W/m^2\].
    conducted: Vec<f64>,
    /// Heat into the surfaces, from the film and from solid friction \[W/m^2\].
    heat: Vec<f64>,
    /// Thermal resistance of the film \[K m^2/W\].
    resistance: Vec<f64>,
    /// Heat of the pressure flow \[W/m^2\].
    pressure_heat: Vec<f64>,
    /// Heat of compression per temperature \[W/(m^2 K)\].
    compression: Vec<f64>,
    /// Whether the next call starts from the bulk temperature.
    is_cool: bool,
    /// Largest change of the mean temperature in the current pass \[K\].
    moved: f64,
}

impl FilmTemperature {
    /// Heat problem of a fluid on `grid` between `bodies` whose surfaces move at `speeds` along x \[m/s\].
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
            flows: vec![Streams { along: 0.0, back: 0.0 }; grid.len()],
            streams: [zeros(), zeros()],
            sliding_sign: if speeds[1] < speeds[0] { -1.0 } else { 1.0 },
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

    /// Temperature at the effective viscosity of the pressure flow \[K\].
    pub fn flow_temperature(&self) -> &[f64] {
        &self.flow_temperature
    }

    /// Discards the last solution: the next call starts from the bulk temperature.
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

    /// Computes the temperatures of `flow`, starting from those of the last call. Allocates nothing.
    ///
    /// # Errors
    /// Fields that do not fit the grid or are not finite, a heat of solid friction below zero, a temperature
    /// that is not finite and positive.
    pub fn update(&mut self, flow: &FilmFlow<'_>) -> Result<HeatBalance, InputError> {
        self.check(flow)?;
        self.find_other_heat(flow);
        if self.is_cool {
            let [forward, backward] = &mut self.streams;
            for field in [&mut self.mean, forward, backward] {
                field.fill(flow.bulk_temperature);
            }
            self.is_cool = false;
        }
        let (mut passes, mut change) = (0, f64::INFINITY);
        let (mut generated, mut carried) = (0.0, 0.0);
        // film under the surface temperatures, then surfaces under the heat of the film
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
            let film = self.mean.iter().fold(0.0_f64, |most, mean| most.max(mean - flow.bulk_temperature));
            change = moved.max(report.mismatch) / (TOLERANCE * report.maximum.max(film)).max(LEAST_CHANGE);
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

    /// Streams, heat of pressure flow, heat of compression per temperature, and thermal resistance; independent of
    /// temperature.
    fn find_other_heat(&mut self, flow: &FilmFlow<'_>) {
        let (nx, ny, n) = (self.grid.nx(), self.grid.ny(), self.grid.len());
        let (dx, dy) = (self.grid.dx(), self.grid.dy());
        let is_strip = self.grid.is_strip();
        let rows_to_next = |j: usize| if is_strip { 1.0 } else { cells_to_next(flow.flows, j, ny) };
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
                self.drive(flow, [k, k + nx], flow.flows.north[k] / (rows_to_next(k / nx) * dy));
            }
            self.flows[k] = flow.streams(k, nx);
            self.resistance[k] = flow.film_at(k) / self.properties.conductivity;
            let (before, after) = (k - usize::from(k % nx > 0), k + usize::from(k % nx + 1 < nx));
            let rise = (flow.pressure[after] - flow.pressure[before]) / (after - before) as f64;
            self.compression[k] = self.properties.expansivity * flow.flows.through[k] * rise / dx;
        }
    }

    /// Adds the heat of pressure flow between two nodes, half to each: flow over distance \[m/s\] times
    /// pressure drop.
    fn drive(&mut self, flow: &FilmFlow<'_>, [k, o]: [usize; 2], driven: f64) {
        let made = driven * (flow.pressure[k] - flow.pressure[o]);
        self.pressure_heat[k] += 0.5 * made;
        self.pressure_heat[o] += 0.5 * made;
    }

    /// Flow into node `k` along x by both streams \[m^2/s\], and its temperature \[K\].
    fn inflow(&self, flow: &FilmFlow<'_>, k: usize) -> (f64, f64) {
        let nx = self.grid.nx();
        let own = self.flows[k];
        let (along, upstream) = match k % nx {
            0 => (own.along, flow.bulk_temperature),
            _ => (self.flows[k - 1].along, self.streams[0][k - 1]),
        };
        // Inflow from behind the box has the temperature of the outflow.
        let (back, downstream) = match k % nx + 1 {
            last if last == nx => (own.back, upstream),
            _ => (self.flows[k + 1].back, self.streams[1][k + 1]),
        };
        let both = along + back;
        let share = if both > 0.0 { along / both } else { 1.0 };
        (both, share * upstream + (1.0 - share) * downstream)
    }

    /// Velocity in the film of node `k`, see [`FilmSection::velocity`]; in units of the mean speed.
    fn velocity(&self, flow: &FilmFlow<'_>, k: usize) -> [f64; 3] {
        let [entrained, through] = flow.through(k, self.grid.nx());
        let (speed, sliding) = flow.speeds;
        if entrained > 0.0 && speed > 0.0 {
            [1.0, self.sliding_sign * sliding / speed, 1.0 - through / entrained]
        } else {
            [0.0, 0.0, -through.signum()]
        }
    }

    /// Film temperatures under the current surface temperatures; returns generated and advected heat per
    /// area, summed over the nodes.
    fn heat_film(&mut self, flow: &FilmFlow<'_>) -> (f64, f64) {
        let (sliding, law) = (flow.speeds.1, Saturating::new(flow.lubricant.viscosity()));
        let per_flow = self.properties.heat_capacity / self.grid.dx();
        // Upper bound of the surface response: the ratio of the largest rise to the largest heat.
        let hottest = self.rises.iter().flatten().fold(0.0_f64, |largest, rise| largest.max(*rise));
        let most = hottest / self.heat.iter().fold(f64::MIN_POSITIVE, |largest, heat| largest.max(*heat));
        let (mut generated, mut carried) = (0.0, 0.0);
        for k in 0..self.grid.len() {
            let (both, around) = self.inflow(flow, k);
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
                theta: flow.theta[k],
                sliding,
                surfaces: rises.map(|rise| flow.bulk_temperature + rise),
                response: (response, self.conducted[k]),
                other_heat,
                carried: (per_flow * both, around),
                velocity: self.velocity(flow, k),
            });
            self.moved = self.moved.max((heat.mean - self.mean[k]).abs());
            (self.mean[k], self.stress[k], self.conducted[k]) = (heat.mean, heat.stress, heat.conducted);
            self.flow_temperature[k] = heat.flow_temperature;
            (self.streams[0][k], self.streams[1][k]) = (heat.streams[0], heat.streams[1]);
            generated += heat.stress * sliding + other_heat.0 + other_heat.1 + flow.boundary_heat[k];
            carried += heat.carried;
        }
        (generated, carried)
    }
}

/// Distance, in cells, of the pressure drop between node `i` of `n` in a row and the next one. Without pressures at the
/// edges of the box it is ambient half a cell beyond the outermost nodes.
fn cells_to_next(flows: &FilmFlows, i: usize, n: usize) -> f64 {
    if !flows.has_edge_pressure && (i == 0 || i + 2 == n) { 1.5 } else { 1.0 }
}
