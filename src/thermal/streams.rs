//! Forward and reverse flow of a film section.

/// Forward and reverse flow along x through a section with the velocity profile
///
/// `u(y) = u [1 + S y - 6 b (1/4 - y^2)]`, `y` from -1/2 to 1/2 across the film:
///
/// It is the sum of the surface velocities with the slide-roll ratio `S` and a parabola of pressure flow at
/// uniform viscosity. `b = 1 - Q/E`, with the flow `Q` through the section and the entrainment `E = u h`.
/// Layers from `y_1` to `y_2` move backward, within the film:
///
/// `Q- = E [F(y_1) - F(y_2)]`, `F = y (2 b y^2 + S y/2 + 1 - 3 b/2)`, `Q+ = Q + Q-`.
///
/// With `r^2 = S^2 - 24 b (1 - 3 b/2)` the limits are the roots of `u(y)`, `y_1 = -(S + r)/(12 b)` and
/// `y_2 = -2 (1 - 3 b/2)/(S + r)`. With `b <= 0`, where pressure drives the film forward, all layers below
/// `y_2` move backward: `y_1 = -1/2`.
///
/// Between surfaces of equal speed there is reverse flow only for `Q < E/3`; at `Q = 0` it is
/// `E / (3 sqrt 3)`. With `S > 2`, where the slower surface moves backward, reverse flow exists for any `b`;
/// with `S <= 2` and `b <= 0` there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Streams {
    /// Forward flow `Q+` \[m^2/s\].
    pub(super) along: f64,
    /// Reverse flow `Q-` \[m^2/s\].
    pub(super) back: f64,
}

impl Streams {
    /// Flows for the entrainment `entrained`, the flow `through` the section \[m^2/s\] and the non-negative
    /// slide-roll ratio `skew`; it does not matter which surface is faster. Without entrainment all flow has
    /// one direction.
    pub(super) fn new(entrained: f64, through: f64, skew: f64) -> Self {
        let b = 1.0 - through / entrained;
        let inside = skew * skew - 24.0 * b * (1.0 - 1.5 * b);
        let back = if entrained > 0.0 && inside > 0.0 {
            let sum = skew + inside.sqrt();
            let first = if b > 0.0 { -sum / (12.0 * b) } else { -0.5 };
            let last = -2.0 * (1.0 - 1.5 * b) / sum;
            let flow = |y: f64| y * (2.0 * b * y * y + 0.5 * skew * y + 1.0 - 1.5 * b);
            entrained * (flow(first.clamp(-0.5, 0.5)) - flow(last.clamp(-0.5, 0.5))).max(0.0)
        } else {
            (-through).max(0.0)
        };
        Self { along: (through + back).max(0.0), back }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_equal_integrals_of_the_velocity_profile() {
        for (through, skew) in [
            (1.0, 0.0),
            (0.5, 0.0),
            (0.1, 0.0),
            (0.0, 2.0),
            (-0.4, 1.0),
            (0.3, 0.5),
            (1.3, 0.0),
            (1.0, 3.0),
            (1.3, 3.0),
        ] {
            let b = 1.0 - through;
            let n = 200_000;
            let layers = (0..n).map(|i| (f64::from(i) + 0.5) / f64::from(n) - 0.5);
            let speeds = layers.map(|y| 1.0 + skew * y - 6.0 * b * (0.25 - y * y));
            let (along, back) =
                speeds.fold((0.0, 0.0), |(along, back), u: f64| (along + u.max(0.0), back - u.min(0.0)));
            let found = Streams::new(1.0, through, skew);
            let scale = f64::from(n);
            assert!((found.along - along / scale).abs() < 1e-8, "{through}, {skew}: {found:?}");
            assert!((found.back - back / scale).abs() < 1e-8, "{through}, {skew}: {found:?}");
        }
        // Equal surface speeds: no reverse flow for Q > E/3.
        assert_eq!(Streams::new(1.0, 0.34, 0.0), Streams { along: 0.34, back: 0.0 });
        assert_eq!(Streams::new(0.0, -0.1, 0.0), Streams { along: 0.0, back: 0.1 });
    }
}
