//! Words that the glossary retires (`docs/glossary.md`).

use std::fs;
use std::path::{Path, PathBuf};

use crate::Result;

/// Words of code and prose that have a standard term, with that term.
const RETIRED: &[(&str, &str)] = &[
    ("widths", "alpha"),
    ("drawn", "sampled"),
    ("brought", "contribution"),
    ("shine", "emit, or transmittance to the light"),
    ("shines", "emits"),
    ("thrown", "projected"),
    ("relief", "bump or normal map"),
    ("reliefs", "bump or normal maps"),
    ("ours", "the method's name"),
];

/// This file, which has to name them.
const THIS: &str = "crates/xtask/src/tidy/words.rs";

/// Ends of the files that are read.
const READ: &[&str] = &["rs", "wgsl", "hlsl", "md", "toml", "html"];

/// One line for each retired word in the crates, shaders included.
pub(super) fn find(root: &Path) -> Result<Vec<String>> {
    let mut lines = Vec::new();
    for path in files(root)? {
        let name = path.strip_prefix(root).unwrap_or(&path);
        let name = name.to_string_lossy().replace('\\', "/");
        if name == THIS {
            continue;
        }
        let text = fs::read_to_string(&path).map_err(|e| format!("{name}: {e}"))?;
        lines.extend(retired(&text).iter().map(|line| format!("{name}:{line}")));
    }
    Ok(lines)
}

fn files(root: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders = vec![root.join("crates")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if path.is_dir() {
                let built = path
                    .file_name()
                    .is_some_and(|n| n == "target" || n == "corpus");
                if !built {
                    folders.push(path);
                }
            } else if path
                .extension()
                .is_some_and(|e| READ.iter().any(|r| e == *r))
            {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// The retired words of a text, as `line: word`. Parts of an identifier count as words.
fn retired(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        for word in words(line) {
            let lower = word.to_lowercase();
            if let Some((_, term)) = RETIRED.iter().find(|(retired, _)| *retired == lower) {
                lines.push(format!("{number}: `{word}` (the glossary says: {term})"));
            }
        }
    }
    lines
}

/// The words of a line: runs of letters, cut where a capital follows a small letter.
fn words(line: &str) -> Vec<&str> {
    let mut words = Vec::new();
    for run in line.split(|c: char| !c.is_alphabetic()) {
        let mut from = 0;
        let mut before = None;
        for (at, c) in run.char_indices() {
            if c.is_uppercase() && before.is_some_and(char::is_lowercase) {
                words.push(&run[from..at]);
                from = at;
            }
            before = Some(c);
        }
        if from < run.len() {
            words.push(&run[from..]);
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn retired_words_are_found_in_prose_and_identifiers() {
        for text in [
            "// Both widths.",
            "fn equal_widths() {}",
            "struct WidthsAt;",
            "const EQUAL_WIDTHS: u8 = 0;",
            "a `Widths`",
        ] {
            let found = retired(text);
            assert_eq!(found.len(), 1, "{text}: {found:?}");
            assert!(found[0].starts_with("1: `"), "{found:?}");
            assert!(found[0].ends_with("alpha)"), "{found:?}");
        }
    }

    #[test]
    fn other_words_are_not() {
        for text in [
            "hours and colours",
            "fn withdrawn() {}",
            "shiner",
            "Neighbours",
        ] {
            assert_eq!(retired(text), [""; 0], "{text}");
        }
    }
}
