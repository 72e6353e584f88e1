//! Laws of viscosity and density, the interface of custom fluids.

use std::fmt::Debug;

/// Viscosity as a function of pressure at the temperature of the contact.
///
/// Contract: for every finite pressure the viscosity is finite and positive, and it does not decrease with
/// pressure. Negative pressures count as zero.
///
/// # Examples
///
/// ```
/// use stribeck::lubricant::ViscosityLaw;
/// /// A fluid with a viscosity that doubles every 100 MPa.
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

    /// Logarithmic slope `d ln(eta) / dp` \[1/Pa\]; the default is a central difference.
    fn log_slope(&self, pressure: f64) -> f64 {
        let step = 1e-4 * pressure.abs().max(1e6);
        let low = (pressure - step).max(0.0);
        let high = pressure.max(0.0) + step;
        (self.viscosity(high) / self.viscosity(low)).ln() / (high - low)
    }

    /// The law at `temperature` \[K\], above zero; `None` (the default) for a law without temperature
    /// dependence.
    fn at_temperature(&self, _temperature: f64) -> Option<Box<dyn ViscosityLaw>> {
        None
    }

    /// Viscosity \[Pa s\] at `pressure` \[Pa\] and `temperature` \[K\]; `None` for a law without temperature
    /// dependence. The default calls [`at_temperature`](Self::at_temperature), which boxes a law per call.
    fn viscosity_at(&self, pressure: f64, temperature: f64) -> Option<f64> {
        self.at_temperature(temperature).map(|law| law.viscosity(pressure))
    }

    /// Fills `viscosity` \[Pa s\] from `pressure` \[Pa\]; both slices have the same length.
    fn fill(&self, pressure: &[f64], viscosity: &mut [f64]) {
        for (eta, &p) in viscosity.iter_mut().zip(pressure) {
            *eta = self.viscosity(p);
        }
    }
}

/// Density relative to that at ambient pressure.
///
/// Contract: the ratio is finite, 1 at zero pressure, and does not decrease with pressure. Negative pressures
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

    /// Density at `pressure` \[Pa\] and `temperature` \[K\] relative to that at ambient pressure and the
    /// temperature of the law; `None` (the default) for a law without temperature dependence. It equals
    /// `ratio_at(0, T)` times the `ratio` of the law [`at_temperature`](Self::at_temperature) `T`, which is
    /// relative to ambient pressure at `T`. Films with their own temperature use it
    /// ([`Lubricant::set_film_temperatures`](crate::lubricant::Lubricant::set_film_temperatures)).
    fn ratio_at(&self, _pressure: f64, _temperature: f64) -> Option<f64> {
        None
    }

    /// Fills `ratio` from `pressure` \[Pa\]; both slices have the same length.
    fn fill(&self, pressure: &[f64], ratio: &mut [f64]) {
        for (ratio, &p) in ratio.iter_mut().zip(pressure) {
            *ratio = self.ratio(p);
        }
    }

    /// Fills `slope` \[1/Pa\] from `pressure` \[Pa\]; both slices have the same length.
    fn fill_slopes(&self, pressure: &[f64], slope: &mut [f64]) {
        for (slope, &p) in slope.iter_mut().zip(pressure) {
            *slope = self.slope(p);
        }
    }

    /// The law at `temperature` \[K\], above zero; `None` (the default) for a law without temperature
    /// dependence.
    fn at_temperature(&self, _temperature: f64) -> Option<Box<dyn DensityLaw>> {
        None
    }
}
