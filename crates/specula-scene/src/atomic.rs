//! Files that are replaced whole or not at all.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes a file so that a failure leaves the old one untouched: it is replaced when all of the new one is on disk.
///
/// The temporary file lies in the same folder, so that the final rename cannot cross file systems,
/// and is removed when anything fails.
///
/// # Errors
///
/// What `write` returns, or the system's error.
pub fn replace<E: From<io::Error>>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), E>,
) -> Result<(), E> {
    let temporary = temporary_beside(path)?;
    let mut writer = BufWriter::with_capacity(1 << 16, temporary.as_file());
    write(&mut writer)?;
    writer.flush()?;
    drop(writer);
    temporary.as_file().sync_all()?;
    temporary.persist(path).map_err(|e| e.error)?;
    Ok(())
}

/// A temporary file in the folder of `path`, removed when it is dropped.
///
/// # Errors
///
/// What the system says.
pub fn temporary_beside(path: &Path) -> io::Result<tempfile::NamedTempFile> {
    let folder = folder_of(path);
    let mut builder = tempfile::Builder::new();
    let prefix = temporary_prefix(path);
    builder.prefix(&prefix).suffix(TEMPORARY_SUFFIX);
    #[cfg(unix)]
    {
        // The umask applies to this; the crate's own default is 0o600, which would hide pictures
        // from everybody else.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

/// Removes temporary files that a killed program left beside `path`. Nobody else may be
/// writing that file.
///
/// # Errors
///
/// What the system says; a folder that is not there holds nothing.
pub fn sweep(path: &Path) -> io::Result<()> {
    let prefix = temporary_prefix(path);
    let entries = match std::fs::read_dir(folder_of(path)) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries?,
    };
    for entry in entries {
        let entry = entry?;
        let name = entry.file_name();
        let bytes = name.as_encoded_bytes();
        if bytes.starts_with(prefix.as_encoded_bytes())
            && bytes.ends_with(TEMPORARY_SUFFIX.as_bytes())
        {
            std::fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

const TEMPORARY_SUFFIX: &str = ".part";

/// `.NAME.`: hidden, and distinct from temporary files of other names.
fn temporary_prefix(path: &Path) -> OsString {
    let mut prefix = OsString::from(".");
    prefix.push(path.file_name().unwrap_or_default());
    prefix.push(".");
    prefix
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn leftovers_of_one_file_are_swept_and_no_others() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        for name in [
            ".a.exr.x1y2.part",
            ".b.exr.x1y2.part",
            "a.exr",
            ".a.exr.keep",
        ] {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        sweep(&path).unwrap();
        let mut left: Vec<_> = std::fs::read_dir(folder.path())
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        left.sort();
        assert_eq!(left, [".a.exr.keep", ".b.exr.x1y2.part", "a.exr"]);
        sweep(&folder.path().join("none").join("b")).unwrap();
    }
}
