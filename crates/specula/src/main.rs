//! The program `specula`.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(specula::command_line(std::env::args_os()))
}
