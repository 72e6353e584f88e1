//! A layer bonded to a substrate, and the transform of its response.

use crate::error::InputError;

/// Range of the ratio of shear moduli, layer over substrate.
const MODULUS_RATIO: [f64; 2] = [1e-4, 1e3];

/// An elastic layer of uniform thickness that is bonded to an elastic half-space, the substrate.
///
/// A pressure of wave number `q` on the layer moves its surface by
///
/// `u/p = (1 - v1)/(G1 q) f(q h)`, `f(x) = [1 + 4 x K T - L K T^2] / [1 - (L + K + 4 K x^2) T + L K T^2]`,
/// `T = exp(-2 x)`,
///
/// with the thickness `h`, Poisson's ratios `v1`, `v2` and shear moduli `G1`, `G2 = G1/M` of layer and
/// substrate, `L = 1 - 4 (1 - v1)/[1 + M (3 - 4 v2)]` and `K = (M - 1)/(M + 3 - 4 v1)`. Short waves deform
/// the layer alone, `f = 1`; long waves deform the substrate, `f = M (1 - v2)/(1 - v1)`.
///
/// Source: Burmister, D. M. (1945), Journal of Applied Physics 16, 89-94.
///
/// ```
/// use stribeck::elastic::Layer;
/// let coating = Layer::new(2e-6, [420e9, 0.3], [210e9, 0.3])?;
/// assert!((coating.transform(0.0) - 2.0).abs() < 1e-14); // twice the compliance of the coating
/// assert!((coating.transform(20.0) - 1.0).abs() < 1e-12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layer {
    /// Thickness `h` \[m\].
    thickness: f64,
    /// `(1 - v^2)/E` of layer and substrate \[1/Pa\].
    compliances: [f64; 2],
    /// Poisson's ratios of layer and substrate.
    pub(super) poissons: [f64; 2],
    /// Shear modulus of the layer over that of the substrate.
    pub(super) moduli: f64,
    /// `K` of the transform.
    k: f64,
    /// `L` of the transform.
    l: f64,
}

impl Layer {
    /// A layer of `thickness` \[m\] with Young's modulus \[Pa\] and Poisson's ratio of layer and substrate.
    ///
    /// # Errors
    /// A thickness or modulus that is not finite and positive, a Poisson's ratio not above -1 or above 0.5, a
    /// ratio of shear moduli outside 1e-4 to 1e3.
    pub fn new(
        thickness: f64,
        [modulus, poisson]: [f64; 2],
        [substrate_modulus, substrate_poisson]: [f64; 2],
    ) -> Result<Self, InputError> {
        for (field, value) in [
            ("elastic.layer.thickness", thickness),
            ("elastic.layer.modulus", modulus),
            ("elastic.layer.substrate_modulus", substrate_modulus),
        ] {
            InputError::require_positive(field, value)?;
        }
        for (field, ratio) in
            [("elastic.layer.poisson", poisson), ("elastic.layer.substrate_poisson", substrate_poisson)]
        {
            InputError::require(-1.0 < ratio && ratio <= 0.5, field, ratio, "above -1 and at most 0.5")?;
        }
        let m = (modulus / (1.0 + poisson)) / (substrate_modulus / (1.0 + substrate_poisson));
        let [least, most] = MODULUS_RATIO;
        let field = "shear modulus of elastic.layer over that of its substrate";
        InputError::require((least..=most).contains(&m), field, m, "between 1e-4 and 1e3")?;
        Ok(Self {
            thickness,
            compliances: [
                (1.0 - poisson * poisson) / modulus,
                (1.0 - substrate_poisson * substrate_poisson) / substrate_modulus,
            ],
            poissons: [poisson, substrate_poisson],
            moduli: m,
            k: (m - 1.0) / (m + 3.0 - 4.0 * poisson),
            l: 1.0 - 4.0 * (1.0 - poisson) / (1.0 + m * (3.0 - 4.0 * substrate_poisson)),
        })
    }

    /// Thickness \[m\].
    pub fn thickness(&self) -> f64 {
        self.thickness
    }

    /// `(1 - v^2)/E` of the layer and of the substrate \[1/Pa\].
    pub fn compliances(&self) -> [f64; 2] {
        self.compliances
    }

    /// `f(x)`: the displacement relative to that of a half-space of the layer's material, at the wave number
    /// `x/h`, `x >= 0`.
    pub fn transform(&self, x: f64) -> f64 {
        let (k, l, t) = (self.k, self.l, (-2.0 * x).exp());
        (1.0 + 4.0 * x * k * t - l * k * t * t) / (1.0 - (l + k + 4.0 * k * x * x) * t + l * k * t * t)
    }
}
