//! `cargo xtask soak`: a long render whose memory must not grow.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use clap::Args;

use crate::Result;

/// Between two readings.
const EVERY: Duration = Duration::from_secs(10);
/// Readings of the first part of a render are not judged: allocators and caches settle.
const SETTLING: Duration = Duration::from_secs(60);
/// Growth that is taken for steady, as a share.
const TOLERANCE: f64 = 0.02;
/// The same in mebibytes, for small renders.
const LEAST_GROWTH: f64 = 2.0;

/// What is rendered, and for how long.
#[derive(Args)]
pub(crate) struct Soak {
    /// How long to render
    #[arg(long, value_name = "N", default_value_t = 60)]
    minutes: u64,
    /// A scene instead of the built-in one
    #[arg(long, value_name = "FILE")]
    scene: Option<PathBuf>,
    /// Where the readings go, as a table of seconds and mebibytes
    #[arg(long, value_name = "FILE", default_value = "target/soak/memory.csv")]
    output: PathBuf,
}

/// Renders with checkpoints and pictures every half minute, reads the memory that is resident, and
/// fails where it grows.
pub(crate) fn run(root: &Path, soak: &Soak) -> Result<()> {
    let built = Command::new("cargo")
        .current_dir(root)
        .args(["build", "--release", "--quiet", "-p", "specula"])
        .status()?;
    if !built.success() {
        return Err("the program cannot be built".into());
    }
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or(root.join("target"), PathBuf::from);
    let output = root.join(&soak.output);
    let folder = output.parent().unwrap_or(root);
    std::fs::create_dir_all(folder)?;
    let mut command = Command::new(target.join("release/specula"));
    command
        .arg("render")
        .args(&soak.scene)
        .args(["--time", &format!("{}m", soak.minutes), "--restart"])
        .args(["--resolution", "640x360", "--checkpoint", "30s", "-o"])
        .arg(folder.join("soak.exr"));
    let mut child = command.spawn()?;
    let readings = watch(&mut child);
    let status = child.wait()?;
    let readings = readings?;
    let mut table = "seconds,resident_mebibytes\n".to_owned();
    for (seconds, resident) in &readings {
        writeln!(table, "{seconds:.0},{resident:.1}")?;
    }
    std::fs::write(&output, table)?;
    if !status.success() {
        return Err(format!("the render ended with {status}").into());
    }
    let verdict = judge(&readings);
    println!("{} readings in {}", readings.len(), output.display());
    verdict.map(|line| println!("{line}"))
}

/// Seconds since the start and mebibytes, until the child ends.
fn watch(child: &mut Child) -> Result<Vec<(f64, f64)>> {
    let start = Instant::now();
    let mut readings = Vec::new();
    let mut next = EVERY;
    while child.try_wait()?.is_none() {
        if start.elapsed() >= next {
            next += EVERY;
            // Between `try_wait` and here it may have ended.
            if let Some(resident) = resident(child.id()) {
                readings.push((start.elapsed().as_secs_f64(), resident));
            }
        }
        std::thread::sleep(Duration::from_millis(100));
    }
    Ok(readings)
}

/// Mebibytes that a process has in memory; `None` where the system does not tell.
fn resident(process: u32) -> Option<f64> {
    let text = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = text.lines().find_map(|l| l.strip_prefix("VmRSS:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes / 1024.0)
}

/// Compares the last third with the first, both after settling: their medians, which writing pictures
/// does not move, and their largest, in which a leak of the writers would show.
fn judge(readings: &[(f64, f64)]) -> Result<String> {
    let settled: Vec<f64> = readings
        .iter()
        .filter(|(seconds, _)| *seconds >= SETTLING.as_secs_f64())
        .map(|(_, resident)| *resident)
        .collect();
    let third = settled.len() / 3;
    if third == 0 {
        return Err("too few readings: render for two minutes at least, on Linux".into());
    }
    let median_and_most = |part: &[f64]| {
        let mut sorted = part.to_vec();
        sorted.sort_by(f64::total_cmp);
        [sorted[sorted.len() / 2], sorted[sorted.len() - 1]]
    };
    let first = median_and_most(&settled[..third]);
    let last = median_and_most(&settled[settled.len() - third..]);
    for (name, from, to) in [("median", first[0], last[0]), ("most", first[1], last[1])] {
        if to > from * (1.0 + TOLERANCE) + LEAST_GROWTH {
            return Err(format!("memory grows: {name} of {from:.1} MiB, then {to:.1} MiB").into());
        }
    }
    Ok(format!(
        "memory is steady: median {:.1} MiB, then {:.1} MiB; most {:.1} MiB, then {:.1} MiB",
        first[0], last[0], first[1], last[1]
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(resident: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
        (1..360)
            .map(|i| f64::from(i) * 10.0)
            .map(|t| (t, resident(t)))
            .collect()
    }

    #[test]
    fn growth_is_told_from_peaks() {
        let peaks = |t: f64| if (t / 30.0).fract() == 0.0 { 40.0 } else { 0.0 };
        assert!(judge(&readings(|t| 100.0 + peaks(t))).is_ok());
        // Settling.
        assert!(judge(&readings(|t| 100.0 + peaks(t) - 90.0 * (-t / 20.0).exp())).is_ok());
        // A kibibyte for each second, and peaks that grow.
        assert!(judge(&readings(|t| 100.0 + t * 0.004)).is_err());
        assert!(judge(&readings(|t| 100.0 + peaks(t) * (1.0 + t / 5000.0))).is_err());
        assert!(judge(&readings(|t| 100.0 + t)[..6]).is_err());
    }
}
