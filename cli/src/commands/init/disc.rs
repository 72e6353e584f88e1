//! Roughness of the disc: heights and their correlation length, a finish, or a measured surface; and the cells that
//! hold it.

use std::error::Error;
use std::path::{Path, PathBuf};

use stribeck::metrics::{AreaCorrelation, height_statistics};
use stribeck::{Boundary, Grid, surface};

use super::quantity::Quantity;
use super::{MOST_CELLS, plain, rounded};

/// Cells in the correlation length. The spectrum of heights with the autocorrelation `exp(-ln(10) r^2/L^2)` is
/// `exp(-q^2 L^2/(4 ln 10))`: four cells hold all but 1e-6 of the mean square slope, half as many, those of the
/// estimate of errors, all but 7 %.
const CELLS_IN_LENGTH: f64 = 4.0;
/// With `--cells` at least.
const FEWEST_IN_LENGTH: f64 = 3.0;
/// Cells across the contact and its surroundings: at least, and of a smooth contact.
const FEWEST_CELLS: u32 = 64;
const SMOOTH_CELLS: u32 = 128;
/// Most nodes of a box unless `--cells` says, and the cells of a square with as many.
const MOST_NODES: u32 = SQUARE * SQUARE;
const SQUARE: u32 = 512;
/// Keys of `[grid]` of a strip of a rough line contact: on a single row oil could not flow around asperities.
pub(super) const STRIP: &str =
    "across = \"periodic\" # a strip of the contact, five correlation lengths wide\n";
/// Its rows.
pub(super) const STRIP_ROWS: u32 = 20;
/// Value of the autocorrelation at which a length is measured, and the length over `L` there.
const THRESHOLD: f64 = 0.2;
const LENGTH_AT_THRESHOLD: f64 = 0.836;

/// Finish of a disc.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Finish {
    /// Rq 500 nm
    Ground,
    /// Rq 350 nm
    Honed,
    /// Rq 125 nm
    Superfinished,
    /// Rq 25 nm
    Polished,
}

impl Finish {
    /// The finish of this name.
    pub(super) fn named(text: &str) -> Option<Self> {
        <Self as clap::ValueEnum>::from_str(text.trim(), true).ok()
    }

    /// Rq \[m\]: 1.25 times the geometric mean of the Ra that ASME B46.1 (2009) lists for the process (ground 0.1
    /// to 1.6 um, honed 0.1 to 0.8, superfinished 0.05 to 0.2), of a polished one the Ra of balls of grade 10 in
    /// ISO 3290-1 (20 nm).
    pub(super) fn rq(self) -> f64 {
        match self {
            Self::Ground => 500e-9,
            Self::Honed => 350e-9,
            Self::Superfinished => 125e-9,
            Self::Polished => 25e-9,
        }
    }

    /// Correlation length \[m\], where the autocorrelation has fallen to 10 %. The mean absolute slope is
    /// `m = 0.124 (Rq/um)^0.743` (Antonetti, White and Simons 1993, J. Electronic Packaging 115, 131-134), and that
    /// of normal heights with a Gaussian autocorrelation `2 sqrt(ln(10)/pi) Rq/L`.
    pub(super) fn length(self) -> f64 {
        let slope = 0.124 * (self.rq() * 1e6).powf(0.743);
        2.0 * (std::f64::consts::LN_10 / std::f64::consts::PI).sqrt() * self.rq() / slope
    }

    /// Its name on the command line.
    fn name(self) -> &'static str {
        match self {
            Self::Ground => "ground",
            Self::Honed => "honed",
            Self::Superfinished => "superfinished",
            Self::Polished => "polished",
        }
    }
}

/// A measured surface.
#[derive(Debug, Clone)]
pub(super) struct Measured {
    path: PathBuf,
    /// Root mean square height \[m\].
    rq: f64,
    /// Cells that hold it \[m\].
    cell: f64,
    /// Extent along x and y \[m\].
    size: [f64; 2],
}

impl Measured {
    /// The surface in the file at `path`.
    pub(super) fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        let unusable = |reason: String| format!("--surface = {}: {reason}", path.display());
        let mut level = surface::read(path).map_err(|error| unusable(error.to_string()))?;
        let (Some(dx), Some(dy)) = (level.dx(), level.dy()) else {
            return Err(unusable("the file does not tell the spacing of its points".to_owned()).into());
        };
        level.remove_plane().map_err(|error| unusable(error.to_string()))?;
        let grid = Grid::centred(level.nx(), level.ny(), dx, dy)?;
        let correlation = AreaCorrelation::new(&grid, level.heights(), level.defined(), Boundary::Open)?;
        // Sal, where it lies within the surface
        let length = correlation.spatial(THRESHOLD)?.sal.map_or(0.0, |sal| sal / LENGTH_AT_THRESHOLD);
        Ok(Self {
            path: path.to_owned(),
            rq: height_statistics(level.heights())?.sq,
            cell: (length / CELLS_IN_LENGTH).max(dx).max(dy),
            size: [grid.size_x(), grid.size_y()],
        })
    }

    /// The path as the scene in `file` has it: paths in a scene count from its folder.
    fn path_from(&self, file: &Path) -> Result<String, Box<dyn Error>> {
        let beside = file.parent().is_none_or(|folder| folder.as_os_str().is_empty());
        let path = if beside { self.path.clone() } else { self.path.canonicalize()? };
        Ok(path.to_str().ok_or("--surface: the path is not UTF-8")?.to_owned())
    }
}

/// Roughness of the disc.
#[derive(Debug, Clone)]
pub(super) enum Disc {
    Smooth,
    /// Rq and correlation length.
    Random(Quantity, Quantity),
    Finish(Finish),
    Measured(Measured),
}

impl Disc {
    /// The key of `[friction]` that limits the shear stress of the oil at the pressures of asperities, which are several times those of
    /// smooth bodies; empty for a smooth disc. Limits are 5 to 10 % of the pressure (Johnson and Tevaarwerk 1977, Proc. R. Soc. A 356).
    pub(super) fn fluid_limit(&self) -> &'static str {
        match self {
            Self::Smooth => "",
            _ => "limiting_stress_coefficient = 0.05 # largest shear stress of the oil over its pressure\n",
        }
    }

    /// Root mean square height \[m\].
    pub(super) fn rq(&self) -> f64 {
        match self {
            Self::Smooth => 0.0,
            Self::Random(rq, _) => rq.value,
            Self::Finish(finish) => finish.rq(),
            Self::Measured(measured) => measured.rq,
        }
    }

    /// Correlation length of random heights \[m\].
    fn length(&self) -> Option<f64> {
        match self {
            Self::Smooth | Self::Measured(_) => None,
            Self::Random(_, length) => Some(length.value),
            Self::Finish(finish) => Some(finish.length()),
        }
    }

    /// Largest cells that hold the surface \[m\]; none of a smooth one.
    fn cell(&self) -> Option<f64> {
        match self {
            Self::Measured(measured) => Some(measured.cell),
            other => other.length().map(|length| length / CELLS_IN_LENGTH),
        }
    }

    /// Cells along a side of `size` \[m\]: those `asked` for, or as many as hold the surface of the disc.
    pub(super) fn cells(&self, asked: Option<u32>, size: f64) -> Result<u32, String> {
        let wanted = |cell: f64| (size / cell).ceil();
        if let Some(cells) = asked {
            return match self.length().filter(|length| *length < FEWEST_IN_LENGTH * size / f64::from(cells)) {
                None => Ok(cells),
                Some(length) => Err(format!(
                    "--cells = {cells}: the correlation length of {} um is less than {FEWEST_IN_LENGTH} cells of {} um; it takes {} cells",
                    plain(1e6 * length),
                    plain(1e6 * size / f64::from(cells)),
                    wanted(length / FEWEST_IN_LENGTH)
                )),
            };
        }
        let Some(cell) = self.cell() else { return Ok(SMOOTH_CELLS) };
        // An even number has a half, on which errors are estimated.
        let cells = 2.0 * (0.5 * wanted(cell)).ceil();
        match self {
            Self::Measured(_) => Ok(cells.clamp(f64::from(FEWEST_CELLS), f64::from(SQUARE)) as u32),
            _ => Ok((cells as u32).max(FEWEST_CELLS)),
        }
    }

    /// Error for more nodes than [`MOST_NODES`] that the option `--cells` has not `asked` for.
    pub(super) fn require_nodes(&self, asked: Option<u32>, [nx, ny]: [u32; 2]) -> Result<(), String> {
        if asked.is_some() || nx.saturating_mul(ny) <= MOST_NODES {
            return Ok(());
        }
        let longest = nx.max(ny);
        let by_option = if u64::from(longest) > MOST_CELLS {
            String::new()
        } else {
            format!(", or --cells {longest} (at most {MOST_CELLS})")
        };
        let longer = match self {
            Self::Finish(finish) => {
                format!(
                    "--roughness with a --length above the {} um of this finish",
                    plain(1e6 * rounded(finish.length()))
                )
            }
            _ => "a longer --length".to_owned(),
        };
        Err(format!(
            "the box takes {nx} x {ny} cells of a quarter of the correlation length, more than {MOST_NODES} nodes; {longer}, a smaller \
             load{by_option}"
        ))
    }

    /// Refuses a measured surface smaller than the box of the `size` \[m\].
    pub(super) fn require_size(&self, size: [f64; 2]) -> Result<(), String> {
        let Self::Measured(measured) = self else { return Ok(()) };
        match size.into_iter().zip(measured.size).find(|(box_, surface)| box_ > surface) {
            None => Ok(()),
            Some((wanted, found)) => Err(format!(
                "--surface = {}: it is {} mm long and the box {} mm; measure more of it, or take less load",
                measured.path.display(),
                plain(1e3 * found),
                plain(1e3 * wanted)
            )),
        }
    }

    /// The tables of the disc in the scene `file`; empty of a smooth one.
    pub(super) fn tables(&self, file: &Path, hardness: &str) -> Result<String, Box<dyn Error>> {
        let random = |rq: &str, length: &str, note: &str| {
            format!(
                "kind = \"gaussian\" # random; a measured surface is kind = \"file\", path = \"FILE\"\n\
                 rq = {rq} # root mean square height{note}\n\
                 length_x = {length} # where the autocorrelation has fallen to 10 %; the cells are a quarter of it or less\n\
                 length_y = {length}\n\
                 seed = 1 # another number is another surface of the same kind\n"
            )
        };
        let heights = match self {
            Self::Smooth => return Ok(String::new()),
            Self::Random(rq, length) => random(&rq.entry(), &length.entry(), ""),
            Self::Finish(finish) => random(
                &format!("\"{} nm\"", plain(1e9 * finish.rq())),
                &format!("\"{} um\"", plain(1e6 * rounded(finish.length()))),
                &format!(", typical of a {} surface", finish.name()),
            ),
            Self::Measured(measured) => {
                let path = toml_text(&measured.path_from(file)?);
                format!("kind = \"file\" # a measured surface, averaged on the cells\npath = {path}\n")
            }
        };
        Ok(format!(
            "\n[roughness.disc] # the ball is smooth\n{heights}\n\
             [plastic] # leave the table out for an elastic contact\n\
             hardness = \"{hardness}\" # no cell carries more\n"
        ))
    }
}

/// Text as a value in TOML: its escapes are those of JSON.
fn toml_text(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
