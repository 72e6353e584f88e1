//! Flash temperature of two bodies in sliding contact.
//!
//! The coefficients depend on grid, bodies and speeds; a history computes new ones when these change.
//! `moving_source` computes the coefficients, `heat_partition` the partition of the heat.

use std::f64::consts::PI;
use std::sync::Arc;

use super::ThermalBody;
use super::heat_partition::PartitionSolver;
use super::moving_source::MovingSource;
use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::{Convolution, ConvolutionPlan};

/// Temperature mismatch between the bodies at convergence, relative to the largest rise.
const TOLERANCE: f64 = 1e-4;

/// Outcome of a flash-temperature evaluation.
///
/// # Examples
///
/// ```
/// use stribeck::Grid;
/// use stribeck::tribochem::{FlashTemperature, ThermalBody};
/// let grid = Grid::centred(32, 32, 1e-5, 1e-5)?;
/// let mut flash = FlashTemperature::new(&grid, [ThermalBody::STEEL; 2], [1.0, 0.5])?;
/// let flux: Vec<f64> = grid.nodes().map(|(x, y)| if x.hypot(y) < 1e-4 { 1e7 } else { 0.0 }).collect();
/// let mut rise = vec![0.0; grid.len()];
/// let report = flash.rise(&flux, &mut rise)?;
/// assert!(report.maximum > 1.0 && report.mismatch < 1e-3 * report.maximum);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[must_use]
#[non_exhaustive]
pub struct FlashReport {
    /// Largest rise \[K\].
    pub maximum: f64,
    /// Largest temperature difference between the two bodies at heated nodes \[K\].
    pub mismatch: f64,
    /// Iterations of the heat partition.
    pub iterations: usize,
}

/// Steady surface temperature rise of two half-spaces in sliding contact, heated where they touch.
///
/// Body `b` moves at `V_b` along x. Its rise under the heat flux `q_b` \[W/m^2\] into it is
///
/// `T_b(x, y) = int q_b exp[-(|V_b| r - V_b X) / (2 kappa_b)] / (2 pi k_b r) dx' dy'`,
/// `X = x - x'`, `r^2 = X^2 + (y - y')^2`,
///
/// computed by zero-padded FFT convolution over cells of uniform flux with exactly integrated coefficients,
/// without periodic images and with the zero mode. The friction heat `q = q_1 + q_2` is partitioned such that
/// `T_1 = T_2` at every heated node (`q > 0`), by iteration from the initial guess
/// `q_1 = q T_2[q] / (T_1[q] + T_2[q])`; equal bodies at equal speeds need no iteration. The quotient of
/// spectra `G_1 G_2 / (G_1 + G_2)` is not used: it would let heat cross the gap where the bodies do not
/// touch, and it is not exact for truncated kernels.
///
/// Valid for heat that varies slowly compared with the transit time of the contact, and for contacts small
/// compared with the bodies. Memory: about 20 fields and three padded spectra. Cost per call: four convolutions, one in
/// single precision, and about one more in single precision per iteration (3 to 12, on any grid).
///
/// Sources: Jaeger (1942), moving sources of heat; Carslaw and Jaeger (1959), Conduction of Heat in Solids;
/// the two-body idea by FFT: Gao, Lee, Ai, Nixon (2000), Journal of Tribology 122.
///
/// ```
/// use stribeck::Grid;
/// use stribeck::tribochem::{FlashTemperature, ThermalBody};
/// let grid = Grid::centred(32, 32, 1e-5, 1e-5)?;
/// let mut flash = FlashTemperature::new(&grid, [ThermalBody::STEEL; 2], [0.0, 0.0])?;
/// let disc: Vec<f64> = grid.nodes().map(|(x, y)| if x.hypot(y) < 1e-4 { 1e6 } else { 0.0 }).collect();
/// let mut rise = vec![0.0; grid.len()];
/// let report = flash.rise(&disc, &mut rise)?;
/// // Uniform disc on a body at rest: q b / k, half of it for two equal bodies.
/// assert!((report.maximum / (0.5 * 1e6 * 1e-4 / 46.0) - 1.0).abs() < 0.02);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct FlashTemperature {
    /// Nodes of the grid.
    n_nodes: usize,
    /// Rise of each body under a heat flux into it \[K m^2/W\].
    bodies: [Convolution; 2],
    /// Solver of the heat partition.
    solver: PartitionSolver,
    /// Rises of both surfaces \[K\].
    temperatures: [Vec<f64>; 2],
    /// Heat flux into the first body \[W/m^2\].
    first_flux: Vec<f64>,
    /// Flux into the second body \[W/m^2\].
    second_flux: Vec<f64>,
}

impl FlashTemperature {
    /// Plans for fields on `grid`, which repeat along y on a strip, with the thermal properties of the two `bodies` and the `speeds` \[m/s\]
    /// (signed, along x) of their surfaces relative to the contact.
    ///
    /// # Errors
    /// A property that is not finite and positive, a speed that is not finite.
    pub fn new(grid: &Grid, bodies: [ThermalBody; 2], speeds: [f64; 2]) -> Result<Self, InputError> {
        for (body, speed) in bodies.iter().zip(speeds) {
            body.validate()?;
            InputError::require(speed.is_finite(), "speed", speed, "finite")?;
        }
        let [first, second] = [0, 1].map(|b| MovingSource::new(grid, bodies[b], speeds[b]));
        let plan = |kernel: &dyn Fn(isize, isize) -> f64| {
            let make = if grid.is_strip() { ConvolutionPlan::periodic_across } else { ConvolutionPlan::new };
            make(grid.nx(), grid.ny(), kernel)
        };
        let bodies = [plan(&|i, j| first.at(i, j)), plan(&|i, j| second.at(i, j))];
        let zeros = || vec![0.0; grid.len()];
        let both = |i, j| first.at(i, j) + second.at(i, j);
        let periodic =
            if grid.is_strip() { ConvolutionPlan::periodic_strip } else { ConvolutionPlan::periodic };
        let periodic = periodic(grid.nx(), grid.ny(), both);
        Ok(Self {
            n_nodes: grid.len(),
            solver: PartitionSolver::new(grid.len(), bodies.each_ref(), &periodic, both(0, 0)),
            bodies: bodies.map(|plan| Convolution::new(Arc::new(plan))),
            temperatures: [zeros(), zeros()],
            first_flux: zeros(),
            second_flux: zeros(),
        })
    }

    /// Overwrites `out` \[K\] with the rise under `heat_flux` \[W/m^2\] (friction coefficient x pressure x
    /// sliding speed): the common temperature at heated nodes, the mean of the bodies elsewhere. Allocates
    /// nothing.
    ///
    /// # Errors
    /// A slice that does not fit the grid, a flux that is negative or not finite.
    pub fn rise(&mut self, heat_flux: &[f64], out: &mut [f64]) -> Result<FlashReport, InputError> {
        InputError::require_len("heat_flux", heat_flux, self.n_nodes)?;
        InputError::require_len("out", out, self.n_nodes)?;
        InputError::require_finite("heat_flux", heat_flux)?;
        for &flux in heat_flux {
            InputError::require_non_negative("heat_flux", flux)?;
        }
        let iterations = self.partition(heat_flux, None);
        Ok(self.collect(heat_flux, out, iterations))
    }

    /// Overwrites `rises` \[K\] of both surfaces under the `heat_flux` \[W/m^2\] of a film between them
    /// (negative for heat absorbed). Half flows to each side, plus conduction through the film from the
    /// warmer to the cooler surface, with its `resistance` `h/k` \[K m^2/W\]:
    ///
    /// `q_1 = q/2 + (T_2 - T_1) k/h`, `q_2 = q - q_1`,
    ///
    /// Without resistance both surfaces have the same temperature. The mismatch of the report is the residual
    /// of the first equation as a temperature. Allocates nothing.
    ///
    /// # Errors
    /// The errors of [`rise`](Self::rise); a resistance that is negative or not finite.
    pub fn rises_through_film(
        &mut self,
        heat_flux: &[f64],
        resistance: &[f64],
        rises: [&mut [f64]; 2],
    ) -> Result<FlashReport, InputError> {
        for (field, values) in [("heat_flux", heat_flux), ("resistance", resistance)] {
            InputError::require_len(field, values, self.n_nodes)?;
            InputError::require_finite(field, values)?;
        }
        for &value in resistance {
            InputError::require_non_negative("resistance", value)?;
        }
        let [one, other] = rises;
        InputError::require_len("rises", one, self.n_nodes)?;
        InputError::require_len("rises", other, self.n_nodes)?;
        let iterations = self.partition(heat_flux, Some(resistance));
        let mut report = self.collect(heat_flux, one, iterations);
        let [first, second] = &self.temperatures;
        report.mismatch = 0.0;
        for k in 0..self.n_nodes {
            let across = resistance[k] * (self.first_flux[k] - 0.5 * heat_flux[k]);
            report.mismatch = report.mismatch.max((second[k] - first[k] - across).abs());
            report.maximum = report.maximum.max(first[k].abs()).max(second[k].abs());
        }
        one.copy_from_slice(first);
        other.copy_from_slice(second);
        Ok(report)
    }

    /// Fluxes \[W/m^2\] into both bodies in the last evaluation.
    pub fn fluxes(&self) -> [&[f64]; 2] {
        [&self.first_flux, &self.second_flux]
    }

    /// Solves for the flux into the first body; returns the number of iterations.
    fn partition(&mut self, heat_flux: &[f64], resistance: Option<&[f64]>) -> usize {
        let largest = |rises: &[f64]| rises.iter().copied().fold(0.0, f64::max);
        let [first, second] = &mut self.temperatures;
        self.bodies[0].apply(heat_flux, first);
        self.bodies[1].apply(heat_flux, second);
        // The unknown is the flux into the body that would be hotter alone: the smaller one, whose rounding matters less.
        let is_first = largest(first) >= largest(second);
        let (own, other) = if is_first { (first, second) } else { (second, first) };
        // initial guess: equal temperatures node by node
        let mut hottest = 0.0_f64;
        for (k, share) in self.first_flux.iter_mut().enumerate() {
            let both = own[k] + other[k];
            *share = if heat_flux[k] > 0.0 && both > 0.0 { heat_flux[k] * other[k] / both } else { 0.0 };
            hottest = hottest.max(own[k].min(other[k]));
        }
        if let Some(resistance) = resistance {
            for ((target, flux), resistance) in other.iter_mut().zip(heat_flux).zip(resistance) {
                *target += 0.5 * resistance * flux;
            }
            // A film of high resistance sends half of the heat to each side.
            for (share, (flux, resistance)) in
                self.first_flux.iter_mut().zip(heat_flux.iter().zip(resistance))
            {
                let weight = resistance / (resistance + self.solver.self_influence);
                *share += weight * (0.5 * flux - *share);
            }
        }
        let tolerance = 0.5 * TOLERANCE * hottest;
        let iterations = self.solver.solve((heat_flux, resistance), other, &mut self.first_flux, tolerance);
        if !is_first {
            for (share, flux) in self.first_flux.iter_mut().zip(heat_flux) {
                *share = flux - *share;
            }
        }
        iterations
    }

    /// Rises under the partition, their mean in `out`, and their mismatch.
    fn collect(&mut self, heat_flux: &[f64], out: &mut [f64], iterations: usize) -> FlashReport {
        for ((rest, flux), share) in self.second_flux.iter_mut().zip(heat_flux).zip(&self.first_flux) {
            *rest = flux - share;
        }
        let [first, second] = &mut self.temperatures;
        self.bodies[0].apply(&self.first_flux, first);
        self.bodies[1].apply(&self.second_flux, second);
        let mut report = FlashReport { maximum: 0.0, mismatch: 0.0, iterations };
        for (k, out) in out.iter_mut().enumerate() {
            *out = 0.5 * (first[k] + second[k]);
            report.maximum = report.maximum.max(*out);
            if heat_flux[k] > 0.0 {
                report.mismatch = report.mismatch.max((first[k] - second[k]).abs());
            }
        }
        report
    }
}

/// Estimate of the largest flash temperature rise \[K\] of a smooth Hertzian contact, to decide whether a
/// [`FlashTemperature`] is needed.
///
/// Heat flux `mu p |V_1 - V_2|` with the Hertz pressure (maximum `hertz_pressure` \[Pa\], radius `radius`
/// \[m\], approximated as parabolic with the mean `2 p_H / 3`). Body `b` alone would reach
/// `2.32 q_mean a / (k_b sqrt(pi (1.234 + Pe_b)))`, `Pe_b = |V_b| a / (2 kappa_b)`; together
/// `1/T = 1/T_1 + 1/T_2`. Rough contacts are hotter at asperities, by about a tenth in the reference scene.
///
/// Source: Tian and Kennedy (1994), Journal of Tribology 116, 167-174.
///
/// # Errors
/// A property, pressure or radius that is not finite and positive, a negative friction coefficient, a speed
/// that is not finite.
///
/// ```
/// use stribeck::tribochem::{ThermalBody, estimate_maximum_rise};
/// let steel = [ThermalBody::STEEL; 2];
/// let rise = estimate_maximum_rise(steel, [0.1025, 0.0975], 0.115, 1.15e9, 149.83e-6)?;
/// assert!((rise - 0.69).abs() < 0.02);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn estimate_maximum_rise(
    bodies: [ThermalBody; 2],
    speeds: [f64; 2],
    friction_coefficient: f64,
    hertz_pressure: f64,
    radius: f64,
) -> Result<f64, InputError> {
    InputError::require_non_negative("friction_coefficient", friction_coefficient)?;
    InputError::require_positive("hertz_pressure", hertz_pressure)?;
    let mean_flux = friction_coefficient * 2.0 / 3.0 * hertz_pressure * (speeds[0] - speeds[1]).abs();
    estimate_rise_under_flux(bodies, speeds, mean_flux, radius)
}

/// [`estimate_maximum_rise`] \[K\] for any heat source with the mean flux `mean_flux` \[W/m^2\] over the
/// contact; that of a fluid is its mean shear stress times the sliding speed.
///
/// # Errors
/// A property or radius that is not finite and positive, a flux that is negative or not finite, a speed that
/// is not finite.
///
/// ```
/// use stribeck::tribochem::{ThermalBody, estimate_rise_under_flux};
/// // 100 MPa of shear stress at 1 m/s of sliding.
/// let rise = estimate_rise_under_flux([ThermalBody::STEEL; 2], [1.5, 0.5], 1e8, 100e-6)?;
/// assert!(rise > 50.0 && rise < 100.0, "{rise}");
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn estimate_rise_under_flux(
    bodies: [ThermalBody; 2],
    speeds: [f64; 2],
    mean_flux: f64,
    radius: f64,
) -> Result<f64, InputError> {
    InputError::require_non_negative("mean_flux", mean_flux)?;
    InputError::require_positive("radius", radius)?;
    let mut inverse = 0.0;
    for (body, speed) in bodies.iter().zip(speeds) {
        body.validate()?;
        InputError::require(speed.is_finite(), "speed", speed, "finite")?;
        let peclet = 0.5 * speed.abs() * radius / body.diffusivity;
        inverse += body.conductivity * (PI * (1.234 + peclet)).sqrt() / (2.32 * radius);
    }
    Ok(mean_flux / inverse)
}
