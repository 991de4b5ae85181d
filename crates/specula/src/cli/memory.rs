//! How much memory a render will take: said before it begins, and refused where it is too much.

use crate::render::{MemoryEstimate, RenderOptions, available_memory};
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
    let estimate = MemoryEstimate::of_process(scene, options, threads);
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
    let needed = estimate.still_needed();
    if let Some(available) = available_memory().filter(|available| needed > *available) {
        say!(
            "warning: {} of memory are available, and the render would take {} more than it has now",
            bytes(available),
            bytes(needed)
        );
    }
    Ok(())
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
}
