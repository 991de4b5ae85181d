//! `cargo xtask mutants`: faults made by machine in `specula-bsdf`, and whether its tests and those of `specula-stat` notice.
//!
//! cargo-mutants lists some 8000 faults: an operator for another, a constant for a function's value. A sample of them is
//! planted one by one in a copy of the workspace, and programs of tests run, those first that are likeliest to see it,
//! until one fails. What survives is equivalent, or a test is missing.

mod fault;
mod programs;

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::{Result, workspace};
use fault::Fault;
use programs::{PACKAGES, ordered};

/// Version of cargo-mutants.
const VERSION: &str = "27.1.0";
/// Longest that a program of tests may take: several times what the longest one does.
const LONGEST: Duration = Duration::from_secs(900);

/// Which faults to try.
#[derive(clap::Args)]
pub(crate) struct Sample {
    /// About so many; 50 take an hour on two cores that do nothing else
    #[arg(long, default_value_t = 50)]
    count: usize,
    /// Chooses them: the next seed takes the next ones of the list
    #[arg(long, default_value_t = 1)]
    seed: usize,
    /// Of these files only: a glob, such as '**/vndf/*.rs'
    #[arg(long, value_name = "GLOB")]
    file: Vec<String>,
    /// File that a line is added to for each fault; faults that have a line there are not tried again
    #[arg(long, value_name = "FILE", default_value = "target/mutants-report.txt")]
    output: PathBuf,
}

/// What became of a fault.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Outcome {
    /// It does not compile.
    Unviable,
    /// The name of the program that failed, or did not end.
    Caught(String),
    Survives,
}

impl Outcome {
    fn text(&self) -> String {
        match self {
            Self::Unviable => "unviable".to_owned(),
            Self::Caught(by) => format!("caught by {by}"),
            Self::Survives => "survives".to_owned(),
        }
    }

    /// The outcome and the fault's name of a line of the report.
    fn parse(line: &str) -> Option<(Self, &str)> {
        let (outcome, name) = line.split_once(": ")?;
        let outcome = match outcome {
            "unviable" => Self::Unviable,
            "survives" => Self::Survives,
            other => Self::Caught(other.strip_prefix("caught by ")?.to_owned()),
        };
        Some((outcome, name))
    }
}

/// Tries the sample, and prints which share is caught.
pub(crate) fn run(root: &Path, sample: &Sample) -> Result<()> {
    let program = installed(root)?;
    let all = fault::list(&mut command(root, &program, sample))?;
    let faults = chosen(&all, sample)?;
    println!("{} of {} faults", faults.len(), all.len());
    let copy = Copy::new(root)?;
    let before = fs::read_to_string(&sample.output).unwrap_or_default();
    let mut outcomes: Vec<(Outcome, &str)> = Vec::new();
    for fault in faults {
        let mut known = before.lines().filter_map(Outcome::parse);
        let known = known.rfind(|(_, name)| *name == fault.name);
        let outcome = match known {
            Some((outcome, _)) => outcome,
            None => {
                let start = Instant::now();
                let outcome = copy.try_fault(fault)?;
                let line = format!("{}: {}\n", outcome.text(), fault.name);
                print!("{:4.0} s  {line}", start.elapsed().as_secs_f64());
                let mut report = fs::File::options();
                let report = report.create(true).append(true);
                report.open(&sample.output)?.write_all(line.as_bytes())?;
                outcome
            }
        };
        outcomes.push((outcome, &fault.name));
    }
    print!("{}", summary(&outcomes));
    Ok(())
}

fn summary(outcomes: &[(Outcome, &str)]) -> String {
    let count = |is: fn(&Outcome) -> bool| outcomes.iter().filter(|(o, _)| is(o)).count();
    let caught = count(|o| matches!(o, Outcome::Caught(_)));
    let viable = count(|o| *o != Outcome::Unviable);
    let mut text = format!("{caught} of {viable} faults that compile are caught\n");
    for (outcome, name) in outcomes {
        if *outcome == Outcome::Survives {
            text += &format!("survives: {name}\n");
        }
    }
    text
}

/// Every so many-th fault.
fn chosen<'a>(all: &'a [Fault], sample: &Sample) -> Result<Vec<&'a Fault>> {
    if all.is_empty() || sample.count == 0 {
        return Err("no faults to try".into());
    }
    let step = (all.len() / sample.count).max(1);
    let first = sample.seed % step;
    Ok(all.iter().skip(first).step_by(step).collect())
}

/// A copy of the workspace, in which faults are planted.
struct Copy {
    root: PathBuf,
    target: PathBuf,
}

impl Copy {
    fn new(root: &Path) -> Result<Self> {
        let target = root.join("target");
        let copy = target.join("mutants-copy");
        let files = Command::new("git")
            .current_dir(root)
            .args(["ls-files", "-z"])
            .output()?;
        for file in String::from_utf8(files.stdout)?.split_terminator('\0') {
            let (from, to) = (root.join(file), copy.join(file));
            if !from.is_file() {
                continue;
            }
            // Files that are as they were keep their time, so that nothing is compiled again.
            let text = fs::read(&from)?;
            if fs::read(&to).is_ok_and(|old| old == text) {
                continue;
            }
            fs::create_dir_all(to.parent().unwrap_or(&copy))?;
            fs::write(&to, text)?;
        }
        Ok(Self { root: copy, target })
    }

    /// Plants a fault, runs tests until some fail, and takes the fault out again.
    fn try_fault(&self, fault: &Fault) -> Result<Outcome> {
        let file = self.root.join(&fault.file);
        let right = fs::read_to_string(&file)?;
        fs::write(&file, fault.planted(&right)?)?;
        let outcome = self.outcome(fault);
        fs::write(&file, right)?;
        outcome
    }

    fn outcome(&self, fault: &Fault) -> Result<Outcome> {
        for (place, program) in ordered(&fault.file).into_iter().enumerate() {
            let arguments: &[&str] = match program {
                programs::UNIT_TESTS => &["--lib"],
                program => &["--test", program],
            };
            let compiled = self.cargo().args(arguments).arg("--no-run").output()?;
            if !compiled.status.success() {
                return match place {
                    0 => Ok(Outcome::Unviable),
                    // The library compiles: it is its unit tests that do not.
                    _ => Ok(Outcome::Caught(program.to_owned())),
                };
            }
            if !self.passes(arguments)? {
                return Ok(Outcome::Caught(program.to_owned()));
            }
        }
        Ok(Outcome::Survives)
    }

    fn cargo(&self) -> Command {
        let mut cargo = workspace::cargo(&self.root);
        cargo.args(["test", "--quiet", "--profile", "mutants", "--target-dir"]);
        cargo.arg(&self.target);
        for package in PACKAGES {
            cargo.args(["--package", package]);
        }
        cargo
    }

    /// Whether tests pass, and in time.
    fn passes(&self, arguments: &[&str]) -> Result<bool> {
        let mut child = self
            .cargo()
            .args(arguments)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()?;
        let start = Instant::now();
        loop {
            if let Some(status) = child.try_wait()? {
                return Ok(status.success());
            }
            if start.elapsed() > LONGEST {
                child.kill()?;
                child.wait()?;
                return Ok(false);
            }
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

fn command(root: &Path, program: &Path, sample: &Sample) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root);
    command.args(["mutants", "--package", "specula-bsdf"]);
    for file in &sample.file {
        command.args(["--file", file]);
    }
    command
}

/// cargo-mutants in `target/mutants-tools`, installed where it is missing.
fn installed(root: &Path) -> Result<PathBuf> {
    let folder = root.join("target/mutants-tools");
    let program = folder.join(format!("bin/cargo-mutants{}", std::env::consts::EXE_SUFFIX));
    let version = Command::new(&program)
        .args(["mutants", "--version"])
        .output();
    let is_right = version.is_ok_and(|v| String::from_utf8_lossy(&v.stdout).contains(VERSION));
    if !is_right {
        let mut install = workspace::install(root, &folder, "cargo-mutants", VERSION);
        if !install.status()?.success() {
            return Err(format!("cargo-mutants {VERSION} could not be installed").into());
        }
    }
    Ok(program)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seeds_take_other_faults() {
        let all: Vec<Fault> = (0..10).map(|i| Fault::named(&i.to_string())).collect();
        let names = |count, seed| {
            let sample = Sample {
                count,
                seed,
                file: Vec::new(),
                output: PathBuf::new(),
            };
            let chosen = chosen(&all, &sample).unwrap();
            let names = chosen.iter().map(|f| f.name.clone());
            names.collect::<Vec<String>>().join(" ")
        };
        assert_eq!(names(5, 0), "0 2 4 6 8");
        assert_eq!(names(5, 3), "1 3 5 7 9");
        assert_eq!(names(40, 7), "0 1 2 3 4 5 6 7 8 9");
    }

    #[test]
    fn lines_are_read_back_and_counted() {
        let outcomes = [
            Outcome::Unviable,
            Outcome::Survives,
            Outcome::Caught("lobes".to_owned()),
            Outcome::Caught("lobes".to_owned()),
        ];
        let name = "src/a.rs:2:9: replace + with -";
        for outcome in &outcomes {
            let line = format!("{}: {name}", outcome.text());
            assert_eq!(Outcome::parse(&line), Some((outcome.clone(), name)));
        }
        let named: Vec<(Outcome, &str)> = outcomes.into_iter().map(|o| (o, name)).collect();
        assert_eq!(
            summary(&named),
            format!("2 of 3 faults that compile are caught\nsurvives: {name}\n")
        );
    }
}
