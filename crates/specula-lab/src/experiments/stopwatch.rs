//! Processor time, which other programs on the machine disturb less than the time on the wall.

/// Processor time of all threads of the program so far, in seconds.
#[cfg(unix)]
pub(super) fn processor_seconds() -> f64 {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}

/// The time on the wall, in seconds since the first call: the system does not tell the processor's.
#[cfg(not(unix))]
pub(super) fn processor_seconds() -> f64 {
    use std::sync::OnceLock;
    static BEGIN: OnceLock<std::time::Instant> = OnceLock::new();
    let begin = BEGIN.get_or_init(std::time::Instant::now);
    begin.elapsed().as_secs_f64()
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
    use std::time::Instant;

    use super::*;

    #[test]
    fn work_takes_processor_time() {
        let begin = processor_seconds();
        let wall = Instant::now();
        let mut sum = 0.0_f64;
        while wall.elapsed().as_secs_f64() < 0.05 {
            sum += std::hint::black_box(1.0_f64).sin();
        }
        let seconds = processor_seconds() - begin;
        // Other tests may run beside it, and others' programs.
        assert!(sum > 0.0 && seconds > 1e-3, "{seconds}");
    }

    #[test]
    fn medians() {
        assert_eq!(median([3.0, 1.0, 2.0]), 2.0);
        assert_eq!(median([4.0, 1.0]), 2.5);
        assert!(median([]).is_nan());
    }
}
