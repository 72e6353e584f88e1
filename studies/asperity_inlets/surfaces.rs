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
    /// Whether it has contacts of given lambdas.
    pub(crate) has_lambdas: bool,
}

pub(crate) const SURFACES: [Surface; 11] = [
    Surface::new("Gaussian, 130 nm", 130e-9, Spectrum::Gaussian([10e-6, 10e-6]), 1).with_lambdas(),
    Surface::new("self-affine, H = 0.8", 130e-9, Spectrum::SelfAffine(0.8), 2).with_lambdas(),
    Surface::new("self-affine, H = 0.4", 60e-9, Spectrum::SelfAffine(0.4), 3),
    Surface::new("Gaussian, 200 nm", 200e-9, Spectrum::Gaussian([14e-6, 14e-6]), 4),
    Surface::new("Gaussian, 80 nm", 80e-9, Spectrum::Gaussian([12e-6, 12e-6]), 5),
    Surface::new("Gaussian, 30 nm", 30e-9, Spectrum::Gaussian([10e-6, 10e-6]), 6),
    Surface::new("Gaussian, 130 nm, seed 11", 130e-9, Spectrum::Gaussian([10e-6, 10e-6]), 11),
    Surface::new("Gaussian, 80 nm, seed 12", 80e-9, Spectrum::Gaussian([12e-6, 12e-6]), 12),
    Surface::new("self-affine, H = 0.8, seed 13", 130e-9, Spectrum::SelfAffine(0.8), 13),
    Surface::new("lay along the flow, 3:1", 130e-9, Spectrum::Gaussian([24e-6, 8e-6]), 8),
    Surface::new("lay across the flow, 1:3", 130e-9, Spectrum::Gaussian([8e-6, 24e-6]), 9),
];

impl Surface {
    const fn new(name: &'static str, rq: f64, spectrum: Spectrum, seed: u64) -> Self {
        Self { name, rq, spectrum, seed, has_lambdas: false }
    }

    const fn with_lambdas(self) -> Self {
        Self { has_lambdas: true, ..self }
    }

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
