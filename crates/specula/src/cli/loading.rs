//! Options of every command that reads a scene: limits, and folders to search.

use std::fmt;
use std::path::PathBuf;

use crate::render::available_memory;
use crate::scene::{Limits, LoadOptions, Missing};
use clap::{Args, ValueEnum};

use super::values;

#[derive(Args, Debug)]
#[command(next_help_heading = "Reading of the scene")]
pub(crate) struct LoadingArguments {
    /// Folder in which files that the scene names are looked for where they are not beside it. May
    /// be repeated.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) search: Vec<PathBuf>,

    /// What is done about pictures, meshes and included files that do not exist
    #[arg(long, value_name = "WHAT", default_value_t = MissingName::Refuse)]
    pub(crate) missing: MissingName,

    /// Deepest nesting of files and references that is not taken for damage [default: 64]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub(crate) limit_nesting: Option<u16>,

    /// Largest file that is read, after unpacking, such as 512MiB or 16GiB [default: 4GiB, or
    /// a quarter of the memory that is available]
    #[arg(long, value_name = "SIZE", value_parser = values::size)]
    pub(crate) limit_bytes: Option<u64>,

    /// Most pixels of one picture [default: 268435456, or what an eighth of the available memory holds at
    /// 4 bytes each]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) limit_pixels: Option<u64>,

    /// Most vertices, and most triangles, of one mesh [default: 268435456]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub(crate) limit_vertices: Option<u64>,
}

/// `--missing`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MissingName {
    /// End with one error that lists them all
    Refuse,
    /// Go on with a grey checker for pictures and without the rest: warnings list them, and so does the
    /// attribute `specula.missing` of EXR files
    StandIn,
}

impl fmt::Display for MissingName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.to_possible_value()
            .map_or(Ok(()), |v| f.write_str(v.get_name()))
    }
}

impl From<MissingName> for Missing {
    fn from(name: MissingName) -> Self {
        match name {
            MissingName::Refuse => Self::Refuse,
            MissingName::StandIn => Self::StandIn,
        }
    }
}

impl LoadingArguments {
    /// What the library is told.
    ///
    /// * `parameters`: values of names in Mitsuba scenes.
    pub(crate) fn options(&self, parameters: &[(String, String)]) -> LoadOptions {
        let mut options = LoadOptions::default();
        options.limits = fitting(options.limits, available_memory());
        let limits = &mut options.limits;
        limits.max_depth = self.limit_nesting.map_or(limits.max_depth, usize::from);
        limits.max_bytes = self.limit_bytes.unwrap_or(limits.max_bytes);
        limits.max_pixels = self.limit_pixels.unwrap_or(limits.max_pixels);
        limits.max_vertices = self.limit_vertices.unwrap_or(limits.max_vertices);
        options.parameters = parameters.to_vec();
        options.folders.clone_from(&self.search);
        options.missing = self.missing.into();
        options
    }
}

/// The limits, less where they would not fit into the memory that is available.
fn fitting(mut limits: Limits, available: Option<u64>) -> Limits {
    if let Some(available) = available {
        // Text is held beside what is made of it.
        limits.max_bytes = limits.max_bytes.min((available / 4).max(LEAST_BYTES));
        // Pictures take 1 to 16 bytes a pixel, and are rarely alone.
        limits.max_pixels = limits.max_pixels.min((available / 32).max(LEAST_PIXELS));
    }
    limits
}

/// What `--limit-bytes` is at least, however little memory there is.
const LEAST_BYTES: u64 = 64 << 20;
/// What `--limit-pixels` is at least.
const LEAST_PIXELS: u64 = 1 << 22;

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct Line {
        #[command(flatten)]
        loading: LoadingArguments,
    }

    #[test]
    fn every_option_reaches_the_library() {
        let mut plain = Line::parse_from(["x"]).loading.options(&[]);
        let defaults = LoadOptions::default();
        assert!(plain.limits.max_bytes <= defaults.limits.max_bytes);
        assert!(plain.limits.max_pixels <= defaults.limits.max_pixels);
        plain.limits = defaults.limits;
        assert_eq!(plain, defaults);
        let line = [
            "x",
            "--limit-nesting=3",
            "--limit-bytes=2KiB",
            "--limit-pixels=5",
            "--limit-vertices=7",
            "--search=a",
            "--search=b",
            "--missing=stand-in",
        ];
        let options = Line::parse_from(line).loading.options(&[]);
        let mut limits = Limits::default();
        limits.max_depth = 3;
        limits.max_bytes = 2048;
        limits.max_pixels = 5;
        limits.max_vertices = 7;
        assert_eq!(options.limits, limits);
        assert_eq!(options.missing, Missing::StandIn);
        assert_eq!(options.folders, [PathBuf::from("a"), PathBuf::from("b")]);
        assert!(Line::try_parse_from(["x", "--limit-pixels=0"]).is_err());
        assert!(Line::try_parse_from(["x", "--limit-bytes=lots"]).is_err());
    }

    #[test]
    fn limits_fit_the_memory_that_is_available() {
        let plain = Limits::default();
        assert_eq!(fitting(plain, None), plain);
        assert_eq!(fitting(plain, Some(64 << 30)), plain);
        let small = fitting(plain, Some(2 << 30));
        assert_eq!((small.max_bytes, small.max_pixels), (512 << 20, 1 << 26));
        let none = fitting(plain, Some(0));
        assert_eq!(
            (none.max_bytes, none.max_pixels),
            (LEAST_BYTES, LEAST_PIXELS)
        );
    }

    #[test]
    fn the_help_says_the_defaults() {
        let limits = Limits::default();
        assert_eq!(limits.max_depth, 64);
        assert_eq!(limits.max_bytes, 4 << 30);
        assert_eq!(limits.max_pixels, 268_435_456);
        assert_eq!(limits.max_vertices, 268_435_456);
    }
}
