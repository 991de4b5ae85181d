//! Paths that pages give and see.

use std::path::{Path, PathBuf};

/// Most parts of a path.
const MOST_PARTS: usize = 32;

/// The file that a page names, where it is an ordinary one below `folder`, also by its links.
pub(crate) fn file_within(folder: &Path, path: &Path) -> Option<PathBuf> {
    let folder = folder.canonicalize().ok()?;
    let path = folder.join(path).canonicalize().ok()?;
    (path.starts_with(&folder) && path.is_file()).then_some(path)
}

/// A path below a folder for the files of a dropped scene; `None` where a file system could take it for another place.
///
/// * `path`: with slashes between its parts, whatever the system.
pub(crate) fn sanitised(path: &str) -> Option<PathBuf> {
    let is_plain = |part: &str| {
        let is_odd = |c: char| c.is_control() || "\\:*?\"<>|".contains(c);
        !part.is_empty()
            && part.len() <= 255
            && !part.starts_with("..")
            && !part.ends_with(['.', ' '])
            && !part.contains(is_odd)
    };
    let parts: Vec<&str> = path.split('/').collect();
    let is_good = parts.len() <= MOST_PARTS && parts.iter().all(|part| is_plain(part));
    is_good.then(|| parts.iter().collect())
}

/// A path as pages see it: relative to the folder, with slashes.
pub(crate) fn shown(folder: &Path, path: &Path) -> String {
    let path = path.strip_prefix(folder).unwrap_or(path);
    let text = path.display().to_string();
    match std::path::MAIN_SEPARATOR {
        '/' => text,
        separator => text.replace(separator, "/"),
    }
}

/// A message without the folder in its paths.
pub(crate) fn without(folder: &Path, message: &str) -> String {
    let folder = folder.display().to_string();
    let separator = std::path::MAIN_SEPARATOR;
    message
        .replace(&format!("{folder}{separator}"), "")
        .replace(&folder, ".")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_dropped_files_stay_in_their_folder() {
        for good in [
            "a.pbrt",
            "a/b.ply",
            "a/.hidden",
            "textures/bl\u{fc}te 1.png",
        ] {
            assert_eq!(sanitised(good), Some(PathBuf::from(good)), "{good}");
        }
        for bad in [
            "",
            "/",
            "/etc/passwd",
            "..",
            "../a",
            "a/../b",
            "a/..",
            "a//b",
            "a/",
            "./a",
            "a/./b",
            "a\\b",
            "..\\a",
            "C:/a",
            "C:a",
            "a\0b",
            "a\nb",
            "a.",
            "a ",
            "...",
            "a/b:stream",
            "~|a",
        ] {
            assert_eq!(sanitised(bad), None, "{bad:?}");
        }
        assert_eq!(sanitised(&"a/".repeat(40)), None);
        assert_eq!(sanitised(&"a".repeat(300)), None);
    }

    #[test]
    #[cfg(unix)]
    fn opened_files_lie_in_the_folder() {
        let folder = tempfile::tempdir().unwrap();
        let inside = folder.path().join("in");
        std::fs::create_dir_all(inside.join("deep")).unwrap();
        std::fs::write(folder.path().join("out.pbrt"), "").unwrap();
        std::fs::write(inside.join("deep/a.pbrt"), "").unwrap();
        std::os::unix::fs::symlink(folder.path().join("out.pbrt"), inside.join("link.pbrt"))
            .unwrap();
        let find = |path: &str| file_within(&inside, Path::new(path));
        assert!(find("deep/a.pbrt").is_some());
        assert!(find("deep/../deep/a.pbrt").is_some());
        assert!(find(inside.join("deep/a.pbrt").to_str().unwrap()).is_some());
        for bad in [
            "../out.pbrt",
            "link.pbrt",
            "deep",
            "none",
            "",
            "/etc/passwd",
            "deep/../../out.pbrt",
        ] {
            assert_eq!(find(bad), None, "{bad}");
        }
    }
}
