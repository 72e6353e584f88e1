//! Pressure of a full film between rigid paraboloids, the far field of every lubricated contact.

use std::f64::consts::PI;

use crate::error::InputError;

/// Steps of the angle from upstream to downstream.
const ANGLES: usize = 2000;
/// Ratio of the radii beyond which the pressure across the flow is that of the inlet alone: the film at the sides is
/// then too flat (or too steep) for it to reach downstream.
const LARGEST_RATIO: f64 = 20.0;

/// Reduced pressure of a flooded, isoviscous film `h = h_0 + x^2/(2 R_x) + y^2/(2 R_y)` between rigid surfaces that
/// entrain along x.
///
/// Upstream it is Kapitza's solution of Reynolds' equation, exact for any `h_0`,
///
/// `q = -12 eta_0 u (a_x x + a_y y) / h^2`, `(H + 2 tr(H) I) a = H e_x`,
///
/// with the curvatures `H` of the gap: `q = 12 eta_0 u (-x) / [(3 + 2 R_x/R_y) h^2]` where its axes are those of the
/// flow, `4 eta_0 u (-x)/h^2` of a line contact. Downstream of the sides the film ruptures. Where the gap is far wider
/// than `h_0` and its axes are those of the flow, Reynolds' condition `q = dq/dn = 0` at the rupture is met by
///
/// `q = c eta_0 u r f(t)/h^2`, `f = cos t + B F(t) [g(t)/g(0)]^2`, `(g^3 F')' = 9 g^3 F`, `F(0) = 1`, `F'(0) = 0`,
///
/// with the angle `t` from upstream and `g = cos^2 t/(2 R_x) + sin^2 t/(2 R_y)`: a homogeneous solution that falls as
/// `r^-3` beside Kapitza's. A sphere ruptures at 108.5 degrees with `B = 0.00216`.
///
/// Source of the first: Kapitza, P. L. (1955), Zhurnal Tekhnicheskoi Fiziki 25, 747-762.
///
/// # Examples
///
/// ```
/// use stribeck::analytic::RigidParaboloids;
/// let sphere = RigidParaboloids::new([1.0 / 15e-3, 0.0, 1.0 / 15e-3])?;
/// let (drag, x, film) = (0.05 * 0.315, -1e-3, 3.4e-5); // eta_0 u, place, film there
/// let kapitza = 2.4 * drag * -x / (film * film);
/// assert!((sphere.reduced_pressure(drag, [x, 0.0], film) / kapitza - 1.0).abs() < 0.01);
/// assert!(sphere.reduced_pressure(drag, [-x, 0.0], film) == 0.0);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone)]
pub struct RigidParaboloids {
    /// `12 a` of Kapitza's solution.
    direction: [f64; 2],
    /// `f(t) - cos t` at [`ANGLES`] steps up to the rupture; empty where only the inlet counts.
    beside: Vec<f64>,
}

impl RigidParaboloids {
    /// Of the curvatures `[1/R_xx, 1/R_xy, 1/R_yy]` of the gap \[1/m\]: its second derivatives. A line contact has the
    /// first alone.
    ///
    /// # Errors
    /// Curvatures that are not finite, or of a gap that does not open upstream.
    pub fn new([xx, xy, yy]: [f64; 3]) -> Result<Self, InputError> {
        InputError::require_positive("curvatures.xx", xx)?;
        InputError::require_non_negative("curvatures.yy", yy)?;
        InputError::require(xy.is_finite(), "curvatures.xy", xy, "finite")?;
        let trace = 2.0 * (xx + yy);
        let determinant = (xx + trace) * (yy + trace) - xy * xy;
        let direction = [
            12.0 * ((yy + trace) * xx - xy * xy) / determinant,
            12.0 * ((xx + trace) * xy - xy * xx) / determinant,
        ];
        let ratio = xx / yy;
        let is_round = xy == 0.0 && ratio < LARGEST_RATIO && ratio * LARGEST_RATIO > 1.0;
        let beside = if is_round { homogeneous(xx, yy) } else { Vec::new() };
        Ok(Self { direction, beside })
    }

    /// `q` \[Pa\] at the point `(x, y)` \[m\] where the film is `film` \[m\], `drag` being `eta_0 u` \[N/m\]; zero
    /// where the film has ruptured.
    pub fn reduced_pressure(&self, drag: f64, [x, y]: [f64; 2], film: f64) -> f64 {
        let kapitza = -(self.direction[0] * x + self.direction[1] * y);
        let beside = match self.beside.len() {
            0 => 0.0,
            n => {
                let step = (y.abs().atan2(-x) / PI * ANGLES as f64) as usize;
                if step >= n {
                    return 0.0;
                }
                self.direction[0] * x.hypot(y) * self.beside[step]
            }
        };
        drag * (kapitza + beside).max(0.0) / (film * film)
    }
}

/// `B F (g/g_0)^2` from upstream to the rupture, where `f` and its derivative are zero.
fn homogeneous(xx: f64, yy: f64) -> Vec<f64> {
    let step = PI / ANGLES as f64;
    let g = |t: f64| (t.cos().powi(2) + yy / xx * t.sin().powi(2)) * 0.5;
    let slope = |t: f64, [f, flux]: [f64; 2]| [flux / g(t).powi(3), 9.0 * g(t).powi(3) * f];
    let opening = |t: f64| (g(t) / g(0.0)).powi(2);
    // `cos t / (g/g_0)^2`, which `-B F` touches at the rupture.
    let wedge = |t: f64| t.cos() / opening(t);
    let wedge_slope = |t: f64| (wedge(t + 1e-6) - wedge(t - 1e-6)) / 2e-6;
    let (mut values, mut state, mut factor) = (vec![1.0], [1.0, 0.0], 0.0);
    for i in 0..ANGLES {
        let t = i as f64 * step;
        let moved = |k: [f64; 2], by: f64| [state[0] + by * k[0], state[1] + by * k[1]];
        let k1 = slope(t, state);
        let k2 = slope(t + 0.5 * step, moved(k1, 0.5 * step));
        let k3 = slope(t + 0.5 * step, moved(k2, 0.5 * step));
        let k4 = slope(t + step, moved(k3, step));
        state = std::array::from_fn(|c| state[c] + step / 6.0 * (k1[c] + 2.0 * (k2[c] + k3[c]) + k4[c]));
        let end = t + step;
        if wedge_slope(end) * state[0] - wedge(end) * state[1] / g(end).powi(3) > 0.0 {
            factor = -wedge(end) / state[0];
            break;
        }
        values.push(state[0]);
    }
    values.iter().enumerate().map(|(i, value)| factor * value * opening(i as f64 * step)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sphere_ruptures_at_108_degrees() {
        let sphere = RigidParaboloids::new([1.0, 0.0, 1.0]).unwrap();
        let degrees = sphere.beside.len() as f64 / ANGLES as f64 * 180.0;
        assert!((degrees - 108.45).abs() < 0.1, "{degrees}");
        assert!((sphere.beside[0] - 0.00216).abs() < 1e-5, "{}", sphere.beside[0]);
    }

    /// The balance of a turned gap by differences: the divergence of `h^3 grad q` is `12 eta u dh/dx`.
    #[test]
    fn kapitza_solves_reynolds_equation_of_a_turned_gap() {
        let [xx, xy, yy] = [80.0, 15.0, 40.0];
        let turned = RigidParaboloids::new([xx, xy, yy]).unwrap();
        let film = |x: f64, y: f64| 1e-6 + 0.5 * (xx * x * x + 2.0 * xy * x * y + yy * y * y);
        let q = |x: f64, y: f64| turned.reduced_pressure(0.02, [x, y], film(x, y));
        let (x, y, d) = (-4e-4, 1e-4, 1e-6);
        let flux = |x0: f64, y0: f64, x1: f64, y1: f64| {
            film(0.5 * (x0 + x1), 0.5 * (y0 + y1)).powi(3) * (q(x1, y1) - q(x0, y0)) / d
        };
        let divergence =
            (flux(x, y, x + d, y) - flux(x - d, y, x, y) + flux(x, y, x, y + d) - flux(x, y - d, x, y)) / d;
        let wedge = 12.0 * 0.02 * (xx * x + xy * y);
        assert!((divergence / wedge - 1.0).abs() < 1e-4, "{divergence} {wedge}");
    }

    #[test]
    fn line_has_four_eta_u_x_over_film_squared() {
        let line = RigidParaboloids::new([100.0, 0.0, 0.0]).unwrap();
        let q = line.reduced_pressure(0.03, [-2e-4, 0.0], 3e-6);
        assert!((q / (4.0 * 0.03 * 2e-4 / 9e-12) - 1.0).abs() < 1e-12);
    }
}
