//! The book's pages in a folder for mdBook: each at its place in the repository, with what it shows, includes
//! and links to.

use std::fs;
use std::path::{Path, PathBuf};

use super::markdown::{self, Document};
use super::summary::{Summary, resolve};
use crate::Result;

/// The folder, from the workspace's root.
const FOLDER: &str = "target/book-pages";
/// Settings and style of the book, beside its pages.
const SETTINGS: [&str; 2] = ["docs/book.toml", "docs/book.css"];

/// Makes the folder anew.
///
/// * Returns: its path.
pub(super) fn make(root: &Path, summary: &Summary) -> Result<PathBuf> {
    let folder = root.join(FOLDER);
    if folder.exists() {
        fs::remove_dir_all(&folder)?;
    }
    for (_, page) in &summary.pages {
        let text = fs::read_to_string(root.join(page))?;
        let document = markdown::read(&text);
        copy(root, &folder, page)?;
        fs::write(folder.join(page), with_indices(&text, &document))?;
        for (_, target) in document.links.iter().chain(&document.inclusions) {
            let path = target.split('#').next().unwrap_or("");
            let beside = page.parent().unwrap_or(Path::new(""));
            if let Some(file) = resolve(beside, path)
                && root.join(&file).is_file()
                && !summary.has(&file)
            {
                copy(root, &folder, &file)?;
            }
        }
    }
    for file in SETTINGS {
        let name = Path::new(file).file_name().unwrap_or_default();
        fs::copy(root.join(file), folder.join(name)).map_err(|e| format!("{file}: {e}"))?;
    }
    fs::write(folder.join("SUMMARY.md"), &summary.text)?;
    Ok(folder)
}

/// The text with links to `README.md` as links to `index.md`: mdBook names the page so, and not the links.
fn with_indices(text: &str, document: &Document) -> String {
    let mut staged = text.to_owned();
    for (_, target) in &document.links {
        let (path, anchor) = target.split_at(target.find('#').unwrap_or(target.len()));
        if let Some(folder) = path.strip_suffix("README.md") {
            let index = format!("]({folder}index.md{anchor})");
            staged = staged.replace(&format!("]({target})"), &index);
        }
    }
    staged
}

fn copy(root: &Path, folder: &Path, file: &Path) -> Result<()> {
    let to = folder.join(file);
    fs::create_dir_all(to.parent().unwrap_or(folder))?;
    fs::copy(root.join(file), to).map_err(|e| format!("{}: {e}", file.display()))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_to_readmes_lead_to_indices() {
        let text = "[a](../README.md) [b](x/README.md#y) [c](README.mdx) `README.md`\n";
        let staged = with_indices(text, &markdown::read(text));
        let expected = "[a](../index.md) [b](x/index.md#y) [c](README.mdx) `README.md`\n";
        assert_eq!(staged, expected);
    }
}
