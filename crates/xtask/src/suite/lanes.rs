//! Chores that run beside each other, and beside tests: tests of Python wait for a farm, those of the studio for a
//! browser, lints for one crate after the other.

use std::fs::{self, File};
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::time::Instant;

use super::deadline::Deadline;
use super::{Report, programs};
use crate::Result;

/// Arguments of `cargo xtask`; the chores of a lane run one after the other.
const LANES: [&[&[&str]]; 2] = [
    &[&["python"], &["book"]],
    &[
        &["studio"],
        &["instructions", "--check"],
        &["tables", "--check"],
    ],
];

/// Runs every chore, even after one has failed, and prints what each printed when it has ended.
///
/// * `skips`: the file to which tests append a line for each skip.
pub(super) fn run(
    root: &Path,
    skips: &Path,
    deadline: &Deadline,
    report: &mut Report,
) -> Result<()> {
    let folder = root.join("target");
    let program = std::env::current_exe()?;
    let command = |chore: &[&str]| of_this_program(&program, skips, chore);
    let admits = |chore: &[&str]| deadline.admits_chore(&chore.join(" "));
    beside_each_other(&LANES, &folder, (&admits, &command), report);
    Ok(())
}

/// What a chore printed and how it ended, or why it did not run.
type Outcome = std::result::Result<(Vec<u8>, ExitStatus), String>;

/// A chore's name, how it ended, and its seconds.
pub(super) type Ended = (String, Outcome, f64);

/// Runs one chore of this program.
pub(super) fn chore(root: &Path, skips: &Path, chore: &[&str]) -> Ended {
    let start = Instant::now();
    let log = root.join(format!("target/chore-{}.log", chore.join("-")));
    let outcome = std::env::current_exe()
        .map_err(Into::into)
        .and_then(|program| logged(&mut of_this_program(&program, skips, chore), &log))
        .map_err(|error| error.to_string());
    (chore.join(" "), outcome, start.elapsed().as_secs_f64())
}

fn of_this_program(program: &Path, skips: &Path, chore: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(chore).env(specula_testing::FILE, skips);
    command
}

/// Whether a chore may begin still.
type Admits<'a> = &'a (dyn Fn(&[&str]) -> bool + Sync);
/// The command of a chore.
type Commands<'a> = &'a (dyn Fn(&[&str]) -> Command + Sync);

fn beside_each_other(
    lanes: &[&[&[&str]]],
    folder: &Path,
    (admits, command): (Admits<'_>, Commands<'_>),
    report: &mut Report,
) {
    let report = Mutex::new(report);
    std::thread::scope(|scope| {
        for (i, lane) in lanes.iter().enumerate() {
            let report = &report;
            scope.spawn(move || {
                for chore in lane.iter().filter(|chore| admits(chore)) {
                    let start = Instant::now();
                    let log = folder.join(format!("chore-{i}.log"));
                    let outcome = logged(&mut command(chore), &log).map_err(|e| e.to_string());
                    let seconds = start.elapsed().as_secs_f64();
                    programs::lock(report).chore((chore.join(" "), outcome, seconds));
                }
            });
        }
    });
}

/// What a chore printed, by way of a file: programs that it leaves behind would keep a pipe open.
fn logged(command: &mut Command, log: &Path) -> programs::Outcome {
    let file = File::create(log)?;
    command.stdin(Stdio::null());
    command.stdout(file.try_clone()?).stderr(file);
    let status = command.status()?;
    Ok((fs::read(log)?, status))
}

/// Prints a chore's output; whether it passed.
pub(super) fn told(name: &str, outcome: Outcome) -> bool {
    println!("== {name}");
    match outcome {
        Ok((printed, status)) => {
            let _ = std::io::stdout().write_all(&printed);
            if !status.success() {
                println!("`cargo xtask {name}` failed: {status}");
            }
            status.success()
        }
        Err(error) => {
            println!("`cargo xtask {name}` did not run: {error}");
            false
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[cfg(unix)]
    fn every_chore_runs_and_those_that_fail_are_named() {
        let lanes: [&[&[&str]]; 2] = [
            &[&["exit 3"], &["exit 0"]],
            &[&["left out"], &["echo there"]],
        ];
        let command = |chore: &[&str]| {
            let mut command = Command::new("sh");
            command.arg("-c").args(chore);
            command
        };
        let mut report = Report::default();
        let folder = std::env::temp_dir().join(format!("specula-lanes-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let admits = |chore: &[&str]| chore != ["left out"];
        beside_each_other(&lanes, &folder, (&admits, &command), &mut report);
        assert_eq!(fs::read(folder.join("chore-1.log")).unwrap(), b"there\n");
        fs::remove_dir_all(folder).unwrap();
        report.lines.sort();
        let verdicts: Vec<_> = report.lines.iter().map(|l| l.contains("FAILED")).collect();
        assert_eq!(verdicts, [false, false, true], "{:?}", report.lines);
        assert!(report.lines[2].starts_with("exit 3"));
        assert!(report.finish().is_err());
    }
}
