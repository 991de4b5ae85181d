//! Dead links of the repository's documents.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use super::markdown::{self, Document};
use super::summary::{self, Summary, resolve};
use crate::Result;

/// Folders whose documents are checked, besides those of the root.
const FOLDERS: [&str; 3] = ["crates", "data", "docs"];
/// The folder whose documents are all pages of the book.
const BOOK: &str = "docs";

/// One line for each dead link, missing page and document of `docs` that is no page.
pub(super) fn find(root: &Path, summary: &Summary) -> Result<Vec<String>> {
    let mut documents = HashMap::new();
    for path in files(root)? {
        let text = fs::read_to_string(root.join(&path)).map_err(|e| format!("{path:?}: {e}"))?;
        documents.insert(path, markdown::read(&text));
    }
    let mut findings = Vec::new();
    for (line, page) in &summary.pages {
        if !documents.contains_key(page) {
            findings.push(format!(
                "{}:{line}: no page {}",
                summary::FILE,
                page.display()
            ));
        }
    }
    let mut paths: Vec<&PathBuf> = documents.keys().collect();
    paths.sort();
    let exists = |path: &Path| root.join(path).exists();
    let is_folder = |path: &Path| root.join(path).is_dir();
    for path in paths {
        if path.starts_with(BOOK) && path != Path::new(summary::FILE) && !summary.has(path) {
            findings.push(format!("{}:1: not in {}", path.display(), summary::FILE));
        }
        let check = Check {
            path,
            documents: &documents,
            in_book: summary.has(path).then_some(summary),
            exists: &exists,
            is_folder: &is_folder,
        };
        findings.extend(check.document(&documents[path]));
    }
    Ok(findings)
}

/// Documents by their paths from the root.
fn files(root: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders: Vec<PathBuf> = FOLDERS.iter().map(|f| root.join(f)).collect();
    let mut entries: Vec<PathBuf> = fs::read_dir(root)?
        .map(|entry| entry.map(|e| e.path()))
        .collect::<std::io::Result<_>>()?;
    entries.retain(|path| path.is_file());
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            if !path.is_dir() {
                entries.push(path);
            } else if path
                .file_name()
                .is_some_and(|name| name != "target" && name != "node_modules")
            {
                folders.push(path);
            }
        }
    }
    for path in entries {
        if path.extension().is_some_and(|e| e == "md") {
            files.push(path.strip_prefix(root)?.to_path_buf());
        }
    }
    files.sort();
    Ok(files)
}

/// A document's links, and what they may point at.
struct Check<'a> {
    path: &'a Path,
    documents: &'a HashMap<PathBuf, Document>,
    /// The book, where the document is a page of it.
    in_book: Option<&'a Summary>,
    exists: &'a dyn Fn(&Path) -> bool,
    is_folder: &'a dyn Fn(&Path) -> bool,
}

impl Check<'_> {
    fn document(&self, document: &Document) -> Vec<String> {
        let mut findings = Vec::new();
        let mut add = |line: usize, problem: Option<String>| {
            findings.extend(problem.map(|p| format!("{}:{line}: {p}", self.path.display())));
        };
        for (line, target) in &document.links {
            add(*line, self.link(target));
        }
        for (line, target) in &document.inclusions {
            add(*line, self.inclusion(target));
        }
        findings
    }

    /// What is wrong with a link.
    fn link(&self, target: &str) -> Option<String> {
        if let Some((scheme, rest)) = target.split_once(':')
            && !scheme.contains(['/', '#', '.'])
        {
            return (!external(scheme, rest)).then(|| format!("no address: {target}"));
        }
        let (path, anchor) = match target.split_once('#') {
            Some((path, anchor)) => (path, Some(anchor)),
            None => (target, None),
        };
        let file = match path {
            "" => self.path.to_path_buf(),
            _ => match self.resolve(path) {
                Ok(file) => file,
                Err(problem) => return Some(problem),
            },
        };
        if let Some(summary) = self.in_book {
            if (self.is_folder)(&file) {
                return Some(format!("a folder, which is no page of the book: {target}"));
            }
            if file.extension().is_some_and(|e| e == "md") && !summary.has(&file) {
                return Some(format!("not a page of the book: {target}"));
            }
        }
        let anchor = anchor?;
        let found = self
            .documents
            .get(&file)
            .is_some_and(|d| d.anchors.iter().any(|a| a == anchor));
        (!found).then(|| format!("no such heading: {target}"))
    }

    fn inclusion(&self, target: &str) -> Option<String> {
        match self.resolve(target) {
            Ok(file) if (self.is_folder)(&file) => Some(format!("a folder: {target}")),
            Ok(_) => None,
            Err(problem) => Some(problem),
        }
    }

    /// The file of a relative path, from the root.
    fn resolve(&self, target: &str) -> std::result::Result<PathBuf, String> {
        let folder = self.path.parent().unwrap_or(Path::new(""));
        match resolve(folder, target) {
            None => Err(format!("outside of the repository: {target}")),
            Some(file) if !(self.exists)(&file) => Err(format!("no such file: {target}")),
            Some(file) => Ok(file),
        }
    }
}

/// Whether an address has the form of one; nothing is fetched.
fn external(scheme: &str, rest: &str) -> bool {
    match scheme {
        "http" | "https" => rest.strip_prefix("//").is_some_and(|rest| {
            let host = rest.split(['/', '?', '#']).next().unwrap_or("");
            host.contains('.') && !host.starts_with('.') && !rest.contains(char::is_whitespace)
        }),
        "mailto" => rest.contains('@'),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# Page\n\n## Part\n";

    /// What is found in a page `docs/guide/a.md` of this text, beside `docs/b.md` and the file `docs/p.png`.
    fn found(text: &str) -> Vec<String> {
        let documents: HashMap<PathBuf, Document> = [
            ("docs/guide/a.md", text),
            ("docs/b.md", PAGE),
            ("README.md", PAGE),
            ("crates/c.md", PAGE),
        ]
        .map(|(path, text)| (PathBuf::from(path), markdown::read(text)))
        .into();
        let pages = ["docs/guide/a.md", "docs/b.md", "README.md"];
        let summary = Summary {
            text: String::new(),
            pages: pages.map(|p| (1, PathBuf::from(p))).into(),
        };
        let known = |path: &Path| documents.contains_key(path) || path == Path::new("docs/p.png");
        let is_folder = |path: &Path| path == Path::new("docs/guide");
        let path = Path::new("docs/guide/a.md");
        let check = Check {
            path,
            documents: &documents,
            in_book: Some(&summary),
            exists: &|path| known(path) || is_folder(path),
            is_folder: &is_folder,
        };
        check.document(&documents[path])
    }

    #[test]
    fn planted_dead_links_are_found_with_file_and_line() {
        for (link, problem) in [
            ("[x](../none.md)", "no such file"),
            ("![x](none.png)", "no such file"),
            ("[x](../b.md#parts)", "no such heading"),
            ("[x](#part)", "no such heading"),
            ("[x](../../../x.md)", "outside of the repository"),
            ("[x](../guide)", "a folder"),
            ("[x](../../crates/c.md)", "not a page of the book"),
            ("[x](../p.png#part)", "no such heading"),
            ("[x](https://nowhere)", "no address"),
            ("[x](https:/example.org)", "no address"),
            ("[x](htps://example.org)", "no address"),
            ("{{#include ../none.rs}}", "no such file"),
            ("{{#include ../guide}}", "a folder"),
        ] {
            let findings = found(&format!("# A\n\n{link}\n"));
            assert_eq!(findings.len(), 1, "{link}: {findings:?}");
            let expected = format!("docs/guide/a.md:3: {problem}");
            assert!(findings[0].starts_with(&expected), "{findings:?}");
        }
    }

    #[test]
    fn live_links_are_not() {
        let text = "# A\n\n[1](../b.md#part) [2](#a) ![3](../p.png) [4](../../README.md)\n\
                    [5](https://example.org/x?y#z) [6](mailto:a@example.org) {{#include ../p.png}}\n";
        assert_eq!(found(text), [""; 0]);
    }
}
