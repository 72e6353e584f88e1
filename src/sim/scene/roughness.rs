//! Roughness of the two bodies.

use std::path::PathBuf;

use crate::surface::{Autocorrelation, GrooveDirection, RandomShape, RandomSurface, Texture};

/// Roughness of ball and disc.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
pub struct RoughnessPair {
    /// The ball, body 0.
    pub ball: Roughness,
    /// The disc, body 1.
    pub disc: Roughness,
}

/// Roughness of one body.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(
        try_from = "super::roughness_table::RoughnessTable",
        into = "super::roughness_table::RoughnessTable"
    )
)]
#[non_exhaustive]
pub enum Roughness {
    /// Smooth.
    #[default]
    None,
    /// Random, Gaussian autocorrelation.
    Gaussian(RandomRoughness),
    /// Random, exponential autocorrelation.
    Exponential(RandomRoughness),
    /// Random with all choices there are: self-affine, skewed, of ensemble height, open.
    Random(RandomSurface),
    /// Dimples or grooves.
    Texture(Texture),
    /// A measured surface.
    File(FileRoughness),
}

/// The shortest waves of a surface along x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) enum ShortestWaves {
    /// As long as this \[m\]; infinite where there are none.
    Of([f64; 2]),
    /// Down to any length.
    Endless,
    /// Not known before the heights are.
    Unknown,
}

impl Roughness {
    /// Whether the body has no roughness.
    pub fn is_smooth(&self) -> bool {
        match self {
            Self::None => true,
            Self::Gaussian(random) | Self::Exponential(random) => random.rq == 0.0,
            Self::Random(surface) => surface.rq == 0.0,
            Self::Texture(_) | Self::File(_) => false,
        }
    }

    /// Root mean square height that is asked for \[m\]; none where none is.
    pub(in crate::sim) fn rq(&self) -> Option<f64> {
        match self {
            Self::Gaussian(random) | Self::Exponential(random) => Some(random.rq),
            Self::Random(surface) => Some(surface.rq),
            Self::File(file) => file.rq,
            Self::None | Self::Texture(_) => None,
        }
    }

    pub(in crate::sim) fn shortest_waves(&self) -> ShortestWaves {
        use ShortestWaves::{Endless, Of, Unknown};
        if self.is_smooth() {
            return Of([f64::INFINITY; 2]);
        }
        match self {
            Self::None => Of([f64::INFINITY; 2]),
            Self::Gaussian(random) => Of([random.length_x, random.length_y]),
            Self::Exponential(_) => Endless,
            Self::Random(surface) => match surface.shape {
                RandomShape::Correlated { autocorrelation: Autocorrelation::Exponential, .. } => Endless,
                RandomShape::Correlated { length_x, length_y, .. } => Of([length_x, length_y]),
                RandomShape::SelfAffine(spectrum) if spectrum.shortest > 0.0 => Of([spectrum.shortest; 2]),
                RandomShape::SelfAffine(_) => Endless,
            },
            Self::Texture(Texture::Dimples { radius, .. }) => Of([2.0 * radius; 2]),
            Self::Texture(Texture::Grooves { width, direction, .. }) => Of(match direction {
                GrooveDirection::AlongX => [f64::INFINITY, *width],
                GrooveDirection::AlongY => [*width, f64::INFINITY],
                GrooveDirection::Crossed => [*width; 2],
            }),
            Self::File(_) => Unknown,
        }
    }
}

/// Parameters of random roughness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RandomRoughness {
    /// Root mean square height \[m\].
    pub rq: f64,
    /// Length along x where the autocorrelation is 10 % \[m\].
    pub length_x: f64,
    /// Length along y where the autocorrelation is 10 % \[m\].
    pub length_y: f64,
    /// Seed.
    pub seed: u64,
}

/// A file of heights.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRoughness {
    /// Path, relative to the scene file, in any format of [`crate::surface`]. A file without spacings (`.npy`
    /// of shape (ny, nx)) is taken node by node, heights in metres, positive out of the body; one with
    /// spacings is levelled, mirror-tiled and resampled to the grid.
    pub path: PathBuf,
    /// Root mean square height to rescale to \[m\].
    pub rq: Option<f64>,
}
