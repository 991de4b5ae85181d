//! What can be typed after `specula lab`.

use std::path::PathBuf;
use std::time::Duration;

use crate::lab::Quality;
use crate::lab::fit::{Bounces, Distribution, FresnelModel};
use crate::scene::Energy;
use crate::scene::material_text::parse_material;
use crate::scene::scene::MaterialKind;
use clap::{Args, Subcommand, ValueEnum};

use super::super::arguments::SamplerName;
use super::super::loading::LoadingArguments;
use super::super::values;

const EXAMPLES: &str = "\
Examples:
  specula lab list                                  the papers' tables and figures, by name
  specula lab run tokuyoshi24-fig5 -o results       one of them, seconds
  specula lab run 'cui23-*' --quality paper         all of a paper's, minutes each, to lab/
  specula lab report results                        results/report.html about all that is there
  specula lab compare scene.pbrt --time 30s         which sampler suits a scene of yours
  specula lab material \"conductor Au alpha 0.3\"     all about one material
  specula lab tabulate \"conductor Au alpha 0.3\" -o gold.bsdf
                                                    a synthetic measurement, to render and to fit
  specula lab fit gold.bsdf -o gold.html            the rough metal nearest to a measured material

Every result is a folder with result.json (verdict, seed, version, machine), tables as CSV, plots
as SVG and PNG, pictures as EXR and PNG. The page report.html holds all of them and needs no
network.

Exit codes: 0 done; 1 failed; 2 the arguments, the scene or the results are wrong; 130 stopped by
Ctrl-C, what was finished is saved and reported.";

/// The papers' tables and figures, and measurements on a scene or a material of yours.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct LabArguments {
    #[command(subcommand)]
    pub(crate) command: LabCommand,
}

#[derive(Debug, Subcommand)]
pub(crate) enum LabCommand {
    /// List the experiments.
    List(ListArguments),
    /// Run experiments and write a page about them.
    Run(RunArguments),
    /// Write one HTML page about all results in a folder.
    Report(ReportArguments),
    /// Compare samplers and treatments of energy on a scene, and recommend one.
    Compare(Box<LabCompareArguments>),
    /// Show a material's lobe, albedo, furnace, and how its samplers do.
    Material(MaterialArguments),
    /// Write a rough metal as a measured material, a .bsdf file of the RGL database.
    Tabulate(TabulateArguments),
    /// Fit rough metals to a measured material (.bsdf of the RGL database, .binary of MERL's).
    Fit(FitArguments),
}

#[derive(Args, Debug)]
pub(crate) struct ListArguments {
    /// Print one line of JSON for each: id, source, item, title, statement
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum QualityName {
    /// The direction of every claim, in seconds
    Draft,
    /// Fit for print, in minutes
    Paper,
}

impl From<QualityName> for Quality {
    fn from(name: QualityName) -> Self {
        match name {
            QualityName::Draft => Self::Draft,
            QualityName::Paper => Self::Paper,
        }
    }
}

/// How much of the machine to use, and what to say.
#[derive(Args, Debug)]
pub(crate) struct EffortArguments {
    /// Of all random numbers: the same seed measures the same
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,

    /// Threads. Below 0: the cores that are left free, such as -1 for all but one [default: all cores]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::threads)]
    pub(crate) threads: Option<i16>,

    /// Print results and errors only
    #[arg(short, long)]
    pub(crate) quiet: bool,
}

const RUN_EXAMPLES: &str = "\
Examples:
  specula lab run
      all experiments at draft quality, to lab/, with lab/report.html
  specula lab run tokuyoshi24-fig5 cui23-fig5 -o results
      two of them
  specula lab run 'tokuyoshi24-*' --quality paper -o results
      all whose names begin so

Each experiment's folder is replaced when it is done, not before. The page is about all results in
the folder, those of earlier runs too. Ctrl-C saves what is finished; once more ends the program at
once.";

#[derive(Args, Debug)]
#[command(after_help = RUN_EXAMPLES)]
pub(crate) struct RunArguments {
    /// Experiments as `specula lab list` names them; a name may end in * [default: all]
    #[arg(value_name = "ID")]
    pub(crate) ids: Vec<String>,

    /// How much work
    #[arg(long, value_name = "NAME", value_enum, default_value_t = QualityName::Draft)]
    pub(crate) quality: QualityName,

    /// Folder for the results, made where there is none
    #[arg(short, long, value_name = "DIR", default_value = "lab")]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) effort: EffortArguments,
}

const REPORT_EXAMPLES: &str = "\
Examples:
  specula lab report
      lab/report.html about all results in lab/
  specula lab report results/tokuyoshi24-fig5
      about one of them
  specula lab report results --markdown docs/results
      also as Markdown with small pictures, for a repository

The page is replaced whole or not at all.";

#[derive(Args, Debug)]
#[command(after_help = REPORT_EXAMPLES)]
pub(crate) struct ReportArguments {
    /// Folder with results, or one result's own
    #[arg(value_name = "DIR", default_value = "lab")]
    pub(crate) folder: PathBuf,

    /// Also write Markdown into this folder: README.md, and a page with plots, small pictures and CSV for each
    /// experiment
    #[arg(long, value_name = "FOLDER")]
    pub(crate) markdown: Option<PathBuf>,
}

/// In the order of their years.
const ALL_SAMPLERS: [SamplerName; 4] = [
    SamplerName::Heitz,
    SamplerName::Cap,
    SamplerName::Bounded,
    SamplerName::Exact,
];

const COMPARE_EXAMPLES: &str = "\
Examples:
  specula lab compare
      all samplers on the built-in scene
  specula lab compare scene.pbrt --time 2m --resolution 480x270
      each sampler renders for two minutes, the reference for eight
  specula lab compare scene.pbrt --samplers bounded,exact --energy none,turquin,kulla-conty
      treatments of energy converge to pictures of their own: each has its own reference
  specula lab compare scene.pbrt --reference truth.exr
      held against a picture that you have

Prints a recommendation with its uncertainty, and writes tables, pictures with error maps and
report.html. Give more time where it says that samplers are even within the uncertainty.";

#[derive(Args, Debug)]
#[command(after_help = COMPARE_EXAMPLES)]
pub(crate) struct LabCompareArguments {
    /// A scene (pbrt-v4, Mitsuba 3 .xml, .gltf, .glb) or a mesh (.obj, .ply); without one, the
    /// built-in scene
    pub(crate) scene: Option<PathBuf>,

    /// Samplers, separated by commas
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',',
          default_values_t = ALL_SAMPLERS)]
    pub(crate) samplers: Vec<SamplerName>,

    /// Treatments of energy, separated by commas, as of `render --energy`
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_values_t = [Energy::None])]
    pub(crate) energy: Vec<Energy>,

    /// Time for each combination, without reading and preparing; references take four times as long
    #[arg(long, value_name = "T", default_value = "30s", value_parser = values::duration)]
    pub(crate) time: Duration,

    /// The picture that all converge to (EXR), with one treatment of energy [default: rendered]
    #[arg(long, value_name = "FILE.exr")]
    pub(crate) reference: Option<PathBuf>,

    /// Give every surface this material, as of `render --material`
    #[arg(long, value_name = "TEXT", value_parser = parse_material)]
    pub(crate) material: Option<MaterialKind>,

    /// Longest path in scattering events [default: as the scene says]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=65_535))]
    pub(crate) max_depth: Option<u32>,

    /// Size of the whole picture, such as 640x360 [default: as the scene says]
    #[arg(long, value_name = "WxH", value_parser = values::resolution)]
    pub(crate) resolution: Option<[u32; 2]>,

    /// Compare these pixels only: columns x0 to x1 - 1, rows y0 to y1 - 1
    #[arg(long, value_name = "x0,x1,y0,y1", value_parser = values::crop)]
    pub(crate) crop: Option<[u32; 4]>,

    /// Exposure of pictures for screens, in stops
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_negative_numbers = true,
          value_parser = values::finite)]
    pub(crate) exposure: f32,

    /// Value of a `$name` in a Mitsuba scene, over its `<default>`. May be repeated.
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::parameter)]
    pub(crate) parameters: Vec<(String, String)>,

    /// Folder for the results, made where there is none
    #[arg(short, long, value_name = "DIR", default_value = "lab")]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) effort: EffortArguments,

    #[command(flatten)]
    pub(crate) loading: LoadingArguments,
}

/// Of commands that make one record.
#[derive(Args, Debug)]
pub(crate) struct RecordArguments {
    /// How much work
    #[arg(long, value_name = "NAME", value_enum, default_value_t = QualityName::Draft)]
    pub(crate) quality: QualityName,

    /// The page alone (FILE.html), or a folder for all files
    #[arg(short, long, value_name = "FILE.html|DIR", default_value = "lab")]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) effort: EffortArguments,
}

const MATERIAL_EXAMPLES: &str = "\
Examples:
  specula lab material \"conductor Au alpha 0.3\" -o gold.html
      one page: lobes, densities, albedo, furnace, chi-square tests, what each sampler wastes
  specula lab material \"dielectric 1.5 alpha 0.2\" --quality paper -o results
      the files too, in results/material-dielectric-1.5-alpha-0.2, and results/report.html

The text is that of `specula render --material`: conductor METAL|R G B, dielectric ETA, diffuse R G B,
coateddiffuse R G B or coatedconductor METAL, then alpha A, alpha AX AY, roughness R, eta ETA.";

#[derive(Args, Debug)]
#[command(after_help = MATERIAL_EXAMPLES)]
pub(crate) struct MaterialArguments {
    /// The material, such as "conductor Au alpha 0.3"
    #[arg(value_name = "TEXT")]
    pub(crate) text: String,

    #[command(flatten)]
    pub(crate) record: RecordArguments,
}

const TABULATE_EXAMPLES: &str = "\
Examples:
  specula lab tabulate \"conductor Au alpha 0.3\" -o gold.bsdf
      tables as large as those of the RGL database
  specula lab tabulate \"conductor Ag alpha 0.1 0.4\" --views 32 --normals 128 -o silver.bsdf
      anisotropic, in finer tables

The text is that of `specula render --material`; the metal is rough and scatters once. pbrt-v4's and Mitsuba's
material \"measured\" renders the file here; Mitsuba itself reads it in its RGB modes.";

#[derive(Args, Debug)]
#[command(after_help = TABULATE_EXAMPLES)]
pub(crate) struct TabulateArguments {
    /// The material, such as "conductor Au alpha 0.3"
    #[arg(value_name = "TEXT")]
    pub(crate) text: String,

    /// Polar angles of views, and azimuths of an anisotropic metal's
    #[arg(long, value_name = "N", default_value_t = 16, value_parser = clap::value_parser!(u16).range(3..=256))]
    pub(crate) views: u16,

    /// Normals along each axis
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u16).range(4..=1024))]
    pub(crate) normals: u16,

    /// Colours along each axis
    #[arg(long, value_name = "N", default_value_t = 32, value_parser = clap::value_parser!(u16).range(4..=256))]
    pub(crate) colours: u16,

    /// The file; of MERL's form (90 x 90 x 180 values, isotropic) where its name ends in .binary
    #[arg(short, long, value_name = "FILE.bsdf|FILE.binary")]
    pub(crate) output: PathBuf,
}

const FIT_EXAMPLES: &str = "\
Examples:
  specula lab fit gold.bsdf -o gold.html
      one page: the fits, text to paste, lobes over each other, where they differ
  specula lab fit chrome.binary --bounces single --quality paper -o results
      metals that scatter once, to more nodes; files in results/fit-chrome.binary

Alphas and the reflectance of a metal are fitted: GGX and Beckmann, an index of refraction per channel, one
bounce, several by compensation (Kulla and Conty), and all of them by simulation. Of lobes that are equally
near, the simplest is chosen.";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum DistributionName {
    Ggx,
    Beckmann,
}

impl From<DistributionName> for Distribution {
    fn from(name: DistributionName) -> Self {
        match name {
            DistributionName::Ggx => Self::Ggx,
            DistributionName::Beckmann => Self::Beckmann,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BouncesName {
    /// One bounce
    Single,
    /// One, and the lost energy made up for
    Compensated,
    /// All, by random walks
    All,
}

impl From<BouncesName> for Bounces {
    fn from(name: BouncesName) -> Self {
        match name {
            BouncesName::Single => Self::Single,
            BouncesName::Compensated => Self::Compensated,
            BouncesName::All => Self::All,
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum FresnelName {
    /// eta + i k
    Index,
    /// Reflectance along the normal, and the tint at 82 degrees; of the library, not of the renderer
    F82,
}

impl From<FresnelName> for FresnelModel {
    fn from(name: FresnelName) -> Self {
        match name {
            FresnelName::Index => Self::Index,
            FresnelName::F82 => Self::F82,
        }
    }
}

#[derive(Args, Debug)]
#[command(after_help = FIT_EXAMPLES)]
pub(crate) struct FitArguments {
    /// The measurement
    #[arg(value_name = "FILE")]
    pub(crate) file: PathBuf,

    /// Distributions of normals, separated by commas
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',',
          default_values_t = [DistributionName::Ggx, DistributionName::Beckmann])]
    pub(crate) distributions: Vec<DistributionName>,

    /// Treatments of several bounces, separated by commas
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',',
          default_values_t = [BouncesName::Single, BouncesName::Compensated, BouncesName::All])]
    pub(crate) bounces: Vec<BouncesName>,

    /// Reflectances, separated by commas
    #[arg(long, value_name = "NAMES", value_enum, value_delimiter = ',', default_values_t = [FresnelName::Index])]
    pub(crate) fresnel: Vec<FresnelName>,

    #[command(flatten)]
    pub(crate) record: RecordArguments,
}
