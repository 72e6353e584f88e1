//! Laws of friction of a scene: solid contact, and the mean shear of the fluid by formula.

use crate::boundary_friction::{BoundaryFriction, ConstantFriction, FilmFriction};
use crate::error::InputError;
use crate::lubricant::Rheology;
use crate::sim::scene::FrictionSpec;

/// Quadrature points for the mean over a Hertz contact.
const MEAN_POINTS: u32 = 32;

/// The boundary friction law of a scene whose tribofilm has the largest thickness `full` \[m\].
pub(in crate::sim) fn boundary_law(
    spec: &FrictionSpec,
    full: Option<f64>,
) -> Result<Box<dyn BoundaryFriction>, InputError> {
    let bare = spec.boundary_coefficient;
    let Some(covered) = spec.film_coefficient else { return Ok(Box::new(ConstantFriction::new(bare)?)) };
    // Without a film the thickness is irrelevant.
    let thickness = spec.covering_thickness.or(full).unwrap_or(1.0);
    Ok(Box::new(FilmFriction::new(bare, covered, thickness)?))
}

/// Mean shear stress \[Pa\] of a fluid film of thickness `film` \[m\] in a point or line Hertz contact of maximum
/// pressure `p_max` \[Pa\] at `sliding` \[m/s\]: the area mean of the stress under `p_max sqrt(1 - r^2/a^2)`.
/// `viscosity` maps pressure \[Pa\] to viscosity \[Pa s\].
pub(in crate::sim) fn mean_fluid_stress(
    viscosity: &dyn Fn(f64) -> f64,
    rheology: &Rheology,
    (p_max, is_line): (f64, bool),
    film: f64,
    sliding: f64,
) -> f64 {
    if film <= 0.0 || sliding <= 0.0 {
        return 0.0;
    }
    // Rings or strips of equal area.
    let stress = |part: u32| {
        let share = (f64::from(part) + 0.5) / f64::from(MEAN_POINTS);
        let pressure = p_max * if is_line { 1.0 - share * share } else { share }.sqrt();
        rheology.shear_stress_under(pressure, viscosity(pressure), sliding / film)
    };
    (0..MEAN_POINTS).map(stress).sum::<f64>() / f64::from(MEAN_POINTS)
}
