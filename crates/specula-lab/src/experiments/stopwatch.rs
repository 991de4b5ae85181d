//! Processor time, which other programs on the machine disturb less than the time on the wall.

use std::sync::OnceLock;
use std::time::Instant;

/// Processor time of all threads of the program so far, in seconds. Where the system does not report it
/// (elsewhere than on Linux): the time on the wall.
pub(super) fn processor_seconds() -> f64 {
    static BEGIN: OnceLock<Instant> = OnceLock::new();
    of_threads().unwrap_or_else(|| BEGIN.get_or_init(Instant::now).elapsed().as_secs_f64())
}

/// The sum over threads of the first number of `schedstat`, nanoseconds on a processor.
fn of_threads() -> Option<f64> {
    let mut nanoseconds = 0.0;
    for thread in std::fs::read_dir("/proc/self/task").ok()? {
        // A thread may end in between.
        let Ok(text) = std::fs::read_to_string(thread.ok()?.path().join("schedstat")) else {
            continue;
        };
        nanoseconds += text.split_whitespace().next()?.parse::<f64>().ok()?;
    }
    (nanoseconds > 0.0).then_some(nanoseconds * 1e-9)
}

/// The middle of the values, or the mean of the two in the middle; not a number where there is none.
pub(crate) fn median(values: impl IntoIterator<Item = f64>) -> f64 {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    match n {
        0 => f64::NAN,
        _ if n % 2 == 1 => sorted[n / 2],
        _ => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_takes_processor_time() {
        let begin = processor_seconds();
        let wall = Instant::now();
        let mut sum = 0.0_f64;
        while wall.elapsed().as_secs_f64() < 0.05 {
            sum += std::hint::black_box(1.0_f64).sin();
        }
        assert!(sum > 0.0 && processor_seconds() > begin);
    }

    #[test]
    fn medians() {
        assert_eq!(median([3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median([4.0, 1.0]), 2.5);
        assert!(median([]).is_nan());
    }
}
