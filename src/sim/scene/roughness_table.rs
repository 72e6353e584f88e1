//! What `[roughness.ball]` and `[roughness.disc]` of a scene file hold.

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
    #[derive(Serialize, Deserialize, Default)]
    pub(super) struct RoughnessTable {
        kind: RoughnessKind;
        rq: f64,
        length_x: f64,
        length_y: f64,
        hurst: f64,
        roll_off: f64,
        longest: f64,
        shortest: f64,
        synthesis: Synthesis,
        skewness: f64,
        kurtosis: f64,
        height: HeightScale,
        boundary: Boundary,
        radius: f64,
        width: f64,
        depth: f64,
        pitch: f64,
        layout: Layout,
        direction: GrooveDirection,
        #[serde(
            default,
            deserialize_with = "seed::optional",
            serialize_with = "seed::serialize_optional"
        )]
        seed: u64,
        path: PathBuf,
    }
}

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

#[derive(Serialize, Deserialize, Clone, Copy, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Layout {
    Square,
    Random,
}

const CORRELATED: [&str; 8] =
    ["rq", "length_x", "length_y", "skewness", "kurtosis", "height", "boundary", "seed"];
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
    /// A random surface of `shape`, its heights as the table says.
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

    fn correlated(&self, kind: &str, autocorrelation: Autocorrelation) -> Result<Roughness, String> {
        self.refuse_strays(kind, &CORRELATED)?;
        let shape = RandomShape::Correlated {
            autocorrelation,
            length_x: required("length_x", self.length_x)?,
            length_y: required("length_y", self.length_y)?,
        };
        Ok(Roughness::Random(self.random(shape)?))
    }

    fn self_affine(&self) -> Result<Roughness, String> {
        self.refuse_strays("self_affine", &SELF_AFFINE)?;
        let spectrum = SelfAffine {
            hurst: required("hurst", self.hurst)?,
            longest: self.longest.unwrap_or(f64::INFINITY),
            roll_off: required("roll_off", self.roll_off)?,
            shortest: self.shortest.unwrap_or_default(),
            synthesis: self.synthesis.unwrap_or_default(),
        };
        Ok(Roughness::Random(self.random(RandomShape::SelfAffine(spectrum))?))
    }

    fn dimples(&self) -> Result<Roughness, String> {
        let layout = match self.layout.unwrap_or(Layout::Square) {
            Layout::Square => {
                self.refuse_strays("dimples", &["radius", "depth", "pitch", "layout"])?;
                DimpleLayout::Square
            }
            Layout::Random => {
                self.refuse_strays("dimples", &["radius", "depth", "pitch", "layout", "seed"])?;
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

    fn grooves(&self) -> Result<Roughness, String> {
        self.refuse_strays("grooves", &["width", "depth", "pitch", "direction"])?;
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
            RoughnessKind::None => table.refuse_strays("none", &[]).map(|()| Self::None),
            RoughnessKind::Gaussian => table.correlated("gaussian", Autocorrelation::Gaussian),
            RoughnessKind::Exponential => table.correlated("exponential", Autocorrelation::Exponential),
            RoughnessKind::SelfAffine => table.self_affine(),
            RoughnessKind::Dimples => table.dimples(),
            RoughnessKind::Grooves => table.grooves(),
            RoughnessKind::File => {
                table.refuse_strays("file", &["path", "rq"])?;
                Ok(Self::File(FileRoughness { path: required("path", table.path)?, rq: table.rq }))
            }
        }
    }
}

/// What differs from the default.
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
