//! Roughness of the two bodies.

#[cfg(feature = "serde")]
use std::path::Path;
use std::path::PathBuf;

use crate::surface::{Autocorrelation, GrooveDirection, RandomShape, RandomSurface, RoughnessSpec, Texture};

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

#[cfg(feature = "serde")]
impl RoughnessPair {
    /// Makes paths of files relative to `folder`.
    pub(in crate::sim) fn locate_files(&mut self, folder: &Path) {
        for roughness in [&mut self.ball, &mut self.disc] {
            if let Roughness::File(file) = roughness {
                file.path = folder.join(&file.path);
            }
        }
    }
}

/// Roughness of one body.
///
/// # Examples
///
/// ```
/// use stribeck::sim::scene::Roughness;
/// use stribeck::surface::{GrooveDirection, Texture};
/// assert!(Roughness::gaussian(0.0, 1e-5, 1).is_smooth());
/// let grooves = Texture::Grooves { width: 20e-6, depth: 0.5e-6, pitch: 50e-6, direction: GrooveDirection::AlongY };
/// assert!(!Roughness::Texture(grooves).is_smooth());
/// ```
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
    /// Random: Gaussian or exponential autocorrelation, or self-affine. In scene files the kinds are `gaussian`,
    /// `exponential` and `self_affine`.
    Random(RandomSurface),
    /// Dimples or grooves.
    Texture(Texture),
    /// A measured surface.
    File(FileRoughness),
}

/// The shortest wavelengths of a surface along x and y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::sim) enum ShortestWaves {
    /// This long \[m\]; infinite for a flat surface.
    Of([f64; 2]),
    /// Waves of any length.
    Endless,
    /// Unknown until the heights are known.
    Unknown,
}

impl From<RoughnessSpec> for Roughness {
    fn from(spec: RoughnessSpec) -> Self {
        Self::Random(spec.into())
    }
}

impl Roughness {
    /// Random roughness of root mean square height `rq` \[m\] with an isotropic Gaussian autocorrelation that falls
    /// to 10 % at `length` \[m\]; equal seeds give equal surfaces.
    pub fn gaussian(rq: f64, length: f64, seed: u64) -> Self {
        let autocorrelation = Autocorrelation::Gaussian;
        RoughnessSpec { autocorrelation, rq, length_x: length, length_y: length, seed }.into()
    }

    /// Whether the body has no roughness.
    pub fn is_smooth(&self) -> bool {
        match self {
            Self::None => true,
            Self::Random(surface) => surface.rq == 0.0,
            Self::Texture(_) | Self::File(_) => false,
        }
    }

    /// Requested root mean square height \[m\]; `None` if unspecified.
    pub(in crate::sim) fn rq(&self) -> Option<f64> {
        match self {
            Self::Random(surface) => Some(surface.rq),
            Self::File(file) => file.rq,
            Self::None | Self::Texture(_) => None,
        }
    }

    /// Correlation length across the flow of random roughness, or its roll-off wavelength \[m\].
    pub(in crate::sim) fn length_across(&self) -> Option<f64> {
        let Self::Random(surface) = self else { return None };
        Some(match surface.shape {
            RandomShape::Correlated { length_y, .. } => length_y,
            RandomShape::SelfAffine(spectrum) => spectrum.roll_off,
        })
    }

    /// The shortest wavelengths of the body.
    pub(in crate::sim) fn shortest_waves(&self) -> ShortestWaves {
        use ShortestWaves::{Endless, Of, Unknown};
        if self.is_smooth() {
            return Of([f64::INFINITY; 2]);
        }
        match self {
            Self::None => Of([f64::INFINITY; 2]),
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

/// A file of heights.
#[derive(Debug, Clone, PartialEq)]
pub struct FileRoughness {
    /// Path relative to the scene file, in any format of [`crate::surface`]. A file without spacings (`.npy` of
    /// shape (ny, nx)) has one height per node in metres, positive out of the body. A file with spacings is
    /// levelled, mirror-tiled and resampled to the grid.
    pub path: PathBuf,
    /// Root mean square height to rescale to \[m\].
    pub rq: Option<f64>,
}
