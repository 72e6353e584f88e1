//! Wear proportional to the frictional energy.

use super::{WearLaw, WearPressure};
use crate::error::InputError;
use crate::surface_state::SurfaceState;

/// `dz/dt = a(h) tau |u_s|`: the worn volume is proportional to the frictional energy, with the volume per energy
/// `a(h) = a_bare - (a_bare - a_film) clamp(h / h_ref, 0, 1)` \[m^3/J\], which decreases with the tribofilm thickness.
/// By default only nodes with solid pressure count, including the shear of the fluid there. With
/// [`WearPressure::Total`] every node under pressure counts.
///
/// With one friction coefficient `mu` and no fluid shear it equals [`Archard`](super::Archard) with `a = K / (mu H)`; it
/// differs if friction varies over the contact.
///
/// Source: Fouvry, Kapsa, Vincent (1996), Wear 200, 186-205.
///
/// ```
/// use stribeck::SurfaceState;
/// use stribeck::wear::{Archard, FrictionalEnergy, WearLaw};
/// let at = SurfaceState::new(1e9, 353.15).with_solid_pressure(1e9)
///     .with_shear_stress(1.15e8).with_sliding_speed(0.005).with_in_contact(true);
/// let energy = FrictionalEnergy::new(5.45e-8 / (0.115 * 6e9), 5.45e-9 / (0.115 * 6e9), 200e-9)?;
/// let archard = Archard::azam_2019();
/// for film in [0.0, 70e-9, 200e-9] {
///     assert!((energy.depth_rate(&at, film) / archard.depth_rate(&at, film) - 1.0).abs() < 1e-12);
/// }
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FrictionalEnergy {
    /// Worn volume per energy of the bare surface \[m^3/J\].
    bare: f64,
    /// Reduction by a full film \[m^3/J\].
    drop: f64,
    /// One over the thickness of a full film \[1/m\].
    per_thickness: f64,
    /// Nodes that wear.
    pressure: WearPressure,
}

impl FrictionalEnergy {
    /// A law with the volumes per energy `bare` and `filmed` \[m^3/J\] of a surface without film and under a film of
    /// `reference_thickness` \[m\] or more.
    ///
    /// # Errors
    /// A negative volume, `filmed` above `bare`, a thickness that is not positive, a value that is not finite.
    pub fn new(bare: f64, filmed: f64, reference_thickness: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("volume_per_energy", bare)?;
        InputError::require(
            filmed.is_finite() && (0.0..=bare).contains(&filmed),
            "film_volume_per_energy",
            filmed,
            "finite, >= 0 and not above that of the bare surface",
        )?;
        InputError::require_positive("reference_thickness", reference_thickness)?;
        let pressure = WearPressure::default();
        Ok(Self { bare, drop: bare - filmed, per_thickness: 1.0 / reference_thickness, pressure })
    }

    /// The same law for the nodes with this pressure.
    #[must_use]
    pub fn with_pressure(mut self, pressure: WearPressure) -> Self {
        self.pressure = pressure;
        self
    }
}

impl WearLaw for FrictionalEnergy {
    fn depth_rate(&self, at: &SurfaceState, film_thickness: f64) -> f64 {
        if self.pressure.at(at) <= 0.0 {
            return 0.0;
        }
        let volume = self.bare - self.drop * (film_thickness * self.per_thickness).clamp(0.0, 1.0);
        volume * at.shear_stress.abs() * at.sliding_speed.abs()
    }
}
