//! Files that are there as a whole or not at all.
//!
//! What is replaced is first written under another name, brought to the disk and then renamed. Checkpoints
//! and the small files of a run folder are written so.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The name under which a file is written before it takes its own.
pub(in crate::sim) fn draft(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".partial");
    PathBuf::from(name)
}

/// Puts the [`draft`] in the place of `path` once the disk has it: whoever stops the process, or the machine,
/// finds the old file or the new one.
pub(in crate::sim) fn put_in_place(path: &Path) -> io::Result<()> {
    let draft = draft(path);
    File::open(&draft)?.sync_all()?;
    fs::rename(&draft, path)?;
    // The new name is safe when the folder is. Elsewhere folders cannot be opened.
    #[cfg(unix)]
    {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        File::open(folder.unwrap_or(Path::new(".")))?.sync_all()?;
    }
    Ok(())
}

/// Replaces the file with `bytes`. On an error the old file stays and no draft is left.
pub(in crate::sim) fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let drafted = File::create(draft(path)).and_then(|mut file| file.write_all(bytes));
    let written = drafted.and_then(|()| put_in_place(path));
    written.inspect_err(|_| drop(fs::remove_file(draft(path))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_draft_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        replace(&path, b"old").unwrap();
        fs::write(draft(&path), b"half of the n").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"old");
        replace(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_failed_replacement_leaves_no_draft() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("file");
        fs::create_dir(&path).unwrap(); // a folder is not replaced by a file
        assert!(replace(&path, b"new").is_err());
        assert!(path.is_dir() && !draft(&path).exists());
    }
}
