//! Files that are replaced whole or not at all.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use super::PictureError;

/// Checks that a file of this name could be written now: its folder exists and takes new files, and
/// it is not itself a folder. Leaves nothing behind.
///
/// # Errors
///
/// What the system says.
pub fn check_writable(path: &Path) -> Result<(), PictureError> {
    let in_folder = || {
        if path.is_dir() {
            return Err(io::Error::from(io::ErrorKind::IsADirectory));
        }
        temporary_beside(path).map(drop)
    };
    in_folder().map_err(|source| PictureError::Io {
        path: path.to_owned(),
        source,
    })
}

/// Puts what `write` produces at `path`; the old file stays untouched unless all of it is on disk.
///
/// The temporary file lies in the same folder, so that the final rename cannot cross file systems,
/// and is removed when anything fails.
///
/// # Errors
///
/// What `write` returns, or the system's error.
pub(super) fn replace<E: From<io::Error>>(
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

fn temporary_beside(path: &Path) -> io::Result<tempfile::NamedTempFile> {
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".specula-").suffix(".part");
    #[cfg(unix)]
    {
        // The umask applies to this; the crate's own default is 0o600, which would hide pictures
        // from everybody else.
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failed_write_leaves_the_old_file_and_no_temporary() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.exr");
        std::fs::write(&path, b"good").unwrap();

        let result: io::Result<()> = replace(&path, |w| {
            w.write_all(b"half of a pict")?;
            Err(io::Error::other("disk full"))
        });

        assert_eq!(result.unwrap_err().to_string(), "disk full");
        assert_eq!(std::fs::read(&path).unwrap(), b"good");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn checking_leaves_nothing_behind_and_refuses_folders() {
        let folder = tempfile::tempdir().unwrap();
        check_writable(&folder.path().join("a.exr")).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        assert!(check_writable(folder.path()).is_err());
    }

    #[test]
    fn a_complete_write_replaces_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("picture.exr");
        std::fs::write(&path, b"old and longer").unwrap();
        replace::<io::Error>(&path, |w| w.write_all(b"new")).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_missing_folder_is_an_error() {
        assert!(check_writable("absent-folder/a.exr".as_ref()).is_err());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("absent").join("picture.exr");
        assert!(replace::<io::Error>(&path, |w| w.write_all(b"new")).is_err());
    }
}
