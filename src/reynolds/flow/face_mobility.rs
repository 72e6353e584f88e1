//! Pressure flow through the face between two nodes.

use super::direction::Direction;
use super::node::NodeFlow;
use super::shear_thinning::ViscosityRatio;

/// Law of the pressure flow through the face between two nodes.
///
/// | law | `A` | potential |
/// |---|---|---|
/// | `Arithmetic` | mean of `rho/rho_0 eta_0/eta h^3` of the nodes | `p` |
/// | `ReducedPressure` | mean of `h^3` of the nodes | `q = integral of (rho/rho_0) (eta_0/eta) dp` |
/// | `Wedge`, faces along the flow with `h_0 > h_1` | `2 h_0 h_1 h_f - 2 h_0^2 h_1^2 / (h_0 + h_1)` | `q` |
/// | `Inlet`, faces along the flow with `h_0 > h_1` | that of `Wedge` times `(1 + Y)/(1 + 2 h_0^2 I)` | `q` |
/// | `Wedge` and `Inlet`, all other faces | `2 h_0^2 h_1^2 / (h_0 + h_1)` | `q` |
///
/// On faces along the flow with decreasing film and increasing density, that of `Inlet` is multiplied by
/// `1 + (rho_1/rho_0 - 1)(1 - h_1/h_0)`.
///
/// The flow through the face is `A / (12 eta_0)` times the potential difference over the distance. `h_0` is the
/// upstream film, `h_1` the downstream film, `h_f` the face film of the entrainment scheme; `Y = (h_0 - h_1)/h_1`.
/// `I` is the integral of `(h - h_1)/h^3` over the distance of the nodes, `Y/(2 h_0^2)` for a linear film.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::FaceMobility;
/// use stribeck::sim::Scene;
/// let mut scene = Scene::azam_2019(32);
/// assert_eq!(scene.face_mobility(), FaceMobility::Inlet); // rough bodies
/// scene.roughness = Default::default();
/// assert_eq!(scene.face_mobility(), FaceMobility::Wedge); // smooth ones
/// scene.solver.face_mobility = Some(FaceMobility::ReducedPressure);
/// assert_eq!(scene.face_mobility(), FaceMobility::ReducedPressure);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum FaceMobility {
    /// Arithmetic mean of the nodal mobilities `rho h^3 / (12 eta)` times the pressure difference: the common
    /// choice.
    Arithmetic,
    /// Mean of `h^3 / (12 eta_0)` times the difference of reduced pressures. It is exact in the viscosity, so that
    /// the flow increases with the pressure difference for any viscosity law.
    ReducedPressure,
    /// Mobility of a linear film between the two nodes, with reduced pressures. The exact flow is
    /// `u 2 h_0 h_1/(h_0 + h_1) + 2 h_0^2 h_1^2/(h_0 + h_1) (q_0 - q_1)/(12 eta_0 dx)`. Its first term makes the
    /// film upstream of a steep decrease grow without bound, so the entrainment is `u h_f`. For decreasing films the
    /// mobility is chosen to give the exact pressure rise at the flow `u h_1` through a node in contact. The inlet
    /// of an asperity then builds up its pressure on cells much wider than the inlet.
    Wedge,
    /// Mobility of a film that is flat behind the edge of a contact and rises in front of it like the gap of a Hertz
    /// contact, `s^(3/2)`. The edge position is reconstructed from the films of two nodes in front of it. At edges
    /// oblique to the flow the pressure is that of the flow component along the edge normal, taken from the
    /// undeformed gap. Resolved films have the mobility of `Wedge`.
    #[default]
    Inlet,
}

/// Mobility of a face with its derivatives by pressure and film of both nodes, by the ratio of the face film to
/// the first film, and by the inlet factor.
#[derive(Debug, Clone, Copy)]
pub(super) struct FaceFlow {
    /// Flow over the difference of the potentials.
    pub(super) mobility: f64,
    /// Derivatives by pressure and film of the first node.
    pub(super) first: [f64; 2],
    /// Derivatives by pressure and film of the second node.
    pub(super) second: [f64; 2],
    /// Derivative by the film of the face over that of the first node.
    pub(super) by_face_film: f64,
    /// Derivative by the inlet factor.
    pub(super) by_inlet: f64,
}

impl FaceMobility {
    /// The mobility of a Newtonian fluid between two nodes.
    #[inline(always)] // Callers that only use the mobility drop the derivatives.
    pub(super) fn of(self, fluidity: f64, a: &NodeFlow, b: &NodeFlow, direction: Direction) -> FaceFlow {
        match self {
            Self::Arithmetic | Self::ReducedPressure => FaceFlow {
                mobility: 0.5 * (a.mobility + b.mobility),
                first: [0.5 * a.mobility_p, 0.5 * a.mobility_h],
                second: [0.5 * b.mobility_p, 0.5 * b.mobility_h],
                by_face_film: 0.0,
                by_inlet: 0.0,
            },
            Self::Wedge | Self::Inlet => {
                let [cube, by_a, by_b, by_face, by_inlet] = wedge(a.film, b.film, direction);
                let flow = FaceFlow {
                    mobility: fluidity * cube,
                    first: [0.0, fluidity * by_a * a.film_h],
                    second: [0.0, fluidity * by_b * b.film_h],
                    by_face_film: fluidity * by_face,
                    by_inlet: fluidity * by_inlet,
                };
                if self == Self::Inlet && matches!(direction, Direction::Along(..)) {
                    flow.densified(a, b)
                } else {
                    flow
                }
            }
        }
    }
}

impl FaceFlow {
    /// Multiplies by `1 + (rho_1/rho_0 - 1)(1 - h_1/h_0)` if film decreases and density increases along the flow:
    /// the denser fluid needs less back flow in the inlet.
    #[inline(always)]
    fn densified(self, a: &NodeFlow, b: &NodeFlow) -> Self {
        // Relative rise of the density and decrease of the film.
        let (rise, fall) = (b.density / a.density - 1.0, 1.0 - b.film / a.film);
        if !(rise > 0.0 && fall > 0.0) {
            return self;
        }
        // Factor of a density that rises where the film decreases.
        let factor = 1.0 + rise * fall;
        let by = |[p, h]: [f64; 2], factor_p: f64, factor_h: f64| {
            [factor * p + self.mobility * factor_p, factor * h + self.mobility * factor_h]
        };
        let per_film = rise / a.film;
        Self {
            mobility: factor * self.mobility,
            first: by(
                self.first,
                -fall * b.density * a.density_p / (a.density * a.density),
                per_film * (1.0 - fall) * a.film_h,
            ),
            second: by(self.second, fall * b.density_p / a.density, -per_film * b.film_h),
            by_face_film: factor * self.by_face_film,
            by_inlet: factor * self.by_inlet,
        }
    }

    /// Divides by the mean of the viscosity ratios of the nodes.
    pub(super) fn thinned(self, first: ViscosityRatio, second: ViscosityRatio) -> Self {
        let mean = 0.5 * (first.value + second.value);
        let mobility = self.mobility / mean;
        let by = |[p, h]: [f64; 2], ratio: ViscosityRatio| {
            [(p - 0.5 * mobility * ratio.by_pressure) / mean, (h - 0.5 * mobility * ratio.by_film) / mean]
        };
        Self {
            mobility,
            first: by(self.first, first),
            second: by(self.second, second),
            by_face_film: self.by_face_film / mean,
            by_inlet: self.by_inlet / mean,
        }
    }
}

/// Replacement of `h^3` between the films `a` and `b`, and its derivatives by both, by the ratio of the face film
/// to `a` and by the inlet factor.
#[inline(always)]
fn wedge(a: f64, b: f64, direction: Direction) -> [f64; 5] {
    let sum = a + b;
    if sum == 0.0 {
        return [0.0; 5];
    }
    let ab = a * b;
    // Exact mean of the cubes for a film that is linear between the nodes.
    let exact = 2.0 * ab * ab / sum;
    let (by_a, by_b) = ((4.0 * ab * b - exact) / sum, (4.0 * ab * a - exact) / sum);
    match direction {
        Direction::Along(face, inlet) if a > b => {
            // A converging film with entrainment: by the film of the face and the inlet factor.
            let whole = 2.0 * ab * a;
            let even = whole * face - exact;
            [
                inlet * even,
                inlet * (4.0 * ab * face - by_a),
                inlet * (2.0 * a * a * face - by_b),
                inlet * whole,
                even,
            ]
        }
        _ => [exact, by_a, by_b, 0.0, 0.0],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_of_the_wedge_are_exact() {
        for (a, b) in [(3.0, 2.0), (2.0, 3.0), (50.0, 1.0), (1.0, 50.0)] {
            for direction in [Direction::Across, Direction::Along(1.0, 1.0), Direction::Along(0.7, 0.6)] {
                let [_, by_a, by_b, by_face, by_inlet] = wedge(a, b, direction);
                let step = 1e-6;
                let slope = |value: &dyn Fn(f64) -> f64| (value(step) - value(-step)) / (2.0 * step);
                let found = [
                    (by_a, slope(&|d| wedge(a + d, b, direction)[0])),
                    (by_b, slope(&|d| wedge(a, b + d, direction)[0])),
                    (
                        by_face,
                        match direction {
                            Direction::AlongWithoutEntrainment | Direction::Across => 0.0,
                            Direction::Along(f, i) => slope(&|d| wedge(a, b, Direction::Along(f + d, i))[0]),
                        },
                    ),
                    (
                        by_inlet,
                        match direction {
                            Direction::AlongWithoutEntrainment | Direction::Across => 0.0,
                            Direction::Along(f, i) => slope(&|d| wedge(a, b, Direction::Along(f, i + d))[0]),
                        },
                    ),
                ];
                for (exact, difference) in found {
                    assert!((exact - difference).abs() < 1e-6 * (1.0 + exact.abs()), "{exact}, {difference}");
                }
            }
        }
    }

    /// A linear film between two nodes: entrainment of the mean `2 a b / (a + b)` and exact mobility. A face that
    /// entrains the upstream film while the downstream film passes needs the same pressure rise.
    #[test]
    fn steep_film_steps_have_the_exact_pressure_rise() {
        for a in [5.0, 50.0, 500.0] {
            let b = 1.0;
            let exact_rise = (2.0 * a * b / (a + b) - b) / wedge(a, b, Direction::Across)[0];
            let rise = (a - b) / wedge(a, b, Direction::Along(1.0, 1.0))[0];
            assert!((rise / exact_rise - 1.0).abs() < 1.01 / a, "{rise} and {exact_rise} from {a}");
        }
        let cube = |direction| wedge(2.0, 2.0, direction)[0];
        for direction in [Direction::Across, Direction::Along(1.0, 1.0)] {
            assert!((cube(direction) - 8.0).abs() < 1e-14);
        }
    }
}
