//! One writer for each output: a second render to the same file is refused while the first runs.
//!
//! The system holds the lock, on a hidden file beside the output, and lets go of it when the program ends,
//! however it ends: a crash leaves no lock behind, at most an empty file that the next render removes.

use std::ffi::OsString;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

use super::Failure;
use super::file_id::FileId;

/// A lock that is held until this is dropped.
#[derive(Debug)]
pub(crate) struct Lock {
    path: PathBuf,
    /// Closing it unlocks. `None`: the file system knows no locks.
    file: Option<File>,
}

impl Lock {
    /// Locks an output.
    ///
    /// # Errors
    ///
    /// Where another program holds it (exit code 2), or the folder cannot be written.
    pub(crate) fn hold(output: &Path) -> Result<Self, Failure> {
        let path = beside(output);
        let cannot =
            |e: io::Error| Failure::other(format_args!("cannot write '{}': {e}", output.display()));
        // Another program may remove the file between opening and locking it: then once more.
        loop {
            let mut options = OpenOptions::new();
            let file = options.write(true).create(true).truncate(false).open(&path);
            let file = file.map_err(cannot)?;
            match file.try_lock() {
                Ok(()) if is_still(&file, &path) => {
                    let file = Some(file);
                    return Ok(Self { path, file });
                }
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    return Err(Failure::bad_input(format_args!(
                        "'{}' is being written by another render: wait for its end, or name another \
                         output",
                        output.display()
                    )));
                }
                // Some network folders know no locks: better a render without than none.
                Err(TryLockError::Error(e)) if e.kind() == ErrorKind::Unsupported => {
                    let _ = std::fs::remove_file(&path);
                    return Ok(Self { path, file: None });
                }
                Err(TryLockError::Error(e)) => return Err(cannot(e)),
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // While it is locked, so that nobody else holds this file.
        if self.file.is_some() {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// Whether the open file is the one that the path names.
#[cfg(unix)]
fn is_still(file: &File, path: &Path) -> bool {
    match (FileId::of_open(file), FileId::of(path)) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// Where open files cannot be removed, the path names the open one.
#[cfg(not(unix))]
fn is_still(_: &File, path: &Path) -> bool {
    FileId::of(path).is_ok()
}

/// `.NAME.lock`.
fn beside(output: &Path) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(output.file_name().unwrap_or_default());
    name.push(".lock");
    output.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_holder_is_refused_until_the_first_lets_go() {
        let folder = tempfile::tempdir().unwrap();
        let output = folder.path().join("a.exr");
        let first = Lock::hold(&output).unwrap_or_else(|f| panic!("{:?}", f.told()));
        let (code, said) = Lock::hold(&output).err().unwrap().told();
        assert_eq!(code, 2);
        assert!(said.contains("another render"), "{said}");
        assert!(Lock::hold(&folder.path().join("b.exr")).is_ok());
        drop(first);
        assert!(Lock::hold(&output).is_ok());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_file_that_a_crash_left_is_no_lock() {
        let folder = tempfile::tempdir().unwrap();
        let output = folder.path().join("a.exr");
        std::fs::write(beside(&output), "").unwrap();
        assert!(Lock::hold(&output).is_ok());
    }
}
