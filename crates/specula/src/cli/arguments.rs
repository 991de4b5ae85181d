//! Commands and options, with their help.

use std::path::PathBuf;
use std::time::Duration;

use crate::bsdf::vndf;
use crate::render::{RenderOptions, TextureFilter};
use crate::scene::Energy;
use clap::{Args, Parser, Subcommand, ValueEnum};

use super::device::{Device, GpuArguments};
use super::display::DisplayArguments;
use super::export::ExportArguments;
use super::farm::FarmArguments;
use super::gpu_report::GpuReportArguments;
use super::lab::LabArguments;
use super::loading::LoadingArguments;
use super::machine::MachineArguments;
use super::material::MaterialOverride;
use super::studio::StudioArguments;
use super::{live_view, values};

/// Render rough metal right: a path tracer whose microfacet mathematics can be trusted.
#[derive(Debug, Parser)]
#[command(name = "specula", version, propagate_version = true, after_help = EXAMPLES)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Examples:
  specula render                              the built-in scene, to orbs.exr and orbs.png
  specula render scene.pbrt -o picture.exr    a pbrt-v4 scene
  specula check scene.pbrt                    all that is wrong with it, in one report
  specula info scene.pbrt                     what is in it, and what is not supported
  specula compare reference.exr picture.exr   how far two pictures are apart
  specula merge a.film b.film -o picture.exr  parts of a render into one
  specula lab compare scene.pbrt              which sampler suits a scene
  specula studio                              samplers, lobes and renders in a browser

Exit codes: 0 done; 1 failed (or `compare` found too large a difference); 2 the arguments or
the scene are wrong; 130, 143, 129 stopped by Ctrl-C, SIGTERM, SIGHUP: what was rendered is
written.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene to EXR and PNG.
    Render(Box<RenderArguments>),
    /// Say what is in a scene, and what of it is not supported.
    Info(InfoArguments),
    /// Report all problems of scenes at once, without rendering.
    Check(CheckArguments),
    /// Write a scene as pbrt-v4, with its meshes and pictures beside it.
    Convert(ConvertArguments),
    /// Compare two EXR pictures: RMSE, relMSE, FLIP, and a picture of the difference.
    Compare(CompareArguments),
    /// Add films of distinct samples into one picture.
    Merge(MergeArguments),
    /// Render on many machines, or write jobs for a farm that there is: with the Python package's extra `farm`.
    Farm(FarmArguments),
    /// Denoise an EXR picture with Open Image Denoise, in programs built with it.
    Denoise(DenoiseArguments),
    /// Write the microfacet library in WGSL, HLSL, GLSL, Metal, SPIR-V, Slang, or C++ and CUDA.
    #[command(visible_alias = "shaders")]
    Export(ExportArguments),
    /// The papers' tables and figures, and measurements on a scene or a material of yours.
    Lab(LabArguments),
    /// Lobes, samplers and renders side by side, in a browser.
    Studio(StudioArguments),
    /// List what `render --device` can be given.
    Devices,
    /// Measure a GPU: whether its pictures are the processor's, samplers, rays and renders per second.
    GpuReport(GpuReportArguments),
}

const RENDER_EXAMPLES: &str = "\
Examples:
  specula render
      the built-in scene: five metals, isotropic behind, anisotropic in front
  specula render scene.pbrt --time 5m -o scene.exr -o scene.png
      as many samples as fit into five minutes
  specula render scene.pbrt --noise 0.02 --time 1h
      until the estimated relative error is 2 %, an hour at most
  specula render scene.pbrt --spp 256 --adaptive=off
      256 samples of every pixel, rather than as much work where it takes most noise away
  specula render scene.pbrt --resolution 480x270 --spp 4 -o preview.png
      a quick look
  specula render bunny.ply --material \"conductor Au alpha 0.3\"
      a mesh alone, on a floor in the built-in studio
  specula render robot.glb --material \"Arm*=conductor Cu alpha 0.2\" --watch
      other metal on all surfaces whose material is named Arm..., again whenever the file changes
  make-scene | specula render - -o picture.exr
      a scene from another program
  specula render scene.pbrt --crop 100,200,50,150 --spp 1024 -o detail.exr
      columns 100 to 199 and rows 50 to 149 only
  specula render scene.pbrt --samples 512..1024 -o b.film
      a part of a picture: `specula merge a.film b.film -o scene.exr` adds the parts
  specula render scene.pbrt --threads -1 --nice --max-memory 8GiB --display-server localhost
      next to other work, shown in tev meanwhile

Ctrl-C finishes the pass, writes and ends with code 130; a second Ctrl-C stops within the pass and writes
what there is; a third ends the program at once. SIGTERM and SIGHUP stop within the pass and write, with
codes 143 and 129. No file that the scene reads is written over, and no second render writes to an output
while the first runs.
Every half minute the picture so far is written, and a checkpoint beside it (scene.film for
scene.exr) from which --resume goes on after Ctrl-C, a crash or a power cut, to the same picture
bit for bit; it is removed when the render is done. Files are replaced whole or not at all. Where a
picture cannot be written in the end, the samples are saved in a film, which is named.";

/// How samples are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Adaptive {
    /// By the error of the picture.
    On,
    /// As many for every pixel.
    Off,
}

#[derive(Args, Debug)]
#[command(after_help = RENDER_EXAMPLES)]
pub(crate) struct RenderArguments {
    /// A scene (pbrt-v4, Mitsuba 3, glTF) or a mesh (OBJ, PLY), whatever its name ends in; - is standard
    /// input; without one, the built-in scene of rough-metal orbs
    pub(crate) scene: Option<PathBuf>,

    /// File to write: .exr (all layers, linear), .png (what a screen shows) or .film (sums, for
    /// `merge` and --resume). May be repeated.
    /// [default: the scene's name with .exr and with .png, in the current folder]
    #[arg(short, long = "output", value_name = "OUT", value_parser = values::output)]
    pub(crate) output: Vec<PathBuf>,

    /// Samples per pixel: with --adaptive, the default from 8 on, as much work as so many everywhere
    /// [default: as the scene says, with --noise 65536]
    #[arg(long, value_name = "N", group = "effort",
          value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub(crate) spp: Option<u32>,

    /// Render for this long: 90s, 5m, 1.5h
    #[arg(long, value_name = "T", group = "effort", value_parser = values::duration)]
    pub(crate) time: Option<Duration>,

    /// Render until the estimated relative error of the picture is E, such as 0.02, with samples spread as
    /// by --adaptive. --spp and --time end it earlier
    #[arg(long, value_name = "E", conflicts_with = "samples", value_parser = values::positive)]
    pub(crate) noise: Option<f32>,

    /// Put more samples where there is more noise, less where they cost more: --spp and --time say how much
    /// work it is in all. Less error in the same time. off: as many samples of every pixel, whose mean has no
    /// bias at all [default: on, off below 8 samples per pixel and with --samples]
    #[arg(long, value_name = "WHEN", num_args = 0..=1, require_equals = true, default_missing_value = "on",
          conflicts_with = "samples")]
    pub(crate) adaptive: Option<Adaptive>,

    /// Bias: clamp each contribution of indirect light (scattered twice or more) to V in every channel, where 1 is
    /// white: fireflies go, and the light that they stand for with them. The picture gets darker; 10 takes little,
    /// 1 much
    #[arg(long, value_name = "V", value_parser = values::positive)]
    pub(crate) clamp: Option<f32>,

    /// Bias: make shiny surfaces rougher where paths come to them from rough ones, as pbrt's `regularize`: less
    /// noise of light that reaches rough surfaces through glass and mirrors; such caustics get blurred
    #[arg(long)]
    pub(crate) regularize: bool,

    /// Render these samples of every pixel only, such as 512..1024, for `specula merge`
    /// [default output: the scene's name, the range and .film]
    #[arg(long, value_name = "A..B", group = "effort", value_parser = values::samples)]
    pub(crate) samples: Option<[u32; 2]>,

    /// With --adaptive or --noise: of one round, only the tiles A to B - 1 of every N, for `specula merge`. With
    /// --resume=FILM it is the round after that film: `specula farm` renders so
    #[arg(long, value_name = "A..B/N", conflicts_with_all = ["samples", "time", "watch"],
          value_parser = values::round_share)]
    pub(crate) round_share: Option<[u32; 3]>,

    /// Go on with the checkpoint beside the output, or begin where there is none; --resume=FILM: with
    /// that film
    #[arg(long, value_name = "FILM", num_args = 0..=1, require_equals = true,
          conflicts_with = "restart")]
    pub(crate) resume: Option<Option<PathBuf>>,

    /// Begin anew and replace the checkpoint beside the output
    #[arg(long)]
    pub(crate) restart: bool,

    /// Time between two writes of the picture and the checkpoint (a larger one where they would take
    /// more than a twentieth of the time), or off
    #[arg(long, value_name = "T", default_value = "30s", value_parser = values::interval)]
    pub(crate) checkpoint: values::Interval,

    /// Sampler of reflections off rough surfaces; the picture converges to the same
    #[arg(long, value_name = "NAME", default_value_t = SamplerName::Exact)]
    pub(crate) sampler: SamplerName,

    /// What rough metal and glass do about light that they scatter more than once, where a material
    /// does not say it itself: none (they darken), turquin, turquin-series, kulla-conty (formulas),
    /// multibounce (simulated) or multibounce=MODEL with heitz, bitterli, wang, wang-uncorrelated,
    /// cui, cui-bidirectional or specula [default: none for pbrt's and Mitsuba's scenes, as in these
    /// renderers; turquin for glTF, meshes and the built-in scene]
    #[arg(long, value_name = "NAME")]
    pub(crate) energy: Option<Energy>,

    /// Value of a `$name` in a Mitsuba scene, over its `<default>`. May be repeated.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::parameter)]
    pub(crate) parameters: Vec<(String, String)>,

    /// Give every surface this material, such as "conductor Au alpha 0.3", "dielectric 1.5",
    /// "coateddiffuse 0.1 0.3 0.8 alpha 0.05", "diffuse 0.5"; lamps keep theirs, and so does the floor
    /// under a file without light. With NAME= before it, those surfaces only whose material has this name
    /// in the file (that of the floor: floor); NAME may be a pattern such as "Chrome*". May be repeated:
    /// the last one counts
    #[arg(long, value_name = "[NAME=]TEXT")]
    pub(crate) material: Vec<MaterialOverride>,

    /// Render again whenever the scene or a file that it reads changes, until Ctrl-C. The picture is
    /// written every two seconds; acceleration structures of shapes that did not change are reused
    #[arg(long, conflicts_with_all = ["samples", "resume", "restart"])]
    pub(crate) watch: bool,

    /// Denoise the finished picture with Open Image Denoise, guided by albedo and normals; .film has
    /// the samples as they are. In programs built with it only
    #[arg(long)]
    pub(crate) denoise: bool,

    /// Filter of textures. Over footprints there is less noise where pictures are seen from afar, and a bias that falls
    /// with the number of samples
    #[arg(long, value_name = "FILTER", default_value_t = TextureFilterName::Scene)]
    pub(crate) texture_filter: TextureFilterName,

    /// Filter normal maps into roughness, by LEAN mapping: seen from afar, metal reflects as its normals do, not as
    /// their mean does. Maps that are interpolated bilinearly are filtered over ellipses, whatever other textures are
    #[arg(long)]
    pub(crate) filter_normal_maps: bool,

    /// Longest path in scattering events [default: as the scene says]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=65_535))]
    pub(crate) max_depth: Option<u32>,

    /// Render these pixels only: columns x0 to x1 - 1, rows y0 to y1 - 1
    #[arg(long, value_name = "x0,x1,y0,y1", value_parser = values::crop)]
    pub(crate) crop: Option<[u32; 4]>,

    /// Size of the whole picture, such as 1280x720 [default: as the scene says]
    #[arg(long, value_name = "WxH", value_parser = values::resolution)]
    pub(crate) resolution: Option<[u32; 2]>,

    /// Seed of the random sequences: renders of different seeds are independent
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) seed: u32,

    /// Let the paths of N neighbouring pixels, 1 to 16, share their vertices behind the first rough
    /// surfaces: half the time to the same noise of a pixel where rough surfaces light each other (8 is
    /// good), more on fine detail under open skies. Pixels that share have noise in common: seen from
    /// afar, as in means of 8 x 8 pixels, the picture takes one to three times as long to the same noise
    #[arg(long, value_name = "N", default_value_t = 1,
          value_parser = clap::value_parser!(u32).range(1..=i64::from(RenderOptions::MOST_SHARING)))]
    pub(crate) share_paths: u32,

    /// Show the picture while it is rendered, in the viewer tev that runs at HOST: it is sent after
    /// passes, once in a second at most. The port may be left out: 14158
    #[arg(long, value_name = "HOST:PORT", value_parser = live_view::address)]
    pub(crate) display_server: Option<String>,

    /// What takes the samples: cpu; gpu, gpu:INDEX or gpu:NAME as `specula devices` lists them; several of
    /// them as gpu:0,1, all real ones as gpu:all, each as many samples as it is fast; or auto: the fastest GPU
    /// that `specula gpu-report` has measured to be faster than the processor, where it renders all of the
    /// scene, else the processor, with a note
    #[arg(long, value_name = "NAME", default_value_t = Device::Cpu)]
    pub(crate) device: Device,

    #[command(flatten)]
    pub(crate) gpu: GpuArguments,

    #[command(flatten)]
    pub(crate) machine: MachineArguments,

    #[command(flatten)]
    pub(crate) display: DisplayArguments,

    /// Print errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,

    /// Say in the end how many vertices of paths were shaded in batches, how many of these but for their
    /// lobes, how many singly, and how many samples of lobes were rejected
    #[arg(long, conflicts_with = "quiet")]
    pub(crate) stats: bool,

    #[command(flatten)]
    pub(crate) loading: LoadingArguments,
}

const MERGE_EXAMPLES: &str = "\
Examples:
  specula render scene.pbrt --samples 0..512 -o a.film        on one machine
  specula render scene.pbrt --samples 512..1024 -o b.film     on another
  specula merge a.film b.film -o scene.exr -o scene.png
      the picture of all 1024 samples, bit for bit that of one render
  specula merge a.film b.film -o whole.film
      to be merged with more, or gone on with by `render --resume -o whole.film`

Films whose samples overlap, or which are of different scenes, settings or versions, are refused
with exit code 2.";

#[derive(Args, Debug)]
#[command(after_help = MERGE_EXAMPLES)]
pub(crate) struct MergeArguments {
    /// Films that `render -o NAME.film` wrote, in any order
    #[arg(required = true, value_name = "FILM")]
    pub(crate) films: Vec<PathBuf>,

    /// File to write: .exr, .png or .film. May be repeated.
    #[arg(short, long = "output", required = true, value_name = "OUT", value_parser = values::output)]
    pub(crate) output: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) display: DisplayArguments,

    /// Print errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

const DENOISE_EXAMPLES: &str = "\
Examples:
  specula denoise scene.exr -o smooth.exr -o smooth.png
      by the layers albedo and normal of scene.exr, where it has them

A denoised picture is smooth, not right: compare and measure with the one that was rendered.";

#[derive(Args, Debug)]
#[command(after_help = DENOISE_EXAMPLES)]
pub(crate) struct DenoiseArguments {
    /// The picture (EXR)
    pub(crate) picture: PathBuf,

    /// File to write: .exr or .png. May be repeated.
    #[arg(short, long = "output", required = true, value_name = "OUT", value_parser = values::picture)]
    pub(crate) output: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) display: DisplayArguments,

    /// Print errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SamplerName {
    /// Spherical caps (Dupuy and Benyoub 2023)
    Cap,
    /// Bounded spherical caps (Tokuyoshi and Eto 2024)
    Bounded,
    /// Only reflections above the surface, none rejected: the least noise
    Exact,
    /// Heitz 2018
    Heitz,
}

impl From<SamplerName> for vndf::Sampler {
    fn from(name: SamplerName) -> Self {
        match name {
            SamplerName::Cap => Self::Cap,
            SamplerName::Bounded => Self::Bounded,
            SamplerName::Exact => Self::Exact,
            SamplerName::Heitz => Self::Heitz,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum TextureFilterName {
    /// As the scene says
    Scene,
    /// Not over footprints: between the nearest four pixels
    Bilinear,
    /// Over squares, by mip maps
    Trilinear,
    /// Over ellipses: sharper at grazing angles
    Ewa,
}

impl From<TextureFilterName> for TextureFilter {
    fn from(name: TextureFilterName) -> Self {
        match name {
            TextureFilterName::Scene => Self::Scene,
            TextureFilterName::Bilinear => Self::Bilinear,
            TextureFilterName::Trilinear => Self::Trilinear,
            TextureFilterName::Ewa => Self::Ewa,
        }
    }
}

macro_rules! display_as_value {
    ($($t:ty),*) => {$(
        impl std::fmt::Display for $t {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                self.to_possible_value().map_or(Ok(()), |v| f.write_str(v.get_name()))
            }
        }
    )*};
}
display_as_value!(SamplerName, TextureFilterName, MetricName);

#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  specula info scene.pbrt\n  specula info       the built-in scene\n  specula info --files scene.pbrt | tar cf scene.tar -T -"
)]
pub(crate) struct InfoArguments {
    /// A scene (pbrt-v4, Mitsuba 3 .xml, .gltf, .glb) or a mesh (.obj, .ply); without one, the
    /// built-in scene
    pub(crate) scene: Option<PathBuf>,

    /// Print the files that the scene is read from and nothing else, a line for each: what another machine needs
    #[arg(long)]
    pub(crate) files: bool,

    /// Print what a film holds instead, as a line of JSON: scene, samples, least, most, mean, noise, work, seconds
    #[arg(long, value_name = "FILM", conflicts_with_all = ["scene", "files"])]
    pub(crate) film: Option<PathBuf>,

    /// Value of a `$name` in a Mitsuba scene, over its `<default>`. May be repeated.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::parameter)]
    pub(crate) parameters: Vec<(String, String)>,

    #[command(flatten)]
    pub(crate) loading: LoadingArguments,
}

const CHECK_EXAMPLES: &str = "\
Examples:
  specula check scene.pbrt
      errors, what would be rendered otherwise than the file says, and what is unused
  specula check --strict scenes/*.xml
      several scenes; exit code 2 where one has errors or warnings
  specula check scene.xml --search ../textures
      looks for pictures and meshes in another folder too
  specula check --json scene.gltf | jq '.problems[] | select(.severity == \"error\")'
      one line of JSON for each scene: file, errors, warnings, notes, unlisted, and problems with
      severity, kind, file, line, column, message, help, count

Reading goes on behind an error, with a neutral stand-in for what has one, so that one run finds all.
Equal warnings are printed once with their count; at most 100 problems of each severity are listed.

Exit codes: 0 the scene can be rendered; 2 it has errors, or warnings under --strict.";

#[derive(Args, Debug)]
#[command(after_help = CHECK_EXAMPLES)]
pub(crate) struct CheckArguments {
    /// Scenes, of any format that `render` takes
    #[arg(required = true, value_name = "SCENE")]
    pub(crate) scenes: Vec<PathBuf>,

    /// Count warnings as errors in the exit code
    #[arg(long)]
    pub(crate) strict: bool,

    /// Print one line of JSON for each scene
    #[arg(long)]
    pub(crate) json: bool,

    /// Value of a `$name` in a Mitsuba scene, over its `<default>`. May be repeated.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::parameter)]
    pub(crate) parameters: Vec<(String, String)>,

    #[command(flatten)]
    pub(crate) loading: LoadingArguments,
}

const CONVERT_EXAMPLES: &str = "\
Examples:
  specula convert scene.xml scene.pbrt
  specula convert model.glb model.pbrt
      writes model.pbrt, and meshes and pictures into model-files/

What pbrt-v4 cannot say is written as the nearest that it can, and named in a note.";

#[derive(Args, Debug)]
#[command(after_help = CONVERT_EXAMPLES)]
pub(crate) struct ConvertArguments {
    /// The scene, of any format that `render` takes
    pub(crate) scene: PathBuf,
    /// The file to write
    #[arg(value_name = "OUT.pbrt", value_parser = values::pbrt)]
    pub(crate) output: PathBuf,

    /// Value of a `$name` in a Mitsuba scene, over its `<default>`. May be repeated.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::parameter)]
    pub(crate) parameters: Vec<(String, String)>,

    #[command(flatten)]
    pub(crate) loading: LoadingArguments,
}

const COMPARE_EXAMPLES: &str = "\
Examples:
  specula compare reference.exr picture.exr
  specula compare reference.exr picture.exr --diff difference.png
      HDR-FLIP in false colours: black is equal, yellow the largest difference there is
  specula compare reference.exr picture.exr --metric rmse --fail-above 0.01
      exit code 1 where the root mean square error is above 0.01";

#[derive(Args, Debug)]
#[command(after_help = COMPARE_EXAMPLES)]
pub(crate) struct CompareArguments {
    /// The picture that is right (EXR, by any renderer)
    pub(crate) reference: PathBuf,
    /// The picture that is tested (EXR, of the same size)
    pub(crate) test: PathBuf,

    /// Write a false-colour picture of the difference
    #[arg(long, value_name = "OUT.png", value_parser = values::png)]
    pub(crate) diff: Option<PathBuf>,

    /// End with exit code 1 where the metric is above this
    #[arg(long, value_name = "VALUE", value_parser = values::not_negative)]
    pub(crate) fail_above: Option<f64>,

    /// The metric that --fail-above is about
    #[arg(long, value_name = "NAME", default_value_t = MetricName::HdrFlip, requires = "fail_above")]
    pub(crate) metric: MetricName,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MetricName {
    /// Perceived difference over all exposures (Andersson et al. 2021), 0 to 1
    HdrFlip,
    /// Perceived difference as displayed (Andersson et al. 2020), 0 to 1
    Flip,
    /// Root mean square error
    Rmse,
    /// Mean of squared errors relative to the reference
    RelMse,
    /// Mean absolute error
    Mae,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn definitions_are_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn efforts_exclude_each_other() {
        for pair in [
            ["--spp=4", "--time=3s"],
            ["--noise=0.1", "--samples=0..4"],
            ["--adaptive", "--samples=0..4"],
        ] {
            let line = ["specula", "render", pair[0], pair[1]];
            assert!(Arguments::try_parse_from(line).is_err(), "{pair:?}");
        }
        for pair in [
            ["--exposure", "-1.5"],
            ["--noise=0.1", "--spp=4"],
            ["--adaptive", "--spp=4"],
            ["--adaptive=off", "--spp=4"],
            ["--noise=1", "--time=3s"],
        ] {
            let line = ["specula", "render", pair[0], pair[1]];
            assert!(Arguments::try_parse_from(line).is_ok(), "{pair:?}");
        }
    }

    #[test]
    fn sampler_names_are_those_of_the_library() {
        for name in SamplerName::value_variants() {
            let sampler = vndf::Sampler::from(*name);
            assert_eq!(sampler.to_string(), name.to_string());
        }
    }
}
