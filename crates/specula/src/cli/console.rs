//! What is printed. A message that cannot be written is dropped, so that a log on a full disk or a closed
//! pipe ends no render; results that cannot be written are an error.

use std::io::{self, ErrorKind, Write};

use super::Failure;

/// Prints a line to standard error, or drops it: `eprintln!` would panic where nobody listens.
macro_rules! say {
    () => { $crate::cli::console::line(format_args!("")) };
    ($($text:tt)*) => { $crate::cli::console::line(format_args!($($text)*)) };
}
pub(crate) use say;

/// Writes one line to standard error in one call, so that lines of several threads do not mix.
pub(crate) fn line(text: std::fmt::Arguments<'_>) {
    let _ = io::stderr()
        .lock()
        .write_all(format!("{text}\n").as_bytes());
}

/// Prints a result to standard output. A reader that has gone away (`specula info x | head`) is no error.
///
/// # Errors
///
/// Where standard output cannot be written: a full disk, say.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::other(format_args!(
            "cannot write to standard output: {e}"
        ))),
        _ => Ok(()),
    }
}
