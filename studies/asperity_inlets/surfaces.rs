//! Surfaces of the study.

use std::error::Error;

use stribeck::Grid;
use stribeck::surface::{Autocorrelation, Heights, RandomShape, RandomSurface, SelfAffine, Synthesis};

use super::BOX;

/// Cells of the mesh whose Fourier series the heights are.
const SERIES: usize = 32;

/// Spectrum of a surface.
pub(crate) enum Spectrum {
    /// Gaussian autocorrelation with these lengths along and across the flow \[m\].
    Gaussian([f64; 2]),
    /// Self-affine with this Hurst exponent, roll-off 16 um, shortest wave 4 um.
    SelfAffine(f64),
}

pub(crate) struct Surface {
    pub(crate) name: &'static str,
    rq: f64,
    spectrum: Spectrum,
    seed: u64,
}

pub(crate) const SURFACES: [Surface; 8] = [
    Surface { name: "Gaussian, 130 nm", rq: 130e-9, spectrum: Spectrum::Gaussian([10e-6; 2]), seed: 1 },
    Surface { name: "self-affine, H = 0.8", rq: 130e-9, spectrum: Spectrum::SelfAffine(0.8), seed: 2 },
    Surface { name: "self-affine, H = 0.4", rq: 60e-9, spectrum: Spectrum::SelfAffine(0.4), seed: 3 },
    Surface { name: "Gaussian, 200 nm", rq: 200e-9, spectrum: Spectrum::Gaussian([14e-6; 2]), seed: 4 },
    Surface { name: "Gaussian, 80 nm", rq: 80e-9, spectrum: Spectrum::Gaussian([12e-6; 2]), seed: 5 },
    Surface { name: "Gaussian, 30 nm", rq: 30e-9, spectrum: Spectrum::Gaussian([10e-6; 2]), seed: 6 },
    Surface {
        name: "lay along the flow, 3:1",
        rq: 130e-9,
        spectrum: Spectrum::Gaussian([24e-6, 8e-6]),
        seed: 8,
    },
    Surface {
        name: "lay across the flow, 1:3",
        rq: 130e-9,
        spectrum: Spectrum::Gaussian([8e-6, 24e-6]),
        seed: 9,
    },
];

impl Surface {
    pub(crate) fn has_lay(&self) -> bool {
        matches!(self.spectrum, Spectrum::Gaussian([along, across]) if (along / across - 1.0).abs() > 0.1)
    }

    /// Heights on the mesh of their Fourier series \[m\].
    fn series(&self) -> Result<(Grid, Vec<f64>), Box<dyn Error>> {
        let grid = Grid::centred(SERIES, SERIES, BOX / SERIES as f64, BOX / SERIES as f64)?;
        let shape = match self.spectrum {
            Spectrum::Gaussian([length_x, length_y]) => {
                let autocorrelation = Autocorrelation::Gaussian;
                RandomShape::Correlated { autocorrelation, length_x, length_y }
            }
            Spectrum::SelfAffine(hurst) => RandomShape::SelfAffine(SelfAffine {
                hurst,
                longest: f64::INFINITY,
                roll_off: 16e-6,
                shortest: 4e-6,
                synthesis: Synthesis::FilteredNoise,
            }),
        };
        let heights = RandomSurface::new(shape, self.rq, self.seed).generate(&grid)?;
        Ok((grid, heights))
    }

    /// Heights on `grid` \[m\] by their Fourier series.
    pub(crate) fn heights(&self, grid: &Grid) -> Result<Vec<f64>, Box<dyn Error>> {
        let (series, heights) = self.series()?;
        let surface = Heights::new(SERIES, SERIES, Some([series.dx(), series.dy()]), heights, None)?;
        Ok(surface.resample_fourier(grid.nx(), grid.ny())?.heights().to_vec())
    }
}
