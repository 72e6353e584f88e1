//! Flow factors of rough surfaces.

use super::asperity_moment;
use crate::error::InputError;

/// Constants of the fits for one Peklenik number.
struct Fit {
    /// Peklenik number.
    gamma: f64,
    /// Pressure flow: `C`, `r`, and the least separation of the fit.
    pressure: [f64; 3],
    /// Shear flow: `A_1`, `alpha_1`, `alpha_2`, `alpha_3`, `A_2`.
    shear: [f64; 5],
    /// Shear stress of sliding: `A_3`, `alpha_4`, `alpha_5`, `alpha_6`.
    sliding: [f64; 4],
    /// Shear stress of the pressure gradient: `D`, `s`.
    gradient: [f64; 2],
}

/// Tables 1 of Patir and Cheng (1978) and 1 to 3 of Patir and Cheng (1979).
#[rustfmt::skip]
const FITS: [Fit; 7] = [
    Fit { gamma: 1.0 / 9.0, pressure: [1.48, 0.42, 1.0], shear: [2.046, 1.12, 0.78, 0.03, 1.856], sliding: [14.1, 2.45, 2.30, 0.10], gradient: [1.51, 0.52] },
    Fit { gamma: 1.0 / 6.0, pressure: [1.38, 0.42, 1.0], shear: [1.962, 1.08, 0.77, 0.03, 1.754], sliding: [13.4, 2.42, 2.30, 0.10], gradient: [1.51, 0.54] },
    Fit { gamma: 1.0 / 3.0, pressure: [1.18, 0.42, 0.75], shear: [1.858, 1.01, 0.76, 0.03, 1.561], sliding: [12.3, 2.32, 2.30, 0.10], gradient: [1.47, 0.58] },
    Fit { gamma: 1.0, pressure: [0.90, 0.56, 0.5], shear: [1.899, 0.98, 0.92, 0.05, 1.126], sliding: [11.1, 2.31, 2.38, 0.11], gradient: [1.40, 0.66] },
    Fit { gamma: 3.0, pressure: [0.225, 1.5, 0.5], shear: [1.560, 0.85, 1.13, 0.08, 0.556], sliding: [9.8, 2.25, 2.80, 0.18], gradient: [0.98, 0.79] },
    Fit { gamma: 6.0, pressure: [0.520, 1.5, 0.5], shear: [1.290, 0.62, 1.09, 0.08, 0.388], sliding: [10.1, 2.25, 2.90, 0.18], gradient: [0.97, 0.91] },
    Fit { gamma: 9.0, pressure: [0.870, 1.5, 0.5], shear: [1.011, 0.54, 1.07, 0.08, 0.295], sliding: [8.7, 2.15, 2.97, 0.18], gradient: [0.73, 0.91] },
];
/// Separation at which the shear flow changes to its exponential, and above which sliding has no difference of shear stresses.
const FAR: [f64; 2] = [5.0, 7.0];
/// Gap below which no shear stress of sliding is counted, over three root mean square heights.
const LEAST_GAP: f64 = 1.0 / 300.0;
/// Separation over three root mean square heights above which the mean of the shear stress is a series.
const SERIES: f64 = 5.0;

impl Fit {
    fn pressure_flow(&self, separation: f64) -> f64 {
        let [c, r, least] = self.pressure;
        let h = separation.max(least);
        if self.gamma > 1.0 { 1.0 + c * h.powf(-r) } else { 1.0 - c * (-r * h).exp() }
    }

    fn shear_flow(&self, separation: f64) -> f64 {
        let [a, power, linear, square, far] = self.shear;
        if separation > FAR[0] {
            far * (-0.25 * separation).exp()
        } else {
            a * separation.powf(power) * (separation * (square * separation - linear)).exp()
        }
    }

    fn sliding(&self, separation: f64) -> f64 {
        let [a, power, linear, square] = self.sliding;
        if separation > FAR[1] {
            return 0.0;
        }
        a * separation.powf(power) * (separation * (square * separation - linear)).exp()
    }

    fn gradient(&self, separation: f64) -> f64 {
        let [d, s] = self.gradient;
        1.0 - d * (-s * separation.max(self.pressure[2])).exp()
    }
}

/// Flow factors of Gaussian roughness with the Peklenik number `gamma`, as functions of the nominal film over the
/// root mean square height of both surfaces together.
///
/// The mean flow along the motion is `u (h_T + s sigma phi_s) - phi_x h^3/(12 eta) dp/dx`, across it `-phi_y h^3/(12 eta) dp/dy`, with the
/// mean gap `h_T` and the slip `s = (u_1 - u_2)/(u_1 + u_2)`. Shear stresses are `eta (u_2 - u_1)/h (phi_f +- phi_fs) +- phi_fp h/2 dp/dx`.
///
/// The Peklenik number is the ratio of the correlation lengths along and across the motion: 1 for isotropic surfaces, above 1 for a lay along
/// it. Between the tabulated numbers the factors are linear in its logarithm. `phi_y` is `phi_x` of `1/gamma`.
///
/// Sources: Patir and Cheng (1978), J. Lubr. Technol. 100, 12-17, doi 10.1115/1.3453103; (1979), J. Lubr. Technol. 101, 220-229,
/// doi 10.1115/1.3453329.
///
/// ```
/// use stribeck::analytic::PatirCheng;
/// let isotropic = PatirCheng::new(1.0)?;
/// let [along, across] = isotropic.pressure_flow(3.0);
/// assert!((along - (1.0 - 0.9 * (-1.68_f64).exp())).abs() < 1e-12 && along == across);
/// assert!(PatirCheng::new(20.0).is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PatirCheng {
    gamma: f64,
}

impl PatirCheng {
    /// Factors for the Peklenik number `gamma`.
    ///
    /// # Errors
    /// A number outside 1/9 to 9.
    pub fn new(gamma: f64) -> Result<Self, InputError> {
        let requirement =
            "1/9 to 9, the range of the flow factors: correlation length along the motion over that across";
        let inside = (0.111..=9.0).contains(&gamma);
        InputError::require(inside, "gamma", gamma, requirement)?;
        Ok(Self { gamma })
    }

    /// The Peklenik number.
    pub fn gamma(&self) -> f64 {
        self.gamma
    }

    /// Smallest nominal film over the root mean square height at which the factors were fitted. Below it those of pressure flow
    /// have their values there.
    pub fn least_separation(&self) -> f64 {
        let [(low, _), (high, _)] = weights(self.gamma);
        low.pressure[2].max(high.pressure[2])
    }

    /// `[phi_x, phi_y]` at a `separation` above 0.
    pub fn pressure_flow(&self, separation: f64) -> [f64; 2] {
        [self.gamma, 1.0 / self.gamma].map(|gamma| between(gamma, |fit| fit.pressure_flow(separation)))
    }

    /// `Phi_s` of one surface with all of the roughness: `phi_s = (sigma_1^2 - sigma_2^2)/sigma^2 Phi_s`.
    pub fn shear_flow(&self, separation: f64) -> f64 {
        between(self.gamma, |fit| fit.shear_flow(separation))
    }

    /// `[phi_f, Phi_fs, phi_fp]`; `Phi_fs` of one surface with all of the roughness.
    ///
    /// `phi_f` is the mean of `h/h_T` over gaps above a hundredth of the root mean square height, of the polynomial height
    /// density `35/96 (1 - (z/3)^2)^3`.
    pub fn shear_stress(&self, separation: f64) -> [f64; 3] {
        let sliding = between(self.gamma, |fit| fit.sliding(separation));
        [mean_shear(separation / 3.0), sliding, between(self.gamma, |fit| fit.gradient(separation))]
    }

    /// Mean gap over the root mean square height, `h_T/sigma`, with overlapping Gaussian heights cut off; `separation` from -4 on.
    pub fn mean_gap(&self, separation: f64) -> f64 {
        separation + asperity_moment(1.0, separation)
    }
}

/// The fits on both sides of `gamma` with their weights.
fn weights(gamma: f64) -> [(&'static Fit, f64); 2] {
    let [first, .., last] = &FITS;
    let mut ends = [first, last];
    for fit in &FITS {
        if fit.gamma <= gamma && fit.gamma > ends[0].gamma {
            ends[0] = fit;
        }
        if fit.gamma >= gamma && fit.gamma < ends[1].gamma {
            ends[1] = fit;
        }
    }
    let [low, high] = ends.map(|fit| fit.gamma.ln());
    let share = if high > low { ((gamma.ln() - low) / (high - low)).clamp(0.0, 1.0) } else { 0.0 };
    [(ends[0], 1.0 - share), (ends[1], share)]
}

/// A factor at `gamma`.
fn between(gamma: f64, of: impl Fn(&Fit) -> f64) -> f64 {
    weights(gamma).into_iter().map(|(fit, weight)| if weight > 0.0 { weight * of(fit) } else { 0.0 }).sum()
}

/// `phi_f` at the separation `3 z`.
fn mean_shear(z: f64) -> f64 {
    let square = z * z;
    if z > SERIES {
        // Mean of 1/(1 + s/z) with the moments 1/9, 1/33 and 5/429 of s^2, s^4 and s^6.
        return 1.0 + (1.0 / 9.0 + (1.0 / 33.0 + 5.0 / 429.0 / square) / square) / square;
    }
    let cube = (1.0 - square).powi(3);
    let rest = if z > 1.0 {
        cube * ((z + 1.0) / (z - 1.0)).ln() + z / 15.0 * (66.0 + square * (30.0 * square - 80.0))
    } else {
        let polynomial =
            -55.0 + z * (132.0 + z * (345.0 + z * (-160.0 + z * (-405.0 + z * (60.0 + 147.0 * z)))));
        cube * ((z + 1.0) / LEAST_GAP).ln() + polynomial / 60.0
    };
    35.0 / 32.0 * z * rest
}
