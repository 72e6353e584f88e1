//! The tables `[roughness.ball]` and `[roughness.disc]` of a scene file.
//!
//! A table in a file is flat: one `kind` and the keys of that kind. [`Roughness`] in memory is an enum with only the
//! fields of its kind. This file converts in both directions. A new kind of surface needs a variant of
//! `RoughnessKind`, its keys, and a function for each direction.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::tables::{keyed, required, seed};
use super::{FileRoughness, Roughness};
use crate::boundary::Boundary;
use crate::surface::{
    Autocorrelation, DimpleLayout, GrooveDirection, HeightDistribution, HeightScale, RandomShape,
    RandomSurface, SelfAffine, Synthesis, Texture,
};

keyed! {
    /// The table as written; all keys except `kind` are optional.
    #[derive(Serialize, Deserialize, Default)]
    pub(super) struct RoughnessTable {
        kind: RoughnessKind;
        /// Rq \[m\] that random heights and those of files are scaled to.
        rq: f64,
        /// Correlation length along x \[m\].
        length_x: f64,
        /// Correlation length along y \[m\].
        length_y: f64,
        /// Hurst exponent of a self-affine surface, 0 to 1.
        hurst: f64,
        /// Wavelength above which its spectrum is flat \[m\].
        roll_off: f64,
        /// Longest wavelength \[m\]; default: that of the grid.
        longest: f64,
        /// Shortest wavelength \[m\]; default: that of the grid.
        shortest: f64,
        /// Whether amplitudes of waves are random, in addition to their phases.
        synthesis: Synthesis,
        /// Skewness of the heights; requires `kurtosis`.
        skewness: f64,
        /// Kurtosis of the heights; 3 for a normal distribution.
        kurtosis: f64,
        /// Heights that Rq refers to.
        height: HeightScale,
        /// Periodic continuation of heights.
        boundary: Boundary,
        /// Radius of a dimple \[m\].
        radius: f64,
        /// Width of a groove \[m\].
        width: f64,
        /// Depth of dimples or grooves \[m\].
        depth: f64,
        /// Pitch of dimples or grooves \[m\].
        pitch: f64,
        /// Arrangement of dimples.
        layout: Layout,
        /// Direction of grooves.
        direction: GrooveDirection,
        /// Seed of random heights or positions.
        #[serde(
            default,
            deserialize_with = "seed::optional",
            serialize_with = "seed::serialize_optional"
        )]
        seed: u64,
        /// File of heights.
        path: PathBuf,
    }
}

/// Values of `kind`.
#[derive(Serialize, Deserialize, Clone, Copy, Default)]
#[serde(rename_all = "snake_case")]
enum RoughnessKind {
    #[default]
    None,
    Gaussian,
    Exponential,
    SelfAffine,
    Dimples,
    Grooves,
    File,
}

/// Values of `layout`.
#[derive(Serialize, Deserialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Layout {
    Square,
    Random,
}

/// Keys of surfaces by their autocorrelation.
const CORRELATED: [&str; 8] =
    ["rq", "length_x", "length_y", "skewness", "kurtosis", "height", "boundary", "seed"];
/// Keys of self-affine surfaces.
const SELF_AFFINE: [&str; 11] = [
    "rq",
    "hurst",
    "roll_off",
    "longest",
    "shortest",
    "synthesis",
    "skewness",
    "kurtosis",
    "height",
    "boundary",
    "seed",
];

impl RoughnessTable {
    /// A random surface of `shape` with the height distribution of the table.
    fn random(&self, shape: RandomShape) -> Result<RandomSurface, String> {
        let distribution = match (self.skewness, self.kurtosis) {
            (None, None) => HeightDistribution::Normal,
            (skewness, kurtosis) => HeightDistribution::Johnson {
                skewness: required("skewness", skewness)?,
                kurtosis: required("kurtosis", kurtosis)?,
            },
        };
        Ok(RandomSurface {
            distribution,
            height: self.height.unwrap_or_default(),
            boundary: self.boundary.unwrap_or_default(),
            ..RandomSurface::new(shape, required("rq", self.rq)?, self.seed.unwrap_or_default())
        })
    }

    /// A surface by its autocorrelation; errors name a missing or unknown key.
    fn correlated(&self, kind: &str, autocorrelation: Autocorrelation) -> Result<Roughness, String> {
        self.reject_unknown_fields(kind, &CORRELATED)?;
        let shape = RandomShape::Correlated {
            autocorrelation,
            length_x: required("length_x", self.length_x)?,
            length_y: required("length_y", self.length_y)?,
        };
        Ok(Roughness::Random(self.random(shape)?))
    }

    /// A self-affine surface; errors name a missing or unknown key.
    fn self_affine(&self) -> Result<Roughness, String> {
        self.reject_unknown_fields("self_affine", &SELF_AFFINE)?;
        let spectrum = SelfAffine {
            hurst: required("hurst", self.hurst)?,
            longest: self.longest.unwrap_or(f64::INFINITY),
            roll_off: required("roll_off", self.roll_off)?,
            shortest: self.shortest.unwrap_or_default(),
            synthesis: self.synthesis.unwrap_or_default(),
        };
        Ok(Roughness::Random(self.random(RandomShape::SelfAffine(spectrum))?))
    }

    /// Dimples; those on a square lattice have no seed.
    fn dimples(&self) -> Result<Roughness, String> {
        let layout = match self.layout.unwrap_or(Layout::Square) {
            Layout::Square => {
                self.reject_unknown_fields("dimples", &["radius", "depth", "pitch", "layout"])?;
                DimpleLayout::Square
            }
            Layout::Random => {
                self.reject_unknown_fields("dimples", &["radius", "depth", "pitch", "layout", "seed"])?;
                DimpleLayout::Random { seed: self.seed.unwrap_or_default() }
            }
        };
        Ok(Roughness::Texture(Texture::Dimples {
            radius: required("radius", self.radius)?,
            depth: required("depth", self.depth)?,
            pitch: required("pitch", self.pitch)?,
            layout,
        }))
    }

    /// Grooves; errors name a missing or unknown key.
    fn grooves(&self) -> Result<Roughness, String> {
        self.reject_unknown_fields("grooves", &["width", "depth", "pitch", "direction"])?;
        Ok(Roughness::Texture(Texture::Grooves {
            width: required("width", self.width)?,
            depth: required("depth", self.depth)?,
            pitch: required("pitch", self.pitch)?,
            direction: required("direction", self.direction)?,
        }))
    }
}

impl TryFrom<RoughnessTable> for Roughness {
    type Error = String;

    fn try_from(table: RoughnessTable) -> Result<Self, String> {
        match table.kind {
            RoughnessKind::None => table.reject_unknown_fields("none", &[]).map(|()| Self::None),
            RoughnessKind::Gaussian => table.correlated("gaussian", Autocorrelation::Gaussian),
            RoughnessKind::Exponential => table.correlated("exponential", Autocorrelation::Exponential),
            RoughnessKind::SelfAffine => table.self_affine(),
            RoughnessKind::Dimples => table.dimples(),
            RoughnessKind::Grooves => table.grooves(),
            RoughnessKind::File => {
                table.reject_unknown_fields("file", &["path", "rq"])?;
                Ok(Self::File(FileRoughness { path: required("path", table.path)?, rq: table.rq }))
            }
        }
    }
}

/// The value unless it is the default.
fn unusual<T: Default + PartialEq>(value: T) -> Option<T> {
    (value != T::default()).then_some(value)
}

impl From<Roughness> for RoughnessTable {
    fn from(roughness: Roughness) -> Self {
        match roughness {
            Roughness::None => Self::default(),
            Roughness::Random(surface) => Self::of_surface(surface),
            Roughness::Texture(texture) => Self::of_texture(texture),
            Roughness::File(FileRoughness { path, rq }) => {
                Self { kind: RoughnessKind::File, path: Some(path), rq, ..Self::default() }
            }
        }
    }
}

impl RoughnessTable {
    /// The table of a random surface, without default values.
    fn of_surface(surface: RandomSurface) -> Self {
        let shape = match surface.shape {
            RandomShape::Correlated { autocorrelation, length_x, length_y } => Self {
                kind: match autocorrelation {
                    Autocorrelation::Gaussian => RoughnessKind::Gaussian,
                    Autocorrelation::Exponential => RoughnessKind::Exponential,
                },
                length_x: Some(length_x),
                length_y: Some(length_y),
                ..Self::default()
            },
            RandomShape::SelfAffine(spectrum) => Self {
                kind: RoughnessKind::SelfAffine,
                hurst: Some(spectrum.hurst),
                roll_off: Some(spectrum.roll_off),
                longest: Some(spectrum.longest).filter(|longest| longest.is_finite()),
                shortest: unusual(spectrum.shortest),
                synthesis: unusual(spectrum.synthesis),
                ..Self::default()
            },
        };
        let moments = match surface.distribution {
            HeightDistribution::Normal => None,
            HeightDistribution::Johnson { skewness, kurtosis } => Some((skewness, kurtosis)),
        };
        Self {
            rq: Some(surface.rq),
            seed: Some(surface.seed),
            skewness: moments.map(|moments| moments.0),
            kurtosis: moments.map(|moments| moments.1),
            height: unusual(surface.height),
            boundary: unusual(surface.boundary),
            ..shape
        }
    }

    /// The table of dimples or grooves.
    fn of_texture(texture: Texture) -> Self {
        match texture {
            Texture::Dimples { radius, depth, pitch, layout } => {
                let (layout, seed) = match layout {
                    DimpleLayout::Square => (Layout::Square, None),
                    DimpleLayout::Random { seed } => (Layout::Random, Some(seed)),
                };
                Self {
                    kind: RoughnessKind::Dimples,
                    radius: Some(radius),
                    depth: Some(depth),
                    pitch: Some(pitch),
                    layout: Some(layout),
                    seed,
                    ..Self::default()
                }
            }
            Texture::Grooves { width, depth, pitch, direction } => Self {
                kind: RoughnessKind::Grooves,
                width: Some(width),
                depth: Some(depth),
                pitch: Some(pitch),
                direction: Some(direction),
                ..Self::default()
            },
        }
    }
}
