//! Lubricant laws: viscosity and density as functions of pressure and, for some laws, of temperature.
//!
//! [`Rheology`] is the shear stress of the fluid, for friction and heat. [`ViscosityLaw`] and [`DensityLaw`]
//! are open traits: implement one for a custom fluid and pass it to [`Lubricant::new`], which tabulates both.
//! Solvers use the table, without a virtual call per node.

mod barus;
mod density;
mod doolittle_tait;
mod improved_yasutomi;
mod laws;
mod oil;
mod rheology;
mod roelands;
mod table;
mod temperature_table;
mod thermal_roelands;
mod thinning;

use std::sync::Arc;

pub use barus::Barus;
pub use density::{DowsonHigginson, Incompressible};
pub use doolittle_tait::{DoolittleTait, DoolittleTaitConstants};
pub use improved_yasutomi::{ImprovedYasutomi, ImprovedYasutomiConstants};
pub use laws::{DensityLaw, ViscosityLaw};
pub(crate) use oil::INDEX_TEMPERATURES;
pub use oil::{BaseOil, Oil, PressureViscosity, Walther, petroleum_density, so_klaus, viscosity_index};
pub use rheology::Rheology;
pub use roelands::Roelands;
pub use table::FluidPoint;
use table::FluidTable;
use temperature_table::TemperatureTable;
pub(crate) use temperature_table::{LEAST_TEMPERATURE, NodeTemperature, Saturating, ThermalRatios};
pub use thermal_roelands::ThermalRoelands;
pub(crate) use thinning::Thinning;

use crate::error::InputError;

/// The viscosity and density laws of a lubricant. Clones share them.
///
/// # Examples
///
/// ```
/// use stribeck::lubricant::{Barus, DowsonHigginson, Lubricant};
/// let oil = Lubricant::new(Barus::new(0.08, 20e-9)?, DowsonHigginson::new(0.6e-9, 1.7e-9)?);
/// assert!((oil.pressure_viscosity_coefficient() - 20e-9).abs() < 1e-12);
/// assert!((oil.viscosity().viscosity(1e8) / 0.08 - 2.0_f64.exp()).abs() < 1e-12);
/// assert!(oil.density().ratio(1e9) > 1.2);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Lubricant {
    /// Viscosity by pressure.
    viscosity: Arc<dyn ViscosityLaw>,
    /// Density by pressure.
    density: Arc<dyn DensityLaw>,
    /// Both laws and the reduced pressure, tabulated.
    table: FluidTable,
    /// Ratios at other temperatures; `None` before the first use.
    temperature_table: Option<Arc<TemperatureTable>>,
    /// Film temperature of every node; empty if all films have the temperature of the laws.
    film_temperatures: Vec<NodeTemperature>,
}

impl Lubricant {
    /// A lubricant from its two laws.
    pub fn new(viscosity: impl ViscosityLaw + 'static, density: impl DensityLaw + 'static) -> Self {
        Self::from_boxed(Box::new(viscosity), Box::new(density))
    }

    /// A lubricant from boxed laws.
    pub fn from_boxed(viscosity: Box<dyn ViscosityLaw>, density: Box<dyn DensityLaw>) -> Self {
        let table = FluidTable::new(&*viscosity, &*density);
        Self {
            viscosity: viscosity.into(),
            density: density.into(),
            table,
            temperature_table: None,
            film_temperatures: Vec::new(),
        }
    }

    /// Sets the film temperatures of a contact, one value per node: `flow` for the effective viscosity of
    /// pressure flow, `mean` for the density. `bulk` \[K\] is the temperature of the contact and of the laws.
    /// A viscosity without temperature dependence is unchanged; a density without it is multiplied by
    /// `exp[-expansivity (T - bulk)]` ([`DensityLaw::ratio_at`]). Above the pressure at which the viscosity
    /// law saturates, films at other temperatures keep the viscosity at that pressure. Empty slices reset all
    /// films to the temperature of the laws.
    ///
    /// Ratios to the laws are interpolated in a table with intervals of 10 K, to 1e-3, and 10 MPa, to 3e-7, for
    /// films from 20 K below the bulk to 590 K above it; other temperatures are clamped to this range.
    ///
    /// # Errors
    /// Temperatures that are not finite or of different lengths, a negative expansivity, a bulk temperature
    /// that is not positive.
    ///
    /// ```
    /// use stribeck::lubricant::{DowsonHigginson, Lubricant, Roelands, ThermalRoelands};
    /// let law = ThermalRoelands::new(Roelands::new(0.04, 0.68, 1.96e8)?, 313.15, 1.1)?;
    /// let mut oil = Lubricant::new(law, DowsonHigginson::new(0.6e-9, 1.7e-9)?);
    /// oil.set_film_temperatures(313.15, &[313.15, 353.15], &[313.15, 353.15], 6.5e-4)?;
    /// let [cool, warm] = [oil.film_ratios(0, 5e8), oil.film_ratios(1, 5e8)];
    /// assert!((cool[0] - 1.0).abs() < 1e-12 && warm[0] < 0.1);
    /// assert!((warm[1] - (-6.5e-4_f64 * 40.0).exp()).abs() < 1e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn set_film_temperatures(
        &mut self,
        bulk: f64,
        flow: &[f64],
        mean: &[f64],
        expansivity: f64,
    ) -> Result<(), InputError> {
        InputError::require_positive("bulk", bulk)?;
        InputError::require_finite("flow", flow)?;
        InputError::require_len("mean", mean, flow.len())?;
        InputError::require_finite("mean", mean)?;
        InputError::require_non_negative("expansivity", expansivity)?;
        self.film_temperatures.clear();
        if flow.is_empty() {
            return Ok(());
        }
        let made = |table: &Arc<TemperatureTable>| {
            table.bulk.to_bits() == bulk.to_bits() && table.expansivity.to_bits() == expansivity.to_bits()
        };
        let table = match self.temperature_table.take().filter(made) {
            Some(table) => table,
            None => Arc::new(TemperatureTable::new(&*self.viscosity, &*self.density, bulk, expansivity)),
        };
        self.film_temperatures.extend(flow.iter().zip(mean).map(|(flow, mean)| table.node(*flow, *mean)));
        self.temperature_table = Some(table);
        Ok(())
    }

    /// Effective viscosity of pressure flow and density of the film at `node` and `pressure` \[Pa\], relative
    /// to those of the laws.
    pub fn film_ratios(&self, node: usize, pressure: f64) -> [f64; 2] {
        let warm = self
            .film_temperatures
            .get(node)
            .and_then(|temperature| self.thermal_ratios(temperature, pressure));
        warm.map_or([1.0; 2], |warm| [warm.viscosity, warm.density])
    }

    /// All films have the temperature of the laws from now on.
    pub(crate) fn forget_film_temperatures(&mut self) {
        self.film_temperatures.clear();
    }

    /// Film temperatures at the nodes; empty if all films have the temperature of the laws.
    pub(crate) fn film_temperatures(&self) -> &[NodeTemperature] {
        &self.film_temperatures
    }

    /// Viscosity and density ratios for the temperature of a node at `pressure` \[Pa\]; `None` if films have
    /// the temperature of the laws.
    #[inline]
    pub(crate) fn thermal_ratios(
        &self,
        temperature: &NodeTemperature,
        pressure: f64,
    ) -> Option<ThermalRatios> {
        self.temperature_table.as_ref().map(|table| table.at(temperature, pressure))
    }

    /// The lubricant at `temperature` \[K\]; laws without temperature dependence are unchanged. If either law
    /// changes, film temperatures are reset.
    #[must_use]
    pub fn at_temperature(self, temperature: f64) -> Self {
        match (self.viscosity.at_temperature(temperature), self.density.at_temperature(temperature)) {
            (None, None) => self,
            (viscosity, density) => {
                let viscosity = viscosity.map_or(self.viscosity, Arc::from);
                let density = density.map_or(self.density, Arc::from);
                let table = FluidTable::new(&*viscosity, &*density);
                Self { viscosity, density, table, temperature_table: None, film_temperatures: Vec::new() }
            }
        }
    }

    /// The viscosity law.
    pub fn viscosity(&self) -> &dyn ViscosityLaw {
        &*self.viscosity
    }

    /// The density law.
    pub fn density(&self) -> &dyn DensityLaw {
        &*self.density
    }

    /// Reduced pressure and density at `pressure` \[Pa\], from a table of the two laws in intervals of 2.5 MPa;
    /// linear above 20.48 GPa. For laws that are smooth over such an interval, with `alpha` up to 40 1/GPa, the
    /// slope of the reduced pressure has a relative error below 2e-10, and mass residuals by the laws themselves
    /// differ from those by the table by less than 1e-7 (points on 128 x 128, lines on 2048 cells).
    ///
    /// The flow through a face at film `h` between pressures 1 and 2 is exactly
    /// `h^3 (q_1 - q_2) / (12 eta_0)` times width over length. It increases with `p_1` and decreases with
    /// `p_2` for any viscosity law.
    ///
    /// ```
    /// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
    /// let oil = Lubricant::new(Barus::new(0.01, 20e-9)?, Incompressible);
    /// let exact = |p: f64| (1.0 - (-20e-9 * p).exp()) / 20e-9;
    /// assert!((oil.at(7.3e7).reduced_pressure / exact(7.3e7) - 1.0).abs() < 1e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[inline]
    pub fn at(&self, pressure: f64) -> FluidPoint {
        self.table.at(pressure)
    }

    /// Pressure-viscosity coefficient `d ln(eta) / dp` at ambient pressure \[1/Pa\].
    pub fn pressure_viscosity_coefficient(&self) -> f64 {
        self.viscosity.log_slope(0.0)
    }
}
