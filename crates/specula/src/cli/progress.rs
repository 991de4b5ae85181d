//! Progress on standard error: a bar on a terminal, sparse lines elsewhere.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use super::console::say;

/// Between two lines where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);
/// Ticks of the bar.
const TICKS: u64 = 1000;

/// Shows how far a render is.
pub(crate) struct Progress {
    bar: Option<ProgressBar>,
    lines: bool,
    start: Instant,
    last_line: Instant,
}

/// What is shown.
pub(crate) struct State {
    /// In `[0, 1]`.
    pub(crate) share_done: f64,
    /// Samples per pixel, in words.
    pub(crate) samples: String,
    /// Over the whole render.
    pub(crate) rays_per_second: f64,
    /// Relative error; infinite where unknown.
    pub(crate) noise: f32,
}

impl Progress {
    /// Progress that begins now.
    pub(crate) fn new(quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let bar = (terminal && !quiet).then(|| {
            let bar = ProgressBar::with_draw_target(Some(TICKS), ProgressDrawTarget::stderr());
            if let Ok(style) = ProgressStyle::with_template("{bar:32} {percent:>3} %  {msg}") {
                bar.set_style(style.progress_chars("━╸ "));
            }
            bar
        });
        Self {
            bar,
            lines: !terminal && !quiet,
            start: Instant::now(),
            last_line: Instant::now(),
        }
    }

    /// Whether what is told now is shown.
    pub(crate) fn is_due(&self) -> bool {
        self.bar.is_some() || (self.lines && self.last_line.elapsed() >= LINE_EVERY)
    }

    /// Shows a state.
    pub(crate) fn show(&mut self, state: &State) {
        self.tell(state.share_done, &describe(state));
    }

    /// Shows how far it is, and what is left.
    ///
    /// * `share_done`: in `[0, 1]`.
    pub(crate) fn tell(&mut self, share_done: f64, what: &str) {
        if !self.is_due() {
            return;
        }
        let message = format!("{what}{}", remaining(self.start.elapsed(), share_done));
        if let Some(bar) = &self.bar {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "in 0..=1000"
            )]
            bar.set_position((share_done * 1000.0) as u64);
            bar.set_message(message);
        } else {
            self.last_line = Instant::now();
            say!("{:3.0} %  {message}", 100.0 * share_done);
        }
    }

    /// Does what writes lines, beside the bar.
    pub(crate) fn aside<T>(&self, write: impl FnOnce() -> T) -> T {
        match &self.bar {
            Some(bar) => bar.suspend(write),
            None => write(),
        }
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn describe(state: &State) -> String {
    let noise = if state.noise.is_finite() {
        format!("  noise {:.1} %", 100.0 * state.noise)
    } else {
        String::new()
    };
    format!(
        "{}  {:.2} Mrays/s{noise}",
        state.samples,
        state.rays_per_second * 1e-6
    )
}

fn remaining(elapsed: Duration, share_done: f64) -> String {
    if share_done <= 0.0 {
        return String::new();
    }
    let seconds = elapsed.as_secs_f64() * (1.0 - share_done) / share_done;
    format!("  {} left", short(seconds))
}

/// `42 s`, `3:05 min`, `2:07 h`.
pub(crate) fn short(seconds: f64) -> String {
    let two = |a: f64, b: f64| format!("{:.0}:{:02.0}", (a / b).floor(), (a % b).floor());
    if seconds < 10.0 {
        format!("{seconds:.1} s")
    } else if seconds < 60.0 {
        format!("{seconds:.0} s")
    } else if seconds < 3600.0 {
        format!("{} min", two(seconds, 60.0))
    } else {
        format!("{} h", two(seconds / 60.0, 60.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_short() {
        assert_eq!(short(3.21), "3.2 s");
        assert_eq!(short(42.4), "42 s");
        assert_eq!(short(185.9), "3:05 min");
        assert_eq!(short(7620.0), "2:07 h");
    }

    #[test]
    fn what_remains_follows_from_what_is_done() {
        let elapsed = Duration::from_secs(10);
        assert_eq!(remaining(elapsed, 0.25), "  30 s left");
        assert_eq!(remaining(elapsed, 0.0), "");
    }
}
