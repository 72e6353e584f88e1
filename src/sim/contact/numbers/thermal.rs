//! Temperature of the film.

/// Temperatures and heat of the film of a contact.
///
/// ```
/// use stribeck::sim::{MixedLubricationSim, Scene};
/// use stribeck::thermal::FilmThermal;
/// let mut scene = Scene::azam_2019(16);
/// // A temperature-dependent viscosity: 4 mPa s at 80 C.
/// scene.lubricant = scene.lubricant.map(|oil| {
///     let known = oil.with_temperature(Some(353.15)).with_roelands_s0(Some(1.1));
///     known.with_thermal(Some(FilmThermal::default()))
/// });
/// let record = MixedLubricationSim::builder(scene).build()?.step(10.0)?;
/// let thermal = record.thermal.ok_or("not modelled")?;
/// assert!(thermal.film_temperature_max > 353.15 && thermal.change <= 5e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ThermalNumbers {
    /// Largest mean temperature across the film \[K\].
    pub film_temperature_max: f64,
    /// Its mean over r <= 2a/3 \[K\].
    pub film_temperature_mean_central: f64,
    /// Largest rise of the ball's surface above the bulk temperature \[K\].
    pub surface_rise_ball: f64,
    /// Largest rise of the disc's surface above the bulk temperature \[K\].
    pub surface_rise_disc: f64,
    /// Heat of shear, of pressure flow, of compression and of solid friction \[W\]; of a line contact \[W/m\].
    pub heat: f64,
    /// Relative energy imbalance of the film.
    pub imbalance: f64,
    /// Number of contact solves.
    pub solves: u64,
    /// Largest difference at a node between the `ln eta` of the last solve and that of its heat, or ten times that of
    /// the thermal expansion if larger.
    pub change: f64,
}
