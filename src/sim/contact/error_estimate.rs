//! Estimated errors of a solution.

/// Estimated errors of a solution: relative for films, pressure and friction, absolute for the two ratios.
///
/// For a smooth contact that chooses its mesh, the estimates come from three meshes. All others come from one mesh of
/// half the cells, with the Fourier series of the given surfaces. All include the error of the box relative to a flooded
/// inlet, which does not depend on the mesh. `docs/errors.md` compares them with actual errors.
///
/// # Examples
///
/// ```
/// use stribeck::sim::{Scene, solve_contact};
/// let mut scene = Scene::azam_2019(32);
/// scene.solver.estimate = true; // second solve on 16 x 16 cells
/// let solution = solve_contact(&scene)?;
/// let estimate = solution.error_estimate.ok_or("one of both was not solved")?;
/// assert!(estimate.film_mean_central >= 0.0 && estimate.contact_load_ratio <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ErrorEstimate {
    /// Error of the central film; 0 in a smooth dry contact, which has no film.
    pub film_central: f64,
    /// Error of the minimum film; 0 in a smooth dry contact.
    pub film_minimum: f64,
    /// Error of the maximum pressure. A pressure spike at the outlet does not converge on such meshes. If the maximum
    /// is at the spike or could move there, the estimate of a smooth contact is large.
    pub pressure_max: f64,
    /// Error of the mean film within two thirds of the Hertz radii.
    pub film_mean_central: f64,
    /// Error of the load ratio, absolute.
    pub contact_load_ratio: f64,
    /// Error of the area ratio, absolute.
    pub contact_area_ratio: f64,
    /// Error of the friction coefficient; 0 without sliding.
    pub friction_coefficient: f64,
    /// Part of the errors of central and mean film that is caused by the edges of the box; the rest is that of the mesh.
    /// 0 if the oil supply is at the edge of the box.
    pub film_by_box: f64,
}

impl ErrorEstimate {
    /// The error that the accuracy of a smooth contact bounds, whose box and cells are chosen: of the central film, and of the maximum
    /// pressure if it is dry.
    pub(in crate::sim) fn of_smooth(&self, is_lubricated: bool) -> f64 {
        if is_lubricated { self.film_central } else { self.pressure_max }
    }

    /// The largest of the four errors that the accuracy of any other contact bounds, with these friction coefficients of solids and
    /// fluid together and of the fluid. The part caused by the box is left out: it does not depend on the cells.
    pub(in crate::sim) fn of_cells(&self, [coefficient, fluid]: [f64; 2]) -> f64 {
        let friction_by_box = if coefficient > 0.0 { self.film_by_box * fluid / coefficient } else { 0.0 };
        let film = self.film_mean_central - self.film_by_box;
        let friction = self.friction_coefficient - friction_by_box;
        film.max(self.contact_load_ratio).max(self.contact_area_ratio).max(friction)
    }
}
