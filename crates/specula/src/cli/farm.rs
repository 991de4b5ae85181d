//! `specula farm`: the farm is part of the Python package, which this finds and runs.

use std::ffi::OsString;
use std::process::{Command, Stdio};

use clap::Args;

use super::{ExitCode, Failure};

/// Names that Python's interpreter has.
const INTERPRETERS: [&str; 2] = ["python3", "python"];
/// Names the interpreter that has the package.
const VARIABLE: &str = "SPECULA_PYTHON";
/// Succeeds where the package is there; it says itself what its extra lacks.
const CHECK: &str = "import specula_render.farm";

/// All that follows the command's name: Python reads it.
#[derive(Args, Debug)]
#[command(disable_help_flag = true)]
pub(crate) struct FarmArguments {
    #[arg(
        value_name = "ARGUMENTS",
        trailing_var_arg = true,
        allow_hyphen_values = true
    )]
    rest: Vec<OsString>,
}

/// Runs `python -m specula_render.farm`; its exit code.
pub(crate) fn run(arguments: &FarmArguments) -> Result<ExitCode, Failure> {
    let Some(python) = interpreter() else {
        return Err(Failure::bad_input(format_args!(
            "`specula farm` needs Python 3.10 or newer with the package specula-render and its extra farm: \
             `pip install \"specula-render[farm]\"` installs both; {VARIABLE} names another interpreter"
        )));
    };
    let mut command = Command::new(&python);
    command.args(["-m", "specula_render.farm"]);
    command.args(&arguments.rest);
    let failed = |e: std::io::Error| {
        let name = python.display();
        Failure::other(format_args!("cannot run '{name}': {e}"))
    };
    replace(command).map_err(failed)
}

/// The first interpreter that has the package.
fn interpreter() -> Option<OsString> {
    let names = match std::env::var_os(VARIABLE) {
        Some(name) => vec![name],
        None => INTERPRETERS.map(OsString::from).to_vec(),
    };
    let has_package = |name: &OsString| {
        let mut check = Command::new(name);
        check.args(["-c", CHECK]).stdin(Stdio::null());
        check.stdout(Stdio::null()).stderr(Stdio::null());
        check.status().is_ok_and(|status| status.success())
    };
    names.into_iter().find(has_package)
}

/// Becomes the program, so that signals reach it.
#[cfg(unix)]
fn replace(mut command: Command) -> std::io::Result<ExitCode> {
    use std::os::unix::process::CommandExt as _;
    Err(command.exec())
}

#[cfg(not(unix))]
fn replace(mut command: Command) -> std::io::Result<ExitCode> {
    let code = command.status()?.code();
    let code = code.and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}
