//! How a call ends.

use std::fmt::Display;

/// How a call ended.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// It did what it was asked to.
    Ok = 0,
    /// An argument that the function does not take.
    InvalidArgument = 1,
    /// A file that cannot be read, or that is damaged.
    Unreadable = 2,
    /// A file that cannot be written.
    Unwritable = 3,
    /// The progress function ended a render.
    Cancelled = 4,
    /// There is not so much memory.
    OutOfMemory = 5,
    /// A fault of the library.
    Internal = 6,
}

/// Why a call failed.
#[derive(Debug)]
pub(crate) struct Failure {
    pub(crate) status: Status,
    pub(crate) message: String,
}

impl Failure {
    pub(crate) fn new(status: Status, message: impl Display) -> Self {
        Self {
            status,
            message: message.to_string(),
        }
    }

    /// An argument that the function does not take.
    pub(crate) fn invalid(message: impl Display) -> Self {
        Self::new(Status::InvalidArgument, message)
    }
}
