//! Atomic replacement of files.
//!
//! The new content is written to a temporary file, synced to disk and renamed. Checkpoints and the small
//! files of a run folder are written this way.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Path of the temporary file beside `path`.
pub(in crate::sim) fn temporary_path(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".partial");
    PathBuf::from(name)
}

/// Renames the temporary file to `path` after it is synced to disk. If the process or the machine stops, either
/// the old or the new file remains.
pub(in crate::sim) fn put_in_place(path: &Path) -> io::Result<()> {
    let temporary = temporary_path(path);
    File::open(&temporary)?.sync_all()?;
    fs::rename(&temporary, path)?;
    // Sync the folder too, so that the new name is durable. Only Unix can open folders.
    #[cfg(unix)]
    {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        File::open(folder.unwrap_or(Path::new(".")))?.sync_all()?;
    }
    Ok(())
}

/// Replaces the file with `bytes`. An error keeps the old file and removes the temporary file.
pub(in crate::sim) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let created = File::create(temporary_path(path)).and_then(|mut file| file.write_all(bytes));
    let written = created.and_then(|()| put_in_place(path));
    written.inspect_err(|_| drop(fs::remove_file(temporary_path(path))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn incomplete_temporary_file_keeps_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        replace(&path, b"old").unwrap();
        fs::write(temporary_path(&path), b"half of the n").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        replace(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn failed_replacement_removes_the_temporary_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::create_dir(&path).unwrap(); // a folder is not replaced by a file
        assert!(replace(&path, b"new").is_err());
        assert!(path.is_dir() && !temporary_path(&path).exists());
    }
}
