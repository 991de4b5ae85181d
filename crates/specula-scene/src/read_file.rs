//! Whole files, decompressed where their name ends in `.gz`, and the list of those that were read.
//!
//! Files that a scene names must be ordinary files: opening a pipe would wait for another program, and
//! opening a device may do anything. The scene itself, which the caller names, may be a pipe.

use std::collections::HashMap;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{BufReader, Error, Read};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use crate::format::{Format, GZIP};
use crate::{Limits, LoadOptions};

/// Opens the files of a scene, and lists them. Clones share the list, also between threads.
#[derive(Clone, Debug, Default)]
pub(crate) struct Files {
    limits: Limits,
    /// Nothing outside of this folder is read.
    confined_to: Option<PathBuf>,
    list: Arc<Mutex<List>>,
    /// The scene's own content, until a reader takes it.
    given: Arc<Mutex<Option<Given>>>,
}

/// A file that was read already, or why it cannot be unpacked.
type Given = (PathBuf, Result<Vec<u8>, String>);

/// Files in the order in which a reader met them.
#[derive(Debug, Default)]
struct List {
    /// Whether a file was read, with its path.
    files: Vec<(PathBuf, bool)>,
    index: HashMap<PathBuf, usize>,
}

impl List {
    fn entry(&mut self, path: &Path) -> &mut bool {
        let i = match self.index.get(path) {
            Some(&i) => i,
            None => {
                self.files.push((path.to_owned(), false));
                self.index.insert(path.to_owned(), self.files.len() - 1);
                self.files.len() - 1
            }
        };
        &mut self.files[i].1
    }
}

impl Files {
    pub(crate) fn new(limits: Limits) -> Self {
        Self {
            limits,
            ..Self::default()
        }
    }

    /// As options say.
    pub(crate) fn of(options: &LoadOptions) -> Self {
        Self {
            confined_to: options.confined_to.clone(),
            ..Self::new(options.limits)
        }
    }

    /// Opens an ordinary file, where it lies in the folder that files are confined to.
    fn ordinary(&self, path: &Path) -> Result<File, String> {
        if let Some(folder) = &self.confined_to {
            let folder = folder.canonicalize().map_err(|e| unreadable(&e))?;
            // Where there is no such file: whether there could be one is nothing to tell about other folders.
            let there = path.ancestors().find_map(|p| p.canonicalize().ok());
            if there.is_some_and(|there| !there.starts_with(&folder)) {
                return Err("lies outside of the scene's folder".to_owned());
            }
        }
        open_ordinary(path)
    }

    pub(crate) fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Gives a file its place in the list before threads read it, so that the order does not depend on
    /// them. A file that nobody reads after it is not listed.
    pub(crate) fn announce(&self, path: &Path) {
        self.locked(|list| {
            list.entry(path);
        });
    }

    /// Every file that was opened and read to its end, once.
    pub(crate) fn list(&self) -> Vec<PathBuf> {
        self.locked(|list| {
            let read = list.files.iter().filter(|(_, is_read)| *is_read);
            read.map(|(path, _)| path.clone()).collect()
        })
    }

    /// Reads a file; one whose name ends in `.gz` is unpacked.
    ///
    /// # Errors
    ///
    /// A message without the file's name.
    pub(crate) fn unpacked(&self, path: &Path) -> Result<Vec<u8>, String> {
        if let Some(bytes) = self.taken(path) {
            return bytes;
        }
        let bytes = self.plain(path)?;
        let packed = path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("gz"));
        if packed {
            unpack(&bytes, &self.limits)
        } else {
            Ok(bytes)
        }
    }

    /// Reads an ordinary file as it is.
    ///
    /// # Errors
    ///
    /// A message without the file's name.
    pub(crate) fn plain(&self, path: &Path) -> Result<Vec<u8>, String> {
        if let Some(bytes) = self.taken(path) {
            return bytes;
        }
        self.whole(path, self.ordinary(path)?)
    }

    /// Opens an ordinary file to be read piece by piece.
    ///
    /// # Errors
    ///
    /// A message without the file's name.
    pub(crate) fn open(&self, path: &Path) -> Result<BufReader<File>, String> {
        let file = self.ordinary(path)?;
        let most = self.limits.max_bytes;
        if file.metadata().map_err(|e| unreadable(&e))?.len() > most {
            return Err(format!("has more than {most} bytes (`max_bytes`)"));
        }
        self.locked(|list| *list.entry(path) = true);
        Ok(BufReader::with_capacity(1 << 16, file))
    }

    /// Reads the file that the caller names, which may be a pipe: once, to its end.
    ///
    /// # Errors
    ///
    /// A message without the file's name.
    pub(crate) fn scene(&self, path: &Path) -> Result<Vec<u8>, String> {
        if let Some(bytes) = self.taken(path) {
            return bytes;
        }
        let kind = (std::fs::metadata(path).map_err(|e| unreadable(&e))?).file_type();
        #[cfg(unix)]
        if std::os::unix::fs::FileTypeExt::is_fifo(&kind) {
            let bytes = bytes_of_pipe(path, &self.limits)?;
            self.locked(|list| *list.entry(path) = true);
            return Ok(bytes);
        }
        if kind.is_dir() {
            return Err("is a folder; expected a file".to_owned());
        }
        if !kind.is_file() {
            let message = "is a socket or a device; expected a file, or - for standard input";
            return Err(message.to_owned());
        }
        self.whole(path, self.ordinary(path)?)
    }

    fn whole(&self, path: &Path, file: File) -> Result<Vec<u8>, String> {
        let bytes = bytes_of(file, &self.limits)?;
        self.locked(|list| *list.entry(path) = true);
        Ok(bytes)
    }

    /// Hands the content of the scene's own file to the reader that will ask for `path`; returns its format.
    pub(crate) fn give(&self, path: &Path, bytes: Vec<u8>) -> Format {
        // The reader will report what cannot be unpacked.
        let bytes = match bytes.starts_with(&GZIP) {
            true => unpack(&bytes, &self.limits),
            false => Ok(bytes),
        };
        let format = Format::of(bytes.as_deref().unwrap_or_default(), path);
        *self.given.lock().unwrap_or_else(PoisonError::into_inner) = Some((path.to_owned(), bytes));
        format
    }

    /// Hands on why the scene's own file cannot be read; returns its format by its name.
    pub(crate) fn refuse(&self, path: &Path, message: String) -> Format {
        let refused = Some((path.to_owned(), Err(message)));
        *self.given.lock().unwrap_or_else(PoisonError::into_inner) = refused;
        Format::of_name(path).unwrap_or(Format::Pbrt)
    }

    fn taken(&self, path: &Path) -> Option<Result<Vec<u8>, String>> {
        let mut given = self.given.lock().unwrap_or_else(PoisonError::into_inner);
        given.take_if(|(of, _)| of == path).map(|(_, bytes)| bytes)
    }

    fn locked<T>(&self, f: impl FnOnce(&mut List) -> T) -> T {
        // The list stays valid even if a thread panics while it holds the lock.
        f(&mut self.list.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

fn unreadable(error: &Error) -> String {
    format!("cannot be read: {error}")
}

/// Opens a file that is neither folder, pipe, socket nor device.
///
/// # Errors
///
/// A message without the file's name.
fn open_ordinary(path: &Path) -> Result<File, String> {
    let is_ordinary = |metadata: Metadata| match metadata.file_type() {
        kind if kind.is_file() => Ok(()),
        kind if kind.is_dir() => Err("is a folder; expected a file".to_owned()),
        _ => Err("is a pipe, a socket or a device; expected an ordinary file".to_owned()),
    };
    // Opening a device may do something: its type is checked first.
    std::fs::metadata(path)
        .map_err(|e| unreadable(&e))
        .and_then(is_ordinary)?;
    let mut options = OpenOptions::new();
    options.read(true);
    // If a pipe took its place since then, opening must not wait for it.
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::custom_flags(&mut options, libc::O_NONBLOCK);
    let file = options.open(path).map_err(|e| unreadable(&e))?;
    file.metadata()
        .map_err(|e| unreadable(&e))
        .and_then(is_ordinary)?;
    Ok(file)
}

/// Reads what another program writes to a pipe. Opening one that nobody writes to would wait for ever: that
/// is an error after half a second.
#[cfg(unix)]
fn bytes_of_pipe(path: &Path, limits: &Limits) -> Result<Vec<u8>, String> {
    use std::os::unix::fs::OpenOptionsExt;
    use std::time::{Duration, Instant};
    const LONGEST_WAIT: Duration = Duration::from_millis(500);
    const SHORTEST_SLEEP: Duration = Duration::from_micros(100);
    const LONGEST_SLEEP: Duration = Duration::from_millis(10);
    let mut options = OpenOptions::new();
    options.read(true).custom_flags(libc::O_NONBLOCK);
    let mut pipe = options.open(path).map_err(|e| unreadable(&e))?;
    let (start, mut sleep) = (Instant::now(), SHORTEST_SLEEP);
    let (mut bytes, mut part, mut is_written) = (Vec::new(), vec![0; 1 << 16], false);
    loop {
        match pipe.read(&mut part) {
            Ok(0) if is_written => return Ok(bytes),
            Ok(0) if start.elapsed() > LONGEST_WAIT => {
                return Err("is a pipe that no program writes to; expected a file".to_owned());
            }
            Ok(0) => {}
            Ok(count) => {
                bytes.extend_from_slice(&part[..count]);
                if bytes.len() as u64 > limits.max_bytes {
                    return Err(too_long(limits));
                }
                (is_written, sleep) = (true, SHORTEST_SLEEP);
                continue;
            }
            // Somebody has opened it, and is to write.
            Err(e) if e.kind() == std::io::ErrorKind::WouldBlock => is_written = true,
            Err(e) if e.kind() == std::io::ErrorKind::Interrupted => continue,
            Err(e) => return Err(unreadable(&e)),
        }
        std::thread::sleep(sleep);
        sleep = LONGEST_SLEEP.min(2 * sleep);
    }
}

fn too_long(limits: &Limits) -> String {
    format!("has more than {} bytes (`max_bytes`)", limits.max_bytes)
}

fn bytes_of(file: File, limits: &Limits) -> Result<Vec<u8>, String> {
    let most = limits.max_bytes;
    let promised = file.metadata().map_err(|e| unreadable(&e))?.len();
    if promised > most {
        return Err(too_long(limits));
    }
    let mut bytes = Vec::with_capacity(usize::try_from(promised).unwrap_or(0));
    // The length of a pipe or a device is unknown.
    file.take(most.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|e| unreadable(&e))?;
    if bytes.len() as u64 > most {
        return Err(too_long(limits));
    }
    Ok(bytes)
}

fn unpack(bytes: &[u8], limits: &Limits) -> Result<Vec<u8>, String> {
    let most = limits.max_bytes;
    // A guess, which is not to exceed the limit.
    let guess = (bytes.len() as u64).saturating_mul(3).min(most);
    let mut unpacked = Vec::with_capacity(usize::try_from(guess).unwrap_or(0));
    flate2::read::MultiGzDecoder::new(bytes)
        .take(most.saturating_add(1))
        .read_to_end(&mut unpacked)
        .map_err(|e| format!("cannot be unpacked: {e}"))?;
    if unpacked.len() as u64 > most {
        return Err(format!("unpacks to more than {most} bytes (`max_bytes`)"));
    }
    Ok(unpacked)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn confined_files_lie_in_their_folder() {
        let outer = tempfile::tempdir().unwrap();
        let folder = outer.path().join("scene");
        std::fs::create_dir_all(folder.join("deep")).unwrap();
        for name in ["secret", "scene/a", "scene/deep/b"] {
            std::fs::write(outer.path().join(name), "text").unwrap();
        }
        let options = LoadOptions {
            confined_to: Some(folder.clone()),
            ..LoadOptions::default()
        };
        let files = Files::of(&options);
        for good in ["a", "deep/b", "deep/../a"] {
            files.plain(&folder.join(good)).unwrap();
        }
        #[cfg(unix)]
        std::os::unix::fs::symlink(outer.path(), folder.join("link")).unwrap();
        let outside = [
            "../secret",
            "../none",
            "link/secret",
            "link/none",
            "/etc/passwd",
            "deep/../../secret",
        ];
        for bad in outside {
            let path = folder.join(bad);
            for error in [
                files.plain(&path).unwrap_err(),
                files.open(&path).unwrap_err(),
                files.unpacked(&path).unwrap_err(),
            ] {
                assert!(
                    cfg!(not(unix)) || error.contains("outside"),
                    "{bad}: {error}"
                );
            }
        }
        let missing = files.plain(&folder.join("none")).unwrap_err();
        assert!(!missing.contains("outside"), "{missing}");
    }

    #[test]
    fn files_are_listed_once_in_the_order_of_their_announcement() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        for name in ["a", "b", "c"] {
            std::fs::write(at(name), "text").unwrap();
        }
        let files = Files::new(Limits::default());
        files.announce(&at("c"));
        files.announce(&at("b"));
        files.announce(&at("missing"));
        let other = files.clone();
        std::thread::scope(|scope| {
            scope.spawn(|| {
                for name in ["a", "c", "c"] {
                    other.plain(&at(name)).unwrap();
                }
                other.plain(&at("missing")).unwrap_err();
            });
        });
        assert_eq!(files.list(), [at("c"), at("a")], "`b` was not read");
    }
}
