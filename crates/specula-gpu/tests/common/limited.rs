//! Processes whose memory ends.

use std::process::{Child, Command, ExitStatus, Stdio};

use super::{AdapterKind, Gpu};

/// Set in the process of a single test.
const ALONE: &str = "SPECULA_TEST_ALONE";
/// 2^20 bytes.
pub(crate) const MIB: u64 = 1 << 20;

/// Bytes up to which an allocation is small. Rust aborts where memory does not hold it: only large ones are asked for
/// in a way that may fail.
const SMALL: u64 = 4 * MIB;

/// Whether this process has a test alone. If not, the test is done in one that has: limits hold for whole
/// processes. Where they say nothing about the GPU's memory, where the driver crashes, or where not even small
/// allocations are left, a loud line that it is skipped.
///
/// * `test`: its full name.
///
/// # Panics
/// Where it fails there.
pub(crate) fn is_alone(gpu: &Gpu, test: &str) -> bool {
    if gpu.adapter.kind != AdapterKind::Software {
        specula_testing::not_of_this_machine(test, "the GPU's memory is its own");
        return false;
    }
    if Command::new("prlimit").arg("--version").output().is_err() {
        specula_testing::skip(test, "no prlimit", "apt-get install util-linux");
        return false;
    }
    if std::env::var_os(ALONE).is_some() {
        return true;
    }
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "--nocapture", test])
        .env(ALONE, "1")
        // Every thread reserves 64 MiB of addresses otherwise, which the limit counts.
        .env("MALLOC_ARENA_MAX", "1")
        .output()
        .unwrap();
    if is_crashed(output.status) {
        specula_testing::not_of_this_machine(test, "the driver crashes where memory ends");
        return false;
    }
    let [said, failed] = [&output.stdout, &output.stderr].map(|s| String::from_utf8_lossy(s));
    if lacked(&failed).is_some_and(|bytes| bytes < SMALL) {
        specula_testing::not_of_this_machine(test, "small allocations fail first");
        return false;
    }
    assert!(output.status.success(), "{said}{failed}");
    assert!(said.contains("1 passed"), "{said}{failed}");
    false
}

/// The bytes of the allocation at which Rust aborted a process, by what it said.
pub(crate) fn lacked(said: &str) -> Option<u64> {
    let (_, rest) = said.split_once("memory allocation of ")?;
    rest.split_once(" bytes failed")?.0.parse().ok()
}

/// Whether a process read or wrote what is not its own: code without `unsafe` cannot, drivers can.
#[cfg(unix)]
fn is_crashed(status: ExitStatus) -> bool {
    use std::os::unix::process::ExitStatusExt as _;

    /// SIGSEGV.
    const SEGMENTATION_FAULT: i32 = 11;
    status.signal() == Some(SEGMENTATION_FAULT)
}

#[cfg(not(unix))]
fn is_crashed(_: ExitStatus) -> bool {
    false
}

/// A limit of this process's memory.
pub(crate) struct Limit {
    /// Lifts it when told to; it is there from the beginning, since starting a process takes memory.
    lifting: Child,
}

impl Limit {
    /// Lets this process have so many bytes more than it has.
    pub(crate) fn new(more: u64) -> Self {
        let process = std::process::id();
        let lifting = Command::new("sh")
            .arg("-c")
            .arg(format!(
                "read line; prlimit --pid={process} --as=unlimited:"
            ))
            .stdin(Stdio::piped())
            .spawn()
            .unwrap();
        let pages = std::fs::read_to_string("/proc/self/statm").unwrap();
        let pages: u64 = pages.split(' ').next().unwrap().parse().unwrap();
        let limit = pages * 4096 + more;
        let set = Command::new("prlimit")
            .arg(format!("--pid={process}"))
            .arg(format!("--as={limit}:"))
            .status();
        assert!(set.unwrap().success(), "prlimit");
        Self { lifting }
    }

    /// Ends the limit.
    pub(crate) fn lift(mut self) {
        drop(self.lifting.stdin.take());
        assert!(self.lifting.wait().unwrap().success(), "prlimit");
    }
}
