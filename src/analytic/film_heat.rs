//! Film heat by formula: thermal reduction factors of inlets, and a sheared layer.

use crate::error::InputError;

/// Inlet conditions of a smooth contact for thermal reduction factors of the film.
///
/// The thermal loading parameter is `L = b eta_0 u^2 / k` with the temperature coefficient
/// `b = -d ln(eta)/dT` of the viscosity at ambient pressure.
///
/// ```
/// use stribeck::analytic::ThermalInlet;
/// let inlet = ThermalInlet {
///     entrainment_speed: 2.0, eta0: 0.04, temperature_coefficient: 0.04, conductivity: 0.14,
///     pressure_over_modulus: 0.0, slide_roll_ratio: 0.0,
/// };
/// assert!((inlet.loading() - 0.04 * 0.04 * 4.0 / 0.14).abs() < 1e-15);
/// // Two independent fits of pure rolling.
/// assert!((inlet.gupta()? / inlet.murch_wilson()? - 1.0).abs() < 0.02);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThermalInlet {
    /// Mean speed of the surfaces `u` \[m/s\].
    pub entrainment_speed: f64,
    /// Viscosity at ambient pressure `eta_0` \[Pa s\].
    pub eta0: f64,
    /// `b` \[1/K\].
    pub temperature_coefficient: f64,
    /// Thermal conductivity of the fluid `k` \[W/(m K)\].
    pub conductivity: f64,
    /// Hertz pressure over equivalent modulus `p_H/E'`.
    pub pressure_over_modulus: f64,
    /// Sliding over entrainment speed `S`.
    pub slide_roll_ratio: f64,
}

impl ThermalInlet {
    /// Thermal loading parameter `L`.
    pub fn loading(&self) -> f64 {
        self.temperature_coefficient * self.eta0 * self.entrainment_speed.powi(2) / self.conductivity
    }

    /// Film relative to that of the isothermal contact, `[1 - 13.2 (p_H/E') L^0.42] / [1 + 0.213 (1 + 2.23
    /// |S|^0.83) L^0.64]`.
    ///
    /// Source: Gupta, P. K., Cheng, H. S., Zhu, D., Forster, N. H. and Schrand, J. B. (1992), Tribology
    /// Transactions 35, 269-274.
    ///
    /// # Errors
    /// A value that is negative or not finite, a conductivity or viscosity of zero, loads and speeds for
    /// which the factor is not positive.
    pub fn gupta(&self) -> Result<f64, InputError> {
        self.validate()?;
        let (load, sliding) = (self.loading(), self.slide_roll_ratio.abs());
        let pressed = 1.0 - 13.2 * self.pressure_over_modulus * load.powf(0.42);
        let factor = pressed / (1.0 + 0.213 * (1.0 + 2.23 * sliding.powf(0.83)) * load.powf(0.64));
        InputError::require_positive("thermal reduction factor", factor).map(|()| factor)
    }

    /// Film relative to that of the isothermal line contact in pure rolling, `3.94 / (3.94 + L^0.62)`.
    ///
    /// Source: Murch, L. E. and Wilson, W. R. D. (1975), Journal of Lubrication Technology 97, 212-216.
    ///
    /// # Errors
    /// The errors of [`gupta`](Self::gupta).
    pub fn murch_wilson(&self) -> Result<f64, InputError> {
        self.validate().map(|()| 3.94 / (3.94 + self.loading().powf(0.62)))
    }

    fn validate(&self) -> Result<(), InputError> {
        InputError::require_non_negative("entrainment_speed", self.entrainment_speed)?;
        InputError::require_positive("eta0", self.eta0)?;
        InputError::require_non_negative("temperature_coefficient", self.temperature_coefficient)?;
        InputError::require_positive("conductivity", self.conductivity)?;
        InputError::require_non_negative("pressure_over_modulus", self.pressure_over_modulus)?;
        let ratio = self.slide_roll_ratio;
        InputError::require(ratio.is_finite(), "slide_roll_ratio", ratio, "finite")
    }
}

/// Exact solution for a Newtonian fluid with `eta = eta_0 exp[-b (T - T_0)]` sheared between plates at `T_0`.
///
/// With the Nahme number `Na = b eta_0 U^2 / k` and `c = 2 asinh sqrt(Na/8)` the shear stress relative to
/// that of the isothermal fluid, `eta_0 U / h`, is `c / sinh c`. The temperature `b (T - T_0)` in the middle
/// is `ln(1 + Na/8)`.
///
/// Source: Nahme, R. (1940), Ingenieur-Archiv 11, 191-209.
///
/// ```
/// use stribeck::analytic::ShearedLayer;
/// let layer = ShearedLayer::new(8.0)?;
/// assert!((layer.stress_ratio() - 1.0_f64.asinh() / 2.0_f64.sqrt()).abs() < 1e-15);
/// assert!((layer.middle() - 2.0_f64.ln()).abs() < 1e-15);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearedLayer {
    nahme: f64,
}

impl ShearedLayer {
    /// The layer with the Nahme number `nahme`.
    ///
    /// # Errors
    /// A Nahme number that is negative or not finite.
    pub fn new(nahme: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("nahme", nahme).map(|()| Self { nahme })
    }

    /// Shear stress relative to that of the isothermal fluid.
    pub fn stress_ratio(&self) -> f64 {
        let c = self.steepness();
        if c == 0.0 { 1.0 } else { c / c.sinh() }
    }

    /// `b (T - T_0)` in the middle.
    pub fn middle(&self) -> f64 {
        (self.nahme / 8.0).ln_1p()
    }

    /// `b (T - T_0)` at `z`, the distance from a plate relative to that between the plates, 0 to 1.
    pub fn at(&self, z: f64) -> f64 {
        self.middle() - 2.0 * (self.steepness() * (z - 0.5)).cosh().ln()
    }

    /// `c`; half of it is the argument at the plates.
    fn steepness(&self) -> f64 {
        2.0 * (self.nahme / 8.0).sqrt().asinh()
    }
}
