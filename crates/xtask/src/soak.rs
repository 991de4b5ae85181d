//! `cargo xtask soak`: a long render whose memory must not grow.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use clap::Args;

use crate::{Result, workspace};

/// Between two readings.
const EVERY: Duration = Duration::from_secs(10);
/// Readings of the first part of a render are not judged: allocators and caches settle.
const SETTLING: Duration = Duration::from_secs(60);
/// Growth that is taken for steady, as a share: an allocator that is handed pictures and films again and
/// again splits its free blocks, and grows by a per cent or two before it finds a fit for all.
const TOLERANCE: f64 = 0.02;
/// The same in mebibytes, for small renders.
const LEAST_GROWTH: f64 = 2.0;
/// Of the peaks, the one that this share are below: with a checkpoint in every third reading, one
/// of a picture's writing.
const PEAKS: f64 = 0.85;

/// What is rendered, and for how long.
#[derive(Args)]
pub(crate) struct Soak {
    /// How long to render
    #[arg(long, value_name = "N", default_value_t = 60)]
    minutes: u64,
    /// A scene instead of the built-in one
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Threads of the render [default: all]
    #[arg(long, value_name = "N")]
    threads: Option<u32>,
    /// Between two checkpoints, as `specula render` takes it
    #[arg(long, value_name = "TIME", default_value = "30s")]
    checkpoint: String,
    /// Specula [default: built from this workspace]
    #[arg(long, value_name = "PROGRAM")]
    specula: Option<PathBuf>,
    /// Where the readings go, as a table of seconds and mebibytes
    #[arg(long, value_name = "FILE", default_value = "target/soak/memory.csv")]
    output: PathBuf,
}

/// Memory of a render at one time, in mebibytes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reading {
    /// Since the start.
    seconds: f64,
    resident: f64,
    /// The most since the reading before.
    peak: f64,
}

/// Renders with checkpoints and pictures every half minute, reads the memory that is resident, and
/// fails where it grows.
pub(crate) fn run(root: &Path, soak: &Soak) -> Result<()> {
    let program = workspace::program(root, soak.specula.as_deref())?;
    let output = root.join(&soak.output);
    let folder = output.parent().unwrap_or(root);
    std::fs::create_dir_all(folder)?;
    let mut command = Command::new(program);
    command
        .arg("render")
        .args(&soak.scene)
        .args(["--time", &format!("{}m", soak.minutes), "--restart"])
        .args(["--resolution", "640x360", "--checkpoint", &soak.checkpoint]);
    if let Some(threads) = soak.threads {
        command.args(["--threads", &threads.to_string()]);
    }
    let mut child = command.arg("-o").arg(folder.join("soak.exr")).spawn()?;
    let readings = watch(&mut child);
    let status = child.wait()?;
    let readings = readings?;
    let mut table = "seconds,resident_mebibytes,peak_mebibytes\n".to_owned();
    for r in &readings {
        writeln!(table, "{:.0},{:.1},{:.1}", r.seconds, r.resident, r.peak)?;
    }
    std::fs::write(&output, table)?;
    if !status.success() {
        return Err(format!("the render ended with {status}").into());
    }
    let verdict = judge(&readings);
    println!("{} readings in {}", readings.len(), output.display());
    verdict.map(|line| println!("{line}"))
}

/// Readings until the child ends.
fn watch(child: &mut Child) -> Result<Vec<Reading>> {
    let start = Instant::now();
    let mut readings = Vec::new();
    let mut next = EVERY;
    while child.try_wait()?.is_none() {
        if start.elapsed() >= next {
            next += EVERY;
            // Between `try_wait` and here it may have ended.
            if let Some([resident, peak]) = memory(child.id()) {
                readings.push(Reading {
                    seconds: start.elapsed().as_secs_f64(),
                    resident,
                    peak,
                });
            }
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    Ok(readings)
}

/// Mebibytes that a process has in memory, and the most that it had since it was last asked; `None`
/// where the system does not tell.
fn memory(process: u32) -> Option<[f64; 2]> {
    let text = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    // Linux: 5 sets the most to what there is.
    std::fs::write(format!("/proc/{process}/clear_refs"), "5").ok()?;
    Some([field(&text, "VmRSS:")?, field(&text, "VmHWM:")?])
}

/// A field of `/proc/N/status`, in mebibytes.
pub(crate) fn field(text: &str, name: &str) -> Option<f64> {
    let line = text.lines().find_map(|l| l.strip_prefix(name))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes / 1024.0)
}

/// Compares the last third with the first, both after settling. A picture's writing moves the median of
/// what is resident little, and the median of the peaks of the readings during which one was written
/// is a matter of many, so that no single reading decides.
fn judge(readings: &[Reading]) -> Result<String> {
    let settled: Vec<Reading> = readings
        .iter()
        .filter(|r| r.seconds >= SETTLING.as_secs_f64())
        .copied()
        .collect();
    let third = settled.len() / 3;
    if third == 0 {
        return Err("too few readings: render for two minutes at least, on Linux".into());
    }
    let (first, last) = (&settled[..third], &settled[settled.len() - third..]);
    let figures = |part: &[Reading]| {
        let resident: Vec<f64> = part.iter().map(|r| r.resident).collect();
        let peaks: Vec<f64> = part.iter().map(|r| r.peak).collect();
        [quantile(&resident, 0.5), quantile(&peaks, PEAKS)]
    };
    let (first, last) = (figures(first), figures(last));
    for (name, from, to) in [
        ("resident", first[0], last[0]),
        ("peaks", first[1], last[1]),
    ] {
        if to > from * (1.0 + TOLERANCE) + LEAST_GROWTH {
            return Err(format!("memory grows: {name} of {from:.1} MiB, then {to:.1} MiB").into());
        }
    }
    Ok(format!(
        "memory is steady: resident {:.1} MiB, then {:.1} MiB; peaks {:.1} MiB, then {:.1} MiB",
        first[0], last[0], first[1], last[1]
    ))
}

/// The value that `share` of the values are below.
fn quantile(values: &[f64], share: f64) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of a count"
    )]
    let at = (sorted.len() as f64 * share) as usize;
    sorted[at.min(sorted.len() - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An hour; every third reading sees a picture written, which takes 40 MiB.
    fn readings(resident: impl Fn(f64) -> f64, writing: impl Fn(f64) -> f64) -> Vec<Reading> {
        (1..360)
            .map(|i| (i % 3, f64::from(i) * 10.0))
            .map(|(i, seconds)| Reading {
                seconds,
                resident: resident(seconds),
                peak: resident(seconds) + if i == 0 { writing(seconds) } else { 0.0 },
            })
            .collect()
    }

    #[test]
    fn growth_is_told_from_peaks() {
        let steady = |_: f64| 100.0;
        let picture = |_: f64| 40.0;
        assert!(judge(&readings(steady, picture)).is_ok());
        // Settling.
        let settling = |t: f64| 100.0 - 90.0 * (-t / 20.0).exp();
        assert!(judge(&readings(settling, picture)).is_ok());
        // One picture that falls on other work at its worst.
        let unlucky = |t: f64| if t == 3000.0 { 90.0 } else { 40.0 };
        assert!(judge(&readings(steady, unlucky)).is_ok());
        // Four kibibytes for each second, and pictures that take more and more.
        assert!(judge(&readings(|t| 100.0 + t * 0.004, picture)).is_err());
        assert!(judge(&readings(steady, |t| 40.0 + t / 300.0)).is_err());
        assert!(judge(&readings(steady, picture)[..6]).is_err());
    }

    #[test]
    fn the_system_tells_the_most_since_it_was_asked() {
        let text = "Name:\tx\nVmHWM:\t    2048 kB\nVmRSS:\t    1536 kB\n";
        assert_eq!(field(text, "VmRSS:"), Some(1.5));
        assert_eq!(field(text, "VmHWM:"), Some(2.0));
        assert_eq!(field(text, "VmSwap:"), None);
        if !cfg!(target_os = "linux") {
            return;
        }
        let own = std::process::id();
        let large = std::hint::black_box(vec![1_u8; 64 << 20]);
        drop(large);
        let [before, peak] = memory(own).unwrap();
        assert!(peak >= before);
        let [_, next] = memory(own).unwrap();
        assert!(next <= peak, "{next} {peak}");
    }
}
