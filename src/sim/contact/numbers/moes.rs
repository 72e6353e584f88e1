//! Moes' parameters.

/// Moes' parameters.
///
/// `M = W / (2 U)^(3/4)` and `L = G (2 U)^(1/4)` for a point contact, `W / (2 U)^(1/2)` and `G (2 U)^(1/4)` for a line
/// contact, with the dimensionless load `W`, speed `U` and material parameter `G` of Hamrock and Dowson along
/// entrainment. A smooth contact of given form depends on these two numbers only.
///
/// Source: Moes, H. (2000), Lubrication and Beyond, University of Twente.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// let moes = solve_contact(&scene)?.moes.ok_or("a dry contact")?;
/// scene.motion.entrainment_speed *= 16.0;
/// let faster = scene.formula_film()?.ok_or("a dry contact")?.moes;
/// assert!((faster.m / moes.m - 1.0 / 8.0).abs() < 1e-9 && (faster.l / moes.l - 2.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Moes {
    /// Load parameter M.
    pub m: f64,
    /// Lubricant parameter L.
    pub l: f64,
}
