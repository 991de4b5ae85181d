//! Where the files that a scene names are looked for.

use std::path::{Path, PathBuf};

/// Folders in the order in which they are searched.
#[derive(Clone, Debug, Default)]
pub(crate) struct Search {
    /// The scene's own folder.
    beside: PathBuf,
    /// Folders of the caller's choice.
    folders: Vec<PathBuf>,
}

impl Search {
    /// For the scene in `main`.
    pub(crate) fn new(main: &Path, folders: &[PathBuf]) -> Self {
        Self {
            beside: main.parent().map(Path::to_owned).unwrap_or_default(),
            folders: folders.to_vec(),
        }
    }

    /// The first file of that name; where there is none, the path that it would have beside the
    /// scene. A name with folders in it, such as an absolute one, is also looked for by its last
    /// part alone.
    pub(crate) fn find(&self, name: &str) -> PathBuf {
        let beside = self.beside.join(name);
        if self.folders.is_empty() || beside.exists() {
            return beside;
        }
        let last = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let mut names = vec![name];
        if last != name && !last.is_empty() {
            names.push(last);
        }
        let found = names
            .iter()
            .flat_map(|name| self.folders.iter().map(move |folder| folder.join(name)))
            .find(|path| path.exists());
        found.unwrap_or(beside)
    }

    /// What helps where `path`, as [`Search::find`] gives it, does not exist.
    pub(crate) fn hint(&self, path: &Path) -> Option<String> {
        hint(
            path,
            std::iter::once(self.beside.as_path()).chain(self.folders.iter().map(PathBuf::as_path)),
        )
    }
}

/// What helps where a file does not exist: the folders in which it was looked for.
pub(crate) fn hint<'a>(path: &Path, folders: impl Iterator<Item = &'a Path>) -> Option<String> {
    if path.exists() {
        return None;
    }
    let mut names: Vec<String> = Vec::new();
    for folder in folders {
        let name = if folder.as_os_str().is_empty() {
            ".".to_owned()
        } else {
            folder.display().to_string()
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    Some(format!(
        "looked for in {}; `--search FOLDER` adds a folder",
        names.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_found_beside_the_scene_first() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir_all(at("more/deep")).unwrap();
        for name in ["a.png", "more/a.png", "more/b.png", "more/deep/c.png"] {
            std::fs::write(at(name), "").unwrap();
        }
        let search = Search::new(&at("scene.pbrt"), &[at("more")]);
        assert_eq!(search.find("a.png"), at("a.png"));
        assert_eq!(search.find("b.png"), at("more/b.png"));
        assert_eq!(search.find("deep/c.png"), at("more/deep/c.png"));
        assert_eq!(search.find("C:\\old\\b.png"), at("more/b.png"));
        assert_eq!(search.find("/nowhere/else/b.png"), at("more/b.png"));
        assert_eq!(search.hint(&search.find("b.png")), None);
        let missing = search.find("d.png");
        assert_eq!(missing, at("d.png"));
        let hint = search.hint(&missing).unwrap();
        assert!(hint.contains("--search") && hint.contains("more"), "{hint}");
    }
}
