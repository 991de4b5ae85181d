//! When a render is done, and how many samples its next pass takes: one at first, then as many as fit into a second or
//! two.

use std::time::Duration;

/// Longest pass that is aimed at: between passes the progress is shown and the clock is read.
const LONGEST_PASS: Duration = Duration::from_millis(1500);
/// A pass takes at most this many times the samples of all before: so much can be told from how long those took.
const MOST_GROWTH: u32 = 15;

/// When a render is done, but for the noise that it may aim at: whatever comes first.
///
/// ```no_run
/// use std::sync::atomic::AtomicBool;
/// use std::time::Instant;
///
/// use specula_render::{RenderGoal, Renderer};
///
/// fn render(renderer: &mut Renderer<'_>, goal: RenderGoal) {
///     let (start, mut last) = (Instant::now(), None);
///     while let Some(done) = renderer.samples_done() {
///         let Some(next) = goal.next_pass(done, last, start.elapsed()) else {
///             break;
///         };
///         let pass = Instant::now();
///         renderer.render_pass(next, &AtomicBool::new(false));
///         last = Some((next, pass.elapsed()));
///     }
/// }
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderGoal {
    /// Samples per pixel.
    pub most_samples: u32,
    /// Time since the start; at least one sample is taken.
    pub time: Option<Duration>,
}

impl RenderGoal {
    /// Samples per pixel at which a render by time ends in any case.
    pub const MOST_BY_TIME: u32 = 1 << 24;

    /// A number of samples per pixel.
    #[must_use]
    pub fn samples(most_samples: u32) -> Self {
        Self {
            most_samples,
            time: None,
        }
    }

    /// As many samples as fit into a time.
    #[must_use]
    pub fn time(time: Duration) -> Self {
        Self {
            most_samples: Self::MOST_BY_TIME,
            time: Some(time),
        }
    }

    /// Samples in the next pass; `None`: done.
    ///
    /// * `done`: samples so far, of the pixels that have the fewest; `last`: samples and duration of
    ///   the last pass; `elapsed`: since the start.
    #[must_use]
    pub fn next_pass(
        self,
        done: u32,
        last: Option<(u32, Duration)>,
        elapsed: Duration,
    ) -> Option<u32> {
        // Few passes: each starts its threads and waits for the last of them.
        let mut samples = done.saturating_mul(MOST_GROWTH).max(1);
        let rest = self.time.map(|limit| limit.saturating_sub(elapsed));
        if done > 0 && rest.is_some_and(|rest| rest.is_zero()) {
            return None;
        }
        let budget = rest.unwrap_or(LONGEST_PASS).min(LONGEST_PASS);
        if let Some((taken, duration)) = last {
            let per_sample = duration.as_secs_f64() / f64::from(taken.max(1));
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "saturates, which is what is wanted"
            )]
            let fitting = (budget.as_secs_f64() / per_sample.max(1e-9)) as u32;
            samples = samples.min(fitting.max(1));
            // One more would end after the limit by more than half of itself.
            let late = rest.is_some_and(|rest| 0.5 * per_sample > rest.as_secs_f64());
            if done > 0 && late {
                return None;
            }
        }
        let left = self.most_samples.saturating_sub(done);
        (left > 0).then(|| samples.min(left))
    }

    /// Share of the work that is done, in `[0, 1]`.
    ///
    /// * `of_samples`: share of the samples.
    #[must_use]
    pub fn share_done(self, of_samples: f64, elapsed: Duration) -> f64 {
        let of_time = self
            .time
            .map_or(0.0, |limit| elapsed.as_secs_f64() / limit.as_secs_f64());
        let share = of_samples.max(of_time);
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
    fn passes_grow_and_end_at_the_asked_samples() {
        let (mut done, mut last, mut passes) = (0, None, Vec::new());
        while let Some(n) = RenderGoal::samples(300).next_pass(done, last, FAST) {
            passes.push(n);
            done += n;
            last = Some((n, FAST));
        }
        assert_eq!(passes, [1, 15, 240, 44]);
    }

    #[test]
    fn passes_take_as_many_samples_as_fit() {
        // 250 ms a sample, after the first and later.
        let goal = RenderGoal::samples(100);
        let (one, six) = (Duration::from_millis(250), Duration::from_millis(1500));
        assert_eq!(goal.next_pass(1, Some((1, one)), FAST), Some(6));
        assert_eq!(goal.next_pass(7, Some((6, six)), FAST), Some(6));
        assert_eq!(
            RenderGoal::samples(8).next_pass(7, Some((6, six)), FAST),
            Some(1)
        );
    }

    #[test]
    fn slow_passes_stay_small() {
        let last = Some((64, Duration::from_secs(64)));
        let next = RenderGoal::samples(1000).next_pass(64, last, FAST);
        assert_eq!(next, Some(1));
    }

    #[test]
    fn time_takes_one_sample_at_least_and_then_ends() {
        let goal = RenderGoal::time(Duration::from_secs(1));
        let late = Duration::from_secs(5);
        assert_eq!(goal.next_pass(0, None, late), Some(1));
        assert_eq!(goal.next_pass(1, Some((1, late)), late), None);
        let half = Duration::from_millis(500);
        let quick = Some((8, Duration::from_millis(80)));
        assert_eq!(goal.next_pass(100, quick, half), Some(50));
    }

    #[test]
    fn samples_that_take_longer_than_a_pass_should_do_not_end_a_render() {
        let goal = RenderGoal::time(Duration::from_secs(2400));
        let slow = Some((1, Duration::from_secs(8)));
        assert_eq!(goal.next_pass(8, slow, Duration::from_secs(20)), Some(1));
        assert_eq!(goal.next_pass(8, slow, Duration::from_secs(2395)), Some(1));
        assert_eq!(goal.next_pass(8, slow, Duration::from_secs(2397)), None);
    }

    #[test]
    fn what_comes_first_ends_a_render() {
        let goal = RenderGoal {
            most_samples: 64,
            time: Some(Duration::from_secs(1)),
        };
        assert_eq!(goal.next_pass(64, None, FAST), None);
        assert_eq!(goal.next_pass(32, None, Duration::from_secs(2)), None);
        assert_eq!(goal.next_pass(48, None, FAST), Some(16));
    }

    #[test]
    fn shares_are_in_bounds() {
        let second = Duration::from_secs(1);
        assert_eq!(RenderGoal::samples(8).share_done(0.25, second), 0.25);
        assert_eq!(RenderGoal::time(second).share_done(0.0, 3 * second), 1.0);
        assert_eq!(RenderGoal::time(4 * second).share_done(0.5, second), 0.5);
        assert_eq!(RenderGoal::samples(8).share_done(f64::NAN, second), 0.0);
    }
}
