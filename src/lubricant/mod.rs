//! Lubricant laws: viscosity and density as functions of pressure, of some of temperature too.
//!
//! [`Rheology`] is the shear stress that friction and heat are made of. [`ViscosityLaw`] and [`DensityLaw`]
//! are open sets: implement one for an own fluid and hand it to [`Lubricant::new`], which tabulates both:
//! solvers read the table, without a virtual call per node.

mod barus;
mod density;
mod doolittle_tait;
mod improved_yasutomi;
mod rheology;
mod roelands;
mod table;
mod thermal_roelands;
mod thinning;
mod warmth;

use std::fmt::Debug;
use std::sync::Arc;

pub use barus::Barus;
pub use density::{DowsonHigginson, Incompressible};
pub use doolittle_tait::{DoolittleTait, DoolittleTaitConstants};
pub use improved_yasutomi::{ImprovedYasutomi, ImprovedYasutomiConstants};
pub use rheology::Rheology;
pub use roelands::Roelands;
pub use table::FluidPoint;
use table::FluidTable;
pub use thermal_roelands::ThermalRoelands;
pub(crate) use thinning::Thinning;
use warmth::WarmTable;
pub(crate) use warmth::{LEAST_TEMPERATURE, NodeWarmth, Saturating, WarmPoint};

use crate::error::InputError;

/// Viscosity as a function of pressure at the temperature of the contact.
///
/// Contract: for every finite pressure the viscosity is finite and positive, and it does not fall with
/// pressure; pressures below zero count as zero.
///
/// # Examples
///
/// ```
/// use stribeck::lubricant::ViscosityLaw;
/// /// A fluid whose viscosity doubles every 100 MPa.
/// #[derive(Debug)]
/// struct Doubling(f64);
/// impl ViscosityLaw for Doubling {
///     fn viscosity(&self, pressure: f64) -> f64 {
///         self.0 * (pressure.max(0.0) / 1e8).exp2()
///     }
/// }
/// // The default slope is a central difference of the logarithm.
/// assert!((Doubling(0.01).log_slope(5e8) - 2.0_f64.ln() / 1e8).abs() < 1e-14);
/// assert!(Doubling(0.01).viscosity_at(0.0, 400.0).is_none());
/// ```
pub trait ViscosityLaw: Debug + Send + Sync {
    /// Viscosity \[Pa s\] at `pressure` \[Pa\].
    fn viscosity(&self, pressure: f64) -> f64;

    /// Logarithmic slope `d ln(eta) / dp` \[1/Pa\]; by default a central difference.
    fn log_slope(&self, pressure: f64) -> f64 {
        let step = 1e-4 * pressure.abs().max(1e6);
        let low = (pressure - step).max(0.0);
        let high = pressure.max(0.0) + step;
        (self.viscosity(high) / self.viscosity(low)).ln() / (high - low)
    }

    /// The law at `temperature` \[K\], above zero; none (the default) for a law that does not know
    /// temperature.
    fn at_temperature(&self, _temperature: f64) -> Option<Box<dyn ViscosityLaw>> {
        None
    }

    /// Viscosity \[Pa s\] at `pressure` \[Pa\] and `temperature` \[K\]; none for a law that does not know
    /// temperature. By default that of [`at_temperature`](Self::at_temperature), which boxes a law a call.
    fn viscosity_at(&self, pressure: f64, temperature: f64) -> Option<f64> {
        self.at_temperature(temperature).map(|law| law.viscosity(pressure))
    }

    /// Fills `viscosity` \[Pa s\] from `pressure` \[Pa\]; slices of one length.
    fn fill(&self, pressure: &[f64], viscosity: &mut [f64]) {
        for (eta, &p) in viscosity.iter_mut().zip(pressure) {
            *eta = self.viscosity(p);
        }
    }
}

/// Density relative to that at ambient pressure.
///
/// Contract: the ratio is finite, 1 at zero pressure, and does not fall with pressure; pressures below zero
/// count as zero.
///
/// # Examples
///
/// ```
/// use stribeck::lubricant::DensityLaw;
/// /// A fluid of constant bulk modulus \[Pa\].
/// #[derive(Debug)]
/// struct BulkModulus(f64);
/// impl DensityLaw for BulkModulus {
///     fn ratio(&self, pressure: f64) -> f64 {
///         (pressure.max(0.0) / self.0).exp()
///     }
///     fn slope(&self, pressure: f64) -> f64 {
///         self.ratio(pressure) / self.0
///     }
/// }
/// let mut ratios = [0.0; 2];
/// BulkModulus(2e9).fill(&[0.0, 2e9], &mut ratios);
/// assert_eq!(ratios, [1.0, 1.0_f64.exp()]);
/// ```
pub trait DensityLaw: Debug + Send + Sync {
    /// Density ratio `rho / rho_0` at `pressure` \[Pa\].
    fn ratio(&self, pressure: f64) -> f64;

    /// Slope of the ratio \[1/Pa\] at `pressure` \[Pa\].
    fn slope(&self, pressure: f64) -> f64;

    /// Density at `pressure` \[Pa\] and `temperature` \[K\] over that at ambient pressure and the temperature of
    /// the law; none (the default) for a law that does not know temperature. With
    /// [`at_temperature`](Self::at_temperature) this is `ratio_at(0, T)` times the `ratio` of the law at `T`: that
    /// one counts from ambient pressure at its own temperature. Films with a temperature of their own take it
    /// ([`Lubricant::set_film_temperatures`]).
    fn ratio_at(&self, _pressure: f64, _temperature: f64) -> Option<f64> {
        None
    }

    /// Fills `ratio` from `pressure` \[Pa\]; slices of one length.
    fn fill(&self, pressure: &[f64], ratio: &mut [f64]) {
        for (ratio, &p) in ratio.iter_mut().zip(pressure) {
            *ratio = self.ratio(p);
        }
    }

    /// Fills `slope` \[1/Pa\] from `pressure` \[Pa\]; slices of one length.
    fn fill_slopes(&self, pressure: &[f64], slope: &mut [f64]) {
        for (slope, &p) in slope.iter_mut().zip(pressure) {
            *slope = self.slope(p);
        }
    }

    /// The law at `temperature` \[K\], above zero; none (the default) for a law that does not know
    /// temperature.
    fn at_temperature(&self, _temperature: f64) -> Option<Box<dyn DensityLaw>> {
        None
    }
}

/// The two laws that describe a lubricant in the Reynolds equation. A clone shares them.
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
    /// Both, with the reduced pressure, tabulated for the flow.
    table: FluidTable,
    /// Both at other temperatures; none before they are asked for.
    warm: Option<Arc<WarmTable>>,
    /// Temperatures of the film at every node; empty for that of the laws everywhere.
    film: Vec<NodeWarmth>,
}

impl Lubricant {
    /// A lubricant from its two laws.
    pub fn new(viscosity: impl ViscosityLaw + 'static, density: impl DensityLaw + 'static) -> Self {
        Self::from_boxed(Box::new(viscosity), Box::new(density))
    }

    /// A lubricant from boxed laws.
    pub fn from_boxed(viscosity: Box<dyn ViscosityLaw>, density: Box<dyn DensityLaw>) -> Self {
        let table = FluidTable::new(&*viscosity, &*density);
        Self { viscosity: viscosity.into(), density: density.into(), table, warm: None, film: Vec::new() }
    }

    /// Takes over temperatures of the film of a contact whose bulk, and whose laws, have the temperature
    /// `bulk` \[K\], one a node: those of `flow` for the viscosity of the flow by pressure, those of `mean` for
    /// the density. A viscosity that does not know temperature stays as it is; a density that does not
    /// becomes `exp[-expansivity (T - bulk)]` times as large ([`DensityLaw::ratio_at`]). Beyond the pressure at
    /// which the viscosity of the law ends warm films keep that at this pressure. Without temperatures all
    /// films have that of the laws.
    ///
    /// Ratios to the laws are interpolated between temperatures 10 K and pressures 10 MPa apart, to 1e-3, for
    /// films from 20 K below the bulk to 590 K above it; others count as these.
    ///
    /// # Errors
    /// Temperatures that are not finite or of two lengths, an expansivity that is negative, a bulk
    /// temperature that is not positive.
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
        self.film.clear();
        if flow.is_empty() {
            return Ok(());
        }
        let made = |table: &Arc<WarmTable>| {
            table.bulk.to_bits() == bulk.to_bits() && table.expansivity.to_bits() == expansivity.to_bits()
        };
        let table = match self.warm.take().filter(made) {
            Some(table) => table,
            None => Arc::new(WarmTable::new(&*self.viscosity, &*self.density, bulk, expansivity)),
        };
        self.film.extend(flow.iter().zip(mean).map(|(flow, mean)| table.node(*flow, *mean)));
        self.warm = Some(table);
        Ok(())
    }

    /// Viscosity for the flow by pressure and density of the film at `node` and `pressure` \[Pa\], over those
    /// of the laws.
    pub fn film_ratios(&self, node: usize, pressure: f64) -> [f64; 2] {
        let warm = self.film.get(node).and_then(|warmth| self.warm_at(warmth, pressure));
        warm.map_or([1.0; 2], |warm| [warm.viscosity, warm.density])
    }

    /// All films have the temperature of the laws.
    pub(crate) fn forget_film_temperatures(&mut self) {
        self.film.clear();
    }

    /// Temperatures of the film at the nodes; empty where all have that of the laws.
    pub(crate) fn film(&self) -> &[NodeWarmth] {
        &self.film
    }

    /// Ratios at a node of the temperatures `warmth` under `pressure` \[Pa\]; none where films have the
    /// temperature of the laws.
    #[inline]
    pub(crate) fn warm_at(&self, warmth: &NodeWarmth, pressure: f64) -> Option<WarmPoint> {
        self.warm.as_ref().map(|table| table.at(warmth, pressure))
    }

    /// The lubricant at `temperature` \[K\]; laws that do not know temperature stay as they are. Temperatures
    /// of films are dropped where one does.
    #[must_use]
    pub fn at_temperature(self, temperature: f64) -> Self {
        match (self.viscosity.at_temperature(temperature), self.density.at_temperature(temperature)) {
            (None, None) => self,
            (viscosity, density) => {
                let viscosity = viscosity.map_or(self.viscosity, Arc::from);
                let density = density.map_or(self.density, Arc::from);
                let table = FluidTable::new(&*viscosity, &*density);
                Self { viscosity, density, table, warm: None, film: Vec::new() }
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

    /// Reduced pressure and density at `pressure` \[Pa\], from a table of the two laws: cubics 2.5 MPa apart,
    /// relative error of the reduced pressure below 1e-7 for `alpha` up to 40 1/GPa; linear above 20.48 GPa.
    ///
    /// The flow through a face at film `h` between pressures 1 and 2 is exactly
    /// `h^3 (q_1 - q_2) / (12 eta_0)` times width over length: it grows with `p_1` and falls with `p_2`
    /// however steep the viscosity is.
    ///
    /// ```
    /// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
    /// let oil = Lubricant::new(Barus::new(0.01, 20e-9)?, Incompressible);
    /// let exact = |p: f64| (1.0 - (-20e-9 * p).exp()) / 20e-9;
    /// assert!((oil.at(7.3e7).reduced_pressure / exact(7.3e7) - 1.0).abs() < 1e-8);
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
