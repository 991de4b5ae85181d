//! `cargo xtask tidy`: what no compiler checks.

mod circles;
mod words;

use std::fs;
use std::path::Path;

use crate::{Result, workspace};

/// Most lines of a file before its tests.
const LONGEST: usize = 600;

/// Fails with the list of everything untidy in the workspace's Rust files.
pub(crate) fn run(root: &Path) -> Result<()> {
    let files = workspace::rust_files(root)?;
    let mut findings = Vec::new();
    for path in &files {
        let name = path.strip_prefix(root).unwrap_or(path).display();
        let text = fs::read_to_string(path).map_err(|e| format!("{name}: {e}"))?;
        findings.extend(untidy(&text).iter().map(|f| format!("{name}:{f}")));
    }
    findings.extend(circles::find(root)?);
    findings.extend(words::find(root)?);
    if findings.is_empty() {
        println!("{} files are tidy", files.len());
        return Ok(());
    }
    Err(format!("{}\n{} findings", findings.join("\n"), findings.len()).into())
}

/// What is untidy in one file, as `line: what`.
fn untidy(text: &str) -> Vec<String> {
    let mut findings = Vec::new();
    if !text.starts_with("//!") {
        findings.push("1: the first line must be `//!` and say what the file is".to_owned());
    }
    let before_tests = text.lines().take_while(|l| *l != "#[cfg(test)]").count();
    if before_tests > LONGEST {
        findings.push(format!(
            "{before_tests}: {before_tests} lines before the tests, at most {LONGEST}"
        ));
    }
    for (number, line) in (1..).zip(text.lines()) {
        if line.ends_with([' ', '\t', '\r']) {
            findings.push(format!("{number}: trailing white space"));
        }
        for left in leftovers() {
            if contains_word(line, &left) {
                findings.push(format!("{number}: `{left}`"));
            }
        }
    }
    if !text.is_empty() && !text.ends_with('\n') {
        findings.push(format!("{}: no newline at the end", text.lines().count()));
    }
    findings
}

/// What must not be left in a file, put together here so that this file holds none of it.
fn leftovers() -> [String; 5] {
    [
        ["TO", "DO"],
        ["FIX", "ME"],
        ["to", "do!"],
        ["unimple", "mented!"],
        ["#[ign", "ore"],
    ]
    .map(|parts| parts.concat())
}

/// Whether `word` occurs in `line` and no letter stands right before or after it.
fn contains_word(line: &str, word: &str) -> bool {
    let letter = |c: Option<char>| c.is_some_and(|c| c.is_alphanumeric() || c == '_');
    line.match_indices(word).any(|(at, _)| {
        let after = line[at + word.len()..].chars().next();
        !letter(line[..at].chars().next_back()) && !letter(after)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tidy_file_has_no_findings() {
        assert_eq!(untidy("//! A file.\n\nfn f() {}\n"), [""; 0]);
        assert_eq!(untidy("//! Mentions TODOS and MASTODON.\n"), [""; 0]);
    }

    #[test]
    fn each_fault_is_found_at_its_line() {
        let [note, fix, macro_call, panics, skipped] = leftovers();
        for (text, finding) in [
            ("fn f() {}\n".to_owned(), "1: the first line must be"),
            ("//! A.\nlet a; \n".to_owned(), "2: trailing white space"),
            ("//! A.".to_owned(), "1: no newline"),
            (format!("//! A.\n// {note}: b\n"), "2: `TO"),
            (format!("//! A.\n// {fix} b\n"), "2: `FIX"),
            (format!("//! A.\n{macro_call}();\n"), "2: `to"),
            (format!("//! A.\n{panics}()\n"), "2: `unimple"),
            (format!("//! A.\n{skipped}]\n"), "2: `#[ign"),
            (
                format!("//! A.\n{}", "a\n".repeat(LONGEST)),
                "601: 601 lines",
            ),
        ] {
            let found = untidy(&text);
            assert_eq!(found.len(), 1, "{text:.40}: {found:?}");
            assert!(found[0].starts_with(finding), "{found:?}");
        }
    }

    #[test]
    fn lines_of_tests_do_not_count() {
        let tests = "a\n".repeat(LONGEST);
        assert_eq!(untidy(&format!("//! A.\n#[cfg(test)]\n{tests}")), [""; 0]);
    }

    #[test]
    fn own_files_are_tidy() {
        let root = workspace::root();
        let own: Vec<_> = workspace::rust_files(&root)
            .unwrap()
            .into_iter()
            .filter(|f| f.starts_with(root.join("crates/xtask")))
            .collect();
        assert!(own.len() > 5, "{own:?}");
        for file in own {
            assert_eq!(
                untidy(&fs::read_to_string(&file).unwrap()),
                [""; 0],
                "{file:?}"
            );
        }
    }
}
