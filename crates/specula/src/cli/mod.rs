//! The commands, one file each.

mod arguments;
mod check;
mod checkpoint;
mod compare;
mod convert;
mod denoise;
mod device;
mod failure;
mod info;
mod lab;
mod lab_arguments;
mod lab_compare;
mod lab_material;
mod lab_run;
mod live_view;
mod load;
mod loading;
mod machine;
mod memory;
mod merge;
mod outputs;
mod progress;
mod render;
mod schedule;
mod shaders;
mod stop;
mod values;

use std::process::ExitCode;

pub(crate) use arguments::Arguments;
use arguments::Command;
use failure::Failure;

/// Runs the command that was asked for; returns the process's exit code.
pub(crate) fn run(arguments: Arguments) -> Result<ExitCode, Failure> {
    match arguments.command {
        Command::Render(a) => render::run(&a),
        Command::Info(a) => info::run(&a),
        Command::Check(a) => check::run(&a),
        Command::Convert(a) => convert::run(&a),
        Command::Compare(a) => compare::run(&a),
        Command::Merge(a) => merge::run(&a),
        Command::Denoise(a) => denoise::run(&a),
        Command::Shaders(a) => shaders::run(&a),
        Command::Lab(a) => lab::run(&a),
        Command::Devices => Ok(device::list()),
    }
}

/// Prints to standard output; a reader that has gone away (`specula info x | head`) is no error.
fn print(text: &str) {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
}
