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
    Gaussian(RandomTable<CorrelationLengths>),
    Exponential(RandomTable<CorrelationLengths>),
    SelfAffine(RandomTable<SelfAffineTable>),
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

/// A random surface, with the keys of its `shape`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RandomTable<S> {
    rq: f64,
    #[serde(flatten)]
    shape: S,
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
}

/// Lengths at which the autocorrelation is 10 % \[m\].
#[derive(Serialize, Deserialize)]
pub(super) struct CorrelationLengths {
    length_x: f64,
    length_y: f64,
}

/// The spectrum of a self-affine surface.
#[derive(Serialize, Deserialize)]
pub(super) struct SelfAffineTable {
    hurst: f64,
    roll_off: f64,
    #[serde(default = "super::infinite", skip_serializing_if = "super::is_infinite")]
    longest: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    shortest: f64,
    #[serde(default, skip_serializing_if = "is_default")]
    synthesis: Synthesis,
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
        let correlated = |autocorrelation, table: RandomTable<CorrelationLengths>| {
            let CorrelationLengths { length_x, length_y } = table.shape;
            table.surface(RandomShape::Correlated { autocorrelation, length_x, length_y })
        };
        Ok(match table {
            RoughnessTable::None {} => Self::None,
            RoughnessTable::Gaussian(table) => correlated(Autocorrelation::Gaussian, table)?,
            RoughnessTable::Exponential(table) => correlated(Autocorrelation::Exponential, table)?,
            RoughnessTable::SelfAffine(table) => {
                let SelfAffineTable { hurst, roll_off, longest, shortest, synthesis } = table.shape;
                let spectrum = SelfAffine { hurst, longest, roll_off, shortest, synthesis };
                table.surface(RandomShape::SelfAffine(spectrum))?
            }
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

impl<S> RandomTable<S> {
    /// The surface of `shape` with the other keys of the table.
    fn surface(&self, shape: RandomShape) -> Result<Roughness, String> {
        let distribution = match (self.skewness, self.kurtosis) {
            (None, None) => HeightDistribution::Normal,
            (Some(skewness), Some(kurtosis)) => HeightDistribution::Johnson { skewness, kurtosis },
            (Some(_), None) => return Err("missing field `kurtosis`, it goes with `skewness`".to_owned()),
            (None, Some(_)) => return Err("missing field `skewness`, it goes with `kurtosis`".to_owned()),
        };
        let (height, boundary) = (self.height, self.boundary);
        let surface =
            RandomSurface { distribution, height, boundary, ..RandomSurface::new(shape, self.rq, self.seed) };
        Ok(Roughness::Random(surface))
    }

    /// The table of `surface`, whose shape has the keys `shape`.
    fn of(surface: &RandomSurface, shape: S) -> Self {
        let (skewness, kurtosis) = match surface.distribution {
            HeightDistribution::Normal => (None, None),
            HeightDistribution::Johnson { skewness, kurtosis } => (Some(skewness), Some(kurtosis)),
        };
        let RandomSurface { rq, height, boundary, seed, .. } = *surface;
        Self { rq, shape, skewness, kurtosis, height, boundary, seed }
    }
}

impl From<Roughness> for RoughnessTable {
    fn from(roughness: Roughness) -> Self {
        match roughness {
            Roughness::None => Self::None {},
            Roughness::Random(surface) => match surface.shape {
                RandomShape::Correlated { autocorrelation, length_x, length_y } => {
                    let table = RandomTable::of(&surface, CorrelationLengths { length_x, length_y });
                    match autocorrelation {
                        Autocorrelation::Gaussian => Self::Gaussian(table),
                        Autocorrelation::Exponential => Self::Exponential(table),
                    }
                }
                RandomShape::SelfAffine(SelfAffine { hurst, longest, roll_off, shortest, synthesis }) => {
                    let keys = SelfAffineTable { hurst, roll_off, longest, shortest, synthesis };
                    Self::SelfAffine(RandomTable::of(&surface, keys))
                }
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
