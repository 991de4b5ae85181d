//! Whether a picture could be written, before it is rendered.

use std::io;
use std::path::Path;

use specula_scene::atomic::temporary_beside;

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

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;
    use specula_scene::atomic::replace;

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
