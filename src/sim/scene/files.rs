//! Scenes as TOML text and files.

use std::path::Path;

use super::document::Document;
use super::{Scene, missing};
use crate::sim::error::SimError;
use crate::text_file;

impl Scene {
    /// Reads a scene from TOML text. The value of a key with a dimension may be text with a
    /// [unit](crate::units): `"9.525 mm"`.
    ///
    /// # Errors
    /// [`SimError::Scene`] with key and line for a value that does not fit, [`SimError::Input`] for a quantity
    /// of another dimension than its key.
    pub fn from_toml(text: &str) -> Result<Self, SimError> {
        Self::read(&Document::parse(text)?)
    }

    /// Reads a parsed scene file.
    pub(in crate::sim) fn read(document: &Document<'_>) -> Result<Self, SimError> {
        document.read(missing::keys)
    }

    /// The scene as TOML text.
    ///
    /// # Errors
    /// [`SimError::Scene`] when a path is not UTF-8.
    pub fn to_toml(&self) -> Result<String, SimError> {
        toml::to_string(self).map_err(|e| SimError::Scene { reason: e.to_string() })
    }

    /// Reads a scene file. Paths of other files in it are relative to its folder.
    ///
    /// # Errors
    /// [`SimError::Io`] if the file cannot be read or exceeds 16 MB, [`SimError::Scene`] if it is not valid.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, SimError> {
        let path = path.as_ref();
        let text = text_file::read(path).map_err(|source| SimError::Io { path: path.to_owned(), source })?;
        Ok(Self::from_toml(&text)?.in_folder(path.parent().unwrap_or(Path::new(""))))
    }

    /// The scene with paths of other files relative to `folder`.
    pub(in crate::sim) fn in_folder(mut self, folder: &Path) -> Self {
        self.roughness.locate_files(folder);
        self.schedule.locate_tables(folder);
        if let Some(table) = self.cycle.as_mut().and_then(|cycle| cycle.table.as_mut()) {
            *table = folder.join(&table);
        }
        self
    }
}
