//! The command line: arguments in, pictures and messages out. One command per file; all else is in the libraries.
#![deny(
    clippy::print_stderr,
    reason = "a lost standard error must end nothing: `console::say`"
)]

#[cfg(not(all(
    feature = "gpu",
    feature = "lab",
    feature = "shaders",
    feature = "studio",
    feature = "tev"
)))]
mod absent;
mod arguments;
mod check;
mod checkpoint;
mod compare;
mod console;
mod convert;
mod denoise;
mod device;
mod display;
mod exit_code;
#[cfg(feature = "shaders")]
mod export;
mod failure;
mod farm;
mod file_id;
#[cfg(feature = "lab")]
mod gpu_report;
mod info;
mod job;
#[cfg(feature = "lab")]
mod lab;
#[cfg(feature = "tev")]
mod live_view;
mod load;
mod loading;
mod lock;
mod machine;
mod material;
mod memory;
mod merge;
mod noise_report;
mod outputs;
mod progress;
mod render;
mod stop;
#[cfg(feature = "studio")]
mod studio;
mod values;
mod watch;

#[cfg(not(feature = "shaders"))]
use absent::export;
#[cfg(not(feature = "tev"))]
use absent::live_view;
#[cfg(not(feature = "studio"))]
use absent::studio;
#[cfg(not(feature = "lab"))]
use absent::{gpu_report, lab};
use std::ffi::OsString;
use std::sync::OnceLock;

use clap::Parser;

use arguments::{Arguments, Command};
pub(crate) use console::print;
pub(crate) use exit_code::ExitCode;
pub(crate) use failure::Failure;

/// The arguments, the program's name first.
static GIVEN: OnceLock<Vec<OsString>> = OnceLock::new();

/// Runs a command line; returns the exit code.
pub(crate) fn command_line(arguments: Vec<OsString>) -> u8 {
    let arguments = GIVEN.get_or_init(|| arguments);
    let code = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => run(arguments).unwrap_or_else(|failure| failure.print()),
        // Help, the version, or a usage error, which ends with code 2.
        Err(told) => usage(&told),
    };
    code.number()
}

/// The arguments as given, without the program's name.
#[cfg(feature = "lab")]
fn given() -> impl Iterator<Item = String> {
    let arguments = GIVEN.get().into_iter().flatten().skip(1);
    arguments.map(|argument| argument.to_string_lossy().into_owned())
}

/// Runs the command that was asked for; returns the process's exit code.
fn run(arguments: Arguments) -> Result<ExitCode, Failure> {
    match arguments.command {
        Command::Render(a) => render::run(&a),
        Command::Info(a) => info::run(&a),
        Command::Check(a) => check::run(&a),
        Command::Convert(a) => convert::run(&a),
        Command::Compare(a) => compare::run(&a),
        Command::Merge(a) => merge::run(&a),
        Command::Farm(a) => farm::run(&a),
        Command::Denoise(a) => denoise::run(&a),
        Command::Export(a) => export::run(&a),
        Command::Lab(a) => lab::run(&a),
        Command::Studio(a) => studio::run(&a),
        Command::Devices => device::list(),
        Command::GpuReport(a) => gpu_report::run(&a),
    }
}

/// Prints help, the version, or what is wrong with the arguments; returns the exit code.
fn usage(told: &clap::Error) -> ExitCode {
    use std::io::ErrorKind;
    let is_result = !told.use_stderr();
    match told.print() {
        Err(e) if is_result && e.kind() != ErrorKind::BrokenPipe => ExitCode::FAILURE,
        _ => ExitCode::from(u8::try_from(told.exit_code()).unwrap_or(failure::BAD_INPUT)),
    }
}
