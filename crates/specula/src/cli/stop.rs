//! Signals that end a render. Ctrl-C: the first lets the pass finish and ends the render, the second stops
//! within it, the third ends the program. SIGTERM and SIGHUP, as schedulers and lost terminals send them,
//! stop within the pass, and end the program when it takes too long. Before the first pass there is
//! nothing to lose: the first signal ends the program.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::Failure;
use super::console::say;
use super::progress::short;

/// What is left of a pass that is called long.
const LONG: Duration = Duration::from_secs(10);
/// What a program may take to end after SIGTERM or SIGHUP; schedulers kill it after 10 to 30 s.
const GRACE: Duration = Duration::from_secs(9);

/// Why the program is to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Signal {
    /// Ctrl-C.
    Interrupt,
    /// SIGTERM: `kill`, schedulers, containers.
    Terminate,
    /// SIGHUP: the terminal is gone.
    HangUp,
}

impl Signal {
    /// As shells have it: 128 and the signal's number.
    pub(crate) fn exit_code(self) -> u8 {
        128 + match self {
            Self::HangUp => 1,
            Self::Interrupt => 2,
            Self::Terminate => 15,
        }
    }

    /// For messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::HangUp => "SIGHUP",
            Self::Interrupt => "Ctrl-C",
            Self::Terminate => "SIGTERM",
        }
    }

    fn exit(self) -> ! {
        std::process::exit(i32::from(self.exit_code()))
    }
}

/// Whether the program was asked to stop.
#[derive(Clone, Default)]
pub(crate) struct Stop(Arc<Shared>);

#[derive(Default)]
struct Shared {
    times: AtomicU8,
    at_once: AtomicBool,
    changed: AtomicBool,
    phase: Mutex<Phase>,
    /// The first.
    signal: Mutex<Option<Signal>>,
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
        on_signals(move |signal| shared.receive(signal))?;
        Ok(stop)
    }

    /// What a signal does.
    fn receive(&self, signal: Signal) {
        locked(&self.0.signal).get_or_insert(signal);
        let before = self.0.times.fetch_add(1, Ordering::SeqCst);
        let phase = *locked(&self.0.phase);
        if std::io::stderr().is_terminal() {
            // Leaves the line of the bar.
            say!();
        }
        match (signal, before, phase) {
            (_, 0, Phase::Loading) => {
                say!("stopped by {} before the first sample", signal.name());
                signal.exit();
            }
            (Signal::Terminate | Signal::HangUp, ..) => {
                self.0.at_once.store(true, Ordering::SeqCst);
                if before == 0 {
                    say!("{}: stopping, and writing what there is", signal.name());
                    end_after(GRACE, signal);
                }
            }
            (Signal::Interrupt, 0, Phase::Pass { start, expected }) => {
                say!("{}", finishing(start.elapsed(), expected));
            }
            (Signal::Interrupt, 0, Phase::Between) => say!("stopping"),
            (Signal::Interrupt, 1, _) => {
                self.0.at_once.store(true, Ordering::SeqCst);
                say!("stopping within the pass; Ctrl-C again to lose what was not written yet");
            }
            (Signal::Interrupt, ..) => signal.exit(),
        }
    }

    /// A pass begins that will probably take as long as `expected`.
    pub(crate) fn pass_begins(&self, expected: Option<Duration>) {
        *locked(&self.0.phase) = Phase::Pass {
            start: Instant::now(),
            expected,
        };
    }

    /// The pass has ended.
    pub(crate) fn pass_ends(&self) {
        *locked(&self.0.phase) = Phase::Between;
    }

    /// The flag of whoever can stop within a pass.
    pub(crate) fn at_once(&self) -> &AtomicBool {
        &self.0.at_once
    }

    /// The first signal, where there was one.
    pub(crate) fn signal(&self) -> Option<Signal> {
        *locked(&self.0.signal)
    }

    /// The scene is no longer what is being rendered: its render is to end at once.
    pub(crate) fn scene_changes(&self) {
        self.0.changed.store(true, Ordering::SeqCst);
        self.0.at_once.store(true, Ordering::SeqCst);
    }

    /// Another render begins.
    pub(crate) fn begin_again(&self) {
        *locked(&self.0.phase) = Phase::Between;
        self.0.changed.store(false, Ordering::SeqCst);
        self.0.at_once.store(self.asked(), Ordering::SeqCst);
    }

    /// Whether the scene has changed since the render began.
    pub(crate) fn changed(&self) -> bool {
        self.0.changed.load(Ordering::SeqCst)
    }

    /// Whether a signal came.
    pub(crate) fn asked(&self) -> bool {
        self.0.times.load(Ordering::SeqCst) > 0
    }
}

/// A flag for the first signal; the second ends the program.
#[cfg(any(feature = "lab", feature = "studio"))]
#[derive(Clone, Default)]
pub(crate) struct StopFlag {
    /// Set by the first signal.
    pub(crate) asked: Arc<AtomicBool>,
    signal: Arc<Mutex<Option<Signal>>>,
}

#[cfg(any(feature = "lab", feature = "studio"))]
impl StopFlag {
    /// Listens from now on.
    ///
    /// * `said`: at the first signal.
    pub(crate) fn listen(said: &'static str) -> Result<Self, Failure> {
        let stop = Self::default();
        let shared = stop.clone();
        on_signals(move |signal| {
            locked(&shared.signal).get_or_insert(signal);
            if shared.asked.swap(true, Ordering::SeqCst) {
                signal.exit();
            }
            say!("\n{said}");
            if signal != Signal::Interrupt {
                end_after(GRACE, signal);
            }
        })?;
        Ok(stop)
    }

    /// The signal that came; Ctrl-C where none did.
    pub(crate) fn signal(&self) -> Signal {
        locked(&self.signal).unwrap_or(Signal::Interrupt)
    }
}

/// Ends the program after a while, if it still runs.
fn end_after(grace: Duration, signal: Signal) {
    std::thread::spawn(move || {
        std::thread::sleep(grace);
        say!(
            "{}: not done after {}; what was written before stays",
            signal.name(),
            short(grace.as_secs_f64())
        );
        signal.exit();
    });
}

/// Calls a function for every signal, in a thread of its own.
#[cfg(unix)]
fn on_signals(mut receive: impl FnMut(Signal) + Send + 'static) -> Result<(), Failure> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    // What was ignored from the start stays so: `nohup`, and jobs that a script runs in the background.
    let ignored = ignored_signals();
    let heard = [SIGINT, SIGTERM, SIGHUP]
        .into_iter()
        .filter(|n| !ignored.contains(n));
    let mut signals = signal_hook::iterator::Signals::new(heard)
        .map_err(|e| Failure::other(format_args!("cannot listen for signals: {e}")))?;
    std::thread::spawn(move || {
        for number in signals.forever() {
            receive(match number {
                SIGTERM => Signal::Terminate,
                SIGHUP => Signal::HangUp,
                _ => Signal::Interrupt,
            });
        }
    });
    Ok(())
}

/// The signals that this process was started to ignore; none where the system does not tell.
#[cfg(unix)]
fn ignored_signals() -> Vec<i32> {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    ignored_in(&status)
}

/// * `status`: text of `/proc/self/status`, whose `SigIgn` has a bit for each signal, the lowest for 1.
#[cfg(unix)]
fn ignored_in(status: &str) -> Vec<i32> {
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    let is_set = |n: &i32| mask.unwrap_or(0) >> (n - 1) & 1 == 1;
    (1..=64).filter(is_set).collect()
}

/// Calls a function for every Ctrl-C, in a thread of its own.
#[cfg(not(unix))]
fn on_signals(mut receive: impl FnMut(Signal) + Send + 'static) -> Result<(), Failure> {
    ctrlc::set_handler(move || receive(Signal::Interrupt))
        .map_err(|e| Failure::other(format_args!("cannot listen for Ctrl-C: {e}")))
}

fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
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
            "finishing the pass, which is a long one, {} left; {again}, which saves all finished tiles",
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

    #[test]
    #[cfg(unix)]
    fn ignored_signals_are_read() {
        let status = "Name:\tx\nSigIgn:\t0000000000001003\nSigCgt:\tffff\n";
        assert_eq!(ignored_in(status), [1, 2, 13]);
        assert!(ignored_in("").is_empty());
    }

    #[test]
    fn exit_codes_are_those_of_shells() {
        let codes = [Signal::HangUp, Signal::Interrupt, Signal::Terminate].map(Signal::exit_code);
        assert_eq!(codes, [129, 130, 143]);
    }
}
