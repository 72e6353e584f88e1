//! Self-affine spectra.

use crate::error::InputError;
use crate::grid::Grid;
use crate::numerics::map_lines;

/// A spectrum that decreases as `q^(-2 (1 + hurst))` above the roll-off wave number, `q = 2 pi / wavelength`; constant
/// below it, zero outside the cut-offs.
///
/// Source: Jacobs, T. D. B., Junge, T. and Pastewka, L. (2017), Surface Topography: Metrology and Properties
/// 5, 013001.
///
/// # Examples
///
/// ```
/// use stribeck::surface::{RandomShape, RandomSurface, SelfAffine, Synthesis};
/// use stribeck::{Grid, metrics::height_statistics};
/// let spectrum = SelfAffine {
///     hurst: 0.8,
///     longest: 200e-6,
///     roll_off: 50e-6,
///     shortest: 5e-6,
///     synthesis: Synthesis::FilteredNoise,
/// };
/// let grid = Grid::centred(128, 128, 1.6e-6, 1.6e-6)?;
/// let heights = RandomSurface::new(RandomShape::SelfAffine(spectrum), 50e-9, 9).generate(&grid)?;
/// assert!((height_statistics(&heights)?.sq / 50e-9 - 1.0).abs() < 1e-9);
/// # Ok::<(), stribeck::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelfAffine {
    /// Hurst exponent, above 0 and at most 1: 1 is smoothest.
    pub hurst: f64,
    /// Longest wavelength \[m\]; infinite for the size of the grid.
    pub longest: f64,
    /// Roll-off wavelength \[m\], at most `longest`; the spectrum decreases at shorter wavelengths.
    pub roll_off: f64,
    /// Shortest wavelength \[m\], below `roll_off`; 0 for that of the grid.
    pub shortest: f64,
    /// Randomness of the modes.
    pub synthesis: Synthesis,
}

/// Randomness of the modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Synthesis {
    /// Random amplitude and phase of every mode: filtered white noise.
    #[default]
    FilteredNoise,
    /// Random phases only: every surface has exactly the given spectrum.
    RandomPhase,
}

impl SelfAffine {
    /// Checks the exponent and the order of the wavelengths.
    pub(super) fn validate(&self) -> Result<(), InputError> {
        let Self { hurst, longest, roll_off, shortest, .. } = *self;
        let exists = hurst > 0.0 && hurst <= 1.0;
        InputError::require(exists, "roughness.hurst", hurst, "above 0 and at most 1")?;
        InputError::require(longest > 0.0, "roughness.longest", longest, "> 0")?;
        let ordered = roll_off > 0.0 && roll_off <= longest && roll_off.is_finite();
        let range = "> 0 and at most the longest wavelength";
        InputError::require(ordered, "roughness.roll_off", roll_off, range)?;
        let ordered = shortest >= 0.0 && shortest < roll_off;
        let range = ">= 0 and below the roll-off wavelength";
        InputError::require(ordered, "roughness.shortest", shortest, range)
    }

    /// The density of 0 to `nx / 2` by 0 to `ny / 2` waves, of any scale.
    pub(super) fn density_quarter(&self, grid: &Grid) -> Vec<f64> {
        // relative slack: modes at a cut-off are not lost to rounding
        let (lowest, highest) = ((1.0 - 1e-9) / self.longest, (1.0 + 1e-9) / self.shortest);
        let exponent = -(1.0 + self.hurst);
        let width = grid.nx() / 2 + 1;
        let mut quarter = vec![0.0; width * (grid.ny() / 2 + 1)];
        map_lines(&mut quarter, width, |j, row| {
            let y = j as f64 / grid.size_y();
            for (i, value) in row.iter_mut().enumerate() {
                let x = i as f64 / grid.size_x();
                let square = x * x + y * y;
                if (lowest * lowest..=highest * highest).contains(&square) {
                    // faster than a power
                    *value = (exponent * (square * self.roll_off * self.roll_off).max(1.0).ln()).exp();
                }
            }
        });
        quarter
    }
}
