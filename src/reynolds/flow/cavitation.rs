//! Cavitation conditions.
//!
//! The two conditions differ where films rupture behind the contact and in a starved inlet. `Discretisation`
//! applies them. Newton's method uses Reynolds' condition at first in a dry start, multigrid cycles always do.

use crate::error::{InputError, format_number};

/// Condition where the fluid pressure is the cavitation pressure, zero.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::Cavitation;
/// use stribeck::sim::Scene;
/// use stribeck::sim::{MixedLubricationSim, SimError};
/// // A starved inlet needs a mass-conserving condition.
/// let mut scene = Scene::azam_2019(32);
/// scene.lubricant = scene.lubricant.map(|oil| oil.with_supplied_film(Some(100e-9)));
/// scene.solver.cavitation = Some(Cavitation::Reynolds);
/// let error = MixedLubricationSim::builder(scene).build().unwrap_err();
/// assert!(error.to_string().contains("mass_conserving"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Cavitation {
    /// Mass is conserved. The film fraction `theta` satisfies `p_f >= 0`, `0 <= theta <= 1`, `p_f (1 - theta) = 0`,
    /// and `theta rho h` is entrained in place of `rho h` (Elrod and Adams 1974; as one complementarity pair
    /// Giacopini, Fowell, Dini and Strozzi 2010, doi 10.1115/1.4000794). A film reforms where the inflow fills
    /// the gap.
    #[default]
    MassConserving,
    /// Reynolds' condition: a cavitated cell entrains a full film whatever its inflow. Mass is created where a
    /// film reforms.
    Reynolds,
}

impl Cavitation {
    /// Rejects a supplied film `value` \[m\] under the key `field` with Reynolds' condition, which entrains a full
    /// film from cells that are not filled.
    pub(crate) fn require_conserved(self, field: &str, value: f64) -> Result<(), InputError> {
        if self == Self::MassConserving {
            return Ok(());
        }
        Err(InputError::Conflict {
            field: format!("{field} = {}", format_number(value)),
            reason: "with Reynolds' condition a cell that is not filled carries on a full film; it needs mass_conserving \
                     cavitation"
                .to_owned(),
        })
    }
}
