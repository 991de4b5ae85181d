//! How much is rendered, and by which clock.

use super::Clock;
use super::renderers::Timing;

/// How much is rendered.
pub(crate) struct Plan {
    /// At least two: pairs of consecutive ones are compared.
    pub(crate) rounds: u32,
    pub(crate) seconds: f64,
    /// Samples of a reference over those of a render.
    pub(crate) reference: u32,
    pub(crate) threads: u32,
    pub(crate) clock: Clock,
}

impl Plan {
    /// The seconds that are compared.
    pub(crate) fn seconds_of(&self, timing: Timing) -> f64 {
        match self.clock {
            Clock::Wall => timing.wall,
            Clock::Cpu => timing.cpu / f64::from(self.threads),
        }
    }

    /// Samples that take about [`seconds`](Self::seconds): the power of two whose time is nearest by ratio.
    pub(crate) fn samples(&self, seconds_per_sample: f64) -> u32 {
        let exponent = (self.seconds / seconds_per_sample.max(1e-9)).log2().round();
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to 0..=14"
        )]
        let exponent = exponent.clamp(0.0, 14.0) as u32;
        1 << exponent
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_fill_the_time() {
        let plan = Plan {
            rounds: 2,
            seconds: 3.0,
            reference: 8,
            threads: 2,
            clock: Clock::Wall,
        };
        assert_eq!(plan.samples(0.1), 32);
        assert_eq!(plan.samples(0.15), 16);
        assert_eq!(plan.samples(100.0), 1);
        assert_eq!(plan.samples(0.0), 1 << 14);
    }
}
