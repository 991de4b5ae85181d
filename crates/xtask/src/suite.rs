//! `cargo xtask test`: everything that must pass before a change is kept.

use std::path::Path;
use std::time::Instant;

use crate::{Result, instructions, tables, tidy, workspace};

/// A cargo command.
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
            "--quiet",
            "--",
            "-D",
            "warnings",
        ],
        environment: None,
    },
    Step {
        name: "documentation",
        arguments: &["doc", "--workspace", "--no-deps", "--quiet"],
        environment: Some(("RUSTDOCFLAGS", "-D warnings")),
    },
    Step {
        // The examples in the documentation are among them.
        name: "tests",
        arguments: &["test", "--workspace", "--quiet", "--no-fail-fast"],
        environment: None,
    },
];

/// Runs every step, even after one has failed, and prints each with its time.
pub(crate) fn run(root: &Path) -> Result<()> {
    let mut report = Report::default();
    for step in CARGO_STEPS {
        report.step(step.name, || {
            let mut command = workspace::cargo(root);
            command.args(step.arguments).envs(step.environment);
            match command.status()?.success() {
                true => Ok(()),
                false => Err(format!("`cargo {}` failed", step.arguments.join(" ")).into()),
            }
        });
    }
    report.step("tables", || tables::run(root, true));
    report.step("instructions", || instructions::run(root, true));
    report.step("tidy", || tidy::run(root));
    report.finish()
}

/// What ran, how long, and what failed.
#[derive(Default)]
struct Report {
    lines: Vec<String>,
    failed: usize,
}

impl Report {
    fn step(&mut self, name: &str, run: impl FnOnce() -> Result<()>) {
        println!("== {name}");
        let start = Instant::now();
        let outcome = run();
        if let Err(error) = &outcome {
            println!("{error}");
            self.failed += 1;
        }
        let verdict = if outcome.is_ok() { "ok" } else { "FAILED" };
        let seconds = start.elapsed().as_secs_f64();
        self.lines
            .push(format!("{name:<14} {verdict:<6} {seconds:8.1} s"));
    }

    fn finish(self) -> Result<()> {
        println!("== summary\n{}", self.lines.join("\n"));
        match self.failed {
            0 => Ok(()),
            n => Err(format!("{n} of {} steps failed", self.lines.len()).into()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_failure_fails_the_whole_and_the_rest_still_runs() {
        let mut report = Report::default();
        let mut ran = 0;
        report.step("first", || Err("no".into()));
        report.step("second", || {
            ran += 1;
            Ok(())
        });
        assert_eq!(ran, 1);
        assert!(report.lines[0].starts_with("first          FAILED"));
        assert!(report.lines[1].starts_with("second         ok"));
        let message = report.finish().unwrap_err().to_string();
        assert_eq!(message, "1 of 2 steps failed");
        assert!(Report::default().finish().is_ok());
    }
}
