//! The command line: arguments in, pictures and messages out. All else is in the libraries.
#![forbid(unsafe_code)]
#![deny(
    clippy::print_stderr,
    reason = "a lost standard error must end nothing: `console::say`"
)]

mod cli;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let run = match cli::Arguments::try_parse() {
        Ok(arguments) => cli::run(arguments),
        // Help, the version, or a usage error, which ends with code 2.
        Err(told) => return cli::usage(&told),
    };
    run.unwrap_or_else(|failure| failure.print())
}
