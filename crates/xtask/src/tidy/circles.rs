//! Modules of a crate that import each other in a circle.
//!
//! A module here is a file or folder directly under `src`, with all that it holds: what a folder does inside is
//! its own affair. Tests may import what they like.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::{Result, workspace};

/// Imports of one crate: importing module -> imported module -> files that do it.
type Imports = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

/// Modules in circles that each crate still has; none may have more.
const LEFT: &[(&str, usize)] = &[];

/// One line for each circle of the crates that have more than is [`LEFT`].
pub(super) fn find(root: &Path) -> Result<Vec<String>> {
    let mut crates: BTreeMap<String, Vec<(String, String)>> = BTreeMap::new();
    for path in workspace::rust_files(root)? {
        let name = path.strip_prefix(root.join("crates")).unwrap_or(&path);
        let name = name.to_string_lossy().replace('\\', "/");
        if let Some((package, file)) = name.split_once("/src/") {
            let text = fs::read_to_string(&path).map_err(|e| format!("{name}: {e}"))?;
            let files = crates.entry(package.to_owned()).or_default();
            files.push((file.to_owned(), text));
        }
    }
    let mut lines = Vec::new();
    for (package, files) in &crates {
        let imports = imports(files);
        let circles = circles(&imports);
        let left = LEFT.iter().find(|(name, _)| name == package);
        let left = left.map_or(0, |(_, modules)| *modules);
        if circles.iter().map(BTreeSet::len).sum::<usize>() <= left {
            continue;
        }
        for circle in circles {
            lines.push(format!("{package}: {}", describe(&circle, &imports)));
        }
    }
    Ok(lines)
}

/// The imports between modules of a crate.
///
/// * `files`: names under `src`, with their texts.
fn imports(files: &[(String, String)]) -> Imports {
    let modules: BTreeSet<&str> = files.iter().map(|(file, _)| module_of(file)).collect();
    let root = files.iter().find(|(file, _)| file == "lib.rs");
    let exported = root.map_or_else(BTreeMap::new, |(_, text)| exports(text, &modules));
    let mut imports = Imports::new();
    for (file, text) in files {
        let from = module_of(file);
        if is_root(from) || is_test(file) {
            continue;
        }
        for name in names_at_root(file, &without_tests(text)) {
            let to = modules.get(name.as_str()).copied();
            let to = to.or_else(|| exported.get(&name).map(String::as_str));
            if let Some(to) = to
                && to != from
                && !is_root(to)
            {
                let importers = imports.entry(from.to_owned()).or_default();
                importers
                    .entry(to.to_owned())
                    .or_default()
                    .insert(file.clone());
            }
        }
    }
    imports
}

/// `accel` for `accel/node.rs`, `accel.rs` and `accel/mod.rs`.
fn module_of(file: &str) -> &str {
    let first = file.split('/').next().unwrap_or(file);
    first.strip_suffix(".rs").unwrap_or(first)
}

fn is_root(module: &str) -> bool {
    matches!(module, "lib" | "main")
}

fn is_test(file: &str) -> bool {
    file.ends_with("/tests.rs") || file.contains("/tests/")
}

/// A file without comments and without what follows `#[cfg(test)]` at its end.
fn without_tests(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next();
    let lines = code.unwrap_or(text).lines();
    let lines = lines.map(|line| line.split("//").next().unwrap_or(line));
    lines.collect::<Vec<_>>().join("\n")
}

/// What `lib.rs` re-exports: name -> module.
fn exports(text: &str, modules: &BTreeSet<&str>) -> BTreeMap<String, String> {
    let mut exported = BTreeMap::new();
    for statement in text.split(';') {
        let Some((_, path)) = statement.split_once("use ") else {
            continue;
        };
        let mut words = identifiers(path);
        let first = words.find(|word| !matches!(*word, "crate" | "self"));
        if let Some(module) = first.filter(|word| modules.contains(word)) {
            exported.extend(words.map(|word| (word.to_owned(), module.to_owned())));
        }
    }
    exported
}

fn identifiers(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
}

/// The names that a file takes from its crate's root, by `crate::` or enough of `super::`.
fn names_at_root(file: &str, code: &str) -> BTreeSet<String> {
    let parts = file.split('/').count();
    let depth = parts - usize::from(file.ends_with("mod.rs"));
    let mut names = BTreeSet::new();
    for path in paths(code, "crate::") {
        names.extend(heads(path));
    }
    for path in paths(code, "super::") {
        let mut rest = path;
        let mut ups = 1;
        while let Some(next) = rest.strip_prefix("super::") {
            rest = next;
            ups += 1;
        }
        if ups >= depth {
            names.extend(heads(rest));
        }
    }
    names
}

/// The text after each `prefix` that begins a path.
fn paths<'a>(code: &'a str, prefix: &'a str) -> impl Iterator<Item = &'a str> {
    code.match_indices(prefix).filter_map(move |(at, _)| {
        let before = code[..at].chars().next_back();
        let begins =
            !before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':' || c == '$');
        begins.then(|| &code[at + prefix.len()..])
    })
}

/// The first name of a path, or of each path of a group in braces.
fn heads(path: &str) -> Vec<String> {
    let Some(group) = path.strip_prefix('{') else {
        return identifiers(path).take(1).map(str::to_owned).collect();
    };
    let mut level = 0;
    let mut heads = Vec::new();
    let mut at_head = true;
    let mut name = String::new();
    for c in group.chars() {
        match c {
            '{' => level += 1,
            '}' if level == 0 => break,
            '}' => level -= 1,
            ',' if level == 0 => {
                heads.push(std::mem::take(&mut name));
                at_head = true;
            }
            ':' if level == 0 => at_head = false,
            c if level == 0 && at_head && !c.is_whitespace() => name.push(c),
            _ => {}
        }
    }
    heads.push(name);
    heads.retain(|head| !head.is_empty());
    heads
}

/// The sets of modules that reach each other.
fn circles(imports: &Imports) -> Vec<BTreeSet<String>> {
    let reach: BTreeMap<&str, BTreeSet<&str>> = imports
        .keys()
        .map(|from| (from.as_str(), reachable(from, imports)))
        .collect();
    let mut circles: Vec<BTreeSet<String>> = Vec::new();
    for (from, reached) in &reach {
        if !reached.contains(from) || circles.iter().any(|circle| circle.contains(*from)) {
            continue;
        }
        let back = |to: &&&str| reach.get(**to).is_some_and(|r| r.contains(from));
        circles.push(
            reached
                .iter()
                .filter(back)
                .map(|to| (*to).to_owned())
                .collect(),
        );
    }
    circles
}

fn reachable<'a>(from: &str, imports: &'a Imports) -> BTreeSet<&'a str> {
    let mut reached = BTreeSet::new();
    let mut open: Vec<&str> = vec![from];
    while let Some(module) = open.pop() {
        for to in imports.get(module).into_iter().flat_map(BTreeMap::keys) {
            if reached.insert(to.as_str()) {
                open.push(to);
            }
        }
    }
    reached
}

/// A circle with the files that make it.
fn describe(circle: &BTreeSet<String>, imports: &Imports) -> String {
    let mut edges = Vec::new();
    for (from, targets) in imports.iter().filter(|(from, _)| circle.contains(*from)) {
        for (to, files) in targets.iter().filter(|(to, _)| circle.contains(*to)) {
            let files: Vec<&str> = files.iter().map(String::as_str).collect();
            edges.push(format!("{from} -> {to} ({})", files.join(", ")));
        }
    }
    format!("modules import each other: {}", edges.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let files: Vec<_> = files
            .iter()
            .map(|(file, text)| ((*file).to_owned(), (*text).to_owned()))
            .collect();
        let imports = imports(&files);
        let circles = circles(&imports);
        circles.iter().map(|c| describe(c, &imports)).collect()
    }

    #[test]
    fn a_circle_is_found_with_its_files() {
        let files = [
            ("a/mod.rs", "use crate::b::B;"),
            ("b.rs", "fn f() { crate::c::g() }"),
            ("c/d.rs", "use super::super::a::A;"),
            ("e.rs", "use crate::{a::A, b::{B, C}};"),
        ];
        let found = found(&files);
        assert_eq!(
            found,
            ["modules import each other: a -> b (a/mod.rs); b -> c (b.rs); c -> a (c/d.rs)"]
        );
    }

    #[test]
    fn names_that_the_root_exports_count_for_their_module() {
        let files = [
            (
                "lib.rs",
                "mod a;\nmod b;\npub use a::{A, X};\npub use b::B;",
            ),
            ("a.rs", "use crate::B;"),
            ("b.rs", "use crate::{X};"),
        ];
        assert_eq!(found(&files).len(), 1);
    }

    #[test]
    fn folders_comments_and_tests_are_free() {
        let files = [
            ("a/mod.rs", "mod x;\nuse x::X;\nuse crate::b::B;"),
            ("a/x.rs", "use super::Y;\nuse crate::a::Z;"),
            (
                "b.rs",
                "// crate::a\n#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}",
            ),
            ("b/tests.rs", "use crate::a::A;"),
        ];
        assert_eq!(found(&files), [""; 0]);
    }
}
