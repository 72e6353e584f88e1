//! Friction of solid contact: an open trait and its laws.

use std::fmt::Debug;

use crate::error::InputError;

/// The friction coefficient of a node in solid contact.
///
/// Contract: a coefficient is finite and non-negative for all finite non-negative arguments, and depends on
/// the arguments alone.
///
/// ```
/// use stribeck::BoundaryFriction;
///
/// /// Friction that decreases with the sliding speed.
/// #[derive(Debug)]
/// struct Falling;
/// impl BoundaryFriction for Falling {
///     fn coefficient(&self, _solid_pressure: f64, sliding_speed: f64, _tribofilm: [f64; 2]) -> f64 {
///         0.08 + 0.04 / (1.0 + sliding_speed / 0.1)
///     }
/// }
/// assert!((Falling.coefficient(1e9, 0.1, [0.0; 2]) - 0.1).abs() < 1e-15);
/// ```
pub trait BoundaryFriction: Debug + Send + Sync {
    /// Shear stress over `solid_pressure` \[Pa\] at the `sliding_speed` \[m/s\] with `tribofilm` \[m\] on
    /// ball and disc.
    fn coefficient(&self, solid_pressure: f64, sliding_speed: f64, tribofilm: [f64; 2]) -> f64;

    /// Overwrites `coefficients` of all nodes, for `solid_pressure` \[Pa\] and the tribofilms of ball and
    /// disc \[m\]; all slices have the same length. The default calls [`coefficient`](Self::coefficient) for
    /// each node, which an override must reproduce.
    fn coefficients(
        &self,
        solid_pressure: &[f64],
        sliding_speed: f64,
        tribofilm: [&[f64]; 2],
        coefficients: &mut [f64],
    ) {
        let films = tribofilm[0].iter().zip(tribofilm[1]);
        for (coefficient, (solid, (ball, disc))) in
            coefficients.iter_mut().zip(solid_pressure.iter().zip(films))
        {
            *coefficient = self.coefficient(*solid, sliding_speed, [*ball, *disc]);
        }
    }
}

/// A constant coefficient.
///
/// ```
/// use stribeck::{BoundaryFriction, ConstantFriction};
/// let law = ConstantFriction::new(0.115)?;
/// assert_eq!(law.coefficient(1e9, 0.1, [0.0, 100e-9]), 0.115);
/// assert!(ConstantFriction::new(-0.1).is_err());
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConstantFriction {
    coefficient: f64,
}

impl ConstantFriction {
    /// A law with this `coefficient`.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite.
    pub fn new(coefficient: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("friction.boundary_coefficient", coefficient)?;
        Ok(Self { coefficient })
    }
}

impl BoundaryFriction for ConstantFriction {
    fn coefficient(&self, _solid_pressure: f64, _sliding_speed: f64, _tribofilm: [f64; 2]) -> f64 {
        self.coefficient
    }
}

/// Friction between bare and covered surfaces: `mu = mu_bare + c (mu_covered - mu_bare)` with the coverage
/// `c = min{(h_1 + h_2) / h_full, 1}` of the tribofilms `h_1` and `h_2` between the solids.
///
/// ```
/// use stribeck::{BoundaryFriction, FilmFriction};
/// let law = FilmFriction::new(0.08, 0.12, 20e-9)?;
/// assert_eq!(law.coefficient(1e9, 0.1, [0.0; 2]), 0.08);
/// assert!((law.coefficient(1e9, 0.1, [4e-9, 6e-9]) - 0.10).abs() < 1e-15);
/// assert_eq!(law.coefficient(1e9, 0.1, [100e-9, 0.0]), 0.12);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmFriction {
    bare: f64,
    covered: f64,
    full_thickness: f64,
}

impl FilmFriction {
    /// A law with the coefficients of `bare` and of fully `covered` surfaces, with full coverage from
    /// `full_thickness` \[m\] on.
    ///
    /// # Errors
    /// A coefficient that is negative or not finite, a thickness that is not finite and positive.
    pub fn new(bare: f64, covered: f64, full_thickness: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("friction.boundary_coefficient", bare)?;
        InputError::require_non_negative("friction.film_coefficient", covered)?;
        InputError::require_positive("friction.covering_thickness", full_thickness)?;
        Ok(Self { bare, covered, full_thickness })
    }
}

impl BoundaryFriction for FilmFriction {
    fn coefficient(&self, _solid_pressure: f64, _sliding_speed: f64, tribofilm: [f64; 2]) -> f64 {
        let cover = ((tribofilm[0] + tribofilm[1]) / self.full_thickness).clamp(0.0, 1.0);
        // Exact at both ends.
        (1.0 - cover) * self.bare + cover * self.covered
    }
}
