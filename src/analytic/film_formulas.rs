//! Film thickness formulas for smooth lubricated point contacts.

use std::f64::consts::FRAC_PI_2;

use super::asymptotes::Asymptotes;
use crate::error::InputError;

/// Operating conditions of a smooth, fully flooded, isothermal point contact, and the film formulas fitted to
/// its numerical solutions.
///
/// Dimensionless groups of Hamrock and Dowson, with the *mean* surface speed `u`:
/// `U = eta0 u/(E' R)`, `G = alpha E'`, `W = F/(E' R^2)`.
/// Groups of Moes, with the *sum* of the speeds `2u`: `M = W (2U)^(-3/4)`, `L = G (2U)^(1/4)`.
///
/// ```
/// use stribeck::analytic::FilmConditions;
/// let scene = FilmConditions {
///     entrainment_speed: 0.1,
///     eta0: 0.004,
///     alpha: 14.94e-9,
///     equivalent_modulus: 229.67e9,
///     radius: 9.525e-3,
///     load: 54.07,
///     ellipticity: 1.0,
/// };
/// assert!((scene.hamrock_dowson_central()? - 9.36e-9).abs() < 0.01e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmConditions {
    /// Mean of the two surface speeds, along x \[m/s\].
    pub entrainment_speed: f64,
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Pressure-viscosity coefficient \[1/Pa\]; zero of an oil that does not thicken under pressure.
    pub alpha: f64,
    /// Equivalent modulus `E'` \[Pa\], `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`.
    pub equivalent_modulus: f64,
    /// Radius of curvature in the direction of entrainment \[m\].
    pub radius: f64,
    /// Load \[N\].
    pub load: f64,
    /// `k = a_y/a_x`: semi-axis across the entrainment over that along it; 1 for a circular contact.
    pub ellipticity: f64,
}

impl FilmConditions {
    /// Checks every field.
    ///
    /// # Errors
    /// [`InputError::Value`] naming the first field that is not finite and positive; `alpha` may
    /// be zero.
    pub fn validate(&self) -> Result<(), InputError> {
        let fields = [
            ("entrainment_speed", self.entrainment_speed),
            ("eta0", self.eta0),
            ("equivalent_modulus", self.equivalent_modulus),
            ("radius", self.radius),
            ("load", self.load),
            ("ellipticity", self.ellipticity),
        ];
        fields.into_iter().try_for_each(|(field, value)| InputError::require_positive(field, value))?;
        InputError::require_non_negative("alpha", self.alpha)
    }

    /// Checks every field for a formula that needs an oil that thickens under pressure.
    fn validate_thickening(&self) -> Result<(), InputError> {
        InputError::require_positive("alpha", self.alpha)?;
        self.validate()
    }

    /// Speed parameter `U = eta0 u/(E' R)` of Hamrock and Dowson, with the mean speed.
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.speed_parameter() - 1.8285e-13).abs() < 1e-17);
    /// ```
    #[must_use]
    pub fn speed_parameter(&self) -> f64 {
        self.eta0 * self.entrainment_speed / (self.equivalent_modulus * self.radius)
    }

    /// Material parameter `G = alpha E'`.
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.material_parameter() - 3431.3).abs() < 0.1);
    /// ```
    #[must_use]
    pub fn material_parameter(&self) -> f64 {
        self.alpha * self.equivalent_modulus
    }

    /// Load parameter `W = F/(E' R^2)`.
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.load_parameter() - 2.595e-6).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn load_parameter(&self) -> f64 {
        self.load / (self.equivalent_modulus * self.radius * self.radius)
    }

    /// Moes load parameter `M = W (2U)^(-3/4)`.
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.moes_load() - 5518.0).abs() < 1.0);
    /// ```
    #[must_use]
    pub fn moes_load(&self) -> f64 {
        self.load_parameter() * (2.0 * self.speed_parameter()).powf(-0.75)
    }

    /// Moes lubricant parameter `L = G (2U)^(1/4)`.
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.moes_lubricant() - 2.67).abs() < 0.005);
    /// ```
    #[must_use]
    pub fn moes_lubricant(&self) -> f64 {
        self.material_parameter() * (2.0 * self.speed_parameter()).powf(0.25)
    }

    /// Central film thickness \[m\]: `h = 2.69 R U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k))`.
    ///
    /// A fit to solutions of hard (elastic, piezoviscous) contacts, 1 <= k <= 8; some 10 % at moderate
    /// conditions, more outside the fitted loads and speeds.
    ///
    /// Source: Hamrock, B. J. and Dowson, D. (1977), Journal of Lubrication Technology 99, 264-276.
    ///
    /// # Errors
    /// See [`FilmConditions::validate`]; an oil that does not thicken under pressure.
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.hamrock_dowson_central()? - 9.356e-9).abs() < 2e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn hamrock_dowson_central(&self) -> Result<f64, InputError> {
        self.validate_thickening()?;
        let side = 1.0 - 0.61 * (-0.73 * self.ellipticity).exp();
        Ok(2.69 * self.radius * self.powers(0.67, 0.53, -0.067) * side)
    }

    /// Minimum film thickness \[m\]: `h = 3.63 R U^0.68 G^0.49 W^-0.073 (1 - exp(-0.68 k))`. Range and source
    /// as [`FilmConditions::hamrock_dowson_central`].
    ///
    /// # Errors
    /// See [`FilmConditions::validate`]; an oil that does not thicken under pressure.
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.hamrock_dowson_minimum()? - 5.132e-9).abs() < 2e-12);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn hamrock_dowson_minimum(&self) -> Result<f64, InputError> {
        self.validate_thickening()?;
        let side = 1.0 - (-0.68 * self.ellipticity).exp();
        Ok(3.63 * self.radius * self.powers(0.68, 0.49, -0.073) * side)
    }

    /// Central film thickness \[m\] of soft bodies in an oil that does not thicken under pressure:
    /// `h = 7.32 R U^0.64 W^-0.22 (1 - 0.72 exp(-0.28 k))`. `alpha` is not used.
    ///
    /// Source: Hamrock, B. J. and Dowson, D. (1978), Journal of Lubrication Technology 100, 236-245.
    ///
    /// # Errors
    /// See [`FilmConditions::validate`].
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 0.0, equivalent_modulus: 10e6, radius: 9.525e-3, load: 1.0, ellipticity: 1.0 };
    /// let ratio = scene.hamrock_dowson_soft()? / scene.moes_central()?;
    /// assert!((0.7..1.3).contains(&ratio), "{ratio}");
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn hamrock_dowson_soft(&self) -> Result<f64, InputError> {
        self.validate()?;
        let side = 1.0 - 0.72 * (-0.28 * self.ellipticity).exp();
        Ok(7.32 * self.radius * self.powers(0.64, 0.0, -0.22) * side)
    }

    fn powers(&self, speed: f64, material: f64, load: f64) -> f64 {
        self.speed_parameter().powf(speed)
            * self.material_parameter().powf(material)
            * self.load_parameter().powf(load)
    }

    /// Central film thickness \[m\] by the formula of Nijenbanning, Venner and Moes, which joins the asymptotes of
    /// the rigid and elastic, isoviscous and piezoviscous regimes. With `D = Rx/Ry`:
    ///
    /// `H = {[H_RI^(3/2) + (H_EI^-4 + H_00^-4)^(-3/8)]^(2s/3) + (H_RP^-8 + H_EP^-8)^(-s/8)}^(1/s)`,
    /// `h = H R (2U)^(1/2)`, `s = 1.5 (1 + exp(-1.2 H_EI/H_EP))`, with `E = 1 + 0.006 ln D + 0.63 D^(4/7)` and
    /// `H_RI = 145 (1 + 0.796 D^(14/15))^(-15/7) D^-1 M^-2`, `H_00 = 1.8 D^-1`,
    /// `H_EI = 3.18 E^(-14/25) D^(-1/15) M^(-2/15)`, `H_RP = 1.29 (1 + 0.691 D)^(-2/3) L^(2/3)`,
    /// `H_EP = 1.48 E^(-7/20) D^(-1/24) M^(-1/12) L^(3/4)`.
    ///
    /// A fit for entrainment along the shorter axis of the contact, `ellipticity >= 1`. Where rigid bodies in an
    /// isoviscous oil set the film it is 18 % above exact solutions; [`film_map`](Self::film_map) is not.
    ///
    /// Source: Nijenbanning, G., Venner, C. H. and Moes, H. (1994), Wear 176, 217-229.
    ///
    /// # Errors
    /// See [`FilmConditions::validate`].
    ///
    /// ```
    /// # let scene = stribeck::analytic::FilmConditions { entrainment_speed: 0.1, eta0: 0.004,
    /// #     alpha: 14.94e-9, equivalent_modulus: 229.67e9, radius: 9.525e-3, load: 54.07, ellipticity: 1.0 };
    /// assert!((scene.moes_central()? - 8.23e-9).abs() < 0.01e-9);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn moes_central(&self) -> Result<f64, InputError> {
        self.validate()?;
        Ok(self.asymptotes().point_film() * self.film_scale())
    }

    /// `R (2U)^(1/2)` \[m\], the unit of Moes' films.
    pub(super) fn film_scale(&self) -> f64 {
        self.radius * (2.0 * self.speed_parameter()).sqrt()
    }

    /// Ratio of the radii across and along the entrainment, by `k = (Ry/Rx)^(2/pi)`.
    ///
    /// Source: Hamrock, B. J. and Brewe, D. (1983), Journal of Lubrication Technology 105, 171-177.
    pub(super) fn radius_ratio(&self) -> f64 {
        self.ellipticity.powf(FRAC_PI_2)
    }

    /// The asymptotes of [`moes_central`](Self::moes_central).
    pub(super) fn asymptotes(&self) -> Asymptotes {
        let (load, lubricant) = (self.moes_load(), self.moes_lubricant());
        let d = 1.0 / self.radius_ratio();
        let width = 1.0 + 0.006 * d.ln() + 0.63 * d.powf(4.0 / 7.0);
        Asymptotes {
            rigid_isoviscous: 145.0 * (1.0 + 0.796 * d.powf(14.0 / 15.0)).powf(-15.0 / 7.0)
                / (d * load.powi(2)),
            elastic_isoviscous: 3.18
                * width.powf(-14.0 / 25.0)
                * d.powf(-1.0 / 15.0)
                * load.powf(-2.0 / 15.0),
            thickest_elastic: 1.8 / d,
            rigid_piezoviscous: 1.29 * (1.0 + 0.691 * d).powf(-2.0 / 3.0) * lubricant.powf(2.0 / 3.0),
            elastic_piezoviscous: 1.48
                * width.powf(-7.0 / 20.0)
                * d.powf(-1.0 / 24.0)
                * load.powf(-1.0 / 12.0)
                * lubricant.powf(0.75),
        }
    }
}
