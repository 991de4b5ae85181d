//! How many samples the next pass takes: few at first, then as many as fit into a second or two.

use std::time::Duration;

/// Longest pass that is aimed at: between passes the progress is shown and the clock is read.
const LONGEST_PASS: Duration = Duration::from_millis(1500);
/// Noise is not judged below this many samples: estimates of few samples are far too low where
/// light is rare.
const FEWEST_TO_JUDGE: u32 = 16;
/// Where a render by time or noise ends in any case.
const MOST_SAMPLES: u32 = 1 << 24;

/// When a render is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Goal {
    /// Samples per pixel.
    Samples(u32),
    /// Time since the start; at least one sample is taken.
    Time(Duration),
    /// Relative error of the picture.
    Noise(f32),
}

impl Goal {
    /// Samples in the next pass; `None`: done.
    ///
    /// * `done`: samples per pixel so far; `last`: samples and duration of the last pass; `elapsed`:
    ///   since the start; `noise`: estimate so far.
    pub(crate) fn next_pass(
        self,
        done: u32,
        last: Option<(u32, Duration)>,
        elapsed: Duration,
        noise: impl FnOnce() -> f32,
    ) -> Option<u32> {
        // 1, 1, 2, 4, ...: what there is doubles, until a pass is long enough.
        let mut samples = done.max(1);
        let mut budget = LONGEST_PASS;
        if let Self::Time(limit) = self {
            if done > 0 && elapsed >= limit {
                return None;
            }
            budget = budget.min(limit.saturating_sub(elapsed));
        }
        if let Some((taken, duration)) = last {
            let per_sample = duration.as_secs_f64() / f64::from(taken.max(1));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "saturates, which is what is wanted"
            )]
            let fitting = (budget.as_secs_f64() / per_sample.max(1e-9)) as u32;
            samples = samples.min(fitting.max(1));
            if matches!(self, Self::Time(_)) && done > 0 && fitting == 0 {
                // One more would end after the limit by more than half of itself.
                let late = per_sample * 0.5 > budget.as_secs_f64();
                if late {
                    return None;
                }
            }
        }
        let most = match self {
            Self::Samples(n) => n,
            Self::Time(_) => MOST_SAMPLES,
            Self::Noise(limit) => {
                if done >= FEWEST_TO_JUDGE && noise() <= limit {
                    return None;
                }
                MOST_SAMPLES
            }
        };
        let left = most.saturating_sub(done);
        (left > 0).then(|| samples.min(left))
    }

    /// Share of the work that is done, in `[0, 1]`.
    pub(crate) fn share_done(self, done: u32, elapsed: Duration, noise: f32) -> f64 {
        let share = match self {
            Self::Samples(n) => f64::from(done) / f64::from(n),
            Self::Time(limit) => elapsed.as_secs_f64() / limit.as_secs_f64(),
            // The error falls with the square root of the samples.
            Self::Noise(limit) => f64::from(limit / noise).powi(2),
        };
        if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FAST: Duration = Duration::from_micros(1);

    #[test]
    fn passes_double_and_end_at_the_asked_samples() {
        let (mut done, mut last, mut passes) = (0, None, Vec::new());
        while let Some(n) = Goal::Samples(21).next_pass(done, last, FAST, || 1.0) {
            passes.push(n);
            done += n;
            last = Some((n, FAST));
        }
        assert_eq!(passes, [1, 1, 2, 4, 8, 5]);
    }

    #[test]
    fn slow_passes_stay_small() {
        let last = Some((64, Duration::from_secs(64)));
        let next = Goal::Samples(1000).next_pass(64, last, FAST, || 1.0);
        assert_eq!(next, Some(1));
    }

    #[test]
    fn time_takes_one_sample_at_least_and_then_ends() {
        let goal = Goal::Time(Duration::from_secs(1));
        let late = Duration::from_secs(5);
        assert_eq!(goal.next_pass(0, None, late, || 1.0), Some(1));
        assert_eq!(goal.next_pass(1, Some((1, late)), late, || 1.0), None);
        let half = Duration::from_millis(500);
        let quick = Some((8, Duration::from_millis(80)));
        assert_eq!(goal.next_pass(100, quick, half, || 1.0), Some(50));
    }

    #[test]
    fn noise_is_judged_after_enough_samples() {
        let goal = Goal::Noise(0.1);
        let last = Some((4, FAST));
        assert_eq!(goal.next_pass(8, last, FAST, || 0.01), Some(8));
        assert_eq!(goal.next_pass(16, last, FAST, || 0.2), Some(16));
        assert_eq!(goal.next_pass(16, last, FAST, || 0.1), None);
    }

    #[test]
    fn shares_are_in_bounds() {
        let second = Duration::from_secs(1);
        assert_eq!(Goal::Samples(8).share_done(2, second, 1.0), 0.25);
        assert_eq!(Goal::Time(second).share_done(2, 3 * second, 1.0), 1.0);
        assert_eq!(Goal::Noise(0.1).share_done(2, second, 0.2), 0.25);
        assert_eq!(Goal::Noise(0.1).share_done(0, second, f32::INFINITY), 0.0);
    }
}
