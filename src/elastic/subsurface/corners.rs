//! Stresses under a uniformly loaded rectangle as differences over its corners.
//!
//! With `X = x - x'`, `Y = y - y'` and `r^2 = X^2 + Y^2 + z^2` the stress under a point load is `g(X, Y)`. A
//! function `G` with `d^2 G/dX dY = g` gives the stress under a rectangle: the sum of `G` at two opposite
//! corners less that at the other two. Loads are unit loads, without the factor `1/(2 pi)`.

/// Number of stress components, in the order xx, yy, zz, xy, xz, yz.
pub(super) const COMPONENTS: usize = 6;

/// Whether `G` of each component is odd (or else even) in `X` and in `Y`.
pub(super) type Parities = [[bool; 2]; COMPONENTS];

/// Parities under a pressure.
pub(super) const UNDER_PRESSURE: Parities =
    [[true, true], [true, true], [true, true], [false, false], [false, true], [true, false]];
/// Parities under a traction along x.
pub(super) const UNDER_TRACTION: Parities =
    [[false, true], [false, true], [false, true], [true, false], [true, true], [false, false]];

/// `G` of a pressure: the integrated Boussinesq solution (Love 1929).
pub(super) fn under_pressure(poisson: f64, [x, y, z]: [f64; 3]) -> [f64; COMPONENTS] {
    let (u, v) = (x * x + z * z, y * y + z * z);
    let r = (x * x + y * y + z * z).sqrt();
    let solid_angle = (x * y / (z * r)).atan();
    let compressible = 1.0 - 2.0 * poisson;
    let along = |x: f64, y: f64| {
        -compressible * (x * y * (r - z)).atan2(x * x * r + z * y * y) + z * x * y / ((x * x + z * z) * r)
    };
    [
        along(x, y) - 2.0 * poisson * solid_angle,
        along(y, x) - 2.0 * poisson * solid_angle,
        -solid_angle - z * x * y * (r * r + z * z) / (r * u * v),
        -compressible * (z + r).ln() - z / r,
        z * z * y / (u * r),
        z * z * x / (v * r),
    ]
}

/// `G` of a traction along x on the lower body: the integrated Cerruti solution.
pub(super) fn under_traction(poisson: f64, [x, y, z]: [f64; 3]) -> [f64; COMPONENTS] {
    let (u, v) = (x * x + z * z, y * y + z * z);
    let r = (x * x + y * y + z * z).sqrt();
    let compressible = 1.0 - 2.0 * poisson;
    let (log_x, log_y) = ((x / v.sqrt()).asinh(), (y / u.sqrt()).asinh());
    [
        x * x * y / (u * r) + 2.0 * log_y - compressible * y / (r + z),
        -y / r + log_y + compressible * (y / (r + z) - log_y),
        z * z * y / (u * r),
        -x / r + log_x + compressible * x / (r + z),
        z * x * y / (u * r) - (x * y / (z * r)).atan(),
        -z / r,
    ]
}
