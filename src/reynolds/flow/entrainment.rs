//! Entrainment flux through a face.

/// Discretization of the wedge term `u d(rho h)/dx`.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::{ContactDefinition, Scheme};
/// use stribeck::sim::Scene;
/// let mut scene = Scene::azam_2019(32);
/// assert_eq!(scene.scheme(), Scheme::Limited);
/// scene.solver.contact = ContactDefinition::UnifiedReynolds;
/// assert_eq!(scene.scheme(), Scheme::FirstOrder); // as published
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Scheme {
    /// First-order upwind: the flux through a face is that of its upstream node.
    FirstOrder,
    /// Second-order upwind: the flux through a face is extrapolated from the two upstream nodes. It may become
    /// negative if the film decreases steeply.
    SecondOrder,
    /// Limited second order. The density `rho_0 + (rho_0 - rho_-1)/2` is extrapolated from the two upstream nodes
    /// and multiplied by the face film `h_f = h_0 + minmod(h_0 - h_-1, h_1 - h_0)/2`; `h_-1` and `h_0` are the films
    /// of the two upstream nodes, `h_1` that of the downstream node. `minmod` is the smaller of both, or zero if
    /// their signs differ, so that no face film is negative. With `FaceMobility::Inlet` the density extrapolation is
    /// multiplied by `min(1, h_0/h_-1)^2`: at the edge of a contact density rises as the film decreases, but not
    /// behind the edge.
    #[default]
    Limited,
}

/// Film of a face minus that of the upstream node \[m\], with its derivatives by the films of that node, of the
/// downstream node and of the next node upstream.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct FaceFilm {
    /// Film of the face minus that of the upstream node.
    pub(super) beyond: f64,
    /// Derivative by the film of the upstream node.
    pub(super) by_own: f64,
    /// Derivative by that of the downstream node.
    pub(super) by_next: f64,
    /// Derivative by that of the next node upstream.
    pub(super) by_up: f64,
}

impl FaceFilm {
    /// The mean of both films, without a second upstream node.
    #[inline]
    pub(super) fn central(own: f64, next: f64) -> Self {
        Self { beyond: 0.5 * (next - own), by_own: -0.5, by_next: 0.5, by_up: 0.0 }
    }

    /// Half of the smaller of the two differences of the films `up`, `own` and `next`, zero if their signs differ.
    #[inline]
    pub(super) fn limited(up: f64, own: f64, next: f64) -> Self {
        let (behind, ahead) = (own - up, next - own);
        // Minmod: zero at extrema, else the smaller difference.
        if behind * ahead <= 0.0 {
            Self::default()
        } else if behind.abs() <= ahead.abs() {
            Self { beyond: 0.5 * behind, by_own: 0.5, by_next: 0.0, by_up: -0.5 }
        } else {
            Self { beyond: 0.5 * ahead, by_own: -0.5, by_next: 0.5, by_up: 0.0 }
        }
    }
}

/// Density of a face minus that of the upstream node, extrapolated from the next node upstream, with its
/// derivatives by densities and films of both.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct DensityRise {
    /// Density ratio of the face minus that of the upstream node.
    pub(super) rise: f64,
    /// Derivative by the density of the node; that by the density of the next node upstream is its negative.
    pub(super) by_density: f64,
    /// Derivative by the film of the node \[1/m\].
    pub(super) by_own_film: f64,
    /// Derivative by that of the next node upstream \[1/m\].
    pub(super) by_up_film: f64,
}

impl DensityRise {
    /// From density and film of the upstream node, `own`, and of the next one upstream, `up`.
    #[inline]
    pub(super) fn new(own: (f64, f64), up: (f64, f64)) -> Self {
        let half = 0.5 * (own.0 - up.0);
        if own.1 >= up.1 {
            return Self { rise: half, by_density: 0.5, by_own_film: 0.0, by_up_film: 0.0 };
        }
        // Weighted by the square of the film ratio where the film decreases.
        let ratio = own.1 / up.1;
        let weight = ratio * ratio;
        let slope = 2.0 * half * ratio / up.1;
        Self { rise: weight * half, by_density: 0.5 * weight, by_own_film: slope, by_up_film: -slope * ratio }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn densities_are_extrapolated_for_non_decreasing_films() {
        for (films, rise) in
            [([3.0, 3.0], 0.05), ([2.0, 4.0], 0.05), ([4.0, 2.0], 0.0125), ([40.0, 1.0], 0.05 / 1600.0)]
        {
            let [up, own] = films;
            let found = DensityRise::new((1.2, own), (1.1, up));
            assert!((found.rise - rise).abs() < 1e-15, "{found:?}");
            let moved =
                |by: [f64; 4]| DensityRise::new((1.2 + by[0], own + by[2]), (1.1 + by[1], up + by[3])).rise;
            let exact = [found.by_density, -found.by_density, found.by_own_film, found.by_up_film];
            for (slot, exact) in exact.into_iter().enumerate() {
                // Not at the kink at equal films.
                if (up - own).abs() < 1e-9 && slot > 1 {
                    continue;
                }
                let by = |step: f64| std::array::from_fn(|other| if other == slot { step } else { 0.0 });
                let difference = (moved(by(1e-6)) - moved(by(-1e-6))) / 2e-6;
                assert!((difference - exact).abs() < 1e-8, "{films:?}, {slot}: {difference}, {exact}");
            }
        }
    }

    #[test]
    fn face_film_is_between_the_films_of_its_nodes() {
        for up in [1.0, 2.0, 5.0, 9.0] {
            for own in [1.0, 3.0, 8.0] {
                for next in [0.5, 3.0, 4.0, 20.0] {
                    let face = own + FaceFilm::limited(up, own, next).beyond;
                    assert!(face >= own.min(next) && face <= own.max(next), "{up} {own} {next}: {face}");
                }
            }
        }
        // Exact for straight films.
        assert!((FaceFilm::limited(5.0, 4.0, 3.0).beyond + 0.5).abs() < 1e-15);
    }
}
