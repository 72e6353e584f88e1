//! Archard's law with a wear coefficient that decreases with the tribofilm thickness.

use super::{WearLaw, WearPressure};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// `dz/dt = K(h)/H p |u_s|` with `K(h) = K_steel - (K_steel - K_min) clamp(h / h_max, 0, 1)`, dimensionless K and the
/// hardness H: that of the substrate, or the [local one](Self::with_film_hardness). With constant K and total pressure,
/// the mean depth over an area A after the sliding distance s is `K F s / (H A)` for any roughness.
///
/// Sources: Archard (1953), Journal of Applied Physics 24, 981-988; coefficient and film: Ghanbarzadeh and
/// co-workers (2016), Tribology Letters 61, as used by Azam and co-workers (2019), Tribology International
/// 135, 161-169.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::wear::{Archard, WearLaw};
/// let law = Archard::azam_2019();
/// let at = SurfaceState::new(6e9, 353.15).with_solid_pressure(6e9)
///     .with_sliding_speed(0.005).with_in_contact(true);
/// assert!((law.depth_rate(&at, 0.0) - 0.2725e-9).abs() < 1e-15);
/// assert!((law.depth_rate(&at, 200e-9) - 0.02725e-9).abs() < 1e-15);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Archard {
    /// Hardness of the substrate \[Pa\].
    hardness: f64,
    /// Coefficient over hardness of the bare surface \[1/Pa\].
    bare: f64,
    /// Reduction by a full film \[1/Pa\].
    drop: f64,
    /// One over the thickness of a full film \[1/m\].
    per_thickness: f64,
    /// Hardness under a full film over that of the substrate, minus 1.
    softening: f64,
    /// Wear pressure.
    pressure: WearPressure,
}

impl Archard {
    /// A law with the wear coefficients `bare` and `filmed` \[-\] of a surface without film and under a film of
    /// `reference_thickness` \[m\] or more, and the `hardness` \[Pa\] of the substrate; the solid pressure causes wear.
    ///
    /// # Errors
    /// A negative coefficient, `filmed` above `bare`, a thickness or hardness that is not positive, a value that is not
    /// finite.
    pub fn new(bare: f64, filmed: f64, reference_thickness: f64, hardness: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("coefficient", bare)?;
        InputError::require(
            filmed.is_finite() && (0.0..=bare).contains(&filmed),
            "film_coefficient",
            filmed,
            "finite, >= 0 and not above that of the bare surface",
        )?;
        InputError::require_positive("reference_thickness", reference_thickness)?;
        InputError::require_positive("hardness", hardness)?;
        Ok(Self::from_valid(bare, filmed, reference_thickness, hardness))
    }

    /// The constants of Azam and co-workers (2019): 5.45e-8 bare, 5.45e-9 under 200 nm of film, 6 GPa; total pressure.
    pub fn azam_2019() -> Self {
        Self::from_valid(5.45e-8, 5.45e-9, 200e-9, 6e9).with_pressure(WearPressure::Total)
    }

    /// The law of valid constants.
    fn from_valid(bare: f64, filmed: f64, reference_thickness: f64, hardness: f64) -> Self {
        Self {
            hardness,
            bare: bare / hardness,
            drop: (bare - filmed) / hardness,
            per_thickness: 1.0 / reference_thickness,
            softening: 0.0,
            pressure: WearPressure::default(),
        }
    }

    /// The same law with another wear pressure.
    #[must_use]
    pub fn with_pressure(mut self, pressure: WearPressure) -> Self {
        self.pressure = pressure;
        self
    }

    /// The same law with the local hardness, linear in the film thickness from that of the substrate to `film_hardness`
    /// \[Pa\] under a film of the reference thickness.
    ///
    /// # Errors
    /// A hardness that is not finite and positive.
    ///
    /// ```
    /// use stribeck::wear::Archard;
    /// let law = Archard::azam_2019().with_film_hardness(2e9)?;
    /// // Half the film: K is 0.55 times the bare one, H is 4 GPa.
    /// assert!((law.specific_rate(100e-9) - 0.55 * 5.45e-8 / 4e9).abs() < 1e-23);
    /// # Ok::<(), stribeck::InputError>(())
    /// ```
    pub fn with_film_hardness(mut self, film_hardness: f64) -> Result<Self, InputError> {
        InputError::require_positive("film_hardness", film_hardness)?;
        self.softening = film_hardness / self.hardness - 1.0;
        Ok(self)
    }

    /// Specific wear rate `K(h)/H` \[m^3/(N m)\] under `film_thickness` \[m\].
    ///
    /// ```
    /// let rate = stribeck::wear::Archard::azam_2019().specific_rate(0.0);
    /// assert!((rate - 9.0833e-18).abs() < 1e-21);
    /// ```
    pub fn specific_rate(&self, film_thickness: f64) -> f64 {
        let filling = (film_thickness * self.per_thickness).clamp(0.0, 1.0);
        (self.bare - self.drop * filling) / (1.0 + self.softening * filling)
    }
}

impl WearLaw for Archard {
    fn depth_rate(&self, at: &SurfaceState, film_thickness: f64) -> f64 {
        self.specific_rate(film_thickness) * self.pressure.at(at).max(0.0) * at.sliding_speed.abs()
    }
}
