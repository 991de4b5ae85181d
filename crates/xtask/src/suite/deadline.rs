//! When a suite must have ended: a slow machine leaves out what would begin too late, and says so.

use std::fmt;
use std::sync::Mutex;
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use super::programs::lock;

/// Until when programs of tests begin, as a share of the time: the chores come after them.
const PROGRAMS: f64 = 0.68;
/// Until when chores begin.
const CHORES: f64 = 0.85;

/// Until when parts of a suite begin, and those that were left out.
pub(super) struct Deadline {
    /// The beginning, and how long the whole may take; `None`: as long as it takes.
    allowed: Option<(SystemTime, Duration)>,
    left_out: Mutex<Vec<String>>,
}

impl Deadline {
    /// * `minutes`: how long the whole may take.
    /// * `began`: when, in seconds since 1970; now where it is not given.
    pub(super) fn new(minutes: Option<u32>, began: Option<u64>) -> Self {
        let began = began.map_or_else(SystemTime::now, |s| UNIX_EPOCH + Duration::from_secs(s));
        let allowed = minutes.map(|m| (began, Duration::from_secs(60 * u64::from(m))));
        Self {
            allowed,
            left_out: Mutex::default(),
        }
    }

    /// Whether a program of tests may begin; one that may not is left out.
    pub(super) fn admits_program(&self, name: &str) -> bool {
        self.admits(name, PROGRAMS)
    }

    /// The same of a chore.
    pub(super) fn admits_chore(&self, name: &str) -> bool {
        self.admits(name, CHORES)
    }

    fn admits(&self, name: &str, share: f64) -> bool {
        let Some((began, allowed)) = self.allowed else {
            return true;
        };
        // A clock that was set back has no time that has passed.
        let passed = began.elapsed().unwrap_or_default();
        let admits = passed < allowed.mul_f64(share);
        if !admits {
            lock(&self.left_out).push(name.to_owned());
        }
        admits
    }
}

/// What was left out; nothing where nothing was.
impl fmt::Display for Deadline {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let left_out = lock(&self.left_out);
        if left_out.is_empty() {
            return Ok(());
        }
        writeln!(
            f,
            "== left out, as this machine is too slow for all in the time"
        )?;
        left_out.iter().try_for_each(|name| writeln!(f, "{name}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn begun(seconds_ago: u64) -> Deadline {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap();
        Deadline::new(Some(10), Some(now.as_secs() - seconds_ago))
    }

    #[test]
    fn programs_end_before_chores_and_what_is_late_is_named() {
        let early = begun(60);
        assert!(early.admits_program("a") && early.admits_chore("b"));
        assert_eq!(early.to_string(), "");
        let later = begun(450);
        assert!(!later.admits_program("a") && later.admits_chore("b"));
        assert!(later.to_string().ends_with("in the time\na\n"), "{later}");
        let late = begun(550);
        assert!(!late.admits_program("a") && !late.admits_chore("b"));
        assert!(late.to_string().ends_with("a\nb\n"), "{late}");
    }

    #[test]
    fn without_minutes_everything_begins() {
        let deadline = Deadline::new(None, None);
        assert!(deadline.admits_program("a") && deadline.admits_chore("b"));
        // One that begins in the future has all its time.
        let next_year = Deadline::new(Some(10), Some(u64::from(u32::MAX) * 2));
        assert!(next_year.admits_program("a"));
    }
}
