//! The film temperature in a contact.

use super::advection::LayerAdvection;
use super::collocation::POINTS;
use super::film_flow::{FilmFlow, HeatBalance};
use super::{FilmSection, FilmThermal, SectionSolver};
use crate::error::InputError;
use crate::grid::Grid;
use crate::lubricant::Saturating;
use crate::reynolds::FilmFlows;
use crate::tribochem::{FlashTemperature, ThermalBody};

/// Largest number of passes over film and surfaces.
const MAX_PASSES: usize = 60;
/// Convergence tolerance, relative to the largest rise, of the temperature change in a pass and of the
/// heat-partition mismatch.
const TOLERANCE: f64 = 3e-4;
/// Absolute lower bound of that tolerance \[K\].
const LEAST_CHANGE: f64 = 1e-9;

/// Temperatures of film and surfaces in a contact.
///
/// Each node is a [`FilmSection`] of eight layers. Each layer carries its own heat along x, first-order upwind: the
/// layers in the middle of an inlet turn back and are the hot ones. The flow through the section is that of the solved
/// contact, entrainment less pressure backflow, since it is the small difference of both in an inlet. The velocity profile
/// is that of a uniform viscosity; its change along x moves heat from layer to layer.
///
/// Heat conducted to the surfaces raises their temperature by [`FlashTemperature::rises_through_film`]. Film
/// and surfaces are solved in alternating passes, in which the surface temperature of a node responds in
/// proportion to its heat.
///
/// The heat of pressure flow is the flow through a face times the pressure drop, half to each of its nodes.
/// The heat of compression is `T a_V Q dp/dx` in each layer. Not included: conduction along the film and advection by
/// flow along y.
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
    /// Flow of the layers along x \[m^2/s\]; their mean is the flow through the node.
    flows: Vec<[f64; POINTS]>,
    /// Temperatures of the layers \[K\].
    layers: Vec<[f64; POINTS]>,
    /// Fluidities of the layers over their mean, the first estimates of the next pass.
    fluidity: Vec<[f64; POINTS]>,
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
    /// Heat of compression per temperature and flow \[J/(m^3 K) over m\].
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
            flows: vec![[0.0; POINTS]; grid.len()],
            layers: vec![[0.0; POINTS]; grid.len()],
            fluidity: vec![[1.0; POINTS]; grid.len()],
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
        self.fluidity.fill([1.0; POINTS]);
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
        flow.validate(&self.grid)?;
        self.find_other_heat(flow);
        if self.is_cool {
            self.mean.fill(flow.bulk_temperature);
            self.layers.fill([flow.bulk_temperature; POINTS]);
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

    /// Heat of pressure flow, layer flows, resistances and compression, which do not depend on the surface
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
            if let Some(north) = self.grid.north_of(k) {
                self.drive(flow, [k, north], flow.flows.north[k] / (rows_to_next(k / nx) * dy));
            }
            self.flows[k] = self.layer_flow(flow, k);
            self.resistance[k] = flow.film_at(k) / self.properties.conductivity;
            let (before, after) = (k - usize::from(k % nx > 0), k + usize::from(k % nx + 1 < nx));
            let rise = (flow.pressure[after] - flow.pressure[before]) / (after - before) as f64;
            self.compression[k] = self.properties.expansivity * rise / dx;
        }
    }

    /// Adds the heat of pressure flow between two nodes, half to each: flow over distance \[m/s\] times
    /// pressure drop.
    fn drive(&mut self, flow: &FilmFlow<'_>, [k, o]: [usize; 2], driven: f64) {
        let made = driven * (flow.pressure[k] - flow.pressure[o]);
        self.pressure_heat[k] += 0.5 * made;
        self.pressure_heat[o] += 0.5 * made;
    }

    /// Flow of the layers of node `k` along x \[m^2/s\].
    fn layer_flow(&self, flow: &FilmFlow<'_>, k: usize) -> [f64; POINTS] {
        let [entrained, through] = flow.through(k, self.grid.nx());
        let (speed, sliding) = flow.speeds;
        let skew = if speed > 0.0 { self.sliding_sign * sliding / speed } else { 0.0 };
        let entrained = entrained.max(0.0);
        self.solver.velocity([entrained, entrained * skew, entrained - through])
    }

    /// Advection in the layers of node `k`.
    fn advection(&self, flow: &FilmFlow<'_>, k: usize) -> LayerAdvection {
        let nx = self.grid.nx();
        let bulk = [flow.bulk_temperature; POINTS];
        let per_flow = self.properties.heat_capacity / self.grid.dx();
        let (is_first, is_last) = (k.is_multiple_of(nx), k % nx + 1 == nx);
        let (before, after) = (if is_first { k } else { k - 1 }, if is_last { k } else { k + 1 });
        let upstream = if is_first { &bulk } else { &self.layers[before] };
        // Inflow from behind the box has the temperature of the outflow.
        let downstream = if is_last { upstream } else { &self.layers[after] };
        self.solver.advection(per_flow, [before, k, after].map(|at| &self.flows[at]), [upstream, downstream])
    }

    /// Film temperatures under the current surface temperatures; returns generated and advected heat per
    /// area, summed over the nodes.
    fn heat_film(&mut self, flow: &FilmFlow<'_>) -> (f64, f64) {
        let law = Saturating::new(flow.lubricant.viscosity());
        // Upper bound of the surface response: the ratio of the largest rise to the largest heat.
        let hottest = self.rises.iter().flatten().fold(0.0_f64, |largest, rise| largest.max(*rise));
        let most = hottest / self.heat.iter().fold(f64::MIN_POSITIVE, |largest, heat| largest.max(*heat));
        // nodes with reversed layers against the flow, then all nodes along it
        for k in (0..self.grid.len()).rev() {
            if self.flows[k].iter().any(|layer| *layer < 0.0) {
                let _ = self.heat_node(flow, &law, most, k);
            }
        }
        (0..self.grid.len()).fold((0.0, 0.0), |(generated, carried), k| {
            let (made, taken) = self.heat_node(flow, &law, most, k);
            (generated + made + flow.boundary_heat[k], carried + taken)
        })
    }

    /// Film temperatures of node `k`, with at most the surface response `most`; returns the heat that its film generates
    /// and that it advects per area.
    fn heat_node(&mut self, flow: &FilmFlow<'_>, law: &Saturating<'_>, most: f64, k: usize) -> (f64, f64) {
        let (film, sliding) = (flow.film_at(k), flow.speeds.1);
        let rises = [self.rises[0][k], self.rises[1][k]];
        let mean_rise = 0.5 * (rises[0] + rises[1]);
        let response = if self.heat[k] > 0.0 { (mean_rise / self.heat[k]).clamp(0.0, most) } else { 0.0 };
        let compression: [f64; POINTS] =
            std::array::from_fn(|i| self.compression[k] * self.flows[k][i] * self.layers[k][i]);
        let section = FilmSection {
            viscosity: law,
            rheology: flow.rheology,
            conductivity: self.properties.conductivity,
            pressure: flow.pressure[k],
            film,
            theta: flow.theta[k],
            sliding,
            surfaces: rises.map(|rise| flow.bulk_temperature + rise),
            response: (response, self.heat[k] - flow.boundary_heat[k]),
            pressure_heat: self.pressure_heat[k],
            compression,
            advection: self.advection(flow, k),
        };
        let heat = self.solver.solve_from(&section, &mut self.fluidity[k]);
        self.moved = self.moved.max((heat.mean - self.mean[k]).abs());
        (self.mean[k], self.stress[k], self.conducted[k]) = (heat.mean, heat.stress, heat.conducted);
        self.flow_temperature[k] = heat.flow_temperature;
        self.layers[k] = heat.layers;
        let generated = heat.stress * sliding + self.pressure_heat[k] + self.solver.mean(&compression);
        (generated, heat.carried)
    }
}

/// Distance, in cells, of the pressure drop between node `i` of `n` in a row and the next one. Without pressures at the
/// edges of the box it is ambient half a cell beyond the outermost nodes.
fn cells_to_next(flows: &FilmFlows, i: usize, n: usize) -> f64 {
    if !flows.has_edge_pressure && (i == 0 || i + 2 == n) { 1.5 } else { 1.0 }
}
