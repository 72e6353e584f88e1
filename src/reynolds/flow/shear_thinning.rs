//! Shear thinning of the pressure flow.

use super::direction::Direction;
use crate::error::InputError;
use crate::lubricant::{Rheology, ThermalRatios, Thinning};

/// Shear thinning of the pressure flow by sliding of the surfaces along x.
///
/// Sliding at `u_s` shears a film of thickness `h` at the rate `g = u_s/h` with the stress `tau(eta g)` of a
/// [`Rheology`], Eyring's or Carreau's. The viscosity of the pressure flow replaces the Newtonian `eta`:
///
/// | flow | along the sliding direction | across it |
/// |---|---|---|
/// | effective ([`ShearThinning::new`]) | `tau/g` | `tau/g` |
/// | directional ([`ShearThinning::directional`]) | `d tau/dg` | `tau/g` |
///
/// A small pressure gradient along the sliding direction changes the shear rate, so the tangent of the law
/// resists it. Across that direction it only rotates the stress, so the secant resists it, as in every generalized
/// Newtonian fluid. `directional` is exact if sliding shears the film much more than the pressure flow does;
/// `effective` underestimates the flow along the sliding direction. The limiting stress of the rheology is not used.
///
/// With directional flow and Carreau exponents below 1/3, the flow through a face may decrease with the pressure of
/// its node, and solvers may stall.
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
    /// The same effective viscosity in all directions. `sliding_speed` is the magnitude of the difference of the
    /// surface speeds \[m/s\]; at zero the fluid is Newtonian.
    ///
    /// # Errors
    /// A speed that is negative or not finite.
    pub fn new(rheology: Rheology, sliding_speed: f64) -> Result<Self, InputError> {
        InputError::require_non_negative("shear_thinning.sliding_speed", sliding_speed)?;
        Ok(Self { law: rheology.thinning(), sliding_speed, is_directional: false })
    }

    /// The same with different viscosities along and across the sliding direction.
    #[must_use]
    pub fn directional(self) -> Self {
        Self { is_directional: true, ..self }
    }

    /// Viscosity along and across the sliding direction over the Newtonian `viscosity` \[Pa s\], in (0, 1], in a
    /// film of thickness `film` \[m\]; both arguments must be positive.
    pub fn viscosity_ratios(&self, viscosity: f64, film: f64) -> [f64; 2] {
        let ratios = self.node_ratios(self.length(viscosity) / film, [0.0; 2]);
        [ratios.along.value, ratios.across.value]
    }

    /// Film in which a fluid of `viscosity` \[Pa s\] has `x = eta u_s/(h S) = 1` \[m\], with `S` the stress at the
    /// onset of thinning; zero for a Newtonian fluid.
    pub(super) fn length(&self, viscosity: f64) -> f64 {
        viscosity * self.sliding_speed / self.law.onset()
    }

    /// The ratios at `x` from its logarithmic derivatives by pressure and by film.
    pub(super) fn node_ratios(&self, x: f64, derivatives: [f64; 2]) -> NodeRatios {
        let ratio = |(value, slope): (f64, f64)| {
            let [by_pressure, by_film] = derivatives.map(|by| if slope == 0.0 { 0.0 } else { slope * by });
            ViscosityRatio { value, by_pressure, by_film }
        };
        // The secant viscosity across the sliding, the tangent along it.
        let across = ratio(self.law.secant(x));
        NodeRatios { along: if self.is_directional { ratio(self.law.tangent(x)) } else { across }, across }
    }
}

/// Viscosity of a node over that of the law, with its derivatives by pressure and film.
#[derive(Debug, Clone, Copy)]
pub(super) struct ViscosityRatio {
    /// The ratio.
    pub(super) value: f64,
    /// Derivative by the pressure of the node \[1/Pa\].
    pub(super) by_pressure: f64,
    /// Derivative by its film \[1/m\].
    pub(super) by_film: f64,
}

impl ViscosityRatio {
    /// The viscosity of the law.
    const NEWTONIAN: Self = Self { value: 1.0, by_pressure: 0.0, by_film: 0.0 };

    /// Multiplies by `factor`, whose logarithm has the derivative `slope` by pressure \[1/Pa\].
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
    /// The viscosity of the law in both directions.
    pub(super) const NEWTONIAN: Self =
        Self { along: ViscosityRatio::NEWTONIAN, across: ViscosityRatio::NEWTONIAN };

    /// The ratios of the mass flow in a warm film, of other viscosity and density.
    pub(super) fn warmed(self, warm: &ThermalRatios) -> Self {
        let factor = warm.viscosity / warm.density;
        let slope = warm.viscosity_slope - warm.density_slope;
        Self { along: self.along.times(factor, slope), across: self.across.times(factor, slope) }
    }

    /// The ratio for flow through a face in `direction`.
    #[inline]
    pub(super) fn of(&self, direction: Direction) -> ViscosityRatio {
        match direction {
            Direction::Along(..) | Direction::AlongWithoutEntrainment => self.along,
            Direction::Across => self.across,
        }
    }
}
