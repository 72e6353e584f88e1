//! Deflection of journal and bush under a pressure.

use crate::elastic::{DeformationModel, HalfSpace};
use crate::error::InputError;
use crate::grid::Grid;

/// Deflection of journal and bush together under the pressure of the film.
///
/// ```
/// use stribeck::lubricant::{Barus, Incompressible, Lubricant};
/// use stribeck::reynolds::{ElasticBore, JournalBearing};
/// let oil = Lubricant::new(Barus::new(0.02, 0.0)?, Incompressible);
/// let rigid = JournalBearing::new([25e-3, 25e-3, 25e-6], 300.0, &oil).with_cells([60, 10]);
/// let liner = ElasticBore::Column { compliance: 1e-13 }; // 1 um at 10 MPa
/// let soft = rigid.with_bore(Some(liner)).solve(0.8)?;
/// assert!(soft.load < rigid.solve(0.8)?.load && soft.bore_widening > 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ElasticBore {
    /// Half-spaces along the unrolled film with `E'` \[Pa\] of journal and bush, `2/E' = (1 - v1^2)/E1 + (1 - v2^2)/E2`: thick bodies
    /// under a loaded arc that is short beside them.
    HalfSpace {
        /// Equivalent modulus \[Pa\].
        equivalent_modulus: f64,
    },
    /// A thin liner in a stiff housing, each column of which deflects by itself: `w = C p`.
    Column {
        /// Deflection per pressure \[m/Pa\].
        compliance: f64,
    },
}

impl ElasticBore {
    /// A bonded liner of a `thickness` \[m\] with Young's modulus \[Pa\] and Poisson's ratio below 0.5 in a stiff housing:
    /// `C = t (1 + v)(1 - 2 v)/(E (1 - v))`, for a liner that is thin beside the loaded arc.
    pub fn liner(thickness: f64, modulus: f64, poisson: f64) -> Self {
        let oedometric = modulus * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        Self::Column { compliance: thickness / oedometric }
    }

    /// Error for a value that is not finite and positive.
    pub(super) fn validate(self) -> Result<(), InputError> {
        match self {
            Self::HalfSpace { equivalent_modulus } => {
                InputError::require_positive("bore_modulus", equivalent_modulus)
            }
            Self::Column { compliance } => InputError::require_positive("liner_compliance", compliance),
        }
    }
}

/// The influence of the pressure on the film.
pub(super) enum Influence {
    HalfSpace(Box<HalfSpace>),
    Column(f64),
}

impl Influence {
    pub(super) fn new(bore: ElasticBore, grid: Grid) -> Result<Self, InputError> {
        bore.validate()?;
        Ok(match bore {
            ElasticBore::HalfSpace { equivalent_modulus } => {
                Self::HalfSpace(Box::new(HalfSpace::new(grid, equivalent_modulus)?))
            }
            ElasticBore::Column { compliance } => Self::Column(compliance),
        })
    }

    /// Widening under `pressure` \[m\].
    pub(super) fn widening(&mut self, pressure: &[f64]) -> Result<Vec<f64>, InputError> {
        match self {
            Self::HalfSpace(bodies) => {
                let mut out = vec![0.0; pressure.len()];
                bodies.displacement(pressure, &mut out)?;
                Ok(out)
            }
            Self::Column(compliance) => Ok(pressure.iter().map(|pressure| *compliance * pressure).collect()),
        }
    }
}
