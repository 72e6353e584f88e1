//! Mean pressure and area of contact of two nominally flat rough surfaces.

use std::f64::consts::{PI, SQRT_2};

use crate::error::InputError;

/// Separations over the root mean square height above which no asperity touches: the moments are below 1e-17.
const FARTHEST: f64 = 8.5;
/// Range and step of the variable `x` of the quadrature, `t = exp(x - exp(-x))`.
const RANGE: [f64; 2] = [-3.2, 2.5];
const STEP: f64 = 0.1;

/// Moment `F_n(u) = 1/sqrt(2 pi) int_u^inf (s - u)^n exp(-s^2/2) ds` of the heights of asperities above the separation
/// `u`, from -4 on, of the order `n > 0`, in units of the root mean square height.
///
/// By double exponential quadrature, to 1e-11 of its value. It is 0 above 8.5.
///
/// ```
/// use stribeck::analytic::asperity_moment;
/// assert!((asperity_moment(2.0, 0.0) - 0.5).abs() < 1e-12);
/// assert!((asperity_moment(2.5, 0.0) - 0.61664).abs() < 1e-5); // Greenwood and Tripp (1970)
/// ```
pub fn asperity_moment(order: f64, separation: f64) -> f64 {
    if separation > FARTHEST {
        return 0.0;
    }
    let count = ((RANGE[1] - RANGE[0]) / STEP).round() as usize;
    let term = |k: usize| {
        let inner = (-(RANGE[0] + STEP * k as f64)).exp();
        let t = (RANGE[0] + STEP * k as f64 - inner).exp();
        let s = separation + t;
        t.powf(order + 1.0) * (1.0 + inner) * (-0.5 * s * s).exp()
    };
    STEP * (0..=count).map(term).sum::<f64>() / (2.0 * PI).sqrt()
}

/// Contact of two nominally flat rough surfaces whose asperities are paraboloids with Gaussian heights.
///
/// At the separation `H` of the mean planes, in root mean square heights `sigma` of both surfaces together, the mean pressure is
///
/// `p_c = 8 sqrt(2)/15 pi (N b sigma)^2 sqrt(sigma/b) E' F_5/2(H)`
///
/// and the area of contact over the nominal one `pi^2 (N b sigma)^2 F_2(H)`, with the density `N` and the radius `b` of the
/// asperities, `E'` by `2/E' = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2`, and the moments [`asperity_moment`]. Asperities are elastic and
/// independent of each other.
///
/// Source: Greenwood and Tripp (1970), The contact of two nominally flat rough surfaces, Proc. Inst. Mech. Eng. 185, 625-633.
///
/// ```
/// use stribeck::analytic::GreenwoodTripp;
/// let contact = GreenwoodTripp::new(0.05, 0.01, 230e9)?;
/// let pressure = 8.0 * 2.0_f64.sqrt() / 15.0 * std::f64::consts::PI * 0.0025 * 0.1 * 230e9 * 0.61664;
/// assert!((contact.pressure(0.0) / pressure - 1.0).abs() < 1e-5);
/// assert!(contact.pressure(6.0) < 1e-6 * contact.pressure(0.0));
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct GreenwoodTripp {
    /// Density times radius of the asperities times root mean square height, `N b sigma`; 0.03 to 0.05 for many finishes.
    pub asperity_number: f64,
    /// Root mean square height over radius of the asperities, `sigma/b`; 1e-4 to 1e-2.
    pub rq_over_radius: f64,
    /// Equivalent modulus `E'` \[Pa\].
    pub equivalent_modulus: f64,
}

impl GreenwoodTripp {
    /// A pair of surfaces.
    ///
    /// # Errors
    /// A value that is not finite and positive.
    pub fn new(
        asperity_number: f64,
        rq_over_radius: f64,
        equivalent_modulus: f64,
    ) -> Result<Self, InputError> {
        InputError::require_positive("asperity_number", asperity_number)?;
        InputError::require_positive("rq_over_radius", rq_over_radius)?;
        InputError::require_positive("equivalent_modulus", equivalent_modulus)?;
        Ok(Self { asperity_number, rq_over_radius, equivalent_modulus })
    }

    /// Mean pressure \[Pa\] at a `separation` of the mean planes over the root mean square height, from -4 on.
    pub fn pressure(&self, separation: f64) -> f64 {
        let factor = 8.0 * SQRT_2 / 15.0 * PI * self.asperity_number.powi(2) * self.rq_over_radius.sqrt();
        factor * self.equivalent_modulus * asperity_moment(2.5, separation)
    }

    /// Area of contact over the nominal area at a `separation`.
    pub fn area_ratio(&self, separation: f64) -> f64 {
        (PI * self.asperity_number).powi(2) * asperity_moment(2.0, separation)
    }
}
