//! Viscosities of a sliding fluid in the flow by pressure.

use super::face_mobility::Direction;
use crate::error::InputError;
use crate::lubricant::{Rheology, ThermalRatios, Thinning};

/// Shear thinning of the flow by pressure, by the sliding of the surfaces along x.
///
/// Sliding at `u_s` shears a film of thickness `h` at the rate `g = u_s/h` by the stress `tau(eta g)` of a
/// [`Rheology`], Eyring's or Carreau's. The flow by pressure takes the viscosity that is left of the
/// Newtonian `eta`:
///
/// | flow | along the sliding direction | across it |
/// |---|---|---|
/// | effective ([`ShearThinning::new`]) | `tau/g` | `tau/g` |
/// | directional ([`ShearThinning::directional`]) | `d tau/dg` | `tau/g` |
///
/// What a small pressure gradient adds to the shear of sliding changes the rate along the sliding direction,
/// where the tangent of the law resists it, but across that direction only turns the stress: the secant
/// resists it, as in every generalised Newtonian fluid. `directional` is exact where sliding shears the film
/// far more than the pressure flow does; in `effective` the flow along is too small. The limiting stress of
/// the rheology does not enter.
///
/// Directional flow of Carreau's fluid with an exponent below 1/3: what flows through a face need not grow
/// with the pressure of its node everywhere, and solvers may stall.
///
/// Sources: Ehret, Dowson and Taylor (1998), Proceedings of the Royal Society A 454, 763-787; Greenwood
/// (2000), Proceedings of the Institution of Mechanical Engineers J 214, 29-41.
///
/// ```
/// use stribeck::lubricant::Rheology;
/// use stribeck::reynolds::ShearThinning;
/// let oil = ShearThinning::new(Rheology::eyring(5e6)?, 0.5)?;
/// // 10 Pa s over 100 nm: the Newtonian stress would be ten Eyring stresses.
/// let secant = 10.0_f64.asinh() / 10.0;
/// assert_eq!(oil.viscosity_ratios(10.0, 1e-7), [secant, secant]);
/// let [along, across] = oil.directional().viscosity_ratios(10.0, 1e-7);
/// assert!((along - 101.0_f64.powf(-0.5)).abs() < 1e-15 && across == secant);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearThinning {
    law: Thinning,
    sliding_speed: f64,
    is_directional: bool,
}

impl ShearThinning {
    /// One effective viscosity in all directions. `sliding_speed` is the difference of the surface speeds,
    /// not negative \[m/s\]; without any the fluid is Newtonian.
    ///
    /// # Errors
    /// A speed that is not finite or negative.
    pub fn new(rheology: Rheology, sliding_speed: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("shear_thinning.sliding_speed", sliding_speed)?;
        Ok(Self { law: rheology.thinning(), sliding_speed, is_directional: false })
    }

    /// The same with another viscosity along the sliding direction than across it.
    #[must_use]
    pub fn directional(self) -> Self {
        Self { is_directional: true, ..self }
    }

    /// Viscosity along and across the sliding direction over the Newtonian `viscosity` \[Pa s\], in (0, 1],
    /// in a film \[m\]; both arguments positive.
    pub fn viscosity_ratios(&self, viscosity: f64, film: f64) -> [f64; 2] {
        let ratios = self.node_ratios(self.length(viscosity) / film, [0.0; 2]);
        [ratios.along.value, ratios.across.value]
    }

    /// The film in which a fluid of `viscosity` \[Pa s\] has `x = eta u_s/(h S) = 1` \[m\], `S` the stress
    /// where thinning sets in; zero for a Newtonian one.
    pub(super) fn length(&self, viscosity: f64) -> f64 {
        viscosity * self.sliding_speed / self.law.onset()
    }

    /// The ratios at `x`, whose logarithmic derivatives by pressure and by film are given.
    pub(super) fn node_ratios(&self, x: f64, derivatives: [f64; 2]) -> NodeRatios {
        let ratio = |(value, slope): (f64, f64)| {
            let [by_pressure, by_film] = derivatives.map(|by| if slope == 0.0 { 0.0 } else { slope * by });
            ViscosityRatio { value, by_pressure, by_film }
        };
        let across = ratio(self.law.secant(x));
        NodeRatios { along: if self.is_directional { ratio(self.law.tangent(x)) } else { across }, across }
    }
}

/// A viscosity of one node over that of the law, with its derivatives by pressure and film.
#[derive(Debug, Clone, Copy)]
pub(super) struct ViscosityRatio {
    /// The ratio.
    pub(super) value: f64,
    /// By the pressure of the node \[1/Pa\].
    pub(super) by_pressure: f64,
    /// By its film \[1/m\].
    pub(super) by_film: f64,
}

impl ViscosityRatio {
    /// That of the law.
    const NEWTONIAN: Self = Self { value: 1.0, by_pressure: 0.0, by_film: 0.0 };

    /// The same `factor` times as large, whose logarithm has a `slope` by pressure \[1/Pa\].
    fn times(self, factor: f64, slope: f64) -> Self {
        Self {
            value: factor * self.value,
            by_pressure: factor * (self.by_pressure + slope * self.value),
            by_film: factor * self.by_film,
        }
    }
}

/// The ratios of one node along and across the sliding direction.
#[derive(Debug, Clone, Copy)]
pub(super) struct NodeRatios {
    /// For faces along the flow.
    along: ViscosityRatio,
    /// For faces across it.
    across: ViscosityRatio,
}

impl NodeRatios {
    /// Those of the law.
    pub(super) const NEWTONIAN: Self =
        Self { along: ViscosityRatio::NEWTONIAN, across: ViscosityRatio::NEWTONIAN };

    /// Those of a film of other viscosity and density: what flows is mass.
    pub(super) fn warmed(self, warm: &ThermalRatios) -> Self {
        let factor = warm.viscosity / warm.density;
        let slope = warm.viscosity_slope - warm.density_slope;
        Self { along: self.along.times(factor, slope), across: self.across.times(factor, slope) }
    }

    /// That of the flow through a face.
    #[inline]
    pub(super) fn of(&self, direction: Direction) -> ViscosityRatio {
        match direction {
            Direction::Along(..) | Direction::AlongAtRest => self.along,
            Direction::Across => self.across,
        }
    }
}
