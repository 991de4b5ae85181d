//! `cargo xtask instructions`: how many instructions the kernels take, counted under valgrind and
//! compared with the recorded ones. A count, unlike a time, is the same on a loaded machine.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{Result, workspace};

/// The recorded counts, from the workspace's root.
const RECORDED: &str = "crates/specula-bsdf/benches/instructions.txt";

/// Largest difference from a recorded count, as a share of it.
const TOLERANCE: f64 = 0.05;

/// Kernels of `benches/instructions.rs`, and the levels to count each at.
const KERNELS: &[(&str, &[&str])] = &[
    ("heitz", &["scalar", "baseline", "avx2"]),
    ("cap", &["scalar", "baseline", "avx2"]),
    ("bounded", &["scalar", "baseline", "avx2"]),
    ("pdf", &["scalar", "baseline", "avx2"]),
    ("gold", &["scalar", "baseline", "avx2"]),
    ("gold-eval", &["scalar", "baseline", "avx2"]),
    ("exact", &["scalar", "baseline", "avx2"]),
    ("exact-unequal", &["scalar", "baseline", "avx2"]),
    ("brushed", &["baseline", "avx2"]),
    ("exact-eval", &["avx2"]),
    ("glass", &["scalar", "avx2"]),
    ("glass-eval", &["scalar", "baseline", "avx2"]),
    ("glass-pdf", &["avx2"]),
    ("mirror", &["scalar", "avx2"]),
    ("eon", &["scalar", "avx2"]),
    ("eon-eval", &["scalar", "baseline", "avx2"]),
    ("coated-diffuse", &["scalar", "avx2"]),
    ("coated-diffuse-eval", &["avx2"]),
    ("gltf", &["scalar", "avx2"]),
    ("gltf-eval", &["scalar", "avx2"]),
    ("principled", &["scalar", "avx2"]),
    ("principled-eval", &["scalar", "avx2"]),
    ("beckmann", &["scalar", "avx2"]),
    ("beckmann-eval", &["scalar", "avx2"]),
    ("turquin", &["avx2"]),
    ("turquin-eval", &["scalar", "avx2"]),
    ("bounces", &["scalar", "avx2"]),
    ("bounces-eval", &["scalar", "avx2"]),
];

/// Instructions per element of one kernel at one level.
#[derive(Clone, Debug, PartialEq)]
struct Count {
    kernel: String,
    level: String,
    instructions: f64,
}

/// Counts, and writes the file or, with `check`, compares with it. Without valgrind, or with another
/// compiler than the recorded counts are of, it says so and passes.
pub(crate) fn run(root: &Path, check: bool) -> Result<()> {
    if Command::new("valgrind").arg("--version").output().is_err() {
        let remedy = "apt-get install valgrind";
        specula_testing::skip("instruction counts", "no valgrind", remedy);
        return Ok(());
    }
    let compiler = compiler()?;
    let recorded = fs::read_to_string(root.join(RECORDED)).unwrap_or_default();
    if check && header(&recorded) != Some(&compiler) {
        let why = format!("{RECORDED} is of another compiler or machine than {compiler}");
        specula_testing::skip("instruction counts", why, "cargo xtask instructions");
        return Ok(());
    }
    let program = build(root)?;
    let mut counts = Vec::new();
    for &(kernel, levels) in KERNELS {
        for &level in levels {
            if let Some(count) = count(&program, kernel, level)? {
                counts.push(count);
            }
        }
    }
    if check {
        return compare(&parse(&recorded)?, &counts);
    }
    fs::write(root.join(RECORDED), text(&compiler, &counts))?;
    println!("{RECORDED}: {} counts written", counts.len());
    Ok(())
}

/// The compiler and what it compiles for: counts of others do not compare.
fn compiler() -> Result<String> {
    let output = Command::new("rustc").arg("--version").output()?;
    let version = String::from_utf8_lossy(&output.stdout);
    let version = version.split_whitespace().take(2).collect::<Vec<_>>();
    Ok(format!("{} {}", version.join(" "), std::env::consts::ARCH))
}

/// Builds the program that runs the kernels, and returns its path.
fn build(root: &Path) -> Result<PathBuf> {
    let mut command = workspace::cargo(root);
    command.args([
        "bench",
        "--package",
        "specula-bsdf",
        "--bench",
        "instructions",
    ]);
    command.args(["--no-run", "--quiet", "--message-format", "json"]);
    let output = command.output()?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    executable(&String::from_utf8_lossy(&output.stdout))
        .ok_or_else(|| "cargo named no executable".into())
}

/// The executable among cargo's messages.
fn executable(messages: &str) -> Option<PathBuf> {
    let key = "\"executable\":\"";
    messages.lines().rev().find_map(|line| {
        let (_, rest) = line.split_once(key)?;
        Some(PathBuf::from(rest.split_once('"')?.0))
    })
}

/// Instructions per element; `None` where this machine lacks the level.
fn count(program: &Path, kernel: &str, level: &str) -> Result<Option<Count>> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg("--toggle-collect=instructions::counted*")
        .arg(program)
        .args([kernel, level])
        .output()?;
    let elements = String::from_utf8_lossy(&output.stdout);
    let Ok(elements) = elements.trim().parse::<f64>() else {
        if level == "avx2" {
            specula_testing::not_of_this_machine(kernel, format_args!("no {level}"));
            return Ok(None);
        }
        return Err(format!("{kernel} at {level} did not run").into());
    };
    let report = String::from_utf8_lossy(&output.stderr);
    let collected = collected(&report).ok_or_else(|| format!("valgrind said\n{report}"))?;
    Ok(Some(Count {
        kernel: kernel.to_owned(),
        level: level.to_owned(),
        instructions: collected / elements,
    }))
}

/// The count in what callgrind reports.
fn collected(report: &str) -> Option<f64> {
    let (_, rest) = report.split_once("Collected :")?;
    rest.split_whitespace().next()?.parse().ok()
}

fn text(compiler: &str, counts: &[Count]) -> String {
    let mut text = format!("# {compiler}\n# kernel level instructions-per-element\n");
    for c in counts {
        let _ = writeln!(text, "{} {} {:.1}", c.kernel, c.level, c.instructions);
    }
    text
}

fn header(text: &str) -> Option<&str> {
    text.lines().next()?.strip_prefix("# ")
}

fn parse(text: &str) -> Result<Vec<Count>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines
        .map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
            [kernel, level, count] => Ok(Count {
                kernel: kernel.to_owned(),
                level: level.to_owned(),
                instructions: count.parse()?,
            }),
            _ => Err(format!("{RECORDED}: not a kernel, a level and a count: {line}").into()),
        })
        .collect()
}

/// Fails with every count that is off by more than the tolerance, or not recorded.
fn compare(recorded: &[Count], counts: &[Count]) -> Result<()> {
    let mut off = String::new();
    for c in counts {
        let old = recorded
            .iter()
            .find(|k| (&k.kernel, &k.level) == (&c.kernel, &c.level))
            .map_or(f64::NAN, |k| k.instructions);
        let change = c.instructions / old - 1.0;
        println!(
            "{:<20} {:<9} {:>8.1} {:>+7.1} %",
            c.kernel,
            c.level,
            c.instructions,
            100.0 * change
        );
        // A count that is not recorded is NaN, and off.
        let close = change.abs() <= TOLERANCE;
        if !close {
            let _ = writeln!(
                off,
                "{} at {}: {:.1} instructions per element, recorded {old:.1}",
                c.kernel, c.level, c.instructions
            );
        }
    }
    match off.is_empty() {
        true => Ok(()),
        false => Err(format!("{off}if that is meant, run `cargo xtask instructions`").into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(instructions: f64) -> Vec<Count> {
        vec![Count {
            kernel: "cap".to_owned(),
            level: "avx2".to_owned(),
            instructions,
        }]
    }

    #[test]
    fn five_per_cent_pass_and_more_fails_in_both_directions() {
        assert!(compare(&one(100.0), &one(104.9)).is_ok());
        assert!(compare(&one(100.0), &one(95.1)).is_ok());
        for off in [105.2, 94.8] {
            let message = compare(&one(100.0), &one(off)).unwrap_err().to_string();
            assert!(message.starts_with("cap at avx2: "), "{message}");
        }
        assert!(compare(&[], &one(1.0)).is_err());
    }

    #[test]
    fn what_is_written_is_read() {
        let written = text("rustc 1.95.0 x86_64", &one(12.3));
        assert_eq!(header(&written), Some("rustc 1.95.0 x86_64"));
        assert_eq!(parse(&written).unwrap(), one(12.3));
        assert!(parse("cap avx2\n").is_err());
    }

    #[test]
    fn reports_are_understood() {
        let report = "==1== Events    : Ir\n==1== Collected : 6124\n==1==\n";
        assert_eq!(collected(report), Some(6124.0));
        assert_eq!(collected("==1== killed"), None);
        let messages = "{\"executable\":null}\n{\"executable\":\"/a/b-1\",\"fresh\":true}\n{}\n";
        assert_eq!(executable(messages), Some(PathBuf::from("/a/b-1")));
    }
}
