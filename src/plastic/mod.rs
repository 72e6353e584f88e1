//! Plastic flattening of asperities: the pressure limit of a node, and the permanent depth.
//!
//! [`PlasticityModel`] is an open trait. [`ElasticPerfectlyPlastic`] is the model of the reference scene,
//! [`IsotropicHardening`] a model with a limit that grows with the depth. Solvers cap the pressure at the
//! [contact limit](PlasticityModel::contact_limit_into) of the softer body. At the limit the bodies overlap;
//! [`split_depth`] assigns the overlap to the softer body, and its [`PlasticDepth`] accumulates it.

mod elastic_perfectly_plastic;
mod flattening;
mod isotropic_hardening;

use std::fmt::Debug;

pub use elastic_perfectly_plastic::ElasticPerfectlyPlastic;
pub use flattening::{PlasticDepth, split_depth, split_depth_into};
pub use isotropic_hardening::IsotropicHardening;

use crate::error::InputError;

/// The largest pressure that a body carries at a node.
///
/// Contract: the limit is positive and not NaN for all finite arguments, and does not decrease with the
/// plastic depth. Infinity stands for a body that never yields.
///
/// # Examples
///
/// ```
/// use stribeck::plastic::PlasticityModel;
/// /// A hardness that no film and no flattening changes.
/// #[derive(Debug)]
/// struct Hard(f64);
/// impl PlasticityModel for Hard {
///     fn pressure_limit(&self, _film_thickness: f64, _plastic_depth: f64) -> f64 {
///         self.0
///     }
/// }
/// let mut limit = [0.0; 2];
/// Hard(6e9).contact_limit_into([&[0.0, 1e-7], &[0.0; 2]], [&[0.0; 2], &[0.0; 2]], &mut limit)?;
/// assert_eq!(limit, [6e9, 6e9]);
/// # Ok::<(), stribeck::InputError>(())
/// ```
pub trait PlasticityModel: Debug + Send + Sync {
    /// Pressure limit \[Pa\] of a body at a node with `film_thickness` \[m\] of tribofilm and `plastic_depth`
    /// \[m\].
    fn pressure_limit(&self, film_thickness: f64, plastic_depth: f64) -> f64;

    /// Fills `out` \[Pa\] with the limits of the nodes of one body; all slices have the same length.
    fn pressure_limits(&self, film_thickness: &[f64], plastic_depth: &[f64], out: &mut [f64]) {
        let nodes = film_thickness.iter().zip(plastic_depth);
        for (limit, (film, depth)) in out.iter_mut().zip(nodes) {
            *limit = self.pressure_limit(*film, *depth);
        }
    }

    /// Whether the limit depends on the plastic depth. A simulation then solves for limit and depth of a step
    /// together.
    fn hardens(&self) -> bool {
        false
    }

    /// Overwrites `out` \[Pa\] with the limit of the pair, at each node the smaller of the two bodies'
    /// limits. `films` and `depths` \[m\] are those of opposite nodes of the two bodies.
    ///
    /// # Errors
    /// Slices of different length.
    fn contact_limit_into(
        &self,
        films: [&[f64]; 2],
        depths: [&[f64]; 2],
        out: &mut [f64],
    ) -> Result<(), InputError> {
        for (name, pair) in [("films", films), ("depths", depths)] {
            InputError::require_len(name, pair[0], out.len())?;
            InputError::require_len(name, pair[1], out.len())?;
        }
        let first = films[0].iter().zip(depths[0]);
        let second = films[1].iter().zip(depths[1]);
        for (limit, (a, b)) in out.iter_mut().zip(first.zip(second)) {
            *limit = self.pressure_limit(*a.0, *a.1).min(self.pressure_limit(*b.0, *b.1));
        }
        Ok(())
    }
}
