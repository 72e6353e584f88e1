//! Regimes of smooth lubricated contacts, and the film in each of them.

use std::fmt;

use super::asymptotes::Asymptotes;
use super::film_formulas::FilmConditions;
use super::line_film_formulas::LineFilmConditions;
use crate::displayed::serialize_as_displayed;
use crate::error::InputError;

/// Martin's film between rigid cylinders over `R U/W`.
const MARTIN: f64 = 4.896;

/// Regime of a smooth lubricated contact: whether the pressure deforms the bodies, and whether it thickens the
/// oil.
///
/// ```
/// use stribeck::analytic::FilmRegime;
/// assert_eq!(FilmRegime::PiezoviscousElastic.to_string(), "piezoviscous-elastic");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilmRegime {
    /// Rigid bodies, constant viscosity: light and fast contacts.
    IsoviscousRigid,
    /// Rigid bodies, viscosity that grows with pressure: light contacts of viscous oils.
    PiezoviscousRigid,
    /// Elastic bodies, constant viscosity: soft bodies.
    IsoviscousElastic,
    /// Elastic bodies, viscosity that grows with pressure: loaded steel contacts.
    PiezoviscousElastic,
}

impl fmt::Display for FilmRegime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::IsoviscousRigid => "isoviscous-rigid",
            Self::PiezoviscousRigid => "piezoviscous-rigid",
            Self::IsoviscousElastic => "isoviscous-elastic",
            Self::PiezoviscousElastic => "piezoviscous-elastic",
        })
    }
}

serialize_as_displayed!(FilmRegime);

/// Position of a smooth, fully flooded, isothermal contact in the map of regimes, and its central film by a
/// formula that holds in all of them.
///
/// The regime is the one whose formula sets the film: in an isoviscous oil the thicker one of rigid and elastic bodies,
/// in a piezoviscous one the thinner one, and of both oils the thicker film.
///
/// ```
/// use stribeck::analytic::{FilmConditions, FilmRegime};
/// let light = FilmConditions {
///     entrainment_speed: 3.15, eta0: 0.05, alpha: 22e-9, equivalent_modulus: 230e9, radius: 15e-3, load: 0.765,
///     ellipticity: 1.0,
/// };
/// let map = light.film_map()?;
/// assert_eq!(map.regime, FilmRegime::IsoviscousRigid);
/// assert!((map.central / 20.4e-6 - 1.0).abs() < 0.03); // flooded limit of numerical solutions: 20.4 um
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct FilmMap {
    /// The regime.
    pub regime: FilmRegime,
    /// Viscosity parameter `g_V`: `G W^3/U^2` of points, `G W^(3/2)/U^(1/2)` of lines.
    pub viscosity_parameter: f64,
    /// Elasticity parameter `g_E`: `W^(8/3)/U^2` of points, `W/U^(1/2)` of lines.
    pub elasticity_parameter: f64,
    /// Central film \[m\].
    pub central: f64,
}

impl FilmConditions {
    /// Regime and central film of a point contact.
    ///
    /// The film is [`moes_central`](Self::moes_central) with the rigid isoviscous asymptote of Brewe, Hamrock and
    /// Taylor, `h = 128 a (1 + 2/(3a))^-2 [0.131 atan(a/2) + 1.683]^2 R (U/W)^2` with `a = Ry/Rx`. Against flooded
    /// numerical solutions of circular contacts it errs by -2 % at `M = 0.5` and by 12 % at `M = 2.8`, `L = 8.8`,
    /// where three regimes meet; by up to some 10 % in loaded steel contacts.
    ///
    /// The regime is by the minimum films of the map of Hamrock and Dowson, over `R (U/W)^2`: that of Brewe, Hamrock and
    /// Taylor, `1.66 g_V^(2/3) (1 - exp(-0.68 k))`, `8.70 g_E^0.67 (1 - 0.85 exp(-0.31 k))` and
    /// `3.42 g_V^0.49 g_E^0.17 (1 - exp(-0.68 k))`.
    ///
    /// Sources: Hamrock, B. J. and Dowson, D. (1979), Proceedings of the 5th Leeds-Lyon Symposium on Tribology,
    /// 22-27; Brewe, D. E., Hamrock, B. J. and Taylor, C. M. (1979), Journal of Lubrication
    /// Technology 101, 231-237; Nijenbanning, G., Venner, C. H. and Moes, H. (1994), Wear 176, 217-229.
    ///
    /// # Errors
    /// See [`FilmConditions::validate`].
    pub fn film_map(&self) -> Result<FilmMap, InputError> {
        self.validate()?;
        let (speed, load) = (self.speed_parameter(), self.load_parameter());
        let viscosity_parameter = self.material_parameter() * load.powi(3) / speed.powi(2);
        let elasticity_parameter = load.powf(8.0 / 3.0) / speed.powi(2);
        let rigid = self.brewe_rigid();
        let side = |factor: f64, rate: f64| 1.0 - factor * (-rate * self.ellipticity).exp();
        let films = RegimeFilms {
            rigid_isoviscous: rigid,
            rigid_piezoviscous: 1.66 * viscosity_parameter.powf(2.0 / 3.0) * side(1.0, 0.68),
            elastic_isoviscous: 8.70 * elasticity_parameter.powf(0.67) * side(0.85, 0.31),
            elastic_piezoviscous: 3.42
                * viscosity_parameter.powf(0.49)
                * elasticity_parameter.powf(0.17)
                * side(1.0, 0.68),
        };
        // (U/W)^2 over (2U)^(1/2) is 1/(4 M^2).
        let rigid_isoviscous = rigid / (4.0 * self.moes_load().powi(2));
        let asymptotes = Asymptotes { rigid_isoviscous, ..self.asymptotes() };
        let central = asymptotes.point_film() * self.film_scale();
        Ok(FilmMap { regime: films.regime(), viscosity_parameter, elasticity_parameter, central })
    }

    /// Film of rigid bodies in an isoviscous oil over `R (U/W)^2`, by Brewe, Hamrock and Taylor.
    fn brewe_rigid(&self) -> f64 {
        let a = self.radius_ratio();
        let side = (1.0 + 2.0 / (3.0 * a)).powi(-2) * (0.131 * (0.5 * a).atan() + 1.683).powi(2);
        128.0 * a * side
    }
}

impl LineFilmConditions {
    /// Regime and central film of a line contact.
    ///
    /// The film is [`moes_central`](Self::moes_central) with Martin's rigid isoviscous asymptote,
    /// `h = 4.896 R U/W`. Against flooded numerical solutions of Barus oils, `M` from 0.3 to 100 and `L` from 0 to
    /// 15, it errs by up to 8 %, but for `L >= 5` near `M = 1`, where it is up to 22 % too thick.
    ///
    /// The regime is by the minimum films of Martin, Blok, Herrebrugh and Dowson and Higginson, over `R U/W`: 4.9,
    /// `1.66 g_V^(2/3)`, `3.10 g_E^0.8` and `2.65 g_V^0.54 g_E^0.06`.
    ///
    /// Sources: Johnson, K. L. (1970), Journal of Mechanical Engineering Science 12, 9-16 (the map); Martin, H. M.
    /// (1916), Engineering 102, 119-121; Moes, H. (1992), Wear 159, 57-66.
    ///
    /// # Errors
    /// See [`LineFilmConditions::validate`].
    ///
    /// ```
    /// use stribeck::analytic::{FilmRegime, LineFilmConditions};
    /// let roller = LineFilmConditions {
    ///     entrainment_speed: 1.0, eta0: 0.04, alpha: 20e-9, equivalent_modulus: 230e9, radius: 10e-3, load: 2e5,
    /// };
    /// assert_eq!(roller.film_map()?.regime, FilmRegime::PiezoviscousElastic);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn film_map(&self) -> Result<FilmMap, InputError> {
        self.validate()?;
        let (speed, load) = (self.speed_parameter(), self.load_parameter());
        let viscosity_parameter = self.material_parameter() * load.powf(1.5) / speed.sqrt();
        let elasticity_parameter = load / speed.sqrt();
        let films = RegimeFilms {
            rigid_isoviscous: MARTIN,
            rigid_piezoviscous: 1.66 * viscosity_parameter.powf(2.0 / 3.0),
            elastic_isoviscous: 3.10 * elasticity_parameter.powf(0.8),
            elastic_piezoviscous: 2.65 * viscosity_parameter.powf(0.54) * elasticity_parameter.powf(0.06),
        };
        // U/W over (2U)^(1/2) is 1/(2 M).
        let rigid_isoviscous = MARTIN / (2.0 * self.moes_load());
        let asymptotes = Asymptotes { rigid_isoviscous, ..self.asymptotes() };
        let central = asymptotes.line_film() * self.film_scale();
        Ok(FilmMap { regime: films.regime(), viscosity_parameter, elasticity_parameter, central })
    }
}

/// Films of the four regimes in one unit.
struct RegimeFilms {
    rigid_isoviscous: f64,
    rigid_piezoviscous: f64,
    elastic_isoviscous: f64,
    elastic_piezoviscous: f64,
}

impl RegimeFilms {
    /// The regime whose formula sets the film.
    fn regime(&self) -> FilmRegime {
        let isoviscous = self.rigid_isoviscous.max(self.elastic_isoviscous);
        let piezoviscous = self.rigid_piezoviscous.min(self.elastic_piezoviscous);
        match isoviscous > piezoviscous {
            true if self.rigid_isoviscous > self.elastic_isoviscous => FilmRegime::IsoviscousRigid,
            true => FilmRegime::IsoviscousElastic,
            false if self.rigid_piezoviscous < self.elastic_piezoviscous => FilmRegime::PiezoviscousRigid,
            false => FilmRegime::PiezoviscousElastic,
        }
    }
}
