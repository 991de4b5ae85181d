//! `cargo xtask test`: everything that must pass before a change is kept.

mod deadline;
mod drivers;
mod lanes;
mod programs;
mod skips;
mod times;

use std::path::Path;
use std::time::Instant;

use crate::{Result, tidy};
use deadline::Deadline;

/// How to run the suite.
#[derive(clap::Args)]
pub(crate) struct Suite {
    /// Fail where a test is skipped that could run with more installed
    #[arg(long)]
    strict: bool,
    /// End within about this many minutes: what would begin too late is left out, and named
    #[arg(long, value_name = "N")]
    minutes: Option<u32>,
    /// Since when they count, as seconds since 1970 [default: now]
    #[arg(long, value_name = "SECONDS", requires = "minutes")]
    began: Option<u64>,
}

/// Runs every step, even after one has failed, and prints each with its time.
pub(crate) fn run(root: &Path, suite: &Suite) -> Result<()> {
    let mut report = Report::default();
    let skips = skips::File::new(root)?;
    let deadline = Deadline::new(suite.minutes, suite.began);
    let mut suites = Vec::new();
    // Lints compile one crate after the other much of the time: alone they leave a core idle.
    std::thread::scope(|scope| {
        let lint = scope.spawn(|| lanes::chore(root, skips.path(), &["lint"]));
        report.step("tests", || {
            tests(root, skips.path(), &deadline, &mut suites)
        });
        if let Ok(lint) = lint.join() {
            report.chore(lint);
        }
    });
    lanes::run(root, skips.path(), &deadline, &mut report)?;
    report.step("tidy", || tidy::run(root));
    let skipped = skips.read()?;
    report.step("skips", || skipped.verdict(suite.strict));
    println!("== suites\n{}", times::table(&suites));
    println!("== skipped\n{skipped}");
    print!("{deadline}");
    report.finish()
}

/// Runs the tests, and notes how long each program of tests took.
fn tests(
    root: &Path,
    skips: &Path,
    deadline: &Deadline,
    suites: &mut Vec<times::Suite>,
) -> Result<()> {
    let skips = skips
        .to_str()
        .ok_or("the workspace's path is not Unicode")?;
    let mut environment = vec![(specula_testing::FILE, skips)];
    environment.extend(drivers::variable());
    programs::run(root, &environment, deadline, suites)
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
        }
        self.line(name, outcome.is_ok(), start.elapsed().as_secs_f64());
    }

    /// Prints what a chore printed, and how it ended.
    fn chore(&mut self, (name, outcome, seconds): lanes::Ended) {
        let passed = lanes::told(&name, outcome);
        self.line(&name, passed, seconds);
    }

    fn line(&mut self, name: &str, passed: bool, seconds: f64) {
        let verdict = if passed { "ok" } else { "FAILED" };
        self.failed += usize::from(!passed);
        self.lines
            .push(format!("{name:<20} {verdict:<6} {seconds:8.1} s"));
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
        assert!(report.lines[0].starts_with("first                FAILED"));
        assert!(report.lines[1].starts_with("second               ok"));
        let message = report.finish().unwrap_err().to_string();
        assert_eq!(message, "1 of 2 steps failed");
        assert!(Report::default().finish().is_ok());
    }
}
