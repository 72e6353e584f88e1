//! What the moving surfaces carry through a face.

/// Discretisation of the wedge term `u d(rho h)/dx`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Scheme {
    /// First-order upwind: the flux through a face is that of the node upstream of it.
    FirstOrder,
    /// Second-order upwind: the flux through a face is extrapolated from the two nodes upstream of it. On films that fall
    /// steeply it may become negative.
    SecondOrder,
    /// Limited second order: the density extrapolated from the two nodes upstream times the film of the face,
    /// `h_f = h_0 + minmod(h_0 - h_-1, h_1 - h_0)/2`, with `h_-1`, `h_0` the films of the two nodes upstream and `h_1` that of the
    /// node downstream. `minmod` is the smaller of both, zero where their signs differ: no film of a face is negative.
    #[default]
    Limited,
}

/// What the film of a face is beyond that of the node upstream \[m\], with its derivatives by the films of that node, of the one
/// downstream and of the one further upstream.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct FaceFilm {
    pub(super) beyond: f64,
    pub(super) by_own: f64,
    pub(super) by_next: f64,
    pub(super) by_up: f64,
}

impl FaceFilm {
    /// The mean of both films, where there is none further upstream.
    #[inline]
    pub(super) fn central(own: f64, next: f64) -> Self {
        Self { beyond: 0.5 * (next - own), by_own: -0.5, by_next: 0.5, by_up: 0.0 }
    }

    /// Half the smaller of the two differences of the films `up`, `own` and `next`, zero where their signs differ.
    #[inline]
    pub(super) fn limited(up: f64, own: f64, next: f64) -> Self {
        let (behind, ahead) = (own - up, next - own);
        if behind * ahead <= 0.0 {
            Self::default()
        } else if behind.abs() <= ahead.abs() {
            Self { beyond: 0.5 * behind, by_own: 0.5, by_next: 0.0, by_up: -0.5 }
        } else {
            Self { beyond: 0.5 * ahead, by_own: -0.5, by_next: 0.5, by_up: 0.0 }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_film_of_a_face_lies_between_those_of_its_nodes() {
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
