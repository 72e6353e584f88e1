//! Hertz contact of two curved bodies with a circular or elliptical contact area.

use std::f64::consts::PI;

use crate::error::InputError;

/// Equivalent modulus `E'` \[Pa\] of two elastic bodies: `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`, with Young's
/// moduli \[Pa\] and Poisson's ratios. It is twice the contact modulus `E*` of other texts.
///
/// # Errors
/// A modulus that is not finite and positive, a Poisson's ratio outside -1 < v <= 0.5.
///
/// ```
/// let steel = stribeck::analytic::equivalent_modulus([209e9, 0.3], [209e9, 0.3])?;
/// assert!((steel - 229.67e9).abs() < 1e7);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub fn equivalent_modulus(first: [f64; 2], second: [f64; 2]) -> Result<f64, InputError> {
    let mut compliance = 0.0;
    for [modulus, ratio] in [first, second] {
        InputError::require_positive("youngs_modulus", modulus)?;
        InputError::require(
            ratio > -1.0 && ratio <= 0.5,
            "poissons_ratio",
            ratio,
            "above -1 and at most 0.5",
        )?;
        compliance += (1.0 - ratio * ratio) / modulus;
    }
    Ok(2.0 / compliance)
}

/// A dry, smooth, frictionless point contact of bodies whose gap is `x^2/(2 Rx) + y^2/(2 Ry)`.
///
/// Pressure `p = pressure sqrt(1 - (x/half_width_x)^2 - (y/half_width_y)^2)`. With `k` the ratio of the short semi-axis `b` to the
/// long one `a`, `e^2 = 1 - k^2`, `K` and `E` the complete elliptic integrals of modulus `e` and
/// `s = (K - E)/(e^2 K)`:
///
/// * the ratio of the radii fixes `k`: `R_long / R_short = (1 - s)/(k^2 s)`,
/// * load `W = pi E' a^3 / (6 R_long K s)`, maximum pressure `pressure = 3 W / (2 pi a b)`,
/// * approach `a^2 / (2 R_long s)`.
///
/// For `Rx = Ry = R` these are `a^3 = 3 W R / (2 E')`, `pressure = a E' / (pi R)` and `a^2 / R`. The elliptic
/// integrals are computed by the arithmetic-geometric mean and `k` by a bracketed root search, both to
/// rounding; no fitted formula is used.
///
/// Source: Hertz, H. (1882), Journal fuer die reine und angewandte Mathematik 92, 156-171; Johnson, K. L.
/// (1985), Contact Mechanics, chapter 4.
///
/// ```
/// use stribeck::analytic::HertzPoint;
/// let ball = HertzPoint::from_max_pressure(9.525e-3, 9.525e-3, 229.67e9, 1.15e9)?;
/// assert!((ball.half_width_x - 149.83e-6).abs() < 0.01e-6);
/// assert!((ball.force - 54.07).abs() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct HertzPoint {
    /// Radius of curvature in the x direction \[m\].
    pub radius_x: f64,
    /// Radius of curvature in the y direction \[m\].
    pub radius_y: f64,
    /// Equivalent modulus `E'` \[Pa\].
    pub equivalent_modulus: f64,
    /// Load \[N\].
    pub force: f64,
    /// Maximum pressure \[Pa\].
    pub pressure: f64,
    /// Semi-axis of the contact along x \[m\].
    pub half_width_x: f64,
    /// Semi-axis of the contact along y \[m\].
    pub half_width_y: f64,
    /// Approach of distant points of the two bodies \[m\].
    pub approach: f64,
}

/// Dimensionless solution, a function of the ratio of radii.
struct Shape {
    /// Short over long semi-axis.
    axis_ratio: f64,
    /// Complete elliptic integral of the first kind.
    integral: f64,
    /// `(K - E) / (e^2 K)`.
    share: f64,
    radius_long: f64,
}

impl HertzPoint {
    /// Largest accepted ratio of the two radii; beyond it the contact is practically a line contact.
    pub const MAX_RADIUS_RATIO: f64 = 1e8;

    /// Contact of radii `radius_x`, `radius_y` \[m\] and equivalent modulus `E'` \[Pa\] under `load` \[N\].
    ///
    /// # Errors
    /// An argument that is not finite and positive, a ratio of radii above [`HertzPoint::MAX_RADIUS_RATIO`],
    /// or a result that overflows.
    ///
    /// ```
    /// use stribeck::analytic::HertzPoint;
    /// let contact = HertzPoint::from_load(20e-3, 10e-3, 230e9, 50.0)?;
    /// assert!(contact.half_width_x > contact.half_width_y);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn from_load(
        radius_x: f64,
        radius_y: f64,
        equivalent_modulus: f64,
        load: f64,
    ) -> Result<Self, InputError> {
        let shape = Shape::of(radius_x, radius_y)?;
        InputError::require_positive("equivalent_modulus", equivalent_modulus)?;
        InputError::require_positive("load", load)?;
        let scale = shape.radius_long * shape.integral * shape.share;
        let long = (6.0 * load * scale / (PI * equivalent_modulus)).cbrt();
        shape.contact(radius_x, radius_y, equivalent_modulus, long)
    }

    /// Contact of radii `radius_x`, `radius_y` \[m\] and equivalent modulus `E'` \[Pa\] whose maximum
    /// pressure is `max_pressure` \[Pa\].
    ///
    /// # Errors
    /// As [`HertzPoint::from_load`].
    ///
    /// ```
    /// use stribeck::analytic::HertzPoint;
    /// let contact = HertzPoint::from_max_pressure(10e-3, 10e-3, 230e9, 1e9)?;
    /// assert!((contact.half_width_x / (std::f64::consts::PI * 10e-3 * 1e9 / 230e9) - 1.0).abs() < 1e-14);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn from_max_pressure(
        radius_x: f64,
        radius_y: f64,
        equivalent_modulus: f64,
        max_pressure: f64,
    ) -> Result<Self, InputError> {
        let shape = Shape::of(radius_x, radius_y)?;
        InputError::require_positive("equivalent_modulus", equivalent_modulus)?;
        InputError::require_positive("max_pressure", max_pressure)?;
        let scale = shape.radius_long * shape.axis_ratio * shape.integral * shape.share;
        let long = 4.0 * max_pressure * scale / equivalent_modulus;
        shape.contact(radius_x, radius_y, equivalent_modulus, long)
    }

    /// Pressure \[Pa\] at `(x, y)` \[m\] from the centre; zero outside the contact.
    ///
    /// ```
    /// use stribeck::analytic::HertzPoint;
    /// let contact = HertzPoint::from_max_pressure(10e-3, 10e-3, 230e9, 1e9)?;
    /// assert!((contact.pressure_at(0.0, 0.0) / contact.pressure - 1.0).abs() < 1e-15);
    /// assert!(contact.pressure_at(1.1 * contact.half_width_x, 0.0).abs() < 1e-300);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn pressure_at(&self, x: f64, y: f64) -> f64 {
        self.pressure
            * (1.0 - (x / self.half_width_x).powi(2) - (y / self.half_width_y).powi(2)).max(0.0).sqrt()
    }

    /// Mean pressure \[Pa\], two thirds of the maximum.
    ///
    /// ```
    /// # use stribeck::analytic::HertzPoint;
    /// let contact = HertzPoint::from_max_pressure(10e-3, 10e-3, 230e9, 1.2e9)?;
    /// assert!((contact.mean_pressure() - 0.8e9).abs() < 1.0);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn mean_pressure(&self) -> f64 {
        self.pressure * 2.0 / 3.0
    }

    /// Contact area `pi half_width_x half_width_y` \[m^2\].
    ///
    /// ```
    /// # use stribeck::analytic::HertzPoint;
    /// let contact = HertzPoint::from_load(10e-3, 10e-3, 230e9, 50.0)?;
    /// assert!((contact.area() * contact.mean_pressure() - 50.0).abs() < 1e-10);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    #[must_use]
    pub fn area(&self) -> f64 {
        PI * self.half_width_x * self.half_width_y
    }
}

impl Shape {
    fn of(radius_x: f64, radius_y: f64) -> Result<Self, InputError> {
        InputError::require_positive("radius_x", radius_x)?;
        InputError::require_positive("radius_y", radius_y)?;
        let (radius_long, radius_short) = (radius_x.max(radius_y), radius_x.min(radius_y));
        let ratio = radius_long / radius_short;
        InputError::require(
            ratio <= HertzPoint::MAX_RADIUS_RATIO,
            "radius_x / radius_y",
            radius_x / radius_y,
            "between 1e-8 and 1e8",
        )?;
        let axis_ratio = axis_ratio(ratio);
        let (integral, share) = elliptic(axis_ratio);
        Ok(Self { axis_ratio, integral, share, radius_long })
    }

    /// The contact with long semi-axis `long`.
    fn contact(
        &self,
        radius_x: f64,
        radius_y: f64,
        modulus: f64,
        long: f64,
    ) -> Result<HertzPoint, InputError> {
        let short = self.axis_ratio * long;
        let (half_width_x, half_width_y) = if radius_x >= radius_y { (long, short) } else { (short, long) };
        let pressure =
            modulus * long / (4.0 * self.radius_long * self.axis_ratio * self.integral * self.share);
        let load = 2.0 / 3.0 * PI * half_width_x * half_width_y * pressure;
        for (field, value) in [("contact semi-axis", short), ("max_pressure", pressure), ("load", load)] {
            InputError::require_positive(field, value)?;
        }
        Ok(HertzPoint {
            radius_x,
            radius_y,
            equivalent_modulus: modulus,
            force: load,
            pressure,
            half_width_x,
            half_width_y,
            approach: long * long / (2.0 * self.radius_long * self.share),
        })
    }
}

/// `(K, (K - E)/(e^2 K))` for semi-axes in the ratio `k = sqrt(1 - e^2)`, `0 < k <= 1`, by the
/// arithmetic-geometric mean: `K = pi/(2 a_n)`, `E = K (1 - sum 2^(n-1) c_n^2)` with `c_0 = e`,
/// `c_(n+1) = c_n^2/(4 a_(n+1))`.
fn elliptic(k: f64) -> (f64, f64) {
    let squared = (1.0 - k) * (1.0 + k);
    let (mut mean, mut geometric) = (1.0, k);
    // c_n^2 / e^2, which covers the circle (e = 0) without a special case
    let mut relative = 1.0_f64;
    let mut share = 0.5;
    let mut weight = 1.0;
    for _ in 0..64 {
        let next = 0.5 * (mean + geometric);
        geometric = (mean * geometric).sqrt();
        mean = next;
        relative = relative * relative * squared / (16.0 * mean * mean);
        share += weight * relative;
        weight *= 2.0;
        if weight * relative < 1e-18 {
            break;
        }
    }
    (PI / (2.0 * mean), share)
}

/// Short over long semi-axis for a ratio of radii `ratio >= 1`, by bisection in the logarithm between
/// `1/ratio` and `1/sqrt(ratio)`, which bracket the root.
fn axis_ratio(ratio: f64) -> f64 {
    let target = ratio.ln();
    let excess = |log_k: f64| {
        let k = log_k.exp();
        let (_, share) = elliptic(k);
        ((1.0 - share) / share).ln() - 2.0 * log_k - target
    };
    let (mut low, mut high) = (-target, -0.5 * target);
    while high - low > 1e-16 * (1.0 + target) {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if excess(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    (0.5 * (low + high)).exp().min(1.0)
}
