//! Film thickness formulas for smooth lubricated line contacts.

use super::asymptotes::Asymptotes;
use crate::error::InputError;

/// Operating conditions of a smooth, fully flooded, isothermal line contact, and the film formulas fitted to
/// its numerical solutions.
///
/// Dimensionless groups of Dowson and Higginson, with the *mean* surface speed `u` and the load per length
/// `w`: `U = eta0 u/(E' R)`, `G = alpha E'`, `W = w/(E' R)`. Groups of Moes, with the *sum* of the speeds
/// `2u`: `M = W (2U)^(-1/2)`, `L = G (2U)^(1/4)`.
///
/// ```
/// use stribeck::analytic::LineFilmConditions;
/// let roller = LineFilmConditions {
///     entrainment_speed: 1.0,
///     eta0: 0.04,
///     alpha: 20e-9,
///     equivalent_modulus: 230e9,
///     radius: 10e-3,
///     load: 2e5,
/// };
/// assert!((roller.dowson_toyoda_central()? / roller.moes_central()? - 1.0).abs() < 0.01);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineFilmConditions {
    /// Mean of the two surface speeds \[m/s\].
    pub entrainment_speed: f64,
    /// Viscosity at ambient pressure \[Pa s\].
    pub eta0: f64,
    /// Pressure-viscosity coefficient \[1/Pa\]; zero of an oil that does not thicken under pressure.
    pub alpha: f64,
    /// Equivalent modulus `E'` \[Pa\], `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`.
    pub equivalent_modulus: f64,
    /// Radius of curvature \[m\].
    pub radius: f64,
    /// Load per length \[N/m\].
    pub load: f64,
}

impl LineFilmConditions {
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
        ];
        fields.into_iter().try_for_each(|(field, value)| InputError::require_positive(field, value))?;
        InputError::require_non_negative("alpha", self.alpha)
    }

    /// Checks every field for a formula that needs an oil that thickens under pressure.
    fn validate_thickening(&self) -> Result<(), InputError> {
        InputError::require_positive("alpha", self.alpha)?;
        self.validate()
    }

    /// Speed parameter `U = eta0 u/(E' R)`, with the mean speed.
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.speed_parameter() - 1.7391e-11).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn speed_parameter(&self) -> f64 {
        self.eta0 * self.entrainment_speed / (self.equivalent_modulus * self.radius)
    }

    /// Material parameter `G = alpha E'`.
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.material_parameter() - 4600.0).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn material_parameter(&self) -> f64 {
        self.alpha * self.equivalent_modulus
    }

    /// Load parameter `W = w/(E' R)`.
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.load_parameter() - 8.6957e-5).abs() < 1e-9);
    /// ```
    #[must_use]
    pub fn load_parameter(&self) -> f64 {
        self.load / (self.equivalent_modulus * self.radius)
    }

    /// Moes load parameter of a line contact, `M = W (2U)^(-1/2)`.
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.moes_load() - 14.74).abs() < 0.01);
    /// ```
    #[must_use]
    pub fn moes_load(&self) -> f64 {
        self.load_parameter() / (2.0 * self.speed_parameter()).sqrt()
    }

    /// Moes lubricant parameter `L = G (2U)^(1/4)`.
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.moes_lubricant() - 11.17).abs() < 0.01);
    /// ```
    #[must_use]
    pub fn moes_lubricant(&self) -> f64 {
        self.material_parameter() * (2.0 * self.speed_parameter()).powf(0.25)
    }

    /// Central film thickness \[m\]: `h = 3.06 R U^0.69 G^0.56 W^-0.10`, a fit to solutions of hard (elastic,
    /// piezoviscous) contacts.
    ///
    /// Source: Dowson, D. and Toyoda, S. (1979), Proceedings of the 5th Leeds-Lyon Symposium on Tribology,
    /// 60-65.
    ///
    /// # Errors
    /// See [`LineFilmConditions::validate`]; an oil that does not thicken under pressure.
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.dowson_toyoda_central()? - 330.2e-9).abs() < 0.1e-9);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn dowson_toyoda_central(&self) -> Result<f64, InputError> {
        self.validate_thickening()?;
        Ok(3.06 * self.radius * self.powers(0.69, 0.56, -0.10))
    }

    /// Minimum film thickness \[m\]: `h = 2.65 R U^0.70 G^0.54 W^-0.13`. Range as
    /// [`LineFilmConditions::dowson_toyoda_central`].
    ///
    /// Source: Dowson, D. (1968), Proceedings of the Institution of Mechanical Engineers 182 (3A), 151-167.
    ///
    /// # Errors
    /// See [`LineFilmConditions::validate`]; an oil that does not thicken under pressure.
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.dowson_minimum()? - 249.6e-9).abs() < 0.1e-9);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn dowson_minimum(&self) -> Result<f64, InputError> {
        self.validate_thickening()?;
        Ok(2.65 * self.radius * self.powers(0.70, 0.54, -0.13))
    }

    fn powers(&self, speed: f64, material: f64, load: f64) -> f64 {
        self.speed_parameter().powf(speed)
            * self.material_parameter().powf(material)
            * self.load_parameter().powf(load)
    }

    /// Central film thickness \[m\] by the formula of Moes, which joins the asymptotes of the rigid and
    /// elastic, isoviscous and piezoviscous regimes (incompressible lubricant):
    ///
    /// `H = {(H_RI^(7/3) + H_EI^(7/3))^(3s/7) + (H_RP^(-7/2) + H_EP^(-7/2))^(-2s/7)}^(1/s)`,
    /// `h = H R (2U)^(1/2)`, `s = (7 + 8 exp(-2 H_EI/H_RI))/5`, with `H_RI = 3 M^-1`,
    /// `H_EI = 2.621 M^(-1/5)`, `H_RP = 1.287 L^(2/3)`, `H_EP = 1.311 M^(-1/8) L^(3/4)`. Where rigid bodies in an
    /// isoviscous oil set the film it is 23 % above exact solutions; [`film_map`](Self::film_map) is not.
    ///
    /// Source: Moes, H. (1992), Wear 159, 57-66; Moes, H. (2000), Lubrication and Beyond, University of
    /// Twente.
    ///
    /// # Errors
    /// See [`LineFilmConditions::validate`].
    ///
    /// ```
    /// # let roller = stribeck::analytic::LineFilmConditions { entrainment_speed: 1.0, eta0: 0.04,
    /// #     alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5 };
    /// assert!((roller.moes_central()? - 331.3e-9).abs() < 0.1e-9);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn moes_central(&self) -> Result<f64, InputError> {
        self.validate()?;
        Ok(self.asymptotes().line_film() * self.film_scale())
    }

    /// `R (2U)^(1/2)` \[m\], the unit of Moes' films.
    pub(super) fn film_scale(&self) -> f64 {
        self.radius * (2.0 * self.speed_parameter()).sqrt()
    }

    /// The asymptotes of [`moes_central`](Self::moes_central).
    pub(super) fn asymptotes(&self) -> Asymptotes {
        let (load, lubricant) = (self.moes_load(), self.moes_lubricant());
        Asymptotes {
            rigid_isoviscous: 3.0 / load,
            elastic_isoviscous: 2.621 * load.powf(-0.2),
            thickest_elastic: f64::INFINITY,
            rigid_piezoviscous: 1.287 * lubricant.powf(2.0 / 3.0),
            elastic_piezoviscous: 1.311 * load.powf(-0.125) * lubricant.powf(0.75),
        }
    }
}
