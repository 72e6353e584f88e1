//! Friction over load.

/// Friction coefficient of a contact and its parts: boundary friction under the solid pressure and shear of the fluid,
/// divided by the load.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// let friction = solve_contact(&scene)?.friction;
/// assert!(friction.boundary > 0.0 && friction.fluid > 0.0);
/// assert!((friction.boundary + friction.fluid - friction.coefficient).abs() < 1e-12);
/// scene.motion.slide_roll_ratio = 0.0;
/// assert_eq!(solve_contact(&scene)?.friction.coefficient, 0.0);
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct FrictionNumbers {
    /// Friction force over load; zero without sliding.
    pub coefficient: f64,
    /// Part of the coefficient from solid contact.
    pub boundary: f64,
    /// Part of the coefficient from shear of the fluid.
    pub fluid: f64,
    /// Friction force times sliding speed \[W\], of a line contact per metre.
    pub power_loss: f64,
}

impl FrictionNumbers {
    /// Values of a contact whose state is unknown.
    pub(super) const UNKNOWN: Self =
        Self { coefficient: f64::NAN, boundary: f64::NAN, fluid: f64::NAN, power_loss: f64::NAN };

    /// From the forces `boundary` and `fluid` \[N\] under `load` \[N\], with `per_load` the power loss per friction
    /// coefficient \[W\].
    pub(in crate::sim) fn of([boundary, fluid]: [f64; 2], load: f64, per_load: f64) -> Self {
        let coefficient = (boundary + fluid) / load;
        Self {
            coefficient,
            boundary: boundary / load,
            fluid: fluid / load,
            power_loss: coefficient * per_load,
        }
    }
}
