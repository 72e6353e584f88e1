//! Estimated errors of a solution.

/// Estimated errors of a solution, those of films, pressure and friction over their value, those of the two
/// ratios as they are.
///
/// The estimates of a smooth contact that picks its mesh come from three meshes, all others from one mesh of half
/// the cells, on which the surfaces are the Fourier series of the given ones. All hold the error of the box, which
/// no mesh shows, against a flooded inlet. How far they were found to hold is in `docs/errors.md`.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.solver.estimate = true; // solved on 16 x 16 cells too
/// let solution = solve_contact(&scene)?;
/// let estimate = solution.error_estimate.ok_or("one of both was not solved")?;
/// assert!(estimate.film_mean_central >= 0.0 && estimate.contact_load_ratio <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ErrorEstimate {
    /// Of the central film; 0 in a smooth dry contact, whose film is none.
    pub film_central: f64,
    /// Of the minimum film; 0 in a smooth dry contact.
    pub film_minimum: f64,
    /// Of the maximum pressure. A pressure spike at the outlet does not converge on such meshes: where it is,
    /// or may still become, the maximum, the estimate of a smooth contact says so and is large.
    pub pressure_max: f64,
    /// Of the mean film within two thirds of the Hertz radii.
    pub film_mean_central: f64,
    /// Of the share of the load that solid contact carries, absolute.
    pub contact_load_ratio: f64,
    /// Of the area of solid contact over the Hertz area, absolute.
    pub contact_area_ratio: f64,
    /// Of the friction coefficient; 0 without sliding.
    pub friction_coefficient: f64,
    /// The part of the errors of the central and the mean film that the edges of the box make, which is in them; the
    /// rest is that of the mesh. 0 where the oil begins at the edge of the box.
    pub film_by_box: f64,
}
