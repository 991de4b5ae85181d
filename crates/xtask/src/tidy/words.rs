//! Words that the glossary retires (`docs/glossary.md`).

use std::fs;
use std::path::{Path, PathBuf};

use crate::Result;

/// Words of code and prose that have a standard term, with that term.
const RETIRED: &[(&str, &str)] = &[
    ("widths", "alpha"),
    ("drawn", "sampled"),
    ("drew", "sampled"),
    ("brought", "contribution"),
    ("brings", "contribution, or contributes"),
    ("shine", "emit, or transmittance to the light"),
    ("shines", "emits"),
    ("thrown", "projected"),
    ("relief", "bump or normal map"),
    ("reliefs", "bump or normal maps"),
    ("ours", "the method's name, or Specula"),
];

/// Pairs of words that have a standard term, side by side in a line or an identifier.
///
/// Each word alone is plain English (to draw a plot, numbers of a file, to find a file), so that only what stands
/// beside it tells the retired meaning.
const RETIRED_PAIRS: &[([&str; 2], &str)] = &[
    (["draw", "light"], "sample_light"),
    (["draw", "lights"], "sample lights"),
    (["draw", "direction"], "sample a direction"),
    (["draw", "directions"], "sample directions"),
    (["draws", "directions"], "samples directions"),
    (["draws", "reflections"], "samples reflections"),
    (["draw", "sample"], "sample"),
    (["draw", "wm"], "sample_wm"),
    (["random", "draw"], "sample"),
    (["light", "numbers"], "random numbers"),
    (["uniform", "numbers"], "random numbers"),
    (["sample", "numbers"], "sample indices"),
    (["pixel", "numbers"], "pixel indices"),
    (["path", "finds"], "hits"),
    (["paths", "find"], "hit"),
    (["ray", "finds"], "hits"),
    (["rays", "find"], "hit"),
    (["lobe", "finds"], "hits"),
    (["lobes", "find"], "hit"),
    (["looked", "at"], "occluded, or checked"),
    (["in", "step"], "wavefront, or interleaved"),
    (["kept", "hit"], "closest hit"),
    (["kept", "light"], "chosen light"),
    (["keep", "hit"], "store a hit"),
];

/// This file, which has to name them.
const THIS: &str = "crates/xtask/src/tidy/words.rs";

/// The folders that are read.
const FOLDERS: &[&str] = &["crates", "docs"];

/// Files and folders that are not: the glossary has to name the words, decisions tell what was tried, results are written
/// by the laboratory.
const EXCEPT: &[&str] = &[THIS, "docs/glossary.md", "docs/decisions", "docs/results"];

/// Ends of the files that are read.
const READ: &[&str] = &["rs", "wgsl", "hlsl", "md", "toml", "html"];

/// One line for each retired word in the crates, shaders included, and in the documents.
pub(super) fn find(root: &Path) -> Result<Vec<String>> {
    let mut lines = Vec::new();
    for path in files(root)? {
        let name = name_of(root, &path);
        let text = fs::read_to_string(&path).map_err(|e| format!("{name}: {e}"))?;
        lines.extend(retired(&text).iter().map(|line| format!("{name}:{line}")));
    }
    Ok(lines)
}

/// A path from the root, with slashes.
fn name_of(root: &Path, path: &Path) -> String {
    let name = path.strip_prefix(root).unwrap_or(path);
    name.to_string_lossy().replace('\\', "/")
}

/// The files that are read: those of the folders, and the root's own.
fn files(root: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    let mut folders: Vec<PathBuf> = FOLDERS.iter().map(|folder| root.join(folder)).collect();
    for entry in fs::read_dir(root)? {
        files.extend(Some(entry?.path()).filter(|path| is_read(path)));
    }
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            if EXCEPT.contains(&name_of(root, &path).as_str()) {
                continue;
            }
            if path.is_dir() {
                let built = path
                    .file_name()
                    .is_some_and(|n| n == "target" || n == "corpus" || n == "node_modules");
                if !built {
                    folders.push(path);
                }
            } else if is_read(&path) {
                files.push(path);
            }
        }
    }
    files.sort();
    Ok(files)
}

/// Whether a path is a file with one of the ends.
fn is_read(path: &Path) -> bool {
    let has_end = |end: &std::ffi::OsStr| READ.iter().any(|read| end == *read);
    path.is_file() && path.extension().is_some_and(has_end)
}

/// The retired words of a text, as `line: word`. Parts of an identifier count as words.
fn retired(text: &str) -> Vec<String> {
    let mut lines = Vec::new();
    for (number, line) in (1..).zip(text.lines()) {
        let words = words(line);
        let mut add = |found: &str, term: &str| {
            lines.push(format!("{number}: `{found}` (the glossary says: {term})"));
        };
        for &(_, word) in &words {
            let lower = word.to_lowercase();
            if let Some((_, term)) = RETIRED.iter().find(|(retired, _)| *retired == lower) {
                add(word, term);
            }
        }
        for pair in words.windows(2) {
            let [(begin, first), (next, second)] = [pair[0], pair[1]];
            let between = &line[begin + first.len()..next];
            let lower = [first.to_lowercase(), second.to_lowercase()];
            let known = RETIRED_PAIRS.iter().find(|(retired, _)| *retired == lower);
            if let (Some((_, term)), "" | "_" | " " | "-") = (known, between) {
                add(&line[begin..next + second.len()], term);
            }
        }
    }
    lines
}

/// The words of a line with their places: runs of letters, cut where a capital follows a small letter.
fn words(line: &str) -> Vec<(usize, &str)> {
    let mut words = Vec::new();
    let mut from = 0;
    let mut before: Option<char> = None;
    for (at, c) in line.char_indices().chain([(line.len(), ' ')]) {
        let was_word = before.is_some_and(char::is_alphabetic);
        let is_cut = c.is_uppercase() && before.is_some_and(char::is_lowercase);
        if was_word && (is_cut || !c.is_alphabetic()) {
            words.push((from, &line[from..at]));
        }
        if c.is_alphabetic() && (is_cut || !was_word) {
            from = at;
        }
        before = Some(c);
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

    #[test]
    fn retired_pairs_are_found_side_by_side() {
        for (text, pair) in [
            ("fn draw_light(&self) {}", "draw_light"),
            ("struct DrawLight;", "DrawLight"),
            ("fn path_light_numbers(u: vec4f) {}", "light_numbers"),
            ("\n// Lights that paths find.", "paths find"),
            ("paths traced in-step", "in-step"),
        ] {
            let found = retired(text);
            assert_eq!(found.len(), 1, "{text}: {found:?}");
            assert!(found[0].contains(&format!(": `{pair}` (")), "{found:?}");
        }
    }

    #[test]
    fn parts_of_pairs_alone_are_not() {
        for text in [
            "draws a plot",
            "fn draw(light: u8) {}",
            "by light: numbers of files",
            "random numbers",
            "rays that find_file finds",
            "looked up at a point",
        ] {
            assert_eq!(retired(text), [""; 0], "{text}");
        }
    }

    /// Every entry can be found, so that none is spelled in a form that no text has.
    #[test]
    fn every_entry_is_found() {
        for (word, _) in RETIRED {
            assert_eq!(retired(word).len(), 1, "{word}");
        }
        for ([first, second], _) in RETIRED_PAIRS {
            assert_eq!(
                retired(&format!("{first}_{second}")).len(),
                1,
                "{first} {second}"
            );
        }
    }

    /// A workspace with a retired word in a crate, a page, the root's readme, and where it may stand.
    #[test]
    fn crates_documents_and_the_root_are_read() {
        let folder = std::env::temp_dir().join(format!("specula-words-{}", std::process::id()));
        let root = folder.as_path();
        for name in [
            "README.md",
            "crates/a/src/lib.rs",
            "crates/a/target/lib.rs",
            "docs/guide/page.md",
            "docs/decisions/one.md",
            "docs/glossary.md",
            "docs/results/table.md",
        ] {
            let path = root.join(name);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, "two widths\n").unwrap();
        }
        let found = find(root).unwrap();
        fs::remove_dir_all(root).unwrap();
        let names: Vec<&str> = found.iter().filter_map(|f| f.split(':').next()).collect();
        let expected = ["README.md", "crates/a/src/lib.rs", "docs/guide/page.md"];
        assert_eq!(names, expected, "{found:?}");
    }
}
