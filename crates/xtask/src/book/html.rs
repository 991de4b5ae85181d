//! Dead links of the built book.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::markdown::attributes;
use super::summary::resolve;
use crate::Result;

/// Files of mdBook's own whose links are relative to other files.
const OTHER: [&str; 2] = ["404.html", "toc.html"];

/// One line for each link of a page that leads nowhere.
pub(super) fn find(built: &Path) -> Result<Vec<String>> {
    let mut pages = HashMap::new();
    let mut files = HashSet::new();
    let mut folders = vec![built.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let name = path.strip_prefix(built)?.to_path_buf();
            let is_page = name.extension().is_some_and(|e| e == "html");
            if is_page && !OTHER.iter().any(|other| name == Path::new(other)) {
                pages.insert(name.clone(), fs::read_to_string(&path)?);
            }
            files.insert(name);
        }
    }
    let mut findings = dead(&pages, &files);
    findings.sort();
    Ok(findings)
}

fn dead(pages: &HashMap<PathBuf, String>, files: &HashSet<PathBuf>) -> Vec<String> {
    let mut findings = Vec::new();
    let anchors: HashMap<&Path, HashSet<&str>> = (pages.iter())
        .map(|(path, text)| (path.as_path(), attributes(text, "id").collect()))
        .collect();
    for (path, text) in pages {
        let folder = path.parent().unwrap_or(Path::new(""));
        for target in ["href", "src"]
            .iter()
            .flat_map(|name| attributes(text, name))
        {
            if target.contains(':') {
                continue;
            }
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let file = match file {
                "" => Some(path.clone()),
                _ => resolve(folder, file),
            };
            let alive = file.is_some_and(|file| {
                let has = |a: &HashSet<&str>| anchor.is_empty() || a.contains(anchor);
                files.contains(&file) && anchors.get(file.as_path()).is_none_or(has)
            });
            if !alive {
                findings.push(format!("{}: dead in the book: {target}", path.display()));
            }
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planted_dead_links_are_found() {
        let text = r##"<h1 id="a">A</h1> <a href="#a"> <a href="b.html#b"> <img src="c.png">
            <a href="https://example.org"> <a href="d.html"> <a href="b.html#c"> <a href="#b"> <img src="../x.png">"##;
        let pages: HashMap<PathBuf, String> = [
            (PathBuf::from("a.html"), text.to_owned()),
            (PathBuf::from("b.html"), r#"<h1 id="b">"#.to_owned()),
        ]
        .into();
        let files = ["a.html", "b.html", "c.png"].map(PathBuf::from).into();
        let mut findings = dead(&pages, &files);
        findings.sort();
        let expected = ["#b", "../x.png", "b.html#c", "d.html"];
        assert_eq!(
            findings,
            expected.map(|t| format!("a.html: dead in the book: {t}"))
        );
    }
}
