//! `docs/SUMMARY.md`: the pages of the book, in order.

use std::fs;
use std::path::{Path, PathBuf};

use super::markdown;
use crate::Result;

/// The list of pages, from the workspace's root.
pub(super) const FILE: &str = "docs/SUMMARY.md";

/// The pages of the book.
pub(super) struct Summary {
    /// The list with targets from the workspace's root, as mdBook wants it.
    pub(super) text: String,
    /// Pages by their paths from the workspace's root, with their lines in the list.
    pub(super) pages: Vec<(usize, PathBuf)>,
}

impl Summary {
    /// Whether a file is a page of the book.
    pub(super) fn has(&self, page: &Path) -> bool {
        self.pages.iter().any(|(_, p)| p == page)
    }
}

/// Reads the list.
pub(super) fn read(root: &Path) -> Result<Summary> {
    let text = fs::read_to_string(root.join(FILE)).map_err(|e| format!("{FILE}: {e}"))?;
    parse(&text)
}

fn parse(text: &str) -> Result<Summary> {
    let folder = Path::new(FILE).parent().unwrap_or(Path::new(""));
    let mut pages = Vec::new();
    let mut staged = text.to_owned();
    for (line, target) in markdown::read(text).links {
        let outside = || format!("{FILE}:{line}: {target} is outside of the repository");
        let page = resolve(folder, &target).ok_or_else(outside)?;
        let from_root = page.to_string_lossy().replace('\\', "/");
        staged = staged.replace(&format!("]({target})"), &format!("](/{from_root})"));
        pages.push((line, page));
    }
    Ok(Summary {
        text: staged.replace("](/", "]("),
        pages,
    })
}

/// A relative path from `folder`, without `.` and `..`; `None` where it leads out of the root.
pub(super) fn resolve(folder: &Path, target: &str) -> Option<PathBuf> {
    let mut path = folder.to_path_buf();
    for part in target.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                if !path.pop() {
                    return None;
                }
            }
            name => path.push(name),
        }
    }
    Some(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_are_named_from_the_root() {
        let summary =
            parse("# Summary\n\n[A](../A.md)\n- [B](guide/b.md)\n  - [C](c.md)\n").unwrap();
        assert_eq!(
            summary.text,
            "# Summary\n\n[A](A.md)\n- [B](docs/guide/b.md)\n  - [C](docs/c.md)\n"
        );
        let pages: Vec<_> = summary
            .pages
            .iter()
            .map(|(n, p)| (*n, p.to_str().unwrap()))
            .collect();
        assert_eq!(
            pages,
            [(3, "A.md"), (4, "docs/guide/b.md"), (5, "docs/c.md")]
        );
        assert!(summary.has(Path::new("A.md")) && !summary.has(Path::new("docs/A.md")));
        assert!(parse("[A](../../A.md)\n").is_err());
    }
}
