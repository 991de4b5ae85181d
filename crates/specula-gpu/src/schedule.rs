//! In which order a device follows the paths of a batch.

use std::fmt;
use std::str::FromStr;

/// Arrays of a kernel of paths in queues.
pub(crate) const QUEUE_ARRAYS: u32 = 8;

/// How threads follow paths. The samples are the same by either.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Schedule {
    /// The faster one by measurements (`docs/gpu`): queues, where a kernel may have enough arrays.
    #[default]
    Auto,
    /// A thread follows a path to its end.
    Paths,
    /// A thread takes a path to its next vertex, and paths that continue form a queue.
    Queues,
}

impl Schedule {
    /// All, by the names of [`fmt::Display`].
    const ALL: [(Self, &str); 3] = [
        (Self::Auto, "auto"),
        (Self::Paths, "paths"),
        (Self::Queues, "queues"),
    ];

    /// Whether paths are in queues on a device whose kernels may have so many arrays.
    pub(crate) fn is_queues(self, arrays: u32) -> bool {
        match self {
            Self::Auto => arrays >= QUEUE_ARRAYS,
            Self::Paths => false,
            Self::Queues => true,
        }
    }
}

impl fmt::Display for Schedule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let found = Self::ALL.iter().find(|(one, _)| one == self);
        f.write_str(found.map_or("", |(_, name)| name))
    }
}

/// A name that no schedule has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected auto, paths or queues")]
pub struct UnknownSchedule;

impl FromStr for Schedule {
    type Err = UnknownSchedule;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let found = Self::ALL.iter().find(|(_, name)| *name == text);
        found.map(|(one, _)| *one).ok_or(UnknownSchedule)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn automatic_queues_have_room_for_their_arrays() {
        assert!(Schedule::Auto.is_queues(QUEUE_ARRAYS) && !Schedule::Auto.is_queues(7));
        assert!(Schedule::Queues.is_queues(7) && !Schedule::Paths.is_queues(64));
    }

    #[test]
    fn schedules_are_read_and_written() {
        for (schedule, name) in Schedule::ALL {
            assert_eq!(name.parse(), Ok(schedule));
            assert_eq!(schedule.to_string(), name);
        }
        assert_eq!("".parse::<Schedule>(), Err(UnknownSchedule));
    }
}
