//! Ctrl-C: the first lets the pass finish and ends the render, the second stops between tiles, the third
//! ends the program. Before the first pass there is nothing to keep: the first ends the program.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::Failure;
use super::progress::short;

/// Exit code after Ctrl-C, as shells have it: 128 + SIGINT.
pub(crate) const INTERRUPTED: u8 = 130;

/// What is left of a pass that is called long.
const LONG: Duration = Duration::from_secs(10);

/// Whether the user has asked to stop.
#[derive(Clone, Default)]
pub(crate) struct Stop(Arc<Shared>);

#[derive(Default)]
struct Shared {
    presses: AtomicU8,
    at_once: AtomicBool,
    phase: Mutex<Phase>,
}

/// What a render is at.
#[derive(Clone, Copy, Debug, Default)]
enum Phase {
    /// Reading and preparing the scene.
    #[default]
    Loading,
    /// Rendering since `start`, probably for `expected`.
    Pass {
        start: Instant,
        expected: Option<Duration>,
    },
    /// Between passes, or writing.
    Between,
}

impl Stop {
    /// Listens from now on.
    pub(crate) fn listen() -> Result<Self, Failure> {
        let stop = Self::default();
        let shared = stop.clone();
        ctrlc::set_handler(move || shared.press())
            .map_err(|e| Failure::other(format_args!("cannot listen for Ctrl-C: {e}")))?;
        Ok(stop)
    }

    /// What Ctrl-C does.
    fn press(&self) {
        let before = self.0.presses.fetch_add(1, Ordering::SeqCst);
        let phase = *self.0.phase.lock().unwrap_or_else(PoisonError::into_inner);
        if std::io::stderr().is_terminal() {
            // Leaves the line of the bar.
            eprintln!();
        }
        match (before, phase) {
            (0, Phase::Loading) => {
                eprintln!("stopped by Ctrl-C before the first sample");
                std::process::exit(i32::from(INTERRUPTED));
            }
            (0, Phase::Pass { start, expected }) => {
                eprintln!("{}", finishing(start.elapsed(), expected));
            }
            (0, Phase::Between) => eprintln!("stopping"),
            (1, _) => {
                self.0.at_once.store(true, Ordering::SeqCst);
                eprintln!("stopping between tiles; Ctrl-C again to lose what was not written yet");
            }
            _ => std::process::exit(i32::from(INTERRUPTED)),
        }
    }

    /// A pass begins that will probably take as long as `expected`.
    pub(crate) fn pass_begins(&self, expected: Option<Duration>) {
        self.set(Phase::Pass {
            start: Instant::now(),
            expected,
        });
    }

    /// The pass has ended.
    pub(crate) fn pass_ends(&self) {
        self.set(Phase::Between);
    }

    fn set(&self, phase: Phase) {
        *self.0.phase.lock().unwrap_or_else(PoisonError::into_inner) = phase;
    }

    /// The flag of the second Ctrl-C, for whoever can stop within a pass.
    pub(crate) fn at_once(&self) -> &AtomicBool {
        &self.0.at_once
    }

    /// Whether Ctrl-C was pressed.
    pub(crate) fn asked(&self) -> bool {
        self.0.presses.load(Ordering::SeqCst) > 0
    }
}

/// A flag that the first Ctrl-C sets; the second ends the program.
pub(crate) fn listen_for_one() -> Result<Arc<AtomicBool>, Failure> {
    let asked = Arc::new(AtomicBool::new(false));
    let flag = asked.clone();
    let press = move || {
        if flag.swap(true, Ordering::SeqCst) {
            std::process::exit(i32::from(INTERRUPTED));
        }
        eprintln!("\nstopping; what is finished is kept");
    };
    ctrlc::set_handler(press)
        .map_err(|e| Failure::other(format_args!("cannot listen for Ctrl-C: {e}")))?;
    Ok(asked)
}

/// What the first Ctrl-C says, `elapsed` into a pass.
fn finishing(elapsed: Duration, expected: Option<Duration>) -> String {
    let again = "Ctrl-C again to stop at once";
    let left = expected.map(|e| e.saturating_sub(elapsed));
    match left {
        None => format!(
            "finishing the first pass, begun {} ago; {again}",
            short(elapsed.as_secs_f64())
        ),
        Some(left) if left.is_zero() => format!("finishing the pass, nearly done; {again}"),
        Some(left) if left > LONG => format!(
            "finishing the pass, which is a long one, {} left; {again}, which keeps all finished tiles",
            short(left.as_secs_f64())
        ),
        Some(left) => format!(
            "finishing the pass, {} left; {again}",
            short(left.as_secs_f64())
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_press_says_how_long_the_pass_takes() {
        let seconds = Duration::from_secs;
        let after = |elapsed, expected| finishing(seconds(elapsed), expected);
        let text = after(1, Some(seconds(3)));
        assert_eq!(
            text,
            "finishing the pass, 2.0 s left; Ctrl-C again to stop at once"
        );
        let text = after(10, Some(seconds(95)));
        assert!(text.contains("a long one, 1:25 min left"), "{text}");
        assert!(!after(10, Some(seconds(20))).contains("long"));
        assert!(after(4, Some(seconds(3))).contains("nearly done"));
        assert!(after(4, None).contains("the first pass, begun 4.0 s ago"));
    }
}
