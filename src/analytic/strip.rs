//! Displacement of a half-space under a uniformly loaded strip, plane strain.

use std::f64::consts::PI;

/// Distance in half-widths beyond which the series in the distance is exact to rounding.
const FAR: f64 = 8.0;
/// Terms of that series; the first omitted one is below 1e-17.
const TERMS: u32 = 8;

/// Integral of `ln(reference/|x - s|)` \[m\] over the strip `|s| <= half_width`, evaluated at the point `x`
/// of its plane.
///
/// All lengths in metres. The displacement by an infinitely long strip is unbounded, so it is relative to
/// that at the distance `reference` from a line load, where the integrand is zero. Defined for every finite
/// `x`, inside, outside and on the edges. A strip of zero width gives zero, arguments out of range
/// (`reference` above zero, `half_width` non-negative) `NaN`.
///
/// Beyond 8 half-widths a series in `half_width/x` avoids the cancellation between the two edge terms.
///
/// Source: Johnson, K. L. (1985), Contact Mechanics, section 2.3.
///
/// ```
/// use stribeck::analytic::strip_potential;
/// // the centre of a strip of width 2: 2 ln(reference) + 2
/// assert!((strip_potential(0.0, 1.0, 10.0) - 2.0 * (10.0_f64.ln() + 1.0)).abs() < 1e-14);
/// // far field: width times the logarithm
/// assert!((strip_potential(1e9, 1.0, 1e10) / (2.0 * 10.0_f64.ln()) - 1.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn strip_potential(x: f64, half_width: f64, reference: f64) -> f64 {
    let finite = [x, half_width, reference].iter().all(|v| v.is_finite());
    if !finite || half_width < 0.0 || reference <= 0.0 {
        return f64::NAN;
    }
    if half_width == 0.0 {
        return 0.0;
    }
    let distance = x.abs();
    if distance > FAR * half_width {
        let square = (half_width / distance).powi(2);
        let mut sum = 0.0;
        for m in (1..=TERMS).rev() {
            let weight = f64::from(2 * m * (2 * m + 1));
            sum = square * (sum + 1.0 / weight);
        }
        return 2.0 * half_width * ((reference / distance).ln() + sum);
    }
    let edge = |u: f64| if u == 0.0 { 0.0 } else { u * (reference / u.abs()).ln() };
    edge(distance + half_width) - edge(distance - half_width) + 2.0 * half_width
}

/// Displacement \[m\] of the pair of surfaces at `x` under `pressure` \[Pa\] on the strip `|s| <= half_width`
/// \[m\], plane strain: `u = 4 p / (pi E') g(x)` with the equivalent modulus `E'` \[Pa\] and
/// [`strip_potential`] `g`.
///
/// Arguments outside their range (`E'` and `reference` above zero, width non-negative, all finite) give
/// `NaN`.
///
/// Source: Johnson, K. L. (1985), Contact Mechanics, section 2.3.
///
/// ```
/// use stribeck::analytic::strip_displacement;
/// // a strip of 1 um under 1 GPa, steel, relative to points at 10 mm
/// let u = strip_displacement(0.0, 0.5e-6, 10e-3, 1e9, 230e9);
/// assert!((u - 4e9 / (std::f64::consts::PI * 230e9) * 1e-6 * (2e4_f64.ln() + 1.0)).abs() < 1e-20);
/// ```
#[must_use]
pub fn strip_displacement(
    x: f64,
    half_width: f64,
    reference: f64,
    pressure: f64,
    equivalent_modulus: f64,
) -> f64 {
    if !(equivalent_modulus.is_finite() && equivalent_modulus > 0.0 && pressure.is_finite()) {
        return f64::NAN;
    }
    4.0 * pressure / (PI * equivalent_modulus) * strip_potential(x, half_width, reference)
}
