//! Options of every command that reads a scene: limits, and folders to search.

use std::fmt;
use std::path::PathBuf;
use std::time::Duration;

use crate::render::available_memory;
use crate::scene::{Exposure, Limits, LoadOptions, Missing};
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

    /// Moment of a glTF file's animations, such as 1.5s or 250ms; without it nodes stand where the file puts
    /// them
    #[arg(long, value_name = "TIME", value_parser = values::moment, conflicts_with = "frame")]
    pub(crate) at: Option<Duration>,

    /// The moment as the number of a frame, from 0
    #[arg(long, value_name = "N")]
    pub(crate) frame: Option<u32>,

    /// Frames of a second
    #[arg(long, value_name = "N", value_parser = values::rate, default_value_t = 24.0)]
    pub(crate) fps: f64,

    /// How long the shutter is open from that moment on, such as 20ms: what moves is blurred
    #[arg(long, value_name = "TIME", value_parser = values::moment)]
    pub(crate) shutter: Option<Duration>,

    /// Which animation of a glTF file, by its name or its number from 0 [default: all together, or the first alone
    /// where they move the same]
    #[arg(long, value_name = "NAME")]
    pub(crate) animation: Option<String>,

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
        options.exposure = self.exposure();
        options.animation.clone_from(&self.animation);
        options
    }

    /// The moment of animations that is asked for.
    fn exposure(&self) -> Option<Exposure> {
        let frame = |n: u32| Duration::from_secs_f64(f64::from(n) / self.fps);
        let time = self.at.or_else(|| self.frame.map(frame));
        let is_asked_for = time.is_some() || self.shutter.is_some() || self.animation.is_some();
        is_asked_for.then(|| Exposure {
            time: time.unwrap_or_default(),
            shutter: self.shutter.unwrap_or_default(),
        })
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
        let moment = |line: &[&str]| {
            let line = ["x"].iter().chain(line);
            let exposure = Line::parse_from(line).loading.options(&[]).exposure;
            exposure.map(|e| [e.time, e.shutter].map(|t| t.as_secs_f64()))
        };
        assert_eq!(moment(&[]), None);
        assert_eq!(moment(&["--fps=30"]), None);
        assert_eq!(moment(&["--at=1.5"]), Some([1.5, 0.0]));
        assert_eq!(moment(&["--at=0", "--shutter=20ms"]), Some([0.0, 0.02]));
        assert_eq!(moment(&["--shutter=1s"]), Some([0.0, 1.0]));
        assert_eq!(moment(&["--frame=36"]), Some([1.5, 0.0]));
        assert_eq!(moment(&["--frame=36", "--fps=12.5"]), Some([2.88, 0.0]));
        for wrong in [
            &["x", "--at=1", "--frame=2"][..],
            &["x", "--at=-1"],
            &["x", "--frame=-1"],
            &["x", "--frame=1", "--fps=0"],
            &["x", "--shutter=long"],
        ] {
            assert!(Line::try_parse_from(wrong).is_err(), "{wrong:?}");
        }
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
