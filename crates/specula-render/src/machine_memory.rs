//! Memory that the system reports: what this process has, and what it can still have.

use specula_scene::Scene;

use crate::memory::MemoryEstimate;
use crate::options::RenderOptions;

impl MemoryEstimate {
    /// The estimate for a scene that this process has just read.
    #[must_use]
    pub fn of_process(scene: &Scene, options: &RenderOptions, threads: usize) -> Self {
        let estimate = Self::new(scene, options, threads);
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        match (field(&status, "VmRSS:"), field(&status, "VmHWM:")) {
            (Some(now), Some(most)) => estimate.after_reading(now, most),
            _ => estimate,
        }
    }

    /// What a render takes besides what the process has, if the scene has been read.
    #[must_use]
    pub fn still_needed(&self) -> u64 {
        self.peak().saturating_sub(self.scene + self.program)
    }
}

/// Memory that can be had without swapping: the system's, or what is left of the control group's where
/// that is less. `None` where it cannot be told.
#[must_use]
pub fn available_memory() -> Option<u64> {
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
    fn fields_are_read() {
        let text = "MemTotal:  100 kB\nMemAvailable:   24000 kB\nSwap: 1 kB\n";
        assert_eq!(field(text, "MemAvailable:"), Some(24_000 * 1024));
        assert_eq!(field("MemTotal: 5 kB", "MemAvailable:"), None);
        assert_eq!(field("VmRSS: many kB", "VmRSS:"), None);
    }

    #[test]
    #[cfg(target_os = "linux")]
    fn the_process_is_in_the_estimate() {
        let scene = specula_scene::builtin::orbs();
        let options = RenderOptions::from_scene(&scene);
        let estimate = MemoryEstimate::of_process(&scene, &options, 1);
        assert!(estimate.program >= MemoryEstimate::new(&scene, &options, 1).program);
        assert!(estimate.still_needed() < estimate.peak());
        assert!(available_memory().is_some_and(|bytes| bytes > 1 << 20));
    }
}
