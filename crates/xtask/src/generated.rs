//! Generated files: written, or compared with what is committed.

use std::fs;
use std::path::Path;

use crate::Result;

/// A file that a generator makes.
pub(crate) struct Generated {
    /// Where it belongs, from the workspace's root.
    pub(crate) path: &'static str,
    /// Its whole text.
    pub(crate) text: String,
}

/// Writes the files, or with `check` fails where a committed one differs.
pub(crate) fn apply(root: &Path, files: &[Generated], check: bool) -> Result<()> {
    if check {
        return match differences(root, files) {
            summary if summary.is_empty() => {
                println!("{} generated files are up to date", files.len());
                Ok(())
            }
            summary => Err(summary.into()),
        };
    }
    for file in files {
        let path = root.join(file.path);
        if fs::read_to_string(&path).is_ok_and(|old| old == file.text) {
            println!("{}: unchanged", file.path);
        } else {
            fs::write(&path, &file.text).map_err(|e| format!("{}: {e}", file.path))?;
            println!("{}: written", file.path);
        }
    }
    Ok(())
}

/// A summary of where the committed files differ from the generated ones; empty if nowhere.
pub(crate) fn differences(root: &Path, files: &[Generated]) -> String {
    let mut summary = String::new();
    for file in files {
        match fs::read_to_string(root.join(file.path)) {
            Ok(committed) if committed == file.text => {}
            Ok(committed) => summary += &difference(file.path, &committed, &file.text),
            Err(e) => summary += &format!("{}: {e}\n", file.path),
        }
    }
    if !summary.is_empty() {
        summary += "run `cargo xtask tables` and commit the result\n";
    }
    summary
}

/// The number of differing lines, and the first three of them.
fn difference(path: &str, committed: &str, generated: &str) -> String {
    let (old, new): (Vec<_>, Vec<_>) = (committed.lines().collect(), generated.lines().collect());
    let line = |lines: &[&str], i: usize| (*lines.get(i).unwrap_or(&"(no line)")).to_owned();
    let differing: Vec<usize> = (0..old.len().max(new.len()))
        .filter(|&i| old.get(i) != new.get(i))
        .collect();
    let mut summary = format!("{path}: {} lines differ\n", differing.len());
    for &i in differing.iter().take(3) {
        summary += &format!(
            "  line {}\n    committed: {}\n    generated: {}\n",
            i + 1,
            line(&old, i),
            line(&new, i)
        );
    }
    summary
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_named_by_line() {
        let summary = difference("table.rs", "a\nb\nc\n", "a\nB\nc\nd\n");
        assert!(
            summary.starts_with("table.rs: 2 lines differ\n"),
            "{summary}"
        );
        assert!(
            summary.contains("line 2\n    committed: b\n    generated: B\n"),
            "{summary}"
        );
        assert!(
            summary.contains("line 4\n    committed: (no line)\n"),
            "{summary}"
        );
    }

    #[test]
    fn a_missing_file_is_a_difference() {
        let file = Generated {
            path: "no/such/file",
            text: String::new(),
        };
        let summary = differences(Path::new("."), &[file]);
        assert!(summary.starts_with("no/such/file: "), "{summary}");
    }
}
