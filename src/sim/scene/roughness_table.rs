//! What `[roughness.ball]` and `[roughness.disc]` of a scene file hold.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};

use super::tables::{given, refuse_strays, required, seed};
use super::{FileRoughness, RandomRoughness, Roughness};
use crate::boundary::Boundary;
use crate::surface::{
    Autocorrelation, DimpleLayout, GrooveDirection, HeightDistribution, HeightScale, RandomShape,
    RandomSurface, SelfAffine, Synthesis, Texture,
};

#[derive(Serialize, Deserialize, Default)]
#[serde(deny_unknown_fields)]
pub(super) struct RoughnessTable {
    kind: RoughnessKind,
    #[serde(skip_serializing_if = "Option::is_none")]
    rq: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length_x: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length_y: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    hurst: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    roll_off: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    longest: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    shortest: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    synthesis: Option<Synthesis>,
    #[serde(skip_serializing_if = "Option::is_none")]
    skewness: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    kurtosis: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    height: Option<HeightScale>,
    #[serde(skip_serializing_if = "Option::is_none")]
    boundary: Option<Boundary>,
    #[serde(skip_serializing_if = "Option::is_none")]
    radius: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    width: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    depth: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pitch: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    layout: Option<Layout>,
    #[serde(skip_serializing_if = "Option::is_none")]
    direction: Option<GrooveDirection>,
    #[serde(
        default,
        deserialize_with = "seed::optional",
        serialize_with = "seed::serialize_optional",
        skip_serializing_if = "Option::is_none"
    )]
    seed: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<PathBuf>,
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
    fn refuse_strays(&self, kind: &str, known: &[&str]) -> Result<(), String> {
        let keys = [
            given("rq", &self.rq),
            given("length_x", &self.length_x),
            given("length_y", &self.length_y),
            given("hurst", &self.hurst),
            given("roll_off", &self.roll_off),
            given("longest", &self.longest),
            given("shortest", &self.shortest),
            given("synthesis", &self.synthesis),
            given("skewness", &self.skewness),
            given("kurtosis", &self.kurtosis),
            given("height", &self.height),
            given("boundary", &self.boundary),
            given("radius", &self.radius),
            given("width", &self.width),
            given("depth", &self.depth),
            given("pitch", &self.pitch),
            given("layout", &self.layout),
            given("direction", &self.direction),
            given("seed", &self.seed),
            given("path", &self.path),
        ];
        refuse_strays(&format!("kind = \"{kind}\""), &keys, known)
    }

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
        let plain = RandomRoughness {
            rq: required("rq", self.rq)?,
            length_x: required("length_x", self.length_x)?,
            length_y: required("length_y", self.length_y)?,
            seed: self.seed.unwrap_or_default(),
        };
        let RandomRoughness { length_x, length_y, .. } = plain;
        let surface = self.random(RandomShape::Correlated { autocorrelation, length_x, length_y })?;
        // Whether it is normal, of the height given and periodic: `rq` may be NaN here, which equals nothing.
        let usual = RandomSurface::new(surface.shape, 0.0, 0);
        let is_plain = (surface.height, surface.distribution, surface.boundary)
            == (usual.height, usual.distribution, usual.boundary);
        Ok(match autocorrelation {
            _ if !is_plain => Roughness::Random(surface),
            Autocorrelation::Gaussian => Roughness::Gaussian(plain),
            Autocorrelation::Exponential => Roughness::Exponential(plain),
        })
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
        let plain = |kind, random: RandomRoughness| Self {
            kind,
            rq: Some(random.rq),
            length_x: Some(random.length_x),
            length_y: Some(random.length_y),
            seed: Some(random.seed),
            ..Self::default()
        };
        match roughness {
            Roughness::None => Self::default(),
            Roughness::Gaussian(random) => plain(RoughnessKind::Gaussian, random),
            Roughness::Exponential(random) => plain(RoughnessKind::Exponential, random),
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
