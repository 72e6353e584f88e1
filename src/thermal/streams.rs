//! Layers of a film that move on and layers that turn back.

/// Flows along x and back through a section whose layers move at
///
/// `u(y) = u [1 + S y - 6 b (1/4 - y^2)]`, `y` from -1/2 to 1/2 across the film:
///
/// that of the surfaces, with the slide-roll ratio `S`, and the parabola of one viscosity under pressure, with
/// `b = 1 - Q/E`, the flow `Q` through the section and the `E = u h` that is entrained. Layers from `y_1` to
/// `y_2` turn back, within the film:
///
/// `Q- = E [F(y_1) - F(y_2)]`, `F = y (2 b y^2 + S y/2 + 1 - 3 b/2)`, `Q+ = Q + Q-`.
///
/// With `r^2 = S^2 - 24 b (1 - 3 b/2)` they are the roots of `u(y)`, `y_1 = -(S + r)/(12 b)` and
/// `y_2 = -2 (1 - 3 b/2)/(S + r)`. With `b <= 0`, where pressure drives the film on, all layers below `y_2`
/// turn back: `y_1 = -1/2`.
///
/// Between surfaces of one speed nothing turns back unless `Q < E/3`; with `Q = 0` it is `E / (3 sqrt 3)`.
/// With `S > 2`, where the slower surface moves back, layers at it do whatever `b` is; with `S <= 2` and
/// `b <= 0` none do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Streams {
    /// `Q+` of the layers that move along x \[m^2/s\].
    pub(super) along: f64,
    /// `Q-` of those that move against it \[m^2/s\].
    pub(super) back: f64,
}

impl Streams {
    /// Of what is `entrained`, what goes `through` \[m^2/s\] and the slide-roll ratio `skew`, never negative:
    /// which of the surfaces is the faster makes no difference. Without entrainment all moves one way.
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
    fn streams_are_those_of_the_layers() {
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
        // Nothing turns back between surfaces of one speed unless less than a third of what is entrained
        // goes through.
        assert_eq!(Streams::new(1.0, 0.34, 0.0), Streams { along: 0.34, back: 0.0 });
        assert_eq!(Streams::new(0.0, -0.1, 0.0), Streams { along: 0.0, back: 0.1 });
    }
}
