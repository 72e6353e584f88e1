//! Correction of a half-space's stresses for a bonded layer, under loads of one wave vector.
//!
//! With `q` the wave number, `x = q z`, `d = q h`, and loads `exp(i q l)` along the direction `l` of the
//! wave, plane strain in `l` and `z` has Airy's function `f(x)/q^2`:
//!
//! `ll = f''`, `zz = -f`, `lz = -i f'`, `2 G q u_l = -i U`, `2 G q u_z = W`,
//! `U = (1 - v) f'' + v f`, `W = (1 - v) f''' - (2 - v) f'`.
//!
//! A half-space has `f_0 = (1 + x) exp(-x)` under unit pressure and `x exp(-x)` under `f'(0) = 1`, a shear
//! along `l`. In the layer `f = f_0 + g`, in the substrate `f = f_0 + k` with
//!
//! `g = A x sinh x + B (sinh x - x cosh x)`, `k = [g(d) + (g(d) + g'(d)) (x - d)] exp(d - x)`:
//!
//! The function `g` leaves the loads at the surface unchanged; `k` continues the tractions across the bond.
//! Continuity of `u_l` and `u_z` determines `A` and `B`. Hyperbolic functions are scaled by `exp(-d)`, so
//! that all exponents are negative: thick layers do not overflow, and for thin ones the two equations remain
//! independent. Shear across `l` has `tz = v'(x)`, `lt = i v`, `v'' = v` and is treated in the same way.
//!
//! Source: Burmister, D. M. (1945), Journal of Applied Physics 16, 89-94 (the conditions at the bond).

use super::Layer;

/// A function of `x = q z` and its three derivatives.
type Derivatives = [f64; 4];

/// Correction functions: `g` or `k` under unit pressure and under unit `f'(0)`, with derivatives, and
/// `v - exp(-x)` with its derivative.
#[derive(Debug, Clone, Copy)]
pub(super) struct LayerCorrection {
    /// Under unit pressure.
    pub(super) pressure: Derivatives,
    /// Under unit `f'(0)`.
    pub(super) shear: Derivatives,
    /// Correction of `v` and `v'` under unit shear across the wave vector.
    pub(super) across: [f64; 2],
}

/// Layer or substrate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Body {
    /// The layer.
    Layer,
    /// The half-space below it.
    Substrate,
}

impl LayerCorrection {
    /// The correction for `exp(-d) = 0`, where the wave does not reach the bond.
    const ZERO: Self = Self { pressure: [0.0; 4], shear: [0.0; 4], across: [0.0; 2] };
}

impl Layer {
    /// The correction at the depth `z` \[m\] of `body` for the wave number `q` \[1/m\].
    pub(super) fn correction(&self, q: f64, z: f64, body: Body) -> LayerCorrection {
        let d = q * self.thickness();
        if (-d).exp() == 0.0 {
            return LayerCorrection::ZERO;
        }
        let bases = bases(d, d);
        let amplitudes = [pressed(d), sheared(d)].map(|load| self.amplitudes(&bases, &load));
        // Shear across: `v = exp(-x)` of the half-space plus `a cosh x`.
        let (sinh, cosh) = scaled(d, d);
        let a = (self.moduli - 1.0) * (-d).exp() / (cosh + self.moduli * sinh);
        match body {
            Body::Layer => {
                let here = self::bases(q * z, d);
                let [pressure, shear] = amplitudes.map(|by| combined(&here, by));
                let (sinh, cosh) = scaled(q * z, d);
                LayerCorrection { pressure, shear, across: [a * cosh, a * sinh] }
            }
            Body::Substrate => {
                let below = q * (z - self.thickness());
                let [pressure, shear] = amplitudes.map(|by| continued(&combined(&bases, by), below));
                let v = -a * sinh * (-below).exp();
                LayerCorrection { pressure, shear, across: [v, -v] }
            }
        }
    }

    /// `A` and `B` from the displacements at the bond, where the half-space solution is `load`.
    fn amplitudes(&self, [first, second]: &[Derivatives; 2], load: &Derivatives) -> [f64; 2] {
        let ([own, below], m) = (self.poissons, self.moduli);
        let jump = |g: &Derivatives| {
            let k = continued(g, 0.0);
            [along(g, own) - m * along(&k, below), into(g, own) - m * into(&k, below)]
        };
        let [a, b] = [jump(first), jump(second)];
        let right = [m * along(load, below) - along(load, own), m * into(load, below) - into(load, own)];
        let determinant = a[0] * b[1] - b[0] * a[1];
        [(right[0] * b[1] - b[0] * right[1]) / determinant, (a[0] * right[1] - right[0] * a[1]) / determinant]
    }
}

/// `U` of `f`.
fn along(f: &Derivatives, poisson: f64) -> f64 {
    (1.0 - poisson) * f[2] + poisson * f[0]
}

/// `W` of `f`.
fn into(f: &Derivatives, poisson: f64) -> f64 {
    (1.0 - poisson) * f[3] - (2.0 - poisson) * f[1]
}

/// `f_0` of a half-space under unit pressure.
fn pressed(x: f64) -> Derivatives {
    [1.0 + x, -x, x - 1.0, 2.0 - x].map(|value| value * (-x).exp())
}

/// `f_0` of a half-space under unit `f'(0)`.
fn sheared(x: f64) -> Derivatives {
    [x, 1.0 - x, x - 2.0, 3.0 - x].map(|value| value * (-x).exp())
}

/// `exp(-d)` times the hyperbolic sine and cosine of `x <= d`.
fn scaled(x: f64, d: f64) -> (f64, f64) {
    let (rising, falling) = (0.5 * (x - d).exp(), 0.5 * (-x - d).exp());
    (rising - falling, rising + falling)
}

/// `exp(-d)` times `x sinh x` and `sinh x - x cosh x`.
fn bases(x: f64, d: f64) -> [Derivatives; 2] {
    let (sinh, cosh) = scaled(x, d);
    [
        [x * sinh, sinh + x * cosh, 2.0 * cosh + x * sinh, 3.0 * sinh + x * cosh],
        [sinh - x * cosh, -x * sinh, -sinh - x * cosh, -2.0 * cosh - x * sinh],
    ]
}

/// `A` times the first plus `B` times the second function.
fn combined([first, second]: &[Derivatives; 2], [a, b]: [f64; 2]) -> Derivatives {
    std::array::from_fn(|k| a * first[k] + b * second[k])
}

/// `k` at `x - d = below`, for `g` at the bottom of the layer.
fn continued(g: &Derivatives, below: f64) -> Derivatives {
    let slope = g[0] + g[1];
    let at = |n: f64, sign: f64| sign * (g[0] + slope * below - n * slope) * (-below).exp();
    [at(0.0, 1.0), at(1.0, -1.0), at(2.0, 1.0), at(3.0, -1.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layers() -> impl Iterator<Item = Layer> {
        let moduli = [1e-4, 0.03, 0.5, 1.0, 3.0, 100.0, 990.0];
        let poissons = [(0.3, 0.3), (0.5, 0.2), (0.1, 0.5), (-0.5, 0.3)];
        moduli.into_iter().flat_map(move |m| poissons.map(|(v1, v2)| layer(m, v1, v2)))
    }

    fn layer(m: f64, v1: f64, v2: f64) -> Layer {
        Layer::new(1.0, [m * (1.0 + v1), v1], [1.0 + v2, v2]).unwrap()
    }

    fn wave_numbers() -> impl Iterator<Item = f64> {
        [0.0].into_iter().chain((-40..20).map(|k| 10.0_f64.powf(f64::from(k) / 8.0)))
    }

    fn total(load: Derivatives, correction: Derivatives) -> Derivatives {
        std::array::from_fn(|k| load[k] + correction[k])
    }

    /// Loads at the surface, continuity of tractions and displacements at the bond.
    #[test]
    fn conditions_at_surface_and_bond_hold() {
        for layer in layers() {
            let ([v1, v2], m) = (layer.poissons, layer.moduli);
            for q in wave_numbers() {
                let surface = layer.correction(q, 0.0, Body::Layer);
                for f in [surface.pressure, surface.shear] {
                    assert!(f[0].abs() < 1e-13 && f[1].abs() < 1e-13, "{layer:?}, {q}: {f:?}");
                }
                assert!(surface.across[1] == 0.0);
                let [over, under] = [Body::Layer, Body::Substrate].map(|body| layer.correction(q, 1.0, body));
                let size = m.max(1.0);
                for (load, over, under) in
                    [(pressed(q), over.pressure, under.pressure), (sheared(q), over.shear, under.shear)]
                {
                    let (over, under) = (total(load, over), total(load, under));
                    let close =
                        |a: f64, b: f64| assert!((a - b).abs() < 1e-11 * size, "{layer:?}, {q}: {a} {b}");
                    close(over[0], under[0]);
                    close(over[1], under[1]);
                    close(along(&over, v1), m * along(&under, v2));
                    close(into(&over, v1), m * into(&under, v2));
                }
                let v = (-q).exp();
                let (over, under) = (over.across, under.across);
                assert!((over[1] - under[1]).abs() < 1e-13 * size);
                assert!((v + over[0] - m * (v + under[0])).abs() < 1e-13 * size, "{layer:?}, {q}");
            }
        }
    }

    /// The surface displacement equals Burmister's transform, and the response is reciprocal.
    #[test]
    fn surface_displacements_are_known_and_reciprocal() {
        for layer in layers() {
            let v1 = layer.poissons[0];
            for q in wave_numbers().filter(|q| *q > 0.0) {
                let correction = layer.correction(q, 0.0, Body::Layer);
                let (pressure, shear) =
                    (total(pressed(0.0), correction.pressure), total(sheared(0.0), correction.shear));
                let (found, known) = (into(&pressure, v1), 2.0 * (1.0 - v1) * layer.transform(q));
                assert!((found / known - 1.0).abs() < 1e-9, "{layer:?}, {q}: {found} {known}");
                let (one, other) = (along(&pressure, v1), into(&shear, v1));
                assert!((one + other).abs() < 1e-9 * known.max(1.0), "{layer:?}, {q}: {one} {other}");
            }
        }
    }

    /// With the derivatives of `f`, equilibrium reduces to `f'''' - 2 f'' + f = 0`.
    #[test]
    fn stresses_are_in_equilibrium_and_derivatives_exact() {
        for layer in layers() {
            for (q, z, body) in
                [(0.5, 0.4, Body::Layer), (3.0, 0.9, Body::Layer), (1.0, 1.7, Body::Substrate)]
            {
                let step = 1e-4;
                let at = |s: f64| layer.correction(q, z + s / q, body);
                let (here, before, after) = (at(0.0), at(-step), at(step));
                for f in [|a: &LayerCorrection| a.pressure, |a: &LayerCorrection| a.shear] {
                    let (here, before, after) = (f(&here), f(&before), f(&after));
                    let size = here.iter().fold(1e-3, |size: f64, value| size.max(value.abs()));
                    let slope = |k: usize| (after[k] - before[k]) / (2.0 * step);
                    for k in 0..3 {
                        assert!((slope(k) - here[k + 1]).abs() < 1e-6 * size, "{layer:?}, {q}, {k}");
                    }
                    assert!((slope(3) - 2.0 * here[2] + here[0]).abs() < 1e-6 * size, "{layer:?}, {q}");
                }
                let slope = |k: usize| (after.across[k] - before.across[k]) / (2.0 * step);
                let size = here.across[0].abs().max(1e-3);
                assert!((slope(0) - here.across[1]).abs() < 1e-6 * size);
                assert!((slope(1) - here.across[0]).abs() < 1e-6 * size);
            }
        }
    }

    #[test]
    fn layers_of_the_substrate_and_far_away_add_nothing() {
        let same = layer(1.0, 0.3, 0.3);
        for q in wave_numbers() {
            for (z, body) in [(0.3, Body::Layer), (1.0, Body::Layer), (1.4, Body::Substrate)] {
                let correction = same.correction(q, z, body);
                let values = correction.pressure.iter().chain(&correction.shear).chain(&correction.across);
                assert!(values.into_iter().all(|value| value.abs() < 1e-13), "{q}, {z}: {correction:?}");
                for far in [1e3, 1e9, 1e150] {
                    let correction = layer(3.0, 0.3, 0.2).correction(far, z, body);
                    let values =
                        correction.pressure.iter().chain(&correction.shear).chain(&correction.across);
                    assert!(
                        values.into_iter().all(|value| value.abs() < 1e-100),
                        "{far}, {z}: {correction:?}"
                    );
                }
            }
        }
    }
}
