//! Stresses below the surface.

use crate::elastic::{Extreme, LayerStressExtremes, LayeredStress, stress_extremes};
use crate::error::InputError;
use crate::reynolds::ContactState;
use crate::sim::contact::friction::FrictionFields;
use crate::sim::contact::model::ContactModel;
use crate::sim::scene::{CoatedBody, Scene};

/// Stresses below the surface of the disc, or of the ball if that has a layer, under pressure and friction.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, scene::StressSpec, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.stress = Some(StressSpec::default());
/// let stress = solve_contact(&scene)?.stress.ok_or("not requested")?;
/// assert!(stress.von_mises.stress > stress.orthogonal_shear.stress);
/// assert!(stress.layer.is_none() && stress.yield_ratio.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct StressNumbers {
    /// Largest von Mises stress; below a layer that of the substrate.
    pub von_mises: Extreme,
    /// Largest orthogonal shear stress; below a layer that of the substrate.
    pub orthogonal_shear: Extreme,
    /// Stresses of the layer and of its bond; `None` without a layer.
    pub layer: Option<LayerStressExtremes>,
    /// Largest von Mises stress over the yield strength; `None` without a strength.
    pub yield_ratio: Option<f64>,
    /// Largest orthogonal shear stress over the yield stress in shear, `yield strength / sqrt 3`. Below one, the load is
    /// below the elastic shakedown limit of free rolling (see
    /// [`StressExtremes`](crate::elastic::StressExtremes)). `None` without a strength.
    pub shakedown_ratio: Option<f64>,
}

impl StressNumbers {
    /// Stresses of `state`, if `scene` requests them. Friction on a body is directed along the motion of the other one
    /// relative to it.
    pub(in crate::sim) fn of(
        scene: &Scene,
        model: &ContactModel,
        state: &ContactState,
        friction: &FrictionFields,
    ) -> Result<Option<Self>, InputError> {
        let Some(spec) = scene.stress else { return Ok(None) };
        let sliding = model.motion.sliding_speed() > 0.0;
        let coated = scene.elastic.layer.map_or(CoatedBody::Disc, |layer| layer.body);
        let sign = if coated == CoatedBody::Ball { -1.0 } else { 1.0 };
        let direction = sign * model.motion.slide_roll_ratio.signum();
        let traction: Option<Vec<f64>> =
            sliding.then(|| (0..state.pressure.len()).map(|k| direction * friction.stress(k)).collect());
        let depths = spec.depths(model.hertz.half_width_x.min(model.hertz.half_width_y));
        let (grid, pressure, traction) = (&model.grid, &state.pressure, traction.as_deref());
        let (largest, layer) = match scene.layer()? {
            None => (stress_extremes(grid, spec.poisson(scene), &depths, pressure, traction)?, None),
            Some(layer) => {
                let both = LayeredStress::new(grid, layer, pressure, traction)?.extremes(&depths)?;
                (both.substrate, Some(both.layer))
            }
        };
        let over = |stress: f64, share: f64| spec.yield_strength.map(|strength| stress / (share * strength));
        Ok(Some(Self {
            von_mises: largest.von_mises,
            orthogonal_shear: largest.orthogonal_shear,
            layer,
            yield_ratio: over(largest.von_mises.stress, 1.0),
            shakedown_ratio: over(largest.orthogonal_shear.stress, 1.0 / 3.0_f64.sqrt()),
        }))
    }
}
