//! Commands and options of a program that was built without a feature of Cargo: messages that name it.

/// That this program lacks something, and how to have it.
///
/// * `what`: with its article.
pub(crate) fn message(what: &str, feature: &str) -> String {
    format!(
        "this program is built without {what}; \
         `cargo build --release -p specula --features {feature}` builds it in"
    )
}

#[cfg(any(
    not(feature = "lab"),
    not(feature = "shaders"),
    not(feature = "studio")
))]
mod command {
    use crate::cli::ExitCode;
    use std::ffi::OsString;

    use clap::Args;

    use super::super::Failure;

    /// All that follows the command's name, `--help` too: none of it is known.
    #[derive(Args, Debug)]
    #[command(disable_help_flag = true)]
    pub(crate) struct AnyArguments {
        #[arg(hide = true, trailing_var_arg = true, allow_hyphen_values = true)]
        _rest: Vec<OsString>,
    }

    /// Says which feature the command needs.
    pub(super) fn refuse(what: &str, feature: &str) -> Result<ExitCode, Failure> {
        Err(Failure::bad_input(super::message(what, feature)))
    }
}

/// `specula lab` without the laboratory.
#[cfg(not(feature = "lab"))]
pub(crate) mod lab {
    use crate::cli::ExitCode;

    use super::super::Failure;
    pub(crate) use super::command::AnyArguments as LabArguments;

    /// Says which feature it needs.
    pub(crate) fn run(_: &LabArguments) -> Result<ExitCode, Failure> {
        super::command::refuse("the laboratory", "lab")
    }
}

/// `specula studio` without it.
#[cfg(not(feature = "studio"))]
pub(crate) mod studio {
    use crate::cli::ExitCode;

    use super::super::Failure;
    pub(crate) use super::command::AnyArguments as StudioArguments;

    /// Says which feature it needs.
    pub(crate) fn run(_: &StudioArguments) -> Result<ExitCode, Failure> {
        super::command::refuse("the studio", "studio")
    }
}

/// `specula gpu-report` without the laboratory.
#[cfg(not(feature = "lab"))]
pub(crate) mod gpu_report {
    use crate::cli::ExitCode;

    use super::super::Failure;
    pub(crate) use super::command::AnyArguments as GpuReportArguments;

    /// Says which feature it needs.
    pub(crate) fn run(_: &GpuReportArguments) -> Result<ExitCode, Failure> {
        super::command::refuse("the GPU's report", "lab")
    }
}

/// `specula export` without the library's texts.
#[cfg(not(feature = "shaders"))]
pub(crate) mod export {
    use crate::cli::ExitCode;

    use super::super::Failure;
    pub(crate) use super::command::AnyArguments as ExportArguments;

    /// Says which feature it needs.
    pub(crate) fn run(_: &ExportArguments) -> Result<ExitCode, Failure> {
        super::command::refuse("the library's export", "shaders")
    }
}

/// `render --display-server` without tev's protocol.
#[cfg(not(feature = "tev"))]
pub(crate) mod live_view {
    use crate::render::FilmBuffer;

    use super::super::Failure;

    /// There is none.
    pub(crate) enum LiveView {}

    impl LiveView {
        /// Says which feature it needs; [`address`] said so before.
        pub(crate) fn connect(_: &str, _: &str) -> Result<Self, Failure> {
            Err(Failure::bad_input(super::message("the live view", "tev")))
        }

        /// Never called.
        pub(crate) fn update(&mut self, _: &FilmBuffer) {
            match *self {}
        }

        /// Never called.
        pub(crate) fn show(&mut self, _: &FilmBuffer) {
            match *self {}
        }

        /// Never called.
        pub(crate) fn finish(&mut self, _: &FilmBuffer) {
            match *self {}
        }
    }

    /// No address is accepted.
    pub(crate) fn address(_: &str) -> Result<String, String> {
        Err(super::message("the live view", "tev"))
    }
}
