//! Velocity of the layers of a film.

use super::collocation::{Collocation, POINTS};

/// Velocity `v_0 + v_1 y - 6 v_2 (1/4 - y^2)` at the collocation points, `y` from -1/2 at the first surface to 1/2: the
/// mean of the surfaces, their sliding and the backflow by pressure in a film of uniform viscosity.
pub(super) fn velocity(rule: &Collocation, [even, skew, back]: [f64; 3]) -> [f64; POINTS] {
    rule.nodes.map(|z| even + skew * (z - 0.5) - 6.0 * back * z * (1.0 - z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_velocity_is_that_of_the_surfaces_less_the_backflow() {
        let rule = Collocation::new();
        let found = velocity(&rule, [2.0, 1.0, 1.5]);
        assert!((rule.mean(&found) - 0.5).abs() < 1e-14);
        // The middle turns back, the layers at the surfaces do not.
        assert!(found[3] < 0.0 && found[4] < 0.0 && found[0] > 0.0 && found[7] > found[0]);
    }
}
