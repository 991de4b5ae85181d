//! `cargo xtask features`: every set of features that users choose compiles.

use std::path::Path;
use std::time::Instant;

use crate::{Result, workspace};

/// Packages with the sets of features that are checked, beside the default and all, which tests and lints compile.
const SETS: &[(&str, &[&str])] = &[
    (
        "specula-bsdf",
        &["", "std", "glam", "mint", "serde", "glam,mint,serde"],
    ),
    ("specula-scene", &[""]),
    ("specula-gpu", &["", "device"]),
    (
        "specula",
        &[
            "",
            "gpu",
            "lab",
            "shaders",
            "cli",
            "cli,gpu",
            "cli,lab",
            "cli,shaders",
            "cli,studio",
            "studio",
        ],
    ),
    ("specula-studio-server", &["", "lab"]),
];

/// Those that the tests check: the library without features, and the program with few.
const IN_TESTS: [(&str, &str); 2] = [("specula-bsdf", ""), ("specula", "cli")];

/// Which sets are checked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Which {
    All,
    InTests,
}

/// Checks each set, warnings as errors; fails with those that do not compile.
pub(crate) fn run(root: &Path, which: Which) -> Result<()> {
    let mut failed = Vec::new();
    let mut count = 0;
    for (package, sets) in SETS {
        for set in *sets {
            if which == Which::InTests && !IN_TESTS.contains(&(*package, *set)) {
                continue;
            }
            let mut check = workspace::cargo(root);
            check.args(["clippy", "--quiet", "--package", package]);
            check.args(["--no-default-features", "--features", set]);
            check.args(["--", "-D", "warnings"]);
            count += 1;
            let name = format!("{package} with features `{set}`");
            let begin = Instant::now();
            let is_fine = check.status()?.success();
            let took = begin.elapsed().as_secs_f64();
            println!("{name}: {took:.1} s");
            if !is_fine {
                failed.push(name);
            }
        }
    }
    match failed.as_slice() {
        [] => {
            println!("{count} sets of features compile");
            Ok(())
        }
        failed => Err(format!("these do not compile:\n{}", failed.join("\n")).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sets_of_the_tests_are_in_the_list() {
        for (package, set) in IN_TESTS {
            let listed = SETS
                .iter()
                .any(|(p, sets)| *p == package && sets.contains(&set));
            assert!(listed, "{package}: {set}");
        }
    }

    #[test]
    fn every_feature_of_a_manifest_is_in_a_set() {
        let root = workspace::root();
        for (package, sets) in SETS {
            let manifest = root.join(format!("crates/{package}/Cargo.toml"));
            let manifest = std::fs::read_to_string(manifest).unwrap();
            let (_, features) = manifest.split_once("[features]\n").unwrap();
            let features = features.split("\n[").next().unwrap();
            for line in features.lines().filter(|l| !l.starts_with([' ', '#', ']'])) {
                let Some((name, _)) = line.split_once(" = ") else {
                    continue;
                };
                // Tests and lints compile with these; Open Image Denoise must be installed for its own.
                let elsewhere = ["default", "full", "tev", "miette", "oidn"].contains(&name);
                let in_a_set = sets.iter().any(|set| set.split(',').any(|f| f == name));
                assert!(elsewhere || in_a_set, "{package}: {name}");
            }
        }
    }
}
