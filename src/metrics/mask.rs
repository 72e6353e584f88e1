//! Heights with undefined points.

use super::roughness::mean;
use crate::error::InputError;
use crate::grid::Grid;

/// Defined points of a field.
#[derive(Clone, Copy)]
pub(super) struct Mask<'a> {
    /// Flags of the defined points; `None` if all are defined.
    defined: Option<&'a [bool]>,
}

impl<'a> Mask<'a> {
    /// Checks that both slices fit the grid and that at least one height is defined and all defined ones are
    /// finite.
    pub(super) fn new(grid: &Grid, heights: &[f64], defined: Option<&'a [bool]>) -> Result<Self, InputError> {
        InputError::require_len("heights", heights, grid.len())?;
        if let Some(flags) = defined {
            InputError::require_len("defined", flags, heights.len())?;
        }
        let mask = Self { defined };
        let wrong = heights.iter().enumerate().find(|&(k, z)| !z.is_finite() && mask.has(k));
        if let Some((index, &value)) = wrong {
            return Err(InputError::NotFinite { field: "heights".to_owned(), index, value });
        }
        let any = defined.is_none_or(|flags| flags.contains(&true));
        InputError::require(any, "defined", 0.0, "true for one point at least")?;
        Ok(mask)
    }

    /// Whether point `k` is defined.
    pub(super) fn has(&self, k: usize) -> bool {
        self.defined.is_none_or(|flags| flags[k])
    }

    /// Deviations of the defined heights from their mean, zero elsewhere.
    pub(super) fn deviations(&self, heights: &[f64]) -> Vec<f64> {
        let mean = mean(heights.iter().enumerate().filter(|&(k, _)| self.has(k)).map(|(_, z)| *z));
        heights.iter().enumerate().map(|(k, z)| if self.has(k) { z - mean } else { 0.0 }).collect()
    }
}
