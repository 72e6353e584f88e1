//! Files that the command writes: each is whole or absent, and none replaces another without `--force`.

use std::error::Error;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

type Written = Result<(), Box<dyn Error>>;

/// Checks before a long computation that all `files` can be written. An existing file is refused unless
/// `force`; `elsewhere` ends the message with the way to write another file. A device is written as it is.
pub(crate) fn claim(files: &[PathBuf], force: bool, elsewhere: &str) -> Result<(), String> {
    for (index, file) in files.iter().enumerate() {
        let (name, same) = (file.display(), absolute(file));
        if files[..index].iter().any(|other| absolute(other) == same) {
            return Err(format!("{name}: two outputs of this command have this name; give another one"));
        }
        match fs::metadata(file) {
            Ok(found) if found.is_dir() => return Err(format!("{name}: this is a folder, give a file")),
            Ok(found) if !found.is_file() => continue,
            Ok(_) if !force => {
                return Err(format!("{name}: the file exists; --force writes over it, {elsewhere}"));
            }
            _ => {}
        }
        require_folder(file)?;
        let draft = draft(file);
        let probed = File::create(&draft).and_then(|_| fs::remove_file(&draft));
        probed.map_err(|error| named(file, &error))?;
    }
    Ok(())
}

/// Checks that the folder of `file` is there.
pub(crate) fn require_folder(file: &Path) -> Result<(), String> {
    match file.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.exists()) {
        Some(folder) => Err(format!(
            "{}: there is no folder {}; make it first, or give another name",
            file.display(),
            folder.display()
        )),
        None => Ok(()),
    }
}

/// The error with the name of its file.
pub(crate) fn named(file: &Path, error: &io::Error) -> String {
    format!("{}: {}", file.display(), io_words(error))
}

/// An error of the file system in plain words, with a remedy where there is one.
pub(crate) fn io_words(error: &io::Error) -> String {
    let words = match error.kind() {
        io::ErrorKind::StorageFull => "the disk is full; free some space or write to another disk",
        io::ErrorKind::QuotaExceeded => "the disk quota is used up; free some space or write to another disk",
        io::ErrorKind::PermissionDenied => "permission denied; choose a folder that you may write to",
        io::ErrorKind::ReadOnlyFilesystem => "the disk is read-only; write to another one",
        io::ErrorKind::NotFound => "there is no such file or folder",
        io::ErrorKind::NotADirectory | io::ErrorKind::AlreadyExists => {
            "a part of this path is a file, not a folder; give a folder"
        }
        io::ErrorKind::IsADirectory => "this is a folder, give a file",
        _ => return error.to_string(),
    };
    words.to_owned()
}

/// Removes the rest of `file` after an error, unless it is a device. The error is reported, not this.
pub(crate) fn remove(file: &Path) {
    if fs::symlink_metadata(file).is_ok_and(|found| found.is_file()) {
        drop(fs::remove_file(file));
    }
}

/// Removes the `folder` if nothing is in it.
pub(crate) fn remove_empty(folder: &Path) {
    // A folder that another program has written into stays.
    drop(fs::remove_dir(folder));
}

/// Makes the `folder` for files.
pub(crate) fn make_folder(folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| named(folder, &error))
}

/// Writes `bytes` to `file`.
pub(crate) fn write(file: &Path, bytes: &[u8]) -> Written {
    write_with(file, |path| fs::write(path, bytes).map_err(|error| named(file, &error).into()))
}

/// Lets `write` write `file` under a temporary name and renames it once it is whole. After an error neither
/// of both names is left; a former file of this name is kept.
pub(crate) fn write_with(file: &Path, write: impl FnOnce(&Path) -> Written) -> Written {
    if fs::metadata(file).is_ok_and(|found| !found.is_file()) {
        return write(file);
    }
    let draft = draft(file);
    let renamed = |()| fs::rename(&draft, file).map_err(|error| named(file, &error).into());
    write(&draft).and_then(renamed).inspect_err(|_| remove(&draft))
}

/// The temporary name of `file`.
fn draft(file: &Path) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(".partial");
    name.into()
}

/// The place of `file`, whether or not it exists.
fn absolute(file: &Path) -> PathBuf {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    file.file_name().map_or_else(|| folder.clone(), |name| folder.join(name))
}
