//! Film of a starved contact.

/// Film of a starved contact beside that of the flooded one.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.roughness = Default::default(); // smooth
/// scene.motion.entrainment_speed = 2.0;
/// let flooded = solve_contact(&scene)?;
/// assert!(flooded.starvation.is_none());
/// scene.lubricant = scene.lubricant.map(|oil| oil.with_supplied_film(Some(20e-9)));
/// let starvation = solve_contact(&scene)?.starvation.ok_or("not solved")?;
/// assert!((starvation.flooded_film / flooded.film.central - 1.0).abs() < 1e-6);
/// assert!(starvation.film_ratio < 0.7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct StarvationNumbers {
    /// Central film of the same contact with flooded inlets \[m\].
    pub flooded_film: f64,
    /// Central film over that film.
    pub film_ratio: f64,
}
