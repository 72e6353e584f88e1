//! Growth law of Ghanbarzadeh and co-workers.

use super::barrier::BOLTZMANN;
use super::first_order::relax;
use super::{Activation, FilmGrowthLaw};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// Planck constant \[J s\].
const PLANCK: f64 = 6.62607015e-34;

/// Saturating growth less saturating removal,
/// `h(t) = h_max [1 - exp(-k t)] - C3 [1 - exp(-C4 t)]`, `k = (k_B T / h_Planck) x_tribo`,
/// with two states per node, so that temperature and contact may vary with time:
///
/// `g' = k(T) (h_max - g)`, `r' = C4 (C3 - r)`, `h = max(g - r, 0)` while the node is active, frozen
/// otherwise.
///
/// Both states follow exact exponentials, so the result depends on the active time and not on the steps. With
/// the constants of [`azam_2019`](Self::azam_2019) the film is not monotonic: it peaks near 2947 s and
/// approaches `h_max - C3`.
///
/// Source: Ghanbarzadeh, Wilson, Morina, Dowson, Neville (2016), Tribology International 93, 573-582, as used
/// by Azam, Ghanbarzadeh, Neville, Morina, Wilson (2019), Tribology International 135, 161-169.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::tribochem::{FilmGrowthLaw, Ghanbarzadeh};
/// let law = Ghanbarzadeh::azam_2019();
/// let at = SurfaceState::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_shear_stress(1e8).with_sliding_speed(0.005).with_in_contact(true);
/// let mut states = [0.0; 2];
/// law.advance(&at, 2947.0, &mut states);
/// assert!((law.thickness(&states) - 156.82e-9).abs() < 0.01e-9);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Ghanbarzadeh {
    /// Limit of growth \[m\].
    maximum: f64,
    /// `k_B x_tribo / h_Planck` \[1/(K s)\].
    rate_per_kelvin: f64,
    /// Limit of removal `C3` \[m\].
    removal_limit: f64,
    /// Rate of removal `C4` \[1/s\].
    removal_rate: f64,
    /// Condition for growth and removal.
    activation: Activation,
}

impl Ghanbarzadeh {
    /// Law with the growth limit `maximum_thickness` \[m\], the mechanical activation `x_tribo` \[-\], the
    /// removal limit `removal_limit` (C3, \[m\]) and the removal rate `removal_rate` (C4, \[1/s\]), active in
    /// solid contact.
    ///
    /// # Errors
    /// `maximum_thickness` or `x_tribo` not positive, a removal constant negative, a value not finite.
    pub fn new(
        maximum_thickness: f64,
        x_tribo: f64,
        removal_limit: f64,
        removal_rate: f64,
    ) -> Result<Self, InputError> {
        InputError::require_positive("maximum_thickness", maximum_thickness)?;
        InputError::require_positive("x_tribo", x_tribo)?;
        InputError::require_non_negative("removal_limit", removal_limit)?;
        InputError::require_non_negative("removal_rate", removal_rate)?;
        Ok(Self {
            maximum: maximum_thickness,
            rate_per_kelvin: BOLTZMANN / PLANCK * x_tribo,
            removal_limit,
            removal_rate,
            activation: Activation::default(),
        })
    }

    /// The constants of Azam and co-workers (2019): `h_max` 200 nm, `x_tribo` 1.66e-16, `C3` 54.32 nm
    /// (printed as 0.05432, interpreted as micrometres), `C4` 4.022e-4 1/s.
    pub fn azam_2019() -> Self {
        Self {
            maximum: 200e-9,
            rate_per_kelvin: BOLTZMANN / PLANCK * 1.66e-16,
            removal_limit: 54.32e-9,
            removal_rate: 4.022e-4,
            activation: Activation::SolidContact,
        }
    }

    /// The law with another activation condition.
    #[must_use]
    pub fn with_activation(mut self, activation: Activation) -> Self {
        self.activation = activation;
        self
    }

    /// Growth constant `k` \[1/s\] at `temperature` \[K\]; zero for a temperature that is not positive or
    /// NaN.
    ///
    /// ```
    /// let k = stribeck::tribochem::Ghanbarzadeh::azam_2019().rate_constant(353.15);
    /// assert!((k - 1.2215e-3).abs() < 1e-7);
    /// ```
    pub fn rate_constant(&self, temperature: f64) -> f64 {
        if temperature.is_finite() { self.rate_per_kelvin * temperature.max(0.0) } else { 0.0 }
    }
}

impl FilmGrowthLaw for Ghanbarzadeh {
    fn rate(&self, at: &SurfaceState, thickness: f64) -> f64 {
        if !self.activation.is_active(at) {
            return 0.0;
        }
        let growth = self.rate_constant(at.temperature) * (self.maximum - thickness);
        let net = growth - self.removal_rate * self.removal_limit;
        if thickness > 0.0 { net } else { net.max(0.0) }
    }

    fn maximum_thickness(&self) -> f64 {
        self.maximum
    }

    fn n_states(&self) -> usize {
        2
    }

    fn thickness(&self, states: &[f64]) -> f64 {
        match states {
            [grown, removed, ..] => (grown - removed).max(0.0),
            _ => 0.0,
        }
    }

    fn grown(&self, states: &[f64]) -> Option<f64> {
        states.first().copied()
    }

    fn advance(&self, at: &SurfaceState, time_step: f64, states: &mut [f64]) {
        if let [grown, removed, ..] = states
            && self.activation.is_active(at)
            && time_step > 0.0
        {
            *grown = relax(*grown, self.maximum, self.rate_constant(at.temperature), time_step);
            *removed = relax(*removed, self.removal_limit, self.removal_rate, time_step);
        }
    }
}
