//! How much memory a render will take: said before it begins, and refused where it is too much.

use crate::render::{MemoryEstimate, RenderOptions};
use crate::scene::Scene;

use super::Failure;
use super::console::say;

/// Says what the render will take. Fails where that is more than `limit`; warns where it is more than
/// the machine has left.
pub(crate) fn check(
    scene: &Scene,
    options: &RenderOptions,
    threads: usize,
    limit: Option<u64>,
    quiet: bool,
) -> Result<(), Failure> {
    let estimate = estimate(scene, options, threads);
    let peak = estimate.peak();
    if let Some(limit) = limit.filter(|limit| peak > *limit) {
        return Err(Failure::bad_input(format_args!(
            "the render would take {} of memory, more than --max-memory {}:\n{}",
            bytes(peak),
            bytes(limit),
            parts(&estimate)
        )));
    }
    if !quiet {
        say!("memory: {}", line(&estimate));
    }
    // What is held of the scene already is no longer available.
    let needed = peak.saturating_sub(estimate.scene + estimate.program);
    if let Some(available) = available().filter(|available| needed > *available) {
        say!(
            "warning: {} of memory are available, and the render would take {} more than it has now",
            bytes(available),
            bytes(needed)
        );
    }
    Ok(())
}

/// The estimate for a scene that was just read.
pub(crate) fn estimate(scene: &Scene, options: &RenderOptions, threads: usize) -> MemoryEstimate {
    let estimate = MemoryEstimate::new(scene, options, threads);
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    match (field(&status, "VmRSS:"), field(&status, "VmHWM:")) {
        (Some(now), Some(most)) => estimate.after_reading(now, most),
        _ => estimate,
    }
}

/// The peak and its parts in a line.
pub(crate) fn line(estimate: &MemoryEstimate) -> String {
    format!("at most {} ({})", bytes(estimate.peak()), parts(estimate))
}

fn parts(estimate: &MemoryEstimate) -> String {
    let parts = [
        ("scene as read", estimate.scene),
        ("geometry", estimate.geometry),
        ("tree over it", estimate.tree),
        ("textures", estimate.textures),
        ("lights", estimate.lights),
        ("film", estimate.film),
        ("writing pictures", estimate.pictures),
    ];
    let mut text: Vec<String> = parts
        .iter()
        .filter(|(_, size)| *size >= 1 << 20)
        .map(|(name, size)| format!("{name} {}", bytes(*size)))
        .collect();
    text.push(format!("program {}", bytes(estimate.program)));
    let phases = format!(
        "; {} while it is read, {} while it is prepared, {} while it is rendered",
        bytes(estimate.reading),
        bytes(estimate.preparing()),
        bytes(estimate.rendering())
    );
    text.join(", ") + &phases
}

/// Bytes with three digits, rounded up: `1.25 GiB`, `340 MiB`.
fn bytes(size: u64) -> String {
    let mebibytes = size as f64 / f64::from(1 << 20);
    let (value, unit) = if mebibytes < 1000.0 {
        (mebibytes, "MiB")
    } else {
        (mebibytes / 1024.0, "GiB")
    };
    let digits = match value {
        v if v < 10.0 => 2,
        v if v < 100.0 => 1,
        _ => 0,
    };
    let scale = [1.0, 10.0, 100.0][digits];
    // A size that the digits hold stays as it is.
    let value = (value * scale - 1e-6).ceil() / scale;
    format!("{value:.digits$} {unit}")
}

/// Memory that can be had without swapping: the system's, or what is left of the control group's where
/// that is less. `None` where it cannot be told.
pub(crate) fn available() -> Option<u64> {
    let of_system = std::fs::read_to_string("/proc/meminfo")
        .ok()
        .and_then(|text| field(&text, "MemAvailable:"));
    let number = |name: &str| {
        let text = std::fs::read_to_string(name).ok()?;
        text.trim().parse::<u64>().ok()
    };
    // Version 2 of control groups, then version 1.
    let of_group = [
        ("/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory.current"),
        (
            "/sys/fs/cgroup/memory/memory.limit_in_bytes",
            "/sys/fs/cgroup/memory/memory.usage_in_bytes",
        ),
    ]
    .into_iter()
    .find_map(|(most, now)| Some(number(most)?.saturating_sub(number(now)?)));
    match (of_system, of_group) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}

/// A field in kB of a file of the system such as `/proc/meminfo`, in bytes.
fn field(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|l| l.strip_prefix(name))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_three_digits() {
        assert_eq!(bytes(1 << 20), "1.00 MiB");
        assert_eq!(bytes(345 << 20), "345 MiB");
        assert_eq!(bytes(5 << 30), "5.00 GiB");
        assert_eq!(bytes(1010 << 20), "0.99 GiB");
        assert_eq!(bytes((44 << 20) + 1), "44.1 MiB");
    }

    #[test]
    fn available_memory_is_read() {
        let text = "MemTotal:  100 kB\nMemAvailable:   24000 kB\nSwap: 1 kB\n";
        assert_eq!(field(text, "MemAvailable:"), Some(24_000 * 1024));
        assert_eq!(field("MemTotal: 5 kB", "MemAvailable:"), None);
        assert_eq!(field("VmRSS: many kB", "VmRSS:"), None);
    }
}
