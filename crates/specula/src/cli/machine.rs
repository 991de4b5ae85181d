//! What a render may take of the machine: threads, their priority, memory.

use clap::Args;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use super::{Failure, values};

#[derive(Args, Debug)]
#[command(next_help_heading = "Use of the machine")]
pub(crate) struct MachineArguments {
    /// Threads; the picture is the same, bit for bit, for any number. Below 0: the cores that are left
    /// free, such as -1 for all but one [default: all cores]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::threads)]
    pub(crate) threads: Option<i16>,

    /// Give way to all other programs: render with the lowest priority, and as fast as ever where
    /// nobody else wants the machine
    #[arg(long)]
    pub(crate) nice: bool,

    /// Refuse a render that would take more memory than this, such as 4GiB or 800MB, before it begins
    /// (exit code 2). `specula info` prints the estimate that this is compared with
    #[arg(long, value_name = "SIZE", value_parser = values::size)]
    pub(crate) max_memory: Option<u64>,
}

impl MachineArguments {
    /// How many threads are meant.
    pub(crate) fn thread_count(&self) -> usize {
        count(self.threads)
    }
}

/// * `asked`: a number; below 0, the cores that are left free; `None`: one thread for each core.
pub(crate) fn count(asked: Option<i16>) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    match asked {
        None => cores,
        Some(n) if n < 0 => cores.saturating_sub(usize::from(n.unsigned_abs())).max(1),
        Some(n) => usize::from(n.unsigned_abs()),
    }
}

/// The threads that render.
///
/// * `nice`: they yield to every other program.
pub(crate) fn pool(threads: usize, nice: bool) -> Result<ThreadPool, Failure> {
    let threads = builder(threads, nice)?.build();
    threads.map_err(not_started)
}

/// The same for threads that callers do not choose: once in a program.
#[cfg(feature = "studio")]
pub(crate) fn global_pool(threads: usize, nice: bool) -> Result<(), Failure> {
    let threads = builder(threads, nice)?.build_global();
    threads.map_err(not_started)
}

fn builder(threads: usize, nice: bool) -> Result<ThreadPoolBuilder, Failure> {
    if nice {
        lower_priority()?;
    }
    Ok(ThreadPoolBuilder::new().num_threads(threads))
}

#[expect(clippy::needless_pass_by_value, reason = "maps errors")]
fn not_started(error: ThreadPoolBuildError) -> Failure {
    Failure::other(format_args!("cannot start threads: {error}"))
}

/// Threads that are started from now on have the least priority.
#[cfg(unix)]
fn lower_priority() -> Result<(), Failure> {
    rustix::process::nice(19)
        .map(|_| ())
        .map_err(|e| Failure::other(format_args!("--nice: cannot lower the priority: {e}")))
}

#[cfg(not(unix))]
fn lower_priority() -> Result<(), Failure> {
    Err(Failure::bad_input(
        "--nice is not available on this system: `start /low specula render ...` does the same",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn some_cores_are_left_free_but_one_thread_renders() {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        assert_eq!(count(None), cores);
        assert_eq!(count(Some(7)), 7);
        assert_eq!(count(Some(-1)), (cores - 1).max(1));
        assert_eq!(count(Some(-4096)), 1);
    }
}
