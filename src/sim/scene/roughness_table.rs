//! The tables `[roughness.ball]` and `[roughness.disc]` of a scene file.
//!
//! A table in a file is flat: one `kind` and the keys of that kind. [`Roughness`] in memory has the types of the
//! generators. A new kind of surface needs a variant of [`RoughnessTable`] and an arm for each direction.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::tables::seed;
use super::{FileRoughness, Roughness};
use crate::boundary::Boundary;
use crate::surface::{
    Autocorrelation, DimpleLayout, GrooveDirection, HeightDistribution, HeightScale, RandomShape,
    RandomSurface, SelfAffine, Synthesis, Texture,
};

/// The table as written.
#[derive(Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum RoughnessTable {
    None {},
    Gaussian(CorrelatedTable),
    Exponential(CorrelatedTable),
    SelfAffine(SelfAffineTable),
    Dimples(DimplesTable),
    Grooves {
        width: f64,
        depth: f64,
        pitch: f64,
        direction: GrooveDirection,
    },
    File {
        path: PathBuf,
        #[serde(skip_serializing_if = "Option::is_none")]
        rq: Option<f64>,
    },
}

/// A surface by its autocorrelation.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CorrelatedTable {
    rq: f64,
    length_x: f64,
    length_y: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    skewness: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kurtosis: Option<f64>,
    #[serde(default, skip_serializing_if = "is_default")]
    height: HeightScale,
    #[serde(default, skip_serializing_if = "is_default")]
    boundary: Boundary,
    #[serde(default, with = "seed")]
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    cells: Option<[usize; 2]>,
}

/// A self-affine surface.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SelfAffineTable {
    rq: f64,
    hurst: f64,
    roll_off: f64,
    #[serde(default = "super::infinite", skip_serializing_if = "super::is_infinite")]
    longest: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    shortest: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    synthesis: Synthesis,
    #[serde(skip_serializing_if = "Option::is_none")]
    skewness: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kurtosis: Option<f64>,
    #[serde(default, skip_serializing_if = "is_default")]
    height: HeightScale,
    #[serde(default, skip_serializing_if = "is_default")]
    boundary: Boundary,
    #[serde(default, with = "seed")]
    seed: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    cells: Option<[usize; 2]>,
}

/// Dimples; those on a square lattice have no seed.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DimplesTable {
    radius: f64,
    depth: f64,
    pitch: f64,
    #[serde(default)]
    layout: Layout,
    #[serde(skip_serializing_if = "Option::is_none")]
    seed: Option<Seed>,
}

/// Values of `layout`.
#[derive(Serialize, Deserialize, Default)]
#[serde(rename_all = "snake_case")]
enum Layout {
    #[default]
    Square,
    Random,
}

/// A seed that is present.
#[derive(Serialize, Deserialize)]
struct Seed(#[serde(with = "seed")] u64);

/// Whether the value can be left out of a file.
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

impl TryFrom<RoughnessTable> for Roughness {
    type Error = String;

    fn try_from(table: RoughnessTable) -> Result<Self, String> {
        Ok(match table {
            RoughnessTable::None {} => Self::None,
            RoughnessTable::Gaussian(table) => table.surface(Autocorrelation::Gaussian)?,
            RoughnessTable::Exponential(table) => table.surface(Autocorrelation::Exponential)?,
            RoughnessTable::SelfAffine(table) => table.surface()?,
            RoughnessTable::Dimples(DimplesTable { radius, depth, pitch, layout, seed }) => {
                let layout = match (layout, seed) {
                    (Layout::Square, None) => DimpleLayout::Square,
                    (Layout::Square, Some(_)) => {
                        return Err("unknown field `seed`, dimples on a square lattice have none".to_owned());
                    }
                    (Layout::Random, seed) => DimpleLayout::Random { seed: seed.map_or(0, |seed| seed.0) },
                };
                Self::Texture(Texture::Dimples { radius, depth, pitch, layout })
            }
            RoughnessTable::Grooves { width, depth, pitch, direction } => {
                Self::Texture(Texture::Grooves { width, depth, pitch, direction })
            }
            RoughnessTable::File { path, rq } => Self::File(FileRoughness { path, rq }),
        })
    }
}

impl CorrelatedTable {
    fn surface(self, autocorrelation: Autocorrelation) -> Result<Roughness, String> {
        let Self { rq, length_x, length_y, height, boundary, seed, cells, .. } = self;
        let shape = RandomShape::Correlated { autocorrelation, length_x, length_y };
        let distribution = distribution(self.skewness, self.kurtosis)?;
        let surface = RandomSurface::new(shape, rq, seed);
        Ok(Roughness::Random(RandomSurface { distribution, height, boundary, cells, ..surface }))
    }

    fn of(surface: RandomSurface, [length_x, length_y]: [f64; 2]) -> Self {
        let RandomSurface { rq, height, boundary, seed, cells, .. } = surface;
        let (skewness, kurtosis) = moments(surface.distribution);
        Self { rq, length_x, length_y, skewness, kurtosis, height, boundary, seed, cells }
    }
}

impl SelfAffineTable {
    fn surface(self) -> Result<Roughness, String> {
        let Self { rq, hurst, roll_off, longest, shortest, synthesis, height, boundary, seed, cells, .. } =
            self;
        let shape = RandomShape::SelfAffine(SelfAffine { hurst, longest, roll_off, shortest, synthesis });
        let distribution = distribution(self.skewness, self.kurtosis)?;
        let surface = RandomSurface::new(shape, rq, seed);
        Ok(Roughness::Random(RandomSurface { distribution, height, boundary, cells, ..surface }))
    }

    fn of(surface: RandomSurface, spectrum: SelfAffine) -> Self {
        let RandomSurface { rq, height, boundary, seed, cells, .. } = surface;
        let SelfAffine { hurst, longest, roll_off, shortest, synthesis } = spectrum;
        let (skewness, kurtosis) = moments(surface.distribution);
        Self {
            rq,
            hurst,
            roll_off,
            longest,
            shortest,
            synthesis,
            skewness,
            kurtosis,
            height,
            boundary,
            seed,
            cells,
        }
    }
}

/// The distribution of heights with these moments.
fn distribution(skewness: Option<f64>, kurtosis: Option<f64>) -> Result<HeightDistribution, String> {
    match (skewness, kurtosis) {
        (None, None) => Ok(HeightDistribution::Normal),
        (Some(skewness), Some(kurtosis)) => Ok(HeightDistribution::Johnson { skewness, kurtosis }),
        (Some(_), None) => Err("missing field `kurtosis`, it goes with `skewness`".to_owned()),
        (None, Some(_)) => Err("missing field `skewness`, it goes with `kurtosis`".to_owned()),
    }
}

/// Skewness and kurtosis of heights that are not normal.
fn moments(distribution: HeightDistribution) -> (Option<f64>, Option<f64>) {
    match distribution {
        HeightDistribution::Normal => (None, None),
        HeightDistribution::Johnson { skewness, kurtosis } => (Some(skewness), Some(kurtosis)),
    }
}

impl From<Roughness> for RoughnessTable {
    fn from(roughness: Roughness) -> Self {
        match roughness {
            Roughness::None => Self::None {},
            Roughness::Random(surface) => match surface.shape {
                RandomShape::Correlated { autocorrelation, length_x, length_y } => {
                    let table = CorrelatedTable::of(surface, [length_x, length_y]);
                    match autocorrelation {
                        Autocorrelation::Gaussian => Self::Gaussian(table),
                        Autocorrelation::Exponential => Self::Exponential(table),
                    }
                }
                RandomShape::SelfAffine(spectrum) => Self::SelfAffine(SelfAffineTable::of(surface, spectrum)),
            },
            Roughness::Texture(Texture::Dimples { radius, depth, pitch, layout }) => {
                let (layout, seed) = match layout {
                    DimpleLayout::Square => (Layout::Square, None),
                    DimpleLayout::Random { seed } => (Layout::Random, Some(Seed(seed))),
                };
                Self::Dimples(DimplesTable { radius, depth, pitch, layout, seed })
            }
            Roughness::Texture(Texture::Grooves { width, depth, pitch, direction }) => {
                Self::Grooves { width, depth, pitch, direction }
            }
            Roughness::File(FileRoughness { path, rq }) => Self::File { path, rq },
        }
    }
}
