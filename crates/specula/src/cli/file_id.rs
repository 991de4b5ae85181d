//! Which file a path means, whatever its name: by another name, a link, or in other case where the file
//! system does not tell cases apart.

use std::io;
use std::path::{Path, PathBuf};

/// A file or folder that exists.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct FileId(Identity);

#[cfg(unix)]
type Identity = (u64, u64);
#[cfg(not(unix))]
type Identity = PathBuf;

impl FileId {
    /// The file that a path leads to, through links.
    ///
    /// # Errors
    ///
    /// Where there is none, or the system denies access.
    #[cfg(unix)]
    pub(crate) fn of(path: &Path) -> io::Result<Self> {
        use std::os::unix::fs::MetadataExt;
        let metadata = std::fs::metadata(path)?;
        Ok(Self((metadata.dev(), metadata.ino())))
    }

    /// An open file.
    ///
    /// # Errors
    ///
    /// What the system says.
    #[cfg(unix)]
    pub(crate) fn of_open(file: &std::fs::File) -> io::Result<Self> {
        use std::os::unix::fs::MetadataExt;
        let metadata = file.metadata()?;
        Ok(Self((metadata.dev(), metadata.ino())))
    }

    /// The file that a path leads to, through links.
    ///
    /// # Errors
    ///
    /// Where there is none, or the system denies access.
    #[cfg(not(unix))]
    pub(crate) fn of(path: &Path) -> io::Result<Self> {
        path.canonicalize().map(Self)
    }
}

/// Files that were read, none of which may be written.
#[derive(Clone, Debug, Default)]
pub(crate) struct Inputs(Vec<(PathBuf, FileId)>);

impl Inputs {
    /// These files; what is gone by now cannot be overwritten.
    pub(crate) fn new<P: Into<PathBuf>>(paths: impl IntoIterator<Item = P>) -> Self {
        let identified = |path: P| {
            let path = path.into();
            FileId::of(&path).ok().map(|id| (path, id))
        };
        Self(paths.into_iter().filter_map(identified).collect())
    }

    /// The one of them that `path` means.
    pub(crate) fn same_as(&self, path: &Path) -> Option<&Path> {
        let id = FileId::of(path).ok()?;
        let found = self.0.iter().find(|(_, input)| *input == id);
        found.map(|(path, _)| path.as_path())
    }

    /// One of them that lies in `folder`, however deep.
    pub(crate) fn inside(&self, folder: &Path) -> Option<&Path> {
        let id = FileId::of(folder).ok()?;
        let is_inside = |path: &Path| {
            // The name as given, and where its links lead.
            let real = path.canonicalize().unwrap_or_default();
            let given = std::path::absolute(path).unwrap_or_default();
            [real, given].iter().any(|full| {
                let mut above = full.ancestors().skip(1);
                above.any(|a| FileId::of(a).is_ok_and(|a| a == id))
            })
        };
        let found = self.0.iter().find(|(path, _)| is_inside(path));
        found.map(|(path, _)| path.as_path())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_found_by_any_of_its_names() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("sub")).unwrap();
        for name in ["a.png", "b.png", "sub/c.png"] {
            std::fs::write(at(name), name).unwrap();
        }
        let inputs = Inputs::new([at("a.png"), at("sub/c.png"), at("gone.png")]);
        assert_eq!(inputs.same_as(&at("a.png")), Some(at("a.png").as_path()));
        assert!(inputs.same_as(&at("sub/../a.png")).is_some());
        assert!(inputs.same_as(&at("b.png")).is_none());
        assert!(inputs.same_as(&at("gone.png")).is_none());
        assert_eq!(inputs.inside(&at("sub")), Some(at("sub/c.png").as_path()));
        assert!(inputs.inside(folder.path()).is_some());
        std::fs::create_dir(at("empty")).unwrap();
        assert!(inputs.inside(&at("empty")).is_none());
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(at("a.png"), at("soft.png")).unwrap();
            std::fs::hard_link(at("a.png"), at("hard.png")).unwrap();
            assert!(inputs.same_as(&at("soft.png")).is_some());
            assert!(inputs.same_as(&at("hard.png")).is_some());
            // A link in a folder to a file elsewhere is lost with the folder, too.
            std::os::unix::fs::symlink(at("b.png"), at("empty/link.png")).unwrap();
            assert!(
                Inputs::new([at("empty/link.png")])
                    .inside(&at("empty"))
                    .is_some()
            );
        }
    }
}
