//! Scene files of all kinds.

use std::path::Path;

use super::scene::Document;
use super::{FlatContact, RigidBearing, Scene, SimError};
use crate::text_file;

/// The contents of a scene file.
///
/// ```
/// use stribeck::sim::SceneFile;
/// let text = "[given_film]\nkind = \"pad\"\nlength = \"10 mm\"\ninlet_film = \"20 um\"\noutlet_film = \"10 um\"\n\
///             speed = 1.0\n[lubricant]\ngrade = \"ISO VG 32\"\nviscosity_index = 98\n";
/// assert!(matches!(SceneFile::from_toml(text)?, SceneFile::Bearing(_)));
/// # Ok::<(), stribeck::sim::SimError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SceneFile {
    /// A contact of curved bodies.
    Contact(Box<Scene>),
    /// A rigid bearing, by the table `[given_film]`.
    Bearing(Box<RigidBearing>),
    /// A contact of flat surfaces, by `form.kind = "flat"`.
    Flat(Box<FlatContact>),
}

impl SceneFile {
    /// Reads the text of a scene file.
    ///
    /// # Errors
    /// Those of [`Scene::from_toml`], [`RigidBearing::from_toml`] and [`FlatContact::from_toml`].
    pub fn from_toml(text: &str) -> Result<Self, SimError> {
        let document = Document::parse(text)?;
        if document.value("given_film").is_some() {
            return RigidBearing::read(&document).map(|bearing| Self::Bearing(Box::new(bearing)));
        }
        if document.value("form.kind").and_then(|kind| kind.as_str()) == Some("flat") {
            return FlatContact::read(&document).map(|contact| Self::Flat(Box::new(contact)));
        }
        Scene::read(&document).map(|scene| Self::Contact(Box::new(scene)))
    }

    /// Reads a scene file. Paths of other files in it are relative to its folder.
    ///
    /// # Errors
    /// Those of [`from_toml`](Self::from_toml), and [`SimError::Io`] if the file cannot be read or exceeds 16 MB.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SimError> {
        let path = path.as_ref();
        let text = text_file::read(path).map_err(|source| SimError::Io { path: path.to_owned(), source })?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Ok(match Self::from_toml(&text)? {
            Self::Contact(scene) => Self::Contact(Box::new(scene.in_folder(folder))),
            Self::Bearing(bearing) => Self::Bearing(Box::new(bearing.in_folder(folder))),
            Self::Flat(contact) => Self::Flat(Box::new(contact.in_folder(folder))),
        })
    }
}
