//! `cargo xtask lint`: what compilers and formatters check, without running a test.

use std::path::Path;
use std::time::Instant;

use crate::feature_sets::{self, Which};
use crate::{Result, workspace};

/// A command of cargo.
struct Step {
    name: &'static str,
    arguments: &'static [&'static str],
    /// A variable to set and its value.
    environment: Option<(&'static str, &'static str)>,
}

const CARGO_STEPS: &[Step] = &[
    Step {
        name: "format",
        arguments: &["fmt", "--all", "--check"],
        environment: None,
    },
    Step {
        name: "lints",
        arguments: &[
            "clippy",
            "--workspace",
            "--all-targets",
            "--features",
            "specula/full",
            "--quiet",
            "--",
            "-D",
            "warnings",
        ],
        environment: None,
    },
    Step {
        name: "documentation",
        arguments: &[
            "doc",
            "--workspace",
            "--no-deps",
            "--features",
            "specula/full",
            "--quiet",
        ],
        environment: Some(("RUSTDOCFLAGS", "-D warnings")),
    },
];

/// Runs every step, even after one has failed, and prints how long each took.
pub(crate) fn run(root: &Path) -> Result<()> {
    let mut failed = Vec::new();
    for step in CARGO_STEPS {
        let begin = Instant::now();
        let mut command = workspace::cargo(root);
        command.args(step.arguments).envs(step.environment);
        if !command.status()?.success() {
            failed.push(format!("`cargo {}` failed", step.arguments.join(" ")));
        }
        println!("{}: {:.1} s", step.name, begin.elapsed().as_secs_f64());
    }
    let begin = Instant::now();
    if let Err(error) = feature_sets::run(root, Which::InTests) {
        failed.push(error.to_string());
    }
    println!("features: {:.1} s", begin.elapsed().as_secs_f64());
    match failed.as_slice() {
        [] => Ok(()),
        failed => Err(failed.join("\n").into()),
    }
}
