//! Bounds on what pages may ask of the server.

use std::time::Duration;

/// Bounds on what pages may ask of the server.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ServerLimits {
    /// Most connections at once; others wait.
    pub connections: usize,
    /// Most requests that are answered at once; others wait.
    pub asks: usize,
    /// Most scenes that are added by opening and dropping.
    pub scenes: usize,
    /// Most bytes of a request.
    pub ask_bytes: usize,
    /// Most bytes of the files that are dropped together.
    pub drop_bytes: u64,
    /// Most files that are dropped together.
    pub drop_files: usize,
    /// For the head of a request, and between two requests.
    pub head_time: Duration,
    /// For each piece of a body.
    pub body_time: Duration,
    /// After so long without a request a render is closed: its page has gone away.
    pub idle_time: Duration,
}

impl Default for ServerLimits {
    fn default() -> Self {
        Self {
            connections: 64,
            asks: 4,
            scenes: 64,
            ask_bytes: 1 << 20,
            drop_bytes: 512 << 20,
            drop_files: 4096,
            head_time: Duration::from_secs(10),
            body_time: Duration::from_secs(15),
            idle_time: Duration::from_secs(60),
        }
    }
}
