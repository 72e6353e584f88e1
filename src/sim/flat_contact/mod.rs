//! Dry contact of two nominally flat rough surfaces: a cell that repeats along both axes.

mod cell;
mod table;

use std::path::Path;

use self::cell::{Cell, Solved};
use self::table::FlatFile;
use crate::error::{InputError, format_number};
use crate::grid::Grid;
use crate::report::Status;
use crate::reynolds::StoppingRule;
use crate::sim::contact::setup;
use crate::sim::contact::warnings::Warning;
use crate::sim::error::SimError;
use crate::sim::scene::{BODIES, Document, RoughnessPair};

/// Memory of a solve per node, with its coarser grids \[byte\].
const MEMORY: usize = 400;
/// Least cells along x.
const LEAST_CELLS: usize = 8;
/// Ratio of the root mean square slope between neighbors to that over two cells above which cells are too wide.
const RESOLVED: f64 = 1.1;
/// Step of the heights across the edges of the cell over that between neighbors above which they do not repeat.
const SEAM: f64 = 3.0;

/// Two rough surfaces that are flat and endless on the whole, by a scene file with `form.kind = "flat"`.
///
/// ```
/// use stribeck::sim::FlatContact;
/// let scene = "[form]\nkind = \"flat\"\n[elastic]\nequivalent_modulus = \"230 GPa\"\n[load]\nmean_pressure = \"20 MPa\"\n\
///              [grid]\nperiodic = true\nnx = 64\nny = 64\nx = [\"-50 um\", \"50 um\"]\ny = [\"-50 um\", \"50 um\"]\n\
///              [roughness.disc]\nkind = \"gaussian\"\nrq = \"50 nm\"\nlength_x = \"10 um\"\nlength_y = \"10 um\"\n";
/// let solved = FlatContact::from_toml(scene)?.solve(|| false)?;
/// let numbers = solved.numbers;
/// assert!(0.0 < numbers.area_share && numbers.area_share < 0.2 && numbers.mean_gap < 5.0 * numbers.composite_rq);
/// assert!((solved.pressure.iter().sum::<f64>() / (64.0 * 64.0) / 20e6 - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FlatContact {
    /// Equivalent modulus `E'` \[Pa\].
    pub equivalent_modulus: f64,
    /// Mean pressure or mean gap.
    pub load: FlatLoad,
    /// The cell, which repeats along both axes.
    pub grid: Grid,
    /// Roughness of both bodies.
    pub roughness: RoughnessPair,
    /// Pressure limit \[Pa\]; `None` for elastic bodies.
    pub hardness: Option<f64>,
    /// Gap error at convergence, relative to the mean displacement.
    pub tolerance: f64,
    /// Largest number of active-set passes.
    pub max_iterations: u64,
}

/// Load of a flat contact.
///
/// ```
/// use stribeck::sim::FlatLoad;
/// assert_ne!(FlatLoad::MeanPressure(1e7), FlatLoad::MeanGap(1e-7));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FlatLoad {
    /// Load over area of the cell \[Pa\].
    MeanPressure(f64),
    /// Mean gap of the deformed surfaces \[m\].
    MeanGap(f64),
}

/// Numbers of a solved flat contact.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct FlatContactNumbers {
    /// Load over area of the cell \[Pa\].
    pub mean_pressure: f64,
    /// Mean gap of the deformed surfaces \[m\].
    pub mean_gap: f64,
    /// Share of the cell under pressure.
    pub area_share: f64,
    /// Share of the cell at the pressure limit.
    pub plastic_share: f64,
    /// Largest pressure \[Pa\].
    pub pressure_max: f64,
    /// Increase of the mean pressure over the decrease of the mean gap of further loading \[Pa/m\]; `None` where the
    /// gap is closed.
    pub stiffness: Option<f64>,
    /// Mean overlap at the pressure limit \[m\].
    pub mean_plastic_depth: f64,
    /// Composite root mean square height \[m\].
    pub composite_rq: f64,
    /// Root mean square slope of both surfaces together between neighboring nodes.
    pub rms_slope: f64,
    /// Area share times `E'/2` times the root mean square slope over the mean pressure: of a small elastic contact 1.60 in
    /// the theory of Persson, 2.51 in that of Bush, Gibson and Thomas.
    pub area_over_load: f64,
    /// Upper bound of the relative energy error.
    pub energy_error: f64,
    /// Elastic convolutions of the last solve.
    pub convolutions: f64,
}

/// A solved flat contact.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct FlatContactSolution {
    /// Whether the dry contact converged.
    pub status: Status,
    /// Mean gap over load, area and stiffness.
    pub numbers: FlatContactNumbers,
    /// The cell.
    pub grid: Grid,
    /// Pressure \[Pa\].
    pub pressure: Vec<f64>,
    /// Gap of the deformed surfaces \[m\].
    pub film: Vec<f64>,
    /// Undeformed gap \[m\].
    pub gap: Vec<f64>,
    /// Overlap of nodes at the pressure limit \[m\].
    pub plastic_depth: Vec<f64>,
    /// Implausible values.
    pub warnings: Vec<Warning>,
}

impl FlatContact {
    /// Reads a scene with `form.kind = "flat"` from TOML text.
    ///
    /// # Errors
    /// [`SimError::Scene`] with key and line for a value that does not fit, [`SimError::Input`] for a table that a flat
    /// contact does not use.
    pub fn from_toml(text: &str) -> Result<Self, SimError> {
        Self::read(&Document::parse(text)?)
    }

    /// Reads a parsed scene file.
    pub(super) fn read(document: &Document<'_>) -> Result<Self, SimError> {
        Ok(document.read::<FlatFile>(|_| Vec::new())?.contact()?)
    }

    /// The contact with paths of files relative to `folder`.
    pub(super) fn in_folder(mut self, folder: &Path) -> Self {
        self.roughness.locate_files(folder);
        self
    }

    /// Solves; `interrupted` ends it with an error between two solves.
    ///
    /// # Errors
    /// A value out of range, smooth surfaces, a mean pressure that the hardness does not carry, a mean gap at which the
    /// surfaces do not touch, an interruption.
    pub fn solve(&self, interrupted: impl Fn() -> bool) -> Result<FlatContactSolution, SimError> {
        let (heights, mut warnings) = self.heights()?;
        warnings.extend(self.doubts(&heights));
        let (n, slope) = (heights.len() as f64, self.slope(&heights, 1));
        let highest = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let mean = heights.iter().sum::<f64>() / n;
        let gap = heights.iter().map(|height| highest - height).collect();
        let most = self.hardness.unwrap_or(f64::INFINITY);
        let stop = (self.tolerance, self.max_iterations);
        let mut cell = Cell::new(self.grid, self.equivalent_modulus, gap, self.hardness, stop)?;
        let solved = match self.load {
            FlatLoad::MeanPressure(pressure) => cell.under_pressure(pressure)?,
            FlatLoad::MeanGap(gap) => {
                let touch = highest - mean;
                if !(gap > 0.0 && gap < touch) {
                    return Err(SimError::Input(InputError::Conflict {
                        field: format!("load.mean_gap = {}", format_number(gap)),
                        reason: format!(
                            "must be above 0 and below {} m, where the surfaces touch",
                            format_number(touch)
                        ),
                    }));
                }
                let scale = 0.05 * self.equivalent_modulus * slope;
                let solved = cell.at_gap(gap, [scale, most], &interrupted)?;
                solved.ok_or_else(|| InputError::Conflict {
                    field: format!("load.mean_gap = {}", format_number(gap)),
                    reason: "no mean pressure was found for it; give load.mean_pressure".to_owned(),
                })?
            }
        };
        if interrupted() {
            return Err(SimError::Interrupted);
        }
        let stiffness = cell.stiffness(&solved, most)?;
        let rq = (heights.iter().map(|height| (height - mean).powi(2)).sum::<f64>() / n).sqrt();
        Ok(self.solution(cell, (&solved, stiffness), [rq, slope], warnings))
    }

    /// Heights of both bodies together \[m\], and doubts about their files.
    fn heights(&self) -> Result<(Vec<f64>, Vec<Warning>), SimError> {
        let grid = &self.grid;
        InputError::require_positive("elastic.equivalent_modulus", self.equivalent_modulus)?;
        for (field, n) in [("grid.nx", grid.nx()), ("grid.ny", grid.ny())] {
            InputError::require(n >= LEAST_CELLS, field, n as f64, "at least 8 for a flat contact")?;
        }
        StoppingRule { tolerance: self.tolerance, max_iterations: self.max_iterations }.validate()?;
        if let FlatLoad::MeanPressure(pressure) = self.load {
            InputError::require_positive("load.mean_pressure", pressure)?;
            if let Some(hardness) = self.hardness.filter(|hardness| pressure >= *hardness) {
                return Err(SimError::Input(InputError::Conflict {
                    field: format!("load.mean_pressure = {}", format_number(pressure)),
                    reason: format!(
                        "the cell carries less than plastic.hardness = {}",
                        format_number(hardness)
                    ),
                }));
            }
        }
        if let Some(hardness) = self.hardness {
            InputError::require_positive("plastic.hardness", hardness)?;
        }
        grid.require_memory(MEMORY)?;
        let (mut sum, mut warnings) = (vec![0.0; grid.len()], Vec::new());
        for (roughness, name) in [&self.roughness.ball, &self.roughness.disc].into_iter().zip(BODIES) {
            let body = setup::heights(roughness, grid, name)?;
            warnings.extend(body.file_warnings);
            sum.iter_mut().zip(&body.heights).for_each(|(sum, height)| *sum += height);
        }
        let lowest = sum.iter().copied().fold(f64::INFINITY, f64::min);
        if sum.iter().all(|height| *height <= lowest) {
            return Err(SimError::Input(InputError::Conflict {
                field: "roughness".to_owned(),
                reason: "both surfaces are smooth: they touch everywhere".to_owned(),
            }));
        }
        Ok((sum, warnings))
    }

    /// Root mean square slope of periodic `heights` over `step` cells.
    fn slope(&self, heights: &[f64], step: usize) -> f64 {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let run = [self.grid.dx(), self.grid.dy()].map(|spacing| spacing * step as f64);
        let square = |k: usize| {
            let (i, j) = (k % nx, k / nx);
            let along = heights[j * nx + (i + step) % nx] - heights[k];
            let across = heights[(j + step) % ny * nx + i] - heights[k];
            (along / run[0]).powi(2) + (across / run[1]).powi(2)
        };
        ((0..heights.len()).map(square).sum::<f64>() / heights.len() as f64).sqrt()
    }

    /// Warnings about heights that the cells do not resolve or that do not repeat.
    fn doubts(&self, heights: &[f64]) -> Vec<Warning> {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let ratio = self.slope(heights, 1) / self.slope(heights, 2);
        let coarse = (ratio > RESOLVED).then(|| {
            Warning::new(
                "grid.nx",
                nx as f64,
                format!(
                    "the cells do not resolve the roughness: its root mean square slope is {:.0} % larger over one cell than \
                     over two, and area, pressures and stiffness depend on the cells",
                    100.0 * (ratio - 1.0)
                ),
                "use smaller cells, or roughness with a longer shortest wave".to_owned(),
            )
        });
        let steps = |pairs: &mut dyn Iterator<Item = (usize, usize)>| {
            let (sum, n) = pairs
                .fold((0.0, 0.0_f64), |(sum, n), (a, b)| (sum + (heights[a] - heights[b]).powi(2), n + 1.0));
            (sum / n.max(1.0)).sqrt()
        };
        let seams = [
            steps(&mut (0..ny).map(|j| (j * nx, j * nx + nx - 1))),
            steps(&mut (0..nx).map(|i| (i, (ny - 1) * nx + i))),
        ];
        let inside = [
            steps(&mut (0..heights.len()).filter(|k| k % nx > 0).map(|k| (k, k - 1))),
            steps(&mut (nx..heights.len()).map(|k| (k, k - nx))),
        ];
        let torn = seams.into_iter().zip(inside).find(|(seam, inside)| *seam > SEAM * inside);
        let torn = torn.map(|(seam, inside)| {
            Warning::new(
                "roughness",
                f64::NAN,
                format!(
                    "the heights do not repeat: they step by {seam:.2e} m across the edges of the cell, by {inside:.2e} m \
                     between neighbors"
                ),
                "use generated roughness, or a patch of a measured surface whose edges fit".to_owned(),
            )
        });
        coarse.into_iter().chain(torn).collect()
    }

    /// The solution in the last state of `cell`.
    fn solution(
        &self,
        cell: Cell,
        (solved, stiffness): (&Solved, Option<f64>),
        [composite_rq, rms_slope]: [f64; 2],
        warnings: Vec<Warning>,
    ) -> FlatContactSolution {
        let [film, plastic_depth] = cell.films();
        let n = film.len() as f64;
        let share = |least: f64| cell.pressure.iter().filter(|p| **p >= least).count() as f64 / n;
        let area_share = share(f64::MIN_POSITIVE);
        let Solved { mean_pressure, mean_gap, outcome } = *solved;
        let status = match outcome.converged {
            true => Status::Converged,
            false if outcome.passes < self.max_iterations => Status::Stalled,
            false => Status::MaxIterations,
        };
        let numbers = FlatContactNumbers {
            mean_pressure,
            mean_gap,
            area_share,
            plastic_share: self.hardness.map_or(0.0, share),
            pressure_max: cell.pressure.iter().copied().fold(0.0, f64::max),
            stiffness,
            mean_plastic_depth: plastic_depth.iter().sum::<f64>() / n,
            composite_rq,
            rms_slope,
            area_over_load: area_share * 0.5 * self.equivalent_modulus * rms_slope / mean_pressure,
            energy_error: outcome.energy_error,
            convolutions: outcome.convolutions,
        };
        FlatContactSolution {
            status,
            numbers,
            grid: self.grid,
            film,
            plastic_depth,
            pressure: cell.pressure,
            gap: cell.gap,
            warnings,
        }
    }
}

impl FlatContactSolution {
    /// Fields by name, one value per node: `pressure` \[Pa\], `film`, `gap` and `plastic_depth` \[m\].
    pub fn fields(&self) -> [(&'static str, &[f64]); 4] {
        [
            ("pressure", &self.pressure),
            ("film", &self.film),
            ("gap", &self.gap),
            ("plastic_depth", &self.plastic_depth),
        ]
    }
}
