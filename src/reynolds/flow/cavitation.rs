//! What becomes of fluid that cannot fill its gap.
//!
//! The two conditions differ behind the contact, where films rupture, and in front of it where the inlet is
//! starved. `Discretisation` makes the difference; Newton's method begins a dry start with Reynolds' condition,
//! and multigrid's cycles always work with it.

use crate::error::{InputError, format_number};

/// What holds where the fluid pressure is at the cavitation pressure, zero.
///
/// # Examples
///
/// ```
/// use stribeck::reynolds::Cavitation;
/// use stribeck::sim::Scene;
/// use stribeck::sim::{MixedLubricationSim, SimError};
/// // A starved inlet asks for a condition that knows how much fluid there is.
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
    /// Mass is conserved: the gap is filled to the content `theta`, `p_f >= 0`, `0 <= theta <= 1`,
    /// `p_f (1 - theta) = 0`, and `theta rho h` is carried along in place of `rho h` (Elrod and Adams 1974;
    /// as one complementary pair Giacopini, Fowell, Dini and Strozzi 2010, doi 10.1115/1.4000794). Fluid
    /// reforms where what arrives fills the gap again.
    #[default]
    MassConserving,
    /// Reynolds' condition: a cavitated cell carries along a full film, whatever it got. Where fluid reforms,
    /// it is made out of nothing.
    Reynolds,
}

impl Cavitation {
    /// Refuses a supplied film `value` \[m\], named `field`, where a cell that is not filled carries on a
    /// full film.
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
