//! `cargo xtask mutants`: faults made by machine in `specula-bsdf`, and whether its tests and those of `specula-stat` notice.
//!
//! cargo-mutants lists some 8000 faults: an operator for another, a constant for a function's value. A sample of them is
//! built and tested one by one, in a copy of the workspace. What survives is equivalent, or a test is missing.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};

use crate::{Result, workspace};

/// Version of cargo-mutants.
const VERSION: &str = "27.1.0";

/// Programs of tests, in the order in which they are tried: each stage has what the one before lets pass. The first
/// compiles in a fifth of the time of all. The longest statistical ones are left out.
const STAGES: [&[&str]; 5] = [
    &["extremes", "known_values", "tints", "values_of_mitsuba"],
    &[
        "awkward_directions",
        "coats_of_pbrt",
        "lobes",
        "no_panics",
        "visible_normals",
    ],
    &["batch", "batch_accuracy", "batch_multibounce"],
    &["colours", "every_lobe"],
    &["energy", "gltf", "layered", "multibounce", "principled"],
];

/// Where these are.
const PACKAGES: [&str; 2] = ["specula-bsdf", "specula-stat"];

/// Which faults to try.
#[derive(clap::Args)]
pub(crate) struct Sample {
    /// About so many; 100 take some hours on two cores that do nothing else
    #[arg(long, default_value_t = 100)]
    count: usize,
    /// Chooses them: the next seed takes the next ones of the list
    #[arg(long, default_value_t = 1)]
    seed: usize,
    /// Of these files only: a glob, such as '**/vndf/*.rs'
    #[arg(long, value_name = "GLOB")]
    file: Vec<String>,
    /// Where the reports are written, in a folder for each stage
    #[arg(long, value_name = "DIR", default_value = "target/mutants-report")]
    output: PathBuf,
}

/// Tries the sample, and prints which share is caught.
pub(crate) fn run(root: &Path, sample: &Sample) -> Result<()> {
    let program = installed(root)?;
    let mut list = command(root, &program, sample);
    let list = list.arg("--list").output()?;
    if !list.status.success() {
        return Err(String::from_utf8_lossy(&list.stderr).into());
    }
    let all = String::from_utf8_lossy(&list.stdout).lines().count();
    let (shard, shards) = shard(all, sample)?;
    test_without_faults(root)?;
    println!("every {shards}th of {all} faults, from the {shard}th on");
    let mut caught = 0;
    let mut missed: Vec<String> = Vec::new();
    for stage in 0..STAGES.len() {
        let mut mutants = command(root, &program, sample);
        if stage == 0 {
            mutants.args(["--sharding", "round-robin", "--shard"]);
            mutants.arg(format!("{shard}/{shards}"));
        }
        for fault in &missed {
            mutants.arg("--re").arg(exactly(fault));
        }
        let output = sample.output.join(format!("stage-{}", stage + 1));
        std::fs::create_dir_all(&output)?;
        verdict(arguments(&mut mutants, stage, &output).status()?)?;
        let lines = |name: &str| -> Vec<String> {
            let text = std::fs::read_to_string(output.join("mutants.out").join(name));
            let text = text.unwrap_or_default();
            text.lines().map(str::to_owned).collect()
        };
        caught += lines("caught.txt").len() + lines("timeout.txt").len();
        missed = lines("missed.txt");
        if missed.is_empty() {
            break;
        }
    }
    let viable = caught + missed.len();
    println!("{caught} of {viable} faults that compile are caught");
    for fault in missed {
        println!("survives: {fault}");
    }
    Ok(())
}

/// How a stage tests faults, and where it writes its report.
fn arguments<'a>(mutants: &'a mut Command, stage: usize, output: &Path) -> &'a mut Command {
    mutants.args(["--profile", "mutants", "--cap-lints", "true"]);
    // The first build compiles all; a fault that never ends is caught by time.
    mutants.args(["--build-timeout", "900", "--timeout", "240"]);
    mutants.arg("--output").arg(output);
    for package in PACKAGES {
        mutants.args(["--test-package", package]);
    }
    // It would test the code without faults in the package alone that is to have them, which lacks most programs.
    mutants.args(["--baseline", "skip", "--"]);
    mutants.args(tests(stage))
}

/// A regular expression of one line of the list.
fn exactly(fault: &str) -> String {
    let mut expression = String::from("^");
    for character in fault.chars() {
        if r"\.+*?()|[]{}^$".contains(character) {
            expression.push('\\');
        }
        expression.push(character);
    }
    expression.push('$');
    expression
}

fn test_without_faults(root: &Path) -> Result<()> {
    println!("the code without faults");
    let mut cargo = workspace::cargo(root);
    cargo.args(["test", "--quiet", "--profile", "mutants"]);
    for package in PACKAGES {
        cargo.args(["--package", package]);
    }
    for stage in 0..STAGES.len() {
        cargo.args(tests(stage));
    }
    match cargo.status()?.success() {
        true => Ok(()),
        false => Err("tests fail without faults".into()),
    }
}

/// Which tests a stage runs, as arguments of `cargo test`.
fn tests(stage: usize) -> Vec<&'static str> {
    // Unit tests are compiled with the whole crate once more.
    let library = (stage == 2).then_some("--lib");
    let programs = STAGES[stage].iter().flat_map(|&test| ["--test", test]);
    library.into_iter().chain(programs).collect()
}

/// Which part of how many is the sample.
fn shard(all: usize, sample: &Sample) -> Result<(usize, usize)> {
    if all == 0 || sample.count == 0 {
        return Err("no faults to try".into());
    }
    let shards = (all / sample.count).max(1);
    Ok((sample.seed % shards, shards))
}

/// Faults that survive are a result, not a failure.
fn verdict(status: ExitStatus) -> Result<()> {
    const SURVIVORS: i32 = 2;
    const TIMEOUTS: i32 = 3;
    match status.code() {
        Some(0 | SURVIVORS | TIMEOUTS) => Ok(()),
        _ => Err(format!("cargo-mutants ended with {status}").into()),
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

    fn sample(count: usize, seed: usize) -> Sample {
        Sample {
            count,
            seed,
            file: Vec::new(),
            output: PathBuf::new(),
        }
    }

    #[test]
    fn seeds_take_other_parts() {
        assert_eq!(shard(8000, &sample(40, 1)).unwrap(), (1, 200));
        assert_eq!(shard(8000, &sample(40, 203)).unwrap(), (3, 200));
        assert_eq!(shard(10, &sample(40, 7)).unwrap(), (0, 1));
        assert!(shard(0, &sample(40, 1)).is_err());
        assert!(shard(10, &sample(0, 1)).is_err());
    }

    #[test]
    fn a_fault_is_found_by_its_line() {
        let expression = exactly("src/a.rs:2:9: replace + with -");
        assert_eq!(expression, r"^src/a\.rs:2:9: replace \+ with -$");
    }

    #[test]
    fn every_program_of_tests_exists() {
        let root = workspace::root();
        for test in STAGES.concat() {
            let file = |package: &str| root.join(format!("crates/{package}/tests/{test}.rs"));
            assert!(
                file("specula-bsdf").exists() || file("specula-stat").exists(),
                "{test}"
            );
        }
    }
}
