//! Heights of which some are undefined.

use super::roughness::mean;
use crate::error::InputError;
use crate::grid::Grid;

/// Which points are defined.
#[derive(Clone, Copy)]
pub(super) struct Mask<'a> {
    /// Which points are defined; none where all are.
    defined: Option<&'a [bool]>,
}

impl<'a> Mask<'a> {
    /// Error unless both slices fit the grid and the defined heights, one at least, are finite.
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

    /// Whether value `k` counts.
    pub(super) fn has(&self, k: usize) -> bool {
        self.defined.is_none_or(|flags| flags[k])
    }

    /// Deviations of the defined heights from their mean, zero elsewhere.
    pub(super) fn deviations(&self, heights: &[f64]) -> Vec<f64> {
        let mean = mean(heights.iter().enumerate().filter(|&(k, _)| self.has(k)).map(|(_, z)| *z));
        heights.iter().enumerate().map(|(k, z)| if self.has(k) { z - mean } else { 0.0 }).collect()
    }
}
